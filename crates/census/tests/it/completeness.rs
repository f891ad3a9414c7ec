//! What stands in the way of a complete list.

use model::{Reason, Status};

use crate::support::{census, problem};

/// Two bars hang plumb from anchors a step apart and the bar between them is level without force:
/// two equilibria merge there.
#[test]
fn merged_equilibria_are_told_with_their_number() {
    let problem = problem(&[(1.0, 1.0, 0.5), (1.0, 0.0, 0.5), (1.0, 1.0, 0.5)], [1.0, 0.0, -2.0]);
    let census = census(&problem);
    assert!(!census.complete && census.undecided.is_empty());
    let open = Status::Open(Reason::DegenerateEquilibria { listed: 1 });
    assert_eq!((census.degenerate.len(), census.completeness()), (1, open));
}
