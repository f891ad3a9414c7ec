//! The copy of the workspace that holds the switches.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::options::Options;
use crate::place;
use crate::{Failure, Mutant};

/// The module that asks the environment which change is on.
const SWITCH: &str = include_str!("../switch.rs");

pub struct Tree {
    pub root: PathBuf,
    /// The folders of the crates with changes.
    krates: Vec<PathBuf>,
}

impl Tree {
    /// A copy of what git tracks or would track. What is the same already stays, so that builds of it do.
    pub fn copied(options: &Options) -> Result<Self, Failure> {
        let output = Command::new("git")
            .args(["ls-files", "-z", "--cached", "--others", "--exclude-standard"])
            .output()?;
        let names = String::from_utf8(output.stdout)?;
        let root = options.work.join("tree");
        let krates: Vec<PathBuf> =
            options.krates.iter().map(|krate| Path::new("crates").join(krate)).collect();
        for name in names.split('\0') {
            let path = Path::new(name);
            // These are written with their switches.
            let is_changed = krates.iter().any(|krate| path.starts_with(krate.join("src")));
            if is_changed && name.ends_with(".rs") {
                continue;
            }
            if path.is_symlink() {
                link(&std::fs::read_link(path)?, &root.join(path))?;
            } else if path.is_file() {
                write(&root.join(path), &std::fs::read(path)?)?;
            }
        }
        for krate in &krates {
            write(&root.join(krate).join("src/mx.rs"), SWITCH.as_bytes())?;
        }
        Ok(Self { root, krates })
    }

    /// The crate's files with the switches of these changes; returns those that found their place.
    pub fn place(&self, mutants: &[Mutant]) -> Result<Vec<Mutant>, Failure> {
        let mut files: BTreeMap<PathBuf, Vec<Mutant>> = BTreeMap::new();
        for krate in &self.krates {
            files.extend(sources(&krate.join("src"))?.into_iter().map(|file| (file, Vec::new())));
        }
        for mutant in mutants {
            files.entry(PathBuf::from(&mutant.file)).or_default().push(mutant.clone());
        }
        let mut placed = Vec::new();
        for (file, mutants) in &files {
            let source = std::fs::read_to_string(file)?;
            let (mut text, ids) = place::switched(&source, mutants)?;
            syn::parse_file(&text).map_err(|error| {
                let line = text.lines().nth(error.span().start().line - 1).unwrap_or_default();
                format!("{}: {error} in\n{line}", file.display())
            })?;
            if self.krates.iter().any(|krate| *file == krate.join("src/lib.rs")) {
                text.push_str("\n#[doc(hidden)]\npub mod mx;\n");
            }
            write(&self.root.join(file), text.as_bytes())?;
            placed.extend(mutants.iter().filter(|mutant| ids.contains(&mutant.id)).cloned());
        }
        Ok(placed)
    }
}

/// The files of Rust below a folder.
pub fn sources(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            files.extend(sources(&path)?);
        } else if path.extension().is_some_and(|end| end == "rs") {
            files.push(path);
        }
    }
    Ok(files)
}

fn write(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    if std::fs::read(path).is_ok_and(|old| old == bytes) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(path, bytes)
}

fn link(to: &Path, path: &Path) -> std::io::Result<()> {
    if std::fs::read_link(path).is_ok_and(|old| old == to) {
        return Ok(());
    }
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::os::unix::fs::symlink(to, path)
}
