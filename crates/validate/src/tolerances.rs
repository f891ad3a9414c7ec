//! The budgets of `validation/tolerances.toml`.

use std::sync::LazyLock;

use toml::{Table, Value};

use crate::built_in::{key, numbers, parsed};

/// One budget.
#[derive(Debug, Clone, Copy)]
pub struct Budget {
    /// The largest value allowed.
    pub value: f64,
    /// The worst value measured over the registry of cases.
    pub measured: f64,
}

/// All budgets.
#[derive(Debug, Clone, Copy)]
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
            let file = file();
            let [joints, forces, energy, statics] = NAMES.map(|name| {
                let budget = key(&file, name, Value::as_table);
                let [value, measured] = numbers(budget, ["value", "measured"]);
                Budget { value, measured }
            });
            Tolerances { joints, forces, energy, statics }
        });
        *PROJECT
    }
}

/// In the order of [`Tolerances`].
const NAMES: [&str; 4] = ["joints", "forces", "energy", "statics"];

/// Each budget with its unit and the reason why it is this much and no more.
fn file() -> Table {
    parsed(include_str!("../data/tolerances.toml"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_budget_is_above_what_was_measured_and_not_far_above() {
        let Tolerances { joints, forces, energy, statics } = Tolerances::project();
        let file = file();
        for (name, budget) in NAMES.into_iter().zip([joints, forces, energy, statics]) {
            assert!(budget.measured <= budget.value && budget.value <= 1e-8, "{budget:?}");
            // A key that is not read is a mistake.
            let keys = key(&file, name, Value::as_table);
            let [unit, reason] = ["unit", "reason"].map(|told| key(keys, told, Value::as_str));
            assert!(!unit.is_empty() && !reason.trim().is_empty() && keys.len() == 4, "{name}");
        }
        assert_eq!(file.len(), NAMES.len());
    }
}
