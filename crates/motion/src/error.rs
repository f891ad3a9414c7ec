//! Why a system does not move here, or a motion ends.

use model::number::Brief;
use model::system::RunTogether;

/// What a step of a motion leads to.
pub(crate) type Result<T, E = MotionError> = std::result::Result<T, E>;

/// Why a system cannot be set in motion, or a step cannot be taken.
///
/// Members are counted from 1, joints are named.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum MotionError {
    /// Occurs when an inextensible cable or strut is part of a system whose mechanics are asked for
    /// without a position: it may be taut or slack.
    #[error(
        "member {member} is an inextensible {kind}: a position tells whether it is taut or slack"
    )]
    Unilateral {
        member: usize,
        /// `cable` or `strut`.
        kind: &'static str,
    },
    /// Occurs when a ring of a taut rope runs to the end of a span: a span of no length has no
    /// direction for its force.
    #[error(transparent)]
    Jammed(#[from] RunTogether),
    /// Occurs when an inextensible cable or strut about whose equilibrium a system oscillates is
    /// neither taut, with a force that is more than rounding, nor slack: on one side it would hold
    /// its ends, on the other it would not, and no small motion is linear.
    #[error(
        "member {member} is an inextensible {kind} that is neither certainly taut nor slack: its ends are \
         {distance_m} m apart, its length is {length_m} m, and it bears {axial_n} N; small motions are not \
         linear there"
    )]
    NeitherTautNorSlack {
        member: usize,
        /// `cable` or `strut`.
        kind: &'static str,
        distance_m: f64,
        length_m: f64,
        /// Its axial force, tension positive, N.
        axial_n: f64,
    },
    /// Occurs when there is no memory for the factor of the equations of a step.
    #[error("there is no memory for the equations of {joints} joints")]
    Memory { joints: usize },
    /// Occurs when impacts follow each other too fast, or when no impulses of the right signs are
    /// found for what closes at one time.
    #[error("at t = {time_s} s there are more than {most} impacts in a step of {step_s} s")]
    Impacts { time_s: f64, step_s: f64, most: usize },
    /// Occurs when a joint about whose equilibrium a system oscillates lies on a floor that does
    /// not certainly push it: it may rise and not sink, and no small motion is linear.
    #[error(
        "joint {joint:?} lies on the floor, which pushes it with {push_n} N: that is not certainly more than \
         nothing, and small motions are not linear there"
    )]
    NotPushed {
        joint: String,
        /// Force of the floor on it, up, N.
        push_n: f64,
    },
    /// Occurs when there is a floor under a system whose mechanics are asked for without a
    /// position.
    #[error("there is a floor: a position tells which joints lie on it")]
    Floor,
    /// Occurs when a joint comes to the floor on a line, where both hold it.
    #[error(
        "joint {joint:?} has come down its line to the floor, where it cannot move: motions end there"
    )]
    FloorEndsLine { joint: String },
    /// Occurs when the two moments across a member differ where that is not provided for (members
    /// with a stiffness, flat bodies in motion), or when no body has its moments.
    #[error("the moments of member {member} are {moments_kg_m2:?} kg m^2: {reason}")]
    UnequalMoments {
        member: usize,
        /// `J_x`, `J_y`, `J_z`.
        moments_kg_m2: [f64; 3],
        reason: &'static str,
    },
    /// Occurs when a joint can be moved without moving any mass.
    #[error(
        "joint {joint:?} can move without moving any mass (inertia {inertia_kg} kg left there): its \
         acceleration is indeterminate; give it a mass_kg, or a mass to a member that ends there (in such \
         systems each joint that moves needs one)"
    )]
    Massless { joint: String, inertia_kg: f64 },
    /// Occurs when the motions about an equilibrium that keep the lengths of rigid members are no linear space.
    #[error(
        "this shape is singular, as bars that are folded into one line, or a cable more than needed that slackens to either \
         side: the motions that keep the lengths are no linear space, and have no modes"
    )]
    Singular,
    /// Occurs when the constraints do not determine their forces: a bar too many, or a taut
    /// straight line.
    #[error(
        "at joint {joint:?} the rigid bars and supports do not determine their forces (relative pivot \
         {pivot}): a bar too many, or bars on one taut line",
        pivot = Brief(*pivot)
    )]
    Redundant {
        joint: String,
        /// The pivot, relative to what it is made of.
        pivot: f64,
    },
    /// Occurs when positions cannot be brought onto the lengths of the bars.
    #[error(
        "the constraints are not met: after {iterations} corrections a bar or support is off by {off} of its \
         length",
        off = Brief(*off)
    )]
    NotClosed {
        iterations: usize,
        /// Largest relative violation left.
        off: f64,
    },
    /// Occurs when the constraints of a step are not met to rounding: the step is too long.
    #[error(
        "at t = {} s a step of {} s does not meet the lengths (off by {} after \
         {iterations} corrections): take a shorter step",
        Brief(*time_s), Brief(step_s.abs()), Brief(*off)
    )]
    StepTooLong {
        time_s: f64,
        step_s: f64,
        iterations: usize,
        /// Largest relative violation left.
        off: f64,
    },
    /// Occurs when a step is far too long for the oscillations of the elastic members: it would be
    /// taken in more than ten thousand parts.
    #[error(
        "a step of {} s is too long for the oscillations of the elastic members, which allow \
         {} s: take steps of at most {} s, or less stiff members",
        Brief(*step_s), Brief(*longest_s), Brief(*most_s)
    )]
    Stiff { step_s: f64, longest_s: f64, most_s: f64 },
    /// Occurs when speeds overflow: a force is too large for what it moves.
    #[error(
        "at t = {} s a step of {} s leads to speeds beyond all numbers: are forces and masses right?",
        Brief(*time_s), Brief(step_s.abs())
    )]
    Overflow { time_s: f64, step_s: f64 },
    /// Occurs when the number of places or velocities given is not that of the joints, or one is
    /// not finite.
    #[error("{what}: {reason}")]
    Input { what: &'static str, reason: String },
    /// Occurs when modes are asked for at a position that is not an equilibrium.
    #[error(
        "the position is not an equilibrium: {off} of the largest force is left over at joint {joint:?}",
        off = Brief(*off)
    )]
    NotInBalance {
        joint: String,
        /// That force, relative to the largest force in the system.
        off: f64,
    },
    /// Occurs when all modes are asked for of a system with too many joints for dense linear
    /// algebra.
    #[error(
        "all modes are found by dense linear algebra, for at most {most} joints that move, and this \
         system has {joints}: ask for the lowest"
    )]
    TooLarge { joints: usize, most: usize },
    /// Occurs when the modes that are found are not as many as the inertia of the shifted stiffness
    /// counts.
    #[error(
        "{found} modes are found where {asked} are asked for, and the inertia of the stiffness does \
         not confirm them"
    )]
    ModesUncounted { found: usize, asked: usize },
}
