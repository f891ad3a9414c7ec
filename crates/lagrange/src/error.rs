//! What can go wrong in a solve.

use model::number::Brief;
use model::system::{Misfit, RunTogether};
use serde::Serialize;

use crate::settings::SettingsError;

/// Why no equilibrium was returned. `Ok` always means converged. Numbers count from 1.
///
/// ```
/// use lagrange::{Error, Seed, Settings, solve_from};
/// let four = Seed::planar(&[0.0; 4]);
/// let error = solve_from(&model::cases::paper(), &four, &Settings::default()).unwrap_err();
/// assert_eq!(error, Error::SeedLength { of: "bars", expected: 3, got: 4 });
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum Error {
    /// Occurs when a setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// Occurs when the seed has not one place for each joint, not one force for each member, or not three angles for each bar.
    #[error("the seed holds {got} {of}, the system has {expected}")]
    SeedLength {
        /// `joints`, `members`, or `bars`.
        of: &'static str,
        expected: usize,
        got: usize,
    },
    /// Occurs when a place, a force or an angle of the seed is infinite or not a number.
    #[error("the seed is not finite at {of} {number}")]
    SeedNotFinite {
        /// `joint`, `member`, or `bar`.
        of: &'static str,
        number: usize,
    },
    /// Occurs when every run of Newton's method stopped at a local minimum of the residual that is
    /// no root, or ran out of steps.
    #[error(
        "no equilibrium from this seed: residual {residual} (relative) after {iterations} steps \
         and {relaxations} relaxations",
        residual = Brief(*residual)
    )]
    Stagnated {
        /// Norm of the residual at the end, in units of the total weight and length.
        residual: f64,
        iterations: usize,
        relaxations: usize,
    },
    /// Occurs when all equations of the paper hold and a bar is not in balance: a false root at
    /// cos θ = cos φ = 0, where the equations lose a moment balance. Only when
    /// [`Settings::lock_margin`](crate::Settings::lock_margin) is zero; otherwise the bar
    /// gets other angles and the solve goes on.
    #[error(
        "false root: the equations hold, and a moment of {moment} (in units of the largest force \
         times the mean length) acts on bar {bar}",
        moment = Brief(*moment)
    )]
    FalseRoot { bar: usize, moment: f64 },
    /// Occurs when the singular value decomposition of the Jacobian does not converge.
    #[error("the singular values of the Jacobian (size {size}) did not converge")]
    Spectrum { size: usize },
    /// Occurs when the passes over the bars ran out, or the iteration stopped at rounding errors
    /// larger than the settings allow.
    #[error(
        "the chain does not close: off by {closure} of its length after {passes} passes",
        closure = Brief(*closure)
    )]
    NotClosed {
        /// Distance of the last joint from its anchor, relative to the total length; NaN when no
        /// closed shape was near.
        closure: f64,
        /// Passes over the bars.
        passes: usize,
    },
    /// Occurs when a force or the energy is larger than a double can hold.
    #[error("a force of this chain is larger than a double can hold")]
    Overflow,
    /// Occurs when the supports of connected joints let them move along their total load.
    #[error(
        "joint {joint} and {} connected with it fall: no support resists {load_n} N of their load",
        if *joints == 1 { "the joint".to_owned() } else { format!("the {joints} joints") },
        load_n = Brief(*load_n)
    )]
    Falls { joint: String, joints: usize, load_n: f64 },
    /// Occurs when a joint moves on without end and the energy falls: only struts, which cannot
    /// pull, connect it with the joints that are held.
    #[error(
        "joint {joint} moves on without end: it was {distance_m} m away when it was given up",
        distance_m = Brief(*distance_m)
    )]
    Escapes {
        joint: String,
        /// Its last distance from the first supported joint, m.
        distance_m: f64,
    },
    /// Occurs when two held joints are further apart than the members between them reach.
    #[error(
        "{distance_m} m between {from} and {to}, and the members between them reach {reach_m} m"
    )]
    TooShort {
        /// Name of a held joint.
        from: String,
        to: String,
        distance_m: f64,
        /// Length of the shortest path of members between them, m.
        reach_m: f64,
    },
    /// Occurs when an inextensible member between two anchors has not the length of their distance,
    /// or, as a cable, is shorter, or, as a strut, longer.
    #[error(
        "member {member} of {length} m is held at both ends, {off} m {} apart than that",
        if distance_m > length_m { "further" } else { "less" },
        length = Brief(*length_m), off = Brief((distance_m - length_m).abs())
    )]
    HeldMisfit { member: usize, length_m: f64, distance_m: f64 },
    /// Occurs when no load acts and no member is stretched: every shape is in equilibrium.
    #[error(
        "no load acts on any joint that can move, and no member is stretched: nothing decides the shape"
    )]
    Unloaded,
    /// Occurs when the iteration ends before balance and lengths hold.
    #[error(
        "not converged after {iterations} factorisations: balance of {joint} is off by {unbalance} of \
         the loads there, the length of member {member} by {misfit_m} m",
        unbalance = Brief(*unbalance), misfit_m = Brief(*misfit_m)
    )]
    NotConverged {
        /// Sparse factorisations.
        iterations: usize,
        joint: String,
        /// What is left there, in units of the loads of the joint (of the mean load, where that is
        /// more).
        unbalance: f64,
        member: usize,
        misfit_m: f64,
    },
    /// Occurs when a ring runs to the end of a span of its rope, where friction-free spans have no
    /// direction and the balance has a corner.
    #[error(transparent)]
    Jammed(#[from] RunTogether),
    /// Occurs when the lengths of inextensible members overdetermine the shape, and the shape that
    /// meets them best is off by more than their tolerances.
    #[error("{}", misfit_text(misfits))]
    Misfit {
        /// The members that overdetermine the shape, the largest misfit for its tolerance first.
        misfits: Vec<Misfit>,
    },
    /// Occurs when forces are so large beside the loads that rounding of them is no small part of
    /// the loads: nothing but rounding decides them.
    #[error(
        "member {member} would bear {force_n} N, {ratio} times the loads: so near to a singular shape \
         the forces are not decided by numbers of sixteen digits",
        force_n = Brief(*force_n), ratio = Brief(*ratio)
    )]
    Absurd {
        member: usize,
        force_n: f64,
        /// Its size over the loads and what elastic members bear.
        ratio: f64,
    },
    /// Occurs when the set of joints that lie on the floor does not settle.
    #[error("which joints lie on the floor is still open after {rounds} rounds")]
    Floor { rounds: usize },
    /// Occurs when only unstable equilibria were found, though the hanging one was asked for.
    #[error("only unstable equilibria found, the last of index {index}")]
    Unstable {
        /// Morse index of the last.
        index: usize,
    },
    /// Occurs when the work that a solve may do is done.
    #[error(
        "the work is spent: factors with {spent} entries together were computed, and max_work is {max_work}"
    )]
    Work {
        spent: u64,
        /// What [`Settings::max_work`](crate::net::Settings::max_work) allows.
        max_work: u64,
    },
    /// Occurs when the factor of the matrix cannot be held in memory.
    #[error("no memory for the factor of a matrix of {unknowns} unknowns")]
    Memory { unknowns: usize },
    /// Occurs when derivatives are asked for at an equilibrium that a motion leaves at rest: a part
    /// that turns freely about the vertical, for one.
    #[error(
        "no derivative here: {} no stiffness, as where a part turns freely; a joint of it that slides in a plane \
         (`normal`) holds it",
        if *motions == 1 { "1 motion meets".to_owned() } else { format!("{motions} independent motions meet") }
    )]
    FreeMotion { motions: usize },
    /// Occurs when derivatives are asked for where equilibrium leaves the forces open.
    #[error(
        "no derivative here: {} the forces open, and the lengths of rigid members cannot change one by one",
        if *dimension == 1 { "1 self-stress leaves".to_owned() } else { format!("{dimension} independent self-stresses leave") }
    )]
    OpenForces { dimension: usize },
    /// Occurs when derivatives are asked for where a cable or strut has just its length and bears
    /// no force but that of its own weight.
    #[error(
        "no derivative here: member {member} has just its length and bears no force but that of its own weight; a change to one side \
         loads it, to the other it is slack, and the derivatives of both sides differ"
    )]
    JustTaut { member: usize },
    /// Occurs when derivatives are asked for where a joint just touches the floor.
    #[error(
        "no derivative here: joint {joint} just touches the floor, which does not push it; a change to one \
         side lifts it, to the other it is pushed, and the derivatives of both sides differ"
    )]
    JustTouches { joint: String },
    /// Occurs when derivatives are asked for where there are none: an inextensible member between
    /// the anchors that are to move, or equations that are singular beyond what is counted.
    #[error(
        "no derivative here: the equations leave {left} of a change; a motion without stiffness, a \
         self-stress or a rigid member that an anchor would stretch does that",
        left = Brief(*left)
    )]
    NoDerivative { left: f64 },
    /// Occurs when the derivative by the place of a joint is asked for that is no anchor.
    #[error("joint {joint} is not an anchor: its place is not a parameter")]
    NotAnAnchor { joint: String },
}

fn misfit_text(misfits: &[Misfit]) -> String {
    let Some(worst) = misfits.first() else {
        return "the lengths of inextensible members do not fit together".into();
    };
    let beyond = misfits.iter().filter(|misfit| misfit.misfit_m.abs() > misfit.within_m);
    let more = match beyond.count().saturating_sub(1) {
        0 => String::new(),
        1 => ", and one more is off".into(),
        more => format!(", and {more} more are off"),
    };
    let way = if worst.misfit_m > 0.0 { "further apart" } else { "closer together" };
    format!(
        "rigid members have lengths that do not fit: in the shape that meets them best the ends of member {} \
         are {} m {way} than its length, and it may be off by {} m{more}; say how far the lengths are known \
         (length_tolerance_m), or how stiff the members are (stiffness_n)",
        worst.member + 1,
        Brief(worst.misfit_m.abs()),
        Brief(worst.within_m)
    )
}
