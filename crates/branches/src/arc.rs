//! Arcs: the parts of a curve along which the position rises, and what happens on them.

use nalgebra::DVector;

use crate::curve::{Curve, CurveEnd};
use crate::equations::{RESIDUAL, residual};
use crate::event::EventKind;
use crate::locate::{crossing_on_chord, on_chord};
use crate::observables::{Observables, STRAIGHT};
use crate::path::Path;

/// At a border with a chain more singular than this the indices are those of the points before it.
const SINGULAR: f64 = 1e-7;

/// A part of a curve, by rising position.
#[derive(Debug, Clone)]
pub(crate) struct Arc {
    pub(crate) points: Vec<ArcPoint>,
    pub(crate) ends: [CurveEnd; 2],
}

/// A point of an arc with what happens there.
#[derive(Debug, Clone)]
pub(crate) struct ArcPoint {
    pub(crate) y: DVector<f64>,
    pub(crate) seen: Observables,
    pub(crate) happens: Option<EventKind>,
}

/// What a curve is made of.
#[derive(Debug, Clone)]
pub(crate) struct Arcs {
    /// In their order along the curve.
    pub(crate) parts: Vec<Arc>,
    /// What its turns are.
    pub(crate) turns: Vec<EventKind>,
    /// Whether all that happens on it is located.
    pub(crate) sure: bool,
}

pub(crate) fn arcs(path: &Path<'_>, curve: &Curve) -> Arcs {
    let point = |y: &DVector<f64>| {
        let seen = Observables::at(&path.plane(y[y.len() - 1]), y);
        ArcPoint { y: y.clone(), seen, happens: None }
    };
    let points: Vec<ArcPoint> = curve.points.iter().map(|p| point(&p.y)).collect();
    let turns: Vec<usize> = (0..points.len()).filter(|k| curve.points[*k].turn.is_some()).collect();
    let kinds = curve.points.iter().filter_map(|point| point.turn).collect();
    let mut sure = turns.iter().all(|k| left(path, &points[*k].y) <= RESIDUAL);
    let mut bounds = vec![0];
    bounds.extend(&turns);
    bounds.push(points.len() - 1);
    let mut found = vec![];
    for (part, ends) in bounds.windows(2).enumerate() {
        let mut along: Vec<ArcPoint> = points[ends[0]..=ends[1]].to_vec();
        let first = if part == 0 { curve.ends[0] } else { CurveEnd::Turn(part - 1) };
        let last = if part == turns.len() { curve.ends[1] } else { CurveEnd::Turn(part) };
        borrow_indices(&mut along, [first, last]);
        let mut arc = Arc { points: happenings(path, along, &mut sure), ends: [first, last] };
        let (a, b) = (&arc.points[0].y, &arc.points[arc.points.len() - 1].y);
        if a[a.len() - 1] > b[b.len() - 1] {
            arc.points.reverse();
            arc.ends.reverse();
        }
        drop_roundings(&mut arc.points);
        found.push(arc);
    }
    Arcs { parts: found, turns: kinds, sure }
}

/// In a turn the index in the plane is that of the arc; where the chain is straight, in space too.
/// So it is at a border with a degenerate chain.
fn borrow_indices(along: &mut [ArcPoint], ends: [CurveEnd; 2]) {
    let count = along.len();
    for (k, neighbour, end) in
        [(0, 1, ends[0]), (count.wrapping_sub(1), count.wrapping_sub(2), ends[1])]
    {
        let Some(from) = along.get(neighbour) else { continue };
        let (inside, outside) = (from.seen.index_in_plane, from.seen.index_out_of_plane);
        let seen = &mut along[k].seen;
        let degenerate = end == CurveEnd::Border && seen.singular <= SINGULAR;
        if degenerate || matches!(end, CurveEnd::Turn(_)) {
            seen.index_in_plane = inside;
            if degenerate || seen.bent <= STRAIGHT {
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

/// The points of an arc with those in between at which an index or a sign changes, in their order; `sure` becomes
/// false if one cannot be located.
fn happenings(path: &Path<'_>, along: Vec<ArcPoint>, sure: &mut bool) -> Vec<ArcPoint> {
    let position = |point: &ArcPoint| point.y[point.y.len() - 1];
    let mut all: Vec<ArcPoint> = vec![];
    for point in along {
        if let Some(before) = all.last() {
            let rising = position(before) <= position(&point);
            let (mut located, located_all) = changes(path, before, &point);
            located.sort_by(|a, b| {
                let order = position(a).total_cmp(&position(b));
                if rising { order } else { order.reverse() }
            });
            *sure &= located_all;
            all.extend(located);
        }
        all.push(point);
    }
    all
}

/// Whether the indices out of the plane of two points mean the same: on one vertical the turn about
/// it is none of them.
fn comparable(path: &Path<'_>, a: &ArcPoint, b: &ArcPoint) -> bool {
    let vertical = |p: &ArcPoint| path.plane(p.y[p.y.len() - 1]).span[0].abs() <= 0.0;
    path.frames.always_vertical || !(vertical(a) || vertical(b))
}

/// What happens between two points, and whether all of it is located: not where an index changes by more than one,
/// which shorter steps tell apart.
fn changes(path: &Path<'_>, a: &ArcPoint, b: &ArcPoint) -> (Vec<ArcPoint>, bool) {
    let in_plane = a.seen.index_in_plane.abs_diff(b.seen.index_in_plane);
    let out_of_plane = a.seen.index_out_of_plane.abs_diff(b.seen.index_out_of_plane);
    let out_of_plane = if comparable(path, a, b) { out_of_plane } else { 0 };
    if in_plane.max(out_of_plane) > 1 {
        return (vec![], false);
    }
    let see = |y: &DVector<f64>| Observables::at(&path.plane(y[y.len() - 1]), y);
    let locate =
        |test: &dyn Fn(&Observables) -> f64| on_chord(path, &a.y, &b.y, |y, _| Some(test(&see(y))));
    let mut found = vec![];
    let mut sure = true;
    let mut add = |y: Option<DVector<f64>>, kind: EventKind| {
        // What cannot be located, or is no equilibrium, is no event: nothing is known of this
        // piece.
        let Some(y) = y.filter(|y| left(path, y) <= RESIDUAL) else {
            sure = false;
            return;
        };
        let mut seen = see(&y);
        // In the event the index is that of the point before it.
        seen.index_in_plane = a.seen.index_in_plane;
        seen.index_out_of_plane = a.seen.index_out_of_plane;
        found.push(ArcPoint { y, seen, happens: Some(kind) });
    };
    if in_plane > 0 {
        let crossing = crossing_on_chord(path, &a.y, &b.y, |y, _| Some(see(y).plane_test));
        add(crossing, EventKind::BranchPoint);
    }
    if out_of_plane > 0 {
        let kind =
            EventKind::SpaceExchange { from: a.seen.index_in_space(), to: b.seen.index_in_space() };
        add(locate(&|seen| seen.space_test), kind);
    }
    // On one line the chain carries forces that are infinite or indeterminate: their signs say
    // nothing.
    let straight = a.seen.bent.min(b.seen.bent) <= STRAIGHT;
    for bar in 0..a.seen.along.len() {
        if !straight && a.seen.along[bar] * b.seen.along[bar] < 0.0 {
            add(locate(&|seen| seen.along[bar]), EventKind::Unloaded { bar: bar + 1 });
        }
    }
    (found, sure)
}

/// Largest residual of the equations at a point.
pub(crate) fn left(path: &Path<'_>, y: &DVector<f64>) -> f64 {
    residual(&path.plane(y[y.len() - 1]), y).amax()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At a position, with nothing else that counts here.
    fn point(position: f64, happens: Option<EventKind>) -> ArcPoint {
        let seen = Observables {
            pull_n: [0.0; 2],
            energy_j: 0.0,
            axial_n: vec![],
            along: vec![],
            index_in_plane: 0,
            index_out_of_plane: 0,
            plane_test: 1.0,
            space_test: 1.0,
            singular: 1.0,
            bent: 1.0,
        };
        ArcPoint { y: DVector::from_element(1, position), seen, happens }
    }

    /// An end shows the indices of the arc beside it: in a turn that in the plane, where the chain is degenerate or
    /// straight also that in space, at a border only where it is degenerate.
    #[test]
    fn ends_without_indices_of_their_own_show_those_of_their_arc() {
        let (turn, border) = (CurveEnd::Turn(0), CurveEnd::Border);
        for (end, singular, bent, wanted) in [
            (turn, 1.0, 1.0, [3, 7]),
            (turn, 0.0, 1.0, [3, 7]),
            (turn, 1.0, 0.0, [3, 4]),
            (border, 1.0, 1.0, [5, 7]),
            (border, 1.0, 0.0, [5, 7]),
            (border, 0.0, 1.0, [3, 4]),
        ] {
            let indices = |[in_plane, out_of_plane]: [usize; 2], singular: f64, bent: f64| {
                let mut point = point(0.0, None);
                (point.seen.index_in_plane, point.seen.index_out_of_plane) =
                    (in_plane, out_of_plane);
                (point.seen.singular, point.seen.bent) = (singular, bent);
                point
            };
            let seen =
                |point: &ArcPoint| [point.seen.index_in_plane, point.seen.index_out_of_plane];
            let last = indices([5, 7], singular, bent);
            let mut along = vec![indices([1, 2], 1.0, 1.0), indices([3, 4], 1.0, 1.0), last];
            borrow_indices(&mut along, [border, end]);
            assert_eq!(seen(&along[2]), wanted, "{end:?} {singular} {bent}");
            along.reverse();
            along[0] = indices([5, 7], singular, bent);
            borrow_indices(&mut along, [end, border]);
            assert_eq!(seen(&along[0]), wanted, "{end:?} {singular} {bent}");
            assert_eq!((seen(&along[1]), seen(&along[2])), ([3, 4], [1, 2]));
        }
    }

    /// Beyond the ends of an arc nothing is left but what happens there.
    #[test]
    fn points_that_rounding_has_beyond_a_turn_go() {
        let event = || Some(EventKind::Straight);
        let mut points = vec![
            point(0.0, None),
            point(-1e-15, None),
            point(-1e-16, event()),
            point(0.0, None),
            point(0.5, None),
            point(1.0 + 1e-15, None),
            point(1.0, None),
        ];
        drop_roundings(&mut points);
        let places: Vec<(f64, bool)> =
            points.iter().map(|point| (point.y[0], point.happens.is_some())).collect();
        let wanted = [(0.0, false), (-1e-16, true), (0.0, false), (0.5, false), (1.0, false)];
        assert_eq!(places, wanted);
        let mut none = vec![];
        drop_roundings(&mut none);
        assert!(none.is_empty());
    }
}
