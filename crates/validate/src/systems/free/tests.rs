//! What leaves a joint free, piece by piece.

use model::Bar;
use model::system::Joint;

use super::super::tests::lamp;
use super::*;

/// A member of 2 m from the origin to a joint at a distance.
fn at(kind: Kind, distance_m: f64) -> bool {
    let body = Bar::homogeneous(2.0, 0.0).unwrap();
    let member = Member { kind, ..Member::bar(0, 1, body) };
    let (_, like) = lamp();
    let joints_m = vec![[0.0; 3], [0.0, distance_m, 0.0]];
    is_slack(&member, &SystemEquilibrium { joints_m, ..like })
}

/// Two micrometres of two metres are rounding at most.
#[test]
fn slack_is_what_no_rounding_explains() {
    let (less, more) = (2.0 - 1.9e-6, 2.0 + 1.9e-6);
    let (short, long) = (2.0 - 2.1e-6, 2.0 + 2.1e-6);
    let slack = |kind: Kind| [0.5, short, less, 2.0, more, long, 3.0].map(|d| at(kind, d));
    assert_eq!(slack(Kind::Bar), [false; 7]);
    assert_eq!(slack(Kind::Cable), [true, true, false, false, false, false, false]);
    assert_eq!(slack(Kind::Strut), [false, false, false, false, false, true, true]);
}

/// The joint of two bars on a straight line cannot leave it to first order, and goes round where
/// the line is bent; whichever end of a bar it is.
#[test]
fn two_bars_leave_room_where_they_are_bent() {
    let room = |at_m: Vector, turned: bool| {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("P"),
            Joint::anchor("B", [2.0, 0.0, 0.0]),
        ];
        let length_m = norm(at_m);
        let bar = Bar::homogeneous(length_m, 0.0).unwrap();
        let second = if turned { Member::bar(2, 1, bar) } else { Member::bar(1, 2, bar) };
        let system =
            System::new("two", 10.0, joints, vec![Member::bar(0, 1, bar), second]).unwrap();
        let (_, like) = lamp();
        let joints_m = vec![[0.0; 3], at_m, [2.0, 0.0, 0.0]];
        let answer = SystemEquilibrium { joints_m, ..like };
        with_room(&system, &answer, &members_of(&system), &[1])
    };
    for turned in [false, true] {
        assert_eq!(room([1.0, 0.0, 0.0], turned), [false], "{turned}");
        assert_eq!(room([1.0, 0.75, 0.0], turned), [true], "{turned}");
        assert_eq!(room([1.0, 0.0, -0.75], turned), [true], "{turned}");
    }
}

/// An anchor from which a slack cable hangs is where it is.
#[test]
fn anchors_are_not_free() {
    let (system, mut answer) = lamp();
    let mut joints = system.joints().to_vec();
    joints.push(Joint::anchor("C", [0.0, 1.0, 0.0]));
    let mut members = system.members().to_vec();
    members.push(Member::cable(3, 2, Bar::homogeneous(7.0, 0.0).unwrap()));
    let system = System::new("spare cable", 10.0, joints, members).unwrap();
    answer.joints_m.push([0.0, 1.0, 0.0]);
    answer.reactions_n.push([0.0; 3]);
    answer.start_forces_n.push([0.0; 3]);
    answer.end_forces_n.push([0.0; 3]);
    answer.axial_n.push(0.0);
    assert_eq!(free_joints(&system, &[answer]), [false; 4]);
}
