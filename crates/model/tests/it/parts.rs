//! Parts of systems and the verticals about which they turn, read off by hand.

use model::system::{Joint, Member, PointLoad, Support, System};
use model::{Anchors, Bar, Chain};

fn bar(from: usize, to: usize) -> Member {
    Member::bar(from, to, Bar::homogeneous(1.0, 1.0).unwrap())
}

fn held(name: &str, support: Support) -> Joint {
    Joint::free(name).held_by(support)
}

/// A joint held as told, and a free one 1 m from it on a bar.
fn pendulum(support: Support) -> System {
    System::new("", 9.81, vec![held("A", support), Joint::free("P")], vec![bar(0, 1)]).unwrap()
}

/// Two joints that are held, and a free one between them.
fn between(first: Support, second: Support) -> System {
    let joints = vec![held("A", first), Joint::free("P"), held("B", second)];
    System::new("", 9.81, joints, vec![bar(0, 1), bar(1, 2)]).unwrap()
}

fn axis(system: &System) -> Option<[f64; 2]> {
    let [part] = &system.parts()[..] else { panic!("{:?}", system.parts()) };
    part.axis_m
}

#[test]
fn what_hangs_from_one_vertical_turns_about_it() {
    let fixed = |x, y, z| Support::Fixed { at_m: [x, y, z] };
    assert_eq!(axis(&pendulum(fixed(3.0, 4.0, 5.0))), Some([3.0, 4.0]));
    assert_eq!(axis(&between(fixed(3.0, 4.0, 5.0), fixed(3.0, 4.0, 4.0))), Some([3.0, 4.0]));
    for (x, y) in [(3.5, 4.0), (3.0, 4.5), (2.5, 4.0), (3.0, 3.5), (-3.0, -4.0)] {
        assert_eq!(axis(&between(fixed(3.0, 4.0, 5.0), fixed(x, y, 5.0))), None, "{x} {y}");
    }
}

/// The tolerance is a part of the total length, here 2 m and then 2000 m.
#[test]
fn the_vertical_is_wide_in_proportion_to_the_length() {
    let apart = |length_m: f64, gap_m: f64| {
        let body = Bar::homogeneous(length_m, 1.0).unwrap();
        let at = |x: f64| Joint::anchor(format!("{x:e}"), [x, 0.0, 0.0]);
        let joints = vec![at(0.0), Joint::free("P"), at(gap_m)];
        let members = vec![Member::bar(0, 1, body), Member::bar(1, 2, body)];
        let chain = Chain::new(
            "",
            9.81,
            Anchors { start_m: [0.0; 3], end_m: [gap_m, 0.0, 0.0] },
            vec![Bar::homogeneous(length_m, 1.0).unwrap(); 2],
        );
        let turns = axis(&System::new("", 9.81, joints, members).unwrap()).is_some();
        assert_eq!(chain.unwrap().anchors_on_one_vertical(), turns);
        turns
    };
    let tolerance = model::VERTICAL_TOLERANCE;
    assert!(apart(1.0, 1.9 * tolerance) && !apart(1.0, 2.1 * tolerance));
    assert!(apart(1000.0, 1900.0 * tolerance) && !apart(1000.0, 2100.0 * tolerance));
}

#[test]
fn vertical_lines_and_level_planes_leave_the_turn_free() {
    let at_m = [3.0, 4.0, 5.0];
    let (up, across) = ([0.0, 0.0, 1.0], [0.6, 0.8, 0.0]);
    let line = |direction| Support::Line { at_m, direction };
    let plane = |normal| Support::Plane { at_m: [7.0, 8.0, 5.0], normal };
    assert_eq!(axis(&pendulum(line(up))), Some([3.0, 4.0]));
    assert_eq!(axis(&pendulum(line(across))), None);
    assert_eq!(axis(&pendulum(line([0.0, 0.6, 0.8]))), None);
    assert_eq!(axis(&pendulum(plane(across))), None);
    // A joint in a level plane holds no place on the level: the other support gives the axis.
    assert_eq!(axis(&between(plane(up), line(up))), Some([3.0, 4.0]));
    assert_eq!(axis(&between(line(up), plane(up))), Some([3.0, 4.0]));
    assert_eq!(axis(&between(line(up), plane(across))), None);
}

#[test]
fn a_load_that_is_not_vertical_stops_the_turn() {
    let anchor = Joint::anchor("A", [0.0; 3]);
    let with = |force_n| {
        let joints = vec![anchor.clone(), Joint::free("P").with_force(force_n)];
        axis(&System::new("", 9.81, joints, vec![bar(0, 1)]).unwrap())
    };
    let on_member = |force_n| {
        let loads = vec![PointLoad { at_m: 0.5, force_n, is_spread: false }];
        let joints = vec![anchor.clone(), Joint::free("P")];
        let members = vec![bar(0, 1).with_loads(loads)];
        axis(&System::new("", 9.81, joints, members).unwrap())
    };
    for load in [&with as &dyn Fn([f64; 3]) -> Option<[f64; 2]>, &on_member] {
        assert_eq!(load([0.0, 0.0, 5.0]), Some([0.0; 2]));
        for x in [5.0, -5.0] {
            assert_eq!(load([x, 0.0, 0.0]), None);
            assert_eq!(load([0.0, x, 0.0]), None);
        }
    }
}

/// Two pendulums side by side, the second with a level force: each part speaks for itself.
#[test]
fn parts_are_told_apart() {
    let joints = vec![
        Joint::anchor("A", [1.0, 2.0, 0.0]),
        Joint::anchor("B", [9.0, 0.0, 0.0]),
        Joint::free("P"),
        Joint::free("Q").with_force([1.0, 0.0, 0.0]),
    ];
    let system = System::new("", 9.81, joints, vec![bar(0, 2), bar(3, 1)]).unwrap();
    let parts = system.parts();
    assert_eq!(parts.iter().map(|part| &part.joints[..]).collect::<Vec<_>>(), [[0, 2], [1, 3]]);
    assert_eq!(parts.iter().map(|part| part.axis_m).collect::<Vec<_>>(), [Some([1.0, 2.0]), None]);
}
