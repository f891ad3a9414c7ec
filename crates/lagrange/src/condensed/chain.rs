//! The chain as arrays, prepared once: what every pass over the bars reads.

use std::num::NonZeroUsize;
use std::ops::Range;

use model::{Chain, Problem, Vector};

use super::bottom::Bottom;
use super::loads::{Moments, count_from};
use super::read::Read;
use super::span::Span;
use super::team::Team;
use super::units::Units;

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
    /// Lengths, loads and totals, in units of the chain. The loads are counted from the bottom bar:
    /// `b_i`, negative before it.
    pub(super) read: Read,
    /// Moments of the loads.
    pub(super) moments: Moments,
    pub(super) span: Span,
    pub(super) bottom: Bottom,
    pub(super) units: Units,
    pub(super) start_m: Vector,
    processors: NonZeroUsize,
}

impl Condensed {
    /// Prepare a chain: one pass over its bars.
    #[must_use]
    pub fn new(problem: &Problem) -> Self {
        Self::with_processors(problem, NonZeroUsize::MIN)
    }

    /// Prepare a chain, and let so many processors share this and all other work on it. Each wants some
    /// 65,000 bars, or it is not asked. The bits of all results are the same for any number of them.
    ///
    /// ```
    /// use lagrange::condensed::Condensed;
    /// let two = std::num::NonZeroUsize::MIN.saturating_add(1);
    /// assert_eq!(Condensed::with_processors(&model::cases::paper(), two).bars(), 3);
    /// ```
    #[must_use]
    pub fn with_processors(problem: &Problem, processors: NonZeroUsize) -> Self {
        Self::prepare(problem, processors, Read::default(), Moments::default())
    }

    /// Prepare another chain in the memory of this one: for a million bars, fresh memory costs more than
    /// all computing.
    #[must_use]
    pub fn again(self, problem: &Problem) -> Self {
        Self::prepare(problem, self.processors, self.read, self.moments)
    }

    fn prepare(
        problem: &Problem,
        processors: NonZeroUsize,
        mut read: Read,
        moments: Moments,
    ) -> Self {
        let chain = problem.chain();
        let team = Team::new(processors, chain.bars().len());
        let si = Units { length: 1.0, mass: 1.0, gravity: chain.gravity_m_s2() };
        read.read(chain, si, team);
        let (length, mass) = (read.total_length, read.total_mass);
        if COMFORTABLE.contains(&length) && COMFORTABLE.contains(&mass) {
            return Self::with_units(chain, si, processors, read, moments);
        }
        let units = Units { length: power_of_two(length), mass: power_of_two(mass), ..si };
        read.read(chain, units, team);
        Self::with_units(chain, units, processors, read, moments)
    }

    /// Number of bars.
    #[must_use]
    pub fn bars(&self) -> usize {
        self.read.lengths.len()
    }

    /// The processors that this chain keeps busy.
    pub(super) fn team(&self) -> Team {
        Team::new(self.processors, self.bars())
    }

    /// Whether the anchors lie on one vertical: their horizontal distance is a rounding error.
    pub(super) fn on_one_vertical(&self) -> bool {
        self.span.across <= f64::EPSILON * self.read.total_length
    }

    /// Horizontal distance of the anchors, seen along the plane of an equilibrium.
    pub(super) fn across_in(&self, level: [f64; 2]) -> f64 {
        self.span.across * (self.span.level[0] * level[0] + self.span.level[1] * level[1])
    }

    fn with_units(
        chain: &Chain,
        units: Units,
        processors: NonZeroUsize,
        mut read: Read,
        mut moments: Moments,
    ) -> Self {
        let team = Team::new(processors, chain.bars().len());
        let span = Span::new(chain.anchors(), 1.0 / units.length);
        let bottom = Bottom::bar(&read, span.rise);
        moments.clear(chain.bars().len());
        count_from(bottom, &read.lengths, &mut read.loads, &mut moments, team);
        let bottom = Bottom::new(bottom, &read, span.rise);
        let start_m = chain.anchors().start_m;
        Self { read, moments, span, bottom, units, start_m, processors }
    }
}

/// The power of two next to a positive number.
fn power_of_two(number: f64) -> f64 {
    number.log2().round().clamp(-1000.0, 1000.0).exp2()
}
