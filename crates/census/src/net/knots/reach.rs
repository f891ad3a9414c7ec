//! Where the knots can be at all: boxes narrowed by the distances that bars reach.

use numerics::Interval;

use super::jet::values;
use super::layout::{End, Layout};
use super::swing::place;
use crate::boxes::arithmetic::{Vector, minus, norm, sum};

/// Rounds over all distances; each one narrows what the last one left.
const ROUNDS: usize = 3;

/// Rounds for the first box, which nothing bounds: more than any path of members is long.
const FIRST_ROUNDS: usize = 64;

/// The box of all places of the knots.
pub(super) fn whole<const N: usize>(layout: &Layout) -> Option<[Interval; N]> {
    let coordinates = layout.coordinates();
    let mut at =
        std::array::from_fn(|k| if k < coordinates { Interval::LINE } else { Interval::ZERO });
    if layout.axis.is_some() {
        // All that is held is on it.
        let ends = layout.links.iter().flat_map(|link| link.ends.as_flattened());
        let held = ends.filter_map(|end| match end {
            End::Held(at) => Some(at[0].lo()),
            End::Knot(_) => None,
        });
        at[0] = Interval::new(held.fold(f64::INFINITY, f64::min), f64::INFINITY);
    }
    for _ in 0..FIRST_ROUNDS {
        narrow(layout, &mut at)?;
    }
    Some(at)
}

/// Narrow a box; nothing if no places in it are within reach of each other.
pub(super) fn narrow<const N: usize>(layout: &Layout, at: &mut [Interval; N]) -> Option<()> {
    for _ in 0..ROUNDS {
        for link in &layout.links {
            for number in 0..link.ends.len() {
                let others = link.ends.iter().enumerate().filter(|(other, _)| *other != number);
                let sizes = others.map(|(_, ends)| norm(span(layout.dim, at, *ends)));
                let range = sum(link.sizes(), -sizes.fold(Interval::ZERO, sum));
                let range = range.intersect(Interval::new(0.0, f64::INFINITY))?;
                narrow_one(layout.dim, at, link.ends[number], range.square())?;
            }
        }
        for (ends, range) in layout.reaches() {
            narrow_one(layout.dim, at, ends, range.square())?;
        }
    }
    Some(())
}

/// From one end to the other over a box of the places of the knots.
pub(super) fn span<const N: usize>(dim: usize, at: &[Interval; N], ends: [End; 2]) -> Vector {
    let [a, b] = ends.map(|end| values(place::<N>(end, dim, at)));
    minus(b, a)
}

/// By one distance: $\sum_k (a_k - b_k)^2$ lies in a range, solved for each part.
fn narrow_one<const N: usize>(
    dim: usize,
    at: &mut [Interval; N],
    ends: [End; 2],
    range: Interval,
) -> Option<()> {
    for k in 0..dim {
        let part = |end: End, j: usize| match end {
            End::Knot(knot) => at[dim * knot + j],
            End::Held(place) => place[j],
        };
        let square = |j: usize| (part(ends[0], j) - part(ends[1], j)).square();
        let others: Interval = (0..dim).filter(|j| *j != k).map(square).sum();
        let own = range - others;
        if own.hi() < 0.0 {
            return None;
        }
        let root = own.sqrt();
        let [a, b] = ends.map(|end| part(end, k));
        let mut off = (a - b).intersect(Interval::new(-root.hi(), root.hi()))?;
        if own.lo() > 0.0 {
            // Not between the roots.
            if off.lo() > -root.lo() {
                off = off.intersect(Interval::new(root.lo(), f64::INFINITY))?;
            } else if off.hi() < root.lo() {
                off = off.intersect(Interval::new(f64::NEG_INFINITY, -root.lo()))?;
            }
        }
        for (end, place) in [(ends[0], b + off), (ends[1], a - off)] {
            if let End::Knot(knot) = end {
                let own = &mut at[dim * knot + k];
                *own = own.intersect(place)?;
            }
        }
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A knot 5 from the origin of a plane whose x is from 3 to 4: y is from 3 to 4, or its
    /// opposite.
    #[test]
    fn a_circle_narrows_a_rectangle() {
        let ends = [End::Held([Interval::ZERO; 3]), End::Knot(0)];
        let five = Interval::point(25.0);
        let mut at = [Interval::new(3.0, 4.0), Interval::new(-1.0, 9.0)];
        assert_eq!(narrow_one(2, &mut at, ends, five), Some(()));
        assert!(at[1].encloses(Interval::new(3.0, 4.0)) && at[1].width() < 1.0 + 1e-12);
        let mut at = [Interval::new(3.0, 4.0), Interval::new(-9.0, 9.0)];
        assert_eq!(narrow_one(2, &mut at, ends, five), Some(()));
        assert!(at[1].encloses(Interval::new(-4.0, 4.0)) && at[1].width() < 8.0 + 1e-12);
        let mut at = [Interval::new(3.0, 4.0), Interval::new(-1.0, 2.0)];
        assert_eq!(narrow_one(2, &mut at, ends, five), None);
    }
}
