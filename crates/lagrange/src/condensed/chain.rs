//! The chain as arrays, prepared once: what every pass over the bars reads.

use std::num::NonZeroUsize;
use std::ops::Range;

use model::{Problem, Vector};

use super::bar_data::BarData;
use super::bottom::Bottom;
use super::kernel::Bars;
use super::loads::{Moments, count_from};
use super::parallel::Workers;
use super::span::Span;
use super::system::{Frame, System};
use super::units::Units;

/// Totals between these bounds leave room for cubes and their inverses in a double; others are
/// brought to about 1 by powers of two, which costs no digit.
const COMFORTABLE: Range<f64> = 1e-60..1e60;

/// A chain prepared for its condensed equations.
///
/// The weight of each bar is lumped to its joints by the lever rule, which changes neither the
/// energy nor an equilibrium. What remains of the chain is two numbers per bar: its length $l_i$
/// and the weight $b_i$ between it and the bottom bar, so that with the force $q$ in the bottom bar
///
/// $$ F_i = q + b_i e_z. $$
///
/// The bottom bar is the one at which two strands hanging straight down from the anchors would
/// meet; it follows from the lengths alone. Counting the weights from there keeps all digits of the
/// small forces at the bottom.
///
/// ```
/// use lagrange::condensed::{Condensed, Settings};
/// let chain = Condensed::new(&model::cases::paper());
/// // The chain carries 2.3129 of its three weights on the first anchor.
/// let ground_n = chain.pull(&Settings::default())?.ground_n();
/// assert!((ground_n[2] / 9.80665 - 2.312944292241838).abs() < 1e-14);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Condensed {
    /// Lengths, loads and totals, in units of the chain. The loads are counted from the bottom bar:
    /// `b_i`, negative before it.
    pub(super) bars: BarData,
    /// Moments of the loads.
    pub(super) moments: Moments,
    pub(super) span: Span,
    pub(super) bottom: Bottom,
    pub(super) units: Units,
    pub(super) start_m: Vector,
    /// Whether the anchors lie on one vertical, to rounding.
    pub(super) on_one_vertical: bool,
    processors: NonZeroUsize,
}

impl Condensed {
    /// Prepare a chain: one pass over its bars.
    pub fn new(problem: &Problem) -> Self {
        Self::with_processors(problem, NonZeroUsize::MIN)
    }

    /// Prepare a chain, and let so many processors share this and all other work on it. Each wants
    /// some 65,000 bars, or it is not asked. The bits of all results are the same for any number of
    /// them.
    pub(super) fn with_processors(problem: &Problem, processors: NonZeroUsize) -> Self {
        Self::prepare(problem, processors, BarData::default(), Moments::default())
    }

    /// Prepare another chain in the memory of this one: for a million bars, fresh memory costs more
    /// than all computing.
    pub(super) fn again(self, problem: &Problem) -> Self {
        Self::prepare(problem, self.processors, self.bars, self.moments)
    }

    fn prepare(
        problem: &Problem,
        processors: NonZeroUsize,
        mut bars: BarData,
        mut moments: Moments,
    ) -> Self {
        let chain = problem.chain();
        let workers = Workers::new(processors, chain.bars().len());
        let mut units = Units { length: 1.0, mass: 1.0, gravity: chain.gravity_m_s2() };
        bars.read(chain, units, workers);
        let (length, mass) = (bars.total_length, bars.total_mass);
        if !(COMFORTABLE.contains(&length) && COMFORTABLE.contains(&mass)) {
            units = Units { length: power_of_two(length), mass: power_of_two(mass), ..units };
            bars.read(chain, units, workers);
        }
        let span = Span::new(chain.anchors(), 1.0 / units.length);
        let bottom = Bottom::bar(&bars, span.rise);
        moments.clear(chain.bars().len());
        count_from(bottom, &bars.lengths, &mut bars.loads, &mut moments, workers);
        let bottom = Bottom::new(bottom, &bars, span.rise);
        let (start_m, on_one_vertical) = (chain.anchors().start_m, chain.anchors_on_one_vertical());
        Self { bars, moments, span, bottom, units, start_m, on_one_vertical, processors }
    }

    pub(super) fn bars(&self) -> usize {
        self.bars.lengths.len()
    }

    /// The processors that this chain keeps busy.
    pub(super) fn workers(&self) -> Workers {
        Workers::new(self.processors, self.bars())
    }

    /// Horizontal distance of the anchors, seen along the plane of an equilibrium.
    pub(super) fn across_in(&self, level: [f64; 2]) -> f64 {
        self.span.across * (self.span.level[0] * level[0] + self.span.level[1] * level[1])
    }

    /// The largest load, in absolute value: that of the first bar or of the last.
    pub(super) fn largest_load(&self) -> f64 {
        self.bars.loads[0].abs().max(self.bars.loads[self.bars.loads.len() - 1].abs())
    }

    pub(super) fn all(&self) -> [Bars<'_>; 2] {
        [Bars { lengths: &self.bars.lengths, loads: &self.bars.loads }, Bars::NONE]
    }

    /// The bars of both strands, without those at the bottom.
    pub(super) fn around_the_bottom(&self) -> [Bars<'_>; 2] {
        let group = &self.bottom.group;
        let [all, _] = self.all();
        [all.chunk(0..group.start), all.chunk(group.end..self.bars())]
    }

    /// All bars, in two parts.
    pub(super) fn split(&self, at: usize) -> [Bars<'_>; 2] {
        let [all, _] = self.all();
        [all.chunk(0..at), all.chunk(at..self.bars())]
    }

    /// The condensed equations in upright axes, with an effective bar of the length `strut` in
    /// compression.
    pub(super) fn upright<'a>(&self, parts: [Bars<'a>; 2], strut: f64) -> System<'a> {
        let frame = Frame::Upright { across: self.span.across, rise: self.span.rise };
        let (total_length, workers) = (self.bars.total_length, self.workers());
        System { parts, strut, frame, total_length, workers }
    }
}

/// The power of two next to a positive number.
fn power_of_two(number: f64) -> f64 {
    number.log2().round().clamp(-1000.0, 1000.0).exp2()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_powers_of_two_within_the_range_of_a_double() {
        let exact = |number: f64, wanted: i32| {
            assert!((power_of_two(number) / 2.0_f64.powi(wanted) - 1.0).abs() <= 0.0, "{number}");
        };
        for (number, wanted) in
            [(1.0, 0), (3.0, 2), (2.8, 1), (0.3, -2), (1e-305, -1000), (1e305, 1000)]
        {
            exact(number, wanted);
        }
    }
}
