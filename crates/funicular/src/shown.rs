//! Shapes, modes and load paths of a system on one HTML page.

use figures::Escaped;
use model::Vector;
use model::system::System;
use serde::Serialize;
use serde_json::Value;

use crate::mode_pages::heading;
use crate::modes::Mode;
use crate::moving_page::{self, Data, flat, plain, six};

const PAGE: &str = include_str!("page.html");
/// The file beside the picture, and what asks for what becomes of it.
const PANEL: &str = include_str!("live/panel.html");
const LIVE: &str = include_str!("live/live.js");

/// What a page shows.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Shown {
    /// What stands behind the name of the system.
    #[serde(skip)]
    pub heading: &'static str,
    /// Whether it moves from the start.
    pub play: bool,
    /// Shapes at rest.
    pub shapes: Vec<Shape>,
    /// The shapes along paths.
    pub paths: Vec<Value>,
    /// What varies along the paths.
    pub load: String,
    /// What is shown of them.
    pub of: String,
}

/// A shape at rest.
#[derive(Debug, Serialize)]
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

#[derive(Debug, Serialize)]
pub(crate) struct ModeShown {
    name: String,
    what: String,
    omega2: [f64; 1],
    shape: Vec<f64>,
}

impl Shape {
    /// Places alone.
    pub fn bare(
        system: &System,
        group: &'static str,
        label: &str,
        joints_m: impl Iterator<Item = Vector>,
    ) -> Self {
        let x = flat(system, joints_m);
        let label = plain(label);
        Self {
            group,
            label,
            x,
            axial: None,
            used: None,
            facts: None,
            ground: vec![],
            rungs: vec![],
            modes: None,
        }
    }

    /// The same with modes.
    pub fn with_modes(self, modes: &[Mode]) -> Self {
        let shown = modes.iter().enumerate().map(|(k, mode)| ModeShown {
            name: heading(k, mode),
            what: mode.what.clone(),
            omega2: [six(mode.omega2_s2)],
            shape: mode.shape.iter().flatten().copied().map(six).collect(),
        });
        Self { modes: Some(shown.collect()), ..self }
    }
}

/// A text of several lines, none of which turns what stands around it.
pub(crate) fn plain_lines(text: &str) -> String {
    text.lines().map(plain).collect::<Vec<_>>().join("\n")
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
    pub data: &'a Value,
}

impl Shown {
    /// The page, with the answer in words if there are some.
    pub fn html(&self, system: &System, words: &str) -> String {
        let name = match self.heading {
            "" => plain(system.name()),
            heading => format!("{}: {heading}", plain(system.name())),
        };
        page(["", ""], &name, words, &moving_page::json(&Data::new(system, self)))
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
