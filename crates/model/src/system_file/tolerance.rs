//! How far numbers may be off: keys of bars and joints, and a table `[tolerances]` for all.

use super::error::{Result, SystemFileError};
use super::kind::SystemFileErrorKind as Kind;
use super::row_table::{Row, Wrong};
use super::table::Table;
use crate::system::{Joint, Member, RangeError, Support, System};

const LENGTH: &str = "length_tolerance_m";
const STIFFNESS: &str = "stiffness_tolerance";
const MASS: &str = "mass_tolerance_kg";
const AT: &str = "at_tolerance_m";
const FORCE: &str = "force_tolerance_n";
/// The keys of the table.
const KEYS: &[&str] = &[LENGTH, STIFFNESS, MASS, AT, FORCE];

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
    fn refused(&self, error: RangeError) -> Self::Error {
        let RangeError { what, wanted, found } = error;
        self.wrong(Kind::OutOfRange { found: found.to_string(), wanted }, what)
    }
    /// A number that is positive and finite where it is given.
    fn positive(&self, what: &'static str) -> Result<Option<f64>, Self::Error> {
        match self.get(what)? {
            Some(found) if !(found.is_finite() && found > 0.0) => {
                Err(self.refused(RangeError { what, wanted: "positive and finite", found }))
            }
            given => Ok(given),
        }
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
    Ok(Tolerances {
        length_m: table.positive(LENGTH)?,
        stiffness: table.positive(STIFFNESS)?,
        mass_kg: table.positive(MASS)?,
        at_m: table.positive(AT)?,
        force_n: table.positive(FORCE)?,
    })
}

impl Tolerances {
    /// A member with its own tolerances, or those of all as far as they say anything of it.
    pub(super) fn member<N: Numbers>(&self, member: Member, own: &N) -> Result<Member, N::Error> {
        let (elastic, heavy) = (member.stiffness_n.is_some(), member.body.mass_kg() > 0.0);
        let length_tolerance_m = own.get(LENGTH)?.or(self.length_m);
        let stiffness = own.get(STIFFNESS)?.or(self.stiffness.filter(|_| elastic));
        let mass_kg = own.get(MASS)?.or(self.mass_kg.filter(|_| heavy));
        let member = member.with_length_tolerance(length_tolerance_m);
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
