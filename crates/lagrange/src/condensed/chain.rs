//! The chain as arrays, prepared once: what every pass over the bars reads.

use std::ops::Range;

use model::{Chain, Problem, Vector};

use super::bottom::Bottom;
use super::loads::{Arrays, Moments, count_from};
use super::read::Read;
use super::span::Span;

/// Totals between these bounds leave room for cubes and their inverses in a double; others are
/// brought to about 1 by powers of two, which costs no digit.
const COMFORTABLE: Range<f64> = 1e-60..1e60;

/// A chain prepared for its condensed equations.
///
/// The weight of each bar is lumped to its joints by the lever rule, which changes neither the
/// energy nor an equilibrium. What remains of the chain is two numbers per bar: its length $l_i$ and
/// the weight $b_i$ between it and the bottom bar, so that with the force $q$ in the bottom bar
///
/// $$ F_i = q + b_i e_z. $$
///
/// The bottom bar is the one at which two strands hanging straight down from the anchors would meet;
/// it follows from the lengths alone. Counting the weights from there keeps all digits of the small
/// forces at the bottom.
#[derive(Debug, Clone)]
pub struct Condensed {
    /// `l_i`.
    pub(super) lengths: Vec<f64>,
    /// `b_i`: weight of the joints between the bottom bar and bar i, negative before it.
    pub(super) loads: Vec<f64>,
    /// Part of the weight of bar i that its second joint carries.
    pub(super) beyond: Vec<f64>,
    /// Part of the weight of bar 1 that joint 0 carries.
    pub(super) at_start: f64,
    pub(super) total_length: f64,
    pub(super) total_mass: f64,
    pub(super) span: Span,
    pub(super) bottom: Bottom,
    /// Length-weighted mean and standard deviation of the loads.
    pub(super) mean: f64,
    pub(super) deviation: f64,
    /// A shorter chain with the same moments of the loads, block by block; empty for few bars.
    pub(super) coarse: Arrays,
    pub(super) units: Units,
    pub(super) start_m: Vector,
}

/// What one is, in SI units.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    /// m, a power of two.
    pub length: f64,
    /// kg, a power of two.
    pub mass: f64,
    /// m/s².
    pub gravity: f64,
}

impl Units {
    /// N
    pub fn force(self) -> f64 {
        self.mass * self.gravity
    }
}

impl Condensed {
    /// Prepare a chain: one pass over its bars.
    #[must_use]
    pub fn new(problem: &Problem) -> Self {
        let chain = problem.chain();
        let si = Units { length: 1.0, mass: 1.0, gravity: chain.gravity_m_s2() };
        let condensed = Self::with_units(chain, si);
        let (length, mass) = (condensed.total_length, condensed.total_mass);
        if COMFORTABLE.contains(&length) && COMFORTABLE.contains(&mass) {
            return condensed;
        }
        let units = Units { length: power_of_two(length), mass: power_of_two(mass), ..si };
        Self::with_units(chain, units)
    }

    /// Number of bars.
    #[must_use]
    pub fn bars(&self) -> usize {
        self.lengths.len()
    }

    /// Whether the anchors lie on one vertical: their horizontal distance is a rounding error.
    pub(super) fn on_one_vertical(&self) -> bool {
        self.span.across <= f64::EPSILON * self.total_length
    }

    /// Horizontal distance of the anchors, seen along the plane of an equilibrium.
    pub(super) fn across_in(&self, level: [f64; 2]) -> f64 {
        self.span.across * (self.span.level[0] * level[0] + self.span.level[1] * level[1])
    }

    fn with_units(chain: &Chain, units: Units) -> Self {
        let span = Span::new(chain.anchors(), 1.0 / units.length);
        let mut read = Read::new(chain, units);
        let bottom = Bottom::bar(&read.lengths, &read.before, read.total_length, span.rise);
        let mut moments = Moments::new(chain.bars().len());
        count_from(bottom, &read.lengths, &mut read.loads, &mut moments);
        let (mean, deviation) = moments.total(read.total_length);
        Self {
            bottom: Bottom::new(bottom, &read, span.rise),
            lengths: read.lengths,
            loads: read.loads,
            beyond: read.beyond,
            at_start: read.at_start,
            total_length: read.total_length,
            total_mass: read.total_mass,
            span,
            mean,
            deviation,
            coarse: moments.coarse,
            units,
            start_m: chain.anchors().start_m,
        }
    }
}

/// The power of two next to a positive number.
fn power_of_two(number: f64) -> f64 {
    number.log2().round().clamp(-1000.0, 1000.0).exp2()
}
