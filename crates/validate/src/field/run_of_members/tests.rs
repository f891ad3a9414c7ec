//! A run of four members.

use super::*;

/// 6 m with 3 N/m in four members of 1.5 m and 4.5 N from the origin to (4, 0, 2).
#[test]
fn a_run_has_the_length_and_the_weight_of_its_cable() {
    let cable =
        ElasticCatenary { x_m: 4.0, z_m: 2.0, length_m: 6.0, stiffness_n: 700.0, weight_n_m: 3.0 };
    let run = run_of_members(&cable, 4).unwrap();
    let places: Vec<_> = run.joints().iter().map(|joint| joint.support.at_m()).collect();
    assert_eq!(places, [Some([0.0; 3]), None, None, None, Some([4.0, 0.0, 2.0])]);
    for (k, member) in run.members().iter().enumerate() {
        assert_eq!((member.from, member.to, member.stiffness_n), (k, k + 1, Some(700.0)));
        assert!((member.body.length_m() - 1.5).abs() < 1e-15);
        assert!((member.body.mass_kg() * run.gravity_m_s2() - 4.5).abs() < 1e-14);
    }
    assert_eq!(run.members().len(), 4);
    assert_eq!((run.floor_m(), run_on_floor(&cable, 4).unwrap().floor_m()), (None, Some(0.0)));
}

#[test]
fn end_forces_are_those_of_the_first_and_the_last_joint() {
    let system = model::cases::exhibit("lamp").unwrap().system();
    let settings = energy::net::Settings::default();
    let mut found = energy::net::minimise(&system, &settings).unwrap().equilibrium;
    found.reactions_n = vec![[1.0, 2.0, 3.0], [9.0; 3], [4.0, 5.0, 6.0]];
    assert_eq!(end_forces(&found), Some([4.0, 6.0, 3.0]));
    found.reactions_n.clear();
    assert_eq!(end_forces(&found), None);
}
