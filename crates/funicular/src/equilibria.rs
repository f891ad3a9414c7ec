//! The equilibria of a problem, all of them where a census is complete.

use model::system::{System, SystemEquilibrium};
use model::{Equilibrium, Vector};

use crate::census::{Census, CensusAnswer};
use crate::error::Error;
use crate::problem::Problem;
use crate::solve::Solve;

/// An equilibrium with its name in its list.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Located {
    /// Of a chain: the label of the census, `2` or for a mirror image `2'`.
    Chain(String, Box<Equilibrium>),
    /// Of another system.
    System(Box<SystemEquilibrium>),
}

/// The equilibria of a problem.
pub(crate) struct Equilibria {
    pub list: Vec<Located>,
    /// Whether a census proves that there are no others.
    pub complete: bool,
}

impl Located {
    pub(crate) fn label(&self) -> &str {
        match self {
            Self::Chain(label, _) => label,
            Self::System(_) => "1",
        }
    }

    pub(crate) fn joints_m(&self) -> &[Vector] {
        match self {
            Self::Chain(_, found) => &found.joints_m,
            Self::System(found) => &found.joints_m,
        }
    }

    pub(crate) fn axial_n(&self) -> &[f64] {
        match self {
            Self::Chain(_, found) => &found.axial_n,
            Self::System(found) => &found.axial_n,
        }
    }

    /// Number of directions in which the energy falls, as the solver or the census has it.
    pub(crate) fn index(&self) -> usize {
        match self {
            Self::Chain(_, found) => found.stability.index_in_space,
            Self::System(found) => found.stability.index_in_space,
        }
    }
}

/// The system of joints and members of a problem: a chain as a system has joints named by their
/// numbers, from `0`.
#[must_use]
pub fn system_of(problem: &Problem) -> System {
    match (problem.as_chain(), problem.as_system()) {
        (Some(chain), _) => System::from(chain.chain()),
        (None, Some(system)) => system.clone(),
        (None, None) => unreachable!("a problem is a chain or a system"),
    }
}

/// The equilibrium that the solvers find, the stable one.
pub(crate) fn hanging(problem: &Problem) -> Result<Equilibria, Error> {
    let list = if let Some(system) = problem.as_system() {
        let found = Solve::new().run_system(system)?;
        found.equilibria().iter().take(1).map(|e| Located::System(Box::new(e.clone()))).collect()
    } else {
        let found = Solve::new().run(problem)?;
        let located = |e: &Equilibrium| Located::Chain("1".to_owned(), Box::new(e.clone()));
        found.equilibria().iter().take(1).map(located).collect()
    };
    Ok(Equilibria { list, complete: false })
}

/// All equilibria of a chain of at most `max_bars` bars by a census, if that is complete; the
/// stable one otherwise.
pub(crate) fn all(problem: &Problem, max_bars: usize) -> Result<Equilibria, Error> {
    let short = problem.as_chain().is_some_and(|chain| chain.chain().bars().len() <= max_bars);
    if !short {
        return hanging(problem);
    }
    let census: CensusAnswer = match Census::new().max_bars(max_bars).run(problem) {
        Ok(census) => census,
        Err(Error::Census(_)) => return hanging(problem),
        Err(error) => return Err(error),
    };
    // Sets with slack bars have no modes: their forces vanish where bars are free to move.
    if !census.census.complete || !census.census.slack_families.is_empty() {
        return hanging(problem);
    }
    let list = census
        .equilibria
        .into_iter()
        .map(|found| Located::Chain(found.label, Box::new(found.equilibrium)))
        .collect();
    Ok(Equilibria { list, complete: true })
}
