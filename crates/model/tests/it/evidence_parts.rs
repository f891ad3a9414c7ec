//! What evidence is made of, and the registries that everything is tested over.

use model::evidence::{Disagreement, Excess, Quantity, Reason};
use model::system::{Kind, Member, PrestressError};
use model::{Bar, SolverName, cases};

fn excess(value: f64) -> Excess {
    let between = [SolverName::LAGRANGE, SolverName::ENERGY];
    Excess { what: Quantity::Joints { between }, value, budget: 1e-10 }
}

#[test]
fn every_part_of_a_disagreement_is_told() {
    let disagreement = Disagreement { excesses: vec![excess(0.5), excess(0.25)] };
    assert!(!disagreement.is_empty());
    let sentences = disagreement.sentences();
    assert_eq!(sentences.len(), 2);
    for reason in [
        Reason::SolversDisagree(disagreement.clone()),
        Reason::JudgeRefuses { excesses: disagreement.excesses },
    ] {
        let said = reason.to_string();
        assert!(sentences.iter().all(|sentence| said.contains(sentence)), "{said}");
    }
}

#[test]
fn a_lone_answer_tells_its_balance() {
    let said = Reason::OneSolverOnly { solver: SolverName::ENERGY, statics: 3e-14 }.to_string();
    assert!(said.contains("only energy was asked"), "{said}");
    assert!(said.contains("every bar in balance"), "{said}");
}

/// Tests run over these lists: an empty one would let them all pass.
#[test]
fn registries_are_not_empty() {
    assert!(cases::all().len() >= 10 && cases::gallery().len() >= 5);
    assert!(!cases::tensegrities().is_empty());
    let all = cases::gallery().len() + cases::tensegrities().len();
    assert_eq!(cases::systems().count(), all);
    assert!(cases::all().iter().any(|case| case.name == "three-equal-bars"));
}

/// A cable under no force is as long as it was, a strut too; the other sign is refused.
#[test]
fn cables_pull_and_struts_push() {
    let member = |kind| {
        let bar = Member::bar(0, 1, Bar::homogeneous(5.0, 2.0).unwrap());
        bar.of_kind(kind).with_stiffness(800.0)
    };
    for kind in [Kind::Bar, Kind::Cable, Kind::Strut] {
        let rest = member(kind).with_prestress(0.0).unwrap();
        assert!((rest.body.length_m() - 5.0).abs() < 1e-15);
    }
    for (kind, prestress_n) in [(Kind::Cable, -1.0), (Kind::Strut, 1.0)] {
        let refused = member(kind).with_prestress(prestress_n);
        assert_eq!(refused, Err(PrestressError::Sign { kind, prestress_n }));
        assert!(member(kind).with_prestress(-prestress_n).is_ok());
    }
}
