//! Systems from files.

use std::path::Path;

use model::{Problem, system_file};

use crate::diagnostics::SystemFileReport;
use crate::exit::Failure;

/// Read the problem of a system file; bars in a file of their own may be CSV or Parquet.
pub fn problem(path: &Path) -> Result<Problem, Failure> {
    system_file::read_problem_with(path, &|bars| {
        let parquet = bars.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
        parquet.then(|| columns::read_bars(bars).map_err(Into::into))
    })
    .map_err(|error| Failure::bad_input(SystemFileReport::from(error)))
}
