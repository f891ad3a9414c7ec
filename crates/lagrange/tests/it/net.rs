//! Systems of members against closed forms, and every answer against Newton's laws.

use lagrange::net::{Error, Forces, Seed, Settings, Solution, solve, solve_from};
use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, InSpace, Vector};
use nalgebra::Vector3;

/// Twice the tolerance of the solver, relative to the number or to one.
const EXACT: f64 = 2e-12;

pub(crate) fn bar(from: usize, to: usize, length_m: f64, mass_kg: f64) -> Member {
    Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).unwrap())
}

pub(crate) fn cable(from: usize, to: usize, length_m: f64, mass_kg: f64) -> Member {
    bar(from, to, length_m, mass_kg).of_kind(Kind::Cable)
}

/// Gravity 1 m/s²: weights in N are masses in kg.
pub(crate) fn system(joints: Vec<Joint>, members: Vec<Member>) -> System {
    System::new("test", 1.0, joints, members).unwrap()
}

pub(crate) fn hang(system: &System) -> Solution {
    let solution = solve(system, &Settings::default()).unwrap();
    judge(system, &solution);
    solution
}

#[track_caller]
pub(crate) fn close(got: f64, expected: f64) {
    assert!((got - expected).abs() <= EXACT * expected.abs().max(1.0), "{got} is not {expected}");
}

#[track_caller]
pub(crate) fn near(got: Vector, expected: Vector) {
    for axis in 0..3 {
        close(got[axis], expected[axis]);
    }
}

#[track_caller]
fn judge(system: &System, solution: &Solution) {
    let faults = faults(system, solution);
    assert!(faults.is_empty(), "{}", faults.join(", "));
}

/// Newton's laws and the laws of the members, from the observables alone: what does not hold.
pub(crate) fn faults(system: &System, solution: &Solution) -> Vec<String> {
    let answer = &solution.equilibrium;
    let largest = answer.axial_n.iter().fold(1e-300, |most: f64, n| most.max(n.abs()));
    let g = system.gravity_m_s2();
    let mut faults = Vec::new();
    let mut hold = |what: String, size: f64, limit: f64| {
        // A NaN does not hold.
        if size.is_nan() || size > limit {
            faults.push(format!("{what}: {size:e}"));
        }
    };
    let ground = system.joints().iter().zip(&answer.reactions_n);
    let ground = ground.map(|(joint, ground)| {
        let weight = Vector3::z() * (-joint.mass_kg * g);
        Vector3::from(joint.force_n) + weight + Vector3::from(*ground)
    });
    let mut at_joints: Vec<Vector3<f64>> = ground.collect();
    for (k, member) in system.members().iter().enumerate() {
        let [a, b] = [member.from, member.to].map(|joint| Vector3::from(answer.joints_m[joint]));
        let start = Vector3::from(answer.start_forces_n[k]);
        let end = Vector3::from(answer.end_forces_n[k]);
        let length = member.body.length_m();
        let weight = Vector3::z() * (-member.body.mass_kg() * g);
        let mut sum = start + end + weight;
        let lever = |at: f64| (b - a) * (at / length);
        let mut moment = (b - a).cross(&end) + lever(member.body.centre_m()).cross(&weight);
        for load in &member.loads {
            let force = Vector3::from(load.force_n);
            sum += force;
            moment += lever(load.at_m).cross(&force);
        }
        hold(format!("forces on member {k}"), sum.norm(), 1e-11 * largest);
        hold(format!("moments on member {k}"), moment.norm(), 1e-11 * largest * length);
        let axial = answer.axial_n[k];
        let strain = member.stiffness_n.map_or(0.0, |stiffness| axial / stiffness);
        let excess = (b - a).norm() - length * (1.0 + strain);
        let excess = match member.kind {
            Kind::Cable if solution.slack.contains(&k) => excess.max(axial.abs() / largest),
            Kind::Strut if solution.slack.contains(&k) => (-excess).max(axial.abs() / largest),
            _ => excess.abs(),
        };
        hold(format!("length of member {k}"), excess, 2e-12 * length);
        let wrong = match member.kind {
            Kind::Bar => 0.0,
            Kind::Cable => -axial,
            Kind::Strut => axial,
        };
        hold(format!("sign of member {k}"), wrong, 1e-10 * largest);
        at_joints[member.from] -= start;
        at_joints[member.to] -= end;
    }
    for (joint, left) in at_joints.iter().enumerate() {
        hold(format!("balance of joint {joint}"), left.norm(), 1e-11 * largest);
    }
    faults
}

#[test]
fn known_systems_hang_as_by_hand() {
    for known in samples::known() {
        let name = known.system.name();
        let solution = hang(&known.system);
        known.assert_holds(&solution.equilibrium, EXACT);
        assert_eq!(solution.slack, known.slack, "{name}");
        if let Some([mechanisms, self_stresses]) = known.counts {
            let counted = solution.self_stresses.as_ref().map(Vec::len);
            assert_eq!((solution.mechanisms, counted), (Some(mechanisms), Some(self_stresses)));
            let forces = if self_stresses > 0 { Forces::LeastNorm } else { Forces::Unique };
            assert_eq!(solution.forces, forces, "{name}");
        }
    }
}

/// Three legs to anchors on a circle, standing up from a seed above.
#[test]
fn a_tripod_stands() {
    let corner = |k: f64| {
        let angle = std::f64::consts::TAU * k / 3.0;
        [3.0 * angle.cos(), 3.0 * angle.sin(), 0.0]
    };
    let mut joints: Vec<_> =
        (0..3).map(|k| Joint::anchor(format!("A{k}"), corner(f64::from(k)))).collect();
    joints.push(Joint::free("P").with_mass(6.0));
    let system = system(joints, (0..3).map(|k| bar(k, 3, 5.0, 0.0)).collect());
    let mut seed: Vec<Vector> = (0..3).map(|k| corner(f64::from(k))).collect();
    seed.push([0.3, -0.2, 3.0]);
    let standing = solve_from(&system, &Seed::at(seed), &Settings::default()).unwrap();
    judge(&system, &standing);
    near(standing.equilibrium.joints_m[3], [0.0, 0.0, 4.0]);
    for axial in &standing.equilibrium.axial_n {
        close(*axial, -2.5);
    }
    // Three bars hold the point in space: no motion, no index.
    assert_eq!(standing.mechanisms, Some(0));
    assert_eq!(standing.equilibrium.stability.index_in_space, 0);
}

/// The paper's chain, E1 and E2: three bars between anchors at 2 l on one vertical.
#[test]
fn the_papers_chain() {
    let system = {
        let mut joints = vec![Joint::anchor("O", [0.0; 3])];
        joints.extend(["A", "B"].map(Joint::free));
        joints.push(Joint::anchor("D", [0.0, 0.0, -2.0]));
        system(joints, (0..3).map(|k| bar(k, k + 1, 1.0, 1.0)).collect())
    };
    let first = hang(&system).equilibrium;
    // V of FACTS is measured 6 mgl higher.
    close(first.energy_j, 2.335_468_651_999_305 - 6.0);
    let horizontal = |force: Vector| force[0].hypot(force[1]);
    close(horizontal(first.reactions_n[0]), 0.648_944_835_933_933_6);
    close(first.reactions_n[0][2], 2.312_944_292_241_837_6);
    close(first.reactions_n[3][2], 0.687_055_707_758_162_4);
    assert!(first.axial_n[0] > 0.0 && first.axial_n[1] > 0.0 && first.axial_n[2] < 0.0);
    assert_eq!((first.stability.index_in_space, first.stability.neutral), (0, 1));
    assert_eq!(first.stability.index_in_plane, Some(0));
    // E2 from roughly its angles.
    let angles = [73.9_f64, -38.6, -19.7].map(f64::to_radians);
    let mut places = vec![[0.0; 3]];
    for (k, angle) in angles.iter().enumerate() {
        let last = places[k];
        places.push([0.0, last[1] + angle.sin(), last[2] - angle.cos()]);
    }
    let second = solve_from(&system, &Seed::at(places), &Settings::default()).unwrap();
    judge(&system, &second);
    let second = second.equilibrium;
    close(second.energy_j, 3.664_531_348_000_695 - 6.0);
    assert_eq!((second.stability.index_in_space, second.stability.neutral), (2, 1));
    assert_eq!(second.stability.index_in_plane, Some(1));
    assert_eq!(second.stability.in_space, InSpace::Unstable);
}

/// A square net from its four corners: every bar pulls, and the answer has the net's symmetry.
#[test]
fn net_of_eight_by_eight() {
    const N: usize = 8;
    let span = 0.8 * (N - 1) as f64;
    let corner = |i: usize| if i == 0 { 0.0 } else { span };
    let edge = |i: usize| i == 0 || i == N - 1;
    let mut joints = Vec::new();
    let mut members = Vec::new();
    for i in 0..N {
        for j in 0..N {
            let name = format!("{i} {j}");
            joints.push(if edge(i) && edge(j) {
                Joint::anchor(name, [corner(i), corner(j), 0.0])
            } else {
                Joint::free(name)
            });
            if i + 1 < N {
                members.push(bar(i * N + j, (i + 1) * N + j, 1.0, 1.0));
            }
            if j + 1 < N {
                members.push(bar(i * N + j, i * N + j + 1, 1.0, 1.0));
            }
        }
    }
    let system = system(joints, members);
    let answer = hang(&system).equilibrium;
    assert!(answer.axial_n.iter().all(|axial| *axial > 0.0));
    let quarter = system.total_mass_kg() / 4.0;
    for (joint, reaction) in system.joints().iter().zip(&answer.reactions_n) {
        if joint.support.is_fixed() {
            assert!((reaction[2] - quarter).abs() < 1e-10 * quarter);
        }
    }
    for i in 0..N {
        for j in 0..N {
            let (here, there) = (answer.joints_m[i * N + j], answer.joints_m[j * N + i]);
            assert!((here[2] - there[2]).abs() < 1e-10);
        }
    }
}

#[test]
fn refusals_name_their_numbers() {
    let free = vec![Joint::free("P").with_mass(1.0), Joint::free("Q")];
    let falls = solve(&system(free, vec![bar(0, 1, 1.0, 1.0)]), &Settings::default());
    let Err(Error::Falls { joint, joints, load_n }) = falls else { panic!("{falls:?}") };
    assert_eq!((joint.as_str(), joints), ("P", 1));
    close(load_n, 2.0);

    let rail = Support::Line { at_m: [0.0; 3], direction: [0.0, 0.0, 1.0] };
    let slides = vec![Joint::free("S").held_by(rail), Joint::free("Q")];
    let falls = solve(&system(slides, vec![bar(0, 1, 1.0, 1.0)]), &Settings::default());
    assert!(matches!(falls, Err(Error::Falls { .. })), "{falls:?}");

    let far =
        vec![Joint::anchor("A", [0.0; 3]), Joint::free("P"), Joint::anchor("B", [3.0, 0.0, 0.0])];
    let members = vec![bar(0, 1, 1.0, 1.0), bar(1, 2, 1.5, 1.0)];
    let short = solve(&system(far, members), &Settings::default());
    let Err(Error::TooShort { distance_m, reach_m, .. }) = short else { panic!("{short:?}") };
    close(distance_m, 3.0);
    close(reach_m, 2.5);

    let still = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P")];
    let unloaded = solve(&system(still, vec![bar(0, 1, 1.0, 0.0)]), &Settings::default());
    assert_eq!(unloaded, Err(Error::Unloaded));
}

/// The pivots of the sparse factors count what the dense decompositions count, stable or not.
#[test]
fn sparse_and_dense_indices_agree() {
    let joints = (0..9).map(|k| match k {
        0 => Joint::anchor("0", [0.0; 3]),
        8 => Joint::anchor("8", [5.0, 0.0, 1.0]),
        _ => Joint::free(format!("{k}")),
    });
    let members = (0..8).map(|k| bar(k, k + 1, 1.0, 1.0)).collect();
    let system = system(joints.collect(), members);
    let (dense, sparse) =
        (Settings::default(), Settings { dense_freedoms: 0, ..Settings::default() });
    let mut indices = std::collections::BTreeSet::new();
    for start in 0..60_u32 {
        // Zigzags of the numbers' bits: rough guesses of equilibria with bars in compression.
        let mut places: Vec<Vector> = (0..9).map(|k| [0.625 * f64::from(k), 0.0, 0.0]).collect();
        for (k, place) in places.iter_mut().enumerate() {
            place[2] = if start >> (k % 6) & 1 == 1 { 1.0 } else { -1.0 };
            place[1] = 0.1 * f64::from(start % 7);
        }
        let seed = Seed::at(places);
        let (Ok(a), Ok(b)) =
            (solve_from(&system, &seed, &dense), solve_from(&system, &seed, &sparse))
        else {
            continue;
        };
        judge(&system, &a);
        let (a, b) = (a.equilibrium.stability, b.equilibrium.stability);
        assert_eq!((a.index_in_space, a.neutral), (b.index_in_space, b.neutral));
        assert_eq!(a.index_in_plane, b.index_in_plane);
        indices.insert(a.index_in_space);
    }
    assert!(indices.len() >= 3, "{indices:?}");
}
