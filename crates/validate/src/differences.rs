//! How far two answers differ, observable by observable.

use model::{Bar, Chain, Equilibrium, Vector};

/// The differences of two answers.
pub(crate) struct Differences {
    /// Largest distance of a joint that is not left out from the same joint in the other answer, m.
    pub(crate) joints_m: f64,
    /// Largest difference of a joint force, N.
    pub(crate) forces_n: f64,
    /// Difference of the energies, J.
    pub(crate) energy_j: f64,
    /// Where the chain turns freely, the angle by which the second answer was turned onto the first, rad.
    pub(crate) turned_rad: Option<f64>,
}

impl Differences {
    /// Between two answers, without the joints that are marked as free.
    pub(crate) fn of(chain: &Chain, [first, second]: [&Equilibrium; 2], free: &[bool]) -> Self {
        let turned_rad = chain.anchors_on_one_vertical().then(|| turn_onto(chain, first, second));
        let (sin, cos) = turned_rad.unwrap_or(0.0).sin_cos();
        let origin = chain.anchors().start_m;
        let turned = |[x, y, z]: Vector| [cos * x - sin * y, sin * x + cos * y, z];
        let place = |joint: &Vector| std::array::from_fn(|k| joint[k] - origin[k]);
        let held = |joints_m: &[Vector], k: usize| if free[k] { origin } else { joints_m[k] };
        let fits = [first, second].iter().all(|answer| answer.joints_m.len() == free.len());
        let joints_m = if fits {
            let pairs =
                (0..free.len()).map(|k| [held(&first.joints_m, k), held(&second.joints_m, k)]);
            worst(pairs.map(|[a, b]| distance(place(&a), turned(place(&b)))))
        } else {
            f64::NAN
        };
        Self {
            joints_m,
            forces_n: largest(&first.multipliers_n, &second.multipliers_n, |a, b| {
                distance(*a, turned(*b))
            }),
            energy_j: (first.energy_j - second.energy_j).abs(),
            turned_rad,
        }
    }
}

/// A joint with less than this part of the total weight carries no load: a rounding of the weight.
const NO_LOAD: f64 = f64::EPSILON;

/// Which joints 0..=n carry no load and lie between bars that carry no force in any answer: an
/// equilibrium does not say where such a joint is. Where a joint without load lies between bars with
/// force, the two are parallel, and it is held.
pub(crate) fn free_joints(chain: &Chain, answers: &[Equilibrium], no_force_n: f64) -> Vec<bool> {
    let bars = chain.bars();
    let mut free = vec![false; bars.len() + 1];
    let no_load_kg = NO_LOAD * chain.total_mass_kg();
    // What of a bar's mass its second end carries.
    let beyond = |bar: &Bar| bar.mass_kg() * (bar.centre_m() / bar.length_m());
    for k in 1..bars.len() {
        let load_kg = beyond(&bars[k - 1]) + (bars[k].mass_kg() - beyond(&bars[k]));
        // Arrays that do not fit, and NaN, free nothing.
        let limp = |bar: usize| {
            answers.iter().all(|a| a.axial_n.get(bar).is_some_and(|n| n.abs() <= no_force_n))
        };
        free[k] = load_kg <= no_load_kg && limp(k - 1) && limp(k);
    }
    free
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

/// Largest difference of two arrays, by the given measure; NaN if they differ in length.
fn largest(a: &[Vector], b: &[Vector], measure: impl Fn(&Vector, &Vector) -> f64) -> f64 {
    if a.len() != b.len() {
        return f64::NAN;
    }
    worst(a.iter().zip(b).map(|(a, b)| measure(a, b)))
}

/// The largest value, NaN if there is one (`f64::max` would forget it).
pub(crate) fn worst(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) })
}

fn distance(a: Vector, b: Vector) -> f64 {
    norm(std::array::from_fn(|k| a[k] - b[k]))
}

fn norm([x, y, z]: Vector) -> f64 {
    x.hypot(y).hypot(z)
}
