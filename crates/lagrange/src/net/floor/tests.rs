//! The rounds of the floor, by hand.

use model::Bar;
use model::system::Member;
use nalgebra::Matrix3;

use super::*;
use crate::net::Settings;
use crate::net::directions::Directions;
use crate::net::framework::Units;

/// On a slope of 45 degrees the floor's push N up and the support's push across it leave a reaction
/// of which N can be told.
#[test]
fn the_push_of_the_floor_is_what_the_support_cannot_bear() {
    let (third, root) = (1.0 / 3.0, 0.5_f64.sqrt());
    for (axis, across) in [
        (Vector3::new(root, 0.0, root), Vector3::new(1.0, 0.0, -1.0)),
        (Vector3::new(0.0, 0.6, 0.8), Vector3::new(0.0, 0.8, -0.6)),
        (Vector3::new(2.0 * third, 2.0 * third, third), Vector3::new(1.0, -1.0, 0.0)),
        (Vector3::z(), Vector3::x()),
    ] {
        let axes = Matrix3::from_columns(&[axis, Vector3::zeros(), Vector3::zeros()]);
        let free = Directions::new(axes, 1);
        let node = Node { base: Vector3::zeros(), free, load: Vector3::zeros() };
        let reaction = Vector3::new(0.0, 0.0, 3.0) + across * 7.0;
        assert!((push_n(&node, reaction.into()) - 3.0).abs() < 1e-14);
    }
    let held = Node { base: Vector3::zeros(), free: Directions::Held, load: Vector3::zeros() };
    assert!(push_n(&held, [1.0, 2.0, 3.0]).abs() <= 0.0);
}

/// An anchor and two weights of 1 N that hang one below the other, 5 m above the floor.
fn strand() -> System {
    let joints = samples::joints(&[[0.0; 3]], &[1.0, 1.0]);
    let bar = Bar::homogeneous(1.0, 0.0).unwrap();
    let members = vec![Member::bar(0, 1, bar), Member::bar(1, 2, bar)];
    System::new("strand", 1.0, joints, members).unwrap().with_floor(-5.0).unwrap()
}

/// Rounds with answers by hand; both joints lie at first. Where B lies the floor would have to pull
/// it, more than C weighs; where it does not, both are below the floor, but where C lies alone, and
/// `settles` is true. Which of them lie, by round.
fn rounds(settles: bool) -> (Vec<[bool; 2]>, Result<Solution, Error>) {
    let system = strand();
    let framework = Framework::new(&system);
    let flat = crate::net::solve(&strand(), &Settings::default()).unwrap();
    let mut rounds = Vec::new();
    let begin = Some(vec![false, true, true]);
    let answer = above(&system, framework, begin, &Settings::default(), |framework| {
        let lies = [1, 2].map(|joint: usize| framework.nodes[joint].freedom() == 2);
        rounds.push(lies);
        let mut solution = flat.clone();
        solution.factorisations = 3;
        let answer = &mut solution.equilibrium;
        let above = settles && lies == [false, true];
        let depth_m = if above { -1.0 } else { -6.0 };
        answer.joints_m = vec![[0.0; 3], [0.0, 0.0, depth_m], [0.0, 0.0, depth_m]];
        let pull_n = if lies[0] { -10.0 } else { 0.0 };
        answer.reactions_n = vec![[0.0; 3], [0.0, 0.0, pull_n], [0.0, 0.0, 1.0]];
        Ok(solution)
    });
    (rounds, answer)
}

/// In the first rounds what is pulled off lifts its neighbours with it: both joints lie and neither,
/// in turn. After thirty it lifts itself alone.
#[test]
fn joints_are_lifted_one_by_one_where_together_goes_to_and_fro() {
    let (rounds, answer) = rounds(true);
    for (k, lie) in rounds.iter().take(31).enumerate() {
        assert_eq!(*lie, [k % 2 == 0; 2], "{k}");
    }
    assert_eq!(rounds[31..], [[false, true]]);
    assert_eq!(answer.unwrap().factorisations, 3 * 32);
}

#[test]
fn rounds_that_lead_nowhere_end() {
    let (rounds, answer) = rounds(false);
    assert_eq!(rounds.len(), 200);
    assert!(matches!(answer, Err(Error::Floor { rounds: 200 })));
}

/// Joints of 1, 2 and 4 N side by side on the floor: a pull lifts as many neighbours as it can bear.
#[test]
fn a_pull_lifts_the_weights_that_it_can_bear() {
    let node = |weight: f64| Node {
        base: Vector3::zeros(),
        free: Directions::All,
        load: Vector3::new(0.0, 0.0, -weight),
    };
    let framework = Framework {
        units: Units { length_m: 1.0, force_n: 2.0, origin_m: Vector3::zeros() },
        nodes: [8.0, 1.0, 2.0, 4.0].map(node).into(),
        links: Vec::new(),
        ropes: Vec::new(),
        lying: Vec::new(),
        work: crate::net::work::Work::default(),
    };
    let neighbours = [vec![1], vec![0, 2], vec![1, 3], vec![2]];
    for (force_n, lifted) in [(1.9, 0), (2.0, 1), (5.9, 1), (6.0, 2), (13.9, 2), (14.0, 3)] {
        let mut lies = [false, true, true, true];
        lift_neighbours(&framework, &neighbours, &mut lies, 0, force_n);
        assert_eq!(lies.iter().filter(|lies| !**lies).count(), 1 + lifted, "{force_n}");
    }
}
