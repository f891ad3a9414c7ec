//! The evidence ladder: how far an equilibrium is proved.

use serde::{Deserialize, Serialize};

/// The rungs, lowest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Rung {
    /// A solver's own residual is below its tolerance.
    Converged,
    /// Both solvers agree, and the statics judge finds every bar in balance.
    Agreed,
    /// Interval arithmetic proves that exactly one equilibrium lies in a stated box.
    Verified,
    /// A census proves that there is no other equilibrium outside the listed boxes.
    Complete,
    /// A certificate proves that no configuration has less energy.
    Optimal,
}

impl Rung {
    /// All rungs, lowest first.
    pub const ALL: [Self; 5] =
        [Self::Converged, Self::Agreed, Self::Verified, Self::Complete, Self::Optimal];
}

impl std::fmt::Display for Rung {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Converged => "converged",
            Self::Agreed => "agreed",
            Self::Verified => "verified",
            Self::Complete => "complete",
            Self::Optimal => "optimal",
        })
    }
}

/// What is known about one rung.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statement {
    /// The rung.
    pub rung: Rung,
    /// Whether it was reached.
    pub reached: bool,
    /// How it was reached, or why not.
    pub how: String,
}

/// How far an equilibrium is proved, and what it cost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evidence {
    rung: Rung,
    /// The solver's own residual, dimensionless; see `residual_of`.
    pub residual: f64,
    /// What the residual measures and in which units.
    pub residual_of: String,
    /// Iterations of the solver.
    pub iterations: usize,
    /// Dimension of the null space of the solver's own system at the solution.
    pub nullity: usize,
    /// Ratio of the largest to the smallest non-zero singular value of that system, scaled to the
    /// solver's units.
    pub condition: f64,
    /// Time of the solver alone, s.
    pub solve_s: f64,
    ladder: Vec<Statement>,
}

impl Evidence {
    /// Evidence of a solver that has converged, and of nothing more.
    #[must_use]
    pub fn converged(residual: f64, residual_of: impl Into<String>, iterations: usize) -> Self {
        let residual_of = residual_of.into();
        let ladder = Rung::ALL
            .into_iter()
            .map(|rung| Statement {
                rung,
                reached: rung == Rung::Converged,
                how: if rung == Rung::Converged {
                    format!("{residual_of}: {residual:.1e} after {iterations} iterations")
                } else {
                    "not tried".to_owned()
                },
            })
            .collect();
        Self {
            rung: Rung::Converged,
            residual,
            residual_of,
            iterations,
            nullity: 0,
            condition: 1.0,
            solve_s: 0.0,
            ladder,
        }
    }

    /// The highest rung reached.
    #[must_use]
    pub fn rung(&self) -> Rung {
        self.rung
    }

    /// One statement per rung, lowest first.
    #[must_use]
    pub fn ladder(&self) -> &[Statement] {
        &self.ladder
    }

    /// Record that a rung was reached, and how.
    pub fn reach(&mut self, rung: Rung, how: impl Into<String>) {
        self.state(rung, true, how.into());
    }

    /// Record that a rung was not reached, and why.
    pub fn miss(&mut self, rung: Rung, why: impl Into<String>) {
        self.state(rung, false, why.into());
    }

    fn state(&mut self, rung: Rung, reached: bool, how: String) {
        for statement in &mut self.ladder {
            if statement.rung == rung {
                *statement = Statement { rung, reached, how };
                break;
            }
        }
        let highest = self.ladder.iter().filter(|s| s.reached).map(|s| s.rung).max();
        // `converged` is what this type starts from: without it there is no equilibrium to speak of.
        self.rung = highest.unwrap_or(Rung::Converged);
    }
}
