//! Chains of integers: lengths, masses and anchors that people type first.

use std::collections::{BTreeMap, BTreeSet};

use census::{Census, Face, Settings, Undecided};
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

/// Every chain is decided; `INTEGERS=10` takes those of up to ten bars as well, a minute.
#[test]
fn all_chains_of_integers_are_decided() {
    let most: usize = std::env::var("INTEGERS").map_or(5, |n| n.parse().unwrap());
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
            assert!(census.complete || upright || !census.decided());
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
    println!("{decided} of {all}, {complete} complete; {why:?}");
    assert_eq!(decided, all, "{why:?}");
}

/// Whether the bars without force of an undecided box just bridge their gap in one line, and the
/// bars that bear force balance each other as at a fold, Σ s l/|F| = 0.
fn is_fold(problem: &Problem, open: &Undecided) -> bool {
    let chain = problem.chain();
    let Face::Around(group) = open.chart else { return false };
    // The runs of bars whose common joints carry nothing.
    let mut groups = vec![vec![0]];
    for (k, pair) in chain.bars().windows(2).enumerate() {
        let [before, after] = [&pair[0], &pair[1]];
        let bears = before.mass_kg() * before.centre_m() > 0.0
            || after.mass_kg() * (after.length_m() - after.centre_m()) > 0.0;
        if bears {
            groups.push(vec![]);
        }
        groups.last_mut().unwrap().push(k + 1);
    }
    let mut signs = open.signs[0].clone();
    groups[usize::from(group)].iter().for_each(|bar| signs[*bar] = 0);
    let length = |k: usize| chain.bars()[k].length_m();
    let slack: Vec<usize> = (0..signs.len()).filter(|k| signs[*k] == 0).collect();
    // What each bar carries before it, and how the others stand where the slack ones carry nothing.
    let mut carried = vec![0.0];
    for pair in chain.bars().windows(2) {
        let at_joint = pair[0].mass_kg() * pair[0].centre_m() / pair[0].length_m()
            + pair[1].mass_kg() * (1.0 - pair[1].centre_m() / pair[1].length_m());
        carried.push(carried[carried.len() - 1] + at_joint);
    }
    let anchors = chain.anchors();
    let mut rise = anchors.end_m[2] - anchors.start_m[2];
    let mut balance = 0.0;
    for (k, sign) in signs.iter().enumerate().filter(|(_, sign)| **sign != 0) {
        let force = carried[k] - carried[slack[0]];
        rise -= f64::from(*sign) * force.signum() * length(k);
        balance += f64::from(*sign) * length(k) / force.abs();
    }
    let level = anchors.end_m[0] - anchors.start_m[0];
    let gap_square = level * level + rise * rise;
    let in_one_line = (0..1_u32 << slack.len()).any(|ways| {
        let way = |j: usize| if ways >> j & 1 == 0 { 1.0 } else { -1.0 };
        let reach: f64 = slack.iter().enumerate().map(|(j, k)| way(j) * length(*k)).sum();
        // All are integers.
        (reach * reach - gap_square).abs() < 0.5
    });
    in_one_line && balance.abs() < 1e-12
}

/// Chains with weights at some joints only, as bridles and lamps have them: bars without mass, or with their centre at a
/// joint. Each is decided, but where a fold meets slack bars that just bridge their gap: those are told.
/// `INTEGERS=10` takes those of up to ten bars.
#[test]
fn chains_of_integers_with_bars_without_mass() {
    let most: usize = std::env::var("INTEGERS").map_or(4, |n| n.parse().unwrap());
    let (mut decided, mut all, mut slack) = (0, 0, 0);
    for bars in 3..=most {
        let mut random = ChaCha8Rng::seed_from_u64(100 + bars as u64);
        for _ in 0..100 {
            let problem = with_weights_at_joints(&mut random, bars);
            let census = Census::take(&problem, &Settings::default()).unwrap();
            assert_eq!(census.check(&problem), Ok(()));
            all += 1;
            decided += usize::from(census.decided());
            slack += usize::from(!census.families.is_empty());
            if !census.decided() {
                let fold = census.undecided.iter().any(|open| is_fold(&problem, open));
                assert!(fold, "{:?}: {:?}", problem.chain(), census.undecided);
            }
        }
        println!("up to {bars} bars: {decided} of {all}, {slack} with slack bars");
    }
    assert!(decided * 100 >= 98 * all && slack > 0, "{decided} of {all}, {slack}");
}

/// Lengths 1 to 5, masses 0 to 3 at either joint or in the middle, an anchor within 8 m.
fn with_weights_at_joints(random: &mut ChaCha8Rng, bars: usize) -> Problem {
    loop {
        let drawn: Vec<Bar> = (0..bars)
            .filter_map(|_| {
                let [l, m, r] =
                    [1..=5, 0..=3, 0..=2].map(|range| f64::from(random.random_range(range)));
                Bar::new(l, m, 0.5 * r * l, [0.0; 3]).ok()
            })
            .collect();
        let [x, z] = [0..=8, -4..=4].map(|range| f64::from(random.random_range(range)));
        let anchors = Anchors { start_m: [0.0; 3], end_m: [x, 0.0, z] };
        let chain = Chain::new("integers", 9.81, anchors, drawn).map(Problem::new);
        if let Ok(Ok(problem)) = chain {
            return problem;
        }
    }
}
