//! A cone programme, row by row, and its solution by clarabel.
//!
//! clarabel minimises $q \cdot x + \tfrac12 x \cdot P x$ subject to $A x + s = b$, s in a product of
//! cones. Every row here is written as what s is: an affine function of the variables.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolution, DefaultSolver, IPSolver, SolverError, SolverStatus,
    SupportedConeT,
};

/// Interior point iterations before it is given up; 10 to 30 are usual.
const MOST_ITERATIONS: u32 = 200;

/// Relative tolerance of the residuals and of the duality gap: about the least that is reached on
/// every net of the tests.
const TOLERANCE: f64 = 1e-9;

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ConeError {
    /// Occurs when a member, by its number from 1, is a rope over rings or pulleys.
    #[error("member {0} is a rope over rings or pulleys, which this programme does not take")]
    Rope(usize),
    /// Occurs when a member, by its number from 1, is a strut, which no convex programme knows.
    #[error("member {0} is a strut, and the least energy of struts is not a convex problem")]
    Strut(usize),
    /// Occurs when clarabel does not accept the programme, which would be a bug here.
    #[error("the cone programme was not accepted")]
    Refused(#[source] Box<SolverError>),
    /// Occurs when clarabel ends without a solution; "almost solved" is not one.
    #[error(
        "the cone programme was not solved: {status}, after {iterations} iterations, \
         primal residual {primal_residual:.1e}, dual residual {dual_residual:.1e}"
    )]
    NotSolved {
        /// How it ended.
        status: SolverStatus,
        /// Iterations done.
        iterations: u32,
        /// Relative primal residual.
        primal_residual: f64,
        /// Relative dual residual.
        dual_residual: f64,
    },
}

/// `constant + Σ coefficient · variable`.
#[derive(Debug, Clone)]
pub(super) struct Affine {
    pub(super) constant: f64,
    pub(super) terms: Vec<(usize, f64)>,
}

/// A programme under construction.
#[derive(Debug, Default)]
pub(super) struct Program {
    cost: Vec<f64>,
    /// Variables with a quadratic cost, and its second derivative.
    curves: Vec<(usize, f64)>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    constants: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

impl Program {
    /// With variables of these costs.
    pub(super) fn minimise(cost: Vec<f64>) -> Self {
        Self { cost, ..Self::default() }
    }

    /// One more variable, that costs `curvature / 2` times its square.
    pub(super) fn variable(&mut self, curvature: f64) -> usize {
        let variable = self.cost.len();
        self.cost.push(0.0);
        self.curves.push((variable, curvature));
        variable
    }

    fn row(&mut self, entry: &Affine) {
        let row = self.constants.len();
        self.constants.push(entry.constant);
        for (variable, coefficient) in &entry.terms {
            self.rows.push(row);
            self.columns.push(*variable);
            self.values.push(-coefficient);
        }
    }

    /// The entry is zero or positive.
    pub(super) fn positive(&mut self, entry: &Affine) {
        self.row(entry);
        self.cones.push(SupportedConeT::NonnegativeConeT(1));
    }

    /// |(s_1, s_2, ...)| ≤ s_0. Returns the first row.
    pub(super) fn second_order(&mut self, entries: &[Affine]) -> usize {
        let first = self.constants.len();
        for entry in entries {
            self.row(entry);
        }
        self.cones.push(SupportedConeT::SecondOrderConeT(entries.len()));
        first
    }

    /// Solve it.
    pub(super) fn solve(self) -> Result<DefaultSolution<f64>, ConeError> {
        let variables = self.cost.len();
        let matrix = CscMatrix::new_from_triplets(
            self.constants.len(),
            variables,
            self.rows,
            self.columns,
            self.values,
        );
        let (at, curvatures): (Vec<usize>, Vec<f64>) = self.curves.into_iter().unzip();
        let quadratic =
            CscMatrix::new_from_triplets(variables, variables, at.clone(), at, curvatures);
        let settings = DefaultSettings {
            max_iter: MOST_ITERATIONS,
            tol_gap_abs: TOLERANCE,
            tol_gap_rel: TOLERANCE,
            tol_feas: TOLERANCE,
            verbose: false,
            max_threads: 1,
            ..DefaultSettings::default()
        };
        let mut solver = DefaultSolver::new(
            &quadratic, &self.cost, &matrix, &self.constants, &self.cones, settings,
        )
        .map_err(|error| ConeError::Refused(Box::new(error)))?;
        solver.solve();
        let solution = solver.solution;
        if solution.status == SolverStatus::Solved {
            return Ok(solution);
        }
        Err(ConeError::NotSolved {
            status: solution.status,
            iterations: solution.iterations,
            primal_residual: solution.r_prim,
            dual_residual: solution.r_dual,
        })
    }
}
