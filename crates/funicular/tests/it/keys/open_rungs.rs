//! Every reason for which a rung is open, as JSON and as a sentence: what went into it stands in
//! both. Which reason an answer has is asserted of cases, here and in the crates that give it.

use model::{
    Choices, Disagreement, Excess, ForceChoice, ForcesFound, LargeForce, NoBox, NoCensus,
    NoCertificate, Place, Proved, Quantity, Reason, SolverName,
};

use super::refusals::output;

fn pair() -> [SolverName; 2] {
    [SolverName::LAGRANGE, SolverName::ENERGY]
}

#[test]
fn reasons_of_a_chain() {
    output(
        "a reason",
        "reasons_of_a_chain",
        &[
            Reason::RefutedByCensus { distance: 0.125 },
            Reason::SlackFamily,
            Reason::NotAmongDecided { cells: 3 },
            Reason::Elsewhere { distance: 0.375 },
            Reason::AtStraight { distance: 0.875 },
            Reason::NothingListed,
            Reason::CensusUndecided { cells: 4 },
            Reason::SingularFamilies { listed: 1 },
            Reason::SingularFamilies { listed: 9 },
            Reason::StraightPosition { sides: vec![6, 7] },
            Reason::CountUnchecked { sides: 8 },
        ],
    );
}

#[test]
fn reasons_without_a_census() {
    let reason = Reason::NoCensus;
    output(
        "a reason",
        "reasons_without_a_census",
        &[
            reason(NoCensus::Settings),
            reason(NoCensus::Refused),
            reason(NoCensus::Motions { closures: 3, motions: 4, limit: 5 }),
            reason(NoCensus::Undecided { boxes: 6 }),
            reason(NoCensus::PlaneOnly),
            reason(NoCensus::Turns { joint: 7 }),
            reason(NoCensus::Closures { closures: 8 }),
            reason(NoCensus::LoadsNotDown { joint: 9 }),
            reason(NoCensus::Elastic { member: 10 }),
            reason(NoCensus::Limp { member: 12 }),
            reason(NoCensus::Flat { joint: 13 }),
            reason(NoCensus::Floor),
            reason(NoCensus::TooManyPositions { limit: 14 }),
            reason(NoCensus::Cables),
            reason(NoCensus::SlackSets { limit: 15 }),
            reason(NoCensus::Loose { joint: 16 }),
        ],
    );
}

#[test]
fn reasons_without_a_box() {
    let reason = Reason::NoBox;
    output(
        "a reason",
        "reasons_without_a_box",
        &[
            reason(NoBox::TooLarge { unknowns: 3, limit: 4 }),
            reason(NoBox::SelfStresses { dimension: 5 }),
            reason(NoBox::FreeMotions { dimension: 6 }),
            reason(NoBox::Degenerate { member: 7 }),
            reason(NoBox::WrongSign { member: 8 }),
            reason(NoBox::NotSlack { member: 9 }),
            reason(NoBox::BetweenAnchors { member: 10 }),
            reason(NoBox::Floor { joint: 11 }),
            reason(NoBox::NotConverged),
            reason(NoBox::Singular),
            reason(NoBox::NotContracting),
            reason(NoBox::Elsewhere { distance_m: 0.125, distance_n: 0.375 }),
            reason(NoBox::NotFinite),
            reason(NoBox::Rope { member: 12 }),
        ],
    );
}

#[test]
fn reasons_without_a_certificate() {
    let reason = Reason::NoCertificate;
    output(
        "a reason",
        "reasons_without_a_certificate",
        &[
            reason(NoCertificate::SeveralCompressed { bars: 3 }),
            reason(NoCertificate::Indefinite { bar: 4, excess: 0.125 }),
            reason(NoCertificate::Gap { gap: 0.375 }),
            reason(NoCertificate::NotClosed { gap_m: 0.5, slack_m: 0.25 }),
            reason(NoCertificate::EnergyFalls { directions: 5 }),
            reason(NoCertificate::PivotsUndecided),
            reason(NoCertificate::NotDefinite { compressed: 6 }),
            reason(NoCertificate::NotConvex { members: 7 }),
            reason(NoCertificate::Unusable),
        ],
    );
}

#[test]
fn reasons_of_solvers_that_disagree() {
    let excess = |what, value| Excess { what, value, budget: 0.125 };
    let solver = SolverName::ENERGY;
    let excesses = vec![
        excess(Quantity::Joints { between: pair() }, 3.0),
        excess(Quantity::Forces { between: pair() }, 4.0),
        excess(Quantity::Energy { between: pair() }, 5.0),
        excess(Quantity::Statics { solver: solver.clone(), place: Place::Member(15) }, 6.0),
        excess(Quantity::MorseIndex { between: pair() }, 7.0),
        excess(Quantity::SelfStresses { solver: solver.clone() }, 8.0),
        excess(Quantity::NamedForces { between: pair() }, 11.0),
        excess(Quantity::EquallyStiff { solver: solver.clone() }, 12.0),
        excess(Quantity::LargeForce { solver, member: 16 }, 13.0),
    ];
    let disagreement = Reason::SolversDisagree(Disagreement { excesses });
    output("a reason", "reasons_of_solvers_that_disagree", &[disagreement]);
}

/// What is found of forces besides their difference. Which findings a comparison has is asserted in
/// the crate that makes it.
#[test]
fn findings_of_forces() {
    let large = ForcesFound {
        large: Some(LargeForce { member: 3, force_n: -5e7, ratio: 2.5e6 }),
        proved: Some(Proved::Rank),
        ..ForcesFound::default()
    };
    let choices = ForcesFound {
        choices: Some(Choices {
            between: pair(),
            choices: [ForceChoice::EquallyStiff, ForceChoice::Unknown],
            member: 4,
            forces_n: [0.25, 12.5],
        }),
        proved: Some(Proved::Stability),
        ..ForcesFound::default()
    };
    let proved = ForcesFound { proved: Some(Proved::RankAndStability), ..ForcesFound::default() };
    let findings = [large, choices, proved];
    output("a finding of forces", "findings_of_forces", &findings);
}
