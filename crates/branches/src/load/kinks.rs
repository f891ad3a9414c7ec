//! Where one-sided conditions change sides.

use super::Equations;
use super::here::{Here, Space};

/// A condition below this has changed sides; above it, it is at zero to rounding.
pub(super) const WRONG: f64 = 1e-10;

/// A point with the conditions that change sides there.
pub(super) type Switching<S> = (Here, Vec<S>);

/// What is left of a condition where it is said to vanish, over what it was before and after.
const VANISHES: f64 = 1e-3;

/// The first point between two at which conditions change sides, with these; `None` when
/// none does. Without conditions where they change without coming to zero, as the force of a row that is pulled straight jumps
/// from one infinity to the other: then the points are not of one path.
pub(super) fn kink<Q: Equations>(
    space: &mut Space<'_, Q>,
    a: &Here,
    b: &Here,
) -> Result<Option<Switching<Q::Side>>, Q::Error> {
    let begin = space.equations.sides(&a.y, a.t)?;
    let mut end = b.clone();
    let mut at_end = space.equations.sides(&b.y, b.t)?;
    let wrong: Vec<bool> = at_end.iter().map(|(_, value)| *value < -WRONG).collect();
    if !wrong.contains(&true) {
        return Ok(None);
    }
    let sizes = begin.iter().zip(&at_end).map(|((_, a), (_, b))| a.abs().max(b.abs()));
    let least: Vec<f64> = sizes.map(|size| -WRONG.max(VANISHES * size)).collect();
    // Each round finds where one of them is at zero to rounding.
    for _ in 0..begin.len() {
        // The one that is estimated to change first; others that change before it come next.
        let part = |k: &usize| begin[*k].1 / (begin[*k].1 - at_end[*k].1);
        let violated = (0..begin.len()).filter(|k| wrong[*k] && at_end[*k].1 < -WRONG);
        let Some(first) = violated.min_by(|a, b| part(a).total_cmp(&part(b))) else { break };
        if begin[first].1 <= WRONG {
            end = a.clone();
            at_end = begin;
            break;
        }
        let found = space.located([a, &end], |space, here| {
            Some(space.equations.sides(&here.y, here.t).ok()?[first].1)
        });
        let Some(at) = found else { break };
        at_end = space.equations.sides(&at.y, at.t)?;
        end = at;
    }
    let changed = |k: &usize| wrong[*k] && at_end[*k].1 <= WRONG;
    let jumps = (0..at_end.len()).filter(changed).any(|k| at_end[k].1 < least[k]);
    let sides = (0..at_end.len()).filter(|k| !jumps && changed(k)).map(|k| at_end[k].0);
    Ok(Some((end, sides.collect())))
}
