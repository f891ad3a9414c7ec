//! Measures against what is allowed, exactly at the bound too.

use model::Bar;

use super::*;

#[test]
fn measures_are_told_in_units_of_what_is_allowed() {
    let noted = |value: f64, allowed: f64| {
        let mut found = Measured::default();
        found.note(Place::Whole, Law::Support, value, allowed);
        (found.largest.to_bits(), found.violations.len())
    };
    let told = |largest: f64, violations: usize| (largest.to_bits(), violations);
    assert_eq!(noted(3.0, 2.0), told(1.5, 1));
    assert_eq!(noted(1.0, 4.0), told(0.25, 0));
    // What the tolerance explains to the last digit is no violation.
    assert_eq!(noted(2.0, 2.0), told(1.0, 0));
    assert_eq!(noted(-1.0, 2.0), told(0.0, 0));
}

/// A cable and a strut of 5 m; their ends are known to 0.25 m each, and forces exactly.
#[test]
fn a_member_is_slack_where_both_ends_together_do_not_explain_it() {
    let bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.0 };
    let told = |kind: Kind, distance_m: f64, force_n: f64| {
        let member = Member { kind, ..Member::bar(0, 1, Bar::homogeneous(5.0, 0.0).unwrap()) };
        let mut found = Measured::default();
        law(&member, distance_m, Some(force_n), &bounds, Place::Member(1), &mut found);
        found.violations.iter().map(|violation| violation.law).collect::<Vec<_>>()
    };
    let broken = |distance_m: f64, force_n: f64| told(Kind::Cable, distance_m, force_n);
    assert_eq!(broken(4.5, 2.0), []);
    let slack = Law::Slack { force_n: 2.0, length_m: 5.0, distance_m: 4.25 };
    assert_eq!(broken(4.25, 2.0), [slack]);
    assert_eq!(broken(4.25, 0.0), []);
    assert_eq!(broken(5.5, 2.0), []);
    assert_eq!(broken(5.75, 2.0), [Law::Length { length_m: 5.0, distance_m: 5.75 }]);
    assert_eq!(broken(4.25, -2.0), [Law::Sign { force_n: -2.0 }]);
    let broken = |distance_m: f64, force_n: f64| told(Kind::Strut, distance_m, force_n);
    assert_eq!(broken(5.5, -2.0), []);
    assert_eq!(broken(4.5, -2.0), []);
    let slack = Law::Slack { force_n: -2.0, length_m: 5.0, distance_m: 5.75 };
    assert_eq!(broken(5.75, -2.0), [slack]);
    assert_eq!(broken(4.25, -2.0), [Law::Length { length_m: 5.0, distance_m: 4.25 }]);
    assert_eq!(broken(5.75, 2.0), [Law::Sign { force_n: 2.0 }]);
}
