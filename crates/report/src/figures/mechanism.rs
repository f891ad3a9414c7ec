//! The mechanism with its symbols: the paper's Figs. 1 and 2.

use super::{Figure, direction, joints, moved};
use ::figures::{Anchor, Svg};

/// Both models side by side.
pub fn mechanism() -> Figure {
    Figure {
        id: "figure-mechanism",
        panels: vec![in_space(), in_the_plane()],
        caption: "The mechanism, redrawn with the paper's symbols. Left, its Fig. 1: three bars of lengths \
                  l₁, l₂, l₃ hang between the fixed points O and A₃; rᵢ is the distance from the near end of bar i to \
                  its centre of weight Cᵢ, where the bar's own axes start. Right, its Fig. 2: three equal bars, D \
                  straight below O. Angles count from straight down, positive to the right; the third one is negative \
                  here. The print says OD = l, its equations say 2l."
            .to_owned(),
    }
}

/// Fig. 1.
fn in_space() -> String {
    let mut svg = Svg::in_page(
        "mechanism-space",
        [400.0, 340.0],
        "Mechanical model, Fig. 1",
        "A chain of three bars in space from the origin O over the joints A1 and A2 to the fixed point A3. The centre \
         of weight of bar i is C i at the distance r i along the bar of length l i. Axes X and Y are level, Z points up.",
    );
    let joints: [[f64; 2]; 4] = [[96.0, 96.0], [166.0, 222.0], [276.0, 262.0], [348.0, 122.0]];
    let o = joints[0];
    for (end, name, offset) in [
        ([26.0, 136.0], "X", [-4.0, 14.0]),
        ([226.0, 96.0], "Y", [10.0, 5.0]),
        ([96.0, 18.0], "Z", [12.0, 8.0]),
    ] {
        svg.arrow("axis-arrow", o, end);
        svg.indexed("label", moved(end, 1.0, offset), Anchor::Middle, name);
    }
    // Where the centre of each bar lies along it, for drawing: anywhere but in the middle.
    let fractions = [0.44, 0.55, 0.42];
    for (bar, fraction) in fractions.into_iter().enumerate() {
        let (from, to) = (joints[bar], joints[bar + 1]);
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        // To the left of the bar's direction for r, to the right for l.
        let aside = [along[1] / length, -along[0] / length];
        svg.line("bar", from, to);
        let centre = moved(from, fraction, along);
        svg.circle("centre", centre, 4.5);
        svg.indexed(
            "label",
            moved(moved(centre, 17.0, aside), 1.0, [0.0, 5.0]),
            Anchor::Middle,
            &format!("C_{}", bar + 1),
        );
        let [near, far] = [moved(from, -34.0, aside), moved(to, -34.0, aside)];
        svg.arrow("dimension", near, far);
        svg.arrow("dimension", far, near);
        let at = moved(moved(from, 0.62, along), -47.0, aside);
        svg.indexed("label", [at[0], at[1] + 5.0], Anchor::Middle, &format!("l_{}", bar + 1));
        let [near, far] = [moved(from, -10.0, aside), moved(centre, -10.0, aside)];
        svg.arrow("dimension", near, far);
        svg.arrow("dimension", far, near);
        let at = moved(moved(from, fraction * 0.5, along), -21.0, aside);
        svg.indexed("label small", [at[0], at[1] + 4.0], Anchor::Middle, &format!("r_{}", bar + 1));
    }
    for (k, (name, offset)) in [
        ("O", [-14.0, -6.0]),
        ("A_1", [20.0, -6.0]),
        ("A_2", [-12.0, -14.0]),
        ("A_3 (X_3 Y_3 Z_3 )", [-14.0, -20.0]),
    ]
    .into_iter()
    .enumerate()
    {
        let fixed = k == 0 || k == 3;
        svg.circle(if fixed { "anchor" } else { "joint" }, joints[k], 6.0);
        svg.indexed("label strong", moved(joints[k], 1.0, offset), Anchor::Middle, name);
    }
    svg.arrow("force", [376.0, 40.0], [376.0, 84.0]);
    svg.indexed("label", [366.0, 66.0], Anchor::End, "g");
    svg.finish()
}

/// Fig. 2, in a shape that is no equilibrium in particular.
fn in_the_plane() -> String {
    /// Length of a bar and radius of the arcs, px.
    const LENGTH: f64 = 130.0;
    const RADIUS: f64 = 44.0;
    let angles = [30.0, 47.0, -83.5];
    let mut svg = Svg::in_page(
        "mechanism-plane",
        [300.0, 340.0],
        "The example, Fig. 2",
        "Three equal bars OA, AB and BD of length l; D lies below O at twice the length of a bar. Theta, alpha and beta are \
         the angles of the bars from the descending vertical.",
    );
    let origin = [70.0, 34.0];
    let at: Vec<[f64; 2]> =
        joints(angles).iter().map(|joint| moved(origin, LENGTH, *joint)).collect();
    let (o, d) = (at[0], moved(origin, 2.0 * LENGTH, [0.0, 1.0]));
    svg.arrow("axis-arrow", o, moved(d, 36.0, [0.0, 1.0]));
    svg.indexed("label", moved(d, 1.0, [12.0, 36.0]), Anchor::Middle, "x");
    let names = ["θ", "α", "β"];
    for (bar, angle) in angles.into_iter().enumerate() {
        let from = at[bar];
        let to = if bar == 2 { d } else { at[bar + 1] };
        svg.line("bar", from, to);
        svg.line("reference", from, moved(from, RADIUS + 12.0, [0.0, 1.0]));
        svg.arc("dimension", from, RADIUS, 0.0, angle);
        let half = direction(angle / 2.0);
        svg.indexed(
            "label",
            moved(moved(from, RADIUS + 12.0, half), 1.0, [0.0, 5.0]),
            Anchor::Middle,
            names[bar],
        );
        let middle = [f64::midpoint(from[0], to[0]), f64::midpoint(from[1], to[1])];
        let offset = [[12.0, -4.0], [12.0, -6.0], [0.0, 20.0]][bar];
        svg.indexed("label", moved(middle, 1.0, offset), Anchor::Middle, "l");
    }
    let [left, right] = [[28.0, o[1]], [28.0, d[1]]];
    svg.arrow("dimension", left, right);
    svg.arrow("dimension", right, left);
    svg.indexed("label", [20.0, f64::midpoint(o[1], d[1])], Anchor::End, "2l");
    for (joint, name, class, offset) in [
        (o, "O", "anchor", [-14.0, -8.0]),
        (at[1], "A", "joint", [12.0, -8.0]),
        (at[2], "B", "joint", [14.0, 4.0]),
        (d, "D", "anchor", [-16.0, 16.0]),
    ] {
        svg.circle(class, joint, 6.0);
        svg.indexed("label strong", moved(joint, 1.0, offset), Anchor::Middle, name);
    }
    svg.finish()
}
