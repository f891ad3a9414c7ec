//! The rung `agreed`.

use serde::Serialize;

use super::finite;
use super::force_choice::ForceChoice;
use super::from_one;
use crate::solver_name::SolverName;

/// Answers of several solvers are one, and each is in balance.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// What the equilibrium of a system leaves open, if anything.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<Room>,
    /// Whether agreement is evidence for the shape alone: the forces are one of a family, chosen by
    /// convention (see [`ForceChoice`]).
    pub shape_only: bool,
    /// What else there is to say of the forces of a system.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub forces_found: Option<ForcesFound>,
}

/// What a comparison finds of the forces of a system besides their difference.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct ForcesFound {
    /// The largest force, where it exceeds all that acts on the system by orders of magnitude.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub large: Option<LargeForce>,
    /// Where the answers name different forces of one family: those that differ most.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choices: Option<Choices>,
    /// What the judge proves of the first answer by a factorisation with a bound of its rounding.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proved: Option<Proved>,
}

impl ForcesFound {
    /// Without value where there is nothing to say.
    #[must_use]
    pub fn into_option(self) -> Option<Self> {
        (self != Self::default()).then_some(self)
    }
}

/// A force that exceeds all that acts on a system by orders of magnitude, as in a line that is
/// nearly taut.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct LargeForce {
    /// The member, from 1.
    pub member: usize,
    /// Its axial force, N.
    #[serde(with = "finite")]
    pub force_n: f64,
    /// Over all loads and the prestress of the elastic members together.
    #[serde(with = "finite")]
    pub ratio: f64,
}

/// Two different forces of one family.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Choices {
    /// The two solvers.
    pub between: [SolverName; 2],
    /// Which forces each of them names.
    pub choices: [ForceChoice; 2],
    /// The member whose forces differ most, from 1.
    pub member: usize,
    /// Its axial force by each of them, N.
    pub forces_n: [f64; 2],
}

/// What is proved of the places and forces of an answer as they are stored, by Cholesky's
/// factorisation in floating point and a bound of its rounding (S. M. Rump, BIT Numer. Math. 46
/// (2006) 433-452, doi:10.1007/s10543-006-0056-1).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Proved {
    /// The lengths are independent: there is no self-stress.
    Rank,
    /// The energy rises along every motion that keeps the lengths.
    Stability,
    /// Both.
    RankAndStability,
}

impl Proved {
    /// Without value where nothing is proved.
    pub fn of(rank: bool, stability: bool) -> Option<Self> {
        match (rank, stability) {
            (true, true) => Some(Self::RankAndStability),
            (true, false) => Some(Self::Rank),
            (false, true) => Some(Self::Stability),
            (false, false) => None,
        }
    }
}

/// What the equilibrium of a system leaves open.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Room {
    /// Parts that turn freely about verticals: they are turned onto each other before answers are
    /// compared.
    pub turning_parts: usize,
    /// Joints without load whose members are proved to bear no force, and which the lengths of
    /// these let move: they are not compared.
    pub free_joints: usize,
    /// Names of the joints that slide from their place in one answer to that in another through equilibria with
    /// the same forces: they are not compared.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub undetermined: Vec<String>,
}

impl Room {
    /// Nothing where nothing is open.
    pub fn of(turning_parts: usize, free_joints: usize, undetermined: Vec<String>) -> Option<Self> {
        let is_open = turning_parts + free_joints + undetermined.len() > 0;
        is_open.then_some(Self { turning_parts, free_joints, undetermined })
    }
}

/// A number that is over its budget.
#[derive(Debug, Clone, PartialEq, Serialize)]
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
#[derive(Debug, Clone, PartialEq, Serialize)]
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
    /// Violation of geometry, of Newton's laws and of the members' laws by one answer, dimensionless.
    Statics {
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
    /// Difference of the axial forces of two answers that name the same forces of a family, N.
    NamedForces {
        /// The two solvers.
        between: [SolverName; 2],
    },
    /// How far the forces of an answer that names those of equally stiff members are from the least
    /// `sum F² l` among those that balance the same loads, N.
    EquallyStiff {
        /// The solver.
        solver: SolverName,
    },
    /// The largest force of an answer over all that acts on the system.
    LargeForce {
        /// The solver.
        solver: SolverName,
        /// The member, from 1.
        member: usize,
    },
}

/// A place in a system.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Place {
    /// A member, counted from 1.
    Member(usize),
    /// A joint, counted from 0; in JSON from 1, as members are.
    Joint(#[serde(with = "from_one")] usize),
    /// The system as a whole.
    #[default]
    Whole,
}

/// What speaks against answers being one.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Disagreement {
    /// What is over its budget.
    pub excesses: Vec<Excess>,
}

impl Disagreement {
    /// Whether nothing differs.
    pub fn is_empty(&self) -> bool {
        self.excesses.is_empty()
    }

    /// Each part in a sentence.
    pub fn sentences(&self) -> Vec<String> {
        self.excesses.iter().map(ToString::to_string).collect()
    }
}
