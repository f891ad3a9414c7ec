//! What leaves a joint free, piece by piece.

use model::Bar;
use model::system::{Joint, Support};
use numerics::vector::minus;

use super::super::tests::{joined, lamp};
use super::*;

/// How all joints may move.
fn ways(system: &System, along: fn(&Support) -> Vec<Vector>) -> impl Fn(usize) -> Vec<Vector> {
    move |joint| along(&system.joints()[joint].support)
}

/// A member of 2 m from the origin to a joint at a distance.
fn at(kind: Kind, distance_m: f64) -> bool {
    let body = Bar::homogeneous(2.0, 0.0).unwrap();
    let member = Member::bar(0, 1, body).of_kind(kind);
    let joints_m = vec![[0.0; 3], [0.0, distance_m, 0.0]];
    is_slack(&member, &SystemEquilibrium { joints_m, ..lamp().1 })
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
        let joints_m = vec![[0.0; 3], at_m, [2.0, 0.0, 0.0]];
        let answer = SystemEquilibrium { joints_m, ..lamp().1 };
        with_room(&system, &[answer], &members_of(&system), &[1], &ways(&system, Support::motions))
    };
    for turned in [false, true] {
        assert_eq!(room([1.0, 0.0, 0.0], turned), [false], "{turned}");
        assert_eq!(room([1.0, 0.75, 0.0], turned), [true], "{turned}");
        assert_eq!(room([1.0, 0.0, -0.75], turned), [true], "{turned}");
    }
}

/// Of a line of four bars over two bar lengths, folded onto itself, the lengths are not independent: whether it can
/// move another answer tells, and none alone.
#[test]
fn a_folded_line_leaves_the_room_that_another_answer_shows() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P"),
        Joint::free("Q"),
        Joint::free("R"),
        Joint::anchor("B", [2.0, 0.0, 0.0]),
    ];
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let members = (0..4).map(|k| Member::bar(k, k + 1, bar)).collect();
    let system = System::new("folded", 10.0, joints, members).unwrap().with_floor(0.0).unwrap();
    let along = |x: f64, y: f64| [x, y, 0.0];
    let answer = |[p, q, r]: [Vector; 3]| {
        let joints_m = vec![[0.0; 3], p, q, r, along(2.0, 0.0)];
        SystemEquilibrium { joints_m, ..lamp().1 }
    };
    let high = 0.75_f64.sqrt();
    let folded = || answer([along(1.0, 0.0), along(0.0, 0.0), along(1.0, 0.0)]);
    let bent = || answer([along(0.5, high), along(1.0, 0.0), along(1.5, high)]);
    let members_of = members_of(&system);
    let room = |answers: &[SystemEquilibrium]| {
        with_room(&system, answers, &members_of, &[1, 2, 3], &ways(&system, sliding))
    };
    assert_eq!(room(&[folded()]), [false; 3]);
    assert_eq!(room(&[bent()]), [true; 3]);
    assert_eq!(room(&[folded(), bent()]), [true; 3]);
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
    joined(&mut answer, [0.0, 1.0, 0.0], [0.0; 3], 1);
    assert_eq!(free_joints(&system, &[answer]), [false; 4]);
}

/// A string of joints beside an anchor, in a zigzag of 3 and 4 m, at whose other end another anchor
/// stands.
fn string(joints: usize) -> Vec<bool> {
    let mut all = vec![Joint::anchor("A", [0.0; 3])];
    let mut joints_m = vec![[0.0; 3]];
    let mut members = vec![];
    for k in 0..=joints {
        let [x, y, z] = joints_m[k];
        let at = if k % 2 == 0 { [x + 3.0, y, z + 4.0] } else { [x + 4.0, y + 3.0, z] };
        joints_m.push(at);
        let last = k == joints;
        all.push(if last { Joint::anchor("B", at) } else { Joint::free(k.to_string()) });
        members.push(Member::bar(k, k + 1, Bar::homogeneous(5.0, 0.0).unwrap()));
    }
    let system = System::new("string", 10.0, all, members).unwrap();
    let (axial_n, reactions_n) = (vec![0.0; joints + 1], vec![[0.0; 3]; joints + 2]);
    let answer = SystemEquilibrium { joints_m, axial_n, reactions_n, ..lamp().1 };
    free_joints(&system, &[answer])[1..=joints].to_vec()
}

#[test]
fn room_is_looked_for_among_eighty_joints_at_most() {
    assert_eq!(string(3), [true; 3]);
    assert_eq!(string(80), [true; 80]);
    assert_eq!(string(81), [false; 81]);
}

/// Three joints on one line, tied to each other: their lengths are not independent there, and decide
/// nothing. Bent, they are a triangle, and all of it moves.
#[test]
fn joints_on_a_line_have_no_room_to_first_order() {
    let room = |middle: Vector| {
        let mut joints = ["A", "P", "Q", "R"].map(Joint::free).to_vec();
        joints[0] = Joint::anchor("A", [9.0, 9.0, 9.0]);
        let joints_m = vec![[9.0; 3], [0.0; 3], middle, [2.0, 0.0, 0.0]];
        let member = |from: usize, to: usize| {
            let length_m = norm(minus(joints_m[to], joints_m[from]));
            Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap())
        };
        let members = vec![member(1, 2), member(2, 3), member(3, 1)];
        let mut tied = members.clone();
        tied.push(member(0, 1));
        let system = System::new("three", 10.0, joints, tied).unwrap();
        let answer = SystemEquilibrium { joints_m, ..lamp().1 };
        with_room(
            &system,
            &[answer],
            &members_of(&system),
            &[1, 2, 3],
            &ways(&system, Support::motions),
        )
    };
    assert_eq!(room([1.0, 0.0, 0.0]), [false; 3]);
    assert_eq!(room([1.0, 1.0, 0.0]), [true; 3]);
}

/// On a floor 4 m below, a second weight lies beside the lamp's; a cable that bears less than 1e-8 of
/// the least load lets it slide.
#[test]
fn what_lies_with_members_that_bear_nothing_is_loose() {
    let (system, mut answer) = lamp();
    let mut joints = system.joints().to_vec();
    joints.push(Joint::free("Q").with_mass(0.3));
    let mut members = system.members().to_vec();
    members.push(Member::cable(2, 3, Bar::homogeneous(7.0, 0.0).unwrap()));
    let system = System::new("lying", 10.0, joints, members).unwrap().with_floor(-4.0).unwrap();
    joined(&mut answer, [1.0, 1.0, -4.0], [0.0, 0.0, 3.0], 1);
    let loose = |change: &dyn Fn(&mut SystemEquilibrium)| {
        let mut second = answer.clone();
        change(&mut second);
        let found = free_joints(&system, &[answer.clone(), second]);
        assert_eq!(found[..3], [false; 3]);
        found[3]
    };
    assert!(loose(&|_| ()));
    // The least load is 2 N, of the lamp.
    assert!(loose(&|a| a.axial_n[2] = 1.9e-8) && loose(&|a| a.axial_n[2] = -1.9e-8));
    assert!(!loose(&|a| a.axial_n[2] = 2.1e-8) && !loose(&|a| a.axial_n[2] = -2.1e-8));
    assert!(!loose(&|a| a.reactions_n[3] = [0.0; 3]));
    assert!(!loose(&|a| a.reactions_n[3] = [0.0, 0.0, -3.0]));
}

/// A heavy bar of 4 m hangs from an anchor and just reaches the floor: at its middle it bears nothing, yet its lower joint
/// carries half its weight and cannot slide. A light one holds it there as well. Two bars of 2 m on the floor leave their joint no
/// room, whether they are straight or not; one does.
#[test]
fn what_hangs_to_the_floor_or_is_held_on_it_is_not_loose() {
    let loose = |bars: usize, length_m: f64, ends: [Vector; 2], place: Vector| {
        [2.0, 0.0].map(|mass_kg| {
            let joints = ["A", "B", "P"].map(Joint::free).into_iter().enumerate();
            let joints = joints.map(|(k, joint)| match ends.get(k) {
                Some(at) => Joint::anchor(joint.name, *at),
                None => joint.with_mass(1.0),
            });
            let bar = Bar::homogeneous(length_m, mass_kg).unwrap();
            let members = (0..bars).map(|end| Member::bar(end, 2, bar)).collect();
            let system = System::new("floor", 10.0, joints.collect(), members).unwrap();
            let system = system.with_floor(0.0).unwrap();
            let answer = SystemEquilibrium {
                joints_m: vec![ends[0], ends[1], place],
                reactions_n: vec![[0.0; 3], [0.0; 3], [0.0, 0.0, 10.0]],
                axial_n: vec![0.0; bars],
                ..lamp().1
            };
            free_joints(&system, &[answer])[2]
        })
    };
    let (o, far, near) = ([0.0; 3], [4.0, 0.0, 0.0], [2.4, 0.0, 0.0]);
    assert_eq!(loose(1, 4.0, [[0.0, 0.0, 4.0], far], o), [false; 2]);
    assert_eq!(loose(2, 2.0, [o, far], [2.0, 0.0, 0.0]), [false; 2]);
    assert_eq!(loose(2, 2.0, [o, near], [1.2, 1.6, 0.0]), [false; 2]);
    assert_eq!(loose(1, 2.0, [o, near], [1.2, 1.6, 0.0]), [true; 2]);
}

/// A joint is loaded by its own mass or force, and by what its members leave to it by the lever rule.
#[test]
fn joints_are_idle_where_nothing_acts_on_them() {
    let idle_with = |change: &dyn Fn(&mut Vec<Joint>, &mut Vec<Member>)| {
        let mut joints = ["A", "P", "Q"].map(Joint::free).to_vec();
        joints[0] = Joint::anchor("A", [0.0; 3]);
        let light = Bar::homogeneous(1.0, 0.0).unwrap();
        let mut members = vec![Member::bar(0, 1, light), Member::bar(1, 2, light)];
        change(&mut joints, &mut members);
        let system = System::new("light", 10.0, joints, members).unwrap();
        let answer = SystemEquilibrium { axial_n: vec![0.0; 2], ..lamp().1 };
        idle(&system, &[answer], &ways(&system, Support::motions))
    };
    assert_eq!(idle_with(&|_, _| ()), [false, true, true]);
    assert_eq!(idle_with(&|joints, _| joints[2].mass_kg = 1e-9), [false, true, false]);
    for axis in 0..3 {
        let pulled = idle_with(&|joints, _| joints[1].force_n[axis] = -1e-9);
        assert_eq!(pulled, [false, false, true]);
        let on_a_member = idle_with(&|_, members| {
            let mut force_n = [0.0; 3];
            force_n[axis] = 1.0;
            members[1].loads =
                vec![model::system::PointLoad { at_m: 0.5, force_n, is_spread: false }];
        });
        assert_eq!(on_a_member, [false; 3]);
    }
    let heavy = |_: &mut Vec<Joint>, members: &mut Vec<Member>| {
        members[0].body = Bar::homogeneous(1.0, 1e-9).unwrap();
    };
    assert_eq!(idle_with(&heavy), [false, false, true]);
}

/// Exactly at the bound nothing is slack.
#[test]
fn a_millionth_of_the_length_is_not_slack() {
    assert!(!at(Kind::Cable, 2.0 * (1.0 - 1e-6)) && !at(Kind::Strut, 2.0 * (1.0 + 1e-6)));
}
