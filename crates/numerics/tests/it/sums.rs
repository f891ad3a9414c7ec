//! Enclosures against the rounding errors that fused operations tell exactly, and sums.

use numerics::{Interval, IntervalSum};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Whether exact = p + e (an unevaluated pair) lies inside.
fn holds(x: Interval, p: f64, e: f64) -> bool {
    let below = x.lo() < p || (x.lo() <= p && e >= 0.0);
    let above = x.hi() > p || (x.hi() >= p && e <= 0.0);
    below && above
}

/// The rounding error of a product and of a quotient is known exactly with a fused
/// multiply-add: the enclosures hold it.
#[test]
fn operations_enclose_the_exact_result() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..100_000 {
        let a = rng.random_range(-2.0..2.0_f64) * 10.0_f64.powi(rng.random_range(-9..9));
        let b = rng.random_range(-2.0..2.0_f64) * 10.0_f64.powi(rng.random_range(-9..9));
        let (x, y) = (Interval::point(a), Interval::point(b));
        let p = a * b;
        assert!(holds(x * y, p, a.mul_add(b, -p)));
        let s = a + b;
        let of_a = s - b;
        assert!(holds(x + y, s, (a - of_a) + (b - (s - of_a))));
        let q = a / b;
        // a = q b + rest, so the exact quotient is q + rest / b.
        assert!(holds(x / y, q, -q.mul_add(b, -a) / b));
        assert!(holds(x.square(), a * a, a.mul_add(a, -(a * a))));
        let r = a.abs().sqrt();
        assert!(holds(Interval::point(a.abs()).sqrt(), r, -r.mul_add(r, -a.abs())));
    }
}

#[test]
fn what_is_not_a_number_proves_nothing() {
    let one = Interval::point(1.0);
    let nan = Interval::point(f64::NAN);
    let infinite = Interval::point(f64::INFINITY);
    for x in [
        nan,
        nan + one,
        infinite - infinite,
        infinite * Interval::ZERO,
        one / Interval::ZERO,
        infinite / infinite,
        nan.square(),
        nan.sqrt(),
    ] {
        assert!(x.lo() <= 0.0 && x.hi() >= f64::MAX, "{x:?}");
    }
}

/// A million terms that nearly cancel: the enclosure holds the exact sum and is narrow.
#[test]
fn sum_is_tight_for_a_million_terms() {
    let mut sum = IntervalSum::ZERO;
    let n = 1_000_000;
    for k in 0..n {
        sum.add(Interval::point(0.1));
        sum.add(Interval::point(if k % 2 == 0 { 1e9 } else { -1e9 }));
    }
    // The double nearest 0.1 is 0.1 + 5.551115123125783e-18 (its 54-bit tail).
    let exact = 1e5 + 5.551_115_123_125_783e-12;
    let value = sum.value();
    assert!(value.lo() <= exact && exact <= value.hi(), "{value:?}");
    assert!(value.hi() - value.lo() < 1e-10, "{value:?}");
}
