//! Bars from Parquet files, good and bad. The files are written by the `parquet` crate's own
//! writer.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use columns::{ColumnsError, read_rows};
use model::Bar;
use model::system_file::{Cell, Rows, read_with};
use parquet::basic::{Compression, LogicalType};
use parquet::data_type::{DoubleType, FloatType, Int32Type, Int64Type};
use parquet::file::metadata::{ParquetMetaDataReader, ParquetMetaDataWriter};
use parquet::file::properties::WriterProperties;

use crate::files::{Cells, cells, doubles, write};

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self) -> PathBuf {
        self.0.path().join("bars.parquet")
    }

    fn write(&self, columns: &[Cells]) -> PathBuf {
        self.compressed(columns, Compression::UNCOMPRESSED)
    }

    fn compressed(&self, columns: &[Cells], compression: Compression) -> PathBuf {
        let properties = WriterProperties::builder().set_compression(compression).build();
        write(&self.path(), columns, properties);
        self.path()
    }
}

/// Rows of numbers, by the names of their columns; what has none is not a number.
#[derive(Default)]
struct Numbers(Vec<String>, Vec<Vec<f64>>);

impl Rows for Numbers {
    fn names(&mut self, names: &[&str]) -> bool {
        self.0 = names.iter().map(|name| (*name).to_owned()).collect();
        true
    }

    fn row(&mut self, cells: &[Cell<'_>]) -> bool {
        let number = |cell: &Cell<'_>| if let Cell::Number(x) = cell { *x } else { f64::NAN };
        self.1.push(cells.iter().map(number).collect());
        true
    }
}

/// The bars of a file.
fn read_bars(path: impl AsRef<Path>) -> Result<Vec<Bar>, Box<dyn std::error::Error>> {
    let mut found = Numbers::default();
    read_rows(path, &mut found)?;
    let place = |name: &str| found.0.iter().position(|known| known == name);
    let bar = |row: &Vec<f64>| {
        let number = |name: &str| place(name).map_or(f64::NAN, |k| row[k]);
        let centre_m = Some(number("centre_m")).filter(|x| !x.is_nan());
        Ok(Bar::given(number("length_m"), number("mass_kg"), centre_m, None)?)
    };
    found.1.iter().map(bar).collect()
}

fn error(path: impl AsRef<Path>) -> ColumnsError {
    read_rows(path, &mut Numbers::default()).unwrap_err()
}

/// What is said of a chain whose bars are these.
fn refused(columns: &[Cells]) -> String {
    let folder = Folder::new();
    folder.write(columns);
    let chain = folder.0.path().join("chain.toml");
    let anchors = "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }";
    fs::write(&chain, format!("bars_file = \"bars.parquet\"\n{anchors}\n")).unwrap();
    let read = read_with(&chain, &|file, rows| Some(read_rows(file, rows).map_err(Into::into)));
    let said = read.unwrap_err().to_string();
    assert!(said.contains("chain.toml:1:13: bars_file: ") && said.contains("bars.parquet: "));
    said
}

#[test]
fn the_columns_come_in_any_order_and_with_gaps_in_the_centres() {
    let folder = Folder::new();
    let path = folder.write(&[
        cells::<DoubleType>("centre_m", None, vec![Some(0.25), None]),
        doubles("mass_kg", [2.0, 0.0]),
        doubles("length_m", [1.0, 0.5]),
    ]);
    let inertia = Bar::slender_inertia(1.0, 2.0);
    let wanted = [Bar::new(1.0, 2.0, 0.25, inertia).unwrap(), Bar::homogeneous(0.5, 0.0).unwrap()];
    assert_eq!(read_bars(path).unwrap(), wanted);
}

/// Two bars, by their lengths, masses and centres.
const WIDTHS: [(f64, f64, f64); 2] = [(3.0, 1.0, 0.5), (4.0, 4_294_967_295.0, 0.75)];

fn numbers(bars: &[Bar]) -> Vec<(f64, f64, f64)> {
    bars.iter().map(|bar| (bar.length_m(), bar.mass_kg(), bar.centre_m())).collect()
}

/// A file packed with Zstandard, by pyarrow 26.0.1 (`write_table` with `compression="zstd"` and `store_schema=False`): what
/// `widths` holds is above, as 64 bits, 32 bits without sign and floats of 32 bits; `roots`, the square roots of 1 to 100 as lengths and
/// masses, without a dictionary.
fn by_pyarrow(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/it/pyarrow/{name}.parquet"))
}

#[test]
fn the_numbers_are_of_any_width_and_any_compression() {
    // The largest number of 32 bits is -1 to whoever overlooks that it has no sign.
    let counts = Some(LogicalType::integer(32, false));
    let columns = [
        cells::<Int64Type>("length_m", None, vec![Some(3), Some(4)]),
        cells::<Int32Type>("mass_kg", counts, vec![Some(1), Some(-1)]),
        cells::<FloatType>("centre_m", None, vec![Some(0.5), Some(0.75)]),
    ];
    for compression in [
        Compression::UNCOMPRESSED,
        Compression::SNAPPY,
        Compression::LZ4,
        Compression::LZ4_RAW,
        Compression::GZIP(parquet::basic::GzipLevel::default()),
    ] {
        let bars = read_bars(Folder::new().compressed(&columns, compression)).unwrap();
        assert_eq!(numbers(&bars), WIDTHS, "{compression:?}");
    }
    assert_eq!(numbers(&read_bars(by_pyarrow("widths")).unwrap()), WIDTHS);
    let small = Some(LogicalType::integer(16, true));
    let long = Some(LogicalType::integer(64, false));
    let whole = [
        cells::<Int32Type>("length_m", small, vec![Some(3)]),
        cells::<Int64Type>("mass_kg", long, vec![Some(-1)]),
    ];
    let bars = read_bars(Folder::new().write(&whole)).unwrap();
    assert_eq!(bars, [Bar::homogeneous(3.0, 2_f64.powi(64)).unwrap()]);
}

/// The writer of the tests packs no better than the reader unpacks: the description alone says
/// another compression.
#[test]
fn a_compression_that_cannot_be_read_is_no_damage() {
    let folder = Folder::new();
    let columns = [doubles("length_m", [1.0]), doubles("mass_kg", [2.0])];
    for (compression, name) in [
        (Compression::BROTLI(parquet::basic::BrotliLevel::default()), "BROTLI"),
        (Compression::LZO, "LZO"),
    ] {
        let path = folder.write(&columns);
        let whole = ParquetMetaDataReader::new().parse_and_finish(&File::open(&path).unwrap());
        let mut builder = whole.unwrap().into_builder();
        for group in builder.take_row_groups() {
            let mut chunks = group.columns().to_vec();
            let last = chunks.pop().unwrap().into_builder().set_compression(compression).build();
            chunks.push(last.unwrap());
            let group = group.into_builder().set_column_metadata(chunks).build().unwrap();
            builder = builder.add_row_group(group);
        }
        let file = File::options().append(true).open(&path).unwrap();
        ParquetMetaDataWriter::new(file, &builder.build()).finish().unwrap();
        let error = error(&path);
        assert!(matches!(error, ColumnsError::Compression { .. }), "{error}");
        let wanted = format!(
            "column `mass_kg` is compressed by {name}, which cannot be read here; Snappy, gzip, Zstandard, LZ4 and no \
             compression can"
        );
        assert!(error.to_string().ends_with(&wanted), "{error}");
    }
}

#[test]
fn rows_are_counted_across_batches() {
    let mut lengths = vec![1.0; 100_000];
    lengths[65_432] = -1.0;
    let masses = doubles("mass_kg", vec![1.0; lengths.len()]);
    let said = refused(&[doubles("length_m", lengths), masses]);
    assert!(said.contains("row 65433, column `length_m`: the length of a bar"), "{said}");
}

#[test]
fn dates_are_no_numbers() {
    let one = |name| doubles(name, [1.0]);
    let day = cells::<Int32Type>("mass_kg", Some(LogicalType::Date), vec![Some(1)]);
    let wrong = error(Folder::new().write(&[one("length_m"), day]));
    assert!(
        matches!(&wrong, ColumnsError::WrongType { column, found, .. }
            if column == "mass_kg" && found == "INT32 (DATE)"),
        "{wrong}"
    );
}

#[test]
fn what_is_no_parquet_file_is_refused() {
    let folder = Folder::new();
    let path = folder.path();
    assert!(matches!(error(&path), ColumnsError::File { .. }));
    assert!(matches!(error(folder.0.path()), ColumnsError::Folder { .. }));
    fs::write(&path, "").unwrap();
    assert!(matches!(error(&path), ColumnsError::Empty { .. }));
    for text in ["PAR1", "PAR1PAR1", "length_m,mass_kg\n1,1\n", "PAR1\0\0\0\0\x7f\x7f\x7f\x7fPAR1"]
    {
        fs::write(&path, text).unwrap();
        assert!(matches!(error(&path), ColumnsError::NotParquet { .. }), "{text:?}");
    }
}

/// Wherever a file is cut and whatever byte of it is turned, there is an answer or an error.
#[test]
fn damage_is_an_error_and_never_a_panic() {
    let folder = Folder::new();
    let path = folder.path();
    let whole = fs::read(by_pyarrow("roots")).unwrap();
    let good: Vec<Bar> = (1..=100)
        .map(|k| Bar::homogeneous(f64::from(k).sqrt(), f64::from(k).sqrt()).unwrap())
        .collect();
    for end in (0..whole.len()).step_by(7) {
        fs::write(&path, &whole[..end]).unwrap();
        assert!(read_bars(&path).is_err(), "cut at {end}");
    }
    let mut refused = 0;
    for at in 0..whole.len() {
        for turn in [0x01, 0x80, 0xff] {
            let mut turned = whole.clone();
            turned[at] ^= turn;
            fs::write(&path, &turned).unwrap();
            refused += usize::from(read_bars(&path).is_err());
        }
    }
    // Without checksums in the file a turned bit of a number is another number; the rest is
    // noticed.
    assert!(refused > whole.len() / 10, "{refused} of {}", 3 * whole.len());
    fs::write(&path, &whole).unwrap();
    assert_eq!(read_bars(&path).unwrap(), good);
}
