//! Differences in their units, and the largest of some values.

use model::{Anchors, Bar, Chain};

use super::*;

/// Two bars of 2 m under 10 m/s², 3.2 m apart, with one joint and one force off: of 4 m, and of the
/// larger of the weight of 40 N and the force at an anchor, 20 N up and 40/3 N aside.
#[test]
fn what_is_off_is_told_in_its_unit() {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [3.2, 0.0, 0.0] };
    let bar = Bar::homogeneous(2.0, 2.0).unwrap();
    let problem = Problem::new(Chain::new("two", 10.0, anchors, vec![bar; 2]).unwrap()).unwrap();
    let settings = lagrange::Settings::default();
    let mut found = lagrange::solve(&problem, &settings).unwrap().equilibrium;
    found.joints_m[1][1] += 0.5;
    found.axial_n[1] += 4.0;
    let cables = hold_against_cables(&problem, &found).unwrap();
    assert!(cables.taut && cables.in_tension);
    // clarabel's tolerance, also of its optimum; the energy was left as it is.
    assert!(cables.optimum.abs() < 1e-6 && cables.gap.abs() < 1e-6, "{cables:?}");
    assert!((cables.joints.unwrap() - 0.125).abs() < 1e-6, "{cables:?}");
    assert!((cables.axial.unwrap() - 0.1).abs() < 1e-6, "{cables:?}");
}

#[test]
fn the_worst_value_is_the_largest_or_none_at_all() {
    let of = |values: &[f64]| worst(values.iter().copied());
    assert_eq!(of(&[0.5, 2.0, 1.0]).to_bits(), 2.0_f64.to_bits());
    assert_eq!(of(&[]).to_bits(), 0.0_f64.to_bits());
    for values in [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]] {
        assert!(of(&values).is_nan(), "{values:?}");
    }
}

/// Budgets of 1/8 for energies and 1/4 for forces.
#[test]
fn cables_confirm_what_is_within_the_budgets() {
    let mut tolerances = Tolerances::project();
    (tolerances.energy.value, tolerances.forces.value) = (0.125, 0.25);
    let with = |taut: bool, in_tension: bool, gap: f64, axial: Option<f64>| {
        let cables = Cables {
            taut,
            slack: 0,
            in_tension,
            gap,
            optimum: 0.0,
            axial,
            joints: None,
            iterations: 1,
        };
        cables.confirm(&tolerances)
    };
    for axial in [None, Some(0.0), Some(0.25)] {
        for (gap, right) in
            [(0.0, true), (0.125, true), (-0.125, true), (0.2, false), (-0.2, false)]
        {
            assert_eq!(with(true, true, gap, axial), right, "{gap}");
        }
    }
    assert!(!with(true, true, 0.0, Some(0.3)) && !with(true, true, 0.0, Some(f64::NAN)));
    assert!(!with(true, true, f64::NAN, None));
    for (gap, right) in [(3.0, true), (0.0, true), (-0.1, true), (-0.125, false), (-0.2, false)] {
        assert_eq!(with(false, false, gap, Some(9.0)), right, "{gap}");
    }
    assert!(!with(false, true, 0.0, None) && !with(true, false, 0.0, None));
}
