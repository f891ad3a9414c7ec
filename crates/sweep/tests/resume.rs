//! Sweeps that were interrupted, and end with the same bytes.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

mod store_common;

use std::fs;
use std::path::Path;

use store_common::{SEEDS, files, manifest, resume, run, stop_after};
use sweep::{Manifest, Shard, StoreError, SystemText};

fn whole(folder: &Path) -> std::collections::BTreeMap<String, Vec<u8>> {
    run(folder, &manifest(), 2).unwrap();
    files(folder)
}

#[test]
fn an_interruption_does_not_show_in_the_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let wanted = whole(&folder.path().join("whole"));
    let out = folder.path().join("out");
    let first = stop_after(&out, &manifest(), 2);
    assert!(first.summary.is_none() && !out.join("summary.json").exists());
    assert!(first.seeds > 0 && first.seeds < SEEDS && first.seeds_before == 0, "{first:?}");
    assert!(files(&out).keys().all(|name| !name.starts_with(".part")));
    let second = stop_after(&out, &manifest(), 4);
    assert_eq!(second.seeds_before, first.seeds);
    let last = resume(&out, &manifest()).unwrap();
    assert_eq!(last.seeds, SEEDS);
    assert_eq!(files(&out), wanted);
    // Once more: everything is there.
    let again = resume(&out, &manifest()).unwrap();
    assert_eq!((again.seeds_before, again.repaired.len()), (SEEDS, 0));
    assert_eq!(files(&out), wanted);
}

#[test]
fn what_a_killed_process_leaves_is_cleared() {
    let folder = tempfile::tempdir().unwrap();
    let wanted = whole(&folder.path().join("whole"));
    let out = folder.path().join("out");
    stop_after(&out, &manifest(), 1);
    fs::write(out.join(".part-000003.parquet.123.part"), "PAR1 and half").unwrap();
    fs::write(out.join(".summary.json.123.part"), "{").unwrap();
    fs::write(out.join(".lock"), "").unwrap();
    resume(&out, &manifest()).unwrap();
    assert_eq!(files(&out), wanted);
    // Killed before the manifest was whole.
    let early = folder.path().join("early");
    fs::create_dir(&early).unwrap();
    fs::write(early.join(".lock"), "").unwrap();
    fs::write(early.join(".manifest.json.99.part"), "{").unwrap();
    run(&early, &manifest(), 1).unwrap();
    assert_eq!(files(&early), wanted);
}

#[test]
fn damaged_parts_are_computed_again_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let wanted = whole(&folder.path().join("whole"));
    let out = folder.path().join("out");
    run(&out, &manifest(), 1).unwrap();
    let (one, two, three) = (
        out.join("part-000001.parquet"),
        out.join("part-000002.parquet"),
        out.join("part-000003.parquet"),
    );
    let bytes = fs::read(&one).unwrap();
    fs::write(&one, &bytes[..bytes.len() / 2]).unwrap();
    fs::copy(&three, &two).unwrap();
    fs::remove_file(&three).unwrap();
    let run = resume(&out, &manifest()).unwrap();
    let told: Vec<_> = run.repaired.iter().map(|(file, _)| file.as_str()).collect();
    assert_eq!(told, ["part-000001.parquet", "part-000002.parquet"]);
    assert!(run.repaired[1].1.contains("seed 3072 stands where 2048 should"), "{:?}", run.repaired);
    assert_eq!(run.seeds_before, SEEDS - 3 * 1024);
    assert_eq!(files(&out), wanted);
}

#[test]
fn other_parameters_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    stop_after(&out, &manifest(), 1);
    let before = files(&out);
    let other = SystemText::of(model::cases::get("ten-equal-bars").unwrap().problem().chain());
    let m = manifest;
    let cases = [
        ("seed_number", Manifest { seed_number: 8, ..m() }),
        ("source", Manifest { source: "sobol".to_owned(), ..m() }),
        ("solvers", Manifest { solvers: vec!["lagrange".to_owned()], ..m() }),
        ("angles", Manifest { angles: Vec::new(), ..m() }),
        ("format", Manifest { format: "csv".to_owned(), ..m() }),
        ("program", Manifest { program: "funicular 1".to_owned(), ..m() }),
        ("system.name", Manifest { system: other, ..m() }),
        ("range.end", m().with_shard(Shard { number: 1, of: 2 })),
        ("range.end", Manifest { seeds: SEEDS + 1, ..m() }.with_shard(Shard::WHOLE)),
        ("equilibria", Manifest { equilibria: Vec::new(), ..m() }),
    ];
    for (wanted, manifest) in cases {
        let error = resume(&out, &manifest).unwrap_err();
        assert!(matches!(&error, StoreError::Differs { key, .. } if key == wanted), "{error}");
        let mut after = files(&out);
        after.remove(".lock");
        let mut before = before.clone();
        before.remove(".lock");
        assert_eq!(after, before);
    }
}

#[test]
fn a_broken_manifest_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    stop_after(&out, &manifest(), 1);
    let path = out.join("manifest.json");
    let good = fs::read_to_string(&path).unwrap();
    let newer = good.replace("\"schema_version\": 1", "\"schema_version\": 2");
    for (text, wanted) in [
        ("", "EOF"),
        ("[]", "schema version is none"),
        (newer.as_str(), "schema version is 2, not 1"),
        ("{\"schema_version\": 1}", "missing field"),
        (&good[..good.len() / 2], "EOF"),
    ] {
        fs::write(&path, text).unwrap();
        let error = resume(&out, &manifest()).unwrap_err();
        assert!(matches!(error, StoreError::Description { .. }), "{error}");
        assert!(error.to_string().contains(wanted), "{error}");
    }
    fs::write(&path, [0xff, 0xfe]).unwrap();
    let error = resume(&out, &manifest()).unwrap_err();
    assert!(error.to_string().contains("not UTF-8"), "{error}");
}

/// A whole and well-formed part, with an outcome that no list has.
#[test]
fn an_outcome_of_no_list_is_noticed() {
    let folder = tempfile::tempdir().unwrap();
    let manifest = Manifest { format: "csv".to_owned(), ..manifest() };
    run(folder.path(), &manifest, 1).unwrap();
    let wanted = files(folder.path());
    let path = folder.path().join("part-000004.csv");
    let text = fs::read_to_string(&path).unwrap();
    let mut cells: Vec<_> = text.lines().last().unwrap().split(',').collect();
    cells[3] = "2";
    let head = text.lines().next().unwrap();
    fs::write(&path, format!("{head}\n{}\n", cells.join(","))).unwrap();
    let run = resume(folder.path(), &manifest).unwrap();
    assert!(run.repaired[0].1.ends_with("there is no outcome 2"), "{:?}", run.repaired);
    assert_eq!(files(folder.path()), wanted);
}
