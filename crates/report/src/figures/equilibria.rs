//! The positions to scale with their forces: the paper's Figs. 3 and 4, and what Fig. 4 should have
//! been.

use ::figures::{Anchor, Svg};
use paper::Reproduction;
use paper::reproduction::Position;

use super::{Figure, joints, moved};
use crate::numbers::fixed;

/// Length of a bar and of a force as large as a bar's weight, px.
const LENGTH: f64 = 118.0;
const FORCE: f64 = 34.0;

/// A bar that leaves the vertical by less hides its weight, which is then drawn this far beside it,
/// px.
const HIDDEN: f64 = 6.0;
const BESIDE: f64 = 11.0;

/// Size of a panel, and where O lies in it.
const SIZE: [f64; 2] = [300.0, 486.0];
const ORIGIN: [f64; 2] = [118.0, 138.0];

/// E1, what Fig. 4 shows, and E2.
pub fn equilibria(r: &Reproduction) -> Figure {
    let of = |name: &str| r.equilibria.iter().find(|p| p.name == name);
    let mut panels = Vec::new();
    panels.extend(
        of("E1").map(|p| equilibrium(p, "equilibrium-e1", "E1: Fig. 3, the lowest position")),
    );
    panels.push(printed(r));
    panels
        .extend(of("E2").map(|p| equilibrium(p, "equilibrium-e2", "E2: what Fig. 4 should show")));
    Figure {
        id: "figure-equilibria",
        panels,
        caption: format!(
            "To scale, with the forces of the ground on the chain at O and D and the weights of the bars. Solid bars are \
             in tension, dashed thick ones in compression. Left: the paper's first position, corrected; bar BD props \
             the chain up. Middle: the paper's second position (x). No reactions can hold it: whatever the \
             multipliers, {} mg of its equations are left over, and let go it would fall. Right: the second \
             equilibrium there is, the first one turned upside down, a maximum of the energy. E1 and E2 each have a \
             mirror image, and turned about OD each makes a circle of equilibria in space.",
            left_over(r).map_or_else(|| "some".to_owned(), |number| fixed(number, 4)),
        ),
    }
}

/// What the best multipliers leave of (40) at (x), mg.
fn left_over(r: &Reproduction) -> Option<f64> {
    r.claims.iter().find(|claim| claim.printed.id == "x-multipliers").and_then(|claim| claim.number)
}

/// Where a joint lies in a panel.
fn place(joint: [f64; 2]) -> [f64; 2] {
    moved(ORIGIN, LENGTH, joint)
}

fn equilibrium(p: &Position, id: &str, heading: &str) -> String {
    let [theta, alpha, beta] = p.lagrange_deg.map(|angle| fixed(angle, 2));
    let state = |axial: f64| if axial < 0.0 { "compression" } else { "tension" };
    let states = p.axial_mg.map(state);
    let description = format!(
        "Angles {theta}, {alpha} and {beta} degrees from straight down. Reaction at O {} level and {} up, at D {} level and \
         {} up, in units of a bar's weight. Bar OA in {}, AB in {}, BD in {}. Energy {} mgl.",
        fixed(p.forces_mg[0][0], 3),
        fixed(p.forces_mg[0][1], 3),
        fixed(p.forces_mg[3][0], 3),
        fixed(p.forces_mg[3][1], 3),
        states[0],
        states[1],
        states[2],
        fixed(p.lagrange_mgl, 5),
    );
    let mut svg = Svg::in_page(id, SIZE, heading, &description);
    svg.indexed("heading", [SIZE[0] / 2.0, 20.0], Anchor::Middle, heading);
    let at = joints(p.lagrange_deg).map(place);
    svg.line("reference", at[0], at[3]);
    for (bar, state) in states.into_iter().enumerate() {
        svg.line(&format!("bar {state}"), at[bar], at[bar + 1]);
    }
    weights(&mut svg, &at);
    for (joint, name) in [(0, "O"), (3, "D")] {
        let [across, up] = p.forces_mg[joint];
        let force = [across, -up];
        // The arrow starts at the joint and points where the ground pulls.
        let tip = moved(at[joint], FORCE, force);
        svg.arrow("force reaction", at[joint], tip);
        let size = format!("{} mg at {name}", fixed(across.hypot(up), 3));
        if joint == 0 {
            svg.indexed("label small", moved(tip, 1.0, [-8.0, 4.0]), Anchor::End, &size);
        } else {
            svg.indexed("label small", moved(at[joint], 1.0, [0.0, 30.0]), Anchor::Middle, &size);
        }
    }
    names(&mut svg, &at);
    let axial = p.axial_mg.map(|f| fixed(f, 2)).join(", ");
    let forces = format!("V = {} mgl, axial {axial} mg", fixed(p.lagrange_mgl, 5));
    caption(&mut svg, [&format!("θ = {theta}°, α = {alpha}°, β = {beta}°"), &forces]);
    svg.finish()
}

/// (x) as printed.
fn printed(r: &Reproduction) -> String {
    let [theta, alpha, beta, energy] = r.figures.scan_results[1];
    let heading = "(x): Fig. 4 as printed, no equilibrium";
    let mut svg = Svg::in_page(
        "equilibrium-x",
        SIZE,
        heading,
        &format!(
            "Bar OA hangs straight down from O; AB and BD make an equal-sided triangle with the rest of OD, to the left. \
             Energy {} mgl. No reactions are drawn, since none balance the weights; an arrow shows that A is pulled aside.",
            fixed(energy, 5)
        ),
    );
    svg.indexed("heading", [SIZE[0] / 2.0, 20.0], Anchor::Middle, heading);
    let at = joints([theta, alpha, beta]).map(place);
    for bar in 0..3 {
        svg.line("bar refuted", at[bar], at[bar + 1]);
    }
    weights(&mut svg, &at);
    // V falls towards smaller theta: A moves to the left.
    svg.arrow("force falls", moved(at[1], 1.0, [-10.0, 0.0]), moved(at[1], 1.0, [-46.0, 0.0]));
    let slope = format!("dV/dθ = {} mgl/rad", fixed(r.figures.slope_at_x, 3));
    for (text, below) in [("V falls to the left:", 14.0), (&*slope, 31.0)] {
        svg.indexed("label small", moved(at[1], 1.0, [16.0, below]), Anchor::Start, text);
    }
    names(&mut svg, &at);
    let alpha = alpha - 360.0 * f64::from(alpha > 180.0);
    let [theta, alpha, beta] = [theta, alpha, beta].map(|angle| fixed(angle, 2));
    let angles = format!("θ = {theta}°, α = {alpha}°, β = {beta}°");
    caption(&mut svg, [&angles, &format!("V = {} mgl", fixed(energy, 5))]);
    svg.finish()
}

/// Two lines under a panel.
fn caption(svg: &mut Svg, lines: [&str; 2]) {
    for (line, below) in lines.into_iter().zip([0.0, 20.0]) {
        let at = [SIZE[0] / 2.0, SIZE[1] - 34.0 + below];
        svg.indexed("label small", at, Anchor::Middle, line);
    }
}

/// The three weights at the middles of the bars; beside the bar where it hangs straight down and
/// would hide its own.
fn weights(svg: &mut Svg, at: &[[f64; 2]; 4]) {
    for ends in at.windows(2) {
        let middle = [f64::midpoint(ends[0][0], ends[1][0]), f64::midpoint(ends[0][1], ends[1][1])];
        let upright = (ends[1][0] - ends[0][0]).abs() < HIDDEN;
        let from = if upright { moved(middle, 1.0, [BESIDE, 0.0]) } else { middle };
        svg.arrow("force weight", from, moved(from, FORCE, [0.0, 1.0]));
    }
}

fn names(svg: &mut Svg, at: &[[f64; 2]; 4]) {
    let lean = |k: usize| if at[k][0] >= at[0][0] { 12.0 } else { -12.0 };
    let offsets = [[-14.0, 4.0], [lean(1), -6.0], [lean(2), 6.0], [-14.0, 8.0]];
    for (k, name) in ["O", "A", "B", "D"].into_iter().enumerate() {
        svg.circle(if k == 0 || k == 3 { "anchor" } else { "joint" }, at[k], 5.0);
        svg.indexed("label strong", moved(at[k], 1.0, offsets[k]), Anchor::Middle, name);
    }
}
