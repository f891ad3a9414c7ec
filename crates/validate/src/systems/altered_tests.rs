//! The judge's own test: right answers with one thing altered. The table states from which size on
//! each alteration is seen; a judge that gets blinder fails.

use model::system::{Joint, Member, System, SystemEquilibrium};
use model::{Bar, ForceChoice, SelfStresses, SolverName};

use super::compare::judge_alone;
use super::tests::{four_legs, lamp};
use super::{ask_with, compare};
use crate::question::{Question, UseCensus};
use crate::tolerances::Tolerances;
use numerics::vector::{minus, plus, times};

/// An answer altered by a size.
type Alteration = fn(&System, &SystemEquilibrium, f64) -> SystemEquilibrium;

/// Add a multiple of axial forces, with all that follows from them.
fn added(
    system: &System,
    answer: &SystemEquilibrium,
    axial: impl Fn(usize) -> f64,
) -> SystemEquilibrium {
    let mut other = answer.clone();
    for (k, member) in system.members().iter().enumerate() {
        let d = minus(answer.joints_m[member.to], answer.joints_m[member.from]);
        let pull = times(axial(k) / numerics::vector::norm(d), d);
        other.axial_n[k] += axial(k);
        other.start_forces_n[k] = minus(other.start_forces_n[k], pull);
        other.end_forces_n[k] = plus(other.end_forces_n[k], pull);
        for (joint, pull) in [(member.from, times(-1.0, pull)), (member.to, pull)] {
            if system.joints()[joint].support.is_fixed() {
                other.reactions_n[joint] = plus(other.reactions_n[joint], pull);
            }
        }
    }
    other
}

const ALL_FORCES: Alteration =
    |system, answer, size| added(system, answer, |k| size * answer.axial_n[k]);
const ONE_FORCE: Alteration = |system, answer, size| {
    added(system, answer, |k| if k == 0 { size * answer.axial_n[0] } else { 0.0 })
};
const ONE_JOINT: Alteration = |system, answer, size| {
    let mut other = answer.clone();
    let moved = system.joints().iter().position(|joint| !joint.support.is_fixed()).unwrap();
    other.joints_m[moved] = plus(other.joints_m[moved], times(size, [0.48, 0.6, 0.64]));
    other
};
/// A self-stress that the answer names, of this part of all loads.
const SELF_STRESS: Alteration = |system, answer, size| {
    let stress = &answer.evidence.self_stresses.as_ref().unwrap().basis[0];
    let load_n = system.total_load_n();
    added(system, answer, |k| size * load_n * stress[k])
};

/// The right answer, named as by the other solver.
fn twin(answer: &SystemEquilibrium) -> SystemEquilibrium {
    SystemEquilibrium { solver: SolverName::new("altered"), ..answer.clone() }
}

/// Whether an altered answer is seen: by itself, and beside the right one.
fn seen(system: &System, right: &SystemEquilibrium, altered: &SystemEquilibrium) -> [bool; 2] {
    let mut alone = altered.clone();
    judge_alone(system, &mut alone);
    let both = &mut [right.clone(), twin(altered)];
    let beside = compare(system, both, &Tolerances::project());
    [alone.evidence.ladder.failed(), !beside.agrees()]
}

/// The exponent of ten from which on every size up to 1e9 is seen, by itself and beside the right
/// answer; 10 where it never is.
fn seen_from(system: &System, right: &SystemEquilibrium, alter: Alteration) -> [i32; 2] {
    let mut from = [10; 2];
    for exponent in (-16..=9).rev() {
        let altered = alter(system, right, 10.0_f64.powi(exponent));
        for (from, seen) in from.iter_mut().zip(seen(system, right, &altered)) {
            if seen && *from == exponent + 1 {
                *from = exponent;
            }
        }
    }
    from
}

/// 16 N on four legs of 5 m, shared equally, and named so.
fn tetrapod() -> (System, SystemEquilibrium) {
    let (system, mut answer) = four_legs(0.5);
    answer.evidence.self_stresses = Some(SelfStresses {
        dimension: 1,
        basis: vec![vec![0.5, 0.5, -0.5, -0.5]],
        choice: ForceChoice::EquallyStiff,
        misfit_m: None,
        ranges: None,
    });
    (system, answer)
}

/// 16 N on a floor, drawn aside by 8 N against a cable of 5 m (3, 4, 5): it pulls with 10 N, and the
/// floor pushes with 10 N.
fn on_the_floor() -> (System, SystemEquilibrium) {
    let joints = vec![
        Joint::anchor("A", [0.0, 0.0, 3.0]),
        Joint::free("P").with_mass(1.6).with_force([8.0, 0.0, 0.0]),
    ];
    let cable = Member::cable(0, 1, Bar::homogeneous(5.0, 0.0).unwrap());
    let system = System::new("on the floor", 10.0, joints, vec![cable]).unwrap();
    let pull = [-8.0, 0.0, 6.0];
    let answer = SystemEquilibrium {
        energy_j: -32.0 - 48.0,
        joints_m: vec![[0.0, 0.0, 3.0], [4.0, 0.0, 0.0]],
        start_forces_n: vec![pull],
        end_forces_n: vec![pull.map(|x| -x)],
        axial_n: vec![10.0],
        reactions_n: vec![pull, [0.0, 0.0, 10.0]],
        ..lamp().1
    };
    (system.with_floor(0.0).unwrap(), answer)
}

/// As `energy` solves it.
fn solved(joints: Vec<Joint>, members: Vec<Member>) -> (System, SystemEquilibrium) {
    let system = System::new("solved", 10.0, joints, members).unwrap();
    let answer =
        ask_with(&system, &Question { census: UseCensus::Never, ..Question::default() }, &|_| {});
    assert!(answer.agrees(), "{:?} {:?}", answer.failures, answer.agreement);
    (system, answer.equilibria[1].clone())
}

/// Three cables of different lengths from different heights.
fn bridle() -> (System, SystemEquilibrium) {
    let joints = samples::joints(&[[0.0, 0.0, 0.0], [4.0, 0.0, 1.0], [1.0, 3.0, 0.5]], &[2.0]);
    let cable = |from, length_m| Member::cable(from, 3, Bar::homogeneous(length_m, 0.3).unwrap());
    solved(joints, vec![cable(0, 2.6), cable(1, 3.4), cable(2, 2.7)])
}

/// A net of nine joints; with a stiffness, its cables are a tenth too short.
fn net(stiffness_n: Option<f64>) -> (System, SystemEquilibrium) {
    let (mut joints, mut members) = (vec![], vec![]);
    for k in 0..25_u8 {
        let (row, column) = (k / 5, k % 5);
        let at_m = [f64::from(row), f64::from(column), 0.1 * f64::from(row) * f64::from(column)];
        let edge = [row, column].iter().any(|n| [0, 4].contains(n));
        joints.push(if edge {
            Joint::anchor(k.to_string(), at_m)
        } else {
            Joint::free(k.to_string()).with_mass(0.1 * f64::from(k))
        });
    }
    for k in 0..25_usize {
        for other in [k + 1, k + 5] {
            let in_row = other == k + 5 || other % 5 != 0;
            let held = |k: usize| [k / 5, k % 5].iter().any(|n| [0, 4].contains(n));
            if other < 25 && in_row && !(held(k) && held(other)) {
                let length_m = if stiffness_n.is_some() { 0.9 } else { 1.15 };
                let cable = Member::cable(k, other, Bar::homogeneous(length_m, 0.05).unwrap());
                members.push(cable.with_stiffness(stiffness_n));
            }
        }
    }
    solved(joints, members)
}

/// 2 N on two cables that sag by 2⁻¹⁹ m, with (m² - 1, 2 m, m² + 1) of m = 2²⁰ in units of 2⁻⁴⁰ m,
/// where all numbers are exact: level they pull with 2¹⁹ (1 - 2⁻⁴⁰) N.
fn nearly_taut() -> (System, SystemEquilibrium) {
    let tiny = 2.0_f64.powi(-40);
    let (half_m, length_m, sag_m) = (1.0 - tiny, 1.0 + tiny, 2.0_f64.powi(-19));
    let joints = samples::joints(&[[-half_m, 0.0, 0.0], [half_m, 0.0, 0.0]], &[0.2]);
    let cable = |from, to| Member::cable(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
    let system = System::new("taut", 10.0, joints, vec![cable(0, 2), cable(2, 1)]).unwrap();
    let (left, right) = ([-half_m / sag_m, 0.0, 1.0], [half_m / sag_m, 0.0, 1.0]);
    let answer = SystemEquilibrium {
        energy_j: -2.0 * sag_m,
        joints_m: vec![[-half_m, 0.0, 0.0], [half_m, 0.0, 0.0], [0.0, 0.0, -sag_m]],
        start_forces_n: vec![left, right.map(|x| -x)],
        end_forces_n: vec![left.map(|x| -x), right],
        axial_n: vec![length_m / sag_m; 2],
        reactions_n: vec![left, right, [0.0; 3]],
        ..lamp().1
    };
    (system, answer)
}

/// The six systems with their right answers.
fn systems() -> [(System, SystemEquilibrium); 6] {
    [tetrapod(), bridle(), net(None), net(Some(1e4)), on_the_floor(), nearly_taut()]
}

/// Exponents of ten of the size from which on an alteration is seen, by itself and beside the right
/// answer: of forces as a part of them, of places in m. The columns are the systems: tetrapod, bridle,
/// net, prestressed net, floor, nearly taut line.
///
/// A force is seen from 1e-9 of what acts at its joint on. All forces of the nearly taut line are
/// seen from 1e-9 of its load on, which is what they leave at the joint when they grow; one of them,
/// of 262144 times the load, from 1e-14 of it. A joint is seen from 1e-10 of the size on, at a nearly
/// taut line from what changes its length.
const SEEN_FROM: [(Alteration, [[i32; 2]; 6]); 3] = [
    (ALL_FORCES, [[-10, -10], [-11, -11], [-10, -10], [-11, -11], [-10, -10], [-8, -9]]),
    (ONE_FORCE, [[-10, -10], [-10, -10], [-10, -10], [-11, -11], [-10, -10], [-14, -14]]),
    (ONE_JOINT, [[-10, -10], [-10, -10], [-10, -10], [-12, -12], [-10, -10], [-14, -14]]),
];

#[test]
fn altered_answers_are_seen_from_a_stated_size_on() {
    for (k, (system, right)) in systems().iter().enumerate() {
        assert_eq!(seen(system, right, right), [false; 2], "{k}");
        for (row, (alter, stated)) in SEEN_FROM.iter().enumerate() {
            let [alone, beside] = seen_from(system, right, *alter);
            let [most_alone, most_beside] = stated[k];
            assert!(alone <= most_alone && beside <= most_beside, "{row} {k}: {alone} {beside}");
        }
    }
}

/// A self-stress leaves every joint in balance. What gives it away is the share that the answer names:
/// from 1e-8 of all loads on, at half of it in each leg. An answer that names no share is one of the
/// family with it, until its forces are no forces any more.
#[test]
fn a_self_stress_is_seen_by_the_share_that_is_named() {
    let (system, mut right) = tetrapod();
    assert_eq!(seen_from(&system, &right, SELF_STRESS), [-8, -8]);
    right.evidence.self_stresses.as_mut().unwrap().choice = ForceChoice::Unknown;
    let altered = SELF_STRESS(&system, &right, 1.0);
    assert_eq!(seen(&system, &right, &altered), [false; 2]);
    let mut both = [right.clone(), twin(&altered)];
    assert!(compare(&system, &mut both, &Tolerances::project()).agrees());
    let found = both[0].evidence.ladder.agreed.proof().unwrap().forces_found.clone().unwrap();
    let choices = found.choices.unwrap();
    // 10 N in all four of them, and 8 N more or less.
    let [before, after] = choices.forces_n;
    assert!((before - 5.0).abs() < 1e-12 && ((after - before).abs() - 8.0).abs() < 1e-12);
    let [alone, beside] = seen_from(&system, &right, SELF_STRESS);
    assert!(alone <= 10 && beside <= 10, "{alone} {beside}");
}

/// One member's sign, with all that follows from it, is seen whatever the member bears; so is a load
/// of any joint that is left out, from 1e-9 of it on.
#[test]
fn a_sign_and_a_load_left_out_are_seen() {
    for (k, (system, right)) in systems().iter().enumerate() {
        for member in 0..system.members().len() {
            let turned = added(system, right, |other| {
                if other == member { -2.0 * right.axial_n[other] } else { 0.0 }
            });
            let bears = right.axial_n[member].abs() > 1e-6;
            assert_eq!(seen(system, right, &turned), [bears; 2], "{k} {member}");
        }
        for (joint, of) in system.joints().iter().enumerate() {
            if of.mass_kg <= 0.0 {
                continue;
            }
            for part in [1e-8, 1e-4, 1.0] {
                let mut joints = system.joints().to_vec();
                joints[joint].mass_kg *= 1.0 + part;
                let members = system.members().to_vec();
                let loaded = System::new("loaded", 10.0, joints, members).unwrap();
                let loaded = match system.floor_m() {
                    Some(floor_m) => loaded.with_floor(floor_m).unwrap(),
                    None => loaded,
                };
                assert_eq!(seen(&loaded, right, right), [true; 2], "{k} {joint} {part}");
            }
        }
    }
}

/// Forces in balance that exceed all that acts are a finding from a million times it on, and no answer
/// from a billion times it on.
#[test]
fn forces_beyond_all_that_acts_are_a_finding_and_then_no_answer() {
    let (system, mut right) = tetrapod();
    right.evidence.self_stresses = None;
    let load_n = system.total_load_n();
    let found = |times_load: f64| {
        let axial = |k: usize| [1.0, 1.0, -1.0, -1.0][k] * times_load * load_n;
        let altered = added(&system, &right, axial);
        let mut both = [altered.clone(), twin(&altered)];
        let agreed = compare(&system, &mut both, &Tolerances::project());
        let proof = both[0].evidence.ladder.agreed.proof().cloned();
        (agreed, proof.and_then(|proof| proof.forces_found).and_then(|found| found.large))
    };
    // A power of two is exact, and the legs stay in balance.
    let (agreed, large) = found(2.0_f64.powi(19));
    assert!(agreed.agrees() && large.is_none(), "{}", agreed.disagreement);
    let (agreed, large) = found(2.0_f64.powi(21));
    let large = large.unwrap();
    assert!(agreed.agrees() && large.member == 1, "{}", agreed.disagreement);
    assert!((large.ratio / 2.0_f64.powi(21) - 1.0).abs() < 1e-6, "{large:?}");
    let (agreed, _) = found(2.0_f64.powi(31));
    let told = |e: &model::Excess| matches!(e.what, model::Quantity::LargeForce { member: 1, .. });
    assert!(agreed.disagreement.excesses.iter().any(told), "{}", agreed.disagreement);
}
