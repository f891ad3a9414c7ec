//! What could not be decided, listed with its cell.

use std::collections::BTreeMap;

use numerics::Interval;
use serde::Serialize;

use crate::branch_and_bound::hull;
use crate::run::closure::Pattern;
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;
use crate::run::search::Task;

/// A set of pulls for which the census does not say whether and how many equilibria it holds,
/// besides those that are listed.
///
/// ```
/// use census::{Census, Reason, Settings};
/// use model::{Anchors, Bar, Chain, Problem};
/// // 1 + 1 + 1 - 1 = 2, and these anchors are 2 m apart but for rounding: whether the chain can lie
/// // straight, where the force along it is then any, hangs on the last digits.
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.2, 0.0, 1.6] };
/// let chain = Chain::new("straight", 9.81, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 4])?;
/// let census = Census::take(&Problem::new(chain)?, &Settings::default())?;
/// assert!(!census.complete);
/// assert!(census.undecided.iter().all(|open| open.reason == Reason::Degenerate));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Undecided {
    /// Why.
    pub reason: Reason,
    /// The patterns of tension (+1), compression (−1) and slack (0) in question.
    pub signs: Vec<Vec<i8>>,
    /// The chart of its cell.
    pub chart: Face,
    /// Its cell in the coordinates of the chart.
    pub at: [Interval; 2],
    /// The pulls along the horizontal direction and along Z, N, where they are finite.
    pub pull_n: Option<[Interval; 2]>,
}

/// Why a cell is undecided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, thiserror::Error)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Reason {
    /// The cell is as small as cells get, or rounding errors hide what is in it: a degenerate
    /// equilibrium, a straight position, or nearly so.
    #[error("as small as cells get: a degenerate equilibrium, a straight position, or nearly so")]
    Degenerate,
    /// The force of a bar vanishes in the cell, and the bar, pointing anywhere, may just bridge the
    /// gap that the others leave.
    #[error(
        "the force of a bar vanishes here, and the bar may just bridge the gap that the others leave"
    )]
    Unloaded,
    /// The budget of tests was spent.
    #[error("the budget of tests was spent")]
    Budget,
    /// Two enclosures overlap that cannot be proved to hold the same equilibrium.
    #[error("two enclosures overlap that may or may not hold the same equilibrium")]
    Unclear,
    /// Exactly one equilibrium lies there, but its index or its finite pull is not proved.
    #[error("one equilibrium lies here, but its index or its finite pull is not proved")]
    Index,
    /// Bars that carry nothing may or may not bridge the gap that the others leave.
    #[error("bars without force may or may not bridge the gap that the others leave")]
    Slack,
}

/// More cells than this are first gathered on a grid: merging them takes the square of their
/// number.
const DIRECT: usize = 2_048;

/// Squares of that grid along the edge of a face, whose length is 2.
const GRID: f64 = 32.0;

/// Touching cells become one; the order is that of faces and coordinates.
pub(crate) fn gather(mut tasks: Vec<Task>) -> Vec<Task> {
    if tasks.len() > DIRECT {
        let mut squares: BTreeMap<(Face, [i64; 2]), Task> = BTreeMap::new();
        for task in tasks {
            #[expect(clippy::cast_possible_truncation, reason = "coordinates lie in [-2, 2]")]
            let square = task.cell.middle().map(|x| (x * GRID / 2.0).floor() as i64);
            let known = squares.entry((task.cell.face, square));
            known.and_modify(|all| unite(all, &task)).or_insert(task);
        }
        tasks = squares.into_values().collect();
    }
    let mut gathered: Vec<Task> = vec![];
    for mut task in tasks {
        // What the growing cell touches joins it, until nothing does.
        while let Some(k) = gathered.iter().position(|other| touch(other, &task)) {
            unite(&mut task, &gathered.swap_remove(k));
        }
        gathered.push(task);
    }
    gathered.sort_by(|a, b| {
        let key = |task: &Task| (task.cell.face, task.cell.middle());
        let ((face, [x, y]), (other, [p, q])) = (key(a), key(b));
        face.cmp(&other).then(x.total_cmp(&p)).then(y.total_cmp(&q))
    });
    gathered
}

fn touch(a: &Task, b: &Task) -> bool {
    a.cell.face == b.cell.face && !a.cell.disjoint(&b.cell)
}

fn unite(all: &mut Task, more: &Task) {
    all.cell.at = hull(all.cell.at, more.cell.at);
    all.patterns.extend(&more.patterns);
    all.patterns.sort_unstable();
    all.patterns.dedup();
}

impl Undecided {
    pub(crate) fn new(system: &System, reason: Reason, cell: &Cell, patterns: &[Pattern]) -> Self {
        let signs = patterns.iter().map(|pattern| pattern.signs(system.bars()).collect()).collect();
        let finite = cell.homogeneous()[2].lo() > 0.0;
        let pull_n = finite.then(|| system.pull_on_anchor_n(cell.pull(system)));
        Self { reason, signs, chart: cell.face, at: cell.at, pull_n }
    }

    /// A slack family that may or may not exist.
    pub(crate) fn slack(system: &System, signs: Vec<i8>) -> Self {
        let slack = signs.iter().position(|sign| *sign == 0).unwrap_or(0);
        let group = system.groups.iter().position(|group| group.contains(&slack)).unwrap_or(0);
        let face = Face::Around(u8::try_from(group).unwrap_or(u8::MAX));
        let cell = Cell { face, at: [Interval::ZERO; 2] };
        let pull_n = Some(system.pull_on_anchor_n(cell.pull(system)));
        Self { reason: Reason::Slack, signs: vec![signs], chart: face, at: cell.at, pull_n }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn task(face: Face, at: [f64; 2], pattern: u32) -> Task {
        let at = at.map(|x| Interval::new(x, x + f64::from_bits((1023 - 8) << 52)));
        Task { cell: Cell { face, at }, patterns: vec![Pattern(pattern)] }
    }

    /// Squares with a corner in common are one, those apart or on another face are not.
    #[test]
    fn what_touches_becomes_one() {
        let width = f64::from_bits((1023 - 8) << 52);
        let tasks = vec![
            task(Face::Right, [0.0, 0.0], 1),
            task(Face::Near, [0.0, 0.0], 3),
            task(Face::Near, [0.0, 2.5 * width], 5),
            task(Face::Near, [width, width], 2),
            task(Face::Near, [2.5 * width, 0.0], 4),
        ];
        let found = gather(tasks);
        let patterns: Vec<Vec<u32>> =
            found.iter().map(|task| task.patterns.iter().map(|p| p.0).collect()).collect();
        assert_eq!(patterns, [vec![5], vec![2, 3], vec![4], vec![1]]);
        let whole = Interval::new(0.0, 2.0 * width);
        assert_eq!(found[1].cell, Cell { face: Face::Near, at: [whole; 2] });
    }

    /// As many as are merged one by one stay apart where they do not touch; one more, and those of
    /// each of 32 by 32 squares are one.
    #[test]
    fn too_many_to_compare_are_gathered_on_a_grid() {
        let side = 64;
        let all: Vec<Task> = (0..side * side)
            .map(|k| {
                let [i, j] = [k % side, k / side].map(|n| f64::from(n) / 32.0 - 1.0);
                task(Face::Near, [i, j], 1)
            })
            .collect();
        assert_eq!(gather(all[..DIRECT].to_vec()).len(), DIRECT);
        // 33 rows of 64 are cut into 32 by 17 squares.
        let rows = gather(all[..33 * 64].to_vec());
        assert_eq!(rows.len(), 32 * 17);
        assert_eq!(gather(all).len(), 32 * 32);
    }
}
