//! Many seeds and many parameters in parallel: which start leads where.

mod product;
mod record;
mod trace;
mod vary;

pub use product::{Combine, Study};
pub use record::{Chunk, Failure, Outcomes};
pub use trace::{
    Branch, BranchEnd, BranchPoint, Checks, Event, EventKind, PointStatus, Trace, TraceError,
    TracePoint, TraceProgress, TraceSettings, trace,
};
pub use vary::{AnchorEnd, BarField, MAX_POINTS, Number, PointError, Vary, VaryError, Which};
