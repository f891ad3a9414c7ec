//! Texts to put mistakes into, and the check of their errors.

use std::fs;
use std::path::{Path, PathBuf};

use model::Problem;
use model::system::System;
use model::system_file::{Described, SystemFileError, parse};

/// A folder of one test; removed at the end of it, if the test passes.
pub struct Folder(pub PathBuf);

impl Folder {
    pub fn new(name: impl AsRef<Path>) -> Self {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
        let _ = fs::remove_dir_all(&path);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    pub fn file(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.0.join(name);
        fs::write(&path, content).unwrap();
        path
    }

    pub fn done(self) {
        fs::remove_dir_all(self.0).unwrap();
    }
}

/// What is described, which is a chain.
pub fn chain(described: Result<Described, SystemFileError>) -> Result<Problem, SystemFileError> {
    match described? {
        Described::Chain(problem) => Ok(problem),
        Described::System(system) => panic!("a system: {system:?}"),
    }
}

/// The system that a text describes by the names of its joints.
#[track_caller]
pub fn system(text: &str) -> System {
    match parse(text, "f") {
        Ok(Described::System(system)) => system,
        other => panic!("{other:?}\n{text}"),
    }
}

/// A file with the anchors of the paper in front of the given rest.
pub fn anchored(rest: &str) -> String {
    format!("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n{rest}")
}

/// Three bars of the paper behind the given head.
pub fn barred(head: &str) -> String {
    format!("{head}\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n")
}

/// The text must be refused with this message (file, line, column, key, reason) and this place
/// marked.
#[track_caller]
pub fn check(text: &str, message: &str, marked: &str) {
    let error = parse(text, "f").expect_err(text);
    let found = error.span().map_or("", |span| &error.text()[span]);
    assert_eq!((error.to_string().as_str(), found), (message, marked));
}

/// The text must be refused at this key with these words, in the error or in its help.
#[track_caller]
pub fn refused_at(text: &str, key: &str, words: &str) {
    let error = parse(text, "system.toml").expect_err(text);
    assert_eq!(error.key(), Some(key), "{error}\n{text}");
    let said = format!("{error} {}", error.help().unwrap_or_default());
    assert!(said.contains(words), "{said}");
}

/// The rows of a part of `refused.txt`.
pub fn rows<const N: usize>(part: &str) -> impl Iterator<Item = [String; N]> {
    let mut parts = include_str!("refused.txt").split("\n## ").skip(1);
    let rows = parts.find_map(|text| text.strip_prefix(part)?.strip_prefix('\n')).expect(part);
    let row = |row| serde_json::from_str::<Vec<String>>(row).unwrap().try_into().unwrap();
    rows.lines().filter(|line| line.starts_with('[')).map(row)
}
