//! Ropes over rings and pulleys in motion and about equilibria, against closed forms and differences of energies.

use model::system::{Joint, Member, RunTogether, System};
use model::{Bar, Vector};
use motion::{
    Contact, EquilibriumBox, MotionError, Order, Settings, Simulation, enclose_modes, lowest_modes,
    modes,
};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use numerics::Interval;
use samples::rope;

use crate::common::G;

fn system(joints: Vec<Joint>, members: Vec<Member>) -> System {
    System::new("ropes", G, joints, members).unwrap()
}

fn free(name: &str, mass_kg: f64) -> Joint {
    Joint::free(name).with_mass(mass_kg)
}

fn near(found: f64, told: f64, tolerance: f64) {
    assert!((found - told).abs() < tolerance, "{found}, not {told}");
}

fn omega2(found: &motion::Modes) -> Vec<f64> {
    found.modes.iter().map(|mode| mode.omega2_s2).collect()
}

/// 3 kg and 2 kg on a rope over two pulleys at one height.
fn atwood() -> (System, Vec<Vector>) {
    let joints = vec![
        Joint::anchor("D", [0.0; 3]),
        Joint::anchor("E", [1.0, 0.0, 0.0]),
        free("P", 3.0),
        free("Q", 2.0),
    ];
    let at = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -1.5], [1.0, 0.0, -2.5]];
    (system(joints, vec![rope(&[2, 0, 1, 3], 5.0)]), at)
}

#[test]
fn two_weights_over_pulleys() {
    let (system, at) = atwood();
    let mut weights = Simulation::new(&system, &at, Settings::default()).unwrap();
    let released = weights.snapshot();
    // (3 - 2)/(3 + 2) g, and 2 * 3 * 2/(3 + 2) g in the rope.
    near(released.accelerations_m_s2[2][2], -G / 5.0, 1e-13);
    near(released.accelerations_m_s2[3][2], G / 5.0, 1e-13);
    let tension_n = 12.0 / 5.0 * G;
    near(released.axial_n[0], tension_n, 1e-12);
    for (pulley, level) in [(0, 1.0), (1, -1.0)] {
        near(released.reactions_n[pulley][0], -level * tension_n, 1e-12);
        near(released.reactions_n[pulley][2], tension_n, 1e-12);
    }
    near(released.start_forces_n[0][2], -tension_n, 1e-12);
    assert!(released.laws.largest() < 1e-14, "{:?}", released.laws);
    for _ in 0..1000 {
        weights.step(1e-3).unwrap();
    }
    near(weights.joints_m()[2][2], -1.5 - G / 10.0, 1e-11);
    near(weights.joints_m()[3][2], -2.5 + G / 10.0, 1e-11);
    near(weights.energy_j(), released.energy_j(), 1e-10);
}

/// The lighter weight rises to its pulley after √(2 · 2.5/(G/5)) = 1.6 s.
#[test]
fn a_weight_that_reaches_its_pulley_jams() {
    let (system, at) = atwood();
    for step_s in [1e-3, 2e-2] {
        let mut weights = Simulation::new(&system, &at, Settings::default()).unwrap();
        let jam = loop {
            if let Err(jam) = weights.step(step_s) {
                break jam;
            }
        };
        let told = RunTogether { member: 1, from: "E".to_owned(), to: "Q".to_owned() }.into();
        assert_eq!(jam, told);
        near(weights.time_s(), (25.0 / G).sqrt(), 1.01 * step_s);
    }
    let elastic = vec![rope(&[2, 0, 1, 3], 5.0).with_stiffness(300.0)];
    let elastic = self::system(system.joints().to_vec(), elastic);
    for (system, below_m) in [(system, 4.0), (elastic, 4.5)] {
        let mut jammed = at.clone();
        (jammed[2], jammed[3]) = ([0.0, 0.0, -below_m], [1.0, 0.0, 0.0]);
        let refused = Simulation::new(&system, &jammed, Settings::default()).err().unwrap();
        assert!(matches!(refused, MotionError::Jammed(RunTogether { member: 1, .. })), "{refused}");
        let refused = modes(&system, &jammed, None).unwrap_err();
        assert!(matches!(refused, MotionError::Jammed(RunTogether { member: 1, .. })), "{refused}");
    }
}

/// A block of 7 kg on two strands, whose rope runs on over a pulley to 2 kg: it falls with
/// (7 - 2 · 2)/(7 + 2² · 2) g, and the other rises by twice that.
#[test]
fn a_tackle_in_motion() {
    let joints = vec![
        Joint::anchor("beam", [0.0; 3]),
        free("block", 7.0),
        Joint::anchor("E", [1.0, 0.0, 0.0]),
        free("Q", 2.0),
    ];
    let at = [[0.0; 3], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [1.0, 0.0, -4.0]];
    let system = system(joints, vec![rope(&[0, 1, 0, 2, 3], 7.0)]);
    let mut tackle = Simulation::new(&system, &at, Settings::default()).unwrap();
    let released = tackle.snapshot();
    let a = 3.0 / 15.0 * G;
    near(released.accelerations_m_s2[1][2], -a, 1e-13);
    near(released.accelerations_m_s2[3][2], 2.0 * a, 1e-13);
    near(released.axial_n[0], 2.0 * (G + 2.0 * a), 1e-12);
    assert!(released.laws.largest() < 1e-14, "{:?}", released.laws);
    for _ in 0..800 {
        tackle.step(1e-3).unwrap();
    }
    near(tackle.joints_m()[1][2], -1.0 - 0.32 * a, 1e-11);
}

/// A ring of 10 kg on a rope of 5 m from the origin to 4 m aside and 1 m up.
fn ring(member: Member) -> (System, Vec<Vector>) {
    let joints =
        vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [4.0, 0.0, 1.0]), free("P", 10.0)];
    (system(joints, vec![member]), vec![[0.0; 3], [4.0, 0.0, 1.0], [4.0 / 3.0, 0.0, -1.0]])
}

/// At the lowest point of its ellipse, 5/3 m and 10/3 m from the foci: `ω² = g κ` with the curvature
/// `κ = a b/(r₁ r₂)^(3/2)`, a = 5/2, b = √2; across its plane it swings about the line of the
/// anchors, which is 4/3 m above it.
fn of_the_ring() -> [f64; 2] {
    [G * 2.5 * 2.0_f64.sqrt() / (50.0_f64 / 9.0).powf(1.5), 0.75 * G]
}

#[test]
fn a_ring_on_a_rope_swings_along_its_ellipse_and_about_its_anchors() {
    let (system, at) = ring(rope(&[0, 2, 1], 5.0));
    let found = modes(&system, &at, None).unwrap();
    let told = of_the_ring();
    assert_eq!(found.modes.len(), 2);
    for (found, told) in omega2(&found).iter().zip(told) {
        near(*found, told, 1e-12);
    }
    assert_eq!(found.modes[0].direction, motion::Direction::InPlane);
    assert_eq!(found.modes[1].direction, motion::Direction::Across);
    assert!(found.modes[0].shape[2][2].abs() < 1e-14, "level");
    // In intervals about the place and the force.
    let around = |x: f64| Interval::around(x, 1e-15 * x.abs());
    let joints_m: Vec<_> = at.iter().map(|x| x.map(around)).collect();
    let axial_n = [around(10.0 * G / 1.2)];
    let equilibrium = EquilibriumBox { joints_m: &joints_m, axial_n: &axial_n, turns: 0 };
    let proved = enclose_modes(&system, &equilibrium).unwrap();
    assert_eq!(proved.inertia, Some([0, 0, 2]));
    for (interval, told) in proved.omega2_s2.iter().zip(told) {
        let around = Interval::around(told, 1e-14);
        assert!(
            interval.lo() <= around.hi() && around.lo() <= interval.hi(),
            "{interval:?} {told}"
        );
        assert!(interval.width() < 1e-11, "{interval:?}");
    }
}

/// Along its ellipse `x = a cos θ, y = b sin θ` about the middle of the anchors, by Lagrange's
/// equation `(a² sin² + b² cos²) θ'' + (a² − b²) sin cos θ'² = −dV/dθ/m` and Runge and Kutta.
#[test]
fn a_ring_runs_along_its_ellipse() {
    let (system, _) = ring(rope(&[0, 2, 1], 5.0));
    let (a, b) = (2.5, 2.0_f64.sqrt());
    let [c, s] = [4.0, 1.0].map(|x| x / 17.0_f64.sqrt());
    let place = |theta: f64| {
        let (x, y) = (a * theta.cos(), b * theta.sin());
        [2.0 + c * x - s * y, 0.0, 0.5 + s * x + c * y]
    };
    let slope = |[theta, rate]: [f64; 2]| {
        let (sin, cos) = theta.sin_cos();
        let inertia = a * a * sin * sin + b * b * cos * cos;
        let falls = G * (-s * a * sin + c * b * cos);
        [rate, -(falls + (a * a - b * b) * sin * cos * rate * rate) / inertia]
    };
    let mut y = [-2.6, 0.0];
    let at = [[0.0; 3], [4.0, 0.0, 1.0], place(y[0])];
    let settings = Settings { order: Order::Eighth, ..Settings::default() };
    let mut swing = Simulation::new(&system, &at, settings).unwrap();
    let energy_j = swing.energy_j();
    let h = 2e-3;
    for _ in 0..1000 {
        let step = |k: [f64; 2], part: f64| [y[0] + part * k[0], y[1] + part * k[1]];
        let k1 = slope(y);
        let k2 = slope(step(k1, 0.5 * h));
        let k3 = slope(step(k2, 0.5 * h));
        let k4 = slope(step(k3, h));
        y = std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        swing.step(h).unwrap();
    }
    let (found, told) = (swing.joints_m()[2], place(y[0]));
    for k in 0..3 {
        near(found[k], told[k], 1e-9);
    }
    near(swing.energy_j(), energy_j, 1e-9);
    let snapshot = swing.snapshot();
    assert!(snapshot.laws.largest() < 1e-12 && snapshot.lengths_off < 1e-12, "{snapshot:?}");
}

/// `EA/L` of a weight over a pulley, `n² EA/L` of a block on `n` strands; aside they are pendulums.
#[test]
fn elastic_ropes_have_the_stiffness_of_their_strands() {
    let joints = || {
        vec![Joint::anchor("D", [0.0; 3]), Joint::anchor("E", [-3.0, 0.0, -4.0]), free("P", 3.0)]
    };
    for (path, strands, held_m) in [
        (vec![1, 0, 2], 1.0, 5.0),
        (vec![0, 2, 0, 2, 0], 4.0, 0.0),
        (vec![2, 0, 2, 0, 1], 3.0, 5.0),
    ] {
        let tension_n = 3.0 * G / strands;
        let (length_m, stiffness_n) = (8.0, 300.0);
        let stretched_m = length_m * (1.0 + tension_n / stiffness_n);
        let depth_m = (stretched_m - held_m) / strands;
        let member = rope(&path, length_m).with_stiffness(stiffness_n);
        let system = system(joints(), vec![member]);
        let at = [[0.0; 3], [-3.0, 0.0, -4.0], [0.0, 0.0, -depth_m]];
        let found = modes(&system, &at, None).unwrap();
        let up = strands * strands * stiffness_n / length_m / 3.0;
        let mut told = [G / depth_m, G / depth_m, up];
        told.sort_by(f64::total_cmp);
        for (found, told) in omega2(&found).iter().zip(told) {
            near(*found, told, 1e-12 * told);
        }
        // As long as a spring of this stiffness allows.
        let simulation = Simulation::new(&system, &at, Settings::default()).unwrap();
        near(simulation.longest_step_s(), 1.0 / up.sqrt(), 1e-12);
    }
}

/// A weight on an elastic rope that is let go at its unstretched length: `z(t) = −(m g L/EA) (1 − cos ωt)`.
#[test]
fn a_weight_bounces_on_an_elastic_rope() {
    let joints =
        vec![Joint::anchor("D", [0.0; 3]), Joint::anchor("E", [-3.0, 0.0, -4.0]), free("P", 3.0)];
    let system = system(joints, vec![rope(&[1, 0, 2], 6.0).with_stiffness(300.0)]);
    let at = [[0.0; 3], [-3.0, 0.0, -4.0], [0.0, 0.0, -1.0]];
    let settings = Settings { order: Order::Fourth, ..Settings::default() };
    let mut weight = Simulation::new(&system, &at, settings).unwrap();
    let omega = (300.0_f64 / 6.0 / 3.0).sqrt();
    for _ in 0..1000 {
        weight.step(2e-3).unwrap();
    }
    near(weight.joints_m()[2][2], -1.0 - 0.06 * G * (1.0 - (2.0 * omega).cos()), 1e-8);
    near(weight.snapshot().axial_n[0], 3.0 * G * (1.0 - (2.0 * omega).cos()), 1e-6);
}

#[test]
fn slack_ropes_are_not_there() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [4.0, 0.0, 0.0]),
        Joint::anchor("C", [2.0, 0.0, 1.0]),
        free("P", 10.0),
    ];
    let at = [[0.0; 3], [4.0, 0.0, 0.0], [2.0, 0.0, 1.0], [2.0, 0.0, -1.0]];
    let cable = Member::cable(2, 3, Bar::homogeneous(2.0, 0.0).unwrap());
    for slack in [rope(&[0, 3, 1], 9.0), rope(&[0, 3, 1, 0], 12.0).with_stiffness(10.0)] {
        let found = modes(&system(joints.clone(), vec![slack, cable.clone()]), &at, None).unwrap();
        assert_eq!(found.modes.len(), 2);
        for found in omega2(&found) {
            near(found, G / 2.0, 1e-13);
        }
    }
    let just = rope(&[0, 3, 1], 2.0 * 5.0_f64.sqrt());
    let system = system(joints, vec![just, cable]);
    let refused = modes(&system, &at, Some(&[0.0, 10.0 * G])).unwrap_err();
    assert!(matches!(refused, MotionError::NeitherTautNorSlack { member: 1, .. }), "{refused}");
}

/// 3 kg fall 1 m until the rope over two pulleys is taut and lifts 2 kg from the floor: both move on with
/// 3/5 of the speed, and 2/5 of the energy are lost.
#[test]
fn a_rope_that_becomes_taut_lifts_a_weight() {
    let (weights, mut at) = atwood();
    let weights = weights.with_floor(-2.5).unwrap();
    at[2][2] = -0.5;
    let mut fall = Simulation::new(&weights, &at, Settings::default()).unwrap();
    assert!(motion::has_impacts(&weights));
    for _ in 0..600 {
        fall.step(1e-3).unwrap();
    }
    let [impact] = fall.impacts() else { panic!("{:?}", fall.impacts()) };
    let taut_s = (2.0 / G).sqrt();
    near(impact.time_s, taut_s, 1e-11);
    near(impact.lost_j, 0.4 * 3.0 * G, 1e-9);
    assert_eq!(impact.closed, [Contact::Member(0)]);
    let left_s = 0.6 - taut_s;
    let down_m = 0.6 * (2.0 * G).sqrt() * left_s + G / 10.0 * left_s * left_s;
    near(fall.joints_m()[2][2], -1.5 - down_m, 1e-9);
    near(fall.joints_m()[3][2], -2.5 + down_m, 1e-9);
}

/// Three masses on a rope that is slack between impacts, whichever of them it runs over: every impact takes energy,
/// what is left changes by the error of the steps alone, and the rope is never longer than it is.
#[test]
fn impacts_on_a_rope_take_energy() {
    let mut impacts = 0;
    for path in [[1, 3, 0, 2], [1, 2, 0, 3], [2, 1, 0, 3], [3, 2, 0, 1], [2, 3, 0, 1], [3, 0, 1, 2]]
    {
        let joints = vec![
            Joint::anchor("A", [6.0, 0.0, 0.0]),
            free("P", 4.7),
            free("Q", 2.5),
            free("M", 6.6),
        ];
        let at = [[6.0, 0.0, 0.0], [4.26, 2.02, -3.35], [7.67, 0.02, 1.63], [5.4, 1.82, -1.33]];
        let length = |at: &[Vector]| -> f64 {
            let span = |pair: &[usize]| {
                (0..3).map(|k| (at[pair[1]][k] - at[pair[0]][k]).powi(2)).sum::<f64>()
            };
            path.windows(2).map(|pair| span(pair).sqrt()).sum()
        };
        let length_m = 15.0_f64.max(length(&at) + 0.4);
        let system = system(joints, vec![rope(&path, length_m)]);
        let mut thrown = Simulation::new(&system, &at, Settings::default()).unwrap();
        let begin_j = thrown.energy_j();
        for _ in 0..2000 {
            if let Err(stop) = thrown.step(1e-3) {
                assert!(matches!(stop, MotionError::Jammed(_)), "{path:?}: {stop}");
                break;
            }
            let now_m = length(&thrown.snapshot().joints_m);
            assert!(now_m < length_m * (1.0 + 1e-9), "{path:?}: {now_m}");
        }
        impacts += thrown.impacts().len();
        for impact in thrown.impacts() {
            assert!(impact.lost_j > -1e-9 * begin_j.abs(), "{path:?}: {impact:?}");
        }
        let kept_j = thrown.energy_j() + thrown.lost_j() - begin_j;
        assert!(kept_j.abs() < 1e-3 * begin_j.abs().max(thrown.lost_j()), "{path:?}: {kept_j}");
    }
    assert!(impacts >= 5, "{impacts}");
}

/// Two ropes over three joints of different masses at places and tensions that nothing is special of, with forces
/// that hold them there.
struct Tangle {
    at: Vec<Vector>,
    masses_kg: [f64; 3],
    paths: [Vec<usize>; 2],
    tensions_n: [f64; 2],
    stiffness_n: f64,
}

impl Tangle {
    fn new() -> Self {
        let at = vec![
            [0.1, -0.2, 0.3],
            [3.1, 0.4, 0.2],
            [1.2, 2.3, 0.7],
            [0.7, 0.5, -1.1],
            [1.9, 0.3, -1.6],
            [1.4, 1.3, -0.8],
        ];
        let paths = [vec![0, 3, 1, 4, 3, 2], vec![1, 4, 5, 0, 5]];
        Self { at, masses_kg: [1.3, 2.7, 0.6], paths, tensions_n: [17.0, 29.0], stiffness_n: 700.0 }
    }

    /// Sum of the distances along a path, and its gradient by the joints that move.
    fn length_m(path: &[usize], at: &[Vector]) -> (f64, DVector<f64>) {
        let (mut sum, mut gradient) = (0.0, DVector::zeros(3 * at.len()));
        for pair in path.windows(2) {
            let [a, b] = [at[pair[0]], at[pair[1]]].map(nalgebra::Vector3::from);
            let d = b - a;
            sum += d.norm();
            for k in 0..3 {
                gradient[3 * pair[0] + k] -= d[k] / d.norm();
                gradient[3 * pair[1] + k] += d[k] / d.norm();
            }
        }
        (sum, gradient.rows(9, 9).into_owned())
    }

    fn system(&self) -> System {
        let [held, elastic] = [0, 1].map(|k| Self::length_m(&self.paths[k], &self.at));
        let pulls = held.1 * self.tensions_n[0] + elastic.1 * self.tensions_n[1];
        let mut joints: Vec<Joint> =
            (0..3).map(|k| Joint::anchor(format!("A{k}"), self.at[k])).collect();
        joints.extend((0..3).map(|k| {
            let weight_n = self.masses_kg[k] * G;
            let force_n = [pulls[3 * k], pulls[3 * k + 1], pulls[3 * k + 2] + weight_n];
            free(&format!("P{k}"), self.masses_kg[k]).with_force(force_n)
        }));
        let unstretched_m = elastic.0 / (1.0 + self.tensions_n[1] / self.stiffness_n);
        let elastic = rope(&self.paths[1], unstretched_m).with_stiffness(self.stiffness_n);
        system(joints, vec![rope(&self.paths[0], held.0), elastic])
    }

    /// `ω²` of the second differences of the lengths, on what keeps the first rope's.
    fn told(&self) -> DVector<f64> {
        let [(_, held), (length_m, elastic)] =
            [0, 1].map(|k| Self::length_m(&self.paths[k], &self.at));
        let unstretched_m = length_m / (1.0 + self.tensions_n[1] / self.stiffness_n);
        let mut stiffness = &elastic * elastic.transpose() * (self.stiffness_n / unstretched_m);
        let h = 1e-5;
        for column in 0..9 {
            for (path, tension_n) in self.paths.iter().zip(self.tensions_n) {
                let moved = |by: f64| {
                    let mut at = self.at.clone();
                    at[3 + column / 3][column % 3] += by;
                    Self::length_m(path, &at).1
                };
                let change = (moved(h) - moved(-h)) * (tension_n / (2.0 * h));
                let mut column = stiffness.column_mut(column);
                column += change;
            }
        }
        let root = DVector::from_fn(9, |k, _| self.masses_kg[k / 3].sqrt().recip());
        let root = DMatrix::from_diagonal(&root);
        let normal = (&root * held).normalize();
        let kept = DMatrix::identity(9, 9) - &normal * normal.transpose();
        // What does not keep the length is moved far up.
        let all = &kept * &root * stiffness * &root * &kept + &normal * normal.transpose() * 1e9;
        let mut values = SymmetricEigen::new(all).eigenvalues;
        values.as_mut_slice().sort_by(f64::total_cmp);
        values.rows(0, 8).into_owned()
    }
}

#[test]
fn modes_are_those_of_second_differences_of_lengths() {
    let tangle = Tangle::new();
    let (system, told) = (tangle.system(), tangle.told());
    let found = modes(&system, &tangle.at, None).unwrap();
    assert_eq!(found.modes.len(), 8);
    for (found, told) in omega2(&found).iter().zip(told.iter()) {
        near(*found, *told, 1e-7 * told.abs());
    }
    assert_eq!(found.index(), told.iter().filter(|o| **o < 0.0).count());
    let joints_m: Vec<_> = tangle.at.iter().map(|x| x.map(Interval::point)).collect();
    let axial_n = tangle.tensions_n.map(Interval::point);
    let equilibrium = EquilibriumBox { joints_m: &joints_m, axial_n: &axial_n, turns: 0 };
    let proved = enclose_modes(&system, &equilibrium).unwrap();
    for (interval, told) in proved.omega2_s2.iter().zip(told.iter()) {
        near(interval.mid(), *told, 1e-7 * told.abs());
        assert!(interval.width() < 1e-9 * told.abs(), "{interval:?}");
    }
}

/// Rings along a rope, each held by a spring too: the lowest modes by the sparse factorisation are those by dense
/// linear algebra.
#[test]
fn the_lowest_modes_of_many_rings() {
    let n = 80_usize;
    let place = |k: usize| -> Vector {
        let s = k as f64 / (n + 1) as f64;
        [30.0 * s, (7.0 * s).sin(), -8.0 * s * (1.0 - s) + 0.1 * (19.0 * s).cos()]
    };
    let at: Vec<Vector> = (0..=n + 1).map(place).chain([[15.0, 0.0, 20.0]]).collect();
    let path: Vec<usize> = (0..=n + 1).collect();
    let norm = |d: Vector| d.iter().map(|x| x * x).sum::<f64>().sqrt();
    let unit = |a: usize, b: usize| {
        let d: Vector = std::array::from_fn(|k| at[b][k] - at[a][k]);
        (norm(d), d.map(|x| x / norm(d)))
    };
    let (tension_n, spring_n) = (100.0, 3.0);
    let joints = (0..n + 3).map(|k| {
        if k == 0 || k > n {
            return Joint::anchor(format!("A{k}"), at[k]);
        }
        let [before, after, up] = [unit(k - 1, k).1, unit(k, k + 1).1, unit(k, n + 2).1];
        let mass_kg = 1.0 + 0.01 * k as f64;
        let force: Vector =
            std::array::from_fn(|i| tension_n * (before[i] - after[i]) - spring_n * up[i]);
        let force = [force[0], force[1], force[2] + mass_kg * G];
        free(&format!("P{k}"), mass_kg).with_force(force)
    });
    let length_m: f64 = (0..=n).map(|k| unit(k, k + 1).0).sum();
    for stiffness_n in [None, Some(1e4)] {
        let stretch = 1.0 + stiffness_n.map_or(0.0, |k| tension_n / k);
        let long = rope(&path, length_m / stretch).with_stiffness(stiffness_n);
        let springs = (1..=n).map(|k| {
            let body = Bar::homogeneous(unit(k, n + 2).0 / 1.01, 0.0).unwrap();
            Member::bar(n + 2, k, body).with_stiffness(100.0 * spring_n)
        });
        let system =
            system(joints.clone().collect(), std::iter::once(long).chain(springs).collect());
        let all = omega2(&modes(&system, &at, None).unwrap());
        let lowest = omega2(&lowest_modes(&system, &at, None, 5).unwrap());
        assert_eq!((all.len(), lowest.len()), (3 * n - usize::from(stiffness_n.is_none()), 5));
        for (found, told) in lowest.iter().zip(&all) {
            near(*found, *told, 1e-8 * told.abs());
        }
    }
}
