//! Stability, nullity and balance of equilibria of random chains, judged by means that the crate
//! does not use: eigenvalues of the bordered matrix, and cross products in the world frame.

use lagrange::{Settings, Solution, jacobian, solve, solve_from};
use model::{InSpace, Problem};
use nalgebra::{DMatrix, DVector, Vector3};

use crate::common::{problem, spatial_seed, stream};

/// Eigenvalues of the bordered matrix below this are zero; the smallest others met are above 1e-7.
const ZERO: f64 = 1e-9;

/// Equilibria of random chains of 2 to 6 bars from random seeds, stable and unstable, anchors on
/// one vertical and not.
fn equilibria() -> impl Iterator<Item = (Problem, Solution)> {
    (2..=6_usize).flat_map(|bars| (0..20).map(move |index| (bars, index))).map(|(bars, index)| {
        let mut random = stream(41, 100 * bars + index);
        let problem = problem(&mut random, bars, index % 4 == 0);
        let seed = spatial_seed(&mut random, bars);
        let found = solve_from(&problem, &seed, &Settings::default()).unwrap();
        (problem, found)
    })
}

/// The Hessian of the Lagrangian bordered by the constraints has as many negative eigenvalues as
/// there are constraints, plus the index; as many zero ones as the nullity.
#[test]
fn index_and_nullity_are_those_of_the_bordered_matrix() {
    let mut unstable = 0;
    for (problem, found) in equilibria() {
        let chain = problem.chain();
        // In the equations the sign of the rows of (40) is such that they are −∂/∂q of the
        // Lagrangian's constraint part: [K −Bᵀ; B 0] becomes symmetric by the sign of its last
        // rows.
        let mut bordered = jacobian(chain, &found.q, &(&found.lambda / 9.81));
        let (size, rows) = (found.q.len(), found.lambda.len());
        let flipped = -bordered.rows(size, rows).into_owned();
        bordered.rows_mut(size, rows).copy_from(&flipped);
        assert!((&bordered - bordered.transpose()).amax() < 1e-12);
        let eigenvalues = bordered.symmetric_eigenvalues();
        let negative = eigenvalues.iter().filter(|value| **value < -ZERO).count();
        let zero = eigenvalues.iter().filter(|value| value.abs() <= ZERO).count();
        let stability = found.equilibrium.stability;
        assert_eq!(negative, rows + stability.index_in_space, "{}", chain.bars().len());
        assert_eq!(zero, found.nullity);
        let vertical = chain.anchors().end_m[0].hypot(chain.anchors().end_m[1]) < 1e-9;
        assert_eq!(found.nullity, chain.bars().len() + usize::from(vertical));
        unstable += usize::from(stability.in_space == InSpace::Unstable);
    }
    // Both kinds occur, or nothing was tested.
    assert!((20..80).contains(&unstable), "{unstable} of 100 unstable");
}

/// In the plane: the energy as a function of the angles of the bars, differentiated numerically on
/// the motions that keep both ends.
#[test]
fn index_in_the_plane_is_that_of_a_numerical_hessian() {
    for (problem, found) in equilibria() {
        let chain = problem.chain();
        let joints = &found.equilibrium.joints_m;
        let bars = chain.bars();
        // Horizontal unit vector of the plane: along the largest horizontal extent.
        let far = joints.iter().fold([0.0_f64; 3], |far, joint| {
            if joint[0].hypot(joint[1]) > far[0].hypot(far[1]) { *joint } else { far }
        });
        let level = far[0].hypot(far[1]);
        let angles = DVector::from_iterator(
            bars.len(),
            joints.windows(2).map(|pair| {
                let d: [f64; 3] = std::array::from_fn(|k| pair[1][k] - pair[0][k]);
                ((d[0] * far[0] + d[1] * far[1]) / level).atan2(-d[2])
            }),
        );
        // Energy and last joint, in units of the total weight and length, from the angles.
        let (mass, length) = (chain.total_mass_kg(), chain.total_length_m());
        let state = |angles: &DVector<f64>| {
            let (mut x, mut z, mut energy) = (0.0, 0.0, 0.0);
            for (bar, angle) in bars.iter().zip(angles.iter()) {
                energy += bar.mass_kg() / mass * (z - bar.centre_m() * angle.cos());
                x += bar.length_m() * angle.sin();
                z -= bar.length_m() * angle.cos();
            }
            (energy / length, x / length, z / length)
        };
        let end = found.equilibrium.reactions_n.end;
        let weight = mass * chain.gravity_m_s2();
        let across = (end[0] * far[0] + end[1] * far[1]) / level / weight;
        let lagrangian = |angles: &DVector<f64>| {
            let (energy, x, z) = state(angles);
            energy - across * x - end[2] / weight * z
        };
        let step = 1e-3;
        let shifted = |shifts: &[(usize, f64)]| {
            let mut at = angles.clone();
            for (index, shift) in shifts {
                at[*index] += shift * step;
            }
            at
        };
        let n = bars.len();
        let hessian = DMatrix::from_fn(n, n, |i, j| {
            let corner = |a: f64, b: f64| lagrangian(&shifted(&[(i, a), (j, b)]));
            (corner(1.0, 1.0) - corner(1.0, -1.0) - corner(-1.0, 1.0) + corner(-1.0, -1.0))
                / (4.0 * step * step)
        });
        let closure = DMatrix::from_fn(2, n, |row, i| {
            let at = |shift: f64| {
                let (_, x, z) = state(&shifted(&[(i, shift)]));
                if row == 0 { x } else { z }
            };
            (at(1.0) - at(-1.0)) / (2.0 * step)
        });
        // Motions that keep the end: eigenvectors of closureᵀ·closure to its n − 2 zero
        // eigenvalues.
        let normal = (closure.transpose() * &closure).symmetric_eigen();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|a, b| normal.eigenvalues[*a].total_cmp(&normal.eigenvalues[*b]));
        let kept: Vec<_> =
            order[..n - 2].iter().map(|k| normal.eigenvectors.column(*k).into_owned()).collect();
        let index = if kept.is_empty() {
            0
        } else {
            let motions = DMatrix::from_columns(&kept);
            let projected = motions.transpose() * hessian * motions;
            projected.symmetric_eigenvalues().iter().filter(|value| **value < 0.0).count()
        };
        assert_eq!(index, found.equilibrium.stability.index_in_plane);
    }
}

/// Newton's laws for each bar, from the observables alone.
#[test]
fn every_bar_is_in_balance() {
    for (problem, found) in equilibria() {
        let chain = problem.chain();
        let weight = chain.total_mass_kg() * chain.gravity_m_s2();
        let equilibrium = &found.equilibrium;
        let joints: Vec<Vector3<f64>> =
            equilibrium.joints_m.iter().map(|joint| Vector3::from(*joint)).collect();
        let on_last: Vec<Vector3<f64>> =
            equilibrium.multipliers_n.iter().map(|force| Vector3::from(*force)).collect();
        let largest = on_last.iter().map(Vector3::norm).fold(weight, f64::max);
        for (index, bar) in chain.bars().iter().enumerate() {
            let first = if index == 0 { on_last[0] } else { -on_last[index] };
            let last = on_last[index + 1];
            let load = Vector3::new(0.0, 0.0, -bar.mass_kg() * chain.gravity_m_s2());
            assert!((first + last + load).norm() < 1e-14 * largest);
            let u = (joints[index + 1] - joints[index]) / bar.length_m();
            assert!((u.norm() - 1.0).abs() < 1e-14 * chain.total_length_m() / bar.length_m());
            let moment = u.cross(&load) * bar.centre_m() + u.cross(&last) * bar.length_m();
            assert!(moment.norm() < 1e-12 * largest * bar.length_m(), "{moment}");
        }
        let gap = joints[chain.bars().len()] - Vector3::from(chain.anchors().end_m);
        assert!(gap.norm() < 1e-13 * chain.total_length_m());
    }
}

#[test]
fn the_solve_without_a_guess_finds_no_more_than_any_seed() {
    for (problem, found) in equilibria() {
        let lowest = solve(&problem, &Settings::default()).unwrap().equilibrium;
        let unit = problem.chain().total_mass_kg() * 9.81 * problem.chain().total_length_m();
        assert_eq!(lowest.stability.in_space, InSpace::Stable);
        assert!(lowest.energy_j <= found.equilibrium.energy_j + 1e-13 * unit);
        if found.equilibrium.stability.in_space == InSpace::Stable {
            assert!((lowest.energy_j - found.equilibrium.energy_j).abs() < 1e-13 * unit);
        }
    }
}

/// Three equal bars between level anchors just before the fold at d² = 3/2, in closed form: with
/// the outer bars at σ ± δ from the horizontal and q = cos² δ, two equilibria have 8 q² − 4 q + d²
/// − 1 = 0 and cos σ = (d² − 1 + 4 q)/(4 d √q). They are 1e-5 apart and both regular: the one has
/// an index in the plane that is one more than that of the other.
#[test]
fn equilibria_near_a_fold_are_not_degenerate() {
    /// √(3 − 2 d²): how far the roots are apart.
    const APART: f64 = 1e-5;
    let span = (0.5 * (3.0 - APART * APART)).sqrt();
    let problem = samples::homogeneous(9.81, &[(1.0, 1.0); 3], [0.0, span, 0.0]);
    for side in [1.0, -1.0] {
        let mut indices = [1.0, -1.0].map(|root: f64| {
            let q = 0.25 * (1.0 + root * APART);
            let sigma = ((span * span - 1.0 + 4.0 * q) / (4.0 * span * q.sqrt())).acos();
            let delta = side * q.sqrt().acos();
            let outer = [sigma + delta, sigma - delta].map(|angle| [angle.cos(), angle.sin()]);
            let middle = [span - outer[0][0] - outer[1][0], -outer[0][1] - outer[1][1]];
            let angles = [outer[0], middle, outer[1]].map(|[along, up]| along.atan2(-up));
            let seed = lagrange::Seed::planar(&angles);
            let found = solve_from(&problem, &seed, &Settings::default()).unwrap().equilibrium;
            // The closed form, and not the equilibrium beside it.
            for (k, angle) in angles.iter().enumerate() {
                let (a, b) = (found.joints_m[k], found.joints_m[k + 1]);
                let off = (b[1] - a[1]).atan2(a[2] - b[2]) - angle;
                let off = off.sin().abs();
                assert!(off < 0.1 * APART, "bar {k} is off by {off:e}");
            }
            assert_ne!(found.stability.in_plane, model::InPlane::Degenerate, "root {root}");
            assert_eq!(found.evidence.nullity, 3, "root {root}");
            found.stability.index_in_plane
        });
        indices.sort_unstable();
        assert_eq!(indices[1], indices[0] + 1, "{indices:?}");
    }
}
