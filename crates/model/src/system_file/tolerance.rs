//! How far numbers may be off: keys of bars and joints, and a table `[tolerances]` for all.

use super::error::{Result, SystemFileError};
use super::kind::SystemFileErrorKind as Kind;
use super::row_table::{Row, Wrong};
use super::strength::{first_of, tables};
use super::table::Table;
use crate::system::{Joint, Member, Support, System, ToleranceError};

const LENGTH: &str = "length_tolerance_m";
const STIFFNESS: &str = "stiffness_tolerance";
const MASS: &str = "mass_tolerance_kg";
const AT: &str = "at_tolerance_m";
const FORCE: &str = "force_tolerance_n";
/// The keys of the table.
const KEYS: &[&str] = &[LENGTH, STIFFNESS, MASS, AT, FORCE];
const WANTED: &str = "positive and finite";

/// The tolerances of all bars and joints that have none of their own.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tolerances {
    length_m: Option<f64>,
    stiffness: Option<f64>,
    mass_kg: Option<f64>,
    at_m: Option<f64>,
    force_n: Option<f64>,
}

/// What numbers are read from by key or column.
pub(super) trait Numbers {
    type Error;
    fn get(&self, key: &'static str) -> Result<Option<f64>, Self::Error>;
    fn wrong(&self, kind: Kind, key: &'static str) -> Self::Error;
    fn refused(&self, error: ToleranceError) -> Self::Error {
        let ToleranceError { what, wanted, found } = error;
        self.wrong(Kind::OutOfRange { found: found.to_string(), wanted }, what)
    }
}

impl Numbers for Table<'_> {
    type Error = SystemFileError;
    fn get(&self, key: &'static str) -> Result<Option<f64>> {
        self.number(key)
    }
    fn wrong(&self, kind: Kind, key: &'static str) -> SystemFileError {
        self.error(kind, key)
    }
}

impl Numbers for Row<'_> {
    type Error = Wrong;
    fn get(&self, key: &'static str) -> Result<Option<f64>, Wrong> {
        self.number(key)
    }
    fn wrong(&self, kind: Kind, key: &'static str) -> Wrong {
        (Some(key), kind)
    }
}

/// The table `[tolerances]` of a file.
pub(super) fn all(root: &Table<'_>) -> Result<Tolerances> {
    let Some(value) = root.get("tolerances") else { return Ok(Tolerances::default()) };
    let table = root.table("tolerances", value)?;
    table.only(KEYS)?;
    let number = |key: &str| {
        let number = table.number(key)?;
        match number.filter(|x| !(x.is_finite() && *x > 0.0)) {
            None => Ok(number),
            Some(found) => {
                let kind = Kind::OutOfRange { found: found.to_string(), wanted: WANTED };
                Err(table.error(kind, key))
            }
        }
    };
    Ok(Tolerances {
        length_m: number(LENGTH)?,
        stiffness: number(STIFFNESS)?,
        mass_kg: number(MASS)?,
        at_m: number(AT)?,
        force_n: number(FORCE)?,
    })
}

impl Tolerances {
    /// A member with its own tolerances, or those of all as far as they say anything of it.
    pub(super) fn member<N: Numbers>(&self, member: Member, own: &N) -> Result<Member, N::Error> {
        let (elastic, heavy) = (member.stiffness_n.is_some(), member.body.mass_kg() > 0.0);
        let length_tolerance_m = own.get(LENGTH)?.or(self.length_m);
        let stiffness = own.get(STIFFNESS)?.or(self.stiffness.filter(|_| elastic));
        let mass_kg = own.get(MASS)?.or(self.mass_kg.filter(|_| heavy));
        let mut member = member;
        member.set_length_tolerance(length_tolerance_m);
        member.with_tolerances(stiffness, mass_kg).map_err(|error| own.refused(error))
    }

    /// The same of a joint; the forces of all are those that are there.
    pub(super) fn joint<N: Numbers>(&self, joint: Joint, own: &N) -> Result<Joint, N::Error> {
        let (heavy, held) = (joint.mass_kg > 0.0, joint.support != Support::Free);
        let pulled = joint.force_n.iter().any(|x| x.abs() > 0.0);
        let mass_kg = own.get(MASS)?.or(self.mass_kg.filter(|_| heavy));
        let at_m = own.get(AT)?.or(self.at_m.filter(|_| held));
        let force_n = own.get(FORCE)?.or(self.force_n.filter(|_| pulled));
        joint.with_tolerances(mass_kg, at_m, force_n).map_err(|error| own.refused(error))
    }
}

/// The tolerances of all for masses and forces that came by `[[loads]]`.
pub(super) fn of_loads(root: &Table<'_>, system: System) -> Result<System> {
    if root.get("tolerances").is_none() || root.get("loads").is_none() {
        return Ok(system);
    }
    let all = all(root)?;
    let given = |number: f64| Some(number).filter(|x| *x > 0.0);
    let joint = |joint: &Joint| {
        let own = joint.tolerances.as_deref().copied().unwrap_or_default();
        let heavy = joint.mass_kg > 0.0;
        let pulled = joint.force_n.iter().any(|x| x.abs() > 0.0);
        let mass_kg = given(own.mass_kg()).or(all.mass_kg.filter(|_| heavy));
        let force_n = given(own.force_n()).or(all.force_n.filter(|_| pulled));
        let known = joint.clone().with_tolerances(mass_kg, given(own.at_m()), force_n);
        known.map_err(|error| root.refused(error))
    };
    let joints = system.joints().iter().map(joint).collect::<Result<_, _>>()?;
    Ok(system.with_joints(joints))
}

/// The first key about tolerances that the file of a chain has.
pub(super) fn given(root: &Table<'_>) -> Option<&'static str> {
    let of_all = root.get("tolerances").map(|_| "tolerances");
    of_all.or_else(|| first_of(root, &[LENGTH, MASS]))
}

/// The chain as a system, with how far its numbers may be off.
pub(super) fn put(root: &Table<'_>, system: System) -> Result<System> {
    if given(root).is_none() {
        return Ok(system);
    }
    let all = all(root)?;
    let mut members = Vec::with_capacity(system.members().len());
    for table in tables(root)? {
        let left = &system.members()[members.len()..];
        for member in left.iter().take(table.count("count")?) {
            members.push(all.member(member.clone(), &table)?);
        }
    }
    for member in &system.members()[members.len()..] {
        members.push(all.member(member.clone(), root)?);
    }
    let joints = system.joints().iter().map(|joint| all.joint(joint.clone(), root));
    let joints = joints.collect::<Result<Vec<_>, _>>()?;
    let known = System::new(system.name(), system.gravity_m_s2(), joints, members);
    known
        .map(|known| known.with_cases_of(system))
        .map_err(|error| root.error(Kind::System(error), "bars"))
}
