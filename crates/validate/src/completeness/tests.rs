//! Families of equilibria with slack bars.

use census::Settings;

use super::*;

/// The last bar hangs from its anchor, with 1 kg at its middle, 0.375 m below 3 m; the others, slack
/// and without mass, bridge what is left of the way in many ways, all of one energy.
#[test]
fn an_energy_is_that_of_a_family_to_rounding() {
    let bars = [(0.5, 0.0), (1.0, 0.0), (2.0, 0.0), (0.75, 1.0)];
    let problem = samples::homogeneous(9.81, &bars, [0.0, 0.0, 3.0]);
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert_eq!(census.families.len(), 1);
    let energy_j = 9.81 * 2.625;
    // The unit is 9.81 N times 4.25 m: 1e-12 of it are 4e-11 J.
    for (off_j, is_one) in [(0.0, true), (2e-11, true), (-1e-10, false), (1e-10, false)] {
        assert_eq!(in_family(problem.chain(), &census, energy_j + off_j), is_one, "{off_j}");
    }
    assert!(!in_family(problem.chain(), &census, f64::NAN));
}

/// What a census says of an answer with these joints, of homogeneous bars of 1 m and 1 kg. Neither its
/// forces nor its energy are asked.
fn said(bars: usize, end_m: [f64; 3], heights_m: &[f64]) -> Reason {
    let problem = samples::homogeneous(10.0, &vec![(1.0, 1.0); bars], end_m);
    let census = Census::take(&problem, &Settings::default()).unwrap();
    let found = lagrange::solve(&problem, &lagrange::Settings::default()).unwrap().equilibrium;
    let joints_m = heights_m.iter().map(|z| [0.0, 0.0, *z]).collect();
    let mut answer = Equilibrium { joints_m, energy_j: 1e6, ..found };
    certify_by_census(&problem, &census, &mut answer);
    let ladder = answer.evidence.ladder;
    assert_eq!(ladder.verified.reason(), ladder.complete.reason());
    ladder.complete.reason().unwrap().clone()
}

/// Three bars over 1 m lie in the vertical in three ways, up or down; four that come back hang or stand.
#[test]
fn answers_in_the_vertical_are_at_straight_positions() {
    let at = |distance| Reason::AtStraight { distance };
    let down = [0.0, 0.0, -1.0];
    assert_eq!(said(3, down, &[0.0, -1.0, -2.0, -1.0]), at(0.0));
    assert_eq!(said(3, down, &[0.0, 1.0, 0.0, -1.0]), at(0.0));
    assert_eq!(said(3, [0.0, 0.0, 1.0], &[0.0, 1.0, 2.0, 1.0]), at(0.0));
    // A joint off by what an answer may be: 2^-33 m, of 3 m. By a millimetre it is somewhere else.
    let apart = 2.0_f64.powi(-33);
    let near = said(3, down, &[0.0, -1.0, apart - 2.0, -1.0]);
    let Reason::AtStraight { distance } = near else { panic!("{near}") };
    assert!((distance - apart / 3.0).abs() < 1e-15, "{distance:e}");
    let off = said(3, down, &[0.0, -1.0, -1.999, -1.0]);
    assert!(!matches!(off, Reason::AtStraight { .. }), "{off}");
    // From one point to itself.
    for turn in [-1.0, 1.0] {
        assert_eq!(said(4, [0.0; 3], &[0.0, turn, 2.0 * turn, turn, 0.0]), at(0.0));
    }
    // A joint less is no answer.
    let short = said(3, down, &[0.0, -1.0, -1.0]);
    assert!(!matches!(short, Reason::AtStraight { .. }), "{short}");
}

/// The budget of joints, 1e-10 of the length, and what a solver may place, 1e-12 and 8 units in the
/// last place.
#[test]
fn an_answer_is_refuted_by_more_than_two_may_differ() {
    let problem = model::cases::paper();
    let bound = 1e-10 + 1e-12 + 8.0 * f64::EPSILON;
    for (distance, refuted) in [(0.0, false), (0.9999 * bound, false), (1.0001 * bound, true)] {
        assert_eq!(refutes(problem.chain(), distance), refuted, "{distance:e}");
    }
    assert!(!refutes(problem.chain(), f64::NAN));
}

#[test]
fn why_an_answer_is_not_listed_is_told() {
    let problem = model::cases::paper();
    let chain = problem.chain();
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert!(census.complete && census.undecided.is_empty());
    let at = |beyond: f64| Some(Nearest { number: 1, beyond });
    let why = |census: &Census, place: Option<Nearest>| not_listed(chain, census, place, -1.0);
    assert_eq!(why(&census, at(0.25)), Reason::RefutedByCensus { distance: 0.25 });
    assert_eq!(why(&census, at(1e-11)), Reason::Elsewhere { distance: 1e-11 });
    assert_eq!(why(&census, None), Reason::NothingListed);
    let mut partial = census.clone();
    partial.complete = false;
    assert_eq!(why(&partial, at(0.25)), Reason::Elsewhere { distance: 0.25 });
    assert_eq!(why(&partial, None), Reason::NothingListed);
}

/// A list whose first entry is taken for another is refuted by, and looked up by number.
#[test]
fn an_answer_is_held_against_its_own_entry() {
    let problem = model::cases::paper();
    let census = Census::take(&problem, &Settings::default()).unwrap();
    let mut answers = census.to_model();
    for (k, answer) in answers.iter_mut().enumerate() {
        certify_by_census(&problem, &census, answer);
        let proof = answer.evidence.ladder.verified.proof().unwrap();
        assert_eq!(proof.box_width.to_bits(), census.equilibria[k].width().to_bits());
        assert_eq!(proof.circle, census.equilibria[k].circle);
        assert!(proof.distance < 1e-15 && answer.evidence.ladder.complete.is_reached());
    }
    // Half a metre off, of three.
    let mut off = answers[0].clone();
    off.joints_m[1][2] -= 0.5;
    certify_by_census(&problem, &census, &mut off);
    let why = off.evidence.ladder.complete.reason();
    assert!(
        matches!(why, Some(Reason::RefutedByCensus { distance }) if (distance - 1.0 / 6.0).abs() < 1e-9),
        "{why:?}"
    );
}
