//! From where pictures are seen.

use clap::ValueEnum;
use funicular::picture::Seen;

/// From where a picture is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum View {
    /// A planar system at right angles to its plane, others from above and from their wider side
    Best,
    /// X to the right, Z up
    Front,
    /// Y to the right, Z up
    Side,
    /// X to the right, Y up
    Top,
}

impl From<View> for Seen {
    fn from(view: View) -> Self {
        match view {
            View::Best => Self::Best,
            View::Front => Self::Front,
            View::Side => Self::Side,
            View::Top => Self::Top,
        }
    }
}
