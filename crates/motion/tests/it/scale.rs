//! Lengths, masses and gravity times powers of two, times times the root of length over gravity: not a digit of
//! a motion changes but by these.

use model::Bar;
use model::system::{Joint, Member, Support, System};
use motion::{Mode, Order, Settings, Simulation, What, lowest_modes, modes};
use samples::{assert_frozen, scaled};

use crate::common::{G, hanging, string};

/// Of lengths, masses and gravity.
const FACTORS: [[f64; 3]; 3] = [[16.0, 1.0, 1.0], [1.0, 0.0625, 4.0], [0.25, 64.0, 0.25]];

fn time([length, _, gravity]: [f64; 3]) -> f64 {
    (length / gravity).sqrt()
}

/// Two bars and a rod that hang from O, the first with three moments of inertia, to a ring on an oblique wire; a
/// prestressed spring to the second joint, a slack cable that catches the first, and a floor under both.
fn rig() -> (System, Vec<[f64; 3]>) {
    let along = |at: [f64; 3], length_m: f64, [x, y, z]: [f64; 3]| {
        let size = (x * x + y * y + z * z).sqrt() / length_m;
        [at[0] + x / size, at[1] + y / size, at[2] + z / size]
    };
    let o = [0.3, -0.2, 1.1];
    let first = along(o, 0.7, [2.0, 1.0, 0.5]);
    let second = along(first, 0.45, [1.0, -2.0, 0.25]);
    let ring = along(second, 0.6, [-1.0, -0.5, -1.5]);
    let (held, caught) = ([1.9, -0.6, 1.7], [0.5, 0.9, 1.4]);
    let joints = vec![
        Joint::anchor("O", o),
        Joint::free("P").with_mass(0.35),
        Joint::free("Q").with_force([0.4, 0.15, -0.3]),
        Joint::free("ring")
            .with_mass(0.2)
            .held_by(Support::Line { at_m: ring, direction: [0.6, 0.0, 0.8] }),
        Joint::anchor("D", held),
        Joint::anchor("C", caught),
    ];
    let body = Bar::given(0.7, 0.9, Some(0.3), Some([0.02, 0.06, 0.05])).unwrap();
    let rod = |length_m: f64, mass_kg| Bar::homogeneous(length_m, mass_kg).unwrap();
    let spring = Member::bar(2, 4, rod(1.3, 0.1)).with_stiffness(45.0);
    let members = vec![
        Member::bar(0, 1, body),
        Member::bar(2, 1, Bar::given(0.45, 0.3, Some(0.1), None).unwrap()),
        Member::bar(2, 3, rod(0.6, 0.25)),
        spring.with_prestress(6.0).unwrap(),
        Member::cable(5, 1, rod(1.45, 0.0)),
    ];
    let system = System::new("rig", G, joints, members).unwrap().with_floor(-0.1).unwrap();
    (system, vec![o, first, second, ring, held, caught])
}

/// A chain of five bars that falls with its end beside its anchor, and passes through positions where it is folded
/// on one line.
fn folded() -> (System, Vec<[f64; 3]>) {
    let lengths = [0.3, 0.5, 0.2, 0.45, 0.6];
    let bars = lengths.map(|length_m| Bar::homogeneous(length_m, 2.0 * length_m).unwrap());
    let at = string(&lengths, &[0.0, 0.0, 1.5, 3.1, 3.1]);
    (hanging(&bars, &[0.0, 0.1]), at)
}

/// Groups of numbers, each with the powers of length, mass and time in its unit.
type Numbers = Vec<([i32; 3], Vec<f64>)>;

fn numbers(simulation: &mut Simulation) -> Numbers {
    let flat = |vectors: &[[f64; 3]]| vectors.as_flattened().to_vec();
    let now = simulation.snapshot();
    let mut found = vec![
        ([0, 0, 1], vec![now.time_s]),
        ([1, 0, 0], flat(&now.joints_m)),
        ([1, 0, -1], flat(&now.velocities_m_s)),
        ([1, 0, -2], flat(&now.accelerations_m_s2)),
        ([1, 1, -2], now.axial_n.clone()),
        ([1, 1, -2], flat(&now.start_forces_n)),
        ([1, 1, -2], flat(&now.end_forces_n)),
        ([1, 1, -2], flat(&now.reactions_n)),
        ([2, 1, -2], now.pin_moments_n_m.as_flattened().as_flattened().to_vec()),
        ([2, 1, -2], vec![now.kinetic_j, now.potential_j, now.lost_j]),
        ([0, 0, 0], vec![now.lengths_off, now.rates_off, now.laws.force, now.laws.moment]),
        ([0, 0, 0], vec![now.laws.joint, now.laws.momentum, now.laws.angular_momentum]),
    ];
    for impact in simulation.impacts() {
        found.push(([0, 0, 1], vec![impact.time_s]));
        found.push(([2, 1, -2], vec![impact.lost_j]));
    }
    found
}

#[track_caller]
fn assert_scaled(one: &Numbers, other: &Numbers, factors: [f64; 3]) {
    let bases = [factors[0], factors[1], time(factors)];
    assert_eq!(one.len(), other.len());
    for ((powers, one), (_, other)) in one.iter().zip(other) {
        let factor: f64 = bases.iter().zip(powers).map(|(base, power)| base.powi(*power)).product();
        let one: Vec<f64> = one.iter().map(|x| factor * x).collect();
        assert_eq!(&one, other, "{powers:?} {factors:?}");
    }
}

#[test]
fn motions_scale_without_rounding() {
    for (name, (system, at), settings, steps) in [
        ("rig", rig(), Settings::default(), 400),
        (
            "damped",
            rig(),
            Settings { order: Order::Fourth, damping_1_s: 0.4, friction_n_m_s: 0.03 },
            200,
        ),
        ("folded", folded(), Settings::default(), 400),
    ] {
        let step_s = 1.0 / 256.0;
        let moved = |factors: [f64; 3]| {
            let [length, mass, _] = factors;
            let time = time(factors);
            let settings = Settings {
                damping_1_s: settings.damping_1_s / time,
                friction_n_m_s: settings.friction_n_m_s * mass * length * length / time,
                ..settings
            };
            let at: Vec<_> = at.iter().map(|x| x.map(|x| length * x)).collect();
            let mut moved = Simulation::new(&scaled(&system, factors), &at, settings).unwrap();
            let mut seen = Numbers::new();
            for k in 0..steps {
                if let Err(error) = moved.step(step_s * time) {
                    panic!("{name} {factors:?} step {k}: {error}");
                }
                if k % 40 == 39 {
                    seen.extend(numbers(&mut moved));
                    seen.push(([0; 3], vec![moved.corrections() as f64]));
                }
            }
            if name == "rig" {
                assert!(moved.impacts().len() > 1, "{:?}", moved.impacts());
            }
            seen
        };
        let one = moved([1.0; 3]);
        for factors in FACTORS {
            assert_scaled(&one, &moved(factors), factors);
        }
    }
}

/// Impacts and corrections of the steps of each, frozen: where another number is meant, the failing test prints what
/// then belongs here.
#[test]
fn work_of_motions() {
    let rig = |order| {
        let (system, at) = rig();
        Simulation::new(&system, &at, Settings { order, ..Settings::default() }).unwrap()
    };
    let (system, at) = folded();
    let folded = Simulation::new(&system, &at, Settings::default()).unwrap();
    let found = [rig(Order::Second), rig(Order::Eighth), folded].map(|mut moved| {
        let mut corrections = 0;
        for _ in 0..200 {
            moved.step(1.0 / 128.0).unwrap();
            corrections += moved.corrections();
        }
        [moved.impacts().len(), corrections]
    });
    assert_frozen(&found, &[[2, 1464], [2, 840], [0, 2323]]);
}

/// Squares of frequencies, shapes and axes.
fn shapes(found: &[Mode]) -> Numbers {
    let mut all = Numbers::new();
    for mode in found {
        all.push(([0, 0, -2], vec![mode.omega2_s2, mode.residual_s2]));
        all.push(([0; 3], mode.shape.as_flattened().to_vec()));
        if let What::Turn { axis_m } = mode.what {
            all.push(([1, 0, 0], axis_m.to_vec()));
        }
    }
    all
}

/// Two bars of 0.6 m and 0.5 m between anchors on one vertical, 0.7 m apart, which turn about it, with a pendulum of
/// two rods on the joint between them, and a rod under the upper anchor; and a weight on a rod under a ring on a level wire. Masses in the middle of
/// bars or not, and moments of inertia of their own.
fn mobile() -> (System, Vec<[f64; 3]>) {
    let (x, y, top) = (0.3, -0.7, 0.45);
    // 0.6² = h² + d², 0.5² = (0.7 - d)² + h².
    let down = (0.36 - 0.25 + 0.49) / 1.4;
    let aside = (0.36_f64 - down * down).sqrt();
    let (sin, cos) = 0.4_f64.sin_cos();
    let out = [x + aside * cos, y + aside * sin, top - down];
    let below = |[x, y, z]: [f64; 3], length_m: f64| [x, y, z - length_m];
    let (knee, ring) = (below(out, 0.4), [2.0, 1.0, 0.5]);
    let at = vec![
        [x, y, top],
        [x, y, top - 0.7],
        out,
        knee,
        below(knee, 0.35),
        ring,
        below(ring, 0.55),
        [x, y, top - 0.3],
    ];
    let wire = Support::Line { at_m: ring, direction: [0.6, 0.8, 0.0] };
    let joints = vec![
        Joint::anchor("A", at[0]),
        Joint::anchor("B", at[1]),
        Joint::free("P").with_mass(0.2),
        Joint::free("Q"),
        Joint::free("R").with_mass(0.15),
        Joint::free("ring").with_mass(0.5).held_by(wire),
        Joint::free("W").with_mass(0.9),
        Joint::free("S"),
    ];
    let bar = |length_m, mass_kg, centre_m, inertia| {
        Bar::given(length_m, mass_kg, Some(centre_m), Some(inertia)).unwrap()
    };
    let members = vec![
        Member::bar(2, 0, bar(0.6, 0.8, 0.35, [0.04, 0.07, 0.05])),
        Member::bar(2, 1, Bar::homogeneous(0.5, 0.3).unwrap()),
        Member::bar(2, 3, bar(0.4, 0.25, 0.15, [0.0, 0.03, 0.03])),
        Member::bar(4, 3, Bar::given(0.35, 0.1, Some(0.1), None).unwrap()),
        Member::bar(5, 6, Bar::homogeneous(0.55, 0.4).unwrap()),
        Member::bar(0, 7, Bar::homogeneous(0.3, 0.6).unwrap()),
    ];
    (System::new("mobile", G, joints, members).unwrap(), at)
}

#[test]
fn modes_scale_without_rounding() {
    let long: Vec<Bar> =
        (0..130).map(|k| Bar::homogeneous(0.1 + 0.001 * f64::from(k), 0.2).unwrap()).collect();
    let lengths: Vec<f64> = long.iter().map(Bar::length_m).collect();
    let down = string(&lengths, &vec![0.0; lengths.len()]);
    for (system, at) in [mobile(), (hanging(&long, &[0.3; 3]), down)] {
        let found = |factors: [f64; 3]| {
            let (system, length) = (scaled(&system, factors), factors[0]);
            let at: Vec<_> = at.iter().map(|x| x.map(|x| length * x)).collect();
            let mut found = shapes(&lowest_modes(&system, &at, None, 4).unwrap().modes);
            if at.len() < 20 {
                found.extend(shapes(&modes(&system, &at, None).unwrap().modes));
            }
            found
        };
        let one = found([1.0; 3]);
        for factors in FACTORS {
            assert_scaled(&one, &found(factors), factors);
        }
    }
}

/// All modes are orthogonal in the metric of the inertia, which is built here from the members: the turn is that
/// about the vertical of the anchors, the ring rolls with its weight, and no oscillation turns or rolls the whole.
#[test]
fn modes_are_orthogonal_in_the_inertia() {
    let (system, at) = mobile();
    let mut found = modes(&system, &at, None).unwrap();
    found.modes.retain(|mode| !matches!(mode.what, What::Spin { .. }));
    // Of six moving joints 18 freedoms less six lengths and two of the wire.
    assert_eq!((found.modes.len(), found.negative), (10, 0));
    let inner = |a: &[[f64; 3]], b: &[[f64; 3]]| {
        let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        let joints = system.joints().iter().enumerate();
        let mut sum: f64 = joints.map(|(k, joint)| joint.mass_kg * dot(a[k], b[k])).sum();
        for member in system.members() {
            // The velocity of a point is linear between the ends: of the centre, and of the turning.
            let (bar, [from, to]) = (&member.body, [member.from, member.to]);
            let part = bar.centre_m() / bar.length_m();
            let centre =
                |x: &[[f64; 3]]| [0, 1, 2].map(|k| (1.0 - part) * x[from][k] + part * x[to][k]);
            let turn = |x: &[[f64; 3]]| [0, 1, 2].map(|k| (x[to][k] - x[from][k]) / bar.length_m());
            sum += bar.mass_kg() * dot(centre(a), centre(b));
            // Its second axis is level: about it go the ends that move along the third, and the other way round.
            let along = [0, 1, 2].map(|k| (at[to][k] - at[from][k]) / bar.length_m());
            let level = along[0].hypot(along[1]);
            let second = if level > 1e-9 {
                [-along[1] / level, along[0] / level, 0.0]
            } else {
                [1.0, 0.0, 0.0]
            };
            let third = [
                along[1] * second[2] - along[2] * second[1],
                along[2] * second[0] - along[0] * second[2],
                along[0] * second[1] - along[1] * second[0],
            ];
            let [_, about_second, about_third] = bar.inertia_kg_m2();
            let [by_a, by_b] = [turn(a), turn(b)];
            sum += about_second * dot(by_a, third) * dot(by_b, third);
            sum += about_third * dot(by_a, second) * dot(by_b, second);
        }
        sum
    };
    let highest = found.modes.iter().fold(0.0_f64, |most, mode| most.max(mode.omega2_s2));
    for (k, a) in found.modes.iter().enumerate() {
        assert!(a.residual_s2 <= 1e-11 * highest, "{a:?}");
        for b in &found.modes[..k] {
            let size = (inner(&a.shape, &a.shape) * inner(&b.shape, &b.shape)).sqrt();
            let between = inner(&a.shape, &b.shape);
            assert!(between.abs() < 1e-10 * size, "{between:e} {:?} {:?}", a.what, b.what);
        }
    }
    let named = |wanted: fn(&What) -> bool| {
        let mut of = found.modes.iter().filter(|mode| wanted(&mode.what));
        let first = of.next().unwrap();
        assert!(of.next().is_none() && first.omega2_s2.to_bits() == 0);
        first
    };
    let turn = named(
        |what| matches!(what, What::Turn { axis_m: [x, y] } if (x - 0.3).hypot(y + 0.7) < 1e-14),
    );
    let largest = 2;
    for (joint, shape) in turn.shape.iter().enumerate() {
        let moves = (2..5).contains(&joint);
        let [x, y, _] = at[joint].map(|x| if moves { x } else { 0.0 });
        let [x0, y0] = if moves { [0.3, -0.7] } else { [0.0; 2] };
        let radius = (at[largest][0] - 0.3).hypot(at[largest][1] + 0.7);
        let wanted = [(y0 - y) / radius, (x - x0) / radius, 0.0];
        let sign = (at[largest][0] - 0.3).signum();
        for (found, wanted) in shape.iter().zip(wanted) {
            assert!((found - sign * wanted).abs() < 1e-10, "{joint}: {shape:?} {wanted}");
        }
    }
    let rolls = named(|what| *what == What::Neutral);
    for (joint, shape) in rolls.shape.iter().enumerate() {
        let wanted = if [5, 6].contains(&joint) { [0.6, 0.8, 0.0] } else { [0.0; 3] };
        for (found, wanted) in shape.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-10, "{joint}: {shape:?}");
        }
    }
}
