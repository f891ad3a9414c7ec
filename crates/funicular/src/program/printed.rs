//! How what is printed looks, as arguments.

use std::fmt::Display;

use clap::Args;
use funicular::text::printed::{Format, Style, Unit, unit};
use serde::Serialize;

use crate::exit::Result;
use crate::output::{print, print_json};

/// Options of every command that prints tables.
#[derive(Debug, Clone, Default, Args)]
pub struct Printed {
    /// Print one JSON object (schema_version 3) instead of tables
    #[arg(long)]
    pub json: bool,
    /// How tables are printed: for a terminal (text), or to paste (in LaTeX and CSV the lines between
    /// them are comments); json is --json
    #[arg(long, value_name = "FORMAT", value_enum, default_value_t, conflicts_with = "json")]
    pub format: Format,
    /// Units of tables and of what `solve` says below them, not of other sentences, JSON and files: `kN,mm`. There are
    /// N, kN, MN, kgf, lbf; m, mm, cm, km, ft, in; J, kJ, MJ; kg, g, t, lb
    #[arg(long, value_name = "UNITS", value_delimiter = ',', value_parser = unit)]
    pub units: Vec<Unit>,
    /// ASCII characters alone, as where the locale (LC_ALL, LC_CTYPE, LANG) names another set than UTF-8
    #[arg(long)]
    pub ascii: bool,
}

impl Printed {
    /// Print in this way from now on; before anything is printed.
    pub fn install(&self) {
        let Self { format, units, ascii, .. } = self.clone();
        Style { format, units, ascii }.install();
    }

    /// Print an answer: the object, or the text.
    pub fn print(&self, answer: &(impl Serialize + Display)) -> Result<()> {
        if self.is_json() { print_json(answer) } else { print(&answer.to_string()) }
    }

    /// Whether one object is asked for.
    pub fn is_json(&self) -> bool {
        self.json || self.format == Format::Json
    }
}
