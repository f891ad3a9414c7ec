use model::{Problem, Reactions, Sum, Vector};

use crate::error::Error;
use crate::lever;
use crate::run::frame::WORLD_UP;
use crate::run::minimise::descend;
use crate::run::scaled_chain::{ScaledChain, Units};
use crate::run::settings::{Motion, Settings};
use crate::run::slope::Slope;
use crate::run::solution::Solution;
use crate::run::vertical_plane::Turn;
use crate::vector::{along, scaled};

/// The force at every joint, world frame, N, in the order of the paper's multipliers.
///
/// Virtual work. Cut the chain at joint *k* and hold the part before it there: its least energy as
/// a function of the place of the cut has the derivative `F_k`, the force that the rest of the
/// chain exerts on it. The energy of the part is that of the whole with the weight `W_k` of the
/// bars after the cut taken off every bar, so its multiplier is that of the whole plus `W_k up`,
/// and
///
/// $$F_k = \frac{\partial V_k^\*}{\partial P_k} = -\mu - W_k\\, \hat z .$$
///
/// At *k* = *n* this is the reaction `dV*/dD` of the end anchor; entry 0 is the force of the ground
/// on the first bar, which carries what the end does not.
pub(crate) fn joint_forces(problem: &Problem, units: &Units, slope: &Slope) -> Vec<Vector> {
    let mu = units.frame.into_world(slope.multiplier);
    let lift = match units.origin {
        Some(origin) => lift_from(problem, origin.bar),
        None => lift_from_middle(problem),
    };
    let mut forces: Vec<Vector> = lift
        .iter()
        .map(|&w| scaled(units.weight_n, along(scaled(-1.0, mu), w, WORLD_UP)))
        .collect();
    forces[0] = scaled(units.weight_n, along(mu, -lift[0], WORLD_UP));
    forces
}

/// What to add to minus the multiplier at each joint, in units of the weight: the multiplier of the
/// shifted energy (see `ScaledChain`) is mu + up / 2, so half the weight before the cut, less half the
/// weight after it.
fn lift_from_middle(problem: &Problem) -> Vec<f64> {
    let (bars, mass_kg) = (problem.chain().bars(), problem.chain().total_mass_kg());
    let mut lift = vec![0.0; bars.len() + 1];
    let mut before = Sum::default();
    for (k, bar) in bars.iter().enumerate() {
        before.add(bar.mass_kg() / mass_kg);
        lift[k + 1] += 0.5 * before.value();
    }
    let mut after = Sum::default();
    for (k, bar) in bars.iter().enumerate().rev() {
        lift[k + 1] -= 0.5 * after.value();
        after.add(bar.mass_kg() / mass_kg);
    }
    lift[0] = -0.5;
    lift
}

/// The same where the weights are counted from a bar: what of them is between it and the joint,
/// negative before it.
pub(crate) fn lift_from(problem: &Problem, origin: usize) -> Vec<f64> {
    let (bars, mass_kg) = (problem.chain().bars(), problem.chain().total_mass_kg());
    let part = bars[origin].mass_kg() / mass_kg;
    let mut lift = vec![0.0; bars.len() + 1];
    let (before, after) = lift.split_at_mut(origin + 1);
    let mut between = Sum::default();
    between.add(part * lever::at_last(&bars[origin]));
    for (k, lift) in after.iter_mut().enumerate() {
        *lift = between.value();
        between.add(bars.get(origin + 1 + k).map_or(0.0, |bar| bar.mass_kg() / mass_kg));
    }
    let mut between = Sum::default();
    between.add(part * lever::at_first(&bars[origin]));
    for (joint, lift) in before.iter_mut().enumerate().rev() {
        *lift = -between.value();
        between.add(joint.checked_sub(1).map_or(0.0, |bar| bars[bar].mass_kg() / mass_kg));
    }
    lift
}

pub(crate) fn axial_forces(units: &Units, slope: &Slope) -> Vec<f64> {
    slope.axial.iter().map(|n| n * units.weight_n).collect()
}

/// The reactions among the joint forces.
pub(crate) fn reactions(forces: &[Vector]) -> Reactions {
    let none = [0.0; 3];
    Reactions {
        start: forces.first().copied().unwrap_or(none),
        end: forces.last().copied().unwrap_or(none),
    }
}

/// Largest displacement of the end anchor over the length that the chain has to spare: the least
/// energy varies over that length.
const STEP: f64 = 1.0 / 256.0;

/// The force of the ground on the chain at its end anchor, world frame, N, without any multiplier:
/// the chain is minimised again with the anchor displaced a little to either side, along three
/// axes, and the least energies are differenced and extrapolated (Richardson).
///
/// $$R_D = + \frac{\partial V^\*}{\partial D}$$
///
/// since the work of the force of the ground is what the chain gains; the force of the chain on the
/// ground is `-dV*/dD`. The branch of the given equilibrium is followed: displacements in its own
/// vertical plane are minimised in that plane. (About anchors on one vertical the least energy *in
/// space* has a ridge: with the anchor displaced to the wrong side the chain turns round to the
/// lower one.) Across the plane the chain is minimised in space.
///
/// # Errors
///
/// The error of a minimisation.
///
/// ```
/// let settings = energy::Settings::default();
/// let problem = model::cases::paper();
/// let solution = energy::minimise(&problem, &settings)?;
/// let numeric = energy::reaction_by_differences(&problem, &solution, &settings)?;
/// let mg = model::STANDARD_GRAVITY_M_S2; // m = 1 kg
/// // lambda_12 of the paper (40 digits by root finding: 0.687055707758162401513537)
/// assert!((numeric[2] / mg - 0.687_055_707_758_162_4).abs() < 1e-10);
/// # Ok::<(), energy::Error>(())
/// ```
pub fn reaction_by_differences(
    problem: &Problem,
    solution: &Solution,
    settings: &Settings,
) -> Result<Vector, Error> {
    settings.validate()?;
    let (links, units) = ScaledChain::new(problem, Motion::Plane);
    let in_frame: Vec<Vector> =
        solution.directions.iter().map(|&u| units.frame.into_frame(u)).collect();
    let turn = Turn::into_plane(&links, &in_frame);
    let start = turn.flattened(&in_frame);
    let spare = links.spare();
    let mut reaction = [0.0; 3];
    for (axis, component) in reaction.iter_mut().enumerate() {
        let motion = if axis == 1 { Motion::Space } else { Motion::Plane };
        let least_energy = |h: f64| -> Result<f64, Error> {
            let mut displaced = ScaledChain { motion, vertical: false, ..links.clone() };
            displaced.span[0][axis] += h;
            let datum = units.datum(&displaced);
            let minimum = descend(displaced, start.clone(), settings)?;
            Ok(minimum.shape.moments.value + datum)
        };
        *component = extrapolated(STEP * spare, least_energy)?;
    }
    let reaction = units.frame.into_world(turn.back(reaction));
    Ok(scaled(units.weight_n, reaction))
}

/// Richardson's extrapolation of central differences, each with half the step of the one before. Three of them remove
/// the errors of order two and four.
fn extrapolated(step: f64, value: impl Fn(f64) -> Result<f64, Error>) -> Result<f64, Error> {
    let mut table = [0.0; 3];
    let mut h = step;
    for entry in &mut table {
        *entry = (value(h)? - value(-h)?) / (2.0 * h);
        h *= 0.5;
    }
    let mut factor = 1.0;
    for order in 1..table.len() {
        factor *= 4.0;
        for k in (order..table.len()).rev() {
            table[k] += (table[k] - table[k - 1]) / (factor - 1.0);
        }
    }
    Ok(table[2])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The central differences of a polynomial of the seventh degree have errors in three even
    /// powers of the step; four levels leave nothing of them.
    #[test]
    fn extrapolation_is_exact_for_polynomials() {
        let value = |h: f64| Ok(3.0 + 2.0 * h - h.powi(2) + 5.0 * h.powi(3) - 4.0 * h.powi(5));
        assert!((extrapolated(0.5, value).unwrap() - 2.0).abs() < 1e-13);
    }
}
