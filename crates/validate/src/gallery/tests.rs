//! Numbers by names.

use model::cases::{drawn, gallery, ropes};
use model::system::System;

use super::*;

/// The gallery's lamp by both solvers: what is read by name is what stands at that place.
#[test]
fn numbers_are_read_by_the_names_of_joints() {
    let system: System = model::cases::exhibit("lamp").unwrap().system();
    let settings = energy::net::Settings::default();
    let found = energy::net::minimise(&system, &settings).unwrap().equilibrium;
    for (k, joint) in system.joints().iter().enumerate() {
        let bits = |force: [f64; 3]| force.map(f64::to_bits);
        assert_eq!(bits(reaction(&system, &found, &joint.name.text())), bits(found.reactions_n[k]));
    }
    for (k, member) in system.members().iter().enumerate() {
        let [from, to] = [member.from, member.to].map(|joint| system.joints()[joint].name.text());
        assert_eq!(axial(&system, &found, &from, &to).to_bits(), found.axial_n[k].to_bits());
        assert!(axial(&system, &found, &to, &from).is_nan());
    }
    assert!(reaction(&system, &found, "nobody").iter().all(|x| x.is_nan()));
    // What holds the lamp up together is its weight.
    let up: f64 = found.reactions_n.iter().map(|force| force[2]).sum();
    let weight = system.total_mass_kg() * system.gravity_m_s2();
    assert!((up / weight - 1.0).abs() < 1e-12 && weight > 1.0, "{up} {weight}");
}

/// Both solvers find the closed form of every exhibit, as accurately as the linkage, the worst of
/// all, lets them.
#[test]
fn what_is_known_is_found() {
    let pieces = solve();
    assert_eq!(pieces.len(), gallery().len() + drawn().len() + ropes().len());
    for piece in pieces {
        let wanted = piece.closed_form.value;
        assert!(piece.answer.agrees() && piece.answer.equilibria.len() == 2);
        let hangs = gallery().iter().any(|exhibit| exhibit.name == piece.exhibit.name);
        for answer in &piece.answer.equilibria {
            let optimal = answer.evidence.rung() == Some(model::Rung::Optimal);
            assert!(optimal || !hangs, "{}: {:?}", piece.exhibit.name, answer.evidence.ladder);
            let found = (piece.closed_form.of)(&piece.system, answer);
            assert!((found / wanted - 1.0).abs() < 1e-11, "{}: {found}", piece.exhibit.name);
        }
    }
    assert!(closed_form("nobody").is_none());
}
