//! Changes of the code that no test notices, many of them in one build.
//!
//! The changes are those that `cargo mutants --list --json` proposes. An operator `a + b` becomes
//! `(if crate::mx::on(7) {(a) - (b)} else {a + b})`, a function returns the proposed value first, an arm of a match gets
//! a guard; the environment says which one is on. Usage: see [`options::USAGE`].

mod compile;
mod draw;
mod edit;
mod judge;
mod options;
mod place;
mod plausible;
mod report;
mod tests;
mod tree;

use serde::Deserialize;

use crate::options::Options;
use crate::tree::Tree;

type Failure = Box<dyn std::error::Error + Send + Sync>;

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
    /// Given by the draw; 0 is none.
    #[serde(default)]
    pub id: u32,
    pub file: String,
    pub name: String,
    pub span: Span,
    pub replacement: String,
    pub genre: String,
}

impl Mutant {
    /// The crate that it is a change of.
    pub fn krate(&self) -> &str {
        self.file.split('/').nth(1).unwrap_or_default()
    }
}

fn main() -> std::process::ExitCode {
    match run() {
        Ok(()) => std::process::ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            std::process::ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), Failure> {
    let options = Options::from_args(std::env::args().skip(1))?;
    let named = options.only.as_ref().map(std::fs::read_to_string).transpose()?;
    let (mut all, mut drawn) = (Vec::new(), Vec::new());
    for krate in &options.krates {
        let listed =
            if options.plausible { plausible::proposed(krate)? } else { draw::listed(krate)? };
        match &named {
            Some(text) => drawn.extend(draw::named(&listed, text)),
            // The compiler refuses some.
            None => drawn.extend(draw::drawn(&listed, 2 * options.draw, options.seed)),
        }
        all.extend(listed);
    }
    let drawn = draw::numbered(drawn);
    eprintln!("{} of {} changes", drawn.len(), all.len());
    let tree = Tree::copied(&options)?;
    let mut built = compile::built(&tree, &options, drawn)?;
    built.keep(&options);
    let tests = tests::traced(&built.programs, &options)?;
    if tests.iter().all(|test| test.reaches.is_empty()) {
        return Err(
            "no test reaches a change: the target folder is also that of another tree".into()
        );
    }
    let mut verdicts = judge::judged(&built.run, &tests, &options)?;
    written(&options, &report::written(&options, &all, &built, &tests, &verdicts)?)?;
    if options.packages().count() > 1 {
        judge::shown_to_others(&mut verdicts, &tests, &options)?;
        written(&options, &report::written(&options, &all, &built, &tests, &verdicts)?)?;
    }
    Ok(())
}

fn written(options: &Options, text: &str) -> Result<(), Failure> {
    match &options.out {
        Some(file) => std::fs::write(file, text)?,
        None => print!("{text}"),
    }
    Ok(())
}
