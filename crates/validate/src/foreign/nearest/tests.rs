//! How far an answer is from an equilibrium, by hand.

use super::super::tests::lamp;
use super::*;
use crate::systems::placed::placed;

#[test]
fn the_largest_has_its_number() {
    let of = |values: &[f64]| largest(values.iter().copied().zip(1..));
    assert_eq!(of(&[]), (0.0, 0));
    assert_eq!(of(&[0.0, 0.0]), (0.0, 0));
    assert_eq!(of(&[1.0, 3.0, 3.0, 2.0]), (3.0, 2));
    let (most, at) = of(&[1.0, f64::NAN, 9.0]);
    assert!(most.is_nan() && at == 2);
}

/// The lamp (2, -1, 2) m off, with 1/4 N too much in one cable and 3/4 N too little in the other.
#[test]
fn an_answer_is_measured_against_the_equilibrium() {
    let system = lamp();
    let at = |lamp_m: Vector, axial_n: [f64; 2]| {
        let joints_m = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], lamp_m];
        placed(&system, &SolverName::new("a table"), &joints_m, &axial_n)
    };
    let right = at([0.0, 0.0, -4.0], [1.25; 2]);
    let off = at([2.0, -1.0, -2.0], [1.5, 0.5]);
    let found = measure(&system, &off, right.clone(), Some(true));
    assert_eq!((found.joint, found.member, found.forces_unique), (2, 2, Some(true)));
    assert!((found.joints_m - 3.0).abs() < 1e-15 && (found.forces_n - 0.75).abs() < 1e-15);
    assert!((found.energy_j - 4.0).abs() < 1e-14 && found.proved.is_none(), "{found:?}");
    assert_eq!(apart_m(&off, &right, &[false; 3]).1, 2);
    assert_eq!(apart_m(&off, &right, &[false, false, true]), (0.0, 0));
}

/// What is no further apart than the answer is known is one equilibrium.
#[test]
fn two_that_are_one_are_compared() {
    let system = lamp();
    let settings = energy::net::Settings::default();
    let first = energy::net::minimise(&system, &settings).unwrap().equilibrium;
    let agreed = |apart_m: f64| {
        let mut second = first.clone();
        second.joints_m[2][1] += apart_m;
        let mut both = [first.clone(), second];
        judged(&system, &mut both, 0.25);
        both.map(|one| match one.evidence.ladder.agreed.reason() {
            Some(model::Reason::OneSolverOnly { .. } | model::Reason::JudgeRefuses { .. }) => false,
            Some(model::Reason::SolversDisagree(_)) | None => true,
            other => panic!("{other:?}"),
        })
    };
    assert_eq!(agreed(0.0), [true; 2]);
    assert_eq!(agreed(0.24), [true; 2]);
    assert_eq!(agreed(0.26), [false; 2]);
}
