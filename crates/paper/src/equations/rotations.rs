//! Section III, rotations: eqs. (1)-(5).

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use super::sample::{LargestEntry, angles, largest, rotation, worst};
use super::{EquationAudit, ROUNDING, says};

const ENTRY: &str = "largest difference of an entry, 1000 random states";

/// Eq. (2).
pub(super) fn psi_matrix(psi: f64) -> Matrix3<f64> {
    let (s, c) = psi.sin_cos();
    Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

/// Eq. (3).
pub(super) fn theta_matrix(theta: f64) -> Matrix3<f64> {
    let (s, c) = theta.sin_cos();
    Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
}

/// Eq. (4).
pub(super) fn phi_matrix(phi: f64) -> Matrix3<f64> {
    let (s, c) = phi.sin_cos();
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// Eq. (1).
fn product([psi, theta, phi]: [f64; 3]) -> Matrix3<f64> {
    psi_matrix(psi) * theta_matrix(theta) * phi_matrix(phi)
}

/// Eq. (5) as printed.
fn printed([psi, theta, phi]: [f64; 3]) -> Matrix3<f64> {
    let ((s_psi, c_psi), (s_th, c_th), (s_phi, c_phi)) =
        (psi.sin_cos(), theta.sin_cos(), phi.sin_cos());
    Matrix3::new(
        c_th * c_phi,
        -c_th * s_phi,
        s_th,
        s_psi * s_th * c_phi + c_psi * s_phi,
        -s_psi * s_th * s_phi + c_psi * c_phi,
        -s_psi * c_th,
        -c_psi * s_th * c_phi + s_psi * s_th,
        c_psi * s_th * s_phi + s_psi * c_phi,
        c_psi * c_phi,
    )
}

/// Difference of an elementary rotation from nalgebra's.
fn elementary(matrix: fn(f64) -> Matrix3<f64>, axis: Unit<Vector3<f64>>) -> f64 {
    worst(|rng| {
        let [angle, ..] = angles(rng);
        (matrix(angle) - Rotation3::from_axis_angle(&axis, angle).into_inner()).largest_entry()
    })
}

/// Difference of an entry of (5), row and column from 0, from the product (1).
fn entry_error(row: usize, column: usize, entry: impl Fn([f64; 3]) -> f64) -> f64 {
    worst(|rng| {
        let q = angles(rng);
        entry(q) - product(q)[(row, column)]
    })
}

pub(super) fn rows() -> Vec<EquationAudit> {
    let of_product = worst(|rng| {
        let q = angles(rng);
        let others = [rotation(q), lagrange::rotation(q[0], q[1], q[2])];
        largest(others.map(|other| (product(q) - other).largest_entry()))
    });
    let others = worst(|rng| {
        let q = angles(rng);
        let difference = printed(q) - product(q);
        let wrong = [(2, 0), (2, 2)];
        largest(
            (0..3)
                .flat_map(|i| (0..3).map(move |j| (i, j)))
                .filter(|at| !wrong.contains(at))
                .map(|at| difference[at]),
        )
    });
    vec![
        says("(1)", "III", "the rotation is the product of three").measured(
            "largest difference of an entry from two other codes, 1000 random states",
            of_product,
            ROUNDING,
        ),
        says("(2)", "III", "rotation by psi about x").measured(
            ENTRY,
            elementary(psi_matrix, Vector3::x_axis()),
            ROUNDING,
        ),
        says("(3)", "III", "rotation by theta about y").measured(
            ENTRY,
            elementary(theta_matrix, Vector3::y_axis()),
            ROUNDING,
        ),
        says("(4)", "III", "rotation by phi about z").measured(
            ENTRY,
            elementary(phi_matrix, Vector3::z_axis()),
            ROUNDING,
        ),
        says("(5)", "III", "the entries of (1) other than (3,1) and (3,3)").measured(
            "largest difference from the product (1), 1000 random states",
            others,
            ROUNDING,
        ),
        says("(5)", "III", "entry (3,1): s(theta) where s(phi) belongs")
            .measured(
                "largest difference from the product (1), 1000 random states",
                entry_error(2, 0, |q| printed(q)[(2, 0)]),
                ROUNDING,
            )
            .corrected(
                "-c(psi) s(theta) c(phi) + s(psi) s(phi), as (9) has it",
                entry_error(2, 0, |[psi, theta, phi]| {
                    -psi.cos() * theta.sin() * phi.cos() + psi.sin() * phi.sin()
                }),
                ROUNDING,
            ),
        says("(5)", "III", "entry (3,3): c(phi) where c(theta) belongs")
            .measured(
                "largest difference from the product (1), 1000 random states",
                entry_error(2, 2, |q| printed(q)[(2, 2)]),
                ROUNDING,
            )
            .corrected(
                "c(psi) c(theta)",
                entry_error(2, 2, |[psi, theta, _]| psi.cos() * theta.cos()),
                ROUNDING,
            ),
    ]
}
