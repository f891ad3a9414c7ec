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

/// A post under a rope, whose spans are of two lengths: across their plane the rope resists with T (1/a + 1/b),
/// the post falls with N/h. Along the plane both keep their lengths.
#[test]
fn a_rope_holds_a_post_up_to_its_stiffness_across() {
    let at = [[-3.0, 0.0, 0.5], [5.0, 0.0, 2.5], [0.0, 0.0, -5.0], [0.0, 0.0, -1.0]];
    let [a, b] = [f64::hypot(3.0, 1.5), f64::hypot(5.0, 3.5)];
    let mut joints: Vec<Joint> =
        at[..3].iter().zip(["A", "B", "foot"]).map(|(at, name)| Joint::anchor(name, *at)).collect();
    joints.push(Joint::free("top").with_mass(1.0));
    let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let members = [Member::cable(0, 1, body(a + b)).over(vec![3]), Member::bar(2, 3, body(4.0))];
    let with = |more: &[Member]| {
        let members = [&members[..], more].concat();
        System::new("a post under a rope", 10.0, joints.clone(), members).unwrap()
    };
    let (system, (_, mut answer)) = (with(&[]), lamp());
    answer.joints_m = at.to_vec();
    let tension_n = 7.0;
    let most_n = 4.0 * tension_n * (1.0 / a + 1.0 / b);
    for (part, wanted) in [(0.999, Proved::RankAndStability), (1.001, Proved::Rank)] {
        answer.axial_n = vec![tension_n, -part * most_n];
        assert_eq!(proved(&system, &answer), Some(wanted));
    }
    // A second rope that does not run along the first leaves one length too many.
    let stay = [Member::cable(0, 2, body(a + 4.0)).over(vec![3])];
    answer.axial_n = vec![tension_n, -0.5 * most_n, 0.0];
    assert_eq!(proved(&with(&stay), &answer), Some(Proved::Stability));
    // A span without length is a corner, of which nothing is proved.
    answer.joints_m[0] = at[3];
    answer.axial_n.truncate(2);
    assert_eq!(proved(&system, &answer), None);
}
