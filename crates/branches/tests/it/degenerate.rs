//! Paths into and across degenerate points: curves that touch, straight positions, chains without
//! weight.

use branches::{
    BranchEnd, Combine, Continuation, ContinuationSettings, EventKind, PointStatus, Variation,
};

const MGL: f64 = 9.80665;

/// Three bars of 1 m and 1 kg, the last anchor at (1, 0, −1) unless it is varied.
fn run(vary: &[&str]) -> Continuation {
    let chain = samples::equal_bars(3, 3.0, 3.0, [1.0, 0.0, -1.0]).into_chain();
    let vary: Vec<_> = vary.iter().map(|text| text.parse().unwrap()).collect();
    let variation = Variation::new(&chain, &vary, Combine::Product).unwrap();
    Continuation::follow(&variation, 0, &ContinuationSettings::default(), &|_| {}).unwrap()
}

/// At (1, 0, −2) bar 1 hangs, bar 2 is level without force and bar 3 hangs below it, V = −3 mgl.
/// Two curves touch there, each with a fold, known to half of the digits.
#[test]
fn two_curves_that_touch_have_a_fold_each() {
    for grid in ["-2.5..-1.5:11", "-2.5..-1.4:12", "-2.3..-1.7:7", "-2.45..-1.6:9"] {
        let trace = run(&["anchors.end_m.x=1", &format!("anchors.end_m.z={grid}")]);
        assert!(trace.checks.agree(), "{grid}: {:?}", trace.checks);
        let folds: Vec<_> = trace.events.iter().filter(|e| e.kind == EventKind::Fold).collect();
        assert_eq!(folds.len(), 2, "{grid}: {:?}", trace.events);
        for fold in &folds {
            let off = (fold.values[1] + 2.0).abs();
            assert!(off <= fold.values_error[1] && off < 1e-6, "{grid}: {fold:?}");
            assert!((fold.energy_j + 3.0 * MGL).abs() < 1e-5, "{grid}: {}", fold.energy_j);
        }
        // The bar without force changes from tension to compression there.
        let unloaded = trace.events.iter().filter(|e| e.kind == EventKind::Unloaded { bar: 2 });
        assert!(unloaded.count() > 0, "{grid}");
        let mut ends: Vec<usize> = folds.iter().flat_map(|fold| fold.branches.clone()).collect();
        ends.sort_unstable();
        ends.dedup();
        assert_eq!(ends.len(), 4, "{grid}");
    }
}

/// Folds by themselves stay what they are, with the digits that are known.
#[test]
fn the_error_of_a_simple_fold_is_rounding() {
    // In closed form (`closed_forms`): the squared distance is 3/2.
    let trace = run(&["anchors.end_m.z=0", "anchors.end_m.x=1.1..1.3:3"]);
    let folds: Vec<_> = trace.events.iter().filter(|e| e.kind == EventKind::Fold).collect();
    assert_eq!(folds.len(), 4);
    for fold in folds {
        let off = (fold.values[1] - 1.5_f64.sqrt()).abs();
        assert!(fold.position_error < 1e-12, "{fold:?}");
        assert!(off <= fold.values_error[1], "{off:e} {fold:?}");
        assert!(fold.values_error[0] <= 0.0);
    }
}

/// With both anchors on one vertical, 1 m apart, the chain lies on it in three ways, with any
/// force: down and down and up, at V = −7/2, −3/2 and 1/2 mgl. Two branches come to each.
#[test]
fn branches_are_followed_into_upright_positions() {
    for range in ["0..3:7", "0..1.1:5", "-1.2..3:8", "-3..3:13"] {
        let trace = run(&[&format!("anchors.end_m.x={range}")]);
        assert!(trace.checks.agree(), "{range}: {:?}", trace.checks);
        let straight: Vec<f64> = trace
            .events
            .iter()
            .filter(|event| event.kind == EventKind::Straight)
            .map(|event| event.values[0].abs())
            .filter(|x| *x > 1.0)
            .collect();
        // Level with the reach: 3² − 1² = 8.
        assert!(straight.iter().all(|x| (x - 8.0_f64.sqrt()).abs() < 1e-10), "{straight:?}");
        assert_eq!(straight.is_empty(), range.starts_with("0..1.1"), "{range}: {straight:?}");
        let upright = trace.points.iter().filter(|point| point.values[0].abs() <= 0.0);
        assert_eq!(upright.clone().count(), 1, "{range}");
        for at in upright {
            let PointStatus::Undecided { straight, .. } = &at.status else { panic!("{at:?}") };
            assert_eq!(*straight, 3);
            if range.starts_with('-') {
                // Six branches pass.
                let passing = trace.branches.iter().filter(|b| b.covers(at.position));
                assert_eq!(passing.count(), 6, "{range}");
                continue;
            }
            let mut energies = vec![];
            for branch in &trace.branches {
                assert_eq!(branch.start, BranchEnd::Border, "{range}");
                let first = &branch.points[0];
                assert!(first.values[0] < 1e-3, "{range}: from {} on", first.values[0]);
                energies.push(first.energy_j / MGL);
            }
            energies.sort_by(f64::total_cmp);
            assert_eq!(energies.len(), 6, "{range}");
            for (found, wanted) in energies.iter().zip([-3.5, -3.5, -1.5, -1.5, 0.5, 0.5]) {
                assert!((found - wanted).abs() < 1e-3, "{range}: {energies:?}");
            }
        }
    }
}

/// A chain without any weight has no equations: branches end before it, and nothing happens there.
#[test]
fn a_path_to_no_weight_ends_before_it() {
    for vary in ["bars.*.mass_kg=0..1:3", "bars.*.mass_kg=1,0.5,0", "bars.*.mass_kg=0..1:4"] {
        let trace = run(&[vary]);
        assert!(trace.checks.agree(), "{vary}: {:?}", trace.checks);
        assert!(trace.events.is_empty(), "{vary}: {:?}", trace.events);
        assert_eq!(trace.branches.len(), 6, "{vary}");
        let points = trace.branches.iter().flat_map(|branch| &branch.points);
        for point in points {
            let numbers = point.angles_rad.iter().chain(&point.axial_n).chain(&point.values);
            assert!(point.energy_j.is_finite() && numbers.into_iter().all(|x| x.is_finite()));
            assert!(point.values[0] > 0.0);
        }
    }
}
