//! Motions integrated a second time: Newton's and Euler's equations in the directions of the bars,
//! solved for the joint forces as the paper does, by the adaptive method of Dormand and Prince of
//! the order eight (crate `ode_solvers`). Neither natural coordinates nor a mass matrix, nor
//! constraints to be met, nor RATTLE has a part in it.

use model::Bar;
use motion::{Order, Simulation};
use nalgebra::{DMatrix, DVector, Matrix3, Quaternion, Rotation3, UnitQuaternion, Vector3};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, System as Equations};

use crate::common::{G, at_rest, closed, hanging, paper, run, string};

/// Tolerance of the adaptive method, relative and absolute.
const TIGHT: f64 = 1e-13;

/// Distance allowed where neighbouring motions of closed chains part by 1e4 to 1e5 in a second, m;
/// measured 1.1e-11 (three bars) and 1.6e-10 (ten).
const CHAOTIC_M: f64 = 1e-9;

/// A chain of bars from an anchor at the origin, its last end free or held.
struct Chain {
    bars: Vec<Bar>,
    held: bool,
    gravity_m_s2: f64,
}

impl Chain {
    /// Unit vectors and their derivatives, bar by bar.
    fn directions(y: &DVector<f64>, i: usize) -> (Vector3<f64>, Vector3<f64>) {
        (y.fixed_rows::<3>(6 * i).into_owned(), y.fixed_rows::<3>(6 * i + 3).into_owned())
    }

    /// Second derivatives of the unit vectors of bars without spin: with `r` from the beginning to
    /// the centre, `J` about it,
    ///
    /// $$ J \ddot u = -(1 - u u^T) (r f_i + (l - r) f_{i+1}) - J |\dot u|^2 u . $$
    fn accelerations(&self, y: &DVector<f64>) -> Vec<Vector3<f64>> {
        let turns = self.bars.iter().enumerate().map(|(i, bar)| {
            let (u, w) = Self::directions(y, i);
            let across = (Matrix3::identity() - u * u.transpose()) / bar.inertia_kg_m2()[1];
            (across, -u * w.norm_squared())
        });
        let turns: Vec<_> = turns.collect();
        let forces = self.forces(&turns);
        let turned = self.bars.iter().zip(&turns).enumerate();
        let turned = turned.map(|(i, (bar, (across, own)))| own - across * arms(bar, &forces, i));
        turned.collect()
    }

    /// Joint forces `f_0 ... f_n` of bars with `ü_i = −K_i (r f_i + (l − r) f_{i+1}) + c_i`.
    ///
    /// Bar `i` carries `f_i` at its beginning (of the bar before it, or the anchor) and `−f_{i+1}`
    /// at its end: `m a_C = f_i − f_{i+1} − m g e_z` with `a_C` the sum of `l ü` of the bars before
    /// and `r ü` of its own. These equations and the end that is free or held determine the forces.
    fn forces(&self, turns: &[(Matrix3<f64>, Vector3<f64>)]) -> Vec<Vector3<f64>> {
        let n = self.bars.len();
        let mut matrix = DMatrix::zeros(3 * n + 3, 3 * n + 3);
        let mut right = DVector::zeros(3 * n + 3);
        let mut add = |row: usize, i: usize, arm_m: f64| {
            let (bar, (across, own)) = (&self.bars[i], &turns[i]);
            let r = bar.centre_m();
            let mut start = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * i);
            start -= across * (arm_m * r);
            let mut end = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * i + 3);
            end -= across * (arm_m * (bar.length_m() - r));
            let mut known = right.fixed_rows_mut::<3>(3 * row);
            known -= own * arm_m;
        };
        for (i, bar) in self.bars.iter().enumerate() {
            for before in 0..i {
                add(i, before, self.bars[before].length_m());
            }
            add(i, i, bar.centre_m());
        }
        if self.held {
            for (i, bar) in self.bars.iter().enumerate() {
                add(n, i, bar.length_m());
            }
        }
        for (i, bar) in self.bars.iter().enumerate() {
            for k in 0..3 {
                matrix[(3 * i + k, 3 * i + k)] -= 1.0 / bar.mass_kg();
                matrix[(3 * i + k, 3 * i + 3 + k)] += 1.0 / bar.mass_kg();
            }
            right[3 * i + 2] -= self.gravity_m_s2;
        }
        if !self.held {
            for k in 0..3 {
                matrix[(3 * n + k, 3 * n + k)] = 1.0;
            }
        }
        let found = matrix.lu().solve(&right).expect("forces are determined");
        (0..=n).map(|i| found.fixed_rows::<3>(3 * i).into_owned()).collect()
    }
}

/// `r f_i + (l − r) f_{i+1}`.
fn arms(bar: &Bar, forces: &[Vector3<f64>], i: usize) -> Vector3<f64> {
    forces[i] * bar.centre_m() + forces[i + 1] * (bar.length_m() - bar.centre_m())
}

impl Equations<f64, DVector<f64>> for &Chain {
    fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
        for (i, turned) in self.accelerations(y).iter().enumerate() {
            let rate = y.fixed_rows::<3>(6 * i + 3).into_owned();
            dy.fixed_rows_mut::<3>(6 * i).copy_from(&rate);
            dy.fixed_rows_mut::<3>(6 * i + 3).copy_from(turned);
        }
    }
}

/// The state at the end, by Dormand and Prince.
fn adaptive<F>(equations: F, y: DVector<f64>, time_s: f64) -> DVector<f64>
where
    F: Equations<f64, DVector<f64>>,
{
    let mut found = Dop853::from_param(
        equations,
        0.0,
        time_s,
        time_s,
        y,
        TIGHT,
        TIGHT,
        0.9,
        0.0,
        0.333,
        6.0,
        time_s,
        0.0,
        1_000_000,
        u32::MAX,
        OutputType::Sparse,
    );
    found.integrate().expect("integrated");
    found.y_out().last().expect("an end").clone()
}

/// Largest distance of a joint between the two integrations at the time, m.
fn disagreement(simulation: &mut Simulation, chain: &Chain, time_s: f64, step_s: f64) -> f64 {
    let (at, velocity) = (simulation.joints_m(), simulation.velocities_m_s());
    let mut y = DVector::zeros(6 * chain.bars.len());
    for (i, bar) in chain.bars.iter().enumerate() {
        for k in 0..3 {
            y[6 * i + k] = (at[i + 1][k] - at[i][k]) / bar.length_m();
            y[6 * i + 3 + k] = (velocity[i + 1][k] - velocity[i][k]) / bar.length_m();
        }
    }
    let end = adaptive(chain, y, time_s);
    run(simulation, time_s, step_s);
    let mut place = Vector3::zeros();
    let mut worst = 0.0_f64;
    for (i, (bar, found)) in chain.bars.iter().zip(&simulation.joints_m()[1..]).enumerate() {
        place += Chain::directions(&end, i).0 * bar.length_m();
        worst = worst.max((place - Vector3::from(*found)).norm());
    }
    println!("{} bars, held {}: {worst:e} m apart", chain.bars.len(), chain.held);
    worst
}

#[test]
fn an_open_chain_in_space_moves_as_the_adaptive_method_says() {
    // Bars that differ, one with its centre of weight aside.
    let bars = vec![
        Bar::homogeneous(0.8, 1.2).unwrap(),
        Bar::new(1.0, 0.7, 0.3, [0.0, 0.08, 0.08]).unwrap(),
        Bar::homogeneous(0.5, 2.0).unwrap(),
        Bar::homogeneous(0.9, 0.6).unwrap(),
    ];
    let system = hanging(&bars, &[]);
    let at = string(&[0.8, 1.0, 0.5, 0.9], &[1.0, 1.4, 0.3, -0.5]);
    let mut simulation = at_rest(&system, &at, Order::Eighth);
    let push = [[0.0; 3], [0.2, 0.5, 0.0], [0.0, -0.4, 0.1], [0.1, 0.3, 0.0], [0.0, 0.6, -0.2]];
    simulation.push(&push).unwrap();
    let worst =
        disagreement(&mut simulation, &Chain { bars, held: false, gravity_m_s2: G }, 3.0, 2e-3);
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn the_papers_chain_in_space_moves_as_the_adaptive_method_says() {
    let mut simulation = at_rest(&paper(), &closed(0.8, 1.0), Order::Eighth);
    simulation.push(&[[0.0; 3], [0.5, 0.0, 0.2], [-0.3, 0.4, 0.0], [0.0; 3]]).unwrap();
    let case = model::cases::paper();
    let (bars, gravity_m_s2) = (case.chain().bars().to_vec(), case.chain().gravity_m_s2());
    // What is off by a rounding is off by 1e5 times as much a second later.
    let worst = disagreement(&mut simulation, &Chain { bars, held: true, gravity_m_s2 }, 1.0, 2e-3);
    assert!(worst < CHAOTIC_M, "{worst:e}");
}

#[test]
fn a_closed_chain_of_ten_bars_moves_as_the_adaptive_method_says() {
    let case = model::cases::get("ten-equal-bars").unwrap().problem();
    let (bars, gravity_m_s2) = (case.chain().bars().to_vec(), case.chain().gravity_m_s2());
    let system = model::system::System::from(case.chain());
    let at = motion::random_position(&system, 3).unwrap();
    let mut simulation = at_rest(&system, &at, Order::Eighth);
    let worst = disagreement(&mut simulation, &Chain { bars, held: true, gravity_m_s2 }, 1.0, 2e-3);
    assert!(worst < CHAOTIC_M, "{worst:e}");
}

/// The angle of a rod of 1 m and 1 kg in a medium, with friction at its anchor, pulled at its end
/// along OX and turned by a moment, both by the time.
struct Forced;

const DRAG_1_S: f64 = 0.3;
const FRICTION_N_M_S: f64 = 0.05;

fn pull_n(t: f64) -> f64 {
    4.0 * (5.0 * t).sin()
}

fn moment_n_m(t: f64) -> f64 {
    1.5 * (2.0 * t).cos()
}

impl Equations<f64, DVector<f64>> for Forced {
    fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
        // Time is a coordinate: with its own argument the crate's method (0.6.2) does not get ahead.
        let (theta, rate, t) = (y[0], y[1], y[2]);
        // θ from the descending vertical towards OX: a turn about −OY.
        let moment = pull_n(t) * theta.cos() - 0.5 * G * theta.sin() + moment_n_m(t);
        dy[2] = 1.0;
        dy[0] = rate;
        dy[1] = 3.0 * (moment - FRICTION_N_M_S * rate) - DRAG_1_S * rate;
    }
}

#[test]
fn a_rod_follows_forces_and_moments_of_time_through_a_medium() {
    let (start, time_s) = (0.4_f64, 5.0);
    let settings = motion::Settings {
        order: Order::Eighth,
        drag_1_s: DRAG_1_S,
        friction_n_m_s: FRICTION_N_M_S,
    };
    let system = hanging(&[Bar::homogeneous(1.0, 1.0).unwrap()], &[]);
    let at = string(&[1.0], &[start]);
    let mut simulation = Simulation::new(&system, &at, settings).unwrap();
    simulation.add_force(1, Box::new(|t| [pull_n(t), 0.0, 0.0])).unwrap();
    simulation.add_moment(0, Box::new(|t| [0.0, -moment_n_m(t), 0.0])).unwrap();
    run(&mut simulation, time_s, 1e-3);
    let end = adaptive(Forced, DVector::from_vec(vec![start, 0.0, 0.0]), time_s);
    let [x, _, z] = simulation.joints_m()[1];
    let off = (x - end[0].sin()).hypot(z + end[0].cos());
    println!("forced and damped: {off:e} m apart");
    assert!(off < 1e-10, "{off:e}");
    assert!(simulation.snapshot().laws.largest() < 1e-12);
}

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
