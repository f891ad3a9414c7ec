//! `[[loads]]`: masses and forces at joints, forces along bars; and `[[cases]]`, in which they act together.

use std::collections::HashMap;

use super::error::Result;
use super::kind::SystemFileErrorKind as Kind;
use super::network::unknown_joint;
use super::table::{Table, Value};
use super::tolerance;
use crate::system::{LoadCase, LoadOn, NamedLoad, PERMANENT, System, SystemError};

const LOAD_KEYS: &[&str] = &["name", "joint", "bar", "mass_kg", "force_n", "force_n_per_m"];
const CASE_KEYS: &[&str] = &["name", "factors"];
const WANTED: &str = "one or more tables [[loads]] with joint, and mass_kg or force_n";
const WANTED_CASES: &str = "one or more tables [[cases]] with name and factors";
const WANTED_FACTORS: &str = "a table of factors by the names of loads, such as { wind = 1.5 }";
const WANTED_FORCE: &str = "the force on each metre of the bar, N/m, [x, y, z]";
/// What the program takes for all cases.
const ALL: &str = "each";

/// The joint that a value of a load names.
type JointOf<'a> = &'a dyn Fn(&Table<'_>, &Value<'_>) -> Result<usize>;

/// A chain, as a system, with the loads of the file at its joints, above its floor.
pub(super) fn of_chain(root: &Table<'_>, system: System) -> Result<System> {
    let last = system.joints().len() - 1;
    let system = put(root, system, &|table, value| numbered(table, value, last))?;
    let system = tolerance::of_loads(root, system)?;
    let system = system.with_floor(root.number("floor_m")?);
    system.map_err(|error| root.error(Kind::System(error), "floor_m"))
}

/// The number of a joint between the anchors of a chain.
fn numbered(table: &Table<'_>, value: &Value<'_>, last: usize) -> Result<usize> {
    let number = table.count_of("joint", value, "the number of a joint, 1 or more")?;
    if number < last {
        return Ok(number);
    }
    let kind = if number == last {
        Kind::LoadedAnchor(number.to_string())
    } else {
        Kind::OutOfRange {
            found: number.to_string(),
            wanted: "the joints between the bars, from 1 to the number of bars less 1",
        }
    };
    Err(table.error(kind, "joint"))
}

/// The system, whose joints have names, with the loads and the cases of the file.
pub(super) fn by_name(root: &Table<'_>, system: System) -> Result<System> {
    if root.get("loads").is_none() && root.get("cases").is_none() {
        return Ok(system);
    }
    let joints = system.joints().to_vec();
    let numbers: HashMap<_, usize> =
        joints.iter().enumerate().map(|(k, joint)| (joint.name.text(), k)).collect();
    put(root, system, &|table, value| {
        let Some(name) = value.get_ref().as_str() else {
            return Err(table.wrong_type("joint", value, "the name of a joint"));
        };
        match numbers.get(name) {
            Some(k) if !joints[*k].support.is_fixed() => Ok(*k),
            Some(_) => Err(table.error(Kind::LoadedAnchor(name.to_owned()), "joint")),
            None => Err(table.error(unknown_joint(name, &joints), "joint")),
        }
    })
}

/// The system with the loads and the cases of the file.
fn put(root: &Table<'_>, system: System, joint: JointOf<'_>) -> Result<System> {
    let load_tables = root.tables("loads", WANTED)?.collect::<Result<Vec<_>>>()?;
    let case_tables = root.tables("cases", WANTED_CASES)?.collect::<Result<Vec<_>>>()?;
    if load_tables.is_empty() && case_tables.is_empty() {
        return Ok(system);
    }
    let loads = load_tables.iter().map(|table| load(table, &system, joint));
    let loads = loads.collect::<Result<Vec<_>, _>>()?;
    let cases = case_tables.iter().map(case).collect::<Result<Vec<_>, _>>()?;
    let called = |table: &&Table<'_>, name: &str| table.text("name").ok().flatten() == Some(name);
    system.with_loads(loads, cases).map_err(|error| match &error {
        SystemError::DuplicateCase(case)
        | SystemError::Factor { case, .. }
        | SystemError::UnknownLoad { case, .. } => {
            let table = case_tables.iter().rev().find(|table| called(table, case)).unwrap_or(root);
            let key =
                if matches!(error, SystemError::DuplicateCase(_)) { "name" } else { "factors" };
            table.error(Kind::System(error), key)
        }
        _ => root.error(Kind::System(error), "loads"),
    })
}

fn load(table: &Table<'_>, system: &System, joint: JointOf<'_>) -> Result<NamedLoad> {
    table.only(LOAD_KEYS)?;
    let name = table.text("name")?.unwrap_or(PERMANENT).to_owned();
    let on_bars = table.get("bar").is_some();
    let (other, apart): (_, &[&'static str]) = if on_bars {
        ("bar", &["joint", "mass_kg", "force_n"])
    } else {
        ("joint", &["force_n_per_m"])
    };
    if let Some(key) = apart.iter().find(|key| table.get(key).is_some()) {
        return Err(table.error(Kind::Conflict { key, other }, key));
    }
    let on = if on_bars {
        let members = several(table, "bar", "the number of a bar, from 1", &|value| {
            bar(table, value, system)
        })?;
        let force = table.require("force_n_per_m", WANTED_FORCE)?;
        let force_n_per_m = table.vector("force_n_per_m", force)?;
        table.check_load(None, Some(force_n_per_m), "force_n_per_m")?;
        LoadOn::Members { members, force_n_per_m }
    } else {
        const WANTED: &str = "the joint where the load acts, or several, [..]";
        let joints = several(table, "joint", WANTED, &|value| joint(table, value))?;
        let mass = table.number("mass_kg")?;
        let force = table.get("force_n").map(|value| table.vector("force_n", value)).transpose()?;
        if mass.is_none() && force.is_none() {
            return Err(table.error(Kind::NoLoadGiven, "joint"));
        }
        table.check_load(mass, force, "force_n")?;
        LoadOn::Joints { joints, mass_kg: mass.unwrap_or(0.0), force_n: force.unwrap_or_default() }
    };
    Ok(NamedLoad { name, on })
}

/// What one value names, or each of an array of them.
fn several(
    table: &Table<'_>,
    key: &'static str,
    wanted: &'static str,
    one: &dyn Fn(&Value<'_>) -> Result<usize>,
) -> Result<Vec<usize>> {
    let value = table.require(key, wanted)?;
    let Some(items) = value.get_ref().as_array() else { return Ok(vec![one(value)?]) };
    if items.is_empty() {
        return Err(table.wrong_type(key, value, wanted));
    }
    let room = table.source().budget.take_members(items.len());
    room.map_err(|error| table.error(Kind::Memory(error), key))?;
    items.iter().map(one).collect()
}

/// The member of a number from 1.
fn bar(table: &Table<'_>, value: &Value<'_>, system: &System) -> Result<usize> {
    let number = table.count_of("bar", value, "the number of a bar, from 1")?;
    if number <= system.members().len() {
        return Ok(number - 1);
    }
    let (found, wanted) = (number.to_string(), "from 1 to the number of bars");
    Err(table.error(Kind::OutOfRange { found, wanted }, "bar"))
}

fn case(table: &Table<'_>) -> Result<LoadCase> {
    table.only(CASE_KEYS)?;
    table.require("name", "what the case is called")?;
    let name = table.text("name")?.unwrap_or_default().to_owned();
    if name == ALL {
        let kind = Kind::OutOfRange {
            found: format!("{ALL:?}"),
            wanted: "any other name: this stands for all cases",
        };
        return Err(table.error(kind, "name"));
    }
    let factors = table.table("factors", table.require("factors", WANTED_FACTORS)?)?;
    let factor =
        |(load, value): (&str, &Value<'_>)| Ok((load.to_owned(), factors.number_of(load, value)?));
    let factors = factors.in_order().into_iter().map(factor).collect::<Result<_>>()?;
    Ok(LoadCase { name, factors })
}
