//! Puts the changes that `cargo mutants --list --json` proposes behind one switch, so that a single build holds them all.
//!
//! Usage: `mutant-switches ROOT < LIST > PLACED`. `LIST` is a subset of that list, each entry with an `id`; the files
//! below `ROOT` are rewritten in place: an operator `a + b` becomes `(if crate::mx::on(7) {(a) - (b)} else {a + b})`, a
//! function returns the proposed value first, an arm of a match gets a guard. The ids that were placed are printed.

mod edit;
mod place;

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use serde::Deserialize;

/// A position as cargo-mutants counts it: lines and columns from 1, columns in characters.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Position {
    pub line: usize,
    pub column: usize,
}

/// From the first character to behind the last.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq, Hash)]
pub struct Span {
    pub start: Position,
    pub end: Position,
}

/// One change of one file.
#[derive(Clone, Debug, Deserialize)]
pub struct Mutant {
    pub id: u32,
    pub file: String,
    pub span: Span,
    pub replacement: String,
    pub genre: String,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let root = std::env::args().nth(1).ok_or("usage: mutant-switches ROOT < LIST")?;
    let mut list = String::new();
    std::io::stdin().read_to_string(&mut list)?;
    let mut files: BTreeMap<String, Vec<Mutant>> = BTreeMap::new();
    for mutant in serde_json::from_str::<Vec<Mutant>>(&list)? {
        files.entry(mutant.file.clone()).or_default().push(mutant);
    }
    let mut placed = Vec::new();
    for (file, mutants) in files {
        let path = Path::new(&root).join(&file);
        let source = std::fs::read_to_string(&path)?;
        let (text, ids) = place::switched(&source, &mutants)?;
        if let Err(error) = syn::parse_file(&text) {
            return Err(format!("{file}: {error}").into());
        }
        std::fs::write(&path, text)?;
        placed.extend(ids);
    }
    println!("{}", serde_json::to_string(&placed)?);
    Ok(())
}
