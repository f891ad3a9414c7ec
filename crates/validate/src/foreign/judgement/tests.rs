//! What a judgement comes to.

use model::system::{Joint, Member};
use model::{Bar, Vector};

use super::super::tests::lamp;
use super::super::violation::Law;
use super::*;
use crate::Solvers;
use crate::systems::ask;
use crate::systems::placed::placed as completed_by;
use numerics::vector::minus;

const KNOWN: Bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.5 };

fn at_rest(solver: &SolverName) -> SystemEquilibrium {
    let places = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    completed_by(&lamp(), solver, &places, &[1.25; 2])
}

/// An equilibrium so far away, with such forces.
fn one(joints_m: f64, forces_n: f64, forces_unique: Option<bool>) -> NearestEquilibrium {
    NearestEquilibrium {
        equilibrium: at_rest(&SolverName::ENERGY),
        joints_m,
        joint: 2,
        forces_n,
        member: 1,
        energy_j: -0.125,
        forces_unique,
        proved: None,
    }
}

fn near(equilibria: Vec<NearestEquilibrium>) -> Nearest {
    Nearest { equilibria, failures: vec![], without_guess: false }
}

fn given(axial_n: Option<Vec<f64>>) -> ForeignAnswer {
    let joints_m = at_rest(&SolverName::ENERGY).joints_m;
    ForeignAnswer::in_order(&lamp(), "a table", joints_m, axial_n).unwrap()
}

fn broken() -> Measured {
    let mut broken = Measured::default();
    broken.note(Place::Joint(2), Law::Support, 3.0, 2.0);
    broken
}

#[test]
fn what_an_answer_comes_to_is_told_in_its_order() {
    let told = |answer: &ForeignAnswer, measured: &Measured, nearest| {
        let at_rest = at_rest(&SolverName::ENERGY);
        finding(&lamp(), answer, (&at_rest, measured), &nearest, &KNOWN)
    };
    let (with, without) = (given(Some(vec![1.25; 2])), given(None));
    let right = Measured::default();
    let open = Measured { open: true, ..Measured::default() };
    let simply = |nearest| told(&with, &right, nearest);
    assert_eq!(told(&with, &broken(), near(vec![])), Finding::Refuted);
    assert_eq!(told(&without, &open, near(vec![])), Finding::ForcesNotFound);
    assert_eq!(told(&without, &right, near(vec![])), Finding::NoEquilibrium);
    assert_eq!(simply(near(vec![])), Finding::NoEquilibrium);
    let far = |joints_m: f64| Finding::Far { joints_m, allowed_m: 0.25 };
    assert_eq!(simply(near(vec![one(0.25, 0.0, Some(true))])), Finding::Confirmed);
    assert_eq!(simply(near(vec![one(0.26, 0.0, Some(true))])), far(0.26));
    assert_eq!(simply(near(vec![one(0.3, 0.0, None), one(0.1, 0.0, None)])), far(0.3));
    let Finding::Far { joints_m, .. } = simply(near(vec![one(f64::NAN, 0.0, None)])) else {
        panic!()
    };
    assert!(joints_m.is_nan());
    let other = Finding::OtherForces { forces_n: 0.75, allowed_n: 0.5 };
    assert_eq!(simply(near(vec![one(0.1, 0.75, Some(true))])), other);
    assert_eq!(simply(near(vec![one(0.1, 0.5, Some(true))])), Finding::Confirmed);
    for unique in [Some(false), None] {
        assert_eq!(simply(near(vec![one(0.1, 0.75, unique)])), Finding::Confirmed);
    }
    let found = told(&without, &right, near(vec![one(0.1, 0.75, Some(true))]));
    assert_eq!(found, Finding::Confirmed);
}

/// Of an equilibrium that both solvers found those within the tolerance stand behind the answer.
#[test]
fn who_stands_behind_an_answer_is_told() {
    let mut found = one(0.125, 0.25, Some(true));
    let own = Agreed {
        solvers: vec![SolverName::LAGRANGE, SolverName::ENERGY],
        joints_m: 1.0,
        forces_n: 2.0,
        energy_j: 3.0,
        statics: 4.0,
        room: None,
        shape_only: true,
        forces_found: None,
    };
    found.equilibrium.evidence.ladder.agreed = Status::Reached(own.clone());
    let source = SolverName::new("a table");
    let told = |others: Vec<NearestEquilibrium>, found: &NearestEquilibrium| {
        let all = std::iter::once(found.clone()).chain(others).collect();
        let told = agreed(&at_rest(&source), &near(all), &KNOWN, found);
        told.proof().unwrap().clone()
    };
    let wanted = |solvers: usize, shape_only: bool| Agreed {
        solvers: std::iter::once(source.clone()).chain(vec![SolverName::ENERGY; solvers]).collect(),
        joints_m: 0.125,
        forces_n: 0.25,
        energy_j: 0.125,
        shape_only,
        ..own.clone()
    };
    assert_eq!(told(vec![], &found), wanted(1, false));
    assert_eq!(told(vec![one(0.25, 0.0, None)], &found), wanted(2, false));
    assert_eq!(told(vec![one(0.26, 0.0, None)], &found), wanted(1, false));
    found.forces_unique = Some(false);
    assert_eq!(told(vec![], &found), wanted(1, true));
    // What the equilibrium itself has not reached, the answer has not.
    let open = one(0.125, 0.25, None);
    let told = agreed(&at_rest(&source), &near(vec![open.clone()]), &KNOWN, &open);
    assert_eq!(told, open.equilibrium.evidence.ladder.agreed);
}

#[test]
fn rungs_that_are_not_reached_say_why() {
    let (system, answer) = (lamp(), at_rest(&SolverName::new("a table")));
    let of = |finding: Finding, measured: &Measured, nearest: Vec<NearestEquilibrium>| {
        ladder(&system, &answer, finding, measured, &near(nearest), &KNOWN)
    };
    let right = Measured::default();
    let between = [SolverName::new("a table"), SolverName::ENERGY];
    let apart = |what: Quantity, value: f64, budget: f64| {
        let excesses = vec![Excess { what, value, budget }];
        Some(Reason::SolversDisagree(Disagreement { excesses }))
    };

    let far = of(
        Finding::Far { joints_m: 0.75, allowed_m: 0.25 },
        &right,
        vec![one(0.75, 0.0, Some(true))],
    );
    assert!(far.converged.is_reached());
    let joints = Quantity::Joints { between: between.clone() };
    assert_eq!(far.agreed.reason().cloned(), apart(joints, 0.75, 0.25));

    let other = Finding::OtherForces { forces_n: 0.75, allowed_n: 0.625 };
    let other = of(other, &right, vec![one(0.1, 0.75, Some(true))]);
    assert_eq!(other.agreed.reason().cloned(), apart(Quantity::Forces { between }, 0.75, 0.625));

    // Loads of 2 N beside 3e9 N, of which half a newton is known.
    let hidden = Finding::LoadsHidden { member: 2, force_n: -3e9, loads_n: 2.0, allowed_n: 0.5 };
    let hidden = of(hidden, &right, vec![one(0.1, 3e9, Some(false))]);
    let Some(Reason::JudgeRefuses { excesses }) = hidden.agreed.reason() else { panic!() };
    let what = Quantity::LargeForce { solver: SolverName::new("a table"), member: 2 };
    assert_eq!(excesses[..], [Excess { what, value: 1.5e9, budget: 1e9 }]);

    let refuted = of(Finding::Refuted, &broken(), vec![one(0.75, 0.0, Some(true))]);
    let Some(Reason::JudgeRefuses { excesses }) = refuted.agreed.reason() else { panic!() };
    let place = Place::Joint(2);
    let what = Quantity::Statics { solver: SolverName::new("a table"), place };
    assert_eq!(excesses[..], [Excess { what, value: 1.5, budget: 1.0 }]);
    let Some(Reason::AboveTolerance(convergence)) = refuted.converged.reason() else { panic!() };
    assert_eq!((convergence.residual, convergence.tolerance), (1.5, Some(1.0)));

    let nowhere = of(Finding::NoEquilibrium, &right, vec![]);
    assert_eq!(nowhere.agreed, Status::Open(Reason::NotTried));

    // Of one that is confirmed they are those of the equilibrium.
    let mut found = one(0.1, 0.0, Some(true));
    let own = &mut found.equilibrium.evidence.ladder;
    own.verified = Status::Open(Reason::SlackFamily);
    own.complete = Status::Open(Reason::NothingListed);
    own.optimal = Status::Open(Reason::Elsewhere { distance: 0.5 });
    let wanted = own.clone();
    let confirmed = of(Finding::Confirmed, &right, vec![found]);
    assert!(confirmed.converged.is_reached());
    assert_eq!(confirmed.verified, wanted.verified);
    assert_eq!(confirmed.complete, wanted.complete);
    assert_eq!(confirmed.optimal, wanted.optimal);
}

#[test]
fn tolerances_have_their_range() {
    let answer = given(None);
    for (tolerance, right) in
        [(0.99e-13, false), (1e-13, true), (0.1, true), (0.101, false), (f64::NAN, false)]
    {
        let judged = judge_foreign(&lamp(), &answer, tolerance, &|_| {});
        assert_eq!(judged.is_ok(), right, "{tolerance}");
    }
}

/// 1 kg on two cables of 5 m, 4 m deep: 9.81/2 N times 5/4 in each, 6.13125 N.
#[test]
fn forces_of_few_digits_are_judged_as_such_where_their_own_laws_ask_for_it() {
    let of = lamp();
    let mut joints = of.joints().to_vec();
    joints[2].mass_kg = 1.0;
    let system = System::new("lamp", 9.81, joints, of.members().to_vec()).unwrap();
    let judged = |deep_m: f64, force_n: f64| {
        let at = vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -deep_m]];
        let answer = ForeignAnswer::in_order(&system, "x", at, Some(vec![force_n; 2])).unwrap();
        judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap()
    };
    let printed = judged(4.0, 6.13);
    assert_eq!((printed.finding, printed.force_digits), (Finding::Confirmed, Some(3)));
    assert!((printed.bounds.force_n - 0.005).abs() < 1e-15);
    // 0.03 N are left, and half a unit in each cable and of the load explains 0.015 N.
    let wrong = judged(4.0, 6.15);
    assert_eq!((wrong.finding, wrong.force_digits), (Finding::Refuted, None));
    assert!((wrong.bounds.force_n - 9.81e-6).abs() < 1e-13);
    // Of nearly level cables the balance hardly feels half a unit: 190.0173 N = 9.81/2 N * 3.001/(3.001^2 - 9)^(1/2).
    let body = Bar::homogeneous(3.001, 0.0).unwrap();
    let lengths = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
    let level = System::new("level", 9.81, system.joints().to_vec(), lengths).unwrap();
    for (force_n, wanted) in [(190.02, Some(5)), (190.017_322, None), (190.03, None)] {
        let at =
            vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -(3.001_f64.powi(2) - 9.0).sqrt()]];
        let answer = ForeignAnswer::in_order(&level, "x", at, Some(vec![force_n; 2])).unwrap();
        let found = judge_foreign(&level, &answer, 1e-6, &|_| {}).unwrap();
        assert_eq!(found.force_digits, wanted, "{force_n}");
        assert_eq!(found.finding == Finding::Confirmed, force_n < 190.03, "{:?}", found.finding);
    }
    // Enough digits need no help, and a wrong place gets none.
    assert_eq!(judged(4.0, 6.13125).force_digits, None);
    let low = judged(4.001, 6.13);
    assert_eq!((low.finding, low.force_digits), (Finding::Refuted, None));
    // A millimetre of 6 m: more than 1e-4, less than 1e-3.
    assert_eq!(low.confirmed_at, Some(1e-3));
    assert_eq!(printed.confirmed_at, None);
    // The arch is 8 m off, and no tolerance explains that.
    assert_eq!(judged(-4.0, -6.13).confirmed_at, None);
}

/// Four legs of which the places are right and the forces off along their self-stress: places known to 1e-6 of the size would make
/// a difference of EA/l times as much, and are no reason to take them.
#[test]
fn forces_off_by_a_self_stress_of_stiff_members_are_not_confirmed() {
    let anchors = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.5], [2.0, 3.0, 0.2], [2.0, -3.0, 0.3]];
    let p = [2.0, 0.0, -1.25];
    let joints = anchors.iter().enumerate().map(|(k, at)| Joint::anchor(format!("{k}"), *at));
    let joints: Vec<Joint> = joints.chain([Joint::free("P").with_mass(100.0).near(p)]).collect();
    let length_m = |at: &Vector| norm(minus(*at, p));
    let leg = |(k, at): (usize, &Vector)| {
        Member::bar(k, 4, Bar::homogeneous(length_m(at), 0.0).unwrap()).with_stiffness(1e9)
    };
    let members = anchors.iter().enumerate().map(leg).collect();
    let system = System::new("legs", 10.0, joints, members).unwrap();
    let found = ask(&system, Solvers::Both, &|_| {}).equilibria.remove(0);
    // By hand: sums of forces along x, y and z vanish for these times the lengths.
    let stress = [-1.0, -1.0, 1.0, 1.0];
    let judged = |size: f64| {
        let axial = found.axial_n.iter().zip(&anchors).zip(stress);
        let axial = axial.map(|((n, at), s)| n + size * s * length_m(at)).collect();
        let places = found.joints_m.clone();
        let answer = ForeignAnswer::in_order(&system, "a table", places, Some(axial)).unwrap();
        judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap().finding
    };
    assert_eq!(judged(0.0), Finding::Confirmed);
    assert!(matches!(judged(1.0), Finding::OtherForces { .. }), "{:?}", judged(1.0));
}
