//! Columns on disk: bars read from Parquet, and tables written as Parquet or CSV.
//!
//! ```
//! use columns::{Column, Data, Format, Kind, Schema, Spread, TableWriter};
//! let length = Column::new("length_m", Kind::F64, Spread::Many, "m", "Length of the bar");
//! let schema = Schema { columns: vec![length], notes: vec![] };
//! let folder = tempfile::tempdir()?;
//! let path = folder.path().join("lengths.csv");
//! let mut table = TableWriter::create(&path, Format::Csv, &schema)?;
//! table.write(vec![Data::F64(vec![1.0 / 3.0, 0.1 + 0.2])])?;
//! assert!(!path.exists());
//! table.finish()?;
//! // The shortest digits that read back to the same bits.
//! let text = "length_m\n0.3333333333333333\n0.30000000000000004\n";
//! assert_eq!(std::fs::read_to_string(&path)?, text);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`read_rows`] is for systems of a million different bars.
//! [`TableWriter`] and [`read_table`] are for what the program makes itself: every column with its
//! unit and a description, row group after row group in bounded memory, in files that are whole or
//! not there.

mod atomic;
mod budget;
mod cells;
mod csv;
mod error;
mod guard;
mod pages;
mod parquet;
mod rows;
mod source;
mod table;
mod unpack;
mod writer;

pub use atomic::{AtomicFile, AtomicFolder, abandon, unfinished, write_whole};
pub use error::ColumnsError;
pub use rows::read_rows;
pub use table::{Column, Data, Kind, Mismatch, Schema, Spread};
pub use writer::{Format, TableWriter, read_notes, read_table};
