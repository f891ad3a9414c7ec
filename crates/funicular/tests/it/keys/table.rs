//! The list of all keys and columns, with the tests that assert each.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Sections by kind of output, with a line for each path: the path and the tests.
fn text() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/keys/table.txt");
    std::fs::read_to_string(path).unwrap()
}

/// The tests by path.
pub type Section = BTreeMap<String, Vec<String>>;

/// All sections by kind of output.
pub fn sections() -> BTreeMap<String, Section> {
    let mut sections = BTreeMap::<String, Section>::new();
    let mut section = None;
    for line in text().lines().filter(|line| !line.is_empty() && !line.starts_with("# ")) {
        if let Some(kind) = line.strip_prefix('[').and_then(|line| line.strip_suffix("]:")) {
            assert!(!sections.contains_key(kind), "{kind} stands twice");
            section = Some(sections.entry(kind.to_owned()).or_default());
        } else {
            let (path, tests) = line.split_once(' ').expect("path and tests");
            let tests = tests.split(' ').map(str::to_owned).collect();
            let twice = section.as_mut().expect("a section").insert(path.to_owned(), tests);
            assert!(twice.is_none(), "{path} stands twice");
        }
    }
    sections
}

/// The section of a kind of output.
pub fn of(kind: &str) -> Section {
    sections().remove(kind).unwrap_or_default()
}

/// Every test that the list names is there.
#[test]
fn the_list_names_tests_that_exist() {
    let named: BTreeSet<String> =
        sections().into_values().flat_map(BTreeMap::into_values).flatten().collect();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/keys");
    let sources: String = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs"))
        .map(|path| std::fs::read_to_string(path).unwrap())
        .collect();
    for test in &named {
        assert!(sources.contains(&format!("#[test]\nfn {test}()")), "there is no test {test}");
    }
    assert!(named.len() > 10);
}
