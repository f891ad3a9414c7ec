//! All curves between two neighbouring stations.

use nalgebra::DVector;

use super::course::Course;
use super::curve::{Border, CurvePoint, Exit, follow};
use super::station::{Node, Station};

/// Longest steps, in radians and parts of the path; each try with shorter ones follows curves that lie
/// closer together.
const LONGEST: [f64; 4] = [0.2, 0.05, 0.0125, 0.003];

/// A curve that ends this near to an equilibrium of the census ends there.
const NEAR: f64 = 1e-6;

/// So does one further off, if every other equilibrium is so many times further.
const APART: f64 = 20.0;
const NEAR_ENOUGH: f64 = 1e-3;

/// What is at the end of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tip {
    /// An equilibrium of the lower station.
    Low(usize),
    /// An equilibrium of the higher station.
    High(usize),
    /// A position at which there is no chain, or no complete census.
    Border,
    /// It could not be followed.
    Lost,
}

/// A curve of equilibria in an interval.
#[derive(Debug, Clone)]
pub(crate) struct Curve {
    pub(crate) points: Vec<CurvePoint>,
    pub(crate) tips: [Tip; 2],
}

/// The curves through all equilibria of two stations; whether every equilibrium is on exactly one, and
/// none is lost.
pub(crate) fn curves(course: &Course<'_>, low: &Station, high: &Station) -> (Vec<Curve>, bool) {
    let mut last = vec![];
    for longest in LONGEST {
        let (found, sure) = attempt(course, low, high, longest);
        if sure {
            return (found, true);
        }
        last = found;
    }
    (last, false)
}

fn attempt(course: &Course<'_>, low: &Station, high: &Station, longest: f64) -> (Vec<Curve>, bool) {
    let nodes = [low, high].map(|station| station.nodes.as_deref().unwrap_or_default());
    let borders = [low, high]
        .map(|station| Border { position: station.position, closed: station.nodes.is_none() });
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
            let (points, exit) = follow(course, from, side == 0, borders, longest);
            let end = points.last().map_or(from, |point| &point.y);
            let mut arrive = |side: usize| match nearest(nodes[side], end) {
                _ if borders[side].closed => Tip::Border,
                Some(node) if !taken[side][node] => {
                    taken[side][node] = true;
                    if side == 0 { Tip::Low(node) } else { Tip::High(node) }
                }
                _ => Tip::Lost,
            };
            let end = match exit {
                Exit::Low => arrive(0),
                Exit::High => arrive(1),
                Exit::Lost => Tip::Lost,
            };
            sure &= end != Tip::Lost;
            let start = if side == 0 { Tip::Low(start) } else { Tip::High(start) };
            curves.push(Curve { points, tips: [start, end] });
        }
    }
    (curves, sure)
}

/// The equilibrium at which a curve ends, if that is clear.
fn nearest(nodes: &[Node], y: &DVector<f64>) -> Option<usize> {
    let mut best = (f64::INFINITY, None);
    let mut second = f64::INFINITY;
    for (k, node) in nodes.iter().enumerate() {
        let distance = distance(&node.y, y);
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
    let [p, q] = [a, b].map(|y| y.fixed_rows::<3>(n).into_owned());
    angles.fold(p.cross(&q).norm(), f64::max)
}
