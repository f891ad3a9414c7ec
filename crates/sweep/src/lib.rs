//! Many seeds and many parameters in parallel: which start leads where.

mod compute;
mod description;
mod error;
mod identify;
mod manifest;
mod merge;
mod picture;
mod product;
mod record;
mod seeds;
mod settings;
mod shard;
mod sobol;
mod source;
mod store;
mod store_digests;
mod store_error;
mod store_footer;
mod store_lock;
mod store_part;
mod store_tally;
mod summary;
mod sweep;
mod trace;
mod vary;

pub use compute::Compute;
pub use description::SCHEMA_VERSION;
pub use error::SweepError;
pub use identify::{JOINT_TOLERANCE, Member, Members, Origin};
pub use manifest::{Manifest, SystemText};
pub use merge::merge;
pub use picture::{Abscissa, Basins, BasinsError, Field, diagram};
pub use product::{Combine, Study};
pub use record::{Chunk, Failure, Outcomes};
pub use seeds::Stream;
pub use settings::{Settings, Solvers};
pub use shard::{Shard, ShardError, part_seeds};
pub use source::{Axis, Source};
pub use store::{Run, RunSettings, StoreSummary, run};
pub use store_error::StoreError;
pub use store_part::{PartRecord, schema};
pub use store_tally::{OutcomeTally, SolverTally, Tally, rate_interval};
pub use summary::{Comparison, Disagreement, KEPT, Summary};
pub use sweep::Sweep;
pub use trace::{
    Branch, BranchEnd, BranchPoint, Checks, Event, EventKind, PointStatus, Trace, TraceError,
    TracePoint, TraceProgress, TraceSettings, trace,
};
pub use vary::{AnchorEnd, BarField, MAX_POINTS, Number, PointError, Vary, VaryError, Which};
