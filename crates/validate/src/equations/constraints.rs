//! Sections III and IV, the constraint functions and their matrix: eqs. (6)-(22).

use nalgebra::{DMatrix, DVector, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::sample::{LargestEntry, angles, derivative, largest, positive, rotation, worst};
use super::{EquationAudit, NUMERIC, ROUNDING};

const CLOSED: &str =
    "largest value at 1000 random configurations that are closed by construction, l";

/// Three bars of random lengths hung one on the other, so that every joint is closed.
struct Closed {
    lengths: [f64; 3],
    levers: [f64; 3],
    angles: [[f64; 3]; 3],
    centres: [Vector3<f64>; 3],
    /// O, A1, A2, A3.
    joints: [Vector3<f64>; 4],
}

impl Closed {
    /// Built joint by joint from rotation matrices, with no constraint function.
    fn random(rng: &mut ChaCha8Rng) -> Self {
        let lengths = positive(rng);
        let levers = lengths.map(|l| rng.random_range(0.0..l));
        let angles = [(); 3].map(|()| angles(rng));
        let mut joints = [Vector3::zeros(); 4];
        let mut centres = [Vector3::zeros(); 3];
        for bar in 0..3 {
            let along = rotation(angles[bar]).column(0).into_owned();
            centres[bar] = joints[bar] + along * levers[bar];
            joints[bar + 1] = joints[bar] + along * lengths[bar];
        }
        Self { lengths, levers, angles, centres, joints }
    }

    /// The component of bar's direction as (7)-(20) print it.
    fn direction(&self, bar: usize, axis: usize) -> f64 {
        let [psi, theta, phi] = self.angles[bar];
        match axis {
            0 => theta.cos() * phi.cos(),
            1 => psi.sin() * theta.sin() * phi.cos() + psi.cos() * phi.sin(),
            _ => -psi.cos() * theta.sin() * phi.cos() + psi.sin() * phi.sin(),
        }
    }

    /// Where a bar begins: $X_C - r u$.
    fn begin(&self, bar: usize, axis: usize) -> f64 {
        self.centres[bar][axis] - self.levers[bar] * self.direction(bar, axis)
    }

    /// Where a bar ends: $X_C + (l - r) u$.
    fn end(&self, bar: usize, axis: usize) -> f64 {
        self.centres[bar][axis] + (self.lengths[bar] - self.levers[bar]) * self.direction(bar, axis)
    }
}

/// Largest value of a constraint function over random closed configurations.
fn open(f: impl Fn(&Closed) -> f64) -> f64 {
    worst(|rng| f(&Closed::random(rng)))
}

/// Largest distance of two points over random closed configurations.
fn apart(f: impl Fn(&Closed) -> Vector3<f64>) -> f64 {
    open(|closed| f(closed).largest_entry())
}

pub(super) fn rows() -> Vec<EquationAudit> {
    let at_o =
        |c: &Closed| c.centres[0] + rotation(c.angles[0]) * Vector3::new(-c.levers[0], 0.0, 0.0);
    let end_1 = |c: &Closed| {
        c.centres[0] + rotation(c.angles[0]) * Vector3::new(c.lengths[0] - c.levers[0], 0.0, 0.0)
    };
    let begin_2 =
        |c: &Closed| c.centres[1] + rotation(c.angles[1]) * Vector3::new(-c.levers[1], 0.0, 0.0);
    let mut rows = vec![EquationAudit::new("(6)", "III", "bar 1 begins at O").measured(
        CLOSED,
        apart(|c| at_o(c) - c.joints[0]),
        ROUNDING,
    )];
    for (axis, number) in ["(7)", "(8)", "(9)"].into_iter().enumerate() {
        rows.push(
            EquationAudit::new(number, "III", "constraint function: bar 1 is held at O").measured(
                CLOSED,
                open(|c| c.begin(0, axis)),
                ROUNDING,
            ),
        );
    }
    rows.push(EquationAudit::new("(10)", "III", "bar 1 ends at A1").measured(
        CLOSED,
        apart(|c| end_1(c) - c.joints[1]),
        ROUNDING,
    ));
    rows.push(EquationAudit::new("(11)", "III", "bar 2 begins at A1").measured(
        CLOSED,
        apart(|c| begin_2(c) - c.joints[1]),
        ROUNDING,
    ));
    for (axis, number) in ["(12)", "(13)", "(14)"].into_iter().enumerate() {
        rows.push(
            EquationAudit::new(number, "III", "constraint function: bars 1 and 2 meet at A1")
                .measured(CLOSED, open(|c| c.end(0, axis) - c.begin(1, axis)), ROUNDING),
        );
    }
    for (axis, number) in ["(15)", "(16)", "(17)"].into_iter().enumerate() {
        rows.push(
            EquationAudit::new(number, "III", "constraint function: bars 2 and 3 meet at A2")
                .measured(CLOSED, open(|c| c.end(1, axis) - c.begin(2, axis)), ROUNDING),
        );
    }
    for (axis, number) in ["(18)", "(19)", "(20)"].into_iter().enumerate() {
        rows.push(
            EquationAudit::new(
                number,
                "III",
                "C2, l2, r2 and the angles of bar 2 where bar 3 is held at A3",
            )
            .measured(CLOSED, open(|c| c.end(1, axis) - c.joints[3][axis]), ROUNDING)
            .corrected(
                "the same with the index 3: C3 + (l3 - r3) [A3] e_x = A3",
                open(|c| c.end(2, axis) - c.joints[3][axis]),
                ROUNDING,
            ),
        );
    }
    rows.push(
        EquationAudit::new("after (20)", "III", "18 coordinates less 12 constraints: 6 degrees of freedom, 3 of them useless")
            .measured(
                "columns of B less its rank less 6, and twists of a bar that move its ends, 100 random states",
                freedom(),
                ROUNDING,
            ),
    );
    let coordinates = lagrange::load_vector(model::cases::paper().chain()).len();
    rows.push(
        EquationAudit::new("(21)", "IV", "the vector of 18 coordinates")
            .counted(
                "entries of lagrange's load vector, one per coordinate, less 18",
                coordinates as f64 - 18.0,
            )
            .definition(),
    );
    rows.push(
        EquationAudit::new("(22)", "IV", "the matrix of constraints is the derivative of (7)-(20), with (18)-(20) corrected")
            .measured(
                "largest difference of lagrange's matrix from numeric derivatives, l and l/rad, 100 random states",
                matrix_of_constraints(),
                NUMERIC,
            ),
    );
    rows
}

/// Random coordinates of the paper's example, on or off its constraints.
fn coordinates(rng: &mut ChaCha8Rng) -> DVector<f64> {
    DVector::from_fn(18, |_, _| rng.random_range(-1.5..1.5))
}

/// `count` random states out of the thousand: these measures are dear.
fn of_some(count: usize, mut residual: impl FnMut(&mut ChaCha8Rng) -> f64) -> f64 {
    let mut taken = 0;
    worst(|rng| {
        taken += 1;
        if taken <= count { residual(rng) } else { 0.0 }
    })
}

/// Below this fraction of the largest singular value the matrix has lost a rank.
const RANK: f64 = 1e-12;

fn freedom() -> f64 {
    let paper = model::cases::paper();
    of_some(100, |rng| {
        let q = coordinates(rng);
        let singular = lagrange::constraint_matrix(paper.chain(), &q).singular_values();
        let rank = singular.iter().filter(|&&s| s > RANK * singular.max()).count();
        let useless = (0..3).map(|bar| {
            let at = 6 * bar + 3;
            let gradient = lagrange::direction_gradient(q[at], q[at + 1], q[at + 2]);
            // A turn about the bar's own axis: the null vector of the derivative of its direction.
            let (s_th, c_th) = q[at + 1].sin_cos();
            let (s_phi, c_phi) = q[at + 2].sin_cos();
            (gradient * Vector3::new(c_phi, c_th * s_phi, -s_th * c_phi)).largest_entry()
        });
        let free = (q.len() - rank) as f64;
        largest(useless.chain([free - 6.0]))
    })
}

/// Derivative of the constraint functions as this file writes them, against `lagrange`'s matrix.
fn matrix_of_constraints() -> f64 {
    let paper = model::cases::paper();
    of_some(100, |rng| {
        let q = coordinates(rng);
        let matrix = lagrange::constraint_matrix(paper.chain(), &q);
        largest((0..18).map(|column| {
            let numeric = derivative(|t| {
                let mut moved = q.clone();
                moved[column] += t;
                constraint_functions(&moved)
            });
            (numeric - matrix.columns(column, 1)).largest_entry()
        }))
    })
}

/// Eqs. (7)-(20), (18)-(20) corrected, of the paper's example with l = 1.
fn constraint_functions(q: &DVector<f64>) -> DMatrix<f64> {
    let state = Closed {
        lengths: [1.0; 3],
        levers: [0.5; 3],
        angles: std::array::from_fn(|bar| std::array::from_fn(|k| q[6 * bar + 3 + k])),
        centres: std::array::from_fn(|bar| q.fixed_rows::<3>(6 * bar).into_owned()),
        joints: [
            Vector3::zeros(),
            Vector3::zeros(),
            Vector3::zeros(),
            Vector3::new(0.0, 0.0, -2.0),
        ],
    };
    DMatrix::from_fn(12, 1, |row, _| {
        let axis = row % 3;
        match row / 3 {
            0 => state.begin(0, axis),
            joint @ (1 | 2) => state.end(joint - 1, axis) - state.begin(joint, axis),
            _ => state.end(2, axis) - state.joints[3][axis],
        }
    })
}
