//! System files: refused with a place, or read, written and read again as the same.

use std::path::Path;

use model::system_file::{Described, parse, write_network, write_system};

use super::fuzz;
use super::mutate::mutated;

/// The other form of a file.
const JSON: &[u8] = br#"{"anchors": {"start_m": [0, 0, 0], "end_m": [1, 0, -1]},
    "bars": [{"length_m": 1, "mass_kg": 1, "count": 3}]}"#;

/// More bars than a test has time for.
const MANY: usize = 5000;

fn described(described: &Described) -> (String, usize) {
    match described {
        Described::Chain(problem) => (write_system(problem.chain()), problem.chain().bars().len()),
        Described::System(system) => (write_network(system), system.members().len()),
    }
}

/// Whether the text asks for more bars than a test has time for.
fn asks_for_many(text: &str) -> bool {
    let numbers = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.');
    text.contains("count")
        && numbers
            .filter_map(|number| number.replace('_', "").parse::<f64>().ok())
            .any(|number| number > MANY as f64)
}

fn check(bytes: &[u8]) {
    // What is no text is told before it is parsed.
    let text = String::from_utf8_lossy(bytes).into_owned();
    if asks_for_many(&text) {
        return;
    }
    match parse(&text, "fuzz.toml") {
        Ok(first) => {
            let (written, members) = described(&first);
            let again = parse(&written, "written.toml");
            let again = again.unwrap_or_else(|error| panic!("{error}\n{written}"));
            assert_eq!(described(&again), (written, members));
        }
        Err(error) => {
            let said = error.to_string();
            // What steers a terminal in a key is escaped where it is printed.
            assert!(said.starts_with("fuzz.toml"), "{said:?}");
            if let Some(position) = error.position() {
                let lines = text.split('\n').count();
                assert!((1..=lines).contains(&position.line), "{said}: {lines} lines");
            }
            if let Some(span) = error.span() {
                assert!(text.get(span.clone()).is_some(), "{said}: {span:?} of {}", text.len());
            }
            let _ = error.help();
        }
    }
}

#[test]
fn system_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/cases");
    let mut paths: Vec<_> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    // The same inputs wherever the files are listed in another order.
    paths.sort();
    let mut files: Vec<Vec<u8>> = paths.iter().map(|path| std::fs::read(path).unwrap()).collect();
    files.retain(|file| file.len() < 4000);
    files.push(JSON.to_vec());
    let examples: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    fuzz(
        "system-file",
        |random| {
            let example = random.pick(&examples);
            mutated(random, example, &examples)
        },
        |bytes| check(bytes),
    );
}
