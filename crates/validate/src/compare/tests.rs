//! Differences exactly at their budget.

use model::{Anchors, Bar, InPlane, InSpace, Rung, Stability};

use super::*;

/// Three bars of 1 m and 1 N over 2 m down, and what `lagrange` finds.
fn three() -> (Problem, Equilibrium) {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, -2.0] };
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let problem = Problem::new(Chain::new("paper", 1.0, anchors, vec![bar; 3]).unwrap()).unwrap();
    let found = lagrange::solve(&problem, &lagrange::Settings::default()).unwrap().equilibrium;
    (problem, found)
}

/// The unit of energy is 9 J, and a budget of 2^-30 of it is exact.
#[test]
fn a_difference_as_large_as_its_budget_is_within_it() {
    let (problem, found) = three();
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

/// "Degenerate" leaves the sign of a curvature open,.
#[test]
fn a_curvature_not_told_from_zero_contradicts_no_other() {
    let (problem, first) = three();
    let Stability { in_plane, in_space, .. } = first.stability;
    assert_eq!((in_plane, in_space), (InPlane::Minimum, InSpace::Stable));
    let compared = |stability| {
        let second = Equilibrium { stability, solver: SolverName::ENERGY, ..first.clone() };
        let mut answers = [first.clone(), second];
        let agreement = compare(&problem, &mut answers, &Tolerances::project());
        let [told, again] = answers.map(|answer| answer.evidence.ladder.how(Rung::Agreed));
        assert_eq!(told, again);
        (agreement, told)
    };

    let (agreement, told) = compared(first.stability);
    assert!(agreement.agrees() && agreement.curvature_undecided.is_empty());
    assert!(!told.contains("curvature"), "{told}");

    let flat = Stability { in_plane: InPlane::Degenerate, ..first.stability };
    let (agreement, told) = compared(flat);
    assert!(agreement.agrees(), "{}", agreement.disagreement);
    let between = [SolverName::LAGRANGE, SolverName::ENERGY];
    let undecided = StabilityDifference { between, found: [first.stability, flat] };
    assert_eq!(agreement.curvature_undecided, [undecided]);
    let words = "; lagrange tells the least curvature in the plane from zero, energy does not: minimum or degenerate";
    assert!(told.ends_with(words), "{told}");

    for other in [
        Stability { in_plane: InPlane::Saddle, ..first.stability },
        Stability { index_in_plane: 1, ..flat },
        Stability { index_in_space: 1, in_space: InSpace::Unstable, ..flat },
    ] {
        let (agreement, _) = compared(other);
        assert!(!agreement.agrees() && agreement.curvature_undecided.is_empty(), "{other}");
        assert_eq!(agreement.disagreement.stability.len(), 1);
    }
}
