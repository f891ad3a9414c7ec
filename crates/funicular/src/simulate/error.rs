//! Why a motion does not begin.

use super::MOST_STEPS;

/// How far from where it has to be a joint may be given, in total lengths: angles in whole degrees.
pub(super) const ROUGH: f64 = 0.02;

/// Why a simulation does not begin.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimulateError {
    /// Occurs when a time is zero, negative, infinite or not a number.
    #[error("{what} must be positive and finite, got {value_s} s")]
    Time {
        /// Which time.
        what: &'static str,
        /// Its value.
        value_s: f64,
    },
    /// Occurs when the time has so many steps, more than can be counted.
    #[error("{0:e} steps are too many: at most {MOST_STEPS:e}")]
    Steps(f64),
    /// Occurs when many positions are to come to rest, and there is no damping.
    #[error(
        "without damping nothing comes to rest: give damping by a medium or friction in the joints"
    )]
    NoDamping,
    /// Occurs when no joint has this name, which is to be pushed, or on which a force is to act.
    #[error("there is no joint {0:?}")]
    NoSuchJoint(String),
    /// Occurs when the joint of this name, which is to be pushed, is held.
    #[error("joint {0:?} is an anchor: a push does not move it")]
    PushedAnchor(String),
    /// Occurs when there is no equilibrium of this number.
    #[error("there is no equilibrium {label:?}; there are {}", labels.join(", "))]
    NoSuchEquilibrium {
        /// The number as given.
        label: String,
        /// Those that are found.
        labels: Vec<String>,
    },
    /// Occurs when there are not as many angles as members.
    #[error("{given} angles are given for {bars} bars")]
    AngleCount {
        /// Number of angles.
        given: usize,
        /// Number of members.
        bars: usize,
    },
    /// Occurs when a rigid bar at its angle ends far off the joint that the others lead to.
    #[error(
        "with these angles bar {bar} ends {off:.3} of the total length off joint {joint:?} (at most \
         {ROUGH} is corrected)"
    )]
    Angles {
        /// Number of the bar, from 1.
        bar: usize,
        /// Name of the joint where it should end.
        joint: String,
        /// Distance of its end from there, in units of the total length.
        off: f64,
    },
    /// Occurs when the given places are far from all that the lengths allow.
    #[error(
        "at these places the lengths are not met: joint {joint:?} would have to move by {off:.3} of the \
         total length (at most {ROUGH} is corrected)"
    )]
    Apart {
        /// Name of the joint that would have to move most.
        joint: String,
        /// By how much, in units of the total length.
        off: f64,
    },
}
