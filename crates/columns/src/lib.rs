//! Columns on disk: bars read from Parquet, and tables written as Parquet or CSV.

mod bars;
mod error;
mod guard;

pub use bars::read_bars;
pub use error::ColumnsError;
