//! The equilibria of a problem, all of them where a census is complete.

use census::Settings;
use census::net::SystemCensus;
use lagrange::net::{self, Seed};
use model::budget::BYTES_PER_MEMBER;
use model::system::{System, SystemEquilibrium};
use validate::systems::{ask_with, quick_census};
use validate::{Question, UseCensus};

use crate::census::{CensusAnswer, Found};
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
    /// Whether the one next to a drawing is its neighbour; true where nothing is drawn.
    pub is_neighbour: bool,
}

/// The equilibrium that the solvers find, the stable one; none where they disagree.
pub(crate) fn hanging(problem: &Problem) -> Result<Equilibria, Error> {
    let answer = Solve::new().run(problem)?;
    if answer.agreement().is_some_and(|agreement| !agreement.agrees()) {
        return Err(Error::Disagreed);
    }
    let is_neighbour = answer.near().is_none_or(|near| near.is_neighbour);
    let found = answer.into_parts().1.into_iter().take(1);
    let list = found.map(|found| Located { label: "1".to_owned(), found }).collect();
    Ok(Equilibria { list, complete: false, is_neighbour })
}

/// The equilibrium that `solve` shows, the lowest or the one next to the drawing, where both solvers agree on it, with the
/// equations of `lagrange` there. Else what `lagrange` finds by itself, and whether they disagree.
pub(crate) fn as_solved(system: &System) -> (Result<net::Solution, net::Error>, bool) {
    let settings = net::Settings::default();
    let question = Question { census: UseCensus::Never, ..Question::default() };
    let answer = ask_with(system, &question, &|_| {});
    let agrees = answer.agreement.map(|agreement| agreement.agrees());
    let solution = match answer.equilibria.into_iter().next() {
        Some(found) if agrees == Some(true) => {
            let SystemEquilibrium { joints_m, axial_n, .. } = found;
            let seed = Seed { axial_n: Some(axial_n), ..Seed::at_rest(joints_m) };
            net::solve_from(system, &seed, &settings)
        }
        _ => match system.drawing() {
            Some(drawing_m) => net::solve_from(system, &Seed::at(drawing_m), &settings),
            None => net::solve(system, &settings),
        },
    };
    (solution, agrees == Some(false))
}

/// All equilibria by a census, if that is complete: of a row of at most `max_bars` bars, or of another
/// system of which it is a matter of a second. The stable one otherwise, or the one next to a
/// drawing.
pub(crate) fn all(problem: &Problem, max_bars: usize) -> Result<Equilibria, Error> {
    problem.fits(BYTES_PER_MEMBER)?;
    let settings = Settings { max_bars, ..Settings::default() };
    if max_bars > 0 {
        settings.validate()?;
    }
    let system = problem.system();
    let known = match system.as_row() {
        _ if system.drawing().is_some() => None,
        Some(row) if row.problem().chain().bars().len() > max_bars => None,
        Some(_) => SystemCensus::take(&system, &settings).ok(),
        None => quick_census(&system).ok(),
    };
    // Sets with slack bars have no modes: their forces vanish where bars are free to move.
    let known = known.filter(|census| census.complete && census.families() == 0);
    let Some(census) = known else { return hanging(problem) };
    let all = CensusAnswer::new(&system, census).equilibria.into_iter().enumerate();
    let located =
        |(k, one): (usize, Found)| Located { label: one.label(k), found: one.equilibrium };
    Ok(Equilibria { list: all.map(located).collect(), complete: true, is_neighbour: true })
}
