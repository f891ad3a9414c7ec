//! What the marks mean, and the scales of lengths and forces.

use crate::look::{Colour, Look};
use crate::structure::forces::{LOAD, REACTION, drawn};
use crate::structure::labels::short;
use crate::structure::members::{GRAIN, Load, largest, load, stroke, warn};
use crate::structure::scene::{LONGEST_ARROW, SIDE, Scene, length};
use crate::structure::supports::support_at;
use crate::structure::{Member, Structure, Support};
use crate::svg::{Anchor, Svg};

/// From the lower edge to the two lines of the key, px.
const LINES: [f64; 2] = [64.0, 28.0];

/// Length of a swatch and what its name stands off, px.
const SWATCH: f64 = 34.0;
const BESIDE: f64 = 8.0;

/// Least length of a scale, px.
const SCALE: f64 = 90.0;

/// A line of the key in the making: where the next entry begins.
struct Row {
    x: f64,
    y: f64,
}

impl Row {
    /// An entry: its swatch between two points, and its name.
    fn entry(&mut self, svg: &mut Svg, name: &str, draw: impl FnOnce(&mut Svg, [[f64; 2]; 2])) {
        draw(svg, [[self.x, self.y], [self.x + SWATCH, self.y]]);
        self.name(svg, SWATCH, name);
    }

    /// The name of what is as wide as this.
    fn name(&mut self, svg: &mut Svg, width: f64, name: &str) {
        /// Mean width of a letter of 12 px.
        const LETTER: f64 = 6.4;
        let at = [self.x + width + BESIDE, self.y + 4.0];
        svg.text(Look::PLAIN.size(12.0), at, Anchor::Start, name);
        self.x += width + BESIDE + LETTER * name.chars().count() as f64 + 20.0;
    }

    /// A scale: a line of a round length in some unit, and how long it is.
    fn scale(&mut self, svg: &mut Svg, per_unit: f64, least: f64, unit: &str) {
        let length = round_above(least / per_unit);
        let width = length * per_unit;
        let look = Look::stroke(Colour::grey(0x22), 1.5).class("scale");
        let [x, y, end] = [self.x, self.y, self.x + width];
        svg.line(look, [x, y], [end, y]);
        svg.lines(look, [x, end].map(|x| [[x, y - 4.0], [x, y + 4.0]]));
        self.name(svg, width, &format!("{} {unit}", plain(length)));
    }
}

pub(crate) fn draw(svg: &mut Svg, structure: &Structure<'_>, scene: &Scene) {
    let [first, second] = LINES.map(|below| scene.size[1] - below);
    let mut row = Row { x: SIDE, y: first };
    let largest = largest(structure);
    // A member that is seen end on is not drawn.
    let long = |[a, b]: [[f64; 2]; 2]| length([a[0] - b[0], a[1] - b[1]]) >= GRAIN;
    // Those of a chain of millions are all short, and make a line.
    let any_long = structure.members.iter().any(|member| long(scene.ends(member.joints)));
    let is = |wanted: fn(&Load) -> bool| {
        let seen = |member: &&Member| !any_long || long(scene.ends(member.joints));
        structure.members.iter().filter(seen).any(|member| wanted(&load(member, largest)))
    };
    for (there, load, name) in [
        (is(|load| matches!(load, Load::Tension(_))), Load::Tension(2), "tension"),
        (is(|load| matches!(load, Load::Compression(_))), Load::Compression(2), "compression"),
        (is(|load| *load == Load::Nothing), Load::Nothing, "no force"),
        (is(|load| *load == Load::Unknown), Load::Unknown, "force unknown"),
    ] {
        if there {
            row.entry(svg, name, |svg, ends| stroke(svg, load, scene.detail, &[ends]));
        }
    }
    if structure.members.iter().any(|member| member.weak) {
        row.entry(svg, "too weak", |svg, ends| warn(svg, scene.detail, &[ends]));
    }
    if structure.joints.iter().any(|joint| joint.support == Some(Support::Fixed)) {
        let middle = [row.x + 0.5 * SWATCH, row.y - 6.0];
        support_at(svg, Support::Fixed, middle, scene);
        row.name(svg, SWATCH, "support");
    }
    let ([loads, reactions], least_n) = drawn(structure, scene);
    if loads {
        row.entry(svg, "load", |svg, [from, to]| svg.arrow(LOAD, from, to));
    }
    if reactions {
        row.entry(svg, "reaction", |svg, [from, to]| svg.arrow(REACTION, from, to));
    }
    let mut row = Row { x: SIDE, y: second };
    if scene.scale > 0.0 {
        row.scale(svg, scene.scale, SCALE, "m");
    }
    if scene.force_scale > 0.0 {
        let unit = match least_n {
            Some(least_n) => format!("N (arrows; none below {} N)", short(least_n)),
            None => "N (arrows)".to_owned(),
        };
        row.scale(svg, scene.force_scale, 0.5 * LONGEST_ARROW, &unit);
    }
    if scene.view.spatial {
        triad(svg, scene);
    }
}

/// The directions of the world, where the lower right corner has room.
fn triad(svg: &mut Svg, scene: &Scene) {
    /// Length of an axis that is seen at right angles, px.
    const LONG: f64 = 40.0;
    // Above the line of the key, whatever that has to say.
    let origin = [scene.size[0] - SIDE, scene.size[1] - LINES[0] - 34.0];
    let look = Look::stroke(Colour::grey(0x55), 1.2).class("axis");
    for (k, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let mut axis = [0.0; 3];
        axis[k] = LONG;
        let [x, y] = scene.view.seen(axis);
        // Seen end on.
        if length([x, y]) < 1.0 {
            continue;
        }
        svg.arrow(look, origin, [origin[0] + x, origin[1] - y]);
        let at = [origin[0] + 1.3 * x, origin[1] - 1.3 * y + 4.0];
        svg.text(Look::PLAIN.size(12.0), at, Anchor::Middle, name);
    }
}

/// The smallest of 1, 2, 5 times a power of ten that is not below a positive number.
fn round_above(x: f64) -> f64 {
    let power = 10_f64.powf(x.log10().floor());
    let leading = [1.0, 2.0, 5.0].into_iter().find(|leading| leading * power >= x).unwrap_or(10.0);
    // Through its decimal digits, so that no rounding error shows.
    format!("{:.0e}", leading * power).parse().unwrap_or(x)
}

fn plain(x: f64) -> String {
    if (1e-3..1e5).contains(&x) { x.to_string() } else { format!("{x:e}") }
}
