//! Bars from Parquet files, good and bad. The files are written by the `parquet` crate's own
//! writer.

use std::fs::{self, File};
use std::path::{Path, PathBuf};

use columns::{ColumnsError, read_bars};
use model::{Bar, BarError};
use parquet::basic::{Compression, LogicalType};
use parquet::data_type::{ByteArray, ByteArrayType, DoubleType, FloatType, Int32Type, Int64Type};
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

fn error(path: impl AsRef<Path>) -> ColumnsError {
    read_bars(path).unwrap_err()
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
fn bad_cells_are_named_by_row_and_column() {
    let folder = Folder::new();
    let cases: [(&str, [f64; 3], &str); 6] = [
        (
            "length_m",
            [1.0, 2.0, f64::NAN],
            "length of a bar must be positive and finite, got NaN m",
        ),
        ("length_m", [1.0, 2.0, 0.0], "must be positive and finite, got 0 m"),
        ("length_m", [1.0, 2.0, 1e200], "a moment of inertia"),
        ("mass_kg", [1.0, 2.0, -1.0], "must be zero or positive, and finite, got -1 kg"),
        ("mass_kg", [1.0, 2.0, f64::INFINITY], "got inf kg"),
        (
            "centre_m",
            [0.1, 0.1, 1.5],
            "must lie on the bar, between 0 and its length 1 m, got 1.5 m",
        ),
    ];
    for (bad, values, wanted) in cases {
        let columns = ["length_m", "mass_kg", "centre_m"]
            .map(|name| doubles(name, if name == bad { values } else { [1.0; 3] }));
        let error = error(folder.write(&columns));
        let text = error.to_string();
        assert!(
            matches!(&error, ColumnsError::Bar { row: 3, column, .. } if *column == bad),
            "{error:?}"
        );
        assert!(
            text.contains(&format!("row 3, column `{bad}`: ")) && text.contains(wanted),
            "{text}"
        );
    }
}

#[test]
fn a_gap_is_allowed_in_the_centres_alone() {
    let folder = Folder::new();
    for bad in ["length_m", "mass_kg"] {
        let columns = ["length_m", "mass_kg"].map(|name| {
            let gap = if name == bad { None } else { Some(1.0) };
            cells::<DoubleType>(name, None, vec![Some(1.0), gap])
        });
        let error = error(folder.write(&columns));
        assert!(
            matches!(&error, ColumnsError::Missing { row: 2, column, .. } if *column == bad),
            "{error:?}"
        );
    }
}

#[test]
fn rows_are_counted_across_batches() {
    let mut lengths = vec![1.0; 100_000];
    lengths[65_432] = -1.0;
    let masses = doubles("mass_kg", vec![1.0; lengths.len()]);
    let path = Folder::new();
    let error = error(path.write(&[doubles("length_m", lengths), masses]));
    assert!(matches!(error, ColumnsError::Bar { row: 65_433, error: BarError::Length { .. }, .. }));
}

#[test]
fn columns_that_do_not_belong_are_refused() {
    let folder = Folder::new();
    let one = |name| doubles(name, [1.0]);
    let unknown = error(folder.write(&[one("length_m"), one("mass_kg"), one("mass")]));
    assert!(matches!(&unknown, ColumnsError::UnknownColumn { column, .. } if column == "mass"));
    assert!(unknown.to_string().contains("allowed are length_m, mass_kg, centre_m"));

    let missing = error(folder.write(&[one("length_m")]));
    assert!(matches!(missing, ColumnsError::MissingColumn { column: "mass_kg", .. }));

    let text = vec![Some(ByteArray::from("1.0"))];
    let text = cells::<ByteArrayType>("mass_kg", Some(LogicalType::String), text);
    let day = cells::<Int32Type>("mass_kg", Some(LogicalType::Date), vec![Some(1)]);
    for (cells, wanted) in [(text, "BYTE_ARRAY (UTF8)"), (day, "INT32 (DATE)")] {
        let wrong = error(folder.write(&[one("length_m"), cells]));
        assert!(
            matches!(&wrong, ColumnsError::WrongType { column, found, .. }
            if column == "mass_kg" && found == wanted),
            "{wrong}"
        );
    }

    let twice = error(folder.write(&[one("length_m"), one("mass_kg"), one("mass_kg")]));
    assert!(matches!(&twice, ColumnsError::DuplicateColumn { column, .. } if column == "mass_kg"));

    let none = error(folder.write(&[doubles("length_m", []), doubles("mass_kg", [])]));
    assert!(matches!(none, ColumnsError::NoBars { .. }));
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

/// A million bars, within what a slow machine needs for an unoptimised build: seconds would mean
/// that something is done per row that should be done per batch.
#[test]
fn a_million_rows_are_read() {
    let values: Vec<f64> = (0..1_000_000).map(|k| 1.0 + f64::from(k) * 1e-6).collect();
    let column = |name| doubles(name, values.clone());
    let halves = doubles("centre_m", values.iter().map(|x| 0.5 * x));
    let folder = Folder::new();
    let path = folder.write(&[column("length_m"), column("mass_kg"), halves]);
    let start = std::time::Instant::now();
    let bars = read_bars(path).unwrap();
    println!("{} bars in {:?}", bars.len(), start.elapsed());
    assert_eq!(bars.len(), 1_000_000);
    assert_eq!(bars[999_999], Bar::homogeneous(values[999_999], values[999_999]).unwrap());
}
