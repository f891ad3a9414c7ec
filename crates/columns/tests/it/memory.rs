//! Small files that claim much memory, and those that only seem to.

use std::path::Path;

use columns::{ColumnsError, read_rows};
use model::system_file::{Cell, Rows};
use parquet::basic::{Compression, Encoding, LogicalType, Repetition, Type as Physical, ZstdLevel};
use parquet::data_type::{ByteArray, ByteArrayType};
use parquet::file::properties::WriterProperties;
use parquet::schema::types::Type;

use crate::files::{Forged, cells, encoded, number, page, write};

/// What the columns of a file may hold where nothing else is said, bytes.
const BUDGET: u64 = 1 << 29;

/// Keeps the texts of the first column, if they are short.
#[derive(Default)]
struct Taken {
    rows: usize,
    texts: Vec<String>,
}

impl Rows for Taken {
    fn names(&mut self, _: &[&str]) -> bool {
        true
    }

    fn row(&mut self, cells: &[Cell<'_>]) -> bool {
        self.rows += 1;
        if let Cell::Text(text) = cells[0]
            && text.len() < 100
        {
            self.texts.push(text.to_owned());
        }
        true
    }
}

fn read(path: &Path) -> Result<Taken, ColumnsError> {
    let mut taken = Taken::default();
    read_rows(path, &mut taken).map(|()| taken)
}

fn field(physical: Physical) -> Type {
    let meaning = (physical == Physical::BYTE_ARRAY).then_some(LogicalType::String);
    let field = Type::primitive_type_builder("it", physical).with_repetition(Repetition::REQUIRED);
    field.with_logical_type(meaning).build().unwrap()
}

/// Blocks of 128 Ki zeros that are 4 GiB.
const FOUR_GIB: u32 = 1 << 15;

/// Bytes and many zeros behind them as a frame of Zstandard, by RFC 8878: each block of zeros takes
/// four bytes.
fn zeros(says_its_size: bool, head: &[u8], blocks: u32) -> Vec<u8> {
    const BLOCK: u32 = 1 << 17;
    const REPEATED: u32 = 1;
    let mut frame = vec![0x28, 0xb5, 0x2f, 0xfd];
    // A window of 128 KiB; the size, if it is there, in eight bytes.
    frame.extend([if says_its_size { 0xc0 } else { 0 }, 0x38]);
    if says_its_size {
        frame.extend((head.len() as u64 + u64::from(blocks) * u64::from(BLOCK)).to_le_bytes());
    }
    frame.extend(&(u32::try_from(head.len()).unwrap() << 3).to_le_bytes()[..3]);
    frame.extend(head);
    for block in 0..blocks {
        let about = BLOCK << 3 | REPEATED << 1 | u32::from(block + 1 == blocks);
        frame.extend(&about.to_le_bytes()[..3]);
        frame.push(0);
    }
    frame
}

/// A block of LZ4: one letter, and a match of it that goes on for 255 bytes for each byte here.
fn letters(bytes: usize) -> Vec<u8> {
    let mut block = vec![0x1f, b'a', 1, 0];
    block.extend(vec![0xff; bytes]);
    block.push(0);
    block
}

/// A run of DELTA_BINARY_PACKED: these many numbers, each `step` more than the one before, which
/// takes no bits.
fn run(block: u64, count: u64, first: u64, step: u64) -> Vec<u8> {
    const PARTS: usize = 4;
    let head = [block, PARTS as u64, count, first << 1];
    let mut run: Vec<u8> = head.into_iter().flat_map(number).collect();
    for _ in 0..(count - 1).div_ceil(block) {
        run.extend(number(step << 1));
        run.extend([0; PARTS]);
    }
    run
}

#[test]
fn what_a_page_claims_is_asked_for_before() {
    const MANY: u64 = 1 << 40;
    let (none, zstd) = (Compression::UNCOMPRESSED, Compression::ZSTD(ZstdLevel::default()));
    let (lz4, plain) = (Compression::LZ4_RAW, Encoding::PLAIN);
    let (lengths, shared) = (Encoding::DELTA_LENGTH_BYTE_ARRAY, Encoding::DELTA_BYTE_ARRAY);
    let (number_of, text) = (Physical::DOUBLE, Physical::BYTE_ARRAY);
    let most = u64::from(i32::MAX.cast_unsigned());
    let many = run(MANY, MANY, 0, 0);
    let suffixes = [run(128, 1, 0, 0), many.clone()].concat();
    let of_lengths = 4 * MANY;
    let of_suffixes = 4 * (MANY + 1);
    let of_dictionary = most * size_of::<ByteArray>() as u64;
    // The letter, and a match of 4 + 15 and what the bytes say.
    let of_letters = 1 + 19 + 255 * 2_200_000;
    let cases = [
        ("snappy", number_of, Compression::SNAPPY, plain, number(most), most),
        ("zeros", number_of, zstd, plain, zeros(true, &[], FOUR_GIB), 1 << 32),
        ("more zeros", number_of, zstd, plain, zeros(false, &[], FOUR_GIB), BUDGET + 1),
        ("letters", number_of, lz4, plain, letters(2_200_000), of_letters),
        ("dictionary", text, none, plain, vec![0; 4], of_dictionary),
        ("lengths", text, none, lengths, many, of_lengths),
        ("suffixes", text, none, shared, suffixes, of_suffixes),
    ];
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("claims.parquet");
    for (name, physical, compression, encoding, bytes, wanted) in cases {
        let dictionary = name == "dictionary";
        let values = if dictionary { i32::MAX } else { 1 };
        let pages = page(dictionary, values, encoding, &bytes);
        Forged { field: field(physical), compression, encoding, rows: 1, pages }.write(&path);
        let error = read(&path).err().unwrap();
        let ColumnsError::Memory { column, claimed, budget: BUDGET, .. } = &error else {
            panic!("{name}: {error}");
        };
        assert_eq!((column.as_str(), *claimed), ("it", wanted), "{name}");
        let text = error.to_string();
        assert!(text.contains("claims.parquet: column `it` claims "), "{text}");
        assert!(text.contains(&format!("{wanted} bytes")) && text.contains("536870912"), "{text}");
    }
}

/// Each text is the one before and 40 letters more: 16,384 of them are 5.4 GB, of 655 kB.
#[test]
fn text_that_grows_row_by_row_is_asked_for_row_by_row() {
    const ROWS: u64 = 1 << 14;
    const MORE: u64 = 40;
    let encoding = Encoding::DELTA_BYTE_ARRAY;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grows.parquet");
    let forged = |rows: u64| {
        let letters = vec![b'a'; usize::try_from(rows * MORE).unwrap()];
        let bytes = [run(128, rows, 0, MORE), run(128, rows, MORE, 0), letters].concat();
        let pages = page(false, i32::try_from(rows).unwrap(), encoding, &bytes);
        let rows = rows.cast_signed();
        let (field, compression) = (field(Physical::BYTE_ARRAY), Compression::UNCOMPRESSED);
        Forged { field, compression, encoding, rows, pages }.write(&path);
        read(&path)
    };
    assert_eq!(forged(2).unwrap().texts, ["a".repeat(40), "a".repeat(80)]);
    let error = forged(ROWS).err().unwrap();
    assert!(matches!(error, ColumnsError::Memory { .. }), "{error}");
}

/// Rows that are read together hold the pages of all of them: here 100 MiB each.
#[test]
fn pages_are_held_as_long_as_their_text() {
    const BLOCKS: u32 = 800;
    let text = BLOCKS << 17;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pages.parquet");
    let encoding = Encoding::PLAIN;
    let read = |rows: usize| {
        let bytes = zeros(false, &text.to_le_bytes(), BLOCKS);
        let pages = page(false, 1, encoding, &bytes).repeat(rows);
        let (field, compression) =
            (field(Physical::BYTE_ARRAY), Compression::ZSTD(ZstdLevel::default()));
        let rows = i64::try_from(rows).unwrap();
        Forged { field, compression, encoding, rows, pages }.write(&path);
        read(&path)
    };
    assert_eq!(read(2).unwrap().rows, 2);
    let error = read(20).err().unwrap();
    assert!(matches!(error, ColumnsError::Memory { .. }), "{error}");
}

#[test]
fn text_comes_in_every_encoding_and_with_gaps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("text.parquet");
    let names = ["mast", "mast head", "", "mast heads", "\u{3b1}"];
    let column = || {
        let names = names.map(|name| Some(ByteArray::from(name)));
        let text = [None].into_iter().chain(names).chain([None]).collect();
        cells::<ByteArrayType>("it", Some(LogicalType::String), text)
    };
    let wanted: Vec<&str> = names.into_iter().filter(|name| !name.is_empty()).collect();
    let plain = [Encoding::PLAIN, Encoding::DELTA_LENGTH_BYTE_ARRAY, Encoding::DELTA_BYTE_ARRAY];
    let plain = plain.map(|encoding| encoded("it", encoding));
    for properties in plain.into_iter().chain([WriterProperties::default()]) {
        write(&path, &[column()], properties);
        let taken = read(&path).unwrap();
        assert_eq!(
            (taken.rows, taken.texts),
            (7, wanted.iter().map(ToString::to_string).collect())
        );
    }
    let bad = vec![Some(ByteArray::from("good")), Some(ByteArray::from(vec![0xff]))];
    let bad = cells::<ByteArrayType>("it", Some(LogicalType::String), bad);
    write(&path, &[bad], WriterProperties::default());
    let error = read(&path).err().unwrap().to_string();
    assert!(error.contains("row 2, column `it`: text is not UTF-8"), "{error}");
}

/// One name of 400 kB, 16,384 times: 6.5 GB if each row had its own.
#[test]
#[cfg(target_os = "linux")]
fn a_name_of_many_rows_is_there_once() {
    const ROWS: i32 = 1 << 14;
    /// All that the tests of this process hold together, kB.
    const MOST: u64 = 3_000_000;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("name.parquet");
    let name = ByteArray::from(vec![b'n'; 400_000]);
    // A dictionary page of that name; indices of no bits, in one run of all rows.
    let dictionary = [&400_000_u32.to_le_bytes(), name.data()].concat();
    let indices = [vec![0], number(u64::from(ROWS.cast_unsigned()) * 2)].concat();
    let pages = [
        page(true, 1, Encoding::PLAIN, &dictionary),
        page(false, ROWS, Encoding::RLE_DICTIONARY, &indices),
    ]
    .concat();
    let (field, compression) = (field(Physical::BYTE_ARRAY), Compression::UNCOMPRESSED);
    let encoding = Encoding::RLE_DICTIONARY;
    Forged { field, compression, encoding, rows: ROWS.into(), pages }.write(&path);
    assert_eq!(i32::try_from(read(&path).unwrap().rows), Ok(ROWS));
    let status = std::fs::read_to_string("/proc/self/status").unwrap();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap();
    let peak: u64 = peak.trim().trim_end_matches(" kB").parse().unwrap();
    assert!(peak < MOST, "{peak} kB");
}
