//! The digits with which an answer was printed, read off its numbers: a number that was printed to a
//! few digits has no shorter way to be written.

/// Places behind the point up to which numbers count as rounded.
const MOST_PLACES: usize = 9;

/// Forces count as printed to this many digits at least: fewer are more often exact, as 20 N, than
/// rounded.
const LEAST_DIGITS: usize = 3;

/// To how many places behind the point these numbers are rounded, if to few.
pub(super) fn places(numbers: impl IntoIterator<Item = f64>) -> Option<usize> {
    let behind = |x: f64| x.to_string().split_once('.').map_or(0, |(_, behind)| behind.len());
    numbers.into_iter().map(behind).max().filter(|places| *places <= MOST_PLACES)
}

/// To how many digits these numbers were printed, and half a unit of the last digit of the largest:
/// none is further than that from what it was rounded from.
pub(super) fn printed(numbers: impl IntoIterator<Item = f64>) -> (usize, f64) {
    let parts = |x: f64| {
        let text = format!("{x:e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        let digits = mantissa.bytes().filter(u8::is_ascii_digit).count();
        // A finite number that is not zero has an exponent.
        (digits, exponent.parse().unwrap_or(f64::MAX_10_EXP))
    };
    let of_all = numbers.into_iter().filter(|x| x.abs() > 0.0).map(parts);
    let most = |a: (usize, i32), b: (usize, i32)| (a.0.max(b.0), a.1.max(b.1));
    let Some((digits, exponent)) = of_all.reduce(most) else { return (LEAST_DIGITS, 0.0) };
    let digits = digits.max(LEAST_DIGITS);
    (digits, (0..digits).fold(5.0 * 10.0_f64.powi(exponent), |unit, _| unit / 10.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_to_the_place_of_their_last_digit() {
        assert_eq!(places([0.0, -3.0, 20.0]), Some(0));
        assert_eq!(places([0.0, -4.01, 3.5]), Some(2));
        assert_eq!(places([1e-9]), Some(9));
        assert_eq!(places([-4.01, 1.0 / 3.0]), None);
        assert_eq!(places([]), None);
    }

    /// 157, 19.2 and 6.68 N may have been 157.5, 19.25 and 6.685 N: half a newton at most.
    #[test]
    fn forces_are_known_to_half_a_unit_of_the_last_digit_of_the_largest() {
        let close = |numbers: &[f64], wanted: (usize, f64)| {
            let found = printed(numbers.iter().copied());
            assert!(found.0 == wanted.0 && (found.1 / wanted.1 - 1.0).abs() < 1e-14, "{found:?}");
        };
        close(&[157.0, -19.2, 6.68, 0.0], (3, 0.5));
        close(&[-1.2625, 1.25], (5, 5e-5));
        close(&[0.00123], (3, 5e-6));
        // Whole numbers and single digits are no forces of one or two digits.
        close(&[16.0, 12.0], (3, 0.05));
        close(&[3.0], (3, 0.005));
        assert!(printed([0.0]).1 <= 0.0);
        assert!(printed([1.0 / 3.0]).1 < 1e-16);
    }
}
