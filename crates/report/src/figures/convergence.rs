//! Residual against iteration for both solvers.

use ::figures::{Anchor, Axes, Svg};
use paper::Reproduction;
use paper::figures::History;

use super::Figure;
use crate::numbers::fixed;

/// Smallest decade that is drawn: below it there is only rounding.
const FLOOR: f64 = -17.0;

/// One panel for each start.
pub fn convergence(r: &Reproduction) -> Figure {
    let histories = &r.figures.histories;
    let longest = histories.iter().map(last).fold(1, usize::max);
    let mut starts: Vec<&str> = histories.iter().map(|h| h.start).collect();
    starts.dedup();
    let panels = starts.iter().enumerate().map(|(k, start)| {
        let of: Vec<&History> = histories.iter().filter(|h| h.start == *start).collect();
        panel(k, start, &of, longest)
    });
    Figure {
        id: "figure-convergence",
        panels: panels.collect(),
        caption: "Residual against iteration, logarithmic. Both solvers double the number of correct digits with each step once \
                  they are near (the lines bend downwards ever faster: quadratic convergence), until only rounding is \
                  left. Left from a rough guess, right from far away, where both first have to find the valley. lagrange \
                  (circles) measures what is left of the balances of force and moment and of the closure, energy (squares) \
                  the largest force across a bar; energy was stopped after 1, 2, 3, … steps to read its residual."
            .to_owned(),
    }
}

/// Number of the last iteration.
fn last(history: &History) -> usize {
    history.first_iteration + history.residuals.len().saturating_sub(1)
}

fn panel(k: usize, start: &str, histories: &[&History], longest: usize) -> String {
    let size = [440.0, 360.0];
    let names = ["iteration", &format!("residual, {start}")];
    let axes = Axes::panel(size, [0.0, longest as f64 + 0.4], [FLOOR, 1.0], names);
    let angles = histories.first().map_or([f64::NAN; 3], |h| h.start_deg).map(|a| fixed(a, 1));
    let mut svg = Svg::in_page(
        &format!("convergence-{k}"),
        size,
        &format!("Convergence from a start: {start}"),
        &format!(
            "Start at theta, alpha, beta = {} degrees. {}",
            angles.join(", "),
            histories.iter().map(|h| in_words(h)).collect::<Vec<_>>().join(" ")
        ),
    );
    let decades: Vec<_> = [0.0, -4.0, -8.0, -12.0, -16.0]
        .into_iter()
        .map(|d: f64| (d, if d < 0.0 { format!("1e−{}", fixed(-d, 0)) } else { "1".to_owned() }))
        .collect();
    let steps: Vec<_> = (0..=longest).map(|k| (k as f64, k.to_string())).collect();
    axes.grid(&mut svg, [&steps, &decades]);
    for history in histories {
        let points: Vec<[f64; 2]> = history
            .residuals
            .iter()
            .enumerate()
            .map(|(k, residual)| {
                let decade = residual.abs().log10().max(FLOOR + 0.4);
                axes.at([(history.first_iteration + k) as f64, decade])
            })
            .collect();
        let class = history.solver.as_str();
        svg.polyline(&format!("history {class}"), points.iter().copied());
        for point in &points {
            if class == "lagrange" {
                svg.circle(&format!("mark {class}"), *point, 4.5);
            } else {
                let [x, y] = *point;
                svg.polygon(
                    &format!("mark {class}"),
                    &[
                        [x - 4.0, y - 4.0],
                        [x + 4.0, y - 4.0],
                        [x + 4.0, y + 4.0],
                        [x - 4.0, y + 4.0],
                    ],
                );
            }
        }
        // The name stands at the second point, on the outer side of the line.
        if let Some([x, y]) = points.get(1) {
            let (anchor, dx) =
                if class == "lagrange" { (Anchor::Start, 9.0) } else { (Anchor::End, -8.0) };
            svg.indexed(
                "label",
                [x + dx, y + if class == "lagrange" { -4.0 } else { 14.0 }],
                anchor,
                class,
            );
        }
    }
    svg.finish()
}

/// A history for those who do not see it.
fn in_words(history: &History) -> String {
    let decades = history
        .residuals
        .iter()
        .map(|r| if *r < 1e-12 { "below 1e-12".to_owned() } else { format!("{r:.0e}") });
    format!(
        "{}: from iteration {}, {}.",
        history.solver,
        history.first_iteration,
        decades.collect::<Vec<_>>().join(", ")
    )
}
