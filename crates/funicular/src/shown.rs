//! Shapes, modes, motions and load paths of a system on one HTML page.

use figures::Escaped;
use model::Vector;
use model::system::System;
use serde::Serialize;

use crate::modes::Mode;
use crate::moving_page::{self, Data, flat, plain, plain_lines, six};
use crate::picture::heading;
use crate::track::{Short, Track};

const PAGE: &str = include_str!("page.html");
/// The file beside the picture, and what asks for what becomes of it.
const PANEL: &str = include_str!("live/panel.html");
const LIVE: &str = include_str!("live/live.js");

/// What a page shows.
#[derive(Debug, Clone, Default, Serialize)]
pub(crate) struct Shown {
    /// What stands behind the name of the system.
    #[serde(skip)]
    pub heading: &'static str,
    /// The answer in words and tables, if there is one.
    #[serde(skip)]
    pub words: String,
    /// Whether what moves is shown first, moving.
    pub play: bool,
    /// Shapes at rest.
    pub shapes: Vec<Shape>,
    /// What moves.
    pub tracks: Vec<Track>,
}

/// A shape at rest.
#[derive(Debug, Clone, Default, Serialize)]
pub(crate) struct Shape {
    pub group: &'static str,
    pub label: String,
    pub x: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub axial: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub used: Option<Vec<Option<f64>>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub facts: Option<String>,
    /// Forces of the ground, N, with the names of their joints.
    pub ground: Vec<(String, Vec<f64>)>,
    /// Whether each rung is reached, its name, and how or why not.
    pub rungs: Vec<(bool, String, String)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub modes: Option<Vec<ModeShown>>,
}

#[derive(Debug, Clone, Serialize)]
pub(crate) struct ModeShown {
    name: String,
    what: String,
    omega2: f64,
    shape: Vec<Short>,
}

impl Shape {
    /// Places alone.
    pub fn bare(
        system: &System,
        group: &'static str,
        label: &str,
        joints_m: impl Iterator<Item = Vector>,
    ) -> Self {
        let (label, x) = (plain(label), flat(system, joints_m));
        Self { group, label, x, ..Self::default() }
    }

    /// The same with modes.
    pub fn with_modes(self, modes: &[Mode]) -> Self {
        let shown = modes.iter().enumerate().map(|(k, mode)| ModeShown {
            name: heading(k, mode),
            what: mode.what.clone(),
            omega2: six(mode.omega2_s2),
            shape: mode.shape.iter().flatten().map(|x| Short::decimals(*x, 4)).collect(),
        });
        Self { modes: Some(shown.collect()), ..self }
    }
}

/// What a page shows first that asks for more.
#[derive(Serialize)]
pub(crate) struct Start<'a> {
    /// The file.
    pub text: &'a str,
    /// The answer in words.
    #[serde(skip)]
    pub words: &'a str,
    /// Why there is none.
    pub error: Option<&'a str>,
    /// Whether it stands in another page, which passes its questions on.
    pub embedded: bool,
    #[serde(flatten)]
    pub data: &'a serde_json::Value,
}

impl Shown {
    /// The page.
    pub fn html(&self, system: &System) -> String {
        let name = match self.heading {
            "" => plain(system.name()),
            heading => format!("{}: {heading}", plain(system.name())),
        };
        page(["", ""], &name, &self.words, &moving_page::json(&Data::new(system, self)))
    }
}

impl Start<'_> {
    /// The page of a system that is changed beside its file.
    pub fn html(&self) -> String {
        page([PANEL, LIVE.trim_end()], "funicular", self.words, &moving_page::json(self))
    }
}

fn page([panel, script]: [&str; 2], name: &str, words: &str, data: &str) -> String {
    let words = Escaped(&plain_lines(words)).to_string().replace('@', "&#64;");
    let page = PAGE.replace("@PANEL@", panel).replace("@LIVE@", script);
    moving_page::filled(&page, name, &words, data)
}
