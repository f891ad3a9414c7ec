//! Numbers as people read them.

use model::BarError;
use model::number::Number;
use model::system::Refusal;

#[test]
fn significant_digits_are_told_in_the_form_that_shows_them() {
    for (x, digits, text) in [
        (0.522_916_3, 4, "0.5229"),
        (-13.0, 4, "-13"),
        (-3.816e-6, 3, "-3.82×10⁻⁶"),
        (4.1e-13, 4, "<\u{a0}10⁻¹²"),
        (0.0, 4, "<\u{a0}10⁻¹²"),
        (2.5e-10, 4, "<\u{a0}10⁻⁹"),
        (f64::NAN, 4, "not a number"),
    ] {
        assert_eq!(Number::significant(x, digits).to_string(), text);
    }
}

#[test]
fn counts_decimals_and_sizes() {
    assert_eq!(Number::count(12.0).to_string(), "12");
    assert_eq!(Number::count(0.0).in_words(), "0");
    assert_eq!(Number::count(0.25).to_string(), "0.25");
    assert_eq!(Number::decimals(-1e-17, 3).to_string(), "0.000");
    assert_eq!(Number::decimals(1e-17, 3).in_words(), "0.000");
    assert_eq!(Number::size(-0.0, 1).to_string(), "0");
    assert_eq!(format!("{:#}", Number::size(2e-3, 0)), "0.002");
    assert_eq!(format!("{:#}", Number::size(2e-5, 0)), "2×10⁻⁵");
}

#[test]
fn what_was_worked_out_has_no_digits_of_its_rounding() {
    let told = |distance_m: f64, reach_m: f64| {
        let (from, to) = (String::new(), String::new());
        Refusal::OutOfReach { from, to, joint: 1, distance_m, reach_m }.to_string()
    };
    for (of, text) in [
        (5.999_999_999_999_998, "6"),
        (0.1 + 0.2, "0.3"),
        (2.0_f64.sqrt(), "1.414213562373095"),
        (0.0, "0"),
        (1e-300, "1e-300"),
        (f64::NAN, "NaN"),
        // What is more than rounding is told.
        (6.000_000_000_000_1, "6.0000000000001"),
    ] {
        let error = told(of, 1.0);
        assert!(error.contains(&format!(" are {text} m apart")), "{error}");
    }
    for (span_m, total_m, text) in [(3.1, 3.0, "0.1"), (1.0 + 4.0 * f64::EPSILON, 1.0, "9e-16")] {
        let error = told(span_m, total_m);
        assert!(error.ends_with(&format!(": {text} m are missing")), "{error}");
    }
}

#[test]
fn only_numbers_of_unusual_size_have_exponents() {
    for (number, text) in [
        (0.0, "0"),
        (-1.5, "-1.5"),
        (1e-6, "0.000001"),
        (-9.9e-7, "-9.9e-7"),
        (999_999_999.5, "999999999.5"),
        (1e9, "1e9"),
        (1e-300, "1e-300"),
        (-5e-324, "-5e-324"),
        (f64::INFINITY, "inf"),
        (f64::NAN, "NaN"),
    ] {
        let error = BarError::Length(number).to_string();
        assert!(error.ends_with(&format!(", got {text} m")), "{error}");
    }
}
