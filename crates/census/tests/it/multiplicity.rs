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
        assert_eq!((found.multiplicity, found.degree), (Some(multiplicity), degree), "{lengths:?}");
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
        let changes: [fn(&mut DegenerateEquilibrium); 3] = [
            |e| e.multiplicity = e.multiplicity.map(|m| m + 1),
            |e| e.degree += 1,
            |e| e.signs[0] = -e.signs[0],
        ];
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

/// Lengths, the end anchor, the signs, multiplicity and degree.
type Straightened = (Vec<f64>, [f64; 3], Vec<i8>, Option<usize>, i8);

/// Bars without mass that just bridge, in one line, what a bar with a weight at its end leaves. (The
/// energy is V₀ ± W x²/2 with x = δ.)
fn straightened() -> [Straightened; 5] {
    [
        // Bar 1 hangs, and 5 + 1 are level over 6: a minimum. It stands: a maximum.
        (vec![1.0, 5.0, 1.0], [6.0, 0.0, -1.0], vec![1, 0, 0], Some(3), 1),
        (vec![1.0, 5.0, 1.0], [6.0, 0.0, 1.0], vec![-1, 0, 0], Some(3), -1),
        // The longest alone points along the gap: 7 - 1 over 6.
        (vec![1.0, 7.0, 1.0], [6.0, 0.0, -1.0], vec![1, 0, 0], Some(3), 1),
        // 3, 4, 5 at a slant, the last two bars: 3 + 2.
        (vec![1.0, 3.0, 2.0], [4.0, 0.0, -4.0], vec![1, 0, 0], Some(3), 1),
        // Three of them, 1 + 2 + 3: a circle of slack positions shrinks to the point. A maximum in two turns.
        (vec![1.0, 1.0, 2.0, 3.0], [6.0, 0.0, 1.0], vec![-1, 0, 0, 0], None, 1),
    ]
}

/// A weight at joint 1, at the end of a bar, and no other.
fn weight_at_joint_1(lengths: &[f64], end_m: [f64; 3]) -> Problem {
    let bars: Vec<(f64, f64, f64)> = lengths
        .iter()
        .enumerate()
        .map(|(k, l)| if k == 0 { (*l, 1.0, *l) } else { (*l, 0.0, 0.5 * l) })
        .collect();
    problem(&bars, end_m)
}

#[test]
fn bars_without_force_that_just_bridge_their_gap_are_named() {
    for (lengths, end, signs, multiplicity, degree) in straightened() {
        let problem = weight_at_joint_1(&lengths, end);
        let census = census(&problem);
        assert!(census.decided() && !census.complete, "{lengths:?}: {:?}", census.undecided);
        let at: Vec<_> = census.degenerate.iter().filter(|merged| merged.signs == signs).collect();
        let [found] = at[..] else { panic!("{lengths:?}: {:?}", census.degenerate) };
        assert_eq!((found.multiplicity, found.degree), (multiplicity, degree), "{lengths:?}");
        assert_eq!(
            (found.index_in_plane, found.index_out_of_plane),
            (0, usize::from(signs[0] < 0))
        );
        // Upright bar 1 bears the weight, and the others lie in the line to the end, without force.
        let up = -f64::from(signs[0]) * lengths[0];
        assert!(
            (found.joints_m[1][2].mid() - up).abs() < 1e-15 && found.joints_m[1][0].mag() < 1e-15
        );
        assert!((found.axial_n[0].mid() - 9.81 * f64::from(signs[0])).abs() < 1e-13);
        assert!((found.energy_j.mid() - 9.81 * up).abs() < 1e-13);
        let (dx, dz) = (end[0], end[2] - up);
        let last = lengths.len();
        for k in 2..last {
            let [x, _, z] = found.joints_m[k];
            assert!((x.mid() * dz - (z.mid() - up) * dx).abs() < 1e-14 * dx.hypot(dz), "joint {k}");
            assert!(found.axial_n[k - 1].mag() < 1e-300);
        }
        for (k, length) in lengths.iter().enumerate() {
            let [a, b] = [k, k + 1].map(|k| found.joints_m[k]);
            let bar = (b[0].mid() - a[0].mid()).hypot(b[2].mid() - a[2].mid());
            assert!((bar - length).abs() < 1e-14, "bar {k}");
        }
        // The sum over all is the Euler characteristic: topology alone knows of it too.
        if let Ok(topology) = &census.topology {
            assert_eq!(census.alternating_sum(), topology.euler, "{lengths:?}");
        }
        let changes: [fn(&mut DegenerateEquilibrium); 3] =
            [|e| e.multiplicity = Some(2), |e| e.degree += 1, |e| e.index_in_plane += 1];
        for change in changes {
            let mut wrong = census.clone();
            change(&mut wrong.degenerate[0]);
            assert!(wrong.check(&problem).is_err());
        }
    }
}

/// One equilibrium is left where the gap is too long for slack bars, of the degree; where it is shorter there is a
/// family of slack positions besides, and all degrees together are the same.
#[test]
fn a_longer_and_a_shorter_gap_part_what_has_merged() {
    for (lengths, end, signs, multiplicity, degree) in straightened() {
        let mut slack = 0;
        for change in [1e-3, -1e-3] {
            let census = census(&weight_at_joint_1(&lengths, [end[0] + change, end[1], end[2]]));
            assert!(census.complete, "{lengths:?} {change:e}: {:?}", census.undecided);
            let up = -f64::from(signs[0]) * lengths[0];
            let near = census.equilibria.iter().filter(|e| {
                let (x, z) = (e.joints_m[1][0].mid(), e.joints_m[1][2].mid());
                let others = e.axial_n[1..].iter().map(|n| n.mag()).fold(0.0, f64::max);
                x.hypot(z - up) < 0.01 && others < 0.1
            });
            // Those in one line: all other ways to lie in it are of another length.
            let near: Vec<usize> = near.map(|e| e.index_in_plane).collect();
            let families: Vec<_> = census.families.iter().filter(|f| f.signs == signs).collect();
            let sign = |index: usize| if index.is_multiple_of(2) { 1 } else { -1 };
            let mut sum: i64 = near.iter().map(|index| sign(*index)).sum();
            for family in &families {
                sum += sign(family.index_in_plane) * family.topology.as_ref().unwrap().euler;
            }
            assert_eq!((near.len(), sum), (1, i64::from(degree)), "{lengths:?} {change:e}");
            slack += families.len();
            // Two slack positions and the one in line.
            if let ([family], Some(3)) = (&families[..], multiplicity) {
                assert_eq!(family.topology.as_ref().unwrap().betti, [2]);
            }
        }
        assert_eq!(slack, 1, "{lengths:?}");
    }
}

/// 5 less 1 upright over the 4 m between anchors on one vertical, bars 1 and 4 hanging to and fro: bars 2 and 3 carry
/// nothing in the straight position, which is named as such, with any force.
#[test]
fn slack_bars_that_just_bridge_an_upright_gap_are_straight() {
    let bars = [(2.0, 2.0, 1.0), (5.0, 0.0, 5.0), (1.0, 3.0, 1.0), (2.0, 0.0, 0.5)];
    let census = census(&problem(&bars, [0.0, 0.0, 4.0]));
    assert!(census.decided(), "{:?}", census.undecided);
    // 2 + 5 - 1 - 2 and -2 + 5 - 1 + 2, all in one line.
    let mut along: Vec<_> = census.straight.iter().map(|s| (s.along.clone(), s.upright)).collect();
    along.sort();
    assert_eq!(along, [(vec![-1, 1, -1, 1], true), (vec![1, 1, -1, -1], true)]);
    assert!(census.degenerate.is_empty());
}
