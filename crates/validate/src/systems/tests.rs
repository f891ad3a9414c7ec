//! The judge of systems on closed forms, right and tampered with.

use model::system::{Joint, Kind, Member, System, SystemEquilibrium, SystemStability};
use model::{
    Bar, Evidence, Excess, ForceChoice, InSpace, NoAnswer, NoCertificate, Place, Quantity, Reason,
    Rigidity, SelfStresses, SolverName, Vector,
};

use super::compare::{judge_alone, judge_without};
use super::{certify, compare, judge};
use crate::tolerances::Tolerances;

/// A lamp of 2 N on two massless bars of 5 m between anchors 6 m apart (3, 4, 5): each bar pulls
/// with 5/4 N.
pub(super) fn lamp() -> (System, SystemEquilibrium) {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.2]);
    let bar = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = vec![Member::bar(0, 2, bar), Member::cable(2, 1, bar)];
    let system = System::new("lamp", 10.0, joints, members).unwrap();
    let (left, right) = ([-0.75, 0.0, 1.0], [0.75, 0.0, 1.0]);
    let answer = SystemEquilibrium {
        solver: SolverName::LAGRANGE,
        energy_j: -8.0,
        joints_m: vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]],
        start_forces_n: vec![left, right.map(|x| -x)],
        end_forces_n: vec![left.map(|x| -x), right],
        axial_n: vec![1.25, 1.25],
        reactions_n: vec![left, right, [0.0; 3]],
        stability: SystemStability {
            in_space: InSpace::Stable,
            index_in_space: 0,
            index_in_plane: Some(0),
            neutral: 0,
        },
        evidence: Evidence::new("closed form", 0.0, 0.0, 0),
    };
    (system, answer)
}

/// The answer with another joint, and members without force to it.
pub(super) fn joined(answer: &mut SystemEquilibrium, at_m: Vector, held_n: Vector, members: usize) {
    answer.joints_m.push(at_m);
    answer.reactions_n.push(held_n);
    answer.start_forces_n.extend(vec![[0.0; 3]; members]);
    answer.end_forces_n.extend(vec![[0.0; 3]; members]);
    answer.axial_n.extend(vec![0.0; members]);
}

/// The largest violation with its place, of the lamp with one number changed.
fn changed(change: impl Fn(&mut SystemEquilibrium)) -> (f64, Place) {
    let (system, mut answer) = lamp();
    change(&mut answer);
    let found = judge(&system, &answer);
    (found.largest(), found.worst)
}

#[test]
fn a_closed_form_passes() {
    assert!(changed(|_| {}).0 < 1e-15);
}

#[test]
fn every_number_of_an_answer_counts() {
    const OFF: f64 = 1e-6;
    let seen = |change: fn(&mut SystemEquilibrium)| {
        let (most, _) = changed(change);
        assert!(most.is_nan() || most > 1e-8, "{most:e}");
    };
    seen(|a| a.joints_m[0][1] += OFF);
    seen(|a| a.joints_m[2][2] += OFF);
    seen(|a| a.start_forces_n[0][0] += OFF);
    seen(|a| a.end_forces_n[1][2] += OFF);
    seen(|a| a.axial_n[1] += OFF);
    seen(|a| a.reactions_n[1][0] += OFF);
    seen(|a| a.reactions_n[2][1] += OFF);
    seen(|a| a.energy_j += OFF);
    seen(|a| a.joints_m.truncate(1));
    assert!(changed(|a| a.joints_m[2][0] = f64::NAN).0.is_nan());
    assert!(changed(|a| a.axial_n[0] = f64::NAN).0.is_nan());
    assert!(changed(|a| a.energy_j = f64::NAN).0.is_nan());
}

#[test]
fn the_place_is_that_of_the_largest_violation() {
    assert_eq!(changed(|a| a.axial_n[1] += 0.1).1, Place::Member(2));
    assert_eq!(changed(|a| a.reactions_n[2][1] += 0.1).1, Place::Joint(2));
}

/// The lamp upside down: in balance as bars, both compressed.
pub(super) fn arch() -> (System, SystemEquilibrium) {
    let (system, mut answer) = lamp();
    answer.joints_m[2][2] = 4.0;
    for forces in [&mut answer.start_forces_n, &mut answer.end_forces_n] {
        for force in forces.iter_mut() {
            force[0] = -force[0];
        }
    }
    for reaction in &mut answer.reactions_n {
        reaction[0] = -reaction[0];
    }
    answer.axial_n = vec![-1.25; 2];
    answer.energy_j = 8.0;
    (system, answer)
}

#[test]
fn a_cable_that_pushes_is_told() {
    let (system, answer) = arch();
    let found = judge(&system, &answer);
    // 1.25 N of the 2 N that act.
    assert!((found.law - 0.625).abs() < 1e-12 && found.worst == Place::Member(2), "{found:?}");
    for other in [found.length, found.force, found.moment, found.joint, found.derived] {
        assert!(other < 1e-15, "{found:?}");
    }
}

/// The lower bound of all energies is the energy itself, -8 J: the only other place of the joint,
/// above, has +8 J.
#[test]
fn pulling_members_are_a_proof_of_the_global_minimum() {
    let (system, answer) = lamp();
    let proof = certify(&system, &answer).unwrap();
    assert!(!proof.singular && proof.gap.unwrap().abs() < 1e-12, "{proof:?}");
    // A tenth of a millimetre too low is no equilibrium, and the bound says how far off it is.
    let mut off = answer.clone();
    off.joints_m[2][2] -= 1e-4;
    off.energy_j -= 2e-4;
    let below = certify(&system, &off);
    assert!(matches!(below, Err(NoCertificate::Gap { gap }) if gap < -1e-5), "{below:?}");
    let mut high = answer;
    high.energy_j += 1e-3;
    // Of 2 N times the 6 m from the first anchor to the second.
    let gap = certify(&system, &high);
    assert!(
        matches!(gap, Err(NoCertificate::Gap { gap }) if (gap - 1e-3 / 12.0).abs() < 1e-12),
        "{gap:?}"
    );
}

#[test]
fn an_arch_has_no_certificate() {
    let (system, answer) = arch();
    assert_eq!(certify(&system, &answer), Err(NoCertificate::NotDefinite { compressed: 1 }));
}

type Change = fn(&mut SystemEquilibrium);

#[test]
fn answers_that_differ_do_not_agree() {
    let (system, answer) = lamp();
    let agreed = |change: &dyn Fn(&mut SystemEquilibrium)| {
        let mut second = answer.clone();
        second.solver = SolverName::ENERGY;
        change(&mut second);
        let mut both = [answer.clone(), second];
        compare(&system, &mut both, &Tolerances::project())
    };
    assert!(agreed(&|_| ()).agrees());
    assert!(!agreed(&|a| a.joints_m[2][1] += 1e-6).agrees());
    assert!(!agreed(&|a| a.reactions_n[0][1] = f64::NAN).agrees());
    assert!(agreed(&|a| a.axial_n.truncate(1)).forces_n.is_nan());
    // Budgets by hand: 6 m from the first anchor, which is 3 m from the origin, to the second, with
    // eight roundings of 9 m; 2 N; and 12 J, with 2 N times the roundings.
    let changes: [(Change, f64); 3] = [
        (|a| a.joints_m[2][1] += 1e-6, 1e-10 * 6.0 + 72.0 * f64::EPSILON),
        (|a| a.reactions_n[0][1] += 1e-6, 1e-9 * 2.0),
        (|a| a.energy_j += 1e-6, 1e-12 * 12.0 + 144.0 * f64::EPSILON),
    ];
    for (change, budget) in changes {
        let excess = agreed(&change).disagreement.excesses[0].clone();
        assert!((excess.value - 1e-6).abs() < 1e-14, "{excess:?}");
        assert!((excess.budget / budget - 1.0).abs() < 1e-12, "{excess:?}");
    }
    let other = agreed(&|a| a.stability.index_in_space = 1);
    assert!(
        matches!(other.disagreement.excesses[..], [ref e] if matches!(e.what, Quantity::MorseIndex { .. }))
    );
}

/// A weight on a bar of 5 m, drawn aside by nothing: it hangs where it likes on a circle about the
/// vertical through (1, 2), here held up by another bar from 6 m below.
pub(super) fn propped(cos: f64, sin: f64) -> (System, SystemEquilibrium) {
    let joints = samples::joints(&[[1.0, 2.0, 0.0], [1.0, 2.0, -6.0]], &[0.2]);
    let bar = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = vec![Member::bar(0, 2, bar), Member::bar(2, 1, bar)];
    let system = System::new("propped", 10.0, joints, members).unwrap();
    // The upper bar pulls, the lower pushes, each with 5/3 N along (4, 3)/5.
    let out = [4.0 * cos, 4.0 * sin];
    let upper = [-out[0] / 3.0, -out[1] / 3.0, 1.0];
    let lower = [out[0] / 3.0, out[1] / 3.0, 1.0];
    let answer = SystemEquilibrium {
        energy_j: -6.0,
        joints_m: vec![[1.0, 2.0, 0.0], [1.0, 2.0, -6.0], [1.0 + out[0], 2.0 + out[1], -3.0]],
        start_forces_n: vec![upper, lower.map(|x| -x)],
        end_forces_n: vec![upper.map(|x| -x), lower],
        axial_n: vec![5.0 / 3.0, -5.0 / 3.0],
        reactions_n: vec![upper, lower, [0.0; 3]],
        ..lamp().1
    };
    (system, answer)
}

#[test]
fn a_part_that_turns_is_turned_before_it_is_compared() {
    let (system, first) = propped(1.0, 0.0);
    let (_, second) = propped(0.6, 0.8);
    let mut both = [first, second];
    both[1].solver = SolverName::ENERGY;
    let agreement = compare(&system, &mut both, &Tolerances::project());
    assert!(agreement.agrees() && agreement.joints_m < 1e-14, "{agreement:?}");
    assert_eq!(agreement.turned_parts, 1);
    // Singular by the turn: nothing is claimed.
    assert!(certify(&system, &both[0]).is_err());
}

/// 16 N on four bars of 5 m from the corners of a square (3, 4, 5): those along x may take any part
/// of it.
pub(super) fn four_legs(along_x: f64) -> (System, SystemEquilibrium) {
    let corners = [[3.0, 0.0, 0.0], [-3.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, -3.0, 0.0]];
    let mut joints: Vec<Joint> = corners
        .iter()
        .zip(["A", "B", "C", "D"])
        .map(|(at, name)| Joint::anchor(name, *at))
        .collect();
    joints.push(Joint::free("P").with_mass(1.6));
    let bar = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = (0..4).map(|k| Member::bar(k, 4, bar)).collect();
    let system = System::new("four legs", 10.0, joints, members).unwrap();
    // Two bars of 5/4 N for each 2 N.
    let axial_n = [along_x, along_x, 1.0 - along_x, 1.0 - along_x].map(|part| 10.0 * part).to_vec();
    let pull = |k: usize| corners[k].map(|x| x / 5.0 * axial_n[k]);
    let start: Vec<_> = (0..4).map(|k| [pull(k)[0], pull(k)[1], 0.8 * axial_n[k]]).collect();
    let end = start.iter().map(|f: &[f64; 3]| f.map(|x| -x)).collect();
    let mut reactions_n = start.clone();
    reactions_n.push([0.0; 3]);
    let mut joints_m = corners.to_vec();
    joints_m.push([0.0, 0.0, -4.0]);
    let answer = SystemEquilibrium {
        energy_j: -64.0,
        joints_m,
        start_forces_n: start,
        end_forces_n: end,
        axial_n,
        reactions_n,
        ..lamp().1
    };
    (system, answer)
}

#[test]
fn answers_that_differ_by_a_self_stress_are_one_and_it_is_no_evidence_for_forces() {
    let (system, first) = four_legs(0.5);
    let (_, mut second) = four_legs(0.2);
    second.solver = SolverName::ENERGY;
    let mut answers = [first, second];
    let agreement = compare(&system, &mut answers, &Tolerances::project());
    assert!(agreement.agrees(), "{}", agreement.disagreement);
    assert_eq!(agreement.self_stresses, Some(1));
    assert!(agreement.forces_n < 1e-14, "{:e}", agreement.forces_n);
    assert!(answers.iter().all(|a| a.evidence.ladder.agreed.proof().unwrap().shape_only));
}

#[test]
fn what_is_no_self_stress_still_counts() {
    let (system, first) = four_legs(0.5);
    let (_, mut second) = four_legs(0.2);
    second.start_forces_n[2][2] += 1e-6;
    let agreement = compare(&system, &mut [first, second], &Tolerances::project());
    assert!(!agreement.agrees());
    assert!((agreement.forces_n - 1e-6).abs() < 1e-12, "{:e}", agreement.forces_n);
}

#[test]
fn forces_of_one_shape_are_told_from_a_family() {
    let (system, first) = lamp();
    let mut second = first.clone();
    second.solver = SolverName::ENERGY;
    let mut answers = [first, second];
    let agreement = compare(&system, &mut answers, &Tolerances::project());
    assert_eq!(agreement.self_stresses, Some(0));
    assert!(!answers[0].evidence.ladder.agreed.proof().unwrap().shape_only);
}

#[test]
fn a_named_self_stress_that_is_none_is_seen() {
    // The largest singular value of the balances is 1.6, of 4/5 along Z four times. Twice 1e-9 of it
    // may be left over, which is 4/5 of what the last force is off.
    for (stress, is_one) in [
        ([0.5, 0.5, -0.5, -0.5], true),
        ([0.5, 0.5, -0.5, -0.5 - 3e-9], true),
        ([0.5, 0.5, -0.5, -0.5 - 6e-9], false),
        ([0.5, 0.5, -0.5, -0.5001], false),
    ] {
        let (system, mut first) = four_legs(0.5);
        let (_, second) = four_legs(0.5);
        first.evidence.self_stresses = Some(SelfStresses {
            dimension: 1,
            basis: vec![stress.to_vec()],
            choice: ForceChoice::Unknown,
            misfit_m: None,
            ranges: None,
        });
        let agreement = compare(&system, &mut [first, second], &Tolerances::project());
        let told = |e: &Excess| matches!(e.what, Quantity::SelfStresses { .. });
        assert_eq!(agreement.disagreement.excesses.iter().any(told), !is_one, "{stress:?}");
        assert_eq!(agreement.agrees(), is_one);
    }
}

/// What the judge refuses of one answer alone stays refused, whatever became of the other solver.
#[test]
fn an_answer_alone_out_of_balance_is_refused() {
    let without = |answer: &mut SystemEquilibrium, system: &System| {
        judge_without(system, answer, SolverName::ENERGY, NoAnswer::Refused);
        answer.evidence.ladder.agreed.reason().cloned()
    };
    let (system, mut answer) = lamp();
    judge_alone(&system, &mut answer);
    let alone = answer.evidence.ladder.agreed.reason();
    assert!(matches!(alone, Some(Reason::OneSolverOnly { .. })), "{alone:?}");
    let reason = without(&mut answer, &system);
    assert!(matches!(reason, Some(Reason::OtherSolverWithoutAnswer { .. })), "{reason:?}");
    answer.reactions_n[0][2] += 1e-3;
    let reason = without(&mut answer, &system);
    assert!(matches!(reason, Some(Reason::JudgeRefuses { .. })), "{reason:?}");
    assert!(answer.evidence.ladder.failed());
}

/// Whichever number is missing in whichever of both answers.
#[test]
fn what_is_missing_is_no_agreement() {
    let (system, answer) = lamp();
    let changes: [Change; 5] = [
        |a| a.start_forces_n.truncate(1),
        |a| a.end_forces_n.truncate(1),
        |a| a.axial_n.truncate(1),
        |a| a.reactions_n.truncate(2),
        |a| a.joints_m.truncate(2),
    ];
    for (k, change) in changes.into_iter().enumerate() {
        for short in 0..2 {
            let mut both = [answer.clone(), answer.clone()];
            both[1].solver = SolverName::ENERGY;
            change(&mut both[short]);
            let found = compare(&system, &mut both, &Tolerances::project());
            assert!(!found.agrees(), "{k} {short}");
            assert_eq!([found.joints_m.is_nan(), found.forces_n.is_nan()], [k == 4, k < 4]);
        }
    }
}

/// Of three answers the largest difference of any two counts.
#[test]
fn three_answers_are_compared_two_by_two() {
    let (system, answer) = lamp();
    let at = |aside_m: f64, energy_j: f64| {
        let mut answer = answer.clone();
        answer.joints_m[2][1] += aside_m;
        answer.reactions_n[0][1] += 2.0 * aside_m;
        answer.energy_j += energy_j;
        answer
    };
    let mut all = [at(0.25, 0.5), at(0.0, 0.0), at(-0.5, 2.0)];
    let found = compare(&system, &mut all, &Tolerances::project());
    assert!((found.joints_m - 0.75).abs() < 1e-15 && (found.forces_n - 1.5).abs() < 1e-14);
    assert!((found.energy_j - 2.0).abs() < 1e-14);
    assert_eq!(found.statics.len(), 3);
    assert_eq!((found.turned_parts, found.free_joints), (0, 0));
}

/// A solver that leaves out a cable that has its length and bears nothing counts no self-stress beside
/// one that counts it. The judge counts one for both, and names it; where signs forbid it, as two
/// cables that it would make push and pull, it is counted and nothing is open.
#[test]
fn no_answer_of_a_family_counts_no_self_stress() {
    for (cables, open) in [(vec![2], true), (vec![2, 3], true), (vec![0, 2], false)] {
        let (system, first) = if open { four_legs(1.0) } else { four_legs(0.0) };
        let mut members = system.members().to_vec();
        for k in cables {
            members[k].kind = Kind::Cable;
        }
        let (mut joints, mut first) = (system.joints().to_vec(), first);
        if !open {
            // Without any load, and a spring elsewhere that gives forces their size.
            joints[4].mass_kg = 0.0;
            joints.push(Joint::anchor("E", [0.0; 3]));
            joints.push(Joint::anchor("F", [3.0, 0.0, 0.0]));
            let spring = Bar::homogeneous(2.0, 0.0).unwrap();
            members.push(Member::bar(5, 6, spring).with_stiffness(2.0));
            first.joints_m.extend([[0.0; 3], [3.0, 0.0, 0.0]]);
            let pull = [1.0, 0.0, 0.0];
            let forces = |k: usize| if k < 4 { [0.0; 3] } else { pull };
            first.axial_n = vec![0.0, 0.0, 0.0, 0.0, 1.0];
            first.start_forces_n = (0..5).map(|k| forces(k).map(|x| -x)).collect();
            first.end_forces_n = (0..5).map(forces).collect();
            first.reactions_n = vec![[0.0; 3]; 7];
            (first.reactions_n[5], first.reactions_n[6]) = (pull.map(|x| -x), pull);
            first.energy_j = 0.5;
        }
        let system = System::new("legs", 10.0, joints, members).unwrap();
        let none = Rigidity { rank: 3, mechanisms: 0, self_stresses: 0, gap: [1.0, 0.0] };
        first.evidence.rigidity = Some(none);
        let mut second = first.clone();
        second.solver = SolverName::ENERGY;
        let mut both = [first, second];
        let agreement = compare(&system, &mut both, &Tolerances::project());
        assert!(agreement.agrees(), "{}", agreement.disagreement);
        assert_eq!(agreement.self_stresses, Some(1));
        for answer in both {
            let agreed = answer.evidence.ladder.agreed.proof().unwrap();
            assert_eq!(agreed.shape_only, open);
            assert_eq!(answer.evidence.rigidity.unwrap().self_stresses, 1);
            assert_eq!(answer.evidence.self_stresses.is_some(), open);
        }
    }
}
