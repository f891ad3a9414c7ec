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

/// Two bars of 2 m under 10 m/s² beside the origin: their unit of energy is 40 N times 4 m, that of
/// forces 40 N. Joints 1e-8 of 4 m from one vertical are on it; bars with 4e-8 N are in tension.
#[test]
fn lines_and_tensions_are_told_to_their_thresholds() {
    let anchors = Anchors { start_m: [5.0, 7.0, 1.0], end_m: [8.2, 7.0, 1.0] };
    let bar = Bar::homogeneous(2.0, 2.0).unwrap();
    let problem = Problem::new(Chain::new("two", 10.0, anchors, vec![bar; 2]).unwrap()).unwrap();
    let settings = lagrange::Settings::default();
    let right = lagrange::solve(&problem, &settings).unwrap().equilibrium;
    let told = |change: &dyn Fn(&mut Equilibrium)| {
        let mut found = right.clone();
        change(&mut found);
        hold_against_cables(&problem, &found).unwrap()
    };
    let upright = |aside_m: [f64; 2]| {
        told(&|found| {
            for joint in &mut found.joints_m {
                (joint[0], joint[1]) = (5.0, 7.0);
            }
            found.joints_m[1][0] += aside_m[0];
            found.joints_m[1][1] += aside_m[1];
        })
    };
    assert_eq!(upright([0.0, 0.0]).axial, None);
    for sign in [1.0, -1.0] {
        for (near, far) in [([3e-8, 0.0], [5e-8, 0.0]), ([0.0, 3e-8], [0.0, 5e-8])] {
            assert_eq!(upright(near.map(|x| sign * x)).axial, None);
            assert!(upright(far.map(|x| sign * x)).axial.is_some());
        }
    }
    for (axial_n, in_tension) in [(3.9e-8, false), (4.1e-8, true), (-1.0, false)] {
        let found = told(&|found| found.axial_n[1] = axial_n);
        assert_eq!(found.in_tension, in_tension, "{axial_n:e}");
    }
    // 64 N are the larger unit.
    let found = told(&|found| {
        found.multipliers_n[1] = [0.0, 64.0, 0.0];
        found.axial_n[0] += 6.4;
    });
    assert!((found.axial.unwrap() - 0.1).abs() < 1e-6, "{found:?}");
    for gap in [0.1, -0.2] {
        let found = told(&|found| found.energy_j += gap * 160.0);
        assert!((found.gap - gap).abs() < 1e-6, "{found:?}");
    }
    assert_eq!((told(&|_| ()).slack, told(&|_| ()).taut), (0, true));
}
