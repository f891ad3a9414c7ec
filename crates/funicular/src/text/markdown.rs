//! Pages of Markdown for a terminal: paragraphs in lines that fit, tables as tables.

use comfy_table::{ColumnConstraint, Width};

use super::tables::{table, wrapped};

/// A page as the terminal shows it. Headings and blocks of code stay as they are.
pub fn page(text: &str) -> String {
    let mut out = String::new();
    let (mut paragraph, mut rows, mut is_code) = (String::new(), Vec::new(), false);
    for line in text.lines().chain([""]) {
        let is_fence = line.trim_start().starts_with("```");
        let is_row = !is_code && line.starts_with('|');
        let starts = ["* ", "- ", "#"].iter().any(|mark| line.trim_start().starts_with(mark));
        let goes_on = !is_code && !is_fence && !is_row && !starts && !line.is_empty();
        if !goes_on && !paragraph.is_empty() {
            let indent = paragraph.len() - paragraph.trim_start_matches([' ', '*', '-']).len();
            out.push_str(&wrapped(&paragraph, indent));
            out.push('\n');
            paragraph.clear();
        }
        if !is_row && !rows.is_empty() {
            out.push_str(&tabled(&rows));
            rows.clear();
        }
        match () {
            () if is_row => rows.push(cells(line)),
            () if goes_on && paragraph.is_empty() => line.clone_into(&mut paragraph),
            () if goes_on => {
                paragraph.push(' ');
                paragraph.push_str(line.trim_start());
            }
            () if starts && !is_code && !line.starts_with('#') => line.clone_into(&mut paragraph),
            () => {
                out.push_str(line);
                out.push('\n');
            }
        }
        is_code ^= is_fence;
    }
    out.truncate(out.trim_end().len());
    out + "\n"
}

/// The cells of a row of a table.
fn cells(row: &str) -> Vec<String> {
    let inner = row.trim().trim_start_matches('|').trim_end_matches('|').replace("\\|", "\u{2}");
    inner.split('|').map(|cell| cell.trim().replace('\u{2}', "|")).collect()
}

/// A table whose first column, what is looked for, is not broken where there is room.
fn tabled(rows: &[Vec<String>]) -> String {
    let Some((head, rows)) = rows.split_first() else { return String::new() };
    let mut shown = table(head.iter().map(String::as_str));
    let is_rule =
        |row: &&Vec<String>| row.iter().all(|cell| cell.chars().all(|c| c == '-' || c == ':'));
    for row in rows.iter().filter(|row| !is_rule(row)) {
        shown.add_row(row.iter().cloned());
    }
    let longest = rows.iter().filter_map(|row| row.first()).map(|cell| cell.chars().count()).max();
    if let (Some(first), Some(longest)) = (shown.column_mut(0), longest) {
        let width = u16::try_from(longest.min(28) + 2).unwrap_or(30);
        first.set_constraint(ColumnConstraint::LowerBoundary(Width::Fixed(width)));
    }
    format!("{shown}\n")
}
