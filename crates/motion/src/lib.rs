//! The motion of systems of bars: sections V and VI of the paper, for any system, in coordinates
//! without gimbal lock.
//!
//! ```
//! // The paper's chain, released at rest with its first bar hanging: after a second the energy is
//! // what it was, and Newton's and Euler's laws hold for every bar.
//! let system = model::system::System::from(model::cases::paper().chain());
//! let half = 0.75_f64.sqrt();
//! let at = [[0.0; 3], [0.0, 0.0, -1.0], [0.0, half, -1.5], [0.0, 0.0, -2.0]];
//! let mut chain = motion::Simulation::new(&system, &at, motion::Settings::default())?;
//! let energy_j = chain.energy_j();
//! for _ in 0..1000 {
//!     chain.step(1e-3)?;
//! }
//! assert!((chain.energy_j() - energy_j).abs() < 1e-4);
//! assert!(chain.snapshot().laws.largest() < 1e-12);
//! # Ok::<(), motion::MotionError>(())
//! ```
//!
//! # The equations
//!
//! The coordinates are the places of the joints (*natural coordinates*). A bar with ball joints has
//! the kinetic energy of its end velocities with a constant 2 × 2 matrix for each axis
//! ([`EndInertia`]); its weight and forces are lumped to its ends by the lever rule, which is
//! exact; that it is rigid is one quadratic constraint. With `d = x_b − x_a`:
//!
//! $$ M \ddot x + R(x)^T \rho = f(x, \dot x, t), \qquad g_e = \tfrac12 (d_e^2 - l_e^2) = 0, \qquad
//!    R \dot x = 0, \qquad R \ddot x = -|\dot d_e|^2 . $$
//!
//! The multiplier `ρ_e` is the force density of the bar: its axial force over its length, tension
//! positive.
//!
//! A member is the case of one span of what a rope over rings and pulleys is with several, between
//! joints that it slides over without friction: with the sum `s` of the spans `d_i`, along the unit
//! vectors `u_i`,
//!
//! $$ g_e = \tfrac12 (s^2 - l_e^2), \qquad
//!    \dot g_e = s \sum_i u_i \cdot \dot d_i, \qquad
//!    R \ddot x = -\Bigl(\sum_i u_i \cdot \dot d_i\Bigr)^2
//!    - s \sum_i \frac{|\dot d_i|^2 - (u_i \cdot \dot d_i)^2}{|d_i|}, $$
//!
//! with the tension `ρ_e s` in every span. Where a ring runs to the end of its span (a weight to its
//! pulley) the span has no direction, and the motion ends with [`MotionError::Jammed`].
//!
//! | paper | code | shape | unit | equation |
//! |---|---|---|---|---|
//! | `{q}`: centres and angles | places of the joints, `at` | 3 per joint | m | (21) |
//! | `[M]`, `[Q]ᵀ[J][Q]` | `mass`, `EndInertia` (constant) | 1 per joint, 1 per member | kg | (31), (32) |
//! | `[B]` | `vectors` `d_e` of the rows of `R` | 3 per row | m | (22) |
//! | `{λ}` | `rho`; joint forces of the paper's meaning in [`Snapshot`] | 1 per row | N/m | (33) |
//! | `{F_q}` | `load`, `force` | 3 per joint | N | (34)-(36) |
//! | `{F̃_q}` | none: `M` is constant | - | - | (37)-(39) |
//! | `−[Ḃ]{q̇}` | `−\|ḋ_e\|²` | 1 per row | m²/s² | (33) |
//!
//! # The integrator
//!
//! RATTLE: symplectic and symmetric, so that the energy of an undamped motion stays within a band
//! of the order `h²` for any number of steps, and constraints hold for places and velocities at
//! every step to [`CONSTRAINT_TOLERANCE`]. An energy-momentum scheme would keep the energy itself
//! at the price of phase errors of the same order and of a nonlinear system with the springs in it.
//! [`Order::Fourth`] composes five steps, [`Order::Eighth`] seventeen. A step that is too long for the
//! oscillations of elastic members is taken in parts ([`Simulation::longest_step_s`]).
//!
//! The linear system of a step is eliminated from the leaves of the system to its root, in O(n)
//! where every loop runs through an anchor (chains, trees, spiders), by a sparse factorisation
//! elsewhere. Where bars are about to lie on one taut line the constraints nearly depend on each
//! other; there the O(n) elimination takes reflections for products and the corrections of a step
//! are Newton's, so that a motion passes positions with more freedoms on the branch it is on. One
//! that begins exactly there is refused: it may leave on any branch.
//!
//! # What it is held against
//!
//! | motion | reference | apart | test |
//! |---|---|---|---|
//! | simple pendulum, A01 of the IFToMM library | elliptic functions; the library's digits | 1e-12 m | `pendulum` |
//! | double pendulum, 10 s | Taylor series in 31 digits | 2e-12 m | `taylor` |
//! | N-four-bar, A02, N = 2 and 40, 20 s | the pendulum of its parallelogram branch | 3e-11 m, at most 2.3e-10 for other N and steps | `four_bars` |
//! | Andrews' squeezing mechanism | the test set for initial value problems | 1e-9 rad of 15.8 | `squeezer` |
//! | open and closed chains in space, three moments | an adaptive method on Newton's and Euler's equations | 1e-13 to 2e-10 m | `second_opinion`, `spinning` |
//! | forces and moments of time, damping | the same | 2e-11 m | `forced` |
//! | falling folded chain | the theory that keeps the energy, which experiments confirm | 0.4 % of the velocity | `folded` |
//! | a level chain let go | its end falls as a free body, as in experiments | 6e-7 of the fall | `folded` |
//! | a weight on an elastic cord that goes slack, and on a prop | free fall and harmonic motion, joined | 8e-7 m | `slack` |
//! | falls caught by cables, props and a floor; weights that catch each other | closed forms | times 1e-11 s, losses 1e-9 J (1e-6 where a step lets go) | `impacts` |
//! | small oscillations of bars with three moments | motions of small amplitude; compound and bifilar pendulum | 2e-6 of the amplitude; 1e-12 | `unequal` |
//! | of what taut cables and a floor hold | closed forms | 1e-13 | `held` |
//! | ropes over rings and pulleys: weights, tackles, a ring on its ellipse, impacts; oscillations | closed forms, Runge and Kutta, second differences of lengths | 1e-9 m; 1e-12, 1e-7 | `ropes` |
//! | small oscillations | closed forms and polynomials, in intervals | inside the enclosures, 1e-12 wide | `enclosed` |
//! | open and closed chains, 3 to 300 bars | MuJoCo, Pinocchio, Exudyn | within their errors | `benches/peers/motion` |
//!
//! # Impacts
//!
//! Inextensible cables and struts and the floor hold on one side alone. What they take when they
//! become taut, or when a joint meets the floor, is lost: impacts are perfectly plastic
//! ([`Impact`]), which is a choice, as no equilibrium knows a law of impact, and the one that loses
//! most without friction. In steps with impacts the energy is off by an order more than in others.
//! Two gaps that close within one step and open again in it are not seen. Elastic cables and struts
//! go slack and taut by their potential `EA/(2l) max(0, e)²` without an impact. Where what holds at
//! one time does not determine its impulses, as taut cables around a field that lies on the floor,
//! the motion ends with [`MotionError::Redundant`].
//!
//! # What is left out
//!
//! Joints without any inertia are refused: their acceleration is indeterminate. Where the two
//! moments across a bar are equal its spin is apart, and a bar without spin never gets any; where
//! they differ the bar has four points for two ([`Turning`]), and begins without spin, its second
//! axis level. Modes are about the same position, of any body; one in motion may not be flat. Modes
//! need cables and struts that are certainly taut or slack, and joints that are certainly pushed by
//! the floor or above it.

mod assemble;
mod composition;
mod contacts;
mod corners;
mod damping;
mod enclosed;
mod error;
mod force;
mod impacts;
mod inertia;
mod krylov;
mod laws;
mod mechanism;
mod modes;
mod order;
mod rattle;
mod saddle;
mod settings;
mod simulation;
mod snapshot;
mod stable;
mod state;
mod unequal;
mod unilateral;

pub use assemble::{assemble, random_places, random_position};
pub use contacts::{Contact, Impact, has_impacts};
pub use corners::Turning;
pub use enclosed::{Enclosures, EquilibriumBox, MOST_ENCLOSED_JOINTS, NotEnclosed, enclose_modes};
pub use error::MotionError;
pub use force::ForceOfTime;
pub use inertia::EndInertia;
pub use laws::Laws;
pub use mechanism::Mechanism;
pub use modes::{Direction, Mode, Modes, What, lowest_modes, modes};
pub use rattle::CONSTRAINT_TOLERANCE;
pub use settings::{Order, Settings};
pub use simulation::{CLOSED_TOLERANCE, Simulation};
pub use snapshot::Snapshot;
