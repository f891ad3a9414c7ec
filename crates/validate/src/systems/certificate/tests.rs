//! The quadratic function below the energy, against the energy itself.

use model::Bar;
use model::system::{Joint, Kind};

use super::super::tests::lamp;
use super::*;

/// The potential of a member at a distance, J: none of a rigid one that keeps its length.
fn potential_j(stiffness_n: f64, length_m: f64, distance_m: f64) -> f64 {
    0.5 * stiffness_n / length_m * (distance_m - length_m).powi(2)
}

#[test]
fn the_tangent_of_a_spring_touches_its_potential_and_stays_below() {
    let (length_m, stiffness_n) = (2.0, 300.0);
    let spring =
        Member::bar(0, 1, Bar::homogeneous(length_m, 0.0).unwrap()).with_stiffness(stiffness_n);
    for distance_m in [1.2, 1.9, 2.0, 2.3, 4.0] {
        let density = stiffness_n / length_m * (distance_m - length_m) / distance_m;
        let at = |d: f64| tangent_j(&spring, density, d * d);
        let (value_j, size_j) = at(distance_m);
        let exact_j = potential_j(stiffness_n, length_m, distance_m);
        assert!((value_j - exact_j).abs() < 1e-12 * (1.0 + exact_j), "{distance_m}");
        // What is rounded on the way is larger than what comes out.
        assert!(size_j >= value_j.abs() && size_j < 40.0 * stiffness_n, "{distance_m}: {size_j}");
        for other in [0.5, 1.0, 1.7, 2.6, 5.0] {
            assert!(at(other).0 <= potential_j(stiffness_n, length_m, other) + 1e-11);
        }
    }
}

/// Of a rigid member it is the work of the density: zero at its length, its slope half of it.
#[test]
fn the_tangent_of_a_rigid_member_is_zero_at_its_length() {
    let rod = Member::bar(0, 1, Bar::homogeneous(3.0, 0.0).unwrap());
    for density in [-2.0, 4.0] {
        let at = |d: f64| tangent_j(&rod, density, d * d);
        assert!(at(3.0).0.abs() < 1e-14);
        assert!((at(5.0).0 - 8.0 * density).abs() < 1e-13);
        assert!((at(5.0).1 - 17.0 * density.abs()).abs() < 1e-13);
    }
}

#[test]
fn the_unit_of_elastic_energy_doubles_all_lengths() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("B"), Joint::free("C")];
    let member = |from, to, l| Member::bar(from, to, Bar::homogeneous(l, 1.0).unwrap());
    let members = vec![
        member(0, 1, 2.0).with_stiffness(300.0),
        member(1, 2, 5.0),
        member(0, 2, 4.0).with_stiffness(100.0),
    ];
    let system = System::new("springs", 9.81, joints, members).unwrap();
    // 300 / 2 · 2² / 2 + 100 / 4 · 4² / 2
    assert!((elastic_unit_j(&system) - 500.0).abs() < 1e-12);
}

/// A spring of 2 m and 300 N at twice its length: 150 N/m stretch it by 2 m, and its density is
/// 75 N/m. What is rounded: 150 · 2 · (2 + 4) of the spring, 75 / 2 · (16 + 16) of the tangent.
#[test]
fn what_is_rounded_in_a_tangent_is_the_size_of_its_terms() {
    let spring = Member::bar(0, 1, Bar::homogeneous(2.0, 0.0).unwrap()).with_stiffness(300.0);
    assert_eq!(tangent_j(&spring, 75.0, 16.0).1.to_bits(), f64::to_bits(1800.0 + 1200.0));
    assert_eq!(tangent_j(&spring, 75.0, 16.0).0.to_bits(), f64::to_bits(300.0));
}

/// A path A-P-Q-B, A and B anchors, with the densities 2, 3 and 5.
#[test]
fn the_stress_matrix_is_that_of_the_joints_that_move() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P"),
        Joint::free("Q"),
        Joint::anchor("B", [2.0, 0.0, 0.0]),
    ];
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let members = (0..3).map(|k| Member::bar(k, k + 1, bar)).collect();
    let system = System::new("path", 9.81, joints, members).unwrap();
    let matrix = stress_matrix(&system, &[2.0, 3.0, 5.0]);
    assert_eq!((matrix.size, matrix.diagonal), (2, vec![5.0, 8.0]));
    assert_eq!(matrix.below, [(1, 0, -3.0)]);
    // Two members in a joint: 2 · 4 roundings of half a unit of 8, the sum of the largest row.
    assert!((matrix.uncertainty / (2.0 * 4.0 * 0.5 * f64::EPSILON * 8.0) - 1.0).abs() < 1e-9);
}

/// The lamp's tangent touches at its energy: the cables have their lengths, and what is left is the
/// work of 2 N over 4 m. From below, by 16 units in the last place of what was rounded: 2 · 25/4 J
/// of the cables and 2 N over the 5 m from A.
#[test]
fn the_bound_is_below_its_value_by_what_is_rounded() {
    let (system, answer) = lamp();
    let (value_j, squared_gradient) = tangent(&system, &answer, &[0.25; 2]);
    let below_j = -8.0 - value_j;
    let rounded_j = 16.0 * f64::EPSILON * (2.0 * 6.25 + 10.0);
    assert!((below_j / rounded_j - 1.0).abs() < 0.1, "{below_j:e} {rounded_j:e}");
    // The joint that moves has no gradient but that of rounding: the load of 2 N, two pulls of
    // 1.25 N, and two more units for the two members that meet there.
    let size_n = 18.0 * f64::EPSILON * 4.5;
    assert!(squared_gradient >= size_n * size_n * 0.999);
    assert!(squared_gradient <= size_n * size_n * 1.2);
}

/// A weight of 2 N that lies 3 m below its anchor on a floor has -6 J, whatever the floor pushes.
#[test]
fn the_push_of_a_floor_takes_no_energy() {
    let joints = vec![Joint::anchor("A", [0.0, 0.0, 2.0]), Joint::free("P").with_mass(0.2)];
    let members = vec![Member::cable(0, 1, Bar::homogeneous(5.0, 0.0).unwrap())];
    let system = System::new("lying", 10.0, joints, members).unwrap().with_floor(-1.0).unwrap();
    let answer = SystemEquilibrium {
        energy_j: -6.0,
        joints_m: vec![[0.0, 0.0, 2.0], [0.5, 0.0, -1.0]],
        start_forces_n: vec![[0.0; 3]],
        end_forces_n: vec![[0.0; 3]],
        axial_n: vec![0.0],
        reactions_n: vec![[0.0; 3], [0.0, 0.0, 2.0]],
        ..lamp().1
    };
    let (value_j, squared_gradient) = tangent(&system, &answer, &[0.0]);
    assert!(value_j < -6.0 && value_j > -6.0 - 1e-12, "{}", value_j);
    assert!(squared_gradient < 1e-26);
}

#[test]
fn what_does_not_fit_or_is_not_finite_is_unusable() {
    let (system, right) = lamp();
    assert!(certify(&system, &right).is_ok());
    let changes: [fn(&mut SystemEquilibrium); 7] = [
        |a| a.joints_m.truncate(2),
        |a| a.axial_n.truncate(1),
        |a| a.reactions_n.truncate(1),
        |a| a.joints_m[2][1] = f64::NAN,
        |a| a.axial_n[1] = f64::INFINITY,
        |a| a.energy_j = f64::NAN,
        |a| a.energy_j = f64::NEG_INFINITY,
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let mut answer = right.clone();
        change(&mut answer);
        assert_eq!(certify(&system, &answer), Err(NoCertificate::Unusable), "{k}");
    }
}

/// A millionth of a newton too much in each cable leaves 1.6e-6 N upwards at the lamp. With the
/// least eigenvalue 1/2 of the two densities, half of which is proved or more, that costs no more
/// than the square of it over 1/2, in the unit of 12 J.
#[test]
fn a_small_gradient_costs_its_square_over_the_eigenvalue() {
    let (system, mut answer) = lamp();
    answer.axial_n = vec![1.25 + 1e-6; 2];
    let gap = certify(&system, &answer).unwrap().gap.unwrap();
    let square = 1.6e-6_f64.powi(2);
    assert!(gap >= square / 12.0 && gap <= square / 0.5 / 12.0 + 1e-14, "{gap:e}");
}

/// The crooked bar: 20 N of its 80 N and five eighths of (5, -6, 4) N are B's, with (2, -1, 4) N and
/// 30 N.
#[test]
fn loads_and_sizes_are_those_of_the_lever_rule() {
    use super::super::statics::tests::crooked;
    let (system, mut answer) = crooked(|_, _| ());
    let loads = system.joint_loads_n();
    assert_eq!(loads, [[1.875, -2.25, -58.5], [5.125, -4.75, -43.5]]);
    let total = 21.0_f64.sqrt() + 77.0_f64.sqrt() + 110.0;
    assert!((system.total_load_n() / total - 1.0).abs() < 1e-15);
    assert_eq!(size_m(&system, &answer).to_bits(), 8.0_f64.to_bits());
    answer.joints_m[1] = [5.0, 4.0, 17.0];
    assert_eq!(size_m(&system, &answer).to_bits(), 14.0_f64.to_bits());
    let largest = |answer: &SystemEquilibrium| largest_force_n(answer);
    assert!((largest(&answer) / 339.0_f64.sqrt() - 1.0).abs() < 1e-15);
    answer.start_forces_n[0] = [30.0, 0.0, 40.0];
    assert_eq!(largest(&answer).to_bits(), 50.0_f64.to_bits());
    answer.reactions_n[0] = [0.0, 60.0, 80.0];
    assert_eq!(largest(&answer).to_bits(), 100.0_f64.to_bits());
}

/// 14 N over 7 m; a cable's is not negative, a strut's not positive, and none is known where the
/// ends meet.
#[test]
fn densities_are_forces_over_distances() {
    use super::super::statics::tests::crooked;
    for (kind, pulls, pushes) in
        [(Kind::Bar, 2.0, -2.0), (Kind::Cable, 2.0, 0.0), (Kind::Strut, 0.0, -2.0)]
    {
        let (system, mut answer) = crooked(|_, bar| bar.kind = kind);
        for (axial_n, density) in [(14.0, pulls), (-14.0, pushes)] {
            answer.axial_n[0] = axial_n;
            assert!((densities(&system, &answer)[0] - density).abs() < 1e-15, "{kind:?}");
        }
        answer.joints_m[1] = answer.joints_m[0];
        assert_eq!(densities(&system, &answer)[0].to_bits(), 0);
    }
}

#[test]
fn the_most_members_meet_in_one_joint() {
    let joints = ["A", "B", "C", "D"].map(Joint::free).to_vec();
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let system = |ends: &[(usize, usize)]| {
        let members = ends.iter().map(|(from, to)| Member::bar(*from, *to, bar)).collect();
        let mut joints = joints.clone();
        joints[0] = Joint::anchor("A", [0.0; 3]);
        System::new("degrees", 10.0, joints, members).unwrap()
    };
    assert_eq!(largest_degree(&system(&[(0, 1), (1, 2), (2, 3)])), 2);
    assert_eq!(largest_degree(&system(&[(0, 2), (1, 2), (2, 3)])), 3);
    assert_eq!(largest_degree(&system(&[(3, 0), (3, 1), (3, 2), (0, 1)])), 3);
}

/// Upside down both bars of the lamp are pressed.
#[test]
fn all_members_that_push_are_counted() {
    let (system, mut answer) = lamp();
    let members = system.members().iter().map(|m| m.clone().of_kind(Kind::Bar));
    let members = members.collect();
    let system = System::new("arch", 10.0, system.joints().to_vec(), members).unwrap();
    answer.joints_m[2][2] = 4.0;
    answer.axial_n = vec![-1.25; 2];
    answer.energy_j = 8.0;
    assert_eq!(certify(&system, &answer), Err(NoCertificate::NotDefinite { compressed: 2 }));
}
