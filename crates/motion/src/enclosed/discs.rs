//! Eigenvalues of a symmetric matrix that is nearly diagonal, by Gershgorin's theorem.
//!
//! The eigenvalues of `D A D⁻¹` with `D = diag(1, .., 1/t, .., 1)` are those of `A`: the disc of
//! the row of `1/t` shrinks by `t`, the others grow by what they have in that column. The largest
//! `t` at which the disc stays apart from all others gives an isolated eigenvalue with an error of
//! the second order in what is beside the diagonal.

use nalgebra::DMatrix;
use numerics::Interval;

/// Largest scale of a row: some digits beyond the rounding of a double are none.
const LARGEST_SCALE: f64 = (1_u64 << 40) as f64;

/// Part of a gap between diagonal elements that the growing discs may take.
const PART_OF_GAP: f64 = 0.25;

/// Of the k-th smallest eigenvalue the k-th enclosure.
pub(super) fn eigenvalues(matrix: &DMatrix<Interval>) -> Vec<Interval> {
    let count = matrix.nrows();
    let radius: Vec<f64> = (0..count).map(|i| radius(matrix, i)).collect();
    let disc =
        |i: usize, by: f64| Interval::around(matrix[(i, i)].mid(), by_at_least(matrix, i, by));
    let mut order: Vec<usize> = (0..count).collect();
    let discs: Vec<Interval> = (0..count).map(|i| disc(i, radius[i])).collect();
    order.sort_by(|&i, &j| discs[i].lo().total_cmp(&discs[j].lo()));
    let mut found = vec![Interval::LINE; count];
    // A connected component of discs holds as many eigenvalues as discs.
    let mut first = 0;
    while first < count {
        let mut all = discs[order[first]];
        let mut end = first + 1;
        while end < count && discs[order[end]].lo() <= all.hi() {
            all = all.hull(discs[order[end]]);
            end += 1;
        }
        found[first..end].fill(all);
        first = end;
    }
    for i in 0..count {
        if let Some((below, isolated)) = isolated(matrix, &radius, i) {
            found[below] = found[below].intersect(isolated).unwrap_or(found[below]);
        }
    }
    found
}

/// Radius of a disc about the middle of the diagonal element.
fn by_at_least(matrix: &DMatrix<Interval>, i: usize, radius: f64) -> f64 {
    (Interval::point(radius) + Interval::point(matrix[(i, i)].rad())).hi()
}

/// Sum of the absolute values beside the diagonal, rounded upward.
fn radius(matrix: &DMatrix<Interval>, i: usize) -> f64 {
    let beside = (0..matrix.ncols()).filter(|&j| j != i);
    beside.map(|j| Interval::point(matrix[(i, j)].mag())).sum::<Interval>().hi()
}

/// The scaled disc of a row, if it is apart from all others, and how many of these lie below.
fn isolated(matrix: &DMatrix<Interval>, radius: &[f64], i: usize) -> Option<(usize, Interval)> {
    let middle = |j: usize| matrix[(j, j)].mid();
    let others = || (0..radius.len()).filter(move |&j| j != i);
    let scale = others()
        .map(|j| PART_OF_GAP * (middle(j) - middle(i)).abs() / matrix[(i, j)].mag())
        .fold(LARGEST_SCALE, f64::min);
    if scale.is_nan() || scale <= 1.0 {
        return None;
    }
    let t = Interval::point(scale);
    let own =
        Interval::around(middle(i), by_at_least(matrix, i, (Interval::point(radius[i]) / t).hi()));
    let mut below = 0;
    for j in others() {
        // The column of the row gains t; what it had is counted once more, which is on the safe
        // side.
        let grown = Interval::point(radius[j]) + t * Interval::point(matrix[(j, i)].mag());
        let disc = Interval::around(middle(j), by_at_least(matrix, j, grown.hi()));
        if !disc.disjoint(own) {
            return None;
        }
        below += usize::from(disc.hi() < own.lo());
    }
    Some((below, own))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_entry_beside_the_diagonal_counts_by_its_square() {
        // [[1, e], [e, 3]]: 2 -+ √(1 + e²) = 1 - e²/2, 3 + e²/2 to fourth order.
        let e = 1e-6;
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, e, e, 3.0].map(Interval::point));
        let [low, high] = eigenvalues(&matrix)[..] else { panic!("two") };
        assert!(low.contains(1.0 - 0.5 * e * e) && low.width() < 1e-11, "{low:?}");
        assert!(high.contains(3.0 + 0.5 * e * e) && high.width() < 1e-11, "{high:?}");
    }

    #[test]
    fn discs_are_those_of_rows() {
        let entries = [1.0, 4.0, -0.5, 0.25, 3.0, 2.0, 8.0, 16.0, 7.0].map(Interval::point);
        let matrix = DMatrix::from_row_slice(3, 3, &entries);
        for (i, wanted) in [4.5, 2.25, 24.0].into_iter().enumerate() {
            let above = radius(&matrix, i) - wanted;
            assert!((0.0..1e-14).contains(&above), "{i}: {above}");
        }
    }

    #[test]
    fn equal_ones_share_their_component() {
        let e = 1e-9;
        let entries = [2.0, e, 0.0, e, 2.0, 0.0, 0.0, 0.0, -1.0].map(Interval::point);
        let found = eigenvalues(&DMatrix::from_row_slice(3, 3, &entries));
        assert!(found[0].contains(-1.0) && found[0].width() < 1e-15, "{found:?}");
        assert!(found[1].contains(2.0 - e) && found[2].contains(2.0 + e), "{found:?}");
        assert!(found[1].width() < 4.0 * e, "{found:?}");
    }
}
