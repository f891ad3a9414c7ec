//! Newton's and Euler's laws, and the balance at the anchors, at stored times.

use model::Bar;
use model::system::{Joint, Member, PointLoad, Support, System};
use motion::{Order, Settings, Simulation};

use crate::common::{hanging, run, string};

/// Rounding of the accelerations, relative to the largest force.
const LAWS: f64 = 1e-12;

/// Bars off centre with loads, a spring, a slider on a line and one in a plane, a loop.
fn mixed() -> (System, Vec<[f64; 3]>) {
    let bar = |l: f64, m: f64, r: f64, j: f64| Bar::new(l, m, r, [0.0, j, j]).unwrap();
    let line = Support::Line { at_m: [1.0, 0.0, 0.2], direction: [0.6, 0.8, 0.0] };
    let plane = Support::Plane { at_m: [0.0, 1.0, 0.0], normal: [0.0, 1.0, 0.0] };
    let joints = vec![
        Joint::anchor("A", [0.1, 0.0, 0.2]),
        Joint::free("P").with_mass(0.5).with_force([1.0, -2.0, 0.5]),
        Joint::free("Q").held_by(line),
        Joint::free("R").with_mass(0.3).held_by(plane),
        Joint::free("S"),
    ];
    let at = vec![
        [0.1, 0.0, 0.2],
        [0.5, 0.4, -0.6],
        [1.6, 0.8, 0.2],
        [0.4, 1.0, -1.4],
        [1.2, 0.5, -1.1],
    ];
    let mut members = vec![
        Member::bar(0, 1, bar(1.0, 1.0, 0.3, 0.05)),
        Member::bar(1, 2, bar(1.0, 2.0, 0.4, 0.1)),
        Member::bar(3, 1, bar(1.0, 0.7, 0.5, 0.06)),
        Member::bar(1, 4, bar(1.0, 0.7, 0.5, 0.06)),
        Member::bar(4, 3, bar(1.0, 0.4, 0.2, 0.03)),
        Member::bar(4, 2, bar(1.0, 0.5, 0.5, 0.05)).with_stiffness(300.0),
    ];
    members[1].loads.push(PointLoad { at_m: 0.1, force_n: [0.5, 0.2, 3.0], is_spread: false });
    for member in &mut members {
        // The lengths are those of the places.
        let d: [f64; 3] = std::array::from_fn(|k| at[member.to][k] - at[member.from][k]);
        let l = d.iter().map(|x| x * x).sum::<f64>().sqrt();
        let body = member.body;
        let r = body.centre_m() * l;
        let j = body.inertia_kg_m2();
        member.body = Bar::new(l, body.mass_kg(), r, j).unwrap();
    }
    members[1].loads[0].at_m *= members[1].body.length_m();
    (System::new("mixed", 9.81, joints, members).unwrap(), at)
}

#[test]
fn loads_springs_sliders_loops_damping_and_forces_of_time_obey_the_laws() {
    let (system, at) = mixed();
    let damped = Settings { damping_1_s: 0.4, friction_n_m_s: 0.05, ..Settings::default() };
    for settings in [Settings::default(), damped] {
        let mut simulation = Simulation::new(&system, &at, settings).unwrap();
        let pull = |t: f64| [3.0 * (5.0 * t).sin(), 0.0, 1.0];
        simulation.add_force(4, Box::new(pull)).unwrap();
        simulation.push(&[[0.1, 0.3, -0.2]; 5]).unwrap();
        for _ in 0..20 {
            run(&mut simulation, 0.02, 1e-3);
            let now = simulation.snapshot();
            assert!(now.laws.largest() < LAWS, "{:?}", now.laws);
            assert!((f64::MIN_POSITIVE..1e-12).contains(&now.lengths_off), "rounding is left");
            assert!(now.rates_off < 1e-12);
            // The support on a line does not pull along it.
            let along = 0.6 * now.reactions_n[2][0] + 0.8 * now.reactions_n[2][1];
            assert!(along.abs() < 1e-10, "{along}");
        }
    }
}

#[test]
fn bars_with_three_moments_obey_the_laws() {
    let (system, at) = mixed();
    let mut members = system.members().to_vec();
    for member in [0, 1, 3] {
        let body = members[member].body;
        let j = body.inertia_kg_m2()[1];
        let [l, m, r] = [body.length_m(), body.mass_kg(), body.centre_m()];
        members[member].body = Bar::new(l, m, r, [0.6 * j, j, 1.3 * j]).unwrap();
    }
    let system = System::new("mixed", 9.81, system.joints().to_vec(), members).unwrap();
    let settings = Settings { damping_1_s: 0.4, friction_n_m_s: 0.01, ..Settings::default() };
    let mut simulation = Simulation::new(&system, &at, settings).unwrap();
    simulation.push(&[[0.1, 0.3, -0.2]; 5]).unwrap();
    for _ in 0..20 {
        run(&mut simulation, 0.02, 1e-3);
        let now = simulation.snapshot();
        assert!(now.laws.largest() < LAWS, "{:?}", now.laws);
        assert_eq!([now.joints_m.len(), now.axial_n.len(), now.turning.len()], [5, 6, 3]);
    }
}

#[test]
fn accelerations_are_the_derivatives_of_the_velocities() {
    let (system, at) = mixed();
    let settings = Settings { order: Order::Fourth, damping_1_s: 0.4, friction_n_m_s: 0.05 };
    let mut simulation = Simulation::new(&system, &at, settings).unwrap();
    simulation.push(&[[0.1, 0.3, -0.2]; 5]).unwrap();
    run(&mut simulation, 0.1, 1e-3);
    let now = simulation.snapshot();
    let h = 1e-4;
    simulation.step(h).unwrap();
    let ahead = simulation.velocities_m_s();
    simulation.step(-h).unwrap();
    simulation.step(-h).unwrap();
    let behind = simulation.velocities_m_s();
    for joint in 0..5 {
        for k in 0..3 {
            let slope = (ahead[joint][k] - behind[joint][k]) / (2.0 * h);
            let told = now.accelerations_m_s2[joint][k];
            assert!((slope - told).abs() < 1e-4 * 10.0, "joint {joint}: {slope} {told}");
        }
    }
}

#[test]
fn damping_takes_energy_at_the_rate_of_its_forces() {
    // A medium alone: d/dt T = -2 c T along a free flight; here of a pendulum without weight on it.
    let settings = Settings { damping_1_s: 0.3, ..Settings::default() };
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_force([0.0, 0.0, 4.905])];
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let system = System::new("no weight", 9.81, joints, vec![Member::bar(0, 1, bar)]).unwrap();
    let mut simulation = Simulation::new(&system, &[[0.0; 3], [0.0, 1.0, 0.0]], settings).unwrap();
    simulation.push(&[[0.0; 3], [0.2, 0.0, 0.0]]).unwrap();
    let before_j = simulation.kinetic_j();
    // An impulse of 0.2 N s at the end of a rod of m l²/3: T = (0.2)² / (2/3).
    assert!((before_j - 0.06).abs() < 1e-15);
    run(&mut simulation, 2.0, 1e-3);
    let told = before_j * f64::exp(-2.0 * 0.3 * 2.0);
    assert!((simulation.kinetic_j() / told - 1.0).abs() < 1e-12);
    // Friction alone, at the anchor's pin and at the free end (which turns with the bar): J ω' = -k
    // ω.
    let settings = Settings { friction_n_m_s: 0.1, ..Settings::default() };
    let mut simulation = Simulation::new(&system, &[[0.0; 3], [0.0, 1.0, 0.0]], settings).unwrap();
    simulation.push(&[[0.0; 3], [0.2, 0.0, 0.0]]).unwrap();
    run(&mut simulation, 2.0, 1e-3);
    let told = before_j * f64::exp(-2.0 * 0.1 * 3.0 * 2.0);
    let off = simulation.kinetic_j() / told - 1.0;
    assert!(off.abs() < 1e-12, "{off:e}");
}

/// A pin without inertia turns as the members it joins do in the mean, and each bears the friction of its
/// own turn against that: bars of 1 m and 2 m that hang plumb and turn with -1/s and -3/s about OY.
#[test]
fn the_pins_of_a_member_bear_different_moments() {
    let bar = |length: f64| Bar::homogeneous(length, 1.0).unwrap();
    let system = hanging(&[bar(1.0), bar(2.0)], &[]);
    let at = string(&[1.0, 2.0], &[0.0, 0.0]);
    let settings = Settings { friction_n_m_s: 0.25, ..Settings::default() };
    let mut simulation = Simulation::new(&system, &at, settings).unwrap();
    simulation.set_velocities(&[[0.0; 3], [1.0, 0.0, 0.0], [7.0, 0.0, 0.0]]).unwrap();
    let found = simulation.snapshot().pin_moments_n_m;
    let wanted = [[0.25, -0.25], [0.25, 0.0]];
    for (found, wanted) in found.iter().flatten().zip(wanted.iter().flatten()) {
        let off = [found[0], found[1] - wanted, found[2]];
        assert!(off.iter().all(|x| x.abs() < 1e-12), "{found:?} {wanted}");
    }
}

/// What is left of the laws is a part of the forces and moments: masses a million times as large, with
/// their moments, move alike and leave as much.
#[test]
fn the_laws_are_held_against_the_forces() {
    let left = |masses: f64| {
        let bar = |length: f64| Bar::homogeneous(length, masses).unwrap();
        let system = hanging(&[bar(1.0), bar(0.7), bar(1.3)], &[]);
        let at = string(&[1.0, 0.7, 1.3], &[0.3, -0.8, 1.9]);
        let mut simulation = Simulation::new(&system, &at, Settings::default()).unwrap();
        simulation.set_velocities(&[[0.0; 3]; 4]).unwrap();
        simulation.snapshot().laws
    };
    let (light, heavy) = (left(1.0), left(20.0_f64.exp2()));
    assert!(light.moment > 0.0 && light.force > 0.0, "{light:?}");
    assert_eq!(light, heavy);
}
