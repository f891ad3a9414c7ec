//! Comma-separated values with a line of names: RFC 4180, blanks around cells do not count.

use crate::error::{At, Result, Wrong, shortened};

/// A table: its names, and its rows with the lines they stand in.
pub(crate) struct Sheet<'a> {
    file: &'a str,
    columns: Vec<Option<usize>>,
    names: &'a [&'a str],
    rows: Vec<Record>,
}

/// The line in which a row begins, and its cells.
type Record = (usize, Box<[String]>);

/// A row of a sheet.
pub(crate) struct Row<'a> {
    sheet: &'a Sheet<'a>,
    pub(crate) line: usize,
    cells: &'a [String],
}

impl<'a> Sheet<'a> {
    /// Read a text whose columns must all be among `names`. A name of the file that stands for one
    /// of them may be given in `aliases`.
    pub(crate) fn parse(
        file: &'a str,
        text: &str,
        names: &'a [&'a str],
        aliases: &[(&str, &str)],
    ) -> Result<Self> {
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        let mut rows = records(file, text)?.into_iter();
        let Some((line, head)) = rows.next() else {
            return Err(At::file(file).error(Wrong::Empty));
        };
        let mut columns = vec![None; names.len()];
        let known = |cell: &String| {
            aliases.iter().any(|(alias, _)| alias == cell)
                || model::system_file::nearest(cell, names).is_some()
        };
        // Such a file is another one, of which nothing is shown.
        if !head.iter().any(known) {
            let error = At::line(file, line).unknown("its first line, which names no column,");
            return Err(error.with_help(format!("columns are: {}", names.join(", "))));
        }
        for (k, cell) in head.iter().enumerate() {
            let cell =
                aliases.iter().find(|(alias, _)| alias == cell).map_or(cell.as_str(), |a| a.1);
            let Some(column) = names.iter().position(|name| *name == cell) else {
                let what = format!("the column {:?}", shortened(cell));
                let near = model::system_file::nearest(cell, names);
                let near = near.map_or(String::new(), |near| format!("did you mean `{near}`? "));
                let help = format!("{near}columns are: {}", names.join(", "));
                let error = At::line(file, line).unknown(what);
                return Err(error.with_help(help));
            };
            if columns[column].replace(k).is_some() {
                return Err(At::line(file, line).repeated(format!("the column {cell:?}")));
            }
        }
        let rows: Vec<_> = rows.collect();
        for (line, cells) in &rows {
            if cells.len() != head.len() {
                let wrong = Wrong::Count { wanted: head.len(), found: cells.len() };
                return Err(At::line(file, *line).error(wrong));
            }
        }
        Ok(Self { file, columns, names, rows })
    }

    /// Whether the sheet has a column.
    pub(crate) fn has(&self, name: &str) -> bool {
        self.place(name).is_some()
    }

    /// Refuse a sheet without a column.
    pub(crate) fn need(&self, name: &str) -> Result<()> {
        if self.has(name) {
            return Ok(());
        }
        Err(At::line(self.file, 1).missing(format!("column `{name}`")))
    }

    pub(crate) fn rows(&'a self) -> impl Iterator<Item = Row<'a>> {
        self.rows.iter().map(|(line, cells)| Row { sheet: self, line: *line, cells })
    }

    fn place(&self, name: &str) -> Option<usize> {
        self.columns[self.names.iter().position(|known| *known == name)?]
    }
}

impl Row<'_> {
    /// The cell of a column; empty where there is no such column.
    pub(crate) fn text(&self, name: &str) -> &str {
        self.sheet.place(name).map_or("", |k| self.cells[k].as_str())
    }

    /// The number of a column.
    pub(crate) fn number(&self, name: &str) -> Result<f64> {
        self.at().number(name, self.text(name))
    }

    /// The number of a column, 0 where there is no such column or its cell is empty.
    pub(crate) fn number_or_zero(&self, name: &str) -> Result<f64> {
        if self.text(name).is_empty() { Ok(0.0) } else { self.number(name) }
    }

    /// Where it stands.
    pub(crate) fn at(&self) -> At<'_> {
        At::line(self.sheet.file, self.line)
    }
}

/// The records of a text with the lines they begin in, without empty lines.
fn records(file: &str, text: &str) -> Result<Vec<Record>> {
    let mut records = Vec::new();
    let (mut cells, mut cell, mut quoted, mut was_quoted) = (vec![], String::new(), false, false);
    let (mut line, mut began) = (1, 1);
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                cell.push('"');
            }
            '"' if quoted => quoted = false,
            '"' if cell.trim().is_empty() && !was_quoted => {
                (quoted, was_quoted) = (true, true);
                cell.clear();
            }
            ',' if !quoted => {
                cells.push(finished(&mut cell, &mut was_quoted));
            }
            '\n' if !quoted => {
                cells.push(finished(&mut cell, &mut was_quoted));
                push(&mut records, began, &mut cells);
                (line, began) = (line + 1, line + 1);
            }
            c => {
                line += usize::from(c == '\n');
                cell.push(c);
            }
        }
    }
    if quoted {
        return Err(At::line(file, began).missing("end of a quoted cell"));
    }
    cells.push(finished(&mut cell, &mut was_quoted));
    push(&mut records, began, &mut cells);
    Ok(records)
}

/// A cell without the blanks around it; within quotes they count.
fn finished(cell: &mut String, quoted: &mut bool) -> String {
    let text = if *quoted { cell.trim_end().to_owned() } else { cell.trim().to_owned() };
    cell.clear();
    *quoted = false;
    text
}

fn push(records: &mut Vec<Record>, line: usize, cells: &mut Vec<String>) {
    let cells = std::mem::take(cells);
    if cells.len() > 1 || cells.iter().any(|cell| !cell.is_empty()) {
        records.push((line, cells.into_boxed_slice()));
    }
}
