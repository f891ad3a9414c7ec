//! Random chains: completeness against topology, and against a search that is written here.

use census::{Census, Settings};
use model::{Anchors, Bar, Chain, Problem};
use nalgebra::{DMatrix, DVector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::{General, Line, stream};

use crate::support::census;

/// A random chain in general position; every fifth one hangs between anchors on one vertical.
fn random_problem(bars: usize, seed: u64) -> Problem {
    let line = if seed.is_multiple_of(5) { Line::Vertical } else { Line::Any };
    General::of_censuses(line).problem(&mut stream(seed, bars as u64), bars)
}

#[test]
fn the_euler_characteristic_is_right_on_two_hundred_chains() {
    for seed in 0..50 {
        for bars in 3..=6 {
            let problem = random_problem(bars, seed);
            let census = census(&problem);
            assert!(census.complete, "{bars} bars, seed {seed}: {:?}", census.undecided);
            let topology = census.topology.as_ref().unwrap();
            assert_eq!(census.alternating_sum(), topology.euler, "{bars} bars, seed {seed}");
            assert_eq!(census.check(&problem), Ok(()), "{bars} bars, seed {seed}");
        }
    }
}

#[test]
fn one_equilibrium_at_least_is_optimal_and_it_is_the_first() {
    for seed in 0..60 {
        let census = census(&random_problem(3 + usize::try_from(seed % 5).unwrap(), seed));
        let optimal: Vec<bool> = census.equilibria.iter().map(|e| e.optimal).collect();
        assert!(optimal[0], "seed {seed}");
        // Stable in space if and only if globally minimal.
        for equilibrium in &census.equilibria {
            assert_eq!(equilibrium.optimal, equilibrium.index_in_space() == 0, "seed {seed}");
        }
        assert_eq!(optimal.iter().filter(|optimal| **optimal).count(), 1, "seed {seed}");
        // All enclosures of energy are apart from each other or the order is by angles.
        assert!(census.equilibria.is_sorted_by(|a, b| a.energy_j.mid() <= b.energy_j.mid()));
    }
}

/// Newton's method from random angles on the Lagrange equations of the plane, in other unknowns
/// than those of the census: angles and two multipliers. Every equilibrium that it finds must be
/// listed.
#[test]
fn random_newton_starts_find_nothing_that_is_not_listed() {
    let mut found = 0;
    let mut listed = 0;
    for seed in 1..5 {
        for bars in 3..=6 {
            let problem = random_problem(bars, seed);
            let census = census(&problem);
            let mut hit = vec![false; census.equilibria.len()];
            let mut rng = ChaCha8Rng::seed_from_u64(1000 + seed);
            for _ in 0..1500 {
                let start: Vec<f64> = (0..bars).map(|_| rng.random_range(-3.15..3.15)).collect();
                let Some(angles) = newton(&problem, start) else { continue };
                found += 1;
                let k = census.equilibria.iter().position(|equilibrium| {
                    equilibrium.angles_rad.iter().zip(&angles).all(|(enclosure, angle)| {
                        let difference = enclosure.mid() - angle;
                        // Whole turns do not count; Newton's end is good to about 1e-10.
                        difference.sin().hypot(1.0 - difference.cos()) < 1e-7
                    })
                });
                let k = k.unwrap_or_else(|| {
                    panic!("{bars} bars, seed {seed}: {angles:?} is not in the census")
                });
                hit[k] = true;
            }
            listed += hit.iter().filter(|hit| **hit).count();
        }
    }
    // The search is worth something: thousands of runs end, and nearly all equilibria are hit.
    assert!(found > 5000 && listed > 150, "{found} {listed}");
}

/// A chain of the kind that breaks general position: lengths and anchors from a few round numbers,
/// so that subsets of bars are often equally long, massless bars, coincident anchors.
fn round_problem(bars: usize, seed: u64) -> Option<Problem> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(100 + bars as u64);
    let mut pick = |from: &[f64]| from[rng.random_range(0..from.len())];
    let bars: Vec<Bar> = (0..bars)
        .filter_map(|_| {
            let length = pick(&[0.5, 1.0, 1.5]);
            let part = pick(&[0.0, 0.25, 0.5, 0.5, 1.0]);
            Bar::new(length, pick(&[0.0, 1.0, 2.0]), part * length, [0.0; 3]).ok()
        })
        .collect();
    let end_m = [pick(&[0.0, 0.0, 0.25, 1.0]), 0.0, pick(&[0.0, -0.5, 0.75])];
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    Chain::new("round", 9.81, anchors, bars).ok().and_then(|chain| Problem::new(chain).ok())
}

/// Never a wrong "complete": where a census of a degenerate chain says so, random starts find
/// nothing else, and the check and the Morse inequalities hold.
#[test]
fn a_complete_census_of_a_degenerate_chain_misses_nothing() {
    let (mut complete, mut open, mut found, mut straight, mut decided) = (0, 0, 0, 0, 0);
    for (bars, seed) in (3..=5).flat_map(|bars| (0..50).map(move |seed| (bars, seed))) {
        let Some(problem) = round_problem(bars, seed) else { continue };
        // All weight on the anchors is refused.
        let Ok(census) = Census::take(&problem, &Settings::default()) else { continue };
        assert_eq!(census.check(&problem), Ok(()), "{bars} bars, seed {seed}");
        straight += u32::from(census.topology.is_err());
        if !census.complete {
            // An honest answer: what is open is listed, or a straight position is named.
            assert!(!census.undecided.is_empty() || census.topology.is_err());
            open += 1;
            continue;
        }
        complete += 1;
        assert!(census.morse().is_ok(), "{bars} bars, seed {seed}");
        assert!(census.topology.is_ok() || !census.straight.is_empty(), "{bars} bars, seed {seed}");
        decided += u32::from(census.topology.is_err());
        let mut rng = ChaCha8Rng::seed_from_u64(2000 + seed);
        for _ in 0..200 {
            let start: Vec<f64> = (0..bars).map(|_| rng.random_range(-3.15..3.15)).collect();
            let Some(angles) = newton(&problem, start) else { continue };
            let near = |a: f64, b: f64| (a - b).sin().hypot(1.0 - (a - b).cos()) < 1e-6;
            let listed = census.equilibria.iter().any(|equilibrium| {
                // With the anchors on one vertical the mirror image is the same circle.
                let sides: &[f64] = if census.circles { &[1.0, -1.0] } else { &[1.0] };
                sides.iter().any(|side| {
                    let boxes = equilibrium.angles_rad.iter().zip(&angles);
                    boxes.into_iter().all(|(a, b)| near(a.mid(), side * b))
                })
            });
            // Bars that hang slack point anywhere; all others are upright.
            let in_family = census.families.iter().any(|family| {
                family.signs.iter().zip(&angles).all(|(sign, a)| *sign == 0 || a.sin().abs() < 1e-6)
            });
            assert!(listed || in_family, "{bars} bars, seed {seed}: {angles:?} {problem:?}");
            found += 1;
        }
    }
    println!(
        "{complete} complete, {open} open, {straight} straight, of these {decided} decided, {found} found"
    );
    assert!(complete > 30 && open > 10 && decided > 2 && found > 3000);
}

/// Solve the planar equations: with angles φ from the descending vertical and multipliers (H, V),
/// l_i (F_ix cos φ_i + F_iz sin φ_i) = 0, Σ l_i sin φ_i = D_x, −Σ l_i cos φ_i = D_z.
fn newton(problem: &Problem, mut angles: Vec<f64>) -> Option<Vec<f64>> {
    let chain = problem.chain();
    let bars = chain.bars();
    let n = bars.len();
    let difference = chain.anchors().difference_m();
    let span = [difference[0].hypot(difference[1]), difference[2]];
    let mut carried = 0.0;
    let weights: Vec<f64> = bars
        .iter()
        .map(|bar| {
            let weight = carried + bar.mass_kg() * (1.0 - bar.centre_m() / bar.length_m());
            carried += bar.mass_kg();
            weight
        })
        .collect();
    // The pull that fits the start best is not worth computing: hang half the weight on each end.
    let mut pull = [angles[0].sin() * carried, -0.5 * carried];
    for _ in 0..60 {
        let (mut matrix, mut misfit) = (DMatrix::zeros(n + 2, n + 2), DVector::zeros(n + 2));
        let mut gap = [-span[0], -span[1]];
        for i in 0..n {
            let (sin, cos) = angles[i].sin_cos();
            let force = [pull[0], pull[1] + weights[i]];
            matrix[(i, i)] = -force[0] * sin + force[1] * cos;
            matrix[(i, n)] = cos;
            matrix[(i, n + 1)] = sin;
            misfit[i] = -(force[0] * cos + force[1] * sin);
            let length = bars[i].length_m();
            matrix[(n, i)] = length * cos;
            matrix[(n + 1, i)] = length * sin;
            gap[0] += length * sin;
            gap[1] -= length * cos;
        }
        (misfit[n], misfit[n + 1]) = (-gap[0], -gap[1]);
        if misfit.iter().all(|x| x.abs() < 1e-12) {
            return Some(angles);
        }
        let step: DVector<f64> = matrix.lu().solve(&misfit)?;
        // Long steps are shortened: only where the method ends matters here.
        let longest = step.rows(0, n).amax();
        let scale = if longest > 1.0 { 1.0 / longest } else { 1.0 };
        for (angle, part) in angles.iter_mut().zip(&step) {
            *angle += scale * part;
        }
        pull[0] += scale * step[n];
        pull[1] += scale * step[n + 1];
    }
    None
}

#[test]
fn the_answer_does_not_depend_on_the_number_of_threads() {
    let problem = random_problem(8, 1);
    let pools = [1, 2, 3, 5].map(|threads| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool")
    });
    // Long enough that the levels of the search are spread over the threads.
    let [one, two, three, five] = pools.map(|pool| {
        let mut census = pool.install(|| census(&problem));
        census.statistics.seconds = 0.0;
        assert!(census.complete && census.equilibria.len() > 20);
        // Every bit of every number is in it.
        format!("{census:?}")
    });
    // Compared without printing: a census is long.
    assert!(one == two && one == three && one == five);
}
