//! `funicular sweep` and `funicular merge` as their users meet them.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Output, Stdio};

use crate::run::{
    Running, fails, files, first_line, folder, funicular, good, limited, program, refused, says,
    wait_until, words,
};
use serde_json::{Value, json};

/// Starts of most tests: four parts of 1024, in about a second.
const SEEDS: &str = "4e3";

fn sweep(out: &Path, more: &[&str]) -> Output {
    let out = out.to_str().unwrap();
    funicular(
        &[&["sweep", "--case", "three-equal-bars", "--seeds", SEEDS, "--out", out], more].concat(),
    )
}

/// Start a longer sweep on one thread, and wait until some of its parts are there.
fn started(out: &Path) -> Running {
    let arguments = long(out, &["--threads=1"]);
    let mut command = program(".", &arguments);
    let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
    let running = Running(child);
    wait_until("no part appears", || out.join("part-000001.parquet").exists());
    running
}

fn long<'a>(out: &'a Path, more: &[&'a str]) -> Vec<&'a str> {
    let end = ["--out", out.to_str().unwrap()];
    LONG.split(' ').chain(more.iter().copied()).chain(end).collect()
}

const LONG: &str = "sweep --case three-equal-bars --seeds 200_000 --solver lagrange --angles";

#[test]
fn the_tables_and_the_object_say_the_same() {
    let out = folder("tables");
    let output = sweep(&out.join("a"), &[]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let text = String::from_utf8(output.stdout).unwrap();
    says(
        &text,
        &[
            "4000 uniform seeds, seed number 1", "equilibrium 1 ", "95 % interval",
            "energy (index: directions of the plane",
        ],
    );
    assert_eq!(sweep(&out.join("b"), &["--json"]).status.code(), Some(0));
    assert_eq!(files(&out.join("a")), files(&out.join("b")));
}

/// Bars of 5 m and 1 m just bridge their gap and bear nothing: what seeds reach is one equilibrium,
/// known to the cube root of their residual, and another with the first bar upright.
#[test]
fn a_degenerate_point_is_listed_once() {
    let out = folder("just-bridged");
    fs::create_dir_all(&out).unwrap();
    let bars = "{ length_m = 1, mass_kg = 3, centre_m = 1 }, \
                { length_m = 5, mass_kg = 2, centre_m = 0 }, { length_m = 1, mass_kg = 0 }";
    let text =
        format!("anchors = {{ start_m = [0, 0, 0], end_m = [6, 0, -1] }}\nbars = [{bars}]\n");
    let file = out.join("file.toml");
    fs::write(&file, text).unwrap();
    good(".", &["solve", file.to_str().unwrap()]);
    let swept = out.join("swept");
    let arguments =
        ["sweep", file.to_str().unwrap(), "--seeds=500", "--out", swept.to_str().unwrap()];
    assert_eq!(funicular(&arguments).status.code(), Some(0));
    let object = |name: &str| -> Value {
        serde_json::from_slice(&fs::read(swept.join(name)).unwrap()).unwrap()
    };
    let energies: Vec<f64> = [&object("manifest.json"), &object("summary.json")["discovered"]]
        .iter()
        .flat_map(|of| of["equilibria"].as_array().unwrap().clone())
        .map(|equilibrium| equilibrium["energy_j"].as_f64().unwrap())
        .collect();
    // All weight, 5 kg, at the end of the first bar, and that down.
    let hanging = energies.iter().filter(|energy| (*energy + 5.0 * 9.80665).abs() < 1e-6);
    assert_eq!((hanging.count(), energies.len()), (1, 2), "{energies:?}");
}

/// Thirty bars are too many for a census: what the seeds reach is the list, as far as it goes.
#[test]
fn a_list_that_ends_is_no_check_that_failed() {
    let out = folder("gaps").join("out");
    let name = out.to_str().unwrap();
    let text = good(".", &["sweep", "--case", "thirty-bars", "--seeds=2000", "--out", name]);
    let wanted = ["equilibria in the list, the lowest of those reached: none from "];
    for wanted in wanted.iter().chain(&["unknown: the list ends below", "not listed"]) {
        assert!(text.contains(wanted), "{wanted} is not in\n{text}");
    }
    assert!(!text.contains(" NO ") && !text.contains("\nseed "), "{text}");
    assert!(files(&out)["summary.json"].len() < 3_000_000);
}

/// A thousand bars and ten seeds: no list is made before, and every seed has its number.
#[test]
fn ten_seeds_of_a_thousand_bars() {
    let out = folder("thousand");
    let text = "anchors = { start_m = [0, 0, 0], end_m = [440, 0, 0] }\n\
                bars = [{ length_m = 0.5, mass_kg = 1, count = 1000 }]\n";
    fs::write(out.join("long.toml"), text).unwrap();
    let name = out.join("out");
    let file = out.join("long.toml");
    let arguments = ["sweep", file.to_str().unwrap(), "--seeds=10", "--solver=energy", "--json"];
    let output = funicular(&[&arguments[..], &["--out", name.to_str().unwrap()]].concat());
    let object: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&object["equilibria_below_j"], &object["comparisons"]), (&Value::Null, &json!({})));
    let rows = object["solvers"]["energy"].as_array().unwrap();
    let counts: Vec<_> = rows.iter().map(|row| (&row["outcome"], &row["count"])).collect();
    assert_eq!(counts, [(&json!(0), &json!(10))]);
}

/// Solvers that contradict each other, made up: whatever reads their rows ends with 1.
#[test]
fn solvers_that_contradict_each_other_are_a_check_that_failed() {
    use ::sweep::{Chunk, Outcomes};
    const WRONG: u64 = 1234;
    let out = folder("contradiction");
    let problem = funicular::Problem::case("three-equal-bars").unwrap();
    let prepared = funicular::Sweep::new(2000).prepare(&problem).unwrap();
    let manifest = prepared.manifest();
    let least = &manifest.equilibria[0];
    assert_eq!(least.index_in_plane, Some(0));
    let top = manifest.equilibria.iter().position(|one| one.index_in_plane > Some(0)).unwrap();
    let top = i16::try_from(top).unwrap();
    let stop = std::sync::atomic::AtomicBool::new(false);
    let (stop, done, found) = (&stop, &|_| (), &|_| ());
    let settings = ::sweep::RunSettings { threads: 1, resume: false, stop, done, found };
    // What `energy` says of one seed: its outcome, and its energy above that of `lagrange`.
    for (name, (outcome, above_j), code) in [
        ("agreed", (0, 0.0), 0),
        ("failed", (-2, 0.0), 0),
        ("energies", (0, 1e-6), 1),
        ("no-minimum", (top, 0.0), 1),
        ("unlisted", (-4, 0.0), 1),
    ] {
        let compute = |seeds: std::ops::Range<u64>| {
            let rows = usize::try_from(seeds.end - seeds.start).unwrap();
            let mut both = ["lagrange", "energy"].map(|solver| Outcomes {
                solver: solver.to_owned(),
                outcome: vec![0; rows],
                iterations: vec![5; rows],
                residual: vec![1e-15; rows],
                energy_j: vec![least.energy_j; rows],
            });
            if seeds.contains(&WRONG) {
                let row = usize::try_from(WRONG - seeds.start).unwrap();
                both[1].outcome[row] = outcome;
                both[1].energy_j[row] += above_j;
            }
            Chunk { seeds, outcomes: both.into() }
        };
        let shard = out.join(name);
        ::sweep::run(&shard, manifest, &compute, &settings).unwrap();
        let merged = out.join(format!("{name}-merged"));
        let output =
            funicular(&["merge", shard.to_str().unwrap(), "--out", merged.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(code), "{name}: {}", words(&output));
        let text = String::from_utf8(output.stdout).unwrap();
        assert_eq!(text.contains("seed 1234: "), code == 1, "{name}: {text}");
    }
}

/// Thousands of bars take their time for every start.
#[test]
fn sweeps_and_basins_of_long_chains_say_so_before_they_begin() {
    let out = folder("long");
    let text = "[anchors]\nstart_m = [0, 0, 0]\nend_m = [1800, 0, 0]\n\n[[bars]]\nlength_m = 1\n\
                mass_kg = 1\ncount = 4_000\n";
    fs::write(out.join("long.toml"), text).unwrap();
    let line = first_line(&out, &["sweep", "long.toml", "--seeds", "5_000", "--out", "s"]);
    assert!(line.contains("this sweep: about ") && line.contains(" of one processor"), "{line}");
    let line = first_line(&out, &["basins", "long.toml", "--size", "40", "--out", "b"]);
    assert!(line.contains("these pictures: about "), "{line}");
    // A trillion: files and bytes, too.
    let many = ["sweep", "--case", "two-bars", "--seeds", "1e12", "--out", "m"];
    let line = first_line(&out, &many);
    assert!(line.contains("this sweep: about ") && line.contains("days"), "{line}");
    let one =
        ["sweep", "--case", "two-bars", "--seeds", "1e12", "--shard", "7/100000", "--out", "o"];
    let mut running = program(&out, &one);
    running.stdout(Stdio::null()).stderr(Stdio::null());
    let running = Running(running.spawn().unwrap());
    wait_until("it does not begin", || out.join("o/manifest.json").exists());
    drop(running);
    let manifest: Value =
        serde_json::from_slice(&fs::read(out.join("o/manifest.json")).unwrap()).unwrap();
    assert_eq!(manifest["part_seeds"], 1 << 24);
}

#[test]
fn an_empty_shard_says_that_it_is() {
    let out = folder("empty");
    // Ten seeds are one part; it is in the last of the shards.
    let shard = |k: u32| {
        let (name, shard) = (out.join(k.to_string()), format!("--shard={k}/3"));
        let name = name.to_str().unwrap();
        funicular(&["sweep", "--case", "three-equal-bars", "--seeds=10", &shard, "--out", name])
    };
    for k in [1, 3] {
        let output = shard(k);
        assert_eq!(output.status.code(), Some(0), "{}", words(&output));
        let text = String::from_utf8(output.stdout).unwrap();
        assert_eq!(text.contains("This shard is empty"), k == 1, "{text}");
        assert!(!text.contains("there already"), "{text}");
    }
}

#[test]
fn a_killed_sweep_goes_on_to_the_same_bytes() {
    let out = folder("killed");
    let whole = out.join("whole");
    assert_eq!(funicular(&long(&whole, &[])).status.code(), Some(0));
    let cut = out.join("cut");
    let mut running = started(&cut);
    // SIGKILL: nothing can be tidied up.
    running.0.kill().unwrap();
    running.0.wait().unwrap();
    assert!(!cut.join("summary.json").exists(), "it had finished: too few seeds for this machine");
    fails(&funicular(&long(&cut, &[])), 2, "holds a sweep already");
    let other = funicular(&long(&cut, &["--resume", "--seed=2"]));
    fails(&other, 2, "`seed_number` is 1, not 2");
    let output = funicular(&long(&cut, &["--resume", "--json"]));
    let object = crate::run::json(&output);
    assert!(object["seeds_before"].as_u64().unwrap() > 0);
    assert_eq!(files(&cut), files(&whole));
}

#[cfg(unix)]
#[test]
fn an_interrupted_sweep_says_how_to_go_on() {
    let out = folder("interrupted");
    for signal in ["INT", "TERM"] {
        let cut = out.join(signal);
        let mut running = started(&cut);
        running.signal(signal);
        let mut text = String::new();
        let mut pipe = running.0.stderr.take().unwrap();
        std::io::Read::read_to_string(&mut pipe, &mut text).unwrap();
        assert_eq!(running.code(), Some(130), "{text}");
        assert!(text.contains("--resume") && text.contains(" of 200000 seeds"), "{text}");
        assert!(files(&cut).keys().all(|name| !name.starts_with(".part")));
        good(".", &long(&cut, &["--resume"]));
    }
    assert_eq!(files(&out.join("INT")), files(&out.join("TERM")));
}

#[test]
fn bad_usage_is_refused_with_a_reason() {
    let out = folder("usage");
    let new = out.join("new");
    let case = ["sweep", "--out", new.to_str().unwrap(), "--case", "three-equal-bars"];
    let table: [(&[&str], _); 4] = [
        (&["--seeds", "0"], "a whole number from 1"),
        (&["--seeds", "-5"], "a whole number from 1"),
        (&["--seeds", "1e20"], "a whole number from 1"),
        (&["--seeds", SEEDS, "--spread", "grid"], "15^3 and 4096 = 16^3"),
    ];
    refused(".", &case, &table);
    let table: [(&[&str], _); 7] = [
        (&["--shard", "0/3"], "there is no shard 0 of 3"),
        (&["--shard", "4/3"], "there is no shard 4 of 3"),
        (&["--shard", "1"], "a shard is K/N"),
        (&["--threads", "-1"], "--threads"),
        (&["--threads", "9999999"], "a whole number up to"),
        (&["--spread", "random"], "possible values: uniform, sobol, grid"),
        (&["--format", "xml"], "possible values: parquet, csv"),
    ];
    refused(".", &[&case[..], &["--seeds", SEEDS]].concat(), &table);
    let nonsense = ["--seeds", SEEDS, "--case", "nonsense"];
    refused(".", &case[..3], &[(&nonsense, "there is no case named `nonsense`")]);
    assert!(!new.exists());
    let output = funicular(&["sweep", "--seeds", "10", "--out", new.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));

    fs::write(out.join("mine"), "").unwrap();
    for resume in [&[][..], &["--resume"]] {
        fails(&sweep(&out, resume), 2, "is not empty and holds no sweep: there is `mine`");
    }
    let output = sweep(&out.join("mine"), &[]);
    assert_eq!(output.status.code(), Some(2), "{}", words(&output));
    let output = funicular(&["merge", out.to_str().unwrap(), "--out", new.to_str().unwrap()]);
    assert!(words(&output).contains("holds no sweep: there is no manifest.json"));
}

/// A disk that takes nothing: the limit of file sizes stands for a full one.
#[cfg(unix)]
#[test]
fn a_disk_that_fails_is_no_bad_input() {
    let out = folder("full").join("out");
    // Blocks of 512 bytes in `sh`: enough for the manifest, too little for a part.
    let seeds = ["sweep", "--case", "three-equal-bars", "--seeds", SEEDS, "--resume", "--out"];
    let arguments = [&seeds[..], &[out.to_str().unwrap()]].concat();
    let output = limited(Path::new("."), "ulimit -f 16; trap '' XFSZ", &arguments);
    fails(&output, 3, "--resume");
    let output = sweep(&out, &["--resume"]);
    assert_eq!(output.status.code(), Some(0), "{}", words(&output));
    let whole = folder("full-whole").join("out");
    sweep(&whole, &[]);
    assert_eq!(files(&out), files(&whole));
}

/// Sweeps of systems that are no chain: what is counted of the seeds, by solver and energy.
fn counts(case: &str, seeds: &str) -> (Value, BTreeMap<String, Vec<(f64, u64)>>) {
    let out = folder(&format!("system-{case}"));
    let path = out.to_str().unwrap();
    let output = funicular(&["sweep", "--case", case, "--seeds", seeds, "--out", path, "--json"]);
    let object = crate::run::json(&output);
    let list = object["equilibria"].as_array().unwrap();
    let of = |row: &Value| {
        let place = usize::try_from(row["outcome"].as_i64().unwrap()).ok()?;
        Some((list[place]["energy_j"].as_f64().unwrap(), row["count"].as_u64().unwrap()))
    };
    let solver = |name: &str| {
        let rows = object["solvers"][name].as_array().unwrap().iter();
        (name.to_owned(), rows.filter_map(of).collect())
    };
    let counts = ["lagrange", "energy"].map(solver).into();
    (object, counts)
}

/// Legs of 3 m with feet 1.8 m from the axis: the 30 kg hang, or stand, 2.4 m from the feet. Every
/// start in space leads to one or the other, and the census proves that there is no third.
#[test]
fn a_sweep_of_a_tripod_finds_it_hanging_and_standing() {
    let (object, counts) = counts("tripod", "100");
    let high_j = 30.0 * model::STANDARD_GRAVITY_M_S2 * 2.4;
    assert_eq!(object["equilibria_complete"], json!(true));
    for (solver, found) in counts {
        let [(low, a), (high, b)] = found[..] else { panic!("{solver}: {found:?}") };
        assert!((low + high_j).abs() < 1e-9 * high_j && (high - high_j).abs() < 1e-9 * high_j);
        assert!(a + b == 100 && a > 20 && b > 20, "{solver}: {found:?}");
    }
    assert_eq!(object["system"]["joints"], json!(4));
}

/// A trapezium of 1 m, 1 m, 1 m below 2.2 m, with 8 kg in all at 0.8 m and 0.6 m below the coupler:
/// it hangs, stands, or lies crossed. `energy` finds the hanging one alone, `lagrange` all.
#[test]
fn a_sweep_of_a_linkage_finds_what_is_no_minimum_by_forces_alone() {
    let (object, counts) = counts("four-bar-linkage", "100");
    let [lagrange, energy] = ["lagrange", "energy"].map(|name| &counts[name]);
    // 2 kg at 0.8 m and 6 kg at 0.8 m + 0.6 m below the cranks' feet.
    let depth_j = model::STANDARD_GRAVITY_M_S2 * (2.0 * 0.8 + 6.0 * 1.4);
    assert!(energy.len() == 1 && energy[0].1 == 100 && (energy[0].0 + depth_j).abs() < 1e-9);
    assert!(lagrange.len() >= 4, "{lagrange:?}");
    let falls: Vec<_> = object["equilibria"].as_array().unwrap().iter().collect();
    assert_eq!(falls[0]["index_in_space"], json!(0));
    assert_eq!(falls[falls.len() - 1]["index_in_space"], json!(4));
}

/// Self-stressed and nearly weightless: energies are compared in the prestress, not in the weight.
#[test]
fn a_sweep_of_a_tensegrity_holds_its_energies_against_its_prestress() {
    let (object, _) = counts("x-cross", "60");
    assert!(object["comparisons"]["same"].as_u64().unwrap() > 5, "{}", object["comparisons"]);
    assert_eq!(object["comparisons"]["energies_differ"], json!(0));
}

#[test]
fn what_is_for_angles_is_refused_for_places() {
    let out = folder("system-refused");
    for more in [&["--spread", "sobol"][..], &["--angles"]] {
        let arguments = ["sweep", "--case", "lamp", "--seeds", "10", "--out"];
        let output = funicular(&[&arguments[..], &[out.to_str().unwrap()], more].concat());
        fails(&output, 2, "is for chains between two anchors");
    }
    assert_eq!(fs::read_dir(&out).unwrap().count(), 0);
}

#[test]
fn basins_of_a_system_are_over_the_place_of_a_joint() {
    let out = folder("system-basins");
    let path = out.to_str().unwrap();
    good(".", &["basins", "--case", "tripod", "--size", "12", "--out", path]);
    let svg = fs::read_to_string(out.join("energy.svg")).unwrap();
    says(
        &svg,
        &["start of joint top: x / m", "start of joint top: z / m", "1: -706.0788 J, minimum"],
    );
    let refused = funicular(&["basins", "--case", "tripod", "--joint", "A", "--out", path]);
    fails(&refused, 2, "not a joint that can move");
}
