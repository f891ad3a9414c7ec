//! One Newton step of all lanes.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

use super::lanes::{LANES, LARGEST_ANGLE, Lanes, each};
use super::numbers::Bar;
use crate::full::multipliers::REGULARISATION;
use crate::thresholds::GOLDEN;

/// One bar in all lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct State {
    /// Where the next step starts.
    pub angle: Lanes,
    /// Sine and cosine of the angle at which the last step was computed.
    pub sin: Lanes,
    pub cos: Lanes,
    /// $t_i \cdot F_i$ there, and then the turn in the step.
    pub moment: Lanes,
    /// $1/N_i$ there.
    pub inverse: Lanes,
}

impl State {
    pub const ZERO: Self = Self {
        angle: Lanes::ZERO,
        sin: Lanes::ZERO,
        cos: Lanes::ZERO,
        moment: Lanes::ZERO,
        inverse: Lanes::ZERO,
    };
}

/// What the lanes have besides their bars.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Common {
    /// Where the next step starts.
    pub pull: [Lanes; 2],
    /// The pull at which the last step was computed.
    pub pull_before: [Lanes; 2],
    /// Steps taken.
    pub count: [u32; LANES],
    /// Whether the residual was still large at the last step.
    pub far: [bool; LANES],
}

/// Every how many steps the plain Newton step is taken, and the multipliers are estimated again
/// while the residual is large.
const PLAIN_EVERY: u32 = 8;

/// Largest turn of a bar in a step, rad, in turn. On random chains of 2 to 8 bars a limit of 1.5
/// with plain steps in between needed the fewest steps of those tried (0.5 to infinity); it is
/// varied, by the fractions of multiples of the golden ratio, since with a constant limit some
/// seeds circle for ever.
const LIMITS: [f64; 32] = limits();

/// A plain step turns no bar further than this, rad: it keeps the angles, after as many steps as
/// there may be, within the range of the sine. Farther than a turn a step leads nowhere in
/// particular anyway.
const PLAIN: f64 = 8.0;

const fn limits() -> [f64; 32] {
    let mut limits = [0.0; 32];
    let mut fraction = 0.0;
    let mut k = 0;
    while k < 32 {
        fraction += GOLDEN;
        if fraction >= 1.0 {
            fraction -= 1.0;
        }
        limits[k] =
            if (k + 1) % (PLAIN_EVERY as usize) == 0 { PLAIN } else { 1.1 + 0.8 * fraction };
        k += 1;
    }
    limits
}

/// Steps allowed at most: the angles then stay within the range of the sine.
pub(crate) const MOST_ALLOWED: u32 = 60_000;
const _: () = assert!(MOST_ALLOWED as f64 * PLAIN < LARGEST_ANGLE);

/// An axial force smaller than this is taken for this one: it keeps the quotients finite.
const LEAST_AXIAL: f64 = 1e-30;

/// Turn of bar i, in multiples of i + 1, where the Newton step is undefined, rad.
const PERTURBATION: f64 = 0.01;

/// Limits of one step in the lanes.
#[inline(always)]
fn limit(count: &[u32; LANES]) -> Lanes {
    Lanes(each(|k| LIMITS[count[k] as usize % LIMITS.len()]))
}

/// Judge the point of every lane, whether every equation is below the tolerance there, and step on from it.
///
/// `bars` and `states` have equal lengths; with constant length the loops are unrolled.
#[inline(always)]
pub(crate) fn step(
    bars: &[Bar],
    span: [f64; 2],
    tolerance: f64,
    states: &mut [State],
    common: &mut Common,
) -> [bool; LANES] {
    for state in states.iter_mut() {
        (state.sin, state.cos) = state.angle.sin_cos();
    }
    let estimated: [bool; LANES] = each(|k| {
        common.count[k] == 0 || (common.far[k] && common.count[k].is_multiple_of(PLAIN_EVERY))
    });
    if estimated.contains(&true) {
        let estimate = estimate(bars, states);
        for (pull, estimate) in common.pull.iter_mut().zip(estimate) {
            *pull = Lanes::select(estimated, estimate, *pull);
        }
    }
    let [across, up] = common.pull;
    let (mut gap, mut matrix) = ([-Lanes::all(span[0]), -Lanes::all(span[1])], [Lanes::ZERO; 3]);
    let (mut right, mut moments) = ([Lanes::ZERO; 2], Lanes::ZERO);
    for (bar, state) in bars.iter().zip(states.iter_mut()) {
        let length = Lanes::all(bar.length);
        let (sin, cos) = (state.sin, state.cos);
        let force = up + Lanes::all(bar.carried);
        state.moment = cos * across + sin * force;
        let axial = sin * across - cos * force;
        let tiny = axial.abs().at_most(Lanes::all(LEAST_AXIAL));
        state.inverse = Lanes::all(1.0) / Lanes::select(tiny, Lanes::all(LEAST_AXIAL), axial);
        gap[0] = gap[0] + length * sin;
        gap[1] = gap[1] - length * cos;
        let weight = length * state.inverse;
        let (along, lift) = (weight * cos, weight * sin);
        matrix[0] = matrix[0] + along * cos;
        matrix[1] = matrix[1] + along * sin;
        matrix[2] = matrix[2] + lift * sin;
        right[0] = right[0] + along * state.moment;
        right[1] = right[1] + lift * state.moment;
        moments = moments.larger((length * state.moment).abs());
    }
    let converged = judge(bars.len(), tolerance, common, &gap, moments);
    let change = solve(matrix, [gap[0] + right[0], gap[1] + right[1]]);

    let (mut largest, mut sum) = (Lanes::ZERO, Lanes::ZERO);
    for state in states.iter_mut() {
        let turn = (state.moment - (state.cos * change[0] + state.sin * change[1])) * state.inverse;
        largest = turn.abs().larger(largest);
        sum = sum + turn.abs();
        state.moment = turn;
    }
    let limit = limit(&common.count);
    let shorter = Lanes::select(largest.at_most(limit), Lanes::all(1.0), limit / largest);
    // A sum keeps what is no number; infinite turns are as undefined.
    let defined = sum.at_most(Lanes::all(f64::MAX));
    for (k, state) in states.iter_mut().enumerate() {
        let perturbation = Lanes::all(PERTURBATION * (k + 1) as f64);
        state.angle = state.angle + Lanes::select(defined, shorter * state.moment, perturbation);
    }
    common.pull_before = common.pull;
    for (pull, change) in common.pull.iter_mut().zip(change) {
        *pull = *pull - Lanes::select(defined, shorter * change, Lanes::ZERO);
    }
    for count in &mut common.count {
        *count += 1;
    }
    converged
}

/// Compare the residual with the tolerance, in squares: moments against the largest force times the
/// mean length, the gap against the total length.
#[inline(always)]
fn judge(
    bars: usize,
    tolerance: f64,
    common: &mut Common,
    gap: &[Lanes; 2],
    moments: Lanes,
) -> [bool; LANES] {
    /// Above this the residual is large.
    const FAR: f64 = 1e-2;
    let mean = 1.0 / bars as f64;
    let [across, up] = common.pull;
    let last = up + Lanes::all(1.0);
    let upright = (up * up).larger(last * last);
    let force = (across * across + upright).larger(Lanes::all(mean * mean));
    let unit = force * Lanes::all(mean * mean);
    let moments = moments * moments;
    let gap = gap[0] * gap[0] + gap[1] * gap[1];
    let below = |tolerance: f64| {
        let square = Lanes::all(tolerance * tolerance);
        let (balanced, closed) = (moments.at_most(unit * square), gap.at_most(square));
        each(|k| balanced[k] & closed[k])
    };
    let near = below(FAR);
    common.far = each(|k| !near[k]);
    below(tolerance)
}

/// The pull for which the moments are least, $\sum l_i (t_i\cdot F_i)^2 \to \min$, with a faint
/// preference for equal reactions: that of `solve_from`, in the plane.
#[inline(always)]
fn estimate(bars: &[Bar], states: &[State]) -> [Lanes; 2] {
    let regularisation = Lanes::all(REGULARISATION);
    let mut matrix = [regularisation, Lanes::ZERO, regularisation];
    let mut right = [Lanes::ZERO, Lanes::all(0.5) * regularisation];
    for (bar, state) in bars.iter().zip(states) {
        let along = Lanes::all(bar.length) * state.cos;
        let lift = Lanes::all(bar.length) * state.sin;
        matrix[0] = matrix[0] + along * state.cos;
        matrix[1] = matrix[1] + along * state.sin;
        matrix[2] = matrix[2] + lift * state.sin;
        let load = Lanes::all(bar.carried) * state.sin;
        right[0] = right[0] + load * along;
        right[1] = right[1] + load * lift;
    }
    let pull = solve(matrix, right);
    [-pull[0], -pull[1]]
}

/// Solution of the symmetric system with the matrix `[[a, b], [b, d]]`.
#[inline(always)]
fn solve([a, b, d]: [Lanes; 3], [x, y]: [Lanes; 2]) -> [Lanes; 2] {
    let inverse = Lanes::all(1.0) / (a * d - b * b);
    [(d * x - b * y) * inverse, (a * y - b * x) * inverse]
}
