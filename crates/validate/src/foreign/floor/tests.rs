//! Joints on and beside a floor, by hand.

use model::SolverName;

use super::super::complete::complete;
use super::super::tests::lamp;
use super::*;

const KNOWN: Bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.5 };

#[test]
fn what_lies_on_the_floor_is_held_in_its_level() {
    let floored = lamp().with_floor(-4.0).unwrap();
    let support = |z: f64| {
        let joints_m = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [1.0, 2.0, z]];
        let laid = laid(&floored, &joints_m, &KNOWN);
        assert_eq!(laid.floor_m(), None);
        assert_eq!(laid.members(), floored.members());
        assert_eq!(laid.joints()[..2], floored.joints()[..2]);
        laid.joints()[2].support
    };
    let level = Support::Plane { at_m: [1.0, 2.0, -4.0], normal: [0.0, 0.0, 1.0] };
    for z in [-4.25, -4.0, -3.75] {
        assert_eq!(support(z), level, "{z}");
    }
    for z in [-4.3, -3.7, 0.0] {
        assert_eq!(support(z), Support::Free, "{z}");
    }
    let joints_m = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    assert_eq!(laid(&lamp(), &joints_m, &KNOWN).joints(), lamp().joints());
}

/// 2 N hang on a floor 3 m below the anchors. Where the cables bear 5 N each, 3 N upwards together
/// and more, the floor would have to pull; 4 m deep the lamp is a metre below it.
#[test]
fn a_floor_that_is_passed_or_pulls_is_told() {
    let told = |z: f64, axial_n: f64| {
        let floored = lamp().with_floor(-3.0).unwrap();
        let joints_m = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, z]];
        let laid = laid(&floored, &joints_m, &KNOWN);
        let answer = complete(&laid, &SolverName::new("a table"), &joints_m, &[axial_n; 2]);
        let mut found = Measured::default();
        above_floor(&floored, &answer, &KNOWN, &mut found);
        found.violations
    };
    assert_eq!(told(-3.0, 0.0), []);
    assert_eq!(told(-3.2, 0.0), []);
    let [below] = told(-4.0, 1.25)[..] else { panic!() };
    assert_eq!((below.place, below.law), (Place::Joint(2), Law::BelowFloor));
    assert_eq!((below.value, below.allowed), (1.0, 0.25));
    // 10 N each, at 45 degrees: 2 N less than 20/√2 N.
    let [pulls] = told(-3.0, 10.0)[..] else { panic!() };
    let pull_n = 20.0 * 0.5_f64.sqrt() - 2.0;
    assert!((pulls.value - pull_n).abs() < 1e-14, "{pulls:?}");
    assert!(matches!(pulls.law, Law::FloorPulls { force_n } if (force_n - pull_n).abs() < 1e-14));
    // Half a newton of the load and of each cable, and 10 N that may turn by `1/2` over `√18 - 1/4`.
    let allowed = 1.5 + 20.0 * 0.5 / (18.0_f64.sqrt() - 0.25);
    assert!((pulls.allowed - allowed).abs() < 1e-14, "{pulls:?}");
}
