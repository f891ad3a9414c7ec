//! Every equilibrium of a hanging chain of bars, with proof.
//!
//! ```
//! use census::{Census, Settings};
//! // The paper's chain has two equilibria, each on a circle about the vertical of the anchors.
//! let census = Census::take(&model::cases::paper(), &Settings::default())?;
//! let [lowest, highest] = &census.equilibria[..] else { panic!("{census:?}") };
//! assert!(census.complete && lowest.circle && highest.circle);
//! // One is the other upside down: the energies add up to that of three centres at mid height.
//! let sum = (lowest.energy_j + highest.energy_j).mid() / 9.80665;
//! assert!((sum + 6.0).abs() < 1e-14);
//! # Ok::<(), census::CensusError>(())
//! ```
//!
//! [`Census::take`] finds all equilibria of a chain, stable or not, encloses each of them in
//! intervals to full double precision, proves its Morse index, and proves that there is no other.
//! What it cannot decide it lists ([`Undecided`]) and does not call complete.
//!
//! # The problem
//!
//! At rest the force along the chain is the pull $p$ of bar 1 on joint 0 plus the weights in
//! between. The moment balance of bar i says that it is parallel to $F_i = p + c_i e_z$, where
//! $c_i$ is the weight carried at the joints 1 to i−1, that of each bar divided between its joints
//! by the lever rule. What joint 0 carries, $m_1(1 - r_1/l_1)$, adds to the pull on the first
//! anchor alone. So $u_i = s_i F_i/|F_i|$ with $s_i = +1$ in tension and −1 in compression, and an
//! equilibrium is a pattern of signs and a pull that close the chain:
//!
//! $$ \Phi_s(p) = \sum_i s_i l_i \frac{F_i}{|F_i|} - D = 0. $$
//!
//! All $F_i$ lie in the vertical plane of $p$, and so does D: two equations in the two unknowns (H,
//! V), for each of 2ⁿ patterns. With the anchors on one vertical every such plane will do, and each
//! solution stands for a circle of equilibria. If H = 0, bars whose force vanishes may point
//! anywhere (modules `slack`, `families`); a bar alone whose force vanishes has its own coordinates
//! (`unloaded`).
//!
//! | meaning | code | shape | unit | equation |
//! |---|---|---|---|---|
//! | $l_i$ | `length` | n | chain's total = 1/2..1 | section II |
//! | $c_i$ | `weight` | n | centred, spread 1..2 | (40), summed and levered |
//! | $s_i$ | `signs`, `Pattern` | n | ±1 | |
//! | $p = (H, V)/w$ | `Cell` | 2 | projective | −(λ₁, λ₂, λ₃), less what joint 0 carries |
//! | $F_i$ | `force` | 2 per bar | that of $c_i$ | |
//! | $l_i f_i = l_i F_i/\|F_i\|$ | `BarTerm` | 2 per bar | that of $l_i$ | |
//! | $\Phi_s$, $\Phi_s'$ | `Closure` | 2, 2 × 2 | that of $l_i$ | (iii), (iv), for n bars |
//! | $D$ | `span` | 2 | that of $l_i$ | |
//! | $\tau_i = s_i \|F_i\|/l_i$ | `density` | n | | |
//!
//! # The method
//!
//! Pulls of any size, infinite ones included, are the points of half a cube (module `cell`), which
//! is cut into cells (module `search`). On each cell all patterns that are left are excluded
//! together where possible (module `pattern_sums`); where the derivative hardly varies, Krawczyk's
//! test proves a zero (module `krawczyk`). All arithmetic that a proof rests on is rounded outward
//! ([`Interval`]). The indices follow from signs of small determinants (module `inertia`).
//!
//! Where the lengths fit into the line between the anchors the closure has singular zeros at
//! infinity. Whether they fit is decided in integers (module `exact`); the zeros are blown up, and
//! proved to be apart from all equilibria (module `straight`).
//!
//! Systems of joints and members, nets of several closures among them, are the business of
//! [`net`], proofs about one equilibrium that of [`boxes`].
//!
//! # What is independent of the search
//!
//! [`Topology`] knows from the lengths alone which numbers of equilibria of each index are
//! possible; [`Census::check`] proves every listed equilibrium again, and holds the claim that
//! nothing is missing against what topology and duality say; [`sextic`] counts the equilibria of
//! the paper's example by exact algebra.

pub mod boxes;
mod branch_and_bound;
mod error;
pub mod net;
mod run;
mod settings;

pub use error::{CensusError, rough_time};
pub use numerics::Interval;
pub use run::check::CheckError;
pub use run::compact::CompactCensus;
pub use run::count::morse::MorseError;
pub use run::count::sextic;
pub use run::count::topology::{Topology, TopologyError};
pub use run::equilibrium::{Neighbourhood, ProvenEquilibrium};
pub use run::estimate::Estimate;
pub use run::plane::face::Face;
pub use run::position::Position;
pub use run::search::Progress;
pub use run::search::undecided::{Reason, Undecided};
pub use run::slack::families::SlackFamily;
pub use run::slack::straight::StraightPosition;
pub use run::{Census, Statistics, expected_time_s};
pub use settings::Settings;
