//! Which start leads where: a slice through the planar starts.

use ::figures::{Anchor, Axes, Svg};
use paper::Reproduction;
use paper::basins::Basins;

use super::Figure;

/// Letter in the rows, class, name.
const PLACES: [(char, &str, &str); 5] = [
    ('1', "first", "E1"),
    ('2', "second", "E1′"),
    ('3', "third", "E2"),
    ('4', "fourth", "E2′"),
    ('-', "none", "none"),
];

/// One panel for each solver.
pub fn basins(r: &Reproduction) -> Figure {
    Figure {
        id: "figure-basins",
        panels: r.figures.basins.iter().map(panel).collect(),
        caption: "Which start leads where: the first two bars start at the angles θ and α, the third one hanging straight down. \
                  Such a chain does not close; both solvers close it on the way. energy, on the right, only goes downhill and \
                  ends in one of the two minima, dark E1 or light E1′. lagrange, on the left, has no notion of downhill: it also ends \
                  at the maxima E2 and E2′, and its basins have the ragged borders of Newton's method. A mirror image starts at \
                  −θ, −α: each picture turned by 180 degrees is the same with E1 for E1′ and E2 for E2′."
            .to_owned(),
    }
}

fn panel(basins: &Basins) -> String {
    let size = [430.0, 470.0];
    let name = basins.solver.as_str();
    let names = ["θ at the start, degrees", &format!("{name}: α at the start, degrees")];
    let axes = Axes::panel([430.0, 420.0], [-180.0, 180.0], [-180.0, 180.0], names);
    let fractions: Vec<String> = PLACES
        .iter()
        .filter(|(letter, ..)| basins.count(*letter) > 0)
        .map(|(letter, _, place)| {
            let all = basins.rows.iter().map(String::len).sum::<usize>().max(1);
            format!("{place} from {} of 100 starts", (100 * basins.count(*letter) + all / 2) / all)
        })
        .collect();
    let mut svg = Svg::in_page(
        &format!("basins-{name}"),
        size,
        &format!("Basins of {name}"),
        &format!("A map of starts by theta and alpha. {}.", fractions.join(", ")),
    );
    let ticks =
        [-180.0, -90.0, 0.0, 90.0, 180.0].map(|a: f64| (a, format!("{a}").replace('-', "−")));
    axes.grid(&mut svg, [&ticks, &ticks]);
    let rows = basins.rows.len().max(2) as f64;
    let step = 360.0 / (rows - 1.0);
    for (letter, class, _) in PLACES {
        let boxes = basins.rows.iter().enumerate().flat_map(|(row, letters)| {
            runs(letters, letter).into_iter().map(move |(from, to)| {
                // A start stands in the middle of its cell; the outermost cells are cut at the
                // frame.
                let x = |k: f64| (-180.0 + step * k).clamp(-180.0, 180.0);
                let y = |k: f64| (180.0 - step * k).clamp(-180.0, 180.0);
                let (row, from, to) = (row as f64, from as f64, to as f64);
                [[x(from - 0.5), y(row - 0.5)], [x(to - 0.5), y(row + 0.5)]]
            })
        });
        svg.boxes(&format!("basin {class}"), boxes.map(|ends| ends.map(|end| axes.at(end))));
    }
    let shown = PLACES.iter().filter(|(letter, ..)| basins.count(*letter) > 0);
    for (k, (_, class, place)) in shown.enumerate() {
        let x = 58.0 + 72.0 * k as f64;
        svg.boxes(&format!("basin key {class}"), [[[x, 446.0], [x + 18.0, 462.0]]]);
        svg.indexed("label", [x + 24.0, 459.0], Anchor::Start, place);
    }
    svg.finish()
}

/// Where a letter stands in a row: from, and to one past the end.
fn runs(row: &str, letter: char) -> Vec<(usize, usize)> {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for (k, _) in row.chars().enumerate().filter(|(_, c)| *c == letter) {
        match runs.last_mut() {
            Some((_, to)) if *to == k => *to = k + 1,
            _ => runs.push((k, k + 1)),
        }
    }
    runs
}
