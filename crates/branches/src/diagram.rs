//! The bifurcation diagram.

use std::fmt::Write as _;

use crate::branch::BranchPoint;
use crate::census_point::PointStatus;
use crate::continuation::Continuation;
use crate::event::EventKind;
use figures::{Anchor, Axis, Svg, frame};

/// What the horizontal axis shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Abscissa {
    /// The last parameter.
    #[default]
    Parameter,
    /// The distance of the anchors.
    Span,
}

/// How a piece of a branch is drawn, by its indices.
struct Style {
    name: &'static str,
    stroke: &'static str,
}

const STYLES: [Style; 3] = [
    Style { name: "stable in space", stroke: "stroke=\"#0072b2\" stroke-width=\"3.2\"" },
    Style { name: "stable in the plane only", stroke: "stroke=\"#e69f00\" stroke-width=\"1.8\"" },
    Style {
        name: "unstable",
        stroke: "stroke=\"#d55e00\" stroke-width=\"1.5\" stroke-dasharray=\"6 4\"",
    },
];

/// Kinds of events that are marked.
const MARKS: [(&str, &str, &str); 4] = [
    ("fold", "fold", "<circle r=\"4.5\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"1.5\"/>"),
    (
        "branch-point",
        "branch point",
        "<path d=\"M0 -6L6 0L0 6L-6 0Z\" fill=\"#000\" stroke=\"#000\"/>",
    ),
    (
        "straight",
        "straight chain",
        "<path d=\"M-4 -4H4V4H-4Z\" fill=\"#fff\" stroke=\"#000\" stroke-width=\"1.5\"/>",
    ),
    (
        "space-exchange",
        "stability in space changes",
        "<path d=\"M0 -6L5.5 4H-5.5Z\" fill=\"#009e73\" stroke=\"#000\"/>",
    ),
];

const WIDTH: f64 = 900.0;
const LEFT: f64 = 100.0;
const RIGHT: f64 = 870.0;
/// Upper and lower edge of the panels: energy, angle.
const PANELS: [[f64; 2]; 2] = [[90.0, 400.0], [440.0, 750.0]];
const HEIGHT: f64 = 880.0;

/// The bifurcation diagram of a continuation as SVG: energy, and the angle of one bar (from 1), over the
/// parameter or the distance of the anchors.
#[must_use]
pub fn diagram(continuation: &Continuation, title: &str, abscissa: Abscissa, bar: usize) -> String {
    let last = continuation.parameters.len().saturating_sub(1);
    let over = |values: &[f64], span_m: f64| match abscissa {
        Abscissa::Parameter => values.get(last).copied().unwrap_or(0.0),
        Abscissa::Span => span_m,
    };
    let label = match (abscissa, continuation.parameters.get(last)) {
        (Abscissa::Parameter, Some(name)) => format!("{name} / {}", continuation.units[last]),
        _ => "distance of the anchors / m".to_owned(),
    };
    let bar = bar.max(1);
    let angle = |angles: &[f64]| angles.get(bar - 1).map_or(0.0, |angle| angle.to_degrees());
    let points = || continuation.branches.iter().flat_map(|branch| &branch.points);
    let grid = continuation.points.iter().map(|point| over(&point.values, point.span_m));
    let x = Axis::around(grid, 0.02, [LEFT, RIGHT]);
    let [top, bottom] = PANELS[0];
    let energy = Axis::around(points().map(|p| p.energy_j), 0.05, [bottom, top]);
    let [top, bottom] = PANELS[1];
    let angles = Axis { values: [-190.0, 190.0], pixels: [bottom, top] };

    let mut svg = Svg::new(WIDTH, HEIGHT, title);
    svg.push(format_args!("<g font-size=\"17\" font-weight=\"bold\">"));
    svg.text([LEFT, 30.0], Anchor::Start, title);
    svg.push("</g>");
    let fixed: Vec<String> = (0..last)
        .filter_map(|k| {
            let value = continuation.points.first()?.values.get(k)?;
            let unit = continuation.units[k];
            let same = continuation.points.iter().all(|p| (p.values[k] - value).abs() <= 0.0);
            same.then(|| format!("{} = {value} {unit}", continuation.parameters[k]))
        })
        .collect();
    svg.text([LEFT, 50.0], Anchor::Start, &fixed.join(", "));
    let refused = shade(&mut svg, continuation, &x, &over);
    for (panel, y) in [&energy, &angles].into_iter().enumerate() {
        let value = |p: &BranchPoint| {
            if panel == 0 { p.energy_j } else { angle(&p.angles_rad) }
        };
        for branch in &continuation.branches {
            let seen: Vec<(f64, f64, usize)> = branch
                .points
                .iter()
                .map(|p| (over(&p.values, p.span_m), value(p), style(p)))
                .collect();
            line(&mut svg, &seen, &x, y, panel == 1);
        }
        for event in &continuation.events {
            let mark = MARKS.iter().find(|mark| mark.0 == event.kind.name());
            if let Some((_, _, shape)) = mark {
                let at = if panel == 0 { event.energy_j } else { angle(&event.angles_rad) };
                let (px, py) = (x.at(over(&event.values, event.span_m)), y.at(at));
                svg.push(format_args!("<g transform=\"translate({px:.2} {py:.2})\">{shape}</g>"));
            }
        }
    }
    let angle_label = format!("angle of bar {bar} from the vertical / \u{b0}");
    frame(&mut svg, &x, &energy, ["", "energy / J"], [false, false]);
    frame(&mut svg, &x, &angles, [&label, &angle_label], [false, true]);
    legend(&mut svg, continuation, refused);
    svg.finish()
}

fn style(point: &BranchPoint) -> usize {
    match (point.index_in_plane, point.index_in_space) {
        (_, 0) => 0,
        (0, _) => 1,
        _ => 2,
    }
}

/// One branch: a line for each run of one style, broken where an angle jumps by a turn.
fn line(svg: &mut Svg, points: &[(f64, f64, usize)], x: &Axis, y: &Axis, turns: bool) {
    let mut path = String::new();
    let mut drawn = None;
    for pair in points.windows(2) {
        let [a, b] = [pair[0], pair[1]];
        // Where the style changes stands an event, which has the indices of what is before it.
        let style = b.2;
        if turns && (a.1 - b.1).abs() > 180.0 {
            stroke(svg, &mut path, drawn.take());
            continue;
        }
        if drawn != Some(style) {
            stroke(svg, &mut path, drawn);
            let _ = write!(path, "M{:.2} {:.2}", x.at(a.0), y.at(a.1));
            drawn = Some(style);
        }
        let _ = write!(path, "L{:.2} {:.2}", x.at(b.0), y.at(b.1));
    }
    stroke(svg, &mut path, drawn);
}

fn stroke(svg: &mut Svg, path: &mut String, style: Option<usize>) {
    if let Some(style) = style {
        let stroke = STYLES[style].stroke;
        svg.push(format_args!(
            "<path d=\"{path}\" fill=\"none\" stroke-linejoin=\"round\" {stroke}/>"
        ));
    }
    path.clear();
}

/// Grey where there is no chain; whether that is anywhere.
fn shade(
    svg: &mut Svg,
    continuation: &Continuation,
    x: &Axis,
    over: &impl Fn(&[f64], f64) -> f64,
) -> bool {
    let refused = |k: usize| matches!(continuation.points[k].status, PointStatus::Refused { .. });
    let mut any = false;
    for k in 0..continuation.points.len().saturating_sub(1) {
        if refused(k) && refused(k + 1) {
            any = true;
            let [a, b] = [k, k + 1].map(|k| {
                let point = &continuation.points[k];
                x.at(over(&point.values, point.span_m))
            });
            for [top, bottom] in PANELS {
                svg.push(format_args!(
                    "<rect x=\"{:.2}\" y=\"{top}\" width=\"{:.2}\" height=\"{}\" fill=\"#e4e4e4\"/>",
                    a.min(b) - 0.2,
                    (b - a).abs() + 0.4,
                    bottom - top
                ));
            }
        }
    }
    any
}

/// What is drawn, in two rows under the panels.
fn legend(svg: &mut Svg, continuation: &Continuation, refused: bool) {
    let points = || continuation.branches.iter().flat_map(|branch| &branch.points);
    let mut entries: Vec<(String, &str)> = vec![];
    for (k, one) in STYLES.iter().enumerate() {
        if points().any(|p| style(p) == k) {
            let swatch = format!("<path d=\"M-14 0H14\" fill=\"none\" {}/>", one.stroke);
            entries.push((swatch, one.name));
        }
    }
    for (kind, name, shape) in MARKS {
        if continuation
            .events
            .iter()
            .any(|event: &crate::event::Event| EventKind::name(event.kind) == kind)
        {
            entries.push((shape.to_owned(), name));
        }
    }
    if refused {
        entries.push(("<path d=\"M-12 -7H12V7H-12Z\" fill=\"#e4e4e4\"/>".to_owned(), "no chain"));
    }
    for (k, (swatch, name)) in entries.iter().enumerate() {
        let at = [LEFT + 16.0 + 195.0 * (k % 4) as f64, 826.0 + 26.0 * (k / 4) as f64];
        svg.push(format_args!(
            "<g transform=\"translate({:.2} {:.2})\">{swatch}</g>",
            at[0], at[1]
        ));
        svg.text([at[0] + 20.0, at[1] + 5.0], Anchor::Start, name);
    }
}
