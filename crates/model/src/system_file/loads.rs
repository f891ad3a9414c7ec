//! `[[loads]]` of a chain: masses and forces at its joints.

use toml::de::DeArray;

use super::error::SystemFileError;
use super::kind::SystemFileErrorKind as Kind;
use super::strength;
use super::table::Table;
use super::tolerance;
use crate::Chain;
use crate::system::System;

const LOAD_KEYS: &[&str] = &["joint", "mass_kg", "force_n"];
const WANTED: &str = "one or more tables [[loads]] with joint, and mass_kg or force_n";

/// The chain as a system with the loads of the file at its joints, the strengths of its bars and the
/// tolerances of its numbers, above its floor.
pub(super) fn put(root: &Table<'_>, chain: &Chain) -> Result<System, SystemFileError> {
    let system =
        if root.get("loads").is_some() { loaded(root, chain)? } else { System::from(chain) };
    let system = tolerance::put(root, strength::put(root, system)?)?;
    match root.number("floor_m")? {
        None => Ok(system),
        Some(floor_m) => {
            system.with_floor(floor_m).map_err(|error| root.error(Kind::System(error), "floor_m"))
        }
    }
}

fn loaded(root: &Table<'_>, chain: &Chain) -> Result<System, SystemFileError> {
    let value = root.require("loads", WANTED)?;
    let tables = value.get_ref().as_array();
    let tables: &DeArray<'_> = tables.ok_or_else(|| root.wrong_type("loads", value, WANTED))?;
    let bare = System::from(chain);
    let (mut joints, members) = (bare.joints().to_vec(), bare.members().to_vec());
    for (k, value) in tables.iter().enumerate() {
        let table = root.table(&format!("loads[{}]", k + 1), value)?;
        table.only(LOAD_KEYS)?;
        let place = table.require("joint", "the number of a joint, from 1 to bars - 1")?;
        let number = table.count_of("joint", place, "the number of a joint, 1 or more")?;
        let last = joints.len() - 1;
        if number >= last {
            let kind = if number == last {
                Kind::LoadedAnchor { joint: number.to_string() }
            } else {
                Kind::OutOfRange {
                    found: number.to_string(),
                    wanted: "the joints between the bars, from 1 to the number of bars less 1",
                }
            };
            return Err(table.error(kind, "joint"));
        }
        let joint = &mut joints[number];
        let mass = table.number("mass_kg")?;
        let force = table.get("force_n").map(|value| table.vector("force_n", value)).transpose()?;
        if mass.is_none() && force.is_none() {
            return Err(table.error(Kind::NoLoadGiven, "joint"));
        }
        joint.mass_kg += mass.unwrap_or(0.0);
        for (sum, component) in joint.force_n.iter_mut().zip(force.unwrap_or_default()) {
            *sum += component;
        }
        table.check_load(mass, force)?;
    }
    System::new(chain.name(), chain.gravity_m_s2(), joints, members)
        .map_err(|error| root.error(Kind::System(error), "loads"))
}
