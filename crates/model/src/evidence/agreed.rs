//! The rung `agreed`.

use serde::{Deserialize, Serialize};

use super::finite;
use crate::solver_name::SolverName;
use crate::stability::Stability;

/// Answers of several solvers are one, and each is in balance.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Agreed {
    /// Whose answers.
    pub solvers: Vec<SolverName>,
    /// Largest distance of a joint in one answer from the same joint in another, m.
    #[serde(with = "finite")]
    pub joints_m: f64,
    /// Largest difference of a joint force, N.
    #[serde(with = "finite")]
    pub forces_n: f64,
    /// Largest difference of the energies, J.
    #[serde(with = "finite")]
    pub energy_j: f64,
    /// Largest violation of geometry and of Newton's laws by any of the answers, dimensionless.
    #[serde(with = "finite")]
    pub statics: f64,
    /// Joints that an equilibrium leaves free, which are not compared: see [`FreeJoints`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub free_joints: Option<FreeJoints>,
    /// What the equilibrium of a system leaves open, if anything.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub room: Option<Room>,
    /// Whether agreement is evidence for the shape alone: the forces are one of a family, chosen by
    /// convention (see [`ForceFamily`](super::ForceFamily)).
    pub shape_only: bool,
    /// Where a solver does not tell the least curvature in the plane from zero and another one does
    /// ([`Stability::is_compatible_with`]): what each of them finds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub curvature_undecided: Vec<StabilityDifference>,
}

/// What the equilibrium of a system leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Room {
    /// Parts that turn freely about verticals: they are turned onto each other before answers are
    /// compared.
    pub turning_parts: usize,
    /// Joints without load whose members are proved to bear no force, and which the lengths of
    /// these let move: they are not compared.
    pub free_joints: usize,
}

impl Room {
    /// Nothing where nothing is open.
    #[must_use]
    pub fn of(turning_parts: usize, free_joints: usize) -> Option<Self> {
        (turning_parts + free_joints > 0).then_some(Self { turning_parts, free_joints })
    }
}

/// The joints between bars that are proved to carry no force: all else hangs plumb from the two
/// anchors, and the lengths of these bars leave more than one way to bridge what is left.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct FreeJoints {
    /// The first of them.
    pub first: usize,
    /// The last of them.
    pub last: usize,
}

impl FreeJoints {
    /// How many.
    #[must_use]
    pub fn count(&self) -> usize {
        self.last + 1 - self.first
    }

    /// Whether a joint is one of them.
    #[must_use]
    pub fn contains(&self, joint: usize) -> bool {
        (self.first..=self.last).contains(&joint)
    }
}

/// A number that is over its budget.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Excess {
    /// What the number measures.
    #[serde(flatten)]
    pub what: Quantity,
    /// The number; not a number where an answer is incomplete or not finite.
    #[serde(with = "finite")]
    pub value: f64,
    /// What it may be.
    #[serde(with = "finite")]
    pub budget: f64,
}

/// What a comparison measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "what", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Quantity {
    /// Largest distance of a joint in one answer from the same joint in the other, m.
    Joints {
        /// The two solvers.
        between: [SolverName; 2],
    },
    /// Largest difference of a joint force, N.
    Forces {
        /// The two solvers.
        between: [SolverName; 2],
    },
    /// Difference of the energies, J.
    Energy {
        /// The two solvers.
        between: [SolverName; 2],
    },
    /// Violation of geometry and of Newton's laws by one answer, dimensionless.
    Statics {
        /// The solver.
        solver: SolverName,
        /// The bar with the largest violation, from 1; 0 where the answer is incomplete.
        bar: usize,
    },
    /// Violation of geometry, of Newton's laws and of the members' laws by one answer for a system,
    /// dimensionless.
    SystemStatics {
        /// The solver.
        solver: SolverName,
        /// Where it is.
        place: Place,
    },
    /// Difference of the Morse indices of two answers for a system.
    MorseIndex {
        /// The two solvers.
        between: [SolverName; 2],
    },
    /// What the self-stresses that a solver names leave at a joint, dimensionless: they are in
    /// balance with no load.
    SelfStresses {
        /// The solver.
        solver: SolverName,
    },
    /// The energy that an answer names less that of its joints, in units of weight times length.
    EnergyOfJoints {
        /// The solver.
        solver: SolverName,
    },
    /// Axial forces and reactions that an answer names less those of its joint forces, in units of
    /// force.
    AxialForcesAndReactions {
        /// The solver.
        solver: SolverName,
    },
}

/// A place in a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A member, counted from 1.
    Member(usize),
    /// A joint, counted from 0.
    Joint(usize),
    /// The system as a whole.
    Whole,
}

/// Two solvers that find different second-order behaviour.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StabilityDifference {
    /// The two solvers.
    pub between: [SolverName; 2],
    /// What each of them finds.
    pub found: [Stability; 2],
}

/// What speaks against answers being one.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Disagreement {
    /// What is over its budget.
    pub excesses: Vec<Excess>,
    /// Different second-order behaviour.
    pub stability: Vec<StabilityDifference>,
}

impl Disagreement {
    /// Whether nothing differs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.excesses.is_empty() && self.stability.is_empty()
    }

    /// Each part in a sentence.
    #[must_use]
    pub fn sentences(&self) -> Vec<String> {
        let excesses = self.excesses.iter().map(ToString::to_string);
        excesses.chain(self.stability.iter().map(ToString::to_string)).collect()
    }
}
