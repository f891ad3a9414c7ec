//! The quadratic function below the energy, against the energy itself.

use model::Bar;
use model::system::Joint;

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
