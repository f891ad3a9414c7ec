//! Why a rung is open.

use serde::Serialize;

use super::agreed::{Disagreement, Excess};
use super::certificate::NoCertificate;
use super::complete::NoCensus;
use super::convergence::Convergence;
use super::finite;
use super::verified::NoBox;
use crate::solver_name::SolverName;

/// Why a rung was not reached.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Reason {
    /// Nobody has tried.
    NotTried,
    /// The solver stopped with a residual above its tolerance.
    AboveTolerance(Convergence),
    /// No other solver was asked.
    OneSolverOnly {
        /// The one that was.
        solver: SolverName,
        /// Largest violation of geometry and of Newton's laws by its answer, dimensionless.
        #[serde(with = "finite")]
        statics: f64,
    },
    /// The other solver has no answer.
    OtherSolverWithoutAnswer {
        /// The other solver.
        solver: SolverName,
        /// Why it has none.
        because: NoAnswer,
        /// Largest violation of geometry and of Newton's laws by this answer, dimensionless.
        #[serde(with = "finite")]
        statics: f64,
    },
    /// Solvers were compared and disagree.
    SolversDisagree(Disagreement),
    /// An answer that stands alone violates geometry or Newton's laws, or its numbers contradict
    /// each other.
    JudgeRefuses {
        /// What is over its budget.
        excesses: Vec<Excess>,
    },
    /// A complete census proves that the answer is no equilibrium, to the accuracy that is asked of
    /// answers.
    RefutedByCensus {
        /// Distance of the nearest one, in units of the total length.
        #[serde(with = "finite")]
        distance: f64,
    },
    /// There is no census.
    NoCensus(NoCensus),
    /// The answer is one of a family with slack bars, which the census lists as a whole.
    SlackFamily,
    /// The answer is in none of the boxes of a census that left cells of pulls undecided.
    NotAmongDecided {
        /// How many.
        cells: usize,
    },
    /// The census lists other equilibria, not so far away, or not proved to be all, that they would
    /// refute the answer.
    Elsewhere {
        /// Distance of the nearest one, in units of the total length.
        #[serde(with = "finite")]
        distance: f64,
    },
    /// The answer is at a straight position in the vertical through both anchors, an equilibrium
    /// under any force along it: the census lists it apart.
    AtStraight {
        /// How far from it, in units of the total length.
        #[serde(with = "finite")]
        distance: f64,
    },
    /// The census lists no equilibrium.
    NothingListed,
    /// The census left cells of pulls undecided.
    CensusUndecided {
        /// How many.
        cells: usize,
    },
    /// Occurs when the census names families with slack bars that are no manifold: the bars also fit
    /// into one line, or close upon themselves.
    SingularFamilies {
        /// How many.
        listed: usize,
    },
    /// The census lists its equilibria, and the count of them could not be checked: a straight
    /// position of the chain exists, where the configuration space is no manifold.
    StraightPosition {
        /// Numbers of the sides that are together as long as the others, from 1; n + 1 is the line
        /// between the anchors.
        sides: Vec<usize>,
    },
    /// The census lists its equilibria, and the count of them could not be checked: so many sides
    /// are not counted.
    CountUnchecked {
        /// Number of bars and the line between the anchors.
        sides: usize,
    },
    /// No box around the answer is proved to hold exactly one equilibrium.
    NoBox(NoBox),
    /// There is no certificate.
    NoCertificate(NoCertificate),
}

/// Why a solver has no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoAnswer {
    /// It looks for minima, and this is not a minimum.
    MinimaOnly,
    /// It refused, or gave up.
    Refused,
}
