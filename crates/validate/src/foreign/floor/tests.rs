//! Joints on and beside a floor, by hand.

use model::system::{Member, Support};
use model::{Bar, STANDARD_GRAVITY_M_S2, SolverName};

use super::super::tests::lamp;
use super::super::{Finding, ForeignAnswer, Judgement, judge_foreign};
use super::*;
use crate::systems::placed::placed;

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
        let answer = placed(&laid, &SolverName::new("a table"), &joints_m, &[axial_n; 2]);
        let mut found = Measured::default();
        Held { system: &floored, answer: &answer, bounds: &KNOWN }.above_floor(&mut found);
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

/// 3 kg on a slack cable of 2 m, on a floor 1.5 m below its anchor.
fn sliding(support: Support, force_n: Vector, pushed_n: Vector) -> Judgement {
    let at_m = [0.0, 0.0, -1.5];
    let mut weight = Joint::free("P").with_mass(3.0).held_by(support);
    weight.force_n = force_n;
    let cable = Member::cable(0, 1, Bar::homogeneous(2.0, 0.0).unwrap());
    let joints = vec![Joint::anchor("A", [0.0; 3]), weight];
    let system = System::new("sliding", STANDARD_GRAVITY_M_S2, joints, vec![cable]).unwrap();
    let system = system.with_floor(-1.5).unwrap();
    let answer = ForeignAnswer::in_order(&system, "x", vec![[0.0; 3], at_m], Some(vec![0.0]));
    let answer = ForeignAnswer { reactions_n: Some(vec![[0.0; 3], pushed_n]), ..answer.unwrap() };
    judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap()
}

#[test]
fn what_slides_is_pushed_by_its_support_and_the_floor() {
    let weight_n = 3.0 * STANDARD_GRAVITY_M_S2;
    let (at_m, none) = ([0.0, 0.0, -1.5], [0.0; 3]);
    let upright = Support::Plane { at_m, normal: [0.0, 1.0, 0.0] };
    let steep = Support::Plane { at_m, normal: [-0.8, 0.0, 0.6] };
    let rising = Support::Line { at_m, direction: [0.6, 0.0, 0.8] };
    for support in [Support::Free, upright, steep, rising] {
        let right = sliding(support, none, [0.0, 0.0, weight_n]);
        assert_eq!(right.finding, Finding::Confirmed, "{support:?}: {:?}", right.violations);
        let wrong = sliding(support, none, [0.0, 0.0, weight_n - 1.0]);
        let [reaction, _] = wrong.violations[..] else { panic!("{:?}", wrong.violations) };
        assert!(matches!(reaction.law, Law::Reaction { .. }), "{reaction:?}");
        assert!((reaction.value - 1.0).abs() < 1e-9, "{reaction:?}");
    }
    // Along the slope 30 N up and 4/5 of the weight down: the floor would have to pull.
    let pulled = sliding(rising, [50.0, 7.0, 0.0], [-50.0, -7.0, weight_n]);
    let [pulls] = pulled.violations[..] else { panic!("{:?}", pulled.violations) };
    let Law::FloorPulls { force_n } = pulls.law else { panic!("{pulls:?}") };
    assert!((force_n - (37.5 - weight_n)).abs() < 1e-9, "{pulls:?}");
    // In the upright plane nothing holds it along x, on or off the floor.
    let drawn = sliding(upright, [50.0, 7.0, 0.0], [0.0, -7.0, weight_n]);
    assert!(
        drawn
            .violations
            .iter()
            .any(|v| matches!(v.law, Law::Balance { left_n } if (left_n[0] - 50.0).abs() < 1e-9))
    );
}
