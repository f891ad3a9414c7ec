//! Rows of comma-separated values: names and numbers, with quotes where a name has a comma (RFC
//! 4180).

use std::borrow::Cow;
use std::ops::Range;

use super::kind::SystemFileErrorKind as Kind;
use super::location::span_of;
use super::rows::{Cell, Rows};

/// Hand the rows of a text to who takes them in. What is no table of cells is an error with its
/// place.
pub(super) fn feed(text: &str, rows: &mut dyn Rows) -> Result<(), (Kind, Range<usize>)> {
    let mut lines = lines(text);
    let head = lines.next().unwrap_or(&text[..0]);
    let separator = head.find([';', '\t', '|']).filter(|_| !head.contains(','));
    if let Some(found) = separator.and_then(|at| head[at..].chars().next()) {
        return Err((Kind::Separator(found), span_of(text, head)));
    }
    let mut cells = Vec::new();
    split(head, &mut cells).map_err(|()| (Kind::OpenQuote, span_of(text, head)))?;
    let names: Vec<&str> = cells.iter().map(|(cell, _)| cell.as_ref()).collect();
    let wanted = names.len();
    if !rows.names(&names) {
        return Ok(());
    }
    for line in lines {
        split(line, &mut cells).map_err(|()| (Kind::OpenQuote, span_of(text, line)))?;
        if cells.len() != wanted {
            let found = if line.trim().is_empty() { 0 } else { cells.len() };
            return Err((Kind::WrongCells { wanted, found }, span_of(text, line)));
        }
        let cells = cells.iter();
        let cells = cells.map(|(c, _)| if c.is_empty() { Cell::Nothing } else { Cell::Text(c) });
        let row: Vec<Cell<'_>> = cells.collect();
        if !rows.row(&row) {
            break;
        }
    }
    Ok(())
}

/// Where a cell stands: row 0 is the head. The whole line where it has no such column.
pub(super) fn place(text: &str, row: usize, column: Option<usize>) -> Range<usize> {
    let Some(line) = lines(text).nth(row) else { return 0..0 };
    let mut cells = Vec::new();
    let cell = match (split(line, &mut cells), column) {
        (Ok(()), Some(column)) => cells.get(column).map(|(_, place)| place.clone()),
        _ => None,
    };
    let begin = span_of(text, line);
    cell.map_or(begin.clone(), |cell| begin.start + cell.start..begin.start + cell.end)
}

/// Lines without their ends, up to the last that is not blank.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    let text = text.trim_end();
    text.split('\n').map(|line| line.strip_suffix('\r').unwrap_or(line))
}

/// The cells of a line without the blanks around them, and where they stand in it.
fn split<'a>(line: &'a str, cells: &mut Vec<(Cow<'a, str>, Range<usize>)>) -> Result<(), ()> {
    cells.clear();
    let mut at = 0;
    loop {
        let rest = &line[at..];
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t']).len();
        if rest[blanks..].starts_with('"') {
            let (cell, length) = quoted(&rest[blanks..]).ok_or(())?;
            let end = at + blanks + length;
            cells.push((cell, at + blanks..end));
            let behind = line[end..].trim_start_matches([' ', '\t']);
            at = line.len() - behind.len();
            match behind.chars().next() {
                None => return Ok(()),
                Some(',') => at += 1,
                Some(_) => return Err(()),
            }
        } else {
            let length = rest.find(',').unwrap_or(rest.len());
            let cell = rest[..length].trim();
            cells.push((Cow::Borrowed(cell), span_of(line, cell)));
            if length == rest.len() {
                return Ok(());
            }
            at += length + 1;
        }
    }
}

/// What stands between the quote that a text begins with and its partner, two quotes being one; and
/// how long that is with the quotes.
fn quoted(text: &str) -> Option<(Cow<'_, str>, usize)> {
    let mut end = 1;
    loop {
        end += text[end..].find('"')?;
        if !text[end + 1..].starts_with('"') {
            break;
        }
        end += 2;
    }
    let inside = &text[1..end];
    let cell =
        if inside.contains('"') { inside.replace("\"\"", "\"").into() } else { inside.into() };
    Some((cell, end + 1))
}
