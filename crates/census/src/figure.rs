//! All shapes side by side, as SVG.

use std::fmt::Write;

use crate::{Census, Interval, ProvenEquilibrium};

/// Side of the square in which a shape is drawn, px; room around it, and for its caption.
const SIDE: f64 = 150.0;
const MARGIN: f64 = 16.0;
const CAPTION: f64 = 34.0;
const PANEL: [f64; 2] = [SIDE + 2.0 * MARGIN, SIDE + 2.0 * MARGIN + CAPTION];

/// Room for the title, and for the key below.
const HEAD: f64 = 30.0;
const FOOT: f64 = 30.0;

/// At most so many panels in a row: the figure then fits a page or a screen.
const COLUMNS: usize = 6;

/// Tension: a dark blue, solid; compression: an orange, dashed. In grey they differ in lightness and in
/// the dashes.
const TENSION: &str = "stroke=\"#12436d\" stroke-width=\"3\"";
const COMPRESSION: &str = "stroke=\"#e07b00\" stroke-width=\"4\" stroke-dasharray=\"7 4\"";

impl Census {
    /// The shapes of the first `limit` equilibria in their vertical plane, each with its energy, its
    /// index and its stability: an SVG file that needs no font and no script. All panels have the same
    /// scale.
    ///
    /// ```
    /// use census::{Census, Settings};
    /// let census = Census::take(&model::cases::paper(), &Settings::default())?;
    /// let svg = census.figure("three equal bars", 60);
    /// assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    /// assert_eq!(svg.matches("class=\"bar\"").count(), 6);
    /// # Ok::<(), census::CensusError>(())
    /// ```
    #[must_use]
    pub fn figure(&self, name: &str, limit: usize) -> String {
        let shown = &self.equilibria[..limit.min(self.equilibria.len())];
        let shapes: Vec<Vec<[f64; 2]>> = shown.iter().map(shape).collect();
        let frame = Frame::around(&shapes);
        let columns = shown.len().clamp(1, COLUMNS);
        let rows = shown.len().div_ceil(columns);
        let width = columns as f64 * PANEL[0];
        let height = HEAD + rows as f64 * PANEL[1] + FOOT;
        let mut svg = String::new();
        let title = self.title(name, shown.len());
        // Writing to a string cannot fail.
        let _ = write!(
            svg,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" \
             width=\"{width}\" height=\"{height}\" font-family=\"sans-serif\" font-size=\"11\" \
             role=\"img\">\n<title>{title}</title>\n\
             <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
             <text x=\"{MARGIN}\" y=\"20\" font-size=\"13\">{title}</text>\n"
        );
        for (k, (equilibrium, shape)) in shown.iter().zip(&shapes).enumerate() {
            let [column, row] = [k % columns, k / columns];
            let x = column as f64 * PANEL[0];
            let y = HEAD + row as f64 * PANEL[1];
            let _ = writeln!(svg, "<g transform=\"translate({x} {y})\">");
            panel(&mut svg, &frame, k + 1, equilibrium, shape);
            svg.push_str("</g>\n");
        }
        let y = height - 12.0;
        let _ = write!(
            svg,
            "<g><line x1=\"{MARGIN}\" y1=\"{0}\" x2=\"46\" y2=\"{0}\" {TENSION}/>\
             <text x=\"52\" y=\"{y}\">tension</text>\
             <line x1=\"106\" y1=\"{0}\" x2=\"136\" y2=\"{0}\" {COMPRESSION}/>\
             <text x=\"142\" y=\"{y}\">compression</text></g>\n</svg>\n",
            y - 4.0
        );
        svg
    }

    fn title(&self, name: &str, shown: usize) -> String {
        let all = self.equilibria.len();
        let what = match (self.circles, all) {
            (true, 1) => "circle of equilibria",
            (true, _) => "circles of equilibria",
            (false, 1) => "equilibrium",
            (false, _) => "equilibria",
        };
        let part = if shown < all { format!("the lowest {shown} of ") } else { String::new() };
        let rest = if self.complete { "complete" } else { "not proved complete" };
        format!("{}: {part}{all} {what}, {rest}", escaped(name))
    }
}

/// A name between tags.
fn escaped(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '&' => "&amp;".to_owned(),
            '<' => "&lt;".to_owned(),
            '>' => "&gt;".to_owned(),
            // Control characters have no place in XML.
            c if c.is_control() => " ".to_owned(),
            c => c.to_string(),
        })
        .collect()
}

/// The joints in the plane: along the horizontal from the first to the last anchor (for anchors on one
/// vertical, along Y) and up, from joint 0.
fn shape(equilibrium: &ProvenEquilibrium) -> Vec<[f64; 2]> {
    let joints: Vec<[f64; 3]> =
        equilibrium.joints_m.iter().map(|joint| joint.map(Interval::mid)).collect();
    let (Some(start), Some(end)) = (joints.first(), joints.last()) else { return vec![] };
    let [x, y] = [end[0] - start[0], end[1] - start[1]];
    let distance = x.hypot(y);
    let along = if equilibrium.circle || distance <= 0.0 {
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
struct Frame {
    middle: [f64; 2],
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
        let size = (high[0] - low[0]).max(high[1] - low[1]);
        if !(size.is_finite() && size > 0.0) {
            return Self { middle: [0.0; 2], scale: 1.0 };
        }
        Self { middle: std::array::from_fn(|k| 0.5 * low[k] + 0.5 * high[k]), scale: SIDE / size }
    }

    fn place(&self, point: [f64; 2]) -> [f64; 2] {
        let centre = MARGIN + 0.5 * SIDE;
        [
            centre + self.scale * (point[0] - self.middle[0]),
            centre - self.scale * (point[1] - self.middle[1]),
        ]
    }
}

fn panel(
    svg: &mut String,
    frame: &Frame,
    number: usize,
    equilibrium: &ProvenEquilibrium,
    shape: &[[f64; 2]],
) {
    let points: Vec<[f64; 2]> = shape.iter().map(|point| frame.place(*point)).collect();
    for (ends, sign) in points.windows(2).zip(&equilibrium.signs) {
        let style = if *sign < 0 { COMPRESSION } else { TENSION };
        let _ = writeln!(
            svg,
            "<line class=\"bar\" x1=\"{:.2}\" y1=\"{:.2}\" x2=\"{:.2}\" y2=\"{:.2}\" {style}/>",
            ends[0][0], ends[0][1], ends[1][0], ends[1][1]
        );
    }
    let last = points.len().saturating_sub(1);
    for (k, [x, y]) in points.iter().enumerate() {
        let _ = if k == 0 || k == last {
            // Anchors: a square.
            writeln!(
                svg,
                "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"8\" height=\"8\" fill=\"#333\"/>",
                x - 4.0,
                y - 4.0
            )
        } else {
            writeln!(
                svg,
                "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2.6\" fill=\"white\" stroke=\"#333\"/>"
            )
        };
    }
    let stability = match (equilibrium.optimal, equilibrium.index_in_space()) {
        (true, _) => "lowest of all".to_owned(),
        (false, 0) => "stable".to_owned(),
        (false, index) => format!("unstable, index {index}"),
    };
    let y = SIDE + 2.0 * MARGIN + 10.0;
    let _ = writeln!(
        svg,
        "<text x=\"{MARGIN}\" y=\"{y}\">{number}: {} J</text>\n\
         <text x=\"{MARGIN}\" y=\"{}\">{stability} (in plane {})</text>",
        short(equilibrium.energy_j.mid()),
        y + 14.0,
        equilibrium.index_in_plane
    );
}

/// Six digits, without an exponent where that is short.
fn short(x: f64) -> String {
    if x.abs() < 1e-3 || x.abs() >= 1e6 {
        return format!("{x:.5e}");
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and 5")]
    let decimals = (5.0 - x.abs().log10().floor()).clamp(0.0, 8.0) as usize;
    format!("{x:.decimals$}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Settings;

    fn take(problem: &model::Problem) -> Census {
        Census::take(problem, &Settings::default()).unwrap()
    }

    #[test]
    fn every_bar_is_drawn_at_scale_and_by_its_force() {
        let problem = model::cases::get("three-bars-off-centre").unwrap().problem();
        let census = take(&problem);
        let svg = census.figure("a < b & c", 60);
        assert!(svg.contains("a &lt; b &amp; c: 4 equilibria, complete"));
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        let compressed: usize = census
            .equilibria
            .iter()
            .map(|e| e.signs.iter().filter(|sign| **sign < 0).count())
            .sum();
        // One more dashed line in the key.
        assert_eq!(svg.matches("stroke-dasharray").count(), compressed + 1);
        assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count());
        // Lengths of the drawn bars are in the ratio of the lengths, whatever the equilibrium.
        let number = |line: &str, key: &str| -> f64 {
            let rest = line.split(&format!(" {key}=\"")).nth(1).unwrap();
            rest.split('"').next().unwrap().parse().unwrap()
        };
        let bars = problem.chain().bars();
        let mut scales = vec![];
        for (k, line) in svg.lines().filter(|line| line.contains("class=\"bar\"")).enumerate() {
            let dx = number(line, "x2") - number(line, "x1");
            let dy = number(line, "y2") - number(line, "y1");
            scales.push(dx.hypot(dy) / bars[k % bars.len()].length_m());
        }
        assert_eq!(scales.len(), 12);
        // Coordinates are written to a hundredth of a pixel.
        assert!(scales.iter().all(|scale| (scale - scales[0]).abs() < 0.1), "{scales:?}");
    }

    #[test]
    fn long_lists_are_cut_and_say_so() {
        let census = take(&model::cases::get("five-in-space").unwrap().problem());
        let svg = census.figure("five", 3);
        assert!(svg.contains(&format!("the lowest 3 of {}", census.equilibria.len())));
        assert_eq!(svg.matches("class=\"bar\"").count(), 15);
        assert_eq!(short(-12.345_678_9), "-12.3457");
        assert_eq!(short(0.0), "0.00000e0");
        assert_eq!(short(123_456.7), "123457");
    }
}
