//! Hanging chains of all hard shapes at once: the condensed solver solves them all, and every
//! answer is an equilibrium by Newton's laws and the lowest by the stress matrix.

use lagrange::condensed::{Settings, solve};
use samples::extreme_chain;

use crate::judge::judge;

/// Random chains of the test.
const CHAINS: u64 = 1000;
/// Lengths, closure, force and moment balance, in units of the largest force and the total length;
/// what the solver promises for any n. Measured over a million such chains: 5e-16, for the closure
/// 1e-13.
const BALANCE: f64 = 1e-12;

#[test]
fn a_thousand_random_chains_hang_at_their_lowest() {
    let mut failed = Vec::new();
    for seed in 0..CHAINS {
        let problem = extreme_chain(seed);
        let judged = solve(&problem, &Settings::default()).map(|solution| {
            let stable = solution.equilibrium.stability.index_in_space == 0;
            (judge(&problem, &solution.equilibrium), stable, solution.pull)
        });
        let good = matches!(&judged, Ok((j, true, _)) if j.within(BALANCE) && j.lowest);
        if !good {
            failed.push(format!("{seed}: {judged:?}"));
        }
    }
    assert!(failed.is_empty(), "{} of {CHAINS}:\n{}", failed.len(), failed.join("\n"));
}

/// A hundred thousand bars of unit length between anchors two metres apart: all but straight down
/// and up again, so that the chain made coarser says nothing of the bend. Both missed their anchor
/// by more than the settings allow, because the last pass was saved on its word.
#[test]
fn deep_chains_are_not_closed_on_the_word_of_a_coarser_chain() {
    for (n, end_m) in [(100_000, [2.0, 0.0, -1.0]), (99_999, [2.0, 0.0, 0.0])] {
        let problem = samples::homogeneous(9.806_65, &vec![(1.0, 1.0); n], end_m);
        let answer = solve(&problem, &Settings::default()).unwrap().equilibrium;
        let judged = judge(&problem, &answer);
        assert!(judged.within(BALANCE) && judged.lowest, "{n}: {judged:?}");
    }
}
