//! Sizes by hand.

use model::Bar;
use model::system::{Joint, Member};

use super::super::statics::tests::crooked;
use super::super::tests::lamp;
use super::*;

/// The crooked bar (module `statics`): at A (1.875, -2.25, -58.5) N of its bar, at B (5.125, -4.75,
/// -43.5) N; the bar weighs 80 N, and all loads together are 110 N and the roots of 21 and 77.
#[test]
fn loads_give_forces_their_size() {
    let (system, mut answer) = crooked(|_, _| ());
    let scale = Scale::new(&system, &answer);
    let total_n = 21.0_f64.sqrt() + 77.0_f64.sqrt() + 110.0;
    assert!((scale.total_n / total_n - 1.0).abs() < 1e-15);
    assert_eq!(scale.joint_n, [80.0, 80.0]);
    assert!((scale.energy_j() / (8.0 * total_n) - 1.0).abs() < 1e-15);
    // No force of an answer changes any of it, and no place makes it larger than its bar allows.
    answer.axial_n[0] = 1e12;
    answer.end_forces_n[0] = [1e12; 3];
    answer.joints_m[1] = [1e9; 3];
    let absurd = Scale::new(&system, &answer);
    assert_eq!(absurd.joint_n, scale.joint_n);
    assert_eq!(absurd.size_m.to_bits(), 16.0_f64.to_bits());
}

/// A joint that carries nothing has the mean load: 2 N on three joints.
#[test]
fn a_joint_without_load_has_the_mean_load() {
    let (system, answer) = lamp();
    let scale = Scale::new(&system, &answer);
    assert_eq!(scale.joint_n, [2.0 / 3.0, 2.0 / 3.0, 2.0]);
    // Differences of forces count beside all that acts, or what meets, where nothing acts.
    let of = |total_n: f64| {
        let scale = Scale { total_n, ..scale.clone() };
        [1.0, 5.0, 1e9].map(|meet_n| scale.of_forces_n(meet_n))
    };
    assert_eq!([of(2.0), of(0.0)], [[2.0, 5.0, 2e6], [1.0, 5.0, 1e9]]);
}

/// Springs of 6 N and 1 m, drawn to 1.5 and 3 m: 3 N, and 6 N instead of 12.
#[test]
fn prestress_gives_forces_their_size_where_nothing_is_loaded() {
    let joints =
        vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [4.5, 0.0, 0.0]), Joint::free("P")];
    let spring =
        |from, to| Member::bar(from, to, Bar::homogeneous(1.0, 0.0).unwrap()).with_stiffness(6.0);
    let system = System::new("springs", 10.0, joints, vec![spring(0, 2), spring(2, 1)]).unwrap();
    let joints_m = vec![[0.0; 3], [4.5, 0.0, 0.0], [1.5, 0.0, 0.0]];
    let scale = Scale::new(&system, &SystemEquilibrium { joints_m, ..lamp().1 });
    assert_eq!((scale.total_n, scale.held_n), (9.0, 9.0));
    assert_eq!(scale.joint_n, [3.0, 6.0, 6.0]);
}

/// A rope of 16 m and 2^42 N over a ring with 3 N, 9 m along x from its reference, 2^20 m up: eight roundings are
/// 2^-29 m, two spans have 2^10 N of them, and the energy 3 N and 2^9 N times 2^-29 m. Shorter by 2^-22 of its length it
/// bears 2^20 N, and eight roundings of 16 m times that are 2^-25 J.
#[test]
fn coordinates_far_from_the_origin_leave_energies_open() {
    let far_m = 2.0_f64.powi(20) - 16.0;
    let stored = |stiffness_n: f64, length_m: f64| {
        let at = |x| [x, 0.0, far_m];
        let joints = samples::joints(&[at(0.0), at(16.0)], &[0.3]);
        let rope = Member::cable(0, 1, Bar::homogeneous(length_m, 0.0).unwrap()).over(vec![2]);
        let system = System::new("rope", 10.0, joints, vec![rope.with_stiffness(stiffness_n)]);
        let joints_m = vec![at(0.0), at(16.0), at(9.0)];
        let (system, answer) = (system.unwrap(), SystemEquilibrium { joints_m, ..lamp().1 });
        let scale = Scale::new(&system, &answer);
        assert_eq!((scale.size_m, scale.stored_m), (16.0, 2.0_f64.powi(-29)));
        (stored_n(&system.members()[0], scale.stored_m), scale.stored_j)
    };
    let (spring_n, stored_j) = stored(2.0_f64.powi(42), 16.0);
    assert_eq!(spring_n.to_bits(), f64::to_bits(1024.0));
    let coordinates_j = (3.0 + 512.0) * 2.0_f64.powi(-29);
    assert!((stored_j / coordinates_j - 1.0).abs() < 1e-3, "{stored_j} {coordinates_j}");
    let (_, stored_j) = stored(2.0_f64.powi(42), 16.0 / (1.0 + 2.0_f64.powi(-22)));
    let told_j = coordinates_j + 2.0_f64.powi(-25);
    assert!((stored_j / told_j - 1.0).abs() < 1e-3, "{stored_j} {told_j}");
    // No stiffness forgives more than a millionth of 3 N times 16 m.
    let (_, stored_j) = stored(2.0_f64.powi(80), 4.0);
    assert!((stored_j / (48e-6 + 3.0 * 2.0_f64.powi(-29)) - 1.0).abs() < 1e-12, "{stored_j}");
}
