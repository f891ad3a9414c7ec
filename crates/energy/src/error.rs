//! Why there is no answer.

use model::number::Brief;
use serde::Serialize;

/// Why a minimisation gave no answer. `Ok` means converged to a local minimum, nothing less.
#[derive(Debug, Clone, PartialEq, Serialize, thiserror::Error)]
#[serde(tag = "kind", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Error {
    /// Occurs when a setting is out of its range.
    #[error(
        "the setting {field} must lie between {} and {}, got {value}",
        Brief(*low), Brief(*high)
    )]
    Setting {
        /// Name of the field.
        field: &'static str,
        /// Its value.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
    },
    /// Occurs when a seed has not one direction (or angle) per bar.
    #[error("a seed needs one direction for each of the {bars} bars, got {given}")]
    SeedSize {
        /// Bars of the chain.
        bars: usize,
        /// Directions of the seed.
        given: usize,
    },
    /// Occurs when a direction of a seed is zero, infinite or not a number, or has no part in the
    /// plane of the motion.
    #[error("direction {bar} of the seed, [{}, {}, {}], points nowhere", direction[0], direction[1], direction[2])]
    SeedDirection {
        /// Number of the bar, from 1.
        bar: usize,
        /// The direction as given.
        direction: model::Vector,
    },
    /// Occurs when an angle of the paper's example is infinite or not a number.
    #[error("the angles of a seed must be finite, got {angle_rad} rad")]
    SeedAngle {
        /// The bad angle.
        angle_rad: f64,
    },
    /// Occurs when the chain could not be closed on its anchors from the seed.
    #[error(
        "the seed could not be closed on the anchors: {gap} of the total length is left after \
         {iterations} corrections",
        gap = Brief(*gap)
    )]
    NotClosed {
        /// Distance left, in units of the total length.
        gap: f64,
        /// Corrections made.
        iterations: usize,
    },
    /// Occurs when the iterations are used up.
    #[error(
        "not converged after {iterations} iterations: projected gradient {gradient}",
        gradient = Brief(*gradient)
    )]
    IterationLimit {
        /// Iterations made.
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
    Stalled {
        /// Iterations made.
        iterations: u64,
        /// Projected gradient reached, in the unit of its tolerance.
        gradient: f64,
        /// Distance of the last joint from the end anchor, in units of the total length.
        gap: f64,
        /// Directions in which the second derivative is negative.
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
    /// Occurs when a number of the computation is infinite or not a number.
    #[error("the {quantity} is not a finite number")]
    NotFinite {
        /// Which number.
        quantity: &'static str,
    },
    /// Occurs when argmin ends a run for a reason that this crate never gives it: an interrupt, a
    /// timeout, a target cost, or an error of its own.
    #[error("argmin ended the run: {reason}")]
    Ended {
        /// The reason, in argmin's words.
        reason: String,
    },
}

impl Error {
    /// The kind of the error in a few words, for counting.
    #[must_use]
    pub fn reason(&self) -> &'static str {
        match self {
            Self::Setting { .. } => "setting out of range",
            Self::SeedSize { .. } | Self::SeedDirection { .. } | Self::SeedAngle { .. } => {
                "bad seed"
            }
            Self::NotClosed { .. } => "not closed",
            Self::IterationLimit { .. } => "iteration limit",
            Self::Stalled { .. } => "stalled",
            Self::NearlyFolded { .. } => "nearly folded",
            Self::NotFinite { .. } => "not finite",
            Self::Ended { .. } => "ended by argmin",
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
            (Error::NotClosed { gap: 0.1, iterations: 3 }, "not closed"),
            (Error::IterationLimit { iterations: 3, gradient: 0.1 }, "iteration limit"),
            (Error::Stalled { iterations: 3, gradient: 0.1, gap: 0.0, directions: 1 }, "stalled"),
            (Error::NearlyFolded { across: 1e-9 }, "nearly folded"),
            (Error::NotFinite { quantity: "energy" }, "not finite"),
            (Error::Ended { reason: "interrupt".to_owned() }, "ended by argmin"),
        ];
        for (error, reason) in all {
            assert_eq!(error.reason(), reason);
        }
    }
}
