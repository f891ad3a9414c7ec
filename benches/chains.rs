//! Chains of any size: the condensed solver and the minimiser, from ten bars to a million.
//!
//! `cargo bench -p benches --bench chains` runs all; `-- pull` what has `pull` in its name. Each
//! size is solved again and again, so a hundred thousand bars stay in the cache and a million do
//! not. `cargo run --profile dist -p benches --bin bars` reads every chain from memory, tells both
//! ratios, and says whether the bars that were set are cleared.

use std::hint::black_box;
use std::num::NonZeroUsize;
use std::time::Duration;

use benches::equal_bars;
use criterion::{
    BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main,
};
use lagrange::condensed::{Condensed, Settings, Solver};

const SIZES: [usize; 4] = [10, 1_000, 100_000, 1_000_000];
/// Sizes for the minimiser.
const ENERGY_SIZES: [usize; 3] = [10, 1_000, 100_000];
/// Sizes that are shared between two processors.
const SHARED_SIZES: [usize; 2] = [100_000, 1_000_000];

/// Flat sampling and a fixed time: a million bars take some ten milliseconds.
fn settle(group: &mut criterion::BenchmarkGroup<'_, criterion::measurement::WallTime>, n: usize) {
    group.throughput(Throughput::Elements(n as u64));
    group.sample_size(20).measurement_time(Duration::from_secs(3));
    group.sampling_mode(if n > 10_000 { SamplingMode::Flat } else { SamplingMode::Auto });
}

/// The pull on the first anchor of a prepared chain: three numbers that say everything.
fn pull(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("lagrange/pull");
    for n in SIZES {
        settle(&mut group, n);
        let chain = Condensed::new(&equal_bars(n));
        let settings = Settings::default();
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| black_box(&chain).pull(&settings));
        });
    }
    group.finish();
}

/// From the bars to all joints, all multipliers, energy and stability, in memory that is used
/// again.
fn solve(criterion: &mut Criterion) {
    let two = NonZeroUsize::MIN.saturating_add(1);
    for (name, processors, sizes) in [
        ("lagrange/all joints and forces", NonZeroUsize::MIN, &SIZES[..]),
        ("lagrange/all joints and forces, two processors", two, &SHARED_SIZES[..]),
    ] {
        let mut group = criterion.benchmark_group(name);
        for n in sizes {
            settle(&mut group, *n);
            let problem = equal_bars(*n);
            let settings = Settings::default();
            let mut solver = Solver::with_processors(processors);
            group.bench_function(BenchmarkId::from_parameter(n), |b| {
                b.iter(|| {
                    let found = solver.solve(black_box(&problem), &settings);
                    found.map(|found| solver.take_back(found))
                });
            });
        }
        group.finish();
    }
}

fn energy(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("energy/all joints and forces");
    for n in ENERGY_SIZES {
        settle(&mut group, n);
        let problem = equal_bars(n);
        let settings = energy::Settings::default();
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| energy::minimise(black_box(&problem), &settings).map(|found| found.work));
        });
    }
    group.finish();
}

criterion_group!(benches, pull, solve, energy);
criterion_main!(benches);
