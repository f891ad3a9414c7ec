//! The method of generalised minimal residuals (Y. Saad, M. Schultz, SIAM J. Sci. Stat. Comput. 7
//! (1986) 856-869).

use crate::modes::lanczos::{dot, length};

/// Directions after which the solution found so far is returned.
const MOST_DIRECTIONS: usize = 40;

/// Residual, relative to the right-hand side, at which the solution is returned.
const ENOUGH: f64 = 1e-9;

/// Solve `A z = b` with `A` given by its products.
///
/// As many directions are needed as `A` has clusters of eigenvalues. The solution of least residual
/// is returned whether that is small or not: the caller judges it.
pub(crate) fn solve(product: &mut dyn FnMut(&[f64]) -> Vec<f64>, b: &[f64]) -> Vec<f64> {
    let size = length(b);
    let mut solution = vec![0.0; b.len()];
    if size <= 0.0 || !size.is_finite() {
        return solution;
    }
    let mut directions = vec![b.iter().map(|b| b / size).collect::<Vec<f64>>()];
    // Columns of the triangle that the rotations make of the Hessenberg matrix.
    let mut columns: Vec<Vec<f64>> = Vec::new();
    let mut rotations: Vec<(f64, f64)> = Vec::new();
    let mut right = vec![size];
    while columns.len() < MOST_DIRECTIONS.min(b.len()) {
        let k = columns.len();
        let mut next = product(&directions[k]);
        let mut column: Vec<f64> = Vec::with_capacity(k + 2);
        for direction in &directions {
            let along = dot(&next, direction);
            next.iter_mut().zip(direction).for_each(|(x, d)| *x -= along * d);
            column.push(along);
        }
        let rest = length(&next);
        for (i, &(c, s)) in rotations.iter().enumerate() {
            (column[i], column[i + 1]) =
                (c * column[i] + s * column[i + 1], c * column[i + 1] - s * column[i]);
        }
        let radius = column[k].hypot(rest);
        if radius <= 0.0 || !radius.is_finite() {
            break;
        }
        let (c, s) = (column[k] / radius, rest / radius);
        column[k] = radius;
        columns.push(column);
        rotations.push((c, s));
        right.push(-s * right[k]);
        right[k] *= c;
        if right[k + 1].abs() <= ENOUGH * size || rest <= 0.0 {
            break;
        }
        directions.push(next.iter().map(|x| x / rest).collect());
    }
    for k in (0..columns.len()).rev() {
        let known: f64 = (k + 1..columns.len()).map(|j| columns[j][k] * right[j]).sum();
        right[k] = (right[k] - known) / columns[k][k];
        solution.iter_mut().zip(&directions[k]).for_each(|(x, d)| *x += right[k] * d);
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_clusters_of_eigenvalues_need_two_directions() {
        // The identity but for two directions with the eigenvalue −30.
        let mut asked = 0;
        let u = [0.6, 0.0, 0.8, 0.0];
        let mut product = |z: &[f64]| {
            asked += 1;
            let along = dot(z, &u);
            let mut out: Vec<f64> = z.iter().zip(&u).map(|(z, u)| z - 31.0 * along * u).collect();
            out[3] *= -30.0;
            out
        };
        let exact = [1.0, -2.0, 0.5, 0.25];
        let b = product(&exact);
        let found = solve(&mut product, &b);
        for (found, exact) in found.iter().zip(&exact) {
            assert!((found - exact).abs() < 1e-12, "{found} {exact}");
        }
        assert_eq!(asked, 3);
    }

    #[test]
    fn a_rotation_is_solved_by_all_directions() {
        let mut product = |z: &[f64]| vec![z[1], -z[0], 2.0 * z[2]];
        let found = solve(&mut product, &[1.0, 2.0, 3.0]);
        for (found, exact) in found.iter().zip(&[-2.0, 1.0, 1.5]) {
            assert!((found - exact).abs() < 1e-14);
        }
        assert!(solve(&mut product, &[0.0; 3]).iter().all(|z| z.abs() < f64::MIN_POSITIVE));
    }
}
