//! A Parquet file to be read: what its end says, and its rows.

use std::fs::File;
use std::io::{ErrorKind, Read as _, Seek as _, SeekFrom};
use std::path::Path;
use std::sync::Arc;

use ::parquet::basic::CompressionCodec;
use ::parquet::errors::ParquetError;
use ::parquet::file::FOOTER_SIZE;
use ::parquet::file::metadata::{
    ColumnChunkMetaData, ParquetMetaData, ParquetMetaDataReader, RowGroupMetaData,
};
use ::parquet::schema::types::TypePtr;
use model::open_input;
use model::system_file::{most_bars_of_file, most_file_bytes};

use crate::budget::{Budget, Share};
use crate::cells::{Cells, Holds, type_of};
use crate::error::{ColumnsError, Result};
use crate::pages::{Pages, shared};
use crate::unpack::COMPRESSIONS;

/// Rows decoded at a time: three columns of them stay in the second-level cache.
const BATCH_ROWS: usize = 1 << 14;

pub struct Source<'p> {
    path: &'p Path,
    file: Arc<File>,
    pub metadata: ParquetMetaData,
}

/// Open a regular file with something in it.
pub fn open(path: &Path) -> Result<File> {
    let io = |error| ColumnsError::file(path, error);
    let file = open_input(path).map_err(|error| match error.kind() {
        ErrorKind::IsADirectory => ColumnsError::Folder { path: path.to_owned() },
        _ => io(error),
    })?;
    if file.metadata().map_err(io)?.len() == 0 {
        return Err(ColumnsError::Empty { path: path.to_owned() });
    }
    Ok(file)
}

impl<'p> Source<'p> {
    /// Read the description at the end of a file. What a writer says there about its own types
    /// (`ARROW:schema`) is left aside: the types of the format itself are enough.
    pub fn open(path: &'p Path) -> Result<Self> {
        let file = open(path)?;
        check_end(path, &file)?;
        let metadata = ParquetMetaDataReader::new()
            .parse_and_finish(&file)
            .map_err(|error| not_parquet(path, error.to_string()))?;
        let source = Self { path, file: Arc::new(file), metadata };
        source.check_compressions()?;
        Ok(source)
    }

    /// What cannot be unpacked is not damaged.
    fn check_compressions(&self) -> Result<()> {
        use CompressionCodec::{BROTLI, GZIP, LZ4, LZ4_RAW, LZO, SNAPPY, UNCOMPRESSED, ZSTD};
        let groups = self.metadata.row_groups().iter();
        for column in groups.flat_map(RowGroupMetaData::columns) {
            match column.compression_codec() {
                UNCOMPRESSED | SNAPPY | GZIP | ZSTD | LZ4 | LZ4_RAW => {}
                found @ (BROTLI | LZO) => {
                    return Err(ColumnsError::Compression {
                        path: self.path.to_owned(),
                        column: column.column_path().string(),
                        found: found.to_string(),
                        supported: COMPRESSIONS,
                    });
                }
            }
        }
        Ok(())
    }

    /// The types of the columns.
    pub fn fields(&self) -> &[TypePtr] {
        self.metadata.file_metadata().schema().get_fields()
    }

    /// See that every column holds something that is wanted.
    pub fn check_types(&self, wanted: &'static str) -> Result<()> {
        match self.fields().iter().find(|field| Holds::of(field).is_none()) {
            None => Ok(()),
            Some(field) => Err(ColumnsError::WrongType {
                path: self.path.to_owned(),
                column: field.name().to_owned(),
                wanted,
                found: type_of(field),
            }),
        }
    }

    /// Refuse more rows than a system may have bars.
    pub fn check_rows(&self) -> Result<()> {
        let (path, rows, limit) = (self.path.to_owned(), self.rows()?, most_bars_of_file());
        if rows <= limit as u64 {
            return Ok(());
        }
        Err(ColumnsError::TooManyBars { path, rows, limit })
    }

    /// How many rows there are, by the file and by its groups.
    fn rows(&self) -> Result<u64> {
        let said = self.metadata.file_metadata().num_rows();
        let mut groups = self.metadata.row_groups().iter().map(RowGroupMetaData::num_rows);
        let sum = groups.try_fold(0_u64, |sum, rows| sum.checked_add(rows.try_into().ok()?));
        sum.filter(|sum| u64::try_from(said) == Ok(*sum)).ok_or_else(|| {
            ColumnsError::damaged(self.path, &format!("its groups do not add up to {said} rows"))
        })
    }

    /// Hand over the rows, some at a time with how many they are, until `each` wants no more.
    pub fn read(&self, mut each: impl FnMut(usize, &[Cells]) -> Result<bool>) -> Result<()> {
        self.rows()?;
        let budget = Budget::of(self.path);
        for group in self.metadata.row_groups() {
            // `rows` has seen that it is no negative number.
            let mut left = usize::try_from(group.num_rows()).unwrap_or_default();
            let columns = group.columns().iter();
            let mut columns = columns
                .map(|chunk| self.cells(chunk, left, &budget))
                .collect::<Result<Vec<_>, _>>()?;
            while left > 0 {
                let rows = left.min(BATCH_ROWS);
                for (cells, chunk) in columns.iter_mut().zip(group.columns()) {
                    let read = cells.read(rows).map_err(|error| self.error(chunk, error))?;
                    if read < rows {
                        let missing =
                            format!("{} of {} rows are missing", left - read, group.num_rows());
                        return Err(self.error(chunk, ParquetError::EOF(missing)));
                    }
                }
                if !each(rows, &columns)? {
                    return Ok(());
                }
                left -= rows;
            }
        }
        Ok(())
    }

    fn cells(
        &self,
        chunk: &ColumnChunkMetaData,
        rows: usize,
        budget: &Arc<Budget>,
    ) -> Result<Cells> {
        let (start, length) = chunk.byte_range();
        let whole = self.file.metadata().map_err(|error| ColumnsError::file(self.path, error))?;
        if start.checked_add(length).is_none_or(|end| end > whole.len()) {
            let reason = format!("{length} bytes from {start} on are not all there");
            return Err(self.error(chunk, ParquetError::EOF(reason)));
        }
        let grown = shared(chunk).then(|| Share::new(budget, &chunk.column_path().string()));
        Pages::new(self.file.clone(), chunk, rows, budget)
            .and_then(|pages| {
                let other = || ParquetError::NYI("another type".to_owned());
                Cells::new(chunk.column_descr_ptr(), pages, grown).ok_or_else(other)
            })
            .map_err(|error| self.error(chunk, error))
    }

    /// What went wrong with a column: our own error, or that of the `parquet` crate.
    fn error(&self, chunk: &ColumnChunkMetaData, error: ParquetError) -> ColumnsError {
        let column = chunk.column_path();
        let damaged = |reason: &dyn std::fmt::Display| {
            ColumnsError::damaged(self.path, &format!("column `{}`: {reason}", column.string()))
        };
        match error {
            ParquetError::External(cause) => match cause.downcast::<ColumnsError>() {
                Ok(error) => *error,
                Err(error) => damaged(&error),
            },
            error => damaged(&error),
        }
    }
}

/// See that a file ends as one of Parquet, in a description of which there is not too much.
fn check_end(path: &Path, mut file: &File) -> Result<()> {
    let io = |error| ColumnsError::file(path, error);
    let length = file.metadata().map_err(io)?.len();
    let Some(start) = length.checked_sub(FOOTER_SIZE as u64) else {
        return Err(not_parquet(path, format!("{length} bytes are too short for one")));
    };
    let mut end = [0; 4];
    file.seek(SeekFrom::Start(start)).map_err(io)?;
    file.read_exact(&mut end).map_err(io)?;
    let (said, most) = (u64::from(u32::from_le_bytes(end)), most_file_bytes());
    if said > most.min(start) {
        let reason = format!(
            "the description at its end claims {said} bytes, of {start}; {most} are read at most"
        );
        return Err(not_parquet(path, reason));
    }
    Ok(())
}

fn not_parquet(path: &Path, reason: String) -> ColumnsError {
    ColumnsError::NotParquet { path: path.to_owned(), reason }
}
