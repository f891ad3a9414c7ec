//! The hanging shape at a point of a study.

use branches::PointError;
use model::system::{System, SystemEquilibrium};
use model::{Anchors, Equilibrium, Reactions, Rung, Vector};
use serde::Serialize;

use crate::extremes::Extremes;
use crate::problem::Problem;
use crate::solution::Solution;
use crate::solve::Solve;

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
    /// Distance of the anchors of a chain, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub span_m: Option<f64>,
    /// Energy, J: above the start anchor of a chain, or as of a
    /// [`SystemEquilibrium`](model::system::SystemEquilibrium).
    pub energy_j: f64,
    /// Sag, lowest joint, largest forces.
    #[serde(flatten)]
    pub extremes: Extremes,
    /// Forces of the ground at the supports, N, in the order of
    /// [`StudyAnswer::supports`](super::StudyAnswer::supports).
    #[serde(skip)]
    pub reactions_n: Vec<Vector>,
    /// How steeply each bar rises from its first joint to its second, degrees from the level.
    pub rises_deg: Vec<f64>,
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
}

impl StudyShape {
    /// Size of the force at a support, by its place in
    /// [`StudyAnswer::supports`](super::StudyAnswer::supports), N.
    #[must_use]
    pub fn support_n(&self, support: usize) -> Option<f64> {
        self.reactions_n.get(support).map(|[x, y, z]| x.hypot(*y).hypot(*z))
    }

    /// Size of the largest force of the ground, N.
    #[must_use]
    pub fn largest_support_n(&self) -> Option<f64> {
        (0..self.reactions_n.len()).filter_map(|k| self.support_n(k)).reduce(f64::max)
    }

    /// The shape in which a problem hangs; next to the shape `before`, which it takes the place of,
    /// where there is one.
    pub(super) fn found(
        problem: &Problem,
        before: &mut Option<Vec<Vector>>,
        solve: &Solve,
    ) -> Result<Self, NoShape> {
        let answer = match before {
            Some(joints_m) => solve.threads(0).near(problem, joints_m),
            None => solve.run_here(problem),
        };
        let answer = answer.map_err(|error| NoShape::unsolved(&error))?;
        if let Some(found) = answer.as_system()
            && let (Some(near), Some(first)) = (found.near(), found.equilibria().first())
        {
            if !near.is_neighbour {
                return Err(NoShape::unsolved(&format!(
                    "the branch ends here, or the steps are too long: joint {:?} of what was found is {:.3e} m away",
                    near.joint, near.moved_m
                )));
            }
            *before = Some(first.joints_m.clone());
        }
        let found = match &answer {
            Solution::Chain(found) => {
                found.equilibria().first().and_then(|first| Self::of_chain(first, &answer))
            }
            Solution::System(found) => {
                let first = found.equilibria().first();
                first.and_then(|first| Self::of_system(found.system(), first, &answer))
            }
        };
        found.ok_or_else(|| NoShape::unsolved(&"no equilibrium"))
    }

    fn of_chain(first: &Equilibrium, answer: &Solution) -> Option<Self> {
        let joints = &first.joints_m;
        let (start_m, end_m) = (*joints.first()?, *joints.last()?);
        let Reactions { start, end } = first.reactions_n;
        let extremes = Extremes::of(joints, [0, joints.len() - 1], &first.axial_forces())?;
        let rises_deg = joints.windows(2).map(|ends| rise_deg(ends[0], ends[1])).collect();
        let span_m = Some(Anchors { start_m, end_m }.span_m());
        let shape = Self::judged(answer, first.energy_j, extremes, vec![start, end], rises_deg);
        Some(Self { span_m, ..shape })
    }

    fn of_system(system: &System, first: &SystemEquilibrium, answer: &Solution) -> Option<Self> {
        let places = &first.joints_m;
        let joints = system.joints().iter();
        let held: Vec<usize> =
            joints.enumerate().filter_map(|(k, joint)| joint.support.at_m().and(Some(k))).collect();
        let reactions = held.iter().map(|joint| first.reactions_n[*joint]).collect();
        let extremes = Extremes::of(places, held, &first.axial_forces(system))?;
        let rises =
            system.members().iter().map(|member| rise_deg(places[member.from], places[member.to]));
        Some(Self::judged(answer, first.energy_j, extremes, reactions, rises.collect()))
    }

    fn judged(
        answer: &Solution,
        energy_j: f64,
        extremes: Extremes,
        reactions_n: Vec<Vector>,
        rises_deg: Vec<f64>,
    ) -> Self {
        let differ = match answer {
            Solution::Chain(found) => found.agreement().map(|both| [both.joints_m, both.forces_n]),
            Solution::System(found) => found.agreement().map(|both| [both.joints_m, both.forces_n]),
        };
        Self {
            span_m: None,
            energy_j,
            extremes,
            reactions_n,
            rises_deg,
            rung: answer.rung(),
            agrees: answer.agrees(),
            check_failed: answer.check_failed(),
            is_decided: answer.is_decided(),
            joints_differ_m: differ.map(|[joints_m, _]| joints_m),
            forces_differ_n: differ.map(|[_, forces_n]| forces_n),
        }
    }
}

/// The angle above the level of the way from one joint to another, degrees.
fn rise_deg(from: Vector, to: Vector) -> f64 {
    (to[2] - from[2]).atan2((to[0] - from[0]).hypot(to[1] - from[1])).to_degrees()
}
