use std::collections::BTreeMap;
use std::fmt;

use serde::de::{MapAccess, Visitor};
use serde::ser::SerializeMap as _;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::reached::Renumbering;
use crate::record::{Chunk, Outcomes};
use crate::solver::FIRST;

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
    ///
    /// ```
    /// use std::collections::BTreeMap;
    /// use sweep::OutcomeTally;
    /// let tally = OutcomeTally { count: 5, iterations: BTreeMap::from([(3, 2), (4, 2), (9, 1)]) };
    /// assert_eq!((tally.median_iterations(), tally.max_iterations()), (4, 9));
    /// ```
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
///
/// In JSON: `seeds`, a key for each solver, and `both`. The keys `lagrange` and `energy` are always
/// there, null if they were not asked.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Tally {
    /// Rows.
    pub seeds: u64,
    /// By solver, in the order of the sweep.
    pub solvers: Vec<(String, SolverTally)>,
    /// With two solvers or more: seeds by outcome of the first, then of the second.
    pub both: Option<BTreeMap<i16, BTreeMap<i16, u64>>>,
}

impl Tally {
    /// Outcomes of the solver of this name, if it was asked.
    pub fn of(&self, solver: &str) -> Option<&SolverTally> {
        self.solvers.iter().find(|(name, _)| name == solver).map(|(_, tally)| tally)
    }

    /// The names of the solvers, in the order of the sweep.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.solvers.iter().map(|(name, _)| name.as_str())
    }

    fn row(&mut self, solver: &str) -> &mut SolverTally {
        let at = self.solvers.iter().position(|(name, _)| name == solver);
        let at = at.unwrap_or_else(|| {
            self.solvers.push((solver.to_owned(), SolverTally::default()));
            self.solvers.len() - 1
        });
        &mut self.solvers[at].1
    }

    /// Count a run of seeds.
    pub fn add_chunk(&mut self, chunk: &Chunk) {
        self.seeds += chunk.seeds.end - chunk.seeds.start;
        for outcomes in &chunk.outcomes {
            add_outcomes(self.row(&outcomes.solver), outcomes);
        }
        if let [first, second, ..] = chunk.outcomes.as_slice() {
            let both = self.both.get_or_insert_default();
            let pairs = first.outcome.iter().copied().zip(second.outcome.iter().copied());
            for (pair, count) in counts(pairs) {
                *both.entry(pair.0).or_default().entry(pair.1).or_default() += count;
            }
        }
    }

    /// Count what was counted elsewhere.
    pub fn add(&mut self, other: &Self) {
        self.add_by(other, |code| code);
    }

    /// The same rows by other numbers.
    pub(crate) fn renumbered(&self, renumbering: &Renumbering) -> Self {
        let mut renumbered = Self::default();
        renumbered.add_by(self, |code| renumbering.apply(code));
        renumbered
    }

    /// Count what was counted elsewhere by other numbers.
    fn add_by(&mut self, other: &Self, number: impl Fn(i16) -> i16) {
        self.seeds += other.seeds;
        for (solver, rows) in &other.solvers {
            let tally = self.row(solver);
            for (code, row) in &rows.0 {
                tally.0.entry(number(*code)).or_default().add(row);
            }
        }
        let Some(other) = &other.both else { return };
        let both = self.both.get_or_insert_default();
        for (first, row) in other {
            let both = both.entry(number(*first)).or_default();
            for (second, count) in row {
                *both.entry(number(*second)).or_default() += count;
            }
        }
    }
}

impl Serialize for Tally {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("seeds", &self.seeds)?;
        for name in FIRST {
            map.serialize_entry(name, &self.of(name))?;
        }
        for (name, tally) in &self.solvers {
            if !FIRST.contains(&name.as_str()) {
                map.serialize_entry(name, tally)?;
            }
        }
        map.serialize_entry("both", &self.both)?;
        map.end()
    }
}

impl<'de> Deserialize<'de> for Tally {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_map(Entries)
    }
}

/// Reads the keys of a tally.
struct Entries;

impl<'de> Visitor<'de> for Entries {
    type Value = Tally;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("counts of outcomes by solver")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Tally, A::Error> {
        let mut tally = Tally::default();
        while let Some(key) = map.next_key::<String>()? {
            match key.as_str() {
                "seeds" => tally.seeds = map.next_value()?,
                "both" => tally.both = map.next_value()?,
                _ => {
                    if let Some(rows) = map.next_value::<Option<SolverTally>>()? {
                        tally.solvers.push((key, rows));
                    }
                }
            }
        }
        Ok(tally)
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

/// How often each pair comes, in some order. Few are different: sorting them takes some nanoseconds
/// a row, and no memory beyond them however many outcomes there are.
fn counts<B: Copy + Ord>(pairs: impl Iterator<Item = (i16, B)>) -> Vec<((i16, B), u64)> {
    let mut pairs: Vec<(i16, B)> = pairs.collect();
    pairs.sort_unstable();
    pairs.chunk_by(|a, b| a == b).map(|equal| (equal[0], equal.len() as u64)).collect()
}

/// Two-sided 95 % quantile of the normal distribution.
const Z_95: f64 = 1.959_963_984_540_054;

/// The 95 % confidence interval of a rate after `count` of `all`, by Wilson's score
/// (p + z²/2n ± z √(p(1 − p)/n + z²/4n²)) / (1 + z²/n). It holds for random seeds; for the points
/// of a grid or a Sobol sequence it is wider than need be.
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
        let outcomes = |solver: &str, outcome: Vec<i16>, iterations: Vec<u16>| {
            let rows = outcome.len();
            let (residual, energy_j) = (vec![0.0; rows], vec![0.0; rows]);
            Outcomes { solver: solver.to_owned(), outcome, iterations, residual, energy_j }
        };
        Chunk {
            seeds: 10..14,
            outcomes: vec![
                outcomes("lagrange", vec![0, 1, 0, -2], vec![3, 4, 9, 50]),
                outcomes("energy", vec![0, 0, 0, 0], vec![7, 7, 8, 8]),
            ],
        }
    }

    #[test]
    fn rows_are_counted_once_in_every_table() {
        let mut tally = Tally::default();
        tally.add_chunk(&chunk());
        let lagrange = tally.of("lagrange").unwrap().0.clone();
        assert_eq!(lagrange[&0].count, 2);
        assert_eq!((lagrange[&0].median_iterations(), lagrange[&0].max_iterations()), (3, 9));
        assert_eq!(lagrange[&-2].iterations, BTreeMap::from([(50, 1)]));
        assert_eq!(tally.of("energy").unwrap().0[&0].count, 4);
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
    fn any_solver_has_its_key_and_two_are_always_there() {
        let mut tally = Tally::default();
        let mut chunk = chunk();
        chunk.outcomes.remove(1);
        chunk.outcomes[0].solver = "third".to_owned();
        tally.add_chunk(&chunk);
        let text = serde_json::to_string(&tally).unwrap();
        assert!(text.starts_with(r#"{"seeds":4,"lagrange":null,"energy":null,"third":{"-2""#));
        assert!(text.ends_with(r#""both":null}"#));
        assert_eq!(serde_json::from_str::<Tally>(&text).unwrap(), tally);
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
