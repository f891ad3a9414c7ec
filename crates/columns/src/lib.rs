//! Columns on disk: bars read from Parquet, and tables written as Parquet or CSV.
//!
//! [`read_bars`] is for chains of a million different bars, [`read_rows`] for systems of as many.
//! [`TableWriter`] and [`read_table`] are for what the program makes itself: every column with its
//! unit and a description, row group after row group in bounded memory, in files that are whole or
//! not there.

mod atomic;
mod bars;
mod csv;
mod error;
mod guard;
mod parquet;
mod rows;
mod table;
mod writer;

pub use atomic::{AtomicFile, abandon, unfinished, write_whole};
pub use bars::read_bars;
pub use error::ColumnsError;
pub use rows::read_rows;
pub use table::{Column, Data, Kind, Mismatch, Schema, Spread};
pub use writer::{Format, TableWriter, read_notes, read_table};
