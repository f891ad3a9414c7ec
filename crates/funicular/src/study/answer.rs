//! All points of a study, as CSV and JSON.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::io::{self, Write};

use model::Vector;
use model::system::System;
use serde::Serialize;

use super::figure;
use super::shape::{NoShape, StudyShape};
use crate::csv::{exact, or_empty, quoted};
use crate::object::{either, head, names};

/// The columns of every study between its parameters and its supports.
const COLUMNS: &str = "agrees evidence energy_j sag_m lowest_joint lowest_x_m lowest_y_m \
     lowest_z_m tension_n tension_bar compression_n compression_bar";

/// A point of a study.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StudyPoint {
    /// Number of its path, from 1: each combination of all parameters but the last has one.
    pub path: usize,
    /// Values of the parameters.
    pub values: Vec<f64>,
    /// The hanging shape, or why there is none.
    #[serde(flatten, serialize_with = "either")]
    pub shape: Result<StudyShape, NoShape>,
}

/// The hanging shape at every point.
#[derive(Debug, Clone, PartialEq)]
pub struct StudyAnswer {
    pub(super) system: System,
    /// Whether there is a distance of anchors.
    pub(super) spans: bool,
    pub(super) parameters: Vec<String>,
    pub(super) units: Vec<&'static str>,
    pub(super) of: Vec<(String, &'static str)>,
    pub(super) paths: usize,
    pub(super) points: Vec<StudyPoint>,
}

impl StudyAnswer {
    /// The names of the parameters, as in the system file.
    pub fn parameters(&self) -> &[String] {
        &self.parameters
    }

    /// The units of the parameters.
    pub fn units(&self) -> &[&'static str] {
        &self.units
    }

    /// What is shown besides, with its units, in the order in which it was asked for.
    pub fn of(&self) -> &[(String, &'static str)] {
        &self.of
    }

    /// The name of the system whose numbers vary.
    pub fn name(&self) -> &str {
        self.system.name()
    }

    /// The joints that are held by name, in the order of [`StudyShape::reactions_n`].
    pub fn supports(&self) -> Vec<Cow<'_, str>> {
        let held = self.system.joints().iter().filter(|joint| joint.support.at_m().is_some());
        held.map(|joint| joint.name.text()).collect()
    }

    /// The most bars that a point has.
    fn bars(&self) -> usize {
        let bars = self.shapes().map(|shape| shape.rises_deg.len()).max();
        bars.unwrap_or(self.system.members().len())
    }

    /// The points, the last parameter changing fastest.
    pub fn points(&self) -> &[StudyPoint] {
        &self.points
    }

    /// Which parameters take more than one value at these points; the last if none does.
    pub fn moving(&self, points: &[&StudyPoint]) -> Vec<bool> {
        let last = self.parameters.len().saturating_sub(1);
        let moves = |k: usize| {
            points.windows(2).any(|two| two[0].values[k].total_cmp(&two[1].values[k]).is_ne())
        };
        let mut all: Vec<bool> = (0..self.parameters.len()).map(moves).collect();
        if !all.contains(&true)
            && let Some(last) = all.get_mut(last)
        {
            *last = true;
        }
        all
    }

    /// How many paths there are: combinations of all parameters but the last.
    pub fn paths(&self) -> usize {
        self.paths
    }

    /// The shapes that were found.
    pub fn shapes(&self) -> impl Iterator<Item = &StudyShape> {
        self.points.iter().filter_map(|point| point.shape.as_ref().ok())
    }

    /// Whether a check failed at some point.
    pub fn check_failed(&self) -> bool {
        self.shapes().any(|shape| shape.check_failed)
    }

    /// Whether every point is solved by every solver that was asked, as a solve of it alone would
    /// have it, or refused because nothing can hang there.
    pub fn is_decided(&self) -> bool {
        self.points.iter().all(|point| match &point.shape {
            Ok(shape) => shape.is_decided,
            Err(none) => none.refused,
        })
    }

    /// Why no value of the parameters describes what can hang, if none does.
    pub fn refused_everywhere(&self) -> Option<&str> {
        let mut reasons = self.points.iter().map(|point| match &point.shape {
            Err(NoShape { refused: true, reason }) => Some(reason.as_str()),
            _ => None,
        });
        let first = reasons.next()??;
        reasons.all(|reason| reason.is_some()).then_some(first)
    }

    /// A line per point as CSV, units in the names of the columns; what a refused point has not is
    /// empty.
    ///
    /// # Errors
    /// When `to` cannot be written.
    pub fn write_csv(&self, mut to: impl Write) -> io::Result<()> {
        let bars = self.bars();
        let mut columns = vec!["path".to_owned()];
        columns.extend(self.parameters.iter().map(quoted));
        columns.extend(self.spans.then(|| "span_m".to_owned()));
        columns.extend(COLUMNS.split(' ').map(str::to_owned));
        let forces = |support| ["x", "y", "z"].map(|axis| quoted(format!("{support}_{axis}_n")));
        columns.extend(self.supports().into_iter().flat_map(forces));
        columns.extend((1..=bars).map(|bar| format!("rise_{bar}_deg")));
        columns.extend(self.of.iter().map(|(name, _)| quoted(name)));
        writeln!(to, "{},refused", columns.join(","))?;
        for point in &self.points {
            let mut cells = vec![point.path.to_string()];
            cells.extend(point.values.iter().map(exact));
            let shape = point.shape.as_ref();
            cells.extend(shape.map_or_else(|_| vec![], |shape| self.cells(shape, bars)));
            cells.resize(columns.len(), String::new());
            cells.push(shape.err().map_or_else(String::new, |none| quoted(&none.reason)));
            writeln!(to, "{}", cells.join(","))?;
        }
        Ok(())
    }

    /// The cells of a line after the values of the parameters.
    fn cells(&self, shape: &StudyShape, bars: usize) -> Vec<String> {
        let StudyShape { agrees, energy_j, extremes, lowest_joint, .. } = shape;
        let mut cells = vec![];
        cells.extend(self.spans.then(|| or_empty(shape.span_m)));
        let rung = shape.rung.map_or_else(String::new, |rung| rung.to_string());
        cells.extend([agrees.to_string(), rung, exact(energy_j), or_empty(extremes.sag_m)]);
        cells.push(quoted(lowest_joint));
        cells.extend(extremes.lowest_m.iter().map(exact));
        for largest in [extremes.tension_n, extremes.compression_n] {
            let (bar, force_n) = largest.unzip();
            cells.extend([or_empty(force_n), or_empty(bar.map(|bar| bar + 1))]);
        }
        cells.extend(shape.reactions_n.as_flattened().iter().map(exact));
        cells.extend((0..bars).map(|bar| or_empty(shape.rises_deg.get(bar))));
        cells.extend(shape.of.iter().map(|value| or_empty(*value)));
        cells
    }

    /// Sag, forces and angles over the last parameter as SVG, for one path, from 1.
    pub fn figure(&self, path: usize) -> String {
        figure::figure(self, path)
    }
}

/// As `funicular study --json` prints it.
impl Serialize for StudyAnswer {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct Point<'a> {
            #[serde(flatten)]
            at: &'a StudyPoint,
            #[serde(skip_serializing_if = "Option::is_none")]
            reactions_n: Option<BTreeMap<&'a str, Vector>>,
        }
        #[derive(Serialize)]
        struct Object<'a> {
            #[serde(flatten, serialize_with = "head")]
            system: &'a System,
            parameters: &'a [String],
            units: &'a [&'static str],
            #[serde(skip_serializing_if = "<[_]>::is_empty", serialize_with = "names")]
            of: &'a [(String, &'static str)],
            points: Vec<Point<'a>>,
        }
        let Self { system, parameters, units, of, points, .. } = self;
        let supports = self.supports();
        let reactions = |shape: &StudyShape| {
            supports.iter().map(|name| &**name).zip(shape.reactions_n.clone()).collect()
        };
        let points = points.iter().map(|point| {
            let shape = point.shape.as_ref().ok();
            Point { at: point, reactions_n: shape.map(reactions) }
        });
        Object { system, parameters, units, of, points: points.collect() }.serialize(serializer)
    }
}
