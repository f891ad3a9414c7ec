//! Every equilibrium of the example, as the census proves them.

use ::census::{Census, Interval, ProvenEquilibrium};
use ::figures::{Anchor, Svg};
use model::Problem;

use super::{Figure, moved};
use crate::numbers::fixed;

/// Size of a panel; length of a bar, px; where O lies.
const SIZE: [f64; 2] = [190.0, 300.0];
const LENGTH: f64 = 88.0;
const ORIGIN: [f64; 2] = [95.0, 66.0];

/// The paper's V less the energy measured from the height of O, mgl.
const PAPER_ZERO_MGL: f64 = 6.0;

/// The shapes, each with its mirror image in thin lines.
pub fn census(problem: &Problem, found: &Census) -> Figure {
    let chain = problem.chain();
    let weight_j: f64 = chain
        .bars()
        .first()
        .map_or(f64::NAN, |bar| bar.mass_kg() * bar.length_m() * chain.gravity_m_s2());
    let panels: Vec<String> =
        found.equilibria.iter().enumerate().map(|(k, e)| panel(k, e, weight_j)).collect();
    Figure {
        id: "figure-census",
        caption: format!(
            "All equilibria of the example by the census: {} {}, each one proved to be alone in its box by interval \
             arithmetic, with none outside the boxes ({}). Every pattern of tension (solid) and compression (dashed) was \
             searched over all pulls on O, infinite ones included. Thin: the mirror image, a turn by 180 degrees away on \
             the same circle.",
            panels.len(),
            if found.circles { "circles about OD" } else { "points" },
            if found.complete { "the search is complete" } else { "the search is NOT complete" },
        ),
        panels,
    }
}

/// One equilibrium. `weight_j` is the weight of a bar times its length.
fn panel(k: usize, e: &ProvenEquilibrium, weight_j: f64) -> String {
    let signs: Vec<&str> =
        e.signs.iter().map(|s| if *s < 0 { "compression" } else { "tension" }).collect();
    let index = e.index_in_space();
    let heading = format!("{}. {}", k + 1, if index == 0 { "stable" } else { "unstable" });
    let mut svg = Svg::in_page(
        &format!("census-{k}"),
        SIZE,
        &format!("Equilibrium {} of the census", k + 1),
        &format!("Bars in {}. {index} directions in which the energy falls.", signs.join(", ")),
    );
    svg.indexed("heading", [SIZE[0] / 2.0, 20.0], Anchor::Middle, &heading);
    let origin = e.joints_m.first().map_or([0.0; 3], |j| j.map(Interval::mid));
    let flat = |side: f64| -> Vec<[f64; 2]> {
        e.joints_m
            .iter()
            .map(|joint| {
                let [x, y, z] = std::array::from_fn(|k| joint[k].mid() - origin[k]);
                // The plane of the chain: the level part of every joint has one direction.
                let across = if x.abs() > y.abs() {
                    x.signum() * x.hypot(y)
                } else {
                    y.signum() * x.hypot(y)
                };
                moved(ORIGIN, LENGTH, [side * across, -z])
            })
            .collect()
    };
    svg.polyline("mirror", flat(-1.0));
    let at = flat(1.0);
    for (bar, ends) in at.windows(2).enumerate() {
        svg.line(
            &format!("bar {}", signs.get(bar).copied().unwrap_or("tension")),
            ends[0],
            ends[1],
        );
    }
    for (k, joint) in at.iter().enumerate() {
        svg.circle(if k == 0 || k + 1 == at.len() { "anchor" } else { "joint" }, *joint, 4.5);
    }
    svg.indexed(
        "label small",
        [SIZE[0] / 2.0, SIZE[1] - 28.0],
        Anchor::Middle,
        &format!("index {index} in space, {} in plane", e.index_in_plane),
    );
    svg.indexed(
        "label small",
        [SIZE[0] / 2.0, SIZE[1] - 10.0],
        Anchor::Middle,
        &format!("V = {} mgl", fixed(e.energy_j.mid() / weight_j + PAPER_ZERO_MGL, 5)),
    );
    svg.finish()
}
