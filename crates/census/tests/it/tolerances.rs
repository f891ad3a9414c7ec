//! Ranges over tolerances: against closed forms, corners and draws.

use census::boxes::{Depth, NoRanges, Range, prove, prove_ranges};
use model::system::{Joint, Member, System};
use model::{Bar, Vector};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// What is found may be so much wider than a closed form: the rounding of some hundred operations.
const ROUNDING: f64 = 1e-12;

fn length(a: Vector, b: Vector) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|k| b[k] - a[k]);
    x.hypot(y).hypot(z)
}

/// 120 N on two bars to anchors 6 m apart, each 5 m ± 2 mm; closed form of place and forces.
fn hanger(tolerance_m: f64, force_n: Option<f64>) -> System {
    let load = Joint::free("P").with_force([0.0, 0.0, -120.0]);
    let joints = vec![
        Joint::anchor("A", [-3.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        load.with_tolerances(None, None, force_n).unwrap(),
    ];
    let bar = |from, to| {
        let bar = Member::bar(from, to, Bar::homogeneous(5.0, 0.0).unwrap());
        bar.with_length_tolerance(tolerance_m)
    };
    System::new("hanger", 10.0, joints, vec![bar(0, 2), bar(1, 2)]).unwrap()
}

const HANGS: [Vector; 3] = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];

/// Where P is and what both bars bear: x = (a² - b²)/12, z² = a² - (x + 3)², and the balance of two pulls.
fn closed(a: f64, b: f64) -> [f64; 4] {
    let x = (a * a - b * b) / 12.0;
    let z = -(a * a - (x + 3.0).powi(2)).sqrt();
    // Horizontally the pulls balance: w (x + 3) = v (3 - x), and (w + v) |z| = 120.
    let sum = 120.0 / -z;
    let (w, v) = (sum * (3.0 - x) / 6.0, sum * (3.0 + x) / 6.0);
    [x, z, w * a, v * b]
}

fn is(range: Range, least: f64, most: f64, size: f64) {
    let near = |found: f64, wanted: f64| (found - wanted).abs() <= ROUNDING * size;
    let [from, to] = range.guaranteed;
    assert!(
        range.is_hull && from <= least + ROUNDING * size && near(from, least),
        "{range:?} {least}"
    );
    assert!(near(to, most) && range.excess() < ROUNDING * size, "{range:?} {most}");
}

/// No hull where what a weight does cancels out, but nearly.
fn near(range: Range, least: f64, most: f64) {
    let [from, to] = range.guaranteed;
    let excess = (to - from) / (most - least) - 1.0;
    assert!(from <= least && to >= most && excess < 0.02, "{range:?} {least} {most}");
}

#[test]
fn a_hanger_of_two_bars_has_the_ranges_of_its_closed_form() {
    let by_m = 2e-3;
    let found = prove_ranges(&hanger(by_m, None), &HANGS, &[75.0; 2], &[]).unwrap();
    assert_eq!((found.boxes, found.numbers.len()), (1, 2));
    let ends = [5.0 - by_m, 5.0 + by_m];
    let corners = ends.map(|a| ends.map(|b| closed(a, b)));
    let all: Vec<[f64; 4]> = corners.into_iter().flatten().collect();
    let hull = |k: usize| {
        let values = || all.iter().map(|corner| corner[k]);
        (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max))
    };
    let [x, z, first, second] = [0, 1, 2, 3].map(hull);
    is(found.joints_m[2][0], x.0, x.1, 5.0);
    is(found.joints_m[2][2], z.0, z.1, 5.0);
    is(found.axial_n[0], first.0, first.1, 120.0);
    is(found.axial_n[1], second.0, second.1, 120.0);
    // Anchors do not move, and bear as much of the load as their bar.
    is(found.joints_m[0][0], -3.0, -3.0, 5.0);
    let up = found.reactions_n[0].unwrap()[2];
    let part = |[x, _, _, _]: [f64; 4]| 120.0 * (3.0 - x) / 6.0;
    let parts = || all.iter().copied().map(part);
    is(up, parts().fold(f64::INFINITY, f64::min), parts().fold(0.0, f64::max), 120.0);
    assert!(found.reactions_n[2].is_none());
    // The other bar's length moves the force of each most or its own: both are named with what they do.
    let (number, by_n) = found.axial_n[0].most_by.unwrap();
    let changed = |a: f64, b: f64| closed(5.0 + a, 5.0 + b)[2] - 75.0;
    let change = if number == 0 { changed(by_m, 0.0) } else { changed(0.0, by_m) };
    assert!((by_n - change).abs() < 1e-2 * change.abs(), "{by_n} {change}");
}

/// Of a bar of 2 kg ± 0.1 kg with its centre 1 m from the anchor a fifth hangs on the joint: 124 N ± 0.2 N on two bars
/// alike, and four fifths on the anchor.
#[test]
fn masses_of_members_act_at_both_ends() {
    let system = hanger(1e-9, None);
    let heavy = Member::bar(0, 2, Bar::given(5.0, 2.0, Some(1.0), None).unwrap());
    let light = Member::bar(1, 2, Bar::homogeneous(5.0, 0.0).unwrap());
    let members = vec![heavy.with_tolerances(None, Some(0.1)).unwrap(), light];
    let system = System::new("heavy", 10.0, system.joints().to_vec(), members).unwrap();
    let found = prove_ranges(&system, &HANGS, &[77.5; 2], &[]).unwrap();
    let axial = [123.8, 124.2].map(|load_n| load_n / 2.0 * 5.0 / 4.0);
    for range in &found.axial_n {
        is(*range, axial[0], axial[1], 120.0);
    }
    let up = |anchor: usize| found.reactions_n[anchor].unwrap()[2];
    is(up(0), 61.9 + 15.2, 62.1 + 16.8, 120.0);
    is(up(1), 61.9, 62.1, 120.0);
}

/// A horizontal force turns the plane of the hanger: across it the place is as far as the force leans.
#[test]
fn a_side_force_is_a_range_too() {
    let found = prove_ranges(&hanger(1e-9, Some(3.0)), &HANGS, &[75.0; 2], &[]).unwrap();
    let range = found.joints_m[2][1];
    // y = z sin(arctan(3/117)), where the force down is least: whether a load down moves it out or in depends on the
    // side, so that the proof is repeated on that side alone.
    let depth = ((5.0_f64 + 1e-9).powi(2) - 9.0).sqrt();
    let most = depth * (3.0_f64 / 117.0).atan().sin();
    let [[least, largest], [from, to]] = [range.guaranteed, range.reached];
    assert!(
        (to - most).abs() < ROUNDING * 5.0 && (from + most).abs() < ROUNDING * 5.0,
        "{range:?}"
    );
    assert!(largest >= to && largest < 1.01 * most && least <= from && least > -1.01 * most);
    // Along the bars, 3/5 and 4/5: (120 + 3)/2 5/4 in the plane and (3/2) 5/3, and across a little.
    let most = found.axial_n[0].guaranteed[1];
    assert!(most > 123.0 / 2.0 * 1.25 + 2.5 - 1e-6 && most < 79.5, "{most}");
}

/// A net of `size` × `size` knots between anchors, with tensions that are drawn, and the loads that go with them.
fn net(size: usize, seed: u64, length_m: f64, stiffness: f64) -> (System, Vec<Vector>, Vec<f64>) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut draw = |least: f64, most: f64| rng.random_range(least..most);
    let side = size + 2;
    let number = |i: usize, j: usize| i * side + j;
    let mut places = vec![];
    for i in 0..side {
        for j in 0..side {
            let z = draw(-0.3, 0.3) + 0.1 * (i as f64 - j as f64);
            places.push([2.0 * i as f64 + draw(-0.2, 0.2), 2.0 * j as f64 + draw(-0.2, 0.2), z]);
        }
    }
    let inside = |i: usize| (1..=size).contains(&i);
    let mut ends = vec![];
    for i in 0..side {
        for j in 0..side {
            for (k, l) in [(i + 1, j), (i, j + 1)] {
                let within = k < side && l < side;
                if within && (inside(i) && inside(j) || inside(k) && inside(l)) {
                    ends.push([number(i, j), number(k, l)]);
                }
            }
        }
    }
    let mut loads = vec![[0.0; 3]; places.len()];
    let (mut members, mut axial) = (vec![], vec![]);
    for [a, b] in ends {
        let (distance, force) = (length(places[a], places[b]), draw(800.0, 2000.0));
        for axis in 0..3 {
            let pull = force * (places[b][axis] - places[a][axis]) / distance;
            loads[a][axis] -= pull;
            loads[b][axis] += pull;
        }
        let ea = draw(5e5, 1e6);
        let body = Bar::homogeneous(distance / (1.0 + force / ea), 0.0).unwrap();
        let cable = Member::cable(a, b, body).with_stiffness(ea).with_length_tolerance(length_m);
        members.push(cable.with_tolerances(Some(stiffness), None).unwrap());
        axial.push(force);
    }
    let joint = |k: usize| {
        let (i, j) = (k / side, k % side);
        if inside(i) && inside(j) {
            Joint::free(k.to_string()).with_force(loads[k])
        } else {
            Joint::anchor(k.to_string(), places[k])
        }
    };
    let joints = (0..places.len()).map(joint).collect();
    (System::new("net", 10.0, joints, members).unwrap(), places, axial)
}

#[test]
fn nets_have_nearly_their_hulls() {
    for (seed, size, most) in
        [(0, 1, 1e-9), (1, 2, 1e-3), (2, 3, 0.05), (3, 3, 0.05), (7, 4, 0.05), (1, 6, 0.05)]
    {
        let (system, places, axial) = net(size, seed, 1e-4, 0.01);
        let found = prove_ranges(&system, &places, &axial, &[]).unwrap();
        assert_eq!((found.boxes, found.numbers.len()), (1, 2 * axial.len()));
        for (range, force) in found.axial_n.iter().zip(&axial) {
            let [least, most_n] = range.guaranteed;
            assert!(
                range.contains(*force) && range.excess() < most * (most_n - least),
                "{range:?}"
            );
            assert!(!range.is_hull || range.excess() < 1e-7, "{range:?}");
        }
    }
}

/// `NETS` random nets, and of each `DRAWS` draws (20 and 500 by night).
fn families() -> [u64; 2] {
    [("NETS", 1), ("DRAWS", 12)]
        .map(|(name, day)| std::env::var(name).map_or(day, |n| n.parse().expect("a number")))
}

/// Draws of the numbers, at ends and between, each proved by itself: all are in the ranges.
#[test]
fn draws_stay_within_their_ranges() {
    let [nets, draws] = families();
    (5..5 + nets).for_each(|seed| draws_stay_within_ranges_of(seed, draws));
}

fn draws_stay_within_ranges_of(seed: u64, draws: u64) {
    let (system, places, axial) = net(2, seed, 1e-6, 1e-4);
    let found = prove_ranges(&system, &places, &axial, &[]).unwrap();
    let mut rng = ChaCha8Rng::seed_from_u64(7);
    for k in 0..draws {
        let values = found.numbers.iter().map(|number| {
            let part: f64 = rng.random_range(-1.0..1.0);
            number.given + number.within * if k % 2 == 0 { part } else { part.signum() }
        });
        let drawn = system.with_uncertain(&values.collect::<Vec<_>>()).unwrap();
        let exact = prove(&drawn, &places, &axial).unwrap();
        for (range, force) in found.axial_n.iter().zip(&exact.axial_n) {
            assert!(range.contains(force.mid()), "{range:?} {force:?}");
        }
        for (range, x) in found.joints_m.iter().flatten().zip(exact.joints_m.iter().flatten()) {
            assert!(range.contains(x.mid()), "{range:?} {x:?}");
        }
    }
}

/// At all 256 corners of the numbers of four cables, each proved by itself: the hull of the forces there is the range.
#[test]
fn a_net_has_the_hull_of_its_corners() {
    let [nets, _] = families();
    (9..9 + nets).for_each(a_net_has_the_hull_of_corners);
}

fn a_net_has_the_hull_of_corners(seed: u64) {
    let (system, places, axial) = net(1, seed, 1e-6, 1e-4);
    let found = prove_ranges(&system, &places, &axial, &[]).unwrap();
    assert_eq!(found.numbers.len(), 8);
    let corner = |corner: u32| {
        let numbers = found.numbers.iter().enumerate();
        let values = numbers.map(|(k, number)| {
            number.given + if corner >> k & 1 == 1 { number.within } else { -number.within }
        });
        let drawn = system.with_uncertain(&values.collect::<Vec<_>>()).unwrap();
        prove(&drawn, &places, &axial).unwrap().axial_n
    };
    let corners: Vec<_> = (0..256).map(corner).collect();
    for (member, range) in found.axial_n.iter().enumerate() {
        let forces = || corners.iter().map(|axial_n| axial_n[member].mid());
        let (least, most) =
            (forces().fold(f64::INFINITY, f64::min), forces().fold(f64::NEG_INFINITY, f64::max));
        let [from, to] = range.guaranteed;
        assert!(range.is_hull && from <= least && to >= most, "{range:?} {least} {most}");
        assert!((to - from) / (most - least) < 1.0 + 1e-6, "{range:?} {least} {most}");
    }
}

/// A third cable below a knot, a little slack or hardly taut: within its tolerance it may change.
#[test]
fn what_may_go_slack_is_named() {
    let joints = vec![
        Joint::anchor("A", [-3.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::anchor("C", [0.0, 0.0, -5.0]),
        Joint::free("P").with_force([0.0, 0.0, -120.0]),
    ];
    let cable = |from, length_m| {
        let cable = Member::cable(from, 3, Bar::homogeneous(length_m, 0.0).unwrap());
        cable.with_stiffness(1e4)
    };
    let of = |length_m: f64, within_m: f64| {
        // The depth where the forces balance, by halving.
        let force = |distance_m: f64, length_m: f64| 1e4 * (distance_m / length_m - 1.0).max(0.0);
        let both = |depth: f64| (force(depth.hypot(3.0), 5.0), force(5.0 - depth, length_m));
        let (mut high, mut low) = (4.0, 4.2);
        for _ in 0..60 {
            let depth = 0.5 * (high + low);
            let (side, third) = both(depth);
            if 2.0 * side * depth / depth.hypot(3.0) < 120.0 + third {
                high = depth;
            } else {
                low = depth;
            }
        }
        let (side, below) = both(low);
        let near = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -5.0], [0.0, 0.0, -low]];
        let third = cable(2, length_m).with_length_tolerance(within_m);
        let members = vec![cable(0, 5.0), cable(1, 5.0), third];
        let system = System::new("third", 10.0, joints.clone(), members).unwrap();
        prove_ranges(&system, &near, &[side, side, below], &[])
    };
    let changes = Err(NoRanges::MayChange { members: vec![2] });
    assert_eq!(of(0.96, 2e-2), changes);
    assert_eq!(of(0.9535, 1e-3), changes);
    // 6 mm of slack are more than 2 mm.
    let found = of(0.96, 2e-3).unwrap();
    let [slack, borne] = [2, 0].map(|k| found.axial_n[k].guaranteed);
    assert!(slack.iter().all(|n| n.abs() <= 0.0) && borne[0] > 74.0, "{slack:?} {borne:?}");
}

/// A spring of 2 m between anchors 2 m apart, and one of 1.9 m: by its law alone, which each number enters once.
#[test]
fn springs_between_anchors_have_the_hull_of_their_law() {
    let anchor = |name: &str, x: f64| {
        Joint::anchor(name, [x, 0.0, 0.0]).with_tolerances(None, Some(0.01), None).unwrap()
    };
    let of = |length_m: f64| {
        let joints = vec![anchor("A", 0.0), anchor("B", 2.0), Joint::free("P").with_mass(1.0)];
        let spring = Member::cable(0, 1, Bar::homogeneous(length_m, 0.0).unwrap());
        let spring = spring.with_stiffness(1000.0).with_tolerances(Some(0.1), None).unwrap();
        let bar = Member::bar(0, 2, Bar::homogeneous(1.0, 0.0).unwrap());
        let system = System::new("spring", 10.0, joints, vec![spring, bar]).unwrap();
        let places = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 0.0, -1.0]];
        prove_ranges(&system, &places, &[1000.0 * (2.0 / length_m - 1.0), 10.0], &[])
    };
    let found = of(1.9).unwrap();
    let force = |distance: f64, stiffness: f64| stiffness * (distance / 1.9 - 1.0);
    // Askew by 0.02 m in both other directions it is a little longer.
    let far = 2.02_f64.hypot(0.02).hypot(0.02);
    is(found.axial_n[0], force(1.98, 900.0), force(far, 1100.0), 1000.0);
    // P hangs plumb from an anchor that may be anywhere; next to the spring no reaction is given.
    is(found.joints_m[2][2], -1.01, -0.99, 1.0);
    assert!(found.reactions_n.iter().all(Option::is_none));
    assert_eq!(of(2.0), Err(NoRanges::MayChange { members: vec![0] }));
}

#[test]
fn what_is_not_proved_says_why() {
    let bar = |from| Member::bar(from, 2, Bar::homogeneous(5.0, 0.0).unwrap());
    let joints = hanger(1e-3, None).joints().to_vec();
    let exact = System::new("exact", 10.0, joints, vec![bar(0), bar(1)]).unwrap();
    let of = |system: &System| prove_ranges(system, &HANGS, &[75.0; 2], &[]).unwrap_err();
    assert_eq!(of(&exact), NoRanges::NothingUncertain);
    // 4 m below its anchors within a millimetre or so.
    let floor = hanger(1e-3, None).with_floor(-4.0005).unwrap();
    assert_eq!(of(&floor), NoRanges::Floor { joints: vec![2] });
    // A third bar in the plane of two.
    let joints = [exact.joints(), &[Joint::anchor("C", [0.0, 0.0, -9.0])]].concat();
    let third = Member::bar(3, 2, Bar::homogeneous(5.0, 0.0).unwrap()).with_length_tolerance(1e-3);
    let braced = System::new("braced", 10.0, joints, vec![bar(0), bar(1), third]).unwrap();
    let at_m = [&HANGS[..], &[[0.0, 0.0, -9.0]]].concat();
    let found = prove_ranges(&braced, &at_m, &[75.0, 75.0, 0.0], &[]);
    assert_eq!(found, Err(NoRanges::Overdetermined { dimension: 1 }));
}

/// What fails in one box is proved in parts: 5 m and 0.9 m more or less, on a grid of closed forms.
#[test]
fn wide_tolerances_are_halved() {
    let by_m = 0.9;
    let found = prove_ranges(&hanger(by_m, None), &HANGS, &[75.0; 2], &[]).unwrap();
    assert!(found.boxes > 1);
    let grid = || (0..=40).map(|k| 5.0 + by_m * (f64::from(k) / 20.0 - 1.0));
    let all: Vec<[f64; 4]> = grid().flat_map(|a| grid().map(move |b| closed(a, b))).collect();
    let [z, force] = [found.joints_m[2][2], found.axial_n[0]];
    assert!(all.iter().all(|at| z.contains(at[1]) && force.contains(at[2])));
    // Lowest where both are longest: a hull. The force does not change in one direction everywhere.
    let lowest = closed(5.0 + by_m, 5.0 + by_m)[1];
    let largest = all.iter().map(|at| at[2]).fold(0.0, f64::max);
    assert!(z.is_hull && (z.guaranteed[0] - lowest).abs() < ROUNDING * 5.0);
    assert!(
        !force.is_hull && force.reached[1] < largest + 0.1 && force.guaranteed[1] < 1.15 * largest
    );
}

/// A joint of 5 N on the floor, drawn aside by F against a bar of length l that rises by 3 m: it is at x = (l² -
/// 9)^1/2, the bar bears F l/x, the floor 5 - 3 F/x. Far above a floor nothing changes.
#[test]
fn joints_on_the_floor_have_ranges() {
    let (by_m, by_n) = (2e-3, 0.01);
    let joints = |mass_kg: f64, by_n: f64| {
        let load = Joint::free("P").with_mass(mass_kg).with_force([3.0, 0.0, 0.0]);
        let load = load.with_tolerances(None, None, Some(by_n)).unwrap();
        vec![Joint::anchor("A", [0.0, 0.0, 3.0]), load]
    };
    let bar = Member::bar(0, 1, Bar::homogeneous(18.0_f64.sqrt(), 0.0).unwrap());
    let members = vec![bar.with_length_tolerance(by_m)];
    let drawn = |mass_kg: f64, by_n: f64| {
        let system = System::new("drawn", 10.0, joints(mass_kg, by_n), members.clone()).unwrap();
        let axial_n = [3.0 * 2.0_f64.sqrt()];
        let at_m = [[0.0, 0.0, 3.0], [3.0, 0.0, 0.0]];
        prove_ranges(&system.with_floor(0.0).unwrap(), &at_m, &axial_n, &[])
    };
    let found = drawn(0.5, by_n).unwrap();
    let length = |by: f64| 18.0_f64.sqrt() + by;
    let aside = |by: f64| (length(by).powi(2) - 9.0).sqrt();
    // What pulls it across turns it, without a force to first order.
    let axial = |by: f64, f: f64| f * length(by) / aside(by);
    let [least, most] = found.axial_n[0].guaranteed;
    let wanted = [axial(by_m, 3.0 - by_n), axial(-by_m, 3.0 + by_n)];
    assert!(
        least <= wanted[0] && most >= wanted[1] && most - least < 1.02 * (wanted[1] - wanted[0])
    );
    let push = |by: f64, f: f64| 5.0 - 3.0 * f / aside(by);
    let up = found.reactions_n[1].unwrap()[2].guaranteed;
    // The load leans up and down, too.
    let wanted = [push(-by_m, 3.0 + by_n) - by_n, push(by_m, 3.0 - by_n) + by_n];
    assert!(up[0] <= wanted[0] && up[1] >= wanted[1]);
    assert!(up[1] - up[0] < 1.02 * (wanted[1] - wanted[0]), "{up:?} {wanted:?}");
    // Of 3.1 N the floor bears a tenth of a newton, or none.
    assert_eq!(drawn(0.31, 0.1), Err(NoRanges::Floor { joints: vec![1] }));
    let high = prove_ranges(&hanger(1e-3, None).with_floor(-9.0).unwrap(), &HANGS, &[75.0; 2], &[]);
    assert_eq!(high, prove_ranges(&hanger(1e-3, None), &HANGS, &[75.0; 2], &[]));
}

/// A ring of 10 kg on a rope from A to B, 4 m aside and 1 m above: both spans lean by a with sin a = 4/s for spans
/// of s together, T = W/(2 cos a), the ring is at z = (1 - s cos a)/2 and x = -z tan a.
#[test]
fn a_ring_on_a_rope_has_the_ranges_of_its_closed_form() {
    let (by_m, by_kg, part) = (0.01, 0.1, 0.02);
    let ring = Joint::free("P").with_mass(10.0).with_tolerances(Some(by_kg), None, None).unwrap();
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [4.0, 0.0, 1.0]), ring];
    let of = |s: f64, kg: f64| {
        let cos = (1.0 - 16.0 / (s * s)).sqrt();
        let z = 0.5 * (1.0 - s * cos);
        [-z * 4.0 / (s * cos), z, kg * 10.0 / (2.0 * cos)]
    };
    // With a stiffness: s = l (1 + T/EA), by halving.
    let of_elastic = |l: f64, kg: f64, ea: f64| {
        let (mut low, mut high) = (l, 2.0 * l);
        for _ in 0..80 {
            let s = 0.5 * (low + high);
            let longer = l * (1.0 + of(s, kg)[2] / ea) > s;
            *(if longer { &mut low } else { &mut high }) = s;
        }
        of(low, kg)
    };
    let body = Bar::homogeneous(5.0, 0.0).unwrap();
    let rope = Member::cable(0, 1, body).over(vec![2]).with_length_tolerance(by_m);
    let elastic = rope.clone().with_stiffness(5e3).with_tolerances(Some(part), None).unwrap();
    let depth = [Depth { joint: 2, ends: [0, 1] }];
    for (rope, softest, stiffest) in [(rope, f64::INFINITY, f64::INFINITY), (elastic, 4.9e3, 5.1e3)]
    {
        let [x, z, force] = of_elastic(5.0, 10.0, 0.5 * (softest + stiffest));
        let system = System::new("ring", 10.0, joints.clone(), vec![rope]).unwrap();
        let at_m = [[0.0; 3], [4.0, 0.0, 1.0], [x, 0.0, z]];
        let found = prove_ranges(&system, &at_m, &[force], &depth).unwrap();
        let low = of_elastic(5.0 + by_m, 10.0 + by_kg, softest);
        let high = of_elastic(5.0 - by_m, 10.0 - by_kg, stiffest);
        near(found.joints_m[2][2], low[1], high[1]);
        near(found.joints_m[2][0], high[0], low[0]);
        // The mass pulls a rope longer that stretches, which bears less then, and it bears it.
        let weak = of_elastic(5.0 + by_m, 10.0 - by_kg, softest);
        let strong = of_elastic(5.0 - by_m, 10.0 + by_kg, stiffest);
        is(found.axial_n[0], weak[2], strong[2], 100.0);
        // Below the line from A to B, which rises by a quarter.
        let depth = |[x, z, _]: [f64; 3]| 0.25 * x - z;
        near(found.depths_m[0], depth(high), depth(low));
        // The pulley at B holds what its span pulls.
        let up = found.reactions_n[1].unwrap()[2].guaranteed;
        assert!(up[0] < 50.0 && up[1] > 50.0 && up[0] > 49.0 && up[1] < 51.0, "{up:?}");
    }
}

/// Lengths, masses and gravity times powers of two: not a digit of a range changes but by them.
#[test]
fn ranges_scale_without_rounding() {
    let ring = Joint::free("P").with_mass(10.0).with_tolerances(Some(0.1), None, None).unwrap();
    let anchor =
        Joint::anchor("B", [4.0, 0.0, 1.0]).with_tolerances(None, Some(1e-3), None).unwrap();
    let rope = Member::cable(0, 1, Bar::homogeneous(5.0, 0.0).unwrap()).over(vec![2]);
    let joints = vec![Joint::anchor("A", [0.0; 3]), anchor, ring];
    let at = vec![[0.0; 3], [4.0, 0.0, 1.0], [4.0 / 3.0, 0.0, -1.0]];
    let ring = System::new("ring", 10.0, joints, vec![rope.with_length_tolerance(0.01)]).unwrap();
    let depth = [Depth { joint: 2, ends: [0, 1] }];
    let above = hanger(2e-3, Some(1e-3)).with_floor(-9.0).unwrap();
    for (system, at, axial) in [
        (ring, at, vec![250.0 / 3.0]),
        (above, HANGS.to_vec(), vec![75.0; 2]),
        net(2, 5, 1e-4, 0.01),
    ] {
        let found = |[length, mass, gravity]: [f64; 3]| {
            let scaled = samples::scaled(&system, [length, mass, gravity]);
            let at: Vec<Vector> = at.iter().map(|x| x.map(|x| x * length)).collect();
            let axial: Vec<f64> = axial.iter().map(|x| x * mass * gravity).collect();
            prove_ranges(&scaled, &at, &axial, &depth).unwrap()
        };
        let one = found([1.0; 3]);
        assert!(one.axial_n.iter().all(|range| range.most_by.is_some()));
        for factors in [[8.0, 1.0, 1.0], [1.0, 0.0625, 4.0], [0.25, 32.0, 0.5]] {
            let there = found(factors);
            let (length, force) = (factors[0], factors[1] * factors[2]);
            // What is nearly nothing has fewer digits.
            let times = |range: &Range, by: f64| Range {
                guaranteed: range.guaranteed.map(|x| if x.abs() < 1e-300 { 0.0 } else { x * by }),
                reached: range.reached.map(|x| x * by),
                most_by: range.most_by.map(|(number, change)| (number, change * by)),
                ..*range
            };
            let same = |one: &Range, by: f64, other: &Range| {
                assert_eq!(times(one, by), times(other, 1.0), "{factors:?}");
            };
            assert_eq!(one.boxes, there.boxes);
            one.axial_n.iter().zip(&there.axial_n).for_each(|(a, b)| same(a, force, b));
            one.depths_m.iter().zip(&there.depths_m).for_each(|(a, b)| same(a, length, b));
            let places = one.joints_m.as_flattened().iter().zip(there.joints_m.as_flattened());
            places.for_each(|(a, b)| same(a, length, b));
            for (a, b) in one.reactions_n.iter().zip(&there.reactions_n) {
                assert_eq!(a.is_some(), b.is_some());
                let both = a.iter().flatten().zip(b.iter().flatten());
                both.for_each(|(a, b)| same(a, force, b));
            }
        }
    }
}
