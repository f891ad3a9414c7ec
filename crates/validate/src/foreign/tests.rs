//! The judge of foreign answers on closed forms, right and tampered with.

use model::system::{Joint, Kind, Member, PointLoad, System, SystemEquilibrium};
use model::{Bar, Place, SolverName};
use numerics::vector::times;

use super::best_forces::best_forces;
use super::bounds::{Bounds, TOLERANCE};
use super::least_squares::{Column, Problem};
use super::proved::proved_error;
use super::{Finding, ForcesJudged, ForeignAnswer, GivenError, Judgement, Law, judge_foreign};
use crate::systems::placed::placed;

/// A lamp of 2 N on two massless cables of 5 m between anchors 6 m apart (3, 4, 5): each pulls with
/// 5/4 N.
pub(super) fn lamp() -> System {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.2]);
    let body = Bar::homogeneous(5.0, 0.0).unwrap();
    System::new("lamp", 10.0, joints, vec![Member::cable(0, 2, body), Member::cable(2, 1, body)])
        .unwrap()
}

fn places(lamp_m: [f64; 3]) -> Vec<[f64; 3]> {
    vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], lamp_m]
}

fn judged(system: &System, joints_m: Vec<[f64; 3]>, axial_n: Option<Vec<f64>>) -> Judgement {
    let answer = ForeignAnswer::in_order(system, "a table", joints_m, axial_n).unwrap();
    judge_foreign(system, &answer, TOLERANCE, &|_| {}).unwrap()
}

#[test]
fn a_closed_form_is_confirmed_with_and_without_forces() {
    let system = lamp();
    for forces in [None, Some(vec![1.25, 1.25])] {
        let found = judged(&system, places([0.0, 0.0, -4.0]), forces.clone());
        assert_eq!(found.finding, Finding::Confirmed, "{found:?}");
        assert!(found.largest < 1e-6 && found.violations.is_empty());
        assert!(found.answer.axial_n.iter().all(|force| (force - 1.25).abs() < 1e-12), "{found:?}");
        assert_eq!(found.ladder.highest(), Some(model::Rung::Optimal));
        assert!(found.nearest().unwrap().joints_m < 1e-12);
        assert_eq!(forces.is_some(), found.forces == ForcesJudged::Given);
    }
}

#[test]
fn digits_beyond_the_tolerance_do_not_count() {
    let found = judged(&lamp(), places([1e-7, 0.0, -4.000_000_1]), Some(vec![1.250_000_1, 1.25]));
    assert_eq!(found.finding, Finding::Confirmed, "{found:?}");
    let answer = ForeignAnswer::in_order(&lamp(), "x", places([1e-7, 0.0, -4.0]), None).unwrap();
    let strict = judge_foreign(&lamp(), &answer, 1e-9, &|_| {}).unwrap();
    assert_eq!(strict.finding, Finding::Refuted);
}

/// The only law broken.
fn only(found: &Judgement) -> (Place, Law) {
    assert_eq!(found.finding, Finding::Refuted, "{found:?}");
    assert_eq!(found.violations.len(), 1, "{:?}", found.violations);
    (found.violations[0].place, found.violations[0].law)
}

/// What is measured of places and forces is held against each law: here a support and signs.
#[test]
fn what_is_broken_is_told_with_its_numbers() {
    let system = lamp();
    let mut moved = places([0.0, 0.0, -4.0]);
    moved[0][1] = 1e-3;
    let found = judged(&system, moved, Some(vec![1.25; 2]));
    assert!(found.violations.iter().any(|v| v.place == Place::Joint(0)
        && v.law == Law::Support
        && (v.value - 1e-3).abs() < 1e-15));
    // The arch: cables that push.
    let found = judged(&system, places([0.0, 0.0, 4.0]), Some(vec![-1.25; 2]));
    let signs = found.violations.iter().filter(|v| matches!(v.law, Law::Sign { .. }));
    assert_eq!(signs.count(), 2);
    assert_eq!(found.violations.len(), 2, "{:?}", found.violations);
}

/// Without forces the arch of cables has none: the best ones are zero, and leave the whole lamp.
#[test]
fn no_forces_hold_an_arch_of_cables() {
    let found = judged(&lamp(), places([0.0, 0.0, 4.0]), None);
    let ForcesJudged::Found(best) = &found.forces else { panic!("{found:?}") };
    assert!((best.residual_n - 2.0).abs() < 1e-12 && best.largest_n < 1e-12, "{best:?}");
    let (place, law) = only(&found);
    assert_eq!(place, Place::Joint(2));
    assert!(matches!(law, Law::Balance { left_n } if (left_n[2] + 2.0).abs() < 1e-12));
    // The nearest equilibrium is 8 m away, below the anchors.
    assert!((found.nearest().unwrap().joints_m - 8.0).abs() < 1e-9, "{:?}", found.nearest);
}

/// A weight of 3 N on a spring of 1 m with 6 N: it stretches by half a metre.
#[test]
fn an_elastic_member_must_have_the_force_of_its_elongation() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(0.3)];
    let body = Bar::homogeneous(1.0, 0.0).unwrap();
    let spring = Member::cable(0, 1, body).with_stiffness(6.0);
    let system = System::new("spring", 10.0, joints, vec![spring]).unwrap();
    let at = |z: f64| vec![[0.0; 3], [0.0, 0.0, z]];
    assert!(judged(&system, at(-1.5), None).is_confirmed());
    assert!(judged(&system, at(-1.5), Some(vec![3.0])).is_confirmed());
    let found = judged(&system, at(-1.4), Some(vec![3.0]));
    let (place, law) = only(&found);
    assert_eq!(place, Place::Member(1));
    assert!(matches!(law, Law::Elongation { elastic_n, .. } if (elastic_n - 2.4).abs() < 1e-12));
    // Without forces the spring has that of its elongation, and 0.6 N are left over.
    let found = judged(&system, at(-1.4), None);
    let (place, _) = only(&found);
    assert_eq!(place, Place::Joint(1));
    assert!((found.violations[0].value - 0.6).abs() < 1e-4, "{:?}", found.violations);
}

/// A square net of cables with loads: some go slack; forces from the shape alone are those of the
/// solver.
#[test]
fn forces_are_found_from_the_shape_of_a_net() {
    const SIDE: usize = 7;
    let system = net(SIDE);
    let solved = energy::net::minimise(&system, &energy::net::Settings::default()).unwrap();
    let bounds = Bounds::of_positions(&system, &solved.equilibrium.joints_m, 1e-9);
    let best = best_forces(&system, &solved.equilibrium.joints_m, &bounds);
    let largest = solved.equilibrium.axial_n.iter().fold(0.0, |a: f64, b| a.max(*b));
    assert!(best.converged && best.residual_n < 1e-9 * largest, "{best:?}");
    assert!(best.axial_n.iter().all(|force| *force >= 0.0));
    let slack = best.axial_n.iter().filter(|force| **force <= 0.0).count();
    assert!(slack >= (SIDE - 1) * (SIDE - 1), "{best:?}");
    let found = judged(&system, solved.equilibrium.joints_m, None);
    assert!(found.is_confirmed(), "{} {:?}", found.finding, found.violations);
}

/// A square net hung from its corners and the middles of its sides, with more cable than distance,
/// and a diagonal in every mesh that is too long to be taut.
fn net(side: usize) -> System {
    let name = |i: usize, k: usize| format!("{i},{k}");
    let mut joints = Vec::new();
    for i in 0..side {
        for k in 0..side {
            let held = [0, side / 2, side - 1];
            let rim = i == 0 || k == 0 || i == side - 1 || k == side - 1;
            let joint = if rim && held.contains(&i) && held.contains(&k) {
                Joint::anchor(name(i, k), [i as f64, k as f64, 0.0])
            } else {
                Joint::free(name(i, k)).with_mass(1.0 + 0.1 * ((3 * i + 5 * k) % 7) as f64)
            };
            joints.push(joint);
        }
    }
    let body = |i: usize, k: usize| {
        Bar::homogeneous(1.1 + 0.02 * ((2 * i + 3 * k) % 5) as f64, 0.0).unwrap()
    };
    let mut members = Vec::new();
    for i in 0..side {
        for k in 0..side {
            let here = i * side + k;
            if i + 1 < side {
                members.push(Member::cable(here, here + side, body(i, k)));
            }
            if k + 1 < side {
                members.push(Member::cable(here, here + 1, body(k, i)));
            }
            if i + 1 < side && k + 1 < side {
                let long = Bar::homogeneous(2.5, 0.0).unwrap();
                members.push(Member::cable(here, here + side + 1, long));
            }
        }
    }
    System::new("net", 9.81, joints, members).unwrap()
}

#[test]
fn names_that_do_not_fit_are_told() {
    let system = lamp();
    let named = |name: &str| (name.to_owned(), [0.0; 3]);
    let error = |names: &[&str]| {
        ForeignAnswer::by_name(&system, "x", names.iter().map(|name| named(name))).unwrap_err()
    };
    assert!(
        matches!(error(&["A", "B", "Q"]), GivenError::UnknownJoint { name, .. } if name == "Q")
    );
    assert!(matches!(error(&["A", "A"]), GivenError::Repeated(name) if name == "A"));
    let missing = error(&["B"]);
    assert_eq!(missing.to_string(), "the answer has no place for joint \"P\"");
    // Anchors are where the system has them.
    let found = ForeignAnswer::by_name(&system, "x", [("P".to_owned(), [0.0, 0.0, -4.0])]).unwrap();
    assert_eq!(found.joints_m, places([0.0, 0.0, -4.0]));
    let nan = ForeignAnswer::by_name(&system, "x", [("A".to_owned(), [f64::NAN; 3])]);
    assert!(matches!(nan, Err(GivenError::NotFinite(_))));
    let answer = ForeignAnswer::in_order(&system, "x", vec![[0.0; 3]; 3], None).unwrap();
    let missing = answer.with_forces(&system, [("A".to_owned(), "P".to_owned(), 1.0)]);
    assert!(matches!(missing, Err(GivenError::MissingForces { count: 1, .. })));
}

/// A lamp on two cables, 4 m deep: the error of an answer a centimetre too low is enclosed, in
/// places and in forces.
#[test]
fn the_error_of_an_answer_is_enclosed_by_proof() {
    let joints = vec![
        Joint::anchor("A", [-3.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::free("lamp").with_mass(0.2).with_force([0.0, 1.0, 0.0]),
    ];
    let body = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
    let system = System::new("lamp", 10.0, joints, members).unwrap();
    // The plane of the cables leans by 1 to 2, and they bear |load| 5/8.
    let load = 5.0_f64.sqrt();
    let (aside, down) = (4.0 / load, 8.0 / load);
    let at = vec![[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, aside, -down - 0.01]];
    let axial_n = Some(vec![0.625 * load, 0.625 * load + 0.25]);
    let answer = ForeignAnswer::in_order(&system, "a table", at, axial_n).unwrap();
    let judged = judge_foreign(&system, &answer, 1e-6, &|_| {}).unwrap();
    let nearest = judged.nearest().unwrap();
    let proved = nearest.proved.unwrap();
    for ([least, most], wanted) in [(proved.joints_m, 0.01), (proved.forces_n, 0.25)] {
        assert!(least <= wanted + 1e-15 && wanted <= most + 1e-15, "{proved:?}");
        assert!(most - least < 1e-12, "{proved:?}");
    }
    let json = serde_json::to_value(nearest).unwrap();
    assert!(json["proved"]["joints_m"][0].as_f64().unwrap() > 0.0099);
}

/// A spring of 1 m and 6 N, drawn by 3 N and 1/2 m: `F²l/2EA` are 3/4 J, less 3 N times 1.5 m. As a
/// cable half a metre too short it has nothing but the weight.
#[test]
fn the_energy_of_a_spring_is_that_of_its_force() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(0.3)];
    let spring = Member::cable(0, 1, Bar::homogeneous(1.0, 0.0).unwrap()).with_stiffness(6.0);
    let system = System::new("spring", 10.0, joints, vec![spring]).unwrap();
    for (z, axial_n, energy_j) in [(-1.5, 3.0, 0.75 - 4.5), (-0.5, 0.0, -1.5)] {
        let at_m = [[0.0; 3], [0.0, 0.0, z]];
        let found = placed(&system, &SolverName::new("a table"), &at_m, &[axial_n]);
        assert!((found.energy_j - energy_j).abs() < 1e-14, "{}", found.energy_j);
        assert!((found.reactions_n[0][2] - axial_n).abs() < 1e-14);
    }
}

/// Two cables pull at one joint, along `(1, 0, 0)` and `(0.8, 0.6, 0)`, against `(1, -0.6, 0)`: both
/// together would need the second to push 1 N and the first 1.8 N. Without that the first alone
/// leaves least, 0.6 N across it, with 1 N.
#[test]
fn a_force_at_its_bound_that_is_pushed_beyond_it_stays_there() {
    let column = |end: usize, unit: [f64; 3]| Column {
        pulls: vec![(0, unit), (end, times(-1.0, unit))],
        lower: 0.0,
        upper: f64::INFINITY,
    };
    let columns = [column(1, [1.0, 0.0, 0.0]), column(2, [0.8, 0.6, 0.0])];
    let free = |joint: usize, force: [f64; 3]| if joint == 0 { force } else { [0.0; 3] };
    // In newtons, micronewtons and meganewtons, or so.
    for scale in [1.0, 2.0_f64.powi(-20), 2.0_f64.powi(20)] {
        let loads = [[-scale, 0.6 * scale, 0.0], [0.0; 3], [0.0; 3]];
        let problem = Problem { columns: &columns, loads: &loads, free: &free };
        let found = problem.solve();
        // 0.6 N is also what is proved of all forces up to 100 N, and no more.
        let least = problem.least(&found, 100.0 * scale) / scale;
        assert!((least - 0.6).abs() < 1e-5 && least <= 0.6, "{scale}: {least}");
        let (x, left) = ([found.x[0] / scale, found.x[1]], found.left[0].map(|n| n / scale));
        assert!((x[0] - 1.0).abs() < 1e-8 && x[1].abs() <= 0.0, "{scale}: {x:?}");
        assert!((left[1] - 0.6).abs() < 1e-12 && left[0].abs() < 1e-8, "{scale}: {left:?}");
    }
}

/// No error is proved of an answer that has a place or a force too few, or a number that is none.
#[test]
fn the_error_of_what_does_not_fit_is_not_enclosed() {
    let system = lamp();
    let settings = energy::net::Settings::default();
    let found = energy::net::minimise(&system, &settings).unwrap().equilibrium;
    let proved = |change: fn(&mut SystemEquilibrium)| {
        let mut answer = found.clone();
        change(&mut answer);
        proved_error(&system, &answer, &found)
    };
    assert!(proved(|_| ()).unwrap().joints_m[1] < 1e-12);
    assert_eq!(proved(|a| a.joints_m.truncate(2)), None);
    assert_eq!(proved(|a| a.axial_n.truncate(1)), None);
    assert_eq!(proved(|a| a.joints_m[2][0] = f64::NAN), None);
    assert_eq!(proved(|a| a.axial_n[1] = f64::INFINITY), None);
}

/// 3 N on a strut of 2 m, as long as its length is: it bears them. Drawn longer it bears nothing.
#[test]
fn a_strut_bears_what_presses_it() {
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(0.3)];
    let rod = Member::bar(0, 1, Bar::homogeneous(2.0, 0.0).unwrap());
    let strut = rod.of_kind(Kind::Strut);
    let system = System::new("prop", 10.0, joints, vec![strut]).unwrap();
    for (z, wanted_n) in [(2.0, -3.0), (2.5, 0.0)] {
        let at_m = [[0.0; 3], [0.0, 0.0, z]];
        let best = best_forces(&system, &at_m, &Bounds::of_positions(&system, &at_m, 1e-6));
        assert!((best.axial_n[0] - wanted_n).abs() < 1e-9, "{best:?}");
        assert!((best.residual_n - (3.0 + wanted_n)).abs() < 1e-9, "{best:?}");
    }
}

/// The lamp is 6 m large, from the first anchor to the second, and 4 m at most from the origin: a
/// millionth of the one, and 8 units in the last place of the larger.
#[test]
fn positions_are_known_to_the_tolerance_and_to_rounding() {
    let system = lamp();
    let stored = 8.0 * f64::EPSILON;
    let bounds = Bounds::of_positions(&system, &places([0.0, 0.0, -4.0]), 1e-6);
    assert!((bounds.position_m / (6e-6 + 6.0 * stored) - 1.0).abs() < 1e-13);
    let bounds = bounds.with_largest_force(3.0);
    assert!((bounds.force_n / (3e-6 + 3.0 * stored) - 1.0).abs() < 1e-13);
}

/// A load along the only column is balanced but for the rounding of its slope over the ridge, some
/// 1e-7, and its square after the next step. One across is left as it is, and next to one as large
/// as that there soon is no gain.
#[test]
fn the_search_ends_with_nothing_left_or_nothing_gained() {
    let columns = [Column {
        pulls: vec![(0, [1.0, 0.0, 0.0]), (1, [-1.0, 0.0, 0.0])],
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    }];
    let free = |joint: usize, force: [f64; 3]| if joint == 0 { force } else { [0.0; 3] };
    for across in [0.0, 0.03, 0.5] {
        let loads = [[-3.0, across, 0.0], [0.0; 3]];
        let found = Problem { columns: &columns, loads: &loads, free: &free }.solve();
        assert!((found.x[0] - 3.0).abs() < 1e-8, "{found:?}");
        assert!(found.left[0][0].abs() < 1e-8 && (found.left[0][1] - across).abs() < 1e-15);
        assert!((1..=3).contains(&found.steps), "{across}: {}", found.steps);
    }
}

/// A spring between two joints that are known to 1/4 m each has the force of any elongation in
/// reach; a rigid cable that is clearly shorter, and a strut that is clearly longer, none.
#[test]
fn forces_are_searched_within_the_reach_of_the_places() {
    let bounds = Bounds { tolerance: 0.0, position_m: 0.25, force_n: 0.0 };
    // A joint 4 m above or below its anchor that is drawn up by 10 N: whatever the member bears up to
    // its bounds is left over.
    let force = |kind: Kind, stiffness_n: Option<f64>, length_m: f64, up_n: f64| {
        let body = Bar::homogeneous(length_m, 0.0).unwrap();
        let member = Member::bar(0, 1, body).of_kind(kind).with_stiffness(stiffness_n);
        let joints =
            vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_force([0.0, 0.0, up_n])];
        let system = System::new("one", 10.0, joints, vec![member]).unwrap();
        let found = best_forces(&system, &[[0.0; 3], [0.0, 0.0, 4.0]], &bounds);
        let largest_n = found.axial_n[0].abs();
        assert!((found.largest_n - largest_n).abs() < 1e-15 && found.converged, "{found:?}");
        assert!((found.residual_n - (up_n - found.axial_n[0]).abs()).abs() < 1e-9, "{found:?}");
        found.axial_n[0]
    };
    let close =
        |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-8, "{found} {wanted}");
    // 8 N over 2 m, drawn by 2 m: between 6 and 10 N.
    for (up_n, wanted) in [(20.0, 10.0), (9.0, 9.0), (1.0, 6.0)] {
        close(force(Kind::Bar, Some(8.0), 2.0, up_n), wanted);
        close(force(Kind::Cable, Some(8.0), 2.0, up_n), wanted);
        close(force(Kind::Strut, Some(8.0), 2.0, up_n), 0.0);
    }
    // 16 N over 8 m, pressed by 4 m: between -9 and -7 N.
    for (up_n, wanted) in [(-20.0, -9.0), (-8.0, -8.0), (1.0, -7.0)] {
        close(force(Kind::Bar, Some(16.0), 8.0, up_n), wanted);
        close(force(Kind::Cable, Some(16.0), 8.0, up_n), 0.0);
        close(force(Kind::Strut, Some(16.0), 8.0, up_n), wanted);
    }
    for up_n in [10.0, -10.0] {
        for length_m in [3.0, 4.0, 5.0] {
            close(force(Kind::Bar, None, length_m, up_n), up_n);
        }
        for (length_m, taut) in [(3.0, true), (4.5, true), (4.625, false), (5.0, false)] {
            close(force(Kind::Cable, None, length_m, up_n), if taut { up_n.max(0.0) } else { 0.0 });
        }
        for (length_m, tight) in [(5.0, true), (3.5, true), (3.375, false), (3.0, false)] {
            close(
                force(Kind::Strut, None, length_m, up_n),
                if tight { up_n.min(0.0) } else { 0.0 },
            );
        }
    }
}

/// 5 N in a bar along (2, 3, 6)/7 with the loads of its joints: what comes to a joint, what is free
/// there, and what the ground is left with.
#[test]
fn what_follows_from_axial_forces_is_that_of_the_lever_rule() {
    use crate::systems::judge;
    use crate::systems::placed::largest_n;
    let mut bar = Member::bar(0, 1, Bar::new(7.0, 8.0, 1.75, [0.0; 3]).unwrap());
    bar.loads.push(PointLoad { at_m: 4.375, force_n: [5.0, -6.0, 4.0], is_spread: false });
    let along = [0.6, 0.0, 0.8];
    let guide = model::system::Support::Line { at_m: [3.0, 1.0, 11.0], direction: along };
    let joints = vec![
        Joint::anchor("A", [1.0, -2.0, 5.0]),
        Joint::free("B").with_mass(3.0).with_force([2.0, -1.0, 4.0]).held_by(guide),
    ];
    let system = System::new("guided", 10.0, joints, vec![bar]).unwrap();
    let places = [[1.0, -2.0, 5.0], [3.0, 1.0, 11.0]];
    let found = placed(&system, &SolverName::new("a table"), &places, &[14.0]);
    // 14 N are (4, 6, 12) N; A has (15/8, -9/4, -117/2) N of loads, B (41/8, -19/4, -87/2) N.
    assert_eq!(found.start_forces_n, [[-4.0 - 1.875, -6.0 + 2.25, -12.0 + 58.5]]);
    assert_eq!(found.end_forces_n, [[4.0 - 3.125, 6.0 + 3.75, 12.0 - (-20.0 + 2.5)]]);
    assert_eq!(found.reactions_n[..1], [[-4.0 - 1.875, -6.0 + 2.25, -12.0 + 58.5]]);
    // B has (9/8, -43/4, -111/2) N, of which 0.6 and 0.8 of 0.675 - 44.4 N are free.
    let free = 0.675 - 44.4;
    let wanted = [-1.125 + 0.6 * free, 10.75, 55.5 + 0.8 * free];
    for (found, wanted) in found.reactions_n[1].into_iter().zip(wanted) {
        assert!((found - wanted).abs() < 1e-14, "{found}, not {wanted}");
    }
    // 155 + 120 - 10 J, as by the judge.
    assert!((found.energy_j - 265.0).abs() < 1e-12, "{}", found.energy_j);
    let judged = judge(&system, &found);
    assert!(judged.force < 1e-14 && judged.moment < 1e-14 && judged.derived < 1e-14, "{judged:?}");
    let largest = (5.875_f64.powi(2) + 3.75_f64.powi(2) + 46.5_f64.powi(2)).sqrt();
    let load = (1.875_f64.powi(2) + 2.25_f64.powi(2) + 58.5_f64.powi(2)).sqrt();
    assert!((largest_n(&system, &found) - load.max(largest)).abs() < 1e-13);
    let pulled = placed(&system, &SolverName::new("a table"), &places, &[-1000.0]);
    assert!((largest_n(&system, &pulled) - 1000.0).abs() < 60.0);
}

/// 3 N are balanced as above. Beside them 1e-9 N are across two members so nearly in one line that
/// the ridge leaves a thousandth: 1e-12, 1e-15 and 1e-18 N, the last of which is rounding beside 3 N.
#[test]
fn the_search_ends_where_rounding_is_left() {
    let (along, across) = (0.999_999_5_f64.sqrt(), 0.5e-6_f64.sqrt());
    let column = |[a, b]: [usize; 2], unit: [f64; 3]| Column {
        pulls: vec![(a, unit), (b, times(-1.0, unit))],
        lower: f64::NEG_INFINITY,
        upper: f64::INFINITY,
    };
    let columns = [
        column([0, 2], [1.0, 0.0, 0.0]),
        column([1, 3], [along, across, 0.0]),
        column([1, 4], [along, -across, 0.0]),
    ];
    let free = |joint: usize, force: [f64; 3]| if joint < 2 { force } else { [0.0; 3] };
    let loads = [[-3.0, 0.0, 0.0], [0.0, 1e-9, 0.0], [0.0; 3], [0.0; 3], [0.0; 3]];
    let found = Problem { columns: &columns, loads: &loads, free: &free }.solve();
    assert_eq!(found.steps, 3, "{found:?}");
    assert!(found.left[1][1].abs() < 2e-18, "{found:?}");
}
