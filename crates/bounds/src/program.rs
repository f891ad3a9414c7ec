//! A cone programme, row by row, and its solution by clarabel.
//!
//! clarabel minimises $q \cdot x$ subject to $A x + s = b$, s in a product of cones. Every row here
//! is written as what s is: an affine function of the variables.
//!
//! # References
//!
//! P. J. Goulart, Y. Chen, Clarabel: an interior-point solver for conic programs with quadratic
//! objectives, 2024, arXiv:2405.12762.

use std::time::Instant;

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolution, DefaultSolver, IPSolver, SupportedConeT};

use crate::error::{BoundError, ConeStatus};
use crate::settings::BoundSettings;

/// `constant + Σ coefficient · variable`.
#[derive(Debug, Clone, Default)]
pub(crate) struct Affine {
    pub(crate) constant: f64,
    pub(crate) terms: Vec<(usize, f64)>,
}

impl Affine {
    pub(crate) fn new<const N: usize>(constant: f64, terms: [(usize, f64); N]) -> Self {
        Self { constant, terms: terms.into() }
    }

    /// Plus a coefficient times a variable.
    #[cfg(feature = "sdp")]
    pub(crate) fn with(mut self, variable: usize, coefficient: f64) -> Self {
        self.terms.push((variable, coefficient));
        self
    }
}

/// A programme under construction.
#[derive(Debug, Default)]
pub(crate) struct Program {
    cost: Vec<f64>,
    /// Variables with a quadratic cost, and its second derivative.
    curves: Vec<(usize, f64)>,
    rows: Vec<usize>,
    columns: Vec<usize>,
    values: Vec<f64>,
    constants: Vec<f64>,
    cones: Vec<SupportedConeT<f64>>,
}

/// How a programme was solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ConeEvidence {
    /// How clarabel judges its own solution.
    pub status: ConeStatus,
    /// Interior point iterations.
    pub iterations: usize,
    /// Relative primal residual at the end.
    pub primal_residual: f64,
    /// Relative dual residual at the end.
    pub dual_residual: f64,
    /// Time of the solver, set-up included, s.
    pub solve_s: f64,
}

impl ConeEvidence {
    /// `Ok` when the programme is solved, or when what was made of its last iterate is proved to be
    /// the optimum anyway: the proof asks nothing of the solver.
    pub(crate) fn accept(&self, proved: bool) -> Result<(), BoundError> {
        if proved || self.status == ConeStatus::Solved {
            return Ok(());
        }
        Err(BoundError::NotSolved {
            status: self.status,
            iterations: self.iterations,
            primal_residual: self.primal_residual,
            dual_residual: self.dual_residual,
        })
    }
}

impl Program {
    /// With variables of these costs.
    pub(crate) fn minimise(cost: Vec<f64>) -> Self {
        Self { cost, ..Self::default() }
    }

    fn row(&mut self, scale: f64, entry: &Affine) {
        let row = self.constants.len();
        self.constants.push(scale * entry.constant);
        for (variable, coefficient) in &entry.terms {
            self.rows.push(row);
            self.columns.push(*variable);
            self.values.push(-scale * coefficient);
        }
    }

    /// Plus `curvature / 2` times the square of a variable, which has no such cost yet.
    pub(crate) fn curve(&mut self, variable: usize, curvature: f64) {
        self.curves.push((variable, curvature));
    }

    /// The entry is zero or positive.
    pub(crate) fn positive(&mut self, entry: &Affine) {
        self.row(1.0, entry);
        self.cones.push(SupportedConeT::NonnegativeConeT(1));
    }

    /// |(s_1, s_2, ...)| ≤ s_0. Returns the first row.
    pub(crate) fn second_order(&mut self, entries: &[Affine]) -> usize {
        let first = self.constants.len();
        for entry in entries {
            self.row(1.0, entry);
        }
        self.cones.push(SupportedConeT::SecondOrderConeT(entries.len()));
        first
    }

    /// The symmetric matrix with this upper triangle, column by column, is positive semidefinite.
    /// Returns the first row.
    #[cfg(feature = "sdp")]
    pub(crate) fn semidefinite(&mut self, columns: &[&[Affine]]) -> usize {
        let first = self.constants.len();
        for column in columns {
            for (i, entry) in column.iter().enumerate() {
                let diagonal = i + 1 == column.len();
                self.row(if diagonal { 1.0 } else { std::f64::consts::SQRT_2 }, entry);
            }
        }
        self.cones.push(SupportedConeT::PSDTriangleConeT(columns.len()));
        first
    }

    /// Solve it.
    pub(crate) fn solve(
        self,
        settings: &BoundSettings,
    ) -> Result<(DefaultSolution<f64>, ConeEvidence), BoundError> {
        settings.validate()?;
        let clock = Instant::now();
        let variables = self.cost.len();
        let matrix = CscMatrix::new_from_triplets(
            self.constants.len(),
            variables,
            self.rows,
            self.columns,
            self.values,
        );
        let theirs = DefaultSettings {
            max_iter: settings.max_iterations,
            tol_gap_abs: settings.tolerance,
            tol_gap_rel: settings.tolerance,
            tol_feas: settings.tolerance,
            verbose: false,
            max_threads: 1,
            ..DefaultSettings::default()
        };
        let (at, curvatures): (Vec<usize>, Vec<f64>) = self.curves.into_iter().unzip();
        let quadratic =
            CscMatrix::new_from_triplets(variables, variables, at.clone(), at, curvatures);
        let mut solver = DefaultSolver::new(
            &quadratic,
            &self.cost,
            &matrix,
            &self.constants,
            &self.cones,
            theirs,
        )
        .map_err(|error| BoundError::Refused(Box::new(error)))?;
        solver.solve();
        let solution = solver.solution;
        let evidence = ConeEvidence {
            status: ConeStatus::from(solution.status),
            iterations: solution.iterations as usize,
            primal_residual: solution.r_prim,
            dual_residual: solution.r_dual,
            solve_s: clock.elapsed().as_secs_f64(),
        };
        Ok((solution, evidence))
    }
}
