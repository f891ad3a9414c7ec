//! All bars in tension.

use super::bracket::Bracket;
use super::newton::{Passes, Root, minimise};
use super::system::{Frame, System};

/// Solve by two nested searches on monotone functions: for each horizontal pull H the vertical force
/// that closes the height, and with it the H that closes the width. Both exist and are unique: the
/// height grows with the force from below $-L$ to above L, and the width, the derivative of the convex
/// $\min_v \Phi$, grows with H. Slower than Newton's method and not to be stopped; in upright axes.
pub(super) fn nested(
    system: &System<'_>,
    start: [f64; 2],
    enough: f64,
    passes: &mut Passes,
) -> Option<Root> {
    let Frame::Upright { .. } = system.frame else { return None };
    let mut force = start;
    let [floor_across, floor_up] = system.closure(start).floor;
    let scale = start[0].hypot(start[1]);
    // H over many orders of magnitude: search for its logarithm.
    Bracket::LINE.root(start[0].ln(), 1.0, floor_across, |log| {
        force[0] = log.exp();
        let height = |v: f64| {
            let closure = passes.spend().then(|| system.closure([force[0], v]))?;
            Some((closure.residual[1], closure.jacobian[2]))
        };
        force[1] = Bracket::LINE.root(force[1], scale, floor_up, height)?;
        let closure = passes.spend().then(|| system.closure(force))?;
        // Along the closed height dv/dH = -J12/J22.
        let [a, b, c] = closure.jacobian;
        Some((closure.residual[0], (a - b * b / c) * force[0]))
    })?;
    minimise(system, force, None, enough, passes)
}
