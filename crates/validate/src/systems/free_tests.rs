//! Joints that an equilibrium leaves free, and parts that turn: closed forms, right and wrong.

use model::system::{Joint, Member, System, SystemEquilibrium};
use model::{Bar, SolverName, Vector};

use super::compare;
use super::compare::SystemAgreement;
use super::tests::{joined, lamp};
use super::turn::turned_onto;
use crate::tolerances::Tolerances;
use numerics::vector::{minus, norm};

/// Two answers that differ by the places of joints which nothing pulls.
fn compared(
    system: &System,
    first: SystemEquilibrium,
    mut second: SystemEquilibrium,
) -> SystemAgreement {
    second.solver = SolverName::ENERGY;
    compare(system, &mut [first, second], &Tolerances::project())
}

/// The lamp with a joint of `mass_kg` and light bars from it to some of the lamp's joints; in an
/// answer it is at `at_m`, with no force in its bars.
fn with_link(mass_kg: f64, to: &[usize], at_m: [Vector; 2]) -> (System, [SystemEquilibrium; 2]) {
    let (system, answer) = lamp();
    let mut joints = system.joints().to_vec();
    joints.push(Joint::free("M").with_mass(mass_kg));
    let mut members = system.members().to_vec();
    for joint in to {
        let length_m = norm(minus(answer.joints_m[*joint], at_m[0]));
        members.push(Member::bar(*joint, 3, Bar::homogeneous(length_m, 0.0).unwrap()));
    }
    let system = System::new("link", 10.0, joints, members).unwrap();
    let answers = at_m.map(|at_m| {
        let mut answer = answer.clone();
        joined(&mut answer, at_m, [0.0; 3], to.len());
        answer
    });
    (system, answers)
}

/// The joint of two light bars between the lamp at (0, 0, -4) and an anchor at (3, 0, 0) goes round
/// the line of these two: here from below it to beside it.
#[test]
fn a_joint_on_two_bars_without_force_is_free() {
    let (across, beside) = ([0.8, 0.0, -0.6], [0.0, 1.0, 0.0]);
    let place = |way: Vector| [0, 1, 2].map(|k| [1.5, 0.0, -2.0][k] + 2.0 * way[k]);
    let (system, [first, second]) = with_link(0.0, &[1, 2], [place(across), place(beside)]);
    let found = compared(&system, first.clone(), second);
    assert!(found.agrees(), "{}", found.disagreement);
    assert_eq!((found.free_joints, found.joints_m), (1, 0.0));
    // Not where the lengths are kept is not free, but wrong.
    let mut off = first.clone();
    off.joints_m[3][1] += 1e-3;
    assert!(!compared(&system, first, off).agrees());
}

/// Three bars hold a joint at one of two places, mirrored at the plane of their other ends: two
/// equilibria.
#[test]
fn a_joint_that_lengths_hold_is_not_free() {
    let at_m = [[0.5, 2.0, -1.0], [0.5, -2.0, -1.0]];
    let (system, [first, second]) = with_link(0.0, &[0, 1, 2], at_m);
    let found = compared(&system, first.clone(), second);
    assert!(!found.agrees() && found.free_joints == 0 && found.joints_m > 3.9);
    assert!(compared(&system, first.clone(), first).agrees());
}

/// Under a load the place counts, though the forces told are the same.
#[test]
fn a_loaded_joint_is_not_free() {
    let (across, beside) = ([0.8, 0.0, -0.6], [0.0, 1.0, 0.0]);
    let place = |way: Vector| [0, 1, 2].map(|k| [1.5, 0.0, -2.0][k] + 2.0 * way[k]);
    let (system, [first, second]) = with_link(1e-3, &[1, 2], [place(across), place(beside)]);
    let found = compared(&system, first, second);
    assert!(!found.agrees() && found.free_joints == 0);
}

/// A chain of light bars that no force draws straight: its inner joints are free together.
#[test]
fn joints_without_force_are_free_together() {
    let (system, answer) = lamp();
    let mut joints = system.joints().to_vec();
    joints.extend(["M", "N"].map(Joint::free));
    let mut members = system.members().to_vec();
    let bar = Bar::homogeneous(2.0, 0.0).unwrap();
    members.extend([(1, 3), (3, 4), (4, 2)].map(|(from, to)| Member::bar(from, to, bar)));
    let system = System::new("slack chain", 10.0, joints, members).unwrap();
    // A trapezium on the line of 5 m from the anchor to the lamp: (5 - 2)/2 = 1.5 along it.
    let height = (2.0_f64.powi(2) - 1.5_f64.powi(2)).sqrt();
    let at = |along: f64, way: Vector| -> Vector {
        [0, 1, 2].map(|k| [3.0, 0.0, 0.0][k] + along * [-0.6, 0.0, -0.8][k] + height * way[k])
    };
    let place = |way: Vector| {
        let mut answer = answer.clone();
        joined(&mut answer, at(1.5, way), [0.0; 3], 1);
        joined(&mut answer, at(3.5, way), [0.0; 3], 2);
        answer
    };
    let found = compared(&system, place([0.0, 1.0, 0.0]), place([0.8, 0.0, -0.6]));
    assert!(found.agrees(), "{}", found.disagreement);
    assert_eq!(found.free_joints, 2);
}

/// A hoop round a hanging rod: its two weights of 1 N are tied to both ends of the rod and to each
/// other. `angle` turns another hoop at the same ends, of other weights, against it.
fn hoops(angle: f64, heavier: f64) -> (System, SystemEquilibrium) {
    weighted_hoops(angle, [1.0, 1.0, heavier, heavier])
}

fn weighted_hoops(angle: f64, weights_n: [f64; 4]) -> (System, SystemEquilibrium) {
    let whole_n: f64 = weights_n.iter().sum();
    let side = 2.0_f64.sqrt() / 2.0;
    let names = ["A", "P", "Q", "S", "T", "U", "V"];
    let mut joints: Vec<Joint> = names.map(Joint::free).into();
    joints[0] = Joint::anchor("A", [0.0; 3]);
    for (joint, weight_n) in joints[3..].iter_mut().zip(weights_n) {
        joint.mass_kg = 0.1 * weight_n;
    }
    let bar = |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
    let mut members = vec![bar(0, 1, 1.0), bar(1, 2, 1.0)];
    // Tip k at half a metre from the rod, borne half from above, half from below.
    let mut axial_n = vec![whole_n, 0.5 * whole_n];
    for (tip, weight_n) in (3..).zip(weights_n) {
        members.extend([bar(1, tip, side), bar(2, tip, side)]);
        axial_n.extend([weight_n * side, -weight_n * side]);
    }
    members.extend([bar(3, 4, 1.0), bar(5, 6, 1.0)]);
    axial_n.extend([0.0, 0.0]);
    let system = System::new("hoops", 10.0, joints, members).unwrap();
    let (cos, sin) = (0.5 * angle.cos(), 0.5 * angle.sin());
    let joints_m = vec![
        [0.0; 3],
        [0.0, 0.0, -1.0],
        [0.0, 0.0, -2.0],
        [0.5, 0.0, -1.5],
        [-0.5, 0.0, -1.5],
        [cos, sin, -1.5],
        [-cos, -sin, -1.5],
    ];
    let pull = |k: usize| -> Vector {
        let along = minus(joints_m[system.members()[k].to], joints_m[system.members()[k].from]);
        along.map(|x| x * axial_n[k] / norm(along))
    };
    let end_forces_n: Vec<Vector> = (0..axial_n.len()).map(pull).collect();
    let mut reactions_n = vec![[0.0; 3]; 7];
    reactions_n[0] = [0.0, 0.0, whole_n];
    let answer = SystemEquilibrium {
        energy_j: -1.5 * whole_n,
        start_forces_n: end_forces_n.iter().map(|f| f.map(|x| -x)).collect(),
        end_forces_n,
        joints_m,
        axial_n,
        reactions_n,
        ..lamp().1
    };
    (system, answer)
}

/// The same with two bars of 1.41 m from anchors beside the rod: no anchor is on its vertical.
fn hoops_between_anchors(angle: f64, heavier: f64) -> (System, SystemEquilibrium) {
    between_anchors(weighted_hoops(angle, [1.0, 1.0, heavier, heavier]))
}

fn between_anchors(hoops: (System, SystemEquilibrium)) -> (System, SystemEquilibrium) {
    let (system, mut answer) = hoops;
    let places: [Vector; 2] = [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
    let mut joints = system.joints().to_vec();
    joints[0] = Joint::anchor("A", places[0]);
    joints.push(Joint::anchor("B", places[1]));
    let mut members = system.members().to_vec();
    let bar = Bar::homogeneous(2.0_f64.sqrt(), 0.0).unwrap();
    members[0] = Member::bar(0, 1, bar);
    members.push(Member::bar(7, 1, bar));
    let half_n = 0.5 * answer.reactions_n[0][2];
    let pulls: [Vector; 2] = [[-half_n, 0.0, half_n], [half_n, 0.0, half_n]];
    answer.joints_m[0] = places[0];
    answer.joints_m.push(places[1]);
    answer.start_forces_n[0] = pulls[0];
    answer.end_forces_n[0] = pulls[0].map(|x| -x);
    answer.axial_n[0] = norm(pulls[0]);
    answer.start_forces_n.push(pulls[1]);
    answer.end_forces_n.push(pulls[1].map(|x| -x));
    answer.axial_n.push(norm(pulls[1]));
    answer.reactions_n[0] = pulls[0];
    answer.reactions_n.push(pulls[1]);
    (System::new("hoops between anchors", 10.0, joints, members).unwrap(), answer)
}

/// Each hoop hangs on two joints of one vertical, none of them an anchor, and turns against the
/// other one.
#[test]
fn what_hinges_on_two_joints_of_one_vertical_turns() {
    type Hoops = fn(f64, f64) -> (System, SystemEquilibrium);
    let cases: [(Hoops, f64); 4] =
        [(hoops, 1.0), (hoops, 2.5), (hoops_between_anchors, 1.0), (hoops_between_anchors, 2.5)];
    for (hoops, heavier) in cases {
        let (system, first) = hoops(0.3, heavier);
        let (_, second) = hoops(1.9, heavier);
        let found = compared(&system, first.clone(), second);
        assert!(found.agrees() && found.joints_m < 1e-14, "{}", found.disagreement);
        assert!(found.turned_parts >= 2, "{}", found.turned_parts);
        // Hinged at other heights it is something else.
        let (_, mut other) = hoops(1.9, heavier);
        other.joints_m[5][2] += 1e-6;
        assert!(!compared(&system, first, other).agrees());
    }
}

/// Hoops of which each pulls the rod's ends aside by a billionth of a newton, in opposite
/// directions: less than forces are known to, but turned against each other they would be out of
/// balance. What hangs on the rod's upper end is turned as one.
#[test]
fn hoops_that_balance_each_other_are_turned_together() {
    let weights_n = [1.0 + 2e-9, 1.0, 1.0, 1.0 + 2e-9];
    let (system, second) = between_anchors(weighted_hoops(0.0, weights_n));
    let (_, first) = between_anchors(weighted_hoops(1.6, weights_n));
    assert!(super::judge(&system, &second).largest() < 1e-14);
    let (turned, parts) = turned_onto(&system, &first, &second, &[false; 8]);
    assert_eq!(parts, [1, 0]);
    assert!(super::judge(&system, &turned).largest() < 1e-14);
}
