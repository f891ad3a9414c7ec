//! The interval Newton method on a dense system of equations.

use numerics::Interval;

use super::dense::Dense;
use crate::network::arithmetic::sum;

/// A step of the method.
pub(in crate::network::census) struct Newton {
    /// What is left of the box; nothing if it holds no zero.
    pub(in crate::network::census) left: Option<Vec<Interval>>,
    /// Whether the derivative is regular over the box: one zero at most.
    pub(in crate::network::census) single: bool,
}

/// With the derivative over a box Y and the value at its middle m, $F(y) \in F(m) + F'(Y)(y - m)$,
/// and an approximate inverse of the derivative: nothing where there is no inverse.
pub(in crate::network::census) fn step(
    whole: &[Interval],
    slope: &Dense<Interval>,
    value: &[Interval],
) -> Option<Newton> {
    let inverse = slope.middle().inverse()?;
    let value = inverse.times(value);
    let slope = inverse.times_matrix(slope);
    let mut off: Vec<Interval> =
        whole.iter().map(|part| *part - Interval::point(part.mid())).collect();
    let radius: Vec<f64> = off.iter().map(|part| part.mag()).collect();
    let single = (0..whole.len()).all(|row| {
        let mut moved = Interval::ZERO;
        for (column, radius) in radius.iter().enumerate() {
            let unit = if row == column { Interval::ONE } else { Interval::ZERO };
            let part = sum(unit, -slope.at(row, column));
            moved = moved + Interval::point(part.mag()) * Interval::point(*radius);
        }
        moved.hi() < radius[row]
    });
    for row in 0..whole.len() {
        let others = (0..whole.len()).filter(|column| *column != row);
        let terms = others.map(|column| slope.at(row, column) * off[column]);
        let rest = terms.fold(value[row], sum);
        let own = slope.at(row, row);
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
