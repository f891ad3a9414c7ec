//! What happens between two points of a path.

use std::cell::RefCell;

use nalgebra::DVector;

use super::bordered::{Bordered, Row};
use super::here::{Here, Metric};
use super::{Equations, Kind};
use crate::locate::sign_change;

/// How far before and after a limit point, as a part of the step, the inertia is counted.
const BESIDE: f64 = 1e-3;
/// Halvings of a step that holds several changes of the inertia; those still together after that
/// are one.
const HALVINGS: usize = 20;
/// The test vanishes below this part of what it is at the ends of a step; in a step that is as short as it
/// gets, of several branch points together, below so many times that.
const VANISHES: f64 = 1e-6;
const CLUSTER: f64 = 1e2;
/// A test that has become so many times larger than at both ends of a step is at a pole.
const POLE: f64 = 4.0;
/// Part of a step to which a point is located.
const NARROW: f64 = 1e-12;
/// A load acts on a mode by less than this part of both if it does not.
const OFF: f64 = 1e-6;
/// A condition below this has changed sides; above it, it is at zero to rounding.
pub(super) const WRONG: f64 = 1e-10;

/// A point with the conditions that change sides there.
pub(super) type Switching<S> = (Here, Vec<S>);

/// A point where the matrix is singular.
pub(super) struct Singular {
    pub(super) at: Here,
    pub(super) kind: Kind,
    pub(super) index: [usize; 2],
    /// Whether the parameter turns there.
    pub(super) turns: bool,
    pub(super) mode: DVector<f64>,
    pub(super) load_on_mode: f64,
}

/// A fixed vector without symmetry.
pub(super) fn without_symmetry(size: usize) -> Row {
    let y =
        DVector::from_fn(size, |k, _| ((k as f64 + 1.0) * 0.754_877_666_246_692_7).fract() - 0.4);
    Row { y, t: 0.0 }
}

/// The test for a singular matrix, 0 where it is, and the null vector there.
fn singular<Q: Equations>(equations: &mut Q, here: &Here) -> Option<(DVector<f64>, f64)> {
    equations.factorise(&here.y, here.t).ok()??;
    let row = without_symmetry(here.y.len());
    let zero = DVector::zeros(here.y.len());
    let bordered = Bordered::new(equations, &row.y, &row);
    let (y, test) = bordered.solve(equations, (&zero, 1.0))?;
    Some((y, test))
}

/// The mode with its largest entry among the places 1, and how much of the load acts on it.
fn mode<Q: Equations>(equations: &mut Q, metric: Metric, at: &Here) -> (DVector<f64>, f64) {
    let Some((mode, _)) = singular(equations, at) else {
        return (DVector::zeros(at.y.len()), 1.0);
    };
    let Ok(column) = equations.by_parameter(&at.y, at.t) else { return (mode, 1.0) };
    let on = mode.dot(&column).abs() / (mode.norm() * column.norm()).max(f64::MIN_POSITIVE);
    let places = mode.rows(0, metric.places);
    let largest = places[places.iamax()];
    let mode = if largest.abs() > 0.0 { mode / largest } else { mode };
    (mode, on)
}

/// Where a test changes its sign between two points: the part of the way, and the point there.
///
/// Each guess is between its neighbours among the points found so far: where the corrector is
/// singular, as where paths cross, it has less and less to do.
fn located<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
    test: impl Fn(&mut Q, &Here) -> Option<f64>,
) -> Option<(f64, Here)> {
    // Both closures borrow the equations, one after the other.
    let equations = RefCell::new(equations);
    let chord = a.towards(b);
    let mut known = vec![(0.0, a.clone()), (1.0, b.clone())];
    let point = |part: f64| {
        let next = known.partition_point(|(other, _)| *other < part).clamp(1, known.len() - 1);
        let [(low, from), (high, to)] = [&known[next - 1], &known[next]];
        let between = (part - low) / (high - low);
        let here = from.next_to(*equations.borrow_mut(), metric, to, (&chord, between))?;
        known.insert(next, (part, here.clone()));
        Some(here)
    };
    sign_change([a, b], NARROW, point, |here: &Here| test(*equations.borrow_mut(), here))
}

/// Limit points and branch points between two points with the same active conditions, in their
/// order; nothing where the two are on different paths.
pub(super) fn smooth<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    a: &Here,
    b: &Here,
) -> Option<Vec<Singular>> {
    let turn = (a.tangent.t * b.tangent.t < 0.0)
        .then(|| located(equations, metric, [a, b], |_, here| Some(here.tangent.t)))
        .flatten();
    let mut all = vec![];
    let Some((part, at)) = turn else {
        branches(equations, metric, [a, b], &mut all)?;
        return Some(all);
    };
    let mut beside = |part: f64, other: &Here| {
        a.between(equations, metric, b, part.clamp(0.0, 1.0)).unwrap_or_else(|| other.clone())
    };
    let (before, after) = (beside(part - BESIDE, a), beside(part + BESIDE, b));
    let (mode, load_on_mode) = mode(equations, metric, &at);
    let index = [before.index, after.index];
    branches(equations, metric, [a, &before], &mut all)?;
    // Where a path of a pitchfork comes to the other one the load does not act on the mode.
    let kind = if load_on_mode > OFF { Kind::Limit } else { Kind::Branch };
    all.push(Singular { at, kind, index, turns: true, mode, load_on_mode });
    branches(equations, metric, [&after, b], &mut all)?;
    Some(all)
}

/// Branch points between two points: where the inertia changes; nothing where it jumps from one path
/// to another.
///
/// The test changes its sign there, but at its poles too, so that a step may have to be halved
/// until it holds one of them alone.
fn branches<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
    all: &mut Vec<Singular>,
) -> Option<()> {
    if a.index == b.index {
        return Some(());
    }
    let tests = [a, b].map(|end| singular(equations, end).map_or(0.0, |(_, test)| test.abs()));
    let zero = VANISHES * tests[0].max(tests[1]);
    within(equations, metric, [a, b], (zero, HALVINGS), all)
}

fn within<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
    (zero, halvings): (f64, usize),
    all: &mut Vec<Singular>,
) -> Option<()> {
    if a.index == b.index {
        return Some(());
    }
    let left = (zero, halvings.saturating_sub(1));
    if let Some((before, found, after)) = branch(equations, metric, [a, b], zero) {
        within(equations, metric, [a, &before], left, all)?;
        all.push(found);
        return within(equations, metric, [&after, b], left, all);
    }
    if halvings > 0
        && let Some(middle) = a.between(equations, metric, b, 0.5)
    {
        within(equations, metric, [a, &middle], left, all)?;
        return within(equations, metric, [&middle, b], left, all);
    }
    // Several at once, or a gap between two paths.
    let (_, test) = singular(equations, b)?;
    let (mode, load_on_mode) = mode(equations, metric, b);
    let index = [a.index, b.index];
    all.push(Singular {
        at: b.clone(),
        kind: Kind::Branch,
        index,
        turns: false,
        mode,
        load_on_mode,
    });
    (test.abs() <= CLUSTER * zero).then_some(())
}

/// A branch point where the test changes its sign, with points before and after it.
fn branch<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
    zero: f64,
) -> Option<(Here, Singular, Here)> {
    let tests = [a, b].map(|end| singular(equations, end).map(|(_, test)| test));
    let [Some(at_a), Some(at_b)] = tests else { return None };
    let large = POLE * at_a.abs().max(at_b.abs());
    let (part, at) = located(equations, metric, [a, b], |equations, here| {
        singular(equations, here).map(|(_, test)| test).filter(|test| test.abs() <= large)
    })?;
    // At a pole it is large, and at a gap between two paths it does not vanish.
    if singular(equations, &at)?.1.abs() > zero {
        return None;
    }
    let mut beside = |part: f64| a.between(equations, metric, b, part.clamp(0.0, 1.0));
    let (before, after) = (beside(part - BESIDE)?, beside(part + BESIDE)?);
    if before.index == after.index {
        return None;
    }
    let (mode, load_on_mode) = mode(equations, metric, &at);
    let index = [before.index, after.index];
    Some((
        before,
        Singular { at, kind: Kind::Branch, index, turns: false, mode, load_on_mode },
        after,
    ))
}

/// The first point between two at which conditions change sides, with these; nothing where none
/// does.
pub(super) fn kink<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    a: &Here,
    b: &Here,
) -> Result<Option<Switching<Q::Side>>, Q::Error> {
    let begin = equations.sides(&a.y, a.t)?;
    let mut end = b.clone();
    let mut at_end = equations.sides(&b.y, b.t)?;
    let wrong: Vec<bool> = at_end.iter().map(|(_, value)| *value < -WRONG).collect();
    if !wrong.contains(&true) {
        return Ok(None);
    }
    loop {
        // The one that is estimated to change first; others that change before it come next.
        let part = |k: &usize| begin[*k].1 / (begin[*k].1 - at_end[*k].1);
        let violated = (0..begin.len()).filter(|k| wrong[*k] && at_end[*k].1 < -WRONG);
        let Some(first) = violated.min_by(|a, b| part(a).total_cmp(&part(b))) else { break };
        if begin[first].1 <= WRONG {
            end = a.clone();
            at_end = begin;
            break;
        }
        let found = located(equations, metric, [a, &end], |equations, here| {
            Some(equations.sides(&here.y, here.t).ok()?[first].1)
        });
        let Some((_, at)) = found else { break };
        at_end = equations.sides(&at.y, at.t)?;
        // At zero to rounding.
        let done = at_end[first].1.abs() > WRONG;
        end = at;
        if done {
            break;
        }
    }
    let sides = at_end.iter().zip(&wrong);
    let sides = sides.filter(|((_, value), wrong)| **wrong && *value <= WRONG);
    let sides: Vec<_> = sides.map(|((side, _), _)| *side).collect();
    Ok((!sides.is_empty()).then_some((end, sides)))
}
