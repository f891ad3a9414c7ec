//! Files as text.

use std::io::{self, Read};
use std::path::Path;

use super::error::{Result, SystemFileError};
use super::kind::SystemFileErrorKind as Kind;
use crate::open_input;

/// What the replacement character stands for in a text takes three bytes in it.
const REPLACEMENT_BYTES: usize = char::REPLACEMENT_CHARACTER.len_utf8();

/// A file that has been read.
pub(super) struct Loaded {
    /// Its name as it is shown.
    pub(super) file: String,
    pub(super) text: String,
}

/// Read a whole file as text: an [`io::Error`] if that fails, an error of the file itself if it is
/// too long or no text.
///
/// The length is counted while reading: pipes and devices do not know theirs.
pub(super) fn load(path: &Path, limit: u64) -> io::Result<Result<Loaded>> {
    let file = path.display().to_string();
    let source = open_input(path)?;
    let length = source.metadata()?.len();
    let mut bytes = Vec::with_capacity(usize::try_from(length.min(limit)).unwrap_or(0));
    source.take(limit + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > limit {
        return Ok(Err(SystemFileError::new(&file, "", None, None, Kind::TooLong(limit))));
    }
    Ok(match String::from_utf8(bytes) {
        Ok(text) => Ok(Loaded { file, text }),
        Err(error) => {
            let offset = error.utf8_error().valid_up_to();
            let text = String::from_utf8_lossy(error.as_bytes());
            let span = offset..offset + REPLACEMENT_BYTES;
            Err(SystemFileError::new(&file, &text, Some(span), None, Kind::NotText(offset)))
        }
    })
}

/// A text without the byte order mark that some editors put in front.
pub(super) fn without_mark(text: &str) -> &str {
    text.strip_prefix('\u{feff}').unwrap_or(text)
}
