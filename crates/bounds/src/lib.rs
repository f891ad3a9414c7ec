//! Bounds on the energy of all configurations, by convex programming; no minimum is needed to start
//! from, and what is called rigorous holds whatever the rounding.
//!
//! ```
//! use bounds::{Sense, pull_bound};
//! use model::{Anchors, Bar, Chain, Problem};
//! // Two bars of 1 m and 1 N between level anchors 1 m apart: a triangle of equal sides.
//! let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
//! let chain = Chain::new("triangle", 1.0, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 2])?;
//! // Each anchor carries 1 N, and the moments about the joint give 1/(2 √3) N across.
//! let pull = [0.5 / 3.0_f64.sqrt(), 0.0, 1.0];
//! let bound = pull_bound(&Problem::new(chain)?, Sense::Lower, pull);
//! // No shape has less energy than the triangle, whose weights are √3/4 deep.
//! assert!(bound <= -0.75_f64.sqrt() && bound > -0.75_f64.sqrt() - 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | bound | needs | cost | tight |
//! |---|---|---|---|
//! | [`stress_bound`] | any shape and force densities | O(n) | for the global optimum |
//! | [`pull_bound`] | any pull | O(n) | where all bars are in tension |
//! | `cable_bound`, feature `cones` | nothing | O(n) per iteration, 10 to 20 | where all bars are in tension |
//! | `cable_system`, feature `cones`: any system, as cables | nothing | 10 to 30 sparse factorisations | where all bars are in tension; no proof |
//! | `semidefinite`, feature `sdp` | nothing | O(n) per iteration, 10 to 50 | always, in exact arithmetic |
//!
//! # Symbols
//!
//! | symbol | code | shape | unit inside | meaning |
//! |---|---|---|---|---|
//! | d_i | `bar` | 3 (2 in the plane) | near the total length | vector of bar i |
//! | l_i | `length` | n | same | its length |
//! | W_k | `joint_weight` | n | near the total weight | weight of joint k, lever rule |
//! | c_i | `tail_weight` | n | same | Σ W_k over k ≥ i |
//! | D | `difference` | 3 | length | last anchor from the first |
//! | q | `pull`, `q` | 3 (2) | weight | force of the ground at the last anchor |
//! | F_i | `force` | 3 (2) | weight | q − c_i e_Z |
//! | τ_i | `tau` | n | weight / length | force density, tension positive |
//! | u_k, g_k, e_k | `joint(k, 0..3)` | n − 2 each | | springs in a row, see below |
//!
//! # The semidefinite programme
//!
//! The energy $\sum c_i d_{iZ}$ is linear in the bar vectors; what makes the problem hard is
//! $|d_i|^2 = l_i^2$, which is quadratic. Shor's relaxation puts the matrix of all products
//! $Y \approx (1, d)(1, d)^T$ in the place of d, and keeps of "rank one" only that Y is positive
//! semidefinite; the lengths are then linear in Y.
//!
//! **The closure must be multiplied by every variable.** As it stands, $\sum d_i = D$ speaks of the
//! first column of Y only: it holds on average, while Y may spread the bars as it likes. For any
//! vectors $\bar d_i$ that close and are not too long, $\bar d \bar d^T$ plus
//! $l_i^2 - |\bar d_i|^2$ spread over the diagonal block of bar i is feasible. So without more the
//! relaxation is the chain of *cables*, $|d_i| \le l_i$: 2.0 mgl in the paper's terms for its
//! example. The rows $\sum_j d_j d_i^T = D d_i^T$ for every i (the closure multiplied by every
//! variable, a step of the reformulation-linearisation technique) say that Y maps the closure's
//! vector to zero: the spread is among chains that close. That is what makes it tight: 2.33546865
//! mgl.
//!
//! A matrix with a known null space is a smaller matrix. The rows are therefore not written down
//! but used up (which also gives the programme the interior that it otherwise lacks, and that the
//! solver needs): with the joints x_k for variables every chain closes by construction, and of the
//! lifted programme remains, for the moments X of the joints between the anchors,
//!
//! $$ \min \sum W_k z_k \quad\text{with}\quad \langle |x_i - x_{i-1}|^2 \rangle = l_i^2 . $$
//!
//! Lengths and energy look at sums over coordinates only, and at Z. So X enters through the Gram
//! matrix of the joints and their mean; the programme in the vertical plane, in space, and in any
//! number of dimensions has the same value, and a bound found in the plane is one for space.
//!
//! **The dual** has one multiplier τ_i / 2 per bar, and one matrix that must be positive
//! semidefinite, the stress matrix bordered by the weights: see [`stress_bound`]. It is tight
//! exactly when the optimum has a positive semidefinite stress matrix. A minimum in space lies in a
//! vertical plane, and displacing its joints out of the plane shows that its stress matrix is: so
//! it always is tight, unless a bar carries no force at all, and then too on all chains tried.
//! (With anchors on one vertical the stress matrix is singular: the turn about it.)
//!
//! **Springs in a row.** The stress matrix of a chain is tridiagonal. Eliminating one joint after
//! the other splits the one large semidefinite cone into n − 2 of size 3 × 3 that overlap in three
//! numbers (the stiffness u_k, the weight g_k and the energy e_k that the eliminated part shows to
//! joint k). It is solved in this form: no dense matrix, and work that grows with n, not n³ and
//! more.
//!
//! **Upper bounds.** The greatest energy is the least one with gravity reversed.
//!
//! # Rounding
//!
//! A cone solver is good to about 1e-9. Its signs of the axial forces are right, though, and with
//! these the chain closes by Newton's method to the last digit. Whatever comes of that, the bound
//! returned as rigorous is [`stress_bound`] (or [`pull_bound`]) of the result: evaluated in
//! interval arithmetic from the numbers of the chain as they are, it owes nothing to the solver.
//!
//! # References
//!
//! N. Z. Shor, Sov. J. Comput. Syst. Sci. 25 (1987) 1-11; J. B. Lasserre, SIAM J. Optim. 11 (2001)
//! 796-817, doi:10.1137/S1052623400366802 (relaxations); H. D. Sherali, W. P. Adams, A
//! Reformulation-Linearization Technique, Kluwer 1999, doi:10.1007/978-1-4757-4388-3; P. Biswas, Y.
//! Ye, IPSN 2004, 46-54, doi:10.1145/984622.984630 (Gram matrices of joints); R. Connelly, Invent.
//! Math. 66 (1982) 11-33, doi:10.1007/BF01404753 (super stability); P. J. Goulart, Y. Chen, 2024,
//! arXiv:2405.12762 (clarabel); C. Jansson, D. Chaykin, C. Keil, SIAM J. Numer. Anal. 46 (2007)
//! 180-200, doi:10.1137/050622870 (rigorous bounds in semidefinite programming).

#[cfg(feature = "cones")]
mod cable;
#[cfg(feature = "cones")]
mod cable_system;
#[cfg(feature = "cones")]
mod configuration;
mod data;
#[cfg(feature = "cones")]
mod error;
#[cfg(feature = "cones")]
mod polish;
#[cfg(feature = "cones")]
mod program;
mod pull;
#[cfg(feature = "sdp")]
mod semidefinite;
#[cfg(feature = "cones")]
mod settings;
mod stress;

#[cfg(feature = "cones")]
pub use cable::{CableBound, cable_bound};
#[cfg(feature = "cones")]
pub use cable_system::{CableSystem, cable_system};
#[cfg(feature = "cones")]
pub use configuration::Configuration;
pub use data::Sense;
#[cfg(feature = "cones")]
pub use error::{BoundError, ConeStatus};
#[cfg(feature = "cones")]
pub use program::ConeEvidence;
pub use pull::pull_bound;
#[cfg(feature = "sdp")]
pub use semidefinite::{SemidefiniteBound, semidefinite};
#[cfg(feature = "cones")]
pub use settings::BoundSettings;
pub use stress::{StressBound, stress_bound};
