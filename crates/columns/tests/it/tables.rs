//! Tables written and read back.

use std::fs::{self, File};
use std::path::Path;

use columns::{
    AtomicFile, Column, ColumnsError, Data, Format, Kind, Mismatch, Schema, Spread, TableWriter,
    read_table, unfinished,
};
use parquet::file::reader::{FileReader, SerializedFileReader};

fn schema() -> Schema {
    let columns = vec![
        Column::new("seed", Kind::U64, Spread::Rising, "1", "Number of the start"),
        Column::new("outcome", Kind::I16, Spread::Few, "1", "Where it led"),
        Column::new("iterations", Kind::U16, Spread::Few, "1", "Steps"),
        Column::new("energy_j", Kind::F64, Spread::Many, "J", "Energy above joint 0"),
    ];
    Schema { columns, notes: vec![("system".to_owned(), "paper".to_owned())] }
}

/// Rows with every kind of number that could come out differently.
fn rows(first: u64, count: u64) -> Vec<Data> {
    let seeds: Vec<u64> = (first..first + count).collect();
    let energy = |k: &u64| match k % 7 {
        0 => f64::NAN,
        1 => f64::NEG_INFINITY,
        2 => -0.0,
        3 => 5e-324,
        #[expect(clippy::cast_precision_loss, reason = "any number will do")]
        _ => (*k as f64).sqrt() * 1e-300,
    };
    let outcome = |k: &u64| i16::try_from(k % 5).unwrap() - 4;
    let iterations = |k: &u64| u16::try_from(k * 7919 % 65_536).unwrap();
    vec![
        Data::U64(seeds.clone()),
        Data::I16(seeds.iter().map(outcome).collect()),
        Data::U16(seeds.iter().map(iterations).collect()),
        Data::F64(seeds.iter().map(energy).collect()),
    ]
}

fn write(path: &Path, format: Format) {
    let mut table = TableWriter::create(path, format, &schema()).unwrap();
    table.write(rows(0, 40_000)).unwrap();
    table.write(rows(40_000, 3)).unwrap();
    table.finish().unwrap();
}

/// Bits and not values: NaN differs from itself.
fn bits(columns: &[Data]) -> Vec<Vec<u64>> {
    columns
        .iter()
        .map(|column| match column {
            Data::F64(cells) => cells.iter().map(|x| x.to_bits()).collect(),
            Data::U64(cells) => cells.clone(),
            Data::U16(cells) => cells.iter().map(|&x| x.into()).collect(),
            Data::I16(cells) => cells.iter().map(|&x| i64::from(x).cast_unsigned()).collect(),
            Data::Utf8(_) => Vec::new(),
        })
        .collect()
}

#[test]
fn what_was_written_comes_back_to_the_last_bit() {
    let folder = tempfile::tempdir().unwrap();
    for format in [Format::Parquet, Format::Csv] {
        let path = folder.path().join("table");
        write(&path, format);
        let mut all: Vec<Data> = schema().columns.iter().map(|c| Data::empty(c.kind)).collect();
        read_table(&path, format, &schema(), &mut |columns| {
            for (all, column) in all.iter_mut().zip(columns) {
                all.append(&mut column.clone());
            }
        })
        .unwrap();
        assert_eq!(bits(&all), bits(&rows(0, 40_003)), "{format:?}");
    }
}

#[test]
fn the_same_rows_give_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    for format in [Format::Parquet, Format::Csv] {
        let (a, b) = (folder.path().join("a"), folder.path().join("b"));
        write(&a, format);
        write(&b, format);
        assert_eq!(fs::read(a).unwrap(), fs::read(b).unwrap(), "{format:?}");
    }
}

#[test]
fn units_and_descriptions_stand_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.parquet");
    write(&path, Format::Parquet);
    let reader = SerializedFileReader::new(File::open(&path).unwrap()).unwrap();
    let file = reader.metadata().file_metadata();
    assert_eq!(file.created_by(), Some("funicular"));
    let notes = file.key_value_metadata().unwrap();
    for (key, value) in [
        ("system", "paper"),
        ("energy_j.unit", "J"),
        ("energy_j.description", "Energy above joint 0"),
    ] {
        assert!(notes.iter().any(|n| n.key == key && n.value.as_deref() == Some(value)), "{key}");
    }
    assert_eq!(reader.num_row_groups(), 2);
}

#[test]
fn a_table_that_is_not_finished_is_not_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.parquet");
    let mut table = TableWriter::create(&path, Format::Parquet, &schema()).unwrap();
    table.write(rows(0, 10)).unwrap();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1, "the unfinished file");
    drop(table);
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    // What a killed process leaves.
    std::mem::forget(AtomicFile::create(&path).unwrap());
    fs::write(folder.path().join("mine.part"), "").unwrap();
    let names = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name());
    let left: Vec<String> = names.map(|name| name.into_string().unwrap()).collect();
    let of: Vec<&str> = left.iter().filter_map(|name| unfinished(name)).collect();
    assert_eq!((left.len(), of), (2, vec!["table.parquet"]));
}

#[test]
fn rows_of_another_table_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    let mut table = TableWriter::create(&path, Format::Csv, &schema()).unwrap();
    let mut short = rows(0, 4);
    short.pop();
    let error = table.write(short).unwrap_err();
    assert!(matches!(
        error,
        ColumnsError::Mismatch { error: Mismatch::Count { wanted: 4, found: 3 }, .. }
    ));
    let mut uneven = rows(0, 4);
    uneven[3] = Data::F64(vec![1.0]);
    let error = table.write(uneven).unwrap_err();
    assert!(error.to_string().contains("column `energy_j` has another type or another length"));
    assert!(TableWriter::create(folder.path(), Format::Csv, &schema()).is_err());
    assert!(TableWriter::create(&path.join("x"), Format::Csv, &schema()).is_err());
}

#[test]
fn other_columns_and_damage_are_refused_on_reading() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table");
    for format in [Format::Parquet, Format::Csv] {
        write(&path, format);
        let mut other = schema();
        other.columns.pop();
        let error = read_table(&path, format, &other, &mut |_| ()).unwrap_err();
        assert!(matches!(error, ColumnsError::OtherColumns { .. }), "{error}");
        let whole = fs::read(&path).unwrap();
        fs::write(&path, &whole[..whole.len() - 3]).unwrap();
        assert!(read_table(&path, format, &schema(), &mut |_| ()).is_err());
    }
    write(&path, Format::Csv);
    let text = fs::read_to_string(&path).unwrap().replacen("\n1,", "\n1,x,", 1);
    fs::write(&path, text).unwrap();
    let error = read_table(&path, Format::Csv, &schema(), &mut |_| ()).unwrap_err();
    assert!(error.to_string().contains("row 2, column `outcome`"), "{error}");
}

#[test]
fn text_with_commas_is_quoted() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("table.csv");
    let columns = vec![Column::new("what", Kind::Utf8, Spread::Few, "", "A word")];
    let schema = Schema { columns, notes: Vec::new() };
    let mut table = TableWriter::create(&path, Format::Csv, &schema).unwrap();
    table.write(vec![Data::Utf8(vec!["a".into(), "b,\"c\"".into()])]).unwrap();
    table.finish().unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "what\na\n\"b,\"\"c\"\"\"\n");
    let read = read_table(&path, Format::Csv, &schema, &mut |_| ());
    assert!(matches!(read, Err(ColumnsError::WrongType { .. })));
}
