//! What is known of the list of equilibria, as `funicular census --json` prints it.

use census::net::{ChainCensus, NetCensus, PartCensus, SystemCensus};
use census::{Face, Interval, Reason, SlackFamily, Statistics, StraightPosition, Undecided};
use model::Chain as Bars;
use model::system::System;
use serde::Serialize;

/// The census as a whole.
#[derive(Debug, Clone, Serialize)]
pub struct Summary {
    /// Whether every equilibrium is in `equilibria`, or in a family of slack bars.
    pub complete: bool,
    /// The same; of a row of bars, also whether every other one is upright in a straight position.
    pub decided: bool,
    /// Number of isolated equilibria: the length of `equilibria`, where each is listed with everything; by signs and
    /// pulls a circle is listed once.
    pub count: usize,
    /// Whether equilibria come in circles, all turns about the vertical through the anchors. Of a row of bars both
    /// positions in one plane are listed, of other systems one.
    pub circles: bool,
    /// How many boxes could not be decided.
    pub undecided_boxes: usize,
    /// How many families of equilibria there are with slack bars.
    pub slack_families: usize,
    /// What `energy_scaled` is a multiple of: of a row of bars.
    #[serde(flatten)]
    pub unit: Option<EnergyUnit>,
    /// The parts that move without each other, each with the sets of its members that may be slack.
    pub parts: Vec<Part>,
    /// Wall-clock time, s.
    pub seconds: f64,
}

/// What energies are multiples of.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct EnergyUnit {
    /// Its value.
    pub energy_unit_j: f64,
    /// What that is, in words.
    pub energy_unit: &'static str,
    /// Its symbol.
    pub energy_symbol: &'static str,
}

/// One part.
#[derive(Debug, Clone, Serialize)]
pub struct Part {
    /// Its isolated equilibria, whatever the lengths of slack members are.
    pub count: usize,
    /// Numbers of the members that are slack, from 1.
    pub slack: Vec<usize>,
    /// Numbers of the members in trees, from 1.
    pub hanging: Vec<usize>,
    /// The chain between anchors that bears the trees.
    pub chain: Option<Chain>,
    /// Joints placed by closed forms.
    pub framed: usize,
    /// The net of several closures that bears the trees.
    pub net: Option<Net>,
}

/// The net of a part.
#[derive(Debug, Clone, Serialize)]
pub struct Net {
    /// Members less joints that move.
    pub closures: usize,
    /// Joints whose places were searched.
    pub knots: Vec<String>,
    /// Joints that follow from their two neighbours.
    pub swings: Vec<String>,
    /// Whether only equilibria in the vertical plane of the anchors were looked for.
    pub in_plane: bool,
    /// Boxes of places looked at.
    pub cells: u64,
    /// Tests of them.
    pub tests: u64,
    /// How many could not be decided.
    pub undecided_boxes: usize,
}

/// The chain of a part, which may be the whole system. Bars and joints are in its order, joint 0 is its first anchor.
#[derive(Debug, Clone, Serialize)]
pub struct Chain {
    /// Its joints from anchor to anchor.
    pub joints: Vec<String>,
    /// Whether every equilibrium is isolated, or in a slack family.
    pub complete: bool,
    /// Whether every equilibrium is isolated, in `slack_families`, or upright in
    /// `straight`.
    pub decided: bool,
    /// Number of isolated equilibria in one vertical plane, both images of each circle.
    pub count_in_plane: usize,
    /// Number of circles; `None` if the anchors are not on one vertical.
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
    /// The boxes that could not be decided.
    pub undecided: Vec<Open>,
    /// Sets of equilibria with bars that carry nothing.
    pub slack_families: Vec<Slack>,
    /// The list judged again, without the search.
    pub check: Check,
    /// What it took.
    pub statistics: Statistics,
}

/// What could not be decided.
#[derive(Debug, Clone, Serialize)]
pub struct Open {
    /// Name of the reason.
    pub reason: Reason,
    /// The reason in words.
    pub why: String,
    /// How many patterns of tension and compression are in question.
    pub pattern_count: usize,
    /// The first of them.
    pub patterns: Vec<Vec<i8>>,
    /// The face of the half cube of pulls where the box is.
    pub chart: Face,
    /// The box in the coordinates of that face.
    pub at: [Interval; 2],
    /// The pulls in it, if they are bounded.
    pub pull_n: Option<[Interval; 2]>,
}

/// A set of equilibria with bars that carry nothing.
#[derive(Debug, Clone, Serialize)]
pub struct Slack {
    /// +1 for each bar in tension, -1 in compression, 0 for a slack one.
    pub signs: Vec<i8>,
    /// Energy above the height of joint 0.
    pub energy_j: Interval,
    /// The gap that the slack bars bridge.
    pub gap_m: Interval,
    /// Pull of the chain on the first anchor, level and upright.
    pub pull_n: [Interval; 2],
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
    /// Of so many equilibria that are listed.
    pub(super) fn of(system: &System, census: &SystemCensus, count: usize) -> Self {
        let row = census.row(system);
        let circles = || census.equilibria.iter().any(|position| position.circle);
        Self {
            complete: census.complete,
            decided: row.map_or(census.complete, |chain| chain.census.decided()),
            count,
            circles: row.map_or_else(circles, |chain| chain.census.circles),
            undecided_boxes: census.undecided(),
            slack_families: census.families(),
            unit: row.and(system.as_row()).map(|row| EnergyUnit::of(row.problem().chain())),
            parts: census.parts.iter().map(|part| Part::of(system, part)).collect(),
            seconds: census.seconds,
        }
    }

    /// The chains of all parts.
    pub fn chains(&self) -> impl Iterator<Item = &Chain> {
        self.parts.iter().filter_map(|part| part.chain.as_ref())
    }

    /// Whether the check shows that something is wrong.
    pub fn check_failed(&self) -> bool {
        self.chains().any(|chain| chain.check.refuted)
    }

    /// Whether every equilibrium is known, and passed the check.
    pub fn is_decided(&self) -> bool {
        self.decided && self.chains().all(|chain| chain.check.passed)
    }
}

impl EnergyUnit {
    /// mgl of one bar where all bars are equal, as in the paper; else weight times length of the
    /// whole chain.
    pub(super) fn of(chain: &Bars) -> Self {
        let bars = chain.bars();
        let equal = bars.windows(2).all(|pair| pair[0] == pair[1]);
        let g = chain.gravity_m_s2();
        match bars.first() {
            Some(bar) if equal => Self {
                energy_unit_j: bar.mass_kg() * g * bar.length_m(),
                energy_unit: "weight times length of one bar",
                energy_symbol: "mgl",
            },
            _ => Self {
                energy_unit_j: chain.total_mass_kg() * g * chain.total_length_m(),
                energy_unit: "weight times length of the whole chain",
                energy_symbol: "MgL",
            },
        }
    }
}

/// From 1.
fn numbers(members: &[usize]) -> Vec<usize> {
    members.iter().map(|member| member + 1).collect()
}

fn names(system: &System, joints: &[usize]) -> Vec<String> {
    joints.iter().map(|joint| system.joints()[*joint].name.to_string()).collect()
}

impl Part {
    fn of(system: &System, part: &PartCensus) -> Self {
        Self {
            count: part.positions,
            slack: numbers(&part.slack),
            hanging: numbers(&part.hanging),
            chain: part.chain.as_ref().map(|chain| Chain::of(system, chain)),
            framed: part.framed,
            net: part.net.as_ref().map(|net| Net::of(system, net)),
        }
    }
}

impl Net {
    fn of(system: &System, net: &NetCensus) -> Self {
        Self {
            closures: net.closures,
            knots: names(system, &net.knots),
            swings: names(system, &net.swings),
            in_plane: net.in_plane,
            cells: net.cells,
            tests: net.tests,
            undecided_boxes: net.undecided.len(),
        }
    }
}

impl Chain {
    fn of(system: &System, chain: &ChainCensus) -> Self {
        let census = &chain.census;
        let topology = census.topology.as_ref();
        Self {
            joints: names(system, &chain.joints),
            complete: census.complete,
            decided: census.decided(),
            count_in_plane: census.count_in_plane(),
            circle_count: census.circles.then_some(census.equilibria.len()),
            count_by_index: census.count_by_index(),
            alternating_sum: census.alternating_sum(),
            euler_characteristic: topology.ok().map(|topology| topology.euler),
            betti: topology.ok().map(|topology| topology.betti.clone()),
            topology_unknown: topology.err().map(ToString::to_string),
            straight: census.straight.clone(),
            undecided: census.undecided.iter().map(open).collect(),
            slack_families: census.families.iter().map(slack).collect(),
            check: Check {
                passed: chain.check.is_ok(),
                refuted: chain.refuted,
                failure: chain.check.as_ref().err().cloned(),
            },
            statistics: census.statistics,
        }
    }
}

/// Whether its ends are numbers that JSON has.
fn is_finite(part: &Interval) -> bool {
    part.mag().is_finite()
}

fn open(undecided: &Undecided) -> Open {
    Open {
        reason: undecided.reason,
        why: undecided.reason.to_string(),
        pattern_count: undecided.signs.len(),
        patterns: undecided.signs.iter().take(PATTERNS).cloned().collect(),
        chart: undecided.chart,
        at: undecided.at,
        pull_n: undecided.pull_n.filter(|parts| parts.iter().all(is_finite)),
    }
}

fn slack(family: &SlackFamily) -> Slack {
    Slack {
        signs: family.signs.clone(),
        energy_j: family.energy_j,
        gap_m: family.gap_m,
        pull_n: family.pull_n,
        index_in_plane: family.index_in_plane,
        index_in_space: family.index_in_space(),
        dimension_in_plane: family.dimension_in_plane,
        is_manifold: family.topology.is_ok(),
    }
}
