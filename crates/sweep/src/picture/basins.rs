//! Basins of attraction on a grid of two angles.

use super::axis::{Axis, frame};
use super::palette::{FAILURE, REGIONS, hex, ramp};
use super::png::{base64, png};
use super::svg::{Anchor, Svg};
use crate::record::Outcomes;

/// What became of the seeds of a regular grid over two angles, from 0° to 360° each, the first varying
/// fastest: each seed stands for the square around it.
#[derive(Debug, Clone, Copy)]
pub struct Basins<'a> {
    /// Seeds along each side.
    pub size: u32,
    /// What one solver made of them.
    pub outcomes: &'a Outcomes,
    /// What the equilibria are called, by their numbers.
    pub names: &'a [String],
    /// Title of the picture.
    pub title: &'a str,
    /// A line under it: which solver, what the other angles are.
    pub note: &'a str,
    /// Labels of the two axes.
    pub labels: [&'a str; 2],
}

/// Why there is no picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum BasinsError {
    /// Occurs when the columns do not hold a square of seeds.
    #[error("a picture of {size} x {size} seeds needs {} outcomes, got {outcomes}", u64::from(*size).pow(2))]
    Shape {
        /// Seeds along each side.
        size: u32,
        /// Entries in the shortest column.
        outcomes: usize,
    },
}

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Field {
    /// The equilibrium reached.
    Outcome,
    /// The iterations spent.
    Iterations,
}

const LEFT: f64 = 100.0;
const TOP: f64 = 80.0;
const SIDE: f64 = 600.0;
const WIDTH: f64 = 1010.0;
const HEIGHT: f64 = 760.0;
/// Colours of the ramp of iterations; the next index of the palette is that of failures.
const SHADES: usize = 64;

impl Basins<'_> {
    /// The picture as SVG, its raster an embedded PNG.
    ///
    /// # Errors
    ///
    /// [`BasinsError`] when the outcomes are not a square of the size.
    pub fn svg(&self, field: Field) -> Result<String, BasinsError> {
        let Outcomes { outcome, iterations, .. } = self.outcomes;
        let side = self.size as usize;
        let outcomes = outcome.len().min(iterations.len());
        if side == 0 || side.checked_mul(side) != Some(outcomes) || outcome.len() != outcomes {
            return Err(BasinsError::Shape { size: self.size, outcomes });
        }
        let mut svg = Svg::new(WIDTH, HEIGHT, self.title);
        svg.push("<g font-size=\"17\" font-weight=\"bold\">");
        svg.text([LEFT, 34.0], Anchor::Start, self.title);
        svg.push("</g>");
        svg.text([LEFT, 58.0], Anchor::Start, self.note);
        let (pixels, palette) = match field {
            Field::Outcome => self.regions(&mut svg),
            Field::Iterations => self.shades(&mut svg),
        };
        // The first row of a PNG is the top one, the largest second angle.
        let rows: Vec<u8> = pixels.chunks(side).rev().flatten().copied().collect();
        let image = base64(&png(self.size, self.size, &rows, &palette));
        svg.push(format_args!(
            "<image x=\"{LEFT}\" y=\"{TOP}\" width=\"{SIDE}\" height=\"{SIDE}\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{image}\"/>"
        ));
        let x = Axis { values: [0.0, 360.0], pixels: [LEFT, LEFT + SIDE] };
        let y = Axis { values: [0.0, 360.0], pixels: [TOP + SIDE, TOP] };
        frame(&mut svg, &x, &y, self.labels, [true, true]);
        Ok(svg.finish())
    }

    /// One colour per equilibrium, black for failures; with the legend.
    fn regions(&self, svg: &mut Svg) -> (Vec<u8>, Vec<[u8; 3]>) {
        let colours = REGIONS.len();
        let mut palette = REGIONS.to_vec();
        palette.push(FAILURE);
        let index = |outcome: i16| usize::try_from(outcome).map_or(colours, |k| k % colours);
        let outcome = &self.outcomes.outcome;
        // The palette has far fewer than 256 colours.
        let pixels = outcome.iter().map(|o| u8::try_from(index(*o)).unwrap_or(u8::MAX)).collect();
        let mut entries: Vec<(usize, &str, usize)> = vec![];
        for (k, name) in self.names.iter().enumerate() {
            let count = outcome.iter().filter(|o| usize::try_from(**o) == Ok(k)).count();
            if count > 0 {
                entries.push((k % colours, name, count));
            }
        }
        let failed = outcome.iter().filter(|o| **o < 0).count();
        entries.push((colours, "no equilibrium reached", failed));
        for (row, (colour, name, count)) in entries.iter().enumerate() {
            let at = [LEFT + SIDE + 24.0, TOP + 12.0 + 44.0 * row as f64];
            let fill = hex(palette[*colour]);
            svg.push(format_args!(
                "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"18\" height=\"18\" fill=\"{fill}\" stroke=\"#000\"/>",
                at[0],
                at[1] - 9.0
            ));
            svg.text([at[0] + 28.0, at[1] + 4.0], Anchor::Start, name);
            let share = 100.0 * *count as f64 / outcome.len() as f64;
            let share = format!("{share:.2} % of the starts");
            svg.push("<g fill=\"#555\" font-size=\"12\">");
            svg.text([at[0] + 28.0, at[1] + 20.0], Anchor::Start, &share);
            svg.push("</g>");
        }
        (pixels, palette)
    }

    /// Light for few iterations, dark for many, black for failures; with the scale, which ends at the
    /// 99th percentile so that a few slow starts do not hide the rest.
    fn shades(&self, svg: &mut Svg) -> (Vec<u8>, Vec<[u8; 3]>) {
        let Outcomes { outcome, iterations, .. } = self.outcomes;
        let reached = || iterations.iter().zip(outcome).filter(|(_, o)| **o >= 0).map(|(i, _)| *i);
        let mut sorted: Vec<u16> = reached().collect();
        sorted.sort_unstable();
        let least = sorted.first().copied().unwrap_or(0);
        let most = sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(1).max(least + 1);
        let range = f64::from(most - least);
        let mut palette: Vec<[u8; 3]> =
            (0..SHADES).map(|k| ramp(k as f64 / (SHADES - 1) as f64)).collect();
        palette.push(FAILURE);
        let pixel = |(iterations, outcome): (&u16, &i16)| {
            if *outcome < 0 {
                return u8::try_from(SHADES).unwrap_or(u8::MAX);
            }
            let part = f64::from(iterations.saturating_sub(least)) / range;
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 63")]
            let shade = (part.min(1.0) * (SHADES - 1) as f64).round() as u8;
            shade
        };
        let pixels = iterations.iter().zip(outcome).map(pixel).collect();
        let left = LEFT + SIDE + 24.0;
        let height = 300.0;
        svg.text([left, TOP + 10.0], Anchor::Start, "iterations");
        let step = height / SHADES as f64;
        for (k, colour) in palette[..SHADES].iter().enumerate() {
            let top = TOP + 28.0 + height - (k + 1) as f64 * step;
            svg.push(format_args!(
                "<rect x=\"{left}\" y=\"{top:.2}\" width=\"20\" height=\"{:.2}\" fill=\"{}\"/>",
                step + 0.5,
                hex(*colour)
            ));
        }
        let scale = Axis {
            values: [f64::from(least), f64::from(most)],
            pixels: [TOP + 28.0 + height, TOP + 28.0],
        };
        let whole = scale.ticks(false).0.into_iter().filter(|t| (t - t.round()).abs() < 1e-9);
        for tick in whole {
            let at = scale.at(tick);
            svg.push(format_args!("<path d=\"M{} {at:.2}h6\" stroke=\"#000\"/>", left + 20.0));
            let more = if tick >= f64::from(most) { " or more" } else { "" };
            svg.text([left + 32.0, at + 5.0], Anchor::Start, &format!("{tick:.0}{more}"));
        }
        if sorted.len() < outcome.len() {
            let top = TOP + 28.0 + height + 24.0;
            svg.push(format_args!(
                "<rect x=\"{left}\" y=\"{top}\" width=\"20\" height=\"18\" fill=\"#000\"/>"
            ));
            svg.text([left + 32.0, top + 14.0], Anchor::Start, "no equilibrium reached");
        }
        (pixels, palette)
    }
}
