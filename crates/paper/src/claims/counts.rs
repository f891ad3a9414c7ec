//! How many equations, unknowns and freedoms: counted on the matrices of `lagrange`.

use lagrange::{constraint_matrix, direction_gradient, jacobian, residual, spin};
use matrices::dense::Kernels;
use nalgebra::DVector;

use super::{Facts, Finding};
use crate::printed::{Assessment, Printed};

/// The largest number of a displayed equation in the paper's text (before the example's roman
/// ones).
const LAST_EQUATION: f64 = 41.0;

/// Angles of a position without symmetry, rad: counts of non-zero entries and ranks hold there as
/// almost everywhere.
const GENERIC: [[f64; 3]; 3] = [[0.3, 0.4, -0.7], [1.1, -0.6, 0.2], [-0.5, 0.9, 1.3]];

/// Entries and singular values below this part of the largest are zero.
const ZERO: f64 = 1e-12;

pub(super) fn judge(facts: &Facts, printed: &Printed) -> Option<Finding> {
    let chain = facts.example.problem.chain();
    let bars = GENERIC.iter().zip(1..);
    let q =
        bars.flat_map(|([psi, theta, phi], k)| [0.1 * f64::from(k), 0.2, -0.3, *psi, *theta, *phi]);
    let q = DVector::from_vec(q.collect());
    let lambda =
        DVector::from_fn(facts.example.lagrange.e1.lambda.len(), |k, _| 1.0 + 0.1 * k as f64);
    let counted = |found: usize, what: &str| {
        let found = found as f64;
        let missing = (found - printed.value()).abs();
        let verdict = Assessment::Corrected.unless(missing < 0.5);
        Some(Finding::new(verdict, missing, what).lagrange(found))
    };
    match printed.id.as_str() {
        "abstract-18" => counted(
            residual(chain, &q, &lambda).len(),
            "equations missing: the constraint functions (section VII has all)",
        ),
        "parameters" => counted(q.len(), "difference to the length of {q}"),
        "multipliers" => counted(
            constraint_matrix(chain, &q).nrows(),
            "difference to the rows of the matrix of constraints",
        ),
        "freedom" => {
            let b = constraint_matrix(chain, &q);
            counted(
                b.ncols() - Kernels::new(&b, ZERO)?.rank,
                "difference to the columns of B less its rank",
            )
        }
        "useless" => {
            // A turn about its own axis moves no point of a bar.
            let still = GENERIC.iter().filter(|[psi, theta, phi]| {
                let axis = spin(*theta, *phi);
                let moved = direction_gradient(*psi, *theta, *phi) * axis;
                moved.norm() <= ZERO && axis.norm() > ZERO
            });
            counted(still.count(), "difference to the bars whose spin changes nothing")
        }
        "equations-40" => counted(
            residual(chain, &q, &lambda).len() - lambda.len(),
            "difference to the rows of -B^T lambda - T",
        ),
        "unknowns-40" => {
            let all = jacobian(chain, &q, &lambda);
            let rows = all.rows(0, q.len());
            let largest = rows.amax();
            let met = rows.column_iter().filter(|column| column.amax() > ZERO * largest).count();
            counted(met, "difference to the columns of its derivative that are not zero")
        }
        "system-30" => {
            let all = jacobian(chain, &q, &lambda);
            let square = all.is_square().then_some(all.nrows())?;
            counted(square, "difference to the size of the square Jacobian")
        }
        "reference-45" | "reference-52" => {
            let beyond = printed.value() - LAST_EQUATION;
            let verdict = if beyond > 0.5 { Assessment::Corrected } else { Assessment::Confirmed };
            let what = if printed.id == "reference-45" {
                "numbers beyond the last equation, (41); (33) is meant"
            } else {
                "numbers beyond the last equation, (41); (40) is meant"
            };
            Some(Finding::new(verdict, beyond, what))
        }
        _ => None,
    }
}
