//! Masses too far apart for doubles.

/// Half a unit in the last place of a double: what is less is lost in the rounding of a sum.
const LOST: f64 = 0.5 * f64::EPSILON;

/// The lightest and the heaviest of these masses, kg, where the lightest is lost in the rounding of the
/// heaviest, so that a balance of both would not contain it. Massless parts do not count.
pub(crate) fn too_wide(masses_kg: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    let (lightest, heaviest) = masses_kg
        .into_iter()
        .filter(|mass_kg| *mass_kg > 0.0)
        .fold((f64::INFINITY, 0.0_f64), |(low, high), kg| (low.min(kg), high.max(kg)));
    (lightest <= LOST * heaviest).then_some((lightest, heaviest))
}
