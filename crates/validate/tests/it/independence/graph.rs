//! The independence of the two solvers, read from the dependency graph.
//!
//! The graph is what cargo resolves with all features on, development and build dependencies
//! included, together with what the manifests declare. A violation is shown with the path that makes
//! it one.

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::process::Command;

use serde_json::Value;

/// Packages that would let mechanics live in `model`.
const LINEAR_ALGEBRA: &[&str] =
    &["nalgebra", "argmin", "argmin-math", "clarabel", MATRICES, "ndarray", "num-dual"];

/// Data that both solvers may use: problems and answers, and the random chains of their tests.
const DATA: &[&str] = &["model", SAMPLES];

/// Linear algebra, which both solvers may use as they use `nalgebra`: it uses nothing of ours.
const MATRICES: &str = "matrices";

/// Random chains, for tests alone.
const SAMPLES: &str = "samples";

/// The one package that is made of the library of the program: its bindings.
const PYTHON: &str = "funicular-python";

/// Packages of the workspace that may reach both solvers: the judge, what shows its verdicts, and
/// what measures or sweeps both side by side.
const MEETING_PLACES: &[&str] = &["validate", "paper", "report", "benches", "funicular", PYTHON];

/// Packages that are handed the solvers they run, or need none.
const WITHOUT_SOLVERS: &[&str] = &["sweep", "branches", "census", "columns", "figures", "motion"];

/// Who depends on whom, by package name.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Graph {
    edges: BTreeMap<String, BTreeSet<String>>,
    workspace: BTreeSet<String>,
    /// Edges that manifests declare for tests, and for nothing else.
    tests_only: BTreeSet<(String, String)>,
}

impl Graph {
    /// The graph of the workspace that holds this crate.
    pub fn of_this_workspace() -> Self {
        let rustc = run("rustc", &["-vV"]).unwrap();
        let rustc = String::from_utf8_lossy(&rustc).into_owned();
        let host = rustc.lines().find_map(|line| line.strip_prefix("host: ")).unwrap();
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".to_owned());
        // Packages of other platforms are of no use to a build here, and may never have been
        // fetched.
        let arguments = [
            "metadata", "--format-version", "1", "--all-features", "--locked", "--filter-platform",
            host,
        ];
        let offline: Vec<_> = arguments.into_iter().chain(["--offline"]).collect();
        let output = run(&cargo, &offline).or_else(|_| run(&cargo, &arguments)).unwrap();
        Self::from_metadata(&serde_json::from_slice(&output).unwrap())
    }

    /// The graph of the object that `cargo metadata` prints.
    pub fn from_metadata(metadata: &Value) -> Self {
        let array = |value: &Value| value.as_array().unwrap().clone();
        let text = |value: &Value| value.as_str().unwrap().to_owned();
        let mut names = BTreeMap::new();
        let mut graph = Self::default();
        for package in array(&metadata["packages"]) {
            let name = text(&package["name"]);
            names.insert(text(&package["id"]), name.clone());
            // What a manifest declares counts even where the resolver has no use for it.
            let declared = array(&package["dependencies"]);
            for dependency in &declared {
                let to = text(&dependency["name"]);
                graph.insert(&name, &to);
                let of_tests = |other: &Value| other["kind"].as_str() == Some("dev");
                let mut kinds = declared.iter().filter(|other| other["name"] == dependency["name"]);
                if kinds.all(of_tests) {
                    graph.tests_only.insert((name.clone(), to));
                }
            }
        }
        for member in array(&metadata["workspace_members"]) {
            graph.workspace.extend(names.get(&text(&member)).cloned());
        }
        for node in array(&metadata["resolve"]["nodes"]) {
            for dependency in array(&node["deps"]) {
                graph.insert(&names[&text(&node["id"])], &names[&text(&dependency["pkg"])]);
            }
        }
        graph
    }

    /// Add an edge.
    pub fn insert(&mut self, from: &str, to: &str) {
        self.edges.entry(from.to_owned()).or_default().insert(to.to_owned());
    }

    /// Whether there is this very edge.
    pub fn has(&self, from: &str, to: &str) -> bool {
        self.edges.get(from).is_some_and(|targets| targets.contains(to))
    }

    /// A shortest path from one package to another, if there is one.
    pub fn path(&self, from: &str, to: &str) -> Option<Vec<String>> {
        let mut before: BTreeMap<&str, &str> = BTreeMap::new();
        let mut queue = VecDeque::from([from]);
        while let Some(here) = queue.pop_front() {
            for next in self.edges.get(here).into_iter().flatten() {
                if next == from || before.contains_key(next.as_str()) {
                    continue;
                }
                before.insert(next, here);
                if next == to {
                    let mut path = vec![to.to_owned()];
                    let mut at = to;
                    while let Some(previous) = before.get(at) {
                        path.push((*previous).to_owned());
                        at = previous;
                    }
                    path.reverse();
                    return Some(path);
                }
                queue.push_back(next);
            }
        }
        None
    }

    /// Every breach of the rules of independence, with the path that shows it.
    pub fn violations(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut forbid = |from: &str, to: &str, rule: &str| {
            if let Some(path) = self.path(from, to) {
                found.push(format!("{rule}: {}", path.join(" -> ")));
            }
        };
        forbid("lagrange", "energy", "the solvers must not know each other");
        forbid("energy", "lagrange", "the solvers must not know each other");
        for data in DATA {
            for package in LINEAR_ALGEBRA {
                forbid(data, package, "data, no mechanics");
            }
        }
        for package in &self.workspace {
            for solver in ["lagrange", "energy"] {
                if package != solver && package != MATRICES && !DATA.contains(&package.as_str()) {
                    forbid(solver, package, "of ours a solver uses data and matrices alone");
                }
            }
            if package != MATRICES {
                forbid(MATRICES, package, "linear algebra, no mechanics");
            }
            if !DATA.contains(&package.as_str()) {
                forbid(SAMPLES, package, "samples are data");
            }
        }
        for package in WITHOUT_SOLVERS {
            for solver in ["lagrange", "energy"] {
                forbid(package, solver, "no solver is reached from here");
            }
        }
        for package in &self.workspace {
            if package != PYTHON {
                forbid(package, "funicular", "nothing uses the program");
            }
            if !MEETING_PLACES.contains(&package.as_str())
                && package != "lagrange"
                && self.path(package, "lagrange").is_some()
            {
                forbid(package, "energy", "the solvers meet in validate and nowhere below it");
            }
        }
        let users = self.edges.iter().filter(|(_, targets)| targets.contains(SAMPLES));
        for (user, _) in users {
            if !self.tests_only.contains(&(user.clone(), SAMPLES.to_owned())) {
                found.push(format!("samples are for tests: {user} -> {SAMPLES}"));
            }
        }
        found
    }
}

/// Standard output of a command in the folder of this crate, or what it says of its failure.
fn run(program: &str, arguments: &[&str]) -> Result<Vec<u8>, String> {
    let folder = env!("CARGO_MANIFEST_DIR");
    let output = Command::new(program).args(arguments).current_dir(folder).output().unwrap();
    if output.status.success() {
        Ok(output.stdout)
    } else {
        Err(String::from_utf8_lossy(&output.stderr).into_owned())
    }
}

mod tests;
