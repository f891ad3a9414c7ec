//! Axes: ranges, round ticks, frames.

use crate::svg::{Anchor, Svg, escape};

/// A range of values on a stretch of the picture.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    /// Its ends.
    pub values: [f64; 2],
    /// Where they stand in the picture.
    pub pixels: [f64; 2],
}

/// Ticks on an axis, about.
const TICKS: f64 = 7.0;

impl Axis {
    /// An axis that holds all values with a margin of this part.
    #[must_use]
    pub fn around(values: impl Iterator<Item = f64>, margin: f64, pixels: [f64; 2]) -> Self {
        let (low, high) = values
            .filter(|x| x.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let (low, high) = if low <= high { (low, high) } else { (0.0, 1.0) };
        let size = high - low;
        // Equal values need a range too.
        let size = if size > 1e-9 * high.abs().max(low.abs()) { size } else { high.abs().max(1.0) };
        Self { values: [low - margin * size, high + margin * size], pixels }
    }

    /// Where a value stands in the picture.
    #[must_use]
    pub fn at(&self, value: f64) -> f64 {
        let [low, high] = self.values;
        let [from, to] = self.pixels;
        from + (value - low) / (high - low) * (to - from)
    }

    /// Round values at round distances; the digits they need behind the point.
    #[must_use]
    pub fn ticks(&self, degrees: bool) -> (Vec<f64>, usize) {
        let [low, high] = self.values;
        let rough = (high - low) / TICKS;
        let step = if degrees && rough > 5.0 {
            [10.0, 15.0, 30.0, 45.0, 60.0, 90.0].into_iter().find(|s| *s >= rough).unwrap_or(180.0)
        } else {
            let ten = 10_f64.powf(rough.log10().floor());
            [1.0, 2.0, 5.0].into_iter().map(|s| s * ten).find(|s| *s >= rough).unwrap_or(10.0 * ten)
        };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
        let digits = (-step.log10().floor()).clamp(0.0, 12.0) as usize;
        let first = (low / step).ceil();
        let count = ((high / step).floor() - first).clamp(0.0, 100.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 100")]
        let count = count as u32;
        ((0..=count).map(|k| (first + f64::from(k)) * step).collect(), digits)
    }
}

/// The frame of a panel with ticks, numbers and labels.
pub fn frame(svg: &mut Svg, x: &Axis, y: &Axis, labels: [&str; 2], degrees: [bool; 2]) {
    let [left, right] = x.pixels;
    let [bottom, top] = y.pixels;
    svg.push(format_args!(
        "<rect x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#000\"/>",
        right - left,
        bottom - top
    ));
    let number = |value: f64, digits: usize| format!("{value:.digits$}").replace('-', "\u{2212}");
    let (ticks, digits) = x.ticks(degrees[0]);
    for tick in ticks {
        let at = x.at(tick);
        svg.push(format_args!("<path d=\"M{at:.2} {bottom}v6\" stroke=\"#000\" fill=\"none\"/>"));
        svg.text([at, bottom + 22.0], Anchor::Middle, &number(tick + 0.0, digits));
    }
    let (ticks, digits) = y.ticks(degrees[1]);
    for tick in ticks {
        let at = y.at(tick);
        svg.push(format_args!("<path d=\"M{left} {at:.2}h-6\" stroke=\"#000\" fill=\"none\"/>"));
        svg.text([left - 10.0, at + 5.0], Anchor::End, &number(tick + 0.0, digits));
    }
    svg.text([0.5 * (left + right), bottom + 46.0], Anchor::Middle, labels[0]);
    let middle = 0.5 * (top + bottom);
    let beside = left - 64.0;
    svg.push(format_args!(
        "<text x=\"{beside:.2}\" y=\"{middle:.2}\" text-anchor=\"middle\" \
         transform=\"rotate(-90 {beside:.2} {middle:.2})\">{}</text>",
        escape(labels[1])
    ));
}
