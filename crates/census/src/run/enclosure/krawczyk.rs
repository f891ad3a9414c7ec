//! Krawczyk's test: proof that a cell holds exactly one zero of the closure of one pattern, or
//! none.
//!
//! With a matrix Y near the inverse of the derivative and any point x of the cell X,
//!
//! $$ K(X) = x - Y\Phi(x) + (I - Y\Phi'(X))(X - x) $$
//!
//! holds every zero of Φ in X; if K(X) lies inside X, there is exactly one.
//!
//! R. Krawczyk, "Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken", Computing
//! 4 (1969) 187-201, doi:10.1007/BF02234767; R. E. Moore, SIAM J. Numer. Anal. 14 (1977) 611-615,
//! doi:10.1137/0714040

use numerics::Interval;

use crate::run::closure::Closure;
use crate::run::plane::cell::Cell;
use crate::run::plane::system::System;

/// Newton steps towards a zero before the cell is cut instead. From inside a cell on which the
/// derivative hardly varies, quadratic convergence needs five or six.
const NEWTON_STEPS: usize = 12;

/// How far around cell and zero the proof reaches, relative to the cell: zeros on the border of a
/// cell are then inside.
const INFLATION: f64 = 1.0 / 16.0;

/// A zero further from the middle of the cell than this many half widths belongs to another cell.
const REACH: f64 = 1.5;

/// Times the last Newton step, and the least radius in units of the last place, of the first tight
/// enclosure: Krawczyk's test needs room to succeed.
const TIGHT: f64 = 4.0;

/// The first tight enclosure grows at most that often, by a factor of eight each time: from the
/// last place to the square root of the precision.
const GROWTH: usize = 9;

/// A zero, proved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Zero {
    /// Where it is, tight.
    pub(crate) tight: Cell,
    /// A larger cell that holds no other zero of the same pattern.
    pub(crate) alone_in: Cell,
}

/// What is known of one pattern on one cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Finding {
    /// The cell holds this zero and no other; the zero may lie a little outside the cell.
    One(Zero),
    /// The cell holds no zero.
    None,
    /// Not decided.
    Unknown,
}

/// Seek the zero of a cell and prove it.
pub(crate) fn examine(system: &System, signs: &[i8], cell: &Cell) -> Finding {
    let (middle, half) = (cell.middle(), cell.half());
    let Some((x, step)) = newton(system, signs, cell, middle, half) else {
        return Finding::Unknown;
    };
    // A cell around the whole cell and the zero.
    let around = Cell {
        face: cell.face,
        at: std::array::from_fn(|k| {
            let margin = INFLATION * half[k] + TIGHT * step[k];
            Interval::around(x[k], margin).hull(Interval::around(middle[k], half[k] + margin))
        }),
    };
    let Some(image) = krawczyk(system, signs, &around, x) else { return Finding::Unknown };
    if !inside(&image, &around) {
        return Finding::Unknown;
    }
    let tight = tighten(system, signs, &around, &image, x, step);
    if tight.disjoint(cell) {
        return Finding::None;
    }
    Finding::One(Zero { tight, alone_in: around })
}

/// The image K(X) with the given point of X; `None` where Φ has no derivative or it is singular.
pub(crate) fn krawczyk(system: &System, signs: &[i8], cell: &Cell, x: [f64; 2]) -> Option<Cell> {
    let slope = Closure::over(system, signs, cell)?.slope;
    let gap = Closure::gap_over(system, signs, &Cell::point(cell.face, x));
    image(cell, x, slope, gap)
}

/// The image K(X) from the derivative over X and the value at a point of X.
pub(crate) fn image(
    cell: &Cell,
    x: [f64; 2],
    slope: [[Interval; 2]; 2],
    gap: [Interval; 2],
) -> Option<Cell> {
    let inverse =
        inverse(slope.map(|row| row.map(Interval::mid)))?.map(|row| row.map(Interval::point));
    let offset: [Interval; 2] = std::array::from_fn(|k| cell.at[k] - Interval::point(x[k]));
    let at = std::array::from_fn(|k| {
        let newton = inverse[k][0] * gap[0] + inverse[k][1] * gap[1];
        let rest: Interval = (0..2)
            .map(|j| {
                let unit = if j == k { Interval::ONE } else { Interval::ZERO };
                let product = inverse[k][0] * slope[0][j] + inverse[k][1] * slope[1][j];
                (unit - product) * offset[j]
            })
            .sum();
        Interval::point(x[k]) - newton + rest
    });
    Some(Cell { face: cell.face, at })
}

/// The zero of a cell that is known to hold exactly one, as narrow as the test gets it.
pub(crate) fn narrow(system: &System, signs: &[i8], cell: &Cell) -> Cell {
    narrowed(cell, |cell| krawczyk(system, signs, cell, cell.middle()))
}

/// The same with the images of cells about their middles.
pub(crate) fn narrowed(cell: &Cell, image: impl Fn(&Cell) -> Option<Cell>) -> Cell {
    /// Quadratic convergence needs six; slower gain is not worth more.
    const ROUNDS: usize = 20;
    let mut best = *cell;
    for _ in 0..ROUNDS {
        let Some(next) = image(&best).and_then(|image| common(&best, &image)) else { break };
        let gain = (0..2).any(|k| next.at[k].width() < 0.75 * best.at[k].width());
        best = next;
        if !gain {
            break;
        }
    }
    best
}

/// Whether one cell lies in the interior of another on the same face.
pub(crate) fn inside(inner: &Cell, outer: &Cell) -> bool {
    inner.at[0].interior_to(outer.at[0]) && inner.at[1].interior_to(outer.at[1])
}

/// The image K(X) about the point of the cell where Newton's method from its middle ends, if it
/// ends in the cell, else about the middle. The image is narrowest about the zero itself.
pub(crate) fn krawczyk_about_zero(system: &System, signs: &[i8], cell: &Cell) -> Option<Cell> {
    let (middle, half) = (cell.middle(), cell.half());
    let x = newton(system, signs, cell, middle, half).map_or(middle, |(x, _)| x);
    let within = (0..2).all(|k| cell.at[k].contains(x[k]));
    krawczyk(system, signs, cell, if within { x } else { middle })
}

/// Newton's method from the middle: the last point and the size of the last step. No proof.
fn newton(
    system: &System,
    signs: &[i8],
    cell: &Cell,
    middle: [f64; 2],
    half: [f64; 2],
) -> Option<([f64; 2], [f64; 2])> {
    let mut x = middle;
    let mut last = [f64::INFINITY; 2];
    for _ in 0..NEWTON_STEPS {
        let (gap, slope) = Closure::plain(system, signs, cell.face, x);
        let inverse = inverse(slope)?;
        let step: [f64; 2] =
            std::array::from_fn(|k| inverse[k][0] * gap[0] + inverse[k][1] * gap[1]);
        let next: [f64; 2] = std::array::from_fn(|k| x[k] - step[k]);
        let last_place = f64::EPSILON * Cell::size(cell.face, next);
        if !(0..2).all(|k| (next[k] - middle[k]).abs() <= REACH * half[k] + last_place) {
            return None;
        }
        x = next;
        let size = step.map(f64::abs);
        let done = size[0].max(size[1]) <= 2.0 * last_place;
        if done || size[0].max(size[1]) >= last[0].max(last[1]) {
            return Some((x, size.map(|part| part + last_place)));
        }
        last = size;
    }
    let last_place = f64::EPSILON * Cell::size(cell.face, x);
    Some((x, last.map(|part| part + last_place)))
}

/// The smallest enclosure that double precision gives: Krawczyk's test on ever smaller cells around
/// the point, starting from the size of the last Newton step, or else by iteration from outside.
fn tighten(
    system: &System,
    signs: &[i8],
    around: &Cell,
    image: &Cell,
    x: [f64; 2],
    step: [f64; 2],
) -> Cell {
    let mut radius = step.map(|part| TIGHT * part);
    for _ in 0..GROWTH {
        let small = Cell {
            face: around.face,
            at: std::array::from_fn(|k| Interval::around(x[k], radius[k])),
        };
        // The zero in the small cell is the one of the large cell only if it lies in it.
        if around.encloses(&small)
            && let Some(next) = krawczyk(system, signs, &small, x)
            && inside(&next, &small)
            && let Some(both) = common(image, &next)
        {
            return both;
        }
        radius = radius.map(|part| 8.0 * part);
    }
    narrow(system, signs, image)
}

fn common(a: &Cell, b: &Cell) -> Option<Cell> {
    Some(Cell { face: a.face, at: [a.at[0].intersect(b.at[0])?, a.at[1].intersect(b.at[1])?] })
}

/// The inverse of a 2 × 2 matrix, approximately.
pub(crate) fn inverse([[a, b], [c, d]]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    let determinant = a * d - b * c;
    let inverse = [[d, -b], [-c, a]].map(|row| row.map(|entry| entry / determinant));
    inverse.iter().flatten().all(|entry| entry.is_finite()).then_some(inverse)
}

#[cfg(test)]
mod tests;
