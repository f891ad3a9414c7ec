//! What a census says, as `funicular census --json` prints it. Tables and CSV are written from the
//! same.

use census::{
    CheckError, DegenerateEquilibrium, Interval, Position, ProvenEquilibrium, SlackFamily,
    Statistics, StraightPosition, Undecided,
};
use model::{Equilibrium, Problem, Reason, SolverName, Status, SystemSummary};
use serde::Serialize;
use validate::systems::judge_chain;

use crate::solve::SCHEMA_VERSION;

/// Both ends of an enclosure.
pub type Enclosure = [f64; 2];

/// All equilibria of a chain with their proofs, and what is known of the list.
#[derive(Debug, Clone, Serialize)]
pub struct ChainCensusAnswer {
    /// Version of this object as JSON.
    pub schema_version: u32,
    /// What was asked about.
    pub system: SystemSummary,
    /// The equilibria in one vertical plane, by energy; circles by both their mirror images.
    pub equilibria: Vec<Found>,
    /// The census as a whole.
    pub census: Summary,
    /// The census itself, to draw and to ask further.
    #[serde(skip)]
    pub proven: census::Census,
    /// The chain.
    #[serde(skip)]
    pub problem: Problem,
}

/// One equilibrium: the same keys as those of `solve`, and what only a census knows.
#[derive(Debug, Clone, Serialize)]
pub struct Found {
    /// As every solver gives it, from the middles of the enclosures.
    #[serde(flatten)]
    pub equilibrium: Equilibrium,
    /// `1`, or `1'` for the mirror image of 1 on the same circle.
    pub label: String,
    /// The number of the circle, from 1.
    pub circle: Option<usize>,
    /// Whether this is the mirror image.
    pub mirrored: bool,
    /// Angle of each bar from the descending vertical, [0, 360).
    pub angles_deg: Vec<f64>,
    /// The same, (-180, 180].
    pub angles_signed_deg: Vec<f64>,
    /// +1 for each bar in tension, -1 in compression, 0 for one that carries next to nothing.
    pub signs: Vec<i8>,
    /// The energy in units of `census.energy_unit_j`.
    pub energy_scaled: f64,
    /// Largest relative width of the enclosures.
    pub box_width: f64,
    /// Intervals that hold the exact values.
    pub enclosures: Enclosures,
}

/// Intervals that hold the exact values.
#[derive(Debug, Clone, Serialize)]
pub struct Enclosures {
    /// Pull of the chain on the first anchor, level and upright.
    pub pull_n: [Enclosure; 2],
    /// Energy above the height of joint 0.
    pub energy_j: Enclosure,
    /// Angle of each bar from the descending vertical.
    pub angles_rad: Vec<Enclosure>,
    /// Place of each joint.
    pub joints_m: Vec<[Enclosure; 3]>,
    /// Force at each joint.
    pub multipliers_n: Vec<[Enclosure; 3]>,
    /// Axial force of each bar.
    pub axial_n: Vec<Enclosure>,
}

/// The census as a whole.
#[derive(Debug, Clone, Serialize)]
pub struct Summary {
    /// Whether every equilibrium is in `equilibria` or `slack_families`.
    pub complete: bool,
    /// Whether every equilibrium is in `equilibria`, `slack_families` or `degenerate`, or upright
    /// in `straight`.
    pub decided: bool,
    /// Number of isolated equilibria in one vertical plane: the length of `equilibria`, where each
    /// is listed with everything; by signs and pulls a circle is listed once.
    pub count: usize,
    /// Whether the anchors are on one vertical, so that equilibria come in circles.
    pub circles: bool,
    /// Number of circles, or `None` if equilibria do not come in circles.
    pub circle_count: Option<usize>,
    /// By index in the plane, slack families with their Betti numbers.
    pub count_by_index: Vec<i64>,
    /// Σ (-1)^index over them.
    pub alternating_sum: i64,
    /// Of the planar configuration space, from the lengths alone; `None` if it is no manifold.
    pub euler_characteristic: Option<i64>,
    /// Its Betti numbers.
    pub betti: Option<Vec<u64>>,
    /// Why `euler_characteristic` is not known.
    pub topology_unknown: Option<String>,
    /// Positions in which all bars lie in the line between the anchors.
    pub straight: Vec<StraightPosition>,
    /// Equilibria at which several have merged.
    pub degenerate: Vec<Merged>,
    /// How many boxes could not be decided.
    pub undecided_boxes: usize,
    /// Those boxes.
    pub undecided: Vec<Open>,
    /// Sets of equilibria with bars that carry nothing.
    pub slack_families: Vec<Slack>,
    /// What `energy_scaled` is a multiple of.
    pub energy_unit_j: f64,
    /// What that is, in words.
    pub energy_unit: &'static str,
    /// Its symbol.
    pub energy_symbol: &'static str,
    /// The list judged again, without the search.
    pub check: Check,
    /// What it took.
    pub statistics: Statistics,
}

/// What could not be decided.
#[derive(Debug, Clone, Serialize)]
pub struct Open {
    /// Name of the reason.
    pub reason: String,
    /// The reason in words.
    pub why: String,
    /// How many patterns of tension and compression are in question.
    pub pattern_count: usize,
    /// The first of them.
    pub patterns: Vec<Vec<i8>>,
    /// The face of the half cube of pulls where the box is.
    pub chart: serde_json::Value,
    /// The box in the coordinates of that face.
    pub at: [Enclosure; 2],
    /// The pulls in it, if they are bounded.
    pub pull_n: Option<[Enclosure; 2]>,
    /// At most so many equilibria in the box and next to it, counted with multiplicity, besides
    /// those listed; if that is proved.
    pub at_most: Option<usize>,
    /// Of what degree they are together: their number has the same parity.
    pub degree: Option<i8>,
}

/// A set of equilibria with bars that carry nothing.
#[derive(Debug, Clone, Serialize)]
pub struct Slack {
    /// +1 for each bar in tension, -1 in compression, 0 for a slack one.
    pub signs: Vec<i8>,
    /// Energy above the height of joint 0.
    pub energy_j: Enclosure,
    /// The gap that the slack bars bridge.
    pub gap_m: Enclosure,
    /// Pull of the chain on the first anchor, level and upright.
    pub pull_n: [Enclosure; 2],
    /// Directions in the plane in which the energy falls.
    pub index_in_plane: usize,
    /// Directions in space in which the energy falls.
    pub index_in_space: usize,
    /// Dimension of the set in the plane.
    pub dimension_in_plane: usize,
    /// Whether it is a manifold, across which the second derivative is regular; not if the slack bars
    /// also fit into one line, or close upon themselves folded.
    pub is_manifold: bool,
}

/// An equilibrium at which several have merged: a bar carries nothing, or several in one line, and the
/// second derivative vanishes in some direction in the plane.
#[derive(Debug, Clone, Serialize)]
pub struct Merged {
    /// +1 for each bar in tension, -1 in compression, 0 for those that carry nothing.
    pub signs: Vec<i8>,
    /// How many have merged: 2 at a fold, 3 at a pitchfork; none where a whole family has shrunk to
    /// this position.
    pub multiplicity: Option<usize>,
    /// Σ (-1)^index over those into which it falls apart when the chain is changed a little.
    pub degree: i8,
    /// Directions in the plane in which the energy falls in second order.
    pub index_in_plane: usize,
    /// Directions out of the plane in which the energy falls.
    pub index_out_of_plane: usize,
    /// Energy above the height of joint 0.
    pub energy_j: Enclosure,
    /// Pull of the chain on the first anchor, level and upright.
    pub pull_n: [Enclosure; 2],
    /// Angle of each bar from the descending vertical.
    pub angles_rad: Vec<Enclosure>,
    /// Place of each joint.
    pub joints_m: Vec<[Enclosure; 3]>,
    /// Axial force of each bar.
    pub axial_n: Vec<Enclosure>,
}

/// The census judged again, without the search.
#[derive(Debug, Clone, Serialize)]
pub struct Check {
    /// Whether every equilibrium is proved again.
    pub passed: bool,
    /// Whether something is shown to be wrong; else what failed is a proof, which shows nothing.
    pub refuted: bool,
    /// What failed.
    pub failure: Option<String>,
}

/// At most so many patterns of an undecided box are listed: there can be 2^n.
const PATTERNS: usize = 64;

impl Summary {
    /// Whether the check shows that something is wrong.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        self.check.refuted
    }

    /// Whether every equilibrium is known, and passed the check.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        self.check.passed && self.decided
    }
}

impl Check {
    /// From the verdict.
    #[must_use]
    pub fn of(verdict: Result<(), CheckError>) -> Self {
        Self {
            passed: verdict.is_ok(),
            refuted: verdict.as_ref().is_err_and(CheckError::refutes),
            failure: verdict.err().map(|error| error.to_string()),
        }
    }
}

impl ChainCensusAnswer {
    /// Put together from a census and the verdict of its check.
    #[must_use]
    pub fn new(problem: &Problem, census: census::Census, verdict: Result<(), CheckError>) -> Self {
        let all = census.positions().map(|position| {
            let equilibrium = census.position_to_model(&position);
            Found::of(problem, equilibrium, &position)
        });
        let equilibria = all.collect();
        Self::with(problem, census, equilibria, verdict)
    }

    /// The same with these equilibria.
    pub(super) fn with(
        problem: &Problem,
        census: census::Census,
        equilibria: Vec<Found>,
        verdict: Result<(), CheckError>,
    ) -> Self {
        let (energy_unit_j, energy_symbol, energy_unit) = energy_unit(problem);
        let topology = census.topology.as_ref();
        Self {
            schema_version: SCHEMA_VERSION,
            system: problem.chain().summary(),
            census: Summary {
                complete: census.complete,
                decided: census.decided(),
                count: equilibria.len(),
                circles: census.circles,
                circle_count: census.circles.then_some(census.equilibria.len()),
                count_by_index: census.count_by_index(),
                alternating_sum: census.alternating_sum(),
                euler_characteristic: topology.ok().map(|topology| topology.euler),
                betti: topology.ok().map(|topology| topology.betti.clone()),
                topology_unknown: topology.err().map(ToString::to_string),
                straight: census.straight.clone(),
                degenerate: census.degenerate.iter().map(merged).collect(),
                undecided_boxes: census.undecided.len(),
                undecided: census.undecided.iter().map(open).collect(),
                slack_families: census.families.iter().map(slack).collect(),
                energy_unit_j,
                energy_unit,
                energy_symbol,
                check: Check::of(verdict),
                statistics: census.statistics,
            },
            equilibria,
            proven: census,
            problem: problem.clone(),
        }
    }
}

/// mgl of one bar where all bars are equal, as in the paper; else weight times length of the whole
/// chain.
fn energy_unit(problem: &Problem) -> (f64, &'static str, &'static str) {
    let chain = problem.chain();
    let bars = chain.bars();
    let equal = bars.windows(2).all(|pair| pair[0] == pair[1]);
    match bars.first() {
        Some(bar) if equal => (
            bar.mass_kg() * chain.gravity_m_s2() * bar.length_m(),
            "mgl",
            "weight times length of one bar",
        ),
        _ => (
            chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m(),
            "MgL",
            "weight times length of the whole chain",
        ),
    }
}

impl Found {
    /// A position and the same as the answer of a solver.
    pub(super) fn of(problem: &Problem, mut equilibrium: Equilibrium, position: &Position) -> Self {
        let proven = &position.equilibrium;
        let statics = judge_chain(problem, &equilibrium);
        equilibrium.evidence.ladder.agreed = Status::Open(Reason::OneSolverOnly {
            solver: SolverName::CENSUS,
            statics: statics.largest(),
        });
        let signed: Vec<f64> =
            proven.angles_rad.iter().map(|angle| signed_deg(angle.mid().to_degrees())).collect();
        Self {
            energy_scaled: equilibrium.energy_j / energy_unit(problem).0,
            equilibrium,
            label: position.label(),
            circle: proven.circle.then_some(position.number),
            mirrored: position.mirrored,
            angles_deg: signed.iter().copied().map(full_turn_deg).collect(),
            angles_signed_deg: signed,
            signs: proven.signs.clone(),
            box_width: proven.width(),
            enclosures: Enclosures::of(proven),
        }
    }
}

/// In (-180, 180].
fn signed_deg(angle: f64) -> f64 {
    if angle > 180.0 {
        angle - 360.0
    } else if angle <= -180.0 {
        angle + 360.0
    } else {
        angle
    }
}

/// In [0, 360).
fn full_turn_deg(signed: f64) -> f64 {
    let turned = if signed < 0.0 { signed + 360.0 } else { signed };
    // A tiny negative angle rounds to the full turn, which is zero.
    if turned >= 360.0 { 0.0 } else { turned }
}

fn ends(interval: Interval) -> Enclosure {
    [interval.lo(), interval.hi()]
}

/// Both ends of both parts, if they are numbers that JSON has.
fn finite(parts: [Interval; 2]) -> Option<[Enclosure; 2]> {
    let parts = parts.map(ends);
    parts.iter().flatten().all(|end| end.is_finite()).then_some(parts)
}

impl Enclosures {
    fn of(proven: &ProvenEquilibrium) -> Self {
        let list = |intervals: &[Interval]| intervals.iter().copied().map(ends).collect();
        let vectors =
            |vectors: &[[Interval; 3]]| vectors.iter().map(|vector| vector.map(ends)).collect();
        Self {
            pull_n: proven.pull_n.map(ends),
            energy_j: ends(proven.energy_j),
            angles_rad: list(&proven.angles_rad),
            joints_m: vectors(&proven.joints_m),
            multipliers_n: vectors(&proven.multipliers_n),
            axial_n: list(&proven.axial_n),
        }
    }
}

fn open(undecided: &Undecided) -> Open {
    Open {
        reason: name(undecided.reason),
        why: undecided.reason.to_string(),
        pattern_count: undecided.signs.len(),
        patterns: undecided.signs.iter().take(PATTERNS).cloned().collect(),
        chart: serde_json::to_value(undecided.chart).unwrap_or_default(),
        at: undecided.at.map(ends),
        pull_n: undecided.pull_n.and_then(finite),
        at_most: undecided.bound.map(|bound| bound.at_most),
        degree: undecided.bound.and_then(|bound| bound.degree),
    }
}

/// The serialised name of a reason.
fn name(reason: census::Reason) -> String {
    let value = serde_json::to_value(reason).ok();
    value.and_then(|name| name.as_str().map(str::to_owned)).unwrap_or_default()
}

fn merged(merged: &DegenerateEquilibrium) -> Merged {
    let list = |intervals: &[Interval]| intervals.iter().copied().map(ends).collect();
    Merged {
        signs: merged.signs.clone(),
        multiplicity: merged.multiplicity,
        degree: merged.degree,
        index_in_plane: merged.index_in_plane,
        index_out_of_plane: merged.index_out_of_plane,
        energy_j: ends(merged.energy_j),
        pull_n: merged.pull_n.map(ends),
        angles_rad: list(&merged.angles_rad),
        joints_m: merged.joints_m.iter().map(|joint| joint.map(ends)).collect(),
        axial_n: list(&merged.axial_n),
    }
}

fn slack(family: &SlackFamily) -> Slack {
    Slack {
        signs: family.signs.clone(),
        energy_j: ends(family.energy_j),
        gap_m: ends(family.gap_m),
        pull_n: family.pull_n.map(ends),
        index_in_plane: family.index_in_plane,
        index_in_space: family.index_in_space(),
        dimension_in_plane: family.dimension_in_plane,
        is_manifold: family.topology.is_ok(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_in_their_ranges() {
        for (angle, signed, full) in [
            (19.5, 19.5, 19.5),
            (-73.9, -73.9, 286.1),
            (190.0, -170.0, 190.0),
            (-180.0, 180.0, 180.0),
        ] {
            assert!((signed_deg(angle) - signed).abs() < 1e-12);
            assert!((full_turn_deg(signed_deg(angle)) - full).abs() < 1e-12);
        }
        assert!(full_turn_deg(-1e-20) < 360.0);
    }
}
