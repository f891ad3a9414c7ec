//! One build of all changes; those that do not compile are left out of it.

use std::collections::BTreeSet;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::options::Options;
use crate::tree::Tree;
use crate::{Failure, Mutant};

/// A test program, with its crate and the folder that it is run in.
pub struct Program {
    pub krate: String,
    pub file: PathBuf,
    pub folder: PathBuf,
}

pub struct Built {
    pub programs: Vec<Program>,
    pub run: Vec<Mutant>,
    pub without_switch: Vec<Mutant>,
    pub not_compiled: Vec<Mutant>,
}

impl Built {
    /// The first ones drawn of those of each crate that can be run.
    pub fn keep(&mut self, options: &Options) {
        self.run.sort_by_key(|mutant| mutant.id);
        for krate in &options.krates {
            let of = |mutant: &Mutant| mutant.krate() == krate;
            let kept = self.run.iter().filter(|mutant| of(mutant)).take(options.draw);
            let last = kept.last().map_or(0, |mutant| mutant.id);
            for list in [&mut self.run, &mut self.not_compiled, &mut self.without_switch] {
                list.retain(|mutant| !of(mutant) || mutant.id <= last);
            }
        }
    }
}

/// # Errors
///
/// Where the build fails at a place that no change stands at.
pub fn built(tree: &Tree, options: &Options, drawn: Vec<Mutant>) -> Result<Built, Failure> {
    let mut run = tree.place(&drawn)?;
    let without_switch: Vec<Mutant> = drawn
        .iter()
        .filter(|mutant| !run.iter().any(|other| other.id == mutant.id))
        .cloned()
        .collect();
    let mut not_compiled = Vec::new();
    loop {
        let messages = messages(tree, options)?;
        let Some(errors) = errors(&messages) else {
            let programs =
                messages.iter().filter_map(|message| program(message, options)).collect();
            return Ok(Built { programs, run, without_switch, not_compiled });
        };
        let mut guilty = BTreeSet::new();
        for error in &errors {
            guilty.extend(blamed(tree, error)?);
        }
        let texts: Vec<&str> =
            errors.iter().filter_map(|error| error["rendered"].as_str()).collect();
        if guilty.is_empty() {
            return Err(texts.concat().into());
        }
        eprintln!("{} errors, {} changes left out", errors.len(), guilty.len());
        let (out, left) = run.into_iter().partition(|mutant| guilty.contains(&mutant.id));
        let out: Vec<Mutant> = out;
        if out.is_empty() {
            return Err(texts.concat().into());
        }
        not_compiled.extend(out);
        run = left;
        tree.place(&run)?;
    }
}

fn messages(tree: &Tree, options: &Options) -> Result<Vec<Value>, Failure> {
    let mut cargo = Command::new("cargo");
    cargo.args(["test", "--locked", "--no-run", "--lib", "--tests", "--message-format", "json"]);
    for package in options.packages() {
        cargo.args(["-p", package]);
    }
    let output = cargo
        .arg("--target-dir")
        .arg(&options.target)
        .current_dir(&tree.root)
        .stderr(Stdio::inherit())
        .output()?;
    let text = String::from_utf8(output.stdout)?;
    Ok(text.lines().map(serde_json::from_str).collect::<Result<_, _>>()?)
}

/// `None` if all was built.
fn errors(messages: &[Value]) -> Option<Vec<&Value>> {
    let finished = messages.iter().any(|message| message["success"] == true);
    let errors = messages
        .iter()
        .filter(|message| message["message"]["level"] == "error")
        .map(|message| &message["message"]);
    (!finished).then(|| errors.collect())
}

fn program(message: &Value, options: &Options) -> Option<Program> {
    let file = PathBuf::from(message["executable"].as_str()?);
    let folder = Path::new(message["manifest_path"].as_str()?).parent()?.to_owned();
    let krate = folder.file_name()?.to_str()?.to_owned();
    let asked = options.packages().any(|package| package == krate);
    (asked && message["profile"]["test"] == true).then_some(Program { krate, file, folder })
}

/// The changes that an error is about: the innermost one around a place that it names, else all between these places,
/// or on their lines, else the last one before them, as a value that a function returns at once.
fn blamed(tree: &Tree, error: &Value) -> Result<BTreeSet<u32>, Failure> {
    let mut spans = Vec::new();
    collect(error, &mut spans);
    let mut blamed = BTreeSet::new();
    for (file, _) in &spans {
        let Ok(text) = std::fs::read_to_string(tree.root.join(file)) else { continue };
        let regions = regions(&text);
        let own: Vec<&Range<usize>> =
            spans.iter().filter(|(other, _)| other == file).map(|(_, range)| range).collect();
        for range in &own {
            let around = regions
                .iter()
                .filter(|(_, region)| region.start <= range.start && range.end <= region.end);
            blamed.extend(around.min_by_key(|(_, region)| region.len()).map(|(id, _)| *id));
        }
        if blamed.is_empty() {
            let from = own.iter().map(|range| range.start).min().unwrap_or(0);
            let to = own.iter().map(|range| range.end).max().unwrap_or(0);
            let from = text[..from].rfind('\n').unwrap_or(0);
            let to = text[to..].find('\n').map_or(text.len(), |end| to + end);
            blamed.extend(
                regions
                    .iter()
                    .filter(|(_, region)| region.start < to && from < region.end)
                    .map(|(id, _)| *id),
            );
            let before = regions.iter().filter(|(_, region)| region.end <= from);
            if blamed.is_empty() {
                blamed.extend(before.max_by_key(|(_, region)| region.start).map(|(id, _)| *id));
            }
        }
    }
    Ok(blamed)
}

/// The places that a message and what belongs to it name.
fn collect(message: &Value, spans: &mut Vec<(String, Range<usize>)>) {
    for mut span in message["spans"].as_array().into_iter().flatten() {
        // What a macro became stands in the file of the macro: the place that used it comes after that.
        while let Some(file) = span["file_name"].as_str() {
            let byte = |key: &str| span[key].as_u64().unwrap_or(0) as usize;
            spans.push((file.to_owned(), byte("byte_start")..byte("byte_end")));
            span = &span["expansion"]["span"];
        }
    }
    for child in message["children"].as_array().into_iter().flatten() {
        collect(child, spans);
    }
}

/// Where the text of each change stands: from its question to the mark behind it.
fn regions(text: &str) -> Vec<(u32, Range<usize>)> {
    const ASKED: &str = "crate::mx::on(";
    text.match_indices(ASKED)
        .filter_map(|(start, _)| {
            let rest = &text[start + ASKED.len()..];
            let id: u32 = rest[..rest.find(')')?].parse().ok()?;
            let end = rest.find(&format!("/*{id}*/"))?;
            Some((id, start..start + ASKED.len() + end))
        })
        .collect()
}
