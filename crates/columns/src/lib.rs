//! Columns on disk: bars read from Parquet, and tables written as Parquet or CSV.
