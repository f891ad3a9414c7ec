//! The condensed solver against closed forms, the reference values of the paper's example, brute
//! force and the catenary.

#![expect(clippy::excessive_precision, reason = "reference digits stand as they were published")]

use std::f64::consts::PI;

use lagrange::Error;
use lagrange::Seed;
use lagrange::condensed::{Settings, Solution, solve};
use model::{Anchors, Bar, Chain, InPlane, InSpace, Problem, Status, Vector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::judge::judge;

fn solved(bars: Vec<Bar>, gravity: f64, end_m: Vector) -> Solution {
    let problem = problem(bars, gravity, end_m);
    let solution = solve(&problem, &Settings::default()).unwrap();
    let found = judge(&problem, &solution.equilibrium);
    assert!(found.within(1e-13) && found.lowest, "{found:?}");
    solution
}

fn problem(bars: Vec<Bar>, gravity: f64, end_m: Vector) -> Problem {
    samples::of_bars(gravity, bars, end_m)
}

fn near(got: Vector, expected: Vector, tolerance: f64) {
    let off = (0..3).map(|k| (got[k] - expected[k]).abs()).fold(0.0, f64::max);
    assert!(off <= tolerance, "{got:?} instead of {expected:?}: {off:e}");
}

fn equal(n: usize, total: f64) -> Vec<Bar> {
    vec![Bar::homogeneous(total / n as f64, 1.0 / n as f64).unwrap(); n]
}

/// Reference digits: 40-digit root finding (kind "external").
#[test]
fn the_papers_chain_hangs_in_e1() {
    let solution = solve(&model::cases::paper(), &Settings::default()).unwrap();
    let found = &solution.equilibrium;
    let chain = model::cases::paper().into_chain();
    let weight = chain.bars()[0].mass_kg() * chain.gravity_m_s2();
    let length = chain.bars()[0].length_m();
    let h = 0.648_944_835_933_933_633_8;
    let v = [
        2.312_944_292_241_837_598_5, -1.312_944_292_241_837_598_5, -0.312_944_292_241_837_598_5,
        0.687_055_707_758_162_401_5,
    ];
    for (k, lambda) in found.multipliers_n.iter().enumerate() {
        let horizontal = if k == 0 { -h } else { h };
        near(lambda.map(|x| x / weight), [0.0, horizontal, v[k]], 1e-14);
    }
    for (k, degrees) in [
        19.694_867_976_133_019_888_6_f64, 38.599_136_184_451_890_107, -73.920_588_792_231_340_814_4,
    ]
    .into_iter()
    .enumerate()
    {
        let (a, b) = (found.joints_m[k], found.joints_m[k + 1]);
        let angle = (b[1] - a[1]).atan2(a[2] - b[2]);
        assert!((angle - degrees.to_radians()).abs() < 1e-14, "bar {k}");
    }
    let energy = found.energy_j / (weight * length) + 6.0;
    assert!((energy - 2.335_468_651_999_305_009_3).abs() < 1e-14);
    assert_eq!(solution.pull.compressed(), [2]);
    assert_eq!(found.stability.in_plane, InPlane::Minimum);
    assert_eq!(found.stability.in_space, InSpace::Stable);
    // The turn about the vertical through both anchors.
    assert_eq!(found.evidence.nullity, 1);
}

/// What stops the solver is in its evidence, and is what the settings promise: 1e-13 of the length,
/// some hundred roundings.
#[test]
fn the_closure_is_held_to_a_hundred_roundings() {
    for end_m in [[0.0, 0.0, -2.0], [1.0, 0.5, -1.0]] {
        let problem = samples::homogeneous(9.81, &[(1.0, 1.0); 3], end_m);
        let found = solve(&problem, &Settings::default()).unwrap();
        let evidence = &found.equilibrium.evidence;
        let Status::Reached(convergence) = &evidence.ladder.converged else {
            panic!("{:?}", evidence.ladder)
        };
        assert!(convergence.tolerance.is_some_and(|tolerance| tolerance <= 1e-13));
        // On one vertical the chain turns about it; elsewhere nothing moves at no cost.
        let vertical = end_m[0].hypot(end_m[1]) < 1e-9;
        assert_eq!(evidence.nullity, usize::from(vertical));
    }
}

/// Two bars: the triangle and the lever rule give everything in closed form.
#[test]
fn two_bars_are_a_triangle() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..1000 {
        let (a, b): (f64, f64) = (rng.random_range(0.1..2.0), rng.random_range(0.1..2.0));
        let (first, second) = (rng.random_range(0.0..2.0), rng.random_range(0.1..2.0));
        let (r, s) = (rng.random_range(0.0..1.0), rng.random_range(0.0..0.9));
        let slope: f64 = rng.random_range(-1.5..1.5);
        let span = rng.random_range((a - b).abs() + 0.01..a + b - 0.01);
        let bars = vec![
            Bar::new(a, first, a * r, [0.0; 3]).unwrap(),
            Bar::new(b, second, b * s, [0.0; 3]).unwrap(),
        ];
        let (across, rise) = (span * slope.cos(), span * slope.sin());
        let solution = solved(bars, 10.0, [across, 0.0, rise]);
        // The apex below the line of the anchors.
        let cosine = (a * a + span * span - b * b) / (2.0 * a * span);
        let angle = slope - cosine.acos();
        let apex = [a * angle.cos(), 0.0, a * angle.sin()];
        near(solution.equilibrium.joints_m[1], apex, 1e-13 * (a + b) / (1.0 - cosine * cosine));
        // The apex carries its parts of both weights; the pulls along the bars have the same
        // horizontal part H, and their slopes at the apex differ by the load over H.
        let load = 10.0 * (first * r + second * (1.0 - s));
        let (left, right) = (-apex[2] / -apex[0], (rise - apex[2]) / (across - apex[0]));
        let horizontal = load / (right - left);
        let got = -solution.equilibrium.multipliers_n[0][0];
        assert!((got / horizontal - 1.0).abs() < 1e-10, "{got} {horizontal}");
    }
}

/// Two bars over anchors next to each other, all in whole numbers: half the span, height and length
/// are `2 m, m² - 1, m² + 1`, and the span rises by 5 over 12.
#[test]
fn two_bars_over_near_anchors_in_whole_numbers() {
    for power in 8..=24 {
        let m = 2.0_f64.powi(power);
        let (length, height) = (m * m + 1.0, m * m - 1.0);
        let bars = [1.0, 2.0].map(|mass| Bar::homogeneous(13.0 * length, mass).unwrap());
        let found = solved(bars.to_vec(), 10.0, [48.0 * m, 0.0, 20.0 * m]);
        let joint = [24.0 * m + 5.0 * height, 0.0, 10.0 * m - 12.0 * height];
        // Near the threshold the closure of all bars is solved, to a rounding over their angle.
        let known = if power > 11 { 1e-15 } else { 1e-13 * m };
        near(found.equilibrium.joints_m[1], joint, known * 13.0 * length);
        // Of the load of 15 N the part 12/13 is across the span and 5/13 along it.
        let (down, along) = (90.0 / 13.0 / height, 75.0 / 52.0 / m);
        for (axial, exact) in found.equilibrium.axial_n.iter().zip([down - along, down + along]) {
            let exact = length * exact;
            assert!((axial / exact - 1.0).abs() < 10.0 * known, "{power}: {axial} {exact}");
        }
        let evidence = &found.equilibrium.evidence;
        assert_eq!((evidence.nullity, evidence.force_uncertainty()), (0, None));
    }
}

/// Unlike bars, folded: Newton's laws, and digits known.
#[test]
fn unlike_bars_over_near_anchors() {
    for pair in samples::unlike_pairs() {
        let found = solve(&pair.problem, &Settings::default()).unwrap().equilibrium;
        let judged = judge(&pair.problem, &found);
        assert!(judged.within(1e-13) && judged.lowest, "{judged:?}");
        pair.assert_holds(&found);
        assert_eq!(found.stability.in_plane, InPlane::Minimum);
    }
}

/// For few bars: of the equilibria that the full system reaches from many seeds none lies lower,
/// and those stable in space lie no higher.
#[test]
fn brute_force_finds_nothing_lower() {
    const SEEDS: usize = 60;
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut seen, mut reached) = ([0; 2], [0; 2]);
    for round in 0..60 {
        let n = 2 + round % 5;
        let bars: Vec<Bar> = (0..n)
            .map(|_| {
                let length = rng.random_range(0.3..1.5);
                let (mass, centre) = (rng.random_range(0.0..1.0), rng.random_range(0.0..length));
                Bar::new(length, mass, centre, [0.0; 3]).unwrap()
            })
            .collect();
        let total: f64 = bars.iter().map(Bar::length_m).sum();
        let longest = bars.iter().map(Bar::length_m).fold(0.0, f64::max);
        let least = (2.0 * longest - total).max(0.0);
        let distance = rng.random_range(least..0.95 * total);
        let slope: f64 = if round % 3 == 0 { 1.4 } else { rng.random_range(-1.2..1.2) };
        let end = [distance * slope.cos(), 0.0, distance * slope.sin()];
        let Ok(chain) = Chain::new("", 1.0, Anchors { start_m: [0.0; 3], end_m: end }, bars) else {
            continue;
        };
        let Ok(problem) = Problem::new(chain) else { continue };
        let best = solve(&problem, &Settings::default()).unwrap();
        seen[best.pull.compressed().len()] += 1;
        let scale = problem.chain().total_mass_kg() * total;
        let mut solver = lagrange::Solver::new(&problem, &lagrange::Settings::default()).unwrap();
        for _ in 0..SEEDS {
            let mut any = || rng.random_range(-PI..PI);
            let seed = Seed::spatial((0..n).map(|_| [any(), any(), any()]).collect());
            // Not every seed of these shapes leads somewhere.
            let Ok(found) = solver.solve(&seed) else { continue };
            let above = (found.energy_j() - best.equilibrium.energy_j) / scale;
            assert!(above > -1e-12, "lower by {above:e}");
            let stability = found.stability();
            let stable = stability.in_space == InSpace::Stable;
            assert_eq!(stable, above < 1e-11, "{stability:?} at {above:e}");
            reached[usize::from(stable)] += 1;
        }
    }
    assert!(seen[0] > 10 && seen[1] > 10, "both kinds must occur: {seen:?}");
    assert!(reached[0] > 100 && reached[1] > 100, "both kinds must be reached: {reached:?}");
}

/// Shapes where forces vanish, are indeterminate, or follow no iteration at all.
#[test]
fn special_shapes() {
    // Even number of equal bars at one point: two strands; they share the lowest joint evenly.
    let found = solved(equal(4, 4.0), 1.0, [0.0; 3]);
    near(found.equilibrium.joints_m[2], [0.0, 0.0, -2.0], 1e-15);
    // Whatever part of the lowest joint each strand carries, every bar is in tension: a strict
    // minimum.
    assert_eq!(found.equilibrium.stability.in_plane, InPlane::Minimum);
    near(found.equilibrium.reactions_n.start, [0.0, 0.0, 0.5], 1e-15);
    near(found.equilibrium.reactions_n.end, [0.0, 0.0, 0.5], 1e-15);
    // Three: an equilateral triangle, hanging from a corner, its lower side compressed.
    let found = solved(equal(3, 3.0), 1.0, [0.0; 3]);
    assert_eq!(found.pull.compressed(), [1]);
    near(found.equilibrium.joints_m[1], [0.0, 0.5, -0.75_f64.sqrt()], 1e-15);
    // Massless bars at the bottom: loose between straight strands.
    let mut bars = equal(6, 6.0);
    for bar in &mut bars[2..4] {
        *bar = Bar::homogeneous(1.0, 0.0).unwrap();
    }
    let found = solved(bars, 1.0, [1.0, 0.0, 0.0]);
    assert!(found.equilibrium.axial_n[2..4].iter().all(|force| force.abs() < 1e-15));
    near(found.equilibrium.joints_m[2], [0.0, 0.0, -2.0], 1e-15);
    near(found.equilibrium.joints_m[4], [1.0, 0.0, -2.0], 1e-15);
    // All weight at the anchors: nothing hangs, and any shape that closes would do.
    let bars = vec![
        Bar::new(1.0, 1.0, 0.0, [0.0; 3]).unwrap(),
        Bar::new(1.0, 0.0, 0.5, [0.0; 3]).unwrap(),
        Bar::new(1.0, 1.0, 1.0, [0.0; 3]).unwrap(),
    ];
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.5, 1.0, 1.0] };
    let chain = Chain::new("test", 1.0, anchors, bars).unwrap();
    assert!(matches!(Problem::new(chain), Err(model::system::Refusal::LoadOnAnchors)));
}

/// Nearly straight chains: the pull follows $\sqrt{\mathrm{var}\,b/(2\,\mathrm{slack})}$ with all
/// its digits.
#[test]
fn nearly_taut_chains_keep_their_digits() {
    for exponent in [1, 3, 6, 9, 12, 13] {
        // The doubles of this span, not the decimal, define the slack.
        let span = 1.0 - 10.0_f64.powi(-exponent);
        let slack = 1.0 - span;
        let found = solved(vec![Bar::homogeneous(0.25, 0.25).unwrap(); 4], 1.0, [span, 0.0, 0.0]);
        let pull = -found.equilibrium.multipliers_n[0][0];
        // b = -3/8, -1/8, 1/8, 3/8; the next term is of the order of the slack.
        let expected = (5.0 / 64.0 / (2.0 * slack)).sqrt();
        assert!(
            (pull / expected - 1.0).abs() < 1.5 * slack + 1e-14,
            "{exponent}: {pull} {expected}"
        );
        assert!(found.pull.passes() < 12, "{} passes", found.pull.passes());
    }
}

#[test]
fn failures_are_typed() {
    let problem = model::cases::paper();
    let few = Settings { max_passes: 1, ..Settings::default() };
    assert!(matches!(solve(&problem, &few), Err(Error::NotClosed { .. })));
    let bad = Settings { closure: f64::NAN, ..Settings::default() };
    assert!(matches!(solve(&problem, &bad), Err(Error::Settings(_))));
}

/// Anchors a hair apart over a chain much longer: two strands side by side. By symmetry equal
/// strands carry alike; different ones bend by $H/F_i$ and must lose the same height,
/// $\sum l_i/F_i^2$ in each, however small H is.
#[test]
fn strands_that_hang_side_by_side_share_the_weight() {
    let g = 9.81;
    for (masses, gaps) in [
        (vec![1.0; 12], [1e-3, 1e-7, 1e-13]),
        (vec![1.0; 40], [1e-4, 1e-8, 1e-12]),
        (vec![1.0, 2.0, 3.0, 1.0, 2.0, 5.0, 1.0, 1.0, 4.0, 2.0, 3.0, 1.0], [1e-4, 1e-7, 1e-12]),
        ([[0.3; 7], [2.0; 7]].concat(), [1e-5, 1e-8, 1e-11]),
    ] {
        let n = masses.len();
        for gap in gaps {
            let bars: Vec<_> = masses.iter().map(|m| (1.0, *m)).collect();
            let problem = samples::homogeneous(g, &bars, [gap, 0.0, 0.0]);
            let found = solve(&problem, &Settings::default()).unwrap();
            let axial = &found.equilibrium.axial_n;
            assert!(axial.iter().all(|force| *force > 0.0), "{n} {gap}");
            // What hangs on both strands: half a bar less at either anchor.
            let weight = g * (masses.iter().sum::<f64>() - 0.5 * (masses[0] + masses[n - 1]));
            let carried = axial[0] + axial[n - 1];
            let tilt = gap / n as f64;
            assert!((carried / weight - 1.0).abs() < 1e-13 + 10.0 * tilt * tilt, "{n} {gap}");
            let lost = |strand: &[f64]| strand.iter().map(|f| 1.0 / (f * f)).sum::<f64>();
            let [down, up] = [lost(&axial[..n / 2]), lost(&axial[n / 2..])];
            assert!((down / up - 1.0).abs() < 1e-12 + 1e3 * tilt * tilt, "{n} {gap} {down} {up}");
        }
    }
}

/// A weight on two massless bars drawn ever tighter, three parts across to four down: its place is
/// where two circles meet, and the forces follow. Reference digits: that formula with 60 digits
/// (kind "external"). A rounding of the way between the anchors would change the third digit of the
/// last of them.
#[test]
fn a_weight_on_a_line_ever_tighter_keeps_all_digits() {
    for (height_m, expected) in [
        (-1.5999, [332.979_774_964_977_93, 325.131_637_633_611_76]),
        (-1.599_999_84, [8_229.859_802_329_457_8, 8_222.011_802_109_713_8]),
        (-1.599_999_999_84, [260_130.865_515_486_23, 260_123.017_515_486_01]),
        (-1.599_999_999_999_84, [8_224_945.663_176_712_4, 8_224_937.815_176_712_4]),
    ] {
        let bars =
            vec![Bar::new(1.0, 1.0, 1.0, [0.0; 3]).unwrap(), Bar::homogeneous(1.0, 0.0).unwrap()];
        let found = solved(bars, 9.81, [1.2, 0.0, height_m]);
        for (axial, expected) in found.equilibrium.axial_n.iter().zip(expected) {
            assert!((axial / expected - 1.0).abs() < 1e-15, "{height_m}: {axial} {expected}");
        }
    }
}
