//! The budgets of `validation/tolerances.toml`.

use std::sync::LazyLock;

use toml::{Table, Value};

use crate::built_in::{key, number, parsed};

/// All budgets; the file says of each what it is measured in, and why it is this much and no more.
#[derive(Debug, Clone, Copy)]
pub struct Tolerances {
    /// Distance of the joints of two answers, over the size of the system.
    pub joints: f64,
    /// Difference of the joint forces of two answers, over all loads.
    pub forces: f64,
    /// Difference of the energies of two answers, over all loads times the size of the system.
    pub energy: f64,
    /// Violations of geometry and of Newton's laws by one answer, over what acts there.
    pub statics: f64,
}

impl Tolerances {
    /// The budgets of this project.
    ///
    /// # Panics
    /// Never: a test reads the file that is compiled in.
    pub fn project() -> Self {
        static PROJECT: LazyLock<Tolerances> = LazyLock::new(|| {
            let file = file();
            let [joints, forces, energy, statics] =
                NAMES.map(|name| key(key(&file, name, Value::as_table), "value", number));
            Tolerances { joints, forces, energy, statics }
        });
        *PROJECT
    }
}

/// In the order of [`Tolerances`].
const NAMES: [&str; 4] = ["joints", "forces", "energy", "statics"];

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
            // A key that is not read is a mistake.
            let keys = key(&file, name, Value::as_table);
            assert!(key(keys, "measured", number) <= budget && budget <= 1e-8, "{name}");
            let [unit, reason] = ["unit", "reason"].map(|told| key(keys, told, Value::as_str));
            assert!(!unit.is_empty() && !reason.trim().is_empty() && keys.len() == 4, "{name}");
        }
        assert_eq!(file.len(), NAMES.len());
    }
}
