//! What evidence says, and what it counts.

use model::Rung;
use model::evidence::{Evidence, Reason, Room, Status, Verified, VerifiedSystem};

#[test]
fn room_is_told_where_there_is_some() {
    assert_eq!(Room::of(0, 0, vec![]), None);
    for (turning_parts, free_joints, names) in
        [(1, 0, ""), (0, 1, ""), (1, 1, "P"), (2, 3, "P Q"), (0, 0, "Q")]
    {
        let undetermined: Vec<String> = names.split_whitespace().map(str::to_owned).collect();
        let room = Room { turning_parts, free_joints, undetermined: undetermined.clone() };
        assert_eq!(Room::of(turning_parts, free_joints, undetermined), Some(room));
    }
    let said = |turning_parts, free_joints, names: &[&str]| {
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        Room::of(turning_parts, free_joints, names).map(|room| room.to_string())
    };
    assert_eq!(said(0, 0, &["P"]).unwrap(), "P slides through equilibria with the same forces");
    let all = said(1, 2, &["P", "Q"]).unwrap();
    assert!(all.starts_with("one part turns freely") && all.contains("first; 2 joints whose"));
    assert!(all.ends_with("compared; P, Q slide through equilibria with the same forces"));
}

/// The box of a system tells its turns, slack members and loose joints where there are some.
#[test]
fn boxes_of_systems_tell_what_they_stand_for() {
    let said = |turns, slack, loose_joints| {
        let (width_m, width_n, distance_n) = (1e-9, 2e-9, 0.0);
        let of = VerifiedSystem { width_m, width_n, distance_n, turns, slack, loose_joints };
        let system = Some(of);
        Verified { box_width: 1e-12, distance: 0.0, circle: false, system }.to_string()
    };
    let plain = said(0, 0, 0);
    assert!(plain.contains("N wide, forces within") && plain.ends_with(" N"), "{plain}");
    for (turns, words) in [(1, "vertical, 1 turn"), (2, "vertical, 2 turns")] {
        let text = said(turns, 0, 0);
        assert!(text.starts_with(&plain) && text.ends_with(words), "{text}");
    }
    for (slack, words) in [(1, "; 1 member proved slack"), (3, "; 3 members proved slack")] {
        assert_eq!(said(0, slack, 0), format!("{plain}{words}"));
    }
    for (loose, words) in [(1, "1 joint without"), (4, "4 joints without")] {
        let text = said(0, 0, loose);
        assert!(text.starts_with(&plain) && text.contains(words), "{text}");
    }
}

/// A census that refutes an answer takes back all but its convergence.
#[test]
fn a_refuted_answer_has_failed() {
    let mut evidence = Evidence::new("residual", 1e-15, 1e-12, 7);
    assert!(!evidence.ladder.failed());
    assert!(evidence.ladder.convergence().is_some());
    evidence.ladder.refute(0.25);
    assert!(evidence.ladder.failed());
    for rung in [Rung::Agreed, Rung::Verified, Rung::Complete, Rung::Optimal] {
        let reason = evidence.ladder.reason(rung);
        assert_eq!(reason, Some(&Reason::RefutedByCensus { distance: 0.25 }));
    }
    assert!(evidence.ladder.is_reached(Rung::Converged));
    evidence.ladder.converged = Status::Open(Reason::NotTried);
    assert!(evidence.ladder.convergence().is_none());
}
