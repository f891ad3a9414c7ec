//! Both solvers on every case of the registry, against the budgets; and the comparison can fail.

use model::{Equilibrium, Problem, Rung, cases};
use validate::Tolerances;
use validate::built_in::{key, number, parsed};
use validate::table::{csv, table};

use crate::judged::{both, compare};

#[test]
fn both_solvers_agree_on_every_case_of_the_registry() {
    let results = table(cases::all());
    // The disagreement is stored before it is judged.
    let path = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join("comparison.csv");
    std::fs::write(path, csv(&results)).unwrap();
    let rows = results.iter().flat_map(|result| &result.rows);
    let worst = rows.max_by(|a, b| a.difference.total_cmp(&b.difference)).unwrap();
    println!("largest difference: {worst:?}");
    let mut measured = [0.0_f64; 4];
    for result in &results {
        println!("{:32} {:?} {:?}", result.case, result.scaled, result.rung);
        for (most, value) in measured.iter_mut().zip(result.scaled.unwrap_or([f64::NAN; 4])) {
            *most = most.max(value);
        }
    }
    println!("measured: joints, forces, energy, statics: {measured:?}");
    // What the file of budgets says of the measured values is not stale. The factor leaves room for
    // other processors.
    let file = parsed(include_str!("../../data/tolerances.toml"));
    for (found, name) in measured.iter().zip(["joints", "forces", "energy", "statics"]) {
        let recorded = key(key(&file, name, toml::Value::as_table), "measured", number);
        assert!(*found <= 10.0 * recorded, "{name}: measured {found:e}, recorded {recorded:e}");
    }
    for result in &results {
        assert!(result.agrees(), "{}: {:?} {:?}", result.case, result.failure, result.agreement);
        // Every hanging chain is certified, not just found twice.
        assert_eq!(result.rung, Some(Rung::Optimal), "{}", result.case);
    }
}

fn answers() -> (Problem, [Equilibrium; 2]) {
    let problem = cases::get("three-equal-bars-oblique").unwrap().problem();
    let (answers, agreement) = both(&problem);
    assert!(agreement.agrees());
    (problem, answers)
}

/// Changes that the comparison must see.
const CHANGES: [fn(&mut Equilibrium); 10] = [
    |e| e.joints_m[1][0] += 1e-6,
    |e| e.multipliers_n[2][2] += 1e-6,
    |e| e.multipliers_n[1] = e.multipliers_n[1].map(|x| -x),
    |e| e.energy_j += 1e-6,
    |e| e.energy_j = f64::NAN,
    |e| e.stability.index_in_space = 1,
    |e| e.axial_n[1] = -e.axial_n[1],
    |e| e.axial_n[0] += 1e-6,
    |e| e.reactions_n.start[2] += 1e-6,
    |e| e.reactions_n.end[0] = f64::NAN,
];

#[test]
fn a_changed_answer_is_not_agreed_with() {
    let (problem, good) = answers();
    for (k, change) in CHANGES.into_iter().enumerate() {
        for which in 0..2 {
            let mut bad = good.clone();
            change(&mut bad[which]);
            let agreement = compare(&problem, &mut bad, &Tolerances::project());
            assert!(!agreement.agrees(), "change {k} of answer {which} went unseen");
            assert!(!agreement.disagreement.is_empty());
            for answer in &bad {
                assert!(!answer.evidence.ladder.is_reached(Rung::Agreed), "change {k}");
            }
        }
    }
}

/// Kilometres and grams, so that a unit forgotten or added is no small matter.
fn long_and_light() -> (Problem, [Equilibrium; 2]) {
    let bars = [(900.0, 1e-3), (700.0, 3e-3), (1100.0, 2e-3)];
    let problem = samples::homogeneous(9.81, &bars, [1000.0, 300.0, -400.0]);
    let (answers, agreement) = both(&problem);
    assert!(agreement.agrees());
    (problem, answers)
}

/// Changes a number of an answer by so much.
type Change = fn(&mut Equilibrium, f64);

/// Errors a little above the budgets of the project are told, each in its own unit: a budget that
/// is widened lets one of them through.
#[test]
fn errors_that_matter_are_not_within_the_budgets() {
    let (problem, good) = long_and_light();
    let (length_m, weight_n) = (2700.0, 6e-3 * 9.81);
    let changes: [(f64, Change); 4] = [
        (1e-9 * length_m, |e, by| e.joints_m[1][1] += by),
        // The pull is several times the weight.
        (1e-8 * weight_n, |e, by| e.multipliers_n[1][0] -= by),
        (1e-11 * weight_n * length_m, |e, by| e.energy_j += by),
        (1e-10 * weight_n, |e, by| e.reactions_n.end[2] += by),
    ];
    for (k, (by, change)) in changes.into_iter().enumerate() {
        for which in 0..2 {
            let mut answers = good.clone();
            change(&mut answers[which], by);
            let agreement = compare(&problem, &mut answers, &Tolerances::project());
            assert!(!agreement.agrees(), "change {k} of answer {which} is within the budgets");
        }
    }
}

/// A joint without load between bars under tension is not free: the two bars are parallel.
#[test]
fn a_joint_without_load_is_held_by_bars_that_carry_force() {
    let bars = [(1.0, 2.0), (0.5, 0.0), (0.7, 0.0), (1.0, 1.0)];
    let problem = samples::homogeneous(9.81, &bars, [2.0, 0.0, 0.0]);
    let (mut answers, agreement) = both(&problem);
    assert!(agreement.agrees() && agreement.free_joints == 0, "{:?}", agreement.disagreement);
    answers[0].joints_m[2][2] += 1e-3;
    let agreement = compare(&problem, &mut answers, &Tolerances::project());
    assert!(!agreement.agrees() && agreement.free_joints == 0);
    assert!((agreement.joints_m - 1e-3).abs() < 1e-9, "{}", agreement.joints_m);
}

#[test]
fn two_answers_wrong_in_the_same_way_do_not_pass_the_statics_judge() {
    let (problem, good) = answers();
    for change in [CHANGES[0], CHANGES[1], CHANGES[2]] {
        let mut bad = good.clone();
        bad.iter_mut().for_each(change);
        assert!(!compare(&problem, &mut bad, &Tolerances::project()).agrees());
    }
}
