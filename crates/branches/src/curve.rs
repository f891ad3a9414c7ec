use nalgebra::DVector;

use crate::equations::{RESIDUAL, Tangent, correct, position_axis, residual, tangent};
use crate::event::EventKind;
use crate::locate::on_chord;
use crate::observables::is_straight;
use crate::path::Path;

/// Cosine of the largest turn of the tangent in one step, about 14 degrees.
const STRAIGHT_ENOUGH: f64 = 0.97;

/// A corrector that moves a point further than this part of the step has found another curve. A
/// step that turns as far as it may leaves its tangent by half of that angle, 0.12.
const CORRECTION: f64 = 0.2;

/// Steps shorter than this count as zero.
const SHORTEST: f64 = 1e-10;

/// Growth of the next step after one that went well.
const GROWTH: f64 = 1.6;

/// Steps along one curve between neighbouring points; a hundred are many.
const MOST_STEPS: usize = 5_000;

/// How much a turn may lie beyond a position at which the chain is refused because it is straight
/// there: the turn is that position.
const BORDER_SLACK: f64 = 1e-9;

/// Where the side of the tangent changes within so short a step, curves cross. Within a longer one
/// the step may have changed from one curve to another that does not cross it but comes near.
const CROSSING: f64 = 1e-5;

/// The end of a walk past a crossing is this near to the end of the step that it checks.
const SAME_END: f64 = 1e-7;

/// Changes of the position along a step below this are not told from rounding.
const FLAT: f64 = 1e-10;

/// Where a curve cannot be followed into a border it is followed up to one of these parts of the
/// last step before it, the first that can be had.
const SHORT_OF: [f64; 3] = [1e-6, 1e-4, 1e-2];

/// A slope that falls below this part of those at both ends of a step may change its sign twice.
const DIP: f64 = 0.2;

/// What is at an end of the interval in which a curve is followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Gate {
    /// A complete census.
    Open,
    /// No chain, or a degenerate one: a curve may turn just here.
    Closed,
    /// A number leaves its range: curves just end.
    Edge,
}

/// One end of the interval in which a curve is followed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Border {
    pub(crate) position: f64,
    pub(crate) gate: Gate,
}

#[derive(Debug, Clone)]
pub(crate) struct CurvePoint {
    pub(crate) y: DVector<f64>,
    pub(crate) turn: Option<EventKind>,
}

/// What is at the end of a curve, or of one of its arcs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CurveEnd {
    /// An equilibrium of the lower census point.
    Low(usize),
    /// An equilibrium of the higher census point.
    High(usize),
    /// The turn of this number on the curve.
    Turn(usize),
    /// A position at which there is no chain, or no complete census.
    Border,
    /// It could not be followed.
    Lost,
}

/// A curve of equilibria in an interval.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    pub(crate) points: Vec<CurvePoint>,
    pub(crate) ends: [CurveEnd; 2],
}

/// Where a curve left the interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    Low,
    High,
    Lost,
}

/// A point with its tangent.
#[derive(Debug, Clone)]
struct Here {
    y: DVector<f64>,
    tangent: Tangent,
}

/// A step along a curve: where it ends, and where it turns on the way.
struct Step {
    end: Here,
    turn: Option<(DVector<f64>, EventKind)>,
    crosses: bool,
}

/// Follow the curve from `start` on, to higher positions first or to lower ones.
pub(crate) fn follow(
    path: &Path<'_>,
    start: &DVector<f64>,
    forward: bool,
    [low, high]: [Border; 2],
    longest: f64,
) -> (Vec<CurvePoint>, Exit) {
    let last = start.len() - 1;
    let mut points = vec![CurvePoint { y: start.clone(), turn: None }];
    let sign = if forward { 1.0 } else { -1.0 };
    let Some(first) = tangent(path, start, &(sign * position_axis(last - 3))) else {
        return (points, Exit::Lost);
    };
    let ahead = |slope: f64| if slope > 0.0 { (high, Exit::High) } else { (low, Exit::Low) };
    let mut here = Here { y: start.clone(), tangent: first };
    let mut length = longest;
    for _ in 0..MOST_STEPS {
        let slope = here.tangent.t[last];
        let (border, exit) = ahead(slope);
        // The whole way to the border in one step, if that is not too long. Next to a closed border
        // the curve may just turn.
        let way = (border.position - here.y[last]) / slope;
        let landing = way <= length && border.gate != Gate::Closed;
        let long = if landing { way.max(0.0) } else { length };
        let row = landing.then(|| sign_of(slope) * position_axis(last - 3));
        let step = step(path, &here, long, row.as_ref())
            .filter(|step| !step.crosses || passes(path, &here, &step.end.y, long));
        let Some(Step { end, turn, .. }) = step else {
            // Short of the border a landing is tried again as a step.
            length = 0.5 * long.min(length);
            if length < SHORTEST {
                return (points, Exit::Lost);
            }
            continue;
        };
        let slope_there = end.tangent.t[last];
        if let Some((y, turn)) = turn {
            let slack = if border.gate == Gate::Closed { BORDER_SLACK } else { 0.0 };
            if beyond(y[last], border.position, slope) > slack {
                land(path, &here.y, &y, border, &mut points);
                return (points, exit);
            }
            points.push(CurvePoint { y: y.clone(), turn: Some(turn) });
            let (border, exit) = ahead(slope_there);
            if beyond(end.y[last], border.position, slope_there) >= 0.0 {
                land(path, &y, &end.y, border, &mut points);
                return (points, exit);
            }
        } else if landing {
            let mut y = end.y;
            y[last] = border.position;
            points.push(CurvePoint { y, turn: None });
            return (points, exit);
        } else if beyond(end.y[last], border.position, slope) >= 0.0 {
            land(path, &here.y, &end.y, border, &mut points);
            return (points, exit);
        }
        points.push(CurvePoint { y: end.y.clone(), turn: None });
        here = end;
        length = (GROWTH * long.max(SHORTEST)).min(longest);
    }
    (points, Exit::Lost)
}

/// A step of this length, corrected across the tangent or in another `row`; `None` if it is too
/// long to say what happens on it.
fn step(path: &Path<'_>, here: &Here, length: f64, row: Option<&DVector<f64>>) -> Option<Step> {
    let (a, t) = (&here.y, &here.tangent.t);
    let last = a.len() - 1;
    let predicted = a + length * t;
    let b = correct(path, predicted.clone(), row.unwrap_or(t))?;
    if (&b - &predicted).norm() > CORRECTION * length.max(SHORTEST) {
        return None;
    }
    let next = tangent(path, &b, t)?;
    if next.t.dot(t) < STRAIGHT_ENOUGH {
        return None;
    }
    let crosses = next.side * here.tangent.side < 0.0;
    // Where the pull passes infinity the chain is straight, and the curve turns there and only
    // there.
    let straightens = a[last - 1] * b[last - 1] < 0.0;
    let slopes = [t[last], next.t[last]];
    let turn = if slopes[0] * slopes[1] < 0.0 {
        let slope =
            |y: &DVector<f64>, chord: &DVector<f64>| tangent(path, y, chord).map(|t| t.t[last]);
        let y = on_chord(path, a, &b, slope)?;
        // Hanging straight down a chain can carry any force: there the curve crosses that of these
        // forces.
        let straight = (straightens || crosses) && is_straight(&y);
        if straightens && !straight {
            return None;
        }
        let turn = match (straight, crosses) {
            (true, _) => EventKind::Straight,
            // The two sides are mirror images: another branch, which is symmetric, passes between them.
            (_, true) => EventKind::BranchPoint,
            _ => EventKind::Fold,
        };
        Some((y, turn))
    } else {
        if straightens || dips(a, &b, slopes) {
            return None;
        }
        None
    };
    Some(Step { end: Here { y: b, tangent: next }, turn, crosses })
}

/// Whether the position may turn twice, back and forth, between two points with these slopes of the
/// same sign: the parabola through the slopes that has their mean changes its sign, or nearly.
fn dips(a: &DVector<f64>, b: &DVector<f64>, [first, second]: [f64; 2]) -> bool {
    let last = a.len() - 1;
    let length = (b - a).norm();
    let sign = sign_of(first + second);
    let (first, second) = (sign * first, sign * second);
    if first.max(second) * length <= FLAT {
        return false;
    }
    let mean = sign * (b[last] - a[last]) / length;
    // first + linear s + square s^2 for s from 0 to 1.
    let square = 3.0 * (first + second) - 6.0 * mean;
    let linear = second - first - square;
    let lowest = -linear / (2.0 * square);
    let inside = square > 0.0 && lowest > 0.0 && lowest < 1.0;
    inside && first - linear * linear / (4.0 * square) < DIP * first.min(second)
}

/// Whether the curve itself leads across a crossing to the end of a long step: walked in steps so
/// short that none changes to another curve.
fn passes(path: &Path<'_>, from: &Here, end: &DVector<f64>, long: f64) -> bool {
    if long <= CROSSING {
        return true;
    }
    let chord = end - &from.y;
    let size = chord.norm();
    let row = &chord / size;
    let mut here = from.clone();
    let mut length = 0.5 * long;
    let mut crossed = false;
    for _ in 0..MOST_STEPS {
        let rest = row.dot(&(end - &here.y)) / row.dot(&here.tangent.t);
        let landing = rest <= length;
        let try_long = if landing { rest.max(0.0) } else { length };
        let step = step(path, &here, try_long, landing.then_some(&row))
            .filter(|step| !step.crosses || (try_long <= CROSSING && !crossed));
        let Some(step) = step else {
            length = 0.5 * try_long.min(length);
            if length < SHORTEST {
                return false;
            }
            continue;
        };
        crossed |= step.crosses;
        here = step.end;
        if landing {
            return crossed && (&here.y - end).norm() <= SAME_END;
        }
        length = (GROWTH * try_long.max(SHORTEST)).min(0.5 * long);
    }
    false
}

fn sign_of(x: f64) -> f64 {
    if x < 0.0 { -1.0 } else { 1.0 }
}

/// How far a position lies beyond a border, going up or down.
fn beyond(position: f64, border: f64, direction: f64) -> f64 {
    sign_of(direction) * (position - border)
}

/// The point between two where the curve crosses the border.
fn land(
    path: &Path<'_>,
    a: &DVector<f64>,
    b: &DVector<f64>,
    border: Border,
    points: &mut Vec<CurvePoint>,
) {
    let last = a.len() - 1;
    let gap = |y: &DVector<f64>, _: &DVector<f64>| Some(y[last] - border.position);
    let mut y = on_chord(path, a, b, gap).unwrap_or_else(|| b.clone());
    y[last] = border.position;
    let singular =
        border.gate == Gate::Closed && residual(&path.plane(border.position), &y).amax() > RESIDUAL;
    let y = if singular { short_of(path, a, &y) } else { Some(y) };
    points.extend(y.map(|y| CurvePoint { y, turn: None }));
}

/// The point of the curve just short of a border at which the equations are singular: `at` is next
/// to the border and need not solve them.
fn short_of(path: &Path<'_>, from: &DVector<f64>, at: &DVector<f64>) -> Option<DVector<f64>> {
    let row = position_axis(at.len() - 4);
    SHORT_OF.iter().find_map(|part| correct(path, at + *part * (from - at), &row))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between two points 2 apart the position has a slope of its parabola of 1 - 3 (1 - m) 2 s (1 - s) for
    /// equal slopes 1 at both ends and the mean m: it touches zero for m = 1/3.
    #[test]
    fn a_curve_dips_where_its_slope_may_vanish_between_two_points() {
        let may = |mean: f64, slopes: [f64; 2]| {
            let [a, b] = [-1.0, 1.0].map(|end| {
                let along = (1.0 - mean * mean).sqrt();
                DVector::from_column_slice(&[end * along, end * mean])
            });
            dips(&a, &b, slopes)
        };
        assert!(may(0.45, [1.0, 1.0]) && !may(0.5, [1.0, 1.0]));
        // Falling is as rising, and a slope that is not known is no reason for another sign.
        assert!(may(-0.3, [-1.0, -1.0]) && may(0.3, [-1.0, -1.0]));
        assert!(may(0.0, [-1.0, 0.0]) && may(0.0, [0.0, 1.0]));
        // The lowest slope is at 7/12 of the way for 1 and 1/2.
        assert!(may(0.1, [1.0, 0.5]) && !may(0.75, [1.0, 0.5]));
    }
}
