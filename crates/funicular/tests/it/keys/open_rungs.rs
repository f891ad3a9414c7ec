//! Every reason for which a rung is open, as JSON and as a sentence: what went into it stands in
//! both. Which reason an answer has is asserted of cases, here and in the crates that give it.

use super::refusals::{of, output};
use model::{
    Choices, Disagreement, Excess, ForceChoice, ForcesFound, LargeForce, NoBox, NoCensus,
    NoCertificate, Place, Proved, Quantity, Reason, SolverName,
};

/// The reasons with what their sentences have to say.
fn reasons<'a, const N: usize>(test: &str, reasons: [(Reason, &'a [&'a str]); N]) {
    let reasons = reasons.map(|(reason, words)| of(&reason, words));
    output("a reason", test, &reasons);
}

fn pair() -> [SolverName; 2] {
    [SolverName::LAGRANGE, SolverName::ENERGY]
}

#[test]
fn reasons_of_a_chain() {
    reasons(
        "reasons_of_a_chain",
        [
            (Reason::RefutedByCensus { distance: 0.125 }, &["refuted", "lies 1.2e-1 of the total"]),
            (Reason::SlackFamily, &["one of a family with slack bars"]),
            (Reason::NotAmongDecided { cells: 3 }, &["leaves 3 cells of pulls undecided"]),
            (Reason::Elsewhere { distance: 0.375 }, &["lies 3.8e-1 of the total"]),
            (
                Reason::AtStraight { distance: 0.875 },
                &["within 8.8e-1 of the total", "a straight position"],
            ),
            (Reason::NothingListed, &["lists no equilibrium"]),
            (Reason::CensusUndecided { cells: 4 }, &["4 cells of pulls are undecided"]),
            (
                Reason::SingularFamilies { listed: 1 },
                &["one family with slack bars is no manifold"],
            ),
            (Reason::SingularFamilies { listed: 9 }, &["9 families with slack bars"]),
            (Reason::StraightPosition { sides: vec![6, 7] }, &["sides 6, 7 are together"]),
            (Reason::CountUnchecked { sides: 8 }, &["a polygon of 8 sides"]),
        ],
    );
}

#[test]
fn reasons_without_a_census() {
    let reason = Reason::NoCensus;
    reasons(
        "reasons_without_a_census",
        [
            (reason(NoCensus::Settings), &["settings are out of range"]),
            (reason(NoCensus::Refused), &["no equilibrium problem"]),
            (
                reason(NoCensus::Motions { closures: 3, motions: 4, limit: 5 }),
                &[
                    "a net of 3 closures whose joints move in 4 independent ways, and the limit is 5",
                ],
            ),
            (reason(NoCensus::Undecided { boxes: 6 }), &["6 boxes of places"]),
            (reason(NoCensus::PlaneOnly), &["in the vertical plane of the anchors"]),
            (reason(NoCensus::Turns { joint: 7 }), &["at the 7th joint turns freely"]),
            (reason(NoCensus::Closures { closures: 8 }), &["8 independent closures"]),
            (reason(NoCensus::LoadsNotDown { joint: 9 }), &["the 9th joint", "not straight down"]),
            (reason(NoCensus::Elastic { member: 10 }), &["member 10", "is elastic"]),
            (reason(NoCensus::Limp { member: 12 }), &["member 12 bears nothing"]),
            (reason(NoCensus::Flat { joint: 13 }), &["the 13th joint may lie flat"]),
            (reason(NoCensus::Floor), &["no census knows a floor"]),
            (reason(NoCensus::TooManyPositions { limit: 14 }), &["more than 14 equilibria"]),
            (reason(NoCensus::Cables), &["of cables and ropes alone"]),
            (reason(NoCensus::SlackSets { limit: 15 }), &["slack or jam in more than 15 ways"]),
            (reason(NoCensus::Loose { joint: 16 }), &["nothing holds the 16th joint"]),
        ],
    );
}

#[test]
fn reasons_without_a_box() {
    let reason = Reason::NoBox;
    reasons(
        "reasons_without_a_box",
        [
            (
                reason(NoBox::TooLarge { unknowns: 3, limit: 4 }),
                &["3 unknowns, and the limit is 4"],
            ),
            (reason(NoBox::SelfStresses { dimension: 5 }), &["5 independent states"]),
            (reason(NoBox::FreeMotions { dimension: 6 }), &["from 6 independent motions"]),
            (
                reason(NoBox::Degenerate { member: 7 }),
                &["member 7 has just its length and bears no force but that of its own weight"],
            ),
            (
                reason(NoBox::WrongSign { member: 8 }),
                &["member 8", "the sign that its kind allows"],
            ),
            (reason(NoBox::NotSlack { member: 9 }), &["member 9 is not proved to be slack"]),
            (reason(NoBox::BetweenAnchors { member: 10 }), &["member 10 connects two anchors"]),
            (
                reason(NoBox::Floor { joint: 11 }),
                &["the 11th joint is not proved to be above the floor"],
            ),
            (reason(NoBox::NotConverged), &["no equilibrium with the same members in action"]),
            (reason(NoBox::Singular), &["is singular"]),
            (reason(NoBox::NotContracting), &["Krawczyk's test fails"]),
            (
                reason(NoBox::Elsewhere { distance_m: 0.125, distance_n: 0.375 }),
                &["is 1.2e-1 m and 3.8e-1 N away"],
            ),
            (reason(NoBox::NotFinite), &["incomplete or not finite"]),
            (reason(NoBox::Rope { member: 12 }), &["the rope that is member 12 has no length"]),
        ],
    );
}

#[test]
fn reasons_without_a_certificate() {
    let reason = Reason::NoCertificate;
    reasons(
        "reasons_without_a_certificate",
        [
            (reason(NoCertificate::SeveralCompressed { bars: 3 }), &["3 bars are in compression"]),
            (reason(NoCertificate::Indefinite { bar: 4, excess: 0.125 }), &["bar 4", "1.25e-1"]),
            (reason(NoCertificate::Gap { gap: 0.375 }), &["stays 3.8e-1 of weight times length"]),
            (
                reason(NoCertificate::NotClosed { gap_m: 0.5, slack_m: 0.25 }),
                &["is 5.0e-1 m from its anchor", "only 2.5e-1 m of slack"],
            ),
            (reason(NoCertificate::EnergyFalls { directions: 5 }), &["falls in 5 directions"]),
            (reason(NoCertificate::PivotsUndecided), &["not proved positive"]),
            (reason(NoCertificate::NotDefinite { compressed: 6 }), &["with 6 members compressed"]),
            (reason(NoCertificate::NotConvex { members: 7 }), &["and 7 push or may push"]),
            (reason(NoCertificate::Unusable), &["incomplete or not finite"]),
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
    let words = [
        "joints of lagrange and energy / m: 3.00e0 is over its budget of 1.25e-1",
        "forces of lagrange and energy / N: 4.00e0",
        "energy of lagrange and energy / J: 5.00e0",
        "statics of energy, at member 15: 6.00e0",
        "numbers of directions in which the energy falls, by lagrange and energy: 7.00e0",
        "what the self-stresses of energy leave at a joint: 8.00e0",
        "forces that lagrange and energy name by the same convention / N: 1.10e1",
        "forces of energy less those of equally stiff members / N: 1.20e1",
        "force of energy over all that acts on the system, at member 16: 1.30e1",
    ];
    let disagreement = Reason::SolversDisagree(Disagreement { excesses });
    reasons("reasons_of_solvers_that_disagree", [(disagreement, &words)]);
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
    let findings = [
        of(&large, &["member 3 bears -5.00e7 N, 2.50e6 times all that acts", "independent"]),
        of(&choices, &["in member 4 0.25 N by lagrange", "12.5 N by energy", "the energy rises"]),
        of(&proved, &["the lengths are independent, and the energy rises"]),
    ];
    output("a finding of forces", "findings_of_forces", &findings);
}
