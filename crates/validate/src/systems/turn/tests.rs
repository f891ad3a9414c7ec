//! Turns by hand.

use model::system::Joint;
use model::{Bar, Jam};

use super::super::tests::{lamp, propped};
use super::*;

/// A quarter turn about (1, 2), and from there to (10, 20).
#[test]
fn a_place_turns_about_its_pivot_and_goes_along() {
    let turn = Turn { from_m: [1.0, 2.0], to_m: [10.0, 20.0], cos: 0.6, sin: 0.8 };
    let close = |found: Vector, wanted: Vector| {
        assert!(norm(minus(found, wanted)) < 1e-14, "{found:?}, not {wanted:?}");
    };
    close(turn.vector([5.0, 10.0, 3.0]), [-5.0, 10.0, 3.0]);
    close(turn.place([6.0, 12.0, 3.0]), [5.0, 30.0, 3.0]);
    close(Turn::NONE.place([6.0, 12.0, 3.0]), [6.0, 12.0, 3.0]);
}

#[test]
fn what_is_not_complete_is_not_turned() {
    let (system, first) = propped(1.0, 0.0);
    let (_, second) = propped(0.6, 0.8);
    let (turned, parts) = turned_onto(&system, &first, &second, &[false; 3]);
    assert_eq!(parts, [1, 0]);
    for (found, wanted) in turned.joints_m.iter().zip(&first.joints_m) {
        assert!(norm(minus(*found, *wanted)) < 1e-14, "{found:?}");
    }
    for (found, wanted) in turned.reactions_n.iter().zip(&first.reactions_n) {
        assert!(norm(minus(*found, *wanted)) < 1e-14, "{found:?}");
    }
    let changes: [fn(&mut SystemEquilibrium); 4] = [
        |a| a.joints_m.truncate(2),
        |a| a.start_forces_n.truncate(1),
        |a| a.end_forces_n.truncate(1),
        |a| a.reactions_n.truncate(2),
    ];
    for change in changes {
        let mut short = second.clone();
        change(&mut short);
        assert_eq!(
            turned_onto(&system, &first, &short, &[false; 3]),
            (Cow::Borrowed(&short), [0; 2])
        );
    }
    let mut short = first;
    short.joints_m.truncate(2);
    assert_eq!(
        turned_onto(&system, &short, &second, &[false; 3]),
        (Cow::Borrowed(&second), [0; 2])
    );
}

/// What is out of balance before is turned, what would only get so is not: the joint that is left
/// out says nothing about the turn.
#[test]
fn joints_that_are_left_out_do_not_count() {
    let (system, first) = propped(1.0, 0.0);
    let (_, second) = propped(0.6, 0.8);
    let (turned, parts) = turned_onto(&system, &first, &second, &[false, false, true]);
    assert_eq!(parts, [1, 0]);
    assert!(norm(minus(turned.joints_m[2], second.joints_m[2])) < 1e-14, "{:?}", turned.joints_m);
}

/// A-P goes by (3, 4)/5 about A, P-Q by a right angle about P, each with its forces and with the pull where it jams.
#[test]
fn forces_turn_with_their_own_span() {
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P"), Joint::free("Q")];
    let members = vec![Member::bar(0, 1, bar), Member::bar(1, 2, bar)];
    let system = System::new("two", 9.81, joints, members).unwrap();
    let along = [1.0, 0.0, 2.0];
    let mut answer = SystemEquilibrium {
        joints_m: vec![[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        start_forces_n: vec![along; 2],
        end_forces_n: vec![along.map(|x| -x); 2],
        axial_n: vec![1.0; 2],
        reactions_n: vec![[0.0; 3]; 3],
        ..lamp().1
    };
    answer.evidence.jams = (0..2).map(|member| Jam { member, span: 0, pull_n: along }).collect();
    let bodies = Bodies::new(&system, |_| true);
    let turn = |cos, sin| Turn { cos, sin, ..Turn::NONE };
    let mut turns = [Turn::NONE; 3];
    (turns[bodies.of_joint[1]], turns[bodies.of_joint[2]]) = (turn(0.6, 0.8), turn(0.0, 1.0));
    let found = turned(&system, &answer, &bodies, &turns);
    let wanted = [[0.6, 0.8, 2.0], [0.0, 1.0, 2.0]];
    assert_eq!(found.start_forces_n, wanted);
    assert_eq!(found.evidence.jams.iter().map(|jam| jam.pull_n).collect::<Vec<_>>(), wanted);
}
