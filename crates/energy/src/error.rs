use model::Vector;
use model::number::Brief;
use model::system::Misfit;
use serde::Serialize;

/// Why a minimisation gave no answer. `Ok` means converged to a local minimum, nothing less. Numbers count from 1.
#[derive(Debug, Clone, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum Error {
    /// Occurs when a setting is out of its range.
    #[error(
        "the setting {field} must lie between {} and {}, got {value}",
        Brief(*low), Brief(*high)
    )]
    Setting { field: &'static str, value: f64, low: f64, high: f64 },
    /// Occurs when no force acts and no member is strained: nothing decides the shape.
    #[error("no force acts on the system, and no member is strained: nothing decides its shape")]
    NoLoad,
    /// Occurs when a part of the system is free to move for ever along its load.
    #[error(
        "the part of the system with joint {joint} falls for ever: its supports leave it free to move along \
         a force of {} N", Brief(*force_n)
    )]
    Falls { joint: String, force_n: f64 },
    /// Occurs when a seed has not one direction (or angle) per bar.
    #[error("a seed needs one direction for each of the {bars} bars, got {given}")]
    SeedSize { bars: usize, given: usize },
    /// Occurs when a direction of a seed is zero, infinite or not a number, or has no part in the
    /// plane of the motion.
    #[error("direction {bar} of the seed, [{}, {}, {}], points nowhere", direction[0], direction[1], direction[2])]
    SeedDirection { bar: usize, direction: Vector },
    /// Occurs when an angle of the paper's example is infinite or not a number.
    #[error("the angles of a seed must be finite, got {angle_rad} rad")]
    SeedAngle { angle_rad: f64 },
    /// Occurs when the chain could not be closed on its anchors from the seed.
    #[error(
        "the seed could not be closed on the anchors: {gap} of the total length is left after \
         {iterations} corrections",
        gap = Brief(*gap)
    )]
    SeedNotClosed {
        /// Distance left, in units of the total length.
        gap: f64,
        iterations: usize,
    },
    /// Occurs when the iterations are used up.
    #[error(
        "not converged after {iterations} iterations: projected gradient {gradient}",
        gradient = Brief(*gradient)
    )]
    NotConverged {
        iterations: u64,
        /// Projected gradient reached, in the unit of its tolerance.
        gradient: f64,
    },
    /// Occurs when no step lowers the energy any further, and the place is not a minimum to the
    /// tolerances: the projected gradient or the closure is above its tolerance, or the energy
    /// falls in some directions by less than its rounding, so that a saddle cannot be told from a
    /// minimum.
    #[error(
        "no step lowers the energy any further after {iterations} iterations: projected gradient \
         {gradient}, closure {gap} of the total length, negative curvature in {directions} \
         directions",
        gradient = Brief(*gradient), gap = Brief(*gap)
    )]
    NoDescent {
        iterations: u64,
        /// Projected gradient reached, in the unit of its tolerance.
        gradient: f64,
        /// Distance of the last joint from the end anchor, in units of the total length.
        gap: f64,
        directions: usize,
    },
    /// Occurs when all bars lie on one line as far as double precision tells, and the anchors do
    /// not: a chain folded to a fraction of 1e-7 of its length, whose least energy depends on
    /// angles that are lost.
    #[error(
        "the bars lie on one line to rounding and the anchors {across} of the total length off it: what decides \
         between the positions of such a folded chain is lost in double precision",
        across = Brief(*across)
    )]
    NearlyFolded {
        /// Distance of the end anchor from the line, in units of the total length.
        across: f64,
    },
    /// Occurs when a seed has not one place per joint, or one that is not finite.
    #[error("a seed needs a finite place for each of the {joints} joints, got {given}")]
    Seed { joints: usize, given: usize },
    /// Occurs when no configuration is found that keeps the lengths: supports too far apart, or a
    /// loop that cannot be closed.
    #[error(
        "the lengths cannot all be kept: member {member} is {misfit_m} m off in the best configuration found",
        misfit_m = Brief(*misfit_m)
    )]
    NotClosed { member: usize, misfit_m: f64 },
    /// Occurs when a ring runs to the end of a span of its rope: the energy has a corner there, and no
    /// gradient that could vanish.
    #[error(
        "the rope (member {member}) jams: its span {span} has no length left, and the energy a corner there"
    )]
    Jammed { member: usize, span: usize },
    /// Occurs when more inextensible members meet than decide the shape, and their lengths do not
    /// fit each other within their tolerances.
    #[error("{}", misfit_message(misfits))]
    Misfit {
        /// The members that would be under self-stress, the worst first.
        misfits: Vec<Misfit>,
    },
    /// Occurs when the joints balance with forces so large beside the loads and the prestress of the
    /// system that their rounding is no longer small beside these: next to a singular shape.
    #[error(
        "the lengths are kept with {ratio} times the loads in member {member} alone, of which nothing is \
         certain: the shape is next to one that bears any forces",
        ratio = Brief(*ratio)
    )]
    Absurd {
        member: usize,
        /// Its force over the sum of the loads and the largest force of an elastic member.
        ratio: f64,
    },
    /// Occurs when joints are out of balance by more than a part of what loads them.
    #[error(
        "joint {joint} is out of balance by {unbalance} of its load",
        unbalance = Brief(*unbalance)
    )]
    Unbalanced {
        joint: String,
        /// The unbalanced force over the load of the joint, or over the mean load where that is more.
        unbalance: f64,
    },
    /// Occurs when the iterations are used up.
    #[error(
        "not converged after {iterations} iterations: unbalanced force {unbalance} of the largest, lengths \
         off by {misfit}",
        unbalance = Brief(*unbalance), misfit = Brief(*misfit)
    )]
    IterationLimit {
        iterations: u64,
        /// Largest unbalanced force over the largest force.
        unbalance: f64,
        /// Largest misfit of a length over the length.
        misfit: f64,
    },
    /// Occurs when the work of a minimisation is used up.
    #[error(
        "not converged within the work it may do: factors of {spent} numbers were computed, and max_work is \
         {max_work}"
    )]
    Work { spent: u64, max_work: u64 },
    /// Occurs when no step lowers the energy and the residual is still above its tolerance.
    #[error(
        "no step lowers the energy any further: unbalanced force {unbalance} of the largest, lengths off \
         by {misfit}",
        unbalance = Brief(*unbalance), misfit = Brief(*misfit)
    )]
    Stalled {
        /// Largest unbalanced force over the largest force.
        unbalance: f64,
        /// Largest misfit of a length over the length.
        misfit: f64,
    },
    /// Occurs when the configuration found is not a minimum: the energy falls in some directions.
    #[error(
        "the configuration found is not a minimum: the energy falls in {index} independent directions"
    )]
    NoMinimum { index: usize },
    /// Occurs when the descent from a drawing leads far away from it: no minimum lies next to it.
    #[error(
        "no minimum near the drawing: the descent ends where joint {joint} is {moved_m} m away",
        moved_m = Brief(*moved_m)
    )]
    NoMinimumNear { joint: String, moved_m: f64 },
    /// Occurs when joints balance with a cable that pushes or a strut that pulls alone.
    #[error(
        "no minimum found: the joints would balance with {force_n} N in member {member}, which it cannot \
         bear (a cable pulls, a strut pushes)"
    )]
    WrongSign {
        member: usize,
        /// The axial force that would balance, tension positive, N.
        force_n: f64,
    },
    /// Occurs when joints balance with a floor that pulls alone.
    #[error(
        "no minimum found: joint {joint} would balance with {force_n} N from the floor, which only pushes"
    )]
    FloorPulls {
        joint: String,
        /// The force that would balance, up positive, N.
        force_n: f64,
    },
    /// Occurs when a number of the computation is infinite or not a number.
    #[error("the {quantity} is not a finite number")]
    NotFinite { quantity: &'static str },
    /// Occurs when there is not enough memory for the factorisation.
    #[error("not enough memory to factorise a system of {coordinates} coordinates")]
    Memory { coordinates: usize },
    /// Occurs when argmin ends a run for a reason that this crate never gives it.
    #[error("argmin ended the run: {reason}")]
    Ended { reason: String },
}

/// The worst misfit with its numbers, how many more, and what helps.
fn misfit_message(misfits: &[Misfit]) -> String {
    let Some(Misfit { member, misfit_m, within_m }) = misfits.first() else {
        return "the lengths do not fit each other".to_owned();
    };
    let over = misfits.iter().filter(|other| other.misfit_m.abs() > other.within_m).count();
    format!(
        "the lengths overdetermine the shape and do not fit each other: in the shape that meets them best \
         member {} is {} m off, where {} m are allowed, and {} more are off by more than \
         allowed; give the lengths more exactly, or their length_tolerance_m, or stiffness_n: then the \
         self-stress is real",
        member + 1,
        Brief(*misfit_m),
        Brief(*within_m),
        over.saturating_sub(1),
    )
}

impl Error {
    /// [`Setting`](Self::Setting) for a value out of its range; NaN is in none.
    pub(crate) fn unless_within(
        field: &'static str,
        value: f64,
        low: f64,
        high: f64,
    ) -> Result<(), Self> {
        let is_within = (low..=high).contains(&value);
        if is_within { Ok(()) } else { Err(Self::Setting { field, value, low, high }) }
    }

    /// The kind of an error of a chain in a few words, for counting.
    pub fn reason(&self) -> &'static str {
        match self {
            Self::Setting { .. } => "setting out of range",
            Self::SeedSize { .. } | Self::SeedDirection { .. } | Self::SeedAngle { .. } => {
                "bad seed"
            }
            Self::SeedNotClosed { .. } => "not closed",
            Self::NotConverged { .. } => "iteration limit",
            Self::NoDescent { .. } => "stalled",
            Self::NearlyFolded { .. } => "nearly folded",
            Self::NotFinite { .. } => "not finite",
            Self::Ended { .. } => "ended by argmin",
            _ => "another error",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reasons are counted and compared over runs: none may take the place of another.
    #[test]
    fn every_kind_has_its_reason() {
        let seed = "bad seed";
        let all = [
            (
                Error::Setting { field: "f", value: 2.0, low: 0.0, high: 1.0 },
                "setting out of range",
            ),
            (Error::SeedSize { bars: 3, given: 2 }, seed),
            (Error::SeedDirection { bar: 1, direction: [0.0; 3] }, seed),
            (Error::SeedAngle { angle_rad: f64::NAN }, seed),
            (Error::SeedNotClosed { gap: 0.1, iterations: 3 }, "not closed"),
            (Error::NotConverged { iterations: 3, gradient: 0.1 }, "iteration limit"),
            (Error::NoDescent { iterations: 3, gradient: 0.1, gap: 0.0, directions: 1 }, "stalled"),
            (Error::NearlyFolded { across: 1e-9 }, "nearly folded"),
            (Error::NotFinite { quantity: "energy" }, "not finite"),
            (Error::Ended { reason: "interrupt".to_owned() }, "ended by argmin"),
        ];
        for (error, reason) in all {
            assert_eq!(error.reason(), reason);
        }
    }
}
