//! The equations of a system as others see them, against differences and closed forms.

use lagrange::net::{Equations, Settings, Side, solve};
use model::Bar;
use model::system::{Joint, Kind, Member, PointLoad, Support, System};
use rand::RngExt;

use crate::common::stream;

/// Every kind of member, rigid and elastic, none of the length of another, between anchors, free joints, a ring on
/// an oblique wire and one on a level plate, and ropes over them, one twice over the same ring.
fn rig(change: impl Fn(&mut Vec<Joint>, &mut Vec<Member>)) -> System {
    let wire = Support::Line { at_m: [2.0, 1.0, -1.5], direction: [0.6, 0.0, 0.8] };
    let plate = Support::Plane { at_m: [-1.0, 0.5, -2.0], normal: [0.0, 0.0, 1.0] };
    let mut joints = vec![
        Joint::anchor("A", [0.3, -0.2, 1.1]),
        Joint::free("P").with_mass(2.0).with_force([0.5, 1.5, -0.25]),
        Joint::free("Q").with_mass(0.75),
        Joint::free("R").with_mass(1.25).held_by(wire),
        Joint::free("S").with_force([3.0, -1.0, 0.0]).held_by(plate),
        Joint::anchor("B", [2.5, 0.4, 1.7]),
    ];
    let member = |from, to, kind, length_m, mass_kg, stiffness_n| {
        Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).unwrap())
            .of_kind(kind)
            .with_stiffness(stiffness_n)
    };
    let mut members = vec![
        member(0, 1, Kind::Bar, 1.3, 0.4, None),
        member(1, 2, Kind::Bar, 0.8, 0.2, Some(60.0)),
        member(5, 2, Kind::Cable, 1.9, 0.0, None),
        member(2, 3, Kind::Cable, 2.1, 0.3, Some(90.0)),
        member(4, 1, Kind::Strut, 2.4, 0.5, None),
        member(4, 3, Kind::Strut, 2.9, 0.0, Some(40.0)),
        member(5, 3, Kind::Bar, 3.1, 0.6, Some(70.0)),
        member(0, 3, Kind::Cable, 4.7, 0.0, Some(55.0)).over(vec![2, 5]),
        member(5, 0, Kind::Cable, 6.3, 0.0, None).over(vec![1, 4, 2]),
        member(0, 1, Kind::Cable, 5.2, 0.0, Some(35.0)).over(vec![3, 5, 3]),
    ];
    change(&mut joints, &mut members);
    System::new("rig", 9.81, joints, members).unwrap()
}

/// Unknowns somewhere, and a direction, both along what supports leave free.
fn somewhere(system: &System, equations: &Equations, seed: usize) -> [Vec<f64>; 2] {
    let mut random = stream(90, seed);
    let count = 3 * system.joints().len() + system.members().len();
    let mut draw = || (0..count).map(|_| random.random_range(-1.0..1.0)).collect::<Vec<f64>>();
    let y = equations.onto(&draw());
    let there: Vec<f64> = y.iter().zip(draw()).map(|(y, v)| y + v).collect();
    let free = equations.onto(&there).iter().zip(&y).map(|(there, y)| there - y).collect();
    [y, free]
}

fn close(found: &[f64], wanted: &[f64], tolerance: f64) {
    assert_eq!(found.len(), wanted.len());
    for (k, (found, wanted)) in found.iter().zip(wanted).enumerate() {
        assert!((found - wanted).abs() < tolerance, "{k}: {found}, not {wanted}");
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// $J v$ is the difference of $G$ along $v$, symmetric in two directions; and what is solved for comes back.
#[test]
fn the_derivative_is_that_of_the_residual() {
    let elastic = |_: &mut Vec<Joint>, members: &mut Vec<Member>| {
        for member in members {
            member.stiffness_n = member.stiffness_n.or(Some(50.0));
        }
    };
    for (exact, system) in [(false, rig(|_, _| {})), (true, rig(elastic))] {
        for seed in 0..4 {
            let mut equations = Equations::new(&system).unwrap();
            let [y, v] = somewhere(&system, &equations, seed);
            let [_, w] = somewhere(&system, &equations, seed + 100);
            let h = 1e-6;
            let residual = |part: f64| {
                let there: Vec<f64> = y.iter().zip(&v).map(|(y, v)| y + part * v).collect();
                equations.residual(&there).0
            };
            let difference: Vec<f64> =
                residual(h).iter().zip(residual(-h)).map(|(a, b)| (a - b) / (2.0 * h)).collect();
            let _ = equations.factorise(&y);
            let (jv, jw) = (equations.apply(&v), equations.apply(&w));
            close(&jv, &difference, 1e-7);
            let (vjw, wjv) = (dot(&v, &jw), dot(&w, &jv));
            assert!((vjw - wjv).abs() < 1e-12 * (1.0 + vjw.abs()), "{vjw} {wjv}");
            if exact {
                close(&equations.solve(&jv), &v, 1e-8);
            }
        }
    }
}

/// What a longer member and a support that moves do to $G$, against the equations of the changed system.
#[test]
fn changes_of_lengths_and_places_are_those_of_the_system() {
    let system = rig(|_, _| {});
    let mut equations = Equations::new(&system).unwrap();
    let [length_m, _] = equations.units();
    let h = 1e-6;
    for seed in 0..3 {
        equations.set(&system);
        let [y, phi] = somewhere(&system, &equations, seed);
        let changed = |equations: &mut Equations, change: &dyn Fn(f64) -> System| {
            let mut at = |by: f64| {
                equations.set(&change(by));
                dot(&equations.residual(&y).0, &phi)
            };
            (at(h) - at(-h)) / (2.0 * h)
        };
        let by_length = equations.by_length(&system, &y, &phi);
        for (k, found) in by_length.iter().enumerate() {
            let longer = |by: f64| {
                rig(|_, members| {
                    let body = &members[k].body;
                    let length_m = body.length_m() + by * length_m;
                    members[k].body = Bar::homogeneous(length_m, body.mass_kg()).unwrap();
                })
            };
            let wanted = changed(&mut equations, &longer);
            assert!((found - wanted).abs() < 1e-7, "{k}: {found}, not {wanted}");
        }
        equations.set(&system);
        let by_place = equations.by_place(&y, &phi);
        for (joint, found) in by_place.iter().enumerate() {
            for axis in 0..3 {
                let moved = |by: f64| {
                    rig(|joints, _| match &mut joints[joint].support {
                        Support::Free => {}
                        Support::Fixed { at_m }
                        | Support::Line { at_m, .. }
                        | Support::Plane { at_m, .. } => at_m[axis] += by * length_m,
                    })
                };
                let wanted = changed(&mut equations, &moved);
                assert!((found[axis] - wanted).abs() < 1e-7, "{joint} {axis}: {found} {wanted}");
            }
        }
    }
}

/// Where a prestress is given the length is that at which it is borne, and a load at a place in metres comes nearer to the
/// beginning of what is longer.
#[test]
fn lengths_are_those_that_are_given() {
    let strut = |length_m: f64| {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [0.0, 1.0, -3.0]),
            Joint::free("P").with_force([5.0, -1.0, 2.0]),
        ];
        let load = PointLoad { at_m: 0.4, force_n: [1.5, 0.5, -4.0], is_spread: false };
        let tight = Member::bar(0, 2, Bar::homogeneous(length_m, 0.7).unwrap())
            .with_stiffness(90.0)
            .with_loads(vec![load])
            .with_prestress(25.0)
            .unwrap();
        let other = Member::bar(1, 2, Bar::homogeneous(2.0, 0.3).unwrap()).with_stiffness(60.0);
        System::new("tight", 9.81, joints, vec![tight, other]).unwrap()
    };
    let (system, h) = (strut(1.3), 1e-6);
    let mut equations = Equations::new(&system).unwrap();
    let [length_m, _] = equations.units();
    let [y, phi] = somewhere(&system, &equations, 7);
    let found = equations.by_length(&system, &y, &phi)[0];
    let at = |by: f64, equations: &mut Equations| {
        equations.set(&strut(1.3 + by * length_m));
        dot(&equations.residual(&y).0, &phi)
    };
    let wanted = (at(h, &mut equations) - at(-h, &mut equations)) / (2.0 * h);
    assert!((found - wanted).abs() < 1e-8, "{found}, not {wanted}");
}

/// A drawing: of what is taut the stretch over the compliance, of what is slack nothing; the conditions are forces
/// of what is taut, and how far what is slack is from being so.
#[test]
fn drawings_say_what_is_taut() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(1.0),
        Joint::anchor("B", [0.0, 0.0, -5.0]),
    ];
    let along = |from, kind, length_m, stiffness_n| {
        Member::bar(from, 1, Bar::homogeneous(length_m, 0.0).unwrap())
            .of_kind(kind)
            .with_stiffness(stiffness_n)
    };
    // P stands 2 m below A and 3 m above B.
    let members = vec![
        along(0, Kind::Cable, 1.6, Some(80.0)),
        along(0, Kind::Cable, 2.5, Some(80.0)),
        along(0, Kind::Cable, 2.0, None),
        along(0, Kind::Cable, 2.25, None),
        along(2, Kind::Strut, 3.75, Some(60.0)),
        along(2, Kind::Strut, 2.5, Some(60.0)),
        along(2, Kind::Strut, 3.0, None),
        along(2, Kind::Strut, 2.75, None),
        along(2, Kind::Bar, 2.4, Some(40.0)),
    ];
    let mut distinct = joints.clone();
    // Members side by side would be one: each has a joint of its own in one place.
    for (k, _) in members.iter().enumerate().skip(1) {
        distinct.push(Joint::free(format!("P{k}")).with_mass(1.0));
    }
    let members: Vec<Member> = members
        .into_iter()
        .enumerate()
        .map(|(k, member)| {
            let (from, to) = (member.from, if k == 0 { 1 } else { 2 + k });
            member.between(from, to)
        })
        .collect();
    let system = System::new("drawn", 9.81, distinct, members).unwrap();
    let mut equations = Equations::new(&system).unwrap();
    let [length_m, force_n] = equations.units();
    let mut drawn_m = vec![[0.0, 0.0, -2.0]; system.joints().len()];
    (drawn_m[0], drawn_m[2]) = ([0.0; 3], [0.0, 0.0, -5.0]);
    let y = equations.drawn(&drawn_m);
    let axial: Vec<f64> = y[3 * drawn_m.len()..].iter().map(|n| n * force_n).collect();
    // 80 N (2 - 1.6)/1.6, 60 N (3 - 3.75)/3.75, 40 N (3 - 2.4)/2.4.
    close(&axial, &[20.0, 0.0, 0.0, 0.0, -12.0, 0.0, 0.0, 0.0, 10.0], 1e-12);
    let wanted = [
        (0, 20.0 / force_n),
        (1, 0.5 / length_m),
        (2, 0.0),
        (3, 0.25 / length_m),
        (4, 12.0 / force_n),
        (5, 0.5 / length_m),
        (6, 0.0),
        (7, 0.25 / length_m),
    ];
    let sides = equations.sides(&y);
    assert_eq!(sides.len(), wanted.len());
    for ((side, value), (member, wanted)) in sides.into_iter().zip(wanted) {
        assert_eq!(side, Side::Member(member));
        assert!((value - wanted).abs() < 1e-12, "{member}: {value}, not {wanted}");
    }
    // What is taut says so as it changes sides, and what is slack.
    for (member, taut) in [(0, false), (1, true), (2, false), (6, false), (7, true)] {
        assert_eq!(equations.switch(Side::Member(member)).unwrap(), taut, "{member}");
    }
}

/// 8 N in a V of two bars of 5 m over 6 m, with a cable of 7 m beside it to an anchor 6 m above: at the answer nothing is
/// left, the bars bear 5 N, and the cable is slack by 7 m - 6 m.
#[test]
fn answers_are_where_nothing_is_left() {
    let joints = vec![
        Joint::anchor("A", [-3.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::free("P").with_force([0.0, 0.0, -8.0]),
        Joint::anchor("C", [0.0, 0.0, 2.0]),
    ];
    let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let members = vec![
        Member::bar(0, 2, body(5.0)),
        Member::bar(1, 2, body(5.0)),
        Member::cable(3, 2, body(7.0)),
    ];
    let system = System::new("V", 9.81, joints, members).unwrap();
    let mut equations = Equations::new(&system).unwrap();
    let y = equations.at(&system, &solve(&system, &Settings::default()).unwrap());
    let [length_m, force_n] = equations.units();
    assert!(equations.residual(&y).1 < 1e-14 && y.len() == 15);
    assert!((equations.units()[0] - 17.0 / 3.0).abs() < 1e-14);
    let axial: Vec<f64> = y[12..].iter().map(|n| n * force_n).collect();
    close(&axial, &[5.0, 5.0, 0.0], 1e-12);
    assert!(((y[8] - y[11]) * length_m + 6.0).abs() < 1e-12, "{y:?}");
    let [(side, value)] = equations.sides(&y)[..] else { panic!() };
    assert!(side == Side::Member(2) && (value * length_m - 1.0).abs() < 1e-12, "{value}");
    assert_eq!(equations.factorise(&y), Some(0));
}

/// Ropes over P, 3 m right of A and 4 m below B: drawn 7 m long, of 80 N and of 60 N a length of 6.4 and of 7.5 m.
#[test]
fn drawn_ropes_are_as_long_as_their_spans() {
    let joints = samples::joints(&[[0.0; 3], [3.0, 0.0, 4.0]], &[1.0]);
    let rope = |length_m, stiffness_n| {
        let body = Bar::homogeneous(length_m, 0.0).unwrap();
        Member::cable(0, 1, body).over(vec![2]).with_stiffness(stiffness_n)
    };
    let system =
        System::new("drawn", 9.81, joints, vec![rope(6.4, 80.0), rope(7.5, 60.0)]).unwrap();
    let mut equations = Equations::new(&system).unwrap();
    let [length_m, force_n] = equations.units();
    let y = equations.drawn(&[[0.0; 3], [3.0, 0.0, 4.0], [3.0, 0.0, 0.0]]);
    close(&y[9..], &[80.0 * 0.6 / 6.4 / force_n, 0.0], 1e-12);
    let [(first, force), (second, slack)] = equations.sides(&y)[..] else { panic!() };
    assert_eq!((first, second), (Side::Member(0), Side::Member(1)));
    close(&[force * force_n, slack * length_m], &[7.5, 0.5], 1e-12);
}
