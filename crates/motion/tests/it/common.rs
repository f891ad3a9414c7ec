//! Systems that several tests use.

use model::system::{Joint, Member, System};
use model::{Bar, Vector};
use motion::{Settings, Simulation};

/// Gravity of the benchmarks, m/s².
pub const G: f64 = 9.81;

/// A string of bars that hangs from one anchor at the origin.
pub fn hanging(bars: &[Bar], point_masses_kg: &[f64]) -> System {
    let mut joints = vec![Joint::anchor("O", [0.0; 3])];
    let masses = point_masses_kg.iter().copied().chain(std::iter::repeat(0.0));
    for (k, mass) in (1..=bars.len()).zip(masses) {
        joints.push(Joint::free(format!("P{k}")).with_mass(mass));
    }
    let members = bars.iter().enumerate().map(|(k, bar)| Member::bar(k, k + 1, *bar)).collect();
    System::new("hanging", G, joints, members).unwrap()
}

/// Equal homogeneous rods of 1 m and 1 kg.
pub fn rods(n: usize) -> Vec<Bar> {
    vec![Bar::homogeneous(1.0, 1.0).unwrap(); n]
}

/// Equal massless links of 1 m.
pub fn links(n: usize) -> Vec<Bar> {
    vec![Bar::homogeneous(1.0, 0.0).unwrap(); n]
}

/// Places of the joints of a string in the plane OXZ, from the angles with the descending vertical,
/// rad.
pub fn string(lengths: &[f64], angles: &[f64]) -> Vec<Vector> {
    let mut at = vec![[0.0; 3]];
    for (l, angle) in lengths.iter().zip(angles) {
        let last = at[at.len() - 1];
        at.push([last[0] + l * angle.sin(), 0.0, last[2] - l * angle.cos()]);
    }
    at
}

/// The paper's chain between its anchors, from the angle of its first bar alone: the other two
/// close it.
pub fn paper() -> System {
    System::from(model::cases::paper().chain())
}

/// Closed positions of the paper's chain in OYZ: bar 1 at `theta` from the descending vertical, the
/// other two folded to the side of `sign`.
pub fn closed(theta: f64, sign: f64) -> Vec<Vector> {
    let (y, z) = (theta.sin(), -theta.cos());
    let (to_y, to_z) = (-y, -2.0 - z);
    let far = to_y.hypot(to_z);
    let across = (1.0 - 0.25 * far * far).sqrt() * sign;
    let (mid_y, mid_z) = (y + 0.5 * to_y, z + 0.5 * to_z);
    let b = [0.0, mid_y - across * to_z / far, mid_z + across * to_y / far];
    vec![[0.0; 3], [0.0, y, z], b, [0.0, 0.0, -2.0]]
}

/// Run for a time in steps of a length.
pub fn run(simulation: &mut Simulation, time_s: f64, step_s: f64) {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few millions")]
    let steps = (time_s / step_s).round() as usize;
    for _ in 0..steps {
        simulation.step(step_s).unwrap();
    }
}

/// A simulation at rest without damping.
pub fn at_rest(system: &System, at: &[Vector], order: motion::Order) -> Simulation {
    Simulation::new(system, at, Settings { order, ..Settings::default() }).unwrap()
}
