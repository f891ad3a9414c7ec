//! Newton's and Euler's laws for every member and the whole, from observables alone.
//!
//! A member is two points `x_a`, `x_b` with their velocities and accelerations, forces `F_a`, `F_b`
//! on its ends, its weight and its moment of inertia; nothing of mass matrices, multipliers or
//! constraints enters. With `u` its direction, `x_C` its centre of weight and `ω = u × u̇`:
//!
//! $$ m \ddot x_C = F_a + F_b + \sum F_k - m g e_z - c m \dot x_C, $$
//! $$ J\\, u \times \ddot u = (x_a - x_C) \times F_a + (x_b - x_C) \times F_b +
//!    \sum (x_k - x_C) \times F_k + M_a + M_b - c J \omega $$
//!
//! across the member (its spin is apart); where the moments across differ, in all directions with
//! the rate of `Σ J_i (ω · e_i) e_i` on the left. The forces on the ends of a rope are its tension
//! along its first and its last span. For the whole system the rates of momentum and of
//! angular momentum about the reference equal the forces and moments of the ground and the loads.

use model::Vector;
use model::system::{Member, System};

use crate::snapshot::Snapshot;
use numerics::vector::{add_times, cross, dot, minus, norm, plus, times, worse};

/// Largest violations, in units of the largest force (weights and inertia counted), and of it times
/// the total length.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Laws {
    /// Force left over on a member.
    pub force: f64,
    /// Moment about the centre of weight left over across a member.
    pub moment: f64,
    /// Force left over on a joint without support, or along the free directions of a slider.
    pub joint: f64,
    /// Momentum of the whole: reactions, loads and drag against its rate of change.
    pub momentum: f64,
    /// Angular momentum of the whole about the reference.
    pub angular_momentum: f64,
}

impl Laws {
    /// The largest violation; NaN stays NaN.
    pub fn largest(&self) -> f64 {
        [self.force, self.moment, self.joint, self.momentum, self.angular_momentum]
            .into_iter()
            .fold(0.0, worse)
    }
}

/// What acts on one member, and what it answers with.
struct Balance {
    /// `Σ F − m a`, and the moment about the centre less `J α`.
    force: Vector,
    moment: Vector,
    direction: Vector,
    /// Whether the moment along the member is in it.
    spins: bool,
    /// Rate of momentum less given forces (all but those of its ends), and the same about the
    /// reference.
    needed: Vector,
    turning: Vector,
}

/// Judge the laws at one time. `damping_1_s` is the drag of the medium, `of_time` the forces of time
/// by joint, N, and `moments` those on the members, N m.
pub(crate) fn judge(
    system: &System,
    at: &Snapshot,
    damping_1_s: f64,
    of_time: &[Vector],
    moments: &[Vector],
) -> Laws {
    let reference = system.reference_m();
    let mut unit_n = system.total_mass_kg() * system.gravity_m_s2();
    let forces = at.start_forces_n.iter().chain(&at.end_forces_n).chain(&at.reactions_n);
    for force in forces {
        unit_n = worse(unit_n, norm(*force));
    }
    let mut found = Laws::default();
    let (mut needed, mut turning) = ([0.0; 3], [0.0; 3]);
    for (number, given) in moments.iter().enumerate() {
        let member = &system.members()[number];
        if member.rope.is_some() {
            found.force = worse(found.force, rope_off(member, number, at));
            continue;
        }
        let balance = member_balance(system, number, at, damping_1_s, *given);
        found.force = worse(found.force, norm(balance.force));
        let along = if balance.spins { 0.0 } else { dot(balance.moment, balance.direction) };
        let left = add_times(balance.moment, -along, balance.direction);
        found.moment = worse(found.moment, norm(left));
        needed = plus(needed, balance.needed);
        turning = plus(turning, balance.turning);
    }
    for (joint, data) in system.joints().iter().enumerate() {
        let x = minus(at.joints_m[joint], reference);
        let weight = [0.0, 0.0, -data.mass_kg * system.gravity_m_s2()];
        let drag = times(-damping_1_s * data.mass_kg, at.velocities_m_s[joint]);
        let given = plus(plus(weight, data.force_n), plus(of_time[joint], drag));
        let own = minus(times(data.mass_kg, at.accelerations_m_s2[joint]), given);
        let left = minus(own, at.reactions_n[joint]);
        needed = plus(needed, left);
        turning = plus(turning, cross(x, left));
        found.joint = worse(found.joint, norm(data.support.free_part(at.reactions_n[joint])));
    }
    for (number, member) in system.members().iter().enumerate() {
        for (joint, moment) in [member.from, member.to].into_iter().zip(at.pin_moments_n_m[number])
        {
            // The pin of an anchor brings the moment of the ground; others hand on what they take.
            if system.joints()[joint].support.is_fixed() {
                turning = minus(turning, moment);
            }
        }
    }
    found.momentum = norm(needed);
    found.angular_momentum = norm(turning);
    let unit_n_m = unit_n * system.total_length_m();
    Laws {
        force: found.force / unit_n,
        moment: found.moment / unit_n_m,
        joint: found.joint / unit_n,
        momentum: found.momentum / unit_n,
        angular_momentum: found.angular_momentum / unit_n_m,
    }
}

/// How far the forces on the ends of a rope are from its tension along its first and last span, N.
fn rope_off(rope: &Member, number: usize, at: &Snapshot) -> f64 {
    let pull = |span: Option<[usize; 2]>| {
        let [a, b] = span.unwrap_or([rope.from, rope.to]);
        let d = minus(at.joints_m[b], at.joints_m[a]);
        let length = norm(d);
        if length > 0.0 { times(at.axial_n[number] / length, d) } else { [0.0; 3] }
    };
    let start = plus(at.start_forces_n[number], pull(rope.spans().next()));
    let end = minus(at.end_forces_n[number], pull(rope.spans().last()));
    worse(norm(start), norm(end))
}

fn member_balance(
    system: &System,
    number: usize,
    at: &Snapshot,
    damping_1_s: f64,
    own_n_m: Vector,
) -> Balance {
    let member = &system.members()[number];
    let (a, b) = (member.from, member.to);
    let body = &member.body;
    let x = [at.joints_m[a], at.joints_m[b]];
    let d = minus(x[1], x[0]);
    let length = norm(d);
    // Ends in one place, as a slack cord's may be, have no direction.
    let u = if length > 0.0 { times(1.0 / length, d) } else { [0.0; 3] };
    let far = body.centre_m() / body.length_m();
    let centre = |v: &[Vector]| plus(times(1.0 - far, v[a]), times(far, v[b]));
    let x_c = centre(&at.joints_m);
    let v_c = centre(&at.velocities_m_s);
    let a_c = centre(&at.accelerations_m_s2);
    // The moment of a member that stretches grows with the square of its length: H = J d × ḋ / l².
    let j = body.inertia_kg_m2()[1] / body.length_m() / body.length_m();
    let w = minus(at.velocities_m_s[b], at.velocities_m_s[a]);
    let turned = minus(at.accelerations_m_s2[b], at.accelerations_m_s2[a]);
    let found = at.turning.binary_search_by_key(&number, |turning| turning.member);
    let turning = found.ok().map(|found| &at.turning[found]);
    let [spin, spin_rate] = turning.map_or_else(
        || [times(j, cross(d, w)), times(j, cross(d, turned))],
        |turning| turning.momentum(body.inertia_kg_m2()),
    );
    let mass = body.mass_kg();
    let weight = [0.0, 0.0, -mass * system.gravity_m_s2()];
    let mut given = add_times(weight, -damping_1_s * mass, v_c);
    // What of the member's own moment is along it is taken by nothing, and does nothing.
    let own_n_m = add_times(own_n_m, -dot(own_n_m, u), u);
    let mut moment = add_times(own_n_m, -damping_1_s, spin);
    for load in &member.loads {
        let fraction = load.at_m / body.length_m();
        given = plus(given, load.force_n);
        moment = plus(moment, cross(times(fraction - far, d), load.force_n));
    }
    let rate = times(mass, a_c);
    let arm = minus(x_c, system.reference_m());
    let needed = minus(rate, given);
    let of_whole = plus(cross(arm, needed), minus(spin_rate, moment));
    let (f_a, f_b) = (at.start_forces_n[number], at.end_forces_n[number]);
    let ends = plus(cross(times(-far, d), f_a), cross(times(1.0 - far, d), f_b));
    let pins = plus(at.pin_moments_n_m[number][0], at.pin_moments_n_m[number][1]);
    Balance {
        force: minus(plus(f_a, f_b), needed),
        moment: minus(plus(plus(ends, pins), moment), spin_rate),
        direction: u,
        spins: turning.is_some(),
        needed,
        turning: of_whole,
    }
}
