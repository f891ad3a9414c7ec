//! Pictures: one writer of SVG and PNG, one palette, one set of axes.
//!
//! Colours are those of M. Okabe and K. Ito (Color Universal Design, 2008), told apart by the colour-blind;
//! lines differ in width and dashes and marks in shape too, so that nothing is lost in grey.

mod axis;
mod palette;
mod png;
mod svg;

pub use axis::{Axis, frame};
pub use palette::{FAILURE, MOST_REGIONS, OTHER, hex, ramp, regions};
pub use png::{base64, png};
pub use svg::{Anchor, Svg, escape};
