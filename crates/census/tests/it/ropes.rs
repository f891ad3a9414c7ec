//! Ropes over rings and pulleys: one box, one equilibrium.

use census::boxes::prove;
use census::net::SystemCensus;
use model::system::{Joint, Kind, Member, System};
use model::{Bar, NoBox, Vector};

/// Enclosures are so wide at most, in units of lengths and forces.
const ROUNDING: f64 = 1e-13;

fn places(system: &System, known: &[(usize, Vector)]) -> Vec<Vector> {
    let held = |joint: &Joint| joint.support.at_m().unwrap_or_default();
    let mut places: Vec<Vector> = system.joints().iter().map(held).collect();
    for (joint, at_m) in known {
        places[*joint] = *at_m;
    }
    places
}

#[test]
fn known_ropes_are_enclosed_and_the_only_ones() {
    for sample in samples::ropes() {
        let (system, axial_n) = (&sample.system, &sample.axial_n);
        let (name, at_m) = (system.name(), places(system, &sample.at_m));
        let found = prove(system, &at_m, axial_n);
        let census = SystemCensus::of_cables(system, &at_m, axial_n);
        let found = found.unwrap_or_else(|because| panic!("{name}: {because}"));
        let off = found.beyond_m(&at_m) / system.total_length_m();
        let largest = axial_n.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let off_n = found.beyond_n(axial_n) / largest;
        assert!(off < ROUNDING && off_n < ROUNDING, "{name}: {off} {off_n}");
        let width = found.width_m / system.total_length_m();
        assert!(width < ROUNDING && found.width_n / largest < ROUNDING, "{name}: {found:?}");
        let census = census.unwrap();
        let [only] = &census.equilibria[..] else { panic!("{name}") };
        assert!(census.complete && only.index_in_space == 0);
        // Weights on heights, and half of what stretches.
        let heights = system.joints().iter().zip(&at_m);
        let heights = heights.map(|(joint, at)| joint.mass_kg * (at[2] - system.reference_m()[2]));
        let stretched = system.members().iter().zip(axial_n).map(|(member, force)| {
            let soft = member.stiffness_n.map_or(0.0, f64::recip);
            0.5 * force * force * member.body.length_m() * soft
        });
        let energy = system.gravity_m_s2() * heights.sum::<f64>() + stretched.sum::<f64>();
        let size = largest * system.total_length_m();
        assert!((only.energy_j.mid() - energy).abs() < ROUNDING * size, "{name}: {energy}");
        // The ground bears all weights.
        let up: f64 = only.reactions_n.iter().map(|force| force[2].mid()).sum();
        let weight = system.total_mass_kg() * system.gravity_m_s2();
        assert!((up - weight).abs() < 1e-12 * weight.max(largest), "{name}: {up} {weight}");
    }
}

/// Two rings on one rope in space, built backwards: its spans run along (3, 0, -4)/5, (4, 3, 0)/5 and (0, -3, 4)/5 under
/// 10 N, so that each ring bears the difference of two directions.
fn two_rings() -> (System, Vec<Vector>) {
    let at_m = [[0.0; 3], [3.0, 0.0, -4.0], [7.0, 3.0, -4.0], [7.0, -3.0, 4.0]];
    let joints = vec![
        Joint::anchor("A", at_m[0]),
        Joint::free("P").with_force([-2.0, -6.0, -8.0]),
        Joint::free("Q").with_force([8.0, 12.0, -8.0]),
        Joint::anchor("B", at_m[3]),
    ];
    let rope = Member::cable(0, 3, Bar::homogeneous(20.0, 0.0).unwrap()).over(vec![1, 2]);
    (System::new("two rings", 10.0, joints, vec![rope]).unwrap(), at_m.to_vec())
}

#[test]
fn rings_that_are_drawn_apart_have_one_equilibrium() {
    let (system, at_m) = two_rings();
    let census = SystemCensus::of_cables(&system, &at_m, &[10.0]).unwrap();
    let only = &census.equilibria[0];
    assert!(only.axial_n[0].contains(10.0) && only.width_m() < 1e-13, "{only:?}");
    let at = only.joints_m.iter().flatten().zip(at_m.iter().flatten());
    assert!(at.into_iter().all(|(found, x)| found.contains(*x)));
    // As answer of the census it has the forces of both ends.
    let model = &census.to_model(&system)[0];
    let near = |found: Vector, wanted: Vector| (0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-12);
    assert!(near(model.start_forces_n[0], [-6.0, 0.0, 8.0]), "{:?}", model.start_forces_n);
    assert!(near(model.end_forces_n[0], [0.0, -6.0, 8.0]), "{:?}", model.end_forces_n);
    // A bar beside them may push.
    let mut members = system.members().to_vec();
    let bar = Bar::homogeneous(9.0, 0.0).unwrap();
    members.push(Member::bar(1, 3, bar).of_kind(Kind::Strut));
    let beside = System::new("beside", 10.0, system.joints().to_vec(), members).unwrap();
    assert_eq!(SystemCensus::of_cables(&beside, &at_m, &[10.0, 0.0]), None);
    assert!(prove(&beside, &at_m, &[10.0, 0.0]).is_ok());
}

#[test]
fn what_is_no_equilibrium_of_a_rope_is_not_proved() {
    let sample = &samples::ropes()[0];
    let at_m = places(&sample.system, &sample.at_m);
    // The ring above, where the rope would have to push: 1 m above the line of its anchors' middle.
    let (mut above, mut ended) = (at_m.clone(), at_m.clone());
    above[2] = [4.0 - at_m[2][0], 0.0, 1.0 - at_m[2][2]];
    let pushed = prove(&sample.system, &above, &[-sample.axial_n[0]]);
    assert_eq!(pushed, Err(NoBox::WrongSign { member: 1 }));
    let pulled = prove(&sample.system, &above, &sample.axial_n);
    assert!(matches!(pulled, Err(NoBox::NotConverged | NoBox::NotContracting)), "{pulled:?}");
    // A ring at the end of its rope has a span without a direction.
    ended[2] = ended[0];
    let found = prove(&sample.system, &ended, &sample.axial_n);
    assert_eq!(found, Err(NoBox::Rope { member: 1 }));
}

/// 3 kg and a lighter weight over pulleys at D and E: the lighter one is pulled up to E, where its span bears its
/// weight, less than the 30 N of the rope.
#[test]
fn joints_that_have_run_together_are_proved() {
    let over_pulleys = |mass_kg: f64| {
        let joints = samples::joints(&[[0.0; 3], [1.0, 0.0, 0.0]], &[3.0, mass_kg]);
        let rope = Member::cable(2, 3, Bar::homogeneous(6.0, 0.0).unwrap()).over(vec![0, 1]);
        System::new("two weights", 10.0, joints, vec![rope]).unwrap()
    };
    let at_m = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -5.0], [1.0, 0.0, 0.0]];
    for (mass_kg, holds) in [(2.0, true), (2.999_999, true), (3.0, false), (3.000_001, false)] {
        let found = prove(&over_pulleys(mass_kg), &at_m, &[30.0]);
        if holds {
            let found = found.unwrap();
            assert!(found.beyond_m(&at_m) < 1e-15 && found.axial_n[0].contains(30.0), "{found:?}");
            assert!(found.width_m < ROUNDING && found.joints_m.len() == 4, "{found:?}");
        } else {
            assert_eq!(found, Err(NoBox::Rope { member: 1 }), "{mass_kg}");
        }
    }
    let census = SystemCensus::of_cables(&over_pulleys(2.0), &at_m, &[30.0]).unwrap();
    assert!(census.complete && census.equilibria[0].energy_j.contains(-150.0));
    // The span over E to Q has no direction; it bears the 20 N of Q, and E both that and the level 30 N of the rope.
    let found = census.to_model(&over_pulleys(2.0));
    let [found] = &found[..] else { panic!("{found:?}") };
    let near = |a: Vector, b: Vector| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-12);
    let [jam] = found.evidence.jams[..] else { panic!("{:?}", found.evidence.jams) };
    assert!((jam.member, jam.span) == (0, 2) && near(jam.pull_n, [0.0, 0.0, -20.0]), "{jam:?}");
    assert!(near(found.end_forces_n[0], [0.0, 0.0, -20.0]), "{:?}", found.end_forces_n);
    assert!(near(found.reactions_n[1], [30.0, 0.0, 20.0]), "{:?}", found.reactions_n);
    // Pulled aside by 12 N in Y too: |(12, 20)| < 30 N, but not with 24 N.
    for (aside_n, holds) in [(12.0, true), (24.0, false)] {
        let system = over_pulleys(2.0);
        let mut joints = system.joints().to_vec();
        joints[3].force_n[1] = aside_n;
        let aside = System::new("aside", 10.0, joints, system.members().to_vec()).unwrap();
        assert_eq!(prove(&aside, &at_m, &[30.0]).is_ok(), holds, "{aside_n}");
    }
}

/// A pulley on a vertical with an anchor: a weight that hangs aside by a second rope turns about it.
#[test]
fn what_hangs_on_ropes_below_one_anchor_turns() {
    let at_m = [[0.0, 0.0, 0.0], [0.0, 0.0, -6.0], [4.0, 0.0, -3.0], [4.0, 0.0, -5.0]];
    let joints = samples::joints(&[at_m[0], at_m[1]], &[0.0, 1.2]);
    let body = |length_m: f64| Bar::homogeneous(length_m, 0.0).unwrap();
    // A bar from A to P and one from B push P out; the rope of both hangs Q below P.
    let members = vec![
        Member::bar(0, 2, body(5.0)),
        Member::bar(1, 2, body(5.0)),
        Member::cable(2, 2, body(4.0)).over(vec![3]),
    ];
    let system = System::new("turns", 10.0, joints, members).unwrap();
    // 12 N at P: 10 N in each bar by 3/5; two strands of 6 N.
    let found = prove(&system, &at_m, &[10.0, -10.0, 6.0]).unwrap();
    assert_eq!(found.turns, 1);
    assert!(found.beyond_m(&at_m) < 1e-14 && found.axial_n[2].contains(6.0), "{found:?}");
}
