//! What several files ask and hold answers to.

use model::system::{System, SystemEquilibrium};
use validate::Solvers;
use validate::systems::{SystemAnswer, ask};

pub fn asked(system: &System) -> SystemAnswer {
    ask(system, Solvers::Both, &|_| {})
}

/// Both answers, which agree.
#[track_caller]
pub fn agreed(system: &System) -> Vec<SystemEquilibrium> {
    let answer = asked(system);
    let name = system.name();
    assert!(answer.agrees(), "{name}: {:?}, {:?}", answer.agreement, answer.failures);
    answer.equilibria
}

/// Relative to the number itself: on the gallery both solvers reach 2e-13 on the linkage, the worst of all.
#[track_caller]
pub fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-11 * wanted.abs(), "{found} is not {wanted}");
}
