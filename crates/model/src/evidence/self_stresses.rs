//! Axial forces of a system that equilibrium does not determine.

use serde::Serialize;

use super::ForceChoice;

/// Forces of members in balance with no load at all: any sum of them may be added to the forces of
/// an equilibrium without a change of shape or balance (as far as cables keep pulling and struts
/// pushing).
///
/// A solver states those that it found by its own method; the judge counts them by its own.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SelfStresses {
    /// Number of independent ones.
    pub dimension: usize,
    /// An orthonormal basis of them: axial forces, tension positive, one for each member.
    pub basis: Vec<Vec<f64>>,
    /// Which of the forces the answer names.
    pub choice: ForceChoice,
    /// The largest difference between the length of an inextensible member and the distance of its
    /// ends, m: these members overdetermine the shape, which is the one that meets all lengths best
    /// (see [`Misfit`](crate::system::Misfit)). Without value where a solver does not say.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub misfit_m: Option<f64>,
    /// What is open of the axial force of each member, where the solver tells it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub ranges: Option<Vec<ForceRange>>,
}

/// What balance and signs leave open of the axial force of a member: cables pull, struts push, bars
/// do either.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum ForceRange {
    /// The force is what the answer shows, in every member of the family.
    Unique,
    /// Any force, pull or push.
    Free,
    /// From the least to the largest force, N, each included; without one where there is none.
    Bounded {
        /// Least force, N.
        least_n: Option<f64>,
        /// Largest force, N.
        most_n: Option<f64>,
    },
}
