use model::Vector;

use crate::corners::Turning;
use crate::damping::Damping;
use crate::force::couple;
use crate::laws::{self, Laws};
use crate::mechanism::Link;
use crate::simulation::Simulation;
use numerics::vector::{add_times, dot, minus, norm, plus, times};

/// Everything about a motion at one time. Arrays are by joint, or by member, in the order of the
/// system.
#[derive(Debug, Clone, PartialEq)]
pub struct Snapshot {
    /// Time since the beginning, s.
    pub time_s: f64,
    /// Places of the joints, world frame, m.
    pub joints_m: Vec<Vector>,
    /// Their velocities, m/s.
    pub velocities_m_s: Vec<Vector>,
    /// Their accelerations, m/s².
    pub accelerations_m_s2: Vec<Vector>,
    /// Axial force of each member with weights, forces and inertia lumped to its joints, N, tension
    /// positive; of a rope the same in all its spans.
    pub axial_n: Vec<f64>,
    /// For each member the force on it at the joint where it begins, world frame, N.
    pub start_forces_n: Vec<Vector>,
    /// For each member the force on it at the joint where it ends, world frame, N.
    pub end_forces_n: Vec<Vector>,
    /// Force of the ground on each joint, world frame, N; of a joint without support the imbalance,
    /// which is rounding.
    pub reactions_n: Vec<Vector>,
    /// Moments of the joints' pins on both ends of each member, N m: zero without friction.
    pub pin_moments_n_m: Vec<[Vector; 2]>,
    /// How the bars turn whose moments across differ.
    pub turning: Vec<Turning>,
    /// Kinetic energy, J.
    pub kinetic_j: f64,
    /// Potential energy, J, relative to
    /// [`System::reference_m`](model::system::System::reference_m).
    pub potential_j: f64,
    /// Energy that was lost in impacts since the beginning, J.
    pub lost_j: f64,
    /// Largest relative violation of a length.
    pub lengths_off: f64,
    /// Largest rate of change of a length in units of the largest speed.
    pub rates_off: f64,
    /// What is left over in Newton's and Euler's laws.
    pub laws: Laws,
}

impl Snapshot {
    pub(crate) fn new(
        simulation: &Simulation,
        accelerations: &[Vector],
        multipliers: &[f64],
        damping: &Damping,
    ) -> Self {
        let mechanism = simulation.mechanism();
        let system = mechanism.system();
        let (members, state) = (system.members(), &simulation.state);
        let mut axial_n = vec![0.0; members.len()];
        let mut start_forces_n = vec![[0.0; 3]; members.len()];
        let mut end_forces_n = vec![[0.0; 3]; members.len()];
        let moments = simulation.moments_of_time();
        // Forces on ropes at the joints that they run over.
        let mut between_n = vec![[0.0; 3]; mechanism.joint_at.len()];
        let spans = &mechanism.spans;
        for (k, (link, density)) in spans.iter().zip(densities(simulation, multipliers)).enumerate()
        {
            let d = state.between(link.a, link.b);
            let m = link.inertia;
            let number = mechanism.owner(link.member);
            let (a, b) = (accelerations[link.a], accelerations[link.b]);
            let member = &mechanism.system.members()[link.member];
            let [load_a, load_b] = member.end_loads_n(system.gravity_m_s2());
            let [damping_a, damping_b] = damping.on_members[link.member];
            let at_a = minus(plus(times(m.from, a), times(m.between, b)), plus(load_a, damping_a));
            let at_b = minus(plus(times(m.between, a), times(m.to, b)), plus(load_b, damping_b));
            let at_a = add_times(at_a, -density, d);
            let at_b = add_times(at_b, density, d);
            if link.member == number {
                let pull = couple(moments[number], d);
                let (at_a, at_b) = (plus(at_a, pull), minus(at_b, pull));
                let is_inside = |next: Option<&Link>| next.is_some_and(|s| s.member == number);
                if is_inside(k.checked_sub(1).and_then(|k| spans.get(k))) {
                    between_n[link.a] = plus(between_n[link.a], at_a);
                } else {
                    axial_n[number] += density * norm(d);
                    start_forces_n[number] = plus(start_forces_n[number], at_a);
                }
                let at_end = if is_inside(spans.get(k + 1)) {
                    &mut between_n[link.b]
                } else {
                    &mut end_forces_n[number]
                };
                *at_end = plus(*at_end, at_b);
                continue;
            }
            // A bar of a corner: what it brings to an end of the member it belongs to.
            let [start, end] = [members[number].from, members[number].to];
            let [start, end] = [mechanism.slot_of[start], mechanism.slot_of[end]];
            for (slot, force, sign) in [(link.a, at_a, 1.0), (link.b, at_b, -1.0)] {
                if slot == start {
                    start_forces_n[number] = plus(start_forces_n[number], force);
                    let along = state.between(start, end);
                    axial_n[number] += sign * density * dot(d, along) / norm(along);
                } else if slot == end {
                    end_forces_n[number] = plus(end_forces_n[number], force);
                }
            }
        }
        let all = |by_slot: &[Vector]| -> Vec<Vector> {
            mechanism.slot_of.iter().map(|&slot| by_slot[slot]).collect()
        };
        let (at, velocity) = (all(&state.at), all(&state.velocity));
        let acceleration = all(accelerations);
        let turning = mechanism.cornered.iter().map(|cornered| {
            let body = &members[cornered.member].body;
            Turning::new(cornered, body, &at, &velocity, &acceleration)
        });
        let turning = turning.collect();
        let of_time = mechanism.by_joint(&simulation.forces_of_time());
        let drag = mechanism.by_joint(&damping.on_joints);
        let accelerations_m_s2 = mechanism.by_joint(accelerations);
        let mut reactions_n: Vec<Vector> = (0..of_time.len())
            .map(|joint| {
                let data = &system.joints()[joint];
                let weight = [0.0, 0.0, -data.mass_kg * system.gravity_m_s2()];
                let given = plus(plus(data.force_n, weight), plus(of_time[joint], drag[joint]));
                let own = minus(times(data.mass_kg, accelerations_m_s2[joint]), given);
                plus(own, between_n[mechanism.slot_of[joint]])
            })
            .collect();
        for (number, member) in members.iter().enumerate() {
            reactions_n[member.from] = plus(reactions_n[member.from], start_forces_n[number]);
            reactions_n[member.to] = plus(reactions_n[member.to], end_forces_n[number]);
        }
        let [lengths_off, rates_off] = simulation.constraints_off();
        let mut found = Self {
            time_s: simulation.time_s(),
            joints_m: simulation.joints_m(),
            velocities_m_s: simulation.velocities_m_s(),
            accelerations_m_s2,
            axial_n,
            start_forces_n,
            end_forces_n,
            reactions_n,
            pin_moments_n_m: damping.moments[..members.len()].to_vec(),
            turning,
            kinetic_j: simulation.kinetic_j(),
            potential_j: simulation.potential_j(),
            lost_j: simulation.lost_j(),
            lengths_off,
            rates_off,
            laws: Laws::default(),
        };
        let damping_1_s = simulation.settings.damping_1_s;
        found.laws = laws::judge(system, &found, damping_1_s, &of_time, &moments);
        found
    }

    /// Mechanical energy, J.
    pub fn energy_j(&self) -> f64 {
        self.kinetic_j + self.potential_j
    }
}

/// Axial force over length of each span, N/m.
fn densities(simulation: &Simulation, multipliers: &[f64]) -> Vec<f64> {
    let (mechanism, state) = (simulation.mechanism(), &simulation.state);
    let mut found = Vec::with_capacity(mechanism.spans.len());
    let span_m = |span: &Link| norm(state.between(span.a, span.b));
    for (bar, rho) in mechanism.bars.iter().zip(multipliers) {
        let spans = mechanism.of(&bar.spans);
        let length_m = state.length_m(spans);
        found.extend(spans.iter().map(|span| rho * (length_m / span_m(span))));
    }
    for spring in &mechanism.springs {
        let spans = mechanism.of(&spring.spans);
        let length_m = state.length_m(spans);
        found.extend(spans.iter().map(|span| spring.force_density(length_m, span_m(span))));
    }
    found
}
