//! Following one curve of equilibria between two positions.

use nalgebra::DVector;

use super::course::Course;
use super::equations::{correct, position_axis, tangent};
use super::refine::on_chord;

/// Cosine of the largest turn of the tangent in one step, about 14 degrees.
const STRAIGHT_ENOUGH: f64 = 0.97;

/// A corrector that moves a point further than this part of the step has found another curve.
const CORRECTION: f64 = 0.3;

/// Steps shorter than this are none.
const SHORTEST: f64 = 1e-10;

/// Growth of the next step after one that went well.
const GROWTH: f64 = 1.6;

/// Steps along one curve between neighbouring points; a hundred are many.
const MOST_STEPS: usize = 5_000;

/// How much a turn may lie beyond a position at which the chain is refused because it is straight
/// there: the turn is that position.
const BORDER_SLACK: f64 = 1e-9;

/// One end of the interval in which a curve is followed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Border {
    pub(crate) position: f64,
    /// Whether there is no chain at this position, or none that is known.
    pub(crate) closed: bool,
}

/// A point on a curve.
#[derive(Debug, Clone)]
pub(crate) struct CurvePoint {
    pub(crate) y: DVector<f64>,
    /// Whether the curve turns back here.
    pub(crate) turn: bool,
}

/// Where a curve left the interval.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    Low,
    High,
    Lost,
}

/// Follow the curve from `start` on, to higher positions first or to lower ones.
pub(crate) fn follow(
    course: &Course<'_>,
    start: &DVector<f64>,
    forward: bool,
    [low, high]: [Border; 2],
    longest: f64,
) -> (Vec<CurvePoint>, Exit) {
    let last = start.len() - 1;
    let mut points = vec![CurvePoint { y: start.clone(), turn: false }];
    let sign = if forward { 1.0 } else { -1.0 };
    let Some(mut t) = tangent(course, start, &(sign * position_axis(last - 3))) else {
        return (points, Exit::Lost);
    };
    let mut a = start.clone();
    let mut step = longest;
    for _ in 0..MOST_STEPS {
        let (border, exit) = if t[last] > 0.0 { (high, Exit::High) } else { (low, Exit::Low) };
        // The whole way to the border in one step, if that is not too long. Next to a closed border the
        // curve may just turn.
        let way = (border.position - a[last]) / t[last];
        let landing = way <= step && !border.closed;
        let length = if landing { way.max(0.0) } else { step };
        let predicted = &a + length * &t;
        let row = if landing { sign_of(t[last]) * position_axis(last - 3) } else { t.clone() };
        let next = correct(course, predicted.clone(), &row)
            .filter(|b| (b - &predicted).norm() <= CORRECTION * length.max(SHORTEST))
            .and_then(|b| tangent(course, &b, &t).map(|next| (b, next)))
            .filter(|(_, next)| next.dot(&t) >= STRAIGHT_ENOUGH);
        let Some((b, next)) = next else {
            // Short of the border a landing is tried again as a step.
            step = 0.5 * length.min(step);
            if step < SHORTEST {
                return (points, Exit::Lost);
            }
            continue;
        };
        if t[last] * next[last] < 0.0 {
            let slope =
                |y: &DVector<f64>, chord: &DVector<f64>| tangent(course, y, chord).map(|t| t[last]);
            let Some(turn) = on_chord(course, &a, &b, slope) else {
                return (points, Exit::Lost);
            };
            let slack = if border.closed { BORDER_SLACK } else { 0.0 };
            if beyond(turn[last], border.position, t[last]) > slack {
                land(course, &a, &turn, border, &mut points);
                return (points, exit);
            }
            points.push(CurvePoint { y: turn.clone(), turn: true });
            let (border, exit) =
                if next[last] > 0.0 { (high, Exit::High) } else { (low, Exit::Low) };
            if beyond(b[last], border.position, next[last]) >= 0.0 {
                land(course, &turn, &b, border, &mut points);
                return (points, exit);
            }
        } else if landing {
            let mut b = b;
            b[last] = border.position;
            points.push(CurvePoint { y: b, turn: false });
            return (points, exit);
        } else if beyond(b[last], border.position, t[last]) >= 0.0 {
            land(course, &a, &b, border, &mut points);
            return (points, exit);
        }
        points.push(CurvePoint { y: b.clone(), turn: false });
        (a, t) = (b, next);
        step = (GROWTH * length.max(SHORTEST)).min(longest);
    }
    (points, Exit::Lost)
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
    course: &Course<'_>,
    a: &DVector<f64>,
    b: &DVector<f64>,
    border: Border,
    points: &mut Vec<CurvePoint>,
) {
    let last = a.len() - 1;
    let gap = |y: &DVector<f64>, _: &DVector<f64>| Some(y[last] - border.position);
    let mut y = on_chord(course, a, b, gap).unwrap_or_else(|| b.clone());
    y[last] = border.position;
    points.push(CurvePoint { y, turn: false });
}
