//! The sections of a MoorDyn input file, and their tables.

use std::collections::HashMap;

use crate::error::{At, Result, Wrong, shortened};

/// The sections that are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Section {
    LineTypes,
    Points,
    Lines,
    Bodies,
    Options,
    /// Rods and their types: only empty ones can be read.
    Rods,
    /// What is written by MoorDyn.
    Outputs,
    /// The line before the first section, and the one after the last.
    Frame,
}

/// What the heading of a section says, in the order in which they are tried.
const HEADINGS: &[(&str, Section)] = &[
    ("LINE TYPES", Section::LineTypes),
    ("LINE DICTIONARY", Section::LineTypes),
    ("ROD", Section::Rods),
    ("BODIES", Section::Bodies),
    ("BODY", Section::Bodies),
    ("NODE PROPERTIES", Section::Points),
    ("CONNECTION PROPERTIES", Section::Points),
    ("POINT", Section::Points),
    ("LINES", Section::Lines),
    ("LINE PROPERTIES", Section::Lines),
    ("LINE LIST", Section::Lines),
    ("OPTIONS", Section::Options),
    ("OUTPUT", Section::Outputs),
    ("NEED THIS LINE", Section::Frame),
    ("INPUT FILE", Section::Frame),
];
/// What begins a comment, unless the file has another use for it.
pub(super) const COMMENTS: &[char] = &['!', '#', '%'];
/// The column that may be empty at the end of a row, and of which all that follows is a part.
const FLAGS: &str = "flags";
/// Lines of names and of units above a table.
const HEAD: usize = 2;

/// The lines of a section with their numbers, without comments and empty lines.
pub(super) struct Table<'a> {
    file: &'a str,
    heading: usize,
    lines: Vec<(usize, &'a str)>,
}

/// All sections of a file.
pub(super) struct Sections<'a> {
    pub(super) file: &'a str,
    title: Option<String>,
    tables: HashMap<Section, Table<'a>>,
}

/// A row of a table.
pub(super) struct Row<'a> {
    file: &'a str,
    line: usize,
    words: Vec<&'a str>,
    units: &'a str,
    columns: HashMap<&'static str, usize>,
}

impl<'a> Sections<'a> {
    pub(super) fn parse(text: &'a str, file: &'a str, comments: &[char]) -> Result<Self> {
        let mut sections = Self { file, title: None, tables: HashMap::new() };
        let mut current = Section::Frame;
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        if text.trim().is_empty() {
            return Err(At::file(file).error(Wrong::Empty));
        }
        for (k, line) in text.lines().enumerate() {
            let number = k + 1;
            if line.contains("---") {
                current = heading(line, file, number)?;
                let table = || Table { file, heading: number, lines: vec![] };
                if current != Section::Frame
                    && current != Section::Rods
                    && sections.tables.contains_key(&current)
                {
                    let what =
                        format!("the section {:?}", shortened(line.trim_matches(['-', ' '])));
                    return Err(At::line(file, number).repeated(what));
                }
                sections.tables.entry(current).or_insert_with(table);
                continue;
            }
            // MAP++ has a use for what a line begins with.
            let bare = line.split(comments).next().unwrap_or_default().trim_end();
            if bare.is_empty() {
                continue;
            }
            match sections.tables.get_mut(&current) {
                Some(table) if current != Section::Frame => table.lines.push((number, bare)),
                // Free text before the first section: its first line is the title.
                _ => {
                    sections.title = sections.title.take().or_else(|| Some(bare.trim().to_owned()));
                }
            }
        }
        if let Some(rods) = sections.tables.get(&Section::Rods)
            && let Some((line, rod)) = rods.lines.get(HEAD)
        {
            return Err(
                At::line(file, *line).out_of_scope(format!("the rod {:?}", shortened(rod.trim())))
            );
        }
        Ok(sections)
    }

    /// The name of the system.
    pub(super) fn title(&self) -> String {
        self.title.clone().unwrap_or_else(|| "unnamed".to_owned())
    }

    pub(super) fn get(&self, section: Section) -> Option<&Table<'a>> {
        self.tables.get(&section)
    }

    pub(super) fn need(&self, section: Section) -> Result<&Table<'a>> {
        self.get(section).ok_or_else(|| {
            At::file(self.file).missing(format!(
                "section {}",
                HEADINGS.iter().find(|(_, one)| *one == section).map_or("", |(name, _)| name)
            ))
        })
    }

    /// Lines of a section without a head.
    pub(super) fn lines(&self, section: Section) -> &[(usize, &'a str)] {
        self.get(section).map_or(&[], |table| &table.lines)
    }
}

fn heading(line: &str, file: &str, number: usize) -> Result<Section> {
    let text = line.trim_matches(|c: char| c == '-' || c.is_whitespace()).to_uppercase();
    if text.is_empty() {
        return Ok(Section::Frame);
    }
    let known = HEADINGS.iter().find(|(name, _)| text.contains(name));
    known.map(|(_, section)| *section).ok_or_else(|| {
        At::line(file, number).unknown(format!("the section {:?}", shortened(&text)))
    })
}

impl<'a> Table<'a> {
    /// The rows under the names and units of the columns. `known` has for each column that is read
    /// the names that it goes by; those without a name are known and have no bearing on statics.
    pub(super) fn rows(&self, known: &[(&'static str, &[&str])]) -> Result<Vec<Row<'a>>> {
        // Decks of OpenFAST begin a table with the number of its rows: `2  NTypes  - number of line types`.
        let mut lines = self.lines.as_slice();
        let first = |text: &'a str| text.split_whitespace().next()?.parse::<usize>().ok();
        if let Some(((line, text), rest)) = lines.split_first()
            && let Some(count) = first(text)
        {
            lines = rest;
            if count != rest.len().saturating_sub(HEAD) {
                let what = "the number in front of the table".to_owned();
                let wanted = "that of its rows";
                let wrong = Wrong::Value { what, wanted, found: count.to_string() };
                return Err(At::line(self.file, *line).error(wrong));
            }
        }
        let Some((line, names)) = lines.first() else {
            return Err(
                At::line(self.file, self.heading).missing("line with the names of the columns")
            );
        };
        let mut columns = HashMap::new();
        let names: Vec<_> = names.split_whitespace().collect();
        for (k, name) in names.iter().enumerate() {
            let lower = name.to_lowercase();
            // `Y0` is a place and `y0` an angle: the name as it stands goes first.
            let find = |name: &str| known.iter().find(|(_, aliases)| aliases.contains(&name));
            let column = find(name).or_else(|| find(&lower));
            let Some((column, _)) = column else {
                return Err(
                    At::line(self.file, *line).unknown(format!("the column {:?}", shortened(name)))
                );
            };
            if !column.is_empty() && columns.insert(*column, k).is_some() {
                return Err(At::line(self.file, *line).repeated(format!("the column {name:?}")));
            }
        }
        let wanted = names.len() - usize::from(columns.get(FLAGS) == Some(&(names.len() - 1)));
        let units = lines.get(1).map_or("", |(_, units)| *units);
        let rows = lines.iter().skip(HEAD).map(|(line, text)| {
            let words: Vec<_> = text.split_whitespace().collect();
            if words.len() < wanted {
                let wrong = Wrong::Count { wanted, found: words.len() };
                return Err(At::line(self.file, *line).error(wrong));
            }
            let (file, line) = (self.file, *line);
            Ok(Row { file, line, words, units, columns: columns.clone() })
        });
        rows.collect()
    }
}

impl Row<'_> {
    pub(super) fn at(&self) -> At<'_> {
        At::line(self.file, self.line)
    }

    pub(super) fn text(&self, column: &str) -> Result<&str> {
        let place = self.columns.get(column).copied();
        let place = place.ok_or_else(|| self.at().missing(format!("column for {column}")))?;
        Ok(self.words[place])
    }

    /// The flags.
    pub(super) fn flags(&self) -> &[&str] {
        let flags = self.columns.get(FLAGS).and_then(|place| self.words.get(*place..));
        flags.unwrap_or_default()
    }

    /// Whether a word is among the flags, in any case.
    pub(super) fn has_flag(&self, flag: &str) -> bool {
        self.flags().iter().any(|word| word.eq_ignore_ascii_case(flag))
    }

    /// The unit of a column as the line below its name says.
    pub(super) fn unit(&self, column: &str) -> &str {
        let unit =
            self.columns.get(column).and_then(|place| self.units.split_whitespace().nth(*place));
        unit.unwrap_or_default().trim_matches(['(', ')', '[', ']'])
    }

    pub(super) fn number(&self, column: &str) -> Result<f64> {
        self.as_number(column, self.text(column)?)
    }

    /// A part of a column as a number.
    pub(super) fn as_number(&self, column: &str, text: &str) -> Result<f64> {
        self.at().number(column, text)
    }

    /// The number of a column that need not be there.
    pub(super) fn optional(&self, column: &str) -> Result<Option<f64>> {
        if self.columns.contains_key(column) { self.number(column).map(Some) } else { Ok(None) }
    }

    pub(super) fn positive(&self, column: &str) -> Result<f64> {
        self.at().positive(column, self.text(column)?)
    }
}
