//! An answer as JSON.

use std::borrow::Cow;
use std::collections::BTreeMap;

use model::system::{Name, System, SystemEquilibrium, SystemStability};
use model::{AxialForce, Evidence, SolverName, Vector};
use serde::{Serialize, Serializer};
use serde_json::Value;
use validate::systems::{Near, SystemAgreement, SystemFailure};

use super::SolveAnswer;
use crate::object::head;
use crate::weakest::Weakest;

/// How an answer has its joints and bars in JSON.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Lists {
    /// An object for each, with its name.
    #[default]
    Objects,
    /// An array over all of them for each quantity, in the order of the system: for large systems.
    Columns,
    /// Not at all.
    None,
}

impl SolveAnswer {
    /// The JSON object, with or without its joints and bars.
    pub fn json(&self, lists: Lists) -> impl Serialize + '_ {
        let named = |equilibrium| Named { system: self.system(), equilibrium, lists };
        Object {
            system: self.system(),
            equilibria: self.equilibria().iter().map(named).collect(),
            agreement: self.agreement(),
            failures: self.failures().iter().map(Failure::of).collect(),
            near: self.near(),
            asked_again: self.asked_again(),
        }
    }
}

/// As `funicular solve --json` prints it.
impl Serialize for SolveAnswer {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.json(Lists::default()).serialize(serializer)
    }
}

#[derive(Serialize)]
struct Object<'a> {
    #[serde(flatten, serialize_with = "head")]
    system: &'a System,
    equilibria: Vec<Named<'a>>,
    agreement: Option<&'a SystemAgreement>,
    failures: Vec<Failure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    near: Option<&'a Near>,
    #[serde(skip_serializing_if = "<[SolverName]>::is_empty")]
    asked_again: &'a [SolverName],
}

/// An equilibrium with the names of its joints.
pub(crate) struct Named<'a> {
    pub(crate) system: &'a System,
    pub(crate) equilibrium: &'a SystemEquilibrium,
    pub(crate) lists: Lists,
}

impl Serialize for Named<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Keys<'a> {
            solver: &'a SolverName,
            energy_j: f64,
            #[serde(skip_serializing_if = "Option::is_none")]
            joints: Option<Joints<'a>>,
            #[serde(skip_serializing_if = "Option::is_none")]
            bars: Option<Bars<'a>>,
            #[serde(flatten)]
            columns: Option<Columns<'a>>,
            #[serde(skip_serializing_if = "Option::is_none")]
            reactions_n: Option<BTreeMap<Cow<'a, str>, Vector>>,
            #[serde(skip_serializing_if = "Option::is_none")]
            weakest: Option<Weakest>,
            stability: SystemStability,
            evidence: &'a Evidence,
        }
        let (system, e) = (self.system, self.equilibrium);
        let objects = self.lists == Lists::Objects;
        Keys {
            solver: &e.solver,
            energy_j: e.energy_j,
            joints: objects.then_some(Joints(system, e)),
            bars: objects.then_some(Bars(system, e)),
            columns: (self.lists == Lists::Columns).then(|| Columns::of(system, e)),
            reactions_n: (self.lists != Lists::None).then(|| reactions(system, e)),
            weakest: Weakest::of(system, e),
            stability: e.stability,
            evidence: &e.evidence,
        }
        .serialize(serializer)
    }
}

/// The forces of the ground by the names of their joints.
fn reactions<'a>(system: &'a System, e: &SystemEquilibrium) -> BTreeMap<Cow<'a, str>, Vector> {
    let supported = system.joints().iter().zip(&e.reactions_n);
    // A joint without support has a force of the ground where it lies on the floor.
    let lies = |force: &Vector| force.iter().any(|n| n.abs() > 0.0);
    let supported =
        supported.filter(|(joint, force)| joint.support.at_m().is_some() || lies(force));
    supported.map(|(joint, force)| (joint.name.text(), *force)).collect()
}

/// An array over all joints or all members for each quantity.
#[derive(Serialize)]
struct Columns<'a> {
    joints_m: &'a [Vector],
    axial_n: &'a [f64],
    axial_from_n: Vec<f64>,
    axial_to_n: Vec<f64>,
    axial_max_n: Vec<f64>,
    start_forces_n: &'a [Vector],
    end_forces_n: &'a [Vector],
    #[serde(skip_serializing_if = "Option::is_none")]
    utilisation: Option<Vec<Option<f64>>>,
}

impl<'a> Columns<'a> {
    fn of(system: &System, e: &'a SystemEquilibrium) -> Self {
        let axial = e.axial_forces(system);
        Self {
            utilisation: e.utilisations(system),
            joints_m: &e.joints_m,
            axial_n: &e.axial_n,
            axial_from_n: axial.iter().map(|along| along.from_n).collect(),
            axial_to_n: axial.iter().map(|along| along.to_n).collect(),
            axial_max_n: axial.iter().map(AxialForce::largest_n).collect(),
            start_forces_n: &e.start_forces_n,
            end_forces_n: &e.end_forces_n,
        }
    }
}

/// The joints one by one, so that a million of them are not built up first.
struct Joints<'a>(&'a System, &'a SystemEquilibrium);

impl Serialize for Joints<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Joint<'a> {
            name: &'a Name,
            at_m: Vector,
        }
        let Self(system, e) = self;
        let places = system.joints().iter().zip(&e.joints_m);
        serializer.collect_seq(places.map(|(joint, at_m)| Joint { name: &joint.name, at_m: *at_m }))
    }
}

/// The members one by one.
struct Bars<'a>(&'a System, &'a SystemEquilibrium);

impl Serialize for Bars<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Bar<'a> {
            from: &'a Name,
            to: &'a Name,
            #[serde(skip_serializing_if = "Vec::is_empty")]
            via: Vec<&'a Name>,
            axial_n: f64,
            axial_from_n: f64,
            axial_to_n: f64,
            axial_max_n: f64,
            force_at_start_n: Vector,
            force_at_end_n: Vector,
            #[serde(skip_serializing_if = "Option::is_none")]
            utilisation: Option<f64>,
        }
        let Self(system, e) = self;
        let name = |joint: usize| &system.joints()[joint].name;
        serializer.collect_seq(system.members().iter().enumerate().map(|(k, member)| {
            let along = e.axial_force(system, k);
            Bar {
                from: name(member.from),
                to: name(member.to),
                via: member.via().iter().map(|k| name(*k)).collect(),
                axial_n: e.axial_n[k],
                axial_from_n: along.from_n,
                axial_to_n: along.to_n,
                axial_max_n: along.largest_n(),
                force_at_start_n: e.start_forces_n[k],
                force_at_end_n: e.end_forces_n[k],
                utilisation: e.utilisation(system, k),
            }
        }))
    }
}

/// A solver without an answer.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Failure {
    /// Its name.
    pub solver: SolverName,
    /// Why it has none, in words.
    pub reason: String,
    /// The same with its numbers: the object of the error, under `kind` its name.
    pub refusal: Value,
}

impl Failure {
    /// As JSON has it.
    pub fn of(failure: &SystemFailure) -> Self {
        // Errors are numbers and texts, which JSON has.
        let refusal = serde_json::to_value(failure).unwrap_or_default();
        Self { solver: failure.solver(), reason: failure.to_string(), refusal }
    }
}
