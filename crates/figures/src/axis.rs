//! Axes: ranges, round ticks, frames.

use model::number::decimals;

use crate::look::{Colour, Look};
use crate::svg::{Anchor, Svg};

/// A range of values on a stretch of the picture.
///
/// ```
/// use figures::Axis;
/// // 0 to 2 on 300 pixels.
/// let axis = Axis { values: [0.0, 2.0], pixels: [80.0, 380.0] };
/// assert_eq!(axis.at(0.5), 155.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Its ends.
    pub values: [f64; 2],
    /// Where they stand in the picture, px.
    pub pixels: [f64; 2],
}

/// Ticks on an axis, about.
const TICKS: f64 = 7.0;

/// Equal values, to this part of their size, need a range too.
const EQUAL: f64 = 1e-9;

impl Axis {
    /// An axis that holds all values with a margin of this part.
    pub fn around(values: impl Iterator<Item = f64>, margin: f64, pixels: [f64; 2]) -> Self {
        let (low, high) = values
            .filter(|x| x.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let size = high - low;
        let size =
            if size > EQUAL * high.abs().max(low.abs()) { size } else { high.abs().max(1.0) };
        Self { values: [low - margin * size, high + margin * size], pixels }
    }

    /// Where a value stands in the picture.
    pub fn at(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        let [from, to] = self.pixels;
        from + (to - from) * (value - low) / (high - low)
    }

    /// Round values at round distances; the digits they need behind the point.
    pub fn ticks(&self, unit: Unit) -> (Vec<f64>, usize) {
        let [low, high] = self.values;
        let rough = (high - low) / TICKS;
        let step = if unit == Unit::Degrees && rough > 5.0 {
            [10.0, 15.0, 30.0, 45.0, 60.0, 90.0].into_iter().find(|s| *s >= rough).unwrap_or(180.0)
        } else {
            let ten = 10_f64.powf(rough.log10().floor());
            [1.0, 2.0, 5.0].into_iter().map(|s| s * ten).find(|s| *s >= rough).unwrap_or(10.0 * ten)
        };
        let digits = decimals(step, 1, 12);
        let first = (low / step).ceil();
        let count = ((high / step).floor() - first).clamp(0.0, 100.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 100")]
        let count = count as u32;
        ((0..=count).map(|k| (first + f64::from(k)) * step).collect(), digits)
    }
}

/// What an axis counts in: what its round numbers are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    /// Powers of ten and their halves and fifths.
    Decimal,
    /// Parts of a full turn.
    Degrees,
}

/// Room for the texts of a panel: left, right, above, below, px.
const MARGIN: [f64; 4] = [58.0, 14.0, 30.0, 48.0];

/// Length of a tick and what its number stands off, px.
const TICK: f64 = 6.0;

/// Width of a digit of the numbers, px.
const DIGIT: f64 = 8.0;

/// Two axes with what they are called.
#[derive(Debug, Clone, Copy)]
pub struct Axes<'a> {
    /// From left to right.
    pub x: Axis,
    /// From the bottom up.
    pub y: Axis,
    /// Names with units; an empty one is not drawn.
    pub names: [&'a str; 2],
}

impl<'a> Axes<'a> {
    /// The axes of a panel of this size in a page, with room for their texts, over these ranges.
    pub fn panel([width, height]: [f64; 2], x: [f64; 2], y: [f64; 2], names: [&'a str; 2]) -> Self {
        let [left, right, above, below] = MARGIN;
        let x = Axis { values: x, pixels: [left, width - right] };
        let y = Axis { values: y, pixels: [height - below, above] };
        Self { x, y, names }
    }

    /// Where a point of the data lies in the picture.
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.x.at(x), self.y.at(y)]
    }

    /// In a file of its own: a frame with round ticks, numbers and names.
    pub fn frame(&self, svg: &mut Svg, units: [Unit; 2]) {
        let line = Look::stroke(Colour::BLACK, 1.0);
        let [left, right] = self.x.pixels;
        let [bottom, top] = self.y.pixels;
        svg.rectangle(line, [left, top], [right - left, bottom - top]);
        let number =
            |value: f64, digits: usize| format!("{value:.digits$}").replace('-', "\u{2212}");
        let (ticks, digits) = self.x.ticks(units[0]);
        for tick in ticks {
            let at = self.x.at(tick);
            svg.line(line, [at, bottom], [at, bottom + TICK]);
            // Zero has no sign.
            let number = number(tick + 0.0, digits);
            svg.text(Look::PLAIN, [at, bottom + 22.0], Anchor::Middle, &number);
        }
        let (ticks, digits) = self.y.ticks(units[1]);
        let mut longest = 0;
        for tick in ticks {
            let at = self.y.at(tick);
            svg.line(line, [left - TICK, at], [left, at]);
            let number = number(tick + 0.0, digits);
            longest = longest.max(number.chars().count());
            svg.text(Look::PLAIN, [left - 10.0, at + 5.0], Anchor::End, &number);
        }
        // Clear of the longest number.
        let beside = (10.0 + DIGIT * longest as f64 + 12.0).max(64.0);
        let [x_name, y_name] = self.names;
        if !x_name.is_empty() {
            let below = [f64::midpoint(left, right), bottom + 46.0];
            svg.text(Look::PLAIN, below, Anchor::Middle, x_name);
        }
        if !y_name.is_empty() {
            svg.text_upwards(Look::PLAIN, [left - beside, f64::midpoint(top, bottom)], y_name);
        }
    }

    /// In a page: a grid of these ticks with their texts, in the classes `grid`, `axis`, `tick` and
    /// `label`.
    pub fn grid(&self, svg: &mut Svg, [x_ticks, y_ticks]: [&[(f64, String)]; 2]) {
        /// Length of a tick, px.
        const TICK: f64 = 5.0;
        let [left, right] = self.x.pixels;
        let [bottom, top] = self.y.pixels;
        for (x, text) in x_ticks {
            let at = self.x.at(*x);
            svg.line("grid", [at, bottom], [at, top]);
            svg.line("axis", [at, bottom], [at, bottom + TICK]);
            svg.indexed("tick", [at, bottom + 18.0], Anchor::Middle, text);
        }
        for (y, text) in y_ticks {
            let at = self.y.at(*y);
            svg.line("grid", [left, at], [right, at]);
            svg.line("axis", [left - TICK, at], [left, at]);
            svg.indexed("tick", [left - 8.0, at + 4.0], Anchor::End, text);
        }
        svg.line("axis", [left, bottom], [right, bottom]);
        svg.line("axis", [left, bottom], [left, top]);
        let [x_name, y_name] = self.names;
        let below = [f64::midpoint(left, right), bottom + 40.0];
        svg.indexed("label", below, Anchor::Middle, x_name);
        svg.indexed("label", [left - 40.0, top - 12.0], Anchor::Start, y_name);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_name_of_an_axis_is_clear_of_long_numbers() {
        let y = Axis { values: [-4.3e5, -1.2e5], pixels: [220.0, 20.0] };
        let x = Axis { values: [0.0, 1.0], pixels: [100.0, 380.0] };
        let mut svg = Svg::new([400.0, 280.0], "");
        Axes { x, y, names: ["", "energy / J"] }.frame(&mut svg, [Unit::Decimal; 2]);
        let text = svg.finish();
        assert!(text.contains(">\u{2212}400000</text>"));
        let name = text.lines().find(|line| line.contains("energy / J")).unwrap();
        let at: f64 =
            name.split(" x=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
        // The numbers end 10 px beside the axis, and have 7 letters of 8 px; half of a name's height is 7.
        assert!(at + 7.0 <= 100.0 - 10.0 - 7.0 * 7.8 && at > 7.0, "{at}");
    }

    #[test]
    fn ticks_are_round_and_within() {
        let axis = |low, high| Axis { values: [low, high], pixels: [0.0, 100.0] };
        let (ticks, digits) = axis(-0.13, 0.71).ticks(Unit::Decimal);
        assert_eq!(digits, 1);
        assert_eq!(ticks.len(), 4);
        let (ticks, _) = axis(0.0, 360.0).ticks(Unit::Degrees);
        assert!(ticks.iter().zip([0.0, 60.0, 120.0, 180.0]).all(|(a, b)| (a - b).abs() < 1e-12));
        let same = Axis::around([3.0, 3.0, f64::NAN].into_iter(), 0.1, [0.0, 1.0]);
        assert!(same.values[0] < 3.0 && 3.0 < same.values[1]);
    }
}
