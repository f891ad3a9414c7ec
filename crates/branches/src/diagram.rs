use figures::{Anchor, Axes, Axis, BLUE, Colour, GREEN, Look, ORANGE, Svg, Unit, VERMILION};

use crate::branch::{Branch, BranchPoint};
use crate::census_point::PointStatus;
use crate::continuation::Continuation;
use crate::event::EventKind;

/// What the horizontal axis shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Abscissa {
    /// The last parameter.
    #[default]
    Parameter,
    /// The distance of the anchors.
    Span,
}

/// How a piece of a branch is drawn, by its indices, and what that means.
const STYLES: [(Look<'_>, &str); 3] = [
    (Look::stroke(BLUE, 3.2), "stable in space"),
    (Look::stroke(ORANGE, 1.8), "stable in the plane only"),
    (Look::stroke(VERMILION, 1.5).dashed("6 4"), "unstable"),
];

/// Kinds of events that are marked, and what the legend calls them.
const MARKS: [(&str, &str); 4] = [
    ("fold", "fold"),
    ("branch-point", "branch point"),
    ("straight", "straight chain"),
    ("space-exchange", "stability in space changes"),
];

/// Where there is no chain.
const REFUSED: Colour = Colour::grey(0xe4);

const WIDTH: f64 = 900.0;
const LEFT: f64 = 100.0;
const RIGHT: f64 = 870.0;
/// Upper and lower edge of the panels: energy, angle.
const PANELS: [[f64; 2]; 2] = [[90.0, 400.0], [440.0, 750.0]];
const HEIGHT: f64 = 880.0;

/// An angle that changes by more than this from point to point has passed a full turn, deg.
const HALF_TURN: f64 = 180.0;

/// What the panels show of a continuation.
struct Diagram<'a> {
    found: &'a Continuation,
    abscissa: Abscissa,
    /// Of the bar whose angle is drawn, from 0.
    bar: usize,
}

/// A panel: its axes and which quantity it shows.
#[derive(Clone, Copy)]
struct Panel<'a> {
    axes: Axes<'a>,
    angles: bool,
}

/// The bifurcation diagram as SVG: energy, and the angle of one bar (from 1), over the parameter or
/// the distance of the anchors.
pub fn diagram(found: &Continuation, title: &str, abscissa: Abscissa, bar: usize) -> String {
    let bar = bar.max(1);
    let diagram = Diagram { found, abscissa, bar: bar - 1 };
    let grid = found.points.iter().map(|point| diagram.over(&point.values, point.span_m));
    let x = Axis::around(grid, 0.02, [LEFT, RIGHT]);
    let points = found.branches.iter().flat_map(|branch| &branch.points);
    let [top, bottom] = PANELS[0];
    let energy = Axis::around(points.map(|p| p.energy_j), 0.05, [bottom, top]);
    let [top, bottom] = PANELS[1];
    let angle = Axis { values: [-190.0, 190.0], pixels: [bottom, top] };
    let (abscissa_name, angle_name) =
        (diagram.name(), format!("angle of bar {bar} from the vertical / \u{b0}"));
    let panels = [
        Panel { axes: Axes { x, y: energy, names: ["", "energy / J"] }, angles: false },
        Panel { axes: Axes { x, y: angle, names: [&abscissa_name, &angle_name] }, angles: true },
    ];

    let mut svg = Svg::new([WIDTH, HEIGHT], title);
    svg.text(Look::PLAIN.size(17.0).bold(), [LEFT, 30.0], Anchor::Start, title);
    svg.text(Look::PLAIN, [LEFT, 50.0], Anchor::Start, &diagram.constants());
    let refused = diagram.shade(&mut svg, &x);
    for panel in panels {
        for branch in &found.branches {
            diagram.draw(&mut svg, branch, panel);
        }
        diagram.mark(&mut svg, panel);
    }
    panels[0].axes.frame(&mut svg, [Unit::Decimal; 2]);
    panels[1].axes.frame(&mut svg, [Unit::Decimal, Unit::Degrees]);
    diagram.legend(&mut svg, refused);
    svg.finish()
}

impl Diagram<'_> {
    /// The parameter along the path: the last one.
    fn last(&self) -> usize {
        self.found.parameters.len().saturating_sub(1)
    }

    /// Where a point stands on the horizontal axis.
    fn over(&self, values: &[f64], span_m: f64) -> f64 {
        match self.abscissa {
            Abscissa::Parameter => values.get(self.last()).copied().unwrap_or(0.0),
            Abscissa::Span => span_m,
        }
    }

    /// What the horizontal axis is called.
    fn name(&self) -> String {
        let last = self.last();
        match (self.abscissa, self.found.parameters.get(last)) {
            (Abscissa::Parameter, Some(name)) => format!("{name} / {}", self.found.units[last]),
            _ => "distance of the anchors / m".to_owned(),
        }
    }

    /// The parameters that stay the same, with their values.
    fn constants(&self) -> String {
        let Continuation { parameters, units, points, .. } = self.found;
        let constant = |k: usize| {
            let value = points.first()?.values.get(k)?;
            let same = points.iter().all(|p| (p.values[k] - value).abs() <= 0.0);
            same.then(|| format!("{} = {value} {}", parameters[k], units[k]))
        };
        (0..self.last()).filter_map(constant).collect::<Vec<_>>().join(", ")
    }

    fn angle(&self, angles_rad: &[f64]) -> f64 {
        angles_rad.get(self.bar).map_or(0.0, |angle| angle.to_degrees())
    }

    /// One branch: a line for each run of one style, broken where an angle jumps by a turn.
    fn draw(&self, svg: &mut Svg, branch: &Branch, panel: Panel<'_>) {
        let place = |p: &BranchPoint| {
            let value = if panel.angles { self.angle(&p.angles_rad) } else { p.energy_j };
            [self.over(&p.values, p.span_m), value]
        };
        let mut line: Vec<[f64; 2]> = vec![];
        let mut drawn = None;
        for pair in branch.points.windows(2) {
            let [a, b] = [place(&pair[0]), place(&pair[1])];
            // Where the style changes stands an event, which has the indices of what is before it.
            let style = style(&pair[1]);
            if panel.angles && (a[1] - b[1]).abs() > HALF_TURN {
                stroke(svg, &mut line, drawn.take());
                continue;
            }
            if drawn != Some(style) {
                stroke(svg, &mut line, drawn);
                line.push(panel.axes.at(a));
                drawn = Some(style);
            }
            line.push(panel.axes.at(b));
        }
        stroke(svg, &mut line, drawn);
    }

    /// The marks of the events.
    fn mark(&self, svg: &mut Svg, panel: Panel<'_>) {
        for event in &self.found.events {
            let value = if panel.angles { self.angle(&event.angles_rad) } else { event.energy_j };
            let at = [self.over(&event.values, event.span_m), value];
            mark(svg, event.kind.name(), panel.axes.at(at));
        }
    }

    /// Grey where there is no chain; whether that is anywhere.
    fn shade(&self, svg: &mut Svg, x: &Axis) -> bool {
        let points = &self.found.points;
        let mut any = false;
        for pair in points.windows(2) {
            if pair.iter().all(|point| matches!(point.status, PointStatus::Refused { .. })) {
                any = true;
                let ends = [0, 1].map(|k| x.at(self.over(&pair[k].values, pair[k].span_m)));
                // Neighbours overlap, so that no white line is left between them.
                let (left, right) = (ends[0].min(ends[1]) - 0.2, ends[0].max(ends[1]) + 0.2);
                for [top, bottom] in PANELS {
                    svg.rectangle(Look::fill(REFUSED), [left, top], [right - left, bottom - top]);
                }
            }
        }
        any
    }

    /// What is drawn, in two rows under the panels.
    fn legend(&self, svg: &mut Svg, refused: bool) {
        let at = |k: usize| [LEFT + 16.0 + 195.0 * (k % 4) as f64, 826.0 + 26.0 * (k / 4) as f64];
        let mut entries = 0;
        let mut entry = |svg: &mut Svg, name: &str| {
            let [x, y] = at(entries);
            svg.text(Look::PLAIN, [x + 20.0, y + 5.0], Anchor::Start, name);
            entries += 1;
            [x, y]
        };
        let points = || self.found.branches.iter().flat_map(|branch| &branch.points);
        for (k, (look, name)) in STYLES.into_iter().enumerate() {
            if points().any(|p| style(p) == k) {
                let [x, y] = entry(svg, name);
                svg.line(look, [x - 14.0, y], [x + 14.0, y]);
            }
        }
        for (kind, name) in MARKS {
            if self.found.events.iter().any(|event| EventKind::name(event.kind) == kind) {
                let at = entry(svg, name);
                mark(svg, kind, at);
            }
        }
        if refused {
            let [x, y] = entry(svg, "no chain");
            svg.rectangle(Look::fill(REFUSED), [x - 12.0, y - 7.0], [24.0, 14.0]);
        }
    }
}

fn style(point: &BranchPoint) -> usize {
    match (point.index_in_plane, point.index_in_space) {
        (_, 0) => 0,
        (0, _) => 1,
        _ => 2,
    }
}

fn stroke(svg: &mut Svg, line: &mut Vec<[f64; 2]>, style: Option<usize>) {
    if let Some(style) = style {
        svg.polyline(STYLES[style].0, line.drain(..));
    }
    line.clear();
}

/// The mark of a kind of events; nothing for a kind that is not marked.
fn mark(svg: &mut Svg, kind: &str, [x, y]: [f64; 2]) {
    let ring = Look::stroke(Colour::BLACK, 1.5).filled(Colour::WHITE);
    let edge = Look::stroke(Colour::BLACK, 1.0);
    match kind {
        "fold" => svg.circle(ring, [x, y], 4.5),
        "branch-point" => svg.diamond(edge.filled(Colour::BLACK), [x, y], 6.0),
        "straight" => svg.rectangle(ring, [x - 4.0, y - 4.0], [8.0, 8.0]),
        "space-exchange" => {
            let corners = [[x, y - 6.0], [x + 5.5, y + 4.0], [x - 5.5, y + 4.0]];
            svg.polygon(edge.filled(GREEN), &corners);
        }
        _ => {}
    }
}
