//! A workspace of a few packages, as cargo tells it.

use serde_json::json;

use super::*;

/// `tool` uses `lagrange` and, for tests alone, `samples`; `lagrange` uses `samples` for both.
fn told() -> Value {
    let package = |name: &str, dependencies: Value| {
        let id = format!("path+file:///{name}#1.0.0");
        json!({ "name": name, "id": id, "dependencies": dependencies })
    };
    let id = |name: &str| format!("path+file:///{name}#1.0.0");
    json!({
        "packages": [
            package("tool", json!([
                { "name": "lagrange", "kind": null },
                { "name": "samples", "kind": "dev" },
            ])),
            package("lagrange", json!([
                { "name": "samples", "kind": "dev" },
                { "name": "samples", "kind": null },
            ])),
            package("samples", json!([])),
            package("outside", json!([])),
        ],
        "workspace_members": [id("tool"), id("lagrange"), id("samples")],
        "resolve": { "nodes": [
            { "id": id("tool"), "deps": [{ "pkg": id("lagrange") }] },
            { "id": id("samples"), "deps": [{ "pkg": id("outside") }] },
        ] },
    })
}

fn names(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|name| (*name).to_owned()).collect()
}

#[test]
fn what_cargo_tells_becomes_a_graph() {
    let graph = Graph::from_metadata(&told());
    assert_eq!(graph.workspace, names(&["tool", "lagrange", "samples"]));
    let edges = [
        ("lagrange", names(&["samples"])),
        ("samples", names(&["outside"])),
        ("tool", names(&["lagrange", "samples"])),
    ];
    assert_eq!(graph.edges, edges.map(|(from, to)| (from.to_owned(), to)).into());
    let pair = ("tool".to_owned(), "samples".to_owned());
    assert_eq!(graph.tests_only, [pair].into());
    assert!(graph.has("tool", "lagrange") && !graph.has("lagrange", "tool"));
    assert!(!graph.has("outside", "tool"));
}

#[test]
fn paths_are_the_shortest() {
    let mut graph = Graph::default();
    for (from, to) in [("a", "b"), ("b", "c"), ("c", "d"), ("a", "e"), ("e", "d"), ("d", "a")] {
        graph.insert(from, to);
    }
    assert_eq!(graph.path("a", "d").unwrap(), ["a", "e", "d"]);
    assert_eq!(graph.path("b", "e").unwrap(), ["b", "c", "d", "a", "e"]);
    assert_eq!(graph.path("a", "b").unwrap(), ["a", "b"]);
    assert_eq!((graph.path("a", "x"), graph.path("x", "a")), (None, None));
}

#[test]
fn every_rule_is_told_with_its_path() {
    let told = |workspace: &[&str], edges: &[(&str, &str)], tests_only: &[(&str, &str)]| {
        let mut graph = Graph { workspace: names(workspace), ..Graph::default() };
        for (from, to) in edges {
            graph.insert(from, to);
        }
        let pair = |(from, to): &(&str, &str)| ((*from).to_owned(), (*to).to_owned());
        graph.tests_only = tests_only.iter().map(pair).collect();
        graph.violations()
    };
    assert_eq!(told(&["lagrange", "energy", "model"], &[("lagrange", "model")], &[]), [""; 0]);
    let solver = "of ours a solver uses data and matrices alone: lagrange -> census";
    assert_eq!(told(&["census", "lagrange"], &[("lagrange", "census")], &[]), [solver]);
    // Those that may meet, do; others may reach one solver, and not both.
    let both = [("tool", "lagrange"), ("tool", "energy")];
    let meets = "the solvers meet in validate and nowhere below it: tool -> energy";
    assert_eq!(told(&["tool"], &both, &[]), [meets]);
    assert_eq!(told(&["tool"], &both[..1], &[]), [""; 0]);
    assert_eq!(told(&["tool"], &both[1..], &[]), [""; 0]);
    for place in MEETING_PLACES {
        assert_eq!(told(&[place], &[(place, "lagrange"), (place, "energy")], &[]), [""; 0]);
    }
    let samples = [("tool", "samples")];
    assert_eq!(told(&["tool"], &samples, &samples), [""; 0]);
    assert_eq!(told(&["tool"], &samples, &[]), ["samples are for tests: tool -> samples"]);
    let program = "nothing uses the program: tool -> funicular";
    assert_eq!(told(&["tool"], &[("tool", "funicular")], &[]), [program]);
    for package in LINEAR_ALGEBRA {
        let found = told(&["model"], &[("model", package)], &[]);
        assert_eq!(found, [format!("data, no mechanics: model -> {package}")]);
    }
    for package in WITHOUT_SOLVERS {
        let found = told(&[], &[(package, "energy")], &[]);
        assert_eq!(found, [format!("no solver is reached from here: {package} -> energy")]);
    }
}
