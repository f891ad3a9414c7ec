//! Systems whose joints and bars stand in Parquet files.

use std::path::Path;

use columns::{Column, Data, Format, Schema, Spread, TableWriter, read_rows};
use model::system::System;
use model::system_file::{Described, Rows, SystemFileError, read_with};

fn write(path: &Path, columns: Vec<(&str, Data)>) {
    let column = |(name, data): &(&str, Data)| {
        Column::new(name, data.kind(), Spread::Many, "1", "of a test")
    };
    let schema = Schema { columns: columns.iter().map(column).collect(), notes: Vec::new() };
    let mut table = TableWriter::create(path, Format::Parquet, &schema).unwrap();
    table.write(columns.into_iter().map(|(_, data)| data).collect()).unwrap();
    table.finish().unwrap();
}

/// The system of a file that names these.
fn read(system: &Path) -> Result<System, SystemFileError> {
    let rows = |file: &Path, rows: &mut dyn Rows| Some(read_rows(file, rows).map_err(Into::into));
    match read_with(system, &rows)? {
        Described::System(system) => Ok(system),
        Described::Chain(_) => panic!("joints by name make no chain"),
    }
}

/// A hundred thousand bars in a row between two anchors of the system file, joints by number.
#[test]
fn joints_and_bars_come_from_parquet_by_number_and_by_name() {
    const BARS: usize = 100_000;
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let text = "bars_file = \"bars.parquet\"\njoints_file = \"joints.parquet\"\n";
    std::fs::write(path("system.toml"), text).unwrap();
    let joint = |k: usize| k == 0 || k == BARS;
    let places = |far: f64| {
        let cell = |k: usize| if k == BARS { far } else { 0.0 };
        Data::F64((0..=BARS).map(cell).collect())
    };
    write(
        &path("joints.parquet"),
        vec![
            ("x_m", places(80.0)),
            ("y_m", places(0.0)),
            ("z_m", places(0.0)),
            ("fixed", Data::U16((0..=BARS).map(|k| u16::from(joint(k))).collect())),
        ],
    );
    let bars = |name: fn(usize) -> Data| {
        vec![
            ("from", name(0)),
            ("to", name(1)),
            ("length_m", Data::F64(vec![1e-3; BARS])),
            ("mass_kg", Data::F64((0..BARS).map(|k| k as f64).collect())),
        ]
    };
    write(&path("bars.parquet"), bars(|end| Data::U64((end as u64..).take(BARS).collect())));
    let by_number = read(&path("system.toml")).unwrap();
    assert_eq!((by_number.joints().len(), by_number.members().len()), (BARS + 1, BARS));
    assert_eq!(by_number.joints().iter().filter(|joint| joint.support.is_fixed()).count(), 2);
    let last = &by_number.members()[BARS - 1];
    assert_eq!((last.from, last.to), (BARS - 1, BARS));
    assert!((last.body.mass_kg() - (BARS - 1) as f64).abs() < 1e-9);

    let texts = |end: usize| Data::Utf8((end..).take(BARS).map(|k| k.to_string()).collect());
    write(&path("bars.parquet"), bars(texts));
    assert_eq!(read(&path("system.toml")).unwrap(), by_number);
}

#[test]
fn errors_name_file_row_and_column() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let text = "bars_file = \"bars.parquet\"\n[joints]\nA = { at_m = [0, 0, 0] }\nB = {}\nC = {}\n";
    std::fs::write(path("system.toml"), text).unwrap();
    let said = |to: [&str; 2], lengths: [f64; 2], last: &str| {
        let names = |names: [&str; 2]| Data::Utf8(names.map(str::to_owned).to_vec());
        let columns = vec![
            ("from", names(["A", "B"])),
            ("to", names(to)),
            ("length_m", Data::F64(lengths.to_vec())),
            (last, Data::F64(vec![1.0; 2])),
        ];
        write(&path("bars.parquet"), columns);
        read(&path("system.toml")).map_err(|error| error.to_string())
    };
    assert!(said(["B", "C"], [1.0, 2.0], "mass_kg").is_ok());
    let error = |to, lengths, last| said(to, lengths, last).unwrap_err();
    let length = error(["B", "C"], [1.0, -2.0], "mass_kg");
    assert!(length.contains("system.toml:1:13: bars_file: "), "{length}");
    assert!(length.contains("bars.parquet: row 2, column `length_m`: the length"), "{length}");
    let joint = error(["B", "D"], [1.0, 2.0], "mass_kg");
    assert!(joint.contains("row 2, column `to`: there is no joint \"D\""), "{joint}");
    let twice = error(["B", "A"], [1.0, 2.0], "mass_kg");
    assert!(twice.contains("row 2: two members connect joint"), "{twice}");
    let column = error(["B", "C"], [1.0, 2.0], "mass");
    assert!(column.contains("the head, column `mass`: unknown key `mass`"), "{column}");
    std::fs::write(path("bars.parquet"), "PAR1 and nothing else").unwrap();
    let broken = read(&path("system.toml")).unwrap_err().to_string();
    assert!(broken.contains("bars.parquet"), "{broken}");
}
