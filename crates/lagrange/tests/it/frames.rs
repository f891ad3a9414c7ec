//! Frames of rigid members whose lengths overdetermine the shape, against least squares by dense
//! singular values (nalgebra) at the places of the answer.
//!
//! `FRAMES=600 cargo test --release -p lagrange --test it frames::` tries more of them.

use lagrange::net::{Error, Forces, Settings, Solution, solve};
use model::system::{Joint, Member, System};
use model::{Bar, ForceRange};
use nalgebra::{DMatrix, DVector, Vector3};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const GRAVITY: f64 = 9.80665;

/// How the places of a frame are drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Draw {
    Integer,
    OneDecimal,
    Real,
    /// Anchors on a circle, the joint on its axis.
    Ring,
    /// All in the plane y = 0.
    Flat,
}

const DRAWS: [Draw; 5] = [Draw::Integer, Draw::OneDecimal, Draw::Real, Draw::Ring, Draw::Flat];

fn place(rng: &mut ChaCha8Rng, draw: Draw) -> Vector3<f64> {
    let mut at = Vector3::from_fn(|_, _| rng.random_range(-4.0..4.0_f64));
    match draw {
        Draw::Integer => at = at.map(f64::round),
        Draw::OneDecimal => at = at.map(|x| (10.0 * x).round() / 10.0),
        Draw::Flat => at.y = 0.0,
        Draw::Real | Draw::Ring => {}
    }
    at
}

/// A frame of up to three joints with 4 to 12 legs each, joined by bars; `elastic` makes the last
/// leg of each joint a stretched or pressed one. Lengths are the distances, rounded to doubles,
/// times one plus a random number up to `off`.
pub fn frame(seed: u64, draw: Draw, elastic: bool, off: f64) -> System {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let count = if draw == Draw::Ring { 1 } else { 1 + (seed % 3) as usize };
    let (mut joints, mut places, mut members) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..count {
        let at = if draw == Draw::Ring {
            Vector3::new(0.0, 0.0, rng.random_range(-2.0..2.0_f64).round() + 0.5)
        } else {
            place(&mut rng, draw)
        };
        let mut force: [f64; 3] = [0.0; 3].map(|_| f64::from(rng.random_range(-20..20_i32)));
        if draw == Draw::Flat {
            force[1] = 0.0;
        }
        joints.push(Joint::free(format!("P{k}")).with_mass((1 + k) as f64).with_force(force));
        places.push(at);
    }
    let mut join =
        |places: &[Vector3<f64>], rng: &mut ChaCha8Rng, from: usize, to: usize, own: bool| {
            let distance = (places[to] - places[from]).norm();
            let length = distance * (1.0 + off * rng.random_range(-1.0..1.0));
            let body = |length| Bar::homogeneous(length, 0.5).unwrap();
            members.push(if own {
                let strain = rng.random_range(-1e-3..1e-3);
                Member::bar(from, to, body(distance * (1.0 + strain))).with_stiffness(1e4)
            } else {
                Member::bar(from, to, body(length))
            });
        };
    for k in 0..count {
        let legs = rng.random_range(4..=12_usize);
        for leg in 0..legs {
            let at = if draw == Draw::Ring {
                let turn = std::f64::consts::TAU * leg as f64 / legs as f64;
                Vector3::new(2.0 * turn.cos(), 2.0 * turn.sin(), 0.0)
            } else {
                place(&mut rng, draw)
            };
            if (at - places[k]).norm() < 0.5 {
                continue;
            }
            joints.push(Joint::anchor(format!("A{k}-{leg}"), at.into()));
            places.push(at);
            join(&places, &mut rng, places.len() - 1, k, elastic && leg + 1 == legs);
        }
        if k > 0 && (places[k] - places[k - 1]).norm() > 0.5 {
            join(&places, &mut rng, k - 1, k, false);
        }
    }
    System::new(format!("{draw:?} {seed}"), GRAVITY, joints, members).unwrap()
}

/// Directions of the members of an answer.
fn directions(system: &System, solution: &Solution) -> Vec<(Vector3<f64>, f64)> {
    let at = |joint: usize| Vector3::from(solution.equilibrium.joints_m[joint]);
    let spans = system.members().iter().map(|m| at(m.to) - at(m.from));
    spans.map(|span| (span.normalize(), span.norm())).collect()
}

/// Load of each joint with the weights of its homogeneous members.
fn loads(system: &System) -> Vec<Vector3<f64>> {
    let down = |mass: f64| Vector3::new(0.0, 0.0, -mass * system.gravity_m_s2());
    let joints = system.joints().iter();
    let mut loads: Vec<_> =
        joints.map(|joint| Vector3::from(joint.force_n) + down(joint.mass_kg)).collect();
    for member in system.members() {
        for joint in [member.from, member.to] {
            loads[joint] += down(0.5 * member.body.mass_kg());
        }
    }
    loads
}

/// Cut of singular values, over the largest.
const CUT: f64 = 1e-6;

/// Least `sum t^2 l` over the rigid members at these directions, the elastic ones as they are.
/// Also how far the answer is from it, over the smallest singular value that counts, and the
/// number of self-stresses.
fn least(system: &System, solution: &Solution) -> (Vec<f64>, f64, usize) {
    let directions = directions(system, solution);
    let free: Vec<usize> =
        (0..system.joints().len()).filter(|j| !system.joints()[*j].support.is_fixed()).collect();
    let row = |joint: usize| free.iter().position(|f| *f == joint).map(|k| 3 * k);
    let rigid: Vec<usize> = (0..system.members().len())
        .filter(|m| system.members()[*m].stiffness_n.is_none())
        .collect();
    let mut matrix = DMatrix::zeros(3 * free.len(), rigid.len());
    let mut right = DVector::zeros(3 * free.len());
    for (joint, load) in loads(system).iter().enumerate() {
        if let Some(at) = row(joint) {
            right.rows_mut(at, 3).copy_from(load);
        }
    }
    for (k, (member, (u, length))) in system.members().iter().zip(&directions).enumerate() {
        for (joint, sign) in [(member.from, 1.0), (member.to, -1.0)] {
            let Some(at) = row(joint) else { continue };
            if let Some(column) = rigid.iter().position(|r| *r == k) {
                let weight = member.body.length_m().sqrt().recip();
                matrix.view_mut((at, column), (3, 1)).copy_from(&(-u * (sign * weight)));
            } else {
                let l = member.body.length_m();
                let axial = member.stiffness_n.unwrap() * (length - l) / l;
                let mut part = right.rows_mut(at, 3);
                part += u * (sign * axial);
            }
        }
    }
    let svd = matrix.svd(true, true);
    let most = svd.singular_values.max();
    let counted = svd.singular_values.iter().filter(|s| **s > CUT * most);
    let (rank, weakest) = (counted.clone().count(), counted.fold(most, |a, b| a.min(*b)));
    let scaled = svd.solve(&right, CUT * most).unwrap();
    let mut axial = solution.equilibrium.axial_n.clone();
    for (column, &member) in rigid.iter().enumerate() {
        axial[member] = scaled[column] / system.members()[member].body.length_m().sqrt();
    }
    (axial, most / weakest, rigid.len() - rank)
}

/// What is wrong with an answer of a frame of bars.
pub fn faults(system: &System, solution: &Solution) -> Vec<String> {
    let mut faults = Vec::new();
    let axial_n = &solution.equilibrium.axial_n;
    let (directions, loads) = (directions(system, solution), loads(system));
    let count = loads.len() as f64;
    let mean = loads.iter().map(Vector3::norm).sum::<f64>() / count;
    let mut left = loads.clone();
    for ((member, axial), (u, length)) in system.members().iter().zip(axial_n).zip(&directions) {
        left[member.from] += u * *axial;
        left[member.to] -= u * *axial;
        let misfit = (length - member.body.length_m()).abs();
        if member.stiffness_n.is_none() && misfit > 1.001 * member.within_m() {
            faults.push(format!("a length is off by {misfit:e}"));
        }
    }
    for (joint, load) in system.joints().iter().zip(loads.iter().zip(&left)) {
        let (load, left) = load;
        if !joint.support.is_fixed() && left.norm() > 1e-9 * load.norm().max(mean) {
            faults.push(format!("{} is out of balance by {:e}", joint.name, left.norm()));
        }
    }
    let (least, condition, self_stresses) = least(system, solution);
    let largest_load = loads.iter().map(Vector3::norm).fold(0.0, f64::max);
    for (member, (shown, least)) in axial_n.iter().zip(&least).enumerate() {
        if (shown - least).abs() > 1e-6 * largest_load * condition.max(1.0) {
            faults.push(format!("member {member} bears {shown} N, least {least} N"));
        }
    }
    if solution.self_stresses.as_ref().is_some_and(|basis| basis.len() != self_stresses) {
        faults.push(format!("not {self_stresses} self-stresses"));
    }
    if self_stresses > 0 && solution.forces != Forces::LeastNorm {
        faults.push(format!("forces {:?}", solution.forces));
    }
    faults
}

/// Seeds of ten frames each, unless `FRAMES` says how many frames.
fn seeds(usual: u64) -> std::ops::Range<u64> {
    0..std::env::var("FRAMES").map_or(usual, |n| n.parse::<u64>().unwrap() / 10)
}

fn all_frames(seeds: std::ops::Range<u64>, off: f64) -> impl Iterator<Item = System> {
    seeds.flat_map(move |seed| {
        DRAWS.into_iter().flat_map(move |draw| [false, true].map(|e| frame(seed, draw, e, off)))
    })
}

/// Every frame of rounded lengths is answered, in balance, with the least forces.
#[test]
fn rounded_lengths_bear_only_the_loads() {
    let (mut wrong, mut refused, mut answers) = (Vec::new(), Vec::new(), 0);
    for system in all_frames(seeds(4), 0.0) {
        match solve(&system, &Settings::default()) {
            Ok(solution) => {
                answers += 1;
                let faults = faults(&system, &solution);
                if !faults.is_empty() {
                    wrong.push(format!("{}: {}", system.name(), faults.join(", ")));
                }
            }
            Err(error) => refused.push(format!("{}: {error}", system.name())),
        }
    }
    let all = wrong.iter().chain(&refused).cloned().collect::<Vec<_>>().join("\n");
    assert!(
        all.is_empty(),
        "{} of {answers} wrong, {} refused:\n{all}",
        wrong.len(),
        refused.len()
    );
}

/// The same system with other members.
fn with_members(system: &System, change: impl Fn(usize, &Member) -> Member) -> System {
    let members = system.members().iter().enumerate().map(|(k, member)| change(k, member));
    let joints = system.joints().to_vec();
    System::new(system.name(), system.gravity_m_s2(), joints, members.collect()).unwrap()
}

fn scaled(member: &Member, by: f64) -> Member {
    let body = Bar::homogeneous(member.body.length_m() * by, member.body.mass_kg()).unwrap();
    member.clone().with_body(body)
}

/// Lengths that are off by up to 1e-6 are refused, with the misfits of members that take part; with
/// a tolerance of 3e-5 m they are answered.
#[test]
fn larger_misfits_are_refused_without_a_tolerance() {
    let mut wrong = Vec::new();
    for system in all_frames(seeds(1), 1e-6) {
        match solve(&system, &Settings::default()) {
            Err(Error::Misfit { misfits }) => {
                let worst = &misfits[0];
                if worst.misfit_m.abs() <= worst.within_m || worst.misfit_m.abs() > 2e-5 {
                    wrong.push(format!("{}: {worst:?}", system.name()));
                }
            }
            other => wrong.push(format!("{}: {other:?}", system.name())),
        }
        let known = with_members(&system, |_, member| match member.stiffness_n {
            Some(_) => member.clone(),
            None => member.clone().with_length_tolerance(3e-5),
        });
        match solve(&known, &Settings::default()) {
            Ok(solution) => {
                let faults = faults(&known, &solution);
                if !faults.is_empty() {
                    wrong.push(format!("{} known: {}", known.name(), faults.join(", ")));
                }
            }
            Err(error) => wrong.push(format!("{} known: {error}", known.name())),
        }
    }
    assert!(wrong.is_empty(), "{}:\n{}", wrong.len(), wrong.join("\n"));
}

/// The finding: a joint on four bars bears 29.9 N at most, not 9e12 N, and lengths that change
/// within rounding change nothing. Anchors, lengths and mass of the report; the figure by `NumPy`,
/// `lstsq` of the four directions at (-3, -3, 3).. weighted by the lengths.
#[test]
fn a_tetrapod_bears_its_load_whatever_rounding_says() {
    let anchors = [[3.0, 2.0, 1.0], [2.0, 1.0, 3.0], [3.0, 1.0, -1.0], [3.0, 0.0, 3.0]];
    let lengths = [6.708_203_932_499_369, 5.0, 6.928_203_230_275_509, 5.0];
    let mut joints = vec![Joint::free("P").with_mass(2.0)];
    joints.extend(anchors.iter().enumerate().map(|(k, at)| Joint::anchor(format!("A{k}"), *at)));
    let member =
        |(k, length): (usize, &f64)| Member::bar(k + 1, 0, Bar::homogeneous(*length, 0.0).unwrap());
    let members: Vec<_> = lengths.iter().enumerate().map(member).collect();
    let system = System::new("tetrapod", GRAVITY, joints, members).unwrap();
    let forces = |by: f64| {
        let system =
            with_members(&system, |k, member| scaled(member, 1.0 + by * [1.0, -1.0, 0.5, 0.0][k]));
        let solution = solve(&system, &Settings::default()).unwrap();
        assert_eq!(faults(&system, &solution), Vec::<String>::new());
        let told = solution.equilibrium.evidence.self_stresses.unwrap();
        assert!(told.ranges.unwrap().iter().all(|range| *range == ForceRange::Free));
        assert!(told.misfit_m.unwrap() < 1e-14);
        solution.equilibrium.axial_n
    };
    let first = forces(0.0);
    let largest = first.iter().fold(0.0_f64, |most, t| most.max(t.abs()));
    assert!((largest - 29.9).abs() < 0.05, "{first:?}");
    for (a, b) in first.iter().zip(forces(1e-15)) {
        assert!((a - b).abs() < 1e-12 * largest);
    }
}

/// Three bars in a vertical plane: rounded lengths are met by moving out of it, where other forces
/// balance; the shape is read as flat, whatever digits the lengths have.
#[test]
fn a_flat_frame_is_flat() {
    let mut joints = vec![Joint::free("P").with_mass(1.0)];
    let anchors = [[-3.0, 0.0, 4.1], [0.7, 0.0, 3.3], [2.9, 0.0, 2.2]];
    joints.extend(anchors.iter().enumerate().map(|(k, at)| Joint::anchor(format!("A{k}"), *at)));
    for digits in [1e-10, 1e-12, 1e-14, 1e-16_f64] {
        for signs in 0..8 {
            let member = |(k, at): (usize, &[f64; 3])| {
                let off = if signs & (1 << k) == 0 { digits } else { -digits };
                let length = Vector3::from(*at).norm() + off;
                Member::bar(k + 1, 0, Bar::homogeneous(length, 0.0).unwrap())
            };
            let members = anchors.iter().enumerate().map(member).collect();
            let system = System::new("flat", GRAVITY, joints.clone(), members).unwrap();
            let solution = solve(&system, &Settings::default()).unwrap();
            let found = faults(&system, &solution);
            assert!(found.is_empty(), "{digits:e} {signs}: {found:?}");
            assert_eq!(solution.self_stresses.map(|basis| basis.len()), Some(1));
            assert!(solution.equilibrium.joints_m[0][1].abs() < 1e-7);
        }
    }
}

/// The same with the first bar a millimetre shorter: it fits nowhere, out of the plane less than in it. The self-stress
/// (-0.654, 1, -0.745) takes all changes of lengths in the plane to 0: some bar is off by its part of that at least.
#[test]
fn a_flat_frame_that_fits_nowhere_is_refused_by_its_lengths() {
    let mut joints = vec![Joint::free("P").with_mass(1.0)];
    let anchors = [[-3.0, 0.0, 4.1], [0.7, 0.0, 3.3], [2.9, 0.0, 2.2]];
    joints.extend(anchors.iter().enumerate().map(|(k, at)| Joint::anchor(format!("A{k}"), *at)));
    let members = anchors.iter().enumerate().map(|(k, at)| {
        let length = Vector3::from(*at).norm() - if k == 0 { 1e-3 } else { 0.0 };
        Member::bar(k + 1, 0, Bar::homogeneous(length, 0.0).unwrap())
    });
    let system = System::new("short", GRAVITY, joints, members.collect()).unwrap();
    let refused = solve(&system, &Settings::default());
    let Err(Error::Misfit { misfits }) = refused else { panic!("{refused:?}") };
    let largest = misfits.iter().fold(0.0_f64, |most, misfit| most.max(misfit.misfit_m.abs()));
    let bounds = 0.654e-3 / (0.654 + 1.0 + 0.745)..1e-3;
    assert!(bounds.contains(&largest), "{misfits:?}");
}

/// Two bars of length 1 + slack over a span of 2: t = W / (2 sin), with sin² = 1 - 1/(1 + slack)².
#[test]
fn a_line_nearly_taut_keeps_its_forces() {
    for slack in [1e-2, 1e-4, 1e-6, 1e-8, 1e-9, 1e-10_f64] {
        let length = 1.0 + slack;
        let bar = Bar::homogeneous(length, 0.0).unwrap();
        let joints = vec![
            Joint::anchor("A", [-1.0, 0.0, 0.0]),
            Joint::anchor("B", [1.0, 0.0, 0.0]),
            Joint::free("P").with_force([0.0, 0.0, -2.0]),
        ];
        let members = vec![Member::bar(0, 2, bar), Member::bar(1, 2, bar)];
        let system = System::new("line", 1.0, joints, members).unwrap();
        let solution = solve(&system, &Settings::default()).unwrap();
        let sag = (length * length - 1.0).sqrt();
        let wanted = length / sag;
        for axial in &solution.equilibrium.axial_n {
            // The tolerance of lengths, 1e-12, moves the force by half of its ratio to the slack.
            assert!(
                (axial / wanted - 1.0).abs() < 1e-14 + 1e-12 / slack,
                "{slack:e}: {axial} {wanted}"
            );
        }
        assert_eq!(solution.forces, Forces::Unique);
    }
}

/// Braced towers of square cells: 4 legs, 4 rings, 8 diagonals a cell are 4 more than needed.
#[test]
fn towers_above_the_dense_limit_share_their_loads() {
    for (cells, dense) in [(6, 300), (6, 0), (30, 300)] {
        let corner = |k: usize| [[0.0, 0.0], [1.3, 0.1], [1.2, 1.4], [-0.1, 1.1]][k % 4];
        let at = |k: usize| Vector3::new(corner(k)[0], corner(k)[1], 1.7 * (k / 4) as f64);
        let mut joints: Vec<_> =
            (0..4).map(|k| Joint::anchor(format!("A{k}"), at(k).into())).collect();
        joints.extend((4..4 * cells + 4).map(|k| {
            Joint::free(format!("P{k}")).with_mass(1.0).with_force([3.0, -1.0, (k % 5) as f64])
        }));
        let bar = |a: usize, b: usize| {
            Member::bar(a, b, Bar::homogeneous((at(b) - at(a)).norm(), 0.1).unwrap())
        };
        let mut members = Vec::new();
        for cell in 0..cells {
            let (low, high) = (4 * cell, 4 * cell + 4);
            for k in 0..4 {
                let next = (k + 1) % 4;
                members.push(bar(low + k, high + k));
                members.push(bar(high + k, high + next));
                members.push(bar(low + k, high + next));
                members.push(bar(low + next, high + k));
            }
        }
        let system = System::new("tower", GRAVITY, joints, members).unwrap();
        let settings = Settings { dense_freedoms: dense, ..Settings::default() };
        let solution = solve(&system, &settings).unwrap();
        let found = faults(&system, &solution);
        assert!(found.is_empty(), "{cells} {dense}: {found:?}");
    }
}

/// A weight on a fan of cables and struts: the least forces that signs allow, by hand.
#[test]
fn signs_bind_the_least_forces() {
    // A bar upright and two cables aslant below a joint that is pulled up by 1 N and aside by 1 N:
    // the cable on the other side would push.
    let anchor = |name: &str, at: [f64; 3]| Joint::anchor(name, at);
    let joints = vec![
        anchor("A", [-1.0, 0.0, 0.0]),
        anchor("B", [0.0, 0.0, 0.0]),
        anchor("C", [1.0, 0.0, 0.0]),
        Joint::free("P").with_force([1.0, 0.0, 1.0]),
    ];
    let side = 2.0_f64.sqrt();
    let bar = |length| Bar::homogeneous(length, 0.0).unwrap();
    let members = vec![
        Member::cable(0, 3, bar(side)),
        Member::bar(1, 3, bar(1.0)),
        Member::cable(2, 3, bar(side)),
    ];
    let system = System::new("fan", 1.0, joints, members).unwrap();
    let solution = solve(&system, &Settings::default()).unwrap();
    // a = sqrt 2 and c = 0: the bar bears nothing.
    let wanted = [side, 0.0, 0.0];
    for (axial, wanted) in solution.equilibrium.axial_n.iter().zip(wanted) {
        assert!((axial - wanted).abs() < 1e-9, "{:?}", solution.equilibrium.axial_n);
    }
    assert_ne!(solution.forces, Forces::Found);
}

/// In metres, the first by how far it is beyond what it may be off; within their tolerances they are shared.
#[test]
fn misfits_are_those_of_the_best_shape() {
    let solved = |within_m| solve(&samples::legs(within_m), &Settings::default());
    let Err(Error::Misfit { misfits }) = solved([1e-4, 2e-5, 4e-5, 5e-5]) else { panic!() };
    samples::assert_misfits_of_legs(&misfits, [(1, 2e-5), (2, 4e-5), (3, 5e-5), (0, 1e-4)]);
    let shared = solved([1e-3; 4]).unwrap().equilibrium;
    samples::assert_shared_by_legs(shared.joints_m[0], &shared.axial_n);
}
