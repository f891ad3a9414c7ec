//! Forces that depend on places and time, and the potential energy.

use model::Vector;
use model::system::Kind;

use crate::mechanism::{Mechanism, Spring};
use crate::state::State;
use numerics::vector::{add_times, cross, dot, minus, norm, plus, times};

/// A force at a joint as a function of time, N.
pub type ForceOfTime = Box<dyn Fn(f64) -> Vector + Send + Sync>;

/// Forces on the slots and moments on the members as functions of time.
#[derive(Default)]
pub(crate) struct Forces {
    /// Slot and force.
    pub of_time: Vec<(usize, ForceOfTime)>,
    pub moments: Vec<MomentOfTime>,
}

/// A moment on a member, N m.
pub(crate) struct MomentOfTime {
    /// Slots of its ends.
    pub a: usize,
    pub b: usize,
    /// Its number.
    pub member: usize,
    pub of_time: ForceOfTime,
}

/// Force at the second end of a member that a moment on it amounts to; the opposite acts at the
/// first. None where both ends are in one place.
pub(crate) fn couple(moment: Vector, d: Vector) -> Vector {
    let squared = dot(d, d);
    if squared > 0.0 { times(1.0 / squared, cross(moment, d)) } else { [0.0; 3] }
}

impl Forces {
    /// All forces at a time by slot, N: loads, springs, and the forces and moments of time.
    pub(crate) fn at(
        &self,
        mechanism: &Mechanism,
        state: &State,
        time_s: f64,
        force: &mut [Vector],
    ) {
        if self.of_time.is_empty() && self.moments.is_empty() && mechanism.springs.is_empty() {
            return;
        }
        force.copy_from_slice(&mechanism.load);
        for spring in &mechanism.springs {
            let spans = mechanism.of(&spring.spans);
            let length_m = state.length_m(spans);
            for span in spans {
                let pull = spring.pull(length_m, state.between(span.a, span.b));
                force[span.a] = plus(force[span.a], pull);
                force[span.b] = minus(force[span.b], pull);
            }
        }
        for (slot, of_time) in &self.of_time {
            force[*slot] = add_times(force[*slot], 1.0, of_time(time_s));
        }
        for moment in &self.moments {
            let pull = couple((moment.of_time)(time_s), state.between(moment.a, moment.b));
            force[moment.a] = minus(force[moment.a], pull);
            force[moment.b] = plus(force[moment.b], pull);
        }
    }
}

impl Spring {
    /// Elongation that the member resists, m, where its spans have this length together.
    fn elongation(&self, length_m: f64) -> f64 {
        self.kind.borne(length_m - self.length_m)
    }

    /// Axial force over the length of a span, N/m, tension positive. Zero where the member is slack,
    /// whose ends may be in one place.
    pub(crate) fn force_density(&self, length_m: f64, span_m: f64) -> f64 {
        let elongation = self.elongation(length_m);
        if elongation.abs() <= 0.0 {
            return 0.0;
        }
        self.stiffness_n * elongation / self.length_m / span_m
    }

    /// The force with which a span pulls where it begins, N.
    pub(crate) fn pull(&self, length_m: f64, span: Vector) -> Vector {
        times(self.force_density(length_m, norm(span)), span)
    }

    /// Derivative of the axial force by the length, N/m.
    pub(crate) fn slope(&self, length_m: f64) -> f64 {
        let pulls = self.kind == Kind::Bar || self.elongation(length_m).abs() > 0.0;
        if pulls { self.stiffness_n / self.length_m } else { 0.0 }
    }

    /// Elastic energy `EA/(2l) e²`, J.
    pub(crate) fn energy_j(&self, length_m: f64) -> f64 {
        let e = self.elongation(length_m);
        0.5 * self.stiffness_n / self.length_m * e * e
    }
}

/// Kinetic energy, J: `½ vᵀ M v`.
pub(crate) fn kinetic_j(mechanism: &Mechanism, state: &State) -> f64 {
    let v = &state.velocity;
    let own = mechanism.mass.iter().zip(v).map(|(m, v)| 0.5 * m * dot(*v, *v));
    let spans = mechanism.spans.iter();
    let between = spans.map(|link| link.inertia.between * dot(v[link.a], v[link.b]));
    model::sum(own.chain(between))
}

/// Potential energy relative to [`System::reference_m`](model::system::System::reference_m), J:
/// that of weights and constant forces, and the elastic energy.
pub(crate) fn potential_j(mechanism: &Mechanism, state: &State) -> f64 {
    let slots = 0..state.at.len();
    let loads = slots.map(|slot| -dot(mechanism.load[slot], state.at[slot]));
    let springs = mechanism.springs.iter();
    let elastic = springs.map(|s| s.energy_j(state.length_m(mechanism.of(&s.spans))));
    model::sum(loads.chain(elastic))
}
