//! Minimisation of the energy from millions of seeds in the vertical plane of the anchors.
//!
//! The same question as [`minimise_from`](crate::minimise_from) with
//! [`Motion::Plane`](crate::Motion), for many seeds of one problem: which minimum does the chain
//! slide into? The energy is $V = \sum_i l_i h_i\\, z_i$ with the weight $h_i$ that bar i lifts and
//! its direction $u_i = (x_i, z_i)$; the closure is $\sum_i l_i u_i = D$. Everything is measured by
//! $\sum_i l_i \delta_i^2$, where $\delta_i$ turns bar i along $t_i = (-z_i, x_i)$.
//!
//! 1. *Close* the chain: the least turns that take the gap away to first order,
//!    $\delta_i = -t_i\cdot\nu$, $(\sum l_i t_i t_i^T + d I)\\,\nu$ = gap; the damping d goes to
//!    zero with the gap. Directions stay unit vectors by normalising,
//!    $u_i \gets (u_i + \delta_i t_i)/\sqrt{1+\delta_i^2}$.
//! 2. On the closed chains the *projected slope* is $s_i = t_i\cdot(h_i e_z + \mu)$ with the
//!    multiplier $\mu$ for which it is least, and the curvature of the Lagrangian by a turn of bar
//!    i is its axial force $N_i = -u_i\cdot(h_i e_z+\mu)$.
//! 3. *Newton's step* on the tangent space: $N_i\delta_i + s_i + t_i\cdot\nu = 0$,
//!    $\sum l_i t_i \delta_i = 0$, again two equations. Where the second derivative is not positive
//!    definite, $|N_i|$ stands for $N_i$: still a descent.
//! 4. *Descend*: step, close again, and halve the step until the energy has fallen by a fair part
//!    (Armijo). The energy never rises from one closed chain to the next.
//! 5. *Verify*: a seed is done when the slope is zero to the tolerance and the second derivative on
//!    the tangent space is positive definite: the number of negative $N_i$ and that of positive
//!    eigenvalues of $\sum (l_i/N_i) t_i t_i^T$ make two together (Sylvester, as for any
//!    saddle-point matrix with two constraints: M. Benzi, G. H. Golub, J. Liesen, Acta Numerica 14,
//!    2005, doi:10.1017/S0962492904000212). Newton's steps go on until they turn no bar any more:
//!    the slope of bars that carry nearly nothing is zero to the tolerance far from where they
//!    belong. A stationary point that is no minimum is left by a
//!    small turn of every bar.
//!
//! | symbol | code | shape | unit |
//! |---|---|---|---|
//! | $l_i$ | `Piece::length` | n | total length |
//! | $h_i$ | `Piece::lifted` | n | total weight |
//! | $u_i = (x_i, z_i)$ | `Place::x`, `Place::z` | n | 1 |
//! | $s_i$ | `Place::slope` | n | total weight |
//! | $N_i$ | `Place::axial` | n | total weight |
//! | $\delta_i$ of a step | `Place::turn` | n | 1 |
//! | D | `span` | 2 | total length |
//!
//! Eight seeds side by side; one that is done gives its place to the next. No function of the
//! system's library is called and no product is fused, so that the bits of a result depend on
//! neither the neighbours nor the machine. Nothing here is shared with `lagrange::batch`: vectors
//! of numbers, the queue and the mechanics stand in both, written twice.

mod control;
mod minimiser;
mod piece;
mod point;
#[cfg(test)]
mod tests;
mod wide;

pub use minimiser::{Batch, BatchSettings};
