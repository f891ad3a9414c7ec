//! Sweeps that were interrupted, and end with the same bytes.

use std::fs;
use std::path::Path;

use crate::made_up::{SEEDS, files, manifest, resume, run, stop_after};
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
    fs::write(out.join(".part-000003.parquet.0123456789ab.part"), "PAR1 and half").unwrap();
    fs::write(out.join(".summary.json.CDEFGHijklmn.part"), "{").unwrap();
    fs::write(out.join(".lock"), "").unwrap();
    resume(&out, &manifest()).unwrap();
    assert_eq!(files(&out), wanted);
    // Killed before the manifest was whole.
    let early = folder.path().join("early");
    fs::create_dir(&early).unwrap();
    fs::write(early.join(".lock"), "").unwrap();
    fs::write(early.join(".manifest.json.0123456789ab.part"), "{").unwrap();
    run(&early, &manifest(), 1).unwrap();
    assert_eq!(files(&early), wanted);
}

#[test]
fn what_is_not_of_the_sweep_stays() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    stop_after(&out, &manifest(), 1);
    let others = [
        ".mine.part", ".notes.csv.0123456789ab.part", ".part-000003.csv.0123456789ab.part",
        ".part-3.parquet.0123456789ab.part",
    ];
    for name in others {
        fs::write(out.join(name), "mine").unwrap();
    }
    resume(&out, &manifest()).unwrap();
    for name in others {
        assert_eq!(fs::read(out.join(name)).unwrap(), b"mine", "{name}");
    }
}

/// Nobody writes into the pipe: opened, it would be waited for without end.
#[cfg(unix)]
#[test]
fn a_pipe_in_the_place_of_a_file_is_told() {
    for name in ["part-000001.parquet", "summary.json", ".digests", ".lock", "manifest.json"] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        stop_after(&out, &manifest(), 2);
        let pipe = out.join(name);
        let _ = fs::remove_file(&pipe);
        let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
        assert!(made.success());
        let (told, heard) = std::sync::mpsc::channel();
        // Not joined: if it waits for the pipe, it waits for ever.
        std::thread::spawn(move || told.send(resume(&out, &manifest()).unwrap_err()));
        let error = heard.recv_timeout(std::time::Duration::from_secs(20));
        let error = error.unwrap_or_else(|_| panic!("{name} is waited for"));
        assert!(matches!(&error, StoreError::NotRegular { path } if *path == pipe), "{error}");
    }
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

/// A bit that turns in a part without harm to its form, and whole parts of other sweeps: in a
/// finished sweep the summary tells, in an unfinished one the list of digests.
#[test]
fn what_is_there_is_trusted_by_its_digest_alone() {
    let folder = tempfile::tempdir().unwrap();
    let other = folder.path().join("other");
    let seed_8 = Manifest { seed_number: 8, ..manifest() };
    run(&other, &seed_8, 1).unwrap();
    let false_rows = folder.path().join("false");
    sweep::run(&false_rows, &manifest(), &crate::made_up::Shifted, &crate::made_up::settings(1))
        .unwrap();
    for format in ["parquet", "csv"] {
        let manifest = Manifest { format: format.to_owned(), ..manifest() };
        let file = format!("part-000000.{format}");
        let out = folder.path().join(format);
        let wanted = {
            run(&out, &manifest, 1).unwrap();
            files(&out)
        };
        for finished in [true, false] {
            for damage in 0..3 {
                if !finished {
                    fs::remove_dir_all(&out).unwrap();
                    stop_after(&out, &manifest, 2);
                    assert!(files(&out).contains_key(".digests"));
                }
                let path = out.join(&file);
                let reason = match damage {
                    0 => {
                        fs::write(&path, with_a_bit_turned(&path, &manifest)).unwrap();
                        "its SHA-256 is "
                    }
                    1 if format == "parquet" => {
                        fs::copy(false_rows.join(&file), &path).unwrap();
                        "its SHA-256 is "
                    }
                    2 if format == "parquet" => {
                        fs::copy(other.join(&file), &path).unwrap();
                        "`funicular.seed_number` at its end is 8, not 7"
                    }
                    _ => continue,
                };
                let run = resume(&out, &manifest).unwrap();
                assert_eq!(run.repaired.len(), 1, "{:?}", run.repaired);
                assert!(run.repaired[0].1.contains(reason), "{:?}", run.repaired);
                assert_eq!(files(&out), wanted);
            }
        }
    }
}

/// The file with a bit turned that its form does not show: the last one.
fn with_a_bit_turned(path: &Path, manifest: &Manifest) -> Vec<u8> {
    let good = fs::read(path).unwrap();
    let format =
        if manifest.format == "csv" { columns::Format::Csv } else { columns::Format::Parquet };
    let decodes = |bytes: &[u8]| {
        fs::write(path, bytes).unwrap();
        columns::read_table(path, format, &sweep::schema(manifest), &mut |_| ()).is_ok()
    };
    (0..good.len())
        .rev()
        .map(|at| {
            let mut bytes = good.clone();
            bytes[at] ^= 1;
            bytes
        })
        .find(|bytes| decodes(bytes))
        .unwrap()
}

#[test]
fn a_list_of_digests_of_another_sweep_or_cut_off_is_no_proof() {
    let folder = tempfile::tempdir().unwrap();
    let wanted = whole(&folder.path().join("whole"));
    let out = folder.path().join("out");
    stop_after(&out, &manifest(), 3);
    let text = fs::read_to_string(out.join(".digests")).unwrap();
    let parts = text.lines().count() - 1;
    assert!(text.lines().next().unwrap().ends_with("  manifest.json") && parts >= 2, "{text}");
    // Its last line is cut off: one part is not trusted.
    fs::write(out.join(".digests"), &text[..text.len() - 30]).unwrap();
    let again = stop_after(&out, &manifest(), 3);
    assert_eq!(again.repaired.len(), 1, "{:?}", again.repaired);
    assert!(again.repaired[0].1.contains("was not written down"), "{:?}", again.repaired);
    // It is of another sweep: none is.
    let text = fs::read_to_string(out.join(".digests")).unwrap();
    fs::write(out.join(".digests"), format!("x{}", &text[1..])).unwrap();
    let last = resume(&out, &manifest()).unwrap();
    assert!(last.repaired.len() >= parts, "{:?}", last.repaired);
    assert_eq!((last.seeds_before, files(&out)), (0, wanted));
}

#[test]
fn a_summary_that_cannot_be_read_is_an_error() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), &manifest(), 1).unwrap();
    fs::write(folder.path().join("summary.json"), "{").unwrap();
    let before = files(folder.path());
    let error = resume(folder.path(), &manifest()).unwrap_err();
    assert!(matches!(error, StoreError::Description { .. }), "{error}");
    assert_eq!(files(folder.path()), before);
}

#[test]
fn other_parameters_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    stop_after(&out, &manifest(), 1);
    let before = files(&out);
    let other = SystemText::from(&(&model::cases::get("ten-equal-bars").unwrap().problem()).into());
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
    let other = good.replace("\"schema_version\": 2", "\"schema_version\": 1");
    for (text, wanted) in [
        ("", "EOF"),
        ("[]", "schema version is missing"),
        (other.as_str(), "schema version is 1, not 2"),
        ("{\"schema_version\": 2}", "missing field"),
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
