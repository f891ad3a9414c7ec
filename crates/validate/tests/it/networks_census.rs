//! Newton's method from many starts finds no equilibrium of a small system that its complete census
//! lacks, and the answers of both solvers are in the list.

use std::time::Instant;

use census::Settings;
use census::boxes::prove;
use census::net::SystemCensus;
use lagrange::net::{Seed, solve_from};
use model::system::{Joint, Kind, Member, System, SystemEquilibrium};
use model::{Bar, Ladder, SolverName};
use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use validate::systems::{ask, ask_with, certify_by_census};
use validate::{Question, Solvers, UseCensus};

use crate::networks::{Draft, Members};

impl Draft {
    fn any_anchor(&mut self) -> usize {
        let at_m = [(); 3].map(|()| self.between(-1.0, 1.0));
        self.anchor(at_m)
    }

    /// A joint with a mass or a force downwards, or neither.
    fn loaded(&mut self) -> usize {
        let mut joint = Joint::free(format!("joint {}", self.joints.len()));
        match self.random.random_range(0..3) {
            0 => joint = joint.with_mass(self.between(0.1, 5.0)),
            1 => joint = joint.with_force([0.0, 0.0, -self.between(1.0, 20.0)]),
            _ => {}
        }
        self.joints.push(joint);
        self.joints.len() - 1
    }

    fn bar(&mut self, from: usize, to: usize) {
        let length_m = self.between(1.0, 2.0);
        let mass_kg = self.between(0.1, 2.0);
        let centre_m = self.between(0.2, 0.8) * length_m;
        let body = Bar::new(length_m, mass_kg, centre_m, [0.0; 3]).unwrap();
        // Told in either direction.
        let [from, to] = if self.random.random_range(0..2) == 0 { [from, to] } else { [to, from] };
        self.members.push(Member::bar(from, to, body));
    }

    fn chain(&mut self, from: usize, to: usize, bars: usize) {
        let mut here = from;
        for k in 1..=bars {
            let there = if k == bars { to } else { self.loaded() };
            self.bar(here, there);
            here = there;
        }
    }
}

/// A chain of two to four bars between anchors, with a branch on one of its joints.
fn branched_chain(seed: u64) -> System {
    let mut draft = Draft::new(Members::Bars, seed);
    let (start, end) = (draft.any_anchor(), draft.any_anchor());
    let bars = draft.random.random_range(2..=4);
    draft.chain(start, end, bars);
    let tip = draft.loaded();
    draft.bar(2, tip);
    draft.finish()
}

/// A tripod, with a hanger from its top to a fourth anchor and a pendulum on that.
fn tripod(seed: u64) -> System {
    let mut draft = Draft::new(Members::Bars, seed);
    let top = draft.loaded();
    for _ in 0..3 {
        let foot = draft.any_anchor();
        draft.bar(foot, top);
    }
    let fourth = draft.any_anchor();
    draft.chain(top, fourth, 2);
    let tip = draft.loaded();
    draft.bar(5, tip);
    draft.finish()
}

/// Whether a list has this position; of circles the heights count alone.
fn has(census: &SystemCensus, answer: &SystemEquilibrium) -> bool {
    /// What Newton's method leaves of places of order one: measured below 1e-12.
    const NEAR: f64 = 1e-9;
    census.equilibria.iter().any(|position| {
        let places = position.joints_m.iter().zip(&answer.joints_m);
        let first = if position.circle { 2 } else { 0 };
        places.into_iter().all(|(enclosure, at)| {
            (first..3).all(|k| at[k] > enclosure[k].lo() - NEAR && at[k] < enclosure[k].hi() + NEAR)
        })
    })
}

#[test]
fn newton_from_many_starts_finds_nothing_that_a_complete_census_lacks() {
    /// Starts of each system; most of them end in an equilibrium.
    const STARTS: usize = 60;
    let (mut lists, mut listed, mut reached, mut ends) = (0, 0, 0, 0);
    for seed in 0..24 {
        let system = if seed % 2 == 0 { branched_chain(seed) } else { tripod(seed) };
        if system.refusal().is_err() {
            continue;
        }
        let census = SystemCensus::take(&system, &Settings::default()).unwrap();
        if !census.complete || census.families() > 0 {
            continue;
        }
        lists += 1;
        listed += census.equilibria.len();
        let mut seen = vec![false; census.equilibria.len()];
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        for _ in 0..STARTS {
            let places = system.joints().iter();
            let start = Seed::at(
                places.map(|_| [(); 3].map(|()| random.random_range(-3.0..3.0))).collect(),
            );
            let Ok(found) = solve_from(&system, &start, &lagrange::net::Settings::default()) else {
                continue;
            };
            ends += 1;
            assert!(has(&census, &found.equilibrium), "{seed}: {:?}", found.equilibrium.joints_m);
            for (seen, position) in seen.iter_mut().zip(&census.equilibria) {
                let same = position.energy_j.lo() - 1e-9 < found.equilibrium.energy_j
                    && found.equilibrium.energy_j < position.energy_j.hi() + 1e-9;
                *seen |= same;
            }
        }
        reached += seen.into_iter().filter(|seen| *seen).count();
    }
    println!(
        "{lists} lists of {listed} equilibria, of which {ends} ends of Newton's method reach {reached}"
    );
    assert!(
        lists >= 8 && ends > 4 * lists && 2 * reached > listed,
        "{lists} {listed} {ends} {reached}"
    );
}

#[test]
fn both_answers_are_in_the_list_and_a_wrong_one_is_refuted() {
    let mut complete = 0;
    for seed in 0..12 {
        let system = if seed % 2 == 0 { branched_chain(seed) } else { tripod(seed) };
        if system.refusal().is_err() {
            continue;
        }
        let answer = ask(&system, Solvers::Both, &|_| {});
        for equilibrium in &answer.equilibria {
            let ladder = &equilibrium.evidence.ladder;
            assert!(ladder.verified.is_reached(), "{seed}: {}", ladder.verified);
            assert!(!ladder.failed(), "{seed}: {}", ladder.complete);
            complete += usize::from(ladder.complete.is_reached());
        }
        let census = SystemCensus::take(&system, &Settings::default()).unwrap();
        let Some(mut wrong) = answer.equilibria.first().cloned().filter(|_| census.complete) else {
            continue;
        };
        wrong.joints_m[2][2] += 1e-6;
        certify_by_census(&system, &census, &mut wrong);
        assert!(wrong.evidence.ladder.failed(), "{seed}: {}", wrong.evidence.ladder.complete);
    }
    assert!(complete >= 10, "{complete}");
}

/// The gallery: which answers are proved to be alone in their boxes, and which in lists.
#[test]
fn the_gallery_is_proved() {
    let mut proved = vec![];
    for exhibit in model::cases::gallery() {
        let answer = ask(&exhibit.system(), Solvers::Both, &|_| {});
        for e in &answer.equilibria {
            let ladder = &e.evidence.ladder;
            println!("{} {}: {}; {}", exhibit.name, e.solver, ladder.verified, ladder.complete);
            assert!(!ladder.failed(), "{}", exhibit.name);
        }
        let all = |reached: &dyn Fn(&Ladder) -> bool| {
            answer.equilibria.iter().all(|e| reached(&e.evidence.ladder))
        };
        let verified = all(&|ladder| ladder.verified.is_reached());
        let complete = all(&|ladder| ladder.complete.is_reached());
        proved.push((exhibit.name, verified, complete));
    }
    let names = |wanted: &dyn Fn(&(&str, bool, bool)) -> bool| -> Vec<&str> {
        proved.iter().filter(|one| wanted(one)).map(|(name, ..)| *name).collect()
    };
    assert_eq!(names(&|(_, verified, _)| !verified), [] as [&str; 0]);
    for name in ["lamp", "tripod", "pendulum-chain"] {
        assert!(names(&|(_, _, complete)| *complete).contains(&name), "{name}");
    }
}

/// A hundred bars: 397 unknowns.
#[test]
fn a_hundred_bars_are_verified() {
    let chain = model::cases::get("hundred-bars").unwrap().problem().into_chain();
    let system = System::from(&chain);
    let answer = ask(&system, Solvers::Lagrange, &|_| {});
    let found = &answer.equilibria[0];
    let start = Instant::now();
    let proof = prove(&system, &found.joints_m, &found.axial_n).unwrap();
    let seconds = start.elapsed().as_secs_f64();
    println!("{seconds} s, {:e} m and {:e} N wide", proof.width_m, proof.width_n);
    assert!(proof.width_m < 1e-10 * chain.total_length_m(), "{:e}", proof.width_m);
    assert!(found.evidence.ladder.verified.is_reached());
}

/// Bars from two anchors to P and on to Q, which a rope holds: without the list `lagrange` rests in a higher minimum
/// than `energy`. Expected is the least energy over the circle of P with Q as low as bar and rope let it.
#[test]
fn who_ends_above_the_lowest_of_a_complete_list_is_asked_again_next_to_it() {
    let [b, t] = [Vector3::new(1.41, 0.14, 0.25), Vector3::new(0.04, 0.0, 1.73)];
    let bar = |from, to, length_m, mass_kg| {
        Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).unwrap())
    };
    let joints = samples::joints(&[[0.0; 3], b.into(), t.into()], &[1.64, 3.49]);
    let members = vec![
        bar(0, 3, 1.9, 0.69),
        bar(1, 3, 1.71, 0.6),
        bar(3, 4, 1.27, 2.85),
        bar(1, 4, 2.672, 0.0).of_kind(Kind::Cable).over(vec![2]),
    ];
    let system = System::new("boom", 9.80665, joints, members).unwrap();

    let (span, down) = (b.norm(), -Vector3::z());
    let foot = 0.5 * (1.9_f64.powi(2) - 1.71_f64.powi(2) + span * span) / span;
    let along = b / span;
    let across = along.cross(&Vector3::z()).normalize();
    let radius = (1.9_f64.powi(2) - foot * foot).sqrt();
    let reach = 2.672 - (t - b).norm();
    let energy_j = |turn: f64| {
        let out = turn.cos() * across + turn.sin() * along.cross(&across);
        let p = along * foot + radius * out;
        let hanging = p + 1.27 * down;
        let far = (t - p).norm();
        let axis = (t - p) / far;
        // The circle in which the sphere of the bar cuts that of the rope.
        let height = 0.5 * (1.27_f64.powi(2) - reach * reach + far * far) / far;
        let width = (1.27_f64.powi(2) - height * height).sqrt();
        let lowest = p + height * axis + width * (down - axis * axis.dot(&down)).normalize();
        let q = if (hanging - t).norm() <= reach { hanging } else { lowest };
        9.80665 * ((1.64 + 0.345 + 0.3 + 1.425) * p.z + (3.49 + 1.425) * q.z + 0.3 * b.z)
    };
    let turns = (0..200_000).map(|k| energy_j(f64::from(k) * std::f64::consts::PI * 1e-5));
    let least_j = turns.filter(|energy| energy.is_finite()).fold(f64::INFINITY, f64::min);

    // Without a list next to the answer of `energy`.
    for census in [Question::default().census, UseCensus::Never] {
        let answer = ask_with(&system, &Question { census, ..Question::default() }, &|_| {});
        assert_eq!(answer.asked_again, [SolverName::LAGRANGE]);
        assert!(answer.agrees(), "{answer:?}");
        for found in &answer.equilibria {
            assert!((found.energy_j - least_j).abs() < 1e-6, "{} {least_j}", found.energy_j);
        }
    }
    let question =
        Question { solvers: Solvers::Lagrange, census: UseCensus::Never, ..Question::default() };
    let alone = ask_with(&system, &question, &|_| {});
    assert!(alone.asked_again.is_empty());
    assert!(alone.equilibria[0].energy_j - least_j > 0.3);
}

/// 10 kg on two bars below two light ones, which a cable of 0.6 m draws out of their plane, to either side: with u^2 =
/// 4.8^2 - 4^2 and l^2 = 4.2^2 - 4^2 it is u + 0.6 m from the line of the upper anchors and l from that of the lower.
#[test]
fn mirror_images_are_one_answer() {
    let cable = Member::cable(4, 5, Bar::homogeneous(0.6, 0.0).unwrap());
    let bar = |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
    let members = vec![bar(0, 4, 4.8), bar(4, 1, 4.8), bar(2, 5, 4.2), bar(5, 3, 4.2), cable];
    let anchor = |name: &str, x, z| Joint::anchor(name, [x, 0.0, z]);
    let joints = vec![
        anchor("A", 0.0, 0.0),
        anchor("B", 8.0, 0.0),
        anchor("C", 0.0, -3.0),
        anchor("D", 8.0, -3.0),
        Joint::free("c"),
        Joint::free("d").with_mass(10.0),
    ];
    let system = System::new("two chains", 10.0, joints, members).unwrap();
    let (upper, lower) = (7.04_f64.sqrt() + 0.6, 1.64);
    let z = (lower - upper * upper - 9.0) / 6.0;
    let y = (upper * upper - z * z).sqrt();
    let answer = ask(&system, Solvers::Both, &|_| {});
    assert!(answer.agrees() && answer.asked_again.len() == 1, "{answer:?}");
    for found in &answer.equilibria {
        let [found_x, found_y, found_z] = found.joints_m[5];
        let off = [found_x - 4.0, found_y.abs() - y, found_z - z];
        assert!(off.iter().all(|off| off.abs() < 1e-9), "{off:?}");
    }
}

/// A mast of 3 m with 5 kg, drawn upright between four guys that are half a millimetre longer than to its top: upright it is in
/// balance at 10 N/kg times 3 m, and falls until two guys hold it, which `energy` sees and `lagrange` when asked again.
#[test]
fn a_mast_leans_on_its_slack_guys() {
    let feet = [[2.0, 0.0, 0.0], [0.0, 2.0, 0.0], [-2.0, 0.0, 0.0], [0.0, -2.0, 0.0]];
    let mut joints = vec![Joint::anchor("foot", [0.0; 3])];
    joints.push(Joint::free("top").with_mass(5.0).near([0.0, 0.0, 3.0]));
    joints.extend(feet.map(|at| Joint::anchor(format!("{at:?}"), at)));
    let guy = |k| Member::cable(1, k, Bar::homogeneous(3.606, 0.0).unwrap()).with_stiffness(1e6);
    let mut members = vec![Member::bar(0, 1, Bar::homogeneous(3.0, 0.0).unwrap())];
    members.extend((2..6).map(guy));
    let system = System::new("mast", 10.0, joints, members).unwrap();
    let answer = ask(&system, Solvers::Both, &|_| {});
    assert!(answer.agrees() && answer.is_decided(), "{answer:?}");
    assert_eq!(answer.asked_again, [SolverName::LAGRANGE]);
    for found in &answer.equilibria {
        let [x, y, _] = found.joints_m[1];
        // Two guys, as far aside in both directions as makes these taut: sqrt(13 + 4 x) = 3.606 and a little more.
        let taut_m = (3.606_f64.powi(2) - 13.0) / 4.0;
        assert!((x.abs() - y.abs()).abs() < 1e-9 && x.abs() > taut_m && x.abs() < taut_m + 1e-6);
        assert!(found.stability.index_in_space == 0 && found.energy_j < 150.0);
        assert_eq!(found.axial_n.iter().filter(|force_n| **force_n > 1e-9).count(), 2);
    }
}

/// A frame whose joint c1 bears nothing and swings on two bars, until the cable at it is taut. Where it swings freely in
/// both answers, its place is not judged; where the cable stops it, a common start is no evidence for its place.
#[test]
fn a_common_start_is_no_evidence_of_what_is_free() {
    let bar = |from, to, length_m, mass_kg| {
        Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).unwrap())
    };
    let anchor = |name: &str, x, z| Joint::anchor(name, [x, 0.0, z]);
    let joints = vec![
        anchor("A", 0.0, 0.0),
        anchor("B", 6.0, 0.0),
        anchor("C", 0.0, -1.0),
        anchor("D", 6.0, -1.0),
        Joint::free("c0").with_mass(1.0),
        Joint::free("d0").with_mass(50.0),
        Joint::free("c1"),
        Joint::free("d1").with_mass(10.0),
    ];
    let members = vec![
        bar(0, 4, 2.4, 0.0),
        bar(2, 5, 2.1, 0.0),
        bar(4, 6, 2.4, 0.0),
        bar(5, 7, 2.1, 1.0),
        bar(6, 1, 2.4, 0.0),
        bar(7, 3, 2.1, 0.0),
        bar(4, 5, 0.2, 0.0),
        bar(6, 7, 1.5, 0.0).of_kind(Kind::Cable),
    ];
    let system = System::new("frame", 9.80665, joints, members).unwrap();
    let answer = ask(&system, Solvers::Both, &|_| {});
    let agreement = answer.agreement.as_ref().unwrap();
    assert_eq!((answer.asked_again.len(), agreement.free_joints), (1, 1), "{answer:?}");
    assert!(answer.agrees());
}
