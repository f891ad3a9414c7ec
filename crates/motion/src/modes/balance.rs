//! What loads and members leave over at the joints of an equilibrium.

use model::Vector;

use crate::error::{MotionError, Result};
use crate::mechanism::{Link, Mechanism};
use crate::state::State;
use crate::unilateral::BALANCE;
use numerics::vector::{add_times, dot, norm, plus, times, worse};

/// What loads and members leave over, by slot: what supports bear, and what is out of balance.
pub(crate) struct LeftOver {
    /// N.
    pub forces: Vec<Vector>,
    /// The largest force in the system, N.
    pub unit_n: f64,
    /// What the rounding of coordinates in the world frame leaves of the forces of springs at a joint, N.
    rounding_n: f64,
}

/// Roundings of the coordinates of a joint: of both ends of the springs that meet there.
const ROUNDINGS: f64 = 8.0;

impl LeftOver {
    pub(super) fn new(
        mechanism: &Mechanism,
        state: &State,
        vectors: &[Vector],
        densities: &[f64],
    ) -> Self {
        let mut forces = mechanism.load.clone();
        let mut unit_n = forces.iter().map(|f| norm(*f)).fold(0.0, worse);
        let rigid = mechanism.bars.iter().zip(densities).flat_map(|(bar, rho)| {
            let spans = mechanism.of(&bar.spans).iter().zip(&vectors[bar.spans.clone()]);
            spans.map(|(span, d)| (span, times(*rho, *d)))
        });
        let springs = mechanism.springs.iter().flat_map(|spring| {
            let spans = mechanism.of(&spring.spans);
            let length_m = state.length_m(spans);
            let pull = move |span: &Link| spring.pull(length_m, state.between(span.a, span.b));
            spans.iter().map(move |span| (span, pull(span)))
        });
        for (link, pull) in rigid.chain(springs) {
            forces[link.a] = plus(forces[link.a], pull);
            forces[link.b] = add_times(forces[link.b], -1.0, pull);
            unit_n = worse(unit_n, norm(pull));
        }
        let far_m = mechanism.reference_m.iter().fold(0.0, |most, x| worse(most, x.abs()));
        let stiffness = mechanism.springs.iter().map(|spring| spring.stiffness_n / spring.length_m);
        let stiffest_n_m = stiffness.fold(0.0, worse);
        let rounding_n = ROUNDINGS * f64::EPSILON * far_m * stiffest_n_m;
        Self { forces, unit_n, rounding_n }
    }

    /// Largest force that no support bears, relative to the largest force.
    /// [`MotionError::NotInBalance`] where it is more than rounding.
    pub(super) fn off(&self, mechanism: &Mechanism) -> Result<f64> {
        let mut left = self.forces.clone();
        for slide in &mechanism.slides {
            let f = left[slide.slot];
            left[slide.slot] = add_times(f, -dot(f, slide.normal), slide.normal);
        }
        let sizes = left[..mechanism.moving].iter().map(|f| norm(*f));
        let (slot, off) = sizes.enumerate().fold((0, 0.0_f64), |most, (slot, size)| {
            if size.is_nan() || size > most.1 { (slot, size) } else { most }
        });
        let rounded = off <= self.rounding_n;
        let off = if self.unit_n > 0.0 { off / self.unit_n } else { off };
        if off.is_nan() || (off > BALANCE && !rounded) {
            return Err(MotionError::NotInBalance { joint: mechanism.name(slot), off });
        }
        Ok(off)
    }
}
