//! A sweep on disk: the same bytes always, and nothing overwritten.

use std::fs;
use std::ops::Range;

use crate::made_up::{MadeUp, QUICK, SEEDS, files, manifest, run, settings};
use columns::{Data, Format, read_table};
use sweep::{Chunk, Compute, Manifest, Outcomes, Shard, StoreError, StoreSummary};

#[test]
fn threads_do_not_show_in_the_bytes() {
    for format in ["parquet", "csv"] {
        let manifest = Manifest { format: format.to_owned(), ..manifest() };
        let folder = tempfile::tempdir().unwrap();
        let (one, two) = (folder.path().join("one"), folder.path().join("deep/two"));
        run(&one, &manifest, 1).unwrap();
        run(&two, &manifest, 2).unwrap();
        let files = files(&one);
        assert_eq!(files, crate::made_up::files(&two));
        let names: Vec<_> = files.keys().cloned().collect();
        let mut wanted = vec!["manifest.json".to_owned()];
        wanted.extend((0..5).map(|part| format!("part-00000{part}.{format}")));
        wanted.push("summary.json".to_owned());
        assert_eq!(names, wanted);
    }
}

#[test]
fn the_rows_are_those_that_were_computed() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = manifest();
    run(folder.path(), &manifest, 2).unwrap();
    let schema = sweep::schema(&manifest);
    let names: Vec<_> = schema.columns.iter().map(|column| column.name.as_str()).collect();
    let wanted = "seed theta_1_rad theta_2_rad lagrange_outcome lagrange_iterations lagrange_residual \
                  lagrange_energy_j energy_outcome energy_iterations energy_residual energy_energy_j";
    assert_eq!(names.join(" "), wanted);
    let mut all: Vec<Data> = schema.columns.iter().map(|c| Data::empty(c.kind)).collect();
    for part in 0..5 {
        let path = folder.path().join(format!("part-00000{part}.parquet"));
        read_table(&path, Format::Parquet, &schema, &mut |columns| {
            for (all, columns) in all.iter_mut().zip(columns) {
                all.append(&mut columns.clone());
            }
        })
        .unwrap();
    }
    let chunk = QUICK.chunk(0..SEEDS);
    let (lagrange, energy) = (chunk.of("lagrange").unwrap(), chunk.of("energy").unwrap());
    let bits = |data: &Data| match data {
        Data::F64(cells) => cells.iter().map(|x| x.to_bits()).collect::<Vec<_>>(),
        _ => panic!("doubles"),
    };
    let doubles = |cells: &[f64]| cells.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    assert_eq!(all[0], Data::U64((0..SEEDS).collect()));
    assert_eq!(bits(&all[2]), doubles(&QUICK.angles(0..SEEDS)[1]));
    assert_eq!(all[3], Data::I16(lagrange.outcome.clone()));
    assert_eq!(all[4], Data::U16(lagrange.iterations.clone()));
    assert_eq!(bits(&all[6]), doubles(&lagrange.energy_j));
    assert_eq!(all[7], Data::I16(energy.outcome.clone()));
    assert_eq!(bits(&all[9]), doubles(&energy.residual));

    let summary: StoreSummary =
        serde_json::from_str(&fs::read_to_string(folder.path().join("summary.json")).unwrap())
            .unwrap();
    assert_eq!(summary.outcomes.seeds(), SEEDS);
    for code in -4..2_i16 {
        let wanted = lagrange.outcome.iter().filter(|outcome| **outcome == code).count();
        assert_eq!(summary.outcomes.tally().of("lagrange").unwrap().0[&code].count, wanted as u64);
        let wanted = lagrange
            .outcome
            .iter()
            .zip(&energy.outcome)
            .filter(|pair| *pair == (&code, &0))
            .count();
        assert_eq!(summary.outcomes.tally().both.as_ref().unwrap()[&code][&0], wanted as u64);
    }
}

#[test]
fn nothing_is_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    run(&out, &manifest(), 1).unwrap();
    let before = files(&out);
    let error = run(&out, &manifest(), 1).unwrap_err();
    assert!(matches!(error, StoreError::Present { .. }));
    assert!(error.help().unwrap().contains("--resume"));
    assert_eq!(files(&out), before);

    let thesis = folder.path().join("thesis");
    fs::create_dir(&thesis).unwrap();
    fs::write(thesis.join("chapter-1.tex"), "text").unwrap();
    for result in [run(&thesis, &manifest(), 1), crate::made_up::resume(&thesis, &manifest())] {
        let error = result.unwrap_err();
        assert!(matches!(&error, StoreError::NotEmpty { found, .. } if found == "chapter-1.tex"));
    }
    assert_eq!(files(&thesis).len(), 1);

    let error = run(&thesis.join("chapter-1.tex"), &manifest(), 1).unwrap_err();
    assert!(matches!(error, StoreError::File { .. }), "{error}");
    let none = Manifest { seeds: 0, ..manifest() };
    assert!(matches!(run(&folder.path().join("none"), &none, 1), Err(StoreError::NoSeeds)));
}

#[test]
fn a_folder_that_is_being_written_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let slow = MadeUp { delay: std::time::Duration::from_millis(100) };
    std::thread::scope(|scope| {
        let first = scope.spawn(|| sweep::run(folder.path(), &manifest(), &slow, &settings(1)));
        while !folder.path().join("part-000000.parquet").exists() {
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        let error = crate::made_up::resume(folder.path(), &manifest()).unwrap_err();
        assert!(matches!(error, StoreError::Busy { .. }), "{error}");
        assert!(first.join().unwrap().unwrap().summary.is_some());
    });
}

/// Rows that say whose they are.
struct Marked(u64);

impl Compute for Marked {
    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        QUICK.chunk(seeds)
    }

    fn angles(&self, seeds: Range<u64>) -> Vec<Vec<f64>> {
        vec![seeds.map(|_| self.0 as f64).collect(); 2]
    }
}

/// Every round three different sweeps go for one new folder: one gets it, the others are told why
/// not, and nothing of them is in it.
#[test]
fn of_sweeps_that_race_for_a_folder_one_gets_it() {
    const ROUNDS: usize = 60;
    let folder = tempfile::tempdir().unwrap();
    let sweep_of = |seed_number| {
        Manifest { seed_number, seeds: 10, format: "csv".to_owned(), ..manifest() }
            .with_shard(Shard::WHOLE)
    };
    for round in 0..ROUNDS {
        let out = folder.path().join(round.to_string());
        let start = std::sync::Barrier::new(3);
        let results: Vec<_> = std::thread::scope(|scope| {
            let go = |number: u64| {
                let (out, start) = (&out, &start);
                scope.spawn(move || {
                    start.wait();
                    sweep::run(out, &sweep_of(number), &Marked(number), &settings(1))
                })
            };
            [1, 2, 3].map(go).map(|thread| thread.join().unwrap()).into()
        });
        let first = results.iter().position(Result::is_ok).unwrap();
        for (k, result) in results.iter().enumerate().filter(|(k, _)| *k != first) {
            let told = matches!(result, Err(StoreError::Present { .. } | StoreError::Busy { .. }));
            assert!(told, "round {round}, sweep {k}: {result:?}");
        }
        assert_eq!(Manifest::read(&out).unwrap().seed_number, first as u64 + 1);
        let rows = fs::read_to_string(out.join("part-000000.csv")).unwrap();
        let mark = format!("{:?}", (first + 1) as f64);
        assert!(rows.lines().skip(1).all(|row| row.split(',').nth(1) == Some(&mark)), "{rows}");
    }
}

#[test]
fn an_incomplete_answer_of_a_solver_is_an_error() {
    let short = |seeds: Range<u64>| {
        let solver = |name: &str| Outcomes { solver: name.to_owned(), ..Outcomes::default() };
        Chunk { seeds, outcomes: ["lagrange", "energy"].map(solver).into() }
    };
    let folder = tempfile::tempdir().unwrap();
    let manifest = Manifest { angles: Vec::new(), ..manifest() };
    let error = sweep::run(folder.path(), &manifest, &short, &settings(2)).unwrap_err();
    assert!(matches!(error, StoreError::Part { .. }), "{error}");
    assert_eq!(files(folder.path()).keys().collect::<Vec<_>>(), [".digests", "manifest.json"]);
}

/// The manifest is not written: nothing is promised that cannot be kept.
#[test]
fn more_seeds_than_a_summary_can_list_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = Manifest { seeds: 10_000_000_000_000, ..manifest() };
    let manifest = manifest.with_shard(Shard { number: 1, of: 596_047 });
    let out = folder.path().join("out");
    let error = run(&out, &manifest, 1).unwrap_err();
    assert!(matches!(error, StoreError::TooManySeeds { parts: 596_047, .. }), "{error}");
    assert!(error.help().is_some() && !out.exists());
}

#[test]
fn a_shard_has_exactly_its_part() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    run(&whole, &manifest(), 1).unwrap();
    let whole = files(&whole);
    let mut parts = 0;
    for number in 1..=3 {
        let out = folder.path().join(number.to_string());
        let result =
            run(&out, &manifest().with_shard(Shard { number, of: 3 }), 2).unwrap().summary.unwrap();
        for record in &result.parts {
            assert_eq!(files(&out)[&record.file], whole[&record.file]);
            parts += 1;
        }
    }
    assert_eq!(parts, 5);
}
