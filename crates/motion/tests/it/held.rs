//! Small oscillations of what taut inextensible cables and the floor hold.

use model::Bar;
use model::system::{Joint, Kind, Member, Support, System};
use motion::{Direction, MotionError, Settings, Simulation, modes};

use crate::common::{G, hanging, links};

fn near(found: f64, told: f64, tolerance: f64) {
    assert!((found / told - 1.0).abs() < tolerance, "{found} {told}");
}

/// A weight of 2 kg at the end of two members to anchors 6 m apart, 4 m below them, and of a third
/// straight up to an anchor above.
fn lamp(kind: Kind, third_m: f64) -> System {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 1.0]], &[2.0]);
    let body = |l| Bar::homogeneous(l, 0.0).unwrap();
    let member = |a, l| Member::bar(a, 3, body(l)).of_kind(kind);
    let mut members = vec![member(0, 5.0), member(1, 5.0)];
    members.push(Member::cable(2, 3, body(third_m)));
    System::new("lamp", G, joints, members).unwrap()
}

const LAMP: [[f64; 3]; 4] = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -4.0]];

#[test]
fn taut_cables_swing_as_bars_and_slack_ones_not_at_all() {
    // The weight swings about the line of the anchors, 4 m below it.
    let found = modes(&lamp(Kind::Cable, 5.5), &LAMP, None).unwrap();
    let [mode] = &found.modes[..] else { panic!("{found:?}") };
    near(mode.omega2_s2, G / 4.0, 1e-13);
    assert_eq!(mode.direction, Direction::Across);
    let bars = modes(&lamp(Kind::Bar, 5.5), &LAMP, None).unwrap();
    assert_eq!(found.modes, bars.modes);
    // Struts would have to push.
    let refused = modes(&lamp(Kind::Strut, 5.5), &LAMP, None).unwrap_err();
    assert!(
        matches!(refused, MotionError::NeitherTautNorSlack { member: 1, kind: "strut", .. }),
        "{refused}"
    );
}

#[test]
fn a_cable_that_is_just_taut_and_bears_nothing_is_refused() {
    let axial = [2.0 * G * 5.0 / 8.0, 2.0 * G * 5.0 / 8.0, 0.0];
    let refused = modes(&lamp(Kind::Cable, 5.0), &LAMP, Some(&axial)).unwrap_err();
    assert!(
        matches!(refused, MotionError::NeitherTautNorSlack { member: 3, kind: "cable", .. }),
        "{refused}"
    );
    // Where it bears a part of the weight it slackens as the lamp swings: from 1 m above the line of the anchors, 4 m below
    // which the lamp turns by θ, it is sqrt(17 + 8 cos θ) m to it, and what it bears at rest is in no frequency.
    let axial = [0.6 * axial[0], 0.6 * axial[0], 0.4 * 2.0 * G];
    let refused = modes(&lamp(Kind::Cable, 5.0), &LAMP, Some(&axial)).unwrap_err();
    assert!(matches!(refused, MotionError::Singular), "{refused}");
}

#[test]
fn a_slack_cable_with_a_mass_moves_with_the_joint_that_it_hangs_on() {
    // Its mass of 3 kg is a homogeneous member's: a third of it at the joint that moves.
    let slack = |mass_kg| {
        let mut joints = hanging(&links(1), &[2.0]).joints().to_vec();
        joints.push(Joint::anchor("A", [0.5, 0.0, -1.0]));
        let cord = Bar::new(0.75, mass_kg, 0.375, Bar::slender_inertia(0.75, mass_kg)).unwrap();
        let members = vec![Member::bar(0, 1, links(1)[0]), Member::cable(2, 1, cord)];
        let system = System::new("slack", G, joints, members).unwrap();
        modes(&system, &[[0.0; 3], [0.0, 0.0, -1.0], [0.5, 0.0, -1.0]], None).unwrap()
    };
    for mass_kg in [0.0, 3.0] {
        for mode in slack(mass_kg).modes {
            let told = (2.0 + 0.5 * mass_kg) * G / (2.0 + mass_kg / 3.0);
            near(mode.omega2_s2, told, 1e-13);
        }
    }
}

/// A weight of 2 kg on the floor between two elastic cords of 1 m, stretched to 1.25 m.
fn on_the_floor(lifted_n: f64) -> System {
    held_on_the_floor(lifted_n, Support::Free)
}

fn held_on_the_floor(lifted_n: f64, support: Support) -> System {
    let weight = Joint::free("P").with_mass(2.0).with_force([0.0, 0.0, lifted_n]);
    let joints =
        vec![Joint::anchor("A", LAID[0]), Joint::anchor("B", LAID[1]), weight.held_by(support)];
    let cord = Bar::homogeneous(1.0, 0.0).unwrap();
    let members = [0, 1].map(|k| Member::cable(k, 2, cord).with_stiffness(400.0));
    System::new("laid", G, joints, members.to_vec()).unwrap().with_floor(0.25).unwrap()
}

const LAID: [[f64; 3]; 3] = [[-1.25, 0.0, 0.25], [1.25, 0.0, 0.25], [0.0, 0.0, 0.25]];

#[test]
fn what_the_floor_pushes_slides_on_it() {
    for lifted_n in [0.0, 1.9 * G] {
        let found = modes(&on_the_floor(lifted_n), &LAID, None).unwrap();
        let [across, along] = &found.modes[..] else { panic!("{found:?}") };
        // Both cords pull with EA/4: 2 T/(d m) across, 2 EA/(l m) along.
        near(across.omega2_s2, 2.0 * 100.0 / (1.25 * 2.0), 1e-13);
        near(along.omega2_s2, 2.0 * 400.0 / 2.0, 1e-13);
        assert_eq!([across.direction, along.direction], [Direction::Across, Direction::InPlane]);
    }
    // A wall that stands along the cords, or leans, leaves the motion along them; a rail down to the floor is
    // refused where it moves.
    for normal in [[0.0, 1.0, 0.0], [0.0, 0.8, 0.6]] {
        let wall = Support::Plane { at_m: LAID[2], normal };
        let found = modes(&held_on_the_floor(0.0, wall), &LAID, None).unwrap();
        let [along] = &found.modes[..] else { panic!("{found:?}") };
        near(along.omega2_s2, 2.0 * 400.0 / 2.0, 1e-13);
    }
    let rail = Support::Line { at_m: LAID[2], direction: [0.0, 0.0, 1.0] };
    let rail = held_on_the_floor(0.0, rail);
    let refused = Simulation::new(&rail, &LAID, Settings::default()).err();
    assert!(matches!(refused, Some(MotionError::FloorEndsLine { .. })), "{refused:?}");
    // With its weight taken it lies there without a push, and may rise.
    let refused = modes(&on_the_floor(2.0 * G), &LAID, None).unwrap_err();
    assert!(
        matches!(refused, MotionError::NotPushed { ref joint, .. } if joint == "P"),
        "{refused}"
    );
    let mut below = LAID;
    below[2][2] = 0.2;
    let refused = modes(&on_the_floor(0.0), &below, None).unwrap_err();
    assert!(matches!(refused, MotionError::Input { .. }), "{refused}");
}

#[test]
fn a_loaded_string_has_the_frequencies_of_lagrange() {
    // n beads on a floor between level anchors, on cords of 1 m stretched to 1.25 m: 2 √(T/(m a))
    // sin θ_k across and 2 √(EA/(l m)) sin θ_k along, θ_k = k π/(2 (n + 1)).
    let (n, mass_kg, stiffness_n) = (7_u32, 0.5, 400.0);
    let at: Vec<[f64; 3]> = (0..=n + 1).map(|k| [1.25 * f64::from(k), 0.0, 0.0]).collect();
    let mut joints = vec![Joint::anchor("A", at[0])];
    joints.extend((1..=n).map(|k| Joint::free(k.to_string()).with_mass(mass_kg)));
    joints.push(Joint::anchor("B", at[at.len() - 1]));
    let cord = Bar::homogeneous(1.0, 0.0).unwrap();
    let members = (0..=n as usize).map(|k| Member::bar(k, k + 1, cord).with_stiffness(stiffness_n));
    let system = System::new("string", G, joints, members.collect()).unwrap();
    let found = modes(&system.with_floor(0.0).unwrap(), &at, None).unwrap();
    let tension_n = 0.25 * stiffness_n;
    for (direction, by) in [
        (Direction::Across, tension_n / (mass_kg * 1.25)),
        (Direction::InPlane, stiffness_n / mass_kg),
    ] {
        let of: Vec<f64> = found
            .modes
            .iter()
            .filter(|mode| mode.direction == direction)
            .map(|mode| mode.omega2_s2)
            .collect();
        assert_eq!(of.len(), n as usize);
        for (k, omega2) in (1..=n).zip(of) {
            let angle = f64::from(k) * std::f64::consts::PI / f64::from(2 * (n + 1));
            near(omega2, 4.0 * by * angle.sin().powi(2), 1e-12);
        }
    }
}

/// A ring on the floor, on a rod from an anchor at the same height, is pushed by its weight and half of the rod's: by
/// more than a ten-millionth of the largest force, that of a weight which hangs elsewhere, or not at all.
#[test]
fn a_push_counts_beside_the_largest_force() {
    for (light_kg, heavy_kg, pushed) in
        [(2.0, 1e6, true), (2.0, 1e8, false), (2e-3, 1e3, true), (2e-3, 1e5, false)]
    {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("ring").with_mass(light_kg),
            Joint::anchor("B", [5.0, 0.0, 4.0]),
            Joint::free("weight").with_mass(heavy_kg),
        ];
        let link = |from, to| Member::bar(from, to, Bar::homogeneous(1.5, 0.0).unwrap());
        let system = System::new("floor", G, joints, vec![link(0, 1), link(2, 3)]).unwrap();
        let system = system.with_floor(0.0).unwrap();
        let at = [[0.0; 3], [1.5, 0.0, 0.0], [5.0, 0.0, 4.0], [5.0, 0.0, 2.5]];
        match modes(&system, &at, None) {
            Ok(_) => assert!(pushed, "{light_kg} {heavy_kg}"),
            Err(MotionError::NotPushed { joint, push_n }) => {
                assert!(!pushed && joint == "ring", "{light_kg} {heavy_kg}");
                assert!((push_n / (G * light_kg) - 1.0).abs() < 1e-6, "{push_n}");
            }
            Err(other) => panic!("{other}"),
        }
    }
}
