//! The equilibria of a problem, all of them where a census is complete.

use std::sync::Arc;

use model::budget::BYTES_PER_MEMBER;
use model::system::{System, SystemEquilibrium};

use validate::systems::quick_census;

use crate::census::{Census, CensusAnswer, SystemCensusAnswer};
use crate::error::Error;
use crate::problem::Problem;
use crate::solve::Solve;

/// An equilibrium with its name in its list.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Located {
    /// The label of the census, `2` or for a mirror image `2'`.
    pub label: String,
    /// The equilibrium.
    pub found: SystemEquilibrium,
}

/// The equilibria of a problem.
#[derive(Debug, Clone)]
pub(crate) struct Equilibria {
    pub list: Vec<Located>,
    /// Whether a census proves that there are no others.
    pub complete: bool,
}

/// The system of joints and members of a problem: a chain as a system has joints named by their
/// numbers, from `0`.
#[must_use]
pub fn system_of(problem: &Problem) -> Arc<System> {
    problem.system()
}

/// The equilibrium that the solvers find, the stable one.
pub(crate) fn hanging(problem: &Problem) -> Result<Equilibria, Error> {
    let found = Solve::new().run(problem)?.into_parts().1.into_iter().take(1);
    let list = found.map(|found| Located { label: "1".to_owned(), found }).collect();
    Ok(Equilibria { list, complete: false })
}

/// All equilibria by a census, if that is complete: of a chain of at most `max_bars` bars, or of a
/// system of which it is a matter of a second. The stable one otherwise, or the one next to a
/// drawing.
pub(crate) fn all(problem: &Problem, max_bars: usize) -> Result<Equilibria, Error> {
    problem.fits(BYTES_PER_MEMBER)?;
    let known = match problem.as_chain() {
        Some(chain) if chain.chain().bars().len() <= max_bars => of_chain(chain, max_bars)?,
        Some(_) => None,
        None => of_system(&system_of(problem)),
    };
    known.map_or_else(|| hanging(problem), |list| Ok(Equilibria { list, complete: true }))
}

fn of_chain(chain: &model::Problem, max_bars: usize) -> Result<Option<Vec<Located>>, Error> {
    let census = match Census::new().max_bars(max_bars).of_chain(chain, &|_| {}) {
        Ok(census) => census,
        Err(Error::Census(_)) => return Ok(None),
        Err(error) => return Err(error),
    };
    // Sets with slack bars have no modes: their forces vanish where bars are free to move.
    if !census.census.complete || !census.census.slack_families.is_empty() {
        return Ok(None);
    }
    let labels: Vec<_> = census.equilibria.iter().map(|found| found.label.clone()).collect();
    let all = CensusAnswer::Chain(census.into()).equilibria();
    let located = |(label, found)| Located { label, found };
    Ok(Some(labels.into_iter().zip(all).map(located).collect()))
}

fn of_system(system: &System) -> Option<Vec<Located>> {
    if system.drawing().is_some() {
        return None;
    }
    let census = quick_census(system).ok()?;
    if !census.complete || census.families() > 0 {
        return None;
    }
    let all = SystemCensusAnswer::new(system, census);
    let located = |(k, found): (usize, &SystemEquilibrium)| Located {
        label: (k + 1).to_string(),
        found: found.clone(),
    };
    Some(all.equilibria().iter().enumerate().map(located).collect())
}
