//! One solve of each crate, seed to answer, and one evaluation of the full system.
//!
//! `cargo bench -p benches` runs all; `cargo bench -p benches -- seeds` what has `seeds` in its
//! name.

use std::f64::consts::PI;
use std::hint::black_box;

use benches::equal_bars;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lagrange::{Seed, Solver};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SIZES: [usize; 3] = [3, 10, 30];

/// Seeds of one run of the throughput benches.
const SEEDS: usize = 1_000;

/// The 30 equations in 30 unknowns of the paper's example, from a seed near E1 to the root.
fn full_system(criterion: &mut Criterion) {
    let problem = model::cases::paper();
    let settings = lagrange::Settings::default();
    let mut solver = Solver::new(&problem, &settings).expect("default settings");
    let seed = Seed::planar(&[0.3, 0.7, -1.3]);
    criterion.bench_function("lagrange/paper, 30 unknowns, near E1", |b| {
        b.iter(|| solver.solve(black_box(&seed)).map(|found| found.residual()));
    });
    let mut group = criterion.benchmark_group("lagrange/random spatial seeds");
    group.throughput(Throughput::Elements(SEEDS as u64)).sample_size(10);
    let seeds: Vec<Seed> = (0..SEEDS as u64)
        .map(|k| {
            let mut random = ChaCha8Rng::seed_from_u64(1);
            random.set_stream(k);
            Seed::spatial(
                (0..3).map(|_| std::array::from_fn(|_| random.random_range(-PI..PI))).collect(),
            )
        })
        .collect();
    group.bench_function("paper", |b| {
        b.iter(|| seeds.iter().filter(|seed| solver.solve(seed).is_ok()).count());
    });
    group.finish();
}

fn hanging(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("hanging equilibrium, no guess");
    for n in SIZES {
        let problem = equal_bars(n);
        let settings = lagrange::Settings::default();
        let mut solver = Solver::new(&problem, &settings).expect("default settings");
        group.bench_function(BenchmarkId::new("lagrange", n), |b| {
            b.iter(|| solver.solve_stable().map(|found| found.residual()));
        });
        let settings = energy::Settings::default();
        group.bench_function(BenchmarkId::new("energy", n), |b| {
            b.iter(|| energy::minimise(black_box(&problem), &settings).map(|found| found.work));
        });
    }
    group.finish();
}

/// The paper's two unknowns, theta and alpha, through argmin.
fn example(criterion: &mut Criterion) {
    let settings = energy::Settings::default();
    let mut group = criterion.benchmark_group("energy/theta and alpha, argmin");
    for (name, theta, alpha) in [("near E1", 0.3, 0.7), ("far", 2.0, -2.5)] {
        group.bench_function(name, |b| {
            b.iter(|| energy::example::minimise(black_box(theta), black_box(alpha), &settings));
        });
    }
    group.finish();
}

fn residual_and_jacobian(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("lagrange/residual and Jacobian of the full system");
    for n in SIZES {
        let problem = equal_bars(n);
        let found =
            lagrange::solve(&problem, &lagrange::Settings::default()).expect("a slack chain");
        let chain = problem.chain();
        group.bench_function(BenchmarkId::from_parameter(n), |b| {
            b.iter(|| {
                let residual = lagrange::residual(chain, black_box(&found.q), &found.lambda);
                (residual, lagrange::jacobian(chain, &found.q, &found.lambda))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, full_system, hanging, example, residual_and_jacobian);
criterion_main!(benches);
