//! Rank and stability by hand.

use model::system::{Joint, Member, System};
use model::{Bar, Proved};

use super::super::tests::{arch, four_legs, lamp, propped};
use super::proved;

/// Two bars at 3-4-5 in a plane leave the swing across it, which their pull resists; upside down the
/// energy falls along it. A part that turns freely is not held by anything. Four legs have a
/// self-stress, and no motion.
#[test]
fn what_holds_is_proved_and_nothing_else() {
    let (system, answer) = lamp();
    assert_eq!(proved(&system, &answer), Some(Proved::RankAndStability));
    let (system, answer) = arch();
    assert_eq!(proved(&system, &answer), Some(Proved::Rank));
    let (system, answer) = propped(1.0, 0.0);
    assert_eq!(proved(&system, &answer), Some(Proved::Rank));
    let (system, answer) = four_legs(0.5);
    assert_eq!(proved(&system, &answer), Some(Proved::Stability));
    let (system, mut answer) = lamp();
    answer.axial_n.truncate(1);
    assert_eq!(proved(&system, &answer), None);
}

/// A cable in line with the first bar of the lamp, 10 m from end to end, without force: at its length within
/// 1e-8 m it may act, and then the lengths depend on each other; longer than that it is slack.
#[test]
fn cables_without_force_act_at_their_length() {
    let (system, mut answer) = lamp();
    let far_m = [-6.0, 0.0, 4.0];
    answer.joints_m.push(far_m);
    answer.axial_n.push(0.0);
    for (longer_m, wanted) in [(2e-9, Proved::Stability), (2e-8, Proved::RankAndStability)] {
        let (mut joints, mut members) = (system.joints().to_vec(), system.members().to_vec());
        joints.push(Joint::anchor("D", far_m));
        members.push(Member::cable(3, 2, Bar::homogeneous(10.0 + longer_m, 0.0).unwrap()));
        let roped = System::new("lamp", 10.0, joints, members).unwrap();
        assert_eq!(proved(&roped, &answer), Some(wanted), "{longer_m}");
    }
}
