//! What is proved with these numbers stands on them: enclosures hold the exact results.

mod interval;
mod relations;
mod sums;
