//! Section V, velocities and matrices of inertia: eqs. (23)-(32).

use matrices::dense::product;
use nalgebra::{DMatrix, Matrix3, Vector3};
use rand::RngExt;
use validate::lever::centre_part;

use super::rotations::{phi_matrix, theta_matrix};
use super::sample::{
    LargestEntry, angles, at, derivative, dynamic, largest, positive, rotation, signed,
    three_by_three, worst,
};
use super::{EquationAudit, Fault, NUMERIC, ROUNDING, says};

const SPIN: &str = "largest difference from A^T dA/dt, numeric, along 1000 random motions with rates up to 1, rad/s";
const ENTRY: &str =
    "largest difference from the product of the matrices, 1000 random states, J up to 1.5";

/// Eq. (23), the matrix.
pub(super) fn velocity_matrix([_, theta, phi]: [f64; 3]) -> Matrix3<f64> {
    let ((s_th, c_th), (s_phi, c_phi)) = (theta.sin_cos(), phi.sin_cos());
    Matrix3::new(c_th * c_phi, s_phi, 0.0, -c_th * s_phi, c_phi, 0.0, s_th, 0.0, 1.0)
}

/// Eq. (25).
pub(super) fn skew(w: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -w.z, w.y, w.z, 0.0, -w.x, -w.y, w.x, 0.0)
}

/// Eq. (24) as printed.
fn printed_omega([_, theta, phi]: [f64; 3], rates: &Vector3<f64>) -> Vector3<f64> {
    let ((s_th, c_th), (s_phi, c_phi)) = (theta.sin_cos(), phi.sin_cos());
    Vector3::new(
        -rates.x * c_th * c_phi + rates.y * s_phi,
        -rates.x * c_th * s_phi + rates.y * c_phi,
        rates.x * s_th + rates.z,
    )
}

/// Eq. (24) with the sign of the first component corrected.
fn omega([psi, theta, phi]: [f64; 3], rates: &Vector3<f64>) -> Vector3<f64> {
    let x = rates.x * theta.cos() * phi.cos() + rates.y * phi.sin();
    let printed = printed_omega([psi, theta, phi], rates);
    Vector3::new(x, printed.y, printed.z)
}

/// $[A]^T [\dot A]$ by numeric differentiation of nalgebra's rotation.
fn numeric_spin(q: [f64; 3], rates: &Vector3<f64>) -> Matrix3<f64> {
    let change = derivative(&|t| dynamic(&rotation(at(q, rates, t))));
    rotation(q).transpose() * three_by_three(&change)
}

/// Component of a formula for omega against the numeric one.
fn omega_error(formula: fn([f64; 3], &Vector3<f64>) -> Vector3<f64>, axis: usize) -> f64 {
    worst(|rng| {
        let (q, rates) = (angles(rng), signed(rng));
        let spin = numeric_spin(q, &rates);
        let numeric = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        formula(q, &rates)[axis] - numeric[axis]
    })
}

/// Eq. (31) as printed, with the line break inside (2,2) read as the sum that it looks like.
fn printed_inertia([_, theta, phi]: [f64; 3], j: &Vector3<f64>) -> Matrix3<f64> {
    let ((s_th, c_th), (s_phi, c_phi)) = (theta.sin_cos(), phi.sin_cos());
    // In (2,1) one and the same term is printed twice, with opposite signs.
    let same_again = j.x * c_phi * s_th * s_phi;
    Matrix3::new(
        j.x * c_phi.powi(2) * c_th.powi(2)
            + j.y * s_phi.powi(2) * c_th.powi(2)
            + j.z * s_th.powi(2),
        j.x * c_phi * c_th * s_phi - j.y * c_phi * c_th * s_phi,
        j.z * s_th,
        j.x * c_phi * s_th * s_phi - same_again,
        j.x * s_phi.powi(2) + j.y * c_phi.powi(2) + j.z * s_phi,
        0.0,
        j.z * s_phi,
        0.0,
        j.z,
    )
}

/// Eq. (31) corrected in its three entries.
fn corrected_inertia(q: [f64; 3], j: &Vector3<f64>) -> Matrix3<f64> {
    let ((s_th, c_th), (s_phi, c_phi)) = (q[1].sin_cos(), q[2].sin_cos());
    let mut matrix = printed_inertia(q, j);
    matrix[(1, 0)] = j.x * c_phi * c_th * s_phi - j.y * c_phi * c_th * s_phi;
    matrix[(1, 1)] = j.x * s_phi.powi(2) + j.y * c_phi.powi(2);
    matrix[(2, 0)] = j.z * s_th;
    matrix
}

/// $[Q]^T [J] [Q]$ of (23) and (26).
pub(super) fn inertia_product(q: [f64; 3], j: &Vector3<f64>) -> Matrix3<f64> {
    let velocity = velocity_matrix(q);
    velocity.transpose() * Matrix3::from_diagonal(j) * velocity
}

/// Entries of a formula for (31) against the product, over those that `pick` picks.
fn inertia_error(
    formula: fn([f64; 3], &Vector3<f64>) -> Matrix3<f64>,
    pick: impl Fn((usize, usize)) -> bool,
) -> f64 {
    worst(|rng| {
        let (q, j) = (angles(rng), Vector3::from(positive(rng)));
        let difference = formula(q, &j) - inertia_product(q, &j);
        largest(
            (0..9)
                .map(|k| (k / 3, k % 3))
                .filter(|&entry| pick(entry))
                .map(|entry| difference[entry]),
        )
    })
}

/// First line of (23) against its second.
fn columns_error(first_line: fn([f64; 3]) -> Matrix3<f64>) -> f64 {
    worst(|rng| {
        let q = angles(rng);
        (first_line(q) - velocity_matrix(q)).largest_entry()
    })
}

/// $[\varphi]^T[\theta]^T$ in front of the three unit vectors side by side: no brackets, as
/// printed.
fn all_turned([_, theta, phi]: [f64; 3]) -> Matrix3<f64> {
    phi_matrix(phi).transpose() * theta_matrix(theta).transpose()
}

/// Each unit vector turned by the rotations that follow it.
fn each_turned([_, theta, phi]: [f64; 3]) -> Matrix3<f64> {
    let (by_theta, by_phi) = (theta_matrix(theta).transpose(), phi_matrix(phi).transpose());
    Matrix3::from_columns(&[by_phi * by_theta * Vector3::x(), by_phi * Vector3::y(), Vector3::z()])
}

/// Rows of (32) for a bar less those that its place in (33) has: as printed, the matrix of the
/// masses times the column of three blocks, or with the two as the blocks of one matrix.
fn rows_too_many(one_matrix: bool) -> f64 {
    let masses = DMatrix::<f64>::identity(3, 3);
    let turning = dynamic(&inertia_product([0.1, 0.2, 0.3], &Vector3::new(1.0, 2.0, 3.0)));
    let rows = if one_matrix {
        masses.nrows() + turning.nrows()
    } else {
        let mut column = DMatrix::zeros(9, 3);
        column.view_mut((6, 0), (3, 3)).copy_from(&turning);
        // Each mass multiplies a block.
        product(&masses.kronecker(&DMatrix::identity(3, 3)), &column).nrows()
    };
    rows as f64 - 6.0
}

/// Kinetic energy by (32) read as block diagonal, less that of translation and of rotation.
fn energy_error() -> f64 {
    worst(|rng| {
        let (q, rates, speed) = (angles(rng), signed(rng), signed(rng));
        let (j, mass) = (Vector3::from(positive(rng)), rng.random_range(0.5..1.5));
        let spin = numeric_spin(q, &rates);
        let w = Vector3::new(spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]);
        let by_32 = mass * speed.norm_squared() + rates.dot(&(corrected_inertia(q, &j) * rates));
        0.5 * (by_32 - mass * speed.norm_squared() - w.dot(&w.component_mul(&j)))
    })
}

/// Eq. (28) at a centre of weight $c$ in the bar's own axes.
pub(super) fn static_moment(mass: f64, c: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(
        0.0,
        -mass * c.z,
        mass * c.y,
        mass * c.z,
        0.0,
        -mass * c.x,
        -mass * c.y,
        mass * c.x,
        0.0,
    )
}

/// (29) or (30) with the centre of weight in the origin of the bar's axes, eq. (27).
fn coupling(transposed: bool) -> f64 {
    worst(|rng| {
        let (q, mass) = (angles(rng), rng.random_range(0.5..1.5));
        let moment = static_moment(mass, &Vector3::zeros());
        let block = rotation(q) * moment.transpose() * velocity_matrix(q);
        let mirror = velocity_matrix(q).transpose() * moment * rotation(q).transpose();
        if transposed { mirror.largest_entry() } else { block.largest_entry() }
    })
}

pub(super) fn rows() -> Vec<EquationAudit> {
    let mut rows = velocities();
    rows.extend(static_moments());
    rows.extend(inertias());
    rows
}

/// Angular velocities: (23)-(25).
fn velocities() -> Vec<EquationAudit> {
    let skew_error = worst(|rng| {
        let (q, rates) = (angles(rng), signed(rng));
        (skew(&omega(q, &rates)) - numeric_spin(q, &rates)).largest_entry()
    });
    let matrix_error = worst(|rng| {
        let (q, rates) = (angles(rng), signed(rng));
        (skew(&(velocity_matrix(q) * rates)) - numeric_spin(q, &rates)).largest_entry()
    });
    vec![
        says(
            "(23)",
            "V",
            "first line: no brackets, so [phi]^T[theta]^T turns all three unit vectors",
        )
        .measured(
            "largest difference from the second line, 1000 random states",
            columns_error(all_turned),
            ROUNDING,
        )
        .corrected(
            "[Q] = [[phi]^T[theta]^T{u_psi}, [phi]^T{u_theta}, {u_phi}], three columns",
            columns_error(each_turned),
            ROUNDING,
        )
        .fault(Fault::Form),
        says("(23)", "V", "second line: the matrix from angle rates to the angular velocity")
            .measured(SPIN, matrix_error, NUMERIC),
        says("(24)", "V", "first component of omega: the sign of the psi term")
            .measured(SPIN, omega_error(printed_omega, 0), NUMERIC)
            .corrected(
                "+psi' cos(theta) cos(phi) + theta' sin(phi), as (23) has it",
                omega_error(omega, 0),
                NUMERIC,
            ),
        says("(24)", "V", "second and third component of omega").measured(
            SPIN,
            largest([1, 2].map(|axis| omega_error(printed_omega, axis))),
            NUMERIC,
        ),
        says("(25)", "V", "the skew matrix of omega, with (24) corrected")
            .measured(SPIN, skew_error, NUMERIC),
    ]
}

/// First moment of a homogeneous bar about its centre of weight, and the differences of its second
/// moments from `model`'s, over ml and ml²: the worst of the example's bars.
fn moments() -> (f64, f64) {
    // Two points of Gauss are exact for squares.
    let at = 1.0 / 12.0_f64.sqrt();
    let paper = model::cases::paper();
    let of = paper.chain().bars().iter().map(|bar| {
        let (l, m) = (bar.length_m(), bar.mass_kg());
        let x = [0.5 - at, 0.5 + at].map(|at| at - centre_part(bar));
        let second = f64::midpoint(x[0] * x[0], x[1] * x[1]);
        let [j_x, j_y, j_z] = bar.inertia_kg_m2().map(|j| j / (m * l * l));
        (f64::midpoint(x[0], x[1]), largest([j_x, j_y - second, j_z - second]))
    });
    let (first, second): (Vec<_>, Vec<_>) = of.unzip();
    (largest(first), largest(second))
}

/// What follows from axes through the centre of weight: (26)-(30).
fn static_moments() -> Vec<EquationAudit> {
    let (of_first, of_second) = moments();
    let moment_error = worst(|rng| {
        let (centre, v) = (signed(rng), signed(rng));
        (static_moment(1.0, &centre) * v - centre.cross(&v)).largest_entry()
    });
    vec![
        says("(26)", "V", "the principal moments of inertia")
            .measured("largest difference of model's moments of the example's bars from integrals over their length, ml^2", of_second, ROUNDING)
            .definition(),
        says("(27)", "V", "the bar's axes start at its centre of weight")
            .measured("first moment of the example's bars about model's centres, an integral over their length, ml", of_first, ROUNDING)
            .definition(),
        says("(28)", "V", "the static moment, zero because of (27); m stands for m_i")
            .measured(
            "largest entry of [S]v - m (x_C cross v) at random x_C and of [S] at x_C = 0",
            largest([moment_error, static_moment(1.0, &Vector3::zeros()).largest_entry()]),
            ROUNDING,
        ),
        says("(29)", "V", "no coupling of rotation into translation").measured(
            "largest entry, 1000 random states",
            coupling(false),
            ROUNDING,
        ),
        says("(30)", "V", "no coupling of translation into rotation").measured(
            "largest entry, 1000 random states",
            coupling(true),
            ROUNDING,
        ),
    ]
}

/// The matrices of inertia: (31), (32).
fn inertias() -> Vec<EquationAudit> {
    let wrong = [(1, 0), (1, 1), (2, 0)];
    let entry = |what, at, text| {
        says("(31)", "V", what)
            .measured(ENTRY, inertia_error(printed_inertia, |e| e == at), ROUNDING)
            .corrected(text, inertia_error(corrected_inertia, |e| e == at), ROUNDING)
    };
    vec![
        says("(31)", "V", "the entries other than (2,1), (2,2), (3,1)").measured(
            ENTRY,
            inertia_error(printed_inertia, |e| !wrong.contains(&e)),
            ROUNDING,
        ),
        entry(
            "entry (2,1): s(theta) for c(theta), J_x for J_y: it cancels to 0, and the matrix is not symmetric",
            (1, 0),
            "(J_x - J_y) c(phi) c(theta) s(phi), the entry (1,2)",
        ),
        entry(
            "entry (2,2): a line break puts J_z s(phi) under it",
            (1, 1),
            "J_x s^2(phi) + J_y c^2(phi)",
        )
        .fault(Fault::Form),
        entry("entry (3,1): s(phi) for s(theta)", (2, 0), "J_z s(theta), the entry (1,3)"),
        says("(32)", "V", "two brackets side by side are a product, of 9 rows where (33) needs 6")
            .counted(
                "rows of the product, or of the matrix, less the 6 of a bar's coordinates",
                rows_too_many(false),
            )
            .corrected(
                "one matrix of 6 rows with the blocks [diag(m_i)] and [Q_i]^T[J_Ci][Q_i]",
                rows_too_many(true),
                ROUNDING,
            )
            .fault(Fault::Form),
        says(
            "(32)",
            "V",
            "the matrix of inertia of a bar as one block diagonal matrix, with (31) corrected",
        )
        .measured(
            "kinetic energy less that of translation and rotation, 1000 random motions",
            energy_error(),
            NUMERIC,
        ),
    ]
}
