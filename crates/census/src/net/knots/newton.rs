//! Newton's method on a dense system of equations, in intervals and in double precision.

use numerics::Interval;

use super::dense::{Dense, inverse_of_middle, times, times_matrix};
use crate::boxes::arithmetic::sum;

/// Steps of Newton's method in double precision to a zero.
const STEPS: usize = 30;

/// A step of this part of the unknowns is rounding.
const CONVERGED: f64 = 1e-13;

/// How far outside of a box, in its widths, Newton's method may end to be worth a proof.
const OUTSIDE: f64 = 0.75;

/// Room about a box and a zero for the proof, relative to it.
const ROOM: f64 = 0.125;

/// Room in units of the unknowns.
const LEAST_ROOM: f64 = 1e-9;

/// Left-hand sides and their derivative.
pub(in crate::net) type Linear = (Vec<Interval>, Dense);

/// Newton's method in double precision, from a point on.
pub(in crate::net) fn zero(
    mut at: Vec<f64>,
    equations: impl Fn(&[Interval]) -> Option<Linear>,
) -> Option<Vec<f64>> {
    for _ in 0..STEPS {
        let points: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
        let (value, slope) = equations(&points)?;
        let step = times(&inverse_of_middle(&slope)?, &value);
        let mut size = 0.0_f64;
        for (x, step) in at.iter_mut().zip(step) {
            *x -= step.mid();
            size = size.max(step.mid().abs() / x.abs().max(1.0));
        }
        if size.is_nan() {
            return None;
        }
        if size < CONVERGED {
            return Some(at);
        }
    }
    None
}

/// A box with room about another one and a zero, if that is near.
pub(in crate::net) fn around(at: &[Interval], zero: &[f64]) -> Option<Vec<Interval>> {
    let pairs = at.iter().zip(zero);
    let with_room = |(part, x): (&Interval, &f64)| {
        let outside = OUTSIDE * part.width() + LEAST_ROOM;
        let both = part.hull(Interval::point(*x));
        let is_near = part.lo() - outside <= *x && *x <= part.hi() + outside;
        is_near.then(|| both + Interval::around(0.0, ROOM * both.width() + LEAST_ROOM))
    };
    pairs.map(with_room).collect()
}

/// A step of the method in intervals.
pub(in crate::net) struct Newton {
    /// What is left of the box; nothing if it holds no zero.
    pub(in crate::net) left: Option<Vec<Interval>>,
    /// Whether the derivative is regular over the box: one zero at most.
    pub(in crate::net) single: bool,
}

/// With the derivative over a box Y and the value at its middle m, $F(y) \in F(m) + F'(Y)(y - m)$,
/// and an approximate inverse of the derivative: nothing where there is no inverse.
pub(in crate::net) fn step(
    whole: &[Interval],
    slope: &Dense,
    value: &[Interval],
) -> Option<Newton> {
    let inverse = inverse_of_middle(slope)?;
    let value = times(&inverse, value);
    let slope = times_matrix(&inverse, slope);
    let mut off: Vec<Interval> =
        whole.iter().map(|part| *part - Interval::point(part.mid())).collect();
    let radius: Vec<f64> = off.iter().map(|part| part.mag()).collect();
    let single = (0..whole.len()).all(|row| {
        let mut moved = Interval::ZERO;
        for (column, radius) in radius.iter().enumerate() {
            let unit = if row == column { Interval::ONE } else { Interval::ZERO };
            let part = sum(unit, -slope[(row, column)]);
            moved = moved + Interval::point(part.mag()) * Interval::point(*radius);
        }
        moved.hi() < radius[row]
    });
    for row in 0..whole.len() {
        let others = (0..whole.len()).filter(|column| *column != row);
        let terms = others.map(|column| slope[(row, column)] * off[column]);
        let rest = terms.fold(value[row], sum);
        let own = slope[(row, row)];
        if own.contains(0.0) {
            if !(rest + own * off[row]).contains(0.0) {
                return Some(Newton { left: None, single });
            }
            continue;
        }
        match off[row].intersect(-(rest / own)) {
            Some(part) => off[row] = part,
            None => return Some(Newton { left: None, single }),
        }
    }
    let narrowed =
        whole.iter().zip(off).map(|(part, off)| part.intersect(Interval::point(part.mid()) + off));
    Some(Newton { left: narrowed.collect(), single })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Boxes of width 2 and 1: a zero may be 1.5 and 0.75 outside; what is proved reaches an eighth further.
    #[test]
    fn a_zero_may_be_three_quarters_of_its_box_outside() {
        let at = [Interval::new(1.0, 3.0), Interval::new(-2.0, -1.0)];
        for (zero, widths) in [
            ([2.0, -1.5], Some([2.0, 1.0])),
            ([4.4, -1.5], Some([3.4, 1.0])),
            ([-0.4, -1.5], Some([3.4, 1.0])),
            ([2.0, -0.3], Some([2.0, 1.7])),
            ([2.0, -2.7], Some([2.0, 1.7])),
            ([4.6, -1.5], None),
            ([-0.6, -1.5], None),
            ([2.0, -0.2], None),
            ([2.0, -2.8], None),
        ] {
            let found = around(&at, &zero).map(|found| [0, 1].map(|k| found[k].width()));
            assert_eq!(found.is_some(), widths.is_some(), "{zero:?}");
            for (found, width) in found.into_iter().flatten().zip(widths.into_iter().flatten()) {
                assert!((found - 1.25 * width).abs() < 1e-8, "{zero:?}: {found}");
            }
        }
    }
}
