//! Constraint functions, eqs. (7)-(20), and the matrix of constraints, eqs. (21)-(22).
#![expect(non_snake_case, reason = "B is the paper's matrix of constraints, eq. (22)")]

use model::Chain;
use nalgebra::{DMatrix, DVector, RealField, Vector3, convert};

use crate::full::mechanism::Mechanism;
use crate::full::rotation::{direction, direction_gradient};

/// Coordinates of one bar in `q`: $X_C, Y_C, Z_C, \psi, \theta, \varphi$, eq. (21).
pub(crate) const PER_BAR: usize = 6;

/// The bar's part of `q`: centre of weight and the three angles.
pub(crate) fn bar_coordinates<T: RealField + Copy>(
    q: &DVector<T>,
    bar: usize,
) -> (Vector3<T>, [T; 3]) {
    let at = PER_BAR * bar;
    (Vector3::new(q[at], q[at + 1], q[at + 2]), [q[at + 3], q[at + 4], q[at + 5]])
}

/// The coordinates `q` of eq. (21): the centres follow from the angles along the chain, so that
/// every constraint but the last three holds.
pub(crate) fn coordinates(mechanism: &Mechanism, angles: &[[f64; 3]]) -> DVector<f64> {
    let mut q = DVector::zeros(mechanism.coordinates());
    let mut joint = mechanism.start;
    for (bar, &[psi, theta, phi]) in angles.iter().enumerate() {
        let u = direction(psi, theta, phi);
        let centre = joint + u * mechanism.centres[bar];
        joint += u * mechanism.lengths[bar];
        let part = [centre.x, centre.y, centre.z, psi, theta, phi];
        q.rows_mut(PER_BAR * bar, PER_BAR).copy_from_slice(&part);
    }
    q
}

/// Constraint functions $f_1 \dots f_{3(n+1)}$ of n bars at the coordinates `q` (6n, eq. 21), m.
///
/// Rows 0..3 hold the first bar at joint 0, eqs. (7)-(9); rows 3k..3k+3 hold bars k and k+1
/// together at joint k, eqs. (12)-(17); the last three hold bar n at joint n. There the paper
/// prints the second bar in (18)-(20) ($C_2, l_2, r_2$ and its angles); the last bar is meant,
/// since the equations are those of the point $A_3$.
///
/// Paper, eqs. (6)-(20).
///
/// # Panics
///
/// When `q` has not 6n entries.
///
/// ```
/// use nalgebra::DVector;
/// // All bars of the paper's chain straight down from the first anchor: the last joint is off.
/// let half_pi = std::f64::consts::FRAC_PI_2;
/// let straight = (0..3).flat_map(|i| [0.0, 0.0, -0.5 - f64::from(i), 0.0, half_pi, 0.0]);
/// let q = DVector::from_iterator(18, straight);
/// let f = lagrange::constraint_functions(model::cases::paper().chain(), &q);
/// assert!(f.rows(0, 11).amax() < 1e-15 && (f[11] + 1.0).abs() < 1e-15);
/// ```
pub fn constraint_functions<T: RealField + Copy>(chain: &Chain, q: &DVector<T>) -> DVector<T> {
    constraint_functions_of(&Mechanism::si(chain), q)
}

pub(crate) fn constraint_functions_of<T: RealField + Copy>(
    mechanism: &Mechanism,
    q: &DVector<T>,
) -> DVector<T> {
    let n = mechanism.bars();
    assert_eq!(q.len(), mechanism.coordinates(), "q holds six coordinates of each bar");
    let mut f = DVector::zeros(mechanism.constraints());
    for joint in 0..=n {
        // What ends at the joint minus what begins there: the ground is both at the anchors.
        let f_joint = if joint == 0 {
            first_end(mechanism, q, 0) - mechanism.start.map(convert)
        } else if joint < n {
            last_end(mechanism, q, joint - 1) - first_end(mechanism, q, joint)
        } else {
            last_end(mechanism, q, n - 1) - mechanism.end.map(convert)
        };
        f.fixed_rows_mut::<3>(3 * joint).copy_from(&f_joint);
    }
    f
}

/// First end of a bar, $X_C - r\\,u$: eqs. (6) and (11).
fn first_end<T: RealField + Copy>(m: &Mechanism, q: &DVector<T>, bar: usize) -> Vector3<T> {
    let (centre, [psi, theta, phi]) = bar_coordinates(q, bar);
    centre - direction(psi, theta, phi) * convert::<f64, T>(m.centres[bar])
}

/// Last end of a bar, $X_C + (l - r)\\,u$: eq. (10).
fn last_end<T: RealField + Copy>(m: &Mechanism, q: &DVector<T>, bar: usize) -> Vector3<T> {
    let (centre, [psi, theta, phi]) = bar_coordinates(q, bar);
    centre + direction(psi, theta, phi) * convert::<f64, T>(m.lengths[bar] - m.centres[bar])
}

/// How the centre and the direction of a bar enter the constraint functions of a joint.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Entry {
    /// The joint.
    pub joint: usize,
    /// Factor of the centre of weight, +1 or −1.
    pub of_centre: f64,
    /// Factor of the direction, a length.
    pub of_direction: f64,
}

/// The two entries of a bar: at its first joint and at its last.
pub(crate) fn entries(mechanism: &Mechanism, bar: usize) -> [Entry; 2] {
    let (length, centre) = (mechanism.lengths[bar], mechanism.centres[bar]);
    // At joint 0 the paper writes bar minus ground, eqs. (7)-(9); at every other joint the bar that
    // begins there is subtracted.
    let sign = if bar == 0 { 1.0 } else { -1.0 };
    [
        Entry { joint: bar, of_centre: sign, of_direction: -sign * centre },
        Entry { joint: bar + 1, of_centre: 1.0, of_direction: length - centre },
    ]
}

/// Matrix of constraints $b_{i,j} = \partial f_i / \partial q_j$, size 3(n+1) × 6n, analytic.
///
/// Entries are 1 or −1 in the columns of the centres and metres (per radian) in those of the
/// angles.
///
/// Paper, eq. (22), and eqs. (xi)-(xxii) for its example.
///
/// # Panics
///
/// When `q` has not 6n entries.
///
/// ```
/// let q = nalgebra::DVector::zeros(18);
/// let b = lagrange::constraint_matrix(model::cases::paper().chain(), &q);
/// // Twelve constraint functions of eighteen coordinates; row 1 holds the centre of bar 1.
/// assert_eq!(b.shape(), (12, 18));
/// assert_eq!((b[(0, 0)], b[(0, 6)], b[(3, 6)]), (1.0, 0.0, -1.0));
/// ```
pub fn constraint_matrix<T: RealField + Copy>(chain: &Chain, q: &DVector<T>) -> DMatrix<T> {
    constraint_matrix_of(&Mechanism::si(chain), q)
}

pub(crate) fn constraint_matrix_of<T: RealField + Copy>(
    mechanism: &Mechanism,
    q: &DVector<T>,
) -> DMatrix<T> {
    assert_eq!(q.len(), mechanism.coordinates(), "q holds six coordinates of each bar");
    let mut B = DMatrix::zeros(mechanism.constraints(), mechanism.coordinates());
    for bar in 0..mechanism.bars() {
        let (_, [psi, theta, phi]) = bar_coordinates(q, bar);
        let gradient = direction_gradient(psi, theta, phi);
        for entry in entries(mechanism, bar) {
            let (row, column) = (3 * entry.joint, PER_BAR * bar);
            for axis in 0..3 {
                B[(row + axis, column + axis)] = convert(entry.of_centre);
            }
            let by_angles = gradient * convert::<f64, T>(entry.of_direction);
            B.fixed_view_mut::<3, 3>(row, column + 3).copy_from(&by_angles);
        }
    }
    B
}

/// Generalised forces of the constraints, $\mathbf{B}^T\\{\lambda\\}$, bar by bar and without
/// forming the matrix, which is almost empty.
pub(crate) fn constraint_forces_of<T: RealField + Copy>(
    mechanism: &Mechanism,
    q: &DVector<T>,
    lambda: &DVector<T>,
) -> DVector<T> {
    assert_eq!(q.len(), mechanism.coordinates(), "q holds six coordinates of each bar");
    let mut forces = DVector::zeros(mechanism.coordinates());
    for bar in 0..mechanism.bars() {
        let (_, [psi, theta, phi]) = bar_coordinates(q, bar);
        let (mut force, mut lever) = (Vector3::zeros(), Vector3::zeros());
        for entry in entries(mechanism, bar) {
            let at_joint = lambda.fixed_rows::<3>(3 * entry.joint);
            force += at_joint * convert::<f64, T>(entry.of_centre);
            lever += at_joint * convert::<f64, T>(entry.of_direction);
        }
        let moment = direction_gradient(psi, theta, phi).tr_mul(&lever);
        forces.fixed_rows_mut::<3>(PER_BAR * bar).copy_from(&force);
        forces.fixed_rows_mut::<3>(PER_BAR * bar + 3).copy_from(&moment);
    }
    forces
}
