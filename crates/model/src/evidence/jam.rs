//! A span of a rope without length.

use std::fmt::{self, Display, Formatter};

use serde::Serialize;

use super::from_one;
use crate::Vector;

/// A span of a rope whose two joints are in one place: a ring that has run to a pulley, to the end of its
/// rope or to another ring.
///
/// The length of the span has a corner there. It has no direction, and pulls with any force up to the tension.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Jam {
    /// Number of the rope among the members, from 0; from 1 in JSON.
    #[serde(with = "from_one")]
    pub member: usize,
    /// Number of the span in the rope, from 0; from 1 in JSON.
    #[serde(with = "from_one")]
    pub span: usize,
    /// Its pull on its first joint, world frame, N, the opposite of that on its second.
    pub pull_n: Vector,
}

impl Display for Jam {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.pull_n;
        let pull_n = x.hypot(y).hypot(z);
        let (member, span) = (self.member + 1, self.span + 1);
        write!(f, "span {span} of the rope (bar {member}) has no length and bears {pull_n:.6} N")
    }
}
