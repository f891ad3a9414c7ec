//! Points on one vertical.

use std::collections::HashMap;

/// For each point `[x, y]` the number of the first one that is within `near_m` of it, if it is not
/// the first itself.
pub(super) fn firsts(points: impl Iterator<Item = [f64; 2]>, near_m: f64) -> Vec<usize> {
    let side_m = 2.0 * near_m.max(f64::MIN_POSITIVE);
    let mut cells: HashMap<[i64; 2], Vec<(usize, [f64; 2])>> = HashMap::new();
    let mut firsts = Vec::new();
    for (k, [x, y]) in points.enumerate() {
        // A cast of what is too large saturates: such points share a cell.
        #[expect(clippy::cast_possible_truncation, reason = "saturates, as said above")]
        let [column, row] = [x, y].map(|at| (at / side_m).floor() as i64);
        let around = [-1, 0, 1].into_iter().flat_map(|c| [-1, 0, 1].map(|r| [c, r]));
        let first = around
            .filter_map(|[c, r]| cells.get(&[column.saturating_add(c), row.saturating_add(r)]))
            .flatten()
            .filter(|(_, [other_x, other_y])| (x - other_x).hypot(y - other_y) <= near_m)
            .map(|(other, _)| *other)
            .min();
        if first.is_none() {
            cells.entry([column, row]).or_default().push((k, [x, y]));
        }
        firsts.push(first.unwrap_or(k));
    }
    firsts
}
