//! What intervals say of each other, against the sets of numbers that they are.

use numerics::{DoubleDouble, Interval};

/// Ends are whole; the numbers looked at lie on and between them.
const ENDS: std::ops::RangeInclusive<i32> = -3..=3;

fn all() -> Vec<Interval> {
    let ends = || ENDS.map(f64::from);
    ends()
        .flat_map(|lo| ends().filter(move |hi| lo <= *hi).map(move |hi| Interval::new(lo, hi)))
        .collect()
}

/// Quarters from below the lowest end to above the highest.
fn numbers() -> impl Iterator<Item = f64> {
    (-16..=16).map(|quarters| f64::from(quarters) / 4.0)
}

fn of(interval: Interval) -> Vec<f64> {
    numbers().filter(|x| interval.lo() <= *x && *x <= interval.hi()).collect()
}

#[test]
fn relations_are_those_of_sets() {
    for a in all() {
        let inside = of(a);
        assert!(numbers().all(|x| a.contains(x) == inside.contains(&x)));
        for b in all() {
            let other = of(b);
            let subset = inside.iter().all(|x| other.contains(x));
            assert_eq!(b.encloses(a), subset, "{a:?} in {b:?}");
            // A quarter more on either side still lies in it.
            let interior =
                inside.iter().all(|x| other.contains(&(x - 0.25)) && other.contains(&(x + 0.25)));
            assert_eq!(a.interior_to(b), interior, "{a:?} inside {b:?}");
            let common = inside.iter().any(|x| other.contains(x));
            assert_eq!(a.disjoint(b), !common, "{a:?} and {b:?}");
        }
    }
}

#[test]
fn signs_are_those_of_all_numbers() {
    for a in all() {
        let inside = of(a);
        let (negative, positive) =
            (inside.iter().any(|x| *x < 0.0), inside.iter().any(|x| *x > 0.0));
        let zero = inside.contains(&0.0);
        let sign = match (negative, zero, positive) {
            (false, false, true) => Some(1),
            (true, false, false) => Some(-1),
            (false, true, false) => Some(0),
            _ => None,
        };
        assert_eq!(a.sign(), sign, "{a:?}");
        let unit = match sign {
            Some(1) => Interval::new(1.0, 1.0),
            Some(-1) => Interval::new(-1.0, -1.0),
            _ => Interval::new(-1.0, 1.0),
        };
        assert_eq!(a.unit_sign(), unit, "{a:?}");
        assert!((a.mid() - 0.5 * (a.lo() + a.hi())).abs() <= 0.0, "{a:?}");
    }
    // Ends whose sum overflows.
    let wide = Interval::new(-1.0, f64::MAX);
    assert!((wide.mid() - 0.5 * f64::MAX).abs() <= 1.0);
}

#[test]
fn sums_have_all_their_terms() {
    let terms = [1.5, -0.25, 4.0];
    let sum: Interval = terms.map(Interval::point).into_iter().sum();
    assert!(sum.contains(5.25) && sum.width() < 1e-14, "{sum:?}");
    let sum: DoubleDouble = terms.map(DoubleDouble::point).into_iter().sum();
    assert!(sum.interval().contains(5.25) && sum.interval().width() < 1e-14, "{sum:?}");
}
