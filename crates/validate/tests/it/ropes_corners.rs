//! Ropes whose rings run together, to pulleys or onto a floor, and ropes along which joints slide: by hand.

use model::system::{Joint, Member, Support, System, SystemEquilibrium};
use model::{Bar, Vector};
use rand::RngExt;
use samples::rope;
use validate::Tolerances;
use validate::systems::{compare, judge};

use crate::common::asked;

fn free(name: &str, mass_kg: f64) -> Joint {
    Joint::free(name).with_mass(mass_kg)
}

fn system(joints: Vec<Joint>, members: Vec<Member>) -> System {
    System::new("by hand", 10.0, joints, members).unwrap()
}

/// Both solvers have an answer, and they agree; the joints whose places are not determined.
fn agreed(system: &System) -> (Vec<SystemEquilibrium>, Vec<String>) {
    let answer = asked(system);
    assert!(answer.agrees() && answer.is_decided(), "{answer:?}");
    assert_eq!(answer.equilibria.len(), 2, "{:?}", answer.failures);
    for found in &answer.equilibria {
        assert!(judge(system, found).largest() < 1e-11);
    }
    (answer.equilibria, answer.agreement.unwrap().undetermined)
}

#[track_caller]
fn near(found: Vector, wanted: Vector) {
    let off = (0..3).map(|k| (found[k] - wanted[k]).abs()).fold(0.0, f64::max);
    let size = wanted.iter().fold(1.0, |most: f64, x| most.max(x.abs()));
    assert!(off < 1e-9 * size, "{found:?}, not {wanted:?}");
}

/// The pulls of the spans without length, each on its first joint.
#[track_caller]
fn jams(found: &SystemEquilibrium, wanted: &[(usize, Vector)]) {
    let spans: Vec<usize> = found.evidence.jams.iter().map(|jam| jam.span).collect();
    assert_eq!(spans, wanted.iter().map(|(span, _)| *span).collect::<Vec<_>>());
    for (jam, (_, pull_n)) in found.evidence.jams.iter().zip(wanted) {
        near(jam.pull_n, *pull_n);
    }
}

/// Two weights over a pulley on a rope of 5 m.
fn over_a_pulley(p_kg: f64, q_kg: f64) -> System {
    let joints = vec![Joint::anchor("A", [0.0; 3]), free("P", p_kg), free("Q", q_kg)];
    system(joints, vec![rope(&[1, 0, 2], 5.0)])
}

#[test]
fn equal_weights_slide_over_their_pulley() {
    let (answers, undetermined) = agreed(&over_a_pulley(3.0, 3.0));
    for found in &answers {
        assert!((found.axial_n[0] - 30.0).abs() < 1e-9 && (found.energy_j + 150.0).abs() < 1e-9);
        near(found.reactions_n[0], [0.0, 0.0, 60.0]);
    }
    // Planted apart by a metre they still slide into each other, and not where one of them is off the vertical.
    let equal = over_a_pulley(3.0, 3.0);
    let at = |p_m: f64, aside_m: f64| {
        let mut moved = answers[0].clone();
        moved.joints_m[1..].copy_from_slice(&[[aside_m, 0.0, -p_m], [0.0, 0.0, p_m - 5.0]]);
        moved.evidence.jams.clear();
        (moved.start_forces_n[0], moved.end_forces_n[0]) = ([0.0, 0.0, -30.0], [0.0, 0.0, -30.0]);
        moved
    };
    let tolerances = Tolerances::project();
    let slides = compare(&equal, &mut [at(1.0, 0.0), at(2.0, 0.0)], &tolerances);
    assert!(slides.agrees(), "{slides:?}");
    assert_eq!(slides.undetermined, ["P", "Q"]);
    assert!(undetermined.is_empty() || undetermined == ["P", "Q"]);
    let aside = compare(&equal, &mut [at(1.0, 0.0), at(2.0, 1e-6)], &tolerances);
    assert!(!aside.agrees() && aside.undetermined.is_empty());
    // One of them heavier by a millionth, as if it were not.
    let unequal = over_a_pulley(3.0, 3.0 * (1.0 + 1e-6));
    assert!(!compare(&unequal, &mut [at(1.0, 0.0), at(2.0, 0.0)], &tolerances).agrees());
    // By a thousandth and by a millionth: the lighter one is at the pulley.
    for more in [1e-3, 1e-6] {
        let (answers, undetermined) = agreed(&over_a_pulley(3.0, 3.0 * (1.0 + more)));
        assert!(undetermined.is_empty());
        for found in &answers {
            near(found.joints_m[2], [0.0, 0.0, -5.0]);
            jams(found, &[(0, [0.0, 0.0, 30.0])]);
        }
    }
}

/// A ring without load on the level span of a rope that a weight keeps taut.
#[test]
fn a_ring_without_load_slides_along_its_rope() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::free("R"),
        free("W", 5.0),
    ];
    let taut = system(joints, vec![rope(&[0, 2, 1, 3], 5.0)]);
    let (answers, _) = agreed(&taut);
    for found in &answers {
        near(found.joints_m[3], [3.0, 0.0, -2.0]);
        assert!((found.axial_n[0] - 50.0).abs() < 1e-9);
    }
    let at = |x_m: f64| {
        let mut moved = answers[0].clone();
        moved.joints_m[2] = [x_m, 0.0, 0.0];
        moved
    };
    let slides = compare(&taut, &mut [at(1.0), at(2.0)], &Tolerances::project());
    assert!(slides.agrees(), "{slides:?}");
    assert!(slides.free_joints + slides.undetermined.len() == 1, "{slides:?}");
}

/// A shallow valley: 10 N on a rope a millimetre below straight, and half a metre beside, where the rope lets it be.
#[test]
fn a_false_place_in_a_shallow_valley_is_seen() {
    let joints =
        vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [4.0, 0.0, 0.0]), free("P", 1.0)];
    let half_m = 2.0_f64.hypot(1e-3);
    let shallow = system(joints, vec![rope(&[0, 2, 1], 2.0 * half_m)]);
    let answers = asked(&shallow).equilibria;
    let tension_n = answers[0].axial_n[0];
    assert!((tension_n / (5.0 * half_m / 1e-3) - 1.0).abs() < 1e-7);
    let mut planted = answers[0].clone();
    let at_m = [2.5, 0.0, -1e-3 * (1.0 - (0.5 / half_m).powi(2)).sqrt()];
    let unit = |x: f64, z: f64| [x / x.hypot(z), 0.0, z / x.hypot(z)];
    planted.joints_m[2] = at_m;
    planted.energy_j = 10.0 * at_m[2];
    planted.start_forces_n[0] = unit(-at_m[0], -at_m[2]).map(|x| x * tension_n);
    planted.end_forces_n[0] = unit(4.0 - at_m[0], -at_m[2]).map(|x| x * tension_n);
    planted.reactions_n[0] = planted.start_forces_n[0];
    planted.reactions_n[1] = planted.end_forces_n[0];
    let found = compare(&shallow, &mut [answers[0].clone(), planted], &Tolerances::project());
    assert!(!found.agrees() && found.undetermined.is_empty(), "{found:?}");
}

/// S of 2 kg, free or on supports, at one end of a rope of 8 m over A with 9 kg in its middle: it runs to A, and
/// spans of 4 m to A and B, 3 m apart, hold the 9 kg.
#[test]
fn a_slider_runs_to_its_pulley() {
    let deep = (16.0_f64 - 2.25).sqrt();
    let tension_n = 45.0 * 4.0 / deep;
    let at_m = [0.0, 0.0, 0.0];
    let up = [0.0, 0.0, 1.0];
    for (support, pull_n) in [
        (Support::Free, [0.0, 0.0, 20.0]),
        (Support::Plane { at_m: [1.0, 0.0, -1.0], normal: [0.0, 1.0, 0.0] }, [0.0, 0.0, 20.0]),
        (Support::Line { at_m: [0.0, 0.0, -1.0], direction: up }, [0.0, 0.0, 20.0]),
        // Its line bears its weight, or what of it is not along it.
        (Support::Line { at_m: [1.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] }, [0.0; 3]),
        (Support::Line { at_m: [3.0, 0.0, -4.0], direction: [0.6, 0.0, -0.8] }, [-9.6, 0.0, 12.8]),
        (Support::Fixed { at_m }, [0.0; 3]),
    ] {
        let joints = vec![
            Joint::anchor("A", at_m),
            Joint::anchor("B", [3.0, 0.0, 0.0]),
            free("S", 2.0).held_by(support),
            free("P", 9.0),
        ];
        let (answers, _) = agreed(&system(joints, vec![rope(&[2, 0, 3, 1], 8.0)]));
        for found in &answers {
            near(found.joints_m[2], at_m);
            near(found.joints_m[3], [1.5, 0.0, -deep]);
            assert!((found.axial_n[0] - tension_n).abs() < 1e-9 * tension_n);
            near(found.start_forces_n[0], pull_n.map(|n: f64| -n));
            near(found.reactions_n[2], [-pull_n[0], 0.0, 20.0 - pull_n[2]]);
        }
    }
}

/// Two rings run together where one would hang, also with a slack heavy cable between them, in a plane, and above a
/// floor that they do not reach.
#[test]
fn rings_run_together_beside_other_things() {
    let rings = |cable_kg: f64, plane: bool| {
        let support = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
        let support = if plane { support } else { Support::Free };
        let ring = |name: &str, mass_kg: f64| free(name, mass_kg).held_by(support);
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [2.0, 0.0, 0.0]),
            ring("R", 1.0),
            ring("S", 3.0),
        ];
        let mut members = vec![rope(&[0, 2, 3, 1], 6.0)];
        if cable_kg > 0.0 {
            members.push(Member::cable(2, 3, Bar::homogeneous(1.0, cable_kg).unwrap()));
        }
        system(joints, members)
    };
    let deep = 8.0_f64.sqrt();
    for (system, cable_n) in [
        (rings(0.0, false), 0.0),
        (rings(0.7, false), 7.0),
        (rings(0.0, true), 0.0),
        (rings(0.0, false).with_floor(-5.0).unwrap(), 0.0),
    ] {
        let tension_n = (40.0 + cable_n) * 3.0 / (2.0 * deep);
        let (answers, _) = agreed(&system);
        for found in &answers {
            near(found.joints_m[2], [1.0, 0.0, -deep]);
            near(found.joints_m[3], [1.0, 0.0, -deep]);
            assert!((found.axial_n[0] - tension_n).abs() < 1e-9 * tension_n);
            // Half of all less what R bears.
            jams(found, &[(1, [tension_n / 3.0, 0.0, 10.0 - 20.0])]);
            assert!((found.energy_j + (40.0 + cable_n) * deep).abs() < 1e-9);
            if cable_n > 0.0 {
                near(found.start_forces_n[1], [0.0, 0.0, 3.5]);
                near(found.end_forces_n[1], [0.0, 0.0, 3.5]);
            }
        }
    }
}

/// Two anchors in one place: their strands bear a block of 7 kg together, which one of them would not.
#[test]
fn anchors_in_one_place_hold_a_block_together() {
    let with_block = |mass_kg: f64| {
        let joints = vec![
            Joint::anchor("a", [0.0; 3]),
            Joint::anchor("b", [0.0; 3]),
            Joint::anchor("out", [3.0, 0.0, 0.0]),
            free("block", mass_kg),
            free("W", 4.0),
        ];
        system(joints, vec![rope(&[0, 3, 1, 2, 4], 12.0)])
    };
    let (answers, _) = agreed(&with_block(7.0));
    for found in &answers {
        near(found.joints_m[3], [0.0; 3]);
        near(found.joints_m[4], [3.0, 0.0, -9.0]);
        jams(found, &[(0, [0.0, 0.0, -35.0]), (1, [0.0, 0.0, 35.0])]);
        near(found.reactions_n[0], [0.0, 0.0, 35.0]);
        near(found.reactions_n[1], [-40.0, 0.0, 35.0]);
    }
    // 9 kg are more than two strands of 40 N hold.
    for found in asked(&with_block(9.0)).equilibria {
        assert!(found.joints_m[3][2] < -1.0, "{found:?}");
    }
}

/// The heavier of two weights on the floor: without it the lighter one would jam at the pulley.
#[test]
fn a_weight_over_a_pulley_lies_on_the_floor() {
    let (answers, _) = agreed(&over_a_pulley(23.0, 1.0).with_floor(-3.25).unwrap());
    for found in &answers {
        near(found.joints_m[1], [0.0, 0.0, -3.25]);
        near(found.joints_m[2], [0.0, 0.0, -1.75]);
        near(found.reactions_n[1], [0.0, 0.0, 220.0]);
        jams(found, &[]);
    }
}

/// Rings blown across the floor to where their rope is taut: 40 N and 30 N, 3 kg and 4 kg.
#[test]
fn rings_run_together_on_the_floor() {
    let blown = |name: &str, mass_kg: f64, force_n: f64| {
        free(name, mass_kg).with_force([0.0, force_n, 0.0])
    };
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [2.0, 0.0, 0.0]),
        blown("R", 3.0, 40.0),
        blown("S", 4.0, 30.0),
    ];
    let lies = system(joints, vec![rope(&[0, 2, 3, 1], 6.0)]).with_floor(-1.0).unwrap();
    let (answers, _) = agreed(&lies);
    let far = 7.0_f64.sqrt();
    let tension_n = 105.0 / far;
    for found in &answers {
        near(found.joints_m[2], [1.0, far, -1.0]);
        assert!((found.axial_n[0] - tension_n).abs() < 1e-9 * tension_n);
        // Level, for the floor bears the weights.
        jams(found, &[(1, [tension_n / 3.0, -5.0, 0.0])]);
        near(found.reactions_n[2], [0.0, 0.0, 30.0 - tension_n / 3.0]);
        near(found.reactions_n[3], [0.0, 0.0, 40.0 - tension_n / 3.0]);
    }
}

/// A boom whose end is held by five strands just above its pulley: short strands are no jam.
#[test]
fn short_strands_hold_a_boom() {
    let top_m = [-0.5, 0.0, 2.0];
    let joints = vec![
        Joint::anchor("foot", [0.0; 3]),
        Joint::anchor("top", top_m),
        free("tip", 4.0),
        free("cw", 8.0),
    ];
    let reach_m = top_m[0].hypot(top_m[2]);
    let long_m = reach_m + 0.15;
    let boom = Member::bar(0, 2, Bar::homogeneous(long_m, 0.0).unwrap());
    let (answers, _) = agreed(&system(joints, vec![boom, rope(&[2, 1, 2, 1, 2, 1, 3], 20.0)]));
    for found in &answers {
        // In the plane of foot and top, near the line through both, which the weight turns it from.
        let [x, y, z] = found.joints_m[2];
        assert!(y.abs() < 1e-9 && (x.hypot(z) - long_m).abs() < 1e-9);
        assert!((found.axial_n[1] - 80.0).abs() < 1e-9);
        // Moments about the foot: five strands of 80 N and 40 N.
        let [a, c] = [top_m[0] - x, top_m[2] - z];
        let turn_nm = 5.0 * 80.0 * (x * c - z * a) / a.hypot(c) - 40.0 * x;
        assert!(turn_nm.abs() < 1e-8, "{turn_nm}");
    }
}

/// Rings on one rope with bars and cables between them, loads below them, and a floor under some.
fn drawn(number: u64) -> System {
    let random = &mut samples::stream(20_261_127, number);
    let mut between = |low: f64, high: f64| random.random_range(low..high);
    let b_m = [between(1.0, 5.0), between(-1.0, 1.0), between(-1.0, 1.0)];
    let mut joints = vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", b_m)];
    let rings = 1 + (number % 3) as usize;
    joints.extend((0..rings).map(|k| free(&format!("R{k}"), between(0.5, 5.0))));
    let path: Vec<usize> = [0].into_iter().chain(2..2 + rings).chain([1]).collect();
    let mut members = vec![rope(&path, between(6.5, 10.0))];
    if rings > 1 && between(0.0, 1.0) < 0.6 {
        let body = Bar::homogeneous(between(0.5, 1.5), 0.2).unwrap();
        let bar = between(0.0, 1.0) < 0.5;
        members.push(if bar { Member::bar(2, 3, body) } else { Member::cable(2, 3, body) });
    }
    for ring in 2..2 + rings {
        if between(0.0, 1.0) < 0.4 {
            let body = Bar::homogeneous(between(0.5, 2.0), 0.3).unwrap();
            members.push(Member::cable(ring, joints.len(), body));
            joints.push(free(&format!("W{ring}"), between(0.5, 5.0)));
        }
    }
    let floor_m = number.is_multiple_of(4).then(|| between(-5.0, -1.5));
    let system = system(joints, members);
    floor_m.map_or(system.clone(), |floor_m| system.with_floor(floor_m).unwrap())
}

#[test]
fn random_rings_with_bars_cables_and_floors_are_agreed_upon() {
    let mut jammed = 0;
    for number in 0..60 {
        let system = drawn(number);
        let answer = asked(&system);
        assert!(answer.agrees() && answer.is_decided(), "{number}: {answer:?}");
        jammed += usize::from(!answer.equilibria[0].evidence.jams.is_empty());
    }
    assert!(jammed > 10, "{jammed}");
}

/// A triangle hangs on A alone, and turns about its vertical; the cable and the rope to it from B are slack whichever
/// way it turns.
#[test]
fn parts_turn_beside_what_is_slack() {
    let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    for via in [vec![], vec![4]] {
        let mut joints =
            samples::joints(&[[0.82, -1.38, -2.75], [-2.9, 1.88, 2.48]], &[20.0, 30.0]);
        if !via.is_empty() {
            joints.push(Joint::anchor("C", [0.0, 0.0, -1.0]));
        }
        let members = vec![
            Member::cable(0, 2, body(3.0)),
            Member::bar(2, 3, body(2.0)),
            Member::cable(0, 3, body(2.5)),
            Member::cable(1, 2, body(25.0)).over(via),
        ];
        let system = System::new("a triangle", 9.81, joints, members).unwrap();
        let answer = asked(&system);
        assert!(answer.agrees() && answer.equilibria.len() == 2, "{answer:?}");
        assert_eq!(answer.agreement.unwrap().turned_parts, 1);
    }
}

/// S slides on a rail, and R is on a rope: what holds them is slack, nothing loads them, and where they are is open.
#[test]
fn what_slack_ropes_hold_is_free() {
    let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let rail = Support::Line { at_m: [3.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("S").held_by(rail),
        Joint::free("M").with_mass(10.0),
        Joint::free("R"),
        Joint::anchor("B", [4.0, 0.0, 0.3]),
    ];
    let members = vec![
        Member::cable(0, 2, body(2.0)),
        Member::cable(0, 1, body(5.0)),
        Member::cable(0, 4, body(9.0)).over(vec![3]),
    ];
    let system = System::new("slack", 9.81, joints, members).unwrap();
    let answer = asked(&system);
    assert!(answer.agrees() && answer.equilibria.len() == 2, "{answer:?}");
    assert_eq!(answer.agreement.unwrap().free_joints, 2);
}
