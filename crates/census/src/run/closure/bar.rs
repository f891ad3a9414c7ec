//! One bar over a whole cell of pulls: its direction and how the direction turns.

use numerics::Interval;

use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;

/// What a bar in tension contributes to the closure, over a cell: `l f` with `f = F/|F|`, and its
/// derivative by the two coordinates of the cell.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BarTerm {
    /// `l f`.
    pub(crate) value: [Interval; 2],
    /// `l ∂f/∂(x, y)`, first index the component, second the coordinate.
    pub(crate) slope: [[Interval; 2]; 2],
}

impl BarTerm {
    /// The bar over the cell; `None` where its force vanishes somewhere in the cell, so that its
    /// direction is free there.
    pub(crate) fn over(cell: &Cell, length: Interval, weight: Interval) -> Option<Self> {
        let force = cell.force(weight);
        if force[0].contains(0.0) && force[1].contains(0.0) {
            return None;
        }
        let f = unit(force);
        let scale = length / size(force);
        // ∂f/∂F = (I - f f^T)/|F|, and I - f f^T = g g^T with g the normal of f.
        let by_h = [f[1].square() * scale, -(f[0] * f[1] * scale)];
        let by_v = [by_h[1], f[0].square() * scale];
        let by_w = || by_v.map(|part| part * weight);
        let (x, y) = match cell.face {
            Face::Near | Face::Around(_) => (by_h, by_v),
            Face::Left | Face::Right => (by_v, by_w()),
            Face::Below | Face::Above => (by_h, by_w()),
        };
        Some(Self { value: f.map(|part| length * part), slope: [[x[0], y[0]], [x[1], y[1]]] })
    }

    /// The same at a point in plain numbers: no proof rests on it.
    pub(crate) fn plain(face: Face, [x, y]: [f64; 2], length: f64, weight: f64) -> [[f64; 3]; 2] {
        let (force, by) = match face {
            Face::Near | Face::Around(_) => ([x, y + weight], [[1.0, 0.0], [0.0, 1.0]]),
            Face::Left => ([-1.0, x + weight * y], [[0.0, 1.0], [0.0, weight]]),
            Face::Right => ([1.0, x + weight * y], [[0.0, 1.0], [0.0, weight]]),
            Face::Below => ([x, weight * y - 1.0], [[1.0, 0.0], [0.0, weight]]),
            Face::Above => ([x, weight * y + 1.0], [[1.0, 0.0], [0.0, weight]]),
        };
        let size = (force[0] * force[0] + force[1] * force[1]).sqrt();
        let f = force.map(|part| part / size);
        let scale = length / size;
        // g g^T dF with the normal g.
        let turned = by.map(|by| scale * (f[0] * by[1] - f[1] * by[0]));
        [
            [length * f[0], -f[1] * turned[0], -f[1] * turned[1]],
            [length * f[1], f[0] * turned[0], f[0] * turned[1]],
        ]
    }

    /// `l f` alone.
    pub(crate) fn value_over(cell: &Cell, length: Interval, weight: Interval) -> [Interval; 2] {
        unit(cell.force(weight)).map(|part| length * part)
    }
}

const DISC: Interval = Interval::ONE.hull(Interval::ONE.negated());

/// The sizes of all vectors of a rectangle.
pub(crate) fn size([x, z]: [Interval; 2]) -> Interval {
    (x.square() + z.square()).sqrt()
}

/// Directions of all vectors of a rectangle: the exact range, but for rounding.
///
/// The first component `x/√(x² + z²)` grows with x; with |z| it falls where x > 0 and grows where
/// x < 0. So its ends are taken at corners, or where z = 0. Likewise the second.
pub(crate) fn unit([x, z]: [Interval; 2]) -> [Interval; 2] {
    if x.contains(0.0) && z.contains(0.0) {
        return [DISC, DISC];
    }
    [cosine(x, z), cosine(z, x)]
}

fn cosine(along: Interval, across: Interval) -> Interval {
    let (near, far) = (across.mig(), across.mag());
    let low = at_corner(along.lo(), if along.lo() > 0.0 { far } else { near }).lo();
    let high = at_corner(along.hi(), if along.hi() > 0.0 { near } else { far }).hi();
    Interval::new(low.max(-1.0), high.min(1.0))
}

/// Squares of numbers between these neither overflow nor lose digits: 2⁻⁹⁰⁰ and 2⁹⁰⁰.
const SMALL: f64 = f64::from_bits((1023 - 900) << 52);
const LARGE: f64 = f64::from_bits((1023 + 900) << 52);

/// `x/√(x² + z²)` of two numbers.
///
/// In plain arithmetic the squares and their sum are off by 2u relative to their size (u = 2⁻⁵³),
/// the root by half of that and u, the quotient by u more: 3u and terms of order u². The end of the
/// interval is rounded once more.
#[inline]
fn at_corner(x: f64, z: f64) -> Interval {
    /// 5u
    const OFF: f64 = 2.5 * f64::EPSILON;
    if x.abs() <= 0.0 {
        return Interval::ZERO;
    }
    if z.abs() <= 0.0 {
        return Interval::point(x.signum());
    }
    let sum = x * x + z * z;
    if (SMALL..LARGE).contains(&sum) {
        let quotient = x / sum.sqrt();
        // Where x² is lost beside z² the quotient may be so small that its part is.
        let off = OFF * quotient.abs() + f64::MIN_POSITIVE;
        return Interval::new(quotient - off, quotient + off);
    }
    let x = Interval::point(x);
    let quotient = x / (x.square() + Interval::point(z).square()).sqrt();
    // Squares that underflow leave nothing known but that it is a cosine.
    quotient.intersect(DISC).unwrap_or(DISC)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn rectangle() -> impl Strategy<Value = [Interval; 2]> {
        let side = || (-1.0..1.0f64, 0.0..0.5f64).prop_map(|(a, w)| Interval::new(a, a + w));
        (side(), side()).prop_map(|(x, z)| [x, z])
    }

    proptest! {
        #[test]
        fn directions_inside_the_rectangle_are_enclosed_and_the_ends_are_reached(
            force in rectangle(), s in 0.0..=1.0f64, t in 0.0..=1.0f64,
        ) {
            let f = unit(force);
            let [x, z] = [(force[0], s), (force[1], t)].map(|(side, t)| side.lo() + t * (side.hi() - side.lo()));
            let size = x.hypot(z);
            prop_assert!(f[0].lo() <= x / size + 1e-15 && x / size - 1e-15 <= f[0].hi());
            prop_assert!(f[1].lo() <= z / size + 1e-15 && z / size - 1e-15 <= f[1].hi());
            // Each end is the value at some point of the border, up to rounding.
            if force[0].mig() > 1e-6 || force[1].mig() > 1e-6 {
                for (k, end) in [(0, f[0].lo()), (0, f[0].hi()), (1, f[1].lo()), (1, f[1].hi())] {
                    let candidates = [force[0].lo(), force[0].hi(), 0.0]
                        .into_iter()
                        .filter(|x| force[0].contains(*x))
                        .flat_map(|x| [force[1].lo(), force[1].hi(), 0.0].map(|z| [x, z]))
                        .filter(|[_, z]| force[1].contains(*z));
                    let nearest = candidates
                        .map(|p| (p[k] / p[0].hypot(p[1]) - end).abs())
                        .fold(f64::INFINITY, f64::min);
                    prop_assert!(nearest < 1e-9, "end {end} of component {k} is not reached");
                }
            }
        }

        #[test]
        fn the_slope_is_the_derivative(x in -0.9..0.9f64, y in 0.01..0.9f64, weight in -1.0..1.0f64, which in 0usize..5) {
            let face = [Face::Near, Face::Left, Face::Right, Face::Below, Face::Above][which];
            let value = |x: f64, y: f64| {
                let [a, b] = Cell::point(face, [x, y]).force(Interval::point(weight)).map(Interval::mid);
                [a / a.hypot(b), b / a.hypot(b)]
            };
            let size = {
                let [a, b] = Cell::point(face, [x, y]).force(Interval::point(weight)).map(Interval::mid);
                a.hypot(b)
            };
            prop_assume!(size > 0.05);
            let term = BarTerm::over(&Cell::point(face, [x, y]), Interval::ONE, Interval::point(weight)).unwrap();
            // Central differences: truncation h² / size³ with a factor of order one.
            let h = 1e-5;
            for k in 0..2 {
                let [dx, dy] = if k == 0 { [h, 0.0] } else { [0.0, h] };
                let (after, before) = (value(x + dx, y + dy), value(x - dx, y - dy));
                for part in 0..2 {
                    let difference = (after[part] - before[part]) / (2.0 * h);
                    let slope = term.slope[part][k].mid();
                    prop_assert!((difference - slope).abs() < 1e-9 / size.powi(3), "{difference} {slope}");
                }
            }
        }
    }
}
