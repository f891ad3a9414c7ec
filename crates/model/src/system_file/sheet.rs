//! A file of joints or bars that a system file names: reading its rows, and placing errors in it.

use std::path::PathBuf;

use super::csv;
use super::error::{Result, SystemFileError};
use super::kind::SystemFileErrorKind as Kind;
use super::load::{Loaded, without_mark};
use super::named;
use super::row_table::{Fault, Known, Row, RowTable, Wrong};
use super::table::Table;

/// A file of columns, named by a key of the system file.
pub(super) struct SheetFile {
    key: &'static str,
    path: PathBuf,
    /// The text, where the file is text.
    text: Option<Loaded>,
}

impl SheetFile {
    /// Read the file that `key` names, row by row; nothing if the key is not there.
    pub(super) fn read(
        root: &Table<'_>,
        key: &'static str,
        known: &'static Known,
        take: &mut dyn FnMut(&Row<'_>) -> Result<(), Wrong>,
    ) -> Result<Option<Self>> {
        let Some(file) = root.text(key)? else { return Ok(None) };
        let source = root.source();
        let Some(folder) = source.folder else {
            return Err(root.error(Kind::NoFolder(key), key));
        };
        let path = folder.join(file);
        let mut rows = RowTable::new(known, take);
        if let Some(read) = source.rows.and_then(|reader| reader(&path, &mut rows)) {
            read.map_err(|cause| root.error(Kind::ForeignBars(cause), key))?;
            let sheet = Self { key, path, text: None };
            return match rows.finish() {
                Some(fault) => Err(sheet.fault(root, fault)),
                None => Ok(Some(sheet)),
            };
        }
        let loaded = named::text(root, key, path.clone(), known.columns)?;
        let fed = csv::feed(without_mark(&loaded.text), &mut rows);
        let fault = rows.finish();
        let sheet = Self { key, path, text: Some(loaded) };
        match (fed, fault) {
            (Err((kind, span)), _) => Err(sheet.at(kind, None, span)),
            (Ok(()), Some(fault)) => Err(sheet.fault(root, fault)),
            (Ok(()), None) => Ok(Some(sheet)),
        }
    }

    fn fault(&self, root: &Table<'_>, fault: Fault) -> SystemFileError {
        let Fault { row, column, kind } = fault;
        if let Some(loaded) = &self.text {
            let (number, name) = column.unzip();
            let span = csv::place(without_mark(&loaded.text), row, number);
            return self.at(kind, name, span);
        }
        let column = column.map(|(_, name)| name);
        let (path, kind) = (self.path.clone(), Box::new(kind));
        root.error(Kind::Row { path, row, column, kind }, self.key)
    }

    /// An error about a whole row, from 1.
    pub(super) fn row_error(&self, root: &Table<'_>, row: usize, kind: Kind) -> SystemFileError {
        self.fault(root, Fault { row, column: None, kind })
    }

    fn at(&self, kind: Kind, key: Option<String>, span: std::ops::Range<usize>) -> SystemFileError {
        let (file, text) = self
            .text
            .as_ref()
            .map_or(("", ""), |loaded| (loaded.file.as_str(), loaded.text.as_str()));
        let key = key.filter(|key| !key.is_empty());
        SystemFileError::new(file, without_mark(text), Some(span), key, kind)
    }
}
