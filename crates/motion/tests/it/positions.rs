//! Positions that meet the constraints.

use model::Bar;
use model::system::{Joint, Kind, Member, Support, System};
use motion::{Settings, Simulation, random_places, random_position};

use crate::common::paper;

#[test]
fn random_positions_close_and_differ_and_are_the_same_for_the_same_seed() {
    let mut mean = [0.0; 3];
    for seed in 0..200 {
        let at = random_position(&paper(), seed).unwrap();
        assert_eq!(at, random_position(&paper(), seed).unwrap());
        let simulation = Simulation::new(&paper(), &at, Settings::default()).unwrap();
        assert!(simulation.constraints_off()[0] < 1e-14);
        for k in 0..3 {
            mean[k] += at[1][k] / 200.0;
        }
    }
    // About the vertical through the anchors no direction is preferred.
    assert!(mean[0].abs() < 0.15 && mean[1].abs() < 0.15, "{mean:?}");
}

#[test]
fn random_positions_of_loops_and_long_chains() {
    let chain = model::cases::get("ten-equal-bars").unwrap().problem();
    let chain = System::from(chain.chain());
    for seed in 0..20 {
        random_position(&chain, seed).unwrap();
    }
}

/// A ring begins anywhere along its line, not where the file names a point of it.
#[test]
fn rings_begin_along_their_lines() {
    let (at_m, direction) = ([1.0, 2.0, 3.0], [0.6, 0.8, 0.0]);
    let support = Support::Line { at_m, direction };
    let ring = Joint::free("R").with_mass(1.0).held_by(support);
    let rod = Member::bar(0, 1, Bar::homogeneous(0.5, 0.1).unwrap());
    let joints = vec![ring, Joint::free("P").with_mass(1.0)];
    let system = System::new("ring", 9.81, joints, vec![rod]).unwrap();
    let places = (0..20).map(|seed| {
        let at = random_position(&system, seed).unwrap()[0];
        let along: f64 = (0..3).map(|k| (at[k] - at_m[k]) * direction[k]).sum();
        assert!((0..3).all(|k| (at[k] - at_m[k] - along * direction[k]).abs() < 1e-12), "{at:?}");
        along
    });
    let (least, most) = places.fold((0.0_f64, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    assert!(least < -0.3 && most > 0.3, "{least} {most}");
}

/// A triangle in an upright plane through its anchors: P is above or below, as the intersection of two
/// circles says.
#[test]
fn joints_in_a_plane_begin_anywhere_in_it() {
    let normal = [0.6, -0.8, 0.0];
    let support = Support::Plane { at_m: [0.0; 3], normal };
    let top = Joint::free("P").with_mass(5.0).held_by(support);
    let end_m = [1.6, 1.2, 0.0];
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", end_m), top];
    let rod = |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.5).unwrap());
    let system =
        System::new("triangle", 9.81, joints, vec![rod(0, 2, 1.5), rod(2, 1, 1.2)]).unwrap();
    let along = (1.5 * 1.5 - 1.2 * 1.2 + 4.0) / 4.0;
    let height = f64::sqrt(1.5 * 1.5 - along * along);
    let mut ways = [0; 2];
    for seed in 0..20 {
        let at = random_position(&system, seed).unwrap()[2];
        let found = [0.8 * at[0] + 0.6 * at[1], at[2].abs(), 0.6 * at[0] - 0.8 * at[1]];
        for (found, wanted) in found.into_iter().zip([along, height, 0.0]) {
            assert!((found - wanted).abs() < 1e-9, "{at:?}");
        }
        ways[usize::from(at[2] > 0.0)] += 1;
    }
    assert!(ways[0] > 3 && ways[1] > 3, "{ways:?}");
}

/// Before loops are closed: a rod at its length from an anchor, a cable and a strut slack by any part of theirs, the
/// next joint in its plane.
#[test]
fn random_places_are_those_of_trees() {
    let normal = [0.36, -0.48, 0.8];
    let support = Support::Plane { at_m: [0.5, -0.25, 2.0], normal };
    let start = [3.0, -1.0, 0.5];
    let joints = vec![
        Joint::anchor("A", start),
        Joint::free("P").with_mass(1.0),
        Joint::free("Q").with_mass(1.0),
        Joint::free("R").with_mass(1.0),
        Joint::free("S").with_mass(1.0).held_by(support),
    ];
    let body = |length_m| Bar::homogeneous(length_m, 0.1).unwrap();
    let members = vec![
        Member::bar(0, 1, body(0.7)),
        Member::cable(0, 2, body(1.6)),
        Member::bar(0, 3, body(2.5)).of_kind(Kind::Strut),
        Member::bar(1, 4, body(0.4)),
    ];
    let system = System::new("tree", 9.81, joints, members).unwrap();
    let mut slack = [Vec::new(), Vec::new()];
    for seed in 0..200 {
        let at = random_places(&system, seed);
        let apart =
            |joint: usize| (0..3).map(|k| (at[joint][k] - start[k]).powi(2)).sum::<f64>().sqrt();
        assert!(at.len() == 5 && apart(0) <= 0.0 && (apart(1) - 0.7).abs() < 1e-14, "{at:?}");
        let off: f64 = (0..3).map(|k| normal[k] * (at[4][k] - [0.5, -0.25, 2.0][k])).sum();
        assert!(off.abs() < 1e-14, "{at:?}");
        slack[0].push(apart(2) / 1.6);
        slack[1].push(apart(3) / 2.5 - 1.0);
    }
    for slack in slack {
        assert!(slack.iter().all(|part| (0.0..1.0).contains(part)), "{slack:?}");
        let mean = slack.iter().sum::<f64>() / 200.0;
        // Five standard deviations of the mean of 200 even parts.
        assert!((mean - 0.5).abs() < 5.0 / (12.0 * 200.0_f64).sqrt(), "{mean}");
        // Of 200 parts none is in a tenth at an end once in 10⁹ times.
        let near = |end: f64| slack.iter().any(|part| (part - end).abs() < 0.1);
        assert!(near(0.0) && near(1.0), "{slack:?}");
    }
}
