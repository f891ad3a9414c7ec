//! How fast the minimiser is: `cargo run --profile dist -p energy --example energy_speed`.
//!
//! Every figure is the least of several runs: what the machine does besides only adds. The chains
//! are those of the bars to clear: equal bars, total length 1.5 times the span, anchors (0, 0, 0)
//! and (1, 0, -0.2); and deep ones, bars of 1 m from anchors a metre and a half apart.

use std::hint::black_box;
use std::time::Instant;

use energy::{Seed, Settings, example, minimise, minimise_from};
use model::{Anchors, Bar, Chain, Problem, cases};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Least time of `runs` runs of `times` calls each, per call, s.
fn least(runs: usize, times: usize, mut call: impl FnMut()) -> f64 {
    let run = |_| {
        let clock = Instant::now();
        for _ in 0..times {
            call();
        }
        clock.elapsed().as_secs_f64() / times as f64
    };
    (0..runs).map(run).fold(f64::INFINITY, f64::min)
}

fn equal_bars(n: usize) -> Result<Problem, Box<dyn std::error::Error>> {
    let span_m = f64::hypot(1.0, 0.2);
    let bars = vec![Bar::homogeneous(1.5 * span_m / n as f64, 1.0 / n as f64)?; n];
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -0.2] };
    Ok(Problem::new(Chain::new("equal bars", 9.81, anchors, bars)?)?)
}

fn deep(n: usize) -> Result<Problem, Box<dyn std::error::Error>> {
    let bars = vec![Bar::homogeneous(1.0, 1.0)?; n];
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.3, 0.0, -0.7] };
    Ok(Problem::new(Chain::new("deep", 9.81, anchors, bars)?)?)
}

/// One line for each number of bars.
fn growth(
    chain: impl Fn(usize) -> Result<Problem, Box<dyn std::error::Error>>,
) -> Result<(), Box<dyn std::error::Error>> {
    let settings = Settings::default();
    for n in [10, 100, 1_000, 10_000, 100_000, 1_000_000] {
        let problem = chain(n)?;
        let found = minimise(&problem, &settings)?;
        let runs = (1_000_000 / n).clamp(3, 20);
        let time = least(runs, (10_000 / n).max(1), || {
            black_box(minimise(&problem, &settings).ok());
        });
        println!(
            "  n = {n:<8} {:12.3} ms  {:6.1} ns per bar, {} iterations, gradient {:.0e}, gap {:.0e}",
            1e3 * time,
            1e9 * time / n as f64,
            found.work.iterations,
            found.work.gradient,
            found.work.gap,
        );
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let settings = Settings::default();
    let mut rng = ChaCha8Rng::seed_from_u64(1);

    println!("the paper's example");
    let near = least(20, 1_000, || {
        black_box(example::minimise(black_box(0.35), black_box(0.67), &settings).ok());
    });
    println!("  theta, alpha, seed near E1       {:9.2} us", 1e6 * near);
    let seeds: Vec<[f64; 2]> =
        (0..1_000).map(|_| [rng.random_range(-3.1..3.1), rng.random_range(-3.1..3.1)]).collect();
    let random = least(20, 1, || {
        for [theta, alpha] in &seeds {
            black_box(example::minimise(*theta, *alpha, &settings).ok());
        }
    });
    println!("  theta, alpha, random seeds       {:9.2} us", 1e6 * random / seeds.len() as f64);

    let paper = cases::paper();
    let near = Seed::angles(&paper, &[0.35, 0.67, -1.3])?;
    let near = least(20, 1_000, || {
        black_box(minimise_from(&paper, &near, &settings).ok());
    });
    println!("  in space, seed near E1           {:9.2} us", 1e6 * near);
    let seeds: Vec<Seed> = (0..1_000)
        .map(|_| {
            let mut direction = || std::array::from_fn(|_| rng.random_range(-1.0..1.0));
            Seed::directions(&paper, &[direction(), direction(), direction()])
        })
        .collect::<Result<_, _>>()?;
    let random = least(20, 1, || {
        for seed in &seeds {
            black_box(minimise_from(&paper, seed, &settings).ok());
        }
    });
    println!("  in space, random seeds           {:9.2} us", 1e6 * random / seeds.len() as f64);
    let none = least(20, 1_000, || {
        black_box(minimise(&paper, &settings).ok());
    });
    println!("  in space, no guess               {:9.2} us", 1e6 * none);

    println!("equal bars, no guess: shape, all forces, stability");
    growth(equal_bars)?;
    println!("deep chains, the same");
    growth(deep)
}
