//! Derivatives of equilibria against central differences.

use lagrange::net::{
    Change, Derivatives, Error, Parameter, Seed, Settings, Solution, solve, solve_from,
};
use model::Bar;
use model::system::{Joint, Member, PointLoad, Support, System};
use nalgebra::{Matrix3, Vector3};

use crate::net::{bar, cable, close};

/// Step of the differences, in units of the parameter's size; their error is its square and
/// the solver's tolerance over it.
const STEP: f64 = 1e-4;
/// What they agree to, in units of the largest derivative of a kind.
const AGREE: f64 = 1e-6;

/// A bridle in space of bars, a cable, springs and a slider, with loads on bars and a spring between
/// two anchors; a spring with a load, a cable and the spring between the anchors are given by what
/// they bear at a length. Centres that are given and such that are not; no two terms of one size.
fn bridle() -> System {
    let mut joints = samples::joints(&[[-2.0, -1.0, 0.3], [2.0, -0.5, 0.0], [0.2, 2.0, -0.2]], &[]);
    let line = Support::Line { at_m: [0.0, -2.0, -1.0], direction: [0.0, 0.6, -0.8] };
    joints.push(Joint::free("S").with_mass(0.5).held_by(line));
    joints.push(Joint::free("P").with_mass(2.0).with_force([0.3, 0.1, 0.0]));
    joints.extend(["Q", "R"].map(|name| Joint::free(name).with_mass(0.7)));
    let load = PointLoad { at_m: 0.4, force_n: [0.2, 0.0, -0.5], is_spread: false };
    let on_spring = [PointLoad { at_m: 0.3, force_n: [-0.1, 0.6, 0.25], is_spread: false }];
    let spring = Member::bar(5, 4, Bar::new(1.5, 0.5, 0.4, [0.0; 3]).unwrap());
    let spring = spring.with_loads(on_spring.into()).with_stiffness(300.0);
    let held = Member::bar(0, 1, Bar::new(3.3, 0.3, 1.1, [0.0; 3]).unwrap());
    let members = vec![
        bar(0, 5, 1.5, 0.8),
        spring.with_prestress(17.0).unwrap(),
        bar(1, 6, 1.2, 1.0).with_loads(vec![load]),
        cable(6, 4, 1.5, 0.2),
        cable(2, 4, 3.0, 0.4).with_stiffness(50.0).with_prestress(5.0).unwrap(),
        Member::bar(3, 4, Bar::new(1.9, 0.6, 0.5, [0.0; 3]).unwrap()),
        held.with_stiffness(20.0).with_prestress(-3.0).unwrap(),
    ];
    System::new("bridle", 9.80665, joints, members).unwrap()
}

/// Ropes over rings and pulleys: one that keeps its length and meets a ring twice, an elastic one with both ends at
/// joints that move, an elastic one along anchors alone. No two terms of one size.
fn roped() -> System {
    let joints = vec![
        Joint::anchor("A", [-2.0, -1.0, 0.3]),
        Joint::anchor("B", [2.0, -0.5, 0.0]),
        Joint::anchor("C", [0.2, 2.0, -0.2]),
        Joint::free("P").with_mass(2.0).with_force([0.3, 0.1, 0.0]),
        Joint::free("Q").with_mass(1.7).with_force([2.0, 3.0, 0.0]),
        Joint::free("R").with_mass(1.1).with_force([0.0, -0.2, 0.1]),
    ];
    let rope = |path: &[usize], length_m: f64| {
        let (last, body) = (path.len() - 1, Bar::homogeneous(length_m, 0.0).unwrap());
        Member::cable(path[0], path[last], body).over(path[1..last].to_vec())
    };
    let members = vec![
        rope(&[0, 3, 1, 3, 4, 2], 10.5),
        rope(&[3, 1, 5], 5.0).with_stiffness(90.0),
        rope(&[1, 0, 2], 6.5).with_stiffness(40.0),
        cable(2, 4, 2.2, 0.4),
        cable(0, 5, 3.0, 0.2).with_stiffness(150.0).with_prestress(4.0).unwrap(),
        bar(4, 5, 2.4, 0.6),
    ];
    System::new("roped", 9.80665, joints, members).unwrap()
}

/// The member that is described by its numbers larger by these: length, mass, stiffness, prestress.
fn given(member: &mut Member, [length_m, mass_kg, stiffness_n, more_n]: [f64; 4]) {
    let prestress_n = member.prestress_n();
    let mut given = member.clone().as_given();
    let (body, centre_m) = (given.body, given.body.given_centre_m());
    let (length_m, mass_kg) = (body.length_m() + length_m, body.mass_kg() + mass_kg);
    given.body = Bar::given(length_m, mass_kg, centre_m, None).unwrap();
    given.stiffness_n = given.stiffness_n.map(|k| k + stiffness_n);
    let is_prestressed = given.stiffness_n.is_some() && (prestress_n.is_some() || more_n != 0.0);
    *member = if is_prestressed {
        given.with_prestress(prestress_n.unwrap_or(0.0) + more_n).unwrap()
    } else {
        given
    };
}

/// The system with one parameter larger by `by`.
fn with(system: &System, parameter: Parameter, by: f64) -> System {
    let (mut joints, mut members) = (system.joints().to_vec(), system.members().to_vec());
    match parameter {
        Parameter::Length { member } => given(&mut members[member], [by, 0.0, 0.0, 0.0]),
        Parameter::Mass { member } => given(&mut members[member], [0.0, by, 0.0, 0.0]),
        Parameter::Stiffness { member } => given(&mut members[member], [0.0, 0.0, by, 0.0]),
        Parameter::Prestress { member } => given(&mut members[member], [0.0, 0.0, 0.0, by]),
        Parameter::Force { joint, axis } => joints[joint].force_n[axis] += by,
        Parameter::Anchor { joint, axis } => {
            if let Support::Fixed { at_m } = &mut joints[joint].support {
                at_m[axis] += by;
            }
        }
    }
    System::new("changed", system.gravity_m_s2(), joints, members).unwrap()
}

fn hang(system: &System) -> Solution {
    solve(system, &Settings::default()).unwrap()
}

/// Places, axial forces and reactions one after another.
fn flat(change: &Change) -> [Vec<f64>; 3] {
    [change.joints_m.concat(), change.axial_n.clone(), change.reactions_n.concat()]
}

fn differences(system: &System, parameter: Parameter) -> [Vec<f64>; 3] {
    let numbers = |by: f64| {
        let answer = hang(&with(system, parameter, by)).equilibrium;
        [answer.joints_m.concat(), answer.axial_n, answer.reactions_n.concat()]
    };
    let (more, less) = (numbers(STEP), numbers(-STEP));
    [0, 1, 2]
        .map(|of| more[of].iter().zip(&less[of]).map(|(a, b)| (a - b) / (2.0 * STEP)).collect())
}

fn parameters(system: &System) -> Vec<Parameter> {
    let mut all = Vec::new();
    for (member, given) in system.members().iter().enumerate() {
        all.push(Parameter::Length { member });
        all.extend(given.stiffness_n.map(|_| Parameter::Stiffness { member }));
        // A rope has neither.
        if given.rope.is_none() {
            all.push(Parameter::Mass { member });
            all.extend(given.stiffness_n.map(|_| Parameter::Prestress { member }));
        }
    }
    for (joint, given) in system.joints().iter().enumerate() {
        for axis in 0..3 {
            all.push(Parameter::Force { joint, axis });
            if given.support.is_fixed() {
                all.push(Parameter::Anchor { joint, axis });
            }
        }
    }
    all
}

#[test]
fn by_every_parameter() {
    for system in [bridle(), roped()] {
        let solution = hang(&system);
        assert!(solution.slack.is_empty() && solution.limp.is_empty(), "{solution:?}");
        let mut derivatives = Derivatives::new(&system, &solution).unwrap();
        for parameter in parameters(&system) {
            let exact = flat(&derivatives.change(parameter).unwrap());
            let numeric = differences(&system, parameter);
            for (exact, numeric) in exact.iter().zip(&numeric) {
                let largest = exact.iter().fold(1e-3_f64, |most, d| most.max(d.abs()));
                for (a, b) in exact.iter().zip(numeric) {
                    assert!((a - b).abs() <= AGREE * largest, "{parameter:?}: {a} against {b}");
                }
            }
        }
    }
}

/// The adjoint gives the same numbers as the changes one by one.
#[test]
fn the_gradient_is_the_adjoint_of_the_changes() {
    for system in [bridle(), roped()] {
        let solution = hang(&system);
        let mut derivatives = Derivatives::new(&system, &solution).unwrap();
        // Any weights.
        let by_joints: Vec<[f64; 3]> = (0..system.joints().len())
            .map(|k| [0.3, -0.7, 1.1].map(|w| w * (k as f64 + 0.5).sin()))
            .collect();
        let by_axial: Vec<f64> =
            (0..system.members().len()).map(|k| (1.7 * k as f64 + 0.2).cos()).collect();
        let gradient = derivatives.gradient(&by_joints, &by_axial).unwrap();
        for parameter in parameters(&system) {
            let change = derivatives.change(parameter).unwrap();
            let places = change.joints_m.iter().zip(&by_joints);
            let places: f64 =
                places.map(|(d, w)| d.iter().zip(w).map(|(d, w)| d * w).sum::<f64>()).sum();
            let forces: f64 = change.axial_n.iter().zip(&by_axial).map(|(d, w)| d * w).sum();
            let adjoint = match parameter {
                Parameter::Length { member } => gradient.by_length[member],
                Parameter::Stiffness { member } => gradient.by_stiffness[member],
                Parameter::Prestress { member } => gradient.by_prestress[member],
                Parameter::Mass { member } => gradient.by_mass[member],
                Parameter::Force { joint, axis } => gradient.by_force[joint][axis],
                Parameter::Anchor { joint, axis } => gradient.by_anchor[joint][axis],
            };
            let difference = (adjoint - places - forces).abs();
            assert!(difference <= 1e-10 * adjoint.abs().max(1.0), "{parameter:?}: {difference:e}");
        }
    }
}

/// The stiffness matrices of the anchors are those of differences, entry by entry (none of them is its
/// own transpose), symmetric together, and a common translation of all supports changes nothing.
#[test]
fn anchors_as_springs() {
    /// The largest entry is less, N/m.
    const LARGEST: f64 = 100.0;
    let joints =
        samples::joints(&[[-2.0, -1.0, 0.3], [2.0, -0.5, 0.0], [0.2, 2.0, -0.2]], &[2.0, 1.0]);
    let members = vec![
        bar(0, 4, 1.5, 0.8),
        bar(4, 3, 1.4, 0.5).with_stiffness(300.0),
        bar(1, 3, 2.4, 1.0),
        cable(2, 3, 2.6, 0.4),
    ];
    let system = System::new("bridle", 9.80665, joints, members).unwrap();
    let solution = hang(&system);
    let mut derivatives = Derivatives::new(&system, &solution).unwrap();
    for of in 0..3 {
        let mut sum = [[0.0; 3]; 3];
        for by in 0..3 {
            let (one, other) = (
                derivatives.anchor_stiffness(of, by).unwrap(),
                derivatives.anchor_stiffness(by, of).unwrap(),
            );
            for axis in 0..3 {
                let reactions = &differences(&system, Parameter::Anchor { joint: by, axis })[2];
                for (row, differ) in reactions[3 * of..3 * of + 3].iter().enumerate() {
                    assert!((one[row][axis] - differ).abs() < AGREE * LARGEST, "{one:?}");
                }
            }
            let skew = (0..3).map(|k| (one[k][(k + 1) % 3] - one[(k + 1) % 3][k]).abs());
            assert!(of == by || skew.fold(0.0, f64::max) > 1e-2, "{one:?}");
            for row in 0..3 {
                for column in 0..3 {
                    assert!((one[row][column] - other[column][row]).abs() < 1e-9);
                    sum[row][column] += one[row][column];
                }
            }
        }
        assert!(sum.iter().flatten().all(|s| s.abs() < 1e-9), "{sum:?}");
    }
    assert!(derivatives.anchor_stiffness(0, 0).unwrap()[0][0] > 0.0);
}

/// A chain of two bars below one anchor swings freely about the vertical, and its forces are not
/// differentiable where nothing holds it; a bar between two anchors does not let them move.
#[test]
fn refusals() {
    let joints = samples::joints(&[[0.0; 3], [1.0, 0.0, 0.0]], &[1.0]);
    let members = vec![bar(0, 1, 1.0, 1.0), bar(0, 2, 2.0, 0.0)];
    let system = System::new("held", 9.80665, joints.clone(), members).unwrap();
    let solution = hang(&system);
    let mut derivatives = Derivatives::new(&system, &solution).unwrap();
    let moved = derivatives.change(Parameter::Anchor { joint: 1, axis: 0 });
    assert!(matches!(moved, Err(Error::NoDerivative { .. })), "{moved:?}");
    let moved = derivatives.change(Parameter::Anchor { joint: 2, axis: 0 });
    assert_eq!(moved, Err(Error::NotAnAnchor { joint: "P".into() }));
    // A slack cable lets them.
    let slack = vec![cable(0, 1, 3.0, 0.0), bar(0, 2, 2.0, 0.0)];
    let slack = System::new("slack", 9.80665, joints, slack).unwrap();
    let mut moved = Derivatives::new(&slack, &hang(&slack)).unwrap();
    let moved = moved.change(Parameter::Anchor { joint: 1, axis: 0 }).unwrap();
    close(moved.joints_m[1][0], 1.0);
    // A pendulum: sideways force moves it by l / W.
    let aside = derivatives.change(Parameter::Force { joint: 2, axis: 1 }).unwrap();
    close(aside.joints_m[2][1], 2.0 / 9.80665);
}

/// Where equilibria have no derivatives, each for its own reason.
#[test]
fn what_is_not_smooth_is_refused() {
    let refused = |joints: Vec<Joint>, members: Vec<Member>, floor_m: Option<f64>| {
        let system = System::new("rough", 10.0, joints, members).unwrap();
        let system = floor_m.map_or(Ok(system.clone()), |z| system.with_floor(z)).unwrap();
        Derivatives::new(&system, &hang(&system)).err()
    };
    let anchor = || Joint::anchor("A", [0.0; 3]);
    // A triangle of rods below one rod turns about the vertical: Q and R hang level with each other
    // or not, but on no line with A.
    let joints = || {
        let loaded = ["Q", "R"].map(|name| Joint::free(name).with_mass(2.0));
        [anchor(), Joint::free("P")].into_iter().chain(loaded).collect::<Vec<_>>()
    };
    let triangle =
        vec![bar(0, 1, 1.0, 0.0), bar(1, 2, 1.3, 0.0), bar(1, 3, 1.1, 0.0), bar(2, 3, 1.0, 0.0)];
    assert_eq!(refused(joints(), triangle, None), Some(Error::FreeMotion { motions: 1 }));
    // Four legs: one self-stress.
    let mut legs: Vec<Joint> = [[3.0, 0.0], [-3.0, 0.0], [0.0, 3.0], [0.0, -3.0]]
        .iter()
        .enumerate()
        .map(|(k, [x, y])| Joint::anchor(k.to_string(), [*x, *y, 0.0]))
        .collect();
    legs.push(Joint::free("P").with_mass(1.0));
    let rods = (0..4).map(|k| bar(k, 4, 5.0, 0.0)).collect();
    assert_eq!(refused(legs, rods, None), Some(Error::OpenForces { dimension: 1 }));
    // A weight on a thread of 2 m, and an elastic cable to a point 5 m aside that is as far away as
    // the cable is long.
    let beside =
        vec![anchor(), Joint::anchor("B", [3.0, 0.0, 2.0]), Joint::free("P").with_mass(1.0)];
    let thread = || vec![bar(0, 2, 2.0, 0.0), cable(1, 2, 5.0, 0.0).with_stiffness(100.0)];
    assert_eq!(refused(beside.clone(), thread(), None), Some(Error::JustTaut { member: 2 }));
    let mut shorter = thread();
    shorter[1] = cable(1, 2, 4.9, 0.0).with_stiffness(100.0);
    assert_eq!(refused(beside, shorter, None), None);
    // Which just reaches the floor, and is pushed by it where it is elastic and lies there.
    let weight = || vec![anchor(), Joint::free("P").with_mass(1.0)];
    let touches = Some(Error::JustTouches { joint: "P".into() });
    let soft = || vec![bar(0, 1, 2.0, 0.0).with_stiffness(20.0)];
    assert_eq!(refused(weight(), soft(), Some(-3.0)), touches);
    assert_eq!(refused(weight(), soft(), Some(-3.1)), None);
}

/// Four legs that strain by some 1e-8 under their load: moves by forces are those of the stiffness `Σ EA/l u uᵀ`, whose
/// relative error from the forces of the legs is of that size.
#[test]
fn legs_that_are_stiff_for_their_load() {
    let feet = [
        [1.3374, -0.1462, 0.0383],
        [-0.0948, 1.0016, -0.0656],
        [-1.1738, 0.404, 0.0873],
        [0.323, -1.334, -0.0584],
    ];
    let stiffnesses_n = [68_788_943.0, 97_671_300.0, 163_533_960.0, 18_747_626.0];
    let apex = Vector3::new(0.0, 0.0, 1.0037);
    let mut joints: Vec<Joint> =
        (feet.iter().enumerate()).map(|(k, foot)| Joint::anchor(format!("A{k}"), *foot)).collect();
    joints.push(Joint::free("P").with_force([0.088, -0.047, -1.386]));
    let mut stiffness = Matrix3::zeros();
    let mut members = vec![];
    for (k, (foot, ea_n)) in feet.iter().zip(stiffnesses_n).enumerate() {
        let leg = apex - Vector3::from(*foot);
        members.push(bar(k, 4, leg.norm(), 0.0).with_stiffness(ea_n));
        stiffness += leg * leg.transpose() * (ea_n / leg.norm().powi(3));
    }
    let system = System::new("legs", 9.80665, joints, members).unwrap();
    let solution =
        solve_from(&system, &Seed::at([&feet[..], &[apex.into()]].concat()), &Settings::default())
            .unwrap();
    let mut derivatives = Derivatives::new(&system, &solution).unwrap();
    let moves = stiffness.try_inverse().unwrap();
    for axis in 0..3 {
        let change = derivatives.change(Parameter::Force { joint: 4, axis }).unwrap();
        let told = Vector3::from(change.joints_m[4]);
        assert!((told - moves.column(axis)).norm() < 1e-6 * moves.norm(), "{told} {moves}");
        let change = derivatives.change(Parameter::Length { member: axis });
        assert!(change.is_ok(), "{change:?}");
    }
}
