//! What the objects of several answers have in common.

use std::borrow::Borrow;

use model::system::System;
use serde::{Serialize, Serializer};

/// Version of the JSON objects; raised when a key that others rely on changes its meaning.
pub const SCHEMA_VERSION: u32 = 3;

/// The few numbers that name a system.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Its name.
    pub name: String,
    /// Number of joints.
    pub joints: usize,
    /// Number of members.
    pub bars: usize,
    /// Sum of their lengths, m.
    pub total_length_m: f64,
    /// Sum of the masses, kg.
    pub total_mass_kg: f64,
    /// Gravity along −Z, m/s².
    pub gravity_m_s2: f64,
}

impl Summary {
    /// Of a system.
    pub fn new(system: &System) -> Self {
        Self {
            name: system.name().to_owned(),
            joints: system.joints().len(),
            bars: system.members().len(),
            total_length_m: system.total_length_m(),
            total_mass_kg: system.total_mass_kg(),
            gravity_m_s2: system.gravity_m_s2(),
        }
    }
}

/// What the object of every answer begins with: its version, and what was asked about.
pub(crate) fn head<S: Serializer>(
    system: &impl Borrow<System>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Head {
        schema_version: u32,
        system: Summary,
    }
    Head { schema_version: SCHEMA_VERSION, system: Summary::new(system.borrow()) }
        .serialize(serializer)
}

/// What is shown, without its units.
pub(crate) fn names<S: Serializer>(
    of: &[(String, &'static str)],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(of.iter().map(|(name, _)| name))
}

/// Either of the two, as its keys.
pub(crate) fn either<T: Serialize, E: Serialize, S: Serializer>(
    found: &Result<T, E>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    match found {
        Ok(found) => found.serialize(serializer),
        Err(reason) => reason.serialize(serializer),
    }
}
