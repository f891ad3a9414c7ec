//! Elongations against exact numbers.

use super::*;

const ORIGIN: Place = [of(0.0, 0.0); 3];

const fn of(high: f64, low: f64) -> DoubleDouble {
    DoubleDouble { high, low }
}

#[test]
fn small_elongations_keep_their_digits() {
    // 3, 4, 0 and a move of e along the member: longer by e, whatever is cut off the places.
    for e in [1e-3, 1e-9, 1e-15, 1e-20, 1e-25] {
        let to = [DoubleDouble::sum(3.0, 0.6 * e), DoubleDouble::sum(4.0, 0.8 * e), ORIGIN[2]];
        let found = elongation_m(&ORIGIN, &to, 5.0);
        // 0.6 and 0.8 are rounded: 0.36 + 0.64 is one to the last place.
        assert!((found / e - 1.0).abs() < 1e-14, "{e}: {found}");
    }
    // Lengths whose squares are rounded.
    for length in [1.0 + 2.0_f64.powi(-30), 0.1, 7.3] {
        for e in [1e-9, 1e-20] {
            let found = elongation_m(
                &ORIGIN,
                &[DoubleDouble::sum(length, e), ORIGIN[0], ORIGIN[0]],
                length,
            );
            assert!((found / e - 1.0).abs() < 1e-10, "{length} {e}: {found}");
        }
    }
    // Across by e: longer by e²/10.
    let across = elongation_m(&ORIGIN, &[3.0, 4.0, 1e-6].map(|x| of(x, 0.0)), 5.0);
    assert!((across / 1e-13 - 1.0).abs() < 1e-12);
}

/// The same from a place whose own cut counts: 2, 3, 6 and a move of e along the member from either end.
#[test]
fn what_is_cut_off_either_end_counts() {
    for e in [1e-17, 3e-19] {
        let from = [of(1.0, 2.0 / 7.0 * e), of(-2.0, 3.0 / 7.0 * e), of(0.5, 6.0 / 7.0 * e)];
        let to = [3.0, 1.0, 6.5].map(|x| of(x, 0.0));
        let found = elongation_m(&from, &to, 7.0);
        assert!((found / -e - 1.0).abs() < 1e-12, "{e}: {found}");
        let parts = [2.0, 3.0, 6.0];
        let to = std::array::from_fn(|k| of(to[k].high, 3.0 * parts[k] / 7.0 * e));
        let found = elongation_m(&from, &to, 7.0);
        assert!((found / (2.0 * e) - 1.0).abs() < 1e-12, "{e}: {found}");
    }
}
