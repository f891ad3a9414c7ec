//! Section VIII closed: all equilibria of the paper's example, with proof, and (x) none of them.
//!
//! The census lists them and proves that there is no other. Others confirm it here: exact root
//! counting on the sextic, the topology of the closure curve, `lagrange` and the statics judge.
//! What the paper prints as its second position is refuted without any equilibrium at all: over the
//! whole box of positions whose angles round to the printed ones, the energy has a slope.

use census::{Census, Interval};
use model::Chain;
use serde::Serialize;
use validate::census_checks::{placed, statics, visits};
use validate::tolerances::Tolerances;

use crate::example::Example;
use crate::printed::{Paper, Printed};
use crate::slope::{degrees, radians, slope};

/// How many equilibria the example has, and why there are no others.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Completeness {
    /// Whether the census proves that there is no other equilibrium.
    pub complete: bool,
    /// Equilibria in the plane of the paper.
    pub planar: usize,
    /// Circles of equilibria in space, by turns about the vertical through both anchors.
    pub circles: usize,
    /// Equilibria in the plane by the number of directions in which the energy falls.
    pub by_index: Vec<i64>,
    /// Σ (−1)^index over the equilibria in the plane.
    pub alternating_sum: i64,
    /// The Euler characteristic of the closure curve from the lengths alone.
    pub euler: Option<i64>,
    /// Real roots of the sextic in cos θ between −1 and 1, counted exactly by Sturm's theorem; each
    /// stands for an equilibrium and its mirror image.
    pub sextic_roots: Option<usize>,
    /// Patterns of tension and compression that the census goes through.
    pub patterns: u64,
    /// Cells of pulls that it needs.
    pub cells: u64,
    /// The largest relative width of an enclosure.
    pub width: f64,
    /// How far outside of its boxes `lagrange` ends, started within them; in units of the total
    /// length, the worst of all equilibria.
    pub lagrange: f64,
    /// The largest violation of Newton's laws by the middles of the boxes.
    pub statics: f64,
    /// The paper's first position: a grid point next to E1.
    pub first: PrintedPosition,
    /// The paper's second position.
    pub second: PrintedPosition,
    /// Time of the census, s.
    pub seconds: f64,
}

/// A position printed by the paper, as the box of all positions whose angles round to the printed
/// ones.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PrintedPosition {
    /// Enclosure of dV/dθ along the closure curve over this box, mgl/rad.
    pub slope_mgl: [f64; 2],
    /// The nearest equilibrium of the four: the largest difference of an angle is at least that,
    /// deg.
    pub nearest_deg: f64,
}

impl PrintedPosition {
    /// Whether no position in the box is an equilibrium: the energy has a slope all over it.
    pub fn is_refuted(&self) -> bool {
        self.least_slope_mgl() > 0.0
    }

    /// The least size of the slope in the box, mgl/rad; 0 if it may vanish.
    pub fn least_slope_mgl(&self) -> f64 {
        let [low, high] = self.slope_mgl;
        if low > 0.0 {
            low
        } else if high < 0.0 {
            -high
        } else {
            0.0
        }
    }

    fn new(paper: &Paper, position: &str, chain: &Chain, census: &Census) -> Self {
        let printed: [Interval; 3] = ["theta", "alpha", "beta"].map(|angle| {
            paper.claim(&format!("{position}-{angle}")).map_or(Interval::LINE, enclosed)
        });
        let slope = slope(chain, printed.map(radians)).unwrap_or(Interval::LINE);
        let nearest_deg = census
            .equilibria
            .iter()
            .flat_map(|equilibrium| [(equilibrium, 1.0), (equilibrium, -1.0)])
            .map(|(equilibrium, side)| {
                let angles = equilibrium.angles_rad.iter().zip(printed);
                angles.map(|(angle, printed)| apart(*angle, printed, side)).fold(0.0, f64::max)
            })
            .fold(f64::INFINITY, f64::min);
        Self { slope_mgl: [slope.lo(), slope.hi()], nearest_deg }
    }
}

/// All angles that round to a printed one, deg, between −180 and 180.
fn enclosed(printed: &Printed) -> Interval {
    let Some(digits) = printed.digits else { return Interval::LINE };
    let place = (0..digits).fold(Interval::ONE, |part, _| part / Interval::point(10.0));
    let half = Interval::new(-0.5, 0.5) * place;
    // The decimal fraction is read to half a unit in the last place.
    let value = Interval::around(printed.value(), printed.value() * f64::EPSILON) + half;
    if printed.value() > 180.0 { value - Interval::point(360.0) } else { value }
}

/// At least the angle between an equilibrium's bar, mirrored or not, and a printed one, deg.
fn apart(angle_rad: Interval, printed_deg: Interval, side: f64) -> f64 {
    let difference = degrees(angle_rad) * Interval::point(side) - printed_deg;
    [-360.0, 0.0, 360.0]
        .into_iter()
        .map(|turn| (difference + Interval::point(turn)).mig())
        .fold(f64::INFINITY, f64::min)
}

impl Completeness {
    /// Hold the census of the example against all that does not need it.
    pub fn new(paper: &Paper, example: &Example) -> Self {
        let (problem, census) = (&example.problem, &example.census);
        let chain = problem.chain();
        let lagrange = visits(problem, census).map_or(f64::NAN, |visits| {
            let judged = visits.iter().map(|visit| {
                let stayed = visit.ended.number == visit.number && visit.same_stability;
                if stayed { visit.ended.beyond } else { f64::NAN }
            });
            judged.fold(0.0, |most: f64, off| if most.is_nan() || off <= most { most } else { off })
        });
        Self {
            complete: census.complete,
            planar: census.count_in_plane(),
            circles: if census.circles { census.equilibria.len() } else { 0 },
            by_index: census.count_by_index(),
            alternating_sum: census.alternating_sum(),
            euler: census.topology.as_ref().ok().map(|topology| topology.euler),
            sextic_roots: census::sextic::count_roots(&census::sextic::SEXTIC, -1, 1),
            patterns: census.patterns(),
            cells: census.statistics.cells,
            width: census
                .equilibria
                .iter()
                .map(census::ProvenEquilibrium::width)
                .fold(0.0, f64::max),
            lagrange,
            statics: statics(problem, census),
            first: PrintedPosition::new(paper, "ix", chain, census),
            second: PrintedPosition::new(paper, "x", chain, census),
            seconds: census.statistics.seconds,
        }
    }

    /// Whether the list is proved complete, all that does not need it confirms it, and (x) is
    /// proved not to be on it.
    pub fn is_closed(&self) -> bool {
        self.confirms_the_list(&Tolerances::project())
            && self.second.is_refuted()
            && self.second.nearest_deg > 0.0
    }

    /// The numbers of equilibria in the plane by index, in words.
    pub fn indices(&self) -> String {
        let some = self.by_index.iter().enumerate().filter(|(_, count)| **count != 0);
        let words: Vec<String> =
            some.map(|(index, count)| format!("{count} of index {index}")).collect();
        words.join(", ")
    }

    /// Whether the list is proved complete, and all that does not need it confirms it.
    pub fn confirms_the_list(&self, tolerances: &Tolerances) -> bool {
        self.complete
            && self.euler == Some(self.alternating_sum)
            && self.sextic_roots.is_some_and(|roots| 2 * roots == self.planar)
            && self.lagrange <= placed(model::cases::paper().chain())
            && self.statics <= tolerances.statics
    }
}
