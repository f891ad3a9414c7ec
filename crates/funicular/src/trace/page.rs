//! Load paths on a page: the shape at every point, and the load over what is shown.

use super::load::{LoadPath, LoadPaths};
use crate::moving_page::{plain, plain_lines};
use crate::shown::Shown;
use crate::text::load::{happens, sentences};
use crate::track::{Chart, Curve, Short, Track, kept};
use crate::varied::named;

/// The HTML of the page.
pub(super) fn page(found: &LoadPaths) -> String {
    let tracks = found.tracks();
    Shown { heading: "load path", play: true, tracks, ..Shown::default() }.html(&found.system)
}

impl LoadPaths {
    /// The paths. Of many points so many are kept that a page stays small, and all events.
    pub(crate) fn tracks(&self) -> Vec<Track> {
        self.paths.iter().enumerate().map(|(number, path)| self.track(number, path)).collect()
    }

    fn track(&self, number: usize, path: &LoadPath) -> Track {
        let last = self.parameters.len().saturating_sub(1);
        let event = |k: usize| path.points[k].event.map(|event| &path.events[event]);
        let kept =
            kept(&self.system, [self.paths.len(), path.points.len()], |k| event(k).is_some());
        let points: Vec<_> = kept.iter().map(|&k| &path.points[k]).collect();
        let frames = points.iter().map(|point| Some((&point.joints_m[..], &point.axial_n[..])));
        let events = kept.iter().enumerate();
        let events = events.filter_map(|(k, &point)| Some((k, plain(&happens(event(point)?)))));
        let of = |(k, name, unit): (usize, &String, &str)| Chart {
            across: named(name, unit),
            up: named(&self.parameters[last], self.units[last]),
            curves: vec![Curve {
                x: Some(Short::all(points.iter().map(|at| at.of[k].unwrap_or(f64::NAN)))),
                stable: Some(points.iter().map(|at| at.index == 0).collect()),
                ..Curve::default()
            }],
        };
        let charts = self.of.iter().enumerate().map(|(k, (name, unit))| of((k, name, unit)));
        let from = path.branches_from.as_ref();
        let from = from.map_or_else(String::new, |from| format!(", from path {}", from.path + 1));
        Track {
            group: "Load paths",
            label: format!("path {}{from}", number + 1),
            note: plain_lines(&format!(
                "A load path: the equilibrium at its start, followed.\n{}",
                sentences(self, path).join("\n")
            )),
            over: named(&self.parameters[last], self.units[last]),
            at: Short::all(points.iter().map(|point| point.values[last])),
            events: events.collect(),
            charts: charts.collect(),
            ..Track::of(&self.system, &frames.collect::<Vec<_>>())
        }
    }
}
