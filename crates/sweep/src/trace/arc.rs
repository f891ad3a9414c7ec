//! Arcs: the parts of a curve along which the position rises, and what happens on them.

use nalgebra::DVector;

use super::course::Course;
use super::equations::residual;
use super::event::EventKind;
use super::observe::Observed;
use super::refine::{crossing_on_chord, on_chord};
use super::segment::{Curve, Tip};

/// A chain whose bars agree in direction to this (sine) where its curve turns lies on one line; turns are
/// located to the square root of rounding or better.
const STRAIGHT: f64 = 1e-5;

/// A part of a curve, by rising position.
#[derive(Debug, Clone)]
pub(crate) struct Arc {
    pub(crate) points: Vec<ArcPoint>,
    pub(crate) ports: [Port; 2],
}

/// An end of an arc.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Port {
    Low(usize),
    High(usize),
    /// The turn of this number on the curve.
    Turn(usize),
    Border,
    Lost,
}

/// A point of an arc with what happens there.
#[derive(Debug, Clone)]
pub(crate) struct ArcPoint {
    pub(crate) y: DVector<f64>,
    pub(crate) seen: Observed,
    pub(crate) happens: Option<EventKind>,
}

/// The arcs of a curve in their order along it, and the kinds of its turns.
pub(crate) fn arcs(course: &Course<'_>, curve: &Curve) -> (Vec<Arc>, Vec<EventKind>) {
    let point = |y: &DVector<f64>| {
        let seen = Observed::at(&course.plane(y[y.len() - 1]), y);
        ArcPoint { y: y.clone(), seen, happens: None }
    };
    let points: Vec<ArcPoint> = curve.points.iter().map(|p| point(&p.y)).collect();
    let turns: Vec<usize> = (0..points.len()).filter(|k| curve.points[*k].turn).collect();
    let kinds = turns.iter().map(|k| turn_kind(&points, *k)).collect();
    let mut bounds = vec![0];
    bounds.extend(&turns);
    bounds.push(points.len() - 1);
    let mut found = vec![];
    for (part, ends) in bounds.windows(2).enumerate() {
        let mut along: Vec<ArcPoint> = points[ends[0]..=ends[1]].to_vec();
        let first = if part == 0 { port(curve.tips[0]) } else { Port::Turn(part - 1) };
        let last = if part == turns.len() { port(curve.tips[1]) } else { Port::Turn(part) };
        borrow_indices(&mut along, [first, last]);
        let mut arc = Arc { points: happenings(course, along), ports: [first, last] };
        let (a, b) = (&arc.points[0].y, &arc.points[arc.points.len() - 1].y);
        if a[a.len() - 1] > b[b.len() - 1] {
            arc.points.reverse();
            arc.ports.reverse();
        }
        drop_roundings(&mut arc.points);
        found.push(arc);
    }
    (found, kinds)
}

/// In a turn the index in the plane is that of the arc; where the chain is straight, in space too.
fn borrow_indices(along: &mut [ArcPoint], ports: [Port; 2]) {
    let count = along.len();
    for (k, neighbour, port) in
        [(0, 1, ports[0]), (count.wrapping_sub(1), count.wrapping_sub(2), ports[1])]
    {
        if let (Port::Turn(_), Some(from)) = (port, along.get(neighbour)) {
            let (inside, outside) = (from.seen.index_in_plane, from.seen.index_out_of_plane);
            let seen = &mut along[k].seen;
            seen.index_in_plane = inside;
            if seen.bent <= STRAIGHT {
                seen.index_out_of_plane = outside;
            }
        }
    }
}

/// Next to a turn the position of a point may pass that of the turn by rounding: such points go.
fn drop_roundings(points: &mut Vec<ArcPoint>) {
    let position = |point: &ArcPoint| point.y[point.y.len() - 1];
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
    let (low, high) = (position(first), position(last));
    let end = points.len() - 1;
    let mut k = 0;
    points.retain(|point| {
        let tip = k == 0 || k == end;
        k += 1;
        tip || point.happens.is_some() || (low..=high).contains(&position(point))
    });
}

fn port(tip: Tip) -> Port {
    match tip {
        Tip::Low(node) => Port::Low(node),
        Tip::High(node) => Port::High(node),
        Tip::Border => Port::Border,
        Tip::Lost => Port::Lost,
    }
}

/// What a turn is: by the shape of the chain, and by the indices on both sides.
fn turn_kind(points: &[ArcPoint], turn: usize) -> EventKind {
    let index = |k: usize| points.get(k).map(|point| point.seen.index_in_plane);
    if points[turn].seen.bent <= STRAIGHT {
        EventKind::Straight
    } else if turn > 0 && index(turn - 1) == index(turn + 1) {
        // The two sides are twins: another branch, with their symmetry, passes between them.
        EventKind::BranchPoint
    } else {
        EventKind::Fold
    }
}

/// The points of an arc with those in between at which an index or a sign changes.
fn happenings(course: &Course<'_>, along: Vec<ArcPoint>) -> Vec<ArcPoint> {
    let mut all: Vec<ArcPoint> = vec![];
    for point in along {
        if let Some(before) = all.last() {
            let mut between = changes(course, before, &point);
            let rising = before.y[before.y.len() - 1] <= point.y[point.y.len() - 1];
            between.sort_by(|a, b| {
                let last = a.y.len() - 1;
                let order = a.y[last].total_cmp(&b.y[last]);
                if rising { order } else { order.reverse() }
            });
            all.extend(between);
        }
        all.push(point);
    }
    all
}

fn changes(course: &Course<'_>, a: &ArcPoint, b: &ArcPoint) -> Vec<ArcPoint> {
    let see = |y: &DVector<f64>| Observed::at(&course.plane(y[y.len() - 1]), y);
    let locate =
        |test: &dyn Fn(&Observed) -> f64| on_chord(course, &a.y, &b.y, |y, _| Some(test(&see(y))));
    let mut found = vec![];
    let mut add = |y: Option<DVector<f64>>, kind: EventKind| {
        // A change that cannot be located is put in the middle: it is not left out.
        let y = y.unwrap_or_else(|| 0.5 * (&a.y + &b.y));
        let mut seen = see(&y);
        // In the event the index is that of the point before it.
        seen.index_in_plane = a.seen.index_in_plane;
        seen.index_out_of_plane = a.seen.index_out_of_plane;
        found.push(ArcPoint { y, seen, happens: Some(kind) });
    };
    if a.seen.index_in_plane != b.seen.index_in_plane {
        let crossing = crossing_on_chord(course, &a.y, &b.y, |y, _| Some(see(y).plane_test));
        add(crossing, EventKind::BranchPoint);
    }
    let vertical = |p: &ArcPoint| course.plane(p.y[p.y.len() - 1]).span[0].abs() <= 0.0;
    let comparable = course.frames.always_vertical || !(vertical(a) || vertical(b));
    if comparable && a.seen.index_out_of_plane != b.seen.index_out_of_plane {
        let kind =
            EventKind::SpaceExchange { from: a.seen.index_in_space(), to: b.seen.index_in_space() };
        add(locate(&|seen| seen.space_test), kind);
    }
    // On one line the chain carries forces that are infinite or indeterminate: their signs say nothing.
    let straight = a.seen.bent.min(b.seen.bent) <= STRAIGHT;
    for bar in 0..a.seen.along.len() {
        if !straight && a.seen.along[bar] * b.seen.along[bar] < 0.0 {
            add(locate(&|seen| seen.along[bar]), EventKind::Unloaded { bar: bar + 1 });
        }
    }
    found
}

/// Largest residual of the equations at a point.
pub(crate) fn left(course: &Course<'_>, y: &DVector<f64>) -> f64 {
    residual(&course.plane(y[y.len() - 1]), y).amax()
}
