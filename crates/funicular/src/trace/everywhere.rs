//! All equilibria under loads that grow in proportion, of systems whose members keep their lengths.
//!
//! Forces in balance times a factor are in balance with the loads times this factor, and no length depends on
//! them: the shapes are those at one load. A complete census there is one at every load.

use branches::{Number, Variation};
use validate::systems::quick_census;

/// How many equilibria there are at every load of a path: of `loads` alone, on one side of no load, of a
/// system without elastic members that a quick census covers.
pub(super) fn everywhere(variation: &Variation, points: &[Vec<f64>]) -> Option<usize> {
    if variation.numbers() != [Number::Loads] {
        return None;
    }
    let factors = || points.iter().flatten().copied();
    let one_sign = factors().all(|factor| factor > 0.0) || factors().all(|factor| factor < 0.0);
    let system = variation.unloaded(points.first()?).ok().filter(|_| one_sign)?;
    if system.members().iter().any(|member| member.stiffness_n.is_some()) {
        return None;
    }
    let census = quick_census(&system).ok()?;
    (census.complete && census.families() == 0).then_some(census.equilibria.len())
}
