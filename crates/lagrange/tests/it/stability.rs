//! Stability, nullity and balance of equilibria of random chains, judged by means that the crate
//! does not use: eigenvalues of the bordered matrix, and cross products in the world frame.

use lagrange::{Settings, Solution, jacobian, solve_from};
use model::{InSpace, Problem};

use crate::common::{problem, spatial_seed, stream};
use crate::judge::judge;

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
        assert!(judge(&problem, &found.equilibrium).within(1e-12));
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
