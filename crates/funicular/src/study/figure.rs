//! A study as a picture.

use figures::{Anchor, Axes, Axis, BLUE, Colour, GREEN, Look, ORANGE, Svg, Unit, VERMILION};

use super::{StudyAnswer, StudyPoint, StudyShape};

const WIDTH: f64 = 900.0;
const LEFT: f64 = 100.0;
const RIGHT: f64 = 870.0;
/// Upper and lower edge of the panels: sag, forces, angles.
const PANELS: [[f64; 2]; 3] = [[70.0, 270.0], [330.0, 530.0], [590.0, 790.0]];
const HEIGHT: f64 = 860.0;

/// How wide the curves are, px.
const STROKE: f64 = 2.4;
/// Dashes of the curves, one on top of the other: where they are equal the ones below are seen in the
/// gaps.
const DASHES: [&str; 4] = ["", "18 9", "9 9", "3 9"];

/// The value of a curve at a shape, where there is one.
type Value = fn(&StudyShape) -> Option<f64>;

/// A curve of a panel: what it is called, how it is drawn, its value.
type Curve = (String, Colour, Value);

fn sag() -> Vec<Curve> {
    vec![("sag".to_owned(), BLUE, |shape| shape.extremes.sag_m)]
}

fn forces(found: &StudyAnswer) -> Vec<Curve> {
    let mut all: Vec<Curve> = vec![
        ("largest tension".to_owned(), BLUE, |shape| {
            shape.extremes.tension_n.map(|(_, force)| force)
        }),
        ("largest compression".to_owned(), VERMILION, |shape| {
            shape.extremes.compression_n.map(|(_, force)| force)
        }),
    ];
    if let [first, second] = &found.supports()[..] {
        all.push((format!("force at {first}"), GREEN, |shape| shape.support_n(0)));
        all.push((format!("force at {second}"), ORANGE, |shape| shape.support_n(1)));
    } else {
        all.push(("largest of the ground".to_owned(), GREEN, StudyShape::largest_support_n));
    }
    all
}

fn angles() -> Vec<Curve> {
    vec![
        ("first bar".to_owned(), BLUE, |shape| shape.rises_deg.first().copied()),
        ("last bar".to_owned(), ORANGE, |shape| shape.rises_deg.last().copied()),
    ]
}

/// The figure of one path, from 1.
pub(super) fn figure(found: &StudyAnswer, path: usize) -> String {
    let points: Vec<&StudyPoint> =
        found.points().iter().filter(|point| point.path == path).collect();
    let last = found.parameters().len().saturating_sub(1);
    let over = |point: &StudyPoint| point.values.get(last).copied().unwrap_or(0.0);
    let x = Axis::around(points.iter().map(|point| over(point)), 0.02, [LEFT, RIGHT]);
    let title = found.name();
    let mut svg = Svg::new([WIDTH, HEIGHT], title);
    svg.text(Look::PLAIN.size(17.0).bold(), [LEFT, 28.0], Anchor::Start, title);
    svg.text(Look::PLAIN, [LEFT, 48.0], Anchor::Start, &constants(found, &points));
    let name = match (found.parameters().get(last), found.units().get(last)) {
        (Some(name), Some(unit)) => format!("{name} / {unit}"),
        _ => String::new(),
    };
    let panels: [(Vec<Curve>, &str, &str, Unit); 3] = [
        (sag(), "", "sag / m", Unit::Decimal),
        (forces(found), "", "force / N", Unit::Decimal),
        (angles(), &name, "angle above the level / \u{b0}", Unit::Degrees),
    ];
    let shapes = || points.iter().filter_map(|point| point.shape.as_ref().ok());
    for ((mut curves, x_name, y_name, unit), [top, bottom]) in panels.into_iter().zip(PANELS) {
        // What has no value anywhere needs no entry of the legend.
        curves.retain(|(_, _, value)| shapes().any(|shape| value(shape).is_some()));
        let values = shapes().flat_map(|shape| curves.iter().filter_map(|curve| curve.2(shape)));
        let y = Axis::around(values, 0.05, [bottom, top]);
        let axes = Axes { x, y, names: [x_name, y_name] };
        for ((_, colour, value), dashes) in curves.iter().zip(DASHES) {
            draw(
                &mut svg,
                &axes,
                (*colour, dashes),
                points.iter().map(|point| {
                    let value = point.shape.as_ref().ok().and_then(value)?;
                    Some([over(point), value])
                }),
            );
        }
        axes.frame(&mut svg, [Unit::Decimal, unit]);
        if curves.len() > 1 {
            legend(&mut svg, &curves, top - 12.0);
        }
    }
    svg.finish()
}

/// A line for each run of points that have a value; a point alone is a dot.
fn draw(
    svg: &mut Svg,
    axes: &Axes<'_>,
    (colour, dashes): (Colour, &'static str),
    points: impl Iterator<Item = Option<[f64; 2]>>,
) {
    let mut run: Vec<[f64; 2]> = vec![];
    let mut end = |run: &mut Vec<[f64; 2]>| {
        match run[..] {
            [] => {}
            [alone] => svg.circle(Look::fill(colour), alone, STROKE),
            _ => svg.polyline(Look::stroke(colour, STROKE).dashed(dashes), run.iter().copied()),
        }
        run.clear();
    };
    for point in points {
        match point {
            Some(at) => run.push(axes.at(at)),
            None => end(&mut run),
        }
    }
    end(&mut run);
}

/// What the curves are, above the right end of a panel.
fn legend(svg: &mut Svg, curves: &[Curve], y: f64) {
    /// Room for one entry, px.
    const ENTRY: f64 = 180.0;
    let left = RIGHT - ENTRY * curves.len() as f64;
    for (k, ((name, colour, _), dashes)) in curves.iter().zip(DASHES).enumerate() {
        let x = left + ENTRY * k as f64;
        let look = Look::stroke(*colour, STROKE).dashed(dashes);
        svg.line(look, [x - 8.0, y - 5.0], [x + 22.0, y - 5.0]);
        svg.text(Look::PLAIN, [x + 28.0, y], Anchor::Start, name);
    }
}

/// The parameters that stay the same along the path, with their values.
fn constants(found: &StudyAnswer, points: &[&StudyPoint]) -> String {
    let Some(first) = points.first() else { return String::new() };
    let constant = |k: usize| {
        let same = points.iter().all(|p| (p.values[k] - first.values[k]).abs() <= 0.0);
        same.then(|| {
            format!("{} = {} {}", found.parameters()[k], first.values[k], found.units()[k])
        })
    };
    let others = 0..found.parameters().len().saturating_sub(1);
    others.filter_map(constant).collect::<Vec<_>>().join(", ")
}
