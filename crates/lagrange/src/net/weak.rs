//! Elastic members under weak loads: forces right to rounding, not only lengths.
//!
//! A strain of $10^{-9}$ taken from the difference of two lengths has seven digits left, and the
//! force no more. The elongation is therefore taken from
//!
//! $$ d - l = \frac{(d_x^2 + d_y^2 + d_z^2) - l^2}{d + l} $$
//!
//! with products and sums in twice the digits, in metres, at places that keep what rounding cut off:
//! anchors and lengths are those of the file to the last digit. In frames
//! with more elastic members than needed the forces follow from the elongations alone; Newton's
//! steps with the members' true stiffnesses bring both to agree.

use model::system::System;

use super::decided::Decided;
use super::framework::{Framework, Link};
use super::newton::{Derivative, Run};
use super::residual::Residual;
use super::state::State;
use super::stiffness::Stiffness;
use crate::condensed::sums::DoubleDouble;
use crate::larger::larger;
use crate::thresholds::{HALVED, ROUNDED, ZERO};

/// The run with the forces of elastic members settled to rounding.
pub(super) fn settled(
    system: &System,
    framework: &Framework,
    stiffness: &mut Stiffness,
    run: Run,
    mut decided: Option<&mut Decided>,
) -> Run {
    if framework.links.iter().all(|link| link.compliance <= 0.0) {
        return run;
    }
    let mut best = run;
    let mut misfits = exact_misfits(system, framework, &best, decided.as_deref_mut());
    let mut error = force_error(framework, &best, &misfits);
    if error <= ROUNDED {
        return best;
    }
    // Two or three steps are enough, of which each leaves a part of the error.
    loop {
        let Run { state, residual, .. } = &best;
        let derivative = Derivative::bordered(framework, stiffness, state, residual);
        let of = (best.residual.forces.as_slice(), misfits.as_slice());
        let step = derivative
            .and_then(|d| d.solve(framework, stiffness, of, ZERO, decided.as_deref_mut()));
        let Some((step, _)) = step else { break };
        let state = step.applied(&best.state, 1.0);
        let residual = Residual::within(framework, &state, decided.as_deref_mut());
        let next = Run { state, residual, steps: best.steps + 1 };
        let there = exact_misfits(system, framework, &next, decided.as_deref_mut());
        let left = force_error(framework, &next, &there);
        // NaN is no progress.
        if left.is_nan() || left >= HALVED * error {
            break;
        }
        (best, misfits, error) = (next, there, left);
    }
    best
}

/// Length by the law minus length of each taut member, without cancellation; of lengths that overdetermine the shape the part
/// that places decide.
fn exact_misfits(
    system: &System,
    framework: &Framework,
    run: &Run,
    decided: Option<&mut Decided>,
) -> Vec<f64> {
    let places = places_m(system, framework, &run.state);
    let misfit = |(k, link): (usize, &Link)| {
        // The spans of a rope are long beside what it is longer, and what is rigid beside them is as they are.
        let straight = link.rope.is_none() && k < framework.members();
        let exact = straight && (framework.ropes.is_empty() || link.compliance > 0.0);
        if exact && run.state.taut[k] && framework.moves(link) {
            let length_m = system.members()[k].body.length_m();
            let longer_m = elongation_m(&places[link.from], &places[link.to], length_m);
            link.compliance * run.state.axial[k] - longer_m / framework.units.length_m
        } else {
            run.residual.lengths[k]
        }
    };
    let misfits: Vec<f64> = framework.links.iter().enumerate().map(misfit).collect();
    match decided {
        Some(decided) => decided.part(framework, &misfits),
        None => misfits,
    }
}

/// A place in twice the digits.
type Place = [DoubleDouble; 3];

/// The places of a state, m; those of anchors are exact.
fn places_m(system: &System, framework: &Framework, state: &State) -> Vec<Place> {
    let units = framework.units;
    let place = |joint: usize| {
        let node = &framework.nodes[joint];
        let lies = framework.lying.iter().any(|lying| lying.joint == joint);
        let at_m = system.joints()[joint].support.at_m().filter(|_| !lies);
        std::array::from_fn(|axis| {
            let (base, at_m) = match at_m {
                Some(at_m) => (node.base[axis], at_m[axis]),
                None => (0.0, units.origin_m[axis]),
            };
            let moved = DoubleDouble::sum(state.places[joint][axis], -base);
            let moved = moved.plus(state.rests[joint][axis]);
            moved.times(DoubleDouble::sum(units.length_m, 0.0)).plus(at_m)
        })
    };
    (0..framework.nodes.len()).map(place).collect()
}

/// The largest error of a balance or of a member's force, in units of the largest force: of what is rigid a length that is off
/// is felt by the stiffest member beside it.
fn force_error(framework: &Framework, run: &Run, misfits: &[f64]) -> f64 {
    let elastic = framework.links.iter().map(|link| link.compliance).filter(|c| *c > 0.0);
    let stiffest = elastic.fold(f64::INFINITY, f64::min);
    let of_rigid = if framework.ropes.is_empty() { stiffest } else { f64::INFINITY };
    let compliance = |link: &Link| if link.compliance > 0.0 { link.compliance } else { of_rigid };
    let links = framework.links.iter().zip(misfits);
    let forces = links.map(|(link, off)| off.abs() / compliance(link) / run.residual.unit);
    forces.fold(run.residual.balance.0, larger)
}

/// How much longer than unstretched a member is, right to rounding of this small number.
fn elongation_m(from: &Place, to: &Place, length_m: f64) -> f64 {
    let square = DoubleDouble::product(length_m, length_m).negate();
    let spans = from.iter().zip(to).map(|(from, to)| to.add(from.negate()).square());
    let difference = spans.fold(square, DoubleDouble::add).value();
    let length = (length_m * length_m + difference).sqrt();
    difference / (length + length_m)
}

#[cfg(test)]
mod tests;
