//! Joints and what holds them.

use crate::look::{Colour, Look};
use crate::structure::labels::{Crossing, Labels};
use crate::structure::scene::{Scene, length};
use crate::structure::{Structure, Support};
use crate::svg::{Anchor, Svg};

const DARK: Colour = Colour::grey(0x22);

/// Radius of a joint, px.
const JOINT: f64 = 3.4;

/// Height and half the width of the triangle under a fixed joint, px.
const FOOT: [f64; 2] = [13.0, 8.0];

/// Half the length of the rail of a joint that slides, px, and its distance from the joint.
const RAIL: [f64; 2] = [18.0, 6.0];

/// A drawing with less detail than this shows no single joints.
const JOINTS: f64 = 0.45;

/// Supports, below everything else.
pub(crate) fn draw(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene, labels: &mut Labels) {
    if !scene.floor.is_empty() {
        let ground = Look::stroke(DARK, 1.4).filled(Colour::grey(0xf0)).class("floor");
        svg.polygon(ground, &scene.floor);
    }
    for (joint, at) in structure.joints.iter().zip(&scene.joints) {
        if let Some(support) = joint.support {
            support_at(svg, support, *at, scene);
            // Nothing is written on it.
            match support {
                Support::Fixed => labels.take([at[0], at[1] + 0.75 * FOOT[0]], 0.7 * FOOT[0]),
                Support::Line(_) | Support::Plane(_) => labels.take(*at, RAIL[1] + 2.0),
            }
            for ends in rails(support, *at, scene) {
                labels.line(ends);
            }
        }
    }
}

pub(crate) fn support_at(svg: &mut Svg, support: Support, at: [f64; 2], scene: &Scene) {
    match support {
        Support::Fixed => foot(svg, at),
        Support::Line(direction) if scene.direction(direction).is_none() => square(svg, at),
        Support::Line(_) | Support::Plane(_) => {
            for [a, b] in rails(support, at, scene) {
                svg.line(Look::stroke(DARK, 1.6).class("support"), a, b);
            }
        }
    }
}

/// The rails of a joint that slides, px: on both sides of a line, and on the side of a plane that its
/// normal does not point to. All that moves in a drawing seen flat moves in it.
fn rails(support: Support, at: [f64; 2], scene: &Scene) -> Vec<[[f64; 2]; 2]> {
    match support {
        Support::Fixed => vec![],
        Support::Line(direction) => {
            let along = scene.direction(direction).into_iter();
            along.flat_map(|along| [1.0, -1.0].map(|side| rail(at, along, side))).collect()
        }
        Support::Plane(normal) => {
            let across = scene.direction(normal).into_iter();
            across.map(|[x, y]| rail(at, [-y, x], 1.0)).collect()
        }
    }
}

/// A triangle on the ground.
fn foot(svg: &mut Svg, [x, y]: [f64; 2]) {
    let [height, half] = FOOT;
    let line = Look::stroke(DARK, 1.4);
    let corners = [[x, y], [x - half, y + height], [x + half, y + height]];
    svg.polygon(line.filled(Colour::grey(0xe0)).class("support"), &corners);
    let ground = y + height;
    svg.line(line, [x - half - 4.0, ground], [x + half + 4.0, ground]);
    let hatch = [-1.0, -0.33, 0.33, 1.0].map(|part| {
        let right = x + part * half + 3.0;
        [[right, ground], [right - 5.0, ground + 5.0]]
    });
    svg.lines(Look::stroke(DARK, 1.0), hatch);
}

/// A line beside the joint, along a direction, on one side of it.
fn rail([x, y]: [f64; 2], [u, v]: [f64; 2], side: f64) -> [[f64; 2]; 2] {
    let [half, beside] = RAIL;
    let [p, q] = [x - side * beside * v, y + side * beside * u];
    [[p - half * u, q - half * v], [p + half * u, q + half * v]]
}

/// A rail that is seen end on.
fn square(svg: &mut Svg, [x, y]: [f64; 2]) {
    let side = RAIL[1] + 2.0;
    let look = Look::stroke(DARK, 1.4).class("support");
    svg.rectangle(look, [x - side, y - side], [2.0 * side; 2]);
}

pub(crate) fn joint_at(svg: &mut Svg, at: [f64; 2], detail: f64) {
    let look = Look::stroke(DARK, 1.4 * detail).filled(Colour::WHITE).class("joint");
    svg.circle(look, at, JOINT * detail);
}

/// Joints, above the members.
pub(crate) fn joints(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene, labels: &mut Labels) {
    for (joint, at) in structure.joints.iter().zip(&scene.joints) {
        if scene.detail >= JOINTS || joint.support.is_some() {
            joint_at(svg, *at, scene.detail.max(JOINTS));
            labels.take(*at, JOINT);
        }
    }
}

/// The names of the joints beside them, where they cover no member if that can be.
pub(crate) fn names(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene, labels: &mut Labels) {
    let crowded = crowded(structure, scene);
    for ((joint, at), crowded) in structure.joints.iter().zip(&scene.joints).zip(crowded) {
        if labels.full() {
            return;
        }
        if scene.detail < 1.0 && joint.support.is_none() {
            continue;
        }
        labels.write(svg, joint.name, &places(*at, crowded), Crossing::Allowed);
    }
}

/// For each joint the sum of the unit directions of its members, px.
fn crowded(structure: &Structure<'_>, scene: &Scene) -> Vec<[f64; 2]> {
    let mut sums = vec![[0.0; 2]; structure.joints.len()];
    for member in structure.members {
        let [a, b] = scene.ends(member.joints);
        let along = [b[0] - a[0], b[1] - a[1]];
        let size = length(along);
        if size > 0.0 {
            for (joint, sign) in member.joints.into_iter().zip([1.0, -1.0]) {
                for k in 0..2 {
                    sums[joint][k] += sign * along[k] / size;
                }
            }
        }
    }
    sums
}

/// Where a name may stand beside a joint: first where its members do not go, then farther out.
fn places([x, y]: [f64; 2], crowded: [f64; 2]) -> Vec<([f64; 2], Anchor)> {
    /// How much farther.
    const FARTHER: f64 = 2.0;
    /// From the joint to its name, px: at the corners, to the sides, above and below.
    const BESIDE: [f64; 3] = [8.0, 9.0, 13.0];
    let [corner, side, above] = BESIDE;
    let mut places = [
        ([corner, -corner], Anchor::Start),
        ([-corner, -corner], Anchor::End),
        ([corner, corner], Anchor::Start),
        ([-corner, corner], Anchor::End),
        ([side, 0.0], Anchor::Start),
        ([-side, 0.0], Anchor::End),
        ([0.0, -above], Anchor::Middle),
        ([0.0, above], Anchor::Middle),
    ];
    let toward = |[u, v]: [f64; 2]| (u * crowded[0] + v * crowded[1]) / length([u, v]);
    // Stable: a joint without members has its name above, to the right.
    places.sort_by(|(a, _), (b, _)| toward(*a).total_cmp(&toward(*b)));
    let at = |by: f64| places.map(|([u, v], anchor)| ([x + by * u, y + by * v], anchor));
    [at(1.0), at(FARTHER)].concat()
}
