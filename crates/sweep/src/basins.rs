//! Basins of attraction on a grid of two angles, or of two coordinates.

use figures::{
    Anchor, Axes, Axis, Colour, FAILURE, Look, MOST_REGIONS, OTHER, Raster, Svg, Unit, ramp,
    regions,
};

use crate::record::{Failure, Outcomes};

/// What became of the seeds of a regular grid over two numbers, the first varying fastest: each seed
/// stands for the square around it.
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
    /// Where each axis begins and ends.
    pub ranges: [[f64; 2]; 2],
    /// What they count in.
    pub unit: Unit,
}

/// Why there is no picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum BasinsError {
    /// Occurs when the columns do not hold a square of seeds.
    #[error("a picture of {size} x {size} seeds needs {} outcomes, got {outcomes}", u64::from(*size).pow(2))]
    Shape { size: u32, outcomes: usize },
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
const WIDTH: f64 = 1040.0;
const HEIGHT: f64 = 760.0;

/// Most entries of a legend with two lines for each; more of them have one.
const ROOMY: usize = 15;
/// Width of a column of such a legend, and the height of its lines.
const COLUMN: f64 = 400.0;
const LINE: f64 = 22.0;
/// Such lines beside the picture.
const LINES: usize = 29;
/// Most columns of a legend; beyond, it grows downwards.
const COLUMNS: usize = 3;

/// Colours with their names and the numbers of starts.
#[derive(Default)]
struct Legend(Vec<(Colour, String, usize)>);

impl Legend {
    /// Columns and lines in each.
    fn shape(&self) -> (usize, usize) {
        let entries = self.0.len();
        if entries <= ROOMY {
            return (1, entries);
        }
        let columns = entries.div_ceil(LINES).min(COLUMNS);
        (columns, entries.div_ceil(columns))
    }

    /// Width and height of a picture that has room for it.
    fn size(&self) -> [f64; 2] {
        let (columns, lines) = self.shape();
        if self.0.len() <= ROOMY {
            return [WIDTH, HEIGHT];
        }
        let width = LEFT + SIDE + 24.0 + COLUMN * columns as f64;
        [width, HEIGHT.max(TOP + LINE * (lines + 1) as f64)]
    }

    fn draw(&self, svg: &mut Svg, all: usize) {
        let (_, lines) = self.shape();
        let roomy = self.0.len() <= ROOMY;
        for (k, (colour, name, count)) in self.0.iter().enumerate() {
            let percent = 100.0 * *count as f64 / all as f64;
            let (left, line) = (LEFT + SIDE + 24.0, if roomy { 44.0 } else { LINE });
            let (column, row) = ((k / lines) as f64, (k % lines) as f64);
            let at = [left + COLUMN * column, TOP + 12.0 + line * row];
            let swatch = Look::stroke(Colour::BLACK, 1.0).filled(*colour).class("swatch");
            svg.rectangle(swatch, [at[0], at[1] - 9.0], [18.0; 2]);
            svg.text(Look::PLAIN, [at[0] + 28.0, at[1] + 4.0], Anchor::Start, name);
            let small = Look::fill(Colour::grey(0x55)).size(12.0);
            if roomy {
                let percent = format!("{percent:.2} % of the starts");
                svg.text(small, [at[0] + 28.0, at[1] + 20.0], Anchor::Start, &percent);
            } else {
                let end = [at[0] + COLUMN - 30.0, at[1] + 4.0];
                svg.text(small, end, Anchor::End, &format!("{percent:.2} %"));
            }
        }
    }
}

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
        let coloured = (field == Field::Outcome).then(|| self.regions());
        let legend = coloured.as_ref().map(|(pixels, palette)| self.legend(pixels, palette));
        let legend = legend.unwrap_or_default();
        let [width, height] = legend.size();
        let mut svg = Svg::new([width, height], self.title);
        svg.text(Look::PLAIN.size(17.0).bold(), [LEFT, 34.0], Anchor::Start, self.title);
        svg.text(Look::PLAIN, [LEFT, 58.0], Anchor::Start, self.note);
        let (pixels, palette) = if let Some(coloured) = coloured {
            legend.draw(&mut svg, outcomes);
            coloured
        } else {
            self.shades(&mut svg)
        };
        // The first row of a PNG is the top one, the largest second number.
        let rows: Vec<u8> = pixels.chunks(side).rev().flatten().copied().collect();
        let (width, height) = (self.size, self.size);
        let raster = Raster { width, height, pixels: &rows, palette: &palette };
        svg.raster([LEFT, TOP], [SIDE; 2], &raster);
        let x = Axis { values: self.ranges[0], pixels: [LEFT, LEFT + SIDE] };
        let y = Axis { values: self.ranges[1], pixels: [TOP + SIDE, TOP] };
        Axes { x, y, names: self.labels }.frame(&mut svg, [self.unit; 2]);
        Ok(svg.finish())
    }

    /// One colour per equilibrium, white for others, black for failures.
    fn regions(&self) -> (Vec<u8>, Vec<Colour>) {
        let mut palette = regions(self.names.len());
        let colours = palette.len();
        palette.extend([OTHER, FAILURE]);
        let index = |outcome: i16| match usize::try_from(outcome) {
            Ok(k) => k.min(colours),
            Err(_) if outcome == Failure::Unlisted as i16 => colours,
            Err(_) => colours + 1,
        };
        // The palette has at most 256 colours.
        let pixel = |o: &i16| u8::try_from(index(*o)).unwrap_or(u8::MAX);
        (self.outcomes.outcome.iter().map(pixel).collect(), palette)
    }

    /// What is in the picture, and failures.
    fn legend(&self, pixels: &[u8], palette: &[Colour]) -> Legend {
        let other = if self.names.len() > MOST_REGIONS {
            format!("from {MOST_REGIONS} on, or in no list")
        } else {
            "an equilibrium in no list".to_owned()
        };
        let own = self.names.iter().take(palette.len() - 2).cloned();
        let names = own.chain([other, "no equilibrium reached".to_owned()]);
        let mut counts = vec![0; palette.len()];
        for pixel in pixels {
            counts[usize::from(*pixel)] += 1;
        }
        let all = palette.iter().zip(names).zip(counts);
        let all = all.map(|((colour, name), count)| (*colour, name, count));
        Legend(all.filter(|(colour, _, count)| *count > 0 || *colour == FAILURE).collect())
    }

    /// Light for few iterations, dark for many, black for failures; with the scale, which ends at
    /// the 99th percentile so that a few slow starts do not hide the rest.
    fn shades(&self, svg: &mut Svg) -> (Vec<u8>, Vec<Colour>) {
        let Outcomes { outcome, iterations, .. } = self.outcomes;
        let reached = || iterations.iter().zip(outcome).filter(|(_, o)| **o >= 0).map(|(i, _)| *i);
        let mut sorted: Vec<u16> = reached().collect();
        sorted.sort_unstable();
        let least = sorted.first().copied().unwrap_or(0);
        let most = sorted.get(sorted.len() * 99 / 100).copied().unwrap_or(1).max(least + 1);
        let range = f64::from(most - least);
        let mut palette: Vec<Colour> =
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
        svg.text(Look::PLAIN, [left, TOP + 10.0], Anchor::Start, "iterations");
        let step = height / SHADES as f64;
        for (k, colour) in palette[..SHADES].iter().enumerate() {
            let top = TOP + 28.0 + height - (k + 1) as f64 * step;
            // Neighbours overlap, so that no white line is left between them.
            svg.rectangle(Look::fill(*colour), [left, top], [20.0, step + 0.5]);
        }
        let scale = Axis {
            values: [f64::from(least), f64::from(most)],
            pixels: [TOP + 28.0 + height, TOP + 28.0],
        };
        let ticks = scale.ticks(Unit::Decimal).0;
        for tick in ticks.into_iter().filter(|tick| (tick - tick.round()).abs() < 1e-9) {
            let at = scale.at(tick);
            let line = Look::stroke(Colour::BLACK, 1.0);
            svg.line(line, [left + 20.0, at], [left + 26.0, at]);
            let more = if tick >= f64::from(most) { " or more" } else { "" };
            let text = format!("{tick:.0}{more}");
            svg.text(Look::PLAIN, [left + 32.0, at + 5.0], Anchor::Start, &text);
        }
        if sorted.len() < outcome.len() {
            let top = TOP + 28.0 + height + 24.0;
            svg.rectangle(Look::fill(FAILURE), [left, top], [20.0, 18.0]);
            let at = [left + 32.0, top + 14.0];
            svg.text(Look::PLAIN, at, Anchor::Start, "no equilibrium reached");
        }
        (pixels, palette)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(members: usize) -> String {
        let names: Vec<_> = (0..members).map(|k| format!("{k}: 1.5 J, no minimum")).collect();
        let outcome: Vec<i16> =
            (0..400).map(|k| i16::try_from(k % (members + 1)).unwrap() - 1).collect();
        let outcomes = Outcomes { iterations: vec![3; 400], outcome, ..Outcomes::default() };
        let basins = Basins {
            size: 20,
            outcomes: &outcomes,
            names: &names,
            title: "t",
            note: "n",
            labels: ["a", "b"],
            ranges: [[0.0, 360.0]; 2],
            unit: Unit::Degrees,
        };
        basins.svg(Field::Outcome).unwrap()
    }

    #[test]
    fn every_equilibrium_has_its_colour_and_all_of_the_legend_is_in_the_picture() {
        for members in [2, 14, 15, 20, 40, 120, 254, 300] {
            let svg = picture(members);
            let number = |text: &str, name: &str| -> f64 {
                let value = text.split(&format!("{name}=\"")).nth(1).unwrap();
                value.split('"').next().unwrap().parse().unwrap()
            };
            let boxes: Vec<_> =
                svg.lines().filter(|line| line.contains("class=\"swatch\"")).collect();
            let fill = |line: &str| line.split("fill=\"").nth(1).unwrap()[..7].to_owned();
            let colours: std::collections::BTreeSet<_> =
                boxes.iter().map(|line| fill(line)).collect();
            // And failures; beyond the palette the others are one.
            let wanted = members.min(MOST_REGIONS) + 1 + usize::from(members > MOST_REGIONS);
            assert_eq!((boxes.len(), colours.len()), (wanted, wanted), "{members}");
            assert!(
                boxes.last().unwrap().contains("#000000") && svg.contains("no equilibrium reached")
            );
            let (width, height) = (number(&svg, "width"), number(&svg, "height"));
            for line in boxes {
                let room = if members < ROOMY { 250.0 } else { COLUMN - 30.0 };
                assert!(number(line, " x") + room <= width, "{members}: {line}");
                assert!(number(line, " y") + 20.0 <= height, "{members}: {line}");
            }
        }
    }
}
