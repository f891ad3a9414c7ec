//! Members, by the sign and the size of their axial forces.

use std::collections::BTreeSet;

use crate::look::{Colour, Look};
use crate::palette::{BLUE, ORANGE, VERMILION, YELLOW};
use crate::structure::labels::{Crossing, Labels, half_extent, short};
use crate::structure::scene::{Scene, length};
use crate::structure::{Member, Structure};
use crate::svg::{Anchor, Svg};

/// Classes of width.
const WIDTHS: usize = 4;

/// Forces below this part of the largest count as zero: a solver leaves as much.
pub(crate) const NOTHING: f64 = 1e-9;

/// A drawing with less detail than this has no room for hollow lines.
const HOLLOW: f64 = 0.5;

/// Beyond so many members those that the eye cannot tell apart are drawn once.
const MANY: usize = 5_000;

/// What the eye does not tell apart on a screen, px.
pub(crate) const GRAIN: f64 = 0.5;

/// How a member is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Load {
    /// Of this class of width.
    Compression(usize),
    /// No force.
    Nothing,
    /// It is not known.
    Unknown,
    /// Of this class of width.
    Tension(usize),
}

/// In which order they are drawn: where members cross, the thin solid ones stay visible.
fn loads() -> impl Iterator<Item = Load> {
    (0..WIDTHS)
        .map(Load::Compression)
        .chain([Load::Nothing, Load::Unknown])
        .chain((0..WIDTHS).map(Load::Tension))
}

/// The largest force of all members, N.
pub(crate) fn largest(structure: &Structure<'_>) -> f64 {
    structure.members.iter().filter_map(|member| member.axial_n).fold(0.0, |a, b| a.max(b.abs()))
}

pub(crate) fn load(member: &Member, largest: f64) -> Load {
    let Some(force) = member.axial_n else { return Load::Unknown };
    let part = force.abs() / largest;
    if part.is_nan() || part <= NOTHING {
        return Load::Nothing;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 4")]
    let class = ((part * WIDTHS as f64) as usize).min(WIDTHS - 1);
    if force > 0.0 { Load::Tension(class) } else { Load::Compression(class) }
}

/// Draw lines of one kind.
pub(crate) fn stroke(svg: &mut Svg, load: Load, detail: f64, lines: &[[[f64; 2]; 2]]) {
    let width = |class: usize| ((1.8 + 1.0 * class as f64) * detail).max(0.6);
    let each = || lines.iter().copied();
    match load {
        Load::Tension(class) => {
            svg.lines(Look::stroke(BLUE, width(class)).class("tension"), each());
        }
        Load::Compression(class) if detail >= HOLLOW => {
            let outer = width(class) + 2.6 * detail;
            svg.lines(Look::stroke(VERMILION, outer).class("compression"), each());
            svg.lines(Look::stroke(Colour::WHITE, 0.45 * outer), each());
        }
        Load::Compression(class) => {
            svg.lines(Look::stroke(ORANGE, width(class)).class("compression"), each());
        }
        Load::Nothing => {
            let look = Look::stroke(Colour::grey(0x77), (1.6 * detail).max(0.6)).dashed("6 3");
            svg.lines(look.class("unloaded"), each());
        }
        Load::Unknown => {
            svg.lines(Look::stroke(Colour::grey(0x55), width(0)).class("unknown"), each());
        }
    }
}

/// What stands behind members that are too weak.
pub(crate) fn warn(svg: &mut Svg, detail: f64, lines: &[[[f64; 2]; 2]]) {
    svg.lines(Look::stroke(YELLOW, (14.0 * detail).max(3.0)).class("weak"), lines.iter().copied());
}

pub(crate) fn draw(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene) {
    let weak = structure.members.iter().filter(|member| member.weak);
    let weak: Vec<_> = weak.map(|member| scene.ends(member.joints)).collect();
    if !weak.is_empty() {
        warn(svg, scene.detail, &weak);
    }
    let largest = largest(structure);
    let mut seen = BTreeSet::new();
    for wanted in loads() {
        let members = structure.members.iter().filter(|member| load(member, largest) == wanted);
        let lines = members.map(|member| scene.ends(member.joints));
        let lines: Vec<_> = if structure.members.len() > MANY {
            seen.clear();
            lines.filter_map(|line| grained(line, &mut seen)).collect()
        } else {
            lines.collect()
        };
        stroke(svg, wanted, scene.detail, &lines);
    }
}

/// A line with its ends on the grid of what the eye tells apart; none if it has no length there, or
/// is one that was seen before. Members that meet still meet.
fn grained(line: [[f64; 2]; 2], seen: &mut BTreeSet<[[i32; 2]; 2]>) -> Option<[[f64; 2]; 2]> {
    #[expect(clippy::cast_possible_truncation, reason = "pixels of a picture")]
    let mut cells = line.map(|point| point.map(|x| (x / GRAIN).round() as i32));
    cells.sort_unstable();
    let fresh = cells[0] != cells[1] && seen.insert(cells);
    fresh.then(|| cells.map(|point| point.map(|x| f64::from(x) * GRAIN)))
}

/// The forces beside the members, the largest first; of those that are equal to rounding the first in the file.
pub(crate) fn values(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene, labels: &mut Labels) {
    /// Between the member and its label, px.
    const BESIDE: f64 = 4.0;
    /// Least length of a member with a label, px.
    const LEAST: f64 = 20.0;
    /// What is equal to this part of the largest force.
    const ROUNDED: f64 = 1e9;
    if scene.detail < 1.0 {
        return;
    }
    let mut known: Vec<(f64, &Member)> = structure
        .members
        .iter()
        .filter(|m| !m.unlabelled)
        .filter_map(|m| Some((m.axial_n?, m)))
        .collect();
    let largest = known.iter().map(|(force, _)| force.abs()).fold(0.0, f64::max);
    let size = |force: f64| (ROUNDED * force.abs() / largest).round();
    known.sort_by(|a, b| size(b.0).total_cmp(&size(a.0)));
    for (force, &Member { joints, used, .. }) in known {
        if labels.full() {
            return;
        }
        let [a, b] = scene.ends(joints);
        let along = [b[0] - a[0], b[1] - a[1]];
        let size = length(along);
        if size < LEAST {
            continue;
        }
        let middle = [f64::midpoint(a[0], b[0]), f64::midpoint(a[1], b[1])];
        let across = [along[1] / size, -along[0] / size];
        let used = used.filter(|used| used.is_finite());
        let used = used.map_or_else(String::new, |used| format!(", {} %", short(100.0 * used)));
        let text = format!("{} N{used}", short(force));
        // So far off that no corner of the label meets the member.
        let [half_width, half_height] = half_extent(&text);
        let off = BESIDE + half_width * across[0].abs() + half_height * across[1].abs();
        let beside = |side: f64, part: f64| {
            let at = [0, 1].map(|k| middle[k] + part * along[k] + side * off * across[k]);
            (at, Anchor::Middle)
        };
        let places = [0.0, -0.2, 0.2].map(|part| [beside(1.0, part), beside(-1.0, part)]);
        labels.write(svg, &text, places.as_flattened(), Crossing::Never);
    }
}
