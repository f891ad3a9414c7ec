//! Long lists of `funicular census`: written one by one, as large as is allowed, never all in memory.

use serde_json::Value;

use crate::census::{chain, funicular, thirteen_bars};
use crate::run::{good, json, peak, stdout, words};

/// What is written one by one is what is written from one list.
#[test]
fn a_long_list_is_that_of_the_library() {
    let path = thirteen_bars("long-list", 13.0);
    let mut written = json(&funicular(&[&path, "--json"]));
    let problem = funicular::Problem::read(&path).unwrap();
    let answer = funicular::Census::new().run(&problem).unwrap();
    let mut expected = serde_json::to_value(&answer).unwrap();
    for object in [&mut written, &mut expected] {
        for equilibrium in object["equilibria"].as_array_mut().unwrap() {
            equilibrium["evidence"]["solve_s"] = 0.0.into();
        }
    }
    let keys = |object: &Value| object.as_object().unwrap().keys().cloned().collect::<Vec<_>>();
    assert_eq!(keys(&written), keys(&expected));
    let [written, expected] = [&written, &expected].map(|o| o["equilibria"].as_array().unwrap());
    assert!(written.len() > 40 && written.len() == expected.len(), "{}", written.len());
    for (a, b) in written.iter().zip(expected) {
        assert_eq!(a, b);
    }
}

/// By signs and pulls an equilibrium is a line, and a list that would fill the disk is refused
/// before it is made.
#[test]
fn a_list_is_as_large_as_is_allowed() {
    let path = thirteen_bars("list", 13.0);
    let output = funicular(&[&path, "--list", "signs", "--json"]);
    let text = stdout(&output);
    let object: Value = serde_json::from_str(&text).unwrap();
    let listed = object["equilibria"].as_array().unwrap();
    assert_eq!(text.lines().filter(|line| line.contains("\"pattern\"")).count(), listed.len());
    assert_eq!(object["census"]["count"], listed.len());
    let longest = text.lines().filter(|line| line.contains("\"pattern\"")).map(str::len).max();
    assert!(longest < Some(260), "{longest:?}");

    let output = funicular(&[&path, "--list", "full", "--json", "--max-output", "10kB"]);
    assert_eq!((output.status.code(), stdout(&output).as_str()), (Some(2), ""));
    let told = words(&output);
    assert!(
        told.contains("the limit is 10 kB") && told.contains("takes it all the same"),
        "{told}"
    );
    // What is not listed takes no room.
    let text = good(".", &["census", &path, "--list", "full", "--max-output", "10kB"]);
    assert!(text.contains("Evidence of the first"), "{text}");
}

/// Equilibria are made while they are written: the list of 170 MB is not in memory. (Whole, these
/// equilibria and their answers took 81 MB, and all of a list of 18 GB more than 9 GB.)
#[cfg(target_os = "linux")]
#[test]
fn memory_does_not_grow_with_the_list() {
    let path = chain("memory", [0.3, 0.0, -4.0], &[(1.0, 1.0); 13]);
    let arguments = ["census", &path, "--list", "full", "--json", "--threads", "1"];
    // It waits for its reader in the middle of the list.
    let most_kb = peak(".", &arguments, 100_000_000) / 1024;
    assert!(most_kb < 50_000, "{most_kb} kB");
}
