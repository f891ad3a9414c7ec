//! What the floor bears, wholly or in part: closed forms by weights and lengths.

use lagrange::net::{Error, Forces, Settings, Solution, solve};
use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, ForceRange};

/// Forces are right to this part of the weight.
const DIGITS: f64 = 1e-10;

fn light(kind: Kind, from: usize, to: usize, length_m: f64) -> Member {
    Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap()).of_kind(kind)
}

/// Above a floor, g = 10 m/s².
#[track_caller]
fn solved(joints: Vec<Joint>, members: Vec<Member>, floor_m: f64) -> (System, Solution) {
    let system = System::new("floor", 10.0, joints, members).unwrap().with_floor(floor_m).unwrap();
    let solution = solve(&system, &Settings::default()).unwrap();
    (system, solution)
}

fn weight(name: &str) -> Joint {
    Joint::free(name).with_mass(1.0)
}

#[track_caller]
fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= DIGITS * 10.0, "{found} is not {wanted}");
}

/// The floor's push on a joint.
fn push_n(solution: &Solution, joint: usize) -> f64 {
    solution.equilibrium.reactions_n[joint][2]
}

/// The range of a member.
#[track_caller]
fn range(solution: &Solution, member: usize) -> [Option<f64>; 2] {
    let told = solution.equilibrium.evidence.self_stresses.as_ref().unwrap();
    let ranges = told.ranges.as_ref().unwrap();
    let ForceRange::Bounded { least_n, most_n } = ranges[member] else { panic!("{ranges:?}") };
    [least_n, most_n]
}

#[track_caller]
fn bounds(found: [Option<f64>; 2], wanted: [Option<f64>; 2]) {
    for (found, wanted) in found.into_iter().zip(wanted) {
        match (found, wanted) {
            (Some(found), Some(wanted)) => close(found, wanted),
            _ => assert_eq!(found, wanted),
        }
    }
}

/// A weight of 10 N on a member that just reaches the floor: N + push = 10 N. Rigid between rigid
/// supports the equally stiff member bears nothing; it may bear all, a bar also push.
#[test]
fn a_weight_that_just_touches_the_floor_rests_on_both() {
    for (kind, least) in [(Kind::Bar, None), (Kind::Cable, Some(0.0))] {
        for gap in [-1e-16, 0.0, 1e-16] {
            let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0 + gap]), weight("P")];
            let (_, found) = solved(joints, vec![light(kind, 0, 1, 1.0)], 0.0);
            assert_eq!(found.forces, Forces::LeastNorm, "{kind:?} {gap}");
            assert_eq!(found.self_stresses.as_ref().map(Vec::len), Some(1), "{kind:?} {gap}");
            close(found.equilibrium.axial_n[0], 0.0);
            close(push_n(&found, 1), 10.0);
            bounds(range(&found, 0), [least, Some(10.0)]);
        }
        // A little higher, by more than rounding, the member bears it alone.
        for gap in [1e-13, 1e-12, 3e-12, 1e-11, 3e-10, 1e-9, 1e-6] {
            let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0 + gap]), weight("P")];
            let (_, found) = solved(joints, vec![light(kind, 0, 1, 1.0)], 0.0);
            assert_eq!(found.forces, Forces::Unique, "{kind:?} {gap}");
            close(found.equilibrium.axial_n[0], 10.0);
            assert!(push_n(&found, 1).abs() <= 0.0);
        }
    }
}

/// Two weights of 10 N on 0.4 m and 0.6 m that together just reach the floor: N1 = N2 + 10 N, and
/// 0.4 N1² + 0.6 N2² is least at N2 = -4 N. Cables cannot push: N2 is from 0 to 10 N, and least at 0.
#[test]
fn members_in_a_row_that_just_reach_the_floor_share_with_it() {
    let row = |kind| {
        let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0]), weight("Q"), weight("P")];
        solved(joints, vec![light(kind, 0, 1, 0.4), light(kind, 1, 2, 0.6)], 0.0)
    };
    let (_, found) = row(Kind::Bar);
    assert_eq!(found.forces, Forces::LeastNorm);
    close(found.equilibrium.axial_n[0], 6.0);
    close(found.equilibrium.axial_n[1], -4.0);
    close(push_n(&found, 2), 14.0);
    bounds(range(&found, 0), [None, Some(20.0)]);
    bounds(range(&found, 1), [None, Some(10.0)]);
    let (_, found) = row(Kind::Cable);
    assert_eq!(found.forces, Forces::LeastNorm);
    close(found.equilibrium.axial_n[0], 10.0);
    close(found.equilibrium.axial_n[1], 0.0);
    close(push_n(&found, 2), 10.0);
    bounds(range(&found, 0), [Some(10.0), Some(20.0)]);
    bounds(range(&found, 1), [Some(0.0), Some(10.0)]);
}

/// A V of 5 m, 4 m high: its members bear 0 to 10 N * 5 / (2 * 4) each.
#[test]
fn a_v_that_just_touches_the_floor_shares_with_it() {
    for (kind, least) in [(Kind::Bar, None), (Kind::Cable, Some(0.0))] {
        let anchor = |name: &str, x| Joint::anchor(name, [x, 0.0, 4.0]);
        let joints = vec![anchor("A", 0.0), anchor("B", 6.0), weight("P")];
        let members = vec![light(kind, 0, 2, 5.0), light(kind, 1, 2, 5.0)];
        let (_, found) = solved(joints, members, 0.0);
        close(push_n(&found, 2), 10.0);
        for member in 0..2 {
            close(found.equilibrium.axial_n[member], 0.0);
            bounds(range(&found, member), [least, Some(6.25)]);
        }
    }
    // Pulled aside by 50 N from 5 m and 8.5 m the least forces would pull at the floor: it bears nothing then.
    let anchor = |name: &str, x| Joint::anchor(name, [x, 0.0, 4.0]);
    let pulled = weight("P").with_force([50.0, 0.0, 0.0]);
    let members = vec![light(Kind::Bar, 0, 2, 5.0), light(Kind::Bar, 1, 2, 8.5)];
    let (_, found) = solved(vec![anchor("A", -3.0), anchor("B", 7.5), pulled], members, 0.0);
    assert_eq!(found.forces, Forces::LeastNorm);
    // 0.6 N1 - 15/17 N2 = 50 N, 0.8 N1 + 8/17 N2 = 10 N.
    let first = 68.75 / 2.1;
    close(found.equilibrium.axial_n[0], first);
    close(found.equilibrium.axial_n[1], (10.0 - 0.8 * first) * 17.0 / 8.0);
    close(push_n(&found, 2), 0.0);
}

/// At the force aside at which the floor bears nothing any more (3, 4, 5) nothing is open: the bar
/// alone balances it.
#[test]
fn a_weight_about_to_leave_the_floor_leaves_nothing_open() {
    let joints = vec![Joint::anchor("A", [0.0, 0.0, 4.0]), weight("P").with_force([7.5, 0.0, 0.0])];
    let (_, found) = solved(joints, vec![light(Kind::Bar, 0, 1, 5.0)], 0.0);
    assert_eq!(found.forces, Forces::Unique);
    close(found.equilibrium.axial_n[0], 12.5);
    close(push_n(&found, 1), 0.0);
}

/// A bar of 20 N down to the floor, and two that lie there: the floor bears what hangs at the joint
/// that just touches it, all of it, or none.
#[test]
fn a_row_that_lies_from_where_it_just_touches() {
    let heavy =
        |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 2.0).unwrap());
    let joints = vec![
        Joint::anchor("A", [0.0, 0.0, 1.0]),
        Joint::free("Q"),
        Joint::free("R"),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
    ];
    let members = vec![heavy(0, 1, 1.0), heavy(1, 2, 2.0), heavy(2, 3, 1.0)];
    let (_, found) = solved(joints, members, 0.0);
    for axial_n in &found.equilibrium.axial_n {
        close(*axial_n, 0.0);
    }
    close(push_n(&found, 1), 20.0);
    close(push_n(&found, 2), 20.0);
    bounds(range(&found, 0), [None, Some(20.0)]);
}

/// Bars longer than the floor is deep reach aside, by Pythagoras, and bear nothing; cables are
/// slack.
#[test]
fn a_weight_wholly_on_the_floor_leaves_its_member_without_force() {
    for excess in [1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10] {
        for kind in [Kind::Bar, Kind::Cable] {
            let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0]), weight("P")];
            let (_, found) = solved(joints, vec![light(kind, 0, 1, 1.0 + excess)], 0.0);
            close(push_n(&found, 1), 10.0);
            assert!(found.equilibrium.axial_n[0].abs() <= 0.0);
            let [x, y, z] = found.equilibrium.joints_m[1];
            assert!(z.abs() < 1e-12, "{z}");
            let (aside, square) = (x.hypot(y), excess * (2.0 + excess));
            if kind == Kind::Bar {
                // The length is right to 1e-12.
                assert!((aside * aside - square).abs() < 4e-12, "{excess}: {aside}");
                assert!(found.slack.is_empty());
            } else {
                assert!(aside * aside < square, "{excess}: {aside}");
                assert_eq!(found.slack, [0]);
            }
            let counts = &found.equilibrium.stability;
            let slides = if kind == Kind::Bar { 1 } else { 2 };
            assert_eq!((counts.index_in_space, counts.neutral), (0, slides), "{excess} {kind:?}");
        }
    }
}

/// Bars of 30 N and weights of 10 N and 20 N that lie flat: joints bear by the lever rule.
#[test]
fn bars_that_lie_flat_press_with_their_weight() {
    let heavy = |from, to| Member::bar(from, to, Bar::homogeneous(2.0, 3.0).unwrap());
    let joints = vec![Joint::anchor("A", [0.0; 3]), weight("P"), Joint::free("Q").with_mass(2.0)];
    let (_, found) = solved(joints, vec![heavy(0, 1), heavy(1, 2)], 0.0);
    for (joint, wanted) in [15.0, 40.0, 35.0].into_iter().enumerate() {
        close(push_n(&found, joint), wanted);
    }
    for [axial_n, bend_n] in [0, 1].map(|k| [k, k].map(|k| found.equilibrium.axial_n[k])) {
        assert!(axial_n.abs() <= 0.0 && bend_n.abs() <= 0.0);
    }
}

/// In a slanted plane, down to the floor: it slides level there, and the floor bears it alone.
#[test]
fn a_weight_on_a_slanted_plane_ends_on_the_floor() {
    let support = Support::Plane { at_m: [0.0, 0.0, 5.0], normal: [0.6, 0.0, 0.8] };
    for kind in [Kind::Cable, Kind::Bar] {
        let joints = vec![Joint::anchor("A", [0.0; 3]), weight("P").held_by(support)];
        let (_, found) = solved(joints, vec![light(kind, 0, 1, 20.0)], -1.0);
        let [rx, ry, rz] = found.equilibrium.reactions_n[1];
        assert!(rx.abs() < 1e-9 && ry.abs() < 1e-9, "{rx} {ry}");
        close(rz, 10.0);
        // 0.6 x + 0.8 (z - 5) = 0 at z = -1.
        let [x, y, z] = found.equilibrium.joints_m[1];
        close(x, 8.0);
        close(z, -1.0);
        if kind == Kind::Bar {
            close(x * x + y * y + z * z, 400.0);
        }
    }
}

/// An elastic bar that reaches the floor unstretched bears nothing; a cord that is too long neither.
#[test]
fn elastic_members_above_what_the_floor_bears_are_unstretched() {
    for (kind, length_m) in [(Kind::Bar, 1.0), (Kind::Bar, 1.5), (Kind::Cable, 1.5)] {
        let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0]), weight("P")];
        let member = light(kind, 0, 1, length_m).with_stiffness(100.0);
        let (_, found) = solved(joints, vec![member], 0.0);
        close(push_n(&found, 1), 10.0);
        close(found.equilibrium.axial_n[0], 0.0);
    }
}

/// A weight that no member keeps from falling: the floor catches it, where its strut need not push.
#[test]
fn a_weight_below_a_strut_falls_onto_the_floor() {
    for length_m in [0.5, 1.0] {
        let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0]), weight("P")];
        let (_, found) = solved(joints, vec![light(Kind::Strut, 0, 1, length_m)], 0.0);
        let [x, y, z] = found.equilibrium.joints_m[1];
        assert!(z.abs() < 1e-12 && x.hypot(y).hypot(1.0) >= length_m - 1e-12, "{x} {y} {z}");
        close(push_n(&found, 1), 10.0);
        close(found.equilibrium.axial_n[0], 0.0);
    }
    // Drawn aside it goes on without end, on the floor too.
    let joints = vec![Joint::anchor("A", [0.0, 0.0, 1.0]), weight("P").with_force([1.0, 0.0, 0.0])];
    let system = System::new("lost", 10.0, joints, vec![light(Kind::Strut, 0, 1, 0.5)]).unwrap();
    let lost = solve(&system.with_floor(0.0).unwrap(), &Settings::default()).unwrap_err();
    assert!(matches!(lost, Error::Escapes { .. }), "{lost}");
}
