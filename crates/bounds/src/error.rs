//! Why there is no bound.

/// What clarabel says at its end. Only [`Solved`](Self::Solved) is a solution; every other one is
/// an error here.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ConeStatus {
    /// Residuals and gap are below the tolerances.
    Solved,
    /// They are below the reduced tolerances only.
    AlmostSolved,
    /// There seems to be no feasible point. The programmes here always have one.
    Infeasible,
    /// The iteration limit was reached.
    IterationLimit,
    /// The time limit was reached.
    TimeLimit,
    /// The linear algebra broke down, or the steps became too short.
    Stalled,
    /// The solver was stopped, or never ran.
    NotRun,
}

impl From<clarabel::solver::SolverStatus> for ConeStatus {
    fn from(status: clarabel::solver::SolverStatus) -> Self {
        use clarabel::solver::SolverStatus as Theirs;
        match status {
            Theirs::Solved => Self::Solved,
            Theirs::AlmostSolved => Self::AlmostSolved,
            Theirs::PrimalInfeasible
            | Theirs::DualInfeasible
            | Theirs::AlmostPrimalInfeasible
            | Theirs::AlmostDualInfeasible => Self::Infeasible,
            Theirs::MaxIterations => Self::IterationLimit,
            Theirs::MaxTime => Self::TimeLimit,
            Theirs::NumericalError | Theirs::InsufficientProgress => Self::Stalled,
            Theirs::Unsolved | Theirs::CallbackTerminated => Self::NotRun,
        }
    }
}

impl std::fmt::Display for ConeStatus {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Solved => "solved",
            Self::AlmostSolved => "solved to reduced accuracy only",
            Self::Infeasible => "infeasible",
            Self::IterationLimit => "iteration limit reached",
            Self::TimeLimit => "time limit reached",
            Self::Stalled => "stalled",
            Self::NotRun => "stopped",
        })
    }
}

/// Why there is no bound.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BoundError {
    /// Occurs when a setting is out of its range.
    #[error("{setting} must be {range}, got {value}")]
    Setting {
        /// Name of the setting.
        setting: &'static str,
        /// What is allowed.
        range: &'static str,
        /// What was given.
        value: f64,
    },
    /// Occurs when a system has a strut, which no convex programme knows.
    #[error("member {member} is a strut, and the least energy of struts is no convex problem")]
    Strut {
        /// Number of the member, from 1.
        member: usize,
    },
    /// Occurs when clarabel does not accept the programme, which would be a bug here.
    #[error("the cone programme was not accepted")]
    Refused(#[source] Box<clarabel::solver::SolverError>),
    /// Occurs when clarabel ends without a solution; "almost solved" is not one.
    #[error(
        "the cone programme was not solved: {status}, after {iterations} iterations, \
         primal residual {primal_residual:.1e}, dual residual {dual_residual:.1e}"
    )]
    NotSolved {
        /// How it ended.
        status: ConeStatus,
        /// Iterations done.
        iterations: usize,
        /// Relative primal residual.
        primal_residual: f64,
        /// Relative dual residual.
        dual_residual: f64,
    },
    /// Occurs when a shared library of the process defines routines of the BLAS or LAPACK under the
    /// names by which the cone solver calls ours: which of the two answers is not known.
    #[error("{library} has routines of the names that the cone solver is to call here")]
    OtherLapack {
        /// Its file.
        library: String,
    },
    /// Occurs when rounding the dual solution to a rigorous bound fails: the stress matrix is not
    /// positive semidefinite even after raising the force densities. A solved programme does not
    /// lead here unless its numbers differ by more orders of magnitude than doubles resolve.
    #[error("the dual solution could not be rounded to a rigorous bound")]
    NotCertified,
}

#[cfg(test)]
mod tests {
    use super::*;
    use clarabel::solver::SolverStatus as Theirs;

    /// Only one of clarabel's statuses is a solution.
    #[test]
    fn almost_solved_is_not_solved() {
        let mapped = [
            (Theirs::Solved, ConeStatus::Solved),
            (Theirs::AlmostSolved, ConeStatus::AlmostSolved),
            (Theirs::PrimalInfeasible, ConeStatus::Infeasible),
            (Theirs::AlmostPrimalInfeasible, ConeStatus::Infeasible),
            (Theirs::DualInfeasible, ConeStatus::Infeasible),
            (Theirs::AlmostDualInfeasible, ConeStatus::Infeasible),
            (Theirs::MaxIterations, ConeStatus::IterationLimit),
            (Theirs::MaxTime, ConeStatus::TimeLimit),
            (Theirs::NumericalError, ConeStatus::Stalled),
            (Theirs::InsufficientProgress, ConeStatus::Stalled),
            (Theirs::Unsolved, ConeStatus::NotRun),
            (Theirs::CallbackTerminated, ConeStatus::NotRun),
        ];
        for (theirs, ours) in mapped {
            assert_eq!(ConeStatus::from(theirs), ours);
            assert_eq!(ours == ConeStatus::Solved, theirs == Theirs::Solved);
            assert!(!ours.to_string().is_empty());
        }
    }
}
