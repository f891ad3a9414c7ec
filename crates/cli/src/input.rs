//! Systems from files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use miette::miette;
use model::{Problem, system_file};

use crate::cases;
use crate::diagnostics::SystemFileReport;
use crate::exit::Failure;

/// The problem of a system file or of a named case.
pub fn problem(file: Option<&Path>, case: Option<&str>) -> Result<Problem, Failure> {
    match (file, case) {
        (Some(file), _) => read(file),
        (None, Some(name)) => cases::find(name).map(model::cases::Case::problem),
        // clap asks for one of them.
        (None, None) => Err(Failure::bad_input(miette!("name a system file or a case"))),
    }
}

/// Bars in a file of their own may be CSV or Parquet.
fn read(path: &Path) -> Result<Problem, Failure> {
    system_file::read_problem_with(path, &|bars| {
        is_parquet(bars).then(|| columns::read_bars(bars).map_err(Into::into))
    })
    .map_err(|error| Failure::bad_input(SystemFileReport::from(error)))
}

/// Whether a file is named or begins like Parquet.
fn is_parquet(path: &Path) -> bool {
    let mut magic = [0; 4];
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"))
        || File::open(path)
            .is_ok_and(|mut file| file.read_exact(&mut magic).is_ok() && magic == *b"PAR1")
}
