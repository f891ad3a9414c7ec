//! Systems from files.

use std::cell::RefCell;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use miette::miette;
use model::{Problem, system_file};

use crate::cases;
use crate::diagnostics::SystemFileReport;
use crate::exit::Failure;

/// A system and where it comes from.
pub struct Input {
    /// What is to be solved.
    pub problem: Problem,
    /// The files that were read; none of them may be written.
    pub files: Vec<PathBuf>,
}

/// The problem of a system file or of a named case.
pub fn problem(file: Option<&Path>, case: Option<&str>) -> Result<Input, Failure> {
    match (file, case) {
        (Some(file), _) => read(file),
        (None, Some(name)) => {
            cases::find(name).map(|case| Input { problem: case.problem(), files: Vec::new() })
        }
        // clap asks for one of them.
        (None, None) => Err(Failure::bad_input(miette!("name a system file or a case"))),
    }
}

/// Bars in a file of their own may be CSV or Parquet.
fn read(path: &Path) -> Result<Input, Failure> {
    let files = RefCell::new(vec![path.to_owned()]);
    let problem = system_file::read_problem_with(path, &|bars| {
        files.borrow_mut().push(bars.to_owned());
        is_parquet(bars).then(|| columns::read_bars(bars).map_err(Into::into))
    })
    .map_err(|error| Failure::bad_input(SystemFileReport::from(error)))?;
    Ok(Input { problem, files: files.into_inner() })
}

/// Whether a file is named or begins like Parquet. What is read from a pipe is gone: only a file is tasted.
fn is_parquet(path: &Path) -> bool {
    let mut magic = [0; 4];
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"))
        || fs::metadata(path).is_ok_and(|about| about.is_file())
            && File::open(path)
                .is_ok_and(|mut file| file.read_exact(&mut magic).is_ok() && magic == *b"PAR1")
}
