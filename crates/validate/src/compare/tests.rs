//! Differences exactly at their budget.

use model::{Anchors, Bar};

use super::*;

/// Three bars of 1 m and 1 N: the unit of energy is 9 J, and a budget of 2^-30 of it is exact.
#[test]
fn a_difference_as_large_as_its_budget_is_within_it() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, -2.0] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let problem = Problem::new(Chain::new("paper", 1.0, anchors, vec![bar; 3]).unwrap()).unwrap();
    let found = lagrange::solve(&problem, &lagrange::Settings::default()).unwrap().equilibrium;
    let mut tolerances = Tolerances::project();
    tolerances.energy.value = 2.0_f64.powi(-30);
    let budget_j = 9.0 * 2.0_f64.powi(-30);
    for (apart_j, within) in [(0.0, true), (budget_j, true), (budget_j * (1.0 + 1e-9), false)] {
        let at = |energy_j: f64| Equilibrium { energy_j, ..found.clone() };
        let agreement = compare(&problem, &mut [at(0.0), at(apart_j)], &tolerances);
        let told = |excess: &Excess| matches!(excess.what, Quantity::Energy { .. });
        assert_eq!(agreement.disagreement.excesses.iter().any(told), !within, "{apart_j:e}");
        assert_eq!(agreement.energy_j.to_bits(), f64::to_bits(apart_j));
    }
}
