//! A compact census is the census, in less memory.

use census::{Census, CompactCensus, Settings};
use model::Problem;

use crate::support::{equal, problem};

fn compact(problem: &Problem) -> CompactCensus {
    match CompactCensus::take(problem, &Settings::default(), &|_| {}) {
        Ok(census) => census,
        Err(error) => panic!("{error}"),
    }
}

/// Chains of which some lists are not empty: generic ones, one with unloaded bars in its
/// equilibria, circles, straight positions, slack bars, undecided boxes.
fn chains() -> Vec<Problem> {
    let generic = [
        (0.8, 1.0, 0.3),
        (0.5, 0.6, 0.2),
        (0.7, 0.4, 0.4),
        (0.6, 0.9, 0.3),
        (0.45, 0.7, 0.15),
        (0.55, 0.3, 0.25),
    ];
    let fold = [(1.0, 1.0, 0.5), (5.0, 1.0, 2.5), (1.0, 1.0, 0.5)];
    let unloaded = [(0.9, 1.0, 0.5), (1.0, 2.0, 0.75), (0.4, 1.0, 0.25)];
    let straight = [(1.5, 1.0, 0.75), (1.0, 1.0, 0.5), (0.5, 1.0, 0.25)];
    vec![
        problem(&generic, [0.9, 0.5, -0.3]),
        model::cases::paper(),
        equal(5, [2.0, 0.0, 0.0]),
        equal(8, [4.0, 0.0, 0.0]),
        equal(8, [0.0, 0.0, -2.5]),
        equal(3, [0.0, 0.0, -1.0]),
        problem(&fold, [3.0, 0.0, -6.0]),
        problem(&unloaded, [1.0, 0.0, -0.5]),
        problem(&straight, [1.2, 0.0, 1.6]),
    ]
}

#[test]
fn it_is_the_census_to_the_bit() {
    let (mut unloaded, mut circles, mut open) = (0, 0, 0);
    for problem in chains() {
        let whole = Census::take(&problem, &Settings::default()).unwrap();
        let compact = compact(&problem);
        assert_eq!(compact.check(&problem), whole.check(&problem));
        assert_eq!(compact.len(), whole.equilibria.len());
        for (k, expected) in whole.equilibria.iter().enumerate() {
            assert_eq!(&compact.equilibrium(k), expected);
            unloaded += usize::from(expected.signs.contains(&0));
            circles += usize::from(expected.circle);
        }
        assert_eq!((compact.complete(), compact.decided()), (whole.complete, whole.decided()));
        assert_eq!(compact.count_by_index(), whole.count_by_index());
        assert_eq!(compact.alternating_sum(), whole.alternating_sum());
        assert_eq!(compact.count_in_plane(), whole.count_in_plane());
        assert_eq!(compact.figure("chain", 7), whole.figure("chain", 7));
        let of_whole: Vec<_> = whole.positions().collect();
        let of_compact: Vec<_> = (0..compact.len()).flat_map(|k| compact.positions(k)).collect();
        assert_eq!(of_compact, of_whole);
        for position in &of_whole {
            let mut model = compact.position_to_model(position);
            model.evidence.solve_s = whole.statistics.seconds;
            assert_eq!(model, whole.position_to_model(position));
        }
        let mut first = compact.first(2);
        first.statistics.seconds = whole.statistics.seconds;
        let few = whole.equilibria.iter().take(2).cloned().collect();
        open += whole.undecided.len();
        assert_eq!(first, Census { equilibria: few, ..whole });
    }
    assert!(unloaded > 0 && circles > 0 && open > 0, "{unloaded} {circles} {open}");
}

/// The census of one chain is not that of another.
#[test]
fn it_is_held_against_its_own_chain() {
    let problems = chains();
    let compact = compact(&problems[0]);
    assert_eq!(compact.check(&problems[0]), Ok(()));
    for other in &problems[1..] {
        assert!(compact.check(other).is_err());
    }
}
