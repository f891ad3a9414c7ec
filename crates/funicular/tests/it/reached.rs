//! Sweeps of chains without a census: their lists grow with the seeds, and the folder is the same to
//! the last byte however it came about.

use std::fs;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering};

use crate::run::files;
use funicular::{Format, PreparedSweep, Problem, Sweep};
use model::{Anchors, Bar, Chain};
use sweep::{Run, RunSettings, Shard};

/// Four parts, the last of one seed.
const SEEDS: u64 = 3 * 1024 + 1;

static NEVER: AtomicBool = AtomicBool::new(false);

fn problem(bars: usize) -> Problem {
    let bar = |k: usize| Bar::homogeneous(0.5 + 0.1 * (k % 3) as f64, 1.0).unwrap();
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.52 * bars as f64, 0.0, 0.1] };
    let chain = Chain::new("long", 9.81, anchors, (0..bars).map(bar).collect()).unwrap();
    Problem::from(model::Problem::new(chain).unwrap())
}

/// A row of equal bars between joints by name.
fn by_joints(bars: usize) -> Problem {
    let text = format!(
        "joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [{}, 0, 0.1] }} }}\n\
         bars = [{{ from = \"A\", to = \"B\", length_m = 0.6, mass_kg = 1, count = {bars} }}]\n",
        0.52 * bars as f64
    );
    Problem::parse(&text, "row.toml").unwrap()
}

fn prepared(problem: &Problem, format: Format, shard: Shard) -> PreparedSweep {
    Sweep::new(SEEDS).format(format).shard(shard).prepare(problem).unwrap()
}

fn settings(threads: usize) -> RunSettings<'static> {
    RunSettings { threads, resume: false, stop: &NEVER, done: &|_| (), found: &|_| () }
}

/// Stop as Ctrl-C does, when so many seeds are computed.
fn stopped(sweep: &PreparedSweep, out: &Path, after: u64, threads: usize) -> Run {
    let (stop, seeds) = (AtomicBool::new(false), AtomicU64::new(0));
    let done = |count: u64| {
        if seeds.fetch_add(count, Ordering::SeqCst) + count >= after {
            stop.store(true, Ordering::SeqCst);
        }
    };
    let settings = RunSettings { resume: true, stop: &stop, done: &done, ..settings(threads) };
    sweep.write(out, &settings).unwrap()
}

fn resumed(sweep: &PreparedSweep, out: &Path) -> Run {
    sweep.write(out, &RunSettings { resume: true, ..settings(2) }).unwrap()
}

#[test]
fn how_a_growing_list_came_about_does_not_show() {
    for (format, problem) in [(Format::Parquet, problem(18)), (Format::Csv, by_joints(18))] {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let sweep = prepared(&problem, format, Shard::WHOLE);
        assert!(!sweep.manifest().equilibria_complete && sweep.manifest().equilibria.is_empty());
        let found = AtomicUsize::new(0);
        let grown = |count: usize| {
            // Told from several threads, in any order.
            found.fetch_max(count, Ordering::SeqCst);
        };
        let run = sweep.write(&at("one"), &RunSettings { found: &grown, ..settings(1) }).unwrap();
        let summary = run.summary.unwrap();
        let list = summary.discovered.as_ref().unwrap();
        assert!(list.below_j.is_none() || list.equilibria.len() > 900);
        assert!(found.into_inner() >= list.equilibria.len() && list.equilibria.len() > 20);
        assert!(!summary.check_failed(sweep.manifest()));
        let wanted = files(&at("one"));
        let extension = if format == Format::Csv { "csv" } else { "parquet" };
        let mut names = vec!["manifest.json".to_owned()];
        names.extend((0..4).map(|part| format!("part-00000{part}.{extension}")));
        names.push("summary.json".to_owned());
        assert_eq!(wanted.keys().cloned().collect::<Vec<_>>(), names);

        sweep.write(&at("four"), &settings(4)).unwrap();
        assert_eq!(files(&at("four")), wanted, "four threads");

        // Within the parts, between them, and before their last numbers.
        let cut = at("cut");
        for (after, least) in [(500, 0), (1500, 1024), (SEEDS, SEEDS)] {
            let run = stopped(&sweep, &cut, after, 1);
            assert!(run.summary.is_none() && run.seeds >= least, "{run:?}");
            assert!(!cut.join("summary.json").exists());
        }
        assert!(files(&cut).contains_key("reached-000002.json"));
        let last = resumed(&sweep, &cut);
        assert_eq!((last.seeds_before, last.repaired.len()), (SEEDS, 0));
        assert_eq!(files(&cut), wanted, "interrupted");

        let shards: Vec<_> = (1..=3)
            .map(|number| {
                let out = at(&format!("{number}-of-3"));
                let shard = prepared(&problem, format, Shard { number, of: 3 });
                shard.write(&out, &settings(2)).unwrap();
                out
            })
            .collect();
        sweep::merge(&shards, &at("merged"), 2, &NEVER, &|_| ()).unwrap().unwrap();
        assert_eq!(files(&at("merged")), wanted, "shards");
    }
}

/// Where a list has lost entries to lower ones, too.
#[test]
fn a_list_that_is_full_is_the_same_list() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let problem = Problem::case("thirty-bars").unwrap();
    let of = |shard| Sweep::new(2 * 1024 + 5).shard(shard).prepare(&problem).unwrap();
    let sweep = of(Shard::WHOLE);
    let run = sweep.write(&at("one"), &settings(1)).unwrap();
    let list = run.summary.unwrap().discovered.unwrap();
    assert!(list.below_j.is_some() && list.equilibria.len() <= sweep::DISCOVERED);
    sweep.write(&at("two"), &settings(2)).unwrap();
    let wanted = files(&at("one"));
    assert_eq!(files(&at("two")), wanted);
    let shards: Vec<_> = [1, 2]
        .into_iter()
        .map(|number| {
            let out = at(&number.to_string());
            of(Shard { number, of: 2 }).write(&out, &settings(2)).unwrap();
            out
        })
        .collect();
    sweep::merge(&shards, &at("merged"), 1, &NEVER, &|_| ()).unwrap().unwrap();
    assert_eq!(files(&at("merged")), wanted);
}

/// What is damaged is computed again, before the sweep is finished and after.
#[test]
fn damaged_files_of_a_growing_list_are_made_again() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let sweep = prepared(&problem(18), Format::Parquet, Shard::WHOLE);
    sweep.write(&at("one"), &settings(2)).unwrap();
    let wanted = files(&at("one"));
    let cut = at("cut");
    let damage = |file: &str| {
        let mut bytes = fs::read(cut.join(file)).unwrap();
        let middle = bytes.len() / 2;
        bytes[middle] ^= 1;
        fs::write(cut.join(file), bytes).unwrap();
    };
    stopped(&sweep, &cut, SEEDS, 2);
    damage("reached-000000.parquet");
    damage("reached-000001.json");
    fs::remove_file(cut.join("reached-000002.json")).unwrap();
    let run = resumed(&sweep, &cut);
    let told: Vec<_> = run.repaired.iter().map(|(file, _)| file.as_str()).collect();
    assert_eq!(told, ["reached-000000.parquet", "reached-000001.json"]);
    assert_eq!((run.seeds_before, files(&cut)), (1, wanted.clone()));
    damage("part-000001.parquet");
    let run = resumed(&sweep, &cut);
    assert_eq!(run.repaired[0].0, "part-000001.parquet");
    assert_eq!((run.seeds_before, files(&cut)), (SEEDS - 1024, wanted));
}
