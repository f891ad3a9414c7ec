//! Section VIII, solution 2: eqs. (xi)-(xxvi).

use nalgebra::{DMatrix, DVector};
use rand::RngExt;

use super::equilibrium::{coordinates, load, planar, reactions};
use super::minimum::closure;
use super::sample::{LargestEntry, angles, largest, worst};
use super::{E1State, EquationAudit, ROUNDING, SOLVED, says};

/// A printed entry of the matrix of constraints, l = 1; bars from 1.
#[derive(Debug, Clone, Copy)]
enum Printed {
    Number(f64),
    Cos(f64, usize),
    Sin(f64, usize),
}
use Printed::{Cos, Number, Sin};

const HALF: f64 = 0.5;

/// The entries of one row: column, counted from 1, and value.
type Entries = &'static [(usize, Printed)];

/// The entries (xi)-(xxii) as printed: number, row (counted from 1) and entries.
const ENTRIES: [(&str, usize, Entries); 12] = [
    ("(xi)", 1, &[(1, Number(1.0)), (5, Cos(HALF, 1))]),
    ("(xii)", 2, &[(2, Number(1.0)), (4, Cos(-HALF, 1)), (6, Cos(-HALF, 1))]),
    ("(xiii)", 3, &[(3, Number(1.0)), (4, Sin(-HALF, 1)), (6, Sin(-HALF, 1))]),
    ("(xiv)", 4, &[(1, Number(1.0)), (5, Cos(-HALF, 1)), (7, Number(-1.0)), (11, Cos(-HALF, 2))]),
    (
        "(xv)",
        5,
        &[
            (2, Number(1.0)),
            (4, Cos(HALF, 1)),
            (6, Cos(HALF, 1)),
            (8, Number(-1.0)),
            (10, Cos(HALF, 2)),
            (12, Cos(HALF, 2)),
        ],
    ),
    (
        "(xvi)",
        6,
        &[
            (3, Number(1.0)),
            (4, Sin(HALF, 1)),
            (6, Sin(HALF, 1)),
            (9, Number(-1.0)),
            (10, Sin(HALF, 2)),
            (12, Sin(HALF, 2)),
        ],
    ),
    (
        "(xvii)",
        7,
        &[(7, Number(1.0)), (11, Cos(-HALF, 2)), (13, Number(-1.0)), (17, Cos(-HALF, 3))],
    ),
    (
        "(xviii)",
        8,
        &[
            (8, Number(1.0)),
            (10, Cos(HALF, 2)),
            (12, Cos(HALF, 2)),
            (14, Number(-1.0)),
            (16, Cos(HALF, 3)),
            (18, Cos(HALF, 3)),
        ],
    ),
    (
        "(xix)",
        9,
        &[
            (9, Number(1.0)),
            (10, Sin(HALF, 2)),
            (12, Sin(HALF, 2)),
            (15, Number(-1.0)),
            (16, Sin(HALF, 3)),
            (18, Sin(HALF, 3)),
        ],
    ),
    ("(xx)", 10, &[(13, Number(1.0)), (17, Cos(-HALF, 3))]),
    ("(xxi)", 11, &[(14, Number(1.0)), (16, Cos(HALF, 3)), (18, Cos(HALF, 3))]),
    ("(xxii)", 12, &[(15, Number(1.0)), (16, Sin(HALF, 3)), (18, Sin(HALF, 3))]),
];

/// The matrix of constraints that (xi)-(xxii) print; what they do not print is zero.
fn printed_matrix(phi: [f64; 3]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(12, 18);
    for (_, row, entries) in ENTRIES {
        for &(column, entry) in entries {
            matrix[(row - 1, column - 1)] = match entry {
                Number(value) => value,
                Cos(factor, bar) => factor * phi[bar - 1].cos(),
                Sin(factor, bar) => factor * phi[bar - 1].sin(),
            };
        }
    }
    matrix
}

/// Row of theta_1 in (xxiii), from 0.
const THETA_1: usize = 4;

/// The left-hand sides of (xxiii) as printed, less the right-hand sides, in mg.
fn printed_system(phi: [f64; 3], lambda: &DVector<f64>) -> DVector<f64> {
    let matrix = printed_matrix(phi);
    let b = |i: usize, j: usize| matrix[(i - 1, j - 1)];
    let l = |k: usize| lambda[k - 1];
    DVector::from_column_slice(&[
        -l(1) - l(4),
        -l(2) - l(5),
        -l(3) - l(6) + 1.0,
        -b(2, 4) * l(2) - b(3, 4) * l(3) - b(5, 4) * l(5) - b(6, 4) * l(6),
        -b(4, 5) * l(4),
        -b(2, 6) * l(2) - b(3, 6) * l(3) - b(5, 6) * l(5) - b(6, 6) * l(6),
        l(4) - l(7),
        l(5) - l(8),
        l(6) - l(9) + 1.0,
        -b(5, 10) * l(5) - b(6, 10) * l(6) - b(8, 10) * l(8) - b(9, 10) * l(9),
        -b(4, 11) * l(4) - b(7, 11) * l(7),
        -b(5, 12) * l(5) - b(6, 12) * l(6) - b(8, 12) * l(8) - b(9, 12) * l(9),
        l(7) - l(10),
        l(8) - l(11),
        l(9) - l(12) + 1.0,
        -b(8, 16) * l(8) - b(9, 16) * l(9) - b(11, 16) * l(11) - b(12, 16) * l(12),
        -b(7, 17) * l(7) - b(10, 17) * l(10),
        -b(8, 18) * l(8) - b(9, 18) * l(9) - b(11, 18) * l(11) - b(12, 18) * l(12),
    ])
}

/// Rows of (xxiii) against (40) with lagrange's matrix, at random angles and multipliers, mg.
fn system_error(theta_1: bool, add_dropped: bool) -> f64 {
    worst(|rng| {
        let phi = angles(rng);
        let lambda = DVector::from_fn(12, |_, _| rng.random_range(-2.0..2.0));
        let mut printed = printed_system(phi, &lambda);
        if add_dropped {
            printed[THETA_1] -= printed_matrix(phi)[(0, 4)] * lambda[0];
        }
        let difference = printed - (reactions(&planar(phi), &lambda) - load(true));
        largest((0..18).filter(|&row| (row == THETA_1) == theta_1).map(|row| difference[row]))
    })
}

/// Rows of (xi)-(xxii) against lagrange's matrix.
fn entries() -> impl Iterator<Item = EquationAudit> {
    ENTRIES.into_iter().map(|(number, row, _)| {
        let paper = model::cases::paper();
        let error = worst(|rng| {
            let phi = angles(rng);
            let matrix = lagrange::constraint_matrix(paper.chain(), &planar(phi));
            (printed_matrix(phi).row(row - 1) - matrix.row(row - 1)).largest_entry()
        });
        let what = if row < 10 {
            "entries of the matrix of constraints"
        } else {
            "entries of the matrix of constraints: those of bar 3, which (18)-(20) as printed do not give"
        };
        says(number, "VIII", what).measured(
            "largest difference of the whole row from lagrange's matrix, 1000 random angles, l",
            error,
            ROUNDING,
        )
    })
}

/// Eqs. (xxiv) at E1.
fn reduced(e1: &E1State) -> Vec<EquationAudit> {
    let l = |k: usize| e1.lambda(k);
    let [(s_1, c_1), (s_2, c_2), (s_3, c_3)] = e1.angles().map(f64::sin_cos);
    let balances = [
        l(2) + l(5),
        l(3) + l(6) - 1.0,
        l(2) * c_1 + l(3) * s_1 - l(5) * c_1 - l(6) * s_1,
        l(5) - l(8),
        l(6) - l(9) + 1.0,
        l(8) - l(11),
        l(9) - l(12) + 1.0,
    ];
    let second = |sign: f64| sign * l(5) * c_2 - l(6) * s_2 - l(8) * c_2 - l(9) * s_2;
    let (at_b, at_d) = (-l(8) * c_3 - l(9) * s_3, -l(11) * c_3 - l(12) * s_3);
    let whole = "-lambda_8 cos(phi_3) - lambda_9 sin(phi_3) - lambda_11 cos(phi_3) - lambda_12 sin(phi_3) = 0";
    // (xxiv) to (xxvi) in eight multipliers and three angles.
    let unknowns = 8.0 + 3.0;
    let others = balances.len() as f64 + 1.0 + 2.0;
    vec![
        says("(xxiv)", "VIII", "the balances of forces and the row of phi_1")
            .measured("largest residual at E1, mg", largest(balances), SOLVED),
        says("(xxiv)", "VIII", "row of phi_2: the sign of lambda_5 cos(phi_2)")
            .measured("residual at E1, mg", second(1.0), SOLVED)
            .corrected(
                "-lambda_5 cos(phi_2) - lambda_6 sin(phi_2) - lambda_8 cos(phi_2) - lambda_9 sin(phi_2) = 0",
                second(-1.0),
                SOLVED,
            ),
        says("(xxiv)", "VIII", "row of phi_3 split into two equations: the half with lambda_8 and lambda_9")
            .measured("residual at E1, mg", at_b, SOLVED)
            .corrected(whole, at_b + at_d, SOLVED),
        says("(xxiv)", "VIII", "row of phi_3 split into two equations: the half with lambda_11 and lambda_12")
            .measured("residual at E1, mg", at_d, SOLVED)
            .corrected(whole, at_b + at_d, SOLVED),
        says("(xxiv)-(xxvi)", "VIII", "the split makes it one equation more than unknowns")
            .counted("equations less unknowns", others + 2.0 - unknowns)
            .corrected("11 equations in 8 multipliers and 3 angles", others + 1.0 - unknowns, ROUNDING),
    ]
}

pub(super) fn rows(e1: &E1State) -> Vec<EquationAudit> {
    let [down, aside] = closure(e1.angles(), 2.0);
    let rows_of_40 = "largest difference of a row from (40), random angles and multipliers up to 2 mg, 1000 states, mg";
    let mut rows = coordinates(e1).to_vec();
    rows.extend(entries());
    rows.extend([
        says("(xxiii)", "VIII", "the rows other than that of theta_1").measured(
            rows_of_40,
            system_error(false, false),
            ROUNDING,
        ),
        says("(xxiii)", "VIII", "row of theta_1 drops b_{1,5} lambda_1")
            .measured(rows_of_40, system_error(true, false), ROUNDING)
            .corrected(
                "-b_{1,5} lambda_1 - b_{4,5} lambda_4 = 0",
                system_error(true, true),
                ROUNDING,
            ),
        says("after (xxiii)", "VIII", "lambda_1, lambda_4, lambda_7 and lambda_10 are zero")
            .measured(
                "largest of them at E1, mg",
                largest([1, 4, 7, 10].map(|k| e1.lambda(k))),
                SOLVED,
            ),
    ]);
    rows.extend(reduced(e1));
    rows.extend([
        says("(xxv)", "VIII", "(iii)").measured("residual at E1", down, SOLVED),
        says("(xxvi)", "VIII", "(iv)").measured("residual at E1", aside, SOLVED),
        says(
            "after (xxvi)",
            "VIII",
            "the multipliers are the reactions: the two anchors carry the three weights",
        )
        .measured(
            "lambda_3 + lambda_12 - 3 and lambda_2 + lambda_11 at E1, mg",
            largest([e1.lambda(3) + e1.lambda(12) - 3.0, e1.lambda(2) + e1.lambda(11)]),
            SOLVED,
        ),
    ]);
    rows
}
