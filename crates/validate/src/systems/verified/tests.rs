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
