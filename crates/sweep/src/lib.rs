//! Many seeds and many parameters in parallel: which start leads where.

mod record;

pub use record::{Chunk, Failure, Outcomes};
