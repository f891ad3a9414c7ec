//! What a Parquet part says of itself at its end.

use std::fs::File;
use std::io::{self, Read as _, Seek as _, SeekFrom};
use std::path::Path;

/// The end of a Parquet file: the length of the footer and the four letters.
const TAIL: u64 = 8;

/// The footer of a Parquet file that was read already, so that its length is sound.
pub(crate) fn footer(path: &Path) -> io::Result<Vec<u8>> {
    let mut file = File::open(path)?;
    let length = file.metadata()?.len();
    let mut bytes = [0; 4];
    file.seek(SeekFrom::Start(length.saturating_sub(TAIL)))?;
    file.read_exact(&mut bytes)?;
    let size = u64::from(u32::from_le_bytes(bytes));
    file.seek(SeekFrom::Start(length.saturating_sub(TAIL + size)))?;
    let mut footer = vec![];
    file.take(size).read_to_end(&mut footer)?;
    Ok(footer)
}

/// The text of a note.
///
/// Keys and texts stand in the footer as they are, each behind its field's header and its length (Thrift's compact
/// protocol, structure `KeyValue` of the Parquet format): all that need be known of it to find them.
pub(crate) fn note(footer: &[u8], key: &str) -> Option<String> {
    let mut wanted = vec![STRING];
    wanted.extend(varint(key.len()));
    wanted.extend(key.as_bytes());
    let at = footer.windows(wanted.len()).position(|window| window == wanted)?;
    let rest = footer[at + wanted.len()..].strip_prefix(&[STRING])?;
    let digits = rest.iter().position(|byte| byte & MORE == 0)?;
    let length = rest[..=digits].iter().rev().try_fold(0_usize, |length, byte| {
        length.checked_mul(1 << 7)?.checked_add(usize::from(byte & !MORE))
    })?;
    let text = rest.get(digits + 1..)?.get(..length)?;
    String::from_utf8(text.to_vec()).ok()
}

/// Header of a field that is a string and the next one of its structure.
const STRING: u8 = 0x18;

/// Flag of a byte of a number that is not the last one.
const MORE: u8 = 0x80;

/// A number in sevens of bits, the lowest first.
fn varint(mut number: usize) -> Vec<u8> {
    let mut bytes = vec![];
    loop {
        // Seven bits: it cannot fail.
        let byte = u8::try_from(number & 0x7f).unwrap_or_default();
        number >>= 7;
        if number == 0 {
            bytes.push(byte);
            return bytes;
        }
        bytes.push(byte | MORE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter};

    #[test]
    fn notes_are_read_back_from_a_file() {
        let long = "x".repeat(300);
        let notes = [("a", "7"), ("ab", ""), ("a.long", long.as_str()), ("sign", "\u{3b1}")];
        let notes = notes.map(|(key, value)| (key.to_owned(), value.to_owned())).to_vec();
        let columns = vec![Column::new("seed", Kind::U64, Spread::Rising, "1", "a, b and c")];
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.parquet");
        let schema = Schema { columns, notes: notes.clone() };
        let mut table = TableWriter::create(&path, Format::Parquet, &schema).unwrap();
        table.write(vec![Data::U64(vec![1, 2, 3])]).unwrap();
        table.finish().unwrap();
        let footer = footer(&path).unwrap();
        for (key, value) in notes {
            assert_eq!(note(&footer, &key), Some(value));
        }
        assert_eq!(note(&footer, "b"), None);
        assert_eq!(note(&footer[..footer.len() / 2], "sign"), None);
    }
}
