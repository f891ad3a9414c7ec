//! Bodies of trees, and what feels a turn, by hand.

use model::Bar;
use model::system::{Joint, Member, PointLoad};

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
    let bodies = Bodies::new(&tree(|_, _| ()));
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
        feeling_turns(&tree(|_, members| members[1].loads = vec![PointLoad { at_m: 0.5, force_n }]))
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
