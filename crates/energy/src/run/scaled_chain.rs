//! The chain in its own units: what the minimiser sees.

use model::{Problem, Sum, Vector};

use crate::lever;
use crate::run::frame::{Frame, WORLD_UP};
use crate::run::regime::{Reach, Turning};
use crate::run::settings::Motion;
use crate::vector::{along, dot, norm};

/// A chain with a total length from 1 to 2 and total weight 1, in its own frame.
///
/// The energy is linear in the directions `u_i` of the bars. Bar *i* lifts all bars after it and a
/// part `r_i / l_i` of itself, so that
///
/// $$V = \sum_i c_i\\, \hat z \cdot u_i, \qquad c_i = g \Bigl(l_i \sum_{j>i} m_j + m_i r_i\Bigr).$$
///
/// With the closure $\sum l_i u_i = D$ the same multiple of $l_i$ may be taken off every $c_i$;
/// half the weight is taken, so that `h_i = c_i / l_i - 1/2` lies between -1/2 and 1/2, keeps its
/// digits and turns into its negative when the chain is read from its other end.
#[derive(Debug, Clone)]
pub(crate) struct ScaledChain {
    /// Lengths `l_i`; their sum is from 1 to 2. The unit is a power of two, so that all digits of
    /// the lengths are there: a nearly taut chain depends on the last of them.
    pub(crate) length: Vec<f64>,
    /// Weight hanging on each bar less one half, `h_i`; never increasing along the chain.
    pub(crate) carried: Vec<f64>,
    /// The end anchor seen from the start anchor, `D`, as a sum to twice the digits; no component
    /// along the second axis.
    pub(crate) span: [Vector; 2],
    /// World up; no component along the second axis.
    pub(crate) up: Vector,
    /// Whether the anchors lie on one vertical.
    pub(crate) vertical: bool,
    /// The motions considered.
    pub(crate) motion: Motion,
}

/// The units and the frame that lead back to the world.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Units {
    /// Unit of length, m: the power of two below the total length.
    pub(crate) length_m: f64,
    /// Unit of force: the total weight, N.
    pub(crate) weight_n: f64,
    pub(crate) frame: Frame,
    /// From where the weights are counted, if not from the middle.
    pub(crate) origin: Option<Origin>,
}

/// A bar from which the weights are counted: its own `h` is zero.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Origin {
    /// Its index, from 0.
    pub(crate) bar: usize,
    /// What it carries less one half, in units of the total weight.
    pub(crate) carried: f64,
}

impl Units {
    /// What to add to the energy `sum l_i h_i up . u_i` of a closed chain to measure it from the
    /// height of joint 0 rather than from half way between the anchors (or from where the origin
    /// has it).
    pub(crate) fn datum(&self, links: &ScaledChain) -> f64 {
        (0.5 + self.origin.map_or(0.0, |origin| origin.carried)) * dot(links.up, links.span[0])
    }
}

impl ScaledChain {
    pub(crate) fn new(problem: &Problem, motion: Motion) -> (Self, Units) {
        let chain = problem.chain();
        let total_m = chain.total_length_m();
        // By the bits of the exponent, which are those of infinity: the logarithm rounds to the next power where it is just
        // below that.
        let length_m = f64::from_bits(total_m.to_bits() & f64::INFINITY.to_bits());
        let mass_kg = chain.total_mass_kg();
        let weight_n = mass_kg * chain.gravity_m_s2();
        let difference_m = chain.anchors().difference_m();
        let bars = chain.bars();
        let span_m = chain.anchors().span_m();
        let longest_m = bars.iter().fold(0.0_f64, |m, bar| m.max(bar.length_m()));
        let reach = Reach::of(total_m, span_m, longest_m);
        let frame = Frame::new(chain, reach);
        let length = bars.iter().map(|bar| bar.length_m() / length_m).collect();
        // Twice h_i: what hangs after bar i less what hangs before it.
        let mut carried = vec![0.0; bars.len()];
        let mut before = Sum::default();
        for (h, bar) in carried.iter_mut().zip(bars) {
            let (m, at_last) = (bar.mass_kg() / mass_kg, lever::at_last(bar));
            *h -= before.value() + m * (1.0 - at_last);
            before.add(m);
        }
        let mut after = Sum::default();
        for (h, bar) in carried.iter_mut().zip(bars).rev() {
            let (m, at_last) = (bar.mass_kg() / mass_kg, lever::at_last(bar));
            *h = 0.5 * (*h + (after.value() + m * at_last));
            after.add(m);
        }
        let difference = difference_m.map(|x| x / length_m);
        let vertical = chain.anchors_on_one_vertical();
        let span = frame.span(difference);
        let mut up = frame.into_frame(WORLD_UP);
        // Zero by the choice of the frame; rounding must not push a plane chain out of its plane.
        up[1] = 0.0;
        (
            Self { length, carried, span, up, vertical, motion },
            Units { length_m, weight_n, frame, origin: None },
        )
    }

    pub(crate) fn bars(&self) -> usize {
        self.length.len()
    }

    /// What the bars can spare before they lie on one line: drawn out along the span, or the
    /// longest against all others.
    pub(crate) fn spare(&self) -> f64 {
        let [span, rest] = self.span;
        let span = norm(std::array::from_fn(|k| span[k] + rest[k]));
        let longest = self.length.iter().fold(0.0_f64, |most, l| most.max(*l));
        let others = self.total() - longest;
        (self.total() - span).min(others - longest + span)
    }

    pub(crate) fn total(&self) -> f64 {
        let mut total = Sum::default();
        self.length.iter().for_each(|l| total.add(*l));
        total.value()
    }

    /// The level axis in the plane of the anchors: `up` turned down into the first axis. It is the vector
    /// product of the second axis with `up`.
    pub(crate) fn level(&self) -> Vector {
        [self.up[2], 0.0, -self.up[0]]
    }

    /// Whether the turn of the whole chain about its anchors is a motion that costs nothing.
    pub(crate) fn turns(&self) -> bool {
        Turning::of(self) == Turning::Free
    }

    /// Gradient of the Lagrangian by the direction of bar `i`, over its length: `h_i up + mu`.
    pub(crate) fn load(&self, i: usize, multiplier: Vector) -> Vector {
        along(multiplier, self.carried[i], self.up)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bars_can_spare_what_keeps_them_off_one_line() {
        let links = |length: Vec<f64>, span: [Vector; 2]| ScaledChain {
            carried: vec![0.0; length.len()],
            length,
            span,
            up: WORLD_UP,
            vertical: false,
            motion: Motion::Plane,
        };
        // 1.5 long over 1.25: a quarter. Folded over a bar of one, the others 0.5: 0.5 + 0.75 - 1.
        let drawn_out = links(vec![0.5; 3], [[0.5, 0.0, 1.0], [0.25, 0.0, 0.0]]);
        assert!((drawn_out.spare() - 0.25).abs() < 1e-15);
        let folded = links(vec![0.25, 1.0, 0.25], [[0.45, 0.0, -0.6], [0.0; 3]]);
        assert!((folded.spare() - 0.25).abs() < 1e-15);
    }
}
