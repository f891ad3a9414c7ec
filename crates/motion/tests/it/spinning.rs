//! Bars with three different moments against unit quaternions and the adaptive method.

use model::Bar;
use motion::{Order, Simulation};
use nalgebra::{DVector, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use ode_solvers::System as Equations;

use crate::common::{G, at_rest, closed, hanging, run, string};
use crate::second_opinion::{CHAOTIC_M, Chain, adaptive, arms};

/// Bars with three different moments, each with a unit quaternion and its angular velocity in its
/// own axes: Newton's and Euler's equations.
struct Spinning(Chain);

impl Spinning {
    fn turn(y: &DVector<f64>, i: usize) -> (UnitQuaternion<f64>, Vector3<f64>) {
        let [w, x, y_, z] = std::array::from_fn(|k| y[7 * i + k]);
        let q = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y_, z));
        (q, y.fixed_rows::<3>(7 * i + 4).into_owned())
    }

    /// The state of bars without spin, the second axis of each level.
    fn state(&self, at: &[[f64; 3]], velocity: &[[f64; 3]]) -> DVector<f64> {
        let mut state = DVector::zeros(7 * self.0.bars.len());
        for (i, bar) in self.0.bars.iter().enumerate() {
            let along =
                |v: &[[f64; 3]]| (Vector3::from(v[i + 1]) - Vector3::from(v[i])) / bar.length_m();
            let (u, rate) = (along(at), along(velocity));
            let second = Vector3::z().cross(&u).normalize();
            let axes = Matrix3::from_columns(&[u, second, u.cross(&second)]);
            let q = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(axes));
            let omega = q.inverse() * u.cross(&rate);
            let parts = [q.w, q.i, q.j, q.k, omega.x, omega.y, omega.z];
            state.fixed_rows_mut::<7>(7 * i).copy_from_slice(&parts);
        }
        state
    }
}

impl Equations<f64, DVector<f64>> for &Spinning {
    fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
        let bars = &self.0.bars;
        // ü = u × I⁻¹ (u × s) + u × I⁻¹ (ω × I ω) + ω × (ω × u), s = r f_i + (l − r) f_{i+1}.
        let mut turns = Vec::new();
        for (i, bar) in bars.iter().enumerate() {
            let (q, omega) = Spinning::turn(y, i);
            let r = q.to_rotation_matrix();
            let moments = Vector3::from(bar.inertia_kg_m2());
            let inverse = r * Matrix3::from_diagonal(&moments.map(|j| 1.0 / j)) * r.transpose();
            let gyroscopic = q * omega.cross(&moments.component_mul(&omega));
            let (u, omega) = (q * Vector3::x(), q * omega);
            let own = u.cross(&(inverse * gyroscopic)) + omega.cross(&omega.cross(&u));
            let skew = u.cross_matrix();
            turns.push((-(skew * inverse * skew), own));
        }
        let forces = self.0.forces(&turns);
        for (i, bar) in bars.iter().enumerate() {
            let (q, omega) = Spinning::turn(y, i);
            let moments = Vector3::from(bar.inertia_kg_m2());
            let torque = -Vector3::x().cross(&(q.inverse() * arms(bar, &forces, i)));
            let euler = torque - omega.cross(&moments.component_mul(&omega));
            let rate = q.quaternion() * Quaternion::from_imag(omega) * 0.5;
            let turned = euler.component_div(&moments);
            let parts = [rate.w, rate.i, rate.j, rate.k, turned.x, turned.y, turned.z];
            dy.fixed_rows_mut::<7>(7 * i).copy_from_slice(&parts);
        }
    }
}

/// Largest distance of a joint, m, and largest difference of the spin of a bar with different
/// moments, rad/s.
fn spinning(simulation: &mut Simulation, chain: Chain, time_s: f64, step_s: f64) -> [f64; 2] {
    let chain = Spinning(chain);
    let y = chain.state(&simulation.joints_m(), &simulation.velocities_m_s());
    let end = adaptive(&chain, y, time_s);
    run(simulation, time_s, step_s);
    let now = simulation.snapshot();
    assert!(now.laws.largest() < 1e-11, "{:?}", now.laws);
    let mut place = Vector3::zeros();
    let mut worst = [0.0_f64; 2];
    for (i, bar) in chain.0.bars.iter().enumerate() {
        let (q, omega) = Spinning::turn(&end, i);
        place += q * Vector3::x() * bar.length_m();
        worst[0] = worst[0].max((place - Vector3::from(now.joints_m[i + 1])).norm());
        if let Some(turning) = now.turning.iter().find(|turning| turning.member == i) {
            let spin = Vector3::from(turning.omega_rad_s).dot(&Vector3::from(turning.axes[0]));
            println!("bar {i} spins with {spin:.6} rad/s, {:.6}", omega.x);
            assert!(spin.abs() > 0.01, "nothing is shown of the spin: {spin}");
            worst[1] = worst[1].max((spin - omega.x).abs());
        }
    }
    println!("{} bars, held {}: {worst:?} apart", chain.0.bars.len(), chain.0.held);
    worst
}

/// A bar of 1 m with three different moments.
fn flat(mass_kg: f64, centre_m: f64) -> Bar {
    Bar::new(1.0, mass_kg, centre_m, [0.03, 0.06, 0.08]).unwrap()
}

#[test]
fn bars_with_three_moments_swing_and_spin_as_their_quaternions_say() {
    let bars = vec![flat(1.0, 0.5), flat(0.7, 0.3)];
    let system = hanging(&bars, &[]);
    let mut simulation = at_rest(&system, &string(&[1.0; 2], &[1.0, 1.3]), Order::Eighth);
    simulation.push(&[[0.0; 3], [0.2, 0.9, 0.1], [0.0, -0.7, 0.3]]).unwrap();
    let energy_j = simulation.energy_j();
    let chain = Chain { bars, held: false, gravity_m_s2: G };
    let [place, spin] = spinning(&mut simulation, chain, 2.0, 2e-3);
    assert!(place < 1e-10 && spin < 1e-9, "{place:e} {spin:e}");
    assert!((simulation.energy_j() - energy_j).abs() < 1e-10);
}

#[test]
fn a_closed_chain_with_three_moments_swings_and_spins_as_its_quaternions_say() {
    use model::system::{Joint, Member, System};
    let bars =
        vec![flat(1.0, 0.5), flat(2.0, 0.6), Bar::new(1.0, 1.0, 0.5, [0.02, 0.1, 0.1]).unwrap()];
    let joints = vec![
        Joint::anchor("O", [0.0; 3]),
        Joint::free("A"),
        Joint::free("B"),
        Joint::anchor("D", [0.0, 0.0, -2.0]),
    ];
    let members = bars.iter().enumerate().map(|(k, bar)| Member::bar(k, k + 1, *bar)).collect();
    let system = System::new("flat", G, joints, members).unwrap();
    let mut simulation = at_rest(&system, &closed(0.8, 1.0), Order::Eighth);
    simulation.push(&[[0.0; 3], [0.5, 0.0, 0.2], [-0.3, 0.4, 0.0], [0.0; 3]]).unwrap();
    let chain = Chain { bars, held: true, gravity_m_s2: G };
    let [place, spin] = spinning(&mut simulation, chain, 1.0, 2e-3);
    assert!(place < CHAOTIC_M && spin < 10.0 * CHAOTIC_M, "{place:e} {spin:e}");
}
