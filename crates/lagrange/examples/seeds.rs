//! Random seeds on the paper's chain, and on random chains: what converges, where, and how fast.
//!
//! `cargo run --release -p lagrange --example seeds`

use std::f64::consts::{FRAC_PI_2, PI};
use std::time::Instant;

use lagrange::{Seed, Settings, Solver, StepMethod, Survey, survey};
use model::{Anchors, Bar, Chain, Problem, cases};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SEEDS: u64 = 10_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let problem = cases::paper();
    println!("The paper's chain, {SEEDS} seeds, angles uniform in [-pi, pi)");
    let reduced = Settings::default();
    let once = Settings { relaxations: 0, ..reduced };
    let kept = Settings { lock_margin: 0.0, ..once };
    let dense = Settings { method: StepMethod::Dense, ..reduced };
    for (name, settings, seeds) in [
        ("reduced", reduced, SEEDS),
        ("reduced, no relaxation", once, SEEDS),
        ("reduced, no relaxation, the paper's angles kept", kept, SEEDS),
        ("dense", dense, SEEDS / 20),
    ] {
        for planar in [false, true] {
            let seeds: Vec<Seed> = (0..seeds).map(|index| seed(3, index, planar)).collect();
            let clock = Instant::now();
            let found = survey(&problem, seeds, &settings)?;
            report(name, planar, &found, clock.elapsed().as_secs_f64());
        }
    }
    near_e1(&problem)?;
    random_chains(&reduced)
}

/// One solve from near E1: best of many, since the machine has other work too.
fn near_e1(problem: &Problem) -> Result<(), lagrange::SolveError> {
    let seed = Seed::planar(&[0.3, 0.7, -1.3]);
    for (method, runs) in [(StepMethod::Reduced, 20_000), (StepMethod::Dense, 200)] {
        let settings = Settings { method, ..Default::default() };
        let mut solver = Solver::new(problem, &settings)?;
        let mut best = f64::INFINITY;
        for _ in 0..runs {
            best = best.min(solver.solve(&seed)?.effort().solve_s);
        }
        let iterations = solver.solve(&seed)?.effort().iterations;
        println!("one solve near E1, {method:?}: {:.2} us, {iterations} steps", best * 1e6);
    }
    Ok(())
}

fn random_chains(settings: &Settings) -> Result<(), Box<dyn std::error::Error>> {
    println!("Random chains (lengths 0.5..2, masses 0.1..3, centres and anchors anywhere)");
    for bars in [2, 3, 4, 5, 6, 7, 8, 9, 10, 20, 50, 100] {
        let (chains, seeds) = if bars <= 10 { (100, 100) } else { (20, 10) };
        for planar in [false, true] {
            let (mut total, mut converged, mut direct, mut stable) = (0, 0, 0, 0);
            let mut time = 0.0;
            let mut slowest: f64 = 0.0;
            for index in 0..chains {
                let problem = chain(bars, index, planar)?;
                let seeds: Vec<Seed> = (0..seeds).map(|k| seed(bars, k, planar)).collect();
                let clock = Instant::now();
                let found = survey(&problem, seeds, settings)?;
                time += clock.elapsed().as_secs_f64();
                total += found.seeds;
                converged += found.converged;
                direct += found.direct;
                let mut solver = Solver::new(&problem, settings)?;
                if let Ok(found) = solver.hang() {
                    stable += 1;
                    slowest = slowest.max(found.effort().solve_s);
                }
            }
            println!(
                "n = {bars:3} {}: {converged}/{total} converged, {direct} directly, {:.1} us per seed; \
                 no guess: {stable}/{chains} stable, slowest {:.0} us",
                if planar { "planar " } else { "spatial" },
                time / total as f64 * 1e6,
                slowest * 1e6
            );
        }
    }
    Ok(())
}

/// Seed number `index`: its own stream, so that it does not depend on the others.
fn seed(bars: usize, index: u64, planar: bool) -> Seed {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    random.set_stream(index);
    let mut angle = || random.random_range(-PI..PI);
    if planar {
        Seed::planar(&(0..bars).map(|_| angle()).collect::<Vec<_>>())
    } else {
        Seed::spatial((0..bars).map(|_| [angle(), angle(), angle()]).collect())
    }
}

/// A random chain that has an answer; every fourth with its anchors on one vertical.
fn chain(bars: usize, index: u64, planar: bool) -> Result<Problem, Box<dyn std::error::Error>> {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    random.set_stream(index + 1000 * bars as u64);
    let bars = (0..bars)
        .map(|_| {
            let length = random.random_range(0.5..2.0);
            let centre = length * random.random_range(0.0..1.0);
            Bar::new(length, random.random_range(0.1..3.0), centre, [0.0; 3])
        })
        .collect::<Result<Vec<_>, _>>()?;
    let total: f64 = bars.iter().map(Bar::length_m).sum();
    let longest = bars.iter().map(Bar::length_m).fold(0.0, f64::max);
    let least = (2.0 * longest - total).max(0.0);
    let span = least + (total - least) * random.random_range(0.02..0.95);
    let azimuth = if planar { FRAC_PI_2 } else { random.random_range(-PI..PI) };
    let height: f64 = if index.is_multiple_of(4) { -1.0 } else { random.random_range(-1.0..1.0) };
    let level = (1.0 - height * height).sqrt();
    let end_m = [span * level * azimuth.cos(), span * level * azimuth.sin(), span * height];
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    Ok(Problem::new(Chain::new("random", 9.81, anchors, bars)?)?)
}

fn report(name: &str, planar: bool, found: &Survey, seconds: f64) {
    println!(
        "{name}, {} seeds: {:.2} % converge ({:.2} % without relaxation), {} stagnate, {} false roots; \
         {:.1} us per seed; steps median {}, 95 % {}, most {}",
        if planar { "planar" } else { "spatial" },
        100.0 * found.rate(),
        100.0 * found.direct as f64 / found.seeds as f64,
        found.stagnated,
        found.false_roots,
        seconds / found.seeds as f64 * 1e6,
        found.iterations_quantile(0.5),
        found.iterations_quantile(0.95),
        found.iterations_quantile(1.0),
    );
    for group in &found.groups {
        println!(
            "    V = {:.12} mgl: {} ({} towards +Y), index {} in the plane, {} in space",
            group.energy_j / 9.806_65 + 6.0,
            group.count,
            group.towards_y,
            group.stability.index_in_plane,
            group.stability.index_in_space
        );
    }
}
