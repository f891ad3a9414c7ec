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
