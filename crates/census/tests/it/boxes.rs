//! Proofs on closed forms, right and tampered with.

use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, NoBox, Vector};

use census::boxes::{MAX_UNKNOWNS, SystemBox, prove};

use crate::support::{light, system};

/// The proof at a closed form, which must lie in a box narrower than 1e-12 of lengths and forces of
/// order one.
fn proved(system: &System, joints_m: &[Vector], axial_n: &[f64]) -> SystemBox {
    let proof = prove(system, joints_m, axial_n).unwrap();
    // The closed forms themselves are rounded.
    assert!(proof.beyond_m(joints_m) < 4e-15 && proof.beyond_n(axial_n) < 1e-13, "{proof:?}");
    assert!(proof.width_m < 1e-12 && proof.width_n < 1e-12, "{proof:?}");
    // Away from the closed form the same zero is found, and it is told that it lies elsewhere.
    let shifted: Vec<Vector> = joints_m.iter().map(|x| [x[0], x[1], x[2] + 1e-9]).collect();
    if let Ok(other) = prove(system, &shifted, axial_n) {
        assert!(other.beyond_m(&shifted) > 1e-10, "{other:?}");
    }
    let harder: Vec<f64> = axial_n.iter().map(|n| n * (1.0 + 1e-9)).collect();
    assert!(axial_n.iter().all(|n| n.abs() < 1e-3) || proof.beyond_n(&harder) > 1e-13);
    proof
}

/// A weight of 2 N on two members of 5 m between anchors 6 m apart: 5/4 N each.
fn hanger(second: Kind) -> System {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.2]);
    let members =
        vec![Member::bar(0, 2, light(5.0)), Member::bar(2, 1, light(5.0)).of_kind(second)];
    system(joints, members)
}

fn below(z: f64) -> [Vector; 3] {
    [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, z]]
}

#[test]
fn a_hanger_and_its_image_above() {
    for kind in [Kind::Bar, Kind::Cable] {
        let proof = proved(&hanger(kind), &below(-4.0), &[1.25; 2]);
        assert_eq!((proof.turns, proof.slack.len()), (0, 0));
    }
    // Above, both members push: bars and struts may, a cable may not; below, a strut may not pull.
    for kind in [Kind::Bar, Kind::Strut] {
        proved(&hanger(kind), &below(4.0), &[-1.25; 2]);
    }
    for (kind, z) in [(Kind::Cable, 4.0), (Kind::Strut, -4.0)] {
        let axial_n = [-1.25 * f64::signum(z); 2];
        assert_eq!(prove(&hanger(kind), &below(z), &axial_n), Err(NoBox::WrongSign { member: 2 }));
    }
}

#[test]
fn what_is_no_equilibrium_is_not_proved() {
    let system = hanger(Kind::Bar);
    for joints_m in [below(-3.9), below(0.0), below(f64::NAN)] {
        assert!(prove(&system, &joints_m, &[1.25; 2]).is_err());
    }
    assert_eq!(prove(&system, &below(-4.0), &[-1.25; 2]), Err(NoBox::NotConverged));
    assert_eq!(prove(&system, &below(-4.0)[..2], &[1.25; 2]), Err(NoBox::NotFinite));
}

/// A string with loads of 16 N and 9 N and the horizontal pull 12 N: slopes 4/3, 0, 3/4 of bars of
/// 5 m.
#[test]
fn a_loaded_string() {
    let joints = vec![
        Joint::anchor("A", [1.0, 0.0, 2.0]),
        Joint::free("P").with_force([0.0, 0.0, -16.0]),
        Joint::free("Q").with_mass(0.9),
        Joint::anchor("B", [13.0, 0.0, 1.0]),
    ];
    let members = (0..3).map(|k| Member::cable(k, k + 1, light(5.0))).collect();
    let at = [[1.0, 0.0, 2.0], [4.0, 0.0, -2.0], [9.0, 0.0, -2.0], [13.0, 0.0, 1.0]];
    proved(&system(joints, members), &at, &[20.0, 12.0, 15.0]);
}

/// Three strands from the corners of a triangle to a ring, and a lamp of 12 N below it: each strand
/// reaches 3 m in and 4 m down, so it bears a third of the load times 5/4.
#[test]
fn a_symmetric_bridle_and_a_tripod() {
    let half = 0.5 * 3.0_f64.sqrt();
    let corners = [[3.0, 0.0, 0.0], [-1.5, 3.0 * half, 0.0], [-1.5, -3.0 * half, 0.0]];
    let mut joints: Vec<Joint> =
        corners.iter().enumerate().map(|(k, at)| Joint::anchor(k.to_string(), *at)).collect();
    joints.push(Joint::free("ring"));
    joints.push(Joint::free("lamp").with_mass(1.2));
    let mut members: Vec<Member> = (0..3).map(|k| Member::bar(k, 3, light(5.0))).collect();
    members.push(Member::bar(3, 4, light(2.0)));
    let bridle = system(joints, members);
    let at = |ring: f64, lamp: f64| {
        let mut at = corners.to_vec();
        at.extend([[0.0, 0.0, ring], [0.0, 0.0, lamp]]);
        at
    };
    proved(&bridle, &at(-4.0, -6.0), &[5.0, 5.0, 5.0, 12.0]);
    proved(&bridle, &at(4.0, 2.0), &[-5.0, -5.0, -5.0, 12.0]);
    proved(&bridle, &at(4.0, 6.0), &[-5.0, -5.0, -5.0, -12.0]);
}

/// Springs of 4 m and 5 N per doubling, drawn to 5 m: 5/4 N each.
#[test]
fn a_hanger_of_springs() {
    let spring = |from, to| Member::bar(from, to, light(4.0)).with_stiffness(5.0);
    let joints = hanger(Kind::Bar).joints().to_vec();
    let members = vec![spring(0, 2), spring(2, 1).of_kind(Kind::Cable)];
    let springs = system(joints.clone(), members);
    proved(&springs, &below(-4.0), &[1.25; 2]);
    // A third one between the anchors bears what its law says, 5 (6 - 4)/4 N, and a cable of 7 m
    // nothing.
    let mut members = vec![spring(0, 2), spring(2, 1), spring(0, 1)];
    let with_third = system(joints.clone(), members.clone());
    proved(&with_third, &below(-4.0), &[1.25, 1.25, 2.5]);
    members[2] = Member::cable(0, 1, light(7.0));
    let proof = proved(&system(joints.clone(), members.clone()), &below(-4.0), &[1.25, 1.25, 0.0]);
    assert_eq!(proof.slack, [] as [usize; 0]);
    // A bar between the anchors bears nobody knows what.
    members[2] = Member::bar(0, 1, light(6.0));
    assert_eq!(
        prove(&system(joints, members), &below(-4.0), &[1.25, 1.25, 0.0]),
        Err(NoBox::BetweenAnchors { member: 3 })
    );
}

/// On a vertical line through the middle only half of the hanger is needed; in a plane x = 0 too.
#[test]
fn sliders() {
    let at = [[-3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    let at_m = [0.0, 0.0, 7.0];
    let line = Support::Line { at_m, direction: [0.0, 0.0, 1.0] };
    let plane = Support::Plane { at_m, normal: [1.0, 0.0, 0.0] };
    for support in [line, plane] {
        let slider = Joint::free("P").with_mass(0.1).held_by(support);
        let joints = vec![Joint::anchor("A", at[0]), slider];
        proved(&system(joints, vec![Member::bar(0, 1, light(5.0))]), &at, &[1.25]);
    }
    // A floor that slopes by 3/4: the bar is drawn down along it by 1 N (3/5), normal to it nothing
    // is asked.
    let normal = [-0.6, 0.0, 0.8];
    let slider = Joint::free("P").with_mass(0.1).held_by(Support::Plane { at_m: [0.0; 3], normal });
    let joints = vec![Joint::anchor("A", [4.0, 0.0, 3.0]), slider];
    let slope = system(joints, vec![Member::bar(0, 1, light(5.0))]);
    proved(&slope, &[[4.0, 0.0, 3.0], [0.0, 0.0, 0.0]], &[0.6]);
}

#[test]
fn self_stresses_and_free_motions_are_counted() {
    let corners = [[3.0, 0.0, 0.0], [-3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, -3.0, 0.0]];
    let mut joints: Vec<Joint> =
        corners.iter().enumerate().map(|(k, at)| Joint::anchor(k.to_string(), *at)).collect();
    joints.push(Joint::free("P").with_mass(1.6));
    let members: Vec<Member> = (0..4).map(|k| Member::bar(k, 4, light(5.0))).collect();
    let mut at = corners.to_vec();
    at.push([0.0, 0.0, -4.0]);
    let pyramid = system(joints.clone(), members.clone());
    assert_eq!(prove(&pyramid, &at, &[5.0; 4]), Err(NoBox::SelfStresses { dimension: 1 }));
    // Three bars and a massless one that nothing loads: it points anywhere, and the turn about the
    // vertical is held fast.
    let mut three = members[..3].to_vec();
    three.push(Member::bar(4, 5, light(1.0)));
    joints.push(Joint::free("Q"));
    at.push([1.0, 0.0, -4.0]);
    let limp = system(joints, three);
    assert_eq!(
        prove(&limp, &at, &[10.0, 10.0, 0.0, 0.0]),
        Err(NoBox::FreeMotions { dimension: 1 })
    );
}

/// Anchors above each other: the joint between them goes round in a circle.
#[test]
fn a_part_that_turns_is_held_fast() {
    let joints = samples::joints(&[[1.0, 2.0, 0.0], [1.0, 2.0, -6.0]], &[0.2]);
    let members = vec![Member::bar(0, 2, light(5.0)), Member::bar(2, 1, light(5.0))];
    let upright = system(joints.clone(), members.clone());
    let at = [[1.0, 2.0, 0.0], [1.0, 2.0, -6.0], [1.0 + 4.0 * 0.6, 2.0 + 4.0 * 0.8, -3.0]];
    assert_eq!(proved(&upright, &at, &[5.0 / 3.0, -5.0 / 3.0]).turns, 1);
    // With anchors that miss the vertical by a little there is no free turn, and next to none is no
    // proof.
    let mut off = joints;
    off[1] = Joint::anchor("B", [1.0 + 1e-13, 2.0, -6.0]);
    let off = system(off, members);
    let found = prove(&off, &at, &[5.0 / 3.0, -5.0 / 3.0]);
    assert!(matches!(found, Err(NoBox::FreeMotions { dimension: 1 })), "{found:?}");
}

/// A mobile: a bar hangs from A, a triangle on it, and on a corner of that another one. Each
/// triangle turns about the vertical through the joint on which it hangs; plumb bars have nothing
/// to turn.
#[test]
fn what_hangs_on_one_joint_turns() {
    let joints = vec![
        Joint::anchor("A", [0.0, 0.0, 0.0]),
        Joint::free("P"),
        Joint::free("left").with_mass(0.2),
        Joint::free("right").with_mass(0.1),
        Joint::free("Q"),
        Joint::free("low left").with_mass(0.05),
        Joint::free("low right").with_mass(0.05),
    ];
    let members = vec![
        Member::bar(0, 1, light(1.0)),
        Member::bar(1, 2, light(5.0)),
        Member::bar(1, 3, light(5.0)),
        Member::bar(2, 3, light(6.0)),
        Member::bar(3, 4, light(1.0)),
        Member::bar(4, 5, light(5.0)),
        Member::bar(4, 6, light(5.0)),
        Member::bar(5, 6, light(6.0)),
    ];
    // Both corners bear 2 N. The lower triangle is turned by the angle whose cosine is 3/5.
    let at = [
        [0.0, 0.0, 0.0],
        [0.0, 0.0, -1.0],
        [-3.0, 0.0, -5.0],
        [3.0, 0.0, -5.0],
        [3.0, 0.0, -6.0],
        [3.0 - 1.8, -2.4, -10.0],
        [3.0 + 1.8, 2.4, -10.0],
    ];
    let axial_n = [4.0, 2.5, 2.5, -1.5, 1.0, 0.625, 0.625, -0.375];
    assert_eq!(proved(&system(joints, members), &at, &axial_n).turns, 2);
}

/// The hanger with a cable that is too long, and a joint that hangs in slack cables.
#[test]
fn slack_cables_are_proved_slack() {
    let mut joints = hanger(Kind::Bar).joints().to_vec();
    let mut members = hanger(Kind::Bar).members().to_vec();
    joints.push(Joint::anchor("C", [0.0, 0.0, 1.0]));
    joints.push(Joint::free("Q"));
    members.push(Member::cable(2, 3, light(5.5)));
    members.push(Member::cable(2, 4, light(3.0)));
    members.push(Member::cable(3, 4, light(6.0)));
    let net = system(joints.clone(), members.clone());
    let mut at = below(-4.0).to_vec();
    at.extend([[0.0, 0.0, 1.0], [0.5, 0.5, -3.0]]);
    let axial_n = [1.25, 1.25, 0.0, 0.0, 0.0];
    let proof = proved(&net, &at, &axial_n);
    assert_eq!((proof.slack, proof.loose_joints), (vec![2, 3, 4], vec![4]));
    // The weight of a cable that an anchor bears alone leaves it loose, whichever end that is; at its
    // own end it does not.
    let heavy = |from: usize, to: usize, centre_m: f64| {
        let body = Bar::new(6.0, 1.0, centre_m, [0.0; 3]).unwrap();
        let members = [&members[..4], &[Member::cable(from, to, body)]].concat();
        prove(&system(joints.clone(), members), &at, &axial_n)
    };
    for on_anchor in [heavy(3, 4, 0.0), heavy(4, 3, 6.0)] {
        assert_eq!(on_anchor.unwrap().loose_joints, vec![4]);
    }
    for on_joint in [heavy(3, 4, 6.0), heavy(4, 3, 0.0)] {
        assert!(on_joint.is_err());
    }
    // Just long enough is neither slack nor taut.
    members[2] = Member::cable(2, 3, light(5.0));
    let net = system(joints, members);
    assert_eq!(prove(&net, &at, &axial_n), Err(NoBox::Degenerate { member: 3 }));
}

#[test]
fn large_systems_are_refused_by_their_number_of_unknowns() {
    let joints = (0..=200).map(|k| {
        let at = [f64::from(k), 0.0, 0.0];
        if k % 200 == 0 { Joint::anchor(k.to_string(), at) } else { Joint::free(k.to_string()) }
    });
    let members = (0..200).map(|k| Member::bar(k, k + 1, Bar::homogeneous(1.5, 1.0).unwrap()));
    let long = system(joints.collect(), members.collect());
    let at: Vec<Vector> = (0..=200).map(|k| [f64::from(k), 0.0, 0.0]).collect();
    let refused = prove(&long, &at, &[1.0; 200]);
    assert_eq!(refused, Err(NoBox::TooLarge { unknowns: 199 * 3 + 200, limit: MAX_UNKNOWNS }));
}

/// The hanger below a strut that is too short to push, and one that says so by less than the answer
/// is off.
#[test]
fn slack_struts_are_proved_slack() {
    let mut joints = hanger(Kind::Bar).joints().to_vec();
    joints.push(Joint::anchor("C", [0.0, 0.0, 1.0]));
    let with = |kind: Kind, length_m: f64| {
        let mut members = hanger(Kind::Bar).members().to_vec();
        members.push(Member::bar(2, 3, light(length_m)).of_kind(kind));
        system(joints.clone(), members)
    };
    let at = |z: f64| [below(z).to_vec(), vec![[0.0, 0.0, 1.0]]].concat();
    let axial_n = [1.25, 1.25, 0.0];
    let proof = proved(&with(Kind::Strut, 4.5), &at(-4.0), &axial_n);
    assert_eq!((proof.slack, proof.loose_joints), (vec![2], vec![]));
    // Or that is as long as the distance, which a proof encloses and does not tell from it.
    for (kind, length_m, z) in [
        (Kind::Strut, 5.0002, -4.0004),
        (Kind::Cable, 4.9998, -3.9996),
        (Kind::Strut, 5.0, -4.0004),
        (Kind::Cable, 5.0, -3.9996),
    ] {
        let refused = prove(&with(kind, length_m), &at(z), &axial_n);
        assert_eq!(refused, Err(NoBox::NotSlack { member: 3 }));
    }
}

/// A level push of 10⁻⁴ N towards an anchor 1 m aside is no pull of the cable from it, though the
/// answer says so.
#[test]
fn a_cable_that_an_answer_draws_tight_may_be_pushed() {
    let mut joints = hanger(Kind::Bar).joints().to_vec();
    joints[2].force_n = [0.0, 1e-4, 0.0];
    joints.push(Joint::anchor("C", [0.0, 1.0, -4.0]));
    let mut members = hanger(Kind::Bar).members().to_vec();
    members.push(Member::cable(2, 3, light(1.0)));
    let pushed = system(joints.clone(), members.clone());
    let at = [below(-4.0).to_vec(), vec![[0.0, 1.0, -4.0]]].concat();
    let refused = prove(&pushed, &at, &[1.25, 1.25, 1e-4]);
    assert_eq!(refused, Err(NoBox::WrongSign { member: 3 }));
    members[2] = members[2].clone().of_kind(Kind::Strut);
    proved(&system(joints, members), &at, &[1.25, 1.25, -1e-4]);
}

/// A joint of 5 N lies on the floor and is drawn aside against a bar that rises by 45° to an anchor:
/// with 3 N the floor bears the 2 N that are left, with 6 N the joint would rise.
#[test]
fn the_floor_pushes_what_lies_on_it() {
    for ends in [[0, 1], [1, 0]] {
        let drawn = |force_n: f64| {
            let mut joints = vec![
                Joint::anchor("A", [0.0, 0.0, 3.0]),
                Joint::free("P").with_mass(0.5),
                Joint::anchor("B", [0.0, 5.0, 3.0]),
            ];
            joints[1].force_n = [force_n, 0.0, 0.0];
            // The second one has no force, and keeps the joint from turning.
            let diagonal = 18.0_f64.sqrt();
            let members = vec![
                Member::bar(ends[0], ends[1], light(diagonal)),
                Member::bar(1, 2, light(43.0_f64.sqrt())),
            ];
            let system = system(joints, members).with_floor(0.0).unwrap();
            let at = [[0.0, 0.0, 3.0], [3.0, 0.0, 0.0], [0.0, 5.0, 3.0]];
            prove(&system, &at, &[force_n * 2.0_f64.sqrt(), 0.0])
        };
        let proof = drawn(3.0).unwrap();
        assert!(proof.axial_n[0].contains(18.0_f64.sqrt()), "{proof:?}");
        assert_eq!(drawn(6.0), Err(NoBox::Floor { joint: 2 }));
    }
}
