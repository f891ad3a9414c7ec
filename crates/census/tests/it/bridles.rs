//! Lists of bridles with long strands against closed forms, topology, the search by places, and
//! Newton's method from many starts.

use model::system::System;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::assert_frozen;

use census::Settings;
use census::net::SystemCensus;

use crate::nets::{bridle, found_of, the_sum_is_the_same, work};
use crate::support::taken;

/// Strands of so many bars, about as long as the bridle asks for, drawn at random.
pub(crate) fn drawn(random: &mut ChaCha8Rng, bars: &[usize]) -> System {
    let (mut anchors, mut lengths) = (vec![], vec![]);
    for (k, strand) in bars.iter().enumerate() {
        let part = (k as f64 + random.random_range(-0.3..0.3)) / bars.len() as f64;
        let angle = part * std::f64::consts::TAU;
        anchors.push([2.0 * angle.cos(), 2.0 * angle.sin(), random.random_range(-0.5..0.5)]);
        let total = random.random_range(2.3..3.5);
        let parts: Vec<f64> = (0..*strand).map(|_| random.random_range(0.7..1.3)).collect();
        let whole: f64 = parts.iter().sum();
        lengths.push(parts.into_iter().map(|part| part * total / whole).collect::<Vec<f64>>());
    }
    let strands: Vec<&[f64]> = lengths.iter().map(Vec::as_slice).collect();
    bridle(&anchors, &strands, random.random_range(0.0..1.0), random.random_range(0.1..1.0))
}

/// Whatever its joints, a bridle is searched over the pulls of its strands.
fn by_pulls() -> Settings {
    Settings { max_motions: 0, ..Settings::default() }
}

/// The promise of the census: complete lists, of which Newton's method finds nothing more. Of one
/// bridle, or of as many as `BRIDLES` says.
#[test]
fn newton_from_many_starts_finds_nothing_that_is_not_listed() {
    const STARTS: usize = 1000;
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let (mut found, mut listed) = (0, 0);
    let shapes = [[3, 3, 3], [3, 2, 1], [4, 1, 1], [3, 1, 1], [3, 3, 2], [3, 3, 3]];
    let bridles = std::env::var("BRIDLES").map_or(1, |n| n.parse().expect("a number"));
    for (seed, bars) in shapes.into_iter().cycle().take(bridles).enumerate() {
        let system = drawn(&mut random, &bars);
        let census = taken(&system);
        let net = census.nets().next().unwrap();
        let all = census.equilibria.len();
        println!("{bars:?}: {all} complete {} in {} tests", census.complete, net.tests);
        assert!(census.complete, "{bars:?}: {:?}", net.undecided);
        let own = found_of(&system, &census, STARTS, seed as u64);
        println!("  Newton finds {own}");
        listed += all;
        found += own;
    }
    assert!(10 * found > 9 * listed, "{found} of {listed}");
}

#[test]
fn the_alternating_sum_does_not_depend_on_the_loads() {
    let loads = [(1.0, 0.5), (0.0, 1.0), (9.0, 0.3)];
    the_sum_is_the_same(&[&[0.9, 0.95, 1.0], &[1.3, 1.2], &[2.2]], &loads);
    // Twice is enough here: it takes seconds where no strand is a single bar.
    let strands = [&[0.9, 0.95, 1.0][..], &[0.8, 0.85, 0.9], &[1.0, 1.05, 0.9]];
    the_sum_is_the_same(&strands, &[loads[0], loads[2]]);
}

/// Both searches, over places with closed forms and over pulls, list the same equilibria.
#[test]
fn places_and_pulls_give_the_same_list() {
    let mut random = ChaCha8Rng::seed_from_u64(5);
    for bars in [[2, 2, 2], [2, 2, 1], [2, 1, 1]] {
        let system = drawn(&mut random, &bars);
        let by_places = taken(&system);
        let by_pulls = SystemCensus::take(&system, &by_pulls()).unwrap();
        assert!(by_places.complete && by_pulls.complete, "{bars:?}");
        assert_ne!(by_places.cells(), by_pulls.cells(), "{bars:?}");
        assert_eq!(by_places.equilibria.len(), by_pulls.equilibria.len(), "{bars:?}");
        for (a, b) in by_places.equilibria.iter().zip(&by_pulls.equilibria) {
            assert!(!a.energy_j.disjoint(b.energy_j) && a.index_in_space == b.index_in_space);
        }
    }
}

/// What is found, and what it takes: cells and tests by the search over pulls, frozen.
#[test]
fn work_of_small_bridles() {
    let mut random = ChaCha8Rng::seed_from_u64(21);
    let mut found = vec![];
    for bars in [[2, 1, 1], [2, 2, 1], [3, 1, 1], [3, 2, 1]] {
        let system = drawn(&mut random, &bars);
        let census = SystemCensus::take(&system, &by_pulls()).unwrap();
        found.push((bars, work(&census)));
    }
    let expected = [
        ([2, 1, 1], [2, 0, 2, 1533, 19154, -94, -90]),
        ([2, 2, 1], [2, 0, 4, 912, 34245, -96, -90]),
        ([3, 1, 1], [6, 0, 12, 1797, 45098, -282, -250]),
        ([3, 2, 1], [2, 0, 6, 2172, 51133, -94, -82]),
    ];
    assert_frozen(&found[..], &expected);
}
