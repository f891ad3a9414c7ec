//! Proofs about any system of bars, cables, struts and springs.
//!
//! # One equilibrium in a box
//!
//! [`prove`] takes the answer of any solver and proves with Krawczyk's test that exactly one
//! equilibrium, shape and forces, lies in a small box around it. With the places $x_j$ of the
//! joints that move and the spans $d = x_b - x_a$ of a member, one or of a rope several, each from a joint a
//! to a joint b, $u = d/|d|$, the equations are
//!
//! $$ f_j + \sum_{\text{at } j} \pm N_e u = 0 \qquad (1), \qquad
//!    \tfrac12(|d|^2 - l_e^2) = 0 \qquad (2), \qquad
//!    \sum |d| - c_e N_e - l_e = 0 \qquad (3): $$
//!
//! balance of each joint along each direction in which it can move (1), the length of each
//! inextensible member of one span that acts (2), the law of each other one with the compliance $c_e =
//! l_e/EA_e$ (3), 0 for an inextensible rope. Unknowns are the force densities $w_e = N_e/|d|$ of members with (2), so
//! that $N_e u = w_e d$ and all of their equations are polynomials, and the forces $N_e$ of the others. As many equations
//! as unknowns. A cable that is slack has no unknown; that it is
//! slack is proved of the whole box, and so is the sign of the force of each cable and strut that
//! acts.
//!
//! Where a system has self-stresses the derivative is singular and there is no such proof; where it
//! turns freely about verticals each turn is held fast (module `turns`), and where an unloaded
//! joint has slack members alone it stays where the answer has it.
//!
//! | symbol | code | shape | unit | meaning |
//! |---|---|---|---|---|
//! | $x_j = o_j + A_j t_j$ | `place` | 3 | length | $t_j$: as many coordinates as the support leaves |
//! | $f_j$ | `loads` | 3 per joint | force | weights and forces, shared by the lever rule |
//! | $w_e$ or $N_e$ | `force` | members that act | force/length or force | tension positive |
//! | $d$ or $u$ | `Direction` | 3 per span | length or 1 | derivative of the pull by the unknown |
//! | $c_e$ | `compliance` | members | length/force | 0 for inextensible ones |
//! | $\mu_i$ | | free turns | force | moment that holds a turn; proved to be zero |
//! | Y | `inverse` | n × n | | approximate inverse of the derivative |
//!
//! # Singular points, and the path to the first of them
//!
//! [`prove_singular`] encloses a load at which the derivative $J$ of the equations $F$ is singular: $F(y, t) =
//! 0$, $J \phi = 0$, $c \cdot \phi = 1$; in a branch point $\phi$ breaks a symmetry (module `limit`).
//! [`prove_path`] proves the path of equilibria through a shape by Krawczyk's test with the load as an
//! interval, box after box, up to its first singular point (modules `tube` and `path`).
//!
//! # Over tolerances
//!
//! [`prove_ranges`] bounds an equilibrium for all values of numbers that are known within limits (module
//! `tolerances`).

pub(crate) mod activity;
pub(crate) mod arithmetic;
mod coordinates;
mod curvature;
mod diagnosis;
pub(crate) mod equations;
mod family;
mod floor;
pub(crate) mod frame;
mod inverse;
mod jam;
pub(crate) mod krawczyk;
mod limit;
pub(crate) mod newton;
mod path;
pub(crate) mod prove;
pub(crate) mod proven;
mod side;
mod symmetry;
mod tolerances;
mod tube;
pub(crate) mod turns;

pub use limit::{MAX_LIMIT_UNKNOWNS, prove_singular};
pub use path::{MAX_PATH_UNKNOWNS, PathProof, SingularKind, prove_path};
pub use prove::{MAX_UNKNOWNS, prove};
pub use proven::SystemBox;
pub use tolerances::{Depth, NoRanges, Range, ToleranceRanges, prove_ranges};
