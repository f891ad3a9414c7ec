//! Relaxation: viscous motion of the chain, where Newton's method has stopped at a local minimum of
//! the residual.
//!
//! Such minima exist (all bars on one straight line, for one: to first order no turn changes the
//! distance of the ends), and no damping helps there. On the paper's chain 4 % of random planar
//! seeds end so, nine in ten of them with all bars vertical, and 2 % of spatial ones. A chain does
//! not mind them. With the inertia in the equation of motion (33) replaced by friction,
//!
//! $$ \dot\alpha = \mathbf{B}^T\lambda + \mathbf{T}, \qquad f = 0, $$
//!
//! it falls until it rests. Large implicit steps of this motion with a step length τ that grows as
//! the residual falls (pseudo-transient continuation), the multipliers estimated in each, bring it
//! near enough for Newton's method. A step counts if the weights do work, or the gap at the
//! last anchor closes: an exact penalty function, so that the motion cannot run in circles.
//!
//! T. S. Coffey, C. T. Kelley, D. E. Keyes, SIAM J. Sci. Comput. 25 (2003) 553-569,
//! doi:10.1137/S106482750241044X; S.-P. Han, J. Optim. Theory Appl. 22 (1977) 297-309,
//! doi:10.1007/BF00932858

use nalgebra::{Complex, Vector3};

use crate::full::reduced::Reduced;
use crate::thresholds::{CLOSURE_ROUNDING, EARNED, HALVINGS};

/// The step length grows as the residual falls, at most by this factor, ...
const FASTEST_GROWTH: f64 = 3.0;
/// ... and shrinks by this one when a step was cut, or at most when the residual rises.
const CUT: f64 = 0.5;
/// No bar turns by more than this in one step, rad: the steps are linear.
const LARGEST_TURN: f64 = 0.5;
/// A penalty above the multipliers is exact; twice as much leaves room for their errors.
const PENALTY: f64 = 2.0;

/// Relax from where `chain` is until the norm of the residual is below `handover`, at most `limit`
/// steps; how many it took.
pub(crate) fn relax(chain: &mut Reduced, handover: f64, limit: usize) -> usize {
    // In units in which weight, length and friction are one.
    let (mut tau, mut penalty) = (1.0, 1.0_f64);
    chain.choose_unit();
    let mut norm = chain.norm();
    for step in 0..limit {
        if norm.is_nan() || norm <= handover {
            return step;
        }
        let gap = chain.here.closure.norm();
        viscous_step(chain, tau, gap);
        let slope = slope(chain, &mut penalty, gap);
        let cut = take(chain, penalty, slope);
        chain.leave_gimbal_lock(chain.lock_margin);
        chain.estimate();
        let before = std::mem::replace(&mut norm, chain.norm());
        tau *= if cut { CUT } else { (before / norm).clamp(CUT, FASTEST_GROWTH) };
    }
    limit
}

/// Implicit step of the motion over the time τ. The shift of the closure lets a gap close in a few
/// steps instead of one: near a straight line one would be a leap.
fn viscous_step(chain: &mut Reduced, tau: f64, gap: f64) {
    let bars = chain.here.bars.iter().zip(&chain.mechanism.lengths);
    let stretch: f64 = bars.map(|(bar, length)| length * bar.force.dot(&bar.u).max(0.0)).sum();
    chain.matrix.assemble_stretched(&chain.here);
    chain.matrix.solve_shifted(
        Complex::new(-1.0 / tau, 0.0),
        Complex::new(gap / (1.0 / tau + stretch), 0.0),
    );
}

/// Slope of the merit, − work + penalty · gap, along the step; raises the penalty until it falls.
fn slope(chain: &Reduced, penalty: &mut f64, gap: f64) -> f64 {
    let (mut work, mut end) = (0.0, Vector3::zeros());
    for (step, weight) in chain.matrix.moves().zip(&chain.carried) {
        work += weight * step.z;
        end += step;
    }
    let closing = if gap > 0.0 { -chain.here.closure.dot(&end) / gap } else { 0.0 };
    let multiplier = (chain.here.pull + chain.matrix.pull_step).norm();
    *penalty = penalty.max(PENALTY * multiplier);
    if closing > 0.0 {
        *penalty = penalty.max(-PENALTY * work / closing);
    }
    -work - *penalty * closing
}

/// Take as much of the step as lowers the merit; whether it had to be cut for that.
fn take(chain: &mut Reduced, penalty: f64, slope: f64) -> bool {
    let merit = |chain: &Reduced, there: bool| {
        let point = if there { &chain.there } else { &chain.here };
        penalty * point.closure.norm() - point.work(&chain.mechanism, &chain.carried)
    };
    let start = merit(chain, false);
    let largest = chain.matrix.turns().fold(0.0, |largest: f64, turn| largest.max(turn.norm()));
    let mut part = if largest > LARGEST_TURN { LARGEST_TURN / largest } else { 1.0 };
    let mut cut = false;
    // Shorter than that it is taken as it is.
    for _ in 0..HALVINGS {
        chain.advance(part);
        if merit(chain, true) <= start + EARNED * part * slope + CLOSURE_ROUNDING * penalty {
            break;
        }
        part *= CUT;
        cut = true;
    }
    chain.stay();
    cut
}

#[cfg(test)]
mod tests;
