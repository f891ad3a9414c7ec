//! The two solvers share no mechanics: the dependency graph proves it, and the guard is proved to
//! see.

mod graph;

use graph::Graph;

fn graph() -> Graph {
    Graph::of_this_workspace()
}

#[test]
fn the_solvers_are_independent() {
    let violations = graph().violations();
    assert!(violations.is_empty(), "{violations:#?}");
}

#[test]
fn the_guard_sees_real_edges() {
    let graph = graph();
    for (from, to) in [
        ("validate", "lagrange"),
        ("validate", "energy"),
        ("lagrange", "model"),
        ("energy", "model"),
        ("lagrange", "nalgebra"),
        ("energy", "argmin"),
        // A development dependency, an optional one, one behind another.
        ("lagrange", "num-dual"),
        ("validate", "clarabel"),
        ("lagrange", "samples"),
        ("energy", "samples"),
    ] {
        assert!(graph.has(from, to), "{from} -> {to} is not seen");
    }
    assert_eq!(graph.path("funicular", "nalgebra").unwrap().first().unwrap(), "funicular");
    assert!(graph.path("model", "lagrange").is_none());
}

#[test]
fn the_guard_fires_on_doctored_graphs() {
    let graph = graph();
    for (edges, path) in [
        (vec![("lagrange", "energy")], "lagrange -> energy"),
        (vec![("energy", "lagrange")], "energy -> lagrange"),
        (vec![("lagrange", "helper"), ("helper", "energy")], "lagrange -> helper -> energy"),
        (vec![("model", "nalgebra")], "model -> nalgebra"),
        (vec![("model", "geometry"), ("geometry", "argmin")], "model -> geometry -> argmin"),
        (vec![("model", "matrices")], "model -> matrices"),
        (vec![("matrices", "model")], "matrices -> model"),
        (vec![("matrices", "numerics")], "lagrange -> matrices -> numerics"),
        (vec![("energy", "funicular")], "energy -> funicular"),
        (vec![("benches", "funicular-python")], "benches -> funicular-python -> funicular"),
        (vec![("sweep", "lagrange")], "sweep -> lagrange"),
        (vec![("motion", "energy")], "motion -> energy"),
        (vec![("figures", "sweep"), ("sweep", "energy")], "figures -> sweep -> energy"),
        // Mechanics that both could take from a third, tests included.
        (vec![("lagrange", "numerics")], "lagrange -> numerics"),
        (vec![("samples", "numerics")], "energy -> samples -> numerics"),
        (vec![("samples", "nalgebra")], "samples -> nalgebra"),
        // Random chains outside tests.
        (vec![("model", "samples")], "model -> samples"),
    ] {
        let mut doctored = graph.clone();
        for (from, to) in &edges {
            doctored.insert(from, to);
        }
        let violations = doctored.violations();
        assert!(violations.iter().any(|v| v.ends_with(path)), "{path} not told: {violations:#?}");
    }
}

/// A dependency is not the only way to share code: no source file of a solver may pull in a file of
/// another crate, nor ask the model for what loads and laws it has for checks and motion.
#[test]
fn no_source_file_reaches_out_of_its_crate() {
    assert!(reaches_out("#[path = \"../../energy/src/closure.rs\"]\nmod closure;"));
    assert!(reaches_out("include!(\"../../lagrange/src/load.rs\");"));
    assert!(reaches_out("let loads = system.joint_loads_n();"));
    assert!(!reaches_out("mod closure;\n// a path of the field, include nothing\n"));
    let crates = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let mut read = 0;
    for solver in ["lagrange", "energy"] {
        let mut folders = vec![crates.join(solver)];
        while let Some(folder) = folders.pop() {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|e| e == "rs") {
                    let text = std::fs::read_to_string(&path).unwrap();
                    assert!(!reaches_out(&text), "{} pulls in a file", path.display());
                    read += 1;
                }
            }
        }
    }
    assert!(read > 10, "only {read} files read");
}

fn reaches_out(text: &str) -> bool {
    text.lines().any(|line| {
        let line = line.trim_start();
        line.starts_with("#[path")
            || line.starts_with("include!(")
            || [".end_loads_n(", ".joint_loads_n(", ".borne("]
                .iter()
                .any(|call| line.contains(call))
            || line.contains("\"../../lagrange")
            || line.contains("\"../../energy")
    })
}
