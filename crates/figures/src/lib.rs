//! Pictures: one writer of SVG, PNG, PDF and DXF, one palette, one set of axes, and the drawing of a
//! structure.
//!
//! ```
//! use figures::{Anchor, Axes, Axis, BLUE, Look, Svg, Unit};
//! let x = Axis { values: [0.0, 2.0], pixels: [80.0, 380.0] };
//! let y = Axis { values: [0.0, 4.0], pixels: [220.0, 20.0] };
//! let axes = Axes { x, y, names: ["x / m", "x² / m²"] };
//! let mut svg = Svg::new([400.0, 280.0], "A parabola");
//! let parabola = (0..=20).map(|k| f64::from(k) / 10.0);
//! svg.polyline(Look::stroke(BLUE, 2.0), parabola.map(|x| axes.at([x, x * x])));
//! axes.frame(&mut svg, [Unit::Decimal; 2]);
//! // Half way to the right, a quarter of the way up.
//! assert_eq!(axes.at([1.0, 1.0]), [230.0, 170.0]);
//! svg.text(Look::PLAIN, axes.at([1.0, 1.0]), Anchor::Start, "(1, 1)");
//! assert!(svg.finish().starts_with("<svg xmlns="));
//! ```
//!
//! No text of a caller reaches a picture but through [`Escaped`].
//!
//! Colours are those of M. Okabe and K. Ito (Color Universal Design, 2008), told apart by the
//! colour-blind; lines differ in width and dashes and marks in shape too, so that nothing is lost
//! in grey.

mod axis;
mod escape;
mod file;
mod look;
mod palette;
mod png;
mod structure;
mod svg;

pub use axis::{Axes, Axis, Unit};
pub use escape::Escaped;
pub use file::{Format, FormatError};
pub use look::{Colour, Look};
pub use palette::{
    BLUE, FAILURE, GREEN, MOST_REGIONS, ORANGE, OTHER, PURPLE, SKY_BLUE, VERMILION, YELLOW, ramp,
    regions,
};
pub use png::Raster;
pub use structure::{
    Joint, Member, ModeShape, ModeShapes, Seen, Structure, StructureError, Support, SystemShape,
};
pub use svg::{Anchor, Svg};
