//! Random seeds on chains of equal bars: how many converge, and in how long.
//!
//! `cargo run --profile dist -p lagrange --example seeds`

use std::f64::consts::PI;
use std::time::Instant;

use lagrange::{Seed, Settings, Solver};
use model::{Anchors, Bar, Chain, Problem, STANDARD_GRAVITY_M_S2};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Span, in total lengths.
const SPAN: f64 = 0.88;
const SEEDS: u64 = 200;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!(" bars   converge   at once   us per seed   most steps");
    for bars in [3, 5, 10, 15, 30, 60] {
        let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, SPAN * f64::from(bars), 0.0] };
        let list = vec![Bar::homogeneous(1.0, 1.0)?; usize::try_from(bars)?];
        let problem =
            Problem::new(Chain::new("equal bars", STANDARD_GRAVITY_M_S2, anchors, list)?)?;
        let mut solver = Solver::new(&problem, &Settings::default())?;
        let (mut converged, mut direct, mut most) = (0, 0, 0);
        let clock = Instant::now();
        for index in 0..SEEDS {
            let mut random = ChaCha8Rng::seed_from_u64(2);
            random.set_stream(index);
            let angles: Vec<f64> = (0..bars).map(|_| random.random_range(-PI..PI)).collect();
            let Ok(found) = solver.solve(&Seed::planar(&angles)) else { continue };
            converged += 1;
            direct += u64::from(found.effort().relaxations == 0);
            most = most.max(found.effort().iterations);
        }
        let percent = |count: u64| 100.0 * count as f64 / SEEDS as f64;
        let micros = clock.elapsed().as_secs_f64() / SEEDS as f64 * 1e6;
        println!(
            "{bars:5} {:8.1} % {:7.1} % {micros:13.0} {most:12}",
            percent(converged),
            percent(direct)
        );
    }
    Ok(())
}
