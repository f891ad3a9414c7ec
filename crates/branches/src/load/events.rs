//! What happens between two points of a path.

use std::cell::RefCell;

use nalgebra::DVector;

use super::bordered::{Bordered, Row};
use super::here::{Here, Metric};
use super::{Equations, Kind};
use crate::locate::sign_change;

/// How far before and after a singular point, as a part of the step, the inertia is counted.
const BESIDE: f64 = 1e-3;
/// Halvings of a step that holds several changes of the inertia.
const HALVINGS: usize = 40;
/// Changes of the inertia that are this near to each other are one event.
const TOGETHER: f64 = 1e-7;
/// Part of a step to which a point is located.
const NARROW: f64 = 1e-12;
/// The test vanishes below this part of what it is at the ends of a step.
const VANISHES: f64 = 1e-6;
/// A test that has become so many times larger than at both ends of a step is at a pole.
const POLE: f64 = 4.0;
/// Corrections of a mode, each by the part of a step at which the factor is.
const CORRECTIONS: usize = 4;
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
///
/// In a singular point no factor is worth much. The mean of the modes before and after it is
/// corrected by $J \phi = 0$ there with the factor before it.
fn mode<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    at: &Here,
    beside: [&Here; 2],
) -> (DVector<f64>, f64) {
    let none = (DVector::zeros(at.y.len()), 1.0);
    let [Some((before, _)), Some((after, _))] = beside.map(|here| singular(equations, here)) else {
        return none;
    };
    let mut mode = (before + after) * 0.5;
    for _ in 0..CORRECTIONS {
        let Some(off) = off(equations, &mode, [at, beside[0]]) else { break };
        mode -= off;
    }
    let Ok(column) = equations.by_parameter(&at.y, at.t) else { return none };
    let on = mode.dot(&column).abs() / (mode.norm() * column.norm()).max(f64::MIN_POSITIVE);
    let places = mode.rows(0, metric.places);
    let largest = places[places.iamax()];
    let mode = if largest.abs() > 0.0 { mode / largest } else { mode };
    (mode, on)
}

/// Points before and after one between two others, by a part of their distance.
fn beside<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    at: &Here,
    ends: [&Here; 2],
) -> [Here; 2] {
    let far = |from: &Here, to: &Here| {
        let way = from.towards(to);
        metric.norm(&way.y, way.t)
    };
    let wanted = BESIDE * far(ends[0], ends[1]);
    ends.map(|end| {
        let part = wanted / far(at, end);
        let here = (part < 1.0).then(|| at.between(equations, metric, end, part)).flatten();
        // Points that lead from the other end to this one.
        let here = here.map(|here| if std::ptr::eq(end, ends[0]) { here.turned() } else { here });
        here.unwrap_or_else(|| end.clone())
    })
}

/// A point where paths cross, corrected with the factor of one beside it: its own is singular in more
/// than one direction.
fn settled<Q: Equations>(equations: &mut Q, at: Here, before: &Here) -> Here {
    let mut best = at;
    let corrected = |equations: &mut Q, at: &Here| -> Option<(Here, bool)> {
        let (left, size) = equations.residual(&at.y, at.t).ok()?;
        equations.factorise(&before.y, before.t).ok()??;
        let step = equations.solve(&-left);
        let y = equations.onto(&(&at.y + step), at.t).ok()?;
        let (_, after) = equations.residual(&y, at.t).ok()?;
        Some((Here { y, ..at.clone() }, after < 0.5 * size))
    };
    for _ in 0..CORRECTIONS {
        match corrected(equations, &best) {
            Some((better, true)) => best = better,
            _ => break,
        }
    }
    best
}

/// What is wrong with a mode in a singular point, by the factor beside it.
fn off<Q: Equations>(
    equations: &mut Q,
    mode: &DVector<f64>,
    [at, beside]: [&Here; 2],
) -> Option<DVector<f64>> {
    equations.factorise(&at.y, at.t).ok()??;
    let left = equations.apply(mode);
    equations.factorise(&beside.y, beside.t).ok()??;
    let row = without_symmetry(mode.len());
    let off = Bordered::new(equations, &row.y, &row).solve(equations, (&left, 0.0));
    off.map(|(off, _)| off)
}

/// Where a test changes its sign between two points.
///
/// Each guess is between its neighbours among the points found so far: where the corrector is
/// singular, as where paths cross, it has less and less to do.
fn located<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [a, b]: [&Here; 2],
    test: impl Fn(&mut Q, &Here) -> Option<f64>,
) -> Option<Here> {
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
    let found =
        sign_change([a, b], NARROW, point, |here: &Here| test(*equations.borrow_mut(), here));
    found.map(|(_, here)| here)
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
    let Some(at) = turn else {
        branches(equations, metric, [a, b], &mut all)?;
        return Some(all);
    };
    let [before, after] = beside(equations, metric, &at, [a, b]);
    let at = settled(equations, at, &before);
    let (mode, load_on_mode) = mode(equations, metric, &at, [&before, &after]);
    let index = [before.index, after.index];
    branches(equations, metric, [a, &before], &mut all)?;
    // A limit exchanges stability; on a side path of a pitchfork the parameter turns where it meets
    // the other one, and both halves are alike.
    let kind = if index[0] == index[1] { Kind::Branch } else { Kind::Limit };
    all.push(Singular { at, kind, index, turns: true, mode, load_on_mode });
    branches(equations, metric, [&after, b], &mut all)?;
    Some(all)
}

/// Branch points between two points: where the inertia changes; `None` when it jumps from one path
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
    let tests = [a, b].map(|end| singular(equations, end).map_or(f64::NAN, |(_, test)| test));
    within(equations, metric, [(a, tests[0]), (b, tests[1])], HALVINGS, all)
}

/// The same with the tests at both points.
fn within<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [(a, at_a), (b, at_b)]: [(&Here, f64); 2],
    halvings: usize,
    all: &mut Vec<Singular>,
) -> Option<()> {
    if a.index == b.index {
        return Some(());
    }
    if at_a * at_b < 0.0
        && let Some((before, found, after)) = branch(equations, metric, [(a, at_a), (b, at_b)])
    {
        branches(equations, metric, [a, &before], all)?;
        all.push(found);
        return branches(equations, metric, [&after, b], all);
    }
    let way = a.towards(b);
    if metric.coarse().norm(&way.y, way.t) <= TOGETHER {
        let (mode, load_on_mode) = mode(equations, metric, b, [a, b]);
        let (kind, index) = (Kind::Branch, [a.index, b.index]);
        all.push(Singular { at: b.clone(), kind, index, turns: false, mode, load_on_mode });
        return Some(());
    }
    // On two paths the ends do not come nearer to each other.
    let middle = (halvings > 0).then(|| a.between(equations, metric, b, 0.5)).flatten()?;
    let test = singular(equations, &middle).map_or(f64::NAN, |(_, test)| test);
    within(equations, metric, [(a, at_a), (&middle, test)], halvings - 1, all)?;
    within(equations, metric, [(&middle, test), (b, at_b)], halvings - 1, all)
}

/// A branch point where the test changes its sign, with points before and after it.
fn branch<Q: Equations>(
    equations: &mut Q,
    metric: Metric,
    [(a, at_a), (b, at_b)]: [(&Here, f64); 2],
) -> Option<(Here, Singular, Here)> {
    let size = at_a.abs().max(at_b.abs());
    let at = located(equations, metric, [a, b], |equations, here| {
        singular(equations, here).map(|(_, test)| test).filter(|test| test.abs() <= POLE * size)
    })?;
    // At a pole it is large, and at a gap between two paths it does not vanish.
    if singular(equations, &at)?.1.abs() > VANISHES * size {
        return None;
    }
    let [before, after] = beside(equations, metric, &at, [a, b]);
    if before.index == after.index {
        return None;
    }
    let at = settled(equations, at, &before);
    let (mode, load_on_mode) = mode(equations, metric, &at, [&before, &after]);
    let (kind, index) = (Kind::Branch, [before.index, after.index]);
    Some((before, Singular { at, kind, index, turns: false, mode, load_on_mode }, after))
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
        let Some(at) = found else { break };
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
