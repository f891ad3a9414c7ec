//! Violations in units by hand.

use model::Bar;
use model::system::Joint;

use super::super::tests::lamp;
use super::*;

/// A spring of 1 m at its length, without any load: the only size that its energy has is what the
/// rounding of its places costs, 8 units in the last place of 1 m times 2^50 N: 2 J.
#[test]
fn the_energy_of_a_spring_is_known_to_the_rounding_of_its_places() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P")];
    let body = Bar::homogeneous(1.0, 0.0).unwrap();
    let spring = Member::bar(0, 1, body).with_stiffness(2.0_f64.powi(50));
    let system = System::new("spring", 10.0, joints, vec![spring]).unwrap();
    let (_, like) = lamp();
    let derived = |energy_j: f64, down_m: f64| {
        let answer = SystemEquilibrium {
            energy_j,
            joints_m: vec![[0.0; 3], [0.0, 0.0, -down_m]],
            start_forces_n: vec![[0.0; 3]],
            end_forces_n: vec![[0.0; 3]],
            axial_n: vec![0.0],
            reactions_n: vec![[0.0; 3]; 2],
            ..like.clone()
        };
        energy(&system, &answer, &Units::new(&system, &answer))
    };
    assert_eq!(derived(0.5, 1.0).to_bits(), f64::to_bits(0.25));
    assert_eq!(derived(0.0, 1.0).to_bits(), 0);
    // Half a metre longer it has 2^47 J, beside which 3 J of rounding are nothing.
    let stretched = derived(0.0, 1.5);
    assert!((stretched - 1.0).abs() < 1e-13, "{stretched}");
}

/// Forces across a cable of 5 m at both ends turn it: 5 m times the force, of its largest force
/// times 5 m.
#[test]
fn a_moment_is_a_part_of_the_force_times_the_length() {
    let (system, mut answer) = lamp();
    answer.start_forces_n[0][1] += 1e-3;
    answer.end_forces_n[0][1] -= 1e-3;
    let found = judge(&system, &answer);
    let wanted = 1e-3 / 1.25_f64.hypot(1e-3);
    assert!((found.moment - wanted).abs() < 1e-14, "{found:?}");
    assert!(found.force < 1e-15, "{found:?}");
}

/// A spring of 1 m and 6 N that is drawn to 1.4 m has 2.4 N, not 3.
#[test]
fn a_wrong_elongation_is_a_part_of_the_force() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(0.3)];
    let spring = Member::bar(0, 1, Bar::homogeneous(1.0, 0.0).unwrap()).with_stiffness(6.0);
    let system = System::new("spring", 10.0, joints, vec![spring]).unwrap();
    let (_, like) = lamp();
    let answer = SystemEquilibrium {
        energy_j: -4.2 + 0.48,
        joints_m: vec![[0.0; 3], [0.0, 0.0, -1.4]],
        start_forces_n: vec![[0.0, 0.0, 3.0]],
        end_forces_n: vec![[0.0, 0.0, -3.0]],
        axial_n: vec![3.0],
        reactions_n: vec![[0.0, 0.0, 3.0], [0.0; 3]],
        ..like
    };
    let found = judge(&system, &answer);
    assert!((found.law - 0.2).abs() < 1e-14 && found.worst == Place::Member(1), "{found:?}");
    assert!(
        [found.force, found.moment, found.joint, found.balance, found.derived]
            .iter()
            .all(|x| *x < 1e-14),
        "{found:?}"
    );
}

/// A short spring of 2^40 N at its length: places are stored to 8 units in the last place of it,
/// which are 2^-9 N, however short.
#[test]
fn the_force_of_a_short_spring_is_known_to_the_rounding_of_its_ends() {
    let length_m = 2.0_f64.powi(-10);
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P")];
    let body = Bar::homogeneous(length_m, 0.0).unwrap();
    let spring = Member::bar(0, 1, body).with_stiffness(2.0_f64.powi(40));
    let system = System::new("spring", 10.0, joints, vec![spring]).unwrap();
    let (_, like) = lamp();
    let law = |axial_n: f64| {
        let answer = SystemEquilibrium {
            energy_j: 0.0,
            joints_m: vec![[0.0; 3], [0.0, 0.0, -length_m]],
            start_forces_n: vec![[0.0; 3]],
            end_forces_n: vec![[0.0; 3]],
            axial_n: vec![axial_n],
            reactions_n: vec![[0.0; 3]; 2],
            ..like.clone()
        };
        judge(&system, &answer).law
    };
    let explained = 2.0_f64.powi(-9);
    assert_eq!(law(0.75 * explained).to_bits(), 0);
    assert!(law(1.25 * explained) > 0.99);
}
