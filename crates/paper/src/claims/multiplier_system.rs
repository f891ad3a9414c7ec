//! Does (40) have a solution at a given position? Twelve multipliers, eighteen equations.

use lagrange::{Seed, constraint_matrix, load_vector};
use matrices::dense::{apply, least_squares};
use model::Problem;
use nalgebra::DVector;

use crate::example::PaperUnits;

/// How far the best multipliers are from solving (40).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Euclidean norm of what is left, rows of forces in mg and rows of moments in mgl.
    pub norm: f64,
    /// Its largest component.
    pub largest: f64,
}

/// Pivots below this part of the largest are zero: rounding is 1e-16, the smallest other 0.1.
const RANK: f64 = 1e-12;

/// The misfit of (40) at the paper's planar position `phi` (psi = 0, theta = pi/2), rad, for the
/// best multipliers in the sense of least squares.
///
/// Only the angles matter: no row of (40) contains the coordinates of a centre of weight.
///
/// # References
///
/// Paper, eqs. (40), (41) with the entry of the second bar.
pub fn misfit(problem: &Problem, units: PaperUnits, phi: &[f64; 3]) -> Misfit {
    let chain = problem.chain();
    let q = coordinates(&Seed::planar(phi));
    let mut matrix = constraint_matrix(chain, &q).transpose();
    let mut right = -load_vector(chain) / units.mg_n;
    for row in (0..matrix.nrows()).filter(|row| row % 6 >= 3) {
        matrix.row_mut(row).scale_mut(1.0 / units.l_m);
        right[row] /= units.l_m;
    }
    let Some(lambda) = least_squares(&matrix, &right, RANK) else {
        return Misfit { norm: f64::NAN, largest: f64::NAN };
    };
    let left = apply(&matrix, &lambda) - right;
    Misfit { norm: left.norm(), largest: left.amax() }
}

/// The coordinates of eq. (21) with the given angles and the centres anywhere.
fn coordinates(seed: &Seed) -> DVector<f64> {
    let bars = seed.angles().iter();
    DVector::from_vec(
        bars.flat_map(|[psi, theta, phi]| [0.0, 0.0, 0.0, *psi, *theta, *phi]).collect(),
    )
}
