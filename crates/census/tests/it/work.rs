//! The work of censuses and the width of what they prove, frozen: cells, tests, proofs and the
//! binary orders of the widest enclosures. A bound that is wider than it need be, or a cell that is
//! cut once more, changes no answer, and is a change all the same. Where one is meant, the failing
//! test prints the table that then belongs here.

#![expect(clippy::cast_possible_truncation, reason = "binary orders of doubles are small")]

use census::boxes::prove;
use census::net::SystemCensus;
use census::{Census, Interval, ProvenEquilibrium, Settings};
use model::{Anchors, Bar, Chain, Problem};
use samples::{General, Line, assert_frozen, stream};

use crate::support::{census, equal, problem};

/// Equilibria, families, straight positions, undecided cells, the sum of all
/// indices in the plane and in space; cells, tests, proofs, levels; binary orders of the widest
/// angle (rad), joint (parts of the length) and force (parts of the weight).
type Row = [i64; 13];

fn order(width: f64) -> i64 {
    if width > 0.0 { width.log2().floor() as i64 } else { 0 }
}

fn widest(equilibrium: &ProvenEquilibrium, scale: [f64; 2]) -> [i64; 3] {
    let most = |widths: &mut dyn Iterator<Item = &Interval>| {
        widths.map(|interval| interval.width()).fold(0.0, f64::max)
    };
    let angles = most(&mut equilibrium.angles_rad.iter());
    let joints = most(&mut equilibrium.joints_m.iter().flatten());
    let forces = most(&mut equilibrium.multipliers_n.iter().flatten());
    [order(angles), order(joints / scale[0]), order(forces / scale[1])]
}

fn add(row: &mut Row, problem: &Problem, census: &Census) {
    let counts = [
        census.equilibria.len(),
        census.families.len(),
        census.straight.len(),
        census.undecided.len(),
        census.equilibria.iter().map(|e| e.index_in_plane).sum(),
        census.equilibria.iter().map(ProvenEquilibrium::index_in_space).sum(),
    ];
    for (sum, count) in row.iter_mut().zip(counts) {
        *sum += i64::try_from(count).unwrap();
    }
    let spent = &census.statistics;
    for (sum, count) in
        row[6..].iter_mut().zip([spent.cells, spent.tests, spent.proofs, u64::from(spent.levels)])
    {
        *sum += i64::try_from(count).unwrap();
    }
    let chain = problem.chain();
    let length: f64 = chain.bars().iter().map(Bar::length_m).sum();
    let scale = [length, chain.total_mass_kg() * chain.gravity_m_s2()];
    for equilibrium in &census.equilibria {
        for (sum, order) in row[10..].iter_mut().zip(widest(equilibrium, scale)) {
            *sum += order;
        }
    }
}

#[test]
fn work_of_chains_in_general_position() {
    let mut found = Vec::new();
    for line in [Line::Any, Line::Vertical] {
        for bars in 2..=6 {
            let mut row = Row::default();
            for seed in 500..506 {
                let problem = General::of_censuses(line).problem(&mut stream(seed, 3), bars);
                add(&mut row, &problem, &census(&problem));
            }
            found.push((bars, row));
        }
    }
    let expected = [
        (2, [12, 0, 0, 0, 0, 6, 829, 1109, 26, 88, -574, -595, -598]),
        (3, [20, 0, 0, 0, 10, 30, 1708, 2986, 31, 83, -956, -990, -1005]),
        (4, [58, 0, 0, 0, 56, 141, 8486, 14050, 100, 174, -2746, -2854, -2915]),
        (5, [86, 0, 0, 0, 125, 293, 12221, 25500, 161, 164, -4067, -4228, -4302]),
        (6, [178, 0, 0, 0, 354, 797, 10363, 40642, 323, 112, -8414, -8752, -8884]),
        (2, [6, 0, 0, 0, 0, 0, 441, 593, 11, 76, -288, -300, -301]),
        (3, [12, 0, 0, 0, 6, 12, 746, 1358, 25, 72, -573, -600, -602]),
        (4, [31, 0, 0, 0, 31, 62, 1846, 4330, 53, 92, -1463, -1529, -1557]),
        (5, [50, 0, 0, 0, 75, 150, 2895, 9402, 93, 105, -2367, -2462, -2506]),
        (6, [131, 0, 0, 0, 262, 524, 5720, 22840, 241, 128, -6167, -6433, -6542]),
    ];
    assert_frozen(&found[..], &expected);
}

/// Round lengths, bars without mass, anchors in one point: slack families, straight positions,
/// merged equilibria, and what stays undecided.
#[test]
fn work_of_special_chains() {
    let light = |length| (length, 0.0, 0.5 * length);
    let heavy = |length, mass| (length, mass, 0.5 * length);
    let chains = [
        (
            "closed triangle",
            problem(&[heavy(3.0, 1.0), heavy(4.0, 2.0), heavy(5.0, 1.0)], [0.0; 3]),
        ),
        ("closed rhombus", equal(4, [0.0; 3])),
        ("level", equal(4, [2.0, 0.0, 0.0])),
        ("plumb", equal(4, [0.0, 0.0, -2.0])),
        (
            "two light",
            problem(&[heavy(0.9, 2.0), light(0.3), light(0.4), heavy(0.7, 1.5)], [0.3, 0.0, -0.1]),
        ),
        (
            "three light",
            problem(
                &[heavy(0.9, 2.0), light(0.3), light(0.4), light(0.2), heavy(0.7, 1.5)],
                [0.3, 0.0, -0.1],
            ),
        ),
        ("light ends", problem(&[light(0.5), heavy(1.0, 1.0), light(0.7)], [0.8, 0.0, 0.2])),
        ("step", problem(&[heavy(1.0, 1.0), light(1.0), heavy(1.0, 1.0)], [1.0, 0.0, -2.0])),
        ("nearly taut", equal(3, [2.999, 0.0, -0.01])),
        ("nearly closed", equal(3, [1e-3, 0.0, 1e-3])),
    ];
    let mut found = Vec::new();
    for (name, problem) in chains {
        let mut row = Row::default();
        let census = census(&problem);
        add(&mut row, &problem, &census);
        found.push((name, row));
    }
    let expected = [
        ("closed triangle", [2, 0, 0, 0, 1, 2, 90, 300, 6, 13, -95, -98, -100]),
        ("closed rhombus", [0, 0, 6, 0, 0, 0, 4306, 12264, 0, 17, 0, 0, 0]),
        ("level", [6, 0, 4, 0, 6, 15, 519, 1284, 12, 13, -286, -296, -302]),
        ("plumb", [1, 0, 4, 0, 1, 2, 166, 602, 4, 10, -48, -50, -51]),
        ("two light", [8, 2, 0, 0, 8, 20, 806, 1741, 12, 15, -383, -398, -398]),
        ("three light", [18, 2, 0, 0, 27, 63, 1784, 4400, 31, 30, -859, -891, -895]),
        ("light ends", [8, 0, 0, 0, 4, 12, 489, 828, 15, 19, -380, -395, -399]),
        ("step", [2, 0, 0, 1, 1, 3, 76987, 78632, 0, 134, -96, -100, -100]),
        ("nearly taut", [2, 0, 0, 0, 1, 3, 51, 128, 4, 12, -100, -100, -92]),
        ("nearly closed", [4, 0, 0, 0, 2, 6, 135, 544, 12, 13, -192, -200, -204]),
    ];
    assert_frozen(&found[..], &expected);
}

fn threads(count: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(count).build().unwrap()
}

/// Two threads and one, lengths and masses times powers of two: the same list, number for number.
#[test]
fn neither_threads_nor_units_change_a_digit() {
    for seed in 0..4 {
        let bars = 3 + usize::try_from(seed % 3).unwrap();
        let one = General::of_censuses(Line::Any).problem(&mut stream(600 + seed, 4), bars);
        let chain = one.chain();
        let times = |vector: [f64; 3]| vector.map(|x| 8.0 * x);
        let anchors = chain.anchors();
        let anchors = Anchors { start_m: times(anchors.start_m), end_m: times(anchors.end_m) };
        let parts = chain.bars().iter().map(|bar| {
            Bar::new(8.0 * bar.length_m(), 4.0 * bar.mass_kg(), 8.0 * bar.centre_m(), [0.0; 3])
                .unwrap()
        });
        let gravity = 0.5 * chain.gravity_m_s2();
        let other = Chain::new("scaled", gravity, anchors, parts.collect()).unwrap();
        let other = census(&Problem::new(other).unwrap());
        let single = threads(1).install(|| census(&one));
        let census = threads(2).install(|| census(&one));
        assert_eq!(census.equilibria, single.equilibria);
        assert_eq!(census.statistics.cells, single.statistics.cells);
        assert_eq!(census.equilibria.len(), other.equilibria.len());
        let scaled = |a: Interval, factor: f64, b: Interval| {
            assert_eq!((factor * a.lo(), factor * a.hi()), (b.lo(), b.hi()));
        };
        for (a, b) in census.equilibria.iter().zip(&other.equilibria) {
            assert_eq!((&a.signs, &a.angles_rad), (&b.signs, &b.angles_rad));
            assert_eq!((a.index_in_plane, a.optimal), (b.index_in_plane, b.optimal));
            scaled(a.energy_j, 16.0, b.energy_j);
            for (a, b) in a.joints_m.iter().flatten().zip(b.joints_m.iter().flatten()) {
                scaled(*a, 8.0, *b);
            }
            for (a, b) in a.axial_n.iter().zip(&b.axial_n) {
                scaled(*a, 2.0, *b);
            }
        }
        assert_eq!(census.statistics.cells, other.statistics.cells);
        assert_eq!(census.statistics.proofs, other.statistics.proofs);
    }
}

/// Systems of the gallery: positions, parts, families, cells, and the orders of their widths; of
/// the others why there is no census.
#[test]
fn work_of_systems() {
    let settings = Settings { max_bars: 6, max_motions: 2, ..Settings::default() };
    let mut found = Vec::new();
    for exhibit in model::cases::systems() {
        let row = match SystemCensus::take(&exhibit.system(), &settings) {
            Ok(census) => {
                let mut orders = [0, 0];
                for position in &census.equilibria {
                    orders[0] += order(position.width_m());
                    orders[1] += order(position.width_n());
                }
                let indices: usize = census.equilibria.iter().map(|e| e.index_in_space).sum();
                let counts = [
                    census.equilibria.len(),
                    census.parts.len(),
                    census.families(),
                    census.undecided(),
                    indices,
                    usize::from(census.complete),
                ];
                format!("{counts:?} {} {orders:?}", census.cells())
            }
            Err(reason) => format!("{reason:?}"),
        };
        found.push(format!("{}: {row}", exhibit.name));
    }
    let expected = [
        "lamp: [1, 3, 0, 0, 0, 1] 95 [-47, -45]",
        "bridle: Motions { closures: 2, motions: 30, limit: 2 }",
        "mobile: Motions { closures: 3, motions: 6, limit: 2 }",
        "footbridge: Slider { joint: 4 }",
        "net: Motions { closures: 67, motions: 87, limit: 2 }",
        "ring: Motions { closures: 3, motions: 15, limit: 2 }",
        "tripod: [2, 1, 0, 0, 0, 1] 0 [-90, -74]",
        "pendulum-chain: [32, 1, 0, 0, 160, 1] 0 [-1504, -1376]",
        "four-bar-linkage: [4, 1, 0, 0, 8, 0] 315 [-192, -166]",
        "x-cross: Slider { joint: 3 }",
        "prism: Slider { joint: 4 }",
        "expandable-octahedron: Slider { joint: 3 }",
        "simplex-tower: Slider { joint: 4 }",
    ];
    assert_frozen(&found[..], &expected.map(str::to_owned));
}

/// Lengths, masses and gravity of systems times powers of two: the same list, number for number, and the same
/// proofs of its entries.
#[test]
fn systems_scale_without_rounding() {
    let settings = Settings { max_bars: 6, max_motions: 2, ..Settings::default() };
    let mut compared = 0;
    for exhibit in model::cases::systems() {
        let system = exhibit.system();
        let Ok(one) = SystemCensus::take(&system, &settings) else { continue };
        for factors in [[8.0, 1.0, 1.0], [1.0, 0.0625, 4.0], [0.25, 32.0, 0.5]] {
            let [length, mass, gravity] = factors;
            let other = samples::scaled(&system, factors);
            let there = SystemCensus::take(&other, &settings).unwrap();
            assert_eq!(one.equilibria.len(), there.equilibria.len(), "{}", exhibit.name);
            assert_eq!((one.complete, one.cells()), (there.complete, there.cells()));
            let same = |a: &Interval, factor: f64, b: &Interval| {
                // What is nearly nothing has fewer digits.
                let whole = |x: f64| if x.abs() < 1e-300 { 0.0 } else { x };
                let [one, other] = [(factor * a.lo(), factor * a.hi()), (b.lo(), b.hi())]
                    .map(|(lo, hi)| (whole(lo), whole(hi)));
                assert_eq!(one, other, "{} {factors:?}", exhibit.name);
            };
            let all = |a: &[Interval], factor: f64, b: &[Interval]| {
                a.iter().zip(b).for_each(|(a, b)| same(a, factor, b));
            };
            for (a, b) in one.equilibria.iter().zip(&there.equilibria) {
                compared += 1;
                assert_eq!(
                    (a.index_in_space, a.index_in_plane),
                    (b.index_in_space, b.index_in_plane)
                );
                same(&a.energy_j, length * mass * gravity, &b.energy_j);
                all(a.joints_m.as_flattened(), length, b.joints_m.as_flattened());
                all(&a.axial_n, mass * gravity, &b.axial_n);
                all(a.reactions_n.as_flattened(), mass * gravity, b.reactions_n.as_flattened());
                let mids = |joints_m: &[[Interval; 3]]| -> Vec<[f64; 3]> {
                    joints_m.iter().map(|at| at.map(Interval::mid)).collect()
                };
                let forces = |axial_n: &[Interval]| -> Vec<f64> {
                    axial_n.iter().map(|axial| axial.mid()).collect()
                };
                let [a, b] = [(&system, a), (&other, b)]
                    .map(|(system, at)| prove(system, &mids(&at.joints_m), &forces(&at.axial_n)));
                let (Ok(a), Ok(b)) = (&a, &b) else {
                    assert_eq!(a.is_ok(), b.is_ok());
                    continue;
                };
                assert_eq!((a.turns, &a.slack), (b.turns, &b.slack));
                all(a.joints_m.as_flattened(), length, b.joints_m.as_flattened());
                all(&a.axial_n, mass * gravity, &b.axial_n);
            }
        }
    }
    assert!(compared > 100, "{compared}");
}
