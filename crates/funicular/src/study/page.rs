//! The shapes of a study on a page, beside forces and energy over the last parameter.

use model::system::System;

use super::{StudyAnswer, StudyPoint, StudyShape};
use crate::moving_page::{Topology, plain, plain_lines};
use crate::track::{Chart, Curve, Short, Track, kept};
use crate::varied::named;

impl StudyAnswer {
    /// The paths; `because` says why they are no load paths.
    pub(crate) fn tracks(&self, system: &System, because: &str) -> Vec<Track> {
        (1..=self.paths).map(|path| self.track(system, path, because)).collect()
    }

    fn track(&self, system: &System, path: usize, because: &str) -> Track {
        let all: Vec<_> = self.points.iter().filter(|point| point.path == path).collect();
        let kept = kept(system, [self.paths, all.len()], |_| false);
        let points: Vec<_> = kept.iter().map(|&k| all[k]).collect();
        let drawn: Vec<_> =
            points.iter().map(|at| at.shape.as_ref().ok()?.drawn.as_ref()).collect();
        let frames = drawn.iter().map(|one| one.map(|one| (&one.joints_m[..], &one.axial_n[..])));
        let last = self.parameters.len().saturating_sub(1);
        let over = named(&self.parameters[last], self.units[last]);
        let events = points.iter().enumerate();
        let changes = drawn.iter().flatten().any(|one| one.joints_m.len() != system.joints().len());
        let nets = drawn.iter().map(|one| one.map(|one| Topology::of(&one.system)));
        Track {
            group: "Study",
            label: self.label(path, &points),
            note: plain_lines(&note(&all, because)),
            at: Short::all(points.iter().map(|point| point.values[last])),
            events: events.filter_map(|(k, at)| Some((k, plain(&said(at)?)))).collect(),
            charts: charts(&over, &points),
            nets: changes.then(|| nets.collect()),
            over,
            ..Track::of(system, &frames.collect::<Vec<_>>())
        }
    }

    fn label(&self, path: usize, points: &[&StudyPoint]) -> String {
        let values = points.first().map_or(&[][..], |first| &first.values);
        let others = self.parameters.iter().zip(&self.units).zip(values);
        let others = others.take(values.len().saturating_sub(1));
        let others = others.map(|((name, unit), x)| format!(", {} = {x}", named(name, unit)));
        plain(&format!("study {path}{}", others.collect::<String>()))
    }
}

/// What it is, and what it is not.
fn note(points: &[&StudyPoint], because: &str) -> String {
    let shapes = || points.iter().filter_map(|point| point.shape.as_ref().ok());
    let (all, found) = (points.len(), shapes().count());
    let agreed = shapes().filter(|shape| shape.agrees).count();
    format!(
        "A study, not a load path: at each of {all} values the system is solved by itself. It has a shape at {found} of them, and both \
         solvers agree at {agreed}. Between them nothing is followed or proved.\nNo load path: {because}."
    )
}

/// What is wrong at a point.
fn said(point: &StudyPoint) -> Option<String> {
    match &point.shape {
        Err(none) => Some(format!("no shape: {}", none.reason)),
        Ok(shape) if !shape.agrees => Some("the solvers do not agree".to_owned()),
        Ok(_) => None,
    }
}

fn charts(over: &str, points: &[&StudyPoint]) -> Vec<Chart> {
    let curve = |label: &str, value: &dyn Fn(&StudyShape) -> Option<f64>| {
        let value = |at: &&StudyPoint| at.shape.as_ref().ok().and_then(value).unwrap_or(f64::NAN);
        let values: Vec<f64> = points.iter().map(value).collect();
        let known = values.iter().any(|x| x.is_finite());
        known.then(|| Curve::up(label, values))
    };
    let forces = [
        curve("largest tension / N", &|shape| shape.extremes.tension_n.map(|(_, force)| force)),
        curve("largest compression / N", &|shape| {
            shape.extremes.compression_n.map(|(_, force)| force)
        }),
    ];
    let energy = [curve("energy / J", &|shape| Some(shape.energy_j))];
    let chart =
        |up: &str, curves: Vec<Curve>| Chart { across: over.to_owned(), up: up.to_owned(), curves };
    let charts = [
        chart("force / N", forces.into_iter().flatten().collect()),
        chart("energy / J", energy.into_iter().flatten().collect()),
    ];
    charts.into_iter().filter(|chart| !chart.curves.is_empty()).collect()
}
