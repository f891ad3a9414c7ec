//! The full system: eq. (40) and the constraint functions, 6n + 3(n+1) equations in as many
//! unknowns.
#![expect(non_snake_case, reason = "B is the paper's matrix of constraints, eq. (22)")]

use model::Chain;
use nalgebra::{DMatrix, DVector, RealField, Vector3, convert};

use crate::full::constraints::{
    PER_BAR, bar_coordinates, constraint_forces_of, constraint_functions_of, constraint_matrix_of,
    entries,
};
use crate::full::load::load_vector_of;
use crate::full::mechanism::{Mechanism, Units};
use crate::full::rotation::direction_hessian;
use crate::larger::larger;

/// Residual of the full system at `q` (6n) and `lambda` (3(n+1)):
///
/// $$ \begin{bmatrix} -\mathbf{B}^T\\{\lambda\\} - \mathbf{T} \\\\ \\{f\\} \end{bmatrix}. $$
///
/// For three bars these are the 30 equations of section VII. Rows of the centres are in N, rows of
/// the angles in N m, rows of the constraints in m.
///
/// Paper, eq. (40) with (7)-(20).
///
/// # Panics
///
/// When `q` has not 6n entries or `lambda` not 3(n+1).
///
/// ```
/// let problem = model::cases::paper();
/// let found = lagrange::solve(&problem, &Default::default())?;
/// let residual = lagrange::residual(problem.chain(), &found.q, &found.lambda);
/// assert!(residual.len() == 30 && residual.amax() < 1e-13);
/// # Ok::<(), lagrange::Error>(())
/// ```
pub fn residual<T: RealField + Copy>(
    chain: &Chain,
    q: &DVector<T>,
    lambda: &DVector<T>,
) -> DVector<T> {
    residual_of(&Mechanism::si(chain), q, lambda)
}

pub(crate) fn residual_of<T: RealField + Copy>(
    mechanism: &Mechanism,
    q: &DVector<T>,
    lambda: &DVector<T>,
) -> DVector<T> {
    let (rows, multipliers) = (mechanism.coordinates(), mechanism.constraints());
    assert_eq!(lambda.len(), multipliers, "three multipliers at each joint");
    // In the paper's letters -Bᵀλ - T, and below f.
    let forces = constraint_forces_of(mechanism, q, lambda);
    let load = load_vector_of(mechanism).map(convert::<f64, T>);
    let mut residual = DVector::zeros(rows + multipliers);
    residual.rows_mut(0, rows).copy_from(&(-forces - load));
    residual.rows_mut(rows, multipliers).copy_from(&constraint_functions_of(mechanism, q));
    residual
}

/// Jacobian of [`residual`] by `q` and then `lambda`, square of size 6n + 3(n+1), analytic:
///
/// $$ \begin{bmatrix} -\sum_i \lambda_i\\, \partial^2 f_i/\partial q^2 & -\mathbf{B}^T \\\\
///    \mathbf{B} & 0 \end{bmatrix}. $$
///
/// It is singular at every equilibrium, because a bar can spin about its own axis without any
/// effect ("three of them being useless", section III); see [`spectrum`](crate::spectrum()).
///
/// # Panics
///
/// When `q` has not 6n entries or `lambda` not 3(n+1).
///
/// ```
/// let problem = model::cases::paper();
/// let (q, lambda) = (nalgebra::DVector::zeros(18), nalgebra::DVector::zeros(12));
/// let jacobian = lagrange::jacobian(problem.chain(), &q, &lambda);
/// // [K, -B^T; B, 0]
/// assert_eq!(jacobian.shape(), (30, 30));
/// assert_eq!(jacobian[(18, 0)], -jacobian[(0, 18)]);
/// ```
pub fn jacobian(chain: &Chain, q: &DVector<f64>, lambda: &DVector<f64>) -> DMatrix<f64> {
    jacobian_of(&Mechanism::si(chain), q, lambda)
}

pub(crate) fn jacobian_of(
    mechanism: &Mechanism,
    q: &DVector<f64>,
    lambda: &DVector<f64>,
) -> DMatrix<f64> {
    let (rows, multipliers) = (mechanism.coordinates(), mechanism.constraints());
    assert_eq!(lambda.len(), multipliers, "three multipliers at each joint");
    let B = constraint_matrix_of(mechanism, q);
    let mut jacobian = DMatrix::zeros(rows + multipliers, rows + multipliers);
    for bar in 0..mechanism.bars() {
        let (_, [psi, theta, phi]) = bar_coordinates(q, bar);
        // Only the direction of the bar is curved: the multipliers of its two joints act on it
        // through their lever arms.
        let force: Vector3<f64> = entries(mechanism, bar)
            .iter()
            .map(|entry| lambda.fixed_rows::<3>(3 * entry.joint) * entry.of_direction)
            .sum();
        let curvature = direction_hessian(psi, theta, phi, &force);
        let at = PER_BAR * bar + 3;
        jacobian.fixed_view_mut::<3, 3>(at, at).copy_from(&-curvature);
    }
    jacobian.view_mut((0, rows), (rows, multipliers)).copy_from(&-B.transpose());
    jacobian.view_mut((rows, 0), (multipliers, rows)).copy_from(&B);
    jacobian
}

/// Largest entry of [`residual`] when force rows are measured in *mg*, moment rows in *mgl* and
/// constraint rows in *l* (mean weight and mean length of the bars); NaN when any entry is NaN.
///
/// # Panics
///
/// When `q` has not 6n entries or `lambda` not 3(n+1).
///
/// ```
/// let problem = model::cases::paper();
/// // Everything at the first anchor, without force: the weights stand alone, the end is 2 l off.
/// let (q, lambda) = (nalgebra::DVector::zeros(18), nalgebra::DVector::zeros(12));
/// let at_rest = lagrange::relative_residual(problem.chain(), &q, &lambda);
/// assert!(at_rest >= 1.0 && at_rest < 3.0);
/// ```
pub fn relative_residual(chain: &Chain, q: &DVector<f64>, lambda: &DVector<f64>) -> f64 {
    let units = Units::mean(chain);
    let residual = residual(chain, q, lambda);
    let coordinates = q.len();
    residual.iter().enumerate().fold(0.0, |largest: f64, (row, value)| {
        let unit = if row >= coordinates {
            units.length
        } else if row % PER_BAR < 3 {
            units.weight
        } else {
            units.weight * units.length
        };
        larger(largest, (value / unit).abs())
    })
}
