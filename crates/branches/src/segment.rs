//! All curves between two neighbouring census points.

use nalgebra::DVector;
use numerics::vector::{cross, norm};

use crate::arc::{Arcs, arcs};
use crate::census_point::CensusPoint;
use crate::curve::{Border, Curve, CurveEnd, Exit, Gate, follow};
use crate::path::Path;

/// Longest steps, in radians and parts of the path; each try with shorter ones follows curves that
/// lie closer together.
const LONGEST: [f64; 4] = [0.2, 0.05, 0.0125, 0.003];

/// A curve that ends this near to an equilibrium of the census ends there.
const NEAR: f64 = 1e-6;

/// So does one further off, if every other equilibrium is so many times further.
const APART: f64 = 20.0;
const NEAR_ENOUGH: f64 = 1e-3;

/// The curves of an interval.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    pub(crate) curves: Vec<Arcs>,
    /// Whether every equilibrium of both census points is on exactly one curve, none is lost, and
    /// all that happens on them is located.
    pub(crate) sure: bool,
}

impl Segment {
    /// The curves through all equilibria of two census points.
    pub(crate) fn new(path: &Path<'_>, low: &CensusPoint, high: &CensusPoint) -> Self {
        let path = path.within(low.position, high.position);
        let borders = [border(&path, low, high), border(&path, high, low)];
        let mut segment = Self { curves: vec![], sure: false };
        if borders[1].position - borders[0].position <= NOWHERE * (high.position - low.position) {
            // The chains end at the census point itself.
            return Self { sure: true, ..segment };
        }
        for longest in LONGEST {
            let (curves, sure) = attempt(&path, [low, high], borders, longest);
            segment.curves = curves.iter().map(|curve| arcs(&path, curve)).collect();
            segment.sure = sure && segment.curves.iter().all(|curve| curve.sure);
            if segment.sure {
                break;
            }
        }
        segment
    }
}

/// Halvings that find where a number leaves its range; and how far before that curves end, as part
/// of the interval: a bar without length has no equations.
const EDGE_HALVINGS: i32 = 30;

/// An interval that is left of one between census points, if it is shorter than this part, counts
/// as empty: what the halvings leave, twice.
const NOWHERE: f64 = 2e-9;

/// How far curves are followed towards a census point from another.
fn border(path: &Path<'_>, census_point: &CensusPoint, other: &CensusPoint) -> Border {
    if census_point.nodes.is_some() {
        return Border { position: census_point.position, gate: Gate::Open };
    }
    if path.is_chain(census_point.position) {
        return Border { position: census_point.position, gate: Gate::Closed };
    }
    let (mut inside, mut outside) = (other.position, census_point.position);
    for _ in 0..EDGE_HALVINGS {
        let middle = 0.5 * (inside + outside);
        *(if path.is_chain(middle) { &mut inside } else { &mut outside }) = middle;
    }
    Border { position: inside, gate: Gate::Edge }
}

fn attempt(
    path: &Path<'_>,
    census_points: [&CensusPoint; 2],
    borders: [Border; 2],
    longest: f64,
) -> (Vec<Curve>, bool) {
    let nodes = census_points.map(|census_point| census_point.nodes.as_deref().unwrap_or_default());
    let mut taken = [vec![false; nodes[0].len()], vec![false; nodes[1].len()]];
    let mut sure = true;
    let mut curves = vec![];
    for side in 0..2 {
        for start in 0..nodes[side].len() {
            if taken[side][start] {
                continue;
            }
            taken[side][start] = true;
            let from = &nodes[side][start].y;
            let (points, exit) = follow(path, from, side == 0, borders, longest);
            let end = points.last().map_or(from, |point| &point.y);
            let away = |side: usize| nodes[side].iter().map(|node| distance(&node.y, end));
            let mut arrive = |side: usize| match nearest(away(side)) {
                _ if borders[side].gate != Gate::Open => CurveEnd::Border,
                Some(node) if !taken[side][node] => {
                    taken[side][node] = true;
                    if side == 0 { CurveEnd::Low(node) } else { CurveEnd::High(node) }
                }
                _ => CurveEnd::Lost,
            };
            let end = match exit {
                Exit::Low => arrive(0),
                Exit::High => arrive(1),
                Exit::Lost => CurveEnd::Lost,
            };
            sure &= end != CurveEnd::Lost;
            let start = if side == 0 { CurveEnd::Low(start) } else { CurveEnd::High(start) };
            curves.push(Curve { points, ends: [start, end] });
        }
    }
    (curves, sure)
}

/// The equilibrium at which a curve ends, by its distance from each, if that is clear.
fn nearest(distances: impl Iterator<Item = f64>) -> Option<usize> {
    let mut best = (f64::INFINITY, None);
    let mut second = f64::INFINITY;
    for (k, distance) in distances.enumerate() {
        if distance < best.0 {
            second = best.0;
            best = (distance, Some(k));
        } else {
            second = second.min(distance);
        }
    }
    let clear = best.0 <= NEAR || (best.0 <= NEAR_ENOUGH && APART * best.0 <= second);
    best.1.filter(|_| clear)
}

/// Largest difference of angles and of the directions of the homogeneous pulls.
pub(crate) fn distance(a: &DVector<f64>, b: &DVector<f64>) -> f64 {
    let n = a.len() - 4;
    let angles = (0..n).map(|i| {
        let turn = (a[i] - b[i]).rem_euclid(std::f64::consts::TAU);
        turn.min(std::f64::consts::TAU - turn)
    });
    let [p, q] = [a, b].map(|y| [y[n], y[n + 1], y[n + 2]]);
    angles.fold(norm(cross(p, q)), f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Within a millionth the nearest, whatever else is there; within a thousandth where others are twenty times
    /// as far; else none.
    #[test]
    fn curves_end_where_it_is_clear() {
        for (distances, end) in [
            (vec![0.3, 9e-7, 0.9, 1e-6], Some(1)),
            (vec![2e-6, 9e-7], Some(1)),
            (vec![0.3, 2e-6, 5e-5], Some(1)),
            (vec![3e-5, 0.3, 2e-6], None),
            (vec![1e-3, 0.3], Some(0)),
            (vec![1.1e-3, 0.3], None),
            (vec![2e-4, 9e-4, 0.1], None),
            (vec![9e-4, 0.1, 2e-5], Some(2)),
            (vec![0.5], None),
            (vec![], None),
        ] {
            assert_eq!(nearest(distances.iter().copied()), end, "{distances:?}");
        }
    }

    /// Angles count modulo a turn, homogeneous pulls by the sine of the angle between them, either way round.
    #[test]
    fn distances_are_those_of_directions() {
        let at = |angles: [f64; 2], [h, v, w]: [f64; 3]| {
            DVector::from_column_slice(&[angles[0], angles[1], h, v, w, 0.7])
        };
        let here = at([0.1, 3.0], [0.6, 0.0, 0.8]);
        for (there, wanted) in [
            (at([0.35, 3.0], [0.6, 0.0, 0.8]), 0.25),
            (
                at([0.1 + std::f64::consts::TAU, 3.0 - std::f64::consts::TAU], [-0.6, 0.0, -0.8]),
                0.0,
            ),
            (at([0.1, -3.0], [0.6, 0.0, 0.8]), std::f64::consts::TAU - 6.0),
            (at([0.2, 3.0], [0.36, 0.48, 0.8]), 0.267_264_f64.sqrt()),
        ] {
            let found = [distance(&here, &there), distance(&there, &here)];
            assert!(found.iter().all(|d| (d - wanted).abs() < 1e-14), "{found:?} {wanted}");
        }
    }
}
