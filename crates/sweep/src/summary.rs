//! What a sweep says in the end: counts, and where the solvers disagree.

use serde::{Deserialize, Serialize};

use crate::identify::Member;
use crate::record::Chunk;
use crate::store_tally::Tally;

/// How the outcomes of one seed compare. The first solver finds equilibria of every kind and the second
/// only minima, and each has its own way down, so that most differences are as they should be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Comparison {
    /// Both reached the same entry of the list.
    Same,
    /// `lagrange` reached an equilibrium that is no minimum, `energy` a minimum: as it should be.
    NoMinimum,
    /// Both reached minima, different ones: the seed is in another basin for each. As it should be.
    OtherBasin,
    /// Both reached entries, and of the one of `lagrange` it is not known whether it is a minimum.
    Unclassified,
    /// One or both failed, by the limit of iterations, by stalling or by an undefined number: no answer, and
    /// so no disagreement.
    Failed,
    /// `energy` reached an entry that is no minimum by the list. Should never be.
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
    #[must_use]
    pub fn should_not_be(self) -> bool {
        matches!(self, Self::EnergyAtNoMinimum | Self::EnergiesDiffer | Self::NotListed)
    }
}

/// A seed on which the solvers disagree where they should not.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Disagreement {
    /// Its number.
    pub seed: u64,
    /// In which way.
    pub comparison: Comparison,
    /// Outcome of `lagrange`.
    pub lagrange: i16,
    /// Outcome of `energy`.
    pub energy: i16,
}

/// Counts of a sweep; exact, and the same in whatever order they are added.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
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

/// Energies of the same equilibrium agree to this, in total weights times total lengths, as the list is identified
/// by: the energies themselves say nothing of their errors, being near zero where a chain is taut. Both solvers
/// stop where the energy has settled to its rounding, and to what is left of the gaps times the forces: at worst
/// 2.2e-12 among the named cases (nearly-taut, whose forces are several hundred weights).
const SAME_ENERGY: f64 = 1e-10;

impl Summary {
    /// Nothing yet, of a sweep with this list and this unit of the energies
    /// ([`Members::energy_unit_j`](crate::Members::energy_unit_j)).
    #[must_use]
    pub fn new(list: &[Member], energy_unit_j: f64) -> Self {
        let index = |member: &Member| {
            member.index_in_plane.map_or(-1, |index| i32::try_from(index).unwrap_or(i32::MAX))
        };
        Self {
            tally: Tally::default(),
            comparisons: [0; 8],
            disagreements: vec![],
            index: list.iter().map(index).collect(),
            scale: energy_unit_j.to_bits(),
        }
    }

    /// Count a chunk.
    pub fn add(&mut self, chunk: &Chunk) {
        self.tally.add_chunk(chunk);
        let (Some(lagrange), Some(energy)) = (&chunk.lagrange, &chunk.energy) else { return };
        let energies = lagrange.energy_j.iter().zip(&energy.energy_j);
        let outcomes = lagrange.outcome.iter().zip(&energy.outcome);
        for ((seed, (a, b)), (v, w)) in chunk.seeds.clone().zip(outcomes).zip(energies) {
            let comparison = self.compare(*a, *b, v - w);
            self.comparisons[comparison as usize] += 1;
            if comparison.should_not_be() {
                self.disagreements.push(Disagreement {
                    seed,
                    comparison,
                    lagrange: *a,
                    energy: *b,
                });
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

    fn compare(&self, lagrange: i16, energy: i16, difference_j: f64) -> Comparison {
        let unlisted = crate::Failure::Unlisted as i16;
        if lagrange == unlisted || energy == unlisted {
            return Comparison::NotListed;
        }
        let (Ok(a), Ok(b)) = (usize::try_from(lagrange), usize::try_from(energy)) else {
            return Comparison::Failed;
        };
        if self.index[b] > 0 {
            return Comparison::EnergyAtNoMinimum;
        }
        if a == b {
            let close = difference_j.abs() <= SAME_ENERGY * f64::from_bits(self.scale);
            return if close { Comparison::Same } else { Comparison::EnergiesDiffer };
        }
        match self.index[a] {
            0 => Comparison::OtherBasin,
            1.. => Comparison::NoMinimum,
            _ => Comparison::Unclassified,
        }
    }

    /// Counts of outcomes and iterations, by solver.
    #[must_use]
    pub fn tally(&self) -> &Tally {
        &self.tally
    }

    /// Seeds in all.
    #[must_use]
    pub fn seeds(&self) -> u64 {
        self.tally.seeds
    }

    /// Seeds by comparison of the two solvers.
    pub fn comparisons(&self) -> impl Iterator<Item = (Comparison, u64)> + '_ {
        Comparison::ALL.into_iter().zip(self.comparisons)
    }

    /// The seeds on which the solvers disagree where they should not, by number, and then those in no list,
    /// by number: the first [`KEPT`] of them.
    #[must_use]
    pub fn disagreements(&self) -> &[Disagreement] {
        &self.disagreements
    }
}
