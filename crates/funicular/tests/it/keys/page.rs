//! The page of keys and columns of the guide, against the list of those that are written.

use std::collections::BTreeSet;

use super::table;

const PAGE: &str = include_str!("../../../guide/14-keys.md");

/// The sections of the page, with the outputs that each describes.
const SECTIONS: [(&str, &[&str]); 6] = [
    ("solve --json", &["solve"]),
    ("solve --csv", &["solve --csv"]),
    ("solve --bars-csv", &["solve --bars-csv"]),
    ("solve --tolerances --csv", &["solve --tolerances --csv"]),
    ("solve --tolerances --bars-csv", &["solve --tolerances --bars-csv"]),
    ("study --json", &["study"]),
];

/// The keys of a section of the page.
fn described(title: &str) -> Vec<&'static str> {
    let heading = format!("\n## `{title}`\n");
    let (_, section) = PAGE.split_once(&heading).unwrap_or_else(|| panic!("no section {title}"));
    let section = section.split("\n## ").next().unwrap();
    let rows = section.lines().filter_map(|line| line.strip_prefix("| `"));
    rows.map(|row| row.split_once("` | ").unwrap().0).collect()
}

/// Whether a row of the page is about a key: `near.*` is about all below `near`.
fn is_about(row: &str, key: &str) -> bool {
    let below = row.strip_suffix('*').is_some_and(|above| key.starts_with(above));
    row == key || below
}

#[test]
fn the_page_has_every_key_and_no_other() {
    for (title, outputs) in SECTIONS {
        let rows = described(title);
        let keys: BTreeSet<&str> = outputs.iter().flat_map(|output| table::of(output)).collect();
        assert!(!keys.is_empty(), "{title}");
        for key in &keys {
            assert!(rows.iter().any(|row| is_about(row, key)), "{title}: {key} is not on the page");
        }
        for row in rows {
            assert!(keys.iter().any(|key| is_about(row, key)), "{title}: {row} is not written");
        }
    }
}
