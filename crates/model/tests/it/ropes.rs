//! Ropes over rings and pulleys: read, written, and refused where they are none.

use model::Bar;
use model::system::{Joint, Kind, Member, PointLoad, Refusal, Support, System, SystemError};
use model::system_file::{parse, write_network};

use crate::support::{rows, system};

/// A ring on a rope between two anchors, with more keys of the rope.
fn ring(more: &str) -> String {
    format!(
        "[joints]\nA = {{ at_m = [0, 0, 0] }}\nB = {{ at_m = [4, 0, 1] }}\nP = {{ mass_kg = 10 }}\n\
         [[bars]]\nfrom = \"A\"\nto = \"B\"\n{more}\n"
    )
}

const VIA: &str = "via = [\"P\"]\nkind = \"cable\"";

#[test]
fn a_rope_needs_no_mass_and_reads_back() {
    let first = system(&ring(&format!("{VIA}\nlength_m = 5\nstiffness_n = 1e4\nstrength_n = 500")));
    let rope = &first.members()[0];
    assert_eq!((rope.from, rope.via(), rope.to), (0, &[2][..], 1));
    assert!(rope.body.mass_kg() <= 0.0 && first.has_ropes());
    assert_eq!(system(&write_network(&first)), first);
    assert_eq!(first.first_rope(), Some(0));
    assert!(first.as_row().is_none());
}

#[test]
fn drawn_ropes_have_the_length_of_their_spans() {
    let drawn = ring(VIA).replace("{ mass_kg", "{ near_m = [0, 3, 4], mass_kg");
    let rope = system(&drawn).members()[0].clone();
    assert!((rope.body.length_m() - 5.0 - f64::sqrt(16.0 + 9.0 + 9.0)).abs() < 1e-15);
}

#[test]
fn what_is_no_rope_is_refused_where_it_stands() {
    for [more, message] in rows("rope") {
        let error = parse(&ring(&format!("{more}\nlength_m = 5")), "f").unwrap_err();
        assert_eq!(error.to_string(), message);
    }
}

/// Two pulleys and a ring on a rope.
fn over_pulleys(length_m: f64) -> System {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("D", [3.0, 0.0, 4.0]),
        Joint::free("P").with_mass(1.0),
        Joint::anchor("B", [3.0, 0.0, 6.0]),
    ];
    let rope = Member::cable(0, 3, Bar::homogeneous(length_m, 0.0).unwrap()).over(vec![1, 2]);
    System::new("over a pulley", 10.0, joints, vec![rope]).unwrap()
}

#[test]
fn ropes_that_do_not_reach_past_their_pulleys_are_refused() {
    assert_eq!(over_pulleys(7.5).refusal(), Ok(()));
    for (length_m, words) in [(6.8, "0.2 m are missing"), (7.0, "straight and taut")] {
        let refused = over_pulleys(length_m).refusal().unwrap_err();
        let Refusal::ShortRope { member, way_m, .. } = refused else { panic!("{refused}") };
        assert!(member == 1 && (way_m - 7.0).abs() < 1e-14);
        assert!(refused.to_string().contains(words), "{refused}");
    }
    // The ends alone are too far apart.
    assert!(matches!(over_pulleys(6.0).refusal(), Err(Refusal::OutOfReach { .. })));
}

/// Two joints on these supports as one.
fn joined(first: Support, second: Support) -> Option<Support> {
    let on = |name: &str, support| Joint::free(name).with_mass(1.0).held_by(support);
    let joints = vec![on("P", first), on("Q", second), Joint::anchor("A", [9.0, 0.0, 0.0])];
    let rope = Member::cable(0, 2, Bar::homogeneous(50.0, 0.0).unwrap()).over(vec![1]);
    let system = System::new("", 10.0, joints, vec![rope]).unwrap().with_floor(-50.0).unwrap();
    let joined = system.joined(&[[0, 1]])?;
    assert_eq!(
        (joined.system.floor_m(), &joined.numbers[1..]),
        (Some(-50.0), &[joined.numbers[0], 1][..])
    );
    assert!((joined.system.joints()[0].mass_kg - 2.0).abs() < 1e-15);
    Some(joined.system.joints()[0].support)
}

/// By hand: where two supports hold one joint.
#[test]
fn joints_that_are_one_move_where_both_supports_let_them() {
    let plane = |at_m, normal| Support::Plane { at_m, normal };
    let line = |at_m, direction| Support::Line { at_m, direction };
    let level = plane([5.0, -7.0, 2.0], [0.0, 0.0, 1.0]);
    let upright = plane([1.0, 3.0, -4.0], [0.6, 0.8, 0.0]);
    let slope = line([0.0, 1.0, 0.0], [2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0]);
    let at = |support: Support, at_m: [f64; 3]| {
        let off = support.nearest_m(at_m);
        (0..3).map(|k| (off[k] - at_m[k]).abs()).fold(0.0, f64::max) < 1e-12
    };
    let Some(Support::Line { direction, .. }) = joined(Support::Free, slope) else { panic!() };
    assert!((direction[0] * 2.0 + direction[1] + direction[2] * 2.0).abs() > 3.0 - 1e-15);
    // 3 on: the slope is at (2, 2, 2) in the level plane.
    let Some(Support::Fixed { at_m }) = joined(slope, level) else { panic!() };
    assert!(at(Support::Fixed { at_m }, [2.0, 2.0, 2.0]), "{at_m:?}");
    // 0.6 x + 0.8 y = 3 at the height of 2.
    let both = joined(level, upright).unwrap();
    assert!(matches!(both, Support::Line { .. }) && at(both, [5.0, 0.0, 2.0]));
    assert!(at(both, [1.0, 3.0, 2.0]) && !at(both, [1.0, 3.0, 2.1]) && !at(both, [1.1, 3.0, 2.0]));
    let same = joined(level, plane([0.0, 0.0, 2.0], [0.0, 0.0, -1.0])).unwrap();
    assert!(matches!(same, Support::Plane { .. }) && at(same, [8.0, 9.0, 2.0]));
    let crossing = line([2.0, 5.0, 2.0], [0.0, 1.0, 0.0]);
    let Some(Support::Fixed { at_m }) = joined(crossing, slope) else { panic!() };
    assert!(at(Support::Fixed { at_m }, [2.0, 2.0, 2.0]), "{at_m:?}");
    let anchor = Support::Fixed { at_m: [2.0, 2.0, 2.0] };
    assert_eq!(joined(slope, anchor), Some(anchor));
    // Parallel planes, lines past each other, an anchor beside.
    assert_eq!(joined(level, plane([0.0, 0.0, 2.5], [0.0, 0.0, 1.0])), None);
    assert_eq!(joined(line([2.0, 5.0, 2.1], [0.0, 1.0, 0.0]), slope), None);
    assert_eq!(joined(slope, Support::Fixed { at_m: [2.0, 2.0, 2.1] }), None);
}

/// What a cable between two joints weighs and bears acts at the joint that they are; a strut cannot be there.
#[test]
fn a_slack_cable_hangs_in_the_joint_that_its_ends_are() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("D", [0.0; 3]),
        Joint::free("P").with_mass(1.0),
        Joint::free("Q").with_mass(2.0),
    ];
    let body = |mass_kg| Bar::homogeneous(2.0, mass_kg).unwrap();
    let load = PointLoad { at_m: 0.5, force_n: [0.0, 3.0, 0.0], is_spread: false };
    let cable = Member::cable(2, 3, body(0.5)).with_loads(vec![load]);
    let ropes = [0, 1].map(|anchor| Member::cable(anchor, 2, body(0.0)).over(vec![3]));
    let with = |member: Member| {
        let members = ropes.iter().cloned().chain([member]).collect();
        System::new("", 10.0, joints.clone(), members).unwrap()
    };
    let one = with(cable.clone()).joined(&[[3, 2]]).unwrap();
    assert_eq!(one.numbers, [0, 1, 2, 2]);
    let joint = &one.system.joints()[2];
    assert!((joint.mass_kg - 3.5).abs() < 1e-15 && (joint.force_n[1] - 3.0).abs() < 1e-15);
    assert_eq!(joint.name, "P");
    let slack = &one.system.members()[2];
    assert!(slack.loads.is_empty() && slack.body.mass_kg() <= 0.0 && slack.from >= 3);
    // At A the other anchor in its place is one with it.
    let held = with(cable).joined(&[[0, 3]]).unwrap();
    assert_eq!((held.numbers, held.kept), (vec![0, 0, 1, 0], vec![0, 2]));
    let strut = Member::cable(2, 3, body(0.0)).of_kind(Kind::Strut);
    assert!(with(strut).joined(&[[2, 3]]).is_none());
}

#[test]
fn rings_hang_on_their_rope_and_lost_ropes_leave_them() {
    let system = over_pulleys(9.0);
    assert_eq!(system.parts().len(), 1);
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(1.0)];
    let rope = Member::cable(0, 7, Bar::homogeneous(1.0, 0.0).unwrap()).over(vec![1]);
    let error = System::new("", 10.0, joints, vec![rope]).unwrap_err();
    assert!(matches!(error, SystemError::NoSuchJoint { joint: 7, .. }), "{error}");
    let mut members = system.members().to_vec();
    members.insert(0, Member::cable(0, 2, Bar::homogeneous(9.0, 0.0).unwrap()));
    let both = System::new("both", 10.0, system.joints().to_vec(), members).unwrap();
    let (left, joints) = both.without(0);
    assert_eq!((left.members()[0].via(), joints), (&[1, 2][..], vec![0, 1, 2, 3]));
    let (left, joints) = both.without(1);
    assert_eq!((left.members().len(), joints), (1, vec![0, 2]));
}
