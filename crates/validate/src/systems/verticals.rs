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

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// Against the definition, point by point, on both sides of both axes and at any distance.
    #[test]
    fn the_first_near_point_is_found_wherever_its_cell_is() {
        let mut random = ChaCha8Rng::seed_from_u64(15);
        for near_m in [1e-9, 0.02, 0.1, 0.5, 3.0] {
            let points: Vec<[f64; 2]> = (0..400)
                .map(|_| [random.random_range(-2.0..2.0), random.random_range(-2.0..2.0)])
                .collect();
            let mut expected: Vec<usize> = Vec::new();
            for (k, [x, y]) in points.iter().enumerate() {
                let near = |&other: &usize| {
                    let [a, b]: [f64; 2] = points[other];
                    expected[other] == other && (x - a).hypot(y - b) <= near_m
                };
                let first = (0..k).find(near).unwrap_or(k);
                expected.push(first);
            }
            assert_eq!(firsts(points.into_iter(), near_m), expected, "{near_m}");
        }
        // Equal points are on one vertical whatever counts as near, of many as of few: each is held
        // against those of the cells around it alone.
        let lattice = |k: usize| [1e-3 * (k % 300) as f64, 1e-3 * (k / 300) as f64];
        let count = 300 * 300;
        let twice = (0..2 * count).map(|k| lattice(k % count));
        assert!(firsts(twice, 1e-6).into_iter().eq((0..count).chain(0..count)));
        assert_eq!(firsts([[0.3, -0.7], [0.3, -0.7], [0.3, 0.7]].into_iter(), 0.0), [0, 0, 2]);
    }
}
