//! Counts over many seeds: how many converge, to which equilibrium, in how many steps.

use lagrange::{Error, Seed, Settings, Solver};
use model::Problem;

/// Energies closer than this, relative to the total weight times the total length, are the same
/// equilibrium: states converged to 1e-13 agree to 1e-12, and two equilibria have no reason to.
const SAME_ENERGY: f64 = 1e-9;

/// What became of many seeds.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Survey {
    /// Seeds tried.
    pub seeds: usize,
    /// Seeds that converged to an equilibrium.
    pub converged: usize,
    /// Of these, without any relaxation.
    pub direct: usize,
    /// The equilibria by energy, the lowest first.
    pub groups: Vec<Group>,
    /// Seeds that ended at a local minimum of the residual after all relaxations.
    pub stagnated: usize,
    /// Seeds that ended at a false root of the paper's equations; only with
    /// `lock_margin` zero.
    pub false_roots: usize,
    /// Seeds that do not fit the chain.
    pub rejected: usize,
    /// `iterations[k]`: how many of the converged seeds took k steps.
    pub iterations: Vec<usize>,
    /// The seeds that ended nowhere, by their place in the order given.
    pub lost: Vec<usize>,
}

/// The seeds that led to equilibria of one energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Group {
    /// Energy from the height of joint 0, J.
    pub energy_j: f64,
    /// Seeds.
    pub count: usize,
    /// Of these, with joint 1 on the side of +Y of joint 0: tells the two mirror images in the
    /// plane *OYZ* apart.
    pub towards_y: usize,
}

impl Survey {
    /// The number of steps that the given part (0 to 1) of the converged seeds did not exceed.
    pub fn iterations_quantile(&self, part: f64) -> usize {
        let wanted = part * self.converged as f64;
        let mut seen = 0;
        for (iterations, count) in self.iterations.iter().enumerate() {
            seen += count;
            if seen > 0 && seen as f64 >= wanted {
                return iterations;
            }
        }
        0
    }

    fn count(&mut self, iterations: usize, group: Group, tolerance_j: f64) {
        self.converged += 1;
        if self.iterations.len() <= iterations {
            self.iterations.resize(iterations + 1, 0);
        }
        self.iterations[iterations] += 1;
        let at = self.groups.partition_point(|g| g.energy_j < group.energy_j - tolerance_j);
        match self.groups.get_mut(at) {
            Some(same) if same.energy_j <= group.energy_j + tolerance_j => {
                same.count += 1;
                same.towards_y += group.towards_y;
            }
            _ => self.groups.insert(at, group),
        }
    }
}

/// Solve from each seed in turn and count. A seed that leads nowhere is counted, too.
pub fn survey(
    problem: &Problem,
    seeds: impl IntoIterator<Item = Seed>,
    settings: &Settings,
) -> Survey {
    let chain = problem.chain();
    let unit_j = chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m();
    let mut solver = Solver::new(problem, settings).unwrap();
    let mut survey = Survey::default();
    for (index, seed) in seeds.into_iter().enumerate() {
        survey.seeds += 1;
        match solver.solve(&seed) {
            Ok(found) => {
                let effort = found.effort();
                let group = Group {
                    energy_j: found.energy_j(),
                    count: 1,
                    towards_y: usize::from(found.first_offset_m()[1] > 0.0),
                };
                survey.direct += usize::from(effort.relaxations == 0);
                survey.count(effort.iterations, group, SAME_ENERGY * unit_j);
                continue;
            }
            Err(Error::FalseRoot { .. }) => survey.false_roots += 1,
            Err(Error::SeedLength { .. } | Error::SeedNotFinite { .. }) => {
                survey.rejected += 1;
            }
            Err(_) => survey.stagnated += 1,
        }
        survey.lost.push(index);
    }
    survey
}
