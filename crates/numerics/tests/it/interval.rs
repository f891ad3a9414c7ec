//! Enclosures against exact rational arithmetic.

use num_rational::BigRational;
use num_traits::Signed;
use proptest::prelude::*;

use numerics::{Interval, down, up};

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).expect("finite")
}

fn holds(interval: Interval, value: &BigRational) -> bool {
    let below = interval.lo() == f64::NEG_INFINITY || &exact(interval.lo()) <= value;
    let above = interval.hi() == f64::INFINITY || &exact(interval.hi()) >= value;
    below && above
}

/// Finite doubles of every size and kind, subnormal ones and both zeros included.
fn any_finite() -> impl Strategy<Value = f64> {
    prop_oneof![
        any::<f64>().prop_filter("finite", |x| x.is_finite()),
        -2.0..2.0f64,
        Just(0.0),
        Just(-0.0),
        Just(f64::MIN_POSITIVE),
        (0u64..64).prop_map(f64::from_bits),
    ]
}

fn any_interval() -> impl Strategy<Value = Interval> {
    (any_finite(), any_finite()).prop_map(|(a, b)| Interval::new(a.min(b), a.max(b)))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn a_step_outward_reaches_the_neighbouring_double(x in any_finite()) {
        prop_assert!(up(x) >= x.next_up() && down(x) <= x.next_down());
        // And hardly more than that: at most two steps.
        if x.is_normal() && x.abs() < f64::MAX / 4.0 && x.abs() > 1e-290 {
            prop_assert!(up(x) <= x.next_up().next_up() && down(x) >= x.next_down().next_down());
        }
    }

    #[test]
    fn exact_rational_results_are_enclosed(a in any_interval(), b in any_interval(), t in 0.0..=1.0f64) {
        // Operands inside the intervals: the ends, and something in between.
        for (x, y) in [
            (a.lo(), b.lo()), (a.lo(), b.hi()), (a.hi(), b.lo()), (a.hi(), b.hi()),
            ((a.lo() * (1.0 - t) + a.hi() * t).clamp(a.lo(), a.hi()), (b.lo() * t + b.hi() * (1.0 - t)).clamp(b.lo(), b.hi())),
        ] {
            let (ex, ey) = (exact(x), exact(y));
            prop_assert!(holds(a + b, &(&ex + &ey)), "{x:e} + {y:e}");
            prop_assert!(holds(a - b, &(&ex - &ey)), "{x:e} - {y:e}");
            prop_assert!(holds(a * b, &(&ex * &ey)), "{x:e} * {y:e}");
            prop_assert!(holds(a.square(), &(&ex * &ex)), "{x:e} squared");
            prop_assert!(holds(a.abs(), &ex.abs()));
            if y != 0.0 {
                prop_assert!(holds(a / b, &(&ex / &ey)), "{x:e} / {y:e}");
            }
            if x >= 0.0 {
                let root = a.sqrt();
                prop_assert!(&exact(root.lo()) * &exact(root.lo()) <= ex);
                prop_assert!(root.hi().is_infinite() || &exact(root.hi()) * &exact(root.hi()) >= ex);
            }
            prop_assert!(holds(a.scale(0.125), &(&ex * exact(0.125))));
        }
    }

    #[test]
    fn results_of_points_are_narrow(x in -1e100..1e100f64, y in 1e-3..1e3f64) {
        let (a, b) = (Interval::point(x), Interval::point(y));
        for wide in [a + b, a - b, a * b, a / b, b.sqrt()] {
            prop_assert!(wide.width() <= 5.0 * f64::EPSILON * wide.mag());
        }
    }

    #[test]
    fn the_middle_and_the_radius_cover_the_interval(a in any_interval()) {
        let (middle, radius) = (a.mid(), a.rad());
        prop_assert!(a.contains(middle));
        prop_assert!(exact(middle) - exact(a.lo()) <= exact(radius) || radius.is_infinite());
        prop_assert!(radius.is_infinite() || exact(a.hi()) - exact(middle) <= exact(radius));
        prop_assert!(Interval::around(middle, radius).encloses(a));
    }
}

#[test]
fn nothing_is_proved_with_what_is_not_a_number() {
    assert_eq!(Interval::point(f64::NAN), Interval::LINE);
    assert_eq!(Interval::ONE / Interval::ZERO, Interval::LINE);
    assert_eq!(Interval::new(2.0, 1.0), Interval::LINE);
    assert_eq!(Interval::LINE * Interval::ZERO, Interval::LINE);
    assert!(!Interval::LINE.interior_to(Interval::LINE));
    assert_eq!(Interval::new(f64::MAX, f64::MAX) + Interval::point(f64::MAX), Interval::LINE);
    assert_eq!(Interval::LINE.sign(), None);
}
