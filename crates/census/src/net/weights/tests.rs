//! Weights by the lever rule.

use model::Bar;
use model::system::{Joint, Member};

use super::*;

/// A joint of 3 kg with 20 N down; a member of 8 m that begins there with 8 kg at a quarter, of which
/// 6 kg are its own, and 16 N at five eighths, of which 6 N are; and one of 4 m that ends there with
/// 2 kg in the middle. 3 + 2 + 6 + 0.6 + 1 kg under 10 m/s².
#[test]
fn what_hangs_at_a_joint_is_its_share_of_all_loads() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(3.0).with_force([0.0, 0.0, -20.0]),
        Joint::free("Q"),
    ];
    let mut long = Member::bar(1, 2, Bar::new(8.0, 8.0, 2.0, [0.0; 3]).unwrap());
    long.loads.push(PointLoad { at_m: 5.0, force_n: [0.0, 0.0, -16.0], is_spread: false });
    let short = Member::bar(0, 1, Bar::homogeneous(4.0, 2.0).unwrap());
    let weights = |long: &Member| {
        let members = vec![long.clone(), short.clone()];
        let system = System::new("two", 10.0, joints.clone(), members).unwrap();
        weights_kg(&system, &[1, 2], &[])
    };
    let found = weights(&long).unwrap();
    assert!(found[0].is_none());
    for (found, wanted) in [(found[1], 12.6), (found[2], 3.0)] {
        let found = found.unwrap().interval().mid();
        assert!((found / wanted - 1.0).abs() < 1e-14, "{found}, not {wanted}");
    }
    for force_n in [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]] {
        let mut pushed = long.clone();
        pushed.loads[0].force_n = force_n;
        assert_eq!(weights(&pushed), Err(NoCensus::LoadsNotDown { joint: 2 }), "{force_n:?}");
    }
    // Up, 8 N take 0.3 kg from the 12 of P and half a kilogram from the 2 of Q; 32 N are what Q bears.
    let mut lifted = long.clone();
    lifted.loads[0].force_n = [0.0, 0.0, 8.0];
    let found = weights(&lifted).unwrap();
    for (found, wanted) in [(found[1], 11.7), (found[2], 1.5)] {
        let found = found.unwrap().interval().mid();
        assert!((found / wanted - 1.0).abs() < 1e-14, "{found}, not {wanted}");
    }
    lifted.loads[0].force_n = [0.0, 0.0, 32.0];
    assert_eq!(weights(&lifted), Err(NoCensus::LoadsNotDown { joint: 3 }));
    // A force of nothing is no load.
    let mut light = Member::bar(1, 2, Bar::new(8.0, 0.0, 2.0, [0.0; 3]).unwrap());
    light.loads.push(PointLoad { at_m: 5.0, force_n: [0.0; 3], is_spread: false });
    assert!(weights(&light).unwrap()[2].is_none());
}

/// What acts at one end is nothing for the other, exactly.
#[test]
fn an_end_takes_nothing_of_what_is_at_the_other() {
    let share = |at_m: f64, is_start: bool| share(8.0, at_m, is_start).map(|x| x.interval().mid());
    assert_eq!((share(0.0, true), share(0.0, false)), (Some(1.0), None));
    assert_eq!((share(8.0, true), share(8.0, false)), (None, Some(1.0)));
    assert_eq!((share(2.0, true), share(2.0, false)), (Some(0.75), Some(0.25)));
}
