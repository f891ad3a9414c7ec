//! Measures against what is allowed, exactly at the bound too.

use model::Bar;
use model::system::Joint;

use super::super::{Finding, ForcesJudged, ForeignAnswer, judge_foreign};
use super::*;

#[test]
fn measures_are_told_in_units_of_what_is_allowed() {
    let noted = |value: f64, allowed: f64| {
        let mut found = Measured::default();
        found.note(Place::Whole, Law::Support, value, allowed);
        (found.largest.to_bits(), found.violations.len())
    };
    let told = |largest: f64, violations: usize| (largest.to_bits(), violations);
    assert_eq!(noted(3.0, 2.0), told(1.5, 1));
    assert_eq!(noted(1.0, 4.0), told(0.25, 0));
    // What the tolerance explains to the last digit is no violation.
    assert_eq!(noted(2.0, 2.0), told(1.0, 0));
    assert_eq!(noted(-1.0, 2.0), told(0.0, 0));
}

/// A cable and a strut of 5 m; their ends are known to 0.25 m each, and forces exactly.
#[test]
fn a_member_is_slack_where_both_ends_together_do_not_explain_it() {
    let bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.0 };
    let told = |kind: Kind, distance_m: f64, force_n: f64| {
        let member = Member::bar(0, 1, Bar::homogeneous(5.0, 0.0).unwrap()).of_kind(kind);
        let mut found = Measured::default();
        law(&member, distance_m, Some(force_n), &bounds, Place::Member(1), &mut found);
        found.violations.iter().map(|violation| violation.law).collect::<Vec<_>>()
    };
    let broken = |distance_m: f64, force_n: f64| told(Kind::Cable, distance_m, force_n);
    assert_eq!(broken(4.5, 2.0), []);
    let slack = Law::Slack { force_n: 2.0, length_m: 5.0, distance_m: 4.25 };
    assert_eq!(broken(4.25, 2.0), [slack]);
    assert_eq!(broken(4.25, 0.0), []);
    assert_eq!(broken(5.5, 2.0), []);
    assert_eq!(broken(5.75, 2.0), [Law::Length { length_m: 5.0, distance_m: 5.75 }]);
    assert_eq!(broken(4.25, -2.0), [Law::Sign { force_n: -2.0 }]);
    let broken = |distance_m: f64, force_n: f64| told(Kind::Strut, distance_m, force_n);
    assert_eq!(broken(5.5, -2.0), []);
    assert_eq!(broken(4.5, -2.0), []);
    let slack = Law::Slack { force_n: -2.0, length_m: 5.0, distance_m: 5.75 };
    assert_eq!(broken(5.75, -2.0), [slack]);
    assert_eq!(broken(4.25, -2.0), [Law::Length { length_m: 5.0, distance_m: 4.25 }]);
    assert_eq!(broken(5.75, 2.0), [Law::Sign { force_n: 2.0 }]);
}

/// Three metres along the support, and (4, 5) m across.
#[test]
fn a_joint_is_off_its_support_by_what_it_may_not_move() {
    let (at_m, along) = ([1.0, 2.0, 3.0], [0.6, 0.0, 0.8]);
    let at = [1.0 + 1.8 - 3.2, 7.0, 3.0 + 2.4 + 2.4];
    let off = |support: Support| off_support_m(&support, at);
    let close = |found: Option<f64>, wanted: f64| {
        assert!((found.unwrap() - wanted).abs() < 1e-14, "{found:?}, not {wanted}");
    };
    close(off(Support::Line { at_m, direction: along }), 41.0_f64.sqrt());
    close(off(Support::Plane { at_m, normal: along }), 3.0);
    close(off(Support::Fixed { at_m }), 50.0_f64.sqrt());
    assert_eq!(off(Support::Free), None);
}

/// A spring of 5 m and 10 N is known to 2 N/m times half a metre and to half a newton.
#[test]
fn an_elongation_is_known_to_the_places_of_its_ends() {
    let bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.5 };
    let body = Bar::homogeneous(5.0, 0.0).unwrap();
    let spring = Member::bar(0, 1, body).with_stiffness(10.0);
    let told = |force_n: Option<f64>| {
        let mut found = Measured::default();
        law(&spring, 8.0, force_n, &bounds, Place::Member(1), &mut found);
        found
    };
    assert_eq!(told(None), Measured::default());
    let found = told(Some(9.0));
    let law = Law::Elongation { force_n: 9.0, elastic_n: 6.0 };
    let [violation] = found.violations[..] else { panic!("{found:?}") };
    assert_eq!((violation.law, violation.place), (law, Place::Member(1)));
    assert!((violation.value - 3.0).abs() < 1e-15 && (violation.allowed - 1.5).abs() < 1e-15);
    assert!((found.largest - 2.0).abs() < 1e-15);
    assert_eq!(told(Some(4.5)).violations, []);
}

/// The lamp's cables with 5 and 10 N, 5 m long: their directions turn by `1/2` over `5 - 1/4`.
fn lamp_with(axial_n: [f64; 2]) -> (System, SystemEquilibrium) {
    let system = super::super::tests::lamp();
    let places = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
    let source = model::SolverName::new("a table");
    let answer = crate::systems::placed::placed(&system, &source, &places, &axial_n);
    (system, answer)
}

fn held<'a>(system: &'a System, answer: &'a SystemEquilibrium) -> Held<'a> {
    Held { system, answer, bounds: &KNOWN }
}

const KNOWN: Bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.125 };

/// Each joint is known to 1/8 N of its load and of each member, and to the turn of its forces. 5 N
/// along (-3, 0, 4)/5 and 10 N along (3, 0, 4)/5 with 2 N down leave (3, 0, 10) N.
#[test]
fn a_balance_is_known_to_the_forces_that_meet_and_their_turns() {
    let (system, answer) = lamp_with([5.0, 10.0]);
    let turn = 0.5 / 4.75;
    let close = |found: (Vector, f64), wanted: (Vector, f64)| {
        assert!(norm(minus(found.0, wanted.0)) < 1e-14, "{found:?}, not {wanted:?}");
        assert!((found.1 - wanted.1).abs() < 1e-14, "{found:?}, not {wanted:?}");
    };
    let [a, b, p] = held(&system, &answer).balances(None)[..] else { panic!() };
    close(a, ([3.0, 0.0, -4.0], 0.25 + 5.0 * turn));
    close(b, ([-6.0, 0.0, -8.0], 0.25 + 10.0 * turn));
    close(p, ([3.0, 0.0, 10.0], 0.375 + 15.0 * turn));
    let [_, _, p] = held(&system, &answer).balances(Some(100.0))[..] else { panic!() };
    close(p, ([3.0, 0.0, 10.0], 0.375 + 200.0 * turn));

    let mut found = Measured::default();
    held(&system, &answer).balance_given(None, &mut found);
    let [left] = found.violations[..] else { panic!("{found:?}") };
    assert_eq!(left.place, Place::Joint(2));
    assert!((left.value - 109.0_f64.sqrt()).abs() < 1e-14);
    assert!((left.allowed - (0.375 + 15.0 * turn)).abs() < 1e-14);
    // The ground is asked for the opposite of what comes to it, and is 13 N off at A.
    let given = [[-3.0, 5.0, 16.0], [6.0, 0.0, 8.0], [0.0; 3]];
    let mut found = Measured::default();
    held(&system, &answer).balance_given(Some(&given), &mut found);
    let [reaction, _] = found.violations[..] else { panic!("{found:?}") };
    assert_eq!(reaction.place, Place::Joint(0));
    assert!((reaction.value - 13.0).abs() < 1e-14, "{reaction:?}");
    let Law::Reaction { given_n, wanted_n } = reaction.law else { panic!("{reaction:?}") };
    assert_eq!([given_n], given[..1]);
    assert!(norm(minus(wanted_n, [-3.0, 0.0, 4.0])) < 1e-14);
}

/// Of √109 N that are left at the only joint that moves so much is proved of all forces; forces of
/// so many newtons explain it or not.
#[test]
fn what_forces_found_leave_is_a_violation_where_it_is_proved_and_none_explain_it() {
    let (system, answer) = lamp_with([5.0, 10.0]);
    let left = 109.0_f64.sqrt();
    let best = |least_n: f64, up_to_n: f64| BestForces {
        axial_n: answer.axial_n.clone(),
        jams: vec![],
        left_n: vec![[0.0; 3], [0.0; 3], [3.0, 0.0, 10.0]],
        residual_n: left,
        least_n,
        up_to_n,
        largest_n: 10.0,
        steps: 1,
        converged: true,
    };
    let measured = |least_n: f64, up_to_n: f64| {
        let mut found = Measured::default();
        held(&system, &answer).balance_found(&best(least_n, up_to_n), &mut found);
        let allowed = 0.375 + 2.0 * up_to_n * 0.5 / 4.75;
        assert!((found.largest - least_n / allowed).abs() < 1e-13, "{found:?}");
        found
    };
    let enough = (left - 0.375) * 4.75;
    let explained = measured(left, 1.001 * enough);
    assert!(explained.violations.is_empty() && !explained.open);
    let broken = measured(left, 0.999 * enough);
    let [told] = broken.violations[..] else { panic!() };
    assert_eq!(told.place, Place::Joint(2));
    assert!((told.value - left).abs() < 1e-14 && !broken.open);
    // Forces that were found too early prove nothing.
    let unproved = measured(0.9 * left, 0.999 * enough);
    assert!(unproved.violations.is_empty() && unproved.open);
    assert!(measured(0.0, 0.999 * enough).open);
}

/// (3, 4, 12) N too much of the ground beside 2 N of weight; two anchors know 1/8 N each.
#[test]
fn the_whole_is_known_to_the_forces_of_its_supports() {
    let (system, answer) = lamp_with([1.25; 2]);
    let mut found = Measured::default();
    let reactions = [[1.0, 4.0, 13.0], [2.0, 0.0, 1.0], [0.0; 3]];
    held(&system, &answer).whole(&reactions, &mut found);
    let [told] = found.violations[..] else { panic!("{found:?}") };
    assert_eq!((told.place, told.law), (Place::Whole, Law::Whole { left_n: [3.0, 4.0, 12.0] }));
    assert_eq!((told.value, told.allowed, found.largest), (13.0, 0.25, 52.0));
}

#[test]
fn the_worst_is_the_largest_part_of_what_is_allowed() {
    let mut found = Measured::default();
    assert!(found.worst().is_none());
    for (k, (value, allowed)) in [(9.0, 3.0), (8.0, 1.0), (70.0, 10.0)].into_iter().enumerate() {
        found.note(Place::Joint(k), Law::Support, value, allowed);
    }
    assert_eq!(found.worst().unwrap().place, Place::Joint(1));
    assert_eq!(found.largest.to_bits(), 8.0_f64.to_bits());
}

#[test]
fn lengths_are_told_in_metres_and_forces_in_newtons() {
    let length = Law::Length { length_m: 1.0, distance_m: 2.0 };
    assert_eq!([Law::Support, Law::BelowFloor, length].map(|law| law.unit()), ["m"; 3]);
    let others = [
        Law::Sign { force_n: 1.0 },
        Law::FloorPulls { force_n: 1.0 },
        Law::Balance { left_n: [0.0; 3] },
        Law::Elongation { force_n: 1.0, elastic_n: 2.0 },
    ];
    assert_eq!(others.map(|law| law.unit()), ["N"; 4]);
}

/// A weight of 2.5 kg on a rope through a ring of 1.5 kg to an anchor, the ring run down to it: the
/// rope bears both, and its span without length the weight.
#[test]
fn forces_are_found_that_balance_joints_in_one_place() {
    let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
    for support in [Support::Free, plane] {
        let of = |name: &str, mass_kg: f64| Joint::free(name).with_mass(mass_kg).held_by(support);
        let joints = vec![Joint::anchor("A", [0.0; 3]), of("ring", 1.5), of("weight", 2.5)];
        let rope = Member::cable(2, 0, Bar::homogeneous(3.0, 0.0).unwrap()).over(vec![1]);
        let system = System::new("hung", 10.0, joints, vec![rope]).unwrap();
        let judged = |apart_m: f64, axial_n: Option<Vec<f64>>| {
            let at_m = vec![[0.0; 3], [0.0, 0.0, -3.0], [apart_m, 0.0, -3.0 + apart_m]];
            let answer = ForeignAnswer::in_order(&system, "x", at_m, axial_n).unwrap();
            judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap()
        };
        // In one place, and as near as places of six digits tell.
        for apart_m in [0.0, 1e-7, -1e-7] {
            let found = judged(apart_m, None);
            assert_eq!(found.finding, Finding::Confirmed, "{:?}", found.violations);
            assert!((found.answer.axial_n[0] - 40.0).abs() < 1e-6, "{:?}", found.answer.axial_n);
            let ForcesJudged::Found(best) = found.forces else { panic!() };
            let [jam] = best.jams[..] else { panic!("{:?}", best.jams) };
            assert_eq!([jam.member, jam.span], [0, 0]);
            assert!(norm(minus(jam.pull_n, [0.0, 0.0, 25.0])) < 1e-6, "{jam:?}");
        }
        assert_eq!(judged(0.0, Some(vec![40.0])).finding, Finding::Confirmed);
        assert_eq!(judged(0.0, Some(vec![26.0])).finding, Finding::Refuted);
    }
}

/// 5 kg at its pulley, and 3 kg that pull there with 30 N: the span without length would have to bear
/// 50 N.
#[test]
fn a_span_without_length_bears_its_tension_at_most() {
    let joints = vec![
        Joint::anchor("pulley", [0.0, 0.0, 3.0]),
        Joint::free("heavy").with_mass(5.0),
        Joint::free("light").with_mass(3.0),
    ];
    let rope = Member::cable(1, 2, Bar::homogeneous(4.0, 0.0).unwrap()).over(vec![0]);
    let system = System::new("block", 10.0, joints, vec![rope]).unwrap();
    let judged = |[heavy_m, light_m]: [f64; 2], axial_n: Option<f64>| {
        let at_m = vec![[0.0, 0.0, 3.0], [0.0, 0.0, heavy_m], [0.0, 0.0, light_m]];
        let axial_n = axial_n.map(|n| vec![n]);
        let answer = ForeignAnswer::in_order(&system, "x", at_m, axial_n).unwrap();
        judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap()
    };
    let wrong = judged([3.0, -1.0], Some(30.0));
    let [left] = wrong.violations[..] else { panic!("{:?}", wrong.violations) };
    assert_eq!((left.place, left.law.unit()), (Place::Joint(1), "N"));
    assert!((left.value - 50.0).abs() < 1e-9 && (left.allowed - 30.0).abs() < 1e-3, "{left:?}");
    assert_eq!(judged([3.0, -1.0], None).finding, Finding::ForcesNotFound);
    for axial_n in [None, Some(50.0)] {
        let right = judged([-1.0, 3.0], axial_n);
        assert_eq!(right.finding, Finding::Confirmed, "{:?}", right.violations);
        assert!((right.answer.axial_n[0] - 50.0).abs() < 1e-6);
    }
}
