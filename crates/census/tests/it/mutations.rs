//! A census that was tampered with is caught.

use census::{Census, CheckError, Interval, MorseError, Settings};
use model::Problem;

/// Chains of so many bars are tampered with.
const CHAINS: [usize; 2] = [4, 5];

fn problem(bars: usize, second_mass_kg: f64) -> Problem {
    let all = [
        (0.8, 1.0, 0.3),
        (0.5, second_mass_kg, 0.2),
        (0.7, 0.4, 0.4),
        (0.6, 0.9, 0.3),
        (0.45, 0.7, 0.15),
    ];
    samples::chain(&all[..bars], [0.9, 0.5, -0.3])
}

fn census(bars: usize) -> Census {
    crate::support::census(&problem(bars, 0.6))
}

fn check(census: &Census) -> Result<(), CheckError> {
    census.check(&problem(census.statistics.bars, 0.6))
}

/// Every chain with the number of each of its equilibria, counted from 0.
fn each_equilibrium() -> impl Iterator<Item = (Census, usize)> {
    CHAINS.into_iter().flat_map(|bars| {
        let census = census(bars);
        (0..census.equilibria.len()).map(move |k| (census.clone(), k))
    })
}

#[test]
fn the_census_as_taken_is_right() {
    for bars in CHAINS {
        let census = census(bars);
        assert!(census.complete && census.equilibria.len() > bars);
        assert_eq!(check(&census), Ok(()));
    }
}

#[test]
fn any_one_missing_equilibrium_is_caught() {
    for (mut census, k) in each_equilibrium() {
        let expected = census.topology.as_ref().unwrap().euler;
        let index = census.equilibria.remove(k).index_in_plane;
        let found = expected - if index % 2 == 0 { 1 } else { -1 };
        let error = CheckError::Morse(MorseError::Euler { found, expected });
        assert_eq!(check(&census), Err(error), "without {k} (index {index})");
    }
}

#[test]
fn a_pair_that_cancels_in_the_euler_characteristic_is_caught_if_topology_needs_it() {
    for bars in CHAINS {
        let mut census = census(bars);
        let before = census.count_by_index();
        let betti = census.topology.clone().unwrap().betti;
        // Remove pairs of index 0 and 1 until there are fewer than the topology allows.
        for index in [0, 1] {
            for _ in 0..=before[0] - i64::try_from(betti[0]).unwrap() {
                let k = census.equilibria.iter().position(|e| e.index_in_plane == index).unwrap();
                census.equilibria.remove(k);
            }
        }
        let error = CheckError::Morse(MorseError::TooFew { index: 0, missing: 1 });
        assert_eq!(check(&census), Err(error));
    }
}

/// What the check of a complete list can see of missing pairs that cancel in every count, and what
/// it cannot: the lowest and the highest position must be there, and of the others the search alone
/// knows.
#[test]
fn of_missing_pairs_that_topology_does_not_need_only_extremes_are_seen() {
    let mut seen = [0, 0];
    let mut unseen = 0;
    for bars in CHAINS {
        let whole = census(bars);
        let size = whole.equilibria.len();
        for (low, high) in (0..size).flat_map(|low| (low + 1..size).map(move |high| (low, high))) {
            let index = |k: usize| whole.equilibria[k].index_in_plane;
            if index(low).abs_diff(index(high)) != 1 {
                continue;
            }
            let mut without = whole.clone();
            without.equilibria.remove(high);
            without.equilibria.remove(low);
            if without.morse().is_err() {
                assert!(check(&without).is_err());
                continue;
            }
            // The lowest is the first of the list, the highest the last.
            let error = |which| Err(CheckError::Extreme { which, found: 0 });
            if low == 0 {
                assert_eq!(check(&without), error("lowest"));
                seen[0] += 1;
            } else if high == size - 1 {
                assert_eq!(check(&without), error("highest"));
                seen[1] += 1;
            } else {
                assert_eq!(check(&without), Ok(()), "{bars} bars without {low} and {high}");
                unseen += 1;
            }
            // A list that is not called complete may lack them.
            without.complete = false;
            assert_eq!(check(&without), Ok(()));
        }
    }
    println!("seen {seen:?}, unseen {unseen}");
    assert!(seen.iter().all(|seen| *seen > 0) && unseen > 0, "{seen:?} {unseen}");
}

/// Families stand for the lowest and the highest position where all other bars hang, or all stand.
#[test]
fn a_slack_family_may_be_the_lowest_or_the_highest() {
    let bars = [(0.9, 2.0, 0.3), (0.4, 0.0, 0.2), (0.45, 0.0, 0.2), (0.5, 1.5, 0.2)];
    let mut extremes = [0, 0];
    for up in [-0.4, -0.2, 0.0, 0.2, 0.4] {
        let problem = samples::chain(&bars, [0.3, 0.0, up]);
        let census = Census::take(&problem, &Settings::default()).unwrap();
        assert!(census.complete && census.check(&problem) == Ok(()));
        for (count, sign) in extremes.iter_mut().zip([1, -1]) {
            let stands = |f: &&census::SlackFamily| f.signs.iter().all(|s| [0, sign].contains(s));
            *count += census.families.iter().filter(stands).count();
        }
    }
    assert!(extremes.iter().all(|count| *count > 0), "{extremes:?}");
}

#[test]
fn a_flipped_index_is_caught() {
    for (census, k) in each_equilibrium() {
        let error = Err(CheckError::Index { number: k + 1 });
        let mut wrong = census.clone();
        wrong.equilibria[k].index_in_plane ^= 1;
        assert_eq!(check(&wrong), error);
        // The topology alone sees it too.
        let error_by_topology = wrong.morse().unwrap_err();
        assert!(
            matches!(error_by_topology, MorseError::Euler { .. } | MorseError::Index { .. }),
            "{error_by_topology}"
        );
        let mut wrong = census.clone();
        wrong.equilibria[k].index_out_of_plane += 1;
        assert_eq!(check(&wrong), error);
        let mut wrong = census;
        wrong.equilibria[k].optimal ^= true;
        assert_eq!(check(&wrong), error);
    }
}

#[test]
fn a_widened_box_is_caught() {
    let wider = |x: Interval, by: f64| Interval::new(x.lo() - by, x.hi() + by);
    for (census, k) in each_equilibrium() {
        let number = k + 1;
        let mut wrong = census.clone();
        wrong.equilibria[k].pull_n[1] = wider(wrong.equilibria[k].pull_n[1], 1e-6);
        assert_eq!(check(&wrong), Err(CheckError::Loose { number, quantity: "the pull" }));
        let mut wrong = census.clone();
        wrong.equilibria[k].angles_rad[2] = wider(wrong.equilibria[k].angles_rad[2], 1e-8);
        assert_eq!(check(&wrong), Err(CheckError::Loose { number, quantity: "the angle" }));
        let mut wrong = census.clone();
        wrong.equilibria[k].energy_j = wider(wrong.equilibria[k].energy_j, f64::INFINITY);
        assert_eq!(check(&wrong), Err(CheckError::Loose { number, quantity: "the energy" }));
        // A neighbourhood so wide that it is not proved to hold one equilibrium only.
        let mut wrong = census;
        wrong.equilibria[k].alone_in.at = wrong.equilibria[k].alone_in.at.map(|x| wider(x, 0.5));
        assert_eq!(check(&wrong), Err(CheckError::NotOne { number }));
    }
}

/// Where a number stands in a census.
type Place = fn(&mut Census) -> &mut Interval;

#[test]
fn a_moved_value_is_caught() {
    let moved = |x: Interval| Interval::new(x.lo() + 1e-9, x.hi() + 1e-9);
    let quantities: [(&str, Place); 6] = [
        ("the pull", |census| &mut census.equilibria[1].pull_n[0]),
        ("the angle", |census| &mut census.equilibria[1].angles_rad[0]),
        ("the energy", |census| &mut census.equilibria[1].energy_j),
        ("the joint", |census| &mut census.equilibria[1].joints_m[2][1]),
        ("the multiplier", |census| &mut census.equilibria[1].multipliers_n[3][2]),
        ("the axial force", |census| &mut census.equilibria[1].axial_n[3]),
    ];
    for bars in CHAINS {
        let census = census(bars);
        for (quantity, place) in quantities {
            let mut wrong = census.clone();
            let value = place(&mut wrong);
            *value = moved(*value);
            assert_eq!(check(&wrong), Err(CheckError::Wrong { number: 2, quantity }));
        }
    }
}

#[test]
fn a_perturbed_coefficient_is_caught() {
    for bars in CHAINS {
        // The same census, held against a chain whose second bar is a billionth heavier.
        let error = Err(CheckError::Wrong { number: 1, quantity: "the pull" });
        assert_eq!(census(bars).check(&problem(bars, 0.6 * (1.0 + 1e-9))), error);
        // And a much heavier one: the neighbourhood holds no equilibrium any more.
        let error = Err(CheckError::Empty { number: 1 });
        assert_eq!(census(bars).check(&problem(bars, 1.2)), error);
    }
}

#[test]
fn a_wrong_sign_a_wrong_number_of_bars_and_a_double_are_caught() {
    for bars in CHAINS {
        let census = census(bars);
        let mut wrong = census.clone();
        wrong.equilibria[0].signs[0] *= -1;
        assert_eq!(check(&wrong), Err(CheckError::Empty { number: 1 }));
        let mut wrong = census.clone();
        wrong.equilibria[0].signs.pop();
        assert_eq!(check(&wrong), Err(CheckError::Malformed { number: 1 }));
        let mut wrong = census.clone();
        let double = wrong.equilibria[2].clone();
        wrong.equilibria.insert(3, double);
        assert_eq!(check(&wrong), Err(CheckError::Order { number: 4 }));
        let mut wrong = census.clone();
        wrong.equilibria.swap(0, 1);
        assert_eq!(check(&wrong), Err(CheckError::Order { number: 2 }));
        let mut wrong = census.clone();
        wrong.topology = Ok(census::Topology { betti: vec![1, 0, 1], euler: 2 });
        assert_eq!(check(&wrong), Err(CheckError::Claim { quantity: "the topology" }));
        let mut wrong = census;
        wrong.statistics.bars = bars + 1;
        let error = Err(CheckError::Claim { quantity: "the number of bars" });
        assert_eq!(wrong.check(&problem(bars, 0.6)), error);
    }
}
