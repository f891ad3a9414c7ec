//! Typeset the formulas of the documentation, so that it can be read without a network:
//! `cargo doc --workspace --no-deps && cargo run -p report --example formulas -- target/doc`

use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder =
        env::args_os().nth(1).ok_or("which folder? target/doc, if cargo has written it there")?;
    let mut formulas = 0;
    let mut pages = Vec::new();
    collect(Path::new(&folder), &mut pages)?;
    for path in &pages {
        let page = fs::read_to_string(path)?;
        let typeset =
            report::formulas::typeset(&page).map_err(|e| format!("{}: {e}", path.display()))?;
        formulas += typeset.matches("<math").count();
        if typeset != page {
            fs::write(path, typeset)?;
        }
    }
    println!("{formulas} formulas in {} pages", pages.len());
    Ok(())
}

/// The pages below a folder, without those of the sources.
fn collect(folder: &Path, pages: &mut Vec<PathBuf>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            if path.file_name().is_none_or(|name| name != "src") {
                collect(&path, pages)?;
            }
        } else if path.extension().is_some_and(|extension| extension == "html") {
            pages.push(path);
        }
    }
    Ok(())
}
