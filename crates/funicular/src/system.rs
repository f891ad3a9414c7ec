//! The hanging equilibrium of any system, by both solvers.

use std::collections::BTreeMap;
use std::io::{self, Write};

use model::system::{System, SystemEquilibrium, SystemStability};
use model::{Evidence, Rung, SolverName, Vector};
use serde::Serialize;
use serde::ser::SerializeSeq;
use validate::systems::{Near, SystemAgreement, SystemAnswer, SystemFailure, ask_with};

use crate::csv::{Numbers, quoted};
use crate::error::Error;
use crate::solve::{Failure, SCHEMA_VERSION, Solve};
use crate::threads;

impl Solve {
    /// Solve a system of joints and members: any network of bars, cables and struts, rigid or
    /// elastic, under weights and constant forces.
    ///
    /// ```
    /// use funicular::prelude::*;
    /// // A lamp of 2 kg on two cables of 5 m between anchors 6 m apart: each pulls with 5/4 of
    /// // 10 N.
    /// let joints = vec![
    ///     Joint::anchor("A", [-3.0, 0.0, 0.0]),
    ///     Joint::anchor("B", [3.0, 0.0, 0.0]),
    ///     Joint::free("lamp").with_mass(2.0),
    /// ];
    /// let body = Bar::homogeneous(5.0, 0.0)?;
    /// let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
    /// let system = System::new("a lamp", 10.0, joints, members)?;
    /// let answer = Solve::new().run_system(&system)?;
    /// assert!(answer.agrees());
    /// let hanging = &answer.equilibria()[0];
    /// assert!((hanging.axial_n[0] - 12.5).abs() < 1e-9);
    /// assert!((hanging.joints_m[2][2] + 4.0).abs() < 1e-9);
    /// assert_eq!(hanging.evidence.rung(), Some(Rung::Optimal));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`Error::SystemRefused`] when the system has no equilibrium, [`Error::UnsolvedSystem`] when
    /// no solver has an answer; if one has, [`SystemSolution::failures`] says why the other has
    /// none.
    pub fn run_system(&self, system: &System) -> Result<SystemSolution, Error> {
        self.run_system_watched(system, &|_| {})
    }

    /// The same, with `watch` told what is being done.
    ///
    /// # Errors
    ///
    /// As [`run_system`](Self::run_system).
    pub fn run_system_watched(
        &self,
        system: &System,
        watch: &(dyn Fn(&str) + Sync),
    ) -> Result<SystemSolution, Error> {
        system.refusal()?;
        threads::on(self.threads_asked(), || {
            let answer = ask_with(system, self.solvers_asked(), self.census_asked(), watch);
            let answer = SystemSolution { system: system.clone(), answer };
            if answer.equilibria().is_empty() {
                return Err(Error::UnsolvedSystem(Box::new(answer)));
            }
            Ok(answer)
        })?
    }
}

/// What the solvers found for a system, and how far it is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemSolution {
    system: System,
    answer: SystemAnswer,
}

impl SystemSolution {
    /// What was solved.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// One equilibrium for each solver that has an answer, with its evidence: `lagrange` first.
    #[must_use]
    pub fn equilibria(&self) -> &[SystemEquilibrium] {
        &self.answer.equilibria
    }

    /// The same, given away: no array is copied.
    #[must_use]
    pub fn into_equilibria(self) -> Vec<SystemEquilibrium> {
        self.answer.equilibria
    }

    /// The answer of one solver, if it has one.
    #[must_use]
    pub fn by(&self, solver: &SolverName) -> Option<&SystemEquilibrium> {
        self.answer.by(solver)
    }

    /// Why solvers that were asked have no answer.
    #[must_use]
    pub fn failures(&self) -> &[SystemFailure] {
        &self.answer.failures
    }

    /// The comparison, and the judge's findings, if there are two answers.
    #[must_use]
    pub fn agreement(&self) -> Option<&SystemAgreement> {
        self.answer.agreement.as_ref()
    }

    /// How the answer lies to the shape given, where the question is the equilibrium next to it;
    /// nothing where it is the lowest of all.
    #[must_use]
    pub fn near(&self) -> Option<&Near> {
        self.answer.near.as_ref()
    }

    /// Whether both solvers answered and agree, and the judge finds both in balance.
    #[must_use]
    pub fn agrees(&self) -> bool {
        self.answer.agrees()
    }

    /// Whether a check has failed: the answers disagree, or the judge refuses one.
    #[must_use]
    pub fn check_failed(&self) -> bool {
        let disagree = self.agreement().is_some_and(|agreement| !agreement.agrees());
        disagree || self.equilibria().iter().any(|answer| answer.evidence.ladder.failed())
    }

    /// Whether every solver that was asked has an answer, each has converged or is proved to be an
    /// equilibrium, and it is the neighbour of the drawing where that is the question.
    #[must_use]
    pub fn is_decided(&self) -> bool {
        let known = |answer: &SystemEquilibrium| {
            let ladder = &answer.evidence.ladder;
            ladder.converged.is_reached() || ladder.verified.is_reached()
        };
        let asked_for = self.near().is_none_or(|near| near.is_neighbour);
        asked_for && self.failures().is_empty() && self.equilibria().iter().all(known)
    }

    /// The highest rung that an answer has reached.
    #[must_use]
    pub fn rung(&self) -> Option<Rung> {
        self.equilibria().iter().filter_map(|equilibrium| equilibrium.evidence.rung()).max()
    }

    /// The JSON object without the lists of joints, bars and reactions.
    #[must_use]
    pub fn summary(&self) -> impl Serialize + '_ {
        self.object(true)
    }

    /// Joints as CSV, a line per solver and joint: its place, and the force of the ground on it.
    /// What is zero but for rounding is written as 0.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_joints_csv(&self, mut to: impl Write) -> io::Result<()> {
        writeln!(to, "solver,joint,x_m,y_m,z_m,reaction_x_n,reaction_y_n,reaction_z_n")?;
        for e in self.equilibria() {
            let places = Numbers::of(e.joints_m.as_flattened());
            // A support that bears nothing has the rounding of the members' forces.
            let forces = Numbers::of(e.reactions_n.as_flattened().iter().chain(&e.axial_n));
            let joints = self.system.joints().iter().zip(&e.joints_m).zip(&e.reactions_n);
            for ((joint, at_m), force_n) in joints {
                let (place, force) = (places.cells(*at_m), forces.cells(*force_n));
                writeln!(to, "{},{},{place},{force}", e.solver, quoted(&joint.name))?;
            }
        }
        Ok(())
    }

    /// Members as CSV, a line per solver and member: its joints, axial force (with the weight at the
    /// joints, at both ends, and where it is largest), and the forces on it at both joints. What is zero but for rounding is written as 0.
    ///
    /// # Errors
    ///
    /// When `to` cannot be written.
    pub fn write_bars_csv(&self, mut to: impl Write) -> io::Result<()> {
        writeln!(
            to,
            "solver,bar,from,to,axial_n,axial_from_n,axial_to_n,axial_max_n,start_x_n,start_y_n,start_z_n,end_x_n,end_y_n,end_z_n"
        )?;
        for e in self.equilibria() {
            let ends = e.start_forces_n.as_flattened().iter().chain(e.end_forces_n.as_flattened());
            let (ends, axial) = (Numbers::of(ends), Numbers::of(&e.axial_n));
            for (k, member) in self.system.members().iter().enumerate() {
                let name = |joint: usize| quoted(&self.system.joints()[joint].name);
                let (from, end) = (name(member.from), name(member.to));
                let along = e.axial_force(&self.system, k);
                let force = [e.axial_n[k], along.from_n, along.to_n, along.largest_n()]
                    .map(|force| axial.cell(force).to_string())
                    .join(",");
                let (start_n, end_n) =
                    (ends.cells(e.start_forces_n[k]), ends.cells(e.end_forces_n[k]));
                writeln!(to, "{},{},{from},{end},{force},{start_n},{end_n}", e.solver, k + 1)?;
            }
        }
        Ok(())
    }

    fn object(&self, bare: bool) -> Object<'_> {
        let named = |equilibrium| Named { system: &self.system, equilibrium, bare };
        Object {
            schema_version: SCHEMA_VERSION,
            system: Summary::of(&self.system),
            equilibria: self.equilibria().iter().map(named).collect(),
            agreement: self.agreement(),
            failures: self.failures().iter().map(Failure::of_system).collect(),
            near: self.near(),
        }
    }
}

/// As `funicular solve --json` prints it.
impl Serialize for SystemSolution {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.object(false).serialize(serializer)
    }
}

#[derive(Serialize)]
struct Object<'a> {
    schema_version: u32,
    system: Summary<'a>,
    equilibria: Vec<Named<'a>>,
    agreement: Option<&'a SystemAgreement>,
    failures: Vec<Failure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    near: Option<&'a Near>,
}

#[derive(Serialize)]
pub(crate) struct Summary<'a> {
    name: &'a str,
    joints: usize,
    bars: usize,
    total_length_m: f64,
    total_mass_kg: f64,
    gravity_m_s2: f64,
}

impl<'a> Summary<'a> {
    pub(crate) fn of(system: &'a System) -> Self {
        Self {
            name: system.name(),
            joints: system.joints().len(),
            bars: system.members().len(),
            total_length_m: system.total_length_m(),
            total_mass_kg: system.total_mass_kg(),
            gravity_m_s2: system.gravity_m_s2(),
        }
    }
}

/// An equilibrium with the names of its joints.
pub(crate) struct Named<'a> {
    pub(crate) system: &'a System,
    pub(crate) equilibrium: &'a SystemEquilibrium,
    pub(crate) bare: bool,
}

impl Serialize for Named<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Keys<'a> {
            solver: &'a SolverName,
            energy_j: f64,
            #[serde(skip_serializing_if = "Option::is_none")]
            joints: Option<Joints<'a>>,
            #[serde(skip_serializing_if = "Option::is_none")]
            bars: Option<Bars<'a>>,
            #[serde(skip_serializing_if = "Option::is_none")]
            reactions_n: Option<BTreeMap<&'a str, Vector>>,
            stability: SystemStability,
            evidence: &'a Evidence,
        }
        let e = self.equilibrium;
        let all = |wanted: bool| wanted.then_some(());
        let lists = all(!self.bare);
        let supported = self.system.joints().iter().zip(&e.reactions_n);
        // A joint without support has a force of the ground where it lies on the floor.
        let lies = |force: &Vector| force.iter().any(|n| n.abs() > 0.0);
        let supported =
            supported.filter(|(joint, force)| joint.support.at_m().is_some() || lies(force));
        Keys {
            solver: &e.solver,
            energy_j: e.energy_j,
            joints: lists.map(|()| Joints(self.system, e)),
            bars: lists.map(|()| Bars(self.system, e)),
            reactions_n: lists
                .map(|()| supported.map(|(joint, force)| (joint.name.as_str(), *force)).collect()),
            stability: e.stability,
            evidence: &e.evidence,
        }
        .serialize(serializer)
    }
}

/// The joints one by one, so that a million of them are not built up first.
struct Joints<'a>(&'a System, &'a SystemEquilibrium);

impl Serialize for Joints<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Joint<'a> {
            name: &'a str,
            at_m: Vector,
        }
        let Self(system, e) = self;
        let mut list = serializer.serialize_seq(Some(e.joints_m.len()))?;
        for (joint, at_m) in system.joints().iter().zip(&e.joints_m) {
            list.serialize_element(&Joint { name: &joint.name, at_m: *at_m })?;
        }
        list.end()
    }
}

/// The members one by one.
struct Bars<'a>(&'a System, &'a SystemEquilibrium);

impl Serialize for Bars<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Bar<'a> {
            from: &'a str,
            to: &'a str,
            axial_n: f64,
            axial_from_n: f64,
            axial_to_n: f64,
            axial_max_n: f64,
            force_at_start_n: Vector,
            force_at_end_n: Vector,
        }
        let Self(system, e) = self;
        let mut list = serializer.serialize_seq(Some(e.axial_n.len()))?;
        for (k, member) in system.members().iter().enumerate() {
            let along = e.axial_force(system, k);
            list.serialize_element(&Bar {
                from: &system.joints()[member.from].name,
                to: &system.joints()[member.to].name,
                axial_n: e.axial_n[k],
                axial_from_n: along.from_n,
                axial_to_n: along.to_n,
                axial_max_n: along.largest_n(),
                force_at_start_n: e.start_forces_n[k],
                force_at_end_n: e.end_forces_n[k],
            })?;
        }
        list.end()
    }
}
