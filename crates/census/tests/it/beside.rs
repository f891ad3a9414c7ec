//! Ropes and cables beside bars and struts: lists against closed forms, scans of one variable, and Newton's method
//! on equations written here.

use model::system::{Joint, Kind, Member, System};
use model::{NoCensus, Vector};
use numerics::Interval;
use numerics::vector::{add_times, dot, minus, norm};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use samples::rope;

use census::Settings;
use census::net::{Open, SystemCensus};

use crate::support::{Acting, light, system, whole};

#[track_caller]
fn refusal(system: &System) -> NoCensus {
    SystemCensus::take(system, &Settings::default()).unwrap_err()
}

/// A boom of 4 m from the origin with 30 N and a side wind at its end P, hung from D by a tackle of so many strands.
fn boom(strands: usize, wind_n: f64, end: Joint, length_m: f64) -> System {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        end.with_force([0.5 * wind_n, wind_n, -30.0]),
        Joint::anchor("D", [-0.6, -0.8, 5.0]),
    ];
    let path: Vec<usize> = (0..=strands).map(|k| if k % 2 == 0 { 2 } else { 1 }).collect();
    system(joints, vec![Member::bar(0, 1, light(4.0)), rope(&path, length_m)])
}

/// P is 4 m from A and L/n from D, on a circle about the line between them, where the load points along the
/// radius, outward or inward; n T follows from the balance. Slack, the boom hangs or stands along the load.
#[test]
fn a_boom_on_a_tackle_has_its_closed_form() {
    let (a_m, d_m) = ([0.0; 3], [-0.6, -0.8, 5.0]);
    let mut counts = vec![];
    for (strands, wind_n, length_m) in [
        (2, 6.0, 12.0),
        (3, 6.0, 18.0),
        (3, 0.0, 18.0),
        (4, -9.0, 24.0),
        (3, 2.0, 9.0),
        (5, 6.0, 41.5),
    ] {
        let load = [0.5 * wind_n, wind_n, -30.0];
        let n = strands as f64;
        let mut expected: Vec<(Vector, f64)> = vec![];
        let (axis, reach) = (minus(d_m, a_m), length_m / n);
        let along = 0.5 * (1.0 + (16.0 - reach * reach) / dot(axis, axis));
        let foot = add_times(a_m, along, axis);
        let radius = (16.0 - along * along * dot(axis, axis)).sqrt();
        let off = add_times(load, -dot(load, axis) / dot(axis, axis), axis);
        for sign in [1.0, -1.0] {
            let at = add_times(foot, sign * radius / norm(off), off);
            // Across the boom, in the plane of load and tackle: load + n T u has no part.
            let across = add_times(load, -dot(load, at) / 16.0, at);
            let pull = -dot(load, across) / dot(minus(d_m, at), across) * reach / n;
            if pull > 0.0 {
                expected.push((at, pull));
            }
            let plumb = add_times(a_m, sign * 4.0 / norm(load), load);
            if n * norm(minus(d_m, plumb)) < length_m {
                expected.push((plumb, 0.0));
            }
        }
        let census = whole(&boom(strands, wind_n, Joint::free("P"), length_m));
        assert_eq!(census.equilibria.len(), expected.len(), "{strands} {wind_n}: {expected:?}");
        for (at, pull) in &expected {
            let is = |one: &&census::net::SystemPosition| {
                let near = |k: usize| (one.joints_m[1][k].mid() - at[k]).abs() < 1e-10;
                (0..3).all(near) && (one.axial_n[1].mid() - pull).abs() < 1e-9
            };
            assert_eq!(census.equilibria.iter().filter(is).count(), 1, "{at:?} {pull}");
        }
        assert_eq!(census.equilibria[0].index_in_space, 0);
        counts.push((expected.len(), expected.iter().filter(|(_, pull)| *pull > 0.0).count()));
    }
    // Taut ones and slack ones are among them.
    assert!(counts.iter().any(|(all, taut)| taut < all), "{counts:?}");
    assert!(counts.iter().any(|(_, taut)| *taut == 2), "{counts:?}");
}

/// With the pulley straight above the foot all turns freely: forces are as the sides of the triangle of foot, pulley
/// and end. The boom stands, too, where the tackle is slack.
#[test]
fn a_boom_below_its_mast_head_turns_freely() {
    let (height, length_m) = (5.0, 13.5);
    let joints = vec![
        Joint::anchor("A", [0.3, -0.2, 1.0]),
        Joint::free("P").with_force([0.0, 0.0, -30.0]),
        Joint::anchor("D", [0.3, -0.2, 1.0 + height]),
    ];
    let tackle = system(joints, vec![Member::bar(0, 1, light(4.0)), rope(&[2, 1, 2, 1], length_m)]);
    let census = whole(&tackle);
    let reach = length_m / 3.0;
    let up = (16.0 + height * height - reach * reach) / (2.0 * height);
    let [turning, standing] = &census.equilibria[..] else { panic!("{:?}", census.equilibria) };
    assert!(turning.circle && !standing.circle);
    let out = turning.joints_m[1][0].mid() - 0.3;
    assert!((turning.joints_m[1][2].mid() - 1.0 - up).abs() < 1e-12 && out > 0.0);
    assert!((out * out + up * up - 16.0).abs() < 1e-11);
    let forces = [-30.0 * 4.0 / height, 30.0 * reach / height / 3.0];
    for (axial, n) in turning.axial_n.iter().zip(forces) {
        assert!((axial.mid() - n).abs() < 1e-11 * 30.0, "{axial:?} {n}");
    }
    assert!(standing.joints_m[1][2].contains(5.0) && standing.axial_n[0].contains(-30.0));
    assert_eq!([turning.index_in_space, standing.index_in_space], [0, 2]);
    // Two joints that turn are not searched.
    let mut joints = tackle.joints().to_vec();
    joints.push(Joint::free("Q").with_mass(1.0));
    let mut members = tackle.members().to_vec();
    members.push(rope(&[1, 3, 2], 7.0));
    assert_eq!(refusal(&system(joints, members)), NoCensus::Turns { joint: 1 });
}

/// How often a function of an angle changes its sign in a full turn, and where.
fn zeros(f: impl Fn(f64) -> f64) -> Vec<f64> {
    const CELLS: usize = 20_000;
    let at = |k: usize| std::f64::consts::TAU * (k as f64 + 0.5) / CELLS as f64;
    let mut found = vec![];
    for k in 0..CELLS {
        let [mut low, mut high] = [at(k), at(k + 1)];
        if f(low) * f(high) < 0.0 {
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if f(low) * f(middle) <= 0.0 { high = middle } else { low = middle }
            }
            found.push(0.5 * (low + high));
        }
    }
    found
}

/// A bar of r from the origin with the weight w at its end Q, in the vertical plane of the pulley D (or, by
/// Lagrange's rule, in no equilibrium): Q = r (sin t, -cos t) has the energy w z + V(|QD|).
fn swung(r: f64, t: f64, d_m: [f64; 2]) -> ([f64; 2], [f64; 2], f64) {
    let (at, way) = ([r * t.sin(), -r * t.cos()], [r * t.cos(), r * t.sin()]);
    (at, way, (at[0] - d_m[0]).hypot(at[1] - d_m[1]))
}

/// A counterweight W at the other end of the rope over D: V = W |QD|. Where the bar is heavy it hangs and
/// stands; where it is light it is drawn to the pulley.
#[test]
fn a_bar_over_a_pulley_with_its_counterweight_is_scanned() {
    let mut counts = vec![];
    for (r, d_m, weights) in [
        (3.0, [2.0, 4.0], [20.0, 12.0]),
        (3.0, [2.5, 1.0], [20.0, 14.0]),
        (3.0, [2.5, 2.0], [9.0, 17.0]),
        (3.0, [2.0, 2.4], [13.0, 12.0]),
    ] {
        let [w, counter] = weights;
        let slope = |t: f64| {
            let (at, way, size) = swung(r, t, d_m);
            w * way[1] + counter * ((at[0] - d_m[0]) * way[0] + (at[1] - d_m[1]) * way[1]) / size
        };
        let angles = zeros(slope);
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::free("Q").with_force([0.0, 0.0, -w]),
            Joint::anchor("D", [0.8 * d_m[0], 0.6 * d_m[0], d_m[1]]),
            Joint::free("E").with_force([0.0, 0.0, -counter]),
        ];
        let tackle = system(joints, vec![Member::bar(0, 1, light(r)), rope(&[3, 2, 1], 9.0)]);
        let census = whole(&tackle);
        assert_eq!(census.equilibria.len(), angles.len(), "{d_m:?} {weights:?}");
        for t in &angles {
            let (at, _, size) = swung(r, *t, d_m);
            let [q, e] = [
                [0.8 * at[0], 0.6 * at[0], at[1]],
                [0.8 * d_m[0], 0.6 * d_m[0], d_m[1] + size - 9.0],
            ];
            let near = |one: &[Interval; 3], at: Vector| {
                (0..3).all(|k| (one[k].mid() - at[k]).abs() < 1e-9)
            };
            let same = census
                .equilibria
                .iter()
                .filter(|one| near(&one.joints_m[1], q) && near(&one.joints_m[3], e));
            let same: Vec<_> = same.collect();
            let [one] = same[..] else { panic!("{t}: {} {q:?}", same.len()) };
            assert!((one.axial_n[1].mid() - counter).abs() < 1e-9);
            // In the plane the energy falls where its second derivative is negative.
            let falls = slope(t + 1e-4) < slope(t - 1e-4);
            assert!(
                one.index_in_space >= usize::from(falls)
                    && one.index_in_space <= 1 + usize::from(falls)
            );
        }
        counts.push(angles.len());
    }
    assert!(counts.contains(&4) && counts.contains(&2), "{counts:?}");
}

/// A rope too short: the counterweight may run to its pulley, and what is in balance there is not listed.
#[test]
fn a_weight_that_runs_to_its_pulley_is_left_open() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("Q").with_force([0.0, 0.0, -20.0]),
        Joint::anchor("D", [1.6, 1.2, 4.0]),
        Joint::free("E").with_force([0.0, 0.0, -3.0]),
    ];
    // Q hangs 3 m below A, 7.3 m from D, if it may.
    let on = |length_m: f64| {
        let members = vec![Member::bar(0, 1, light(3.0)), rope(&[3, 2, 1], length_m)];
        SystemCensus::take(&system(joints.clone(), members), &Settings::default()).unwrap()
    };
    let (long, short) = (on(8.0), on(5.0));
    assert!(long.complete && !short.complete);
    let reasons: Vec<Open> =
        short.nets().flat_map(|net| &net.undecided).map(|open| open.reason).collect();
    assert!(
        !reasons.is_empty() && reasons.iter().all(|reason| *reason == Open::Jam),
        "{reasons:?}"
    );
    // The upright ones are listed with both.
    assert!(short.equilibria.len() < long.equilibria.len());
}

/// A topping lift of three strands that stretches, `V = EA (s - L)²/2L`.
#[test]
fn a_boom_on_an_elastic_tackle_is_scanned() {
    let (w, length_m, stiffness_n, d_m) = (30.0, 10.0, 60.0, [-1.0, 5.0]);
    let slope = |t: f64| {
        let (at, way, size) = swung(4.0, t, d_m);
        let tension = stiffness_n * (3.0 * size / length_m - 1.0).max(0.0);
        w * way[1] + 3.0 * tension * ((at[0] - d_m[0]) * way[0] + (at[1] - d_m[1]) * way[1]) / size
    };
    let mut elastic = boom(3, 0.0, Joint::free("P"), length_m);
    let members = vec![
        elastic.members()[0].clone(),
        elastic.members()[1].clone().with_stiffness(stiffness_n),
    ];
    elastic = system(elastic.joints().to_vec(), members);
    let census = whole(&elastic);
    let angles = zeros(slope);
    assert_eq!(census.equilibria.len(), angles.len(), "{angles:?}");
    for t in angles {
        let (at, _, size) = swung(4.0, t, d_m);
        let tension = stiffness_n * (3.0 * size / length_m - 1.0).max(0.0);
        let same = census.equilibria.iter().filter(|one| {
            (one.joints_m[1][2].mid() - at[1]).abs() < 1e-9
                && (one.joints_m[1][0].mid() - 0.6 * at[0]).abs() < 1e-9
                && (one.axial_n[1].mid() - tension).abs() < 1e-8
        });
        assert_eq!(same.count(), 1, "{t}");
    }
    // Nothing bounds where P is without the boom.
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(1.0),
        Joint::anchor("D", [1.0, 0.0, 2.0]),
        Joint::anchor("C", [-1.0, 0.5, 2.0]),
    ];
    let lift = |at: usize| Member::cable(at, 1, light(1.0)).with_stiffness(50.0);
    let members = vec![
        rope(&[0, 1, 2], 3.0).with_stiffness(50.0),
        lift(3),
        Member::bar(0, 1, light(0.5)).with_stiffness(50.0).of_kind(Kind::Strut),
    ];
    assert_eq!(refusal(&system(joints, members)), NoCensus::Elastic { member: 1 });
}

/// Bars from A over P and Q to B, a rope from P over a pulley to Q, and weights with side winds.
fn linkage(random: &mut ChaCha8Rng, winds: bool, stiffness_n: Option<f64>) -> System {
    let mut near = |at: Vector| at.map(|x| x + random.random_range(-0.2..0.2));
    let [a, b, d] = [near([0.0; 3]), near([3.0, 0.0, 0.3]), near([1.4, 0.3, 1.9])];
    let mut range = |low: f64, high: f64| random.random_range(low..high);
    let wind = if winds { range(0.5, 2.0) } else { 0.0 };
    let joints = vec![
        Joint::anchor("A", a),
        Joint::free("P").with_force([0.3 * wind, wind, -range(6.0, 12.0)]),
        Joint::free("Q").with_force([0.0, -0.4 * wind, -range(6.0, 12.0)]),
        Joint::anchor("B", b),
        Joint::anchor("D", d),
    ];
    let mut members = vec![
        Member::bar(0, 1, light(range(1.4, 1.7))),
        Member::bar(1, 2, light(range(1.1, 1.4))),
        Member::bar(2, 3, light(range(1.4, 1.7))),
    ];
    members.push(rope(&[1, 4, 2], range(3.0, 3.4)).with_stiffness(stiffness_n));
    system(joints, members)
}

/// A strut from the ground to M, that a rope from B over M to C holds under a load.
fn mast(random: &mut ChaCha8Rng) -> System {
    let mut near = |at: Vector| at.map(|x| x + random.random_range(-0.2..0.2));
    let [a, b, c] = [near([0.0; 3]), near([-2.0, -1.2, 0.1]), near([-2.1, 1.3, -0.1])];
    let load = near([2.0, 0.5, -9.0]);
    let mut range = |low: f64, high: f64| random.random_range(low..high);
    let joints = vec![
        Joint::anchor("A", a),
        Joint::free("M").with_force(load),
        Joint::anchor("B", b),
        Joint::anchor("C", c),
    ];
    let strut = Member::bar(0, 1, light(range(2.0, 2.4))).of_kind(Kind::Strut);
    let members = vec![strut, rope(&[2, 1, 3], range(6.0, 6.8))];
    system(joints, members)
}

/// Places and forces of all members of what Newton's method comes to, if signs and lengths are those of the kinds.
fn equilibrium(acting: &Acting, random: &mut ChaCha8Rng) -> Option<Vec<f64>> {
    let places = 3 * acting.free.len();
    let at = acting.newton(random)?;
    let fits = |(k, member): (usize, &Member)| {
        let force = acting.members.iter().position(|acting| *acting == k).map(|i| at[places + i]);
        match (member.kind, force) {
            (Kind::Bar, _) => true,
            (Kind::Cable, Some(force)) => force > 0.0,
            (Kind::Strut, Some(force)) => force < 0.0,
            (Kind::Cable, None) => acting.beyond(&at, k) < 0.0,
            (Kind::Strut, None) => acting.beyond(&at, k) > 0.0,
        }
    };
    if !acting.system.members().iter().enumerate().all(fits) {
        return None;
    }
    let mut all = at[..places].to_vec();
    all.resize(places + acting.system.members().len(), 0.0);
    for (member, force) in acting.members.iter().zip(&at[places..]) {
        all[places + member] = *force;
    }
    Some(all)
}
/// All that Newton's method finds, from so many points with each set of members that act.
fn found(system: &System, random: &mut ChaCha8Rng, starts: usize) -> Vec<Vec<f64>> {
    let mut found: Vec<Vec<f64>> = vec![];
    let all = system.members().len();
    for set in 0_u32..1 << all {
        let acts = |k: &usize| set >> k & 1 == 1;
        let may = |k: usize| system.members()[k].kind != Kind::Bar || acts(&k);
        if !(0..all).all(may) {
            continue;
        }
        let acting = Acting::new(system, (0..all).filter(acts).collect());
        for _ in 0..starts {
            let Some(at) = equilibrium(&acting, random) else { continue };
            let known = |other: &Vec<f64>| {
                other.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-6 * (1.0 + b.abs()))
            };
            if !found.iter().any(known) {
                found.push(at);
            }
        }
    }
    found
}

/// Every equilibrium that Newton's method finds is listed; how many are listed, found, and listed with a taut rope.
fn compared(system: &System, random: &mut ChaCha8Rng, starts: usize) -> [usize; 3] {
    let (census, free) = (whole(system), Acting::new(system, vec![]).free);
    let found = found(system, random, starts);
    for at in &found {
        let is = |one: &&census::net::SystemPosition| {
            let places = free.iter().flat_map(|k| one.joints_m[*k].map(Interval::mid));
            let all = places.chain(one.axial_n.iter().map(|x| x.mid()));
            all.zip(at).all(|(a, b)| (a - b).abs() < 1e-7 * (1.0 + b.abs()))
        };
        assert_eq!(census.equilibria.iter().filter(is).count(), 1, "{at:?}");
    }
    let taut = census.equilibria.iter().filter(|one| one.axial_n.last().unwrap().lo() > 0.0);
    [census.equilibria.len(), found.len(), taut.count()]
}

#[test]
fn masts_on_bridles_are_listed_as_newton_finds_them() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut sums = [0; 3];
    for _ in 0..12 {
        let drawn = mast(&mut random);
        let counts = compared(&drawn, &mut random, 400);
        (0..3).for_each(|k| sums[k] += counts[k]);
    }
    println!("{sums:?}");
    assert!(sums[0] == sums[1] && sums[2] > 6, "{sums:?}");
}

#[test]
fn linkages_with_a_rope_are_listed_as_newton_finds_them() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut sums = [0; 3];
    // Wind, and ropes that stretch.
    for (winds, stiffness_n) in [(false, None), (true, None), (false, Some(40.0)), (true, None)] {
        let drawn = linkage(&mut random, winds, stiffness_n);
        let start = std::time::Instant::now();
        let counts = compared(&drawn, &mut random, 300);
        println!("{counts:?} {:?}", start.elapsed());
        (0..3).for_each(|k| sums[k] += counts[k]);
    }
    println!("{sums:?}");
    assert!(sums[0] == sums[1] && sums[2] > 12, "{sums:?}");
}

/// Cables alone, more ropes than are tried, a ring without a load, and a rope that may be slack and taut.
#[test]
fn what_has_no_list_is_told_why() {
    let joints = samples::joints(&[[0.0; 3], [3.0, 0.0, 0.0]], &[1.0]);
    let alone = system(joints.clone(), vec![rope(&[0, 2, 1], 5.0)]);
    assert_eq!(refusal(&alone), NoCensus::Cables);
    let mut many = joints.clone();
    many.extend((0_u8..7).map(|k| Joint::anchor(format!("C{k}"), [f64::from(k), 1.0, 0.5])));
    let members = [0, 3, 4, 5, 6, 7, 8, 9]
        .map(|k| Member::cable(k, 2, light(7.0)).with_stiffness(50.0))
        .into_iter();
    let members: Vec<Member> = members.chain([Member::bar(1, 2, light(3.5))]).collect();
    assert_eq!(refusal(&system(many, members)), NoCensus::SlackSets { limit: 64 });
    // Over a ring without weight at the end of a boom's cable.
    let mut light_ring = joints.clone();
    light_ring.push(Joint::free("R"));
    let members =
        vec![Member::bar(0, 2, light(2.0)), Member::cable(2, 3, light(1.0)), rope(&[0, 3, 1], 5.0)];
    assert_eq!(refusal(&system(light_ring, members)), NoCensus::Loose { joint: 4 });
    // A rope exactly as long as it reaches to the hanging, and to the standing boom is both.
    let members = vec![Member::bar(0, 2, light(4.0)), rope(&[1, 2, 1], 10.0)];
    assert_eq!(refusal(&system(joints, members)), NoCensus::Limp { member: 2 });
}

/// A pendulum beside a strut that cannot reach it, bar and strut being too short for their anchors, and a rope that is
/// too long: it hangs and stands, and a list without any position of bar and strut together passes its check.
#[test]
fn what_does_not_reach_has_no_position() {
    let joints = samples::joints(&[[0.0; 3], [3.0, 0.2, 0.1], [2.0, 0.5, 1.0]], &[2.0]);
    let strut = Member::bar(1, 3, light(1.5)).of_kind(Kind::Strut);
    let members = vec![Member::bar(0, 3, light(1.0)), strut, rope(&[1, 2, 3], 12.0)];
    let census = whole(&system(joints, members));
    let heights: Vec<f64> = census.equilibria.iter().map(|e| e.joints_m[3][2].mid()).collect();
    assert!(heights.len() == 2 && (heights[0] + 1.0).abs() < 1e-12, "{heights:?}");
    assert!(census.chains().count() > 0);
    for chain in census.chains() {
        assert_eq!(chain.check, Ok(()), "{:?}", chain.members);
    }
}
