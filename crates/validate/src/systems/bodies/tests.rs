//! Bodies of trees, and what feels a turn, by hand.

use model::Bar;
use model::system::PointLoad;

use super::*;

/// An anchor A with bars A-P, P-Q and A-R.
fn tree(change: impl Fn(&mut Vec<Joint>, &mut Vec<Member>)) -> System {
    let mut joints: Vec<Joint> = ["A", "P", "Q", "R"].map(Joint::free).into();
    joints[0] = Joint::anchor("A", [0.0; 3]);
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let mut members = [(0, 1), (1, 2), (0, 3)].map(|(from, to)| Member::bar(from, to, bar)).into();
    change(&mut joints, &mut members);
    System::new("tree", 9.81, joints, members).unwrap()
}

/// Q turns about P, P and R about A: Q goes wherever the pivots P and A go, and nothing goes where
/// its neighbour on another branch or what hangs on it goes.
#[test]
fn a_joint_moves_with_its_body_and_the_pivots_above_it() {
    let bodies = Bodies::new(&tree(|_, _| ()), |_| true);
    let moving: Vec<(usize, usize)> = (0..4)
        .flat_map(|joint| (0..4).map(move |other| (joint, other)))
        .filter(|(joint, other)| bodies.moves_with(*joint, *other))
        .collect();
    assert_eq!(moving, [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2), (3, 0), (3, 3)]);
    let depths = bodies.of_joint.iter().map(|body| bodies.all[*body].depth).collect::<Vec<_>>();
    assert_eq!(depths, [0, 1, 2, 1]);
}

#[test]
fn level_loads_feel_a_turn_in_both_directions() {
    let at_q = |force_n: [f64; 3]| feeling_turns(&tree(|joints, _| joints[2].force_n = force_n));
    assert_eq!(at_q([0.0, 0.0, -3.0]), [true, false, false, false]);
    for force_n in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]] {
        assert_eq!(at_q(force_n), [true, false, true, false], "{force_n:?}");
    }
    let on_a_member = |force_n: [f64; 3]| {
        feeling_turns(&tree(|_, members| {
            members[1].loads = vec![PointLoad { at_m: 0.5, force_n, is_spread: false }];
        }))
    };
    assert_eq!(on_a_member([0.0, 0.0, -3.0]), [true, false, false, false]);
    assert_eq!(on_a_member([0.0, -1.0, 0.0]), [true, true, true, false]);
}

/// A plane feels a turn unless it is level, a line always.
#[test]
fn supports_feel_a_turn() {
    let of = |support: Support| feeling_turns(&tree(|joints, _| joints[3].support = support))[3];
    let at_m = [0.0, 1.0, 0.0];
    assert!(!of(Support::Plane { at_m, normal: [0.0, 0.0, 1.0] }));
    assert!(of(Support::Plane { at_m, normal: [0.0, 0.6, 0.8] }));
    assert!(of(Support::Line { at_m, direction: [0.0, 0.0, 1.0] }));
    assert!(!of(Support::Free));
}

/// Body 1 hangs on body 2, which hangs on body 3, and 4 on 1.
#[test]
fn depths_are_counted_in_any_order() {
    let body = |pivot: Option<usize>| Body { pivot, slides: Slides::Not, depth: 9 };
    let mut bodies = Bodies {
        of_joint: vec![0, 1, 2, 3, 4],
        all: vec![body(None), body(Some(2)), body(Some(3)), body(Some(0)), body(Some(1))],
        fixed: vec![false; 5],
        neighbours: vec![vec![]; 5],
    };
    bodies.count_depths();
    let depths: Vec<usize> = bodies.all.iter().map(|body| body.depth).collect();
    assert_eq!(depths, [0, 3, 2, 1, 4]);
}

/// Anchors and upright guides on one vertical are one; a sloping guide, and what stands beside, are
/// not. Far from the origin as well.
#[test]
fn what_stands_on_one_vertical_is_one_node() {
    let far = 2.0_f64.powi(40);
    for [far_x, far_y] in [[0.0, 0.0], [far, 0.0], [0.0, far]] {
        let beside = if far_x + far_y > 0.0 { 2.0_f64.powi(-12) } else { 1e-9 };
        let at = |off: f64, z: f64| {
            if far_y > 0.0 { [7.0, far_y + off, z] } else { [far_x + off, 7.0, z] }
        };
        let guide = |at_m: [f64; 3], direction: [f64; 3]| Support::Line { at_m, direction };
        let supports = [
            Support::Fixed { at_m: at(0.0, 1.0) },
            guide(at(0.0, 2.0), [0.0, 0.0, 1.0]),
            guide(at(0.0, 3.0), [0.0, 0.6, 0.8]),
            Support::Fixed { at_m: at(beside, 4.0) },
            Support::Fixed { at_m: at(0.0, 5.0) },
            Support::Plane { at_m: at(0.0, 6.0), normal: [0.0, 0.0, 1.0] },
        ];
        let joints: Vec<Joint> = supports
            .into_iter()
            .enumerate()
            .map(|(k, support)| Joint::free(k.to_string()).held_by(support))
            .collect();
        let bar = Bar::homogeneous(1.0, 1.0).unwrap();
        let members = (1..6).map(|k| Member::bar(0, k, bar)).collect();
        let system = System::new("guides", 10.0, joints, members).unwrap();
        assert_eq!(nodes(&system), [0, 0, 2, 3, 0, 5], "{far_x} {far_y}");
    }
}

/// Two anchors of one vertical and what hangs between them turn as one body about it; what is tied
/// to a third anchor does not.
#[test]
fn anchors_of_one_vertical_carry_one_body() {
    let bodies = |third: bool| {
        let mut joints: Vec<Joint> = ["A", "B", "P", "Q", "C"].map(Joint::free).into();
        joints[0] = Joint::anchor("A", [0.0; 3]);
        joints[1] = Joint::anchor("B", [0.0, 0.0, -3.0]);
        joints[4] = Joint::anchor("C", [5.0, 0.0, 0.0]);
        let bar = Bar::homogeneous(2.0, 1.0).unwrap();
        let mut ends = vec![(0, 2), (2, 3), (3, 1), (4, 0)];
        if third {
            ends.push((3, 4));
        }
        let members = ends.into_iter().map(|(from, to)| Member::bar(from, to, bar)).collect();
        let bodies =
            Bodies::new(&System::new("two anchors", 10.0, joints, members).unwrap(), |_| true);
        let pivots: Vec<_> = bodies.all.iter().map(|body| body.pivot).collect();
        (bodies.of_joint, pivots)
    };
    let (of_joint, pivots) = bodies(false);
    assert_eq!(of_joint, [0, 0, 1, 1, 0]);
    assert!(pivots.len() == 2 && pivots[0].is_none() && pivots[1].is_some_and(|pivot| pivot < 2));
    assert_eq!(bodies(true), (vec![0; 5], vec![None]));
}

/// What touches a vertical in one joint hinges on nothing but that.
#[test]
fn one_joint_is_no_hinge() {
    let mut bodies = Bodies::new(&tree(|_, _| ()), |_| true);
    bodies.add_hinged(&[vec![0, 3]], |_, _| 0.0, 1.0);
    assert_eq!((bodies.all.len(), bodies.of_joint), (4, vec![0, 1, 2, 3]));
}
