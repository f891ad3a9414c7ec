//! Branches against censuses that they were not made from.

use serde::Serialize;

use crate::branch::{Branch, BranchEnd};
use crate::census_point::CensusPoint;
use crate::event::{Event, EventKind};

/// Two curves that cross.
const ARMS: usize = 4;

/// What the checks say.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub struct Checks {
    /// Censuses taken between neighbouring points, to compare with the branches there.
    pub between: usize,
    /// Positions of those whose equilibria differ from the branches in number or in indices, after
    /// all rounds of refinement.
    pub mismatches: Vec<f64>,
    /// Positions between two points or events at which no census could be decided, nor near by:
    /// nothing is known there. If no census of the path is complete, all its positions.
    pub undecided: Vec<f64>,
    /// Points that were added on the way, where branches and census differed at first.
    pub added: usize,
    /// Proved equilibria whose energy or indices the curves' own formulas see otherwise.
    pub disagreements: usize,
    /// Intervals in which not every equilibrium could be followed.
    pub unfollowed: Vec<[f64; 2]>,
    /// Positions of branch points whose other branches were not found, after all rounds of
    /// refinement.
    pub incomplete: Vec<f64>,
    /// Points at which the alternating sum of the indices is not the Euler characteristic.
    pub euler_violations: usize,
}

impl Checks {
    /// Whether every check was decided, and agrees.
    pub fn agree(&self) -> bool {
        self.decided()
            && self.mismatches.is_empty()
            && self.disagreements == 0
            && self.euler_violations == 0
    }

    /// Whether every branch was followed, every branch point has its branches, and no stretch of
    /// the path is without a complete census.
    pub fn decided(&self) -> bool {
        self.unfollowed.is_empty() && self.incomplete.is_empty() && self.undecided.is_empty()
    }
}

/// Positions of the branch points at which fewer than two curves cross.
pub(crate) fn incomplete(branches: &[Branch], events: &[Event]) -> Vec<f64> {
    let crossing = events.iter().filter(|event| event.kind == EventKind::BranchPoint);
    let lacking = crossing.filter(|event| {
        // Each branch that passes is two arms of the crossing, and each that ends is one.
        let here = BranchEnd::Event(event.id);
        let arms = event.branches.iter().map(|branch| {
            let ends = [branches[*branch].start, branches[*branch].end];
            match ends.into_iter().filter(|end| *end == here).count() {
                0 => 2,
                ends => ends,
            }
        });
        arms.sum::<usize>() < ARMS
    });
    lacking.map(|event| event.position).collect()
}

/// Indices in the plane and in space of all equilibria at a census point, sorted.
fn census_indices(census_point: &CensusPoint) -> Option<Vec<[usize; 2]>> {
    let nodes = census_point.nodes.as_ref()?;
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
            // Behind an event the index is that of the next point; so it is where a branch begins, as it may on
            // the vertical, whose turn is no part of the index.
            let after = branch.points.partition_point(|point| point.position < position);
            let before = branch.before(position)?;
            let begins = before.position <= branch.points[0].position;
            let next = before.event.is_some() || begins;
            let point = if next { branch.points.get(after)? } else { before };
            Some([point.index_in_plane, point.index_in_space])
        })
        .collect();
    indices.sort_unstable();
    indices
}

/// Whether the branches are what a census finds; `None` if it is undecided.
pub(crate) fn agrees(branches: &[Branch], census_point: &CensusPoint) -> Option<bool> {
    if census_point.is_refused() {
        return Some(branch_indices(branches, census_point.position).is_empty());
    }
    Some(census_indices(census_point)? == branch_indices(branches, census_point.position))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two branches that end in a crossing are half of it, and one that passes is the other half.
    #[test]
    fn a_crossing_has_four_arms() {
        let event = |branches: &[usize], kind| Event {
            id: 0,
            kind,
            position: 0.25,
            position_error: 0.0,
            values: vec![],
            values_error: vec![],
            span_m: 1.0,
            branches: branches.to_vec(),
            angles_rad: vec![],
            energy_j: 0.0,
            residual: 0.0,
            singular: 0.0,
        };
        let branch = |id, start, end| Branch { id, points: vec![], start, end };
        let here = BranchEnd::Event(0);
        let branches = [
            branch(0, BranchEnd::Path, BranchEnd::Path),
            branch(1, here, BranchEnd::Path),
            branch(2, BranchEnd::Border, here),
        ];
        let lacks = |meet: &[usize], kind| incomplete(&branches, &[event(meet, kind)]);
        assert!(lacks(&[0, 1, 2], EventKind::BranchPoint).is_empty());
        assert_eq!(lacks(&[0, 1], EventKind::BranchPoint), [0.25]);
        assert_eq!(lacks(&[0], EventKind::BranchPoint), [0.25]);
        assert!(lacks(&[1, 2], EventKind::Fold).is_empty());
    }
}
