//! Results are replaced by results alone: whatever a command refuses, the files of an earlier run
//! stay as they are, byte by byte, and nothing is left beside them.

use std::collections::BTreeMap;
use std::path::Path;

use crate::run::ran;

/// Every option of every command that names a file or folder of results; `FILE` is the input.
const COMMANDS: [&str; 18] = [
    "solve FILE --csv old.csv --bars-csv bars.csv --svg old.svg",
    "census FILE --csv old.csv --svg old.svg",
    "judge FILE --answer answer.csv --html old.html",
    "sweep FILE --seeds 10 --out folder",
    "sweep FILE --seeds 10 --out folder --resume",
    "study FILE --vary gravity_m_s2=9,10 --csv old.csv --svg old.svg",
    "derivatives FILE --csv old.csv --of bars.1.axial_n",
    "trace FILE --vary gravity_m_s2=9,10 --csv old.csv --svg old.svg",
    "trace good.toml --vary anchors.end_m.x=8,9 --csv old.csv --svg old.svg",
    "basins FILE --size 4 --out folder",
    "modes FILE --svg old.svg --html old.html",
    "simulate FILE --time 0.1 --out old.csv --html old.html",
    "simulate FILE --time 0.1 --out old.parquet",
    "simulate FILE --time 0.1 --out old.pvd",
    "simulate FILE --seeds 10 --damping 1 --out folder",
    "simulate FILE --seeds 10 --damping 1 --out folder --resume",
    "merge folder other --out folder",
    "reproduce --out old.json",
];

/// Refused as text, as a chain that does not reach, and by the solvers: a strut cannot pull.
const INPUTS: [(&str, &str); 3] = [
    (
        "misspelt.toml",
        "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\nbars = [{ length = 1 }]\n",
    ),
    (
        "far.toml",
        "anchors = { start_m = [0, 0, 0], end_m = [4, 0, 0] }\n\
         bars = [{ length_m = 1, mass_kg = 1, count = 2 }]\n",
    ),
    (
        "falls.toml",
        "joints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 1 } }\n\
         bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"strut\" }]\n",
    ),
];

/// All files below a folder with their bytes.
fn all(folder: &Path, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            all(&path, files);
        } else {
            files.insert(path.display().to_string(), std::fs::read(&path).unwrap());
        }
    }
}

#[test]
fn what_is_refused_replaces_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (name, text) in INPUTS {
        std::fs::write(at(name), text).unwrap();
    }
    let answer = "joint,x_m,y_m,z_m\n0,0,0,0\n1,0.5,0,-0.8660254037844386\n2,1,0,0\n";
    std::fs::write(at("answer.csv"), answer).unwrap();
    std::fs::write(at("good.toml"), INPUTS[1].1.replace("[4, 0, 0]", "[1, 0, 0]")).unwrap();
    for inner in ["folder", "other"] {
        std::fs::create_dir(at(inner)).unwrap();
        for name in ["lagrange.svg", "manifest.json", "part-000000.parquet", "summary.json"] {
            std::fs::write(at(inner).join(name), format!("an older {name}")).unwrap();
        }
    }
    for name in ["old.csv", "bars.csv", "old.svg", "old.html", "old.json", "old.parquet", "old.pvd"]
    {
        std::fs::write(at(name), format!("an older {name}")).unwrap();
    }
    let mut before = BTreeMap::new();
    all(folder.path(), &mut before);
    let run = |command: &str, input: &str| {
        ran(&folder, &command.replace("FILE", input).split(' ').collect::<Vec<_>>())
    };
    for command in COMMANDS {
        for (input, _) in INPUTS {
            // What cannot hang may stand, which a census lists, and starts lead to or not; and a study has a line for every
            // point, with its reason where it has no answer.
            let standing = ["census", "study", "sweep", "basins", "modes"];
            if input == "falls.toml" && standing.iter().any(|name| command.starts_with(name)) {
                continue;
            }
            let output = run(command, input);
            let code = output.status.code();
            let said = String::from_utf8_lossy(&output.stderr);
            assert!(code == Some(2) || code == Some(3), "{command} {input}: {code:?} {said}");
            let mut after = BTreeMap::new();
            all(folder.path(), &mut after);
            let names = |files: &BTreeMap<String, _>| files.keys().cloned().collect::<Vec<_>>();
            assert_eq!(names(&before), names(&after), "{command} {input}");
            assert!(before == after, "{command} {input} has changed a file");
        }
    }
    // With an input that is good the same commands replace each file that they name.
    for command in COMMANDS.iter().filter(|command| command.contains("FILE")) {
        let is_result = |word: &&str| word.starts_with("old.") || *word == "bars.csv";
        let results: Vec<&str> = command.split(' ').filter(is_result).collect();
        if results.is_empty() {
            continue;
        }
        for name in &results {
            std::fs::write(at(name), format!("an older {name}")).unwrap();
        }
        let output = run(command, "good.toml");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(0), "{command}: {said}");
        for name in results {
            let bytes = std::fs::read(at(name)).unwrap();
            assert!(!bytes.starts_with(b"an older"), "{command} {name}");
        }
    }
}

/// Files of results are begun by one writer, which names them when they are whole: no other source of
/// the workspace opens a file to write into it.
#[test]
fn one_writer_begins_every_file() {
    // The writer; those that write while the workspace is built, or for its own sources; the list of
    // finished parts of a sweep, which grows by lines, and its lock.
    const APART: &str = "columns/src/atomic.rs report/build.rs report/examples/formulas.rs \
        report/examples/guide.rs sweep/src/store/digests.rs sweep/src/store/lock.rs";
    const OPENINGS: &str = "File::create fs::write( fs::rename( fs::copy( OpenOptions File::options( hard_link( \
        persist(";
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let (mut files, mut writers) = (BTreeMap::new(), Vec::new());
    for entry in std::fs::read_dir(crates).unwrap() {
        let own = entry.unwrap().path();
        for inner in ["src", "examples"].map(|inner| own.join(inner)) {
            if inner.is_dir() {
                all(&inner, &mut files);
            }
        }
        let build = own.join("build.rs");
        if let Ok(bytes) = std::fs::read(&build) {
            files.insert(build.display().to_string(), bytes);
        }
    }
    for (path, bytes) in &files {
        let name = path[crates.display().to_string().len() + 1..].replace('\\', "/");
        let is_test = name.contains("/tests/") || name.ends_with("tests.rs");
        let text = String::from_utf8_lossy(bytes);
        // Tests inside of a file stand at its end; what the documentation shows is no code of ours.
        let code = text.split("#[cfg(test)]").next().unwrap_or_default().lines();
        let code = code.filter(|line| !line.trim_start().starts_with("//"));
        let opens = |line: &str| {
            let line = line.replace("AtomicFile::create", "");
            OPENINGS.split(' ').any(|opening| line.contains(opening))
        };
        if !is_test && code.clone().any(opens) {
            writers.push(name);
        }
    }
    assert_eq!(writers.join(" "), APART);
}
