//! Shards joined.

use std::fs;
use std::path::{Path, PathBuf};

use crate::made_up::{NEVER, SEEDS, files, manifest, run, stop_after};
use sweep::{Manifest, Shard, StoreError, StoreSummary};

fn shards(folder: &Path, manifest: &Manifest, of: u64) -> Vec<PathBuf> {
    (1..=of)
        .map(|number| {
            let out = folder.join(format!("{number}-of-{of}"));
            run(&out, &manifest.clone().with_shard(Shard { number, of }), 1).unwrap();
            out
        })
        .collect()
}

fn merge(folders: &[PathBuf], out: &Path) -> Result<Option<StoreSummary>, StoreError> {
    sweep::merge(folders, out, 2, &NEVER, &|_| ())
}

fn error(folders: &[PathBuf], out: &Path) -> StoreError {
    let _ = fs::remove_dir_all(out);
    merge(folders, out).unwrap_err()
}

#[test]
fn the_number_of_shards_does_not_show_in_the_bytes() {
    for format in ["parquet", "csv"] {
        let manifest = Manifest { format: format.to_owned(), ..manifest() };
        let folder = tempfile::tempdir().unwrap();
        let whole = folder.path().join("whole");
        run(&whole, &manifest, 2).unwrap();
        for of in [1, 2, 3, 7] {
            let mut shards = shards(folder.path(), &manifest, of);
            shards.reverse();
            let out = folder.path().join(format!("merged-{of}"));
            let summary = merge(&shards, &out).unwrap().unwrap();
            assert_eq!(summary.outcomes.seeds(), SEEDS);
            assert_eq!(files(&out), files(&whole), "{of} shards, {format}");
        }
    }
}

/// Shards of many become shards of few, those that a single run would have written, and these the
/// whole.
#[test]
fn many_shards_are_joined_in_two_steps() {
    let folder = tempfile::tempdir().unwrap();
    let whole = folder.path().join("whole");
    run(&whole, &manifest(), 2).unwrap();
    // Of five parts: some of the twelve shards are empty.
    let shards = shards(folder.path(), &manifest(), 12);
    let mut groups = vec![];
    for number in 1..=3_u64 {
        let shard = Shard { number, of: 3 };
        let out = folder.path().join(format!("group-{number}"));
        let first = usize::try_from(number - 1).unwrap() * 4;
        let group = &shards[first..first + 4];
        sweep::merge_shard(group, &out, shard, 2, &NEVER, &|_| ()).unwrap().unwrap();
        let alone = folder.path().join(format!("alone-{number}"));
        run(&alone, &manifest().with_shard(shard), 1).unwrap();
        assert_eq!(files(&out), files(&alone));
        groups.push(out);
    }
    let out = folder.path().join("out");
    merge(&groups, &out).unwrap().unwrap();
    assert_eq!(files(&out), files(&whole));

    let refused = |folders: &[PathBuf], shard| {
        let out = folder.path().join("refused");
        sweep::merge_shard(folders, &out, shard, 2, &NEVER, &|_| ()).unwrap_err()
    };
    let uneven = refused(&shards, Shard { number: 1, of: 5 });
    assert!(matches!(uneven, StoreError::Uneven { of: 12, .. }), "{uneven}");
    let outside = refused(&shards[3..8], Shard { number: 2, of: 3 });
    assert!(matches!(outside, StoreError::Outside { found: Shard { number: 4, .. }, .. }));
    let missing = refused(&shards[5..8], Shard { number: 2, of: 3 });
    assert_eq!(missing.to_string(), "of 12 shards these are missing: 5");
}

#[test]
fn an_interrupted_merge_is_completed() {
    let folder = tempfile::tempdir().unwrap();
    let shards = shards(folder.path(), &manifest(), 2);
    let out = folder.path().join("out");
    let stop = std::sync::atomic::AtomicBool::new(false);
    let first = sweep::merge(&shards, &out, 1, &stop, &|_| {
        stop.store(true, std::sync::atomic::Ordering::SeqCst);
    });
    assert!(first.unwrap().is_none() && !out.join("summary.json").exists());
    merge(&shards, &out).unwrap().unwrap();
    let whole = folder.path().join("whole");
    run(&whole, &manifest(), 1).unwrap();
    assert_eq!(files(&out), files(&whole));
}

#[test]
fn what_is_missing_or_double_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let shards = shards(folder.path(), &manifest(), 3);
    assert!(matches!(error(&[], &out), StoreError::Nothing));
    let missing = error(&shards[1..2], &out);
    assert_eq!(missing.to_string(), "of 3 shards these are missing: 1, 3");
    let twice = [&shards[..], &shards[1..2]].concat();
    let double = error(&twice, &out);
    assert!(matches!(&double, StoreError::Double { shard: Shard { number: 2, of: 3 }, .. }));
    let other = self::shards(folder.path(), &manifest(), 2);
    let cut = error(&[shards[0].clone(), other[1].clone()], &out);
    assert!(matches!(
        cut,
        StoreError::OtherCut { found: Shard { number: 2, of: 2 }, wanted: 3, .. }
    ));
    assert!(!out.exists());
}

#[test]
fn what_does_not_belong_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let shards = shards(folder.path(), &manifest(), 2);
    let elsewhere = folder.path().join("elsewhere");
    let other = Manifest { seed_number: 8, ..manifest() };
    run(&elsewhere, &other.with_shard(Shard { number: 2, of: 2 }), 1).unwrap();
    let differs = error(&[shards[0].clone(), elsewhere], &out);
    assert!(
        matches!(&differs, StoreError::Differs { key, wanted, found, .. }
            if key == "seed_number" && wanted == "7" && found == "8"),
        "{differs}"
    );
    let unfinished = folder.path().join("unfinished");
    stop_after(&unfinished, &manifest().with_shard(Shard { number: 2, of: 2 }), 1);
    let error_ = error(&[shards[0].clone(), unfinished], &out);
    assert!(matches!(error_, StoreError::Unfinished { .. }), "{error_}");
    let nothing = error(&[shards[0].clone(), folder.path().to_owned()], &out);
    assert!(matches!(nothing, StoreError::NoSweep { missing: "manifest.json", .. }));
    let same = merge(&shards, &shards[0]).unwrap_err();
    assert!(matches!(same, StoreError::SameFolder { .. }), "{same}");
    fs::create_dir(&out).unwrap();
    fs::write(out.join("mine"), "").unwrap();
    assert!(matches!(merge(&shards, &out), Err(StoreError::NotEmpty { .. })));
}

/// The bytes that are copied are those that were proved: what changes in between is no part.
#[test]
fn a_part_that_changes_while_it_is_copied_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let shards = shards(folder.path(), &manifest(), 1);
    let part = shards[0].join("part-000001.parquet");
    let good = fs::read(&part).unwrap();
    let proved = std::sync::atomic::AtomicU64::new(0);
    let done = |seeds| {
        // All are proved, and none is copied.
        if proved.fetch_add(seeds, std::sync::atomic::Ordering::SeqCst) + seeds == SEEDS {
            let mut turned = good.clone();
            turned[good.len() / 2] ^= 1;
            fs::write(&part, turned).unwrap();
        }
    };
    let error = sweep::merge(&shards, &out, 1, &NEVER, &done).unwrap_err();
    assert!(error.to_string().ends_with("it changed while it was being copied"), "{error}");
    assert!(!out.join("part-000001.parquet").exists() && !out.join("summary.json").exists());
}

#[test]
fn damage_is_found() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let shards = shards(folder.path(), &manifest(), 2);
    let part = shards[1].join("part-000003.parquet");
    let good = fs::read(&part).unwrap();

    // One bit in the middle of the numbers: only the digest can tell.
    let mut turned = good.clone();
    turned[good.len() / 2] ^= 1;
    fs::write(&part, &turned).unwrap();
    assert!(error(&shards, &out).to_string().contains("part-000003.parquet"));
    fs::write(&part, &good[..good.len() - 1]).unwrap();
    assert!(matches!(error(&shards, &out), StoreError::Columns(_)));
    // Nothing was copied before all was proved.
    assert_eq!(files(&out).into_keys().collect::<Vec<_>>(), ["manifest.json"]);
    fs::remove_file(&part).unwrap();
    let missing = error(&shards, &out);
    assert!(missing.to_string().ends_with("part-000003.parquet: it is not there"));
    assert!(missing.help().unwrap().contains("computes the part again"), "{:?}", missing.help());
    // Another part's rows under this name.
    fs::copy(shards[1].join("part-000002.parquet"), &part).unwrap();
    assert!(error(&shards, &out).to_string().contains("seed 2048 stands where 3072 should"));
    // A part of another sweep, whole and with the right seeds.
    let other = folder.path().join("other");
    run(&other, &Manifest { seed_number: 8, ..manifest() }, 1).unwrap();
    fs::copy(other.join("part-000003.parquet"), &part).unwrap();
    let told = error(&shards, &out).to_string();
    assert!(told.ends_with("`funicular.seed_number` at its end is 8, not 7"), "{told}");
    // Other rows that say that they are of this one.
    let false_rows = folder.path().join("false");
    sweep::run(&false_rows, &manifest(), &crate::made_up::Shifted, &crate::made_up::settings(1))
        .unwrap();
    fs::copy(false_rows.join("part-000003.parquet"), &part).unwrap();
    assert!(error(&shards, &out).to_string().contains("its SHA-256 is"));
    fs::write(&part, &good).unwrap();

    let summary = shards[0].join("summary.json");
    let text = fs::read_to_string(&summary).unwrap();
    let at = text.find("\"count\": ").unwrap() + 9;
    let changed = format!("{}1{}", &text[..at], &text[at..]);
    fs::write(&summary, changed).unwrap();
    assert!(error(&shards, &out).to_string().contains("outcomes counted are not those"));
    fs::write(&summary, &text).unwrap();

    let manifest = shards[0].join("manifest.json");
    let text = fs::read_to_string(&manifest).unwrap();
    fs::write(&manifest, text.replace("\"end\": 2048", "\"end\": 2047")).unwrap();
    let range = error(&shards, &out);
    assert!(matches!(&range, StoreError::Differs { key, .. } if key == "range.end"), "{range}");
    fs::write(&manifest, text.replace("\"of\": 2", "\"of\": 18446744073709551615")).unwrap();
    assert!(matches!(error(&shards, &out), StoreError::Differs { .. }));
    fs::write(&manifest, text).unwrap();
    assert!(!out.join("summary.json").exists());
    let _ = fs::remove_dir_all(&out);
    merge(&shards, &out).unwrap().unwrap();
}
