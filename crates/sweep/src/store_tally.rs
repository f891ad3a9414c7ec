//! Counts of outcomes, as rows go by.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::record::{Chunk, Outcomes};

/// How often each outcome came, after how many iterations: a row of the final table.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct OutcomeTally {
    /// Seeds that led here.
    pub count: u64,
    /// How many of them took 0, 1, 2, ... iterations.
    pub iterations: BTreeMap<u16, u64>,
}

impl OutcomeTally {
    /// The middle of the numbers of iterations, the lower one of two.
    #[must_use]
    pub fn median_iterations(&self) -> u16 {
        let mut below = 0;
        for (iterations, count) in &self.iterations {
            below += count;
            if 2 * below >= self.count {
                return *iterations;
            }
        }
        0
    }

    /// The largest number of iterations.
    #[must_use]
    pub fn max_iterations(&self) -> u16 {
        self.iterations.last_key_value().map_or(0, |(iterations, _)| *iterations)
    }

    fn add(&mut self, other: &Self) {
        self.count += other.count;
        for (iterations, count) in &other.iterations {
            *self.iterations.entry(*iterations).or_default() += count;
        }
    }
}

/// Outcomes of one solver: by their code, an equilibrium or a [`Failure`](crate::Failure).
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SolverTally(pub BTreeMap<i16, OutcomeTally>);

/// Outcomes of all rows.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Tally {
    /// Rows.
    pub seeds: u64,
    /// Of `lagrange`, if it was asked.
    pub lagrange: Option<SolverTally>,
    /// Of `energy`, if it was asked.
    pub energy: Option<SolverTally>,
    /// With both: seeds by outcome of `lagrange`, then of `energy`.
    pub both: Option<BTreeMap<i16, BTreeMap<i16, u64>>>,
}

impl Tally {
    /// Count a run of seeds.
    pub fn add_chunk(&mut self, chunk: &Chunk) {
        self.seeds += chunk.seeds.end - chunk.seeds.start;
        for (tally, outcomes) in
            [(&mut self.lagrange, &chunk.lagrange), (&mut self.energy, &chunk.energy)]
        {
            if let Some(outcomes) = outcomes {
                add_outcomes(tally.get_or_insert_default(), outcomes);
            }
        }
        if let (Some(lagrange), Some(energy)) = (&chunk.lagrange, &chunk.energy) {
            let both = self.both.get_or_insert_default();
            let pairs = lagrange.outcome.iter().copied().zip(energy.outcome.iter().copied());
            for (pair, count) in counts(pairs) {
                *both.entry(pair.0).or_default().entry(pair.1).or_default() += count;
            }
        }
    }

    /// Count what was counted elsewhere.
    pub fn add(&mut self, other: &Self) {
        self.seeds += other.seeds;
        for (tally, other) in
            [(&mut self.lagrange, &other.lagrange), (&mut self.energy, &other.energy)]
        {
            for (outcome, other) in other.iter().flat_map(|other| &other.0) {
                tally.get_or_insert_default().0.entry(*outcome).or_default().add(other);
            }
        }
        for (lagrange, row) in other.both.iter().flatten() {
            let both = self.both.get_or_insert_default().entry(*lagrange).or_default();
            for (energy, count) in row {
                *both.entry(*energy).or_default() += count;
            }
        }
    }
}

fn add_outcomes(tally: &mut SolverTally, outcomes: &Outcomes) {
    let pairs = outcomes.outcome.iter().copied().zip(outcomes.iterations.iter().copied());
    for ((outcome, iterations), count) in counts(pairs) {
        let row = tally.0.entry(outcome).or_default();
        row.count += count;
        *row.iterations.entry(iterations).or_default() += count;
    }
}

/// How often each pair comes, in some order. Few are different: sorting them takes some nanoseconds a row, and
/// no memory beyond them however many outcomes there are.
fn counts<B: Copy + Ord>(pairs: impl Iterator<Item = (i16, B)>) -> Vec<((i16, B), u64)> {
    let mut pairs: Vec<(i16, B)> = pairs.collect();
    pairs.sort_unstable();
    pairs.chunk_by(|a, b| a == b).map(|equal| (equal[0], equal.len() as u64)).collect()
}

/// Two-sided 95 % quantile of the normal distribution.
const Z_95: f64 = 1.959_963_984_540_054;

/// The 95 % confidence interval of a rate after `count` of `all`, by Wilson's score
/// (p + z²/2n ± z √(p(1 − p)/n + z²/4n²)) / (1 + z²/n). It holds for random seeds; for the points of a
/// grid or a Sobol sequence it is wider than need be.
///
/// # References
///
/// E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209, doi:10.1080/01621459.1927.10502953.
///
/// ```
/// // Nothing seen in 1000 seeds: at most z²/(n + z²).
/// let (low, high) = sweep::rate_interval(0, 1000);
/// assert_eq!(low, 0.0);
/// assert!((high - 0.003_826_758_5).abs() < 1e-9);
/// ```
#[must_use]
pub fn rate_interval(count: u64, all: u64) -> (f64, f64) {
    if all == 0 {
        return (0.0, 1.0);
    }
    let (n, p) = (all as f64, count as f64 / all as f64);
    let z2 = Z_95 * Z_95;
    let middle = p + z2 / (2.0 * n);
    let half = Z_95 * (p * (1.0 - p) / n + z2 / (4.0 * n * n)).sqrt();
    let scale = 1.0 + z2 / n;
    let low = if count == 0 { 0.0 } else { ((middle - half) / scale).max(0.0) };
    let high = if count == all { 1.0 } else { ((middle + half) / scale).min(1.0) };
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chunk() -> Chunk {
        let outcomes = |outcome: Vec<i16>, iterations: Vec<u16>| {
            let rows = outcome.len();
            let (residual, energy_j) = (vec![0.0; rows], vec![0.0; rows]);
            Some(Outcomes { outcome, iterations, residual, energy_j })
        };
        Chunk {
            seeds: 10..14,
            lagrange: outcomes(vec![0, 1, 0, -2], vec![3, 4, 9, 50]),
            energy: outcomes(vec![0, 0, 0, 0], vec![7, 7, 8, 8]),
        }
    }

    #[test]
    fn rows_are_counted_once_in_every_table() {
        let mut tally = Tally::default();
        tally.add_chunk(&chunk());
        let lagrange = tally.lagrange.clone().unwrap().0;
        assert_eq!(lagrange[&0].count, 2);
        assert_eq!((lagrange[&0].median_iterations(), lagrange[&0].max_iterations()), (3, 9));
        assert_eq!(lagrange[&-2].iterations, BTreeMap::from([(50, 1)]));
        assert_eq!(tally.energy.as_ref().unwrap().0[&0].count, 4);
        assert_eq!(tally.both.as_ref().unwrap()[&1], BTreeMap::from([(0, 1)]));
        let mut twice = tally.clone();
        twice.add(&tally);
        let mut again = tally.clone();
        again.add_chunk(&chunk());
        assert_eq!(twice, again);
        let text = serde_json::to_string(&twice).unwrap();
        assert_eq!(serde_json::from_str::<Tally>(&text).unwrap(), twice);
    }

    #[test]
    fn the_interval_is_that_of_the_textbook() {
        // Agresti and Coull, Am. Stat. 52 (1998) 119: 9 of 10 gives 0.596 to 0.982.
        let (low, high) = rate_interval(9, 10);
        assert!((low - 0.596).abs() < 5e-4 && (high - 0.982).abs() < 5e-4, "{low} {high}");
        let (low, high) = rate_interval(10, 10);
        assert!(low < 1.0 && high >= 1.0);
        assert!(rate_interval(0, 0) == (0.0, 1.0));
    }
}
