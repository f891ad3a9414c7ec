//! The larger of two numbers.

/// The larger number; unlike `f64::max` it keeps a NaN.
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if b <= a || a.is_nan() { a } else { b }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_larger_of_two_numbers_is_none_where_one_is_none() {
        assert!((larger(1.0, 2.0) - 2.0).abs() <= 0.0 && (larger(2.0, 1.0) - 2.0).abs() <= 0.0);
        assert!(larger(f64::NAN, 1.0).is_nan() && larger(1.0, f64::NAN).is_nan());
    }
}
