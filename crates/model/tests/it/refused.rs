//! Chains that can be described and have no equilibrium, each with its exact refusal and its place.

use crate::support::{anchored, check};

#[test]
fn chains_that_are_no_equilibrium_problem() {
    let two = |a: &str, b: &str| {
        format!("[[bars]]\nlength_m = {a}\nmass_kg = 1\n[[bars]]\nlength_m = {b}\nmass_kg = 1\n")
    };
    check(
        &anchored(&two("0.5", "1")),
        "f:3:9: anchors.end_m: the anchors \"0\" and \"2\" are 2 m apart and the members between them reach only 1.5 m: 0.5 m are missing",
        "[0, 0, -2]",
    );
    check(
        &anchored(&two("1", "1")),
        "f:3:9: anchors.end_m: the anchors \"0\" and \"2\" are 2 m apart and the members between them reach just as far \
         (2 m): they lie straight and taut, and the force along them is indeterminate",
        "[0, 0, -2]",
    );
    check(
        &anchored(&two("0.5", "3")),
        "f:8:12: bars[2].length_m: member 2 from \"1\" to \"2\" is 3 m long, and the rest of a loop through it (1, 0, 2) only 2.5 m: \
         the loop cannot close, 0.5 m are missing",
        "3",
    );
    check(
        &anchored(&two("2.5", "0.5")),
        "f:5:12: bars[1].length_m: member 1 from \"0\" to \"1\" is 2.5 m long, exactly as long as the rest of a loop through it (0, 2, 1): \
         the loop closes only folded on one line, and the force along it is indeterminate",
        "2.5",
    );
    check(
        "[anchors]\nstart_m = [1, 1, 1]\nend_m = [1, 1, 1]\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 2\n",
        "f:5:12: bars[1].length_m: member 1 from \"0\" to \"1\" is 1 m long, exactly as long as the rest of a loop through it (0, 2, 1): \
         the loop closes only folded on one line, and the force along it is indeterminate",
        "1",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 0\ncount = 3\n"),
        "f:6:11: bars[1].mass_kg: no mass and no force act on the system: without load every position is an equilibrium",
        "0",
    );
    check(
        &anchored("[[bars]]\nlength_m = 2\nmass_kg = 1\n"),
        "f:5:12: bars: every joint is an anchor: nothing can move",
        "2",
    );
    // Nobody counts three hundred zeros.
    check(
        "[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2e12]\n[[bars]]\nlength_m = 1e-200\nmass_kg = 1\n",
        "f:3:9: anchors.end_m: the anchors \"0\" and \"1\" are 2e12 m apart and the members between them reach only 1e-200 m: 2e12 m are missing",
        "[0, 0, -2e12]",
    );
    check(
        &anchored("[[bars]]\nlength_m = -1e-300\nmass_kg = 1\n"),
        "f:5:12: bars[1].length_m: the length of a bar must be positive and finite, got -1e-300 m",
        "-1e-300",
    );
    // The bar that is too long in the third table is the fifth of the chain.
    check(
        &anchored(
            "[[bars]]\nlength_m = 0.1\nmass_kg = 1\ncount = 3\n[[bars]]\nlength_m = 0.2\nmass_kg = 1\n[[bars]]\nlength_m = 9\nmass_kg = 1\n",
        ),
        "f:12:12: bars[3].length_m: member 5 from \"4\" to \"5\" is 9 m long, and the rest of a loop through it (4, 3, 2, 1, 0, 5) only \
         2.5 m: the loop cannot close, 6.5 m are missing",
        "9",
    );
}

#[test]
fn a_single_bar_is_refused_for_what_is_wrong_with_it() {
    let one = |length: &str| anchored(&format!("[[bars]]\nlength_m = {length}\nmass_kg = 1\n"));
    check(
        &one("1.5"),
        "f:3:9: anchors.end_m: the anchors \"0\" and \"1\" are 2 m apart and the members between them reach only 1.5 m: 0.5 m are missing",
        "[0, 0, -2]",
    );
    check(
        &one("2.5"),
        "f:5:12: bars[1].length_m: member 1 from \"0\" to \"1\" is 2.5 m long, and the rest of a loop through it (0, 1) only 2 m: \
         the loop cannot close, 0.5 m are missing",
        "2.5",
    );
}

#[test]
fn anchors_too_far_away_to_tell() {
    check(
        "[anchors]\nstart_m = [1e15, 0, 0]\nend_m = [1000000000000002, 0, 0]\n\
         [[bars]]\nlength_m = 1.1\nmass_kg = 1\ncount = 2\n",
        "f:3:9: anchors.end_m: the coordinates of the anchors reach 1.000000000000002e15 m, where doubles place the \
         anchors only to 0.6661 m, and the bars are only 0.2 m away from being straight",
        "[1000000000000002, 0, 0]",
    );
}
