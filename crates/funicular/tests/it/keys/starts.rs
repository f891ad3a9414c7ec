//! `sweep`, `merge` and `simulate --seeds`: tallies are counted again from the rows.

use std::collections::BTreeMap;
use std::path::Path;

use serde_json::{Value, json};

use super::output::Output;
use super::solve::{DEPTH, LEVEL_V};

use crate::run::{column, good, holding};

/// Seeds of the grid: 8 angles of each bar.
const SEEDS: usize = 64;

/// The sum of a file's bytes as the system's own program has it.
fn sha256(path: &Path) -> String {
    let output = std::process::Command::new("sha256sum").arg(path).output().unwrap();
    String::from_utf8(output.stdout).unwrap().split(' ').next().unwrap().to_owned()
}

/// Wilson's interval of a rate at 95 %: E. B. Wilson, J. Am. Stat. Assoc. 22 (1927) 209-212.
fn wilson(count: f64, all: f64) -> [f64; 2] {
    let z = 1.959_963_984_540_054;
    let (rate, z2) = (count / all, z * z / all);
    let half = z * ((rate * (1.0 - rate) + z2 / 4.0) / all).sqrt();
    [-half, half].map(|half| (rate + z2 / 2.0 + half) / (1.0 + z2))
}

/// Two equilibria, and rows of them for a solver.
struct Rows {
    outcomes: Vec<f64>,
    iterations: Vec<f64>,
}

impl Rows {
    fn of(text: &str, solver: &str) -> Self {
        Self {
            outcomes: column(text, &format!("{solver}_outcome")),
            iterations: column(text, &format!("{solver}_iterations")),
        }
    }

    /// Sorted iterations of the rows of each outcome.
    fn by_outcome(&self) -> Vec<(f64, Vec<f64>)> {
        let mut found = Vec::new();
        for outcome in [0.0, 1.0] {
            let rows = self.outcomes.iter().zip(&self.iterations);
            let mut rows: Vec<f64> =
                rows.filter(|(o, _)| (*o - outcome).abs() < 0.5).map(|(_, i)| *i).collect();
            rows.sort_by(f64::total_cmp);
            if !rows.is_empty() {
                found.push((outcome, rows));
            }
        }
        found
    }

    /// Assert what is said of a solver.
    fn assert(&self, output: &mut Output, solver: &str) {
        let at = |key: &str| format!("solvers.{solver}[].{key}");
        let found = self.by_outcome();
        let all = self.outcomes.len() as f64;
        let counts: Vec<f64> = found.iter().map(|(_, rows)| rows.len() as f64).collect();
        output.is(&at("outcome"), found.iter().map(|(outcome, _)| *outcome).collect::<Vec<_>>());
        let meaning: Vec<String> =
            found.iter().map(|(outcome, _)| format!("equilibrium {}", outcome + 1.0)).collect();
        output.are_at(at, json!({ "meaning": meaning, "count": counts.clone() }));
        let rates: Vec<f64> = counts.iter().map(|count| count / all).collect();
        output.is(&at("rate"), rates);
        let intervals: Vec<[f64; 2]> = counts.iter().map(|count| wilson(*count, all)).collect();
        output.near(&at("rate_95[]"), 1e-9, json!(intervals));
        let most: Vec<f64> = found.iter().map(|(_, rows)| rows[rows.len() - 1]).collect();
        output.is(&at("iterations.max"), most);
        // The lower of the two in the middle.
        let middle: Vec<f64> = found.iter().map(|(_, rows)| rows[(rows.len() - 1) / 2]).collect();
        output.is(&at("iterations.median"), middle);
    }

    /// Assert the tally of a solver in `summary.json`.
    fn assert_tally(&self, output: &mut Output, solver: &str) {
        let at = |key: &str| format!("outcomes.tally.{solver}.*.{key}");
        let found = self.by_outcome();
        output.is(&at("count"), found.iter().map(|(_, rows)| rows.len()).collect::<Vec<_>>());
        // By numbers of iterations as texts, in the order of texts.
        let mut counts = Vec::new();
        for (_, rows) in found {
            let mut by = BTreeMap::<String, usize>::new();
            for i in rows {
                *by.entry(i.to_string()).or_default() += 1;
            }
            counts.extend(by.into_values());
        }
        output.is(&at("iterations.*"), counts);
    }
}

/// The two equilibria of the level V: from the descending vertical bar 1 stands at 30 degrees where
/// it hangs, at 150 where it stands.
fn equilibria(output: &mut Output, angles: bool) {
    output.is("equilibria[].energy_j", json!([-10.0 * DEPTH, 10.0 * DEPTH]));
    output.each("equilibria[].index_in_plane", 0);
    output.each("equilibria[].mirrored", false);
    output.each("equilibria[].origin", "proven");
    output.is("equilibria_complete", true);
    if angles {
        let [low, high] = [std::f64::consts::FRAC_PI_6, 5.0 * std::f64::consts::FRAC_PI_6];
        output.is("equilibria[].angles_rad[]", json!([low, high, high, low]));
    } else {
        let joints = [-DEPTH, DEPTH].map(|z| [0.0, 0.0, 0.0, 0.5, 0.0, z, 1.0, 0.0, 0.0]);
        output.are(json!({ "equilibria[].joints_m[][]": joints, "equilibria[].angles_rad[]": [] }));
        // It hangs, or stands on a line that it may fall off to both sides.
        output.is("equilibria[].index_in_space", json!([0, 1]));
    }
}

/// What a run over so many seeds says of itself.
fn about(output: &mut Output, folder: &str, count: usize, parts: usize) {
    output.are(json!({
        "schema_version": 2, "folder": folder, "parts": parts, "seeds.count": count,
        "seeds.of": count, "seeds.range.start": 0, "seeds.range.end": count, "disagreements[]": [],
        "equilibria_below_j": null,
    }));
}

/// How often both solvers came to the same equilibrium, and how often to different minima.
fn comparisons(lagrange: &Rows, energy: &Rows) -> [usize; 2] {
    let pairs = lagrange.outcomes.iter().zip(&energy.outcomes);
    let same = pairs.filter(|(a, b)| (*a - *b).abs() < 0.5).count();
    [same, lagrange.outcomes.len() - same]
}

fn assert_comparisons(output: &mut Output, lagrange: &Rows, energy: &Rows) {
    let [same, other] = comparisons(lagrange, energy);
    output.are(json!({ "comparisons.same": same, "comparisons.other_basin": other }));
    // No minimum but these two, which nothing in their plane can leave.
    let none = ["energies_differ", "energy_at_no_minimum", "failed", "no_minimum", "not_listed"];
    for none in none.iter().chain(&["unclassified"]) {
        output.is(&format!("comparisons.{none}"), 0);
    }
}

fn sweep(folder: &Path, more: &[&str]) -> String {
    std::fs::write(folder.join("v.toml"), LEVEL_V).unwrap();
    let seeds = SEEDS.to_string();
    let arguments = ["sweep", "v.toml", "--seeds", &seeds, "--source", "grid", "--format", "csv"];
    good(folder, &[&arguments[..], &["--angles", "--json"], more].concat())
}

#[test]
fn a_grid_of_starts() {
    let folder = tempfile::tempdir().unwrap();
    let text = sweep(folder.path(), &["--out", "out"]);
    let rows = std::fs::read_to_string(folder.path().join("out/part-000000.csv")).unwrap();
    let [lagrange, energy] = ["lagrange", "energy"].map(|solver| Rows::of(&rows, solver));
    let mut output = Output::json("sweep", "a_grid_of_starts", &text);
    equilibria(&mut output, true);
    about(&mut output, "out", SEEDS, 1);
    output.is("seeds_before", 0);
    output.within("seconds", 1e-6..=60.0);
    lagrange.assert(&mut output, "lagrange");
    energy.assert(&mut output, "energy");
    assert_comparisons(&mut output, &lagrange, &energy);
    columns_of_a_grid(&rows, &lagrange, &energy);
    summary_of_a_grid(folder.path(), &lagrange, &energy);
    manifest_of_a_grid(folder.path());
}

/// Angles in the middles of eighths of a turn; each end has the energy of its equilibrium.
fn columns_of_a_grid(rows: &str, lagrange: &Rows, energy: &Rows) {
    let mut output = Output::csv("columns of a sweep", "a_grid_of_starts", rows);
    output.is("seed", (0..SEEDS).collect::<Vec<_>>());
    let eighth = std::f64::consts::FRAC_PI_4;
    let angle = |k: usize| (k as f64 + 0.5) * eighth;
    // Both angles stand in one row: the first turns fastest.
    let angles: Vec<[f64; 2]> = (0..SEEDS).map(|k| [angle(k % 8), angle(k / 8)]).collect();
    output.is("theta_#_rad", json!(angles));
    for (solver, rows) in [("lagrange", lagrange), ("energy", energy)] {
        let at = |key: &str| format!("{solver}_{key}");
        output.within(&at("outcome"), 0.0..=1.0);
        output.within(&at("iterations"), 1.0..=1000.0);
        output.within(&at("residual"), 0.0..=1e-10);
        let energies: Vec<f64> =
            rows.outcomes.iter().map(|outcome| (20.0 * outcome - 10.0) * DEPTH).collect();
        output.near(&at("energy_j"), 1e-9, json!(energies));
    }
}

fn summary_of_a_grid(folder: &Path, lagrange: &Rows, energy: &Rows) {
    let text = std::fs::read_to_string(folder.join("out/summary.json")).unwrap();
    let mut output = Output::json("summary.json of a sweep", "a_grid_of_starts", &text);
    output.are(json!({ "schema_version": 2, "outcomes.tally.seeds": SEEDS }));
    lagrange.assert_tally(&mut output, "lagrange");
    energy.assert_tally(&mut output, "energy");
    let both = |a: f64, b: f64| {
        let pairs = lagrange.outcomes.iter().zip(&energy.outcomes);
        pairs.filter(|(x, y)| (*x - a).abs() + (*y - b).abs() < 0.5).count()
    };
    let pairs = [both(0.0, 0.0), both(0.0, 1.0), both(1.0, 0.0), both(1.0, 1.0)];
    output.is("outcomes.tally.both.*.*", pairs.as_slice());
    one_part(&mut output, folder, SEEDS, comparisons(lagrange, energy));
    // The bits of 40 J: weight times length.
    output.are(json!({ "outcomes.index[]": [0, 0], "outcomes.scale": 40.0_f64.to_bits() }));
}

/// What a summary says of its one part, and of ends that are the same by both solvers and that are not.
fn one_part(output: &mut Output, folder: &Path, seeds: usize, [same, other]: [usize; 2]) {
    let part = folder.join("out/part-000000.csv");
    output.are(json!({
        "outcomes.comparisons[]": [same, 0, other, 0, 0, 0, 0, 0], "outcomes.disagreements[]": [],
        "parts[].file": "part-000000.csv", "parts[].seeds.start": 0, "parts[].seeds.end": seeds,
        "parts[].bytes": std::fs::metadata(&part).unwrap().len(), "parts[].sha256": sha256(&part),
    }));
}

fn manifest_of_a_grid(folder: &Path) {
    let text = std::fs::read_to_string(folder.join("out/manifest.json")).unwrap();
    let mut output = Output::json("manifest.json of a sweep", "a_grid_of_starts", &text);
    manifest(&mut output, folder, &text, SEEDS);
    equilibria(&mut output, true);
    output.is("solvers[]", json!(["lagrange", "energy"]));
    output.is("angles[]", json!(["theta_1_rad", "theta_2_rad"]));
    output.is("source", "grid");
}

/// What every manifest says.
fn manifest(output: &mut Output, folder: &Path, text: &str, seeds: usize) {
    output.is("schema_version", 2);
    output.is("program", format!("funicular {}", env!("CARGO_PKG_VERSION")));
    output.is("system.name", "level V");
    output.says("system.text", json!(["length_m = 1.0\nmass_kg = 1.0\ncount = 2\n"]));
    let parsed: Value = serde_json::from_str(text).unwrap();
    let copy = folder.join("copy.toml");
    std::fs::write(&copy, parsed["system"]["text"].as_str().unwrap()).unwrap();
    output.are(json!({
        "system.sha256": sha256(&copy), "system.unit_j": 40.0, "seeds": seeds, "seed_number": 1,
        "format": "csv",
        // README: parts of 1024 seeds.
        "part_seeds": 1024, "shard.number": 1, "shard.of": 1, "range.start": 0, "range.end": seeds,
    }));
}

/// Bars of one mass over equal distances hang on a parabola: where the tangents of their angles grow
/// by 0.1, bar by bar, from -0.85 to 0.85. Eighteen are too many for a census, and the only minimum
/// is what every seed reaches.
#[test]
fn eighteen_on_a_parabola() {
    let tangents: Vec<f64> = (0..18).map(|k| 0.1 * f64::from(k) - 0.85).collect();
    let bars: Vec<String> = tangents
        .iter()
        .map(|t| format!("{{ length_m = {}, mass_kg = 1 }}", t.hypot(1.0)))
        .collect();
    let text = format!(
        "gravity_m_s2 = 10\nanchors = {{ start_m = [0, 0, 0], end_m = [18, 0, 0] }}\nbars = [{}]\n",
        bars.join(", ")
    );
    let folder = holding([("p.toml", text)]);
    let arguments = ["sweep", "p.toml", "--seeds", "20", "--solver", "energy", "--format", "csv"];
    good(&folder, &[&arguments[..], &["--out", "out"]].concat());
    let text = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let kind = "summary.json of a list that grows";
    let mut output = Output::json(kind, "eighteen_on_a_parabola", &text);
    // Heights of the joints are sums of tangents, those of the centres are between.
    let mut heights = vec![0.0];
    for t in &tangents {
        heights.push(heights[heights.len() - 1] + t);
    }
    let energy_j: f64 = heights.windows(2).map(|z| 10.0 * 0.5 * (z[0] + z[1])).sum();
    let at = |key: &str| format!("discovered.equilibria[].{key}");
    output.near(&at("energy_j"), 1e-8, json!([energy_j]));
    let angles: Vec<f64> =
        tangents.iter().map(|t| std::f64::consts::FRAC_PI_2 + t.atan()).collect();
    output.near(&at("angles_rad[]"), 1e-7, json!(angles));
    output.are_at(at, json!({ "index_in_plane": 0, "mirrored": false, "origin": "discovered" }));
    output.is("discovered.below_j", json!(null));
    output.is("schema_version", 2);
    output.is("outcomes.tally.seeds", 20);
    output.is("outcomes.tally.energy.*.count", 20);
    let rows = std::fs::read_to_string(folder.path().join("out/part-000000.csv")).unwrap();
    let energy = Rows::of(&rows, "energy");
    assert!(energy.outcomes.iter().all(|outcome| *outcome == 0.0));
    output.within("outcomes.tally.energy.*.iterations.*", 1.0..=20.0);
    for none in ["lagrange", "both"] {
        output.is(&format!("outcomes.tally.{none}"), json!(null));
    }
    one_part(&mut output, folder.path(), 20, [0, 0]);
    output.is("outcomes.index[]", 0);
    let lengths: f64 = tangents.iter().map(|t| t.hypot(1.0)).sum();
    let scale = f64::from_bits(
        serde_json::from_str::<Value>(&text).unwrap()["outcomes"]["scale"].as_u64().unwrap(),
    );
    assert!((scale - 180.0 * lengths).abs() < 1e-9);
    output.within("outcomes.scale", 0.0..=f64::MAX);
}

/// Two halves joined say what the whole says.
#[test]
fn halves_joined() {
    let seeds = ["--seeds", "2048"];
    let folder = holding([("v.toml", LEVEL_V)]);
    let sweep = |shard: &str, out: &str| {
        let more = ["--format", "csv", "--shard", shard, "--out", out];
        good(&folder, &[&["sweep", "v.toml"], &seeds[..], &more].concat());
    };
    sweep("1/2", "one");
    sweep("2/2", "two");
    let text = good(&folder, &["merge", "two", "one", "--out", "all", "--json"]);
    let rows = ["part-000000.csv", "part-000001.csv"]
        .map(|part| std::fs::read_to_string(folder.path().join("all").join(part)).unwrap());
    let second = rows[1].split_once('\n').unwrap().1;
    let rows = format!("{}{second}", rows[0]);
    let [lagrange, energy] = ["lagrange", "energy"].map(|solver| Rows::of(&rows, solver));
    let mut output = Output::json("merge", "halves_joined", &text);
    equilibria(&mut output, true);
    about(&mut output, "all", 2048, 2);
    lagrange.assert(&mut output, "lagrange");
    energy.assert(&mut output, "energy");
    assert_comparisons(&mut output, &lagrange, &energy);
}

/// Released with damping all come to rest where they hang: nothing rests standing.
#[test]
fn releases() {
    let folder = holding([("v.toml", LEVEL_V)]);
    let arguments = ["simulate", "v.toml", "--seeds", "20", "--damping", "3", "--time", "20"];
    let more = ["--step", "0.02", "--format", "csv", "--json", "--out", "out"];
    let text = good(&folder, &[&arguments[..], &more].concat());
    let rows = std::fs::read_to_string(folder.path().join("out/part-000000.csv")).unwrap();
    let motion = Rows::of(&rows, "motion");
    let mut output = Output::json("simulate --seeds", "releases", &text);
    equilibria(&mut output, false);
    about(&mut output, "out", 20, 1);
    output.is("seeds_before", 0);
    output.within("seconds", 1e-6..=60.0);
    motion.assert(&mut output, "motion");
    let mut output = Output::csv("columns of releases", "releases", &rows);
    output.is("seed", (0..20).collect::<Vec<_>>());
    output.each("motion_outcome", 0);
    // Looked at four times a step; it swings for seconds, at most 20 s.
    output.within("motion_iterations", 10.0..=250.0);
    output.within("motion_residual", 0.0..=1e-7);
    let rest = json!(vec![-10.0 * DEPTH; 20]);
    output.near("motion_energy_j", 1e-9, rest);
    let text = std::fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let mut output = Output::json("summary.json of releases", "releases", &text);
    output.are(json!({ "schema_version": 2, "outcomes.tally.seeds": 20 }));
    motion.assert_tally(&mut output, "motion");
    for none in ["lagrange", "energy", "both"] {
        output.is(&format!("outcomes.tally.{none}"), json!(null));
    }
    one_part(&mut output, folder.path(), 20, [0, 0]);
    output.are(json!({ "outcomes.index[]": [0, 1], "outcomes.scale": 40.0_f64.to_bits() }));
    let text = std::fs::read_to_string(folder.path().join("out/manifest.json")).unwrap();
    let mut output = Output::json("manifest.json of releases", "releases", &text);
    manifest(&mut output, folder.path(), &text, 20);
    equilibria(&mut output, false);
    output.are(json!({
        "solvers[]": "motion", "angles[]": [], "source": "released", "release.time_s": 20.0,
        "release.step_s": 0.02,
        // Four steps.
        "release.span_s": 0.08, "release.damping_1_s": 3.0, "release.friction_n_m_s": 0.0,
        "release.order": 2, "release.rest": 1e-7,
    }));
}
