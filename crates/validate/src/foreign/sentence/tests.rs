//! Every law in words, with numbers by hand.

use super::*;

#[test]
fn what_is_broken_is_told_with_its_numbers() {
    let what =
        |law: Law, value: f64| Violation { place: Place::Whole, law, value, allowed: 0.0 }.what();
    assert_eq!(what(Law::Support, 0.25), "0.25 m off its support");
    assert_eq!(what(Law::BelowFloor, 0.5), "0.5 m below the floor");
    assert_eq!(
        what(Law::FloorPulls { force_n: 3.0 }, 3.0),
        "the floor would have to pull it down with 3 N"
    );
    let length = |distance_m: f64| Law::Length { length_m: 5.0, distance_m };
    assert_eq!(
        what(length(5.5), 0.5),
        "its joints are 5.5 m apart, 0.5 m more than its length of 5 m"
    );
    assert_eq!(
        what(length(4.5), 0.5),
        "its joints are 4.5 m apart, 0.5 m less than its length of 5 m"
    );
    assert_eq!(
        what(Law::Elongation { force_n: 3.0, elastic_n: 2.5 }, 0.5),
        "carries 3 N, and its elongation gives 2.5 N"
    );
    assert_eq!(what(Law::Sign { force_n: -2.0 }, 2.0), "a cable that pushes with 2 N");
    assert_eq!(what(Law::Sign { force_n: 2.0 }, 2.0), "a strut that pulls with 2 N");
    assert_eq!(
        what(Law::Slack { force_n: 2.0, length_m: 5.0, distance_m: 4.0 }, 2.0),
        "carries 2 N, though its joints are 4 m apart and its length is 5 m"
    );
    let force = [1.0, -0.0, -2.5];
    assert_eq!(what(Law::Balance { left_n: force }, 1.0), "(1, 0, -2.5) N are left over");
    assert_eq!(
        what(Law::Reaction { given_n: force, wanted_n: [0.0, 0.5, 0.0] }, 1.0),
        "the ground is said to push with (1, 0, -2.5) N, and its members and loads need (0, 0.5, 0) N"
    );
    assert_eq!(
        what(Law::Whole { left_n: force }, 1.0),
        "forces of the ground and loads together leave (1, 0, -2.5) N"
    );
}

/// Ten digits, and exponents for what is shorter than 1e-4 or as long as 1e9.
#[test]
fn numbers_are_written_short() {
    for (number, text) in [
        (0.0, "0"),
        (-0.0, "0"),
        (0.000_125, "0.000125"),
        (-0.000_1, "-0.0001"),
        (0.000_099, "9.9e-5"),
        (1.0 / 3.0, "0.3333333333"),
        (999_999_999.0, "999999999"),
        (1e9, "1e9"),
        (-2.5e12, "-2.5e12"),
        (1.000_000_000_04, "1"),
    ] {
        assert_eq!(Digits(number).to_string(), text);
    }
    assert_eq!(Force([1.0 / 3.0, 2e-5, -1e9]).to_string(), "(0.3333333, 2e-5, -1e9) N");
}

#[test]
fn ends_are_told_outwards() {
    let [least, most] = outwards([2.0, 4.0]);
    assert!((least - 1.999).abs() < 1e-15 && (most - 4.002).abs() < 1e-15, "{least} {most}");
}
