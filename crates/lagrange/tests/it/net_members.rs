//! Members of all kinds, supports that slide, loads on members: against closed forms.

use lagrange::net::{Error, Settings, solve};
use model::Vector;
use model::system::{Joint, Kind, Member};

use crate::net::{bar, cable, close, hang, near, system};

/// A cable that is longer than needed is slack; one that just reaches bears nothing.
#[test]
fn slack_and_just_taut_cables() {
    let joints = samples::joints(&[[0.0; 3], [5.0, 0.0, 0.0], [1.8, 3.0, -2.4]], &[10.0]);
    let with = |length| {
        let members = vec![cable(0, 3, 3.0, 0.0), bar(1, 3, 4.0, 0.0), cable(2, 3, length, 0.0)];
        hang(&system(joints.clone(), members))
    };
    let slack = with(3.5);
    assert_eq!((slack.slack.as_slice(), slack.limp.as_slice()), (&[2][..], &[][..]));
    near(slack.equilibrium.joints_m[3], [1.8, 0.0, -2.4]);
    close(slack.equilibrium.axial_n[0], 8.0);
    let taut = with(3.0);
    assert_eq!(taut.limp, [2]);
    near(taut.equilibrium.joints_m[3], [1.8, 0.0, -2.4]);
    close(taut.equilibrium.axial_n[1], 6.0);
}

/// Members between anchors: a spring has the force of its length, an inextensible bar one that
/// nothing decides, and one that does not fit is refused.
#[test]
fn members_between_anchors() {
    let joints = samples::joints(&[[0.0; 3], [2.0, 0.0, 0.0]], &[3.0]);
    let with = |member: Member| system(joints.clone(), vec![bar(0, 2, 1.0, 0.0), member]);
    let spring = bar(0, 1, 1.6, 0.0).with_stiffness(10.0);
    let solution = hang(&with(spring));
    close(solution.equilibrium.axial_n[1], 2.5);
    near(solution.equilibrium.reactions_n[1], [2.5, 0.0, 0.0]);
    close(solution.equilibrium.energy_j, -3.0 + 2.5 * 2.5 * 0.16 / 2.0);
    let rigid = hang(&with(bar(0, 1, 2.0, 0.0)));
    assert_eq!(rigid.self_stresses.as_ref().map(Vec::len), Some(1));
    close(rigid.equilibrium.axial_n[1], 0.0);
    let misfit = solve(&with(bar(0, 1, 1.6, 0.0)), &Settings::default());
    assert_eq!(misfit, Err(Error::HeldMisfit { member: 2, length_m: 1.6, distance_m: 2.0 }));
    let slack = hang(&with(cable(0, 1, 2.1, 0.0)));
    assert_eq!(slack.slack, [1]);
    let held = system(joints[..2].to_vec(), vec![bar(0, 1, 2.0, 4.0)]);
    near(hang(&held).equilibrium.reactions_n[1], [0.0, 0.0, 2.0]);
}

/// A strut that is given shorter than the place it has bears nothing; one that is longer pushes.
/// Two cables of 5 m from anchors 6 m apart to the ends of a spreader: with 2 m between the ends
/// the cables would have to end 2 m apart.
#[test]
fn spreader() {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[4.0, 4.0]);
    let with = |length: f64| {
        let strut = bar(2, 3, length, 0.0).of_kind(Kind::Strut);
        hang(&system(joints.clone(), vec![cable(0, 2, 5.0, 0.0), cable(1, 3, 5.0, 0.0), strut]))
    };
    // Each hangs straight down, 6 m apart.
    let idle = with(5.0);
    assert_eq!(idle.slack, [2]);
    near(idle.equilibrium.joints_m[2], [-3.0, 0.0, -5.0]);
    // 12 m between the ends spread the cables by 3 m each: 4 m deep, and 4 N * 3/4 in the strut.
    let pushing = with(12.0);
    close(pushing.equilibrium.joints_m[2][2], -4.0);
    close(pushing.equilibrium.axial_n[0], 5.0);
    close(pushing.equilibrium.axial_n[2], -3.0);
}

/// A massless bar below a lamp and a cable without load: neither has a force, and both are said to
/// be limp; the lamp hangs as without them.
#[test]
fn limp_members() {
    let joints = samples::joints(&[[0.0; 3]], &[2.0, 0.0, 0.0]);
    let members = vec![bar(0, 1, 1.0, 0.0), bar(1, 2, 0.5, 0.0), cable(1, 3, 0.5, 0.0)];
    let solution = hang(&system(joints, members));
    near(solution.equilibrium.joints_m[1], [0.0, 0.0, -1.0]);
    close(solution.equilibrium.axial_n[0], 2.0);
    assert!(solution.limp.contains(&1));
    assert!(solution.limp.contains(&2) || solution.slack.contains(&2));
}

/// Nullity by hand: a V swings back, one below the other's anchor it turns freely, and a third bar
/// in the plane of a V of sides 3, 4, 5 is one bar too many.
#[test]
fn nullity_counts_free_turns_and_self_stresses() {
    let joints = |second: Vector| samples::joints(&[[-3.0, 0.0, 0.0], second], &[2.0]);
    let two = |second| vec![bar(0, 2, 5.0, 0.0), bar(1, 2, second, 0.0)];
    let nullity = |joints, members| hang(&system(joints, members)).equilibrium.evidence.nullity;
    assert_eq!(nullity(joints([3.0, 0.0, 0.0]), two(5.0)), 0);
    assert_eq!(nullity(joints([-3.0, 0.0, -4.0]), two(4.0)), 1);
    let mut held = joints([3.0, 0.0, 0.0]);
    held.push(Joint::anchor("C", [0.0; 3]));
    let mut members = two(5.0);
    members.push(bar(3, 2, 4.0, 0.0));
    assert_eq!(nullity(held, members), 1);
}

/// 1 N on a rod of 2 m, and 1e-8 N towards the anchor of a cable that just reaches: it would have to
/// push with that, and hangs slack, so that the weight moves by 2e-8 m. Away from it the cable holds.
#[test]
fn a_cable_that_pushes_a_little_is_slack() {
    for (aside_n, moves_m, pull_n) in [(1e-8, 2e-8, 0.0), (-1e-8, 0.0, 1e-8)] {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [3.0, 0.0, -2.0]),
            Joint::free("P").with_force([aside_n, 0.0, -1.0]),
        ];
        let found = hang(&system(joints, vec![bar(0, 2, 2.0, 0.0), cable(1, 2, 3.0, 0.0)]));
        let (at, axial) = (found.equilibrium.joints_m[2], &found.equilibrium.axial_n);
        assert!((at[0] - moves_m).abs() < 1e-13, "{at:?}");
        assert!((axial[1] - pull_n).abs() < 1e-13, "{axial:?}");
    }
}

/// Weights between two anchors on one vertical each, where their bars fit one place alone. The least forces, by `sum F² l`
/// those of two springs, push more than they pull, `W (l2/l1 - l1/l2)/(l1 + l2) < 0` across, and would let them fall
/// aside; a self-stress that pulls both bars holds them.
#[test]
fn self_stresses_stiffen_what_the_least_forces_let_fall() {
    let columns = [(2.0, 1.0, 30.0), (1.5, 0.5, 8.0)];
    let (mut joints, mut members) = (vec![], vec![]);
    for (k, (above, below, weight)) in columns.into_iter().enumerate() {
        let x = 4.0 * k as f64;
        joints.push(Joint::anchor(format!("A{k}"), [x, 1.0, above]));
        joints.push(Joint::anchor(format!("B{k}"), [x, 1.0, -below]));
        joints.push(Joint::free(format!("P{k}")).with_mass(weight));
        members.push(bar(3 * k, 3 * k + 2, above, 0.0));
        members.push(bar(3 * k + 1, 3 * k + 2, below, 0.0));
    }
    let answer = hang(&system(joints, members)).equilibrium;
    for (k, (above, below, weight)) in columns.into_iter().enumerate() {
        near(answer.joints_m[3 * k + 2], [4.0 * k as f64, 1.0, 0.0]);
        close(answer.axial_n[2 * k], weight * below / (above + below));
        close(answer.axial_n[2 * k + 1], -weight * above / (above + below));
    }
}

/// Two bars of 1 m that hang by an angle of 1e-5 below the line between their anchors, which their tolerances do not
/// tell from a straight one: only as they are do they bear the weight.
#[test]
fn a_line_that_is_nearly_taut_bears_its_weight_as_it_is() {
    let half: f64 = 1.0 - 5e-11;
    let joints = samples::joints(&[[-half, 0.0, 0.0], [half, 0.0, 0.0]], &[1.0]);
    let found = solve(
        &system(joints, vec![bar(0, 2, 1.0, 0.0), bar(2, 1, 1.0, 0.0)]),
        &Settings::default(),
    );
    let answer = found.unwrap().equilibrium;
    let sine = ((1.0 - half) * (1.0 + half)).sqrt();
    assert!((answer.axial_n[0] * 2.0 * sine - 1.0).abs() < 1e-5, "{answer:?}");
    assert!((answer.joints_m[2][2] + sine).abs() < 1e-10, "{answer:?}");
}
