//! The budgets of `validation/tolerances.toml`.

use std::sync::LazyLock;

use serde::Deserialize;

/// One budget.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// The largest value allowed.
    pub value: f64,
    /// Its unit.
    pub unit: String,
    /// The worst value measured over the registry of cases.
    pub measured: f64,
    /// Why this much and no more.
    pub reason: String,
}

/// All budgets.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tolerances {
    /// Distance of the joints of two answers.
    pub joints: Budget,
    /// Difference of the joint forces of two answers.
    pub forces: Budget,
    /// Difference of the energies of two answers.
    pub energy: Budget,
    /// Violations of geometry and of Newton's laws by one answer.
    pub statics: Budget,
}

impl Tolerances {
    /// The budgets of this project.
    ///
    /// # Panics
    ///
    /// Never: a test reads the file that is compiled in.
    #[must_use]
    pub fn project() -> Self {
        static PROJECT: LazyLock<Tolerances> = LazyLock::new(|| {
            toml::from_str(include_str!("../data/tolerances.toml"))
                .expect("data/tolerances.toml is read by a test")
        });
        PROJECT.clone()
    }
}

#[cfg(test)]
mod tests {
    use super::Tolerances;

    #[test]
    fn every_budget_is_above_what_was_measured_and_not_far_above() {
        let Tolerances { joints, forces, energy, statics } = Tolerances::project();
        for budget in [joints, forces, energy, statics] {
            assert!(budget.measured <= budget.value, "{budget:?}");
            assert!(budget.value <= 1e-8 && !budget.reason.trim().is_empty(), "{budget:?}");
        }
    }
}
