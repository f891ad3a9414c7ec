//! Elastic members under weak loads: forces right to rounding, not only lengths.
//!
//! A strain of $10^{-9}$ taken from the difference of two lengths has seven digits left, and the
//! force no more. The elongation is therefore taken from
//!
//! $$ d - l = \frac{(d_x^2 + d_y^2 + d_z^2) - l^2}{d + l} $$
//!
//! with products and sums in twice the digits, at places that keep what rounding cut off. In frames
//! with more elastic members than needed the forces follow from the elongations alone; Newton's
//! steps with the members' true stiffnesses bring both to agree.

use model::system::{Joint, System};
use nalgebra::Vector3;

use super::framework::{Framework, Link};
use super::newton::{Derivative, Run};
use super::residual::Residual;
use super::state::{State, two_sum};
use super::stiffness::Stiffness;

/// Steps at most; two or three are enough.
const ROUNDS: usize = 8;

/// A step must leave less than this part of the error.
const PROGRESS: f64 = 0.5;

/// What a linear solve leaves of the errors.
const SOLVED: f64 = 1e-9;

/// The run with the forces of elastic members settled to rounding.
pub(super) fn settled(
    system: &System,
    framework: &Framework,
    stiffness: &mut Stiffness,
    run: Run,
) -> Run {
    if framework.links.iter().all(|link| link.compliance <= 0.0) {
        return run;
    }
    let cut = cut_off_supports(system, framework);
    let mut best = run;
    let mut misfits = exact_misfits(framework, &cut, &best);
    let mut error = force_error(framework, &best, &misfits);
    for _ in 0..ROUNDS {
        if error <= 0.0 {
            break;
        }
        let derivative = Derivative::elastic(framework, stiffness, &best.state, &best.residual);
        let of = (best.residual.forces.as_slice(), misfits.as_slice());
        let step = derivative.and_then(|d| d.solve(framework, stiffness, of, SOLVED));
        let Some((step, _)) = step else { break };
        let state = step.applied(&best.state, 1.0);
        let residual = Residual::new(framework, &state);
        let next = Run { state, residual, steps: best.steps + 1 };
        let there = exact_misfits(framework, &cut, &next);
        let left = force_error(framework, &next, &there);
        // NaN is no progress.
        if left.is_nan() || left >= PROGRESS * error {
            break;
        }
        (best, misfits, error) = (next, there, left);
    }
    best
}

/// Length by the law minus length of each taut member, without cancellation where it is elastic.
fn exact_misfits(framework: &Framework, cut: &[Vector3<f64>], run: &Run) -> Vec<f64> {
    let misfit = |(k, link): (usize, &Link)| {
        if link.compliance > 0.0 && run.state.taut[k] && framework.moves(link) {
            link.compliance * run.state.axial[k]
                - elongation(link, &run.state, &(cut[link.to] - cut[link.from]))
        } else {
            run.residual.lengths[k]
        }
    };
    framework.links.iter().enumerate().map(misfit).collect()
}

/// What rounding cuts off the places of supports when they are measured from the origin.
fn cut_off_supports(system: &System, framework: &Framework) -> Vec<Vector3<f64>> {
    let units = framework.units;
    let cut = |joint: &Joint| {
        let at_m = joint.support.at_m().unwrap_or(units.origin_m.into());
        let cut = |axis: usize| two_sum(at_m[axis], -units.origin_m[axis]).1 / units.length_m;
        Vector3::from_fn(|axis, _| cut(axis))
    };
    system.joints().iter().map(cut).collect()
}

/// The largest error of a balance or of an elastic member's force, in units of the largest force.
fn force_error(framework: &Framework, run: &Run, misfits: &[f64]) -> f64 {
    let elastic = framework.links.iter().zip(misfits).filter(|(link, _)| link.compliance > 0.0);
    let forces = elastic.map(|(link, misfit)| misfit.abs() / link.compliance / run.residual.unit);
    forces.fold(
        run.residual.balance.0,
        |a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) },
    )
}

/// How much longer than unstretched a member is, right to rounding of this small number.
/// `off` is what the places leave out of the span.
fn elongation(link: &Link, state: &State, off: &Vector3<f64>) -> f64 {
    let (mut square, mut rest) = negative_square(link.length);
    for axis in 0..3 {
        let (from, to) = (link.from, link.to);
        let (span, cut) = two_sum(state.places[to][axis], -state.places[from][axis]);
        let cut = cut + (state.rests[to][axis] - state.rests[from][axis]) + off[axis];
        let (span, cut) = two_sum(span, cut);
        let product = span * span;
        let below = span.mul_add(span, -product) + 2.0 * span * cut;
        let (sum, lost) = two_sum(square, product);
        (square, rest) = (sum, rest + lost + below);
    }
    let difference = square + rest;
    let length = (link.length * link.length + difference).sqrt();
    difference / (length + link.length)
}

/// `-l²` in twice the digits.
fn negative_square(length: f64) -> (f64, f64) {
    let square = length * length;
    (-square, -length.mul_add(length, -square))
}

#[cfg(test)]
mod tests;
