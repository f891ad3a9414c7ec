//! Turns by hand.

use super::super::tests::propped;
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
    assert_eq!(parts, 1);
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
        assert_eq!(turned_onto(&system, &first, &short, &[false; 3]), (Cow::Borrowed(&short), 0));
    }
    let mut short = first;
    short.joints_m.truncate(2);
    assert_eq!(turned_onto(&system, &short, &second, &[false; 3]), (Cow::Borrowed(&second), 0));
}

/// What is out of balance before is turned, what would only get so is not: the joint that is left
/// out says nothing about the turn.
#[test]
fn joints_that_are_left_out_do_not_count() {
    let (system, first) = propped(1.0, 0.0);
    let (_, second) = propped(0.6, 0.8);
    let (turned, parts) = turned_onto(&system, &first, &second, &[false, false, true]);
    assert_eq!(parts, 1);
    assert!(norm(minus(turned.joints_m[2], second.joints_m[2])) < 1e-14, "{:?}", turned.joints_m);
}
