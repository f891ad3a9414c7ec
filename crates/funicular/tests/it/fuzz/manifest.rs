//! Descriptions of a sweep that somebody changed: no folder is joined that is not the one that was
//! written.

use std::path::Path;
use std::sync::atomic::AtomicBool;

use sweep::{Chunk, Manifest, Outcomes, RunSettings};

use super::fuzz;
use super::mutate::mutated;
use crate::run::files;

static NEVER: AtomicBool = AtomicBool::new(false);

/// A finished sweep of five made-up seeds.
fn finished(folder: &Path) -> Manifest {
    let problem = funicular::Problem::case("two-bars").unwrap();
    let prepared =
        funicular::Sweep::new(5).format(funicular::Format::Csv).prepare(&problem).unwrap();
    let outcomes = |solver: &str| Outcomes {
        solver: solver.to_owned(),
        outcome: vec![0; 5],
        iterations: vec![3; 5],
        residual: vec![0.0; 5],
        energy_j: vec![-1.0; 5],
    };
    let compute = |seeds: std::ops::Range<u64>| Chunk {
        seeds,
        outcomes: ["lagrange", "energy"].map(outcomes).into(),
    };
    let (done, found) = (&|_| (), &|_| ());
    let settings = RunSettings { threads: 1, resume: false, stop: &NEVER, done, found };
    sweep::run(folder, prepared.manifest(), &compute, &settings).unwrap();
    prepared.manifest().clone()
}

#[test]
fn descriptions_of_a_sweep() {
    let folder = tempfile::tempdir().unwrap();
    let given = folder.path().join("given");
    let manifest = finished(&given);
    let good = files(&given);
    let examples: Vec<&[u8]> = good.values().map(Vec::as_slice).collect();
    for name in ["manifest.json", "summary.json", "part-000000.csv"] {
        let out = folder.path().join("out");
        fuzz(
            name,
            |random| mutated(random, &good[name], &examples),
            |bytes| {
                std::fs::write(given.join(name), bytes).unwrap();
                let _ = std::fs::remove_dir_all(&out);
                let merged = sweep::merge(std::slice::from_ref(&given), &out, 1, &NEVER, &|_| ());
                match merged {
                    Ok(summary) => {
                        // What was accepted says the same, in whatever form it was written, but for
                        // texts that are for people alone.
                        let read = Manifest::read(&out).unwrap();
                        assert_eq!((read.seeds, &read.solvers), (5, &manifest.solvers));
                        assert_eq!(files(&out)["part-000000.csv"], good["part-000000.csv"]);
                        assert_eq!(summary.unwrap().outcomes.seeds(), 5);
                    }
                    Err(error) => assert!(!error.to_string().is_empty()),
                }
                std::fs::write(given.join(name), &good[name]).unwrap();
            },
        );
    }
}
