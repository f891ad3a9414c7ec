//! The paper's own equation of motion, sections V and VI, corrected: a checked reference away from
//! gimbal lock.
//!
//! Six coordinates for each bar, `q_i = (X_C, Y_C, Z_C, ψ, θ, φ)`, and three constraints for each
//! joint, anchors included:
//!
//! $$ \begin{bmatrix} M & -B^T \\\\ B & 0 \end{bmatrix}
//!    \begin{bmatrix} \ddot q \\\\ \lambda \end{bmatrix} =
//!    \begin{bmatrix} F + \tilde F \\\\ -\dot B \dot q \end{bmatrix} . \qquad (33) $$
//!
//! Corrected are (5), of which two entries are misprinted; (18)-(20), where bar 3 ends, not bar 2;
//! the sign of the first component of (24); two entries of (31); the matrix and the right-hand side
//! of (33), where `B` and the dot of `B` are missing; and (39), where the second bracket has
//! `[Q]ᵀ` without a dot:
//!
//! $$ \tilde F_\beta = -\mathbf{Q}^T \left( \mathbf{J}_C \dot{\mathbf{Q}}
//!    + \tilde\omega \mathbf{J}_C \mathbf{Q} \right) \dot\beta . $$
//!
//! | paper | code | shape | unit | equation |
//! |---|---|---|---|---|
//! | `[A_i]` | [`rotation`] | 3 × 3 | - | (1)-(5) |
//! | `[Q_i]` | [`rates`] | 3 × 3 | - | (23) |
//! | `[Q̇_i]` | [`rates_derivative`] | 3 × 3 | 1/s | (39) |
//! | `{ω_i}` | `[Q_i] (ψ̇, θ̇, φ̇)`, in the axes of the bar | 3 | rad/s | (24) |
//! | `[Q]ᵀ[J][Q]` | [`angular_inertia`] | 3 × 3 | kg m² | (31) |
//! | `{F̃_β}` | [`velocity_terms`] | 3 | N m | (39) |
//! | `f_i`, `[B]`, `−[Ḃ]{q̇}` | [`Constraints`] | 3(n+1) rows | m | (7)-(22), (33) |
//! | `{q̈}`, `{λ}` | [`accelerations`] | 6n, 3(n+1) | | (33) |
//!
//! At `θ = π/2`, where the paper puts its own equilibrium, the columns of `ψ` and `φ` in `[Q]` are
//! parallel: `det [Q]ᵀ[J][Q] = J_x J_y J_z cos² θ`. The matrix of (33) is singular there, and near
//! it the angles turn the faster the nearer they are, whatever the bar does. A slender bar (`J_x =
//! 0`) has a singular matrix everywhere. [`Simulation`](crate::Simulation) has neither.

mod constraints;
mod rotation;

use model::Chain;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

pub use constraints::Constraints;
pub use rotation::{rates, rates_derivative, rotation};

/// Places of the centres and angles of a bar, or their derivatives by time.
pub type Coordinates = [f64; 6];

/// The part `(ψ, θ, φ)` of coordinates.
#[must_use]
pub fn angles(q: &Coordinates) -> Vector3<f64> {
    Vector3::new(q[3], q[4], q[5])
}

/// `[J_C]` (26), kg m².
fn moments(inertia_kg_m2: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::from(inertia_kg_m2))
}

/// `[Q]ᵀ [J_C] [Q]` (31), kg m²: inertia of the angles.
///
/// ```
/// use nalgebra::Vector3;
/// let at = Vector3::new(0.3, 0.7, -0.2);
/// let m = motion::paper::angular_inertia([1.0, 2.0, 3.0], &at);
/// // The determinant is J_x J_y J_z cos² θ.
/// assert!((m.determinant() - 6.0 * 0.7_f64.cos().powi(2)).abs() < 1e-14);
/// ```
#[must_use]
pub fn angular_inertia(inertia_kg_m2: [f64; 3], angles: &Vector3<f64>) -> Matrix3<f64> {
    let q = rates(angles);
    q.transpose() * moments(inertia_kg_m2) * q
}

/// `{F̃_β}` (39), N m: what the angles' velocities add to the right-hand side.
#[must_use]
pub fn velocity_terms(
    inertia_kg_m2: [f64; 3],
    angles: &Vector3<f64>,
    velocities: &Vector3<f64>,
) -> Vector3<f64> {
    let q = rates(angles);
    let j = moments(inertia_kg_m2);
    let omega = q * velocities;
    let dot = rates_derivative(angles, velocities);
    -(q.transpose() * (j * dot * velocities + omega.cross(&(j * omega))))
}

/// Accelerations and multipliers at a state.
#[derive(Debug, Clone, PartialEq)]
pub struct Accelerations {
    /// `{q̈}`, six for each bar.
    pub q: Vec<Coordinates>,
    /// `{λ}` in the paper's meaning and order, three for each joint, N.
    pub lambda_n: Vec<[f64; 3]>,
}

/// The matrix of (33).
#[must_use]
pub fn matrix(chain: &Chain, q: &[Coordinates]) -> DMatrix<f64> {
    let b = Constraints::new(chain).matrix(q);
    let (rows, size) = b.shape();
    let mut matrix = DMatrix::zeros(size + rows, size + rows);
    for (i, (bar, q)) in chain.bars().iter().zip(q).enumerate() {
        for k in 0..3 {
            matrix[(6 * i + k, 6 * i + k)] = bar.mass_kg();
        }
        let angular = angular_inertia(bar.inertia_kg_m2(), &angles(q));
        matrix.view_mut((6 * i + 3, 6 * i + 3), (3, 3)).copy_from(&angular);
    }
    matrix.view_mut((0, size), (size, rows)).copy_from(&(-b.transpose()));
    matrix.view_mut((size, 0), (rows, size)).copy_from(&b);
    matrix
}

/// Solve (33) at a state; nothing where its matrix is singular.
#[must_use]
pub fn accelerations(
    chain: &Chain,
    q: &[Coordinates],
    velocities: &[Coordinates],
) -> Option<Accelerations> {
    let matrix = matrix(chain, q);
    let bars = chain.bars();
    let mut right = DVector::zeros(matrix.nrows());
    for (i, bar) in bars.iter().enumerate() {
        right[6 * i + 2] = -bar.mass_kg() * chain.gravity_m_s2();
        let terms = velocity_terms(bar.inertia_kg_m2(), &angles(&q[i]), &angles(&velocities[i]));
        for k in 0..3 {
            right[6 * i + 3 + k] = terms[k];
        }
    }
    let gamma = Constraints::new(chain).gamma(q, velocities);
    right.rows_mut(6 * bars.len(), gamma.len()).copy_from(&gamma);
    let solved = matrix.lu().solve(&right)?;
    let q = (0..bars.len()).map(|i| std::array::from_fn(|k| solved[6 * i + k])).collect();
    let lambda = |k: usize| std::array::from_fn(|axis| solved[6 * bars.len() + 3 * k + axis]);
    Some(Accelerations { q, lambda_n: (0..=bars.len()).map(lambda).collect() })
}
