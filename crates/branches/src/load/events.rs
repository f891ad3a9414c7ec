//! What happens between two points of a path.

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
/// A test that has become so many times larger than at both ends of a step is at a pole.
const POLE: f64 = 4.0;
/// Part of a step to which a point is located.
const NARROW: f64 = 1e-12;
/// A condition below this has changed sides; above it, it is at zero to rounding.
pub(super) const WRONG: f64 = 1e-10;

/// A point with the conditions that change sides there.
pub(super) type Switching<S> = (Here, Vec<S>);

/// A point where the matrix is singular.
pub(super) struct Singular {
    pub(super) at: Here,
    pub(super) kind: Kind,
    pub(super) index: [usize; 2],
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

/// Limit points and branch points between two points with the same active conditions, in their
/// order.
pub(super) fn smooth<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    a: &Here,
    b: &Here,
) -> Vec<Singular> {
    let turn = (a.tangent.t * b.tangent.t < 0.0)
        .then(|| {
            let point = |part| a.between(equations, metric, b, part);
            sign_change([a, b], NARROW, point, |here: &Here| Some(here.tangent.t))
        })
        .flatten();
    let Some((part, at)) = turn else {
        return branches(equations, metric, [a, b], HALVINGS);
    };
    let mut beside = |part: f64, other: &Here| {
        a.between(equations, metric, b, part.clamp(0.0, 1.0)).unwrap_or_else(|| other.clone())
    };
    let (before, after) = (beside(part - BESIDE, a), beside(part + BESIDE, b));
    let (mode, load_on_mode) = mode(equations, metric, &at);
    let index = [before.index, after.index];
    let mut all = branches(equations, metric, [a, &before], HALVINGS);
    all.push(Singular { at, kind: Kind::Limit, index, mode, load_on_mode });
    all.extend(branches(equations, metric, [&after, b], HALVINGS));
    all
}

/// Branch points between two points: where the inertia changes.
///
/// The test changes its sign there, but at its poles too, so that a step may have to be halved
/// until it holds one of them alone.
fn branches<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
    halvings: usize,
) -> Vec<Singular> {
    if a.index == b.index {
        return vec![];
    }
    if let Some((before, found, after)) = branch(equations, metric, [a, b]) {
        let left = halvings.saturating_sub(1);
        let mut all = branches(equations, metric, [a, &before], left);
        all.push(found);
        all.extend(branches(equations, metric, [&after, b], left));
        return all;
    }
    let middle = if halvings == 0 { None } else { a.between(equations, metric, b, 0.5) };
    let Some(middle) = middle else {
        let (mode, load_on_mode) = mode(equations, metric, b);
        let index = [a.index, b.index];
        return vec![Singular { at: b.clone(), kind: Kind::Branch, index, mode, load_on_mode }];
    };
    let mut all = branches(equations, metric, [a, &middle], halvings - 1);
    all.extend(branches(equations, metric, [&middle, b], halvings - 1));
    all
}

/// A branch point where the test changes its sign, with points before and after it.
fn branch<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
) -> Option<(Here, Singular, Here)> {
    let tests = [a, b].map(|end| singular(equations, end).map(|(_, test)| test));
    let [Some(at_a), Some(at_b)] = tests else { return None };
    let (part, at) = {
        // Each closure borrows the equations while the other does not.
        let equations = std::cell::RefCell::new(&mut *equations);
        let point = |part| a.between(*equations.borrow_mut(), metric, b, part);
        let large = POLE * at_a.abs().max(at_b.abs());
        let test = |here: &Here| singular(*equations.borrow_mut(), here).map(|(_, test)| test);
        let test = |here: &Here| test(here).filter(|test| test.abs() <= large);
        sign_change([a, b], NARROW, point, test)?
    };
    let test = singular(equations, &at)?.1.abs();
    let beside = |part: f64| a.between(equations, metric, b, part.clamp(0.0, 1.0));
    let [before, after] = [part - BESIDE, part + BESIDE].map(beside);
    let (before, after) = (before?, after?);
    // At a pole the test is large, and the inertia the same on both sides.
    if before.index == after.index || test > at_a.abs().min(at_b.abs()) {
        return None;
    }
    let (mode, load_on_mode) = mode(equations, metric, &at);
    let index = [before.index, after.index];
    Some((before, Singular { at, kind: Kind::Branch, index, mode, load_on_mode }, after))
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
        let found = {
            let equations = std::cell::RefCell::new(&mut *equations);
            let point = |part| a.between(*equations.borrow_mut(), metric, &end, part);
            let value = |here: &Here| {
                let sides = equations.borrow_mut().sides(&here.y, here.t).ok()?;
                Some(sides[first].1)
            };
            sign_change([a, &end], NARROW, point, value)
        };
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
