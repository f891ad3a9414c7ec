//! Ropes over rings and pulleys against closed forms.

use energy::net::{Forces, Settings, Solution, critical, minimise, minimise_from, minimise_near};
use model::Bar;
use model::system::{Joint, Member, System};
use samples::RopeSample;

fn near(found: f64, wanted: f64) -> bool {
    (found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0)
}

fn holds(sample: &RopeSample, found: &Solution) {
    let (name, answer) = (sample.system.name(), &found.equilibrium);
    assert_eq!(answer.axial_n.len(), sample.axial_n.len());
    for (axial, wanted) in answer.axial_n.iter().zip(&sample.axial_n) {
        assert!(near(*axial, *wanted), "{name}: {axial} is not {wanted}");
    }
    for (joint, at_m) in &sample.at_m {
        let found = answer.joints_m[*joint];
        assert!((0..3).all(|k| near(found[k], at_m[k])), "{name}: {found:?} is not {at_m:?}");
    }
}

/// What is found, and places next to it.
fn found(sample: &RopeSample) -> (Solution, Vec<[f64; 3]>) {
    let found = minimise(&sample.system, &Settings::default());
    let found = found.unwrap_or_else(|error| panic!("{}: {error}", sample.system.name()));
    let joints_m = found.equilibrium.joints_m.iter();
    let moved = joints_m.map(|[x, y, z]| [x + 0.1, y - 0.05, z + 0.1]).collect();
    (found, moved)
}

#[test]
fn ropes_have_one_tension() {
    for sample in samples::ropes() {
        let name = sample.system.name();
        let (found, moved) = found(&sample);
        assert!(matches!(found.forces, Forces::Unique(_)), "{name}: {:?}", found.forces);
        assert_eq!(found.equilibrium.stability.neutral, 0, "{name}");
        holds(&sample, &found);
        for again in [minimise_from, minimise_near] {
            let again = again(&sample.system, &moved, &Settings::default());
            holds(&sample, &again.unwrap_or_else(|error| panic!("{name}: {error}")));
        }
    }
}

/// A shape at rest, and the same with its ring lifted.
#[test]
fn shapes_of_ropes_are_judged_by_their_energy() {
    let ring = &samples::ropes()[0];
    let mut at_m = [[0.0; 3], [4.0, 0.0, 1.0], ring.at_m[0].1];
    let found = critical(&ring.system, &at_m).unwrap().unwrap();
    assert!(found.is_equilibrium() && found.index == 0, "{found:?}");
    at_m[2][2] += 1e-3;
    assert!(!critical(&ring.system, &at_m).unwrap().unwrap().is_equilibrium());
}

/// Rings at a corner of the energy, where it falls to no side: found from everywhere, with what holds them.
#[test]
fn minima_at_corners_of_the_energy_are_found() {
    for sample in samples::jammed_ropes() {
        let name = sample.system.name();
        let (found, moved) = found(&sample);
        let again = minimise_from(&sample.system, &moved, &Settings::default());
        for found in [&found, &again.unwrap_or_else(|error| panic!("{name}: {error}"))] {
            holds(&sample, found);
            let jams = &found.equilibrium.evidence.jams;
            assert_eq!(jams.len(), sample.jams.len(), "{name}: {jams:?}");
            for (jam, (span, pull_n)) in jams.iter().zip(&sample.jams) {
                assert_eq!((jam.member, jam.span), (0, *span), "{name}");
                let right = (0..3).all(|axis| near(jam.pull_n[axis], pull_n[axis]));
                assert!(right, "{name}: {jam:?} is not {pull_n:?}");
            }
        }
    }
}

/// A cable that is slack where it is let go bears nothing there, and no force is a measure.
#[test]
fn what_begins_slack_falls_into_its_cable() {
    let joints = vec![Joint::anchor("D", [0.0; 3]), Joint::free("P").with_mass(1.0)];
    let cable = Member::cable(0, 1, Bar::homogeneous(1.0, 0.0).unwrap());
    let system = System::new("one", 10.0, joints, vec![cable]).unwrap();
    let from = [[0.0; 3], [0.1, 0.0, -0.9]];
    let found = minimise_from(&system, &from, &Settings::default()).unwrap();
    assert!(found.work.iterations < 60, "{:?}", found.work);
    assert!(near(found.equilibrium.axial_n[0], 10.0));
}
