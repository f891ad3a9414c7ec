//! Widths of boxes in the units of the system.

use model::system::System;

use super::super::tests::lamp;
use super::*;

/// The lamp with a mass times a power of two, its forces and the box's too: the same relative
/// width, by hand the larger of that of the places over 6 m, the distance of the anchors, and that
/// of the forces over the weight of 2 N.
#[test]
fn widths_are_parts_of_the_size_and_of_the_largest_force() {
    for scale in [2.0_f64.powi(-20), 1.0, 2.0_f64.powi(20)] {
        let (system, mut answer) = lamp();
        let mut joints = system.joints().to_vec();
        joints[2].mass_kg *= scale;
        let system = System::new("lamp", 10.0, joints, system.members().to_vec()).unwrap();
        for forces in
            [&mut answer.start_forces_n, &mut answer.end_forces_n, &mut answer.reactions_n]
        {
            forces.iter_mut().flatten().for_each(|x| *x *= scale);
        }
        answer.axial_n.iter_mut().for_each(|x| *x *= scale);
        answer.energy_j *= scale;
        let mut answers = [answer];
        verify(&system, &mut answers);
        let proof = answers[0].evidence.ladder.verified.proof().unwrap();
        let of_system = proof.system.unwrap();
        let wanted = (of_system.width_m / 6.0).max(of_system.width_n / (2.0 * scale));
        assert!((proof.box_width / wanted - 1.0).abs() < 1e-12, "{scale}: {proof:?}");
        assert!(proof.box_width > 0.0 && proof.box_width < 1e-12, "{scale}: {proof:?}");
    }
}

/// The lamp's bars have 10 m and its largest force is 2 N: 1e-10 of the one and 1e-9 of the other may
/// be off.
#[test]
fn an_answer_may_be_off_its_box_by_what_two_may_differ() {
    let (system, right) = lamp();
    let proof = prove(&system, &right.joints_m, &right.axial_n).unwrap();
    let held = |change: &dyn Fn(&mut SystemEquilibrium)| {
        let mut answer = right.clone();
        change(&mut answer);
        held_against(&system, &proof, &answer)
    };
    let distance = held(&|_| ()).proof().unwrap().distance;
    assert!(distance < 1e-15, "{distance:e}");
    for sign in [1.0, -1.0] {
        let near = held(&|a| a.joints_m[2][1] += sign * 0.9e-9);
        assert!((near.proof().unwrap().distance / 0.9e-10 - 1.0).abs() < 1e-4, "{near:?}");
        let far = held(&|a| a.joints_m[2][1] += sign * 1.1e-9);
        let Some(Reason::NoBox(NoBox::Elsewhere { distance_m, distance_n })) = far.reason() else {
            panic!("{far:?}")
        };
        assert!((distance_m / 1.1e-9 - 1.0).abs() < 1e-4 && *distance_n < 1e-14);
        let near = held(&|a| a.axial_n[1] += sign * 1.9e-9);
        let found = near.proof().unwrap().system.unwrap();
        assert!((found.distance_n / 1.9e-9 - 1.0).abs() < 1e-4, "{found:?}");
        assert!(!held(&|a| a.axial_n[1] += sign * 2.1e-9).is_reached());
    }
    assert!(!held(&|a| a.axial_n[0] = f64::NAN).is_reached());
    assert!(!held(&|a| a.joints_m[2][0] = f64::NAN).is_reached());
}

/// Two answers of one box share its proof; one that is elsewhere gets none by it.
#[test]
fn answers_are_proved_one_by_one() {
    let (system, right) = lamp();
    let mut off = right.clone();
    off.joints_m[2][2] += 0.5;
    let mut answers = [right.clone(), right.clone(), off, right];
    verify(&system, &mut answers);
    let reached = answers.map(|answer| answer.evidence.ladder.verified.is_reached());
    assert_eq!([reached[0], reached[1], reached[3]], [true; 3]);
    assert!(!reached[2]);
}
