//! Branches against censuses that they were not made from.

use serde::Serialize;

use super::branch::Branch;
use super::station::Station;

/// What the checks of a trace say.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Checks {
    /// Censuses taken between neighbouring points, to compare with the branches there.
    pub between: usize,
    /// Positions of those whose equilibria differ from the branches in number or in indices, after all
    /// rounds of refinement.
    pub mismatches: Vec<f64>,
    /// Positions of those that were undecided.
    pub undecided: Vec<f64>,
    /// Points that were added on the way, where branches and census differed at first.
    pub added: usize,
    /// Proved equilibria whose energy or indices the curves' own formulas see otherwise.
    pub disagreements: usize,
    /// Intervals in which not every equilibrium could be followed.
    pub unfollowed: Vec<[f64; 2]>,
    /// Points at which the alternating sum of the indices is not the Euler characteristic.
    pub euler_violations: usize,
}

impl Checks {
    /// Whether every check agrees.
    #[must_use]
    pub fn agree(&self) -> bool {
        self.mismatches.is_empty()
            && self.unfollowed.is_empty()
            && self.disagreements == 0
            && self.euler_violations == 0
    }
}

/// Indices in the plane and in space of all equilibria at a station, sorted.
fn census_indices(station: &Station) -> Option<Vec<[usize; 2]>> {
    let nodes = station.nodes.as_ref()?;
    let mut indices: Vec<[usize; 2]> =
        nodes.iter().map(|node| [node.seen.index_in_plane, node.seen.index_in_space()]).collect();
    indices.sort_unstable();
    Some(indices)
}

/// The same of all branches at its position.
fn branch_indices(branches: &[Branch], position: f64) -> Vec<[usize; 2]> {
    let mut indices: Vec<[usize; 2]> = branches
        .iter()
        .filter(|branch| branch.covers(position))
        .filter_map(|branch| {
            // Behind an event the index is that of the next point.
            let after = branch.points.partition_point(|point| point.position < position);
            let before = branch.before(position)?;
            let point = if before.event.is_some() { branch.points.get(after)? } else { before };
            Some([point.index_in_plane, point.index_in_space])
        })
        .collect();
    indices.sort_unstable();
    indices
}

/// Whether the branches are what the census of a station finds; `None` if the station is undecided.
pub(crate) fn agrees(branches: &[Branch], station: &Station) -> Option<bool> {
    if station.is_refused() {
        return Some(branch_indices(branches, station.position).is_empty());
    }
    Some(census_indices(station)? == branch_indices(branches, station.position))
}
