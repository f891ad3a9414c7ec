//! Axes of a plot.

use crate::svg::{Anchor, Svg};

/// Room for the labels: left, right, above, below, px.
const MARGIN: [f64; 4] = [58.0, 14.0, 30.0, 48.0];

/// A frame from data to px.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axes {
    size: [f64; 2],
    x: [f64; 2],
    y: [f64; 2],
}

impl Axes {
    /// The ranges of x and y in a picture of this size.
    pub(super) fn new(size: [f64; 2], x: [f64; 2], y: [f64; 2]) -> Self {
        Self { size, x, y }
    }

    /// Where a point of the data lies in the picture.
    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let [left, right, above, below] = MARGIN;
        let width = self.size[0] - left - right;
        let height = self.size[1] - above - below;
        [
            left + width * (x - self.x[0]) / (self.x[1] - self.x[0]),
            above + height * (self.y[1] - y) / (self.y[1] - self.y[0]),
        ]
    }

    /// Frame, ticks with their texts, and what is plotted.
    pub(super) fn draw(
        &self,
        svg: &mut Svg,
        [x_ticks, y_ticks]: [&[(f64, String)]; 2],
        [x_name, y_name]: [&str; 2],
    ) {
        /// Length of a tick, px, and how far its text stands off.
        const TICK: f64 = 5.0;
        for (x, text) in x_ticks {
            let foot = self.at([*x, self.y[0]]);
            svg.line("grid", foot, self.at([*x, self.y[1]]));
            svg.line("axis", foot, [foot[0], foot[1] + TICK]);
            svg.text("tick", [foot[0], foot[1] + 18.0], Anchor::Middle, text);
        }
        for (y, text) in y_ticks {
            let foot = self.at([self.x[0], *y]);
            svg.line("grid", foot, self.at([self.x[1], *y]));
            svg.line("axis", foot, [foot[0] - TICK, foot[1]]);
            svg.text("tick", [foot[0] - 8.0, foot[1] + 4.0], Anchor::End, text);
        }
        let corner = self.at([self.x[0], self.y[0]]);
        svg.line("axis", corner, self.at([self.x[1], self.y[0]]));
        svg.line("axis", corner, self.at([self.x[0], self.y[1]]));
        let middle = self.at([f64::midpoint(self.x[0], self.x[1]), self.y[0]]);
        svg.text("label", [middle[0], self.size[1] - 8.0], Anchor::Middle, x_name);
        let top = self.at([self.x[0], self.y[1]]);
        svg.text("label", [top[0] - 40.0, top[1] - 12.0], Anchor::Start, y_name);
    }
}
