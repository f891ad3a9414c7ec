//! Files of columns: refused, or read as no more numbers than they hold.

use std::path::Path;

use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter};

use super::fuzz;
use super::mutate::mutated;

fn schema() -> Schema {
    let column = |name, unit| Column::new(name, Kind::F64, Spread::Many, unit, "a test");
    let notes = vec![("made".to_owned(), "here".to_owned())];
    Schema { columns: vec![column("length_m", "m"), column("mass_kg", "kg")], notes }
}

/// Bars in either form.
fn example(folder: &Path, format: Format) -> Vec<u8> {
    let path = folder.join(format!("bars.{}", format.extension()));
    let mut table = TableWriter::create(&path, format, &schema()).unwrap();
    let numbers = |first: i32| (first..first + 50).map(|k| 0.1 * f64::from(k)).collect();
    table.write(vec![Data::F64(numbers(1)), Data::F64(numbers(0))]).unwrap();
    table.finish().unwrap();
    std::fs::read(path).unwrap()
}

fn check(path: &Path, format: Format, bytes: &[u8]) {
    std::fs::write(path, bytes).unwrap();
    let chain = path.with_file_name("chain.toml");
    match funicular::Problem::read(chain) {
        Ok(problem) => {
            let system = problem.system();
            let bars = system.members();
            assert!(bars.len() <= 50 * bytes.len(), "{} bars in {}", bars.len(), bytes.len());
            for bar in bars {
                assert!(bar.body.length_m() > 0.0 && bar.body.length_m().is_finite());
                assert!(bar.body.mass_kg() >= 0.0 && bar.body.mass_kg().is_finite());
            }
        }
        Err(said) => assert!(!said.to_string().is_empty()),
    }
    let mut rows = 0;
    let each = &mut |data: &[Data]| rows += data[0].len();
    if columns::read_table(path, format, &schema(), each).is_ok() {
        assert!(rows <= 50 * bytes.len(), "{rows} rows in {} bytes", bytes.len());
    }
}

#[test]
fn files_of_columns() {
    let folder = tempfile::tempdir().unwrap();
    for format in [Format::Parquet, Format::Csv] {
        let good = example(folder.path(), format);
        let path = folder.path().join(format!("damaged.{}", format.extension()));
        let anchors = "anchors = { start_m = [0, 0, 0], end_m = [3, 0, 0] }";
        let chain = format!("bars_file = \"damaged.{}\"\n{anchors}\n", format.extension());
        std::fs::write(folder.path().join("chain.toml"), chain).unwrap();
        fuzz(
            &format!("columns-{}", format.extension()),
            |random| mutated(random, &good, &[&good]),
            |bytes| check(&path, format, bytes),
        );
    }
}
