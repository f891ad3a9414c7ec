//! How far two answers differ, observable by observable.

use model::{Chain, Equilibrium, ForceFamily, FreeJoints, Vector};

use crate::force_family::beside_the_family;
use crate::vector::{minus, norm};

/// The differences of two answers.
pub(crate) struct Differences {
    /// Largest distance of a joint that is not left out from the same joint in the other answer, m.
    pub(crate) joints_m: f64,
    /// Largest difference of a joint force, N; of forces of one family what is not along its line.
    pub(crate) forces_n: f64,
    /// Difference of the energies, J.
    pub(crate) energy_j: f64,
    /// Where the chain turns freely, the angle by which the second answer was turned onto the
    /// first, rad.
    pub(crate) turned_rad: Option<f64>,
}

impl Differences {
    /// Between two answers, without the joints that are free, and up to a force of the family.
    pub(crate) fn of(
        chain: &Chain,
        [first, second]: [&Equilibrium; 2],
        free: Option<FreeJoints>,
        family: Option<&ForceFamily>,
    ) -> Self {
        let turned_rad = chain.anchors_on_one_vertical().then(|| turn_onto(chain, first, second));
        let (sin, cos) = turned_rad.unwrap_or(0.0).sin_cos();
        let origin = chain.anchors().start_m;
        let turned = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
        let place = |joint: &Vector| std::array::from_fn(|k| joint[k] - origin[k]);
        let joints = chain.bars().len() + 1;
        let joints_m =
            if [first, second].iter().all(|answer| answer.joints_m.len() == joints) {
                let held = (0..joints).filter(|k| !free.is_some_and(|free| free.contains(*k)));
                worst(held.map(|k| {
                    distance(place(&first.joints_m[k]), turned(place(&second.joints_m[k])))
                }))
            } else {
                f64::NAN
            };
        let forces_n = if [first, second].iter().all(|a| a.multipliers_n.len() == joints) {
            let pairs = first.multipliers_n.iter().zip(&second.multipliers_n);
            let mut left: Vec<Vector> = pairs.map(|(a, b)| minus(*a, turned(*b))).collect();
            if let Some(family) = family {
                beside_the_family(family, &mut left);
            }
            worst(left.into_iter().map(norm))
        } else {
            f64::NAN
        };
        Self { joints_m, forces_n, energy_j: (first.energy_j - second.energy_j).abs(), turned_rad }
    }
}

/// The turn about the vertical that brings the joints of `second` closest to those of `first`.
fn turn_onto(chain: &Chain, first: &Equilibrium, second: &Equilibrium) -> f64 {
    let [ox, oy, _] = chain.anchors().start_m;
    let (mut along, mut across) = (0.0, 0.0);
    for (a, b) in first.joints_m.iter().zip(&second.joints_m) {
        let (ax, ay, bx, by) = (a[0] - ox, a[1] - oy, b[0] - ox, b[1] - oy);
        along += ax * bx + ay * by;
        across += bx * ay - by * ax;
    }
    f64::atan2(across, along)
}

/// The largest value, NaN if there is one (`f64::max` would forget it).
pub(crate) fn worst(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

fn distance(a: Vector, b: Vector) -> f64 {
    norm(minus(a, b))
}

#[cfg(test)]
mod tests;
