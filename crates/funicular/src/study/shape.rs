//! The hanging shape at a point of a study.

use std::sync::Arc;

use branches::PointError;
use model::number::Brief;
use model::system::{Member, System, SystemEquilibrium};
use model::{Rung, Vector};
use serde::Serialize;

use crate::extremes::Extremes;
use crate::observable::Observable;
use crate::problem::Problem;
use crate::solve::{Solve, SolveAnswer};

/// Why a point has no hanging shape.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct NoShape {
    /// Whether the values describe nothing that can hang; else no solver has an answer.
    pub refused: bool,
    /// Why, in words.
    pub reason: String,
}

impl NoShape {
    /// The shape of a problem, where the values describe one.
    pub(super) fn or(
        problem: Result<Problem, PointError>,
        shape: impl FnOnce(&Problem) -> Result<StudyShape, Self>,
    ) -> Result<StudyShape, Self> {
        let problem = problem.map_err(|error| Self { refused: true, reason: error.to_string() })?;
        shape(&problem)
    }

    fn unsolved(reason: &impl ToString) -> Self {
        Self { refused: false, reason: reason.to_string() }
    }
}

/// The hanging shape at a point of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyShape {
    /// Distance of the anchors of a row of rigid bars between two of them, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub span_m: Option<f64>,
    /// Energy, J, as of a [`SystemEquilibrium`](model::system::SystemEquilibrium).
    pub energy_j: f64,
    /// Sag, lowest joint, largest forces.
    #[serde(flatten)]
    pub extremes: Extremes,
    /// The lowest joint by name; in a chain its number, from 0.
    pub lowest_joint: String,
    /// Forces of the ground at the supports, N, in the order of
    /// [`StudyAnswer::supports`](super::StudyAnswer::supports).
    #[serde(skip)]
    pub reactions_n: Vec<Vector>,
    /// How steeply each bar rises from its first joint to its second, a rope to the first that it runs
    /// over, degrees from the level.
    pub rises_deg: Vec<f64>,
    /// What [`Study::of`](super::Study::of) asks for; `None` for a sag of joints that no members connect, or
    /// of which one is above the other, and for what is not there with another count of bars.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub of: Vec<Option<f64>>,
    /// The highest rung of evidence.
    pub rung: Option<Rung>,
    /// Whether both solvers answered and agree, and the judge finds both in balance.
    pub agrees: bool,
    /// Whether a check failed.
    pub check_failed: bool,
    /// Whether every solver that was asked has an answer that it converged to.
    #[serde(skip)]
    pub is_decided: bool,
    /// Largest distance of a joint between the two answers, m, if there are two.
    pub joints_differ_m: Option<f64>,
    /// Largest difference of a force, N.
    pub forces_differ_n: Option<f64>,
    /// What a page shows, where it is asked for.
    #[serde(skip)]
    pub(super) drawn: Option<Drawn>,
}

/// The system at a point of a study, with places of its joints, m, and forces along its bars, N.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Drawn {
    pub system: Arc<System>,
    pub joints_m: Vec<Vector>,
    pub axial_n: Vec<f64>,
}

impl Drawn {
    fn of(answer: SolveAnswer) -> Option<Self> {
        let (system, found) = answer.into_parts();
        let SystemEquilibrium { joints_m, axial_n, .. } = found.into_iter().next()?;
        Some(Self { system, joints_m, axial_n })
    }
}

impl StudyShape {
    /// Size of the force at a support, by its place in
    /// [`StudyAnswer::supports`](super::StudyAnswer::supports), N.
    pub fn support_n(&self, support: usize) -> Option<f64> {
        self.reactions_n.get(support).map(|[x, y, z]| x.hypot(*y).hypot(*z))
    }

    /// Size of the largest force of the ground, N.
    pub fn largest_support_n(&self) -> Option<f64> {
        (0..self.reactions_n.len()).filter_map(|k| self.support_n(k)).reduce(f64::max)
    }

    /// The shape in which a problem hangs; next to the shape `before`, which it takes the place of,
    /// where there is one.
    pub(super) fn found(
        problem: &Problem,
        before: &mut Option<Vec<Vector>>,
        solve: &Solve,
        of: &[(String, &'static str)],
        is_drawn: bool,
    ) -> Result<Self, NoShape> {
        let joints = problem.system().joints().len();
        let answer = match before {
            Some(joints_m) if joints_m.len() == joints => solve.threads(0).near(problem, joints_m),
            _ => solve.run_here(problem),
        };
        let answer = answer.map_err(|error| NoShape::unsolved(&error))?;
        let first = answer.equilibria().first();
        if let (Some(near), Some(first)) = (answer.near(), first) {
            if !near.is_neighbour {
                let what = match before {
                    Some(_) => "the branch ends here, or the steps are too long",
                    None => "it does not rest next to its drawing",
                };
                let (joint, away) = (&near.joint, Brief(near.moved_m));
                let why = format!("{what}: joint {joint:?} of what was found is {away} m away");
                return Err(NoShape::unsolved(&why));
            }
            *before = Some(first.joints_m.clone());
        }
        let shape = Self::of(&answer, of).ok_or_else(|| NoShape::unsolved(&"no equilibrium"))?;
        let span_m = problem.row().map(|row| row.chain().anchors().span_m());
        let drawn = is_drawn.then(|| Drawn::of(answer)).flatten();
        Ok(Self { span_m, drawn, ..shape })
    }

    fn of(answer: &SolveAnswer, of: &[(String, &'static str)]) -> Option<Self> {
        let (system, first) = (answer.system(), answer.equilibria().first()?);
        let places = &first.joints_m;
        let joints = system.joints().iter();
        let held =
            joints.zip(&first.reactions_n).filter(|(joint, _)| joint.support.at_m().is_some());
        let reactions = held.map(|(_, force)| *force).collect();
        // Of a rope its first span.
        let next = |member: &Member| member.path().nth(1).unwrap_or(member.to);
        let rises = system.members().iter();
        let rises = rises.map(|member| {
            let (from, to) = (places[member.from], places[next(member)]);
            (to[2] - from[2]).atan2((to[0] - from[0]).hypot(to[1] - from[1])).to_degrees()
        });
        let agreement = answer.agreement();
        let extremes = Extremes::of(system, first)?;
        Some(Self {
            span_m: None,
            energy_j: first.energy_j,
            of: of
                .iter()
                .map(|(text, _)| Observable::parse(text, system).ok()?.of(system, first))
                .collect(),
            lowest_joint: system.joints()[extremes.lowest_joint].name.to_string(),
            extremes,
            reactions_n: reactions,
            rises_deg: rises.collect(),
            rung: answer.rung(),
            agrees: answer.agrees(),
            check_failed: answer.check_failed(),
            is_decided: answer.is_decided(),
            joints_differ_m: agreement.map(|both| both.joints_m),
            forces_differ_n: agreement.map(|both| both.forces_n),
            drawn: None,
        })
    }
}
