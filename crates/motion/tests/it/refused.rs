//! What is refused, and with which numbers.

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{Mechanism, MotionError, Settings, Simulation};

use numerics::vector::minus;

use crate::common::{at_rest, hanging, links, rods, string};

fn rod() -> Bar {
    Bar::homogeneous(1.0, 1.0).unwrap()
}

#[test]
fn cables_and_unequal_moments_are_refused() {
    let joints = || vec![Joint::anchor("O", [0.0; 3]), Joint::free("P")];
    let cable = System::new("cable", 9.81, joints(), vec![Member::cable(0, 1, rod())]).unwrap();
    assert_eq!(
        Mechanism::new(&cable).unwrap_err(),
        MotionError::Unilateral { member: 1, kind: "cable" }
    );
    let flat = Bar::new(1.0, 1.0, 0.5, [0.1, 0.2, 0.3]).unwrap();
    let flat = System::new("flat", 9.81, joints(), vec![Member::bar(0, 1, flat)]).unwrap();
    // Small oscillations are of any body; motions of such as are not flat, and this is a plate.
    assert!(Mechanism::new(&flat).is_ok());
    let at = [[0.0; 3], [1.0, 0.0, 0.0]];
    let refused = Simulation::new(&flat, &at, Settings::default()).err().unwrap();
    assert!(matches!(refused, MotionError::UnequalMoments { member: 1, .. }), "{refused}");
}

#[test]
fn a_joint_without_inertia_is_named() {
    let system = hanging(&links(2), &[0.0, 1.0]);
    let at = string(&[1.0, 1.0], &[0.1, 0.2]);
    let refused = Simulation::new(&system, &at, Settings::default()).err().unwrap();
    assert!(
        matches!(refused, MotionError::Massless { ref joint, .. } if joint == "P1"),
        "{refused}"
    );
}

#[test]
fn a_taut_line_is_told() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P"),
        Joint::anchor("B", [2.0, 0.0, 0.0]),
        Joint::free("Q"),
    ];
    let members =
        vec![Member::bar(0, 1, rod()), Member::bar(1, 2, rod()), Member::bar(1, 3, rod())];
    let taut = System::new("taut", 9.81, joints, members).unwrap();
    let at = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, -1.0]];
    let refused = Simulation::new(&taut, &at, Settings::default()).err().unwrap();
    assert!(
        matches!(refused, MotionError::Redundant { ref joint, .. } if joint == "P"),
        "{refused}"
    );
}

/// A bar between the anchors of a pendulum, and one whose own anchors are fixed: the pendulum swings as without, sqrt(3g/2l).
#[test]
fn a_bar_between_anchors_changes_no_motion() {
    let joints =
        vec![Joint::anchor("A", [0.0; 3]), Joint::free("P"), Joint::anchor("B", [2.0, 0.0, 0.0])];
    let between = Member::bar(0, 2, Bar::homogeneous(2.0, 1.0).unwrap());
    let system =
        System::new("pendulum", 9.81, joints, vec![Member::bar(0, 1, rod()), between]).unwrap();
    let places = [[0.0; 3], [0.0, 0.0, -1.0], [2.0, 0.0, 0.0]];
    let modes = motion::modes(&system, &places, None).unwrap();
    for mode in &modes.modes {
        assert!((mode.omega2_s2 / (1.5 * 9.81) - 1.0).abs() < 1e-12, "{}", mode.omega2_s2);
    }
    assert_eq!(modes.modes.len(), 2);
    let mut simulation = Simulation::new(&system, &places, Settings::default()).unwrap();
    simulation.step(1e-2).unwrap();
    assert!(minus(simulation.joints_m()[1], places[1]).iter().all(|x| x.abs() < 1e-12));
}

/// A weight on a spring of 1e8 N/m far from the origin, whose places are rounded to 1e-9 m and its force to 0.05 N: its
/// frequencies are those of a spring pendulum.
#[test]
fn modes_far_from_the_origin_are_those_at_it() {
    for far_m in [0.0, 5.2e6] {
        let place = |z: f64| [far_m, 0.3 * far_m, far_m + z];
        let joints = vec![Joint::anchor("A", place(0.0)), Joint::free("P").with_mass(80.0)];
        let body = Bar::homogeneous(1.0, 0.0).unwrap();
        let spring = Member::bar(0, 1, body).with_stiffness(1e8);
        let system = System::new("spring", 10.0, joints, vec![spring]).unwrap();
        let at = [place(0.0), place(-1.0 - 8e-6)];
        let found = motion::modes(&system, &at, None).unwrap().modes;
        let rates: Vec<f64> = found.iter().map(|mode| mode.omega2_s2).collect();
        for (rate, wanted) in rates.iter().zip([10.0, 10.0, 1e8 / 80.0]) {
            assert!((rate / wanted - 1.0).abs() < 1e-4, "{far_m}: {rates:?}");
        }
    }
}

#[test]
fn places_off_the_lengths_are_refused_and_rounded_ones_tidied() {
    let system = hanging(&rods(1), &[]);
    let off = Simulation::new(&system, &[[0.0; 3], [1.1, 0.0, 0.0]], Settings::default());
    assert!(matches!(off, Err(MotionError::NotClosed { .. })));
    let near = [[0.0; 3], [0.866_025, 0.0, -0.5]];
    let tidied = Simulation::new(&system, &near, Settings::default()).unwrap();
    let [x, _, z] = tidied.joints_m()[1];
    assert!((x.hypot(z) - 1.0).abs() < 1e-15);
    let few = Simulation::new(&system, &[[0.0; 3]], Settings::default());
    assert!(matches!(few, Err(MotionError::Input { .. })));
    let negative = Settings { damping_1_s: -1.0, ..Settings::default() };
    assert!(matches!(Simulation::new(&system, &near, negative), Err(MotionError::Input { .. })));
}

#[test]
fn a_step_that_is_too_long_is_refused_and_not_taken_for_solved() {
    let system = hanging(&rods(2), &[]);
    let mut simulation = at_rest(&system, &string(&[1.0, 1.0], &[1.0, 2.0]), motion::Order::Second);
    let failed = (0..100).find_map(|_| simulation.step(2.0).err());
    assert!(matches!(failed, Some(MotionError::StepTooLong { .. })), "{failed:?}");
}

/// A weight of 1 kg between two springs of 10⁷ N/m.
fn between_springs(stiffness_n: f64) -> Simulation {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(1.0),
        Joint::anchor("B", [2.1, 0.0, 0.0]),
    ];
    let spring = Bar::homogeneous(1.0, 0.0).unwrap();
    let members = [0, 1].map(|k| Member::bar(k, k + 1, spring).with_stiffness(stiffness_n));
    let system = System::new("springs", 9.81, joints, members.into()).unwrap();
    let places = [[0.0; 3], [1.0, 0.0, -0.1], [2.1, 0.0, 0.0]];
    Simulation::new(&system, &places, Settings::default()).unwrap()
}

/// A step of a millisecond is longer than `2/ω = 2/sqrt(2k/m)`, beyond which oscillations grow: it
/// is taken in parts, and the energy stays in its band.
#[test]
fn a_step_longer_than_the_oscillations_of_springs_is_taken_in_parts() {
    let mut simulation = between_springs(1e7);
    assert!((simulation.longest_step_s() - 1.0 / 2e7_f64.sqrt()).abs() < 1e-12);
    assert_eq!(simulation.parts_of(1e-3).unwrap(), 5);
    let before_j = simulation.energy_j();
    let kinetic_j: Vec<f64> = (0..10_000)
        .map(|_| {
            simulation.step(1e-3).unwrap();
            assert!((simulation.energy_j() - before_j).abs() < 0.3 * before_j);
            simulation.kinetic_j()
        })
        .collect();
    // It swings by 5 cm about the middle: half of 2k times its square, 25 kJ.
    let most_j = kinetic_j.iter().copied().fold(0.0, f64::max);
    assert!((most_j / 25e3 - 1.0).abs() < 0.3, "{most_j}");
}

#[test]
fn a_step_that_would_be_ten_thousands_of_parts_is_refused_with_one_that_works() {
    let mut simulation = between_springs(1e17);
    let Err(MotionError::Stiff { most_s, .. }) = simulation.step(1e-3) else { panic!("too long") };
    assert!(simulation.step(most_s).is_ok());
}

#[test]
fn speeds_beyond_all_numbers_are_refused() {
    let mut simulation = between_springs(1e-3);
    simulation.add_force(1, Box::new(|_| [1e308, 0.0, 0.0])).unwrap();
    let failed = (0..100).find_map(|_| simulation.step(10.0).err());
    assert!(matches!(failed, Some(MotionError::Overflow { .. })), "{failed:?}");
}
