//! What is expected of every output, as the text files beside the tests say it.
//!
//! A block begins with `[kind] test`: what that test in Rust looks at; or with `[kind] name $ command`, which
//! is run, and ends with 0 if not `(ends with 3)`; or, after such a one, with `[kind] name < file`, columns
//! that the command has written. Of `[said]` the text for people is looked at instead of JSON, in one line.
//! The lines of a block say what stands at which paths:
//!
//! - `path = values`, in their order; `path near 1e-9 values`, which are not as close; `path each values`,
//!   which repeat themselves; `path in 0..1e-12`; `path encloses values`, by intervals; `path says words`
//!   of texts that repeat themselves, one of each or several in a list;
//! - `in Rust: paths`, what a test of the block's name asserts itself;
//! - `name.toml| text`, a line of a file beside `v.toml` and `lamp.toml`; it stays for the blocks that follow.
//!
//! Values are JSON; long ones are closed forms, or digits of others, in decimals. A path with `{a,b}` stands
//! for two, one that begins with a dot, after `; `, is beside the first of its line. A line that is indented
//! goes on with the one before.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use serde_json::json;

use super::output::Output;
use super::solve::{LAMP, LEVEL_V};

use crate::run::{good, holding, names};

/// What is expected of an output.
#[derive(Default)]
pub struct Block {
    pub kind: String,
    pub test: String,
    /// The command or the file, if it is not the test in Rust that has the output.
    source: String,
    /// Names with the lines of these files.
    files: Vec<(String, String)>,
    /// Paths, with how and what they are.
    pub lines: Vec<[String; 3]>,
}

/// How a path is said to be asserted by a test in Rust.
pub const IN_RUST: &str = "in Rust:";

/// The files of this folder with this extension, one after the other.
pub fn read(extension: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/keys");
    let files = names(&folder).into_iter().map(|name| folder.join(name));
    let files = files.filter(|path| path.extension().is_some_and(|found| found == extension));
    files.map(|path| std::fs::read_to_string(path).unwrap() + "\n").collect()
}

fn paths_of(path: &str) -> Vec<String> {
    let Some((before, (names, after))) =
        path.split_once('{').map(|(before, rest)| (before, rest.split_once('}').unwrap()))
    else {
        return vec![path.to_owned()];
    };
    names.split(',').flat_map(|name| paths_of(&format!("{before}{name}{after}"))).collect()
}

impl Block {
    fn begun(kind: &str, rest: &str) -> Self {
        let (test, source) = rest.split_once(' ').unwrap_or((rest, ""));
        let [kind, test, source] = [kind, test, source].map(str::to_owned);
        Self { kind, test, source, ..Self::default() }
    }

    fn add(&mut self, line: &str) {
        if let Some(paths) = line.strip_prefix(IN_RUST) {
            for path in paths.split_whitespace().flat_map(paths_of) {
                self.lines.push([path, IN_RUST.to_owned(), String::new()]);
            }
        } else if let Some((name, text)) =
            line.split_once('|').filter(|(name, _)| !name.contains(' '))
        {
            self.files.push((name.to_owned(), text.trim_start().to_owned() + "\n"));
        } else {
            let first = line.split(' ').next().unwrap();
            let at_end = first.rsplit_once('}').is_some_and(|(_, after)| !after.contains('.'));
            let first = if at_end { first.rsplit_once('{').unwrap().0 } else { first };
            let beside = &first[..first.rfind('.').map_or(0, |dot| dot + 1)];
            for line in line.replace("; .", &format!("\n{beside}")).lines() {
                let [path, how, what] = line.splitn(3, ' ').collect::<Vec<_>>().try_into().unwrap();
                for path in paths_of(path) {
                    self.lines.push([path, how.to_owned(), what.to_owned()]);
                }
            }
        }
    }
}

static BLOCKS: LazyLock<Vec<Block>> = LazyLock::new(|| {
    let mut blocks = Vec::<Block>::new();
    let text = read("txt").replace("\n  ", " ");
    for line in text.lines().filter(|line| !line.is_empty() && !line.starts_with("# ")) {
        let head = line.strip_prefix('[').and_then(|line| line.split_once("] "));
        match head {
            Some((kind, rest)) => blocks.push(Block::begun(kind, rest)),
            None => blocks.last_mut().expect("a block").add(line),
        }
    }
    for block in &blocks {
        let paths: BTreeSet<_> = block.lines.iter().map(|[path, ..]| path).collect();
        assert_eq!(paths.len(), block.lines.len(), "{}: a path stands twice", block.test);
        let same = |other: &&Block| (&other.kind, &other.test) == (&block.kind, &block.test);
        let count = blocks.iter().filter(same).count();
        assert_eq!(count, 1, "[{}] {} stands twice", block.kind, block.test);
    }
    blocks
});

/// All blocks.
pub fn blocks() -> &'static [Block] {
    &BLOCKS
}

/// The paths of a kind of output.
pub fn of(kind: &str) -> BTreeSet<&'static str> {
    let blocks = blocks().iter().filter(|block| block.kind == kind);
    blocks.flat_map(|block| block.lines.iter().map(|[path, ..]| path.as_str())).collect()
}

/// A folder with the files that all commands may name.
fn folder() -> tempfile::TempDir {
    holding([("v.toml", LEVEL_V), ("lamp.toml", LAMP)])
}

impl Block {
    fn is_for_rust(&self) -> bool {
        self.source.is_empty() || self.lines.iter().any(|[_, how, _]| how == IN_RUST)
    }

    fn write_files(&self, folder: &Path) {
        for (name, _) in &self.files {
            let lines =
                self.files.iter().filter(|(of, _)| of == name).map(|(_, line)| line.as_str());
            std::fs::write(folder.join(name), lines.collect::<String>()).unwrap();
        }
    }

    /// The output in a folder with its files.
    fn output(&self, folder: &Path) -> Output {
        let test = &self.test;
        if let Some(file) = self.source.strip_prefix("< ") {
            return Output::file(&self.kind, test, folder.join(file));
        }
        let command = self.source.strip_prefix("$ ").expect(test);
        if self.kind == "said" {
            let text = good(folder, &command.split(' ').collect::<Vec<_>>());
            assert!(text.lines().all(|line| line.chars().count() <= 80), "{text}");
            let words = text.split_whitespace().collect::<Vec<_>>().join(" ");
            return Output::json(&self.kind, test, &json!({ "text": words }).to_string());
        }
        let (command, code) = command.split_once(" (ends with ").unwrap_or((command, "0)"));
        let code = code.trim_end_matches(')').parse().unwrap();
        Output::ended(code, test, folder, command).of(&self.kind)
    }
}

/// The outputs of all blocks of a test in Rust that have a command or a file.
pub fn outputs<const N: usize>(test: &str) -> [Output; N] {
    let folder = folder();
    let blocks = blocks().iter().filter(|block| block.test == test && !block.source.is_empty());
    let outputs: Vec<Output> = blocks
        .inspect(|block| block.write_files(folder.path()))
        .map(|block| block.output(folder.path()))
        .collect();
    outputs.try_into().ok().unwrap()
}

/// Commands and their files of columns, in one folder, but for those that a test in Rust looks at.
#[test]
fn commands_say_what_is_written() {
    let folder = folder();
    let in_rust: BTreeSet<&str> =
        blocks().iter().filter(|b| b.is_for_rust()).map(|b| b.test.as_str()).collect();
    for block in blocks() {
        println!("[{}] {} {}", block.kind, block.test, block.source);
        block.write_files(folder.path());
        if !in_rust.contains(block.test.as_str()) {
            drop(block.output(folder.path()));
        }
    }
}

/// A block of a test in Rust has a test that looks at such an output.
#[test]
fn tests_in_rust_are_there() {
    let tests = read("rs");
    for block in blocks().iter().filter(|block| block.is_for_rust()) {
        let Block { kind, test, source, .. } = block;
        assert!(tests.contains(&format!("#[test]\nfn {test}()")), "there is no test {test}");
        let is_looked_at = if source.is_empty() {
            ["\"", " "].iter().any(|end| tests.contains(&format!("\"{kind}{end}")))
        } else {
            tests.contains(&format!("table::outputs(\"{test}\")"))
        };
        assert!(is_looked_at, "{test} does not look at [{kind}]");
    }
}
