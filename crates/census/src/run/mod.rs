//! The census of a chain: its pulls searched, for all patterns of tension and compression.

pub(crate) mod check;
pub(crate) mod closure;
pub(crate) mod compact;
mod convert;
pub(crate) mod count;
pub(crate) mod enclosure;
pub(crate) mod equilibrium;
pub(crate) mod estimate;
mod figure;
pub(crate) mod plane;
pub(crate) mod position;
pub(crate) mod search;
pub(crate) mod slack;

use model::{Chain, Problem};
use serde::Serialize;

use crate::error::CensusError;
use crate::run::compact::CompactCensus;
use crate::run::count::morse::{self, MorseError};
use crate::run::count::topology::{Topology, TopologyError};
use crate::run::equilibrium::ProvenEquilibrium;
use crate::run::plane::loads::JointLoads;
use crate::run::search::Progress;
use crate::run::search::undecided::Undecided;
use crate::run::slack::families::SlackFamily;
use crate::run::slack::straight::StraightPosition;
use crate::settings::Settings;

/// All equilibria of a chain, and how far that is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct Census {
    /// The isolated equilibria (for anchors on one vertical: the circles), by energy, then by
    /// angles.
    pub equilibria: Vec<ProvenEquilibrium>,
    /// Sets of equilibria with slack bars; most chains have none.
    pub families: Vec<SlackFamily>,
    /// Positions in which all bars lie in the line between the anchors, as far as integers decide
    /// whether the lengths fit into it. Upright ones are equilibria whose force is a family; no
    /// force holds the others.
    pub straight: Vec<StraightPosition>,
    /// What could not be decided. Neither dropped nor counted.
    pub undecided: Vec<Undecided>,
    /// Whether every equilibrium of the chain is in `equilibria` or `families`: nothing is
    /// undecided, no straight position is an equilibrium, and the Morse inequalities hold (where a
    /// straight position exists there are none).
    pub complete: bool,
    /// Whether each equilibrium stands for a circle, the anchors being on one vertical.
    pub circles: bool,
    /// The planar configuration space, from the lengths alone, or why it is not known.
    pub topology: Result<Topology, TopologyError>,
    /// What it took.
    pub statistics: Statistics,
}

/// What a census took.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Statistics {
    /// Number of bars.
    pub bars: usize,
    /// Cells of pulls looked at.
    pub cells: u64,
    /// Tests of one cell for one pattern, those decided together included.
    pub tests: u64,
    /// Proofs of existence tried.
    pub proofs: u64,
    /// Levels of the search.
    pub levels: u32,
    /// Wall-clock time, s.
    pub seconds: f64,
}

impl Census {
    /// Take the census of a chain.
    ///
    /// The result does not depend on the number of threads, but for the time.
    ///
    /// # Errors
    ///
    /// [`CensusError`] when a setting is out of range or the chain is too long.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// assert!(census.complete && census.circles);
    /// assert_eq!((census.equilibria.len(), census.count_in_plane()), (2, 4));
    /// let mgl = 9.80665;
    /// let energy = census.equilibria[0].energy_j.mid() / mgl + 6.0;
    /// assert!((energy - 2.335_468_651_999_305).abs() < 1e-14);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn take(problem: &Problem, settings: &Settings) -> Result<Self, CensusError> {
        Self::of_chain(problem.chain(), JointLoads::NONE, settings, &|_| {})
    }

    /// Take the census of a chain with loads at its joints.
    pub(crate) fn of_chain(
        chain: &Chain,
        loads: &JointLoads,
        settings: &Settings,
        watch: &dyn Fn(Progress),
    ) -> Result<Self, CensusError> {
        let compact = CompactCensus::of_chain(chain, loads, settings, watch)?;
        Ok(compact.first(compact.len()))
    }

    /// Whether every equilibrium is named: in `equilibria` or `families`, or upright in `straight`. So the census is complete but for what has no regular second derivative.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// use model::{Anchors, Bar, Chain, Problem};
    /// // 1 + 1 − 1 = 1: three ways to hang upright, each with any force.
    /// let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, -1.0] };
    /// let chain = Chain::new("upright", 9.81, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 3])?;
    /// let census = Census::take(&Problem::new(chain)?, &Settings::default())?;
    /// assert!(census.decided() && !census.complete);
    /// assert_eq!(census.straight.iter().filter(|straight| straight.upright).count(), 3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn decided(&self) -> bool {
        self.is_decided_with(&self.count_by_index())
    }

    /// The same of these equilibria by index.
    pub(crate) fn is_decided_with(&self, by_index: &[i64]) -> bool {
        self.topology_is_known() && self.undecided.is_empty() && self.morse_of(by_index).is_ok()
    }

    /// Whether it is known what topology asks for: nothing where a straight position exists.
    fn topology_is_known(&self) -> bool {
        matches!(&self.topology, Ok(_) | Err(TopologyError::Straight { .. }))
    }

    /// Whether all equilibria are isolated, or families across which the second derivative is
    /// regular.
    pub(crate) fn may_be_complete(&self) -> bool {
        self.topology_is_known()
            && self.singular_families() == 0
            && self.straight.iter().all(|straight| !straight.upright)
    }

    /// Slack families that are no manifold.
    pub(crate) fn singular_families(&self) -> usize {
        self.families.iter().filter(|family| family.topology.is_err()).count()
    }

    /// Number of isolated equilibria in a vertical plane: with the anchors on one vertical, each
    /// circle meets the plane twice.
    pub fn count_in_plane(&self) -> usize {
        self.equilibria.len() * if self.circles { 2 } else { 1 }
    }

    /// Number of equilibria in the plane by index; families of slack bars count with their Betti
    /// numbers.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// // Two minima and two maxima in the plane: the configurations are closed curves.
    /// assert_eq!(census.count_by_index(), [2, 2]);
    /// assert_eq!((census.alternating_sum(), census.morse()), (0, Ok(())));
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn count_by_index(&self) -> Vec<i64> {
        self.count_of(self.equilibria.iter().map(|equilibrium| equilibrium.index_in_plane))
    }

    /// The same of isolated equilibria with these indices in the plane.
    pub(crate) fn count_of(&self, indices: impl Iterator<Item = usize>) -> Vec<i64> {
        let mut count = vec![0; self.statistics.bars.saturating_sub(1)];
        let mut add = |index: usize, number: i64| {
            if index >= count.len() {
                count.resize(index + 1, 0);
            }
            count[index] += number;
        };
        for index in indices {
            add(index, if self.circles { 2 } else { 1 });
        }
        for family in &self.families {
            for (k, betti) in family.topology.iter().flat_map(|t| &t.betti).enumerate() {
                add(family.index_in_plane + k, i64::try_from(*betti).unwrap_or(i64::MAX));
            }
        }
        count
    }

    /// Σ (−1)^index over the equilibria in the plane.
    pub fn alternating_sum(&self) -> i64 {
        morse::alternating_sum(&self.count_by_index())
    }

    /// The Morse inequalities between the equilibria and the topology of the configuration space;
    /// nothing is said where the topology is not known.
    ///
    /// # Errors
    ///
    /// [`MorseError`] for the first inequality that fails.
    pub fn morse(&self) -> Result<(), MorseError> {
        self.morse_of(&self.count_by_index())
    }

    /// The same for these equilibria by index.
    pub(crate) fn morse_of(&self, by_index: &[i64]) -> Result<(), MorseError> {
        match &self.topology {
            // What these count for is not known.
            Ok(_) if self.singular_families() > 0 => Ok(()),
            Ok(topology) => morse::check(by_index, topology),
            Err(_) => Ok(()),
        }
    }
}

/// By energy, then by the angles, bar by bar: middles of the enclosures.
pub(crate) fn by_energy_and_angles(
    a: &ProvenEquilibrium,
    b: &ProvenEquilibrium,
) -> std::cmp::Ordering {
    let angles = a.angles_rad.iter().zip(&b.angles_rad);
    let by_energy = a.energy_j.mid().total_cmp(&b.energy_j.mid());
    by_energy.then_with(|| {
        let mut orders = angles.map(|(x, y)| x.mid().total_cmp(&y.mid()));
        orders.find(|order| order.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    })
}

/// The factor of time and memory for each bar more, measured on random chains.
pub(crate) const GROWTH: f64 = 2.1;

/// Processor time of a census of a chain of so many bars, s: t = 0.3 s · 2.1^(n − 10). Measured on
/// random chains of 8 to 16 bars (`examples/census_speed.rs`); good to an order of magnitude,
/// chains of one length differing by that. The number of equilibria doubles too.
///
/// ```
/// assert!((census::expected_time_s(10) - 0.3).abs() < 1e-12);
/// assert!((census::expected_time_s(12) / census::expected_time_s(10) - 2.1 * 2.1).abs() < 1e-12);
/// ```
pub fn expected_time_s(bars: usize) -> f64 {
    const TEN_BARS_S: f64 = 0.3;
    // Beyond this the numbers overflow; the message stays finite.
    TEN_BARS_S * GROWTH.powf((bars as f64 - 10.0).min(600.0))
}
