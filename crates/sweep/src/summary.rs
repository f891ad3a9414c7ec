//! What a sweep says in the end: counts, and where the solvers disagree.

use std::collections::BTreeMap;

use serde::ser::SerializeMap as _;
use serde::{Deserialize, Serialize, Serializer};

use crate::identify::Member;
use crate::reached::{Discovered, Renumbering};
use crate::record::{Chunk, Failure};
use crate::tally::Tally;

/// How the outcomes of one seed compare, by two solvers: in a sweep of `lagrange` and `energy` the
/// first finds equilibria of every kind and the second only minima, and each has its own way down,
/// so that most differences are as they should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Comparison {
    /// Both reached the same entry of the list.
    Same,
    /// The first reached an equilibrium that is no minimum, the second a minimum: as it should be.
    NoMinimum,
    /// Both reached minima, different ones: the seed is in another basin for each. As it should be.
    OtherBasin,
    /// Both reached entries, and of that of the first it is not known whether it is a minimum.
    Unclassified,
    /// One or both failed, by the limit of iterations, by stalling or by an undefined number: no
    /// answer, and so no disagreement.
    Failed,
    /// The second reached an entry that is no minimum by the list. Should never be.
    EnergyAtNoMinimum,
    /// Both reached the same entry, with different energies. Should never be.
    EnergiesDiffer,
    /// One of them converged to something that is not in the list: a gap in the list, or a false
    /// solution. Should never be where the list is complete.
    NotListed,
}

impl Comparison {
    /// All of them.
    pub const ALL: [Self; 8] = [
        Self::Same,
        Self::NoMinimum,
        Self::OtherBasin,
        Self::Unclassified,
        Self::Failed,
        Self::EnergyAtNoMinimum,
        Self::EnergiesDiffer,
        Self::NotListed,
    ];

    /// Whether a seed with this comparison is to be looked at.
    pub fn should_not_be(self) -> bool {
        matches!(self, Self::EnergyAtNoMinimum | Self::EnergiesDiffer | Self::NotListed)
    }
}

/// A seed on which the first two solvers disagree where they should not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Disagreement {
    /// Its number.
    pub seed: u64,
    /// In which way.
    pub comparison: Comparison,
    /// Outcomes of the two.
    pub outcomes: [i16; 2],
}

/// A disagreement with the names of the solvers, as it stands in JSON: `seed`, `comparison`, and
/// the outcome of each under its name.
#[derive(Debug, Clone, Copy)]
pub struct Named<'a> {
    disagreement: Disagreement,
    solvers: [&'a str; 2],
}

impl Serialize for Named<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Disagreement { seed, comparison, outcomes } = self.disagreement;
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("seed", &seed)?;
        map.serialize_entry("comparison", &comparison)?;
        for (solver, outcome) in self.solvers.iter().zip(outcomes) {
            map.serialize_entry(solver, &outcome)?;
        }
        map.end()
    }
}

/// Counts of a sweep; exact, and the same in whatever order they are added.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(try_from = "Stored")]
pub struct Summary {
    tally: Tally,
    /// Seeds by comparison, in the order of [`Comparison::ALL`].
    comparisons: [u64; 8],
    /// The first of those that should not be.
    disagreements: Vec<Disagreement>,
    /// Index in the plane of each entry; −1 where it is not known.
    index: Vec<i32>,
    /// Unit of the energies, J, as its bits.
    scale: u64,
}

/// Disagreements kept: the first by seed number, those in no list last. All are counted.
pub const KEPT: usize = 1000;

/// Energies of the same equilibrium agree to this, in total weights times total lengths, as the
/// list is identified by: the energies themselves say nothing of their errors, being near zero
/// where a chain is taut. Both solvers stop where the energy has settled to its rounding, and to
/// what is left of the gaps times the forces: at worst 2.2e-12 among the named cases (nearly-taut,
/// whose forces are several hundred weights).
const SAME_ENERGY: f64 = 1e-10;

impl Summary {
    /// Nothing yet, of a sweep with this list and this unit of the energies
    /// ([`Members::energy_unit_j`](crate::Members::energy_unit_j)).
    pub fn new<'a>(list: impl IntoIterator<Item = &'a Member>, energy_unit_j: f64) -> Self {
        let index = |member: &Member| {
            member.index().map_or(-1, |index| i32::try_from(index).unwrap_or(i32::MAX))
        };
        Self {
            tally: Tally::default(),
            comparisons: [0; 8],
            disagreements: vec![],
            index: list.into_iter().map(index).collect(),
            scale: energy_unit_j.to_bits(),
        }
    }

    /// Count a chunk.
    pub fn add(&mut self, chunk: &Chunk) {
        self.tally.add_chunk(chunk);
        let [first, second, ..] = chunk.outcomes.as_slice() else { return };
        let energies = first.energy_j.iter().zip(&second.energy_j);
        let outcomes = first.outcome.iter().zip(&second.outcome);
        for ((seed, (a, b)), (v, w)) in chunk.seeds.clone().zip(outcomes).zip(energies) {
            let comparison = self.compare(*a, *b, v - w);
            self.comparisons[comparison as usize] += 1;
            if comparison.should_not_be() {
                let outcomes = [*a, *b];
                self.disagreements.push(Disagreement { seed, comparison, outcomes });
            }
        }
        self.keep();
    }

    /// Count what was counted elsewhere in the same sweep.
    pub fn merge(&mut self, other: &Self) {
        self.tally.add(&other.tally);
        for (count, other) in self.comparisons.iter_mut().zip(other.comparisons) {
            *count += other;
        }
        self.disagreements.extend_from_slice(&other.disagreements);
        self.keep();
    }

    fn keep(&mut self) {
        // A list with gaps may leave out most of the seeds, and hide no contradiction.
        self.disagreements
            .sort_unstable_by_key(|seed| (seed.comparison == Comparison::NotListed, *seed));
        self.disagreements.truncate(KEPT);
    }

    fn compare(&self, first: i16, second: i16, difference_j: f64) -> Comparison {
        let unlisted = Failure::Unlisted as i16;
        if first == unlisted || second == unlisted {
            return Comparison::NotListed;
        }
        let (Ok(a), Ok(b)) = (usize::try_from(first), usize::try_from(second)) else {
            return Comparison::Failed;
        };
        // What is not in the list yet, because it grows, is of no known kind.
        let index = |entry: usize| self.index.get(entry).copied().unwrap_or(-1);
        if index(b) > 0 {
            return Comparison::EnergyAtNoMinimum;
        }
        if a == b {
            let close = difference_j.abs() <= SAME_ENERGY * f64::from_bits(self.scale);
            return if close { Comparison::Same } else { Comparison::EnergiesDiffer };
        }
        match index(a) {
            0 => Comparison::OtherBasin,
            1.. => Comparison::NoMinimum,
            _ => Comparison::Unclassified,
        }
    }

    /// Where the list is not complete, a seed in no list is no disagreement: it is counted alone.
    pub(crate) fn leave_out_unlisted(&mut self) {
        self.disagreements.retain(|seed| seed.comparison != Comparison::NotListed);
    }

    /// Counts of outcomes and iterations, by solver.
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Seeds in all.
    pub fn seeds(&self) -> u64 {
        self.tally.seeds
    }

    /// Seeds by comparison of the first two solvers.
    pub fn comparisons(&self) -> impl Iterator<Item = (Comparison, u64)> + '_ {
        Comparison::ALL.into_iter().zip(self.comparisons)
    }

    /// The seeds on which the solvers disagree where they should not, by number, and then those in
    /// no list, by number: the first [`KEPT`] of them.
    pub fn disagreements(&self) -> &[Disagreement] {
        &self.disagreements
    }

    /// The same with the names of the solvers, for JSON.
    pub fn named_disagreements(&self) -> impl Iterator<Item = Named<'_>> {
        let mut names = self.tally.names();
        let solvers = [(); 2].map(|()| names.next().unwrap_or_default());
        self.disagreements.iter().map(move |one| Named { disagreement: *one, solvers })
    }
}

/// Counts by numbers of a list that grows. What depends on the kinds of its entries is told in the
/// end.
#[derive(Debug, Clone)]
pub(crate) struct OpenSummary {
    counts: Summary,
    proven: Vec<Member>,
    /// Seeds of which both reached this entry, with different energies.
    differ: BTreeMap<i16, u64>,
}

impl OpenSummary {
    /// Nothing yet, by a summary of nothing, and the proven list.
    pub(crate) fn new(counts: Summary, proven: Vec<Member>) -> Self {
        Self { counts, proven, differ: BTreeMap::new() }
    }

    pub(crate) fn add(&mut self, chunk: &Chunk) {
        self.counts.add(chunk);
        self.counts.leave_out_unlisted();
        if let [first, second, ..] = chunk.outcomes.as_slice() {
            let rows = first.outcome.iter().zip(&second.outcome);
            let energies = first.energy_j.iter().zip(&second.energy_j);
            for ((a, b), (v, w)) in rows.zip(energies) {
                if self.counts.compare(*a, *b, v - w) == Comparison::EnergiesDiffer {
                    *self.differ.entry(*a).or_default() += 1;
                }
            }
        }
    }

    /// By the final numbers.
    pub(crate) fn finish(self, discovered: &Discovered, renumbering: &Renumbering) -> Summary {
        let list = self.proven.iter().chain(&discovered.equilibria);
        let mut summary = Summary::new(list, f64::from_bits(self.counts.scale));
        summary.tally = self.counts.tally.renumbered(renumbering);
        for (first, row) in summary.tally.both.iter().flatten() {
            for (second, count) in row {
                let comparison = summary.compare(*first, *second, 0.0);
                summary.comparisons[comparison as usize] += count;
            }
        }
        for (entry, count) in self.differ {
            // Of those that are listed.
            if renumbering.apply(entry) >= 0 {
                summary.comparisons[Comparison::Same as usize] -= count;
                summary.comparisons[Comparison::EnergiesDiffer as usize] += count;
            }
        }
        let renumbered = self.counts.disagreements.into_iter().map(|seed| {
            let outcomes = seed.outcomes.map(|code| renumbering.apply(code));
            Disagreement { outcomes, ..seed }
        });
        let listed = |seed: &Disagreement| !seed.outcomes.contains(&(Failure::Unlisted as i16));
        summary.disagreements = renumbered.filter(listed).collect();
        summary
    }
}

impl Serialize for Summary {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        map.serialize_entry("tally", &self.tally)?;
        map.serialize_entry("comparisons", &self.comparisons)?;
        let disagreements: Vec<_> = self.named_disagreements().collect();
        map.serialize_entry("disagreements", &disagreements)?;
        map.serialize_entry("index", &self.index)?;
        map.serialize_entry("scale", &self.scale)?;
        map.end()
    }
}

/// As it is stored.
#[derive(Deserialize)]
struct Stored {
    tally: Tally,
    comparisons: [u64; 8],
    disagreements: Vec<StoredDisagreement>,
    index: Vec<i32>,
    scale: u64,
}

#[derive(Deserialize)]
struct StoredDisagreement {
    seed: u64,
    comparison: Comparison,
    /// By solver.
    #[serde(flatten)]
    outcomes: BTreeMap<String, i16>,
}

impl TryFrom<Stored> for Summary {
    type Error = String;

    fn try_from(stored: Stored) -> Result<Self, String> {
        let Stored { tally, comparisons, disagreements, index, scale } = stored;
        let solvers: Vec<&str> = tally.names().take(2).collect();
        let read = |one: StoredDisagreement| {
            let outcome = |k: usize| solvers.get(k).and_then(|name| one.outcomes.get(*name));
            let (Some(first), Some(second)) = (outcome(0), outcome(1)) else {
                return Err(format!("the disagreement of seed {} lacks an outcome", one.seed));
            };
            let (seed, comparison) = (one.seed, one.comparison);
            Ok(Disagreement { seed, comparison, outcomes: [*first, *second] })
        };
        let disagreements = disagreements.into_iter().map(read).collect::<Result<_, _>>()?;
        Ok(Self { tally, comparisons, disagreements, index, scale })
    }
}
