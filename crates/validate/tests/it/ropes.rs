//! Ropes over rings and pulleys: both solvers agree, the judge and the certificate hold them to the laws of a
//! rope.

mod foreign;

use model::system::{Joint, Member, Support, System, SystemEquilibrium};
use model::{Bar, NoCertificate, STANDARD_GRAVITY_M_S2, Status, Vector};
use numerics::vector::{minus, norm};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use validate::foreign::{Finding, ForeignAnswer, Judgement, judge_foreign};
use validate::systems::{certify, judge};

use crate::common::asked;

#[test]
fn known_ropes_are_agreed_upon_and_proved_optimal() {
    for sample in samples::ropes() {
        let name = sample.system.name();
        let answer = asked(&sample.system);
        assert!(answer.agrees() && answer.is_decided(), "{name}: {answer:?}");
        for found in &answer.equilibria {
            let ladder = &found.evidence.ladder;
            let Status::Reached(optimal) = &ladder.optimal else {
                panic!("{name}: {:?}", ladder.optimal)
            };
            assert!(optimal.gap.unwrap() < 1e-11 && judge(&sample.system, found).largest() < 1e-11);
            assert!(ladder.verified.is_reached(), "{name}: {:?}", ladder.verified);
            let Status::Reached(complete) = &ladder.complete else {
                panic!("{name}: {:?}", ladder.complete)
            };
            assert_eq!(complete.in_plane, 1);
        }
    }
}

/// Spans without length: found by both, held by less than the tension, and proved to be the minimum.
#[test]
fn known_jams_are_agreed_upon_and_proved_optimal() {
    for sample in samples::jammed_ropes() {
        let (system, name) = (&sample.system, sample.system.name());
        let answer = asked(system);
        assert!(answer.agrees() && answer.is_decided(), "{name}: {answer:?}");
        assert_eq!(answer.equilibria.len(), 2, "{name}: {answer:?}");
        for found in &answer.equilibria {
            let Status::Reached(optimal) = &found.evidence.ladder.optimal else {
                panic!("{name}: {:?}", found.evidence.ladder.optimal)
            };
            assert!(optimal.gap.unwrap() < 1e-11 && judge(system, found).largest() < 1e-11);
        }
        // Judged as the answer of another program, which says nothing of the corner.
        for axial_n in [None, Some(sample.axial_n.clone())] {
            let found = judged(system, places(&sample), axial_n);
            assert_eq!(found.finding, Finding::Confirmed, "{name}: {:?}", found.violations);
        }
    }
}

/// Two buckets on an elastic rope over a pulley at 3 m: the heavy one draws the other up to the pulley and hangs below by the
/// length of the rope, longer by its weight over EA.
#[test]
fn the_heavier_of_two_buckets_draws_the_other_up() {
    for (heavy_kg, light_kg, length_m, ea_n) in
        [(16.58, 2.35, 6.6447, 11_011.0), (16.58, 2.35, 6.6447, 11_012.0), (5.0, 4.0, 3.0, 1e3)]
    {
        let joints = vec![
            Joint::anchor("pulley", [0.0, 0.0, 3.0]),
            Joint::free("heavy").with_mass(heavy_kg),
            Joint::free("light").with_mass(light_kg),
        ];
        let rope = Member::cable(2, 1, Bar::homogeneous(length_m, 0.0).unwrap()).over(vec![0]);
        let rope = rope.with_stiffness(ea_n);
        let system = System::new("buckets", STANDARD_GRAVITY_M_S2, joints, vec![rope]).unwrap();
        let answer = asked(&system);
        let weight_n = heavy_kg * STANDARD_GRAVITY_M_S2;
        assert!(answer.agrees(), "{:?} {:?}", answer.agreement, answer.failures);
        for e in &answer.equilibria {
            let below_m = length_m * (1.0 + weight_n / ea_n);
            assert!((3.0 - below_m - e.joints_m[1][2]).abs() < 1e-9, "{:?}", e.joints_m);
            assert!(
                (e.axial_n[0] - weight_n).abs() < 1e-9
                    && norm(minus(e.joints_m[2], [0.0, 0.0, 3.0])) < 1e-9
            );
        }
    }
}

/// A sample and the first answer to it.
fn answered(sample: samples::RopeSample) -> (System, SystemEquilibrium) {
    let answer = asked(&sample.system);
    (sample.system, answer.equilibria[0].clone())
}

/// The judge finds an answer wrong in which this was changed.
fn assert_seen(
    name: &str,
    system: &System,
    found: &SystemEquilibrium,
    change: &dyn Fn(&mut SystemEquilibrium),
) {
    let mut wrong = found.clone();
    change(&mut wrong);
    let largest = judge(system, &wrong).largest();
    assert!(largest > 1e-7 || largest.is_nan(), "{name}: {largest:e}");
}

/// The lighter of two weights at its pulley, with one number changed by a part in a million.
#[test]
fn the_judge_sees_what_is_wrong_with_a_jam() {
    let (system, found) = answered(samples::jammed_ropes().swap_remove(0));
    let off = 1.0 + 1e-6;
    let seen = |name: &str, change: &dyn Fn(&mut SystemEquilibrium)| {
        assert_seen(name, &system, &found, change);
    };
    seen("pull", &|a| a.evidence.jams[0].pull_n[2] *= off);
    seen("pull and end", &|a| {
        a.evidence.jams[0].pull_n[2] *= off;
        a.end_forces_n[0][2] *= off;
    });
    seen("apart", &|a| a.joints_m[3][2] -= 1e-6);
    seen("nothing said", &|a| a.evidence.jams.clear());
    // 2 kg at a tension of less than their weight: the rest is in balance.
    let mut weak = found.clone();
    weak.axial_n[0] *= 0.6;
    assert!(judge(&system, &weak).law > 1e-7);
    // More than the tension bounds no energy.
    let mut steep = found;
    steep.evidence.jams[0].pull_n[2] *= 1.6;
    assert!(certify(&system, &steep).is_err());
}

/// A strut or a bar that pushes beside a rope leaves no bound.
#[test]
fn ropes_beside_what_pushes_are_not_certified() {
    let top = Joint::free("top").near([0.0, 0.0, -1.0]).with_mass(1.0).with_force([0.0, 1.0, 0.0]);
    let joints = vec![
        Joint::anchor("A", [-3.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::anchor("foot", [0.0, 0.0, -5.0]),
        // Along the stay nothing holds it.
        top.held_by(Support::Plane { at_m: [0.0; 3], normal: [1.0, 0.0, 0.0] }),
    ];
    let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let mast = Member::bar(2, 3, body(4.0)).with_stiffness(1e4);
    let stay = Member::cable(0, 1, body(6.3)).over(vec![3]).with_stiffness(1e3);
    let system = System::new("a mast under a stay", 9.81, joints, vec![mast, stay]).unwrap();
    let answer = asked(&system);
    assert!(answer.agrees(), "{answer:?}");
    let found = &answer.equilibria[0];
    assert!(found.axial_n[0] < 0.0 && found.axial_n[1] > 0.0);
    assert_eq!(certify(&system, found), Err(NoCertificate::NotConvex { members: 1 }));
}

/// A boom of 3 m pushes against the mast, its end E held by three strands of a mainsheet of 7.5 m from T, 1.1 m
/// along x: 4 kg at 10 m/s² and 30 N of wind turn E about the line of mast and T towards their resultant of 50 N,
/// 2.4 m from it at x = 1.8 m. Along and across that line the balance of E gives both forces.
#[test]
fn a_mainsheet_holds_its_boom() {
    let end = Joint::free("E").with_mass(4.0).with_force([0.0, 30.0, 0.0]);
    let (mast, traveller) = (Joint::anchor("mast", [0.0; 3]), Joint::anchor("T", [1.1, 0.0, 0.0]));
    let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let members =
        vec![Member::bar(0, 2, body(3.0)), Member::cable(1, 2, body(7.5)).over(vec![2, 1])];
    let system = System::new("a boom", 10.0, vec![mast, traveller, end], members).unwrap();
    let answer = asked(&system);
    assert!(answer.agrees() && answer.is_decided(), "{answer:?}");
    let strands_n = 50.0 / (2.4 / 2.5 - (0.28 / 0.6) * 0.8);
    for found in &answer.equilibria {
        let wanted =
            [(found.axial_n[0], -strands_n * 0.28 / 0.6), (found.axial_n[1], strands_n / 3.0)];
        let places = found.joints_m[2].into_iter().zip([1.8, 1.44, -1.92]);
        for (value, wanted) in wanted.into_iter().chain(places) {
            assert!((value - wanted).abs() < 1e-9 * wanted.abs(), "{value} {wanted}");
        }
        let ladder = &found.evidence.ladder;
        assert!(ladder.verified.is_reached() && ladder.complete.is_reached(), "{ladder:?}");
    }
}

/// Everything that is stored of a rope, changed by a part in a million.
#[test]
fn the_judge_sees_what_is_wrong_with_a_rope() {
    let (system, found) = answered(samples::ropes().swap_remove(3));
    let off = 1.0 + 1e-6;
    let seen = |name: &str, change: &dyn Fn(&mut SystemEquilibrium)| {
        assert_seen(name, &system, &found, change);
    };
    seen("tension", &|a| a.axial_n[0] *= off);
    seen("start", &|a| a.start_forces_n[0][2] *= off);
    seen("end", &|a| a.end_forces_n[0][0] *= off);
    seen("block lower", &|a| a.joints_m[1][2] *= off);
    seen("block aside", &|a| a.joints_m[1][0] += 1e-6);
    seen("pulley", &|a| a.reactions_n[0][2] *= off);
    seen("energy", &|a| a.energy_j *= off);
    seen("block on its pulley", &|a| a.joints_m[1] = [0.0; 3]);
    // Of all ends together the whole is in balance, but not the joint inside.
    seen("all forces", &|a| {
        a.axial_n[0] *= off;
        for force in [&mut a.start_forces_n[0], &mut a.end_forces_n[0]] {
            *force = force.map(|x| x * off);
        }
    });
}

/// Rings that a rope and cables hold, some of the cables slack and some elastic.
fn net(random: &mut ChaCha8Rng) -> System {
    let rings = random.random_range(1..6_usize);
    let pulley = random.random_range(1..=rings + 1);
    let mut between = |low: f64, high: f64| random.random_range(low..high);
    let mut place = |z: f64| -> Vector { [between(0.0, 4.0), between(0.0, 4.0), z] };
    let mut joints: Vec<Joint> =
        (0..4).map(|k| Joint::anchor(format!("A{k}"), place(f64::from(k) / 3.0))).collect();
    let middle: Vec<Vector> = (0..rings).map(|_| place(-2.0)).collect();
    joints.extend((0..rings).map(|k| Joint::free(format!("P{k}")).with_mass(between(0.5, 5.0))));
    let at = |joint: usize| match joints[joint].support.at_m() {
        Some(at_m) => at_m,
        None => middle[joint - 4],
    };
    let apart = |path: &[usize]| -> f64 {
        let span = |pair: &[usize]| {
            let [a, b] = [at(pair[0]), at(pair[1])];
            (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt()
        };
        path.windows(2).map(span).sum()
    };
    let mut members = Vec::new();
    let mut add = |path: Vec<usize>, part: f64, stiffness_n: Option<f64>| {
        let (first, last) = (path[0], path[path.len() - 1]);
        let body = Bar::homogeneous(part * apart(&path), 0.0).unwrap();
        let member = Member::cable(first, last, body).over(path[1..path.len() - 1].to_vec());
        members.push(member.with_stiffness(stiffness_n));
    };
    // One rope over all rings, past an anchor that is a pulley, and a second one over the first ring.
    let mut path = vec![0];
    path.extend(4..4 + rings);
    path.insert(pulley, 1);
    path.push(2);
    let elastic = |x: f64| (x > 0.5).then_some(1000.0 * x);
    let (part, soft) = (between(1.0, 1.3), elastic(between(0.0, 1.0)));
    add(path, part, soft);
    let (part, soft) = (between(0.9, 1.2), elastic(between(0.0, 1.0)));
    add(vec![3, 4, 0], part, soft);
    for ring in 4..4 + rings {
        let (part, soft) = (between(0.9, 1.5), elastic(between(0.0, 1.0)));
        add(vec![1 + ring % 3, ring], part, soft);
        if ring > 4 {
            let (part, soft) = (between(0.8, 1.5), elastic(between(0.0, 1.0)));
            add(vec![ring - 1, ring], part, soft);
        }
    }
    System::new("a net with ropes", 9.81, joints, members).unwrap()
}

#[test]
fn random_nets_with_ropes_are_agreed_upon() {
    let (mut agreed, mut jammed) = (0, 0);
    for number in 0..60 {
        let system = net(&mut samples::stream(20_261_126, number));
        if system.refusal().is_err() {
            continue;
        }
        let answer = asked(&system);
        let both = answer.agrees() && answer.equilibria.len() == 2;
        assert!(both, "{number}: {:?}", answer.failures);
        agreed += 1;
        // A ring that runs to another one, or to a pulley: both solvers say so.
        let [first, second] = [0, 1].map(|k| answer.equilibria[k].evidence.jams.len());
        assert_eq!(first, second, "{number}");
        jammed += usize::from(first > 0);
        for found in &answer.equilibria {
            let optimal = &found.evidence.ladder.optimal;
            assert!(optimal.is_reached(), "{number}: {optimal:?}");
        }
    }
    assert_eq!((agreed, jammed), (60, 1));
}

/// The places of a sample as known by hand.
fn places(sample: &samples::RopeSample) -> Vec<Vector> {
    let joints = sample.system.joints().iter().enumerate();
    let known = |k: usize| sample.at_m.iter().find(|(joint, _)| *joint == k).map(|(_, at)| *at);
    joints.map(|(k, joint)| joint.support.at_m().or_else(|| known(k)).unwrap()).collect()
}

fn judged(system: &System, places: Vec<Vector>, axial_n: Option<Vec<f64>>) -> Judgement {
    let answer = ForeignAnswer::in_order(system, "a table", places, axial_n).unwrap();
    judge_foreign(system, &answer, 1e-6, &|_| {}).unwrap()
}

/// code_aster's SSNL100 (V6.02.100): one cable of 210 m over a pulley in the middle of two spans of 100 m.
#[derive(serde::Deserialize)]
struct OverAPulley {
    span_m: f64,
    free_length_m: f64,
    weight_n_m: f64,
    stiffness_n: f64,
    sag_m: String,
}

impl OverAPulley {
    fn read() -> Self {
        let text = include_str!("../../data/external/code-aster.toml");
        let table: toml::Table = text.parse().unwrap();
        table["cable_over_a_pulley"].clone().try_into().unwrap()
    }

    /// The horizontal pull with which what hangs is as wide as the span, N, by bisection.
    fn pull_n(&self, wide_m: impl Fn(f64) -> f64) -> f64 {
        let (mut low, mut high) = (1.0, 1e6);
        for _ in 0..200 {
            let pull_n = f64::midpoint(low, high);
            *(if wide_m(pull_n) > self.span_m { &mut high } else { &mut low }) = pull_n;
        }
        low
    }

    /// Sag of the middle of a span and tension at the pulley, m and N, of the elastic catenary:
    /// `2H/w asinh(wl/2H) + Hl/EA` wide.
    fn catenary(&self) -> [f64; 2] {
        let (length, ea, w) = (0.5 * self.free_length_m, self.stiffness_n, self.weight_n_m);
        let half_n = 0.5 * w * length;
        let h = self.pull_n(|h| 2.0 * h / w * (half_n / h).asinh() + h * length / ea);
        [(h.hypot(half_n) - h) / w + 0.25 * half_n * length / ea, h.hypot(half_n)]
    }

    /// The same of `n` straight elements, an even number: element `k` from the middle bears `w l (k + 1/2)` upright.
    fn polygon(&self, n: u32) -> [f64; 2] {
        let (length, count) = (0.5 * self.free_length_m / f64::from(n), n / 2);
        let parts = |h: f64| {
            let upright = (0..count).map(|k| self.weight_n_m * length * (f64::from(k) + 0.5));
            upright.map(move |v| (v, length * (1.0 / h.hypot(v) + 1.0 / self.stiffness_n)))
        };
        let h = self.pull_n(|h| 2.0 * h * parts(h).map(|(_, part)| part).sum::<f64>());
        let sag_m = parts(h).map(|(v, part)| v * part).sum();
        [sag_m, h.hypot(0.25 * self.weight_n_m * self.free_length_m)]
    }

    /// Each span in `n` straight elements. The two beside the pulley are one rope without weight, which the joints at
    /// its ends bear by the lever rule, as the pulley its other half.
    fn system(&self, n: u32) -> System {
        let element_m = 0.5 * self.free_length_m / f64::from(n);
        let mass_kg = self.weight_n_m * element_m / STANDARD_GRAVITY_M_S2;
        let body = Bar::homogeneous(element_m, mass_kg).unwrap();
        let mut joints = samples::joints(
            &[[0.0; 3], [self.span_m, 0.0, 0.0], [2.0 * self.span_m, 0.0, 0.0]],
            &[],
        );
        let mut members = Vec::new();
        let mut ends = [0, 2];
        for end in &mut ends {
            for k in 1..n {
                let half_kg = if k == n - 1 { 0.5 * mass_kg } else { 0.0 };
                joints.push(Joint::free(joints.len().to_string()).with_mass(half_kg));
                let next = joints.len() - 1;
                members.push(Member::cable(*end, next, body).with_stiffness(self.stiffness_n));
                *end = next;
            }
        }
        let rope = Bar::homogeneous(2.0 * element_m, 0.0).unwrap();
        let rope = Member::cable(ends[0], ends[1], rope).over(vec![1]);
        members.push(rope.with_stiffness(self.stiffness_n));
        System::new("a cable over a pulley", STANDARD_GRAVITY_M_S2, joints, members).unwrap()
    }

    /// The lowest joint of each span, m below the supports, and the tension at the pulley, N.
    fn found(&self, n: u32) -> [f64; 3] {
        let system = self.system(n);
        let answer = asked(&system);
        assert!(answer.agrees(), "{n}: {answer:?}");
        let found = &answer.equilibria[0];
        let depths: Vec<f64> = found.joints_m[3..].iter().map(|at_m| -at_m[2]).collect();
        let (first, second) = depths.split_at(depths.len() / 2);
        let [first, second] = [first, second].map(|span| span.iter().copied().fold(0.0, f64::max));
        // The element at the pulley, with the half of its weight that the pulley bears.
        let [x, _, z] = found.start_forces_n[system.members().len() - 1];
        let half_n = 0.25 * self.weight_n_m * self.free_length_m / f64::from(n);
        [first, second, x.hypot(z.abs() + half_n)]
    }
}

#[test]
fn a_cable_over_a_pulley_tends_to_the_catenary_of_code_aster() {
    let case = OverAPulley::read();
    let [sag_m, tension_n] = case.catenary();
    assert!((sag_m - 13.939_193_351_6).abs() < 1e-9, "{sag_m}");
    assert!((tension_n - 3_175.258_81).abs() < 1e-5, "{tension_n}");
    let printed: f64 = case.sag_m.parse().unwrap();
    assert!((printed / sag_m - 1.0).abs() < 1e-3, "code_aster: {printed}, not {sag_m}");
    let off = |n: u32| {
        let [first, second, tension] = case.found(n);
        println!("{n} elements: {first} m, {second} m, {tension} N");
        let [polygon_m, polygon_n] = case.polygon(n);
        for sag in [first, second] {
            assert!((sag - polygon_m).abs() < 1e-9 * sag_m, "{n}: {sag}, not {polygon_m}");
        }
        assert!((tension - polygon_n).abs() < 1e-9 * tension_n, "{n}: {tension}");
        [first - sag_m, tension - tension_n].map(f64::abs)
    };
    // By the square of the length of an element.
    for (coarse, fine) in off(20).into_iter().zip(off(80)) {
        let ratio = coarse / fine;
        assert!((ratio - 16.0).abs() < 0.5, "{coarse:e} {fine:e}");
    }
}
