//! The two solvers as a sweep runs them: many starts in, many ends out.

use std::sync::Arc;

use model::{Ends, Problem};
use sweep::{BatchSolver, Finds, Solvers};

/// Why a solver cannot be made ready for a sweep.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolversError {
    /// Occurs when a setting of the first solver is out of range.
    #[error("lagrange: {0}")]
    Lagrange(#[from] lagrange::SettingsError),
    /// Occurs when a setting of the second solver is out of range.
    #[error("energy: {0}")]
    Energy(#[from] energy::Error),
}

/// Both solvers of a problem, `lagrange` first.
///
/// # Errors
///
/// [`SolversError`]; with the default settings there is none.
///
/// ```
/// use sweep::{Settings, Sweep};
/// let problem = model::cases::paper();
/// let sweep = Sweep::new(&problem, Settings::default(), funicular::starts::solvers(&problem)?)?;
/// let summary = sweep.run(0..2000, 2)?;
/// let lagrange = summary.tally().of("lagrange").ok_or("not asked")?;
/// // The four equilibria of the census, and nothing else.
/// assert_eq!(lagrange.0.keys().copied().collect::<Vec<_>>(), [0, 1, 2, 3]);
/// assert_eq!(lagrange.0.values().map(|row| row.count).sum::<u64>(), 2000);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solvers(problem: &Problem) -> Result<Solvers, SolversError> {
    let lagrange = lagrange::batch::Batch::new(problem, lagrange::batch::BatchSettings::default())?;
    let energy = energy::batch::Batch::new(problem, energy::batch::BatchSettings::default())?;
    Ok(Solvers::new(vec![Arc::new(Lagrange(lagrange)), Arc::new(Energy(energy))]))
}

#[derive(Debug)]
struct Lagrange(lagrange::batch::Batch);

impl BatchSolver for Lagrange {
    fn name(&self) -> &'static str {
        "lagrange"
    }

    fn finds(&self) -> Finds {
        Finds::Equilibria
    }

    fn solve(&self, starts_rad: &[f64], ends: &mut Ends) {
        self.0.solve(starts_rad, ends);
    }
}

#[derive(Debug)]
struct Energy(energy::batch::Batch);

impl BatchSolver for Energy {
    fn name(&self) -> &'static str {
        "energy"
    }

    fn finds(&self) -> Finds {
        Finds::Minima
    }

    fn solve(&self, starts_rad: &[f64], ends: &mut Ends) {
        self.0.minimise(starts_rad, ends);
    }
}
