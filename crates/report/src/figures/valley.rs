//! The energy along the closure curve, with the paper's scan on it.

use ::figures::{Anchor, Axes, Svg};
use paper::Reproduction;
use paper::figures::NEAR_DEG;

use super::Figure;
use crate::numbers::fixed;

/// Every how many-th point of the scan is drawn: all of them would be a line.
const EVERY: usize = 40;

/// Ten millionths of mgl, the unit of the enlarged picture.
const TINY: f64 = 1e7;

/// The whole curve, and the neighbourhood of E1.
pub fn valley(r: &Reproduction) -> Figure {
    Figure {
        id: "figure-valley",
        panels: vec![whole(r), near(r)],
        caption: format!(
            "How the paper obtained its numbers. Left: all closed chains lie on one closed curve; its heights are the \
             energy V. The dots are the paper's scan (one point in {EVERY} is drawn), θ = 0.001, 0.002, … rad on each \
             of the two branches of (viii), lowest value kept. On the branch through E1 (filled dots) that is a point \
             next to the minimum; on the other (rings) it is the very first point, (x), on the slope of {} mgl/rad \
             (dashed line) down to E1′ at negative θ, where the scan does not look. Minima: circles E1, E1′; maxima: diamonds E2, E2′. \
             Right: the bottom at E1, enlarged; the scan steps over the minimum, and (ix) is its lowest point.",
            fixed(r.figures.slope_at_x, 3),
        ),
    }
}

fn ticks(values: impl IntoIterator<Item = f64>, decimals: usize) -> Vec<(f64, String)> {
    values.into_iter().map(|v| (v, fixed(v, decimals).replace('-', "−"))).collect()
}

fn whole(r: &Reproduction) -> String {
    let size = [520.0, 400.0];
    let axes = Axes::panel(size, [-80.0, 80.0], [2.2, 3.8], ["θ in degrees", "V in mgl"]);
    let mut svg = Svg::in_page(
        "valley-whole",
        size,
        "Energy along the closure curve",
        "A closed curve of V over theta with two minima of equal height at plus and minus 19.7 degrees and two maxima at plus and \
         minus 73.9 degrees. The result (ix) of the scan lies beside the right minimum, the result (x) at theta = 0.06 degrees \
         on a slope.",
    );
    axes.grid(
        &mut svg,
        [&ticks([-75.0, -50.0, -25.0, 0.0, 25.0, 50.0, 75.0], 0), &ticks([2.5, 3.0, 3.5], 1)],
    );
    let curve = &r.figures.closure_curve;
    let ring = curve.iter().chain(curve.first()).map(|p| axes.at([p[0], p[3]]));
    svg.polyline("curve", ring.collect::<Vec<_>>());
    for (branch, class) in r.figures.scan_points.iter().zip(["scan first", "scan second"]) {
        for point in branch.iter().step_by(EVERY) {
            svg.circle(class, axes.at(*point), 3.0);
        }
    }
    let [ix, x] = r.figures.scan_results;
    // The tangent at (x), as long as it stays in the picture.
    let slope = r.figures.slope_at_x * 1_f64.to_radians();
    let tangent = [-13.0, 26.0].map(|d: f64| axes.at([x[0] + d, x[3] + slope * d]));
    svg.line("tangent", tangent[0], tangent[1]);
    for p in &r.equilibria {
        let at = axes.at([p.lagrange_deg[0], p.lagrange_mgl]);
        let minimum = p.stability.index_in_plane == 0;
        if minimum {
            svg.circle("minimum", at, 6.0);
        } else {
            svg.diamond("maximum", at, 7.0);
        }
        let name = p.name.replace('\'', "′");
        let offset = if minimum { 24.0 } else { -13.0 };
        svg.indexed("label strong", [at[0], at[1] + offset], Anchor::Middle, &name);
    }
    let at = axes.at([x[0], x[3]]);
    svg.cross("wrong-mark", at, 6.0);
    svg.indexed("label strong", [at[0] - 10.0, at[1] - 8.0], Anchor::End, "(x)");
    let at = axes.at([ix[0], ix[3]]);
    svg.indexed("label", [at[0] + 12.0, at[1] + 16.0], Anchor::Start, "(ix)");
    svg.finish()
}

fn near(r: &Reproduction) -> String {
    let size = [380.0, 400.0];
    let [ix, _] = r.figures.scan_results;
    let e1 = r.equilibria.first().map_or([f64::NAN; 2], |p| [p.lagrange_deg[0], p.lagrange_mgl]);
    let above = |point: &[f64; 2]| [point[0], (point[1] - e1[1]) * TINY];
    let highest = r.figures.near_minimum.iter().map(|p| above(p)[1]).fold(0.0, f64::max);
    let axes = Axes::panel(
        size,
        [ix[0] - NEAR_DEG, ix[0] + NEAR_DEG],
        [-0.12 * highest, 1.08 * highest],
        ["θ in degrees", "V − V(E1) in 10⁻⁷ mgl"],
    );
    let mut svg = Svg::in_page(
        "valley-near",
        size,
        "The minimum between two points of the scan",
        "A parabola with the points of the scan on it, 0.0573 degrees apart. E1 at its bottom lies between two of them; the \
         nearer one, 0.015 degrees to the right, is the printed (ix).",
    );
    // Four or five ticks of a round size.
    let step = 10_f64.powf((highest / 2.0).log10().floor()) * 2.0;
    axes.grid(
        &mut svg,
        [
            &ticks([19.6, 19.7, 19.8], 1),
            &ticks((0..=12).map(|k| f64::from(k) * step).filter(|v| *v <= highest), 0),
        ],
    );
    svg.polyline(
        "curve",
        r.figures.near_minimum.iter().map(|p| axes.at(above(p))).collect::<Vec<_>>(),
    );
    for point in &r.figures.scan_points[0] {
        if (point[0] - ix[0]).abs() <= NEAR_DEG {
            svg.circle("scan first", axes.at(above(point)), 4.0);
        }
    }
    let at = axes.at(above(&e1));
    svg.circle("minimum", at, 6.0);
    svg.indexed("label strong", [at[0] - 10.0, at[1] - 12.0], Anchor::Middle, "E1");
    let at = axes.at(above(&[ix[0], ix[3]]));
    svg.indexed("label", [at[0] + 6.0, at[1] + 18.0], Anchor::Start, "(ix)");
    svg.finish()
}
