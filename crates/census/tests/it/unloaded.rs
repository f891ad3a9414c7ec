//! Bars that carry no force: decided, by hand, by the check, and by what happens a little off.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::support::{census, equal, problem};
use census::net::SystemCensus;
use census::{Census, ProvenEquilibrium, Settings};
use model::system::System;
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// The equilibria in which a bar carries next to nothing.
fn unloaded(census: &Census) -> Vec<&ProvenEquilibrium> {
    census.equilibria.iter().filter(|equilibrium| equilibrium.signs.contains(&0)).collect()
}

#[test]
fn a_bar_without_force_bridges_the_gap() {
    // Bar 1 hangs down by 0.9, bar 3 rises by 0.4, and bar 2, which then carries nothing, is level
    // and bridges the gap of 1 exactly.
    let chain = |gap: f64| {
        problem(&[(0.9, 1.0, 0.5), (1.0, 2.0, 0.75), (0.4, 1.0, 0.25)], [gap, 0.0, -0.5])
    };
    let exact = census(&chain(1.0));
    assert!(exact.complete, "{:?}", exact.undecided);
    let hanging = unloaded(&exact);
    let [hanging] = hanging[..] else { panic!("{hanging:?}") };
    assert_eq!(hanging.signs, [1, 0, 1]);
    assert_eq!((hanging.index_in_plane, hanging.index_in_space(), hanging.optimal), (0, 0, true));
    let near = |interval: census::Interval, expected: f64| {
        assert!((interval.mid() - expected).abs() < 1e-14, "{interval:?} {expected}");
        assert!(interval.width() < 1e-13, "{interval:?}");
    };
    // By hand: upright, level, upright.
    for (angle, expected) in hanging.angles_rad.iter().zip([0.0, FRAC_PI_2, PI]) {
        near(*angle, expected);
    }
    for (joint, expected) in hanging.joints_m.iter().zip([[0.0, 0.0], [0.0, -0.9], [1.0, -0.9]]) {
        near(joint[0], expected[0]);
        near(joint[2], expected[1]);
    }
    // Joint 1 carries 5/9 of bar 1 and a quarter of bar 2; joint 2 the rest of bar 2 and 3/8 of bar
    // 3.
    let newton = [5.0 / 9.0 + 0.5, 0.0, 1.5 + 3.0 / 8.0].map(|kilogram| 9.81 * kilogram);
    for (force, expected) in hanging.axial_n.iter().zip(newton) {
        near(*force, expected);
    }
    near(hanging.energy_j, 9.81 * (-0.5 - 2.0 * 0.9 + (-0.9 + 0.25)));
    // A little off, and the bar is nearly without force; nothing else changes.
    for off in [1e-3, 1e-6, 1e-9, 1e-11, 1e-12, 1e-13, 1e-14, 1e-15, 1e-16] {
        for sign in [-1.0, 1.0] {
            let census = census(&chain(1.0 + sign * off));
            assert!(census.complete, "{off:e}: {:?}", census.undecided);
            assert_eq!(census.count_by_index(), exact.count_by_index(), "{off:e}");
            // Nearly without force is not next to nothing, until rounding sets in.
            assert!(off < 1e-10 || unloaded(&census).is_empty(), "{off:e}");
            assert!(off > 1e-14 || unloaded(&census).len() == 1, "{off:e}");
            let least = census
                .equilibria
                .iter()
                .map(|equilibrium| equilibrium.axial_n[1].mag())
                .fold(f64::INFINITY, f64::min);
            assert!(least < 1e3 * off + 1e-13, "{off:e} {least:e}");
        }
    }
}

/// Two equal bars between anchors a length apart, across and up: one bar is upright, the other
/// level.
#[test]
fn a_right_angle_of_two_bars_is_decided() {
    let census = census(&equal(2, [1.0, 0.0, 1.0]));
    assert!(census.complete, "{:?}", census.undecided);
    let [lower, upper] = &census.equilibria[..] else { panic!("{:?}", census.equilibria) };
    assert_eq!((&lower.signs[..], &upper.signs[..]), (&[0, 1][..], &[-1, 0][..]));
    // Centres at 0 and 0.5, or at 0.5 and 1.
    for (found, height) in [(lower, 0.5), (upper, 1.5)] {
        assert!((found.energy_j.mid() / 9.81 - height).abs() < 1e-14);
    }
    assert_eq!((lower.index_in_space(), lower.optimal), (0, true));
    assert_eq!((upper.index_in_space(), upper.optimal), (1, false));
    // Drawn dashed, once in each panel and once in the key.
    let svg = census.figure("right angle", 60);
    assert_eq!(svg.matches("stroke-dasharray=\"6 3\"").count(), 3);
    assert!(svg.contains("no force"));
    // What is said of a bar without force is checked.
    let chain = equal(2, [1.0, 0.0, 1.0]);
    for change in [
        |e: &mut ProvenEquilibrium| e.signs[0] = 1,
        |e: &mut ProvenEquilibrium| e.signs[1] = -1,
        |e: &mut ProvenEquilibrium| e.signs[1] = 0,
        |e: &mut ProvenEquilibrium| e.index_in_plane = 1,
        |e: &mut ProvenEquilibrium| e.optimal = false,
        |e: &mut ProvenEquilibrium| e.axial_n[1] = -e.axial_n[1],
        |e: &mut ProvenEquilibrium| e.angles_rad[0] = -e.angles_rad[0],
        |e: &mut ProvenEquilibrium| e.alone_in.at[0] = e.alone_in.at[0] + e.alone_in.at[0],
    ] {
        let mut wrong = census.clone();
        change(&mut wrong.equilibria[0]);
        assert!(wrong.check(&chain).is_err());
    }
}

/// Lengths that are small integers make bars carry nothing. Such equilibria are regular: a little
/// off there are as many of each index, with nearly the same energies, and there every bar carries
/// something. (The masses are no integers: those can make them degenerate.)
#[test]
fn integers_are_decided_as_their_neighbours_are() {
    /// Off the integers by this; the energies follow in proportion.
    const OFF: f64 = 1e-6;
    let mut rng = ChaCha8Rng::seed_from_u64(11);
    let (mut met, mut tried) = (0, 0);
    while met < 40 {
        tried += 1;
        assert!(tried < 4000, "{met} of 40");
        let n = rng.random_range(2..=5);
        let bars: Vec<(f64, f64, f64)> = (0..n)
            .map(|_| {
                let length = f64::from(rng.random_range(1..=3_u8));
                (length, rng.random_range(0.5..4.0), 0.5 * length)
            })
            .collect();
        let mut end = |range| f64::from(rng.random_range(range));
        let end = [end(1..=4_i8), 0.0, end(-4..=4)];
        let anchors = |by: f64| Anchors { start_m: [0.0; 3], end_m: [end[0] + by, 0.0, end[2]] };
        let chain = |by: f64| {
            let bars = bars.iter().map(|(l, m, r)| Bar::new(*l, *m, *r, [0.0; 3]).unwrap());
            Problem::new(Chain::new("integers", 9.81, anchors(by), bars.collect()).unwrap())
        };
        let (Ok(exact), Ok(less), Ok(more)) = (chain(0.0), chain(-OFF), chain(OFF)) else {
            continue;
        };
        let exact = census(&exact);
        if unloaded(&exact).is_empty() || exact.topology.is_err() {
            continue;
        }
        met += 1;
        assert!(exact.complete, "{bars:?} {end:?}: {:?}", exact.undecided);
        for near in [less, more] {
            let near = census(&near);
            assert!(near.complete && unloaded(&near).is_empty(), "{bars:?} {end:?}");
            assert_eq!(near.count_by_index(), exact.count_by_index(), "{bars:?} {end:?}");
            for (a, b) in exact.equilibria.iter().zip(&near.equilibria) {
                let off = (a.energy_j.mid() - b.energy_j.mid()).abs();
                assert!(off < 1e3 * OFF, "{bars:?} {end:?}: {off:e}");
            }
        }
    }
}

/// Of a family of slack bars between two strands the first hangs and the last rises, if both pull;
/// where one pushes it stands the other way.
#[test]
fn strands_of_a_family_are_vertical() {
    use std::f64::consts::PI;
    let heavy = |length: f64, mass| (length, mass, 0.5 * length);
    let bars = [heavy(0.9, 2.0), heavy(0.3, 0.0), heavy(0.4, 0.0), heavy(0.7, 1.5)];
    let problem = problem(&bars, [0.3, 0.0, -0.1]);
    let census = census(&problem);
    assert_eq!(census.families.len(), 2);
    for family in &census.families {
        let expected = match family.signs[..] {
            [1, 0, 0, 1] => [Some(0.0), None, None, Some(PI)],
            [-1, 0, 0, -1] => [Some(PI), None, None, Some(0.0)],
            _ => panic!("{:?}", family.signs),
        };
        let bits = |angle: &Option<f64>| angle.map(f64::to_bits);
        let found = family.angles_rad(&problem);
        assert!(found.iter().map(bits).eq(expected.iter().map(bits)), "{found:?}");
    }
}

/// Slack bars in a chain are slack in its system: two that hang at the ends with two slack ones between, and what
/// else the chain has; weights at the joints.
#[test]
fn families_of_a_system_are_those_of_its_chain() {
    let bars = [(0.9, 2.0, 0.3), (0.5, 0.0, 0.25), (0.6, 0.0, 0.3), (0.7, 1.5, 0.2)];
    let problem = problem(&bars, [0.3, 0.0, -0.1]);
    let chain = Census::take(&problem, &Settings::default()).unwrap();
    let system = System::from(problem.chain());
    let system = SystemCensus::take(&system, &Settings::default()).unwrap();
    assert!(chain.complete && system.complete && !chain.families.is_empty());
    assert_eq!(system.families(), chain.families.len());
    assert_eq!(system.equilibria.len(), chain.equilibria.len());
}
