//! Loads and reactions as arrows, all to one scale, on that side of the joint where its members are
//! not.

use crate::look::{Colour, Look};
use crate::palette::GREEN;
use crate::structure::Structure;
use crate::structure::labels::{Crossing, Labels, half_extent, short};
use crate::structure::members::NOTHING;
use crate::structure::scene::{LONGEST_ARROW, Scene, length};
use crate::svg::{Anchor, Svg};

/// Loads: solid.
pub(crate) const LOAD: Look<'static> = Look::stroke(Colour::BLACK, 1.8).class("load");

/// Reactions: dashed.
pub(crate) const REACTION: Look<'static> = Look::stroke(GREEN, 1.8).dashed("5 3").class("reaction");

/// Arrows shorter than this part of the longest are left out: they would be hidden by their joints.
const LEAST: f64 = 0.1;

/// Around the tip of an arrow nothing is written, px.
const HEAD: f64 = 5.0;

/// An arrow that leaves its joint is drawn towards it instead where it is nearer to a member than
/// this (the cosine of 15 degrees) and its tail would not be.
const ALONG: f64 = 0.966;

/// A force at a joint as an arrow, px.
struct Arrow {
    joint: usize,
    force: [f64; 2],
    newton: f64,
    look: Look<'static>,
    /// Cosine of the angle to the nearest member, of the force and of its opposite.
    nearest: [f64; 2],
}

pub(crate) fn draw(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene, labels: &mut Labels) {
    // All arrows before the first label: none is to be crossed.
    let arrows = arrows(structure, scene);
    for arrow in &arrows {
        let (at, far) = (scene.joints[arrow.joint], arrow.far(scene));
        let ends = if arrow.inwards() { [far, at] } else { [at, far] };
        svg.arrow(arrow.look, ends[0], ends[1]);
        labels.line(ends);
        labels.take(ends[1], HEAD);
    }
    for arrow in &arrows {
        let places = places(arrow.far(scene), scene.joints[arrow.joint]);
        labels.write(svg, &arrow.label(), &places, Crossing::Allowed);
    }
}

/// Which of loads and reactions are drawn, and the size below which some are left out, N.
pub(crate) fn drawn(structure: &Structure<'_>, scene: &Scene) -> ([bool; 2], Option<f64>) {
    let arrows = arrows(structure, scene);
    let drawn = [LOAD, REACTION].map(|look| arrows.iter().any(|arrow| arrow.look == look));
    let forces = structure.joints.iter().flat_map(|joint| [joint.load_n, joint.reaction_n]);
    let mut parts = forces.map(|force_n| length(scene.arrow(force_n)) / LONGEST_ARROW);
    let is_hidden = parts.any(|part| part > NOTHING && part < LEAST);
    (drawn, is_hidden.then(|| LEAST * LONGEST_ARROW / scene.force_scale))
}

/// How far arrows and their labels reach beyond the picture, px, to the left and to the right.
pub(crate) fn overhang(structure: &Structure<'_>, scene: &Scene) -> [f64; 2] {
    /// Room between a label and the edge, px.
    const EDGE: f64 = 4.0;
    arrows(structure, scene).iter().fold([0.0, 0.0], |[left, right]: [f64; 2], arrow| {
        let [([x, _], anchor), ..] = places(arrow.far(scene), scene.joints[arrow.joint]);
        let width = 2.0 * half_extent(&arrow.label())[0];
        let begin = x - width
            * match anchor {
                Anchor::Start => 0.0,
                Anchor::Middle => 0.5,
                Anchor::End => 1.0,
            };
        [left.max(EDGE - begin), right.max(begin + width + EDGE - scene.size[0])]
    })
}

impl Arrow {
    /// Whether it is drawn towards its joint.
    fn inwards(&self) -> bool {
        self.nearest[0] > ALONG && self.nearest[1] < self.nearest[0]
    }

    /// The end that is not at its joint.
    fn far(&self, scene: &Scene) -> [f64; 2] {
        let at = scene.joints[self.joint];
        let sign = if self.inwards() { -1.0 } else { 1.0 };
        [0, 1].map(|k| at[k] + sign * self.force[k])
    }

    fn label(&self) -> String {
        format!("{} N", short(self.newton))
    }
}

fn arrows(structure: &Structure<'_>, scene: &Scene) -> Vec<Arrow> {
    let mut arrows = vec![];
    let mut of_joint = vec![[usize::MAX; 2]; structure.joints.len()];
    for (k, joint) in structure.joints.iter().enumerate() {
        for (which, (force_n, look)) in
            [(joint.load_n, LOAD), (joint.reaction_n, REACTION)].into_iter().enumerate()
        {
            let force = scene.arrow(force_n);
            let size = length(force);
            if size.is_nan() || size < LEAST * LONGEST_ARROW {
                continue;
            }
            of_joint[k][which] = arrows.len();
            let newton = force_n[0].hypot(force_n[1]).hypot(force_n[2]);
            arrows.push(Arrow { joint: k, force, newton, look, nearest: [-1.0; 2] });
        }
    }
    for member in structure.members {
        let [a, b] = scene.ends(member.joints);
        let along = [b[0] - a[0], b[1] - a[1]];
        for (joint, sign) in member.joints.into_iter().zip([1.0, -1.0]) {
            for arrow in of_joint[joint].into_iter().filter(|arrow| *arrow != usize::MAX) {
                let Arrow { force: [x, y], nearest, .. } = &mut arrows[arrow];
                let cosine =
                    sign * (*x * along[0] + *y * along[1]) / (length([*x, *y]) * length(along));
                *nearest = [nearest[0].max(cosine), nearest[1].max(-cosine)];
            }
        }
    }
    arrows
}

/// Where the size of a force may stand: beyond the far end of its arrow, then beside it.
fn places(far: [f64; 2], joint: [f64; 2]) -> [([f64; 2], Anchor); 3] {
    /// From the end of the arrow to the label, px.
    const BEYOND: f64 = 12.0;
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
