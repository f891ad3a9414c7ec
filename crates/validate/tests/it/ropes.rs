//! Ropes over rings and pulleys: both solvers agree, the judge and the certificate hold them to the laws of a
//! rope.

use model::system::{Joint, Member, Support, System, SystemEquilibrium};
use model::{Bar, NoBox, NoCensus, NoCertificate, Reason, STANDARD_GRAVITY_M_S2, Status, Vector};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use validate::Solvers;
use validate::foreign::{ForeignAnswer, NotJudged, judge_foreign};
use validate::systems::{SystemAnswer, ask, certify, judge};

fn asked(system: &System) -> SystemAnswer {
    ask(system, Solvers::Both, &|_| {})
}

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
            assert_eq!(ladder.verified, Status::Open(Reason::NoBox(NoBox::Rope { member: 1 })));
            assert_eq!(
                ladder.complete,
                Status::Open(Reason::NoCensus(NoCensus::Rope { member: 1 }))
            );
        }
    }
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
        Joint { support: Support::Plane { at_m: [0.0; 3], normal: [1.0, 0.0, 0.0] }, ..top },
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

/// Everything that is stored of a rope, changed by a part in a million.
#[test]
fn the_judge_sees_what_is_wrong_with_a_rope() {
    let (system, found) = {
        let sample = samples::ropes().swap_remove(3);
        let answer = asked(&sample.system);
        (sample.system, answer.equilibria[0].clone())
    };
    let off = 1.0 + 1e-6;
    let seen = |name: &str, change: &dyn Fn(&mut SystemEquilibrium)| {
        let mut wrong = found.clone();
        change(&mut wrong);
        let largest = judge(&system, &wrong).largest();
        assert!(largest > 1e-7 || largest.is_nan(), "{name}: {largest:e}");
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
        members.push(Member { stiffness_n, ..member });
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
        if answer.agrees() && answer.equilibria.len() == 2 {
            agreed += 1;
            for found in &answer.equilibria {
                assert!(
                    found.evidence.ladder.optimal.is_reached(),
                    "{number}: {:?}",
                    found.evidence.ladder.optimal
                );
            }
        } else {
            // A ring that runs to another one, or to a pulley: both solvers say so.
            let said: Vec<String> = answer.failures.iter().map(ToString::to_string).collect();
            let jams = said.len() == 2 && said.iter().all(|text| text.contains("jams"));
            assert!(jams, "{number}: {said:?}");
            jammed += 1;
        }
    }
    assert_eq!((agreed, jammed), (59, 1));
}

/// Who judges the answers of others knows straight members alone.
#[test]
fn answers_of_others_are_not_judged_with_ropes() {
    let sample = samples::ropes().swap_remove(0);
    let places = asked(&sample.system).equilibria[0].joints_m.clone();
    let answer = ForeignAnswer::in_order(&sample.system, "a table", places, None).unwrap();
    let found = judge_foreign(&sample.system, &answer, 1e-6, &|_| {});
    assert!(matches!(found, Err(NotJudged::Rope(rope)) if rope.member == 1), "{found:?}");
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
        let mut joints = vec![
            Joint::anchor("O", [0.0; 3]),
            Joint::anchor("P1", [self.span_m, 0.0, 0.0]),
            Joint::anchor("P2", [2.0 * self.span_m, 0.0, 0.0]),
        ];
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
