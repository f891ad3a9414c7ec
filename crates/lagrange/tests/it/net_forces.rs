//! Systems whose forces are one family: ranges of the members' forces.

use lagrange::net::{Forces, Seed, Settings, Solution, solve, solve_from};
use model::ForceRange;
use model::system::{Joint, Kind, Support, System};

use crate::net::{bar, cable, close, hang, system};

const EXACT: f64 = 1e-9;

fn told(solution: Solution) -> Vec<ForceRange> {
    solution.equilibrium.evidence.self_stresses.unwrap().ranges.unwrap()
}

fn ranges(system: &System) -> Vec<ForceRange> {
    told(solve(system, &Settings::default()).unwrap())
}

#[track_caller]
fn bounded(range: ForceRange, least: Option<f64>, most: Option<f64>) {
    let ForceRange::Bounded { least_n, most_n } = range else { panic!("{range:?}") };
    for (got, expected) in [(least_n, least), (most_n, most)] {
        match (got, expected) {
            (Some(a), Some(b)) => assert!((a - b).abs() < EXACT, "{range:?}"),
            (None, None) => {}
            _ => panic!("{range:?}, not {least:?} to {most:?}"),
        }
    }
}

/// A square of struts braced by two cables, held in its plane at one corner and on a rail at
/// another: the self-stress has `t sqrt 2` in the cables and `-t` in the struts. Weights of 1 N at
/// the upper corners need 1 N of push in the two uprights: from there any prestress goes.
#[test]
fn square_with_two_cables() {
    let plane = |x: f64, z: f64, name: &str| {
        Joint::free(name)
            .with_mass(1.0)
            .held_by(Support::Plane { at_m: [x, 0.0, z], normal: [0.0, 1.0, 0.0] })
    };
    let rail = Support::Line { at_m: [1.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("B").held_by(rail),
        plane(1.0, 1.0, "C"),
        plane(0.0, 1.0, "D"),
    ];
    let strut = |from, to| bar(from, to, 1.0, 0.0).of_kind(Kind::Strut);
    let root = 2.0_f64.sqrt();
    let members = vec![
        strut(0, 1),
        strut(1, 2),
        strut(2, 3),
        strut(3, 0),
        cable(0, 2, root, 0.0),
        cable(1, 3, root, 0.0),
    ];
    let system = system(joints, members);
    // It stands; hanging below its supports it would have less energy.
    let square = [0.0, 1.0].map(|x| [x, 0.0, 0.0]).into_iter();
    let square = square.chain([1.0, 0.0].map(|x| [x, 0.0, 1.0])).collect();
    let prestress = vec![-1.0, -2.0, -1.0, -2.0, root, root];
    let seed = Seed { axial_n: Some(prestress), ..Seed::at(square) };
    let solution = solve_from(&system, &seed, &Settings::default()).unwrap();
    let stresses = solution.self_stresses.as_ref().unwrap();
    assert_eq!(stresses.len(), 1);
    for k in 0..4 {
        assert!((stresses[0][4] + root * stresses[0][k]).abs() < EXACT, "{stresses:?}");
    }
    let [counted, left] = solution.rank_gap.unwrap();
    assert!(counted > 0.1 && left < 1e-14);
    let ranges = told(solution);
    bounded(ranges[0], None, Some(0.0));
    bounded(ranges[1], None, Some(-1.0));
    bounded(ranges[2], None, Some(0.0));
    bounded(ranges[3], None, Some(-1.0));
    bounded(ranges[4], Some(0.0), None);
    bounded(ranges[5], Some(0.0), None);
}

/// The same three members to a weight as cables and as bars.
#[test]
fn fans() {
    let root = 2.0_f64.sqrt();
    let fan = |kind: Kind| {
        let mut joints: Vec<_> =
            [-1.0, 0.0, 1.0].map(|x| Joint::anchor(format!("{x}"), [x, 0.0, 0.0])).into();
        joints.push(Joint::free("P").with_mass(1.0));
        joints.push(Joint::free("Q").with_mass(1.0));
        let member = |from, length| bar(from, 3, length, 0.0).of_kind(kind);
        let hanger = bar(3, 4, 0.5, 0.0);
        system(joints, vec![member(0, root), member(1, 1.0), member(2, root), hanger])
    };
    let cables = ranges(&fan(Kind::Cable));
    bounded(cables[0], Some(0.0), Some(root));
    bounded(cables[1], Some(0.0), Some(2.0));
    bounded(cables[2], Some(0.0), Some(root));
    assert_eq!(cables[3], ForceRange::Unique);
    let bars = ranges(&fan(Kind::Bar));
    assert_eq!(bars[..3], [ForceRange::Free; 3]);
    assert_eq!(bars[3], ForceRange::Unique);
    // With axial forces a, b, a the weights 2 are `sqrt 2 a + b` and least `2 sqrt 2 a² + b²` gives `b = 2 a`.
    let solution = hang(&fan(Kind::Bar));
    assert_eq!(solution.forces, Forces::LeastNorm);
    assert_eq!(solution.self_stresses.as_ref().map(Vec::len), Some(1));
    let least = 2.0 / (2.0 + root);
    for (axial, wanted) in solution.equilibrium.axial_n.iter().zip([least, 2.0 * least, least]) {
        close(*axial, wanted);
    }
}

/// Five cables in one plane to a weight: three self-stresses. The least force of each is zero, and
/// the largest that of bearing the weight with at most one other: of the steep cable at x = 0 the
/// whole weight.
#[test]
fn five_cables_in_a_plane() {
    let places = [-2.0, -1.0, 0.0, 1.0, 2.0_f64];
    let mut joints: Vec<_> = places.map(|x| Joint::anchor(format!("{x}"), [x, 0.0, 0.0])).into();
    joints.push(Joint::free("P").with_mass(1.0));
    let members = places.iter().enumerate();
    let members = members.map(|(k, x)| cable(k, 5, x.hypot(1.0), 0.0)).collect();
    let system = system(joints, members);
    let solution = solve(&system, &Settings::default()).unwrap();
    assert_eq!(solution.self_stresses.as_ref().map(Vec::len), Some(3));
    assert!(matches!(solution.forces, Forces::LeastNorm | Forces::Found));
    let ranges = told(solution);
    // With the force densities w: sum w = 1, sum w x = 0, w >= 0; so w of x is at most that of x
    // and the opposite side's farthest: 2 / (2 + |x|).
    for (range, x) in ranges.iter().zip(places) {
        bounded(*range, Some(0.0), Some(2.0 / (2.0 + x.abs()) * x.hypot(1.0)));
    }
}

/// Upright between A and B, 3 m above it: a cable of 1 m, a bar of 0.5 m and a prop of 1.5 m, which just fit, with 10 N and 20 N
/// between them. The bar bears from -10 N, where the cable is about to be slack, to 20 N, where the prop is.
#[test]
fn a_bar_between_a_cable_and_a_prop() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(10.0),
        Joint::free("Q").with_mass(20.0),
        Joint::anchor("B", [0.0, 0.0, -3.0]),
    ];
    let prop = bar(2, 3, 1.5, 0.0).of_kind(Kind::Strut);
    let system = system(joints, vec![cable(0, 1, 1.0, 0.0), bar(1, 2, 0.5, 0.0), prop]);
    let places = [0.0, -1.0, -1.5, -3.0].map(|z| [0.0, 0.0, z]).to_vec();
    let seed = Seed { axial_n: Some(vec![16.0, 6.0, -14.0]), ..Seed::at(places) };
    let found = told(solve_from(&system, &seed, &Settings::default()).unwrap());
    bounded(found[0], Some(0.0), Some(30.0));
    bounded(found[1], Some(-10.0), Some(20.0));
    bounded(found[2], Some(-30.0), Some(0.0));
}

/// Three cables and a bar on one joint in a plane: extremes by linear programming (HiGHS), whichever of them are taken for slack
/// on the way to the forces that are shown.
#[test]
fn what_bears_nothing_at_first_is_open_too() {
    let feet = [[1.433, -1.917], [-0.16, 1.009], [-1.363, -1.002], [-1.813, -0.316]];
    let at = [-0.917, -1.207];
    for order in [[0, 1, 2, 3], [3, 2, 1, 0], [2, 0, 3, 1]] {
        let anchor = |k: usize| Joint::anchor(format!("{k}"), [feet[k][0], 0.0, feet[k][1]]);
        let mut joints: Vec<Joint> = order.map(anchor).into();
        let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
        let free = Joint::free("P").held_by(plane).with_mass(10.42 * 9.80665);
        joints.push(free.with_force([10.6, 0.0, -0.5]));
        let member = |(n, k): (usize, usize)| {
            let length_m = (feet[k][0] - at[0]).hypot(feet[k][1] - at[1]);
            let kind = if k == 2 { Kind::Bar } else { Kind::Cable };
            bar(n, 4, length_m, 0.0).of_kind(kind)
        };
        let system = system(joints.clone(), order.into_iter().enumerate().map(member).collect());
        let places = joints.iter().map(|joint| joint.support.at_m().unwrap());
        let places = places.take(4).chain([[at[0], 0.0, at[1]]]).collect();
        let found = told(solve_from(&system, &Seed::at(places), &Settings::default()).unwrap());
        let extremes = [
            (0.0, 648.705_050_180_61),
            (0.0, 89.335_641_446_789),
            (-189.633_825_369_21, 695.104_638_262_92),
            (0.0, 257.944_577_107_58),
        ];
        for (range, k) in found.into_iter().zip(order) {
            bounded(range, Some(extremes[k].0), Some(extremes[k].1));
        }
    }
}

/// A box tower of four storeys with rigid cables crossed on its sides, 100 N on each joint: at a joint of the top the cables only
/// pull down, so its column pushes by 100 N or more, and cables can bear anything from zero on.
#[test]
fn ranges_of_many_self_stresses_are_those_of_the_balance() {
    let storeys = 4;
    let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
    let place = |joint: usize| {
        let [x, y]: [f64; 2] = corners[joint % 4];
        [x, y, 2.0 * (joint / 4) as f64]
    };
    let joints = (0..4 * storeys + 4).map(|joint| match joint {
        0..4 => Joint::anchor(format!("{joint}"), place(joint)),
        _ => Joint::free(format!("{joint}")).with_mass(100.0).near(place(joint)),
    });
    let member = |a: usize, b: usize, kind| {
        let square: f64 = place(a).iter().zip(place(b)).map(|(a, b)| (a - b).powi(2)).sum();
        bar(a, b, square.sqrt(), 0.0).of_kind(kind)
    };
    let members = (0..storeys).flat_map(|storey| {
        let at = move |level: usize, corner: usize| 4 * (storey + level) + corner % 4;
        let columns = (0..4).map(move |k| member(at(0, k), at(1, k), Kind::Bar));
        let beams = (0..4).map(move |k| member(at(1, k), at(1, k + 1), Kind::Bar));
        let across = [member(at(1, 0), at(1, 2), Kind::Bar)];
        let cables = (0..4).flat_map(move |k| {
            [(k, k + 1), (k + 1, k)].map(|(low, high)| member(at(0, low), at(1, high), Kind::Cable))
        });
        columns.chain(beams).chain(across).chain(cables)
    });
    let system = system(joints.collect(), members.collect());
    let places = system.drawing().unwrap();
    let found = told(solve_from(&system, &Seed::at(places), &Settings::default()).unwrap());
    for (member, range) in system.members().iter().zip(found) {
        match member.kind {
            Kind::Cable => bounded(range, Some(0.0), None),
            _ if member.from >= 4 * storeys - 4 && member.to == member.from + 4 => {
                bounded(range, None, Some(-100.0));
            }
            _ => {}
        }
    }
}
