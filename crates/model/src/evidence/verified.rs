//! The rung `verified`.

use serde::Serialize;

use super::finite;

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

/// Why no box around an answer is proved to hold exactly one equilibrium of a system.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "because", rename_all = "snake_case")]
#[non_exhaustive]
pub enum NoBox {
    /// Occurs when the system has more unknowns than the proof takes.
    TooLarge {
        /// Coordinates and force densities.
        unknowns: usize,
        /// The limit.
        limit: usize,
    },
    /// Occurs when forces can be added in the members without a load: the forces are a family.
    SelfStresses {
        /// Number of independent ones.
        dimension: usize,
    },
    /// Occurs when joints move in directions in which no force, to first order, brings them back,
    /// besides free turns about verticals.
    FreeMotions {
        /// Number of independent ones.
        dimension: usize,
    },
    /// Occurs when a rope that is taut has a span without a length, as where a ring runs to its end, which is not
    /// proved to bear less than the tension.
    Rope {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when a cable or strut has just its length and bears no force but that of its own
    /// weight.
    Degenerate {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when a cable is not proved to pull, or a strut to push.
    WrongSign {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when a cable or strut that bears nothing is not proved to be slack.
    NotSlack {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when an inextensible member connects two anchors and is not proved to be slack: no
    /// joint tells its force.
    BetweenAnchors {
        /// The member, from 1.
        member: usize,
    },
    /// Occurs when the floor is not proved to push a joint that lies on it, or a joint not to be
    /// above it.
    Floor {
        /// The joint, from 1.
        joint: usize,
    },
    /// Occurs when no equilibrium in which the same members act is found next to the answer.
    NotConverged,
    /// Occurs when the derivative of the equations is singular in double precision.
    Singular,
    /// Occurs when Krawczyk's test does not succeed: the answer is too near to one where the
    /// derivative is singular.
    NotContracting,
    /// Occurs when the equilibrium that is proved is further away than answers may be.
    Elsewhere {
        /// Its distance in a coordinate of a joint, m.
        #[serde(with = "finite")]
        distance_m: f64,
        /// Its distance in an axial force, N.
        #[serde(with = "finite")]
        distance_n: f64,
    },
    /// Occurs when a number of the answer is not finite, or the arrays do not fit the system.
    NotFinite,
}

impl std::error::Error for NoBox {}
