//! A study as text.

use std::fmt::{self, Write as _};

use model::number::Number;

use super::census::plural;
use super::printable::Printable;
use super::tables::{heading, heads, numbers_from, short, table, wrapped};
use crate::csv::Numbers;
use crate::study::{StudyAnswer, StudyPoint, StudyShape};

/// Points of a path printed one by one; of more, as many spread over the path.
const PRINTED: usize = 24;

/// The tables of all paths, and what is said of all points, as `funicular study` prints them.
impl fmt::Display for StudyAnswer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(self))
    }
}

fn text(found: &StudyAnswer) -> String {
    let mut text = format!(
        "{}: {} {} of {}\n",
        Printable(found.name()),
        found.points().len(),
        plural(found.points().len(), "point", "points"),
        Printable(&found.parameters().join(", "))
    );
    for path in 1..=found.paths() {
        let points: Vec<_> = found.points().iter().filter(|point| point.path == path).collect();
        text += &one_path(found, &points);
    }
    let shapes = found.shapes().count();
    let refused = found.points().len() - shapes;
    let agreed = found.shapes().filter(|shape| shape.agrees).count();
    let most = found.shapes().filter_map(|shape| shape.joints_differ_m).fold(0.0, f64::max);
    let most = Number::size(most, 1);
    text += &wrapped(
        &format!(
            "\n{shapes} {}, of which both solvers agree on {agreed} (joints to {most} m at worst); {refused} {} \
             without a shape",
            plural(shapes, "shape", "shapes"),
            plural(refused, "point", "points")
        ),
        0,
    );
    text.push('\n');
    if let Some((values, reason)) = found
        .points()
        .iter()
        .find_map(|point| point.shape.as_ref().err().map(|none| (&point.values, &none.reason)))
    {
        let values = values.iter().map(|value| short(*value)).collect::<Vec<_>>().join(", ");
        text += &wrapped(&format!("the first of these, at {values}: {}", Printable(reason)), 2);
        text.push('\n');
    }
    text
}

/// A table over the last parameter.
fn one_path(found: &StudyAnswer, points: &[&StudyPoint]) -> String {
    let moves = found.moving(points);
    let mut text = String::new();
    let fixed: Vec<String> = (0..moves.len())
        .filter(|k| !moves[*k])
        .filter_map(|k| {
            let name = Printable(&found.parameters()[k]);
            Some(format!("{name} = {} {}", short(points.first()?.values[k]), found.units()[k]))
        })
        .collect();
    if !fixed.is_empty() {
        text += &wrapped(&format!("\n{}", fixed.join(", ")), 2);
        text.push('\n');
    }
    let moving: Vec<usize> = (0..moves.len()).filter(|k| moves[*k]).collect();
    let parameters = moving.iter().map(|k| match moving.len() {
        1 => format!("value / {}", found.units()[*k]),
        _ => heading(&found.parameters()[*k], found.units()[*k], true),
    });
    let (head, cells) = columns(found);
    let head: Vec<String> = parameters.chain(head).chain(["evidence".to_owned()]).collect();
    let mut table = table(head.iter().map(String::as_str));
    for point in spread(points) {
        let mut row: Vec<String> = moving.iter().map(|k| short(point.values[*k])).collect();
        match &point.shape {
            Ok(shape) => {
                row.extend(cells(shape));
                row.push(match (shape.agrees, shape.rung) {
                    (true, Some(rung)) => rung.to_string(),
                    _ => "no agreement".to_owned(),
                });
            }
            Err(_) => row.push("no shape".to_owned()),
        }
        table.add_row(row);
    }
    numbers_from(&mut table, 0);
    let _ = writeln!(text, "{table}");
    if points.len() > PRINTED {
        let _ = writeln!(text, "({PRINTED} of {} points; --csv and --json have all)", points.len());
    }
    text
}

/// What is shown of a shape.
type Cells<'a> = Box<dyn Fn(&StudyShape) -> Vec<String> + 'a>;

/// The columns between the value and the evidence: what is asked for, else what stands out.
fn columns(found: &StudyAnswer) -> (Vec<String>, Cells<'_>) {
    let number = |x: Option<f64>| x.map_or_else(String::new, short);
    if !found.of().is_empty() {
        let shapes = || found.points().iter().filter_map(|point| point.shape.as_ref().ok());
        let values = |k: usize| shapes().filter_map(|shape| shape.of[k]).collect();
        let columns = Numbers::of_columns(found.of(), values);
        let cells = move |shape: &StudyShape| {
            let cells = shape.of.iter().zip(&columns);
            cells.map(|(x, column)| x.map_or_else(String::new, |x| column.short(x))).collect()
        };
        return (heads(found.of(), 52), Box::new(cells));
    }
    let mut head: Vec<String> =
        ["sag / m", "lowest", "tension / N", "bar"].map(String::from).into();
    let supports = found.supports();
    // Two supports have a column each, of more the largest force is shown.
    let two = supports.len() == 2;
    if two {
        head.extend(supports.iter().map(|name| format!("{} / N", cut(name))));
    } else {
        head.push("ground / N".to_owned());
    }
    let cells = move |shape: &StudyShape| {
        let tension = shape.extremes.tension_n;
        let mut row = vec![
            number(shape.extremes.sag_m),
            cut(&shape.lowest_joint),
            tension.map_or_else(|| "none".to_owned(), |(_, force)| short(force)),
            tension.map_or_else(String::new, |(bar, _)| (bar + 1).to_string()),
        ];
        if two {
            row.extend([0, 1].map(|support| number(shape.support_n(support))));
        } else {
            row.push(number(shape.largest_support_n()));
        }
        row
    };
    (head, Box::new(cells))
}

/// A name that fits into a column.
fn cut(name: &str) -> String {
    const WIDTH: usize = 8;
    let name = Printable(name).to_string();
    match name.char_indices().nth(WIDTH) {
        Some((at, _)) => format!("{}\u{2026}", &name[..at]),
        None => name,
    }
}

/// At most [`PRINTED`] of the points, the first and the last among them.
fn spread<'a>(points: &'a [&'a StudyPoint]) -> impl Iterator<Item = &'a StudyPoint> {
    let shown = points.len().min(PRINTED);
    (0..shown).map(move |k| points[k * (points.len() - 1) / (shown - 1).max(1)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_printed_points_are_spread_over_all() {
        let point = StudyPoint {
            path: 1,
            values: vec![],
            shape: Err(crate::study::NoShape { refused: true, reason: String::new() }),
        };
        for (count, shown) in [(0, 0), (1, 1), (2, 2), (24, 24), (25, 24), (1000, 24)] {
            let points = vec![&point; count];
            assert_eq!(spread(&points).count(), shown);
        }
    }
}
