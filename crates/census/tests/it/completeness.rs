//! What stands in the way of a complete list.

use model::{InSpace, Reason, Status};

use crate::support::{census, problem};

/// Two bars hang plumb from anchors a step apart and the bar between them is level without force:
/// equilibria merge there, which is not decided.
#[test]
fn undecided_cells_are_told_with_their_number() {
    let problem = problem(&[(1.0, 1.0, 0.5), (1.0, 0.0, 0.5), (1.0, 1.0, 0.5)], [1.0, 0.0, -2.0]);
    let census = census(&problem);
    let cells = census.undecided.len();
    assert!(!census.complete && cells > 0);
    assert_eq!(census.completeness(), Status::Open(Reason::CensusUndecided { cells }));
}

/// Two bars of 5 m between level anchors 6 m apart hang stable, and stand stable in their plane only.
#[test]
fn stability_is_told_by_the_indices() {
    let problem = problem(&[(5.0, 1.0, 2.5); 2], [6.0, 0.0, 0.0]);
    let found = census(&problem).to_model();
    let told: Vec<_> = found.iter().map(|one| one.stability.in_space).collect();
    assert_eq!(told, [InSpace::Stable, InSpace::Unstable]);
}

/// Four equal bars between anchors in one point lie straight where two point back: 1 + 1 = 1 + 1.
#[test]
fn straight_positions_are_told_with_their_sides() {
    let census = census(&crate::support::equal(4, [0.0; 3]));
    assert!(census.undecided.is_empty());
    let completeness = census.completeness();
    let Status::Open(Reason::StraightPosition { sides }) = &completeness else {
        panic!("{completeness:?}")
    };
    assert_eq!(sides.len(), 2);
}
