//! Where a solve starts.

use model::Vector;
use model::system::System;

use crate::error::Error;

/// Places of the joints, and axial forces if they are known.
#[derive(Debug, Clone, PartialEq)]
pub struct Seed {
    /// Place of each joint, world frame, m. Joints that are held are put where their supports
    /// allow.
    pub joints_m: Vec<Vector>,
    /// Axial force of each member, N, tension positive; without them those that leave the joints
    /// least out of balance.
    pub axial_n: Option<Vec<f64>>,
    /// Whether the places are those of an equilibrium and not of a drawing: every cable that is shorter than its
    /// length, beyond rounding, begins slack, and every strut that is longer.
    pub at_rest: bool,
}

impl Seed {
    /// Places alone.
    pub fn at(joints_m: Vec<Vector>) -> Self {
        Self { joints_m, axial_n: None, at_rest: false }
    }

    /// The places of an equilibrium that is known.
    pub fn at_rest(joints_m: Vec<Vector>) -> Self {
        Self { at_rest: true, ..Self::at(joints_m) }
    }

    pub(super) fn check(&self, system: &System) -> Result<(), Error> {
        let lengths = [
            ("joints", system.joints().len(), self.joints_m.len()),
            ("members", system.members().len(), self.axial_n.as_ref().map_or(0, Vec::len)),
        ];
        let given = if self.axial_n.is_some() { 2 } else { 1 };
        for (of, expected, got) in lengths.into_iter().take(given) {
            if expected != got {
                return Err(Error::SeedLength { of, expected, got });
            }
        }
        let infinite = |place: &Vector| place.iter().any(|c| !c.is_finite());
        if let Some(number) = self.joints_m.iter().position(infinite) {
            return Err(Error::SeedNotFinite { of: "joint", number: number + 1 });
        }
        let forces = self.axial_n.iter().flatten();
        if let Some(number) = forces.clone().position(|force| !force.is_finite()) {
            return Err(Error::SeedNotFinite { of: "member", number: number + 1 });
        }
        Ok(())
    }
}
