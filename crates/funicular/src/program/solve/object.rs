//! The JSON of one answer among many: the object of a single answer, and where its system stands.

use funicular::{Error, Lists, SolveAnswer};
use serde::Serialize;

use crate::exit::Failure;

/// Where a system stands.
#[derive(Debug, Clone, Copy, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin<'a> {
    /// In this line of a batch, from 1.
    Line(u64),
    /// In this file.
    File(&'a str),
}

#[derive(Serialize)]
struct Placed<'a, T> {
    #[serde(flatten)]
    origin: Origin<'a>,
    #[serde(flatten)]
    content: T,
}

/// What stands in the place of an answer.
#[derive(Serialize)]
pub struct Unanswered {
    error: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    key: Option<String>,
    /// Where in the line of a batch, in characters from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    column: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    help: Option<String>,
    /// What each solver said, where all that were asked gave up.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    failures: Vec<funicular::Failure>,
}

impl Unanswered {
    /// What is no answer of the library.
    pub fn because(error: &impl ToString) -> Self {
        Self { error: error.to_string(), key: None, column: None, help: None, failures: vec![] }
    }

    /// What stopped the answer.
    pub fn by(failure: &Failure) -> Self {
        let (error, help) = failure.words();
        Self { help: help.map(str::to_owned), ..Self::because(&error) }
    }

    /// What the library says of a line, with its place taken apart.
    pub fn of(error: &Error) -> Self {
        let because = Self::because(error);
        match error {
            Error::File(error) => Self {
                error: error.kind().to_string(),
                key: error.key().map(str::to_owned),
                column: error.position().map(|place| place.column),
                help: error.help(),
                ..because
            },
            Error::Unsolved(answer) => {
                let failures = answer.failures().iter().map(funicular::Failure::of).collect();
                Self { failures, ..because }
            }
            _ => because,
        }
    }

    /// As JSON, in one line or for people.
    pub fn text(self, origin: Origin<'_>, pretty: bool) -> serde_json::Result<String> {
        text(&Placed { origin, content: self }, pretty)
    }
}

/// An answer as JSON, in one line or for people, with a line end.
pub fn answer(
    origin: Origin<'_>,
    answer: &SolveAnswer,
    lists: Lists,
    pretty: bool,
) -> serde_json::Result<String> {
    text(&Placed { origin, content: answer.json(lists) }, pretty)
}

fn text(object: &impl Serialize, pretty: bool) -> serde_json::Result<String> {
    let text =
        if pretty { serde_json::to_string_pretty(object) } else { serde_json::to_string(object) };
    text.map(|text| text + "\n")
}
