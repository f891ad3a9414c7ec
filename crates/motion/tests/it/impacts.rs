//! Inextensible cables that become taut and joints that meet a floor: plastic impacts against
//! closed forms.

use model::Bar;
use model::system::{Joint, Kind, Member, Support, System};
use motion::{Contact, MotionError, Order, Settings, Simulation};

use crate::common::{G, at_rest, run};

const MASS_KG: f64 = 2.0;

fn cord(length_m: f64) -> Bar {
    Bar::homogeneous(length_m, 0.0).unwrap()
}

/// A weight on a cable of 1 m, or on a prop of 1 m that it is above of.
fn weight(kind: Kind) -> System {
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(MASS_KG)];
    let member = Member::bar(0, 1, cord(1.0)).of_kind(kind);
    System::new("weight", G, joints, vec![member]).unwrap()
}

/// Gaps that are never negative, forces never of the wrong sign, laws and lengths that hold.
fn judge(system: &System, simulation: &mut Simulation) {
    let now = simulation.snapshot();
    assert!(now.laws.largest() < 1e-11 && now.lengths_off < 1e-12, "{:?}", now.laws);
    for (member, axial_n) in system.members().iter().zip(&now.axial_n) {
        let d: f64 = (0..3)
            .map(|k| (now.joints_m[member.to][k] - now.joints_m[member.from][k]).powi(2))
            .sum();
        let stretch = d.sqrt() / member.body.length_m() - 1.0;
        let (spare, borne) = match (member.kind, member.stiffness_n) {
            (Kind::Cable, None) => (-stretch, *axial_n),
            (Kind::Strut, None) => (stretch, -axial_n),
            _ => continue,
        };
        assert!(spare > -1e-11 && borne > -1e-9, "{stretch:e} {axial_n} N");
        assert!(spare < 1e-11 || borne.abs() <= 1e-9, "{stretch:e} {axial_n} N");
    }
}

#[test]
fn a_weight_that_falls_aside_keeps_what_is_across_the_cable() {
    // It falls from 0.6 m beside its anchor and is held 0.8 m below: half of the height is lost by
    // the square of the cosine 0.8, and it swings on.
    let system = weight(Kind::Cable);
    for order in [Order::Second, Order::Fourth] {
        let mut fall = at_rest(&system, &[[0.0; 3], [0.6, 0.0, 0.0]], order);
        let start_j = fall.energy_j();
        let mut lowest_j = 0.0_f64;
        for _ in 0..400 {
            run(&mut fall, 5e-3, 1e-3);
            judge(&system, &mut fall);
            lowest_j = lowest_j.min(fall.potential_j());
        }
        let [impact] = fall.impacts() else { panic!("{:?}", fall.impacts()) };
        assert_eq!(impact.closed, [Contact::Member(0)]);
        assert!((impact.time_s - (1.6 / G).sqrt()).abs() < 1e-11, "{}", impact.time_s);
        let kinetic_j = MASS_KG * G * 0.8;
        assert!((impact.lost_j - 0.64 * kinetic_j).abs() < 1e-9, "{}", impact.lost_j);
        let off_j = (fall.energy_j() + fall.lost_j() - start_j).abs();
        assert!(off_j < 1e-4, "{off_j:e}");
        // It swings through its lowest place.
        assert!((lowest_j + MASS_KG * G).abs() < 1e-3 * MASS_KG * G);
    }
}

/// Impact of a pendulum that is thrown past the level of its anchor: time since it went slack as
/// the energy tells, s; place and loss.
fn thrown(step_s: f64, sine: f64) -> ([f64; 3], f64) {
    let system = weight(Kind::Cable);
    let mut swing = at_rest(&system, &[[0.0; 3], [0.0, 0.0, -1.0]], Order::Second);
    let speed = (G * (2.0 + 3.0 * sine)).sqrt();
    swing.set_velocities(&[[0.0; 3], [speed, 0.0, 0.0]]).unwrap();
    while swing.impacts().is_empty() {
        swing.step(step_s).unwrap();
        judge(&system, &mut swing);
        assert!(swing.time_s() < 5.0);
    }
    // Back to the time of the impact, on the circle.
    let impact = &swing.impacts()[0];
    (swing.joints_m()[1], impact.lost_j)
}

#[test]
fn a_pendulum_thrown_past_its_anchor_goes_slack_and_is_caught_where_the_parabola_says() {
    // Slack at the angle φ above the level with v² = g l sin φ, caught at 3 φ below it on the other
    // side with the radial speed -v sin φ cos 3φ + 3 v cos φ sin 3φ.
    let sine = 0.4_f64;
    let angle = sine.asin();
    let speed = (G * sine).sqrt();
    let (sin3, cos3) = (3.0 * angle).sin_cos();
    let radial = speed * (3.0 * angle.cos() * sin3 - sine * cos3);
    let told_j = 0.5 * MASS_KG * radial * radial;
    let off = |step_s: f64| {
        let (at, lost_j) = thrown(step_s, sine);
        // The step of the impact ends some time later; it has moved on along the circle.
        let place = (at[0] - cos3).hypot(at[2] + sin3);
        assert!(place < 12.0 * step_s, "{at:?}");
        (lost_j / told_j - 1.0).abs()
    };
    let (coarse, fine) = (off(2e-3), off(2.5e-4));
    println!("of {told_j} J: {coarse:e} {fine:e}");
    assert!(fine < 1e-5 && fine < 0.05 * coarse.max(1e-5), "{coarse:e} {fine:e}");
}

/// Weights on a level line, from each to the next a slack cable of 1 m.
fn train(masses_kg: &[f64]) -> (System, Vec<[f64; 3]>) {
    let line = Support::Line { at_m: [0.0; 3], direction: [1.0, 0.0, 0.0] };
    let joint = |(k, mass): (usize, &f64)| {
        let mut joint = Joint::free(format!("S{k}")).with_mass(*mass);
        joint.support = line;
        joint
    };
    let joints: Vec<Joint> = masses_kg.iter().enumerate().map(joint).collect();
    let members = (1..masses_kg.len()).map(|k| Member::cable(k - 1, k, cord(1.0))).collect();
    let system = System::new("train", G, joints, members).unwrap();
    let at = (0..masses_kg.len()).map(|k| [-0.25 * k as f64, 0.0, 0.0]).collect();
    (system, at)
}

#[test]
fn weights_that_are_caught_one_after_the_other_share_their_momentum() {
    let masses_kg = [3.0, 2.0, 1.0, 4.0];
    let (system, at) = train(&masses_kg);
    let mut train = at_rest(&system, &at, Order::Second);
    train.set_velocities(&[[8.0, 0.0, 0.0], [0.0; 3], [0.0; 3], [0.0; 3]]).unwrap();
    run(&mut train, 2.0, 1e-3);
    // After each catch all before it have 24 N s over their mass: 24²/2 (1/3 - 1/5), and so on.
    let sums = [3.0, 5.0, 6.0, 10.0];
    assert_eq!(train.impacts().len(), 3);
    for (impact, masses) in train.impacts().iter().zip(sums.windows(2)) {
        let told_j = 288.0 * (1.0 / masses[0] - 1.0 / masses[1]);
        assert!((impact.lost_j / told_j - 1.0).abs() < 1e-10, "{impact:?} {told_j}");
    }
    // The first gap of 0.75 m closes at 8 m/s, the next at 24/5, then at 24/6.
    let mut told_s = 0.0;
    for (impact, mass) in train.impacts().iter().zip(sums) {
        told_s += 0.75 * mass / 24.0;
        // One next to an end of a step is moved by a millionth of the step at most.
        assert!((impact.time_s - told_s).abs() < 1.1e-9, "{impact:?} {told_s}");
    }
    assert!(train.velocities_m_s().iter().all(|v| (v[0] - 2.4).abs() < 1e-11));
}

#[test]
fn a_weight_bounces_off_nothing_and_a_prop_catches_what_falls_on_it() {
    let system = weight(Kind::Strut);
    let mut fall = at_rest(&system, &[[0.0; 3], [0.0, 0.0, 1.5]], Order::Second);
    run(&mut fall, 0.5, 1e-3);
    let [impact] = fall.impacts() else { panic!("{:?}", fall.impacts()) };
    assert!((impact.time_s - (1.0 / G).sqrt()).abs() < 1e-11);
    assert!((impact.lost_j - 0.5 * MASS_KG * G).abs() < 1e-9);
    judge(&system, &mut fall);
    assert!((fall.snapshot().axial_n[0] + MASS_KG * G).abs() < 1e-9);
}

/// A rod of 1 m, hinged half a metre above the floor.
fn flap(support: Support) -> System {
    let tip = Joint::free("P").held_by(support);
    let joints = vec![Joint::anchor("O", [0.0, 0.0, 0.5]), tip];
    let rod = Bar::homogeneous(1.0, 3.0).unwrap();
    let members = vec![Member::bar(0, 1, rod)];
    System::new("flap", G, joints, members).unwrap().with_floor(0.0).unwrap()
}

#[test]
fn a_rod_falls_onto_the_floor_and_lies_there() {
    falls_and_lies(&flap(Support::Free));
    // Its tip slides on a wall, down to the floor.
    falls_and_lies(&flap(Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] }));
}

fn falls_and_lies(system: &System) {
    let mut fall = at_rest(system, &[[0.0, 0.0, 0.5], [1.0, 0.0, 0.5]], Order::Fourth);
    let start_j = fall.energy_j();
    run(&mut fall, 2.0, 1e-3);
    let [impact] = fall.impacts() else { panic!("{:?}", fall.impacts()) };
    assert_eq!(impact.closed, [Contact::Floor(1)]);
    // Its centre has fallen by a quarter of a metre.
    assert!((impact.lost_j / (0.25 * 3.0 * G) - 1.0).abs() < 1e-9, "{}", impact.lost_j);
    assert!((fall.energy_j() + fall.lost_j() - start_j).abs() < 1e-8);
    let now = fall.snapshot();
    assert!(now.joints_m[1][2].abs() < 1e-12 && now.kinetic_j < 1e-18);
    // The floor bears half of it.
    assert!((now.reactions_n[1][2] - 1.5 * G).abs() < 1e-10, "{:?}", now.reactions_n);
    assert!(now.laws.largest() < 1e-12);
    // Lifted by an impulse it comes down again, and loses all of it.
    fall.push(&[[0.0; 3], [0.0, 0.0, 1.0]]).unwrap();
    let given_j = fall.kinetic_j();
    assert!(given_j > 0.1);
    run(&mut fall, 2.0, 1e-3);
    assert_eq!(fall.impacts().len(), 2);
    assert!((fall.impacts()[1].lost_j / given_j - 1.0).abs() < 1e-4);
    // A push into the floor does nothing.
    fall.push(&[[0.0; 3], [0.0, 0.0, -1.0]]).unwrap();
    assert!(fall.kinetic_j() < 1e-18);
}

/// A net of 21 weights on cables of 1 m, hung by its four corners above a floor: nodes 0.9 m apart.
fn net(floor_m: f64) -> (System, Vec<[f64; 3]>) {
    let at: Vec<[f64; 3]> = (0..25_u32)
        .map(|k| [k / 5, k % 5].map(f64::from))
        .map(|[x, y]| [0.9 * x, 0.9 * y, 0.0])
        .collect();
    let joint = |k: usize| {
        if [0, 4, 20, 24].contains(&k) {
            Joint::anchor(k.to_string(), at[k])
        } else {
            Joint::free(k.to_string()).with_mass(0.5 + 0.02 * k as f64)
        }
    };
    let joints: Vec<Joint> = (0..25).map(joint).collect();
    let mut members = Vec::new();
    for k in 0..25 {
        if k % 5 < 4 {
            members.push(Member::cable(k, k + 1, cord(1.0)));
        }
        if k < 20 {
            members.push(Member::cable(k, k + 5, cord(1.0)));
        }
    }
    let system = System::new("net", G, joints, members).unwrap();
    (system.with_floor(floor_m).unwrap(), at)
}

#[test]
fn a_net_that_falls_keeps_its_laws_and_what_it_loses_is_told() {
    let (system, at) = net(-2.0);
    let settings = Settings { damping_1_s: 0.5, ..Settings::default() };
    let mut fall = Simulation::new(&system, &at, settings).unwrap();
    let mut before_j = fall.energy_j();
    for _ in 0..30 {
        run(&mut fall, 0.05, 2e-3);
        judge(&system, &mut fall);
        // Impacts and drag take energy, nothing gives any.
        let now_j = fall.energy_j();
        assert!(now_j <= before_j + 1e-3, "{before_j} {now_j}");
        before_j = now_j;
    }
    let lost: Vec<f64> = fall.impacts().iter().map(|impact| impact.lost_j).collect();
    println!("{} impacts, {} J of {} J", lost.len(), fall.lost_j(), fall.energy_j());
    assert!(lost.len() > 5 && lost.iter().all(|j| *j > -1e-6), "{lost:?}");
}

#[test]
fn what_cannot_begin_or_go_back_is_refused() {
    let system = weight(Kind::Cable);
    let long = Simulation::new(&system, &[[0.0; 3], [1.1, 0.0, 0.0]], Settings::default());
    assert!(matches!(long, Err(MotionError::NotClosed { .. })));
    let below = Simulation::new(
        &flap(Support::Free),
        &[[0.0, 0.0, 0.5], [0.0, 0.0, -0.5]],
        Settings::default(),
    );
    assert!(matches!(below, Err(MotionError::NotClosed { .. })));
    let mut fall = at_rest(&system, &[[0.0; 3], [0.5, 0.0, 0.0]], Order::Second);
    assert!(matches!(fall.step(-1e-3), Err(MotionError::Input { .. })));
}

#[test]
fn positions_at_random_have_cables_within_their_lengths_and_joints_above_the_floor() {
    let (system, _) = net(-0.6);
    let (mut slack, mut taut, mut laid) = (0, 0, 0);
    for seed in 0..40 {
        let at = motion::random_position(&system, seed).unwrap();
        assert_eq!(at, motion::random_position(&system, seed).unwrap());
        for member in system.members() {
            let d: f64 =
                (0..3).map(|k| (at[member.to][k] - at[member.from][k]).powi(2)).sum::<f64>().sqrt();
            assert!(d < 1.0 + 1e-11, "{d}");
            *(if d < 1.0 - 1e-9 { &mut slack } else { &mut taut }) += 1;
        }
        for place in &at {
            assert!(place[2] > -0.6 - 1e-9);
            laid += usize::from(place[2] < -0.6 + 1e-9);
        }
        assert!(Simulation::new(&system, &at, Settings::default()).is_ok());
    }
    println!("{slack} slack, {taut} taut, {laid} on the floor");
    assert!(slack > 100 && taut > 20 && laid > 20);
}

/// A cable does not prop what stands above its anchor, however light that is beside the rest: 0.1 mg beside
/// a tonne falls by g t^2 / 2.
#[test]
fn a_light_weight_above_its_cable_falls_beside_a_heavy_one() {
    let joints = samples::joints(&[[0.0; 3]], &[1e-7, 1000.0]);
    let light = Member::bar(0, 1, cord(1.0)).of_kind(Kind::Cable);
    let members = vec![light, Member::bar(0, 2, cord(1.0))];
    let system = System::new("light", G, joints, members).unwrap();
    let mut fall = at_rest(&system, &[[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], Order::Second);
    run(&mut fall, 0.1, 1e-3);
    let z = fall.snapshot().joints_m[1][2];
    assert!((z - (1.0 - 0.5 * G * 0.01)).abs() < 1e-9, "{z}");
}

/// Of three cables that bear a weight a push wants all to push, by impulses of -9.9, -8.1 and -5.2 in units of the mass: the
/// first goes, then the last, then the second, and then the first is stretched after all. It bears 8/9 alone.
#[test]
fn what_an_impact_lets_go_may_be_closed_by_it_again() {
    let directions = [
        [7.0, -4.0, 4.0].map(|x| x / 9.0),
        [-8.0, 4.0, -1.0].map(|x| x / 9.0),
        [-6.0, -3.0, -2.0].map(|x| x / 7.0),
    ];
    let lengths = [1.0, 0.7, 1.3];
    let (mass_kg, push) = (2.0, [4.0, 3.0, -2.0]);
    let mut joints: Vec<Joint> = (0..3)
        .map(|k| Joint::anchor(format!("A{k}"), directions[k].map(|x| -lengths[k] * x)))
        .collect();
    // With its weight, 1 N along each.
    let mut force = [0.0, 0.0, mass_kg * G];
    for direction in directions {
        force = std::array::from_fn(|k| force[k] + direction[k]);
    }
    joints.push(Joint::free("P").with_mass(mass_kg).with_force(force));
    let members = (0..3).map(|k| Member::cable(k, 3, cord(lengths[k]))).collect();
    let system = System::new("three", G, joints.clone(), members).unwrap();
    let at: Vec<_> = joints.iter().map(|joint| joint.support.at_m().unwrap_or([0.0; 3])).collect();
    let mut pushed = at_rest(&system, &at, Order::Second);
    assert!(pushed.snapshot().axial_n.iter().all(|force| (force - 1.0).abs() < 1e-12));
    pushed.push(&[[0.0; 3], [0.0; 3], [0.0; 3], push.map(|x| mass_kg * x)]).unwrap();
    let found = pushed.velocities_m_s()[3];
    for k in 0..3 {
        let wanted = push[k] - 8.0 / 9.0 * directions[0][k];
        assert!((found[k] - wanted).abs() < 1e-12, "{found:?} {wanted}");
    }
}

/// A cable that is taut and bears nothing beside one that bears 10 GN stops what would stretch it, whatever rounding
/// makes of its force.
#[test]
fn cables_without_force_hold() {
    let mass_kg = 1e9;
    let main = [3.0, -2.0, 6.0].map(|x| x / 7.0);
    let mut force = main.map(|x| 1e10 * x);
    force[2] += mass_kg * G;
    for [x, y, z] in
        [[2.0, 3.0, 6.0], [-6.0, 2.0, 3.0], [6.0, 3.0, -2.0], [-3.0, 6.0, 2.0], [2.0, -6.0, -3.0]]
    {
        let aside = [x, y, z].map(|x| x / 7.0);
        let joints = vec![
            Joint::anchor("A", main.map(|x| -x)),
            Joint::anchor("B", aside.map(|x| -0.7 * x)),
            Joint::free("P").with_mass(mass_kg).with_force(force),
        ];
        let members = vec![Member::cable(0, 2, cord(1.0)), Member::cable(1, 2, cord(0.7))];
        let at = [main.map(|x| -x), aside.map(|x| -0.7 * x), [0.0; 3]];
        let system = System::new("beside", G, joints, members).unwrap();
        let mut pushed = at_rest(&system, &at, Order::Second);
        pushed.push(&[[0.0; 3], [0.0; 3], aside.map(|x| mass_kg * x)]).unwrap();
        let v = pushed.velocities_m_s()[2];
        let along = v[0] * aside[0] + v[1] * aside[1] + v[2] * aside[2];
        assert!(along.abs() < 1e-12, "{along} m/s along {aside:?}");
    }
}

/// From the floor z = v t - g t^2 / 2, be it ever so slow.
#[test]
fn what_is_thrown_leaves_the_floor() {
    for (v, g) in [(3.0, G), (1e-7, 1e-14)] {
        let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(MASS_KG)];
        let leash = Member::cable(0, 1, cord(100.0));
        let system =
            System::new("thrown", g, joints, vec![leash]).unwrap().with_floor(0.0).unwrap();
        let mut thrown = at_rest(&system, &[[0.0; 3], [1.0, 0.0, 0.0]], Order::Second);
        thrown.push(&[[0.0; 3], [0.0, 0.0, MASS_KG * v]]).unwrap();
        run(&mut thrown, 0.5 * v / g, 0.01 * v / g);
        let z = thrown.joints_m()[1][2];
        assert!((z / (v * v / g) - 0.375).abs() < 1e-9, "{z}");
    }
}
