//! The frame with two stays, by hand.

use super::*;

/// 8 N at the corner of a square: the stay bears √2 times as much, bar 3-4 is pressed by 8 N. Half
/// a newton too much in the bar is left over at the corner, more than the 1/64 of the load that is allowed.
#[test]
fn the_corner_of_the_frame_is_in_balance() {
    let entry = |bar_n: &str| {
        frame(&parsed(&format!(
            "force_n = 8\ntolerance = 0.015625\ndiagonal_n = '11.313708498984761'\nbar_n = '{bar_n}'"
        )))
    };
    for (bar_n, broken_n) in [("-8.0", 0.0), ("-8.5", 0.5)] {
        let entry = entry(bar_n);
        let check = entry.by_hand.as_ref().unwrap();
        assert!((check.broken_n - broken_n).abs() < 1e-14, "{check:?}");
        assert_eq!(check.allowed_n.to_bits(), f64::to_bits(0.125));
        let [stay, bar] = &entry.numbers[..] else { panic!("{entry:?}") };
        assert!((stay.ours - 8.0 * 2.0_f64.sqrt()).abs() < 1e-14);
        assert!((bar.ours + 8.0).abs() < 1e-15 && (bar.published + 8.0 + broken_n).abs() < 1e-15);
        assert!((bar.allowed - (8.0 + broken_n) / 64.0).abs() < 1e-15);
    }
}

#[test]
fn half_a_digit_is_that_of_the_last_one_printed() {
    for (printed, half) in
        [("12", 0.5), ("-8.5", 0.05), ("0.125", 5e-4), ("1.25e3", 5.0), ("2E-3", 5e-4)]
    {
        let allowed = Compared::new("", printed, 0.0, None).allowed;
        assert!((allowed / half - 1.0).abs() < 1e-14, "{printed}");
    }
}

/// Twelve newtons across and slopes of 3/4 and 5/12 up, so that 14 N of cable are between 9 N at the
/// upper end and -5 N at the lower; or 9 and 5 N down where it hangs upwards. What is printed adds up
/// to half a newton less.
#[test]
fn a_mooring_line_is_told_with_the_signs_of_its_source() {
    let ln3 = 3.0_f64.ln();
    let case = |weight_n_m: f64, expected: [&str; 4]| {
        parsed(&format!(
            "index = 7\nx_m = {}\nz_m = 1.5\nlength_m = 7\nstiffness_n = 28
            weight_n_m = {weight_n_m}\nexpected = {expected:?}",
            3.0 + 6.0 * ln3
        ))
    };
    for (weight_n_m, expected, ours) in [
        (2.0, ["12.0", "-5.0", "-12.0", "-8.5"], [12.0, -5.0, -12.0, -9.0]),
        (-2.0, ["12.0", "9.0", "-12.0", "5.5"], [12.0, 9.0, -12.0, 5.0]),
    ] {
        let entry = moorpy_case(&case(weight_n_m, expected), 0.125);
        assert_eq!((entry.title.as_str(), entry.numbers.len()), ("mooring line, index 7", 4));
        for ((number, ours), printed) in entry.numbers.iter().zip(ours).zip(expected) {
            assert!((number.ours - ours).abs() < 1e-12, "{number:?}");
            assert_eq!(number.printed, printed);
            let published: f64 = printed.parse().unwrap();
            assert!((number.published - published).abs() < 1e-15);
            assert!((number.allowed - 0.125 * published.abs()).abs() < 1e-15);
        }
        let check = entry.by_hand.unwrap();
        assert!((check.broken_n - 0.5).abs() < 1e-14, "{check:?}");
        let sizes: f64 =
            [expected[1], expected[3]].map(|n| n.parse::<f64>().unwrap().abs()).iter().sum();
        assert!((check.allowed_n - 0.125 * sizes).abs() < 1e-14, "{check:?}");
        let Some(BothSolvers::Run { members: 100, off }) = entry.solvers else { panic!() };
        assert!(
            off.iter().all(|(_, off)| off.is_some_and(|off| off > 0.0 && off < 1e-3)),
            "{off:?}"
        );
    }
}

/// 3 N of 10 N hang and are borne, 7 m lie; 9 N and 2 N are published for what hangs.
#[test]
fn a_line_on_the_floor_is_told_with_what_lies() {
    let (h, v) = (2.0_f64, 3.0_f64);
    let (x_m, z_m) = (7.0 + h * 10.0 / 50.0 + h * (v / h).asinh(), h.hypot(v) - h + v * v / 100.0);
    let case = |friction: f64| {
        parsed(&format!(
            "index = 1\nx_m = {x_m}\nz_m = {z_m}\nlength_m = 10\nstiffness_n = 50\nweight_n_m = 1
            friction = {friction}\nexpected = ['2.0', '0.0', '-2.0', '-3.5']\non_floor_m = '6.0'"
        ))
    };
    let entry = moorpy_case(&case(0.0), 0.25);
    let found: Vec<f64> = entry.numbers.iter().map(|number| number.ours).collect();
    for (found, wanted) in found.iter().zip([2.0, 0.0, -2.0, -3.0, 7.0]) {
        assert!((found - wanted).abs() < 1e-11, "{found}, not {wanted}");
    }
    let lies = &entry.numbers[4];
    assert!((lies.published - 6.0).abs() < 1e-15 && (lies.allowed - 1.5).abs() < 1e-15);
    // 10 m less 6 m weigh 4 N, and 3.5 N are borne.
    let check = entry.by_hand.as_ref().unwrap();
    assert!((check.broken_n - 0.5).abs() < 1e-14 && (check.allowed_n - 0.875).abs() < 1e-14);
    let Some(BothSolvers::Run { off, .. }) = &entry.solvers else { panic!() };
    assert!(off.iter().all(|(_, off)| off.is_some_and(|off| off > 0.0 && off < 1e-2)), "{off:?}");
    assert!(moorpy_case(&case(0.5), 0.25).not_judged.is_some());
}
