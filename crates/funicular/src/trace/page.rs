//! Load paths as one HTML file: the shape at every point, and the load over what is shown.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::json;

use super::load::{LoadPath, LoadPaths};
use crate::moving_page::{flat, plain, six};
use crate::shown::Shown;
use crate::text::load::happens;

/// The shapes along a path.
#[derive(Debug, Serialize)]
struct Path {
    group: &'static str,
    label: String,
    load: Vec<f64>,
    of: Vec<Option<f64>>,
    stable: Vec<bool>,
    /// What happens, by the numbers of the points.
    events: BTreeMap<usize, String>,
    x: Vec<Vec<f64>>,
    axial: Vec<Vec<f64>>,
}

impl Shown {
    /// The same with load paths beside it.
    pub(crate) fn with_paths(self, found: &LoadPaths) -> Self {
        let named = |name: &str, unit: &str| match unit {
            "1" => plain(name),
            _ => plain(&format!("{name} / {unit}")),
        };
        let last = found.parameters.len().saturating_sub(1);
        let of =
            found.of.first().map_or_else(|| "point".to_owned(), |(name, unit)| named(name, unit));
        let paths =
            found.paths.iter().enumerate().map(|(k, path)| json!(one(found, k, path, last)));
        let load = named(&found.parameters[last], found.units[last]);
        Self { load, of, paths: paths.collect(), ..self }
    }
}

/// The HTML of the page.
pub(super) fn page(found: &LoadPaths) -> String {
    let shown = Shown { heading: "load path", play: true, ..Shown::default() };
    shown.with_paths(found).html(&found.system, "")
}

fn one(found: &LoadPaths, number: usize, path: &LoadPath, last: usize) -> Path {
    let from = path.branches_from.as_ref();
    let from = from.map_or_else(String::new, |from| format!(", from path {}", from.path + 1));
    let points = path.points.iter().enumerate();
    let events = path.events.iter().map(|event| (event.point, plain(&happens(event))));
    Path {
        group: "Load paths",
        label: format!("path {}{from}", number + 1),
        load: path.points.iter().map(|point| six(point.values[last])).collect(),
        of: points.map(|(k, point)| point.of.first().map_or(Some(k as f64), |of| *of)).collect(),
        stable: path.points.iter().map(|point| point.index == 0).collect(),
        events: events.collect(),
        x: path
            .points
            .iter()
            .map(|point| flat(&found.system, point.joints_m.iter().copied()))
            .collect(),
        axial: path
            .points
            .iter()
            .map(|point| point.axial_n.iter().copied().map(six).collect())
            .collect(),
    }
}
