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
//!
//! # All equilibria
//!
//! [`SystemCensus::take`] takes a system apart. Trees, chains and frames that are built up joint by
//! joint have closed forms, or the census of a chain. A net of several closures is searched over
//! the places of its knots. A joint P that two bars of the lengths $l_1$, $l_2$ hold to a and b is
//! no knot: with $c = b - a$, $q = |c|^2$, its load f and $f_\perp$, the part of it across c,
//!
//! $$ P = a + \alpha c \pm h \frac{f_\perp}{|f_\perp|}, \qquad
//!    \alpha = \frac12 + \frac{l_1^2 - l_2^2}{2q}, \qquad
//!    h^2 = \frac{((l_1 + l_2)^2 - q)(q - (l_1 - l_2)^2)}{4q}, $$
//!
//! with the force densities $w_1 = \pm|f_\perp|(1 - \alpha)/h + f\cdot c/q$ and $w_2 =
//! \pm|f_\perp|\alpha/h - f\cdot c/q$. So a bridle whose strands have two bars each has one knot,
//! three unknowns and a sign for each strand, whatever the number of strands. Branch and bound goes
//! through all places of the knots within reach of their anchors. Boxes are narrowed by distances,
//! excluded by the linear balance of forces in intervals, and where all is smooth by the interval
//! Newton method, which also proves that a box has one equilibrium at most for a pattern of signs.
//! Each equilibrium is then enclosed by Krawczyk's test on (1) and (2), and its index follows from
//! the inertia of the bordered second derivative.
//!
//! A bridle of three strands of which one has three bars or more has two independent closures too,
//! and six unknowns, the pulls of two strands, whatever the number of its bars: a strand under
//! upright loads hangs in a plane, and its pull and a pattern of tension and compression tell its
//! shape as they do that of a chain. Branch and bound goes through the places of the knot, and with
//! each box goes the list of the cells of pulls with which each strand reaches it (module
//! `bridle`).
//!
//! Cables, struts and ropes beside bars are taut or slack: for each set of slack ones the others make a system of
//! their own, whose equilibria are kept where the taut ones pull or push as they can and the slack ones do not
//! reach. In a net a rope is one link of several spans with one tension $N$ and equation (3); an elastic member tells
//! its tension by its spans, and a weight alone at the end of a rope tells that of the rope, $N = W$, and hangs as far
//! down as the other spans leave it. A span without length pulls with any vector of at most the length 1 times N,
//! so that boxes with a jam are not excluded; they end as undecided, with that reason.
//!
//! Of cables and ropes alone the energy is convex, so that an equilibrium in a box is the only one
//! ([`SystemCensus::of_cables`]).
//!
//! Other nets with more motions than [`Settings::max_motions`](crate::Settings::max_motions) are
//! refused; what cannot be decided is listed.

mod activity;
mod arithmetic;
mod census;
mod coordinates;
mod curvature;
mod diagnosis;
mod equations;
mod family;
mod floor;
mod frame;
mod inverse;
mod jam;
mod krawczyk;
mod limit;
mod newton;
mod path;
mod prove;
mod proven;
mod side;
mod symmetry;
mod tolerances;
mod tube;
mod turns;

pub use census::{
    ChainCensus, LoadedRow, MAX_POSITIONS, NetCensus, Open, PartCensus, SystemCensus,
    SystemPosition, UndecidedPlaces, bridle_seconds,
};
pub use limit::{MAX_LIMIT_UNKNOWNS, prove_singular};
pub use path::{MAX_PATH_UNKNOWNS, PathProof, SingularKind, prove_path};
pub use prove::{MAX_UNKNOWNS, prove};
pub use proven::SystemBox;
pub use tolerances::{Depth, NoRanges, Range, ToleranceRanges, prove_ranges};
