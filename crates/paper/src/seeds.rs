//! Many random seeds for both solvers: how many converge, to which equilibrium, in how many steps.

use std::f64::consts::PI;
use std::time::Instant;

use model::SolverName;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use crate::example::Example;

/// Number of random seeds of each kind in the reproduction.
pub const SEEDS: usize = 10_000;

/// Seed of the generator; every seed angle has a stream of its own, so that neither the number of
/// threads nor that of seeds changes any of them.
const GENERATOR: u64 = 2026;

/// Seeds that one worker solves with the memory of one solver.
const CHUNK: usize = 250;

/// Energies closer than this, mgl, are those of one equilibrium: solutions agree to 1e-12, E1 and
/// E2 are 1.3 apart.
const SAME_ENERGY_MGL: f64 = 1e-9;

/// The two kinds of seeds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// The paper's choice: psi = 0, theta = pi/2, in the plane *OYZ*; phi uniform. `energy`
    /// minimises in this plane.
    Planar,
    /// All three angles of each bar uniform. `energy` starts from the directions they give and
    /// minimises in space.
    Spatial,
}

/// What became of the seeds of one kind with one solver.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Survey {
    /// The solver.
    pub solver: SolverName,
    /// The kind of seeds.
    pub kind: Kind,
    /// Seeds tried.
    pub seeds: usize,
    /// Seeds that converged.
    pub converged: usize,
    /// Where they led, in the order E1, E1', E2, E2' (planar) or E1, E2 (spatial: circles).
    pub reached: Vec<Reached>,
    /// Seeds that converged to something else.
    pub elsewhere: usize,
    /// Converged seeds of `lagrange` that Newton's method alone brought there, without relaxing the
    /// chain first.
    pub direct: Option<usize>,
    /// Steps of the converged seeds: half of them took at most this many.
    pub median_iterations: usize,
    /// 95 of 100 took at most this many.
    pub most_iterations_of_95_percent: usize,
    /// The most.
    pub most_iterations: usize,
    /// What became of the rest, counted by what the solver said.
    pub lost: Vec<Lost>,
    /// Wall-clock time on all cores of this machine, s. The only number here that is not the same
    /// in every run.
    pub seconds: f64,
}

impl Survey {
    /// Part of the seeds that converged, 0 to 1.
    pub fn rate(&self) -> f64 {
        self.converged as f64 / self.seeds.max(1) as f64
    }

    /// Equilibria reached by at least one seed.
    pub fn distinct(&self) -> usize {
        self.reached.iter().filter(|reached| reached.seeds > 0).count()
    }

    /// Where the seeds led; the mirror images have this mark.
    pub fn led_to(&self, prime: &str) -> String {
        let reached = self.reached.iter().filter(|reached| reached.seeds > 0);
        let mut parts: Vec<_> = reached
            .map(|reached| {
                format!("{} {}", reached.seeds, reached.equilibrium.replace('\'', prime))
            })
            .collect();
        if self.elsewhere > 0 {
            parts.push(format!("{} elsewhere", self.elsewhere));
        }
        parts.extend(self.lost.iter().map(|lost| format!("{} lost: {}", lost.seeds, lost.why)));
        parts.join(", ")
    }
}

/// How many seeds led to one equilibrium (or circle of equilibria).
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Reached {
    /// Its name in this project.
    pub equilibrium: String,
    /// Its V, mgl.
    pub energy_mgl: f64,
    /// Seeds.
    pub seeds: usize,
}

/// How many seeds led nowhere for one reason.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Lost {
    /// The reason.
    pub why: String,
    /// Seeds.
    pub seeds: usize,
}

/// What one seed led to.
#[derive(Debug, Clone)]
struct Outcome {
    energy_mgl: f64,
    /// Joint A lies towards +Y.
    towards_y: bool,
    iterations: usize,
    direct: bool,
}

/// The four surveys: both kinds of seeds with both solvers, `count` seeds each.
pub fn surveys(example: &Example, count: usize) -> Vec<Survey> {
    let mut all = Vec::new();
    for kind in [Kind::Planar, Kind::Spatial] {
        let seeds: Vec<_> = (0..count).map(|index| angles(kind, index)).collect();
        for solver in [SolverName::LAGRANGE, SolverName::ENERGY] {
            let clock = Instant::now();
            let run = |chunk: &[[[f64; 3]; 3]]| {
                if solver == SolverName::LAGRANGE {
                    by_lagrange(example, chunk)
                } else {
                    by_energy(example, kind, chunk)
                }
            };
            let outcomes: Vec<_> = seeds.par_chunks(CHUNK).flat_map_iter(run).collect();
            let seconds = clock.elapsed().as_secs_f64();
            all.push(counted(example, solver, kind, &outcomes, seconds));
        }
    }
    all
}

/// Angles psi, theta, phi of the three bars of one seed, rad.
fn angles(kind: Kind, index: usize) -> [[f64; 3]; 3] {
    let mut random = ChaCha8Rng::seed_from_u64(GENERATOR);
    random.set_stream(index as u64);
    let mut angle = || random.random_range(-PI..PI);
    std::array::from_fn(|_| match kind {
        Kind::Planar => [0.0, 0.5 * PI, angle()],
        Kind::Spatial => [angle(), angle(), angle()],
    })
}

fn by_lagrange(example: &Example, seeds: &[[[f64; 3]; 3]]) -> Vec<Result<Outcome, String>> {
    let settings = lagrange::Settings::default();
    let mut solver = match lagrange::Solver::new(&example.problem, &settings) {
        Ok(solver) => solver,
        Err(error) => return vec![Err(error.to_string()); seeds.len()],
    };
    let mut outcome =
        |seed: &[[f64; 3]; 3]| match solver.solve(&lagrange::Seed::spatial(seed.to_vec())) {
            Ok(found) => Ok(Outcome {
                energy_mgl: example.v_mgl(found.energy_j()),
                towards_y: found.first_offset_m()[1] > 0.0,
                iterations: found.effort().iterations,
                direct: found.effort().relaxations == 0,
            }),
            Err(error) => Err(reason(&error).to_owned()),
        };
    seeds.iter().map(&mut outcome).collect()
}

/// A short name of the way a solve ends, to count by.
fn reason(error: &lagrange::Error) -> &'static str {
    match error {
        lagrange::Error::Stagnated { .. } => "stopped at a local minimum of the residual",
        lagrange::Error::FalseRoot { .. } => "ended at a false root of the paper's equations",
        _ => "another error",
    }
}

fn by_energy(
    example: &Example,
    kind: Kind,
    seeds: &[[[f64; 3]; 3]],
) -> Vec<Result<Outcome, String>> {
    let motion = match kind {
        Kind::Planar => energy::Motion::Plane,
        Kind::Spatial => energy::Motion::Space,
    };
    let settings = energy::Settings { motion, ..energy::Settings::default() };
    let outcome = |seed: &[[f64; 3]; 3]| -> Result<Outcome, energy::Error> {
        let directions = seed.map(|[psi, theta, phi]| lagrange::direction(psi, theta, phi).into());
        let seed = energy::Seed::directions(&example.problem, &directions)?;
        let found = energy::minimise_from(&example.problem, &seed, &settings)?;
        let [origin, first] = [found.equilibrium.joints_m[0], found.equilibrium.joints_m[1]];
        Ok(Outcome {
            energy_mgl: example.v_mgl(found.equilibrium.energy_j),
            towards_y: first[1] > origin[1],
            iterations: found.equilibrium.evidence.iterations,
            direct: true,
        })
    };
    seeds.iter().map(|seed| outcome(seed).map_err(|error| error.reason().to_owned())).collect()
}

fn counted(
    example: &Example,
    solver: SolverName,
    kind: Kind,
    outcomes: &[Result<Outcome, String>],
    seconds: f64,
) -> Survey {
    let mut reached = equilibria(example, kind);
    let mut survey = Survey {
        direct: (solver == SolverName::LAGRANGE).then_some(0),
        solver,
        kind,
        seeds: outcomes.len(),
        converged: 0,
        reached: Vec::new(),
        elsewhere: 0,
        median_iterations: 0,
        most_iterations_of_95_percent: 0,
        most_iterations: 0,
        lost: Vec::new(),
        seconds,
    };
    let mut iterations = Vec::new();
    for outcome in outcomes {
        match outcome {
            Ok(found) => {
                survey.converged += 1;
                iterations.push(found.iterations);
                if let Some(direct) = &mut survey.direct {
                    *direct += usize::from(found.direct);
                }
                let same = |(place, side): &&mut (Reached, Option<bool>)| {
                    (place.energy_mgl - found.energy_mgl).abs() <= SAME_ENERGY_MGL
                        && side.is_none_or(|side| side == found.towards_y)
                };
                match reached.iter_mut().find(same) {
                    Some((place, _)) => place.seeds += 1,
                    None => survey.elsewhere += 1,
                }
            }
            Err(why) => match survey.lost.iter_mut().find(|lost| lost.why == *why) {
                Some(lost) => lost.seeds += 1,
                None => survey.lost.push(Lost { why: why.clone(), seeds: 1 }),
            },
        }
    }
    iterations.sort_unstable();
    let quantile = |part: usize| {
        // The smallest count that `part` of 100 do not exceed.
        let place = (iterations.len() * part).div_ceil(100).max(1);
        iterations.get(place - 1).copied().unwrap_or(0)
    };
    survey.median_iterations = quantile(50);
    survey.most_iterations_of_95_percent = quantile(95);
    survey.most_iterations = quantile(100);
    survey.reached = reached.into_iter().map(|(place, _)| place).collect();
    survey
}

/// The equilibria to count by, and the side on which joint A lies (planar seeds only: in space a
/// turn makes the mirror images one).
fn equilibria(example: &Example, kind: Kind) -> Vec<(Reached, Option<bool>)> {
    let solutions = example.lagrange.all();
    let place = |name: &str, which: usize, side| {
        let energy_mgl = example.v_mgl(solutions[which].equilibrium.energy_j);
        (Reached { equilibrium: name.to_owned(), energy_mgl, seeds: 0 }, side)
    };
    match kind {
        Kind::Planar => vec![
            place("E1", 0, Some(true)),
            place("E1'", 1, Some(false)),
            place("E2", 2, Some(true)),
            place("E2'", 3, Some(false)),
        ],
        Kind::Spatial => vec![place("E1", 0, None), place("E2", 2, None)],
    }
}
