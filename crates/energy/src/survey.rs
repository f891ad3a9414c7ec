//! Many seeds, honestly counted.

use std::collections::BTreeMap;

use model::Problem;

use crate::{Error, Seed, Settings, Solution, minimise_from};

/// What became of many seeds.
#[derive(Debug, Clone, PartialEq)]
pub struct Survey {
    /// Energies that differ by less than this are the same level.
    resolution: f64,
    /// Seeds tried.
    pub tried: usize,
    /// Distinct energies reached, lowest first.
    pub levels: Vec<Level>,
    /// Seeds without an answer, by [`Error::reason`].
    pub failures: BTreeMap<&'static str, usize>,
    /// Iterations of each seed that converged, in the order of recording.
    pub iterations: Vec<u64>,
}

/// One energy that seeds ended at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// The lowest energy recorded at this level, in the unit of the survey.
    pub energy: f64,
    /// Seeds that ended here.
    pub seeds: usize,
}

impl Survey {
    /// An empty survey that tells energies apart if they differ by more than `resolution`.
    #[must_use]
    pub fn new(resolution: f64) -> Self {
        Self {
            resolution,
            tried: 0,
            levels: Vec::new(),
            failures: BTreeMap::new(),
            iterations: Vec::new(),
        }
    }

    /// Count one outcome: an energy and the iterations it took, or why there is none.
    pub fn record(&mut self, outcome: Result<(f64, u64), &Error>) {
        self.tried += 1;
        let (energy, iterations) = match outcome {
            Ok(found) => found,
            Err(error) => {
                *self.failures.entry(error.reason()).or_insert(0) += 1;
                return;
            }
        };
        self.iterations.push(iterations);
        let near = |level: &&mut Level| (level.energy - energy).abs() <= self.resolution;
        if let Some(level) = self.levels.iter_mut().find(near) {
            level.seeds += 1;
            level.energy = level.energy.min(energy);
        } else {
            self.levels.push(Level { energy, seeds: 1 });
        }
        self.levels.sort_by(|a, b| a.energy.total_cmp(&b.energy));
    }

    /// Seeds that converged.
    #[must_use]
    pub fn converged(&self) -> usize {
        self.iterations.len()
    }

    /// Most iterations of a seed that converged.
    #[must_use]
    pub fn most_iterations(&self) -> u64 {
        self.iterations.iter().copied().max().unwrap_or(0)
    }

    /// Mean number of iterations of the seeds that converged; NaN if none did.
    #[must_use]
    pub fn mean_iterations(&self) -> f64 {
        self.iterations.iter().map(|&k| k as f64).sum::<f64>() / self.converged() as f64
    }
}

/// Parts of the total weight times the total length below which two energies are one.
const RESOLUTION: f64 = 1e-9;

/// Minimise from every seed and count. Energies are in joules.
///
/// # Errors
///
/// [`Error::Setting`] for settings out of range; what happens to a seed is counted, not returned.
///
/// ```
/// use energy::{Seed, Settings, survey};
/// let problem = model::cases::paper();
/// let seeds = (0..100).map(|k| {
///     let angle = f64::from(k);
///     Seed::angles(&problem, &[angle, 2.0 * angle, 3.0 * angle])
/// });
/// let seeds: Vec<Seed> = seeds.collect::<Result<_, _>>()?;
/// let found = survey(&problem, &seeds, &Settings::default())?;
/// assert_eq!((found.tried, found.converged(), found.levels.len()), (100, 100, 1));
/// # Ok::<(), energy::Error>(())
/// ```
pub fn survey<'a>(
    problem: &Problem,
    seeds: impl IntoIterator<Item = &'a Seed>,
    settings: &Settings,
) -> Result<Survey, Error> {
    settings.validate()?;
    let mut survey = Survey::for_problem(problem);
    for seed in seeds {
        let outcome = minimise_from(problem, seed, settings);
        survey.record(outcome.as_ref().map(Solution::cost_of_search));
    }
    Ok(survey)
}

impl Survey {
    /// An empty survey of energies in joules of this problem.
    #[must_use]
    pub fn for_problem(problem: &Problem) -> Self {
        let chain = problem.chain();
        let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
        Self::new(RESOLUTION * weight_n * chain.total_length_m())
    }
}

impl Solution {
    /// Energy in joules and iterations, for [`Survey::record`].
    #[must_use]
    pub fn cost_of_search(&self) -> (f64, u64) {
        (self.equilibrium.energy_j, self.work.iterations)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_are_counted_by_level_and_by_reason() {
        let mut survey = Survey::new(0.1);
        survey.record(Ok((2.0, 5)));
        survey.record(Ok((1.0, 7)));
        survey.record(Ok((2.05, 9)));
        survey.record(Err(&Error::NotClosed { gap: 0.1, iterations: 3 }));
        survey.record(Err(&Error::NotFinite { quantity: "energy" }));
        survey.record(Err(&Error::NotClosed { gap: 0.2, iterations: 3 }));
        assert_eq!((survey.tried, survey.converged(), survey.most_iterations()), (6, 3, 9));
        assert!((survey.mean_iterations() - 7.0).abs() < 1e-15);
        let counts: Vec<usize> = survey.levels.iter().map(|l| l.seeds).collect();
        assert_eq!(counts, [1, 2]);
        assert_eq!(survey.failures.get("not closed"), Some(&2));
        assert_eq!(survey.failures.get("not finite"), Some(&1));
    }
}
