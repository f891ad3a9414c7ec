//! The equilibria of the paper's example counted by exact algebra: integers, and no rounding at
//! all.
//!
//! Eliminating all but c = cos θ from "critical point of (vi) on the closure curve" leaves
//!
//! $$ 2048 c^6 - 8192 c^5 + 9472 c^4 + 2080 c^3 - 11348 c^2 + 7120 c - 1189 = 0, $$
//!
//! and Sturm's theorem counts its real roots between two integers.
//!
//! C. Sturm, Bull. Sci. Math. Ferussac 11 (1829) 419-422; S. Basu, R. Pollack, M.-F. Roy,
//! "Algorithms in Real Algebraic Geometry" (2006), section 2.2, doi:10.1007/3-540-33099-2

/// Coefficients of the sextic in cos θ, from the constant one upward.
pub const SEXTIC: [i128; 7] = [-1189, 7120, -11348, 2080, 9472, -8192, 2048];

/// Number of different real roots x of a polynomial with `low < x <= high`, exactly.
///
/// `None` if the polynomial is zero, or an intermediate number exceeds 128 bits.
///
/// ```
/// use census::sextic::{SEXTIC, count_roots};
/// // The cosines of E1 and E2, and nothing else.
/// assert_eq!(count_roots(&SEXTIC, -1, 1), Some(2));
/// // (x² − 2)(x − 3)
/// assert_eq!(count_roots(&[6, -2, -3, 1], 0, 3), Some(2));
/// ```
pub fn count_roots(coefficients: &[i128], low: i128, high: i128) -> Option<usize> {
    let first = primitive(coefficients.to_vec())?;
    let mut sequence = vec![first.clone()];
    let slope: Option<Vec<i128>> =
        (1..).zip(first.iter().skip(1)).map(|(k, c)| c.checked_mul(k)).collect();
    let mut next = primitive(slope?);
    while let Some(divisor) = next {
        let dividend = sequence.last()?;
        let remainder = negative_remainder(dividend, &divisor)?;
        sequence.push(divisor);
        next = primitive(remainder);
    }
    let changes = |x: i128| -> Option<usize> {
        let signs: Option<Vec<i128>> =
            sequence.iter().map(|p| Some(evaluate(p, x)?.signum())).collect();
        let signs: Vec<i128> = signs?.into_iter().filter(|sign| *sign != 0).collect();
        Some(signs.windows(2).filter(|pair| pair[0] != pair[1]).count())
    };
    changes(low)?.checked_sub(changes(high)?)
}

/// The value at an integer.
fn evaluate(polynomial: &[i128], x: i128) -> Option<i128> {
    polynomial.iter().rev().try_fold(0_i128, |value, c| value.checked_mul(x)?.checked_add(*c))
}

/// Without leading zeros and common factors of the coefficients; `None` for zero.
fn primitive(mut polynomial: Vec<i128>) -> Option<Vec<i128>> {
    while polynomial.last() == Some(&0) {
        polynomial.pop();
    }
    let content = polynomial.iter().fold(0_u128, |all, c| divisor(all, c.unsigned_abs()));
    let content = i128::try_from(content).ok().filter(|content| *content > 0)?;
    Some(polynomial.into_iter().map(|c| c / content).collect())
}

/// Greatest common divisor.
fn divisor(a: u128, b: u128) -> u128 {
    if b == 0 { a } else { divisor(b, a % b) }
}

/// A positive multiple of minus the remainder of a division.
fn negative_remainder(dividend: &[i128], divisor: &[i128]) -> Option<Vec<i128>> {
    let lead = *divisor.last()?;
    let mut rest = dividend.to_vec();
    while rest.len() >= divisor.len() {
        let top = rest.pop()?;
        // |lead| rest − sign(lead) top x^k divisor.
        let factor = top.checked_mul(lead.signum())?;
        for c in &mut rest {
            *c = c.checked_mul(lead.checked_abs()?)?;
        }
        let shift = rest.len() + 1 - divisor.len();
        for (k, c) in divisor[..divisor.len() - 1].iter().enumerate() {
            rest[k + shift] = rest[k + shift].checked_sub(factor.checked_mul(*c)?)?;
        }
        rest = match primitive(rest) {
            Some(rest) => rest,
            None => return Some(vec![]),
        };
    }
    Some(rest.into_iter().map(|c| -c).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_paper_has_two_cosines() {
        assert_eq!(count_roots(&SEXTIC, -1, 1), Some(2));
        assert_eq!(count_roots(&SEXTIC, -1, 0), Some(0));
        // One of them on each side of 1/2: 64 p(c/2) has integer coefficients in c.
        let doubled: Vec<i128> =
            SEXTIC.iter().enumerate().map(|(k, c)| c * (1 << (6 - k))).collect();
        assert_eq!(count_roots(&doubled, 0, 1), Some(1));
        assert_eq!(count_roots(&doubled, 1, 2), Some(1));
        // Changing one coefficient changes the count: the test can fail.
        let mut other = SEXTIC;
        other[0] = -3000;
        assert_eq!(count_roots(&other, -1, 1), Some(0));
    }

    /// Products of linear factors: the roots are known.
    #[test]
    fn known_roots_are_counted_once() {
        let product = |roots: &[i128]| {
            roots.iter().fold(vec![1], |p: Vec<i128>, root| {
                let mut q = vec![0; p.len() + 1];
                for (k, c) in p.iter().enumerate() {
                    q[k + 1] += c;
                    q[k] -= c * root;
                }
                q
            })
        };
        assert_eq!(count_roots(&product(&[-3, -1, 0, 2, 5]), -10, 10), Some(5));
        assert_eq!(count_roots(&product(&[-3, -1, 0, 2, 5]), -3, 2), Some(3), "low is open");
        assert_eq!(count_roots(&product(&[1, 1, 1, 4]), 0, 10), Some(2), "multiple roots");
        assert_eq!(count_roots(&[1, 0, 1], -100, 100), Some(0));
        assert_eq!(count_roots(&[0, 0], -1, 1), None);
        assert_eq!(count_roots(&[i128::MAX, i128::MAX - 1, 7, 3], -1, i128::MAX), None);
    }
}
