//! The hanging equilibrium of a chain, with everything that belongs to it.

use std::num::NonZeroUsize;
use std::time::Instant;

use model::{Equilibrium, Evidence, ForceUncertainty, Problem, SolverName, UncertaintyCause};

use super::chain::Condensed;
use super::pull::Pull;
use super::settings::Settings;
use super::stability::second_order;
use super::vectors::{Totals, Vectors};
use crate::error::Error;
use crate::thresholds::ZERO;

/// What the residual is.
const RESIDUAL_OF: &str = "distance of the last joint from its anchor, in total lengths";

/// An equilibrium from the condensed equations. That it exists means converged.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// The equilibrium as everyone reads it.
    pub equilibrium: Equilibrium,
    /// The same in three numbers and the signs.
    pub pull: Pull,
}

/// Find the hanging equilibrium, the global minimum of the energy, with no guess.
///
/// # Errors
///
/// [`Error`]: settings out of range; passes over the bars that ran out, or a chain that
/// is farther from its anchor than the settings allow; a force too large for a double.
///
/// ```
/// use lagrange::condensed::{Settings, solve};
/// let solution = solve(&model::cases::paper(), &Settings::default())?;
/// // E1: the third bar props the chain up.
/// assert_eq!(solution.pull.compressed(), [2]);
/// let weight = model::STANDARD_GRAVITY_M_S2;
/// let ground = solution.pull.ground_n();
/// assert!((ground[1] / weight + 0.648944835933934).abs() < 1e-14);
/// assert!((ground[2] / weight - 2.312944292241838).abs() < 1e-14);
/// # Ok::<(), lagrange::Error>(())
/// ```
pub fn solve(problem: &Problem, settings: &Settings) -> Result<Solution, Error> {
    Solver::default().solve(problem, settings)
}

/// Memory for one chain after another.
///
/// Fresh memory is the largest part of the time that a million bars take: the system hands it out
/// page by page. A solver keeps that of its last chain, and of the solutions that are given back.
///
/// ```
/// use lagrange::condensed::{Settings, Solver};
/// let mut solver = Solver::default();
/// let first = solver.solve(&model::cases::paper(), &Settings::default())?;
/// let energy_j = first.equilibrium.energy_j;
/// solver.take_back(first);
/// let second = solver.solve(&model::cases::paper(), &Settings::default())?;
/// assert_eq!(second.equilibrium.energy_j, energy_j);
/// # Ok::<(), lagrange::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Solver {
    processors: NonZeroUsize,
    chain: Option<Condensed>,
    spare: Vectors,
}

impl Default for Solver {
    fn default() -> Self {
        Self::with_processors(NonZeroUsize::MIN)
    }
}

impl Solver {
    /// A solver that shares large chains among so many processors; by default there is one.
    pub fn with_processors(processors: NonZeroUsize) -> Self {
        Self { processors, chain: None, spare: Vectors::default() }
    }

    /// Find the hanging equilibrium, like [`solve`](solve()).
    ///
    /// # Errors
    ///
    /// Those of [`solve`](solve()).
    pub fn solve(&mut self, problem: &Problem, settings: &Settings) -> Result<Solution, Error> {
        let begun = Instant::now();
        let chain = match self.chain.take() {
            Some(chain) => chain.again(problem),
            None => Condensed::with_processors(problem, self.processors),
        };
        let chain = self.chain.insert(chain);
        let pull = chain.pull(settings)?;
        let memory = std::mem::take(&mut self.spare);
        let mut equilibrium = chain.equilibrium(memory, &pull, settings)?;
        equilibrium.evidence.solve_s = begun.elapsed().as_secs_f64();
        Ok(Solution { equilibrium, pull })
    }

    /// Use the memory of a solution that is not needed any more for the next one.
    pub fn take_back(&mut self, solution: Solution) {
        let Equilibrium { joints_m, multipliers_n, axial_n, .. } = solution.equilibrium;
        self.spare = Vectors { joints_m, multipliers_n, axial_n };
    }
}

impl Condensed {
    /// Joints, multipliers, axial forces, energy and stability that belong to a pull of this chain.
    fn equilibrium(
        &self,
        mut memory: Vectors,
        pull: &Pull,
        settings: &Settings,
    ) -> Result<Equilibrium, Error> {
        let Totals { reactions_n, energy_j, closure } = self.vectors(pull, &mut memory);
        let passes = pull.passes();
        if closure.is_nan() || closure > settings.closure {
            return Err(Error::NotClosed { closure, passes });
        }
        let finite = reactions_n.start.iter().chain(&reactions_n.end).all(|x| x.is_finite());
        if !(finite && energy_j.is_finite()) {
            return Err(Error::Overflow);
        }
        let second = second_order(self, pull);
        let mut evidence = Evidence::new(RESIDUAL_OF, closure, settings.closure, passes);
        let relative = self.force_error(pull);
        if relative > ZERO {
            let cause = UncertaintyCause::WeakClosure;
            evidence = evidence.with_force_uncertainty(ForceUncertainty { relative, cause });
        }
        evidence.nullity = second.nullity;
        evidence.condition = second.condition;
        let Vectors { joints_m, multipliers_n, axial_n } = memory;
        Ok(Equilibrium {
            solver: SolverName::LAGRANGE,
            energy_j,
            joints_m,
            multipliers_n,
            reactions_n,
            axial_n,
            stability: second.stability,
            evidence,
        })
    }
}
