//! In which directions each joint can move.

use model::system::Support;
use numerics::Interval;

use super::arithmetic::{NOWHERE, Vector, cross, plus, points, times, upon};
use super::frame::Frame;

/// A joint's place `o + Σ t_k A_k`, with as many coordinates `t_k` as the support leaves.
#[derive(Debug, Clone)]
pub(super) struct Coordinates {
    /// Number of the first of its unknowns.
    pub(super) first: usize,
    pub(super) origin: Vector,
    /// The directions; what holds the joint is exactly normal to them.
    pub(super) axes: Vec<Vector>,
}

impl Coordinates {
    /// Of a joint whose unknowns begin with this number.
    pub(super) fn new(support: &Support, frame: &Frame, first: usize) -> Self {
        let unit = |k: usize| upon(k, Interval::ONE);
        match support {
            Support::Free => Self { first, origin: NOWHERE, axes: (0..3).map(unit).collect() },
            Support::Fixed { at_m } => Self { first, origin: frame.place(*at_m), axes: vec![] },
            Support::Line { at_m, direction } => {
                Self { first, origin: frame.place(*at_m), axes: vec![points(*direction)] }
            }
            Support::Plane { at_m, normal } => {
                let least = (0..3).min_by(|a, b| normal[*a].abs().total_cmp(&normal[*b].abs()));
                let normal = points(*normal);
                // Products with 0 and 1 alone: the first axis is normal to the normal without
                // rounding.
                let across = cross(normal, unit(least.unwrap_or(0)));
                let axes = vec![across, cross(normal, across)];
                Self { first, origin: frame.place(*at_m), axes }
            }
        }
    }

    /// A joint that is kept where it is.
    pub(super) fn held(place: Vector, first: usize) -> Self {
        Self { first, origin: place, axes: vec![] }
    }

    pub(super) fn place(&self, unknowns: &[Interval]) -> Vector {
        plus(self.origin, self.step(unknowns))
    }

    /// A step along the directions.
    pub(super) fn step(&self, by: &[Interval]) -> Vector {
        let steps = self.axes.iter().zip(&by[self.first..]);
        steps.fold(NOWHERE, |all, (axis, t)| plus(all, times(*t, *axis)))
    }

    /// The coordinates next to a place.
    pub(super) fn of(&self, place: Vector) -> impl Iterator<Item = f64> {
        // The axes are normal to each other; those of a plane are shorter than one.
        self.axes.iter().map(move |axis| {
            let along = (0..3).map(|k| axis[k].mid() * (place[k].mid() - self.origin[k].mid()));
            along.sum::<f64>() / (0..3).map(|k| axis[k].mid() * axis[k].mid()).sum::<f64>()
        })
    }
}
