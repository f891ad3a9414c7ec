//! Equilibria of hanging chains of bars, energy first: section VIII, Solution 1 of the paper, for
//! any number of bars in space.
//!
//! ```
//! // The paper's chain: three bars of 1 m and 1 kg, anchors 2 m apart on one vertical.
//! let found = energy::minimise(&model::cases::paper(), &energy::Settings::default())?;
//! // The first bar hangs 19.694867976133 degrees off the vertical (a root finder of 40 digits).
//! let [x, y, z] = found.directions[0];
//! assert!((x.hypot(y).atan2(-z).to_degrees() - 19.694_867_976_133).abs() < 1e-9);
//! assert_eq!(found.equilibrium.stability.index_in_space, 0);
//! # Ok::<(), energy::Error>(())
//! ```
//!
//! A chain comes to rest where its potential energy is least. The energy is linear in the
//! directions `u_i` of the bars; that the chain ends at its anchor is one vector equation, the
//! closure. This crate minimises the one subject to the other, and gets every force from the
//! energy: the reaction of an anchor is the derivative of the least energy by its place.
//!
//! | paper | code | unit | equation |
//! |---|---|---|---|
//! | `l_i`, `m_i`, `r_i` | `length_m`, `mass_kg`, `centre_m` of `model::Bar` | m, kg, m | section II |
//! | first column of `[A_i]` | `u`, `directions` | - | (5) |
//! | `V` | `energy_j` (from joint 0) | J | (v) |
//! | `V / mgl` | [`example::potential`] (6 more) | `mgl` | (vi) |
//! | - | `carried`, `h_i`: weight hanging on bar *i*, less one half | total weight | (v), see `scaled_chain` |
//! | `sum l_i u_i = D` | `closure`, `gap` | total length | (i), (ii) |
//! | `theta, alpha, beta` | `theta_rad`, `alpha_rad`, `beta_rad` | rad | (i)-(iv) |
//! | (viii) | [`example::quadratic`], [`example::candidates`] | - | (viii) |
//! | (ix), (x) | [`example::scan`] | deg, `mgl` | (ix), (x) |
//! | - | `mu`, `multiplier` of the closure | total weight | - |
//! | `lambda_1..3(n+1)` | `multipliers_n` | N | (40); here by virtual work |
//! | - | `axial`, `N_i`: second derivative by a turn of bar *i*; its axial force | total weight | - |
//!
//! # The method
//!
//! On the closed chains, with the metric `sum l_i |du_i|²`, the projected gradient has the parts
//! `t_i = (I - u_i u_iᵀ)(h_i up + mu)` and the Hessian is the axial force `N_i` times the identity,
//! bar by bar, projected on the three rows of the closure. One pass over the bars eliminates them;
//! what remains has size three (four about vertical anchors, where the turn of the whole chain is
//! taken out). So an iteration costs O(n), and so do the inertia, the Morse index, and the way out
//! of a saddle. Iterates are closed chains, the energy never rises beyond its rounding, and the
//! stop is on the projected gradient and the closure alone. `Ok` means converged to a local
//! minimum; in space that is the global one.
//!
//! From no guess a long chain is first solved with its bars held parallel in groups of eight, and
//! so on down to two dozen bars that start from a circular arc: restricted to such shapes the
//! energy and the closure are those of a shorter chain. Three or four iterations on the chain
//! itself are left. Where a deep chain bends within a few bars the bars around the bend are
//! minimised by themselves first, their ends held.
//!
//! # Regimes
//!
//! Two questions decide which way a chain takes, `regime` answers both from the
//! lengths and the anchors before any iteration. Let L be the total length, D the way from anchor
//! to anchor, l the longest bar and s the length to spare, the smaller of $L - |D|$ and
//! $L + |D| - 2l$. The thresholds stand in `regime`.
//!
//! | `Reach` | test | unknowns | fallback | what the evidence says |
//! |---|---|---|---|---|
//! | slack | neither of those below | directions on the closed chains, 2 n - 3; axes level and upright | a saddle is left along its lowest mode; bars that carry next to nothing: Newton's method with the weights counted from the least loaded bar (`refine`) | converged; minimum, with its indices |
//! | drawn out | $s < L/4$ and $s < \lvert D\rvert$ | the same, with an axis along D | the same | the same; how uncertain the forces are, if above 1e-9; refused as `NearlyFolded` where what decides is lost |
//!
//! | `Turning` | test | what is done | what the evidence says |
//! |---|---|---|---|
//! | free | anchors on one vertical | the turn about it is taken out of the Newton system | the turn counts in `nullity` |
//! | soft | level distance of the anchors at most 1/100 of the unit of length | the chain is turned as a whole before Newton's steps | its condition |
//! | held | any other, and every chain with [`Motion::Plane`] | nothing | nothing |
//!
//! What only a solution can tell follows from it. All bars on one line through both anchors (two
//! strands that just meet): their forces are the limit of anchors moved apart (`straight_fold`). A bend
//! that is too sharp for the groups of bars of a coarser chain: its bars are solved by themselves
//! (`sharp_bend`).
//!
//! argmin (`Executor`, `CostFunction`, `Gradient`, `Solver`, `IterState`) runs the
//! minimisation of the paper's two angles ([`example`]). The others are loops of our own: argmin has
//! no solver for constrained problems, and its unconstrained ones cannot use a Hessian that is
//! diagonal plus three rows.
//!
//! Up to which *n* does it keep up? The time is linear in *n* as far as memory goes: nothing is
//! stored but a few vectors of length *n*, and the number of iterations on the chain itself does
//! not grow. `cargo run --profile dist -p benches --bin bars` shows it.
//! A pass over the bars costs a square root and a division per bar, and an iteration takes about
//! five passes (system, step, two or three corrections of the closure); a method with three
//! unknowns instead of 2 n needs one pass and stays ahead by that factor and by the coarser chains.
//! A chain drawn out along one line, nearly taut or hanging as two strands side by side, is closed
//! by the balance of its slack with what the bars lose by their angles to that line, and keeps its
//! digits down to the slack of the tautest chain that is a problem; the forces along the line then
//! hold to a rounding over those angles, and the evidence says so where that is much. See
//! [`SecondOrder::condition`] and [`Evidence`](model::Evidence)`::nullity`.
//!
//! # Why some formulas are also in `lagrange`
//!
//! The two solvers share data types and nothing else. Weights hanging on a bar, joint forces, axial
//! forces appear in both, derived and written twice on purpose: that two programs which share no
//! mechanics agree to the last digits is the experiment of this project. Do not deduplicate them.

pub mod batch;
mod error;
pub mod example;
mod lever;
pub mod net;
mod run;
mod thresholds;
mod twofold;
mod vector;

pub use error::Error;
pub use run::{
    Motion, SecondOrder, Seed, Settings, Solution, Work, minimise, minimise_from,
    reaction_by_differences, second_order,
};
