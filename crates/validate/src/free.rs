//! Joints that an equilibrium leaves free, proved.
//!
//! Where neighbouring joints carry no load, the bars before, between and behind them carry one
//! force. If it is zero, each of the two parts of the chain that are left hangs (or stands) plumb
//! from its own anchor, for every bar of it carries the weight of what is beyond it. So the places
//! of their ends are known from the lengths alone, and the bars between them are at rest in any
//! position in which they bridge the gap: their joints are free if the gap is wider than the
//! lengths need folded, and narrower than they reach. Bars that just bridge their gap, or fall
//! short of it, carry force, however little, and their joints are held.

use std::ops::{Range, RangeInclusive};

use model::{Bar, Chain, Vector};
use numerics::DoubleDouble;
use numerics::vector::{minus, norm};

use crate::lever::carried_kg;
use crate::systems::STORED_ULPS;

/// How far from plumb the joints at the ends of the bars without force may be, in units of the
/// total length: the budget for joints.
const PLUMB: f64 = 1e-10;

/// Roundings of a sum of lengths, in units of the last place of the total.
const ROUNDINGS: f64 = 16.0;

/// Rounding of the joints' coordinates, m: they are stored in the world frame, however far from its
/// origin the anchors are.
pub(crate) fn stored_rounding_m(chain: &Chain) -> f64 {
    let anchors = chain.anchors();
    let coordinates = anchors.start_m.iter().chain(&anchors.end_m);
    let farthest = coordinates.fold(chain.total_length_m(), |most, x| most.max(x.abs()));
    STORED_ULPS * f64::EPSILON * farthest
}

/// The bars without force (from 0), and the joints between them, if a position of the chain is one
/// of a family of equilibria in which these joints are free.
pub(crate) fn free_joints(
    chain: &Chain,
    joints_m: &[Vector],
) -> Option<(Range<usize>, RangeInclusive<usize>)> {
    if joints_m.len() != chain.bars().len() + 1 {
        return None;
    }
    let enough_m = PLUMB * chain.total_length_m() + stored_rounding_m(chain);
    // In one pass before anything is summed for one run: a long chain may have many.
    let near =
        unloaded_runs(chain).into_iter().filter(|run| stands_below(chain, joints_m, run, enough_m));
    let bars_of = near.into_iter().find(|run| {
        hangs_plumb(chain, joints_m, run, enough_m) && has_room(chain, joints_m, run)
    })?;
    let free = bars_of.start + 1..=bars_of.end - 1;
    Some((bars_of, free))
}

/// Maximal runs of two or more bars with no load at the joints between them.
fn unloaded_runs(chain: &Chain) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (k, load_kg) in (1..).zip(carried_kg(chain)) {
        // Exactly none: the least load holds a joint where it hangs.
        if load_kg > 0.0 {
            continue;
        }
        match runs.last_mut() {
            Some(run) if run.end == k => run.end = k + 1,
            _ => runs.push(k - 1..k + 1),
        }
    }
    runs
}

/// Whether both ends of these bars are on the verticals through their anchors, as they are if all
/// other bars are plumb.
fn stands_below(chain: &Chain, joints_m: &[Vector], run: &Range<usize>, enough_m: f64) -> bool {
    let off = |joint: Vector, anchor: Vector| (joint[0] - anchor[0]).hypot(joint[1] - anchor[1]);
    let anchors = chain.anchors();
    off(joints_m[run.start], anchors.start_m) <= enough_m
        && off(joints_m[run.end], anchors.end_m) <= enough_m
}

/// Whether both ends of these bars are straight above or below their anchors.
fn hangs_plumb(chain: &Chain, joints_m: &[Vector], run: &Range<usize>, enough_m: f64) -> bool {
    let [start, end] = plumb(chain, joints_m, run);
    norm(minus(joints_m[run.start], start)) <= enough_m
        && norm(minus(joints_m[run.end], end)) <= enough_m
}

/// Where the ends of the bars of a run are with all other bars plumb, each up or down as it is.
fn plumb(chain: &Chain, joints_m: &[Vector], run: &Range<usize>) -> [Vector; 2] {
    let bars = chain.bars();
    let anchors = chain.anchors();
    let rise = |k: usize| {
        let length_m = bars[k].length_m();
        if joints_m[k + 1][2] < joints_m[k][2] { -length_m } else { length_m }
    };
    let [mut start, mut end] = [anchors.start_m, anchors.end_m];
    start[2] += model::sum((0..run.start).map(rise));
    end[2] -= model::sum((run.end..bars.len()).map(rise));
    [start, end]
}

/// Whether the bars of a run can bridge the gap between the plumb parts, neither straight nor
/// folded on one line. Parts that end at one point do so to rounding.
fn has_room(chain: &Chain, joints_m: &[Vector], run: &Range<usize>) -> bool {
    let lengths = || chain.bars()[run.clone()].iter().map(Bar::length_m);
    let reach_m = model::sum(lengths());
    let longest_m = lengths().fold(0.0, f64::max);
    let [start, end] = plumb(chain, joints_m, run);
    let gap_m = norm(minus(start, end));
    let rounding_m = ROUNDINGS * f64::EPSILON * chain.total_length_m() + stored_rounding_m(chain);
    // How much longer one bar is than the others: with a gap of that the run lies folded on one
    // line.
    let folded_m = 2.0 * longest_m - reach_m;
    if gap_m <= rounding_m {
        // Closed on one point, about which it turns.
        return folded_m <= rounding_m;
    }
    let [gap, reach, folded] = squares(chain, joints_m, run);
    (reach - gap).interval().lo() > 0.0
        && (folded_m < -rounding_m || (gap - folded).interval().lo() > 0.0)
}

/// Squares of the gap, of the reach of a run, and of what its longest bar is longer than the
/// others: of the numbers as they are given, since a difference of one rounding is room.
fn squares(chain: &Chain, joints_m: &[Vector], run: &Range<usize>) -> [DoubleDouble; 3] {
    let point = DoubleDouble::point;
    let anchors = chain.anchors();
    let mut gap: [_; 3] =
        std::array::from_fn(|k| point(anchors.end_m[k]) - point(anchors.start_m[k]));
    let (mut reach, mut longest_m) = (DoubleDouble::ZERO, 0.0_f64);
    for (k, length_m) in chain.bars().iter().map(Bar::length_m).enumerate() {
        let length = point(length_m);
        if run.contains(&k) {
            reach = reach + length;
            longest_m = longest_m.max(length_m);
        } else if joints_m[k + 1][2] < joints_m[k][2] {
            gap[2] = gap[2] + length;
        } else {
            gap[2] = gap[2] - length;
        }
    }
    let folded = point(longest_m) + point(longest_m) - reach;
    let [x, y, z] = gap.map(DoubleDouble::square);
    [x + y + z, reach.square(), folded.square()]
}

#[cfg(test)]
mod tests;
