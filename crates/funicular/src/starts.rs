//! The two solvers as a sweep runs them: many starts in, many ends out.

use std::sync::Arc;

use model::system::{System, SystemEquilibrium};
use model::{Ends, Problem, Vector};
use sweep::{BatchSolver, Failure, Finds, Solvers};

use crate::followed::{End, Follow};

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
    let lagrange = Named("lagrange", Finds::Equilibria, lagrange, lagrange::batch::Batch::solve);
    let energy = Named("energy", Finds::Minima, energy, energy::batch::Batch::minimise);
    Ok(Solvers::new(vec![Arc::new(lagrange), Arc::new(energy)]))
}

/// A solver by its name, what it looks for, and how it is asked.
#[derive(Debug)]
struct Named<B>(&'static str, Finds, B, fn(&B, &[f64], &mut Ends));

impl<B: std::fmt::Debug + Send + Sync> BatchSolver for Named<B> {
    fn name(&self) -> &'static str {
        self.0
    }

    fn finds(&self) -> Finds {
        self.1
    }

    fn solve(&self, starts_rad: &[f64], ends: &mut Ends) {
        (self.3)(&self.2, starts_rad, ends);
    }
}

/// The two solvers from places of the joints of any system, at random in space.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FromPlaces(pub(crate) validate::Solvers);

impl FromPlaces {
    /// Where these places of the joints lead, m.
    pub(crate) fn from(self, system: &System, places_m: &[Vector]) -> Vec<End> {
        let one = |name| match name {
            "lagrange" => lagrange(system, places_m),
            _ => energy(system, places_m),
        };
        self.names().into_iter().map(one).collect()
    }
}

impl Follow for FromPlaces {
    fn names(&self) -> Vec<&'static str> {
        match self.0 {
            validate::Solvers::Lagrange => vec!["lagrange"],
            validate::Solvers::Energy => vec!["energy"],
            validate::Solvers::Both => vec!["lagrange", "energy"],
        }
    }

    fn follow(&self, system: &System, start: u64) -> Vec<End> {
        self.from(system, &motion::random_places(system, start))
    }
}

fn lagrange(system: &System, places_m: &[Vector]) -> End {
    use lagrange::net::{Error, Seed, solve_from};
    match solve_from(system, &Seed::at(places_m.to_vec()), &lagrange::net::Settings::default()) {
        Ok(found) => end(found.equilibrium),
        // It ends where no step helps.
        Err(Error::NotConverged { iterations, .. }) => after(iterations, Failure::Stalled),
        Err(Error::Work { .. }) => End::failed(Failure::IterationLimit),
        Err(_) => End::failed(Failure::Stalled),
    }
}

fn energy(system: &System, places_m: &[Vector]) -> End {
    use energy::net::{Error, minimise_from};
    match minimise_from(system, places_m, &energy::net::Settings::default()) {
        Ok(found) => end(found.equilibrium),
        Err(Error::IterationLimit { iterations, .. }) => after(iterations, Failure::IterationLimit),
        Err(Error::Work { .. }) => End::failed(Failure::IterationLimit),
        Err(_) => End::failed(Failure::Stalled),
    }
}

/// A failure with the steps it took.
fn after(steps: impl TryInto<u16>, failure: Failure) -> End {
    End { steps: steps.try_into().unwrap_or(u16::MAX), ..End::failed(failure) }
}

fn end(found: SystemEquilibrium) -> End {
    End {
        steps: u16::try_from(found.evidence.iterations).unwrap_or(u16::MAX),
        residual: found.evidence.residual,
        energy_j: found.energy_j,
        index: Some(found.stability.index_in_space),
        joints_m: Ok(found.joints_m),
    }
}
