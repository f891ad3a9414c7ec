//! The evidence ladder: how far an equilibrium is proved.
//!
//! Each of the five rungs of a [`Ladder`] is reached with its proof, a struct of numbers, or open
//! with its [`Reason`], an enum with numbers. Whoever produces evidence hands in numbers; whoever
//! judges reads numbers; the sentences for people are made in one place, the `Display` of these
//! types.
//!
//! ```
//! use model::{Evidence, Reason, Rung, Status};
//! let mut evidence = Evidence::new("largest equation, in mg", 2e-16, 1e-13, 7);
//! assert_eq!(evidence.rung(), Some(Rung::Converged));
//! assert_eq!(evidence.ladder.optimal, Status::Open(Reason::NotTried));
//! assert_eq!(
//!     evidence.ladder.converged.to_string(),
//!     "largest equation, in mg: 2.0e-16 after 7 iterations"
//! );
//! // A residual above its tolerance is no convergence.
//! evidence = Evidence::new("largest equation, in mg", 2e-12, 1e-13, 7);
//! assert_eq!(evidence.rung(), None);
//! ```

mod agreed;
mod certificate;
mod complete;
mod convergence;
mod finite;
mod force_choice;
mod from_one;
mod jam;
mod ladder;
mod reason;
mod rigidity;
mod rung;
mod self_stresses;
mod status;
mod text;
mod verified;

use serde::Serialize;

pub use agreed::{
    Agreed, Choices, Disagreement, Excess, ForcesFound, LargeForce, Place, Proved, Quantity, Room,
};
pub use certificate::{NoCertificate, Optimal};
pub use complete::{Complete, CompleteSystem, NoCensus};
pub use convergence::{Convergence, ForceUncertainty, UncertaintyCause};
pub use force_choice::ForceChoice;
pub use jam::Jam;
pub use ladder::{Ladder, Statement};
pub use reason::{NoAnswer, Reason};
pub use rigidity::Rigidity;
pub use rung::Rung;
pub use self_stresses::{ForceRange, SelfStresses};
pub use status::Status;
pub use verified::{NoBox, Verified, VerifiedSystem};

/// How far an equilibrium is proved, and what it cost.
#[derive(Debug, Clone, PartialEq)]
pub struct Evidence {
    /// The solver's own residual, dimensionless; see `residual_of`.
    pub residual: f64,
    /// What the residual measures and in which units.
    pub residual_of: &'static str,
    /// Iterations of the solver.
    pub iterations: usize,
    /// Dimension of the null space of the solver's own system at the solution.
    pub nullity: usize,
    /// Ratio of the largest to the smallest non-zero singular value of that system, scaled to the
    /// solver's units.
    pub condition: f64,
    /// Time of the solver alone, s.
    pub solve_s: f64,
    /// Where equilibrium does not determine the forces in a system: what may be added to them.
    pub self_stresses: Option<SelfStresses>,
    /// In a system: how the lengths determine shape and forces, where the solver has counted that.
    pub rigidity: Option<Rigidity>,
    /// In a system: spans of ropes without length, with their forces.
    pub jams: Vec<Jam>,
    /// The five rungs.
    pub ladder: Ladder,
}

impl Evidence {
    /// Evidence of a solver that has ended with a residual: the rung `converged` is reached if the
    /// residual is not above its tolerance, and no other rung is.
    ///
    /// ```
    /// use model::{Evidence, Rung};
    /// let within = Evidence::new("residual of (40)", 1e-15, 1e-12, 7);
    /// assert_eq!(within.rung(), Some(Rung::Converged));
    /// // Above its tolerance it reaches no rung, and neither does what is not a number.
    /// assert_eq!(Evidence::new("residual of (40)", 1e-9, 1e-12, 7).rung(), None);
    /// assert_eq!(Evidence::new("residual of (40)", f64::NAN, 1e-12, 7).rung(), None);
    /// ```
    pub fn new(
        residual_of: &'static str,
        residual: f64,
        tolerance: f64,
        iterations: usize,
    ) -> Self {
        Self::of(Convergence::new(residual_of, residual, Some(tolerance), iterations))
    }

    /// Evidence of a proof by enclosure, which has no tolerance: the enclosures of `residual_of`
    /// have this largest relative width.
    pub fn enclosed(residual_of: &'static str, width: f64) -> Self {
        Self::of(Convergence::new(residual_of, width, None, 0))
    }

    fn of(convergence: Convergence) -> Self {
        let Convergence { residual_of, residual, iterations, .. } = convergence;
        Self {
            residual,
            residual_of,
            iterations,
            nullity: 0,
            condition: 1.0,
            solve_s: 0.0,
            self_stresses: None,
            rigidity: None,
            jams: vec![],
            ladder: Ladder { converged: convergence.judged(), ..Ladder::default() },
        }
    }

    /// Say how far the solver's arithmetic leaves the forces open.
    #[must_use]
    pub fn with_force_uncertainty(mut self, uncertainty: ForceUncertainty) -> Self {
        if let Some(convergence) = self.ladder.convergence_mut() {
            convergence.force_uncertainty = Some(uncertainty);
        }
        self
    }

    /// How far the solver's arithmetic leaves the forces open, where that is worth saying.
    pub fn force_uncertainty(&self) -> Option<ForceUncertainty> {
        self.ladder.convergence().and_then(|convergence| convergence.force_uncertainty)
    }

    /// The highest rung reached, if any is.
    pub fn rung(&self) -> Option<Rung> {
        self.ladder.highest()
    }
}

/// The keys of the JSON, in their order.
#[derive(Serialize)]
struct Keys<'a> {
    rung: Option<Rung>,
    #[serde(with = "finite")]
    residual: f64,
    residual_of: &'a str,
    iterations: usize,
    nullity: usize,
    #[serde(with = "finite")]
    condition: f64,
    #[serde(with = "finite")]
    solve_s: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    self_stresses: Option<&'a SelfStresses>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rigidity: Option<Rigidity>,
    #[serde(skip_serializing_if = "<[Jam]>::is_empty")]
    jams: &'a [Jam],
    ladder: &'a Ladder,
}

impl Serialize for Evidence {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        Keys {
            rung: self.rung(),
            residual: self.residual,
            residual_of: self.residual_of,
            iterations: self.iterations,
            nullity: self.nullity,
            condition: self.condition,
            solve_s: self.solve_s,
            self_stresses: self.self_stresses.as_ref(),
            rigidity: self.rigidity,
            jams: &self.jams,
            ladder: &self.ladder,
        }
        .serialize(serializer)
    }
}
