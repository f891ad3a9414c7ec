//! Notes of a file, read back.

use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter, read_notes};

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
    let read = read_notes(&path).unwrap();
    assert!(notes.iter().all(|note| read.contains(note)), "{read:?}");
}
