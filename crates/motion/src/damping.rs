//! Damping linear in the velocities: a medium, and friction in the joints.
//!
//! The medium takes away momentum at the rate `c`: `−c M v`. Friction has Rayleigh's function
//!
//! $$ D = \frac k2 \sum_j \sum_{e \in j} |P_e (\omega_e - \omega_j)|^2, \qquad
//!    \omega_e = \frac{d_e \times \dot d_e}{d_e^2}, \qquad P_e = I - u_e u_e^T, $$
//!
//! with the pin of joint *j* at rest at anchors; elsewhere it has no inertia and turns so that the
//! moments on it cancel: `(Σ P_e) ω_j = Σ ω_e`. A member twists in its joints without friction, so
//! its spin stays apart.

use matrices::dense::solve_three;
use model::Vector;

use crate::force::{couple, kinetic_j};
use crate::mechanism::{Link, Mechanism};
use crate::rattle::{Failure, Stepper};
use crate::settings::Settings;
use crate::state::State;
use numerics::vector::{add_times, cross, dot, minus, plus, times};

pub(crate) struct Damping {
    /// Drag on the point mass of each slot, N.
    pub on_joints: Vec<Vector>,
    /// Drag and friction at both ends of each member by number, N.
    pub on_members: Vec<[Vector; 2]>,
    /// Moment of each pin on each end of each member by number, N m.
    pub moments: Vec<[Vector; 2]>,
    ends: Vec<(usize, usize)>,
}

impl Damping {
    /// Forces by slot, N.
    pub(crate) fn total(&self) -> Vec<Vector> {
        let mut total = self.on_joints.clone();
        for (&(a, b), on) in self.ends.iter().zip(&self.on_members) {
            total[a] = plus(total[a], on[0]);
            total[b] = plus(total[b], on[1]);
        }
        total
    }
}

/// The forces of the damping, told apart.
pub(crate) fn forces(mechanism: &Mechanism, settings: &Settings, state: &State) -> Damping {
    let v = &state.velocity;
    let c = settings.damping_1_s;
    let joints = mechanism.system.joints();
    let mut found = Damping {
        on_joints: (0..v.len())
            .map(|slot| times(-c * joints[mechanism.joint_at[slot]].mass_kg, v[slot]))
            .collect(),
        on_members: vec![[[0.0; 3]; 2]; mechanism.system.members().len()],
        moments: moments(mechanism, settings, state),
        ends: vec![(0, 0); mechanism.system.members().len()],
    };
    for link in &mechanism.spans {
        let m = link.inertia;
        let couple = couple(
            plus(found.moments[link.member][0], found.moments[link.member][1]),
            vector(state, link),
        );
        let drag_a = plus(times(m.from, v[link.a]), times(m.between, v[link.b]));
        let drag_b = plus(times(m.between, v[link.a]), times(m.to, v[link.b]));
        found.on_members[link.member] =
            [add_times(times(-1.0, couple), -c, drag_a), add_times(couple, -c, drag_b)];
        found.ends[link.member] = (link.a, link.b);
    }
    found
}

/// Moments of the pins on the ends of the members; a rope bends without any.
fn moments(mechanism: &Mechanism, settings: &Settings, state: &State) -> Vec<[Vector; 2]> {
    let k = settings.friction_n_m_s;
    let mut found = vec![[[0.0; 3]; 2]; mechanism.system.members().len()];
    if k <= 0.0 {
        return found;
    }
    let v = &state.velocity;
    let [_, of_system] = mechanism.given();
    let members = mechanism.system.members();
    // A bar of a corner has no pins.
    let pinned = |link: &&Link| link.member < of_system && members[link.member].rope.is_none();
    let mut turning = vec![[0.0; 3]; found.len()];
    let mut pins = vec![Pin::default(); v.len()];
    for link in mechanism.spans.iter().filter(pinned) {
        let d = vector(state, link);
        let omega = times(1.0 / dot(d, d), cross(d, minus(v[link.b], v[link.a])));
        turning[link.member] = omega;
        for slot in [link.a, link.b] {
            pins[slot].add(d, omega);
        }
    }
    let pins: Vec<Vector> = (0..v.len())
        .map(|slot| if slot < mechanism.moving { pins[slot].turning() } else { [0.0; 3] })
        .collect();
    for link in mechanism.spans.iter().filter(pinned) {
        let d = vector(state, link);
        let moment = |slot: usize| {
            let against = minus(turning[link.member], pins[slot]);
            times(-k, add_times(against, -dot(against, d) / dot(d, d), d))
        };
        found[link.member] = [moment(link.a), moment(link.b)];
    }
    found
}

/// A pin without inertia: `Σ P_e` and `Σ ω_e` of its members.
#[derive(Clone, Default)]
struct Pin {
    resists: [Vector; 3],
    turning: Vector,
}

/// Added to `Σ P_e`, in units of it: members on one line leave the turn about it open, which moves
/// none of them (and which the backward error of the factorisation then fills with rounding,
/// alone).
const OPEN_TURN: f64 = 1e-14;

impl Pin {
    fn add(&mut self, d: Vector, omega: Vector) {
        for (i, row) in self.resists.iter_mut().enumerate() {
            row[i] += 1.0;
            *row = add_times(*row, -d[i] / dot(d, d), d);
        }
        self.turning = plus(self.turning, omega);
    }

    fn turning(&self) -> Vector {
        let mut closed = self.resists;
        let trace: f64 = (0..3).map(|k| closed[k][k]).sum();
        (0..3).for_each(|k| closed[k][k] += OPEN_TURN * trace);
        solve_three(&closed, self.turning).unwrap_or_default()
    }
}

fn vector(state: &State, link: &Link) -> Vector {
    state.between(link.a, link.b)
}

/// Let the damping alone act for the time `h`, with the places held.
///
/// The medium is exact. Friction is a linear equation for the velocities, taken to the fourth
/// order; where the energy does not fall with it the step is too long.
pub(crate) fn damp(
    settings: &Settings,
    state: &mut State,
    stepper: &mut Stepper,
    h: f64,
) -> Result<(), Failure> {
    if settings.damping_1_s > 0.0 {
        let factor = (-settings.damping_1_s * h).exp();
        state.velocity.iter_mut().for_each(|v| *v = times(factor, *v));
    }
    if settings.friction_n_m_s <= 0.0 {
        return Ok(());
    }
    let before_j = kinetic_j(&stepper.mechanism, state);
    let only_friction = Settings { damping_1_s: 0.0, ..*settings };
    // exp(h F) v to the fourth order: v + h F (v + h/2 F (v + h/3 F (v + h/4 F v))).
    let begin = state.velocity.clone();
    for part in [4.0, 3.0, 2.0, 1.0] {
        let force = forces(&stepper.mechanism, &only_friction, state).total();
        let impulse: Vec<Vector> = force.iter().map(|f| times(h / part, *f)).collect();
        state.velocity.clone_from(&begin);
        stepper.push(state, &impulse)?;
    }
    let after_j = kinetic_j(&stepper.mechanism, state);
    if h > 0.0 && after_j > before_j {
        return Err(Failure::NotMet { corrections: 0, off: after_j / before_j - 1.0 });
    }
    Ok(())
}
