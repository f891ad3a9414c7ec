//! A made-up sweep: what the store does with rows does not depend on what they mean.

use std::collections::BTreeMap;
use std::fs;
use std::ops::Range;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use sweep::{
    Chunk, Compute, Manifest, Member, Origin, Outcomes, Run, RunSettings, SCHEMA_VERSION, Shard,
    StoreError, SystemText,
};

/// Seeds of the made-up sweep: five parts, the last one of a single seed.
pub const SEEDS: u64 = 4 * 1024 + 1;

fn member(energy_j: f64) -> Member {
    let angles_rad = vec![Some(1.0 / 3.0), None];
    let origin = Origin::Discovered;
    Member {
        origin,
        energy_j,
        angles_rad,
        index_in_plane: Some(0),
        index_in_space: None,
        mirrored: false,
        joints_m: None,
    }
}

pub fn manifest() -> Manifest {
    Manifest {
        schema_version: SCHEMA_VERSION,
        program: "funicular 0".to_owned(),
        system: SystemText::from(&(&model::cases::paper()).into()),
        seeds: SEEDS,
        seed_number: 7,
        source: "uniform".to_owned(),
        solvers: vec!["lagrange".to_owned(), "energy".to_owned()],
        release: None,
        angles: vec!["theta_1_rad".to_owned(), "theta_2_rad".to_owned()],
        equilibria: vec![member(0.1 + 0.2), member(-1.0e-300)],
        equilibria_complete: true,
        format: "parquet".to_owned(),
        part_seeds: 0,
        shard: Shard::WHOLE,
        range: 0..0,
    }
    .with_shard(Shard::WHOLE)
}

/// Numbers that a hash gives: reproducible, and of no order.
pub struct MadeUp {
    pub delay: std::time::Duration,
}

pub fn hash(seed: u64) -> u64 {
    let mut x = seed.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

#[expect(clippy::cast_precision_loss, reason = "any double will do")]
fn double(seed: u64) -> f64 {
    match seed % 97 {
        0 => f64::NAN,
        1 => f64::INFINITY,
        _ => hash(seed) as f64 * 1e-19,
    }
}

fn outcomes(solver: &str, seeds: Range<u64>, salt: u64) -> Outcomes {
    let pick = |seed: u64, among: u64| u16::try_from(hash(seed ^ salt) % among).unwrap_or(0);
    Outcomes {
        solver: solver.to_owned(),
        outcome: seeds.clone().map(|s| pick(s, 6).cast_signed() - 4).collect(),
        iterations: seeds.clone().map(|s| pick(s + 1, 40)).collect(),
        residual: seeds.clone().map(|s| double(s ^ salt)).collect(),
        energy_j: seeds.map(|s| -double(s ^ salt)).collect(),
    }
}

fn both(seeds: Range<u64>, salts: [u64; 2]) -> Chunk {
    let named = ["lagrange", "energy"].into_iter().zip(salts);
    let outcomes = named.map(|(solver, salt)| outcomes(solver, seeds.clone(), salt)).collect();
    Chunk { seeds, outcomes }
}

impl Compute for MadeUp {
    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        std::thread::sleep(self.delay);
        both(seeds, [1 << 40, 1 << 41])
    }

    fn angles(&self, seeds: Range<u64>) -> Vec<Vec<f64>> {
        [3, 5].map(|salt| seeds.clone().map(|s| double(s ^ salt << 30)).collect()).into()
    }
}

/// The same seeds with other numbers.
pub struct Shifted;

impl Compute for Shifted {
    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        both(seeds, [1, 2])
    }

    fn angles(&self, seeds: Range<u64>) -> Vec<Vec<f64>> {
        QUICK.angles(seeds)
    }
}

pub const QUICK: MadeUp = MadeUp { delay: std::time::Duration::ZERO };
pub static NEVER: AtomicBool = AtomicBool::new(false);

pub fn settings(threads: usize) -> RunSettings<'static> {
    RunSettings { threads, resume: false, stop: &NEVER, done: &|_| (), found: &|_| () }
}

pub fn run(folder: &Path, manifest: &Manifest, threads: usize) -> Result<Run, StoreError> {
    sweep::run(folder, manifest, &QUICK, &settings(threads))
}

pub fn resume(folder: &Path, manifest: &Manifest) -> Result<Run, StoreError> {
    sweep::run(folder, manifest, &QUICK, &RunSettings { resume: true, ..settings(2) })
}

/// Run until about `parts` parts are there, then stop as Ctrl-C does.
pub fn stop_after(folder: &Path, manifest: &Manifest, parts: u64) -> Run {
    let stop = AtomicBool::new(false);
    let seeds = std::sync::atomic::AtomicU64::new(0);
    let done = |count: u64| {
        if seeds.fetch_add(count, Ordering::SeqCst) + count > parts * manifest.part_seeds {
            stop.store(true, Ordering::SeqCst);
        }
    };
    let settings = RunSettings { resume: true, stop: &stop, done: &done, ..settings(1) };
    sweep::run(folder, manifest, &QUICK, &settings).unwrap()
}

/// All files of a folder with their bytes.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    fs::read_dir(folder)
        .unwrap()
        .map(|entry| {
            let entry = entry.unwrap();
            (entry.file_name().into_string().unwrap(), fs::read(entry.path()).unwrap())
        })
        .collect()
}
