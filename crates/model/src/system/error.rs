//! Why a system cannot be built.

use super::{Joint, Member};

/// Why a system cannot be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SystemError {
    /// Occurs when gravity is zero, negative, infinite or not a number.
    #[error("gravity must be positive and finite (it acts along -Z), got {gravity_m_s2} m/s^2")]
    Gravity {
        /// Gravity as given.
        gravity_m_s2: f64,
    },
    /// Occurs when a member begins or ends at a joint that is not there.
    #[error("member {member} meets joint {joint}, and there are only {joints}")]
    NoSuchJoint {
        /// Number of the member, from 1.
        member: usize,
        /// Number of the joint, from 0.
        joint: usize,
        /// Number of joints.
        joints: usize,
    },
    /// Occurs when a member begins and ends at the same joint.
    #[error("member {member} begins and ends at joint {joint}")]
    SelfLoop {
        /// Number of the member, from 1.
        member: usize,
        /// Name of the joint.
        joint: String,
    },
}

/// Refuse what is no system.
pub(super) fn check(
    gravity_m_s2: f64,
    joints: &[Joint],
    members: &[Member],
) -> Result<(), SystemError> {
    if !(gravity_m_s2.is_finite() && gravity_m_s2 > 0.0) {
        return Err(SystemError::Gravity { gravity_m_s2 });
    }
    for (k, member) in members.iter().enumerate() {
        for joint in [member.from, member.to] {
            if joint >= joints.len() {
                return Err(SystemError::NoSuchJoint {
                    member: k + 1,
                    joint,
                    joints: joints.len(),
                });
            }
        }
        if member.from == member.to {
            let joint = joints[member.from].name.clone();
            return Err(SystemError::SelfLoop { member: k + 1, joint });
        }
    }
    Ok(())
}
