//! The whole record.

use super::entry::Entry;
use super::{cables, chains, nets};

/// Everything that is published and was looked at, judged or not.
pub fn field() -> Vec<Entry> {
    [
        cables::moorpy(),
        cables::code_aster(),
        nets::jax_fdm(),
        chains::cutest(),
        chains::not_judged(),
    ]
    .concat()
}
