//! Systems and checks that the tests of networks use.

use energy::net::{Settings, Solution, minimise};
use model::system::{Joint, Member, System};
use model::{Bar, Vector};

/// Gravity of the tests, m/s²: round numbers of newtons.
pub const G: f64 = 10.0;

/// Rounding of places and forces of order one: some units in the last place times the condition of
/// these small systems, at most some hundreds.
pub const ROUNDING: f64 = 1e-12;

pub fn bar(from: usize, to: usize, length_m: f64, mass_kg: f64) -> Member {
    Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).expect("a bar"))
}

pub fn solve(joints: Vec<Joint>, members: Vec<Member>) -> (System, Solution) {
    let system = System::new("test", G, joints, members).expect("a system");
    let solution = minimise(&system, &Settings::default()).expect("a minimum");
    check(&system, &solution);
    (system, solution)
}

/// What holds for every answer: a minimum, each length, the balance of each member and each joint,
/// by Newton's laws alone.
pub fn check(system: &System, solution: &Solution) {
    check_but(system, solution, &[], ROUNDING);
}

/// The same, to a part of the largest force and of each length, with some members slack or
/// stretched.
pub fn check_but(system: &System, solution: &Solution, slack: &[usize], rounding: f64) {
    let (found, gravity) = (&solution.equilibrium, system.gravity_m_s2());
    assert_eq!(found.stability.index_in_space, 0);
    let mut joint_n: Vec<Vector> = system
        .joints()
        .iter()
        .zip(&found.reactions_n)
        .map(|(joint, r)| {
            let f = joint.force_n;
            [r[0] + f[0], r[1] + f[1], r[2] + f[2] - joint.mass_kg * gravity]
        })
        .collect();
    let largest = found.axial_n.iter().fold(1.0, |most: f64, n| most.max(n.abs()));
    for (e, member) in system.members().iter().enumerate() {
        let (a, b) = (found.joints_m[member.from], found.joints_m[member.to]);
        let length = (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt();
        let misfit = length / member.body.length_m() - 1.0;
        let strain = member.stiffness_n.map_or(0.0, |stiffness| found.axial_n[e] / stiffness);
        let off = misfit - strain;
        assert!(slack.contains(&e) || off.abs() < rounding, "member {e}: {off:e}");
        let weight = member.body.mass_kg() * gravity;
        let (start, end) = (found.start_forces_n[e], found.end_forces_n[e]);
        for (k, own) in [0.0, 0.0, -weight].into_iter().enumerate() {
            let external = own + member.loads.iter().map(|load| load.force_n[k]).sum::<f64>();
            assert!((start[k] + end[k] + external).abs() < rounding * largest);
            joint_n[member.from][k] -= start[k];
            joint_n[member.to][k] -= end[k];
        }
    }
    for (joint, rest) in joint_n.iter().enumerate() {
        assert!(rest.iter().all(|r| r.abs() < rounding * largest), "joint {joint}: {rest:?}");
    }
}

pub fn close(a: f64, b: f64) {
    assert!((a - b).abs() < ROUNDING * b.abs().max(1.0), "{a} is not {b}");
}

/// A net of `n` x `n` joints hung from its corners, `span` of its side apart.
pub fn net(n: usize, span: f64) -> (Vec<Joint>, Vec<Member>) {
    let step = 1.0 / (n as f64 - 1.0);
    let (mut joints, mut members) = (Vec::new(), Vec::new());
    for i in 0..n {
        for j in 0..n {
            let at = [span * i as f64 * step, span * j as f64 * step, 0.0];
            let corner = (i == 0 || i == n - 1) && (j == 0 || j == n - 1);
            let name = format!("{i},{j}");
            joints.push(if corner { Joint::anchor(name, at) } else { Joint::free(name) });
            let here = i * n + j;
            if i + 1 < n {
                members.push(bar(here, here + n, step, step));
            }
            if j + 1 < n {
                members.push(bar(here, here + 1, step, step));
            }
        }
    }
    (joints, members)
}
