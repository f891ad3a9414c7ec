//! Systems from files.

use std::path::Path;

use model::{Problem, system_file};

use crate::diagnostics::SystemFileReport;
use crate::exit::Failure;

/// Read the problem of a system file.
pub fn problem(path: &Path) -> Result<Problem, Failure> {
    system_file::read_problem(path)
        .map_err(|error| Failure::bad_input(SystemFileReport::from(error)))
}
