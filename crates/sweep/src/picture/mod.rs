//! Pictures: the bifurcation diagram of a trace, and basins of attraction on a grid.
//!
//! Colours are those of M. Okabe and K. Ito (Color Universal Design, 2008), told apart by the colour-blind;
//! lines differ in width and dashes and marks in shape too, so that nothing is lost in grey.

mod axis;
mod basins;
mod diagram;
mod palette;
mod png;
mod svg;

pub use basins::{Basins, BasinsError, Field};
pub use diagram::{Abscissa, diagram};
