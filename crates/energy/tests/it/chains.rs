//! Chains of every shape: closed, balanced by Newton's laws, minimal, and the same from other
//! seeds.

use crate::support::{difference, direction, energy_unit, problem, random_seed, rng, unbalanced};
use energy::{Error, Motion, Seed, Settings, minimise, minimise_from, reaction_by_differences};
use model::{InSpace, Problem, Vector};
use rand::RngExt;

/// Everything that holds at every answer of the minimiser.
fn check(name: &str, problem: &Problem) -> energy::Solution {
    let solution =
        minimise(problem, &Settings::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let found = &solution.equilibrium;
    let (forces, lengths) = unbalanced(problem, &solution);
    assert!(forces < 1e-12, "{name}: forces {forces:e}");
    assert!(lengths < 1e-13, "{name}: lengths {lengths:e}");
    assert!(solution.work.gradient <= 1e-12 && solution.work.gap <= 1e-13, "{name}");
    assert_eq!(found.stability.in_space, InSpace::Stable, "{name}");
    assert_eq!(found.stability.index_in_space, 0, "{name}");
    // Two pushed bars could turn about each other and lower the chain: at most one in a stable one.
    let weight = problem.chain().total_mass_kg() * problem.chain().gravity_m_s2();
    assert!(found.axial_n.iter().filter(|n| **n < -1e-12 * weight).count() <= 1, "{name}");
    let finite = found.evidence.condition.is_finite() && found.energy_j.is_finite();
    assert!(finite && found.evidence.condition >= 1.0, "{name}");
    solution
}

fn equal(n: usize, length: f64) -> Vec<(f64, f64, f64)> {
    vec![(length / n as f64, 1.0 / n as f64, 0.5); n]
}

#[test]
fn hard_shapes_of_all_kinds() {
    for seed in 0..330 {
        let (shape, problem) = samples::random_chain(seed);
        check(&format!("{shape:?} {seed}"), &problem);
    }
}

/// All but one of the bars weightless: strings on either side of the weight are straight.
#[test]
fn one_weight_hangs_on_straight_strings() {
    for n in [3, 8, 40, 200] {
        let light: Vec<_> =
            (0..n).map(|i| (1.0, if i == n / 3 { 5.0 } else { 0.0 }, 0.5)).collect();
        let end = [0.6 * n as f64, 0.0, 0.1 * n as f64];
        let u = check(&format!("{n} bars"), &problem(&light, end, 9.81)).directions;
        for i in 1..n / 3 {
            assert!(difference(u[i], u[0]) < 1e-9);
        }
    }
}

#[test]
fn two_bars_form_the_triangle_of_the_cosine_rule() {
    let mut rng = rng(4);
    for _ in 0..200 {
        let (a, b): (f64, f64) = (rng.random_range(0.2..2.0), rng.random_range(0.2..2.0));
        let d = rng.random_range((a - b).abs() + 1e-3..a + b - 1e-3);
        let u = direction(&mut rng);
        let (m1, m2) = (rng.random_range(0.0..2.0), rng.random_range(0.1..2.0));
        let (r1, r2) = (rng.random_range(0.0..1.0), rng.random_range(0.0..1.0));
        let problem = problem(&[(a, m1, r1), (b, m2, r2)], u.map(|x| d * x), 9.81);
        let solution = check("triangle", &problem);
        // The joint is at the foot along the span, and below it in the vertical plane: the lower of
        // the two triangles in the plane is the lowest on the circle.
        let foot = (d * d + a * a - b * b) / (2.0 * d);
        let height = (a * a - foot * foot).sqrt();
        let level = u[0].hypot(u[1]);
        let below: Vector = [u[0] * u[2] / level, u[1] * u[2] / level, -level];
        let joint: Vector = std::array::from_fn(|k| foot * u[k] + height * below[k]);
        assert!(difference(solution.equilibrium.joints_m[1], joint) < 1e-9);
        let lever = r1 * m1 * joint[2] + m2 * ((1.0 - r2) * joint[2] + r2 * d * u[2]);
        assert!((solution.equilibrium.energy_j - 9.81 * lever).abs() < 1e-9);
    }
}

#[test]
fn random_chains_from_random_seeds_all_end_at_the_energy_found_without_a_guess() {
    let mut rng = rng(5);
    for case in 0..120 {
        let n = rng.random_range(2..30);
        let spread = [0.0, 1.0, 3.0][case % 3];
        let bars: Vec<_> = (0..n)
            .map(|i| {
                let l = 10.0_f64.powf(0.5 * spread * rng.random_range(-0.5..0.5));
                let m = 10.0_f64.powf(spread * rng.random_range(-0.5..0.5));
                (l, if i > 0 && rng.random_bool(0.2) { 0.0 } else { m }, rng.random())
            })
            .collect();
        let total: f64 = bars.iter().map(|b| b.0).sum();
        let longest = bars.iter().fold(0.0_f64, |m, b| m.max(b.0));
        let least = (2.0 * longest - total).max(0.0);
        let span = least + (total - least) * rng.random_range(0.01..0.999);
        let u = if case % 4 == 0 { [0.0, 0.0, 1.0] } else { direction(&mut rng) };
        let problem = problem(&bars, u.map(|x| span * x), 9.81);
        let best = check(&format!("random {case}"), &problem);
        for k in 0..10 {
            let seed = random_seed(&problem, &mut rng);
            let found = minimise_from(&problem, &seed, &Settings::default())
                .unwrap_or_else(|e| panic!("case {case} seed {k}: {e}"));
            let above = found.equilibrium.energy_j - best.equilibrium.energy_j;
            let above = above / energy_unit(&problem);
            assert!(above.abs() < 1e-12, "case {case} seed {k}: {above:e}");
        }
    }
}

#[test]
fn the_reaction_is_the_derivative_of_the_least_energy_for_any_chain() {
    let mut rng = rng(6);
    let settings = Settings::default();
    for case in 0..20 {
        let n = rng.random_range(2..12);
        let bars: Vec<_> =
            (0..n).map(|_| (rng.random_range(0.5..2.0), rng.random_range(0.1..2.0), 0.4)).collect();
        let total: f64 = bars.iter().map(|b| b.0).sum();
        let longest = bars.iter().fold(0.0_f64, |m, b| m.max(b.0));
        let least = (2.0 * longest - total).max(0.0);
        let span = least + (total - least) * rng.random_range(0.2..0.9);
        let u = if case % 4 == 0 { [0.0, 0.0, -1.0] } else { direction(&mut rng) };
        let problem = problem(&bars, u.map(|x| span * x), 9.81);
        let solution = minimise(&problem, &settings).unwrap();
        let numeric = reaction_by_differences(&problem, &solution, &settings).unwrap();
        let analytic = solution.equilibrium.reactions_n.end;
        let scale = analytic.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let error = difference(numeric, analytic) / scale;
        // Sixth order differences of energies exact to about 1e-16.
        assert!(error < 1e-10, "case {case}: {error:e}");
    }
}

#[test]
fn long_chains_take_no_more_iterations_than_short_ones() {
    for n in [10, 100, 1_000, 10_000, 100_000] {
        let span = f64::hypot(1.0, 0.2);
        let problem = problem(&equal(n, 1.5 * span), [1.0, 0.0, -0.2], 9.81);
        let solution = check(&format!("{n} bars"), &problem);
        assert!(solution.work.iterations <= 6, "{n}: {}", solution.work.iterations);
    }
}

/// Bars of unit length from anchors next to each other: the chain hangs straight down, bends within
/// a few bars, and comes up again. With the second end the bar at the bottom lies level and carries
/// no force, so that there is no horizontal pull that would say where the plane of the chain is.
#[test]
fn deep_chains_take_few_iterations_however_many_bars_they_have() {
    for end_m in [[1.3, 0.0, -0.7], [1.0, 0.0, -1.0]] {
        for n in [100, 1_000, 10_000, 100_000] {
            let problem = problem(&vec![(1.0, 1.0, 0.5); n], end_m, 9.81);
            let solution = check(&format!("{n} bars to {end_m:?}"), &problem);
            // Measured: 7, 5, 7, 7; 7, 5, 4, 7.
            assert!(solution.work.iterations <= 10, "{n}: {}", solution.work.iterations);
        }
    }
}

#[test]
fn a_plane_minimum_need_not_be_one_in_space() {
    // Anchors nearly on one vertical: in the plane the chain can hang on the wrong side of them; in
    // space it turns round.
    let mut rng = rng(7);
    let problem = problem(&equal(6, 1.0), [0.05, 0.0, -0.6], 9.81);
    let plane = Settings { motion: Motion::Plane, ..Settings::default() };
    let best = minimise(&problem, &Settings::default()).unwrap();
    let mut caught = 0;
    for _ in 0..200 {
        let angles: Vec<f64> = (0..6).map(|_| rng.random_range(-3.0..3.0)).collect();
        let seed = Seed::angles(&problem, &angles).unwrap();
        let found = minimise_from(&problem, &seed, &plane).unwrap();
        assert_eq!(found.equilibrium.stability.index_in_plane, 0);
        let above = found.equilibrium.energy_j - best.equilibrium.energy_j;
        if above > 1e-9 {
            caught += 1;
            assert!(found.equilibrium.stability.index_in_space > 0);
            // The same seed, free to leave the plane.
            let on = Seed::directions(&problem, &found.directions).unwrap();
            let freed = minimise_from(&problem, &on, &Settings::default()).unwrap();
            assert!((freed.equilibrium.energy_j - best.equilibrium.energy_j).abs() < 1e-11);
        }
    }
    assert!(caught > 0);
}

#[test]
fn bad_seeds_and_settings_are_refused_with_their_numbers() {
    let chain = problem(&equal(3, 1.0), [0.5, 0.0, 0.0], 9.81);
    let settings = Settings::default();
    let size = Seed::directions(&chain, &[[1.0, 0.0, 0.0]]).unwrap_err();
    assert_eq!(size, Error::SeedSize { bars: 3, given: 1 });
    let zero = [[1.0, 0.0, 0.0], [0.0; 3], [1.0, 0.0, 0.0]];
    let zero = Seed::directions(&chain, &zero).unwrap_err();
    assert_eq!(zero, Error::SeedDirection { bar: 2, direction: [0.0; 3] });
    let across = Seed::directions(&chain, &[[0.0, 1.0, 0.0]; 3]).unwrap();
    let plane = Settings { motion: Motion::Plane, ..settings };
    let across = minimise_from(&chain, &across, &plane).unwrap_err();
    assert_eq!(across, Error::SeedDirection { bar: 1, direction: [0.0, 1.0, 0.0] });
    assert!(matches!(
        Seed::angles(&chain, &[0.0, f64::NAN, 0.0]).unwrap_err(),
        Error::SeedAngle { .. }
    ));
    // Out of iterations is an error, whatever argmin calls it.
    let short = Settings { max_iterations: 1, ..settings };
    let upside_down = Seed::angles(&chain, &[3.0, 1.5, 0.5]).unwrap();
    assert!(matches!(
        minimise_from(&chain, &upside_down, &short).unwrap_err(),
        Error::NotConverged { iterations: 1, .. }
    ));
    // However few are asked for, and however near that was.
    let iterations = minimise_from(&chain, &upside_down, &settings).unwrap().work.iterations;
    for max_iterations in 1..iterations {
        let short = Settings { max_iterations, ..settings };
        let refused = minimise_from(&chain, &upside_down, &short).unwrap_err();
        assert!(
            matches!(refused, Error::NotConverged { iterations, .. } if iterations == max_iterations),
            "{max_iterations}: {refused}"
        );
    }
    // A seed of another chain.
    let other = problem(&equal(4, 1.0), [0.5, 0.0, 0.0], 9.81);
    let seed = Seed::angles(&other, &[0.0; 4]).unwrap();
    assert!(matches!(
        minimise_from(&chain, &seed, &settings).unwrap_err(),
        Error::SeedSize { bars: 3, given: 4 }
    ));
}
