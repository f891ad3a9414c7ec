//! Joints and forces as vectors of the world.

use std::ops::Range;

use model::{Reactions, Vector};

use super::bar_data::resize;
use super::chain::Condensed;
use super::parallel::split;
use super::pull::Pull;
use super::reconstruction::reconstruct;

impl Condensed {
    /// All joints and forces that belong to a pull of this chain, as vectors in the world frame.
    pub(super) fn vectors(&self, pull: &Pull, to: &mut Vectors) -> Totals {
        let n = self.bars();
        let (length, force) = (self.units.length, self.units.force());
        let ([x0, y0, z0], [ex, ey]) = (self.start_m, pull.level);
        let h = pull.force[0] * force;
        let (hx, hy) = (h * ex, h * ey);
        let Vectors { joints_m, multipliers_n, axial_n } = to;
        resize(joints_m, n + 1);
        resize(multipliers_n, n + 1);
        resize(axial_n, n);
        let output = ([&mut joints_m[1..], &mut multipliers_n[1..]], [&mut axial_n[..]]);
        let split = |(vectors, numbers), ranges: &[Range<usize>]| {
            split(vectors, ranges).into_iter().zip(split(numbers, ranges)).collect()
        };
        let ends = reconstruct(self, pull, output, split, |output, segment| {
            let ([joints_m, multipliers_n], [axial_n]) = output;
            let bars = segment.first..segment.first + segment.axial.len();
            let positions = segment.along.iter().zip(segment.height);
            for (joint, (s, z)) in joints_m[bars.clone()].iter_mut().zip(positions) {
                let s = s * length;
                *joint = [x0 + ex * s, y0 + ey * s, z0 + z * length];
            }
            for (lambda, v) in multipliers_n[bars.clone()].iter_mut().zip(segment.vertical) {
                *lambda = [hx, hy, v * force];
            }
            scale(&mut axial_n[bars], segment.axial, force);
        });
        joints_m[0] = self.start_m;
        multipliers_n[0] = pull.ground_n();
        Totals {
            reactions_n: Reactions { start: pull.ground_n(), end: multipliers_n[n] },
            energy_j: ends.energy * length * force,
            closure: self.closure_of(pull, ends.last),
        }
    }

    /// Distance of the last joint from its anchor, relative to the total length.
    fn closure_of(&self, pull: &Pull, [along, height]: [f64; 2]) -> f64 {
        // The plane of a pull that was given need not be that of the anchors.
        let [ex, ey] = self.span.level.map(|e| e * self.span.across);
        let [x, y] = pull.level.map(|e| e * along);
        let off = (x - ex).hypot(y - ey).hypot(height - self.span.rise);
        off / self.bars.total_length
    }
}

/// Memory for the answer.
#[derive(Debug, Clone, Default)]
pub(super) struct Vectors {
    pub joints_m: Vec<Vector>,
    pub multipliers_n: Vec<Vector>,
    pub axial_n: Vec<f64>,
}

/// What belongs to all bars together.
pub(super) struct Totals {
    pub reactions_n: Reactions,
    pub energy_j: f64,
    /// Distance of the last joint from its anchor, relative to the total length.
    pub closure: f64,
}

fn scale(to: &mut [f64], from: &[f64], by: f64) {
    for (to, from) in to.iter_mut().zip(from) {
        *to = from * by;
    }
}
