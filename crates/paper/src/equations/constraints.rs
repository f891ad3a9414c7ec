//! Sections III and IV, the constraint functions and their matrix: eqs. (6)-(22).

use matrices::dense::Kernels;
use nalgebra::{DMatrix, DVector, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::sample::{LargestEntry, angles, derivative, largest, positive, rotation, worst};
use super::{EquationAudit, NUMERIC, ROUNDING, says};

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
}

/// A bar's letters in (7)-(20): `x`, `y`, `z` of its centre, `l`, `r`, and the sines and cosines of
/// its angles.
#[derive(Clone, Copy)]
struct Letters {
    x: f64,
    y: f64,
    z: f64,
    l: f64,
    r: f64,
    s_psi: f64,
    c_psi: f64,
    s_th: f64,
    c_th: f64,
    s_phi: f64,
    c_phi: f64,
}

impl Closed {
    fn letters(&self) -> [Letters; 3] {
        std::array::from_fn(|bar| {
            let [x, y, z] = self.centres[bar].into();
            let (l, r) = (self.lengths[bar], self.levers[bar]);
            let [(s_psi, c_psi), (s_th, c_th), (s_phi, c_phi)] = self.angles[bar].map(f64::sin_cos);
            Letters { x, y, z, l, r, s_psi, c_psi, s_th, c_th, s_phi, c_phi }
        })
    }
}

/// The constraint functions $f_1 \dots f_{12}$ of (7)-(9), (12)-(20) as they are printed, each
/// typed by itself: a misprint in one is a misprint in one.
fn as_printed(closed: &Closed) -> [f64; 12] {
    let [b1, b2, b3] = closed.letters();
    let [x_3, y_3, z_3]: [f64; 3] = closed.joints[3].into();
    [
        b1.x - b1.r * b1.c_th * b1.c_phi,
        b1.y - b1.r * (b1.s_psi * b1.s_th * b1.c_phi + b1.c_psi * b1.s_phi),
        b1.z - b1.r * (-b1.c_psi * b1.s_th * b1.c_phi + b1.s_psi * b1.s_phi),
        b1.x + (b1.l - b1.r) * b1.c_th * b1.c_phi - b2.x + b2.r * b2.c_th * b2.c_phi,
        b1.y + (b1.l - b1.r) * (b1.s_psi * b1.s_th * b1.c_phi + b1.c_psi * b1.s_phi) - b2.y
            + b2.r * (b2.s_psi * b2.s_th * b2.c_phi + b2.c_psi * b2.s_phi),
        b1.z + (b1.l - b1.r) * (-b1.c_psi * b1.s_th * b1.c_phi + b1.s_psi * b1.s_phi) - b2.z
            + b2.r * (-b2.c_psi * b2.s_th * b2.c_phi + b2.s_psi * b2.s_phi),
        b2.x + (b2.l - b2.r) * b2.c_th * b2.c_phi - b3.x + b3.r * b3.c_th * b3.c_phi,
        b2.y + (b2.l - b2.r) * (b2.s_psi * b2.s_th * b2.c_phi + b2.c_psi * b2.s_phi) - b3.y
            + b3.r * (b3.s_psi * b3.s_th * b3.c_phi + b3.c_psi * b3.s_phi),
        b2.z + (b2.l - b2.r) * (-b2.c_psi * b2.s_th * b2.c_phi + b2.s_psi * b2.s_phi) - b3.z
            + b3.r * (-b3.c_psi * b3.s_th * b3.c_phi + b3.s_psi * b3.s_phi),
        b2.x + (b2.l - b2.r) * b2.c_th * b2.c_phi - x_3,
        b2.y + (b2.l - b2.r) * (b2.s_psi * b2.s_th * b2.c_phi + b2.c_psi * b2.s_phi) - y_3,
        b2.z + (b2.l - b2.r) * (-b2.c_psi * b2.s_th * b2.c_phi + b2.s_psi * b2.s_phi) - z_3,
    ]
}

/// The same with the index 3 in (18)-(20).
fn as_corrected(closed: &Closed) -> [f64; 12] {
    let [_, _, b3] = closed.letters();
    let [x_3, y_3, z_3]: [f64; 3] = closed.joints[3].into();
    let mut f = as_printed(closed);
    f[9] = b3.x + (b3.l - b3.r) * b3.c_th * b3.c_phi - x_3;
    f[10] = b3.y + (b3.l - b3.r) * (b3.s_psi * b3.s_th * b3.c_phi + b3.c_psi * b3.s_phi) - y_3;
    f[11] = b3.z + (b3.l - b3.r) * (-b3.c_psi * b3.s_th * b3.c_phi + b3.s_psi * b3.s_phi) - z_3;
    f
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
    let mut rows = vec![says("(6)", "III", "bar 1 begins at O").measured(
        CLOSED,
        apart(|c| at_o(c) - c.joints[0]),
        ROUNDING,
    )];
    let row = |number, f: usize, what| {
        says(number, "III", what).measured(CLOSED, open(|c| as_printed(c)[f - 1]), ROUNDING)
    };
    for (number, f) in [("(7)", 1), ("(8)", 2), ("(9)", 3)] {
        rows.push(row(number, f, "constraint function: bar 1 is held at O"));
    }
    rows.push(says("(10)", "III", "bar 1 ends at A1").measured(
        CLOSED,
        apart(|c| end_1(c) - c.joints[1]),
        ROUNDING,
    ));
    rows.push(says("(11)", "III", "bar 2 begins at A1").measured(
        CLOSED,
        apart(|c| begin_2(c) - c.joints[1]),
        ROUNDING,
    ));
    for (number, f) in [("(12)", 4), ("(13)", 5), ("(14)", 6)] {
        rows.push(row(number, f, "constraint function: bars 1 and 2 meet at A1"));
    }
    for (number, f) in [("(15)", 7), ("(16)", 8), ("(17)", 9)] {
        rows.push(row(number, f, "constraint function: bars 2 and 3 meet at A2"));
    }
    for (number, f) in [("(18)", 10), ("(19)", 11), ("(20)", 12)] {
        let what = "C2, l2, r2 and the angles of bar 2 where bar 3 is held at A3";
        rows.push(row(number, f, what).corrected(
            "the same with the index 3: C3 + (l3 - r3) [A3] e_x = A3",
            open(|c| as_corrected(c)[f - 1]),
            ROUNDING,
        ));
    }
    rows.push(
        says("after (20)", "III", "18 coordinates less 12 constraints: 6 degrees of freedom, 3 of them useless")
            .measured(
                "columns of B less its rank less 6, and twists of a bar that move its ends, 100 random states",
                freedom(),
                ROUNDING,
            ),
    );
    let coordinates = lagrange::load_vector(model::cases::paper().chain()).len();
    rows.push(
        says("(21)", "IV", "the vector of 18 coordinates")
            .counted(
                "entries of lagrange's load vector, one per coordinate, less 18",
                coordinates as f64 - 18.0,
            )
            .definition(),
    );
    rows.push(
        says("(22)", "IV", "the matrix of constraints is the derivative of (7)-(20), with (18)-(20) corrected")
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
        let matrix = lagrange::constraint_matrix(paper.chain(), &q);
        let rank = Kernels::new(&matrix, RANK).map_or(0, |kernels| kernels.rank);
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
            let numeric = derivative(&|t| {
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
    DMatrix::from_column_slice(12, 1, &as_corrected(&state))
}
