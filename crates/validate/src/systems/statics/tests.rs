//! Violations in units by hand.

use model::Bar;
use model::system::{Joint, PointLoad, Support};

use super::super::tests::lamp;
use super::*;

/// A spring of a length and a stiffness that hangs from A with a mass on it.
fn spring(length_m: f64, stiffness_n: f64, mass_kg: f64) -> System {
    let body = Bar::homogeneous(length_m, 0.0).unwrap();
    let spring = Member::bar(0, 1, body).with_stiffness(stiffness_n);
    System::new("spring", 10.0, samples::joints(&[[0.0; 3]], &[mass_kg]), vec![spring]).unwrap()
}

/// The mass of it so far below A, drawn up with so many newtons.
fn hung(down_m: f64, axial_n: f64, energy_j: f64) -> SystemEquilibrium {
    let up = [0.0, 0.0, axial_n];
    SystemEquilibrium {
        energy_j,
        joints_m: vec![[0.0; 3], [0.0, 0.0, -down_m]],
        start_forces_n: vec![up],
        end_forces_n: vec![times(-1.0, up)],
        axial_n: vec![axial_n],
        reactions_n: vec![up, [0.0; 3]],
        ..lamp().1
    }
}

/// A spring of 1 m at its length, without any load: the only size that its energy has is what the
/// rounding of its places costs, 8 units in the last place of 1 m times 2^50 N: 2 J.
#[test]
fn the_energy_of_a_spring_is_known_to_the_rounding_of_its_places() {
    let system = spring(1.0, 2.0_f64.powi(50), 0.0);
    let derived = |energy_j: f64, down_m: f64| {
        let answer = hung(down_m, 0.0, energy_j);
        let units = Units::new(&system, &answer, Scale::new(&system, &answer));
        judging(&system, &answer, units).energy()
    };
    // Of it half of 2^50 N/m times the square of 2^-49 m is rounding, and 2^-49 m of a strain that rounding may leave.
    let strained = 2.0 * model::system::LENGTH_ROUNDING;
    let told = 0.25 - 2.0_f64.powi(-50) - 0.5 * strained;
    let found = derived(0.5, 1.0);
    assert!((found - told).abs() < 0.01 * strained, "{found:e} {told:e}");
    assert_eq!(derived(0.0, 1.0).to_bits(), 0);
    // Half a metre longer it has 2^47 J, beside which 3 J of rounding are nothing.
    let stretched = derived(0.0, 1.5);
    assert!((stretched - 1.0).abs() < 1e-13, "{stretched}");
}

/// Forces across a cable of 5 m at both ends turn it: 5 m times the force, of its largest force
/// times 5 m.
#[test]
fn a_moment_is_a_part_of_the_force_times_the_length() {
    let (system, mut answer) = lamp();
    answer.start_forces_n[0][1] += 1e-3;
    answer.end_forces_n[0][1] -= 1e-3;
    let found = judge(&system, &answer);
    let wanted = 1e-3 / 1.25_f64.hypot(1e-3);
    assert!((found.moment - wanted).abs() < 1e-14, "{found:?}");
    assert!(found.force < 1e-15, "{found:?}");
}

/// Three bars to a joint that bears nothing, beside 10 N on another one: 2 N for each joint on the
/// average. What the rounding of the 10 N leaves at the idle joint is no part of its own forces; a
/// force of 1e-10 N there is seen.
#[test]
fn an_idle_joint_is_measured_by_what_acts_elsewhere() {
    let at = [[0.0; 3], [5.0, 0.0, 0.0], [7.0, 0.0, 0.0]];
    let mut joints: Vec<Joint> = at.map(|at| Joint::anchor(format!("{at:?}"), at)).to_vec();
    joints.extend([Joint::free("P").with_mass(1.0), Joint::free("idle")]);
    let bar = |from, to| Member::bar(from, to, Bar::homogeneous(1.0, 0.0).unwrap());
    let members = vec![bar(0, 3), bar(1, 4), bar(2, 4)];
    let system = System::new("idle", 10.0, joints, members).unwrap();
    let left = |force_n: f64| {
        let answer = SystemEquilibrium {
            energy_j: -10.0,
            joints_m: [&at[..], &[[0.0, 0.0, -1.0], [6.0, 0.0, 0.0]]].concat(),
            start_forces_n: vec![[0.0, 0.0, 10.0], [-force_n, 0.0, 0.0], [0.0; 3]],
            end_forces_n: vec![[0.0, 0.0, -10.0], [force_n, 0.0, 0.0], [0.0; 3]],
            axial_n: vec![10.0, force_n, 0.0],
            reactions_n: vec![[0.0, 0.0, 10.0], [-force_n, 0.0, 0.0], [0.0; 3], [0.0; 3], [0.0; 3]],
            ..lamp().1
        };
        let units = Units::new(&system, &answer, Scale::new(&system, &answer));
        judging(&system, &answer, units).joint_balances()[4]
    };
    assert!(left(4e-14) < 2e-12, "{}", left(4e-14));
    assert!(left(1e-10) > 1e-9, "{}", left(1e-10));
}

/// A spring of 1 m and 6 N that is drawn to 1.4 m has 2.4 N, not 3.
#[test]
fn a_wrong_elongation_is_a_part_of_the_force() {
    let found = judge(&spring(1.0, 6.0, 0.3), &hung(1.4, 3.0, -4.2 + 0.48));
    assert!((found.law - 0.2).abs() < 1e-14 && found.worst == Place::Member(1), "{found:?}");
    assert!(
        [found.force, found.moment, found.joint, found.balance, found.derived]
            .iter()
            .all(|x| *x < 1e-14),
        "{found:?}"
    );
}

/// A spring that bears 2 N at 1.2 m, EA 6 N, is 0.9 m long unstretched, (6 + 2) 1.5/1.2 - 6 = 4 N at
/// 1.5 m. An unstretched length that is wrong in the system, and an answer that fits it, are seen:
/// 6 (1.5/1 - 1) = 3 N from 1 m.
#[test]
fn the_law_of_a_prestressed_member_is_that_of_the_numbers_given() {
    let system = spring(1.2, 6.0, 0.4);
    let spring = system.members()[0].clone().with_prestress(2.0).unwrap();
    let law = |length_m: f64, axial_n: f64| {
        let member = spring.clone().with_body(Bar::homogeneous(length_m, 0.0).unwrap());
        let joints = system.joints().to_vec();
        let system = System::new("spring", 10.0, joints, vec![member]).unwrap();
        judge(&system, &hung(1.5, axial_n, -8.0)).law
    };
    assert!(law(spring.body.length_m(), 4.0) < 1e-14);
    close(law(1.0, 3.0), 1.0 / 3.0);
}

/// A short spring of 2^40 N at its length: places are stored to 8 units in the last place of it,
/// which are 2^-9 N, however short.
#[test]
fn the_force_of_a_short_spring_is_known_to_the_rounding_of_its_ends() {
    let length_m = 2.0_f64.powi(-10);
    let system = spring(length_m, 2.0_f64.powi(40), 0.0);
    let law = |axial_n: f64| {
        let at_rest = hung(length_m, 0.0, 0.0);
        judge(&system, &SystemEquilibrium { axial_n: vec![axial_n], ..at_rest }).law
    };
    let explained = 2.0_f64.powi(-9);
    assert_eq!(law(0.75 * explained).to_bits(), 0);
    assert!(law(1.25 * explained) > 0.99);
}

/// A is held at (1, -2, 5) and B drawn by (2, -1, 4) N with 3 kg; a bar of 8 m between them, 7 m
/// apart along (2, 3, 6), has 8 kg at a quarter and (5, -6, 4) N at five eighths of its length.
pub(in crate::systems) fn crooked(
    change: impl Fn(&mut Vec<Joint>, &mut Member),
) -> (System, SystemEquilibrium) {
    let mut joints = vec![
        Joint::anchor("A", [1.0, -2.0, 5.0]),
        Joint::free("B").with_mass(3.0).with_force([2.0, -1.0, 4.0]),
    ];
    let mut bar = Member::bar(0, 1, Bar::new(8.0, 8.0, 2.0, [0.0; 3]).unwrap());
    bar.loads.push(PointLoad { at_m: 5.0, force_n: [5.0, -6.0, 4.0], is_spread: false });
    change(&mut joints, &mut bar);
    let system = System::new("crooked", 10.0, joints, vec![bar]).unwrap();
    let answer = SystemEquilibrium {
        energy_j: 265.0,
        joints_m: vec![[1.0, -2.0, 5.0], [3.0, 1.0, 11.0]],
        start_forces_n: vec![[1.0, 2.0, 3.0]],
        end_forces_n: vec![[7.0, 11.0, 13.0]],
        axial_n: vec![15.0 / 7.0],
        reactions_n: vec![[1.0, 2.0, 4.0], [0.0; 3]],
        ..lamp().1
    };
    (system, answer)
}

const UNITS: Units = Units {
    load_n: 0.0,
    rounding_m: 0.25,
    rounding_n: 0.5,
    rounding_j: 0.125,
    size_m: 4.0,
    largest_n: 8.0,
    acts_n: vec![],
    meet_n: vec![],
    total_n: f64::INFINITY,
    free: vec![],
};

fn judging<'a>(system: &'a System, answer: &'a SystemEquilibrium, units: Units) -> Judging<'a> {
    Judging { system, answer, units, found: SystemStatics::default() }
}

fn close(found: f64, wanted: f64) {
    assert!((found - wanted).abs() < 1e-14 * wanted.abs().max(1.0), "{found}, not {wanted}");
}

/// (1, 2, 3), (7, 11, 13) and (5, -6, 4) N with the weight of 80 N leave (13, 7, -60) N. The second
/// joint carries (81/8, 29/4, -9/2) N: 15/7 N along the bar, and across it (-57, 279/4, -127/8) N m.
/// Half a newton is rounding of forces, and turns 7 m; a quarter of a metre is rounding of places,
/// and turns 80 N.
#[test]
fn what_is_left_over_on_a_member_is_a_part_of_its_largest_force() {
    let (system, mut answer) = crooked(|_, _| ());
    answer.axial_n[0] += 2.5;
    let mut exact = judging(&system, &answer, UNITS);
    exact.member(0, 7.0);
    let found = exact.found;
    close(found.force, (3818.0_f64.sqrt() - 0.5) / 80.0);
    close(found.moment, (535_429.0_f64.sqrt() / 8.0 - 23.5) / 560.0);
    close(found.derived, 0.025);
    close(found.length, 0.75 / 8.0);
    assert_eq!((found.law.to_bits(), found.worst), (0, Place::Member(1)));
    // Where rounding is as much as the distance there is no direction.
    for (rounding_m, derived) in [(7.0, 0.0), (6.875, 0.025)] {
        let units = Units { rounding_m, ..UNITS };
        let mut rough = judging(&system, &answer, units);
        rough.member(0, 7.0);
        close(rough.found.derived, derived);
    }
}

/// 8 m and 16 N: a metre is 2 N, a quarter of one, of rounding, half a newton. A rigid member of 8 m
/// may be off by a quarter of a metre, and its force by half a newton, of 4 N.
#[test]
fn the_laws_of_members_are_those_of_their_kinds() {
    let acting =
        |acts_n: f64, kind: Kind, stiffness_n: Option<f64>, distance_m: f64, axial_n: f64| {
            let local = Local { rounding_n: 0.5, most_n: BORNE * acts_n, least_n: 0.0 };
            let body = Bar::homogeneous(8.0, 0.0).unwrap();
            let (system, mut answer) = crooked(|_, bar| {
                *bar = Member::bar(0, 1, body).of_kind(kind).with_stiffness(stiffness_n);
            });
            answer.axial_n[0] = axial_n;
            let mut judging = judging(&system, &answer, UNITS);
            judging.law(0, distance_m, 4.0, local);
            [judging.found.length, judging.found.law]
        };
    let told = |kind, stiffness_n, distance_m, axial_n| {
        acting(1.0, kind, stiffness_n, distance_m, axial_n)
    };
    let spring = |kind: Kind, distance_m: f64, axial_n: f64, wanted: f64| {
        let [length, law] = told(kind, Some(16.0), distance_m, axial_n);
        close(law, wanted);
        assert_eq!(length.to_bits(), 0);
    };
    for (kind, longer_n, shorter_n) in
        [(Kind::Bar, 2.0, -2.0), (Kind::Cable, 2.0, 0.0), (Kind::Strut, 0.0, -2.0)]
    {
        for (distance_m, wanted_n) in [(9.0, longer_n), (7.0, shorter_n)] {
            spring(kind, distance_m, wanted_n + 1.0, 0.0);
            spring(kind, distance_m, wanted_n - 4.0, 0.75);
            spring(kind, distance_m, wanted_n + 4.0, 0.75);
            // What is left over may be more than all forces told.
            spring(kind, distance_m, wanted_n + 6.0, 1.0);
        }
    }
    let rigid = |kind: Kind, distance_m: f64, axial_n: f64, wanted: [f64; 2]| {
        let found = told(kind, None, distance_m, axial_n);
        close(found[0], wanted[0]);
        close(found[1], wanted[1]);
    };
    let part = 0.75 / 8.0;
    for axial_n in [3.0, -3.0] {
        rigid(Kind::Bar, 9.0, axial_n, [part, 0.0]);
        rigid(Kind::Bar, 7.0, axial_n, [part, 0.0]);
    }
    rigid(Kind::Cable, 9.0, 3.0, [part, 0.0]);
    rigid(Kind::Cable, 9.0, -3.0, [part, 0.625]);
    rigid(Kind::Cable, 7.0, 3.0, [0.0, part]);
    rigid(Kind::Cable, 3.0, 1.0, [0.0, 0.125]);
    rigid(Kind::Cable, 7.0, 0.0, [0.0, 0.0]);
    rigid(Kind::Strut, 7.0, -3.0, [part, 0.0]);
    rigid(Kind::Strut, 7.0, 3.0, [part, 0.625]);
    rigid(Kind::Strut, 9.0, -3.0, [0.0, part]);
    rigid(Kind::Strut, 13.0, -1.0, [0.0, 0.125]);
    // What should vanish is measured by what acts at the joints, 20 N, where that is more.
    close(acting(20.0, Kind::Cable, None, 9.0, -3.0)[1], 2.5 / 20.0);
    close(acting(20.0, Kind::Strut, None, 9.0, -2.0)[1], 1.5 / 20.0);
    close(acting(20.0, Kind::Cable, Some(16.0), 7.0, 3.0)[1], 0.5);
}

/// A has (1, 2, 4) N of the ground and gives (1, 2, 3) N; B has (2, -1, 4) N and its weight of 30 N,
/// and gives (7, 11, 13) N.
#[test]
fn what_is_left_over_at_a_joint_is_a_part_of_its_largest_force() {
    let (system, answer) = crooked(|_, _| ());
    let [a, b] = judging(&system, &answer, UNITS).joint_balances()[..] else { panic!() };
    close(a, 0.5 / 21.0_f64.sqrt());
    close(b, (1690.0_f64.sqrt() - 0.5) / 30.0);
    let (system, answer) = crooked(|joints, _| joints[1].mass_kg = 0.0);
    let b = judging(&system, &answer, UNITS).joint_balances()[1];
    close(b, ((25.0 + 144.0 + 81.0_f64).sqrt() - 0.5) / 339.0_f64.sqrt());
}

/// (2, -1, -26) N, the weight of 80 N, (5, -6, 4) N and (1, 2, 4) N of the ground. With (-7, 7, 102)
/// N of the ground no force is left over, but the moment about A: at (2, 3, 6), (2, 3, 6)/4 and (2, 3, 6) 5/8
/// it is (-72, 64, -8) + (-60, 40, 0) + (30, 55/4, -135/8) N m, and a quarter of a metre of all forces is
/// rounding of places.
#[test]
fn what_is_left_over_on_the_whole_is_a_part_of_all_forces() {
    let (system, mut answer) = crooked(|_, _| ());
    let loads = 681.0_f64.sqrt() + 77.0_f64.sqrt() + 80.0;
    let sizes = loads + 21.0_f64.sqrt();
    close(judging(&system, &answer, UNITS).whole(), (9693.0_f64.sqrt() - 0.5) / sizes);
    answer.reactions_n[0] = [-7.0, 7.0, 102.0];
    let sizes = loads + 10_502.0_f64.sqrt();
    let moment = (102.0_f64.powi(2) + 117.75_f64.powi(2) + 24.875_f64.powi(2)).sqrt();
    close(judging(&system, &answer, UNITS).whole(), ((moment - 0.25 * sizes) / 4.0 - 0.5) / sizes);
}

/// (1, 2, 4) N of the ground where nothing acts but a prestress of 1 kN.
#[test]
fn without_loads_the_whole_is_measured_by_the_prestress() {
    let (system, answer) = crooked(|joints, bar| {
        joints[1] = Joint::free("B");
        *bar = Member::bar(0, 1, Bar::homogeneous(8.0, 0.0).unwrap());
    });
    let units = Units { total_n: 1000.0, ..UNITS };
    // A millionth of that at most is rounding.
    close(judging(&system, &answer, units).whole(), (21.0_f64.sqrt() - 1e-3) / 1000.0);
}

/// From A: (2, -1, -26) N along (2, 3, 6), 80 N down along 3/2 and (5, -6, 4) N along (5, 15/2, 15)/4:
/// 155 + 120 - 10 J. The unit is 4 m times all these forces; the rounding of places by 0.25 m explains
/// that times them.
#[test]
fn the_energy_is_that_of_all_loads_and_springs() {
    let forces = 681.0_f64.sqrt() + 80.0 + 77.0_f64.sqrt();
    let off = |kind: Kind, stiffness_n: Option<f64>, far: f64, elastic_j: f64, unit_j: f64| {
        let (system, mut answer) = crooked(|_, bar| {
            bar.kind = kind;
            bar.stiffness_n = stiffness_n;
        });
        answer.joints_m[1] = [1.0 + 2.0 * far, -2.0 + 3.0 * far, 5.0 + 6.0 * far];
        answer.energy_j = 265.0 * far + elastic_j;
        assert!(judging(&system, &answer, UNITS).energy() < 1e-15, "{kind:?} {far}");
        answer.energy_j += 64.0;
        let beyond_j = 64.0 - 0.125;
        close(judging(&system, &answer, UNITS).energy(), beyond_j / (4.0 * forces + unit_j));
    };
    off(Kind::Bar, None, 1.0, 0.0, 0.0);
    // 24 N over 8 m are 3 N/m, a metre too short or 6 m too long; rounding is 6 J.
    for (kind, short_j, long_j) in
        [(Kind::Bar, 1.5, 54.0), (Kind::Cable, 0.0, 54.0), (Kind::Strut, 1.5, 0.0)]
    {
        off(kind, Some(24.0), 1.0, short_j, short_j + 6.0);
        off(kind, Some(24.0), 2.0, long_j, long_j + 6.0);
    }
}

/// Three metres along, and (4, 5) m across; 6 N along, and 8 N across.
#[test]
fn supports_bear_what_is_normal_to_their_motions() {
    let along = [0.6, 0.0, 0.8];
    let found = |support_of: Support, floor_m: Option<f64>| {
        let (system, mut answer) = crooked(|joints, _| {
            joints[0] = Joint::anchor("A", [1.0, -2.0, 9.0]);
            joints[1].support = support_of;
        });
        let system = floor_m.map_or(system.clone(), |floor_m| system.with_floor(floor_m).unwrap());
        answer.joints_m[1] = [1.8 - 3.2, 5.0, 2.4 + 2.4];
        answer.reactions_n[1] = [3.6 - 6.4, 0.0, 4.8 + 4.8];
        let mut judging = judging(&system, &answer, UNITS);
        judging.support(1);
        let found = judging.found;
        assert_eq!(found.worst, Place::Joint(1));
        (found.support, found.joint)
    };
    let at_m = [0.0; 3];
    let (off, pushed) = found(Support::Line { at_m, direction: along }, None);
    close(off, (41.0_f64.sqrt() - 0.25) / 4.0);
    close(pushed, 5.5 / 10.0);
    let (off, pushed) = found(Support::Plane { at_m, normal: along }, None);
    close(off, (3.0 - 0.25) / 4.0);
    close(pushed, 7.5 / 10.0);
    let (off, pushed) = found(Support::Fixed { at_m }, None);
    close(off, (50.0_f64.sqrt() - 0.25) / 4.0);
    close(pushed, 0.0);
    let (off, pushed) = found(Support::Free, None);
    close(off, 0.0);
    close(pushed, 9.5 / 10.0);
    // The floor, 0.8 m below, pushes 9.6 N of it up; the rest is 2.8 N aside.
    let (off, pushed) = found(Support::Free, Some(4.0));
    close(off, 0.0);
    close(pushed, 2.3 / 10.0);
    // 3.8 m above it no push is right, and the height is less of 4 m than the push of 8 N.
    let (_, pushed) = found(Support::Free, Some(1.0));
    close(pushed, (3.8 - 0.25) / 4.0);
    // Below it.
    let (off, pushed) = found(Support::Free, Some(5.8));
    close(off, 0.75 / 4.0);
    close(pushed, 2.3 / 10.0);
}

#[test]
fn a_floor_pushes_what_lies_on_it_alone() {
    let (system, answer) = crooked(|_, _| ());
    let told = |above_m: f64, push_n: f64| {
        let mut judging = judging(&system, &answer, UNITS);
        judging.on_floor(above_m, push_n, 3);
        let found = judging.found;
        (found.support, found.joint, found.worst)
    };
    let joint = Place::Joint(3);
    assert_eq!(told(-1.25, 2.5), (0.25, 0.0, joint));
    assert_eq!(told(0.25, 100.0), (0.0, 0.0, Place::Whole));
    assert_eq!(told(9.0, 0.5), (0.0, 0.0, Place::Whole));
    assert_eq!(told(0.0, -2.5), (0.0, 0.25, joint));
    assert_eq!(told(1.25, 6.5), (0.0, 0.25, joint));
    assert_eq!(told(4.25, 4.5), (0.0, 0.5, joint));
}

#[test]
fn units_are_the_largest_numbers_of_an_answer() {
    let ulps = 8.0 * f64::EPSILON;
    let (system, mut answer) = crooked(|_, _| ());
    let units = |answer: &SystemEquilibrium| {
        let Units { rounding_m, rounding_n, size_m, largest_n, .. } =
            Units::new(&system, answer, Scale::new(&system, answer));
        [rounding_m / ulps, rounding_n / ulps, size_m, largest_n]
    };
    let wanted = |found: [f64; 4], wanted: [f64; 4]| {
        found.into_iter().zip(wanted).for_each(|(found, wanted)| close(found, wanted));
    };
    let largest = 339.0_f64.sqrt();
    wanted(units(&answer), [11.0, largest, 8.0, largest]);
    answer.joints_m[1] = [5.0, 4.0, -7.0];
    wanted(units(&answer), [8.0, largest, (16.0 + 36.0 + 144.0_f64).sqrt(), largest]);
    answer.reactions_n[1] = [0.0, -30.0, 40.0];
    wanted(units(&answer), [8.0, 50.0, 14.0, 50.0]);
    answer.start_forces_n[0] = [60.0, 0.0, -80.0];
    wanted(units(&answer), [8.0, 100.0, 14.0, 100.0]);
}

/// The larger of two stays, with its place; what is none stays whatever comes.
#[test]
fn the_largest_violation_is_kept_with_its_place() {
    let mut found = SystemStatics::default();
    found.note(|s| &mut s.force, 0.5, Place::Joint(1));
    found.note(|s| &mut s.joint, 0.25, Place::Joint(2));
    found.note(|s| &mut s.force, 0.25, Place::Joint(3));
    found.note(|s| &mut s.moment, 0.5, Place::Joint(4));
    assert_eq!((found.force, found.joint, found.moment), (0.5, 0.25, 0.5));
    assert_eq!((found.largest(), found.worst), (0.5, Place::Joint(1)));
    assert!(found.passes(0.5) && !found.passes(0.499));
    found.note(|s| &mut s.law, f64::NAN, Place::Joint(5));
    found.note(|s| &mut s.law, f64::NAN, Place::Joint(6));
    found.note(|s| &mut s.law, 9.0, Place::Joint(7));
    assert!(found.largest().is_nan() && found.worst == Place::Joint(5));
    assert!(!found.passes(f64::INFINITY));
}

/// Four legs of 5 m, one of which is 4e-10 m longer: the shape that meets all lengths best leaves
/// 1e-10 m in each, which is within a billionth of 5 m. Any other shape is off by more than it need
/// be; and with a tolerance of 1e-11 m that shape is no answer either.
#[test]
fn lengths_that_overdetermine_a_shape_are_met_best() {
    use super::super::tests::four_legs;
    let (system, right) = four_legs(0.5);
    let found = |down_m: f64, within_m: Option<f64>| {
        let mut members = system.members().to_vec();
        for member in &mut members {
            member.set_length_tolerance(within_m);
        }
        members[0].body = Bar::homogeneous(5.0 + 4e-10, 0.0).unwrap();
        let system = System::new("legs", 10.0, system.joints().to_vec(), members).unwrap();
        let mut answer = right.clone();
        // The leg from (3, 0, 0) is longer, and lies along (-3, 0, -4)/5. With d the place, least
        // squares of u·d - e: sums of u u' are 18/25 along x and y, 64/25 along z.
        let (x, z) = (-0.6 * 4e-10 / 0.72, -0.8 * 4e-10 / 2.56);
        answer.joints_m[4] = [x, 0.0, -4.0 + z - down_m];
        judge(&system, &answer).length
    };
    assert!(found(0.0, None) < 1e-15, "{:e}", found(0.0, None));
    assert!(found(1e-9, None) > 1e-11);
    assert!(found(0.0, Some(2e-10)) < 1e-15);
    assert!((found(0.0, Some(1e-11)) / 2e-11 - 1.0).abs() < 1e-3);
}

/// What is left at a joint counts against its load of 16 N, whatever its members bear: the unit is a
/// hundred times that. Of 1e-4 N, rounding of 6.7e8 N explains 1.2e-6.
#[test]
fn large_forces_forgive_nothing() {
    use super::super::tests::four_legs;
    let (system, mut answer) = four_legs(2.0_f64.powi(26));
    let balanced = judge(&system, &answer);
    assert!(balanced.joint < 1e-15, "{balanced:?}");
    answer.start_forces_n[0][2] += 1e-4;
    answer.reactions_n[0][2] += 1e-4;
    answer.end_forces_n[0][2] -= 1e-4;
    let found = judge(&system, &answer).joint;
    assert!((found / ((1e-4 - 1.2e-6) / 1600.0) - 1.0).abs() < 0.02, "{found:e}");
}
