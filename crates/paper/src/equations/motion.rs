//! Section VI, the equation of motion: eqs. (33)-(39).

use matrices::dense::product;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::inertia::{inertia_product, skew, velocity_matrix};
use super::sample::{
    LargestEntry, angles, at, derivative, dynamic, largest, positive, rotation, second_derivative,
    signed, three_by_three, worst,
};
use super::{EquationAudit, Fault, NUMERIC, ROUNDING, says};

const GYROSCOPIC: &str = "largest difference from Lagrange's equation by numeric derivatives of the kinetic energy, 1000 random motions, J up to 1.5, rates up to 1";

/// A motion of the paper's example (l = 1, O above D by 2) that keeps every joint closed: bar 1
/// turns at constant angle rates, bars 2 and 3 span the rest and turn about it.
struct ClosedMotion {
    first: [f64; 3],
    first_rates: Vector3<f64>,
    elbow: f64,
    elbow_rate: f64,
}

/// Fastest rate of a closed motion, rad/s: slow enough for the stencils, since the coordinates of
/// bars 2 and 3 bend more than those of bar 1.
const FASTEST: f64 = 0.2;

/// Where the third bar ends.
const D: Vector3<f64> = Vector3::new(0.0, 0.0, -2.0);

impl ClosedMotion {
    /// A motion that stays clear of the stretched chain and of the gimbal lock, where the
    /// coordinates of bars 2 and 3 are no smooth functions of time.
    fn random(rng: &mut ChaCha8Rng) -> Self {
        // Tries until clear. The bound only keeps a broken generator from hanging.
        let mut motion = Self::any(rng);
        for _ in 0..1000 {
            if motion.is_clear() {
                break;
            }
            motion = Self::any(rng);
        }
        motion
    }

    fn any(rng: &mut ChaCha8Rng) -> Self {
        Self {
            first: angles(rng),
            first_rates: signed(rng) * FASTEST,
            elbow: angles(rng)[0],
            elbow_rate: rng.random_range(-FASTEST..FASTEST),
        }
    }

    fn is_clear(&self) -> bool {
        let rest = D - self.first_direction(0.0);
        let q = self.coordinates(0.0);
        let lock = q[10].sin().min(q[16].sin());
        // Bars 2 and 3 of length 1 each span at most 2.
        rest.norm() < 1.7 && rest.x.hypot(rest.y) > 0.5 && lock > 0.5
    }

    fn first_direction(&self, t: f64) -> Vector3<f64> {
        rotation(at(self.first, &self.first_rates, t)).column(0).into_owned()
    }

    /// The 18 coordinates at time `t`.
    fn coordinates(&self, t: f64) -> DVector<f64> {
        let a = self.first_direction(t);
        let rest = D - a;
        let along = rest.normalize();
        let across = along.cross(&Vector3::z()).normalize();
        let height = (1.0 - rest.norm_squared() / 4.0).sqrt();
        let (sine, cosine) = (self.elbow + self.elbow_rate * t).sin_cos();
        let b = a + rest / 2.0 + (across * cosine + along.cross(&across) * sine) * height;
        let (second, third) = (b - a, D - b);
        let first = at(self.first, &self.first_rates, t);
        let bars = [
            (a / 2.0, first),
            (second / 2.0 + a, lying(&second)),
            (third / 2.0 + b, lying(&third)),
        ];
        DVector::from_iterator(
            18,
            bars.iter().flat_map(|(centre, angles)| centre.iter().chain(angles).copied()),
        )
    }
}

/// Angles of a direction with phi = 0.
fn lying(u: &Vector3<f64>) -> [f64; 3] {
    [u.y.atan2(-u.z), u.x.acos(), 0.0]
}

/// $[B]\\{\ddot q\\}$ of a closed motion less the right-hand side of the lower rows of (33).
fn lower_rows(as_printed: bool) -> f64 {
    let paper = model::cases::paper();
    let matrix = |q: &DVector<f64>| lagrange::constraint_matrix(paper.chain(), q);
    worst(|rng| {
        let motion = ClosedMotion::random(rng);
        let path = |t: f64| DMatrix::from_column_slice(18, 1, motion.coordinates(t).as_slice());
        let q = motion.coordinates(0.0);
        let rhs = if as_printed {
            -product(&matrix(&q), &path(0.0))
        } else {
            let change = derivative(&|t| matrix(&motion.coordinates(t)));
            -product(&change, &derivative(&path))
        };
        (product(&matrix(&q), &second_derivative(&path)) - rhs).largest_entry()
    })
}

/// Rows that the matrix on the left of (33) has too few for its unknowns
/// $\\{\ddot q\\}, \\{\lambda\\}$.
fn missing_rows(lower_rows: bool) -> f64 {
    let paper = model::cases::paper();
    let matrix = lagrange::constraint_matrix(paper.chain(), &DVector::<f64>::zeros(18));
    let unknowns = matrix.ncols() + matrix.nrows();
    let equations = matrix.ncols() + if lower_rows { matrix.nrows() } else { 0 };
    unknowns as f64 - equations as f64
}

/// Columns that the factor of $\\{\ddot q\\}, \\{\lambda\\}$ on the left of (33) has too few: $[B]^T$
/// alone, or the whole matrix.
fn missing_columns(bracket: bool) -> f64 {
    let paper = model::cases::paper();
    let matrix = lagrange::constraint_matrix(paper.chain(), &DVector::<f64>::zeros(18));
    let unknowns = matrix.ncols() + matrix.nrows();
    let transposed = matrix.transpose();
    let columns = transposed.ncols() + if bracket { matrix.ncols() } else { 0 };
    unknowns as f64 - columns as f64
}

/// Kinetic energy of rotation.
fn kinetic(q: [f64; 3], rates: &Vector3<f64>, j: &Vector3<f64>) -> f64 {
    0.5 * rates.dot(&(inertia_product(q, j) * rates))
}

/// The generalised force of (39) by Lagrange's equation: $\partial T/\partial\beta$ less the part
/// of the time derivative of $\partial T/\partial\dot\beta$ without accelerations.
fn gyroscopic(q: [f64; 3], rates: &Vector3<f64>, j: &Vector3<f64>) -> Vector3<f64> {
    let change = derivative(&|t| dynamic(&inertia_product(at(q, rates, t), j)));
    let gradient = Vector3::from_fn(|k, _| {
        let along = Vector3::ith(k, 1.0);
        derivative(&|t| DMatrix::from_element(1, 1, kinetic(at(q, &along, t), rates, j)))[(0, 0)]
    });
    gradient - three_by_three(&change) * rates
}

/// (39) with its missing bracket; the dot on the transpose as printed, or without.
fn bracketed(q: [f64; 3], rates: &Vector3<f64>, j: &Vector3<f64>, dotted: bool) -> Vector3<f64> {
    let velocity = velocity_matrix(q);
    let change = three_by_three(&derivative(&|t| dynamic(&velocity_matrix(at(q, rates, t)))));
    let inertia = Matrix3::from_diagonal(j);
    let front = if dotted { change } else { velocity }.transpose();
    let turning = front * skew(&(velocity * rates)) * inertia * velocity;
    -(velocity.transpose() * inertia * change + turning) * rates
}

/// Difference of (39) from Lagrange's equation.
fn gyroscopic_error(dotted: bool) -> f64 {
    worst(|rng| {
        let (q, rates, j) = (angles(rng), signed(rng), Vector3::from(positive(rng)));
        (bracketed(q, &rates, &j, dotted) - gyroscopic(q, &rates, &j)).largest_entry()
    })
}

/// Columns of the first summand of (38) or (39) less those of the left-hand side: 3 × 3 matrices,
/// times the column of rates only if a bracket says so.
fn columns_too_many(bracket: bool) -> f64 {
    let summand = product(&DMatrix::zeros(3, 3), &DMatrix::zeros(3, 3));
    let rates = DMatrix::<f64>::zeros(3, 1);
    let columns = if bracket { product(&summand, &rates).ncols() } else { summand.ncols() };
    columns as f64 - 1.0
}

pub(super) fn rows() -> Vec<EquationAudit> {
    let paper = model::cases::paper();
    let load = lagrange::load_vector(paper.chain());
    let at_rest = worst(|rng| {
        let (q, j) = (angles(rng), Vector3::from(positive(rng)));
        bracketed(q, &Vector3::zeros(), &j, false).largest_entry()
    });
    let weights = paper.chain().bars().iter().enumerate().map(|(bar, of)| {
        let weight = of.mass_kg() * paper.chain().gravity_m_s2();
        (load.fixed_rows::<3>(6 * bar) / weight - Vector3::new(0.0, 0.0, -1.0)).largest_entry()
    });
    let weight_error = largest(weights);
    let couples = largest((0..3).map(|bar| load.fixed_rows::<3>(6 * bar + 3).largest_entry()));
    let columns = "columns of the first summand less those of the left-hand side";
    vec![
        says("(33)", "VI", "lower right-hand side: -[B]{q}, without its two dots, is no derivative of the constraints")
            .measured(
                "largest entry of [B]{q''} less the right-hand side, 1000 random motions with all joints closed, l/s^2 and rates up to 0.2/s",
                lower_rows(true),
                NUMERIC,
            )
            .corrected("-[dB/dt]{q'}", lower_rows(false), NUMERIC)
            .fault(Fault::Form),
        says("(33)", "VI", "no bracket joins [M] and -[B]^T, which so has 12 columns for 30 unknowns")
            .counted("unknowns less columns of what stands before them", missing_columns(false))
            .corrected("[[M], -[B]^T; [B], [0]]", missing_columns(true), ROUNDING)
            .fault(Fault::Form),
        says("(33)", "VI", "the matrix on the left lacks its lower rows [B] [0]")
            .counted("unknowns less equations", missing_rows(false))
            .corrected("[[M], -[B]^T; [B], [0]], 30 rows for 30 unknowns", missing_rows(true), ROUNDING)
            .fault(Fault::Form),
        says("(34)", "VI", "the generalised force: force, then moment")
            .counted("entries of lagrange's load vector less 3 + 3 for each bar", load.len() as f64 - 6.0 * paper.chain().bars().len() as f64)
            .definition(),
        says("(35)", "VI", "the weight acts along -Z")
            .measured("largest difference from lagrange's load vector, mg", weight_error, ROUNDING),
        says("(36)", "VI", "a weight at the centre has no moment about it")
            .measured("largest entry of lagrange's load vector, N m", couples, ROUNDING),
        says("(37)", "VI", "the generalised force of inertia: force, then moment")
            .measured("largest entry at rest, where section VII leaves it out: (39) corrected without rates, 1000 random states", at_rest, ROUNDING)
            .definition(),
        says("(38)", "VI", "no bracket before the column of angle rates: a matrix is added to a column (the value 0 is right)")
            .counted(columns, columns_too_many(false))
            .corrected("-([A][S]^T[Q'] + [A'][S]^T[Q]){psi' theta' phi'}", columns_too_many(true), ROUNDING)
            .fault(Fault::Form),
        says("(39)", "VI", "no bracket before the column of angle rates: a matrix is added to a column")
            .counted(columns, columns_too_many(false))
            .corrected("-([Q]^T[J][Q'] + [Q]^T[omega][J][Q]){psi' theta' phi'}", columns_too_many(true), ROUNDING)
            .fault(Fault::Form),
        says("(39)", "VI", "[Q']^T for [Q]^T in front of [omega], even with the bracket: 1/s^3 added to 1/s^2")
            .measured(GYROSCOPIC, gyroscopic_error(true), NUMERIC)
            .corrected(
                "-([Q]^T[J][Q'] + [Q]^T[omega][J][Q]){psi' theta' phi'}",
                gyroscopic_error(false),
                NUMERIC,
            ),
    ]
}
