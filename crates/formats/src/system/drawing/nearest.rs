//! The nearest of many places.

use model::Vector;
use numerics::vector::{minus, norm};

/// Places by one of their coordinates.
pub(super) struct Sorted<'a> {
    axis: usize,
    order: Vec<usize>,
    at_m: &'a [Vector],
}

impl<'a> Sorted<'a> {
    /// Along the axis on which they reach furthest.
    pub(super) fn of(at_m: &'a [Vector]) -> Self {
        let reach = |k: usize| {
            let along = || at_m.iter().map(|at_m| at_m[k]);
            along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
        };
        let axis = (0..3).max_by(|a, b| reach(*a).total_cmp(&reach(*b))).unwrap_or_default();
        let mut order: Vec<usize> = (0..at_m.len()).collect();
        order.sort_by(|a, b| at_m[*a][axis].total_cmp(&at_m[*b][axis]));
        Self { axis, order, at_m }
    }

    /// The distance of the nearest, m, and its number.
    pub(super) fn nearest(&self, to_m: Vector) -> Option<(f64, usize)> {
        let along = |k: &usize| self.at_m[*k][self.axis] - to_m[self.axis];
        let (before, after) = self.order.split_at(self.order.partition_point(|k| along(k) < 0.0));
        let mut best: Option<(f64, usize)> = None;
        let mut look = |k: &usize| {
            let far = |within_m: f64| best.is_some_and(|(best_m, _)| within_m >= best_m);
            if far(along(k).abs()) {
                return false;
            }
            let distance_m = norm(minus(self.at_m[*k], to_m));
            if !far(distance_m) {
                best = Some((distance_m, *k));
            }
            true
        };
        let _ = before.iter().rev().all(&mut look);
        let _ = after.iter().all(&mut look);
        best
    }
}
