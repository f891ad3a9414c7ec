//! Systems from files.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use model::{Problem, system_file};

use crate::diagnostics::SystemFileReport;
use crate::exit::Failure;

/// Read the problem of a system file; bars in a file of their own may be CSV or Parquet.
pub fn problem(path: &Path) -> Result<Problem, Failure> {
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
