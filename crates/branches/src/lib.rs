//! Continuation of equilibria over a parameter: branches, folds, branch points, exchanges of
//! stability.
//!
//! ```
//! use branches::{Combine, Continuation, ContinuationSettings, EventKind, Variation};
//! // Three bars of 1 m between level anchors, which move from 1.1 m to 1.3 m apart.
//! let vary = ["anchors.end_m.z=0".parse()?, "anchors.end_m.x=1.1..1.3:3".parse()?];
//! let variation = Variation::new(model::cases::paper().chain(), &vary, Combine::Product)?;
//! let found = Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {})?;
//! // The asymmetric shapes end in folds where the squared distance is 3/2.
//! let folds = found.events.iter().filter(|event| event.kind == EventKind::Fold);
//! let places: Vec<f64> = folds.map(|fold| fold.values[1]).collect();
//! assert_eq!(places.len(), 4);
//! assert!(places.iter().all(|x| (x - 1.5_f64.sqrt()).abs() < 1e-10));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! At every point of a path a census lists all equilibria in the vertical plane of the anchors,
//! with proof. Between neighbouring points every one of them is followed along its curve (module
//! `curve`), which ends at exactly one other: of the next point, or, having turned back, of the
//! same. Where a curve turns back, two branches meet in a fold. So the census at the points proves
//! what is there, and the curves say what belongs together; a census between neighbouring points
//! and events counts again. Where it differs, or a branch point lacks its branches, points are
//! added.
//!
//! Where the equations are doubly singular (two curves touch) each has a fold of its own in the point
//! that they share, located to the square root of rounding only.
//!
//! # Limits
//!
//! What begins and ends between two censuses and touches no other branch (two branches that meet in
//! two folds, a closed curve) is not seen: a finer grid sees it. Curves end where a number leaves
//! its range, and at degenerate points at an end of the path or in a corner of it.
//!
//! # Steps
//!
//! Along one curve the sign of det (derivatives; tangent) changes where another curve crosses and
//! nowhere else, the slope of the position where the curve turns, and $w$ where the chain is
//! straight, which is a turn. A step is halved until the signs at its ends say one such thing at
//! most, and the slopes leave no room for two turns.
//!
//! # Columns
//!
//! `funicular trace --csv` writes the points of the branches, one line each: `path`,
//! `branch` (both from 1), `position`, a column for each parameter, `span_m`, `grid` (empty between the points),
//! `proved`, `event` (its number, or empty), `pull_horizontal_n`, `pull_vertical_n`, `energy_j`,
//! `index_in_plane`, `index_in_space`, and for each bar `angle_1_rad`, `axial_1_n`, ...: the fields
//! of [`BranchPoint`].
//!
//! # The equations
//!
//! $\varphi_i$ is the angle of bar i from the descending vertical,
//! $u_i = (\sin\varphi_i, -\cos\varphi_i)$, $(H, V)/w$ the pull of the chain on the first anchor in
//! homogeneous coordinates and $F_i = (H, V + w c_i)$. Equilibria are
//!
//! $$ F_i \cdot u_i' = 0, \qquad \sum_i l_i u_i = D, \qquad H^2 + V^2 + w^2 = 1: $$
//!
//! n + 3 equations in n + 3 unknowns and the parameter. In this form nothing is singular where a
//! bar changes from tension to compression ($F_i = 0$), nor where the chain becomes straight and
//! its pull infinite ($w = 0$): there the curve turns back as in a fold.
//!
//! | meaning | code | shape | unit |
//! |---|---|---|---|
//! | $\varphi_i$ | `y[i]` | n | rad |
//! | $H, V, w$ | `y[n..n + 3]` | 3 | homogeneous |
//! | position on the path, 0 at its first point, 1 at its last | `y[n + 3]`, `position` | 1 | 1 |
//! | $l_i, c_i, D$ | `PlanarChain` | n, n, 2 | total length; half the spread of the $c_i$ |
//!
//! # References
//!
//! H. B. Keller, "Numerical solution of bifurcation and nonlinear eigenvalue problems", in:
//! Applications of bifurcation theory, Academic Press 1977 (pseudo-arclength).

mod arc;
mod assemble;
mod branch;
mod census_point;
mod checks;
mod continuation;
mod curve;
mod diagram;
mod equations;
mod error;
mod event;
mod frame;
pub mod load;
mod locate;
mod observables;
mod parameter;
mod path;
mod segment;
mod variation;

pub use branch::{Branch, BranchEnd, BranchPoint};
pub use census_point::{PathPoint, PointStatus};
pub use checks::Checks;
pub use continuation::{Continuation, ContinuationSettings, Progress};
pub use diagram::{Abscissa, diagram};
pub use error::ContinuationError;
pub use event::{Event, EventKind};
pub use parameter::apply::PointError;
pub use parameter::base::{check, resolved};
pub use parameter::error::ParameterError;
pub use parameter::number::{AnchorEnd, BarField, JointField, Number, Which};
pub use parameter::system::apply;
pub use parameter::values::{MAX_POINTS, Parameter};
pub use variation::{Combine, Variation};
