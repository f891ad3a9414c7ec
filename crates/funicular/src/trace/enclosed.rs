//! Limit points of loads, enclosed by interval arithmetic.

use branches::Variation;
use census::network::prove_limit;
use model::system::{Joint, Member, System};

use super::equations::Kept;

/// Values of the last parameter between which the limit point is proved to lie; nothing where more than
/// loads vary, over a floor, or where there is no proof.
pub(super) fn enclosed(
    variation: &Variation<System>,
    [from, to]: [&[f64]; 2],
    at: &Kept,
) -> Option<[f64; 2]> {
    let system = |values: &[f64]| variation.unloaded(values).ok();
    let (first, last, here) = (system(from)?, system(to)?, system(&at.values)?);
    if here.floor_m().is_some() || !loads_alone(&first, &last) {
        return None;
    }
    let values = [from.last()?, to.last()?, at.values.last()?].map(|value| *value);
    let answer = &at.equilibrium;
    let found =
        prove_limit([&first, &last], &here, values, &answer.joints_m, &answer.axial_n).ok()?;
    Some([found.lo(), found.hi()])
}

/// Whether two systems differ in forces and masses alone.
pub(super) fn loads_alone(a: &System, b: &System) -> bool {
    let joint = |(a, b): (&Joint, &Joint)| a.support == b.support;
    let body =
        |member: &Member| (member.body.length_m().to_bits(), member.body.centre_m().to_bits());
    let places = |member: &Member| -> Vec<u64> {
        member.loads.iter().map(|load| load.at_m.to_bits()).collect()
    };
    let member = |(a, b): (&Member, &Member)| {
        body(a) == body(b) && a.stiffness_n == b.stiffness_n && places(a) == places(b)
    };
    // A product of gravity and masses is not on a straight line.
    a.gravity_m_s2().to_bits() == b.gravity_m_s2().to_bits()
        && a.joints().iter().zip(b.joints()).all(joint)
        && a.members().iter().zip(b.members()).all(member)
}
