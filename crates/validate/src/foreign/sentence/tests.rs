//! Every law in words, with numbers by hand.

use super::*;

#[test]
fn what_is_broken_is_told_with_its_numbers() {
    let what =
        |law: Law, value: f64| Violation { place: Place::Whole, law, value, allowed: 0.0 }.what();
    assert_eq!(what(Law::Support, 0.25), "0.25 m off its support");
    assert_eq!(what(Law::BelowFloor, 0.5), "0.5 m below the floor");
    assert_eq!(
        what(Law::FloorPulls { force_n: 3.0 }, 3.0),
        "the floor would have to pull it down with 3 N"
    );
    let length = |distance_m: f64| Law::Length { length_m: 5.0, distance_m };
    assert_eq!(
        what(length(5.5), 0.5),
        "its joints are 5.5 m apart, 0.5 m more than its length of 5 m"
    );
    assert_eq!(
        what(length(4.5), 0.5),
        "its joints are 4.5 m apart, 0.5 m less than its length of 5 m"
    );
    assert_eq!(
        what(Law::Elongation { force_n: 3.0, elastic_n: 2.5 }, 0.5),
        "carries 3 N, and its elongation gives 2.5 N"
    );
    assert_eq!(what(Law::Sign { force_n: -2.0 }, 2.0), "a cable that pushes with 2 N");
    assert_eq!(what(Law::Sign { force_n: 2.0 }, 2.0), "a strut that pulls with 2 N");
    assert_eq!(
        what(Law::Slack { force_n: 2.0, length_m: 5.0, distance_m: 4.0 }, 2.0),
        "carries 2 N, though its joints are 4 m apart and its length is 5 m"
    );
    let force = [1.0, -0.0, -2.5];
    assert_eq!(what(Law::Balance { left_n: force }, 1.0), "(1, 0, -2.5) N are left over");
    assert_eq!(
        what(Law::Reaction { given_n: force, wanted_n: [0.0, 0.5, 0.0] }, 1.0),
        "the ground is said to push with (1, 0, -2.5) N, and its members and loads need (0, 0.5, 0) N"
    );
    assert_eq!(
        what(Law::Whole { left_n: force }, 1.0),
        "forces of the ground and loads together leave (1, 0, -2.5) N"
    );
}

/// Ten digits, and exponents for what is shorter than 1e-4 or as long as 1e9.
#[test]
fn numbers_are_written_short() {
    for (number, text) in [
        (0.0, "0"),
        (-0.0, "0"),
        (0.000_125, "0.000125"),
        (-0.000_1, "-0.0001"),
        (0.000_099, "9.9e-5"),
        (1.0 / 3.0, "0.3333333333"),
        (999_999_999.0, "999999999"),
        (1e9, "1e9"),
        (-2.5e12, "-2.5e12"),
        (1.000_000_000_04, "1"),
    ] {
        assert_eq!(fine(number).to_string(), text);
    }
    assert_eq!(Force([1.0 / 3.0, 2e-5, -1e9]).to_string(), "(0.3333333, 2e-5, -1e9) N");
}

#[test]
fn ends_are_told_outwards() {
    let [least, most] = outwards([2.0, 4.0]);
    assert!((least - 1.999).abs() < 1e-15 && (most - 4.002).abs() < 1e-15, "{least} {most}");
}

/// Two equilibria near a lamp, with numbers that are made up, and one solver without any.
#[test]
fn a_judgement_is_told_in_sentences() {
    use super::super::{ForeignAnswer, ProvedError, judge_foreign};
    let system = super::super::tests::lamp();
    let places = vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    let answer = ForeignAnswer::in_order(&system, "a table", places, None).unwrap();
    let mut judged = judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap();
    let ForcesJudged::Found(best) = &mut judged.forces else { panic!() };
    (best.residual_n, best.largest_n) = (0.125, 1.25);
    assert_eq!(
        judged.forces_sentence(),
        "The answer has no forces: those that balance best leave 0.125 N (root of the sum of squares over \
         the joints), the largest of them is 1.25 N."
    );
    judged.forces = ForcesJudged::Given;
    assert_eq!(judged.forces_sentence(), "The forces are those of the answer.");

    let [first, second] = &mut judged.nearest.equilibria[..] else { panic!() };
    (first.equilibrium.solver, second.equilibrium.solver) =
        (model::SolverName::LAGRANGE, model::SolverName::ENERGY);
    (first.joints_m, first.joint, first.forces_n, first.member) = (0.5, 2, 0.25, 2);
    first.proved = Some(ProvedError { joints_m: [2.0, 4.0], forces_n: [0.0, 8.0] });
    (second.joints_m, second.joint, second.member, second.proved) = (0.75, 7, 0, None);
    second.equilibrium.evidence.ladder = model::Ladder::default();
    second.equilibrium.stability.index_in_space = 1;
    let rung = first.equilibrium.evidence.rung().unwrap().to_string();
    let [told, other] = &judged.error_sentences(&system)[..] else { panic!() };
    assert_eq!(
        *told,
        format!(
            "lagrange, from the answer, finds an equilibrium ({rung}) up to 0.5 m away, at joint P; \
             forces differ by up to 0.25 N, in member 2 (P - B). Proved: the largest error of a joint is \
             between 1.999 and 4.002 m, of a force between 0 and 8.004 N."
        )
    );
    let wanted = "finds an unstable equilibrium (no rung) up to 0.75 m away, at joint .";
    assert_eq!(*other, format!("energy, from the answer, {wanted}"));
    // A member that is not there is not named.
    judged.nearest.equilibria[1].member = 3;
    judged.nearest.without_guess = true;
    assert_eq!(judged.error_sentences(&system)[1], format!("energy, without a guess, {wanted}"));
}

#[test]
fn places_are_told_by_name() {
    let system = super::super::tests::lamp();
    let told = |place: Place| {
        Violation { place, law: Law::Support, value: 1.0, allowed: 1.0 }.place_in(&system)
    };
    assert_eq!(told(Place::Member(1)), "member 1 (A - P)");
    assert_eq!(told(Place::Member(2)), "member 2 (P - B)");
    assert_eq!(told(Place::Member(0)), "member 0");
    assert_eq!(told(Place::Member(3)), "member 3");
    assert_eq!(told(Place::Joint(0)), "joint A");
    assert_eq!(told(Place::Joint(2)), "joint P");
    assert_eq!(told(Place::Joint(3)), "joint 3");
    assert_eq!(told(Place::Whole), "the whole");
}

#[test]
fn laws_and_findings_have_their_words() {
    let none = [0.0; 3];
    let words = [
        Law::Support,
        Law::Length { length_m: 1.0, distance_m: 1.0 },
        Law::Elongation { force_n: 1.0, elastic_n: 1.0 },
        Law::Sign { force_n: 1.0 },
        Law::Slack { force_n: 1.0, length_m: 1.0, distance_m: 1.0 },
        Law::Balance { left_n: none },
        Law::Reaction { given_n: none, wanted_n: none },
        Law::Whole { left_n: none },
        Law::BelowFloor,
        Law::FloorPulls { force_n: 1.0 },
    ]
    .map(|law| law.word());
    assert_eq!(
        words.join(", "),
        "support, length, elongation, sign, slackness, balance, force of the ground, \
         balance of the whole, floor, push of the floor"
    );
    let words = [Finding::Confirmed, Finding::Refuted, Finding::NoEquilibrium].map(|f| f.word());
    assert_eq!(words, ["confirmed", "refuted", "undecided"]);
}
