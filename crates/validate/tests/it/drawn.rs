//! Structures as they are drawn: the equilibrium next to the drawing by both solvers, against the
//! method of joints, a linear stiffness computation by nalgebra, and published numbers.

use model::cases::exhibit;
use model::system::{Joint, Member, Support, System, SystemEquilibrium};
use model::{Bar, STANDARD_GRAVITY_M_S2 as G, Vector};
use nalgebra::{DMatrix, DVector, Vector3};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use validate::answer::Solvers;
use validate::systems::{Near, SystemAnswer, ask};

fn drawn(name: &str) -> System {
    exhibit(name).expect("it is drawn").system()
}

/// Both answers next to the drawing, which agree.
#[track_caller]
fn neighbour(system: &System) -> SystemAnswer {
    let answer = ask(system, Solvers::Both, &|_| {});
    assert!(answer.agrees(), "{}: {:?} {:?}", system.name(), answer.agreement, answer.failures);
    assert!(answer.near.as_ref().unwrap().is_neighbour, "{:?}", answer.near);
    answer
}

fn axial(system: &System, e: &SystemEquilibrium, from: &str, to: &str) -> f64 {
    let [a, b] = [from, to].map(|name| system.joint(name).expect("a joint"));
    let member = system.members().iter().position(|m| [m.from, m.to] == [a, b]);
    e.axial_n[member.expect("a member")]
}

/// Displacements and axial forces of the linear analysis at the drawing. Rigid members are equally
/// stiff, which moves nothing in the limit; forces of members that are fewer than needed do not
/// depend on it.
fn linear(system: &System) -> (DVector<f64>, Vec<f64>) {
    let places = system.drawing().unwrap();
    let mut columns: Vec<Vec<Vector3<f64>>> = vec![];
    for joint in system.joints() {
        let axes = Vector3::ith;
        let unit: Vec<Vector3<f64>> = (0..3).map(|k| axes(k, 1.0)).collect();
        columns.push(match joint.support {
            Support::Free => unit,
            Support::Fixed { .. } => vec![],
            Support::Line { direction, .. } => vec![direction.into()],
            Support::Plane { normal, .. } => {
                let normal = Vector3::from(normal);
                unit.into_iter().filter(|axis| axis.dot(&normal).abs() < 0.5).collect()
            }
        });
    }
    let first: Vec<usize> = columns
        .iter()
        .scan(0, |next, free| {
            let first = *next;
            *next += free.len();
            Some(first)
        })
        .collect();
    let size = columns.iter().map(Vec::len).sum();
    let row = |member: &Member| {
        let span = Vector3::from(places[member.to]) - Vector3::from(places[member.from]);
        let mut row = DVector::zeros(size);
        for (joint, sign) in [(member.from, -1.0), (member.to, 1.0)] {
            for (k, axis) in columns[joint].iter().enumerate() {
                row[first[joint] + k] += sign * axis.dot(&span.normalize());
            }
        }
        (row, member.stiffness_n.unwrap_or(1.0) / span.norm())
    };
    let mut stiffness = DMatrix::zeros(size, size);
    for member in system.members() {
        let (row, k) = row(member);
        stiffness += &row * row.transpose() * k;
    }
    let mut load = DVector::zeros(size);
    for (joint, free) in columns.iter().enumerate() {
        let of = &system.joints()[joint];
        let force = Vector3::from(of.force_n) - Vector3::z() * (of.mass_kg * system.gravity_m_s2());
        for (k, axis) in free.iter().enumerate() {
            load[first[joint] + k] = axis.dot(&force);
        }
    }
    let moves = stiffness.cholesky().expect("it is braced").solve(&load);
    let forces = system.members().iter().map(|member| {
        let (row, k) = row(member);
        k * row.dot(&moves)
    });
    let forces = forces.collect();
    (moves, forces)
}

/// The same system under a part of its loads.
fn loaded(system: &System, part: f64) -> System {
    let joints = system.joints().iter().map(|joint| Joint {
        mass_kg: part * joint.mass_kg,
        force_n: joint.force_n.map(|x| part * x),
        ..joint.clone()
    });
    let members = system.members().to_vec();
    System::new(system.name(), system.gravity_m_s2(), joints.collect(), members).unwrap()
}

#[track_caller]
fn close(found: &[f64], wanted: &[f64], within: f64) {
    for (k, (a, b)) in found.iter().zip(wanted).enumerate() {
        assert!((a - b).abs() <= within, "member {k}: {a} is not {b} within {within:e}");
    }
}

/// Half of 500 kg g on each support; then joint by joint: a diagonal has the slope 8 in 5.
#[test]
fn the_warren_truss_stands_as_by_the_method_of_joints() {
    let system = drawn("warren-truss");
    let answer = neighbour(&system);
    // Upright parts of the diagonals, in 100 kg g; level parts are 5/8 of them.
    let (diagonal, level) = (89.0_f64.sqrt() / 8.0, 5.0 / 8.0);
    let unit = 100.0 * G;
    for e in &answer.equilibria {
        for (from, to, upright) in [
            ("A", "E", -2.5),
            ("E", "B", 1.5),
            ("B", "F", -0.5),
            ("F", "C", -0.5),
            ("C", "G", 1.5),
            ("G", "D", -2.5),
        ] {
            let wanted = upright * diagonal * unit;
            assert!((axial(&system, e, from, to) - wanted).abs() < 1e-9 * unit, "{from}{to}");
        }
        // A pulls with AE; E hands AE and EB on to EF; B adds EB and BF.
        for (from, to, force) in
            [("A", "B", 2.5), ("B", "C", 4.5), ("C", "D", 2.5), ("E", "F", -4.0), ("F", "G", -4.0)]
        {
            let wanted = force * level * unit;
            assert!((axial(&system, e, from, to) - wanted).abs() < 1e-9 * unit, "{from}{to}");
        }
        assert!((e.reactions_n[system.joint("D").unwrap()][2] - 2.5 * unit).abs() < 1e-9 * unit);
        assert_eq!(e.stability.index_in_space, 0);
    }
    // The heap below is lower, and said so.
    assert!(answer.near.unwrap().lower_j.unwrap() < -1000.0);
    close(&answer.equilibria[0].axial_n, &linear(&system).1, 1e-9 * unit);
}

#[test]
fn rigid_braced_trusses_share_their_loads_as_equally_stiff_bars() {
    let system = drawn("pratt-truss");
    let wanted = linear(&system).1;
    for e in &neighbour(&system).equilibria {
        // 3000 N in all.
        close(&e.axial_n, &wanted, 1e-8 * 3000.0);
    }
}

#[test]
fn the_tower_tends_to_its_linear_analysis_as_its_loads_vanish() {
    let system = drawn("lattice-tower");
    let total_n = 200.0 * G + 4.0 * 400.0_f64.hypot(100.0);
    for part in [1.0, 1e-3, 1e-6] {
        let system = loaded(&system, part);
        let (moves, forces) = linear(&system);
        // Strains of some 1e-5 under the whole load change the forces by as much; and lengths that
        // are rounded to doubles strain a frame with more members than needed.
        let rounded_n = 1e8 * f64::EPSILON;
        let within = 1e-4 * part * part * total_n + rounded_n;
        for e in &neighbour(&system).equilibria {
            close(&e.axial_n, &forces, within);
        }
        assert!(moves.amax() > 0.0);
    }
}

/// Levy and Spillers: the crown moves by 0.20641184 in under P by linear analysis.
#[test]
fn the_dome_stands_under_part_of_its_load_and_tends_to_its_linear_analysis() {
    const INCH_M: f64 = 0.0254;
    let system = drawn("star-dome");
    let crown = |e: &SystemEquilibrium| e.joints_m[0][2] - 0.082_158_84;
    let answer = neighbour(&system);
    for e in &answer.equilibria {
        assert!((crown(e) + 1.842_733_020e-3).abs() < 1e-12, "{:e}", crown(e));
        assert_eq!(e.stability.index_in_space, 0);
    }
    // Inverted it has less energy.
    assert!(answer.near.unwrap().lower_j.unwrap() < -20.0);
    for part in [1e-3, 1e-6] {
        let weak = loaded(&system, part / 0.3);
        let (_, forces) = linear(&weak);
        let load_n = 980.654_937_3 * part;
        for e in &neighbour(&weak).equilibria {
            let per_load_in = crown(e) / part / INCH_M;
            // The first term of what is not linear is some 0.6 of the load's part; places are
            // stored to 1.4e-17 m.
            let within = 0.206 * 2.0 * part + 2.8e-17 / part / INCH_M;
            assert!((per_load_in + 0.206_411_84).abs() < within + 5e-9, "{per_load_in}");
            close(&e.axial_n, &forces, 4.0 * part * load_n + 1e-8 * load_n);
        }
    }
}

#[test]
fn the_cable_dome_stands_by_its_prestress() {
    let system = drawn("geiger-dome");
    let answer = neighbour(&system);
    for e in &answer.equilibria {
        assert_eq!(e.stability.index_in_space, 0);
        // Its weight is 9 times 20 kg, borne by eight supports alike.
        let support = e.reactions_n[system.joint("S3").unwrap()];
        assert!((support[2] - 9.0 * 20.0 * G / 8.0).abs() < 1e-7, "{support:?}");
    }
    // Without weight it stands where it is drawn, with the prestress that is written.
    let still = loaded(&system, 0.0);
    let answer = neighbour(&still);
    assert!(answer.near.unwrap().moved_m < 1e-12);
    for e in &answer.equilibria {
        assert!((axial(&still, e, "top", "bottom") + 2000.0).abs() < 1e-6);
    }
}

/// Places off by up to a part of the shortest member.
fn drawn_wrong(system: &System, part: f64, seed: u64) -> System {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let lengths = system.members().iter().map(|member| member.body.length_m());
    let off_m = part * lengths.fold(f64::INFINITY, f64::min);
    let places: Vec<Vector> = system.drawing().unwrap();
    let moved =
        places.iter().map(|place| place.map(|x| x + off_m * random.random_range(-1.0..1.0)));
    system.clone().drawn_at(&moved.collect::<Vec<_>>()).unwrap()
}

/// It is the same equilibrium, or the program says that it is not, or that there is none.
#[test]
fn shapes_drawn_wrong_lead_to_the_neighbour_or_say_so() {
    for name in ["warren-truss", "lattice-tower", "star-dome", "geiger-dome"] {
        let system = drawn(name);
        let right = neighbour(&system).equilibria.remove(0);
        for (part, seeds) in [(0.01, 3), (0.05, 3), (0.2, 3)] {
            let mut found = 0;
            for seed in 0..seeds {
                let wrong = drawn_wrong(&system, part, seed);
                let answer = ask(&wrong, Solvers::Both, &|_| {});
                let near = answer.near.clone();
                for e in &answer.equilibria {
                    let apart = e.joints_m.iter().zip(&right.joints_m);
                    let apart = apart.map(|(a, b)| (Vector3::from(*a) - Vector3::from(*b)).norm());
                    let same = apart.fold(0.0, f64::max) < 1e-9;
                    let there = Near::of(&wrong, &wrong.drawing().unwrap(), e);
                    let says = !there.is_neighbour || e.stability.index_in_space > 0;
                    // Of two neighbours of a rough sketch either is right.
                    assert!(same || says || part > 0.1, "{name} {part} {seed}: {near:?}");
                    found += usize::from(same && answer.agrees());
                }
            }
            // All of them, both solvers, up to 5 %.
            let least = if part < 0.1 { 6 } else { 0 };
            assert!(found >= least, "{name} {part}: {found}");
        }
    }
}

#[test]
fn where_no_minimum_is_near_energy_says_so() {
    let joints = vec![
        Joint::anchor("foot", [0.0; 3]),
        Joint::free("P").near([0.0, 0.0, 1.0]).with_mass(2.0),
    ];
    let rod = vec![Member::bar(0, 1, Bar::homogeneous(1.0, 0.0).unwrap())];
    let system = System::new("a rod on its head", 10.0, joints, rod).unwrap();
    let answer = ask(&system, Solvers::Both, &|_| {});
    let near = answer.near.unwrap();
    assert!(near.is_neighbour && near.moved_m < 1e-12);
    // 2 kg hang 1 m below the foot.
    assert!((near.lower_j.unwrap() + 20.0).abs() < 1e-9);
    assert_eq!(answer.equilibria[0].stability.index_in_space, 2);
    assert!(answer.failures[0].to_string().contains("no minimum near the drawing"));
}

/// Two elastic bars of 5 m over feet 6 m apart, drawn up and found down: on the way through the
/// level each is 2 m shorter, which is 1e3 N (2 m)²/(2 · 5 m) in each.
#[test]
fn what_has_snapped_through_is_no_neighbour() {
    let joint = |name: &str, x: f64| Joint::anchor(name, [x, 0.0, 0.0]);
    let joints = vec![
        joint("A", -3.0),
        joint("B", 3.0),
        Joint::free("P").near([0.0, 0.0, 4.0]).with_force([0.0, 0.0, -1e-3]),
    ];
    let body = Bar::homogeneous(5.0, 0.0).unwrap();
    let members = [0, 1].map(|foot| Member::bar(foot, 2, body).with_stiffness(1e3)).to_vec();
    let system = System::new("two bars", 10.0, joints, members).unwrap();
    let mut answer = ask(&system, Solvers::Lagrange, &|_| {});
    let mut down = answer.equilibria.remove(0);
    down.joints_m[2] = [0.0, 0.0, -4.0];
    let near = Near::of(&system, &system.drawing().unwrap(), &down);
    assert!(!near.is_neighbour && near.joint == "P");
    assert!((near.moved_m - 8.0).abs() < 1e-12 && (near.moved - 1.6).abs() < 1e-12);
    // Less the 4 m that the load has sunk there.
    assert!((near.barrier_j.unwrap() - (800.0 - 4e-3)).abs() < 1e-9, "{near:?}");
}
