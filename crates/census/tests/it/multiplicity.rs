//! Equilibria that have merged: named with their multiplicity, and fallen apart by a small change.

use crate::support::{census, problem};
use census::{
    Bound, Census, CheckError, DegenerateEquilibrium, Face, MorseError, Reason, Undecided,
};
use model::Problem;

/// Equal bars but for their lengths: each joint carries as much as any other.
fn bars(lengths: &[f64], end_m: [f64; 3]) -> Problem {
    let bars: Vec<(f64, f64, f64)> = lengths.iter().map(|l| (*l, 1.0, 0.5 * l)).collect();
    problem(&bars, end_m)
}

/// Chains with one degenerate equilibrium, in which the middle bar carries nothing.
fn merged() -> [(Vec<f64>, [f64; 3], usize, i8); 4] {
    [
        // Bar 1 hangs as heavily as bar 3 stands; the middle bar leans by 3, 4, 5, down or up.
        (vec![1.0, 5.0, 1.0], [3.0, 0.0, -6.0], 2, 0),
        (vec![1.0, 5.0, 1.0], [3.0, 0.0, 2.0], 2, 0),
        // The same about a level bar. With angles x, π/2 + y, −z the closure is z = x + x⁴/2 + ...,
        // and the energy x⁵/2 + ...: its derivative has a zero of order four.
        (vec![1.0; 3], [1.0, 0.0, -2.0], 4, 0),
        // Symmetric: bars 1 and 5 hang, 2 and 4 stand, 2/2 − 1/1 = 0; and the same upside down.
        // With S₃ = 2 (2/8 − 1) the third term is +3/4 ρ³, and two bars are compressed.
        (vec![2.0, 1.0, 3.0, 1.0, 2.0], [3.0, 0.0, 0.0], 3, 1),
    ]
}

/// The one whose first bar hangs.
fn hanging(census: &Census) -> &DegenerateEquilibrium {
    let hanging: Vec<_> = census.degenerate.iter().filter(|merged| merged.signs[0] > 0).collect();
    let [hanging] = hanging[..] else { panic!("{:?}", census.degenerate) };
    hanging
}

#[test]
fn merged_equilibria_are_named_with_their_multiplicity() {
    for (lengths, end, multiplicity, degree) in merged() {
        let problem = bars(&lengths, end);
        let census = census(&problem);
        assert!(census.decided() && !census.complete, "{lengths:?}: {:?}", census.undecided);
        let found = hanging(&census);
        assert_eq!((found.multiplicity, found.degree), (multiplicity, degree), "{lengths:?}");
        // The sum of (−1)^index is the Euler characteristic, the degenerate one counted by degree.
        if let Ok(topology) = &census.topology {
            assert_eq!(census.alternating_sum(), topology.euler);
            let mut wrong = census.clone();
            wrong.degenerate[0].degree += 1;
            assert!(matches!(wrong.morse(), Err(MorseError::Euler { .. })));
        }
        // Upright but for the middle bar, and the ends where the anchors are.
        let middle = lengths.len() / 2;
        for (k, angle) in found.angles_rad.iter().enumerate().filter(|(k, _)| *k != middle) {
            assert!(angle.mid().sin().abs() < 1e-15, "bar {k}: {angle:?}");
        }
        assert!(found.axial_n[middle].contains(0.0) && found.axial_n[middle].width() < 1e-14);
        // What is said of it is checked.
        let changes: [fn(&mut DegenerateEquilibrium); 3] =
            [|e| e.multiplicity += 1, |e| e.degree += 1, |e| e.signs[0] = -e.signs[0]];
        for change in changes {
            let mut wrong = census.clone();
            change(&mut wrong.degenerate[0]);
            assert!(wrong.check(&problem).is_err());
        }
    }
}

/// A zero of multiplicity m of an analytic function, changed by ε, falls apart into simple zeros at
/// a distance of the order of ε^(1/m), or into none; their number has its parity, and is at most m.
#[test]
fn a_small_change_makes_as_many_as_the_multiplicity_says() {
    for (lengths, end, multiplicity, degree) in merged() {
        let exact = census(&bars(&lengths, end));
        let place = hanging(&exact).joints_m.clone();
        let root = 1.0 / multiplicity as f64;
        let mut most = 0;
        for change in [1e-3, -1e-3] {
            let near = |change: f64| {
                let census =
                    census(&bars(&lengths, [end[0] + 0.3 * change, end[1], end[2] + change]));
                assert!(census.complete, "{lengths:?} {change:e}: {:?}", census.undecided);
                let mut distances: Vec<(f64, usize)> = vec![];
                for e in &census.equilibria {
                    let off = |k: usize| e.joints_m[k].iter().zip(&place[k]);
                    let far = (0..place.len())
                        .flat_map(|k| off(k).map(|(a, b)| (a.mid() - b.mid()).abs()))
                        .fold(0.0, f64::max);
                    if far < 2.0 * change.abs().powf(root) {
                        distances.push((far, e.index_in_plane));
                    }
                }
                distances
            };
            let [wide, narrow] = [near(change), near(change / 32.0)];
            assert_eq!(wide.len(), narrow.len());
            assert_eq!(wide.len() % 2, multiplicity % 2);
            let sum: i32 = wide.iter().map(|(_, k)| if k % 2 == 0 { 1 } else { -1 }).sum();
            assert_eq!(sum, i32::from(degree));
            most = most.max(wide.len());
            let farthest =
                |all: &[(f64, usize)]| all.iter().map(|(far, _)| *far).fold(0.0, f64::max);
            if !wide.is_empty() {
                let order = (farthest(&wide) / farthest(&narrow)).log2() / 5.0;
                println!(
                    "{lengths:?} {change:e}: {} at a distance of order {order:.3}",
                    wide.len()
                );
                assert!(order < 1.2 * root + 0.2, "{order} {root}");
            }
        }
        assert!((2..=multiplicity).contains(&most) || multiplicity == 3, "{lengths:?}: {most}");
    }
}

/// The chain of the fold of `degenerate.rs`: length, mass, centre.
const AT_A_FOLD: [(f64, f64, f64); 4] = [
    (0.744_003_286_989_166_3, 0.295_321_229_436_031_84, 0.734_670_458_537_469),
    (0.800_934_968_638_009_8, 0.337_843_480_862_743_63, 0.252_195_513_658_455_1),
    (0.955_505_132_010_287, 0.371_962_658_396_993_55, 0.359_763_508_059_449_1),
    (0.606_212_031_725_482, 0.798_976_642_597_092_9, 0.357_182_036_441_701_43),
];

/// At a fold to the last digit of the chain's numbers no one can tell whether there are two
/// equilibria or none: but there are two at most. (The fold is that of `degenerate.rs`.)
#[test]
fn next_to_a_fold_there_are_two_at_most() {
    let (mut open, mut counts) = (0, vec![]);
    for off in [-1e-3, -1e-14, -1e-15, -4e-16, 0.0, 4e-16, 1e-15, 1e-14, 1e-3] {
        let end = [1.488_489_526_943_378_4, 0.0, 1.650_370_399_310_159_3 + off];
        let census = census(&problem(&AT_A_FOLD, end));
        for undecided in &census.undecided {
            let bound = undecided.bound.unwrap_or_else(|| panic!("{off:e}: {undecided:?}"));
            // One of the two may be listed.
            let known = (bound.at_most, bound.degree.expect("far from infinite pulls").abs());
            assert!(known == (2, 0) || known == (1, 1), "{off:e}: {bound:?}");
            open += 1;
        }
        counts.push((census.equilibria.len(), census.undecided.len()));
    }
    println!("{counts:?}");
    assert!(open > 0);
    // On its two sides there are two more and two fewer.
    let [first, .., last] = &counts[..] else { panic!() };
    assert!((first.1, last.1) == (0, 0) && first.0.abs_diff(last.0) == 2, "{counts:?}");
}

/// Who changes what is said of an undecided box is caught: more than are proved, another degree and
/// another box are wrong; fewer are not proved.
#[test]
fn the_bound_of_an_undecided_box_is_proved_again() {
    let mut boxes = 0;
    for off in [-1e-14, -1e-15, -4e-16, 4e-16, 1e-15, 1e-14] {
        let end = [1.488_489_526_943_378_4, 0.0, 1.650_370_399_310_159_3 + off];
        let problem = problem(&AT_A_FOLD, end);
        let census = census(&problem);
        assert_eq!(census.check(&problem), Ok(()));
        for k in 0..census.undecided.len() {
            bound_of_box(&problem, &census, k);
            boxes += 1;
        }
    }
    assert!(boxes > 0);
}

fn bound_of_box(problem: &Problem, census: &Census, k: usize) {
    let changed = |change: &dyn Fn(&mut Undecided)| {
        let mut wrong = census.clone();
        change(&mut wrong.undecided[k]);
        wrong.check(problem)
    };
    let bound = |change: &dyn Fn(&mut Bound)| {
        changed(&|open| change(open.bound.as_mut().expect("every box of this chain has one")))
    };
    let number = k + 1;
    let (wrong, open) = (CheckError::Bound { number }, CheckError::BoundNotProved { number });
    assert!(wrong.refutes() && !open.refutes());
    assert_eq!(bound(&|bound| bound.at_most += 1), Err(wrong.clone()));
    assert_eq!(bound(&|bound| bound.at_most -= 1), Err(open));
    let turned = |bound: &mut Bound| bound.degree = bound.degree.map(|degree| degree + 1);
    assert_eq!(bound(&turned), Err(wrong.clone()));
    assert_eq!(changed(&|open| open.signs[0][0] = 0), Err(wrong.clone()));
    assert_eq!(changed(&|open| open.chart = Face::Around(9)), Err(wrong.clone()));
    assert_eq!(changed(&|open| open.reason = Reason::Budget), Err(wrong));
    // Whoever claims less claims nothing that is wrong.
    assert_eq!(changed(&|open| open.bound = None), Ok(()));
}

/// Just longer than the distance of its anchors, by 4e-17 m: next to the straight position two
/// equilibria have pulls some 1e8 times the weights, one in tension and one, with all signs turned,
/// in compression. Each is a zero alone; of the two that a count beyond infinite pulls finds the
/// parity says nothing.
#[test]
fn what_is_counted_beyond_infinite_pulls_has_no_parity() {
    let bars = [(1.5, 1.0, 0.75), (1.0, 1.0, 0.5), (0.5, 1.0, 0.25)];
    let census = census(&problem(&bars, [1.2, 0.0, 1.6]));
    for undecided in &census.undecided {
        println!("{undecided:?}");
        if let Some(bound) = undecided.bound {
            assert!(
                bound.at_most > 0 && bound.degree.is_none_or(|degree| degree != 0),
                "{bound:?}"
            );
        }
    }
    assert!(!census.complete || census.equilibria.len() >= 2);
}

/// $M_0 M_2 = M_1^2$: the variance of the weights with these signs vanishes, and the straight position
/// is isolated in the next order only.
#[test]
fn a_straight_position_without_variance_is_apart_from_all_equilibria() {
    let lengths = [2.0, 4.0, 3.0, 1.0, 2.0, 4.0, 3.0, 1.0];
    let masses = [3.0, 3.0, 3.0, 1.0, 4.0, 5.0, 3.0, 5.0];
    let chain: Vec<(f64, f64, f64)> =
        lengths.iter().zip(masses).map(|(l, m)| (*l, m, 0.5 * l)).collect();
    let signs = [-1, 1, -1, 1, 1, -1, 1, 1];
    // c in kilograms, from what the joints carry.
    let mut carried = 0.0;
    let mut moments = [0.0; 3];
    for (k, sign) in signs.iter().enumerate() {
        if k > 0 {
            carried += 0.5 * (masses[k - 1] + masses[k]);
        }
        for (m, moment) in (0..).zip(&mut moments) {
            *moment += f64::from(*sign) * lengths[k] * f64::powi(carried, m);
        }
    }
    // 2 · 924.5 = 43².
    for (moment, expected) in moments.into_iter().zip([2.0, 43.0, 924.5]) {
        assert!((moment - expected).abs() <= 0.0);
    }
    let census = census(&problem(&chain, [2.0, 0.0, 0.0]));
    assert!(census.straight.iter().any(|straight| straight.along == signs));
    assert!(census.complete, "{:?}", census.undecided);
}
