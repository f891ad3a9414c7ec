//! What is expected of every output, as the text files beside the tests say it.
//!
//! A block begins with `[kind] test`: what that test in Rust looks at; or with `[kind] name $ command`, which
//! is run below, and ends with 0 if not `(ends with 3)`; or, after such a one, with `[kind] name < file`,
//! columns that the command has written. Its lines say what stands at which paths:
//!
//! - `path = values`, in their order; `path near 1e-9 values`, which are not as close; `path each values`,
//!   which repeat themselves; `path in 0..1e-12`; `path encloses values`, by intervals; `path says words`;
//! - `in Rust: paths`, what the test asserts itself;
//! - `name.toml| text`, a line of a file beside `v.toml` and `lamp.toml`.
//!
//! Values are JSON; long ones are closed forms, or digits of others, in decimals. A path with `{a,b}` stands
//! for two, one that begins with a dot, after `; `, is beside the first of its line. A line that is indented
//! goes on with the one before.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use super::output::Output;
use super::solve::{LAMP, LEVEL_V};

use crate::run::{holding, names};

/// What is expected of an output.
#[derive(Default)]
pub struct Block {
    pub kind: String,
    pub test: String,
    /// The command or the file, where no test in Rust has an output.
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
            let first = line.split([' ', '{']).next().unwrap();
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
        assert_eq!(
            blocks.iter().filter(same).count(),
            1,
            "[{}] {} stands twice",
            block.kind,
            block.test
        );
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

/// Commands and their files of columns, in one folder.
#[test]
fn commands_say_what_is_written() {
    let folder = holding([("v.toml", LEVEL_V), ("lamp.toml", LAMP)]);
    for block in blocks() {
        let Block { kind, test, source, .. } = block;
        for (name, _) in &block.files {
            let lines =
                block.files.iter().filter(|(of, _)| of == name).map(|(_, line)| line.as_str());
            std::fs::write(folder.path().join(name), lines.collect::<String>()).unwrap();
        }
        println!("[{kind}] {test} {source}");
        if let Some(command) = source.strip_prefix("$ ") {
            let (command, code) = command.split_once(" (ends with ").unwrap_or((command, "0)"));
            let code = code.trim_end_matches(')').parse().unwrap();
            drop(Output::ended(code, test, &folder, command).of(kind));
        } else if let Some(file) = source.strip_prefix("< ") {
            drop(Output::file(kind, test, folder.path().join(file)));
        } else {
            assert!(source.is_empty() && block.files.is_empty(), "{test}: {source}");
        }
    }
}

/// A block without a command has a test in Rust that looks at such an output.
#[test]
fn tests_in_rust_are_there() {
    let tests = read("rs");
    let blocks = blocks().iter().filter(|block| block.source.is_empty());
    for Block { kind, test, .. } in blocks {
        assert!(tests.contains(&format!("#[test]\nfn {test}()")), "there is no test {test}");
        let is_said = ["\"", " "].iter().any(|end| tests.contains(&format!("\"{kind}{end}")));
        assert!(is_said, "no test has {kind}");
    }
}
