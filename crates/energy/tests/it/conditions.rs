//! The condition of the second derivative, against eigenvalues of dense matrices.

use energy::{Seed, Settings, minimise, second_order};
use nalgebra::DMatrix;
use samples::General;

use crate::support::rng;

/// The smallest eigenvalue of `diag(force)` on the kernel of rows that are orthonormalised first.
fn smallest(force: &[f64], mut rows: Vec<Vec<f64>>) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    for k in 0..rows.len() {
        let (before, rest) = rows.split_at_mut(k);
        for other in before {
            let part = dot(&rest[0], other);
            for (x, y) in rest[0].iter_mut().zip(other) {
                *x -= part * *y;
            }
        }
        let size = dot(&rest[0], &rest[0]).sqrt();
        for x in &mut rest[0] {
            *x /= size;
        }
    }
    let n = force.len();
    let most = force.iter().fold(0.0_f64, |most, force| most.max(force.abs()));
    let away = |i: usize, k: usize| {
        f64::from(u8::from(i == k)) - rows.iter().map(|row| row[i] * row[k]).sum::<f64>()
    };
    // P diag(N) P, with the kernel of P moved far up.
    let matrix = DMatrix::from_fn(n, n, |i, k| {
        let inside: f64 = (0..n).map(|j| away(i, j) * force[j] * away(j, k)).sum();
        inside + 10.0 * most * rows.iter().map(|row| row[i] * row[k]).sum::<f64>()
    });
    matrix.symmetric_eigenvalues().min()
}

/// In the metric `sum l_i |du_i|²` the second derivative is the axial force of each bar, for the
/// turns in the plane and those out of it; the closure has two rows there and one here. The
/// smallest eigenvalue is enclosed within ten per cent either way.
#[test]
fn the_condition_is_the_ratio_of_the_largest_force_to_the_smallest_eigenvalue() {
    let mut most = 0.0_f64;
    for stream in 0..60 {
        let bars = 4 + usize::try_from(stream).unwrap() % 12;
        let problem = General::default().problem(&mut rng(400 + stream), bars);
        let solution = minimise(&problem, &Settings::default()).unwrap();
        let directions = Seed::directions(&problem, &solution.directions).unwrap();
        let found = second_order(&problem, &directions).unwrap();
        assert!(found.residual < 1e-9 && found.gap < 1e-13, "{stream}");
        let root: Vec<f64> = problem.chain().bars().iter().map(|b| b.length_m().sqrt()).collect();
        let level = |u: &model::Vector| u[0].hypot(u[1]);
        let end = problem.chain().anchors().difference_m();
        let along = |u: &model::Vector| (u[0] * end[0] + u[1] * end[1]).signum() * level(u);
        let row = |part: &dyn Fn(usize) -> f64| (0..bars).map(|i| root[i] * part(i)).collect();
        let u = &solution.directions;
        let in_plane = vec![row(&|i| -u[i][2]), row(&|i| along(&u[i]))];
        let force = &solution.equilibrium.axial_n;
        let least = smallest(force, in_plane).min(smallest(force, vec![row(&|_| 1.0)]));
        let largest = force.iter().fold(0.0_f64, |most, n| most.max(n.abs()));
        let ratio = found.condition / (largest / least);
        assert!((0.9..1.11).contains(&ratio), "{stream}: {ratio}");
        most = most.max(found.condition);
    }
    assert!(most > 20.0, "{most}");
}
