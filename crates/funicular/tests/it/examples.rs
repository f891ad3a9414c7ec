//! The examples, run as their readers run them.

use std::path::{Path, PathBuf};
use std::process::Command;

/// The examples that the tests below run.
const RUN: &str =
    "batch census derivatives judge modes simulate solve study sweep third_solver trace";

/// Standard output and standard error of an example.
fn run(name: &str) -> (String, String) {
    assert!(RUN.split(' ').any(|run| run == name), "{name}");
    let tests = std::env::current_exe().unwrap();
    let folder = tests.parent().and_then(Path::parent).unwrap();
    // What these tests are built with builds the examples too, except `--test it` by itself. A package by itself is built with other
    // features of all that it depends on than with the workspace around it.
    if !fresh(&folder.join("examples").join(name)) {
        let build = ["build", "--quiet", "--locked", "-p", "funicular", "--example", name];
        let built = Command::new(env!("CARGO")).args(build).output().unwrap();
        assert!(built.status.success(), "{name}: {}", String::from_utf8_lossy(&built.stderr));
    }
    let output = Command::new(folder.join("examples").join(name)).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let (stdout, stderr) = (text(output.stdout), text(output.stderr));
    assert!(output.status.success(), "{name}: {stderr}");
    (stdout, stderr)
}

/// Whether a program is newer than all that it was compiled from, as the list beside it has it.
fn fresh(program: &Path) -> bool {
    let changed = |path: &Path| std::fs::metadata(path).and_then(|file| file.modified()).ok();
    let built = changed(program);
    let sources = std::fs::read_to_string(program.with_extension("d")).unwrap_or_default();
    let Some((_, sources)) = sources.trim().split_once(": ") else { return false };
    // A space in a name is escaped.
    let sources = sources.replace("\\ ", "\0");
    let older = |source: &str| changed(Path::new(&source.replace('\0', " "))) <= built;
    built.is_some() && sources.split(' ').all(older)
}

/// The cells of a table of comma-separated values, without its head.
fn rows(csv: &str) -> Vec<Vec<&str>> {
    csv.lines().skip(1).map(|line| line.split(',').collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap()
}

#[test]
fn examples_are_short_and_all_of_them_are_run() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let mut names = vec![];
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let lines = std::fs::read_to_string(&path).unwrap().lines().count();
        assert!(lines <= 40, "{} has {lines} lines", path.display());
        names.push(path.file_stem().unwrap().to_str().unwrap().to_owned());
    }
    names.sort_unstable();
    assert_eq!(names.join(" "), RUN, "each is run by a test below");
}

#[test]
fn solve() {
    let (csv, said) = run("solve");
    let rows = rows(&csv);
    // Two solvers, six joints.
    assert_eq!(rows.len(), 12);
    for (lagrange, energy) in rows[..6].iter().zip(&rows[6..]) {
        assert_eq!([lagrange[0], energy[0]], ["lagrange", "energy"]);
        for (a, b) in lagrange[2..8].iter().zip(&energy[2..8]) {
            assert!((number(a) - number(b)).abs() < 1e-12, "{a} {b}");
        }
    }
    // The anchors carry the weight, 3.4 kg.
    let weight_n = number(rows[0][7]) + number(rows[5][7]);
    assert!((weight_n - 3.4 * 9.80665).abs() < 1e-12, "{weight_n}");
    assert!(said.ends_with("agreed: true\n"), "{said}");
}

#[test]
fn judge() {
    let (text, _) = run("judge");
    assert!(text.starts_with("refuted: "), "{text}");
    assert!(text.contains("member 1 (A - lamp): its joints are 5.008"), "{text}");
    assert!(text.contains("up to 0.01 m away, at joint lamp"), "{text}");
}

#[test]
fn census() {
    let (text, _) = run("census");
    assert!(text.starts_with("2 equilibria, complete: true\n"), "{text}");
    assert_eq!(text.lines().count(), 3);
    assert!(
        text.lines().nth(1).unwrap().contains(" 0 directions in which the energy falls"),
        "{text}"
    );
}

/// The pull (W/2) a/h of half the span a at the depth h grows by W l²/(4 h³) with the span, and the
/// depth by l/(2 h) with a bar.
#[test]
fn derivatives() {
    let (text, _) = run("derivatives");
    let told = |line: &str| {
        let found = text.lines().find_map(|l| l.strip_prefix(line)).unwrap();
        number(found.trim_end_matches(" N/m"))
    };
    let stiffness = told("force at B by place of B, along x: ");
    assert!((stiffness - 8.0 * 25.0 / (4.0 * 64.0)).abs() < 1e-6, "{text}");
    assert!((told("height of P by bars.1.length_m: ") + 5.0 / 8.0).abs() < 1e-6, "{text}");
}

/// The horizontal pull of a chain of ten bars that is nearly straight is that of a string with the
/// same weight: w L / (8 d) for small sag d.
#[test]
fn batch() {
    let (csv, said) = run("batch");
    assert_eq!(said, "1000 of 1000 agree\n");
    let rows = rows(&csv);
    assert_eq!(rows.len(), 1000);
    let pulls: Vec<f64> = rows.iter().map(|row| number(row[1])).collect();
    assert!(pulls.windows(2).all(|pair| pair[0] < pair[1]), "the pull grows with the span");
    let [span_m, pull_n, sag_m] = [0, 1, 2].map(|k| number(rows[999][k]));
    let string_n = 10.0 * 0.2 * 9.80665 * span_m / (8.0 * sag_m);
    assert!((pull_n / string_n - 1.0).abs() < 0.02, "{pull_n} {string_n}");
}

#[test]
fn third_solver() {
    let (text, _) = run("third_solver");
    assert!(text.starts_with("agreed: to "), "{text}");
}

#[test]
fn sweep() {
    let (csv, _) = run("sweep");
    let rows = rows(&csv);
    let starts = |solver: &str| -> u64 {
        rows.iter().filter(|row| row[0] == solver).map(|row| row[3].parse::<u64>().unwrap()).sum()
    };
    assert_eq!([starts("lagrange"), starts("energy")], [10_000, 10_000]);
    // E1 and E2 of the paper, from the height of joint 0.
    let lagrange: Vec<f64> =
        rows.iter().filter(|row| row[0] == "lagrange").map(|row| number(row[2])).collect();
    assert_eq!(lagrange.len(), 4);
    assert!((lagrange[0] / 9.80665 + 3.664_531_348_000_695).abs() < 1e-12);
    assert!((lagrange[3] / 9.80665 + 2.335_468_651_999_305).abs() < 1e-12);
}

#[test]
fn trace() {
    let (text, _) = run("trace");
    assert!(text.ends_with("every census between agrees: true\n"), "{text}");
    // The chain is straight where the anchors are as far apart as its bars reach.
    assert!(text.contains("straight at x = 2.500000000 m"), "{text}");
}

#[test]
fn study() {
    let (text, _) = run("study");
    assert!(text.ends_with("both solvers agree everywhere: true\n"), "{text}");
    let rows = rows(&text);
    // By the triangles 3, 4, 5 and 4, 3, 5: the middle joint carries 20 N.
    for (row, sag, half) in [(&rows[0], 0.8, 0.6), (&rows[1], 0.6, 0.8)] {
        assert!((row[1].parse::<f64>().unwrap() - sag).abs() < 1e-6, "{text}");
        assert!((row[2].parse::<f64>().unwrap() - 10.0 * half / sag).abs() < 1e-6, "{text}");
    }
    // Out of reach.
    assert_eq!(&rows[3][..2], &["2.2", ""], "{text}");
}

#[test]
fn modes() {
    let (text, _) = run("modes");
    assert!(text.ends_with("signs and indices agree: true\n"), "{text}");
    // Two circles of equilibria, each with its mirror image, and three modes each.
    assert_eq!(text.matches("omega^2").count(), 12);
    assert_eq!(text.matches("turn about the vertical").count(), 4);
    assert_eq!(text.matches("leaves the equilibrium").count(), 4);
}

#[test]
fn simulate() {
    let (csv, said) = run("simulate");
    let last = rows(&csv).pop().unwrap().iter().map(|cell| number(cell)).collect::<Vec<_>>();
    assert!((last[0] - 30.0).abs() < 1e-9 && last[1] < 1e-20, "{last:?}");
    let off = said.strip_prefix("at rest ").unwrap().split(' ').next().unwrap();
    assert!(number(off) < 1e-8, "{said}");
}

/// An example works when it is copied into a crate that depends on `funicular` alone: the compiler
/// knows no other name.
#[test]
fn examples_work_in_a_crate_of_others() {
    let build = ["build", "--locked", "--workspace", "--example", "third_solver"];
    let mut cargo = Command::new(env!("CARGO"));
    let built = cargo.args(build).arg("--message-format=json").output().unwrap();
    let lines = String::from_utf8(built.stdout).unwrap();
    let messages = lines.lines().map(|line| serde_json::from_str(line).unwrap());
    let library = |message: serde_json::Value| {
        let target = &message["target"];
        let is_ours = target["name"] == "funicular" && target["kind"][0] == "lib";
        let files = message["filenames"].as_array().filter(|_| is_ours)?;
        let mut names = files.iter().filter_map(|file| file.as_str().map(PathBuf::from));
        names.find(|name| name.extension().is_some_and(|ending| ending == "rlib"))
    };
    let library = messages.filter_map(library).next_back().expect("a library");
    let folder = tempfile::tempdir().unwrap();
    let examples = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for name in RUN.split(' ') {
        let copy = folder.path().join(name).with_extension("rs");
        std::fs::copy(examples.join(name).with_extension("rs"), &copy).unwrap();
        let compiled = Command::new(Path::new(env!("CARGO")).with_file_name("rustc"))
            .args(["--edition=2024", "--emit=metadata", "--cap-lints=allow", "--extern"])
            .arg(format!("funicular={}", library.display()))
            .arg("-L")
            .arg(format!("dependency={}", library.parent().unwrap().display()))
            .args(["--out-dir".as_ref(), folder.path(), copy.as_path()])
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&compiled.stderr);
        assert!(compiled.status.success(), "{name}: {said}");
    }
}
