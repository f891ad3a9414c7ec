//! Equilibria of hanging chains of bars, forces first: sections II-IV and VII of the paper.
//!
//! ```
//! // The paper's chain: three bars of 1 m and 1 kg, anchors 2 m apart on one vertical.
//! let found = lagrange::solve(&model::cases::paper(), &lagrange::Settings::default())?;
//! // lambda_3, the vertical force of the ground on bar 1, in mg.
//! assert!((found.lambda[2] / 9.80665 - 2.312944292241838).abs() < 1e-13);
//! assert_eq!(found.equilibrium.stability.index_in_space, 0);
//! # Ok::<(), lagrange::Error>(())
//! ```
//!
//! The unknowns are the paper's own. Each of n bars has six coordinates, eq. (21); each of the n +
//! 1 joints has three constraint functions, eqs. (7)-(20), and three multipliers. Equation (40) and
//! the constraint functions are 6n + 3(n+1) equations for as many unknowns (30 for three bars), and
//! every equilibrium, stable or not, solves them:
//!
//! $$ -\mathbf{B}^T\\{\lambda\\} = \mathbf{T}, \qquad \\{f\\} = 0. $$
//!
//! | paper | code | shape | unit | equation |
//! |---|---|---|---|---|
//! | $\mathbf{A}_i$ | [`rotation`](rotation()) | 3 × 3 | 1 | (1)-(5) |
//! | $u_i = \mathbf{A}_ie_x$ | [`direction`] | 3 | 1 | (6), (10) |
//! | $\partial u_i/\partial(\psi_i, \theta_i, \varphi_i)$ | [`direction_gradient`] | 3 × 3 | 1/rad | (22) |
//! | $\psi_i, \theta_i, \varphi_i$ | [`Seed`], [`Solution::angles_rad`] | 3 per bar | rad | section II |
//! | $\\{q\\}$ | `q` | 6n | m, rad | (21) |
//! | $f_i$ | [`constraint_functions`] | 3(n+1) | m | (7)-(20) |
//! | $\mathbf{B}$ | [`constraint_matrix`] | 3(n+1) × 6n | 1, m/rad | (22) |
//! | $\mathbf{T}$ | [`load_vector`] | 6n | N | (41) |
//! | $\\{\lambda\\}$ | `lambda` | 3(n+1) | N | (33), (40) |
//! | (40) with (7)-(20) | [`residual`] | 6n + 3(n+1) | N, N m, m | (40) |
//! | its derivative | [`jacobian`] | square | mixed | |
//! | spin about $C_i x_i$ | [`spin`](spin()) | 3 | 1 | section III, (23) |
//! | $F_i = p_0 + c_i e_z$ | `force` | 3 per bar | N | sum of (40) over bars 1..i |
//!
//! # The method
//!
//! Everything affine is eliminated exactly, which leaves 3n angles and the first pull (module
//! `point`). Their matrix is singular at every solution; module `step` treats it, and nothing else
//! does. Module `newton` makes the method global; module `relax` helps where the residual has local
//! minima that are no roots; module `spin` says where the paper's coordinates lose a moment balance
//! and with it admit false roots, and how they are avoided.
//!
//! What a run of Newton's method has led to is known only afterwards, and decides what follows:
//!
//! | outcome of a run | what follows |
//! |---|---|
//! | an equilibrium | done; for [`solve`](solve()), if it is stable |
//! | a root at which a bar is not in balance | other angles for all bars, another run |
//! | no root: a local minimum of the residual | relaxation from the seed, another run |
//! | for [`solve`](solve()), two vertical strands that just meet | their forces by `condensed` |
//!
//! # Regimes
//!
//! [`condensed`] finds the hanging equilibrium from three unknowns, and which way it takes follows
//! from the chain alone, before any iteration: `Regime::of` in `condensed/regime`, one file for
//! each, and one for all struts. Let the parts of the chain before and after its lowest bar (length l) hang straight down
//! as two strands, G be the gap between their ends, L the total length, D the way from anchor to
//! anchor and u the unit roundoff. The thresholds of this table stand in `thresholds.rs`.
//!
//! | regime | test | unknowns | fallback | what the evidence says |
//! |---|---|---|---|---|
//! | tension | $\lvert G\rvert > l$ | force in the lowest bar, across and up | nested searches on two monotone functions | converged; minimum, stable |
//! | taut | and $L - \lvert D\rvert < 10^{-3} L$ | along and across the line of the anchors | those searches, polished along the line | as above |
//! | side by side | and strands of one depth, less than $10^{-3} L$ apart | along and across the vertical | none | as above; the error of the forces if it is above 1e-9 |
//! | strut | $\lvert G\rvert < l$ | compression and slope of the lowest bar | nested searches for both | as above |
//! | taut strut | and nearly straight from anchor to anchor | the slope from the line of the anchors | as above | as above |
//! | folded strut | and longer than all others, nearly as long as these and the span together | the slope from that line, the others against it | as above | as above |
//! | vertical strut | and anchors on one vertical | the slope from the vertical | as above | as above; forces indeterminate if the chain is straight |
//! | triangle | two bars, $\lvert D\rvert < 10^{-3} L$ | none: the moments of the load, to twice the digits | none is needed | converged; minimum, stable |
//! | unloaded | bars without load at the bottom can fill G | none | none is needed | degenerate, with the number of free motions |
//! | indeterminate | $G = l$ to 8u L, anchors on one vertical | how the strands share one weight | none | the limit of anchors moved apart |
//!
//! `condensed` stays in this crate: the full system takes the forces from it where its own
//! multipliers are indeterminate, and settings and their errors are shared. A crate of its own
//! would look like a third solver, though it eliminates the same equations, and an agreement of the
//! two is no evidence.
//!
//! # Independence
//!
//! The crate `energy` answers the same question from the potential energy. Neither crate may use
//! the other, nor have so much as a helper in common: that they agree is the evidence, so formulas
//! that stand in both (a direction from angles, a sum of weights) stand there twice on purpose.

pub mod batch;
pub mod condensed;
mod effort;
mod error;
mod full;
mod larger;
pub mod net;
mod settings;
mod thresholds;

pub use effort::Effort;
pub use error::Error;
pub use full::{
    Converged, Seed, Solution, Solver, Spectrum, constraint_functions, constraint_matrix,
    direction, direction_gradient, direction_hessian, jacobian, load_vector, relative_residual,
    residual, rotation, solve, solve_from, spectrum, spin,
};
pub use settings::{Settings, SettingsError};
