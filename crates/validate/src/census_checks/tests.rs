//! What a census is held against, with an index that is wrong and with numbers that are none.

use super::*;

#[test]
fn either_index_counts() {
    let problem = model::cases::paper();
    let census = Census::take(&problem, &census::Settings::default()).unwrap();
    let same = |census: &Census| -> Vec<bool> {
        visits(&problem, census).unwrap().iter().map(|visit| visit.same_stability).collect()
    };
    assert_eq!(same(&census), [true; 2]);
    // The index in space is the sum of both: one wrong, the sum right; and the other way round.
    let mut wrong = census.clone();
    wrong.equilibria[1].index_in_plane -= 1;
    wrong.equilibria[1].index_out_of_plane += 1;
    assert_eq!(same(&wrong), [true, false]);
    let mut wrong = census;
    wrong.equilibria[0].index_out_of_plane += 1;
    assert_eq!(same(&wrong), [false, true]);
}

#[test]
fn the_larger_of_two_remembers_what_is_none() {
    for (a, b, larger) in [(1.0, 2.0, 2.0), (2.0, 1.0, 2.0), (-2.0, -1.0, -1.0)] {
        assert_eq!(worse(a, b).to_bits(), f64::to_bits(larger));
    }
    for (a, b) in [(f64::NAN, 1.0), (1.0, f64::NAN), (f64::NAN, f64::NAN)] {
        assert!(worse(a, b).is_nan(), "{a} {b}");
    }
}

/// An interval from 1 to 2.
#[test]
fn what_lies_outside_is_measured_from_the_nearer_end() {
    let part = Interval::new(1.0, 2.0);
    for (x, off) in [(0.75, 0.25), (1.0, 0.0), (1.5, 0.0), (2.0, 0.0), (4.5, 2.5)] {
        assert_eq!(outside(part, x).to_bits(), f64::to_bits(off), "{x}");
    }
    assert!(outside(part, f64::NAN).is_nan());
}
