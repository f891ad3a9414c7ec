//! Chains of integers: lengths, masses and anchors that people type first.

use std::collections::{BTreeMap, BTreeSet};

use census::{Census, Settings};
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Lengths and masses from 1 to 5, the last anchor at integers within reach.
fn drawn(random: &mut ChaCha8Rng, bars: usize) -> Problem {
    loop {
        let bars: Vec<Bar> = (0..bars)
            .filter_map(|_| {
                let [l, m] = [(); 2].map(|()| f64::from(random.random_range(1..=5)));
                Bar::homogeneous(l, m).ok()
            })
            .collect();
        // Every other span is level.
        let [x, z] = [0..=10, -10..=10].map(|range| f64::from(random.random_range(range)));
        let z = if random.random_range(0..2) == 0 { 0.0 } else { z };
        let anchors = Anchors { start_m: [0.0; 3], end_m: [x, 0.0, z] };
        let chain = Chain::new("integers", 9.81, anchors, bars).map(Problem::new);
        if let Ok(Ok(problem)) = chain {
            return problem;
        }
    }
}

/// Every chain is decided, its degenerate equilibria named. `INTEGERS=10` takes those of up to ten
/// bars: 800 of 800, a minute.
#[test]
fn all_chains_of_integers_are_decided() {
    let most: usize = std::env::var("INTEGERS").map_or(6, |n| n.parse().unwrap());
    let mut why: BTreeMap<String, usize> = BTreeMap::new();
    let (mut decided, mut complete, mut all) = (0, 0, 0);
    for bars in 3..=most {
        let mut random = ChaCha8Rng::seed_from_u64(bars as u64);
        let mut here = 0;
        for _ in 0..100 {
            let problem = drawn(&mut random, bars);
            let census = Census::take(&problem, &Settings::default()).unwrap();
            all += 1;
            here += usize::from(census.decided());
            complete += usize::from(census.complete);
            // What keeps a list from being complete is named.
            let upright = census.straight.iter().any(|straight| straight.upright);
            let named = upright || !census.degenerate.is_empty();
            assert!(census.complete || named || !census.decided());
            if !census.undecided.is_empty() {
                let [x, _, z] = problem.chain().anchors().end_m;
                let place = match (x > 0.0, z.abs() > 0.0) {
                    (false, false) => "one point",
                    (false, true) => "upright",
                    _ => "apart",
                };
                let reasons: BTreeSet<String> =
                    census.undecided.iter().map(|open| format!("{:?}", open.reason)).collect();
                *why.entry(format!("{place}: {reasons:?}")).or_default() += 1;
            }
        }
        decided += here;
        println!("{bars} bars: {here} of 100");
    }
    println!("{decided} of {all}, {complete} without any that is degenerate; {why:?}");
    assert_eq!(decided, all, "{why:?}");
}
