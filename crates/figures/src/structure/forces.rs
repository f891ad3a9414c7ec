//! Loads and reactions as arrows, all to one scale.

use crate::look::{Colour, Look};
use crate::palette::GREEN;
use crate::structure::Structure;
use crate::structure::labels::{Labels, short};
use crate::structure::scene::{LONGEST_ARROW, Scene, length};
use crate::svg::{Anchor, Svg};

/// Loads: solid, from the joint on.
pub(crate) const LOAD: Look<'static> = Look::stroke(Colour::BLACK, 1.8).class("load");

/// Reactions: dashed, towards the joint.
pub(crate) const REACTION: Look<'static> = Look::stroke(GREEN, 1.8).dashed("5 3").class("reaction");

/// Arrows shorter than this part of the longest are left out; their labels would say nothing.
const LEAST: f64 = 0.02;

pub(crate) fn draw(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene, labels: &mut Labels) {
    for (joint, at) in structure.joints.iter().zip(&scene.joints) {
        for (force_n, look, outwards) in
            [(joint.load_n, LOAD, true), (joint.reaction_n, REACTION, false)]
        {
            let [x, y] = scene.arrow(force_n);
            let size = length([x, y]);
            if size.is_nan() || size < LEAST * LONGEST_ARROW {
                continue;
            }
            let sign = if outwards { 1.0 } else { -1.0 };
            let far = [at[0] + sign * x, at[1] + sign * y];
            let ends = if outwards { [*at, far] } else { [far, *at] };
            svg.arrow(look, ends[0], ends[1]);
            let newton = force_n[0].hypot(force_n[1]).hypot(force_n[2]);
            labels.write(svg, &format!("{} N", short(newton)), &places(far, *at));
        }
    }
}

/// Where the size of a force may stand: beyond the far end of its arrow, then beside it.
fn places(far: [f64; 2], joint: [f64; 2]) -> [([f64; 2], Anchor); 3] {
    /// From the end of the arrow to the label, px.
    const BEYOND: f64 = 9.0;
    let away = [far[0] - joint[0], far[1] - joint[1]];
    let size = length(away);
    let [u, v] = away.map(|x| BEYOND * x / size);
    let anchor = match u {
        _ if u.abs() < 0.5 * BEYOND => Anchor::Middle,
        u if u > 0.0 => Anchor::Start,
        _ => Anchor::End,
    };
    [
        ([far[0] + u, far[1] + v], anchor),
        ([far[0] + BEYOND, far[1]], Anchor::Start),
        ([far[0] - BEYOND, far[1]], Anchor::End),
    ]
}
