//! All shapes side by side, as SVG.
//!
//! Colours are two of M. Okabe and K. Ito's palette, which people of every colour vision tell apart
//! (<https://jfly.uni-koeln.de/color/>). Tension and compression differ by their form as well: a
//! solid line like a taut string, a hollow one like a tube; so they do in grey and on bad paper.

use std::fmt::Write;

use figures::{Anchor, BLUE, Colour, Look, Svg, VERMILION};
use model::number::decimals;
use numerics::Interval;

use crate::run::Census;
use crate::run::position::Position;

/// The longer side of the common frame of all shapes, px, and the least room for the caption.
const SIDE: f64 = 170.0;
const LEAST_WIDTH: f64 = 150.0;

/// Room around a shape, for the marks of joints and anchors, and below it for three lines of
/// caption.
const MARGIN: f64 = 18.0;
const CAPTION: f64 = 52.0;

/// Room for title and subtitle, and for the key below.
const HEAD: f64 = 56.0;
const FOOT: f64 = 44.0;

/// Width of a row: the figure fits a page or a screen.
const ROW: f64 = 1_150.0;

/// Least width of the whole figure: the key must fit.
const LEAST_FIGURE: f64 = 560.0;

/// Distance of the lines of a caption.
const LINE: f64 = 15.0;

/// Tension: blue, solid. Compression: vermilion with a white core, hollow.
const TENSION: Look<'_> = Look::stroke(BLUE, 3.5).class("bar");
const UNLOADED: Look<'_> = Look::stroke(Colour::grey(0x77), 2.0).dashed("6 3").class("bar");
const COMPRESSION: Look<'_> = Look::stroke(VERMILION, 6.5).class("bar");
const CORE: Look<'_> = Look::stroke(Colour::WHITE, 2.5).class("core");
const DARK: Colour = Colour::grey(0x22);
const SPAN: Look<'_> = Look::stroke(Colour::grey(0x99), 1.0).dashed("2 4").class("span");
const SCALE: Look<'_> = Look::stroke(DARK, 1.5).class("scale");
const TEXT: Look<'_> = Look::fill(DARK);

/// Size of the letters, px.
const LETTERS: f64 = 12.0;

impl Census {
    /// The shapes of the first `limit` positions in their vertical plane, each with its energy, its
    /// stability and its indices: an SVG file that needs no font and no script. All panels have the
    /// same scale, which a bar of round length below them shows.
    ///
    /// Slack families are not drawn, and neither is what is undecided; the subtitle says so.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let svg = census.figure("three equal bars", 60);
    /// assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    /// assert_eq!(svg.matches("class=\"shape\"").count(), 4);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    pub fn figure(&self, name: &str, limit: usize) -> String {
        self.figure_of(
            name,
            &self.positions().take(limit).collect::<Vec<_>>(),
            self.count_in_plane(),
        )
    }

    /// The same of these positions, of so many that there are.
    pub(crate) fn figure_of(&self, name: &str, shown: &[Position], all: usize) -> String {
        let shapes: Vec<Vec<[f64; 2]>> = shown.iter().map(shape).collect();
        let frame = Frame::around(&shapes);
        let panel_width = frame.size.max(LEAST_WIDTH) + 2.0 * MARGIN;
        let columns = columns(shown.len(), panel_width);
        let rows: Vec<Row> =
            shapes.chunks(columns).map(|shapes| Row::around(&frame, shapes)).collect();
        let grid = columns as f64 * panel_width;
        let unloaded = shown.iter().any(|position| position.equilibrium.signs.contains(&0));
        let width = grid.max(LEAST_FIGURE + if unloaded { NO_FORCE_KEY } else { 0.0 });
        let height = HEAD + rows.iter().map(Row::height).sum::<f64>() + FOOT;
        let subtitle = self.subtitle(shown.len(), all);
        let size = [width, height].map(|side| (10.0 * side).round() / 10.0);
        let mut svg = Svg::new(size, &format!("Equilibria of {name}")).letters(LETTERS).described(
            &format!(
                "{subtitle} Each panel shows one shape in its vertical plane, with its energy, its stability \
                 and its indices; bars in tension are solid, bars in compression hollow, bars without force \
                 dashed."
            ),
        );
        svg.text(TEXT.size(16.0).bold(), [MARGIN, 24.0], Anchor::Start, name);
        svg.text(TEXT, [MARGIN, 43.0], Anchor::Start, &subtitle);
        let left = 0.5 * (width - grid);
        let mut y = HEAD;
        let panels = shown.chunks(columns).zip(shapes.chunks(columns));
        for (row, (positions, shapes)) in rows.iter().zip(panels) {
            for (k, (position, shape)) in positions.iter().zip(shapes).enumerate() {
                let x = left + k as f64 * panel_width;
                let points: Vec<[f64; 2]> =
                    shape.iter().map(|point| row.place(&frame, panel_width, *point)).collect();
                let caption = Caption::of(position);
                svg.group("shape", [x, y], Some(&caption.title()), |svg| {
                    panel(svg, position, &points);
                    caption.draw(svg, 0.5 * panel_width, row.size + 2.0 * MARGIN + LETTERS);
                });
            }
            y += row.height();
        }
        key(&mut svg, &frame, unloaded, height - 0.5 * FOOT);
        svg.finish()
    }

    /// What is shown, and what is not.
    fn subtitle(&self, shown: usize, all: usize) -> String {
        let circles = all / 2;
        let mut text = if shown < all {
            format!("The {shown} lowest of {all} equilibria in the plane")
        } else {
            format!("{all} {} in the plane", if all == 1 { "equilibrium" } else { "equilibria" })
        };
        if self.circles {
            let noun = if circles == 1 { "circle" } else { "circles" };
            let _ = write!(text, " ({circles} {noun} in space)");
        }
        text += if self.complete { ", proved to be all." } else { ", not proved to be all." };
        for (number, one, many) in [
            (self.families.len(), "slack family is", "slack families are"),
            (self.undecided.len(), "undecided box is", "undecided boxes are"),
        ] {
            if number > 0 {
                let _ =
                    write!(text, " {number} {} not drawn.", if number == 1 { one } else { many });
            }
        }
        text
    }
}

/// As many panels in a row as fit, evenly spread over the rows.
fn columns(panels: usize, width: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 7")]
    let most = ((ROW / width) as usize).max(1);
    let rows = panels.div_ceil(most).max(1);
    panels.div_ceil(rows).max(1)
}

/// The joints in the plane: along the horizontal from the first to the last anchor (for anchors on
/// one vertical, along Y) and up, from joint 0.
fn shape(position: &Position) -> Vec<[f64; 2]> {
    let joints: Vec<[f64; 3]> =
        position.equilibrium.joints_m.iter().map(|joint| joint.map(Interval::mid)).collect();
    let (Some(start), Some(end)) = (joints.first(), joints.last()) else { return vec![] };
    let [x, y] = [end[0] - start[0], end[1] - start[1]];
    let distance = x.hypot(y);
    let along = if position.equilibrium.circle || distance <= 0.0 {
        [0.0, 1.0]
    } else {
        [x / distance, y / distance]
    };
    joints
        .iter()
        .map(|joint| {
            let level = (joint[0] - start[0]) * along[0] + (joint[1] - start[1]) * along[1];
            [level, joint[2] - start[2]]
        })
        .collect()
}

/// The common scale of all panels.
#[derive(Debug)]
struct Frame {
    /// Of the level coordinate, m.
    middle: f64,
    /// Pixels from the leftmost to the rightmost joint.
    size: f64,
    /// Pixels per metre.
    scale: f64,
}

impl Frame {
    fn around(shapes: &[Vec<[f64; 2]>]) -> Self {
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for point in shapes.iter().flatten() {
            for k in 0..2 {
                low[k] = low[k].min(point[k]);
                high[k] = high[k].max(point[k]);
            }
        }
        let size = [high[0] - low[0], high[1] - low[1]];
        let longest = size[0].max(size[1]);
        if !(longest.is_finite() && longest > 0.0) {
            return Self { middle: 0.0, size: SIDE, scale: 0.0 };
        }
        let scale = SIDE / longest;
        Self { middle: 0.5 * low[0] + 0.5 * high[0], size: size[0] * scale, scale }
    }
}

/// The heights of the shapes of one row: rows of flat shapes are low.
#[derive(Debug)]
struct Row {
    /// Of the highest joint, m.
    top: f64,
    /// Pixels from the highest to the lowest joint.
    size: f64,
}

impl Row {
    fn around(frame: &Frame, shapes: &[Vec<[f64; 2]>]) -> Self {
        let heights = || shapes.iter().flatten().map(|point| point[1]);
        let top = heights().fold(f64::NEG_INFINITY, f64::max);
        let bottom = heights().fold(f64::INFINITY, f64::min);
        Self { top, size: frame.scale * (top - bottom) }
    }

    /// Pixels with margins and caption.
    fn height(&self) -> f64 {
        self.size + 2.0 * MARGIN + CAPTION
    }

    /// A point of the plane in a panel of this width.
    fn place(&self, frame: &Frame, width: f64, point: [f64; 2]) -> [f64; 2] {
        [
            0.5 * width + frame.scale * (point[0] - frame.middle),
            MARGIN + frame.scale * (self.top - point[1]),
        ]
    }
}

/// A bar between two points.
fn bar(svg: &mut Svg, [from, to]: [[f64; 2]; 2], sign: i8) {
    match sign {
        ..0 => {
            svg.line(COMPRESSION, from, to);
            svg.line(CORE, from, to);
        }
        0 => svg.line(UNLOADED, from, to),
        1.. => svg.line(TENSION, from, to),
    }
}

fn joint(svg: &mut Svg, at: [f64; 2]) {
    svg.circle(Look::stroke(DARK, 1.4).filled(Colour::WHITE), at, 3.2);
}

fn anchor(svg: &mut Svg, [x, y]: [f64; 2]) {
    svg.rectangle(Look::fill(DARK), [x - 4.5, y - 4.5], [9.0; 2]);
}

/// A shape: `points` are its joints.
fn panel(svg: &mut Svg, position: &Position, points: &[[f64; 2]]) {
    let (Some(first), Some(last)) = (points.first(), points.last()) else { return };
    svg.line(SPAN, *first, *last);
    // Hollow bars first: where bars cross, the thin solid ones stay visible.
    for compressed in [true, false] {
        for (ends, sign) in points.windows(2).zip(&position.equilibrium.signs) {
            if (*sign < 0) == compressed {
                bar(svg, [ends[0], ends[1]], *sign);
            }
        }
    }
    for point in points.get(1..points.len() - 1).unwrap_or_default() {
        joint(svg, *point);
    }
    anchor(svg, *first);
    anchor(svg, *last);
}

/// What stands under a shape: its number, energy, stability and indices.
struct Caption {
    label: String,
    energy: String,
    stability: &'static str,
    indices: String,
}

impl Caption {
    fn of(position: &Position) -> Self {
        let equilibrium = &position.equilibrium;
        let (in_plane, in_space) = (equilibrium.index_in_plane, equilibrium.index_in_space());
        Self {
            label: position.label(),
            energy: format!("{} J", short(equilibrium.energy_j.mid()).replace('-', "\u{2212}")),
            stability: match (equilibrium.optimal, in_plane, in_space) {
                (true, ..) => "lowest of all",
                (false, _, 0) => "stable",
                (false, 0, _) => "stable in the plane only",
                (false, ..) => "unstable",
            },
            indices: format!("index {in_plane} in plane, {in_space} in space"),
        }
    }

    fn title(&self) -> String {
        let Self { label, energy, stability, indices } = self;
        format!("{label}: {energy}, {stability}, {indices}")
    }

    /// Three lines, centred, the first one at `top`.
    fn draw(&self, svg: &mut Svg, middle: f64, top: f64) {
        // No-break spaces: plain ones are lost between pieces.
        let energy = format!("\u{a0} {}", self.energy);
        let first = [(TEXT.bold(), self.label.as_str()), (TEXT, energy.as_str())];
        svg.pieces([middle, top], Anchor::Middle, &first);
        svg.text(TEXT, [middle, top + LINE], Anchor::Middle, self.stability);
        let grey = Look::fill(Colour::grey(0x55));
        svg.text(grey, [middle, top + 2.0 * LINE], Anchor::Middle, &self.indices);
    }
}

/// What the key is longer where some bar carries no force.
const NO_FORCE_KEY: f64 = 112.0;

fn key(svg: &mut Svg, frame: &Frame, unloaded: bool, y: f64) {
    let text =
        |svg: &mut Svg, x: f64, text: &str| svg.text(TEXT, [x, y + 4.0], Anchor::Start, text);
    svg.group("key", [0.0; 2], None, |svg| {
        let swatch = |x: f64| [[x, y], [x + 36.0, y]];
        bar(svg, swatch(MARGIN), 1);
        text(svg, MARGIN + 44.0, "tension");
        bar(svg, swatch(MARGIN + 104.0), -1);
        text(svg, MARGIN + 148.0, "compression");
        let mut left = MARGIN + 244.0;
        if unloaded {
            bar(svg, swatch(left), 0);
            text(svg, left + 44.0, "no force");
            left += NO_FORCE_KEY;
        }
        anchor(svg, [left, y]);
        text(svg, left + 12.0, "anchor");
        joint(svg, [left + 72.0, y]);
        text(svg, left + 82.0, "joint");
        if frame.scale > 0.0 {
            let length = round_below(0.5 * SIDE / frame.scale);
            let [x, end] = [left + 132.0, left + 132.0 + length * frame.scale];
            svg.line(SCALE, [x, y], [end, y]);
            for x in [x, end] {
                svg.line(SCALE, [x, y - 4.0], [x, y + 4.0]);
            }
            let plain = (1e-3..1e5).contains(&length);
            let words = if plain { format!("{length} m") } else { format!("{length:e} m") };
            text(svg, end + 8.0, &words);
        }
    });
}

/// The largest of 1, 2, 5 times a power of ten that is not above a positive number.
fn round_below(x: f64) -> f64 {
    let power = 10_f64.powf(x.log10().floor());
    let leading = [5.0, 2.0].into_iter().find(|leading| leading * power <= x).unwrap_or(1.0);
    // Through its decimal digits, so that no rounding error shows.
    format!("{:.0e}", leading * power).parse().unwrap_or(x)
}

/// Six digits, without an exponent where that is short.
fn short(x: f64) -> String {
    if x.abs() < f64::MIN_POSITIVE {
        return "0".to_owned();
    }
    if x.abs() < 1e-3 || x.abs() >= 1e6 {
        return format!("{x:.5e}");
    }
    format!("{x:.*}", decimals(x, 6, 8))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Settings;

    fn take(problem: &model::Problem) -> Census {
        Census::take(problem, &Settings::default()).unwrap()
    }

    #[test]
    fn every_bar_is_drawn_at_scale_and_by_its_force() {
        let problem = model::cases::get("three-bars-off-centre").unwrap().problem();
        let census = take(&problem);
        let svg = census.figure("a < b & c", 60);
        assert!(
            svg.contains("a &lt; b &amp; c") && svg.contains("4 equilibria in the plane, proved")
        );
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        let compressed: usize = census
            .equilibria
            .iter()
            .map(|e| e.signs.iter().filter(|sign| **sign < 0).count())
            .sum();
        // One more hollow line in the key.
        assert_eq!(svg.matches("class=\"core\"").count(), compressed + 1);
        assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count());
        // Lengths of the drawn bars are those of the chain in some order, whatever the equilibrium.
        let number = |line: &str, key: &str| -> f64 {
            let rest = line.split(&format!(" {key}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        let drawn = |line: &str| {
            let dx = number(line, "x2") - number(line, "x1");
            dx.hypot(number(line, "y2") - number(line, "y1"))
        };
        let mut lengths: Vec<f64> =
            problem.chain().bars().iter().map(model::Bar::length_m).collect();
        lengths.sort_by(f64::total_cmp);
        let mut scales = vec![];
        for panel in svg.split("class=\"shape\"").skip(1) {
            let panel = panel.split("</g>").next().unwrap();
            let bars = panel.lines().filter(|line| line.contains("class=\"bar\""));
            let mut drawn: Vec<f64> = bars.map(drawn).collect();
            drawn.sort_by(f64::total_cmp);
            assert_eq!(drawn.len(), lengths.len());
            scales.extend(drawn.iter().zip(&lengths).map(|(pixels, metres)| pixels / metres));
        }
        assert_eq!(scales.len(), 12);
        // Coordinates are written to a hundredth of a pixel.
        assert!(scales.iter().all(|scale| (scale - scales[0]).abs() < 0.1), "{scales:?}");
        // The scale is that of the shapes: its length in pixels over the metres that it says.
        let scale = svg.lines().find(|line| line.contains("class=\"scale\"")).unwrap();
        let metres = svg.lines().rev().find_map(|line| line.strip_suffix(" m</text>")).unwrap();
        let metres: f64 = metres.split('>').next_back().unwrap().parse().unwrap();
        assert!((drawn(scale) / metres - scales[0]).abs() < 0.1);
    }

    #[test]
    fn both_images_of_a_circle_are_drawn() {
        let svg = take(&model::cases::paper()).figure("three equal bars", 60);
        assert!(svg.contains("4 equilibria in the plane (2 circles in space), proved to be all."));
        let labels = ["1", "1'", "2", "2'"];
        assert!(labels.iter().all(|label| svg.contains(&format!("<title>{label}: "))));
        // E1 has one bar in compression, E2 two; each twice, and once in the key.
        assert_eq!(svg.matches("class=\"core\"").count(), 2 * (1 + 2) + 1);
    }

    #[test]
    fn long_lists_are_cut_and_say_so() {
        let census = take(&model::cases::get("five-in-space").unwrap().problem());
        let svg = census.figure("five", 3);
        assert!(svg.contains(&format!("The 3 lowest of {}", census.equilibria.len())));
        assert_eq!(svg.matches("class=\"shape\"").count(), 3);
        let none = census.figure("five", 0);
        assert!(!none.contains("NaN") && !none.contains("inf"));
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(short(-12.345_678_9), "-12.3457");
        assert_eq!(short(0.0), "0");
        assert_eq!(short(123_456.7), "123457");
        assert_eq!(short(1.5e-9), "1.50000e-9");
        for (x, below) in [(0.99, 0.5), (1.0, 1.0), (4.9, 2.0), (7e8, 5e8), (3e-9, 2e-9)] {
            assert!((round_below(x) / below - 1.0).abs() < 1e-15, "{x}");
        }
        assert_eq!((columns(4, 186.0), columns(7, 186.0), columns(1, 5e3)), (4, 4, 1));
    }

    /// Whatever has no size, or none that a number tells, has no scale.
    #[test]
    fn what_has_no_size_has_no_scale() {
        for shapes in [vec![], vec![vec![[2.0, 1.0]]], vec![vec![[-1e308, 0.0], [1e308, 0.0]]]] {
            let Frame { middle, size, scale } = Frame::around(&shapes);
            assert_eq!([middle, size, scale].map(f64::to_bits), [0.0, SIDE, 0.0].map(f64::to_bits));
        }
        let Frame { middle, size, scale } = Frame::around(&[vec![[1.0, 0.0], [2.0, -4.0]]]);
        let expected = [1.5, SIDE / 4.0, SIDE / 4.0];
        assert_eq!([middle, size, scale].map(f64::to_bits), expected.map(f64::to_bits));
    }

    /// One panel of 150 and twice 18 pixels is narrower than 560; the key of bars without force needs
    /// 112 more.
    #[test]
    fn the_key_of_bars_without_force_widens_the_figure() {
        let census = take(&model::cases::get("three-bars-off-centre").unwrap().problem());
        let mut shown: Vec<Position> = census.positions().take(1).collect();
        let width = |shown: &[Position]| {
            let svg = census.figure_of("one", shown, 1);
            let rest = svg.split(" width=\"").nth(1).unwrap();
            rest.split('"').next().unwrap().parse::<f64>().unwrap()
        };
        assert!((width(&shown) - 560.0).abs() < 1e-9, "{}", width(&shown));
        shown[0].equilibrium.signs[1] = 0;
        assert!((width(&shown) - 672.0).abs() < 1e-9, "{}", width(&shown));
    }

    /// Anchors (3, 4) apart, from (1, 2, 3): a joint at (3/2, 4, 1) is `3/5 · 1/2 + 4/5 · 2` along them;
    /// circles, and what begins and ends on one vertical, are seen along Y.
    #[test]
    fn shapes_are_seen_from_the_first_anchor() {
        let census = take(&model::cases::get("three-bars-off-centre").unwrap().problem());
        let mut position = census.positions().next().unwrap();
        let (start, middle) = ([1.0, 2.0, 3.0], [1.5, 4.0, 1.0]);
        for (circle, end, wanted) in [
            (false, [4.0, 6.0, 2.0], [[1.9, -2.0], [5.0, -1.0]]),
            (true, [4.0, 6.0, 2.0], [[2.0, -2.0], [4.0, -1.0]]),
            (false, [1.0, 2.0, 2.0], [[2.0, -2.0], [0.0, -1.0]]),
        ] {
            position.equilibrium.circle = circle;
            position.equilibrium.joints_m =
                [start, middle, end].map(|at| at.map(Interval::point)).to_vec();
            let found = shape(&position);
            assert!(found[0].iter().all(|x| x.abs() <= 0.0));
            for (found, wanted) in found[1..].iter().flatten().zip(wanted.iter().flatten()) {
                assert!((found - wanted).abs() < 1e-15, "{found}, not {wanted}");
            }
        }
    }
}
