//! Counts over many seeds: how many converge, to which equilibria, in how many steps.

use lagrange::{Error, Seed, Settings, Solver};
use model::Problem;

/// What became of many seeds.
#[derive(Debug, Default)]
pub struct Survey {
    /// Of the seeds that converged: the energy from the height of joint 0, J, and whether joint 1 is on the side of +Y
    /// of joint 0, which tells the two mirror images in the plane *OYZ* apart.
    pub ends: Vec<(f64, bool)>,
    /// The steps that each of them took.
    pub iterations: Vec<usize>,
    /// How many of them converged without any relaxation.
    pub direct: usize,
    /// Seeds that ended at a false root of the paper's equations; only with
    /// `lock_margin` zero.
    pub false_roots: usize,
    /// The seeds that ended nowhere, by their place in the order given.
    pub lost: Vec<usize>,
}

/// Solve from each seed in turn and count.
pub fn survey(
    problem: &Problem,
    seeds: impl IntoIterator<Item = Seed>,
    settings: &Settings,
) -> Survey {
    let mut solver = Solver::new(problem, settings).unwrap();
    let mut survey = Survey::default();
    for (index, seed) in seeds.into_iter().enumerate() {
        match solver.solve(&seed) {
            Ok(found) => {
                survey.ends.push((found.energy_j(), found.first_offset_m()[1] > 0.0));
                survey.iterations.push(found.effort().iterations);
                survey.direct += usize::from(found.effort().relaxations == 0);
            }
            Err(Error::FalseRoot { .. }) => survey.false_roots += 1,
            Err(_) => survey.lost.push(index),
        }
    }
    survey
}
