//! Numbers from 0 here, from 1 for readers.

use serde::{Serialize, Serializer};

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
pub(super) fn serialize<S: Serializer>(number: &usize, serializer: S) -> Result<S::Ok, S::Error> {
    number.saturating_add(1).serialize(serializer)
}
