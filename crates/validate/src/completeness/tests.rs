//! Families of equilibria with slack bars.

use census::Settings;
use model::{Anchors, Bar};

use super::*;

/// The last bar hangs from its anchor, with 1 kg at its middle, 0.375 m below 3 m; the others, slack
/// and without mass, bridge what is left of the way in many ways, all of one energy.
#[test]
fn an_energy_is_that_of_a_family_to_rounding() {
    let bar = |length, mass| Bar::homogeneous(length, mass).unwrap();
    let bars = vec![bar(0.5, 0.0), bar(1.0, 0.0), bar(2.0, 0.0), bar(0.75, 1.0)];
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, 3.0] };
    let problem = Problem::new(Chain::new("slack", 9.81, anchors, bars).unwrap()).unwrap();
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
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let chain = Chain::new("upright", 10.0, anchors, vec![bar; bars]).unwrap();
    let problem = Problem::new(chain).unwrap();
    let census = Census::take(&problem, &Settings::default()).unwrap();
    let found = lagrange::solve(&problem, &lagrange::Settings::default()).unwrap().equilibrium;
    let joints_m = heights_m.iter().map(|z| [0.0, 0.0, *z]).collect();
    let mut answer = Equilibrium { joints_m, energy_j: 1e6, ..found };
    certify_by_census(&problem, &census, &mut answer);
    let ladder = answer.evidence.ladder;
    assert_eq!(ladder.verified.reason(), ladder.complete.reason());
    ladder.complete.reason().unwrap().clone()
}

/// Three bars over 1 m lie in the vertical in three ways, up and down; two that come back in two.
#[test]
fn answers_in_the_vertical_are_at_straight_positions() {
    let at = |distance| Reason::AtStraight { distance };
    let down = [0.0, 0.0, -1.0];
    assert_eq!(said(3, down, &[0.0, -1.0, -2.0, -1.0]), at(0.0));
    assert_eq!(said(3, down, &[0.0, 1.0, 0.0, -1.0]), at(0.0));
    assert_eq!(said(3, [0.0, 0.0, 1.0], &[0.0, 1.0, 2.0, 1.0]), at(0.0));
    // A joint off by what an answer may be: 2^-33 m, of 3 m. By a millimetre it is somewhere else.
    let apart = 2.0_f64.powi(-33);
    assert_eq!(said(3, down, &[0.0, -1.0, apart - 2.0, -1.0]), at(apart / 3.0));
    let off = said(3, down, &[0.0, -1.0, -1.999, -1.0]);
    assert!(!matches!(off, Reason::AtStraight { .. }), "{off}");
    // From one point to itself it hangs or stands.
    for turn in [-1.0, 1.0] {
        assert_eq!(said(2, [0.0; 3], &[0.0, turn, 0.0]), at(0.0));
    }
    // A joint less is no answer.
    let short = said(3, down, &[0.0, -1.0, -1.0]);
    assert!(!matches!(short, Reason::AtStraight { .. }), "{short}");
}
