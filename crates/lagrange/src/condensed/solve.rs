//! The hanging equilibrium of a chain, with everything that belongs to it.

use std::time::Instant;

use model::{Equilibrium, Evidence, Problem, SolverName};

use super::chain::Condensed;
use super::error::CondensedError;
use super::pull::Pull;
use super::settings::Settings;
use super::shape::Vectors;
use super::stability::second_order;

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
/// [`CondensedError`]: settings out of range; passes over the bars that ran out, or a chain that
/// misses its anchor by more than the settings allow; a force too large for a double.
///
/// ```
/// use lagrange::condensed::{Settings, solve};
/// let solution = solve(&model::cases::paper(), &Settings::default())?;
/// // E1: the third bar props the chain up, and the anchors carry three weights together.
/// assert_eq!(solution.pull.compressed(), [2]);
/// let weight = model::STANDARD_GRAVITY_M_S2;
/// let ground = solution.pull.ground_n();
/// assert!((ground[1] / weight + 0.648944835933934).abs() < 1e-14);
/// assert!((ground[2] / weight - 2.312944292241838).abs() < 1e-14);
/// # Ok::<(), lagrange::condensed::CondensedError>(())
/// ```
pub fn solve(problem: &Problem, settings: &Settings) -> Result<Solution, CondensedError> {
    let begun = Instant::now();
    let chain = Condensed::new(problem);
    let pull = chain.pull(settings)?;
    let mut equilibrium = chain.equilibrium(&pull, settings)?;
    equilibrium.evidence.solve_s = begun.elapsed().as_secs_f64();
    Ok(Solution { equilibrium, pull })
}

impl Condensed {
    /// Joints, multipliers, axial forces, energy and stability that belong to a pull of this chain.
    ///
    /// # Errors
    ///
    /// [`CondensedError::NotClosed`] when the last joint misses its anchor by more than
    /// [`Settings::closure`], [`CondensedError::Overflow`] when a force or the energy is infinite.
    pub fn equilibrium(
        &self,
        pull: &Pull,
        settings: &Settings,
    ) -> Result<Equilibrium, CondensedError> {
        let Vectors { joints_m, multipliers_n, axial_n, reactions_n, energy_j, closure } =
            self.vectors(pull);
        let passes = pull.passes();
        if closure.is_nan() || closure > settings.closure {
            return Err(CondensedError::NotClosed { closure, passes });
        }
        let finite = reactions_n.start.iter().chain(&reactions_n.end).all(|x| x.is_finite());
        if !(finite && energy_j.is_finite()) {
            return Err(CondensedError::Overflow);
        }
        let second = second_order(self, pull);
        let mut evidence = Evidence::converged(
            closure,
            "distance of the last joint from its anchor, in total lengths",
            passes,
        );
        evidence.nullity = second.nullity;
        evidence.condition = second.condition;
        Ok(Equilibrium {
            solver: SolverName::Lagrange,
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
