//! The rung `verified`.

use serde::Serialize;

use super::finite;
use super::text::{counted, ordinal};

/// Exactly one equilibrium lies in a box (Krawczyk's test in interval arithmetic), and this is it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Verified {
    /// Largest relative width of the enclosures.
    #[serde(with = "finite")]
    pub box_width: f64,
    /// How far outside of the box the answer lies, in units of the total length; 0 inside.
    #[serde(with = "finite")]
    pub distance: f64,
    /// Whether the box stands for a circle of equilibria, turned about the vertical through both
    /// anchors.
    pub circle: bool,
    /// What there is to say besides of the box of a system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub system: Option<VerifiedSystem>,
}

/// The box of a system of bars, cables, struts and springs.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct VerifiedSystem {
    /// Largest width of the box in a coordinate of a joint, m.
    #[serde(with = "finite")]
    pub width_m: f64,
    /// Largest width of the box in an axial force, N.
    #[serde(with = "finite")]
    pub width_n: f64,
    /// How far outside of the box the axial forces of the answer lie, N; 0 inside.
    #[serde(with = "finite")]
    pub distance_n: f64,
    /// Independent free turns of parts about verticals: the box stands for all that they make of
    /// it.
    pub turns: usize,
    /// Cables and struts proved to be slack.
    pub slack: usize,
    /// Joints without load between slack members alone: the box holds one equilibrium for each of
    /// their places near by.
    pub loose_joints: usize,
}

/// What every reason begins with.
const NO_BOX: &str = "no box is proved to hold exactly one equilibrium";

/// Why no box around an answer is proved to hold exactly one equilibrium of a system.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "because", rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoBox {
    /// Occurs when the system has more unknowns than the proof takes.
    #[error("{NO_BOX}: {unknowns} unknowns, and the limit is {limit}")]
    TooLarge {
        /// Coordinates and force densities.
        unknowns: usize,
        /// The limit.
        limit: usize,
    },
    /// Occurs when forces can be added in the members without a load: the forces are a family.
    #[error(
        "{NO_BOX}: the members bear {} without any load, so the forces are a family",
        counted(*dimension, "independent state")
    )]
    SelfStresses {
        /// Number of independent ones.
        dimension: usize,
    },
    /// Occurs when joints move in directions in which no force, to first order, brings them back,
    /// besides free turns about verticals.
    #[error(
        "{NO_BOX}: nothing brings the joints back, to first order, from {}",
        counted(*dimension, "independent motion")
    )]
    FreeMotions {
        /// Number of independent ones.
        dimension: usize,
    },
    /// Occurs when a rope that is taut has a span without a length, as where a ring runs to its end, which is not
    /// proved to bear less than the tension.
    #[error(
        "{NO_BOX}: a span of the rope that is member {member} has no length, and is not proved to bear less than its \
         tension"
    )]
    Rope {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when a cable or strut has just its length and bears no force but that of its own
    /// weight.
    #[error(
        "{NO_BOX}: member {member} has just its length and bears no force but that of its own weight"
    )]
    Degenerate {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when a cable is not proved to pull, or a strut to push.
    #[error(
        "{NO_BOX}: member {member} is not proved to bear a force of the sign that its kind allows"
    )]
    WrongSign {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when a cable or strut that bears nothing is not proved to be slack.
    #[error("{NO_BOX}: member {member} is not proved to be slack")]
    NotSlack {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when an inextensible member connects two anchors and is not proved to be slack: no
    /// joint tells its force.
    #[error("{NO_BOX}: member {member} connects two anchors, and nothing determines its force")]
    BetweenAnchors {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when the floor is not proved to push a joint that lies on it, or a joint not to be
    /// above it.
    #[error("{NO_BOX}: the {} joint is not proved to be above the floor, nor to be pushed by it", ordinal(*joint))]
    Floor {
        /// The joint, from 1.
        joint: usize,
    },
    /// Occurs when no equilibrium in which the same members act is found next to the answer.
    #[error("{NO_BOX}: no equilibrium with the same members in action is found next to the answer")]
    NotConverged,
    /// Occurs when the derivative of the equations is singular in double precision.
    #[error("{NO_BOX}: the derivative of the equations is singular")]
    Singular,
    /// Occurs when Krawczyk's test does not succeed: the answer is too near to one where the
    /// derivative is singular.
    #[error(
        "{NO_BOX}: Krawczyk's test fails, as it does next to places with a singular derivative"
    )]
    NotContracting,
    /// Occurs when the equilibrium that is proved is further away than answers may be.
    #[error(
        "{NO_BOX}: the equilibrium that is proved is {distance_m:.1e} m and {distance_n:.1e} N away"
    )]
    Elsewhere {
        /// Its distance in a coordinate of a joint, m.
        #[serde(with = "finite")]
        distance_m: f64,
        /// Its distance in an axial force, N.
        #[serde(with = "finite")]
        distance_n: f64,
    },
    /// Occurs when a number of the answer is not finite, or the arrays do not fit the system.
    #[error("{NO_BOX}: the answer is incomplete or not finite")]
    NotFinite,
}
