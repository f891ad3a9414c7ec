//! The paper's Newton iteration for millions of seeds in the vertical plane of the anchors.
//!
//! One problem, many seeds: one angle per bar, from the descending vertical towards the last
//! anchor. In that plane the paper's system has three coordinates per bar and two multipliers per
//! joint, 3n + 2(n+1) equations. Each iteration here is one Newton step on all of them. Centres of
//! weight and inner multipliers are linear and leave at once (module `point` of this crate does the
//! same in space); what remains are the rows of the angles and the closure,
//!
//! $$ g_i = l_i\\, t_i \cdot F_i = 0, \qquad h = \sum_i l_i u_i - D = 0, \qquad
//!    F_i = p + c_i e_z, $$
//!
//! with $u_i = (\sin\varphi_i, -\cos\varphi_i)$, $t_i = du_i/d\varphi_i$ and the pull $p$ of the
//! chain on the first anchor. The row of a bar holds its own angle and the pull only, so that the
//! corrections of the angles are eliminated, bar by bar, and two equations are left for that of the
//! pull:
//!
//! $$ \Big(\sum_i \frac{l_i}{N_i} t_i t_i^T\Big)\\,\delta p
//!    = -h - \sum_i \frac{l_i}{N_i}(t_i\cdot F_i)\\,t_i,
//! \qquad \delta\varphi_i = \frac{t_i\cdot(F_i + \delta p)}{N_i}, \qquad N_i = u_i\cdot F_i. $$
//!
//! No approximation is made: the step is that of the full system (a test compares it with the
//! solution of the full planar system by the crate's own [`jacobian`](crate::jacobian())).
//!
//! | symbol | code | shape | unit |
//! |---|---|---|---|
//! | $l_i$ | `Bar::length` | n | total length |
//! | $c_i$, as `carried_weights` | `Bar::carried` | n | total weight |
//! | $\varphi_i$ | `State::angle` | n | rad |
//! | $\sin\varphi_i, \cos\varphi_i$ | `State::sin`, `State::cos` | n | 1 |
//! | $t_i \cdot F_i$ | `State::moment` | n | total weight |
//! | $N_i = u_i \cdot F_i$ | `axial` | n | total weight |
//! | $p$ | `pull` | 2 | total weight |
//! | $D$ | `span` | 2 | total length |
//!
//! # Where it differs from `solve_from`
//!
//! [`solve_from`](crate::solve_from) works in space with three angles per bar, where the Jacobian
//! of the paper's coordinates is singular at every solution; it damps each step by Levenberg's and
//! Marquardt's rule, falls from step to step, and relaxes the chain where the residual has a local
//! minimum. Here the plain Newton step is taken, shortened only in length:
//!
//! - no bar turns by more than a limit, which varies from step to step so that the iteration runs
//!   into no cycle; every eighth step is a plain one;
//! - the first multipliers are estimated from the angles as `solve_from` does, and estimated again
//!   after every eighth step as long as the residual is large;
//! - where the step is undefined (all bars parallel, say) the bars are turned by a small fixed
//!   pattern.
//!
//! Nothing falls from step to step, and none of it acts near a solution, where both converge
//! quadratically. From the same seed the two may therefore reach different equilibria; the set of
//! equilibria that they reach is the same. A decrease of the residual is not asked for: damped so
//! that it never grows, the iteration ended in a local minimum of the residual from about a third
//! of the random seeds of the paper's chain.
//!
//! # Seeds of long chains
//!
//! The more bars, the farther a random seed is from every equilibrium: a chain that spans 0.88 of
//! its length is reached from all seeds at 5 equal bars, from 18 % at 15 and from none at 60. What
//! is left after [`BatchSettings::max_iterations`] steps is solved by signs (module `signs`): the
//! closed shape nearest to the seed says which bars are compressed, and for given signs two
//! equations in the pull are left, whatever n is. So every seed leads to an equilibrium that has
//! the signs of its shape as far as one exists; at 15, 30 and 60 such bars all of 1,000 seeds do.
//!
//! # Speed and repeatability
//!
//! Eight seeds are solved side by side ([`Batch::solve`]); a seed that is done gives its place to
//! the next. Nothing is allocated meanwhile. The result of a seed has the same bits whatever its
//! neighbours, and on whatever machine.

mod kernel;
mod lanes;
mod numbers;
mod signs;
mod solver;
#[cfg(test)]
mod tests;

pub use solver::{Batch, BatchSettings};
