//! Systems on which the verdict once said more than was known: bars that just bridge their gap,
//! masses over many orders of magnitude, forces that equilibrium does not determine.

use census::{Census, Settings};
use model::{Equilibrium, ForceChoice, Place, Problem, Reason, Vector, cases};
use nalgebra::DMatrix;
use numerics::vector::norm;
use validate::Tolerances;
use validate::completeness::certify_by_census;
use validate::systems::judge_chain;

use crate::judged::{compare, judge_alone};

const SYSTEMS: [(&str, &str); 5] = [
    ("limp2", include_str!("first_tries/limp2.toml")),
    ("limp3", include_str!("first_tries/limp3.toml")),
    ("just-bridged", include_str!("first_tries/just-bridged.toml")),
    ("ratios-80", include_str!("first_tries/ratios-80.toml")),
    ("od-equals-l", include_str!("first_tries/od-equals-l.toml")),
];

fn system(name: &str) -> Problem {
    samples::parsed(SYSTEMS.iter().find(|(system, _)| *system == name).unwrap().1)
}

fn by_lagrange(problem: &Problem) -> Equilibrium {
    let settings = lagrange::condensed::Settings::default();
    lagrange::condensed::solve(problem, &settings).unwrap().equilibrium
}

fn by_energy(problem: &Problem) -> Equilibrium {
    energy::minimise(problem, &energy::Settings::default()).unwrap().equilibrium
}

/// Largest distance of any joint, whatever a comparison leaves out, in units of the total length.
fn apart(problem: &Problem, [a, b]: [&Equilibrium; 2]) -> f64 {
    let joints = a.joints_m.iter().zip(&b.joints_m);
    let distances = joints.map(|(a, b)| norm(std::array::from_fn(|k| a[k] - b[k])));
    distances.fold(0.0, f64::max) / problem.chain().total_length_m()
}

/// A joint that is held is compared, however little its bars carry: where answers agree, all their
/// joints do.
#[test]
fn agreement_leaves_out_no_joint_that_is_held() {
    let tolerances = Tolerances::project();
    for name in ["limp2", "limp3", "just-bridged", "ratios-80"] {
        let problem = system(name);
        let mut answers = [by_lagrange(&problem), by_energy(&problem)];
        let agreement = compare(&problem, &mut answers, &tolerances);
        let apart = apart(&problem, [&answers[0], &answers[1]]);
        println!("{name}: {apart:.1e} {:?} {}", agreement.verdict, agreement.disagreement);
        assert_eq!(agreement.free_joints, 0, "{name}");
        assert!(!agreement.agrees() || apart < 2.0 * tolerances.joints, "{name}: {apart}");
    }
}

/// An answer that stands alone passes neither the judge nor the census unless it is where the
/// equilibrium is.
#[test]
fn an_answer_alone_is_not_passed_where_it_is_wrong() {
    for name in ["limp2", "limp3", "just-bridged", "ratios-80"] {
        let problem = system(name);
        let truth = by_lagrange(&problem);
        let mut answer = by_energy(&problem);
        judge_alone(&problem, &mut answer);
        if problem.chain().bars().len() <= 4 {
            let census = Census::take(&problem, &Settings::default()).unwrap();
            certify_by_census(&problem, &census, &mut answer);
        }
        let apart = apart(&problem, [&truth, &answer]);
        assert!(answer.evidence.ladder.failed() || apart < 1e-9, "{name}: {apart:.1e}");
    }
}

/// What a complete census refutes keeps no rung but the first; a distance within the budget refutes
/// nothing.
#[test]
fn a_complete_census_refutes_an_answer() {
    let problem = cases::get("three-equal-bars-oblique").unwrap().problem();
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert!(census.complete);
    for (moved_m, refuted) in [(1e-6, true), (1e-11, false)] {
        let mut answers = [by_lagrange(&problem), by_energy(&problem)];
        assert!(compare(&problem, &mut answers, &Tolerances::project()).agrees());
        let mut answer = answers[0].clone();
        answer.joints_m[1][2] += moved_m;
        certify_by_census(&problem, &census, &mut answer);
        let ladder = &answer.evidence.ladder;
        let told = matches!(
            ladder.optimal.reason(),
            Some(Reason::RefutedByCensus { distance }) if *distance > 1e-7
        );
        assert_eq!((told, ladder.failed()), (refuted, refuted), "{ladder:?}");
        assert_eq!(ladder.agreed.is_reached(), !refuted);
        assert!(!ladder.verified.is_reached());
        // A census that is not complete refutes nothing.
        let mut open = census.clone();
        open.complete = false;
        let mut answer = answers[0].clone();
        answer.joints_m[1][2] += moved_m;
        certify_by_census(&problem, &open, &mut answer);
        assert!(!answer.evidence.ladder.failed());
    }
}

/// A light bar between heavy ones is judged by its own forces: turned by a thousandth, it is out of
/// balance by that.
#[test]
fn a_light_bar_is_judged_by_its_own_forces() {
    let bars = [(1.0, 1e6), (1.0, 1.0), (1.0, 1.0), (1.0, 1e6)];
    let problem = samples::homogeneous(9.81, &bars, [1.0, 0.0, 0.0]);
    let mut answer = by_lagrange(&problem);
    assert!(judge_chain(&problem, &answer).passes(1e-11));
    // Only the joint between the two light bars moves, across the way and hardly changing lengths.
    answer.joints_m[2][1] += 1e-6;
    let found = judge_chain(&problem, &answer);
    assert!(found.length < 1e-11 && found.moment > 1e-7, "{found:?}");
    assert!([Place::Member(2), Place::Member(3)].contains(&found.worst), "{found:?}");
}

/// n equal bars between anchors on one vertical.
fn equal(bars: usize, down_m: f64) -> Problem {
    samples::homogeneous(1.0, &vec![(1.0, 1.0); bars], [0.0, 0.0, -down_m])
}

/// Self-stresses by the rank of the rigidity matrix: a column for each free coordinate, a row for
/// each bar.
fn self_stresses(answer: &Equilibrium) -> usize {
    let bars = answer.joints_m.len() - 1;
    let mut rigidity = DMatrix::<f64>::zeros(bars, 3 * (bars - 1));
    for (i, ends) in answer.joints_m.windows(2).enumerate() {
        let along: Vector = std::array::from_fn(|k| ends[1][k] - ends[0][k]);
        for (k, along) in along.map(|x| x / norm(along)).into_iter().enumerate() {
            if i > 0 {
                rigidity[(i, 3 * (i - 1) + k)] = -along;
            }
            if i + 1 < bars {
                rigidity[(i, 3 * i + k)] = along;
            }
        }
    }
    bars - rigidity.rank(1e-7)
}

/// Parallel bars: the forces are a family, and agreement on one of them is no evidence.
#[test]
fn indeterminate_forces_are_told() {
    let tolerances = Tolerances::project();
    let problems = [(3, 1.0), (4, 2.0), (6, 2.0), (8, 2.0), (10, 2.0), (8, 0.0), (10, 0.0)];
    for (bars, down_m) in problems {
        let problem = equal(bars, down_m);
        let mut answers = [by_lagrange(&problem), by_energy(&problem)];
        let agreement = compare(&problem, &mut answers, &tolerances);
        let what = format!("{bars} bars, {down_m} m: {}", agreement.disagreement);
        assert!(agreement.agrees(), "{what}");
        assert!(answers[0].evidence.ladder.agreed.proof().unwrap().shape_only, "{what}");
        for answer in &answers {
            let family = answer.evidence.self_stresses.as_ref().unwrap();
            assert_eq!((family.dimension, self_stresses(answer)), (1, 1), "{what}");
            assert_eq!(family.choice, ForceChoice::AnchorsMovedApart);
            // The same along the whole row: tension down one strand, compression in the other.
            let sizes = family.basis[0].iter().map(|part| part.abs());
            assert!(sizes.clone().all(|part| (part - family.basis[0][0].abs()).abs() < 1e-9));
            // All bars are in tension.
            assert!(answer.axial_n.iter().all(|axial_n| *axial_n > 0.0), "{what}");
        }
        // Any other member of the family is in balance, and is no disagreement.
        let mut shifted = answers.clone();
        shift(&mut shifted[1], 0.3);
        let statics = judge_chain(&problem, &shifted[1]);
        assert!(statics.passes(1e-11), "{what} {statics:?}");
        let again = compare(&problem, &mut shifted, &tolerances);
        assert!(again.agrees(), "{what}: {}", again.disagreement);
        // A force beside the line is one.
        shifted[1].multipliers_n[1][0] += 1e-3;
        assert!(!compare(&problem, &mut shifted, &tolerances).agrees(), "{what}");
    }
}

/// Add an upward pull to all bars that run up, and take it from those that run down.
fn shift(answer: &mut Equilibrium, by_n: f64) {
    answer.multipliers_n[0][2] -= by_n;
    answer.multipliers_n[1..].iter_mut().for_each(|force| force[2] += by_n);
    answer.reactions_n.start[2] -= by_n;
    answer.reactions_n.end[2] += by_n;
    for (ends, axial) in answer.joints_m.windows(2).zip(&mut answer.axial_n) {
        *axial += if ends[1][2] > ends[0][2] { by_n } else { -by_n };
    }
}

/// Where bars are not all parallel there is no family, and no shift goes unseen.
#[test]
fn determinate_forces_are_compared_in_full() {
    let tolerances = Tolerances::project();
    for case in cases::all().iter().filter(|case| case.problem().chain().bars().len() <= 10) {
        let problem = case.problem();
        let mut answers = [by_lagrange(&problem), by_energy(&problem)];
        let agreement = compare(&problem, &mut answers, &tolerances);
        assert!(agreement.agrees(), "{}: {}", case.name, agreement.disagreement);
        let family = agreement.self_stresses;
        assert_eq!(Some(self_stresses(&answers[0])), family, "{}", case.name);
        if family == Some(0) {
            let pull_n = norm(answers[0].reactions_n.start);
            shift(&mut answers[1], 1e-3 * pull_n);
            assert!(!compare(&problem, &mut answers, &tolerances).agrees(), "{}", case.name);
        }
    }
}

/// Free joints are those that lengths leave room for: beside that, the place of each is an answer.
#[test]
fn joints_are_free_only_where_there_is_room() {
    let tolerances = Tolerances::project();
    let rows = [
        // Room to bend, exactly the reach, and less than the bars reach folded.
        ([1.0, 1.0], 1.5, true),
        ([1.0, 1.0], 1.999_999, true),
        ([1.0, 1.0], 2.000_001, false),
        ([1.5, 0.5], 1.1, true),
        ([1.5, 0.5], 0.999_999, false),
    ];
    for (lengths, span, free) in rows {
        // A heavy bar hangs from each anchor, the two without mass are between them.
        let bars = [(1.0, 1.0), (lengths[0], 0.0), (lengths[1], 0.0), (1.0, 1.0)];
        let problem = samples::homogeneous(1.0, &bars, [span, 0.0, 0.0]);
        let mut answers = [by_lagrange(&problem), by_lagrange(&problem)];
        let agreement = compare(&problem, &mut answers, &tolerances);
        assert_eq!(agreement.free_joints, usize::from(free), "{span}");
        let proof = answers[0].evidence.ladder.agreed.proof().unwrap();
        assert_eq!(proof.room.as_ref().map_or(0, |room| room.free_joints), usize::from(free));
    }
}
