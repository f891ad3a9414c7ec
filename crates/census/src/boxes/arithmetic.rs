//! Vectors of intervals, exact zeros and ones kept exact.

use numerics::Interval;

pub(crate) type Vector = [Interval; 3];

/// The vector 0.
pub(crate) const NOWHERE: Vector = [Interval::ZERO; 3];

/// `a + b`, without rounding where one of them is 0.
pub(crate) fn sum(a: Interval, b: Interval) -> Interval {
    if a == Interval::ZERO {
        b
    } else if b == Interval::ZERO {
        a
    } else {
        a + b
    }
}

/// `a − b`, without rounding where one of them is 0 or both are the same number.
pub(crate) fn difference(a: Interval, b: Interval) -> Interval {
    if a == b && a.width() <= 0.0 { Interval::ZERO } else { sum(a, -b) }
}

/// `a b`, without rounding where one of them is 0, 1 or −1.
pub(crate) fn product(a: Interval, b: Interval) -> Interval {
    const MINUS_ONE: Interval = Interval::ONE.negated();
    match (a, b) {
        _ if a == Interval::ZERO || b == Interval::ZERO => Interval::ZERO,
        (x, Interval::ONE) | (Interval::ONE, x) => x,
        (x, MINUS_ONE) | (MINUS_ONE, x) => -x,
        _ => a * b,
    }
}

pub(crate) fn plus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| sum(a[k], b[k]))
}

pub(crate) fn minus(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| difference(a[k], b[k]))
}

pub(crate) fn times(c: Interval, a: Vector) -> Vector {
    a.map(|part| product(c, part))
}

/// `a/c`, without rounding where a part is 0.
pub(crate) fn over(a: Vector, c: Interval) -> Vector {
    a.map(|part| if part == Interval::ZERO { part } else { part / c })
}

pub(crate) fn dot(a: Vector, b: Vector) -> Interval {
    (0..3).fold(Interval::ZERO, |all, k| sum(all, product(a[k], b[k])))
}

pub(crate) fn cross(a: Vector, b: Vector) -> Vector {
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        difference(product(a[i], b[j]), product(a[j], b[i]))
    })
}

pub(crate) fn squared(a: Vector) -> Interval {
    a.into_iter()
        .filter(|part| *part != Interval::ZERO)
        .map(Interval::square)
        .fold(Interval::ZERO, sum)
}

pub(crate) fn norm(a: Vector) -> Interval {
    squared(a).sqrt()
}

/// `a/|a|`. Where a may vanish, all that is at most 1: a span without length pulls in any direction, with any
/// part of its tension.
pub(crate) fn unit(a: Vector) -> Vector {
    const WHOLE: Interval = Interval::ONE.hull(Interval::ONE.negated());
    std::array::from_fn(|k| {
        let others = squared([a[(k + 1) % 3], a[(k + 2) % 3], Interval::ZERO]);
        if a[k] == Interval::ZERO && others != Interval::ZERO {
            return Interval::ZERO;
        }
        // It rises with the part itself, and its size falls with the others.
        let end = |x: f64, sign: f64| {
            let others = if sign * x > 0.0 { others.lo() } else { others.hi() };
            let size = (Interval::point(x).square() + Interval::point(others.max(0.0))).sqrt();
            if size.lo() > 0.0 { Interval::point(x) / size } else { WHOLE }
        };
        if !(a[k].mag() + others.mag()).is_finite() {
            return WHOLE;
        }
        let ends = Interval::new(end(a[k].lo(), -1.0).lo(), end(a[k].hi(), 1.0).hi());
        ends.intersect(WHOLE).unwrap_or(WHOLE)
    })
}

/// `x/w` with `w ≥ 0`, the limits at w = 0 included.
pub(crate) fn quotient(x: Interval, w: Interval) -> Interval {
    if w == Interval::ONE {
        return x;
    }
    if w.lo() > 0.0 {
        return x / w;
    }
    let least = x / Interval::point(w.hi());
    if w.hi() <= 0.0 {
        Interval::LINE
    } else if x.lo() > 0.0 {
        Interval::new(least.lo(), f64::INFINITY)
    } else if x.hi() < 0.0 {
        Interval::new(f64::NEG_INFINITY, least.hi())
    } else {
        Interval::LINE
    }
}

/// `a · (b × c)`.
pub(crate) fn det(a: Vector, b: Vector, c: Vector) -> Interval {
    dot(a, cross(b, c))
}

/// The factors with which one, two or three vectors add up to another one in their span, by Cramer's rule; nothing
/// where they may be dependent.
pub(crate) fn factors(vectors: &[Vector], of: Vector) -> Option<Vec<Interval>> {
    let over = |part: Interval, whole: Interval| (whole.mig() > 0.0).then(|| part / whole);
    match *vectors {
        [one] => Some(vec![over(dot(of, one), squared(one))?]),
        [one, two] => {
            let both = cross(one, two);
            let parts = [cross(of, two), cross(one, of)].map(|part| dot(part, both));
            parts.into_iter().map(|part| over(part, squared(both))).collect()
        }
        [one, two, three] => {
            let whole = det(one, two, three);
            let parts = [det(of, two, three), det(one, of, three), det(one, two, of)];
            parts.into_iter().map(|part| over(part, whole)).collect()
        }
        _ => None,
    }
}

/// A vector along an axis.
pub(crate) fn upon(axis: usize, part: Interval) -> Vector {
    std::array::from_fn(|k| if k == axis { part } else { Interval::ZERO })
}

/// Three numbers that are exact as they stand.
pub(crate) fn points(a: model::Vector) -> Vector {
    a.map(Interval::point)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between these the true value lies, and no rounding has been paid for it.
    #[test]
    fn zeros_and_ones_round_nothing() {
        let third = Interval::ONE / Interval::point(3.0);
        let [tenth, zero, one] = [Interval::point(0.1), Interval::ZERO, Interval::ONE];
        assert_eq!([sum(third, zero), sum(zero, third)], [third; 2]);
        assert_eq!([product(third, one), product(one, third)], [third; 2]);
        assert_eq!([product(third, -one), product(-one, third)], [-third; 2]);
        assert_eq!([product(Interval::LINE, zero), product(zero, Interval::LINE)], [zero; 2]);
        assert_eq!([difference(tenth, zero), difference(zero, tenth)], [tenth, -tenth]);
        assert_eq!(difference(tenth, tenth), zero);
        // A range less another one that is the same is not zero.
        let range = Interval::new(1.0, 3.0);
        assert!(difference(range, range).encloses(Interval::new(-2.0, 2.0)));
    }

    /// Of 3 to 4 beside 0 to 3 the direction is from (3, 3) to (4, 0); what may vanish has any.
    #[test]
    fn directions_are_those_of_the_corners() {
        let [x, y] = [Interval::new(3.0, 4.0), Interval::new(0.0, 3.0)];
        let [along, across, none] = unit([x, y, Interval::ZERO]);
        let near = |found: Interval, lo: f64, hi: f64| {
            found.encloses(Interval::new(lo, hi)) && found.width() < hi - lo + 1e-15
        };
        assert!(near(along, 0.5_f64.sqrt(), 1.0) && near(across, 0.0, 0.5_f64.sqrt()));
        assert_eq!(none, Interval::ZERO);
        let [back, ..] = unit([-x, y, Interval::ZERO]);
        assert!(near(back, -1.0, -(0.5_f64.sqrt())));
        let whole = Interval::new(-1.0, 1.0);
        let [along, first, second] = unit([Interval::new(-1.0, 2.0), y, y]);
        assert!(near(along, -1.0, 1.0) && near(first, 0.0, 1.0) && near(second, 0.0, 1.0));
        assert_eq!(unit(NOWHERE), [whole; 3]);
    }

    #[test]
    fn quotients_have_their_limits() {
        let x = Interval::new(2.0, 3.0);
        assert_eq!(quotient(x, Interval::ONE), x);
        let both = quotient(x, Interval::new(4.0, 8.0));
        assert!(both.encloses(Interval::new(0.25, 0.75)) && both.width() < 0.5 + 1e-15);
        let half = Interval::new(0.0, 2.0);
        let up = quotient(x, half);
        assert!(up.contains(1.0) && up.lo() > 1.0 - 1e-15 && up.hi() >= f64::INFINITY);
        let down = quotient(-x, half);
        assert!(down.contains(-1.0) && down.hi() < -1.0 + 1e-15 && down.lo() <= -f64::INFINITY);
        assert_eq!(quotient(Interval::new(-1.0, 1.0), half), Interval::LINE);
        // Nothing over nothing may be anything.
        assert_eq!(quotient(Interval::new(0.0, 1.0), half), Interval::LINE);
        assert_eq!(quotient(Interval::new(-1.0, 0.0), half), Interval::LINE);
        assert_eq!(quotient(x, Interval::ZERO), Interval::LINE);
    }

    /// Products of vectors by hand.
    #[test]
    fn vectors_multiply() {
        let [a, b] = [points([3.0, 4.0, 12.0]), points([1.0, -2.0, 0.5])];
        let is = |found: Interval, value: f64| found.contains(value) && found.width() < 1e-12;
        assert!(is(norm(a), 13.0) && is(squared(a), 169.0) && is(dot(a, b), 1.0));
        let expected = [4.0 * 0.5 + 12.0 * 2.0, 12.0 - 3.0 * 0.5, -3.0 * 2.0 - 4.0];
        assert!(cross(a, b).into_iter().zip(expected).all(|(found, value)| is(found, value)));
        let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(points);
        assert_eq!([cross(x, y), cross(y, z), cross(z, x)], [z, x, y]);
        assert_eq!([plus(x, y), minus(plus(x, y), y)], [points([1.0, 1.0, 0.0]), x]);
    }
}
