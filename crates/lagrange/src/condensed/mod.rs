//! The condensed equations: three unknowns for any number of bars.
//!
//! Translations and inner multipliers of the full system are linear in the pull $p_0$ of the chain
//! on its first anchor, and the moment balance of bar i says that it is parallel to the average of
//! its joint forces, weighted with the lever arms,
//!
//! $$ F_i = p_0 + W_i e_z, \qquad u_i = s_i F_i/|F_i|, \qquad \sum l_i u_i = D, $$
//!
//! with the weight $W_i$ between joint 0 and the bar, and $s_i = +1$ in tension, $-1$ in
//! compression. Three equations in three unknowns, two in the vertical plane of the anchors;
//! residual and derivative take one pass over the bars.
//!
//! | symbol | code | unit |
//! |---|---|---|
//! | $-p_0 = (\lambda_1, \lambda_2, \lambda_3)$ | [`Pull::ground_n`] | N |
//! | $q = F_k$, force in the bottom bar k | `force`, `q` | N |
//! | $b_i = W_i - W_k$ | `loads` | N |
//! | $l_i$ | `lengths` | m |
//! | $s_i$ | [`Pull::compressed`] | 1 |
//! | $D = (D_h, D_z)$ | `across`, `rise` | m |
//! | $r = \sum s_i l_i F_i/\lvert F_i\rvert - D$ | `residual` | m |
//! | $\varrho, \varphi$: compression and slope of the bottom bar | `log`, `angle` | N, rad |
//!
//! # The method
//!
//! Module `bottom` decides from the lengths alone whether one bar is compressed, and which; module
//! `regime` says which way the chain is solved ([the table](crate#regimes)). With all bars in
//! tension the pull is the minimum of a convex function (`newton`, from the catenary; for many bars
//! first over a coarser chain of their moments, `loads`); with one compressed it is the only root
//! of its kind (`compression`). Both have a nested search in reserve that cannot fail, but where
//! strands hang side by side. Nearly straight chains are balanced along their line (`axis`). What
//! comes out is the global minimum of the energy, for every chain that [`model::Problem`] accepts.
//!
//! From the pull one more pass makes all joints and all $3(n+1)$ multipliers
//! (module `reconstruction`).
//!
//! ```
//! use lagrange::condensed::{Condensed, Settings};
//! use model::{Anchors, Bar, Chain, Problem};
//! // Two bars of length 1 over a span of 1.2: a symmetric triangle, 0.8 high.
//! let anchors = Anchors { start_m: [0.0; 3], end_m: [1.2, 0.0, 0.0] };
//! let chain = Chain::new("two", 10.0, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 2])?;
//! let chain = Condensed::new(&Problem::new(chain)?);
//! let pull = chain.pull(&Settings::default())?;
//! // Each bar: 10 N, half of it at the apex; the apex force 5 N per side acts with slope 4/3.
//! let [x, _, z] = pull.ground_n();
//! assert!((x + 3.75).abs() < 1e-14 && (z - 10.0).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod axis;
mod bar_data;
mod bottom;
mod bracket;
mod catenary;
mod chain;
mod compression;
mod kernel;
mod loads;
mod newton;
mod parallel;
mod pull;
mod reconstruction;
mod regime;
mod settings;
mod solve;
mod span;
mod stability;
pub(crate) mod sums;
mod system;
mod units;
mod vectors;

pub use chain::Condensed;
pub use pull::Pull;
pub use settings::Settings;
pub use solve::{Solution, Solver, solve};
