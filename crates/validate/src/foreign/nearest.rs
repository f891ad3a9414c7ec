//! The equilibrium nearest to an answer: how large its error is.

use model::system::{System, SystemEquilibrium};
use model::{SelfStresses, SolverName, Vector};
use serde::{Serialize, Serializer};

use super::proved::{ProvedError, proved_error};
use crate::systems::compare::{compare, judge_alone};
use crate::systems::free::free_joints;
use crate::systems::turn::turned_onto;
use crate::systems::{SystemFailure, ask};
use crate::tolerances::Tolerances;
use numerics::vector::{minus, norm, worse};

/// What a solver that starts at the answer's positions finds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NearestEquilibrium {
    /// The equilibrium with its evidence.
    #[serde(flatten, serialize_with = "about")]
    pub equilibrium: SystemEquilibrium,
    /// Largest distance of a joint of the answer from the same joint of the equilibrium, m. Parts
    /// that turn freely about a vertical are turned onto each other first; joints that nothing
    /// holds are not compared.
    pub joints_m: f64,
    /// That joint, from 0.
    pub joint: usize,
    /// Largest difference of an axial force, N.
    pub forces_n: f64,
    /// That member, from 1.
    pub member: usize,
    /// The energy of the answer less that of the equilibrium, J.
    pub energy_j: f64,
    /// Whether equilibrium determines the forces; nothing where that was not counted.
    pub forces_unique: Option<bool>,
    /// The errors with proof, of the nearest equilibrium alone and where there is one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub proved: Option<ProvedError>,
}

/// What both solvers say about the surroundings of an answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Nearest {
    /// One for each solver that found one, the nearest first.
    pub equilibria: Vec<NearestEquilibrium>,
    /// Why the others found none.
    #[serde(serialize_with = "reasons")]
    pub failures: Vec<SystemFailure>,
    /// Whether no solver found its way from the answer's positions, and they began without a guess.
    pub without_guess: bool,
}

impl Nearest {
    /// What balance leaves open of the forces, from who says most of it.
    pub(super) fn self_stresses(&self) -> Option<&SelfStresses> {
        let all = self.equilibria.iter().map(|one| &one.equilibrium.evidence);
        let families = all.filter_map(|evidence| evidence.self_stresses.as_ref());
        families.max_by_key(|family| family.ranges.is_some())
    }
}

/// Look from the positions of an answer.
pub(super) fn nearest(
    system: &System,
    answer: &SystemEquilibrium,
    position_m: f64,
    watch: &dyn Fn(&str),
) -> Nearest {
    watch("lagrange from the answer's positions");
    let seed = lagrange::net::Seed {
        axial_n: Some(answer.axial_n.clone()),
        ..lagrange::net::Seed::at(answer.joints_m.clone())
    };
    let forces = lagrange::net::solve_from(system, &seed, &lagrange::net::Settings::default());
    watch("energy from the answer's positions");
    let positions =
        energy::net::minimise_from(system, &answer.joints_m, &energy::net::Settings::default());
    let (mut found, mut unique, mut failures) = (vec![], vec![], vec![]);
    match forces {
        Ok(solution) => {
            use lagrange::net::Forces;
            unique.push(match solution.forces {
                Forces::Unique => Some(true),
                Forces::LeastNorm | Forces::Found => Some(false),
                Forces::Uncounted => None,
            });
            found.push(solution.equilibrium);
        }
        Err(error) => failures.push(SystemFailure::from(error)),
    }
    match positions {
        Ok(solution) => {
            use energy::net::Forces;
            unique.push(match solution.forces {
                Forces::Unique(_) => Some(true),
                Forces::Family { .. } => Some(false),
                _ => None,
            });
            found.push(solution.equilibrium);
        }
        Err(error) => failures.push(SystemFailure::from(error)),
    }
    let without_guess = found.is_empty();
    if without_guess {
        let fresh = ask(system, crate::question::Solvers::Both, watch);
        if !fresh.equilibria.is_empty() {
            (found, failures) = (fresh.equilibria, fresh.failures);
            unique = vec![None; found.len()];
        }
    } else {
        judged(system, &mut found, position_m);
    }
    let measured = found.into_iter().zip(unique);
    let mut equilibria: Vec<_> =
        measured.map(|(found, unique)| measure(system, answer, found, unique)).collect();
    equilibria.sort_by(|a, b| a.joints_m.total_cmp(&b.joints_m));
    if let Some(first) = equilibria.first_mut() {
        watch("a box around the nearest equilibrium");
        first.proved = proved_error(system, answer, &first.equilibrium);
    }
    Nearest { equilibria, failures, without_guess }
}

/// Two answers that are one are compared; two equilibria are judged each by itself.
fn judged(system: &System, found: &mut [SystemEquilibrium], position_m: f64) {
    if let [first, second] = found {
        let free = free_joints(system, &[first.clone(), second.clone()]);
        let (turned, _) = turned_onto(system, first, second, &free);
        let apart = apart_m(first, &turned, &free).0;
        if apart <= position_m {
            // What it finds stands in the evidence of both.
            let _ = compare(system, found, &Tolerances::project());
            return;
        }
    }
    for one in found {
        judge_alone(system, one);
    }
}

/// Largest distance of a joint that something holds, and which.
fn apart_m(first: &SystemEquilibrium, second: &SystemEquilibrium, free: &[bool]) -> (f64, usize) {
    let places = first.joints_m.iter().zip(&second.joints_m);
    let distance = |(a, b): (&Vector, &Vector)| norm(minus(*a, *b));
    let held = places.map(distance).enumerate().filter(|(k, _)| !free[*k]);
    largest(held.map(|(k, distance)| (distance, k)))
}

/// The largest of numbered values.
fn largest(values: impl Iterator<Item = (f64, usize)>) -> (f64, usize) {
    values.fold((0.0, 0), |(most, at), (value, k)| {
        if value > most || value.is_nan() { (worse(most, value), k) } else { (most, at) }
    })
}

fn measure(
    system: &System,
    answer: &SystemEquilibrium,
    equilibrium: SystemEquilibrium,
    forces_unique: Option<bool>,
) -> NearestEquilibrium {
    let both = [answer.clone(), equilibrium];
    let free = free_joints(system, &both);
    let [_, equilibrium] = both;
    let (turned, _) = turned_onto(system, answer, &equilibrium, &free);
    let (joints_m, joint) = apart_m(answer, &turned, &free);
    let forces = answer.axial_n.iter().zip(&equilibrium.axial_n).enumerate();
    let (forces_n, member) = largest(forces.map(|(k, (a, b))| ((a - b).abs(), k + 1)));
    let energy_j = answer.energy_j - equilibrium.energy_j;
    let proved = None;
    NearestEquilibrium {
        equilibrium,
        joints_m,
        joint,
        forces_n,
        member,
        energy_j,
        forces_unique,
        proved,
    }
}

/// Of the equilibrium, what the places and forces of the system do not say.
fn about<S: Serializer>(equilibrium: &SystemEquilibrium, serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Keys<'a> {
        solver: &'a SolverName,
        index_in_space: usize,
        evidence: &'a model::Evidence,
    }
    let SystemEquilibrium { solver, stability, evidence, .. } = equilibrium;
    Keys { solver, index_in_space: stability.index_in_space, evidence }.serialize(serializer)
}

/// Solvers without an answer, each with its reason in words.
fn reasons<S: Serializer>(failures: &[SystemFailure], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Failure {
        solver: SolverName,
        because: String,
    }
    let one = |of: &SystemFailure| Failure { solver: of.solver(), because: of.to_string() };
    serializer.collect_seq(failures.iter().map(one))
}

#[cfg(test)]
mod tests;
