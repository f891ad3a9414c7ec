//! Names that only some answers have: of what ends a branch, of what a seed comes to, of verdicts.

use serde::Serialize;
use serde_json::{Value, json};

use super::refusals::output;

fn name(value: &impl Serialize) -> Value {
    serde_json::to_value(value).unwrap()
}

/// Every reason for an undecided cell of pulls.
#[test]
fn reasons_of_cells() {
    use census::Reason;
    let reasons = [
        (Reason::Degenerate, "degenerate", "as small as cells get"),
        (Reason::Unloaded, "unloaded", "the force of a bar vanishes here"),
        (Reason::Budget, "budget", "the budget of tests was spent"),
        (Reason::Unclear, "unclear", "overlap"),
        (Reason::Index, "index", "its index or its finite pull is not proved"),
        (Reason::Slack, "slack", "may or may not bridge the gap"),
    ];
    for (reason, called, sentence) in reasons {
        assert_eq!(name(&reason), called);
        assert!(reason.to_string().contains(sentence), "{reason}");
    }
}

#[test]
fn ends_and_events_of_branches() {
    use branches::{BranchEnd, EventKind};
    assert_eq!(name(&BranchEnd::Path), "path");
    assert_eq!(name(&BranchEnd::Event(3)), json!({ "event": 3 }));
    assert_eq!(name(&BranchEnd::Border), "border");
    assert_eq!(name(&BranchEnd::Lost), "lost");
    assert_eq!(name(&funicular::LoadEnd::Unbounded), "unbounded");
    assert_eq!(name(&funicular::LoadEnd::Jams), "jams");
    assert_eq!(name(&funicular::LoadEnd::NoLength), "no-length");
    assert_eq!(name(&funicular::Format::Parquet), "parquet");
    let kinds = [
        (EventKind::Fold, json!({ "kind": "fold" })),
        (EventKind::Straight, json!({ "kind": "straight" })),
        (EventKind::BranchPoint, json!({ "kind": "branch-point" })),
        (
            EventKind::SpaceExchange { from: 1, to: 2 },
            json!({ "kind": "space-exchange", "from": 1, "to": 2 }),
        ),
        (EventKind::Unloaded { bar: 5 }, json!({ "kind": "unloaded", "bar": 5 })),
    ];
    for (kind, object) in kinds {
        assert_eq!(name(&kind), object);
    }
}

#[test]
fn characters_in_the_plane() {
    use model::InPlane::{Degenerate, Maximum, Minimum, Saddle};
    let names = [Minimum, Saddle, Maximum, Degenerate].map(|found| name(&found));
    assert_eq!(names, ["minimum", "saddle", "maximum", "degenerate"].map(Value::from));
}

#[test]
fn what_seeds_come_from_and_to() {
    use sweep::{Comparison, Origin, Source};
    assert_eq!(name(&Source::Uniform), "uniform");
    assert_eq!(name(&Source::Sobol), "sobol");
    assert_eq!(name(&Origin::Proven), "proven");
    assert_eq!(name(&Origin::Family), "family");
    assert_eq!(name(&Origin::Discovered), "discovered");
    for (comparison, called) in [
        (Comparison::Same, "same"),
        (Comparison::NoMinimum, "no_minimum"),
        (Comparison::OtherBasin, "other_basin"),
        (Comparison::Unclassified, "unclassified"),
        (Comparison::Failed, "failed"),
        (Comparison::EnergyAtNoMinimum, "energy_at_no_minimum"),
        (Comparison::EnergiesDiffer, "energies_differ"),
        (Comparison::NotListed, "not_listed"),
    ] {
        assert_eq!(name(&comparison), called);
    }
}

#[test]
fn verdicts_of_all_kinds() {
    use paper::equations::{Fault, Validity};
    use validate::Verdict;
    use validate::foreign::Finding;
    assert_eq!(name(&Verdict::Agreed), "agreed");
    assert_eq!(name(&Verdict::Disagreed), "disagreed");
    assert_eq!(name(&Finding::NoEquilibrium), json!({ "finding": "no_equilibrium" }));
    let hidden = Finding::LoadsHidden { member: 1, force_n: 2.0, loads_n: 3.0, allowed_n: 4.0 };
    let keys = json!({ "finding": "loads_hidden", "member": 1, "force_n": 2.0, "loads_n": 3.0, "allowed_n": 4.0 });
    assert_eq!(name(&hidden), keys);
    assert_eq!(name(&Finding::ForcesNotFound), json!({ "finding": "forces_not_found" }));
    for (validity, called) in [
        (Validity::Holds, "holds"),
        (Validity::Corrected, "corrected"),
        (Validity::Refuted, "refuted"),
        (Validity::Definition, "definition"),
        (Validity::Remark, "remark"),
    ] {
        assert_eq!(name(&validity), called);
    }
    for (fault, called) in
        [(Fault::Form, "form"), (Fault::Digits, "digits"), (Fault::Substance, "substance")]
    {
        assert_eq!(name(&fault), called);
    }
}

/// What is said of forces that are not certain.
#[test]
fn uncertain_forces() {
    use model::{Convergence, ForceChoice, ForceRange, ForceUncertainty, UncertaintyCause};
    let uncertain = |residual, relative, cause| Convergence {
        residual_of: "closure",
        residual,
        tolerance: Some(0.5),
        iterations: 3,
        force_uncertainty: Some(ForceUncertainty { relative, cause }),
    };
    let objects = [
        uncertain(0.125, 3e-5, UncertaintyCause::WeakClosure),
        uncertain(0.25, 4e-6, UncertaintyCause::ParallelBars),
    ];
    output("uncertain forces", "uncertain_forces", &objects);
    assert_eq!(name(&ForceChoice::Unknown), "unknown");
    assert_eq!(name(&ForceRange::Free), json!({ "kind": "free" }));
}
