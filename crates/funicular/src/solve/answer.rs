//! What the solvers found, and how far it is proved.

use std::io::{self, Write};
use std::sync::Arc;

use formats::export::{Shape, Target};
use model::system::{System, SystemEquilibrium};
use model::{Rung, SolverName, Vector};
use validate::systems::{Near, SystemAgreement, SystemAnswer, SystemFailure};

use crate::csv::{Numbers, quoted};
use crate::error::Error;
use crate::weakest::Weakest;

/// What the solvers found for a [`Problem`](crate::Problem), and how far it is proved. A chain is here
/// a system whose joints are named by their numbers, from `0`.
#[derive(Debug, Clone, PartialEq)]
pub struct SolveAnswer {
    system: Arc<System>,
    answer: SystemAnswer,
}

impl SolveAnswer {
    pub(crate) fn new(system: Arc<System>, mut answer: SystemAnswer) -> Self {
        if system.has_strengths() {
            share_ranges(&mut answer.equilibria);
        }
        Self { system, answer }
    }

    /// What was solved.
    pub fn system(&self) -> &System {
        &self.system
    }

    /// One equilibrium for each solver that has an answer, with its evidence: `lagrange` first.
    pub fn equilibria(&self) -> &[SystemEquilibrium] {
        &self.answer.equilibria
    }

    /// The system and its equilibria, given away: no array is copied.
    pub fn into_parts(self) -> (Arc<System>, Vec<SystemEquilibrium>) {
        (self.system, self.answer.equilibria)
    }

    /// The answer of one solver, if it has one.
    pub fn by(&self, solver: &SolverName) -> Option<&SystemEquilibrium> {
        self.answer.by(solver)
    }

    /// Why solvers that were asked have no answer.
    pub fn failures(&self) -> &[SystemFailure] {
        &self.answer.failures
    }

    /// The comparison, and the judge's findings, if there are two answers.
    pub fn agreement(&self) -> Option<&SystemAgreement> {
        self.answer.agreement.as_ref()
    }

    /// How the answer lies to the shape given, where the question is the equilibrium next to it;
    /// no value where it is the lowest of all.
    pub fn near(&self) -> Option<&Near> {
        self.answer.near.as_ref()
    }

    /// The solvers that were asked again, next to the lowest equilibrium of a complete census,
    /// because they had no answer or a higher one.
    pub fn asked_again(&self) -> &[SolverName] {
        &self.answer.asked_again
    }

    /// The paper's multipliers of an answer, N, where the system is a row of rigid bars between two
    /// anchors: first the force of the ground on the first bar, then at each joint the force of the
    /// next bar on the one before, last that of the ground on the last bar.
    pub fn multipliers_n(&self, answer: &SystemEquilibrium) -> Option<Vec<Vector>> {
        self.system.as_row()?.multipliers_n(answer)
    }

    /// Whether both solvers answered and agree, the judge finds both in balance, and no census
    /// refutes them.
    pub fn agrees(&self) -> bool {
        self.answer.agrees()
    }

    /// Whether a check has failed: the answers disagree, the judge refuses one, or a complete
    /// census refutes one.
    pub fn check_failed(&self) -> bool {
        self.answer.check_failed()
    }

    /// Whether every solver that was asked has an answer, each has converged or is proved to be an
    /// equilibrium, and it is the neighbour of the drawing where that is the question.
    pub fn is_decided(&self) -> bool {
        self.answer.is_decided()
    }

    /// The highest rung that an answer has reached.
    pub fn rung(&self) -> Option<Rung> {
        self.equilibria().iter().filter_map(|equilibrium| equilibrium.evidence.rung()).max()
    }

    /// Whether all members are as strong as wanted in every equilibrium found; no value where none has
    /// a strength.
    pub fn is_strong(&self) -> Option<bool> {
        let weakest = self.equilibria().iter().filter_map(|e| Weakest::of(&self.system, e));
        weakest.map(|weakest| weakest.suffices()).reduce(|a, b| a && b)
    }

    /// The first equilibrium as a file for another program; no text where there is no equilibrium.
    ///
    /// # Errors
    /// [`Error::Export`] for what the format cannot hold.
    ///
    /// ```
    /// use funicular::{export::Target, prelude::*};
    /// let answer = Solve::new().run(&Problem::case("lamp")?)?;
    /// let text = answer.export(Target::Vtu)?.unwrap();
    /// assert!(text.contains("axial_n"));
    /// // The cables of the lamp do not stretch, as lines of MoorDyn do.
    /// assert!(answer.export(Target::MoorDyn).is_err());
    /// # Ok::<(), Error>(())
    /// ```
    pub fn export(&self, target: Target) -> Result<Option<String>, Error> {
        let Some(found) = self.equilibria().first() else { return Ok(None) };
        let used = found.utilisations(&self.system).unwrap_or_default();
        Ok(Some(Shape::new(&self.system, found, &used).text(target)?))
    }

    /// Joints as CSV, a line per solver and joint: its place, and the force of the ground on it.
    /// What is zero but for rounding is written as 0.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
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
    /// Where a member has a strength, the part of it that is used stands behind these; where one is a rope, the
    /// joints that it runs over last.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_bars_csv(&self, mut to: impl Write) -> io::Result<()> {
        let strong = self.system.has_strengths();
        let last = if strong { ",utilisation" } else { "" };
        let roped = self.system.has_ropes();
        let via = if roped { ",via" } else { "" };
        writeln!(
            to,
            "solver,bar,from,to,axial_n,axial_from_n,axial_to_n,axial_max_n,start_x_n,start_y_n,start_z_n,end_x_n,end_y_n,end_z_n{last}{via}"
        )?;
        for e in self.equilibria() {
            let ends = e.start_forces_n.as_flattened().iter().chain(e.end_forces_n.as_flattened());
            let (ends, axial) = (Numbers::of(ends), Numbers::of(&e.axial_n));
            for (k, member) in self.system.members().iter().enumerate() {
                let name = |joint: usize| quoted(&self.system.joints()[joint].name);
                let (from, end) = (name(member.from), name(member.to));
                let along = e.axial_force(&self.system, k);
                let force = [e.axial_n[k], along.from_n, along.to_n, along.largest_n()]
                    .map(|force| axial.cell(force))
                    .join(",");
                let (start_n, end_n) =
                    (ends.cells(e.start_forces_n[k]), ends.cells(e.end_forces_n[k]));
                write!(to, "{},{},{from},{end},{force},{start_n},{end_n}", e.solver, k + 1)?;
                match e.utilisation(&self.system, k) {
                    Some(utilisation) => write!(to, ",{utilisation:?}")?,
                    None if strong => write!(to, ",")?,
                    None => {}
                }
                if roped {
                    let names = member.via().iter().map(|k| self.system.joints()[*k].name.text());
                    write!(to, ",{}", quoted(names.collect::<Vec<_>>().join(" ")))?;
                }
                writeln!(to)?;
            }
        }
        Ok(())
    }
}

/// What one solver knows of the forces that balance leaves open holds for the answer of the other:
/// where they have the same family, strengths are held against the same ranges.
fn share_ranges(equilibria: &mut [SystemEquilibrium]) {
    let mut families = equilibria.iter().filter_map(|e| e.evidence.self_stresses.as_ref());
    let known = families.find_map(|all| Some((all.dimension, all.ranges.clone()?)));
    let Some((dimension, ranges)) = known else { return };
    let families = equilibria.iter_mut().filter_map(|e| e.evidence.self_stresses.as_mut());
    for family in families.filter(|all| all.ranges.is_none() && all.dimension == dimension) {
        family.ranges = Some(ranges.clone());
    }
}
