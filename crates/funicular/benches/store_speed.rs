//! How many seeds a second are computed and written: the paper's chain, to a temporary folder.
//!
//! ```text
//! cargo bench -p funicular --bench store_speed -- [SEEDS [lagrange|energy|both [parquet|csv]]]
//! ```

use std::error::Error;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use sweep::{Manifest, RunSettings, SCHEMA_VERSION, Settings, Shard, Sweep, SystemText, run};

/// Runs of each kind; the fastest counts, being the least disturbed.
const RUNS: usize = 3;

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo adds an option of its own.
    let mut arguments = std::env::args().skip(1).filter(|argument| argument != "--bench");
    let seeds: u64 = arguments.next().as_deref().unwrap_or("4000000").parse()?;
    let solver = arguments.next().unwrap_or_else(|| "lagrange".to_owned());
    let format = arguments.next().unwrap_or_else(|| "parquet".to_owned());
    let problem = model::cases::paper();
    let both = funicular::starts::solvers(&problem)?;
    let solvers = if solver == "both" { both } else { both.only(&[&solver]) };
    let sweep = Sweep::new(&problem, Settings::default(), solvers)?;
    let manifest = Manifest {
        schema_version: SCHEMA_VERSION,
        program: "store_speed".to_owned(),
        system: SystemText::from(&(&problem).into()),
        seeds,
        seed_number: 1,
        source: "uniform".to_owned(),
        solvers: sweep.solvers().names().map(str::to_owned).collect(),
        release: None,
        angles: Vec::new(),
        equilibria: sweep.members().list().to_vec(),
        equilibria_complete: sweep.members().complete(),
        format: format.clone(),
        part_seeds: 0,
        shard: Shard::WHOLE,
        range: 0..0,
    }
    .with_shard(Shard::WHOLE);
    let stop = AtomicBool::new(false);
    let mut one = 0.0;
    for threads in [1, 2] {
        let mut rate = 0.0_f64;
        let mut bytes = 0;
        for _ in 0..RUNS {
            let folder = tempfile::tempdir()?;
            let start = Instant::now();
            let settings =
                RunSettings { threads, resume: false, stop: &stop, done: &|_| (), found: &|_| () };
            let done = run(folder.path(), &manifest, &sweep, &settings)?;
            rate = rate.max(seeds as f64 / start.elapsed().as_secs_f64());
            bytes = done.summary.iter().flat_map(|s| &s.parts).map(|part| part.bytes).sum();
        }
        println!(
            "{solver} to {format}, {threads} thread(s): {:.3} million seeds/s, {:.1} bytes a seed",
            rate * 1e-6,
            bytes as f64 / seeds as f64
        );
        if threads == 1 {
            one = rate;
        } else {
            println!("efficiency: {:.2} times one thread", rate / one);
        }
    }
    Ok(())
}
