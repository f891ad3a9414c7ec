//! Many starts in parallel: which start leads where.
//!
//! ```
//! // None of 1000 random starts led to a position: fewer than 0.4 % of all do, with 95 %
//! // confidence.
//! let (low, high) = sweep::rate_interval(0, 1000);
//! let z = 1.959_963_984_540_054_f64;
//! assert_eq!(low, 0.0);
//! assert!((high - z * z / (1000.0 + z * z)).abs() < 1e-15);
//! ```
//!
//! A sweep depends on no solver: it is handed those that it runs ([`BatchSolver`]). Two are
//! compared seed by seed.
//!
//! # The folder of a sweep
//!
//! [`run()`] writes, and [`merge()`] joins, folders that hold
//!
//! | file | what |
//! |---|---|
//! | `manifest.json` | [`Manifest`]: everything the rows depend on; written first |
//! | `part-000000.parquet`, ... | the rows, [`part_seeds`] of them in each, which keeps the summary short for any number |
//! | `summary.json` | [`StoreSummary`]: counts of the outcomes, and the digest of every part; written last |
//!
//! and, until they are finished, `.digests`: the digests so far, as `sha256sum --check` reads them.
//! Where the census has not proved that there are no other equilibria, the list grows as the seeds
//! go ([`Discovered`], in the summary), and the rows get their last numbers when all are computed:
//! until then those of a part are in `reached-000000.parquet`, and its list in `reached-000000.json`.
//!
//! The columns of a part ([`schema`]) are
//!
//! | column | type | unit | what |
//! |---|---|---|---|
//! | `seed` | u64 | 1 | number of the start |
//! | `theta_1_rad`, ... | f64 | rad | the start, if asked for |
//! | `lagrange_outcome` | i16 | 1 | number of the equilibrium in `equilibria` of the manifest and, behind these, of `discovered` in the summary, from 0, or a [`Failure`] |
//! | `lagrange_iterations` | u16 | 1 | iterations spent |
//! | `lagrange_residual` | f64 | 1 | the solver's own residual where it stopped |
//! | `lagrange_energy_j` | f64 | J | energy where it stopped, above joint 0 |
//! | `energy_outcome`, ..., `energy_energy_j` | | | the same of `energy` |
//!
//! and the codes of [`Failure`]s are −1 (iteration limit), −2 (stalled), −3 (a number overflowed or
//! was undefined) and −4 (converged to something that is in no list). Unit and description of each
//! column stand in its metadata in Parquet, and in the footer `funicular.program`, `.system`,
//! `.system_sha256`, `.seed_number` and `.source`; CSV has the names alone.

mod accuracy;
mod basins;
mod cost;
mod error;
mod identify;
mod reached;
mod record;
mod seeds;
mod settings;
mod sobol;
mod solver;
mod starts;
mod store;
mod summary;
mod sweep;
mod tally;

pub use basins::{Basins, BasinsError, Field};
pub use cost::expected_time_s;
pub use error::SweepError;
pub use identify::{JOINT_TOLERANCE, Member, Members, Origin};
pub use reached::{DISCOVERED, Discovered, Reached};
pub use record::{Chunk, Failure, Outcomes};
pub use seeds::Stream;
pub use settings::Settings;
pub use solver::{BatchSolver, Finds, Solvers};
pub use starts::{Axis, Source};
pub use store::compute::Compute;
pub use store::description::SCHEMA_VERSION;
pub use store::error::StoreError;
pub use store::finished::{PartRecord, StoreSummary};
pub use store::manifest::{Manifest, Release, SystemText};
pub use store::merge::{merge, merge_shard};
pub use store::part::schema;
pub use store::run::{Run, RunSettings, run};
pub use store::shard::{MOST_SEEDS, Shard, ShardError, part_seeds};
pub use summary::{Comparison, Disagreement, KEPT, Named, Summary};
pub use sweep::{Sweep, Swept};
pub use tally::{OutcomeTally, SolverTally, Tally, rate_interval};
