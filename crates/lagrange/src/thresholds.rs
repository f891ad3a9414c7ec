//! Where decisions turn, and why there.
//!
//! Every threshold that tells one way of solving, one kind of equilibrium or one remark on it from
//! another stands here, and so do bounds that several iterations share; constants of one iteration (how far
//! a step may go, when to give up) stand with it, and those of nets with their modules. All are set against
//! the unit roundoff u, the part of its result by which one operation on doubles errs at most, 1.1e-16, and the
//! digits that the steps before them keep.

/// Rounding of a closure, in parts of the terms that are added: a few u for each of direction,
/// product and sum. Compensated sums keep it there for any number of bars. Lengths, sums of lengths and
/// distances that differ by less than this part are equal, and changes of other sums by so little are none.
pub(crate) const CLOSURE_ROUNDING: f64 = 4.0 * f64::EPSILON;

/// Slack, in total lengths, below which a chain is nearly straight and its closure is balanced
/// along an axis: with a closure known to $8u$, upright axes would leave less than 12 digits of the
/// slack.
pub(crate) const NEARLY_STRAIGHT: f64 = 1e-3;

/// A gap this near to the length of the bottom bar, in total lengths, is summed again to twice the
/// digits: the plain sum of a million bars may err by $10^6 u$.
pub(crate) const RECHECKED_GAP: f64 = 1e-10;

/// Loads smaller than this beside the largest are zero: their cubes would underflow in units of it.
pub(crate) const NO_LOAD: f64 = 1e-100;

/// Bars nearer to the vertical than this, rad, are upright. A versine of u belongs to an angle of
/// $\sqrt{2u}$ = 1.5e-8; the sums over many bars lose up to two digits more.
pub(crate) const UPRIGHT: f64 = 1e-6;

/// A balance of small terms may stop at this many of its rounding errors: 1e-8 of the slack, which
/// leaves half of the digits of a force.
pub(crate) const SLACK_ROUNDINGS: f64 = 1e7;

/// Singular values below this part of the largest are zero. At a state converged to 1e-13 the zero
/// ones come out at 1e-16 to 1e-13 and the smallest of the others, up to a hundred bars, above
/// 1e-7.
pub(crate) const ZERO_SINGULAR_VALUE: f64 = 1e-10;

/// Part of the promised decrease that a step must earn (Armijo's rule).
pub(crate) const EARNED: f64 = 1e-4;

/// 1 over the golden ratio: the fractions of its multiples are spread without pattern.
pub(crate) const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// What a search leaves of forces, loads, strains, lengths and energies, over the largest; and curvatures, eigenvalues and
/// components of directions that are zero: a state is known to 1e-13, divided by the smallest axial forces met, 1e-3 of the
/// largest and less. Less is none, and more is seen, as by two solvers that are asked to agree.
pub(crate) const ZERO: f64 = 1e-9;

/// What rounding leaves of a solve at best, over the largest, with room.
pub(crate) const ROUNDED: f64 = 1e-13;

/// Lengths, and loads, of a file that differ by less than this part are equal; and axial forces, and pivots of the
/// closure's derivative, that are so small beside the largest, or beside the terms of which they are the difference, are zero:
/// forces are known to some 1e-13, and the terms carry some $10^4 u$ where large forces cancel.
pub(crate) const GIVEN: f64 = 1e-12;

/// Residuals, gaps and errors of lengths at which a state is near enough to read its signs, or to begin from: far above
/// rounding, so that a wrong sign costs few steps, and far below the forces that are likely.
pub(crate) const SEEN: f64 = 1e-6;

/// An error, or a slope along a step, that has fallen to this part has become better.
pub(crate) const BETTER: f64 = 0.9;

/// A step, or a few, ought to leave at most this part.
pub(crate) const HALVED: f64 = 0.5;

/// Shortest part of a step that is tried, or leads on.
pub(crate) const SHORTEST: f64 = 1e-3;

/// Steps of an iteration at most: some twelve are the rule, also for nets of 20,000 members.
pub(crate) const MOST_STEPS: usize = 100;

/// A step is halved at most so many times.
pub(crate) const HALVINGS: usize = 30;

/// A drawing is rounded to three digits: stiff members that miss their lengths by more than this part are closed first, a cable that
/// is shorter by more is slack, and a joint lies on the floor within this part of its shortest member. Stiff are those that the
/// mean load stretches by no more.
pub(crate) const MISDRAWN: f64 = 1e-3;

/// What misses its length in a drawing by more than this part is not rounded but loose.
pub(crate) const LOOSE: f64 = 0.1;
