//! The work of the minimiser of systems, frozen as that of chains in `work`.

use energy::net::{Error, Settings, Solution, minimise, minimise_from, minimise_near};
use model::system::{Kind, Member, Support, System};
use model::{Bar, Vector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use samples::assert_frozen;

use crate::net_random::{bridle, net, ring, tree};
use crate::net_support::G;

/// Systems, answers, iterations of the relaxation, of Newton's method, factorisations; and the sum
/// of the numbers of members and joints that refusals name.
type Row = [u64; 6];

fn add(row: &mut Row, system: &System, outcome: Result<Solution, Error>) {
    row[0] += 1;
    match outcome {
        Ok(solution) => {
            row[1] += 1;
            row[2] += solution.work.relaxation;
            row[3] += solution.work.iterations;
            row[4] += solution.work.factorisations;
        }
        Err(Error::NotClosed { member, .. } | Error::WrongSign { member, .. }) => {
            row[5] += member as u64;
        }
        Err(Error::FloorPulls { joint, .. } | Error::Falls { joint, .. }) => {
            row[5] += system.joint(&joint).expect("a name") as u64;
        }
        Err(_) => {}
    }
}

/// The same joints with members made from these.
fn with(system: &System, member: impl Fn(usize, &Member) -> Member) -> System {
    let members = system.members().iter().enumerate().map(|(e, old)| member(e, old));
    System::new("other", G, system.joints().to_vec(), members.collect()).expect("a system")
}

/// The kinds of members, some of each kind elastic.
fn variants(system: System) -> [System; 6] {
    let cables = with(&system, |_, bar| Member::cable(bar.from, bar.to, bar.body));
    let mixed = with(&system, |e, bar| match e % 4 {
        0 => Member::cable(bar.from, bar.to, bar.body),
        1 => Member::cable(bar.from, bar.to, bar.body).with_stiffness(200.0),
        2 => bar.clone().with_stiffness(500.0),
        _ => bar.clone(),
    });
    let soft = with(&system, |_, bar| bar.clone().with_stiffness(100.0));
    let struts = with(&system, |e, bar| {
        let stiffness_n = (e % 3 == 1).then_some(500.0);
        let kind = if e % 3 == 2 { Kind::Bar } else { Kind::Strut };
        bar.clone().of_kind(kind).with_stiffness(stiffness_n)
    });
    let lowest = system.joints().iter().filter_map(|joint| match joint.support {
        Support::Fixed { at_m } => Some(at_m[2]),
        _ => None,
    });
    let floor_m = lowest.fold(f64::INFINITY, f64::min) - 0.3;
    let floor = mixed.clone().with_floor(floor_m).expect("below the anchors");
    [system, cables, mixed, soft, struts, floor]
}

fn work(make: impl Fn(&mut ChaCha8Rng) -> System, count: u64, expected: &[Row; 6]) {
    let mut found = [Row::default(); 6];
    for stream in 1000..1000 + count {
        let system = make(&mut ChaCha8Rng::seed_from_u64(stream));
        for (row, system) in found.iter_mut().zip(variants(system)) {
            add(row, &system, minimise(&system, &Settings::default()));
        }
    }
    assert_frozen(&found, expected);
}

#[test]
fn work_on_trees() {
    work(
        tree,
        30,
        &[
            [30, 30, 90, 30, 120, 0],
            [30, 30, 180, 30, 210, 0],
            [30, 30, 180, 30, 210, 0],
            [30, 30, 119, 30, 149, 0],
            [30, 0, 0, 0, 0, 0],
            [30, 30, 309, 859, 1460, 0],
        ],
    );
}

#[test]
fn work_on_bridles() {
    work(
        bridle,
        60,
        &[
            [60, 60, 269, 401, 1107, 0],
            [60, 60, 416, 60, 476, 0],
            [60, 60, 416, 217, 885, 0],
            [60, 60, 317, 99, 598, 0],
            [60, 5, 0, 58, 106, 0],
            [60, 60, 556, 1244, 2526, 0],
        ],
    );
}

#[test]
fn work_on_rings() {
    work(
        ring,
        40,
        &[
            [40, 40, 165, 851, 2390, 0],
            [40, 40, 268, 40, 308, 0],
            [40, 40, 278, 427, 1270, 0],
            [40, 39, 182, 239, 731, 0],
            [40, 0, 0, 0, 0, 0],
            [40, 40, 406, 1373, 2223, 0],
        ],
    );
}

#[test]
fn work_on_nets() {
    work(
        |rng| net(rng, 0.6),
        30,
        &[
            [30, 30, 175, 285, 712, 0],
            [30, 30, 255, 30, 285, 0],
            [30, 30, 275, 109, 556, 0],
            [30, 30, 201, 41, 331, 0],
            [30, 0, 0, 0, 0, 0],
            [30, 30, 320, 281, 949, 0],
        ],
    );
}

/// A bridle, and places for its joints.
pub(crate) fn seeded(stream: u64) -> (System, Vec<Vector>) {
    let mut rng = ChaCha8Rng::seed_from_u64(stream);
    let system = bridle(&mut rng);
    let mut place = || std::array::from_fn(|_| rng.random_range(-1.5..1.5));
    let seed = system.joints().iter().map(|_| place()).collect();
    (system, seed)
}

#[test]
fn work_from_seeds() {
    let mut found = [Row::default(); 6];
    for stream in 2000..2040 {
        let (system, seed) = seeded(stream);
        for (row, system) in found.iter_mut().zip(variants(system)) {
            add(row, &system, minimise_from(&system, &seed, &Settings::default()));
        }
    }
    let expected = [
        [40, 38, 0, 992, 1229, 2],
        [40, 40, 0, 849, 832, 0],
        [40, 40, 0, 987, 1149, 0],
        [40, 40, 0, 578, 892, 0],
        [40, 5, 0, 105, 132, 0],
        [40, 40, 0, 916, 1298, 0],
    ];
    assert_frozen(&found, &expected);
}

/// All exhibits: from no guess or from the drawing, and from places a twentieth of a metre off.
#[test]
fn work_on_exhibits() {
    let settings = Settings::default();
    let mut found = Vec::new();
    for exhibit in model::cases::exhibits() {
        let system = exhibit.system();
        let first = match system.drawing() {
            Some(drawing_m) => minimise_near(&system, &drawing_m, &settings),
            None => minimise(&system, &settings),
        };
        let mut row = Row::default();
        let seed: Option<Vec<Vector>> = first.as_ref().ok().map(|solution| {
            let off = |k: usize, x: f64| x + 0.05 * (1.0 + k as f64).sin();
            let joints = solution.equilibrium.joints_m.iter().enumerate();
            joints.map(|(j, at)| std::array::from_fn(|k| off(3 * j + k, at[k]))).collect()
        });
        add(&mut row, &system, first);
        if let Some(seed) = seed {
            add(&mut row, &system, minimise_from(&system, &seed, &settings));
        }
        found.push((exhibit.name, row));
    }
    let expected = [
        ("lamp", [2, 2, 6, 9, 16, 0]),
        ("bridle", [2, 2, 3, 12, 20, 0]),
        ("mobile", [2, 2, 6, 43, 76, 0]),
        ("footbridge", [2, 2, 12, 18, 35, 0]),
        ("net", [2, 2, 7, 24, 42, 0]),
        ("ring", [2, 2, 7, 18, 29, 0]),
        ("tripod", [2, 2, 3, 9, 11, 0]),
        ("pendulum-chain", [2, 2, 3, 12, 19, 0]),
        ("four-bar-linkage", [2, 2, 4, 10, 21, 0]),
        ("x-cross", [2, 2, 0, 33, 59, 0]),
        ("prism", [2, 2, 0, 22, 34, 0]),
        ("expandable-octahedron", [2, 2, 0, 53, 82, 0]),
        ("simplex-tower", [2, 2, 0, 44, 66, 0]),
        ("warren-truss", [2, 2, 0, 18, 18, 0]),
        ("pratt-truss", [2, 2, 0, 15, 22, 0]),
        ("lattice-tower", [2, 2, 0, 4, 12, 0]),
        ("star-dome", [2, 2, 0, 11, 31, 0]),
        ("geiger-dome", [2, 2, 0, 19, 41, 0]),
        ("ring-on-a-rope", [2, 2, 6, 2, 14, 0]),
        ("tackle", [2, 2, 6, 4, 10, 0]),
    ];
    assert_frozen(&found, &expected);
}

/// Three cables and a lamp: one factor of 3 coordinates has 6 numbers, and the work is asked before each.
#[test]
fn a_minimisation_ends_with_its_work() {
    let joints = samples::joints(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.5], [1.0, 1.5, -0.3]], &[3.0]);
    let cable = |from| Member::cable(from, 3, Bar::homogeneous(2.0, 1.0).unwrap());
    let system = System::new("a lamp", G, joints, (0..3).map(cable).collect()).unwrap();
    let found = minimise(&system, &Settings::default()).unwrap();
    let mut refused = 0;
    for max_work in [1, 7, 20, 50, 100, 200, 500, 5000] {
        match minimise(&system, &Settings { max_work, ..Settings::default() }) {
            Err(Error::Work { spent, max_work: most }) => {
                refused += 1;
                assert!(most == max_work && spent >= most && spent < most + 6, "{spent} of {most}");
            }
            other => {
                assert!(max_work >= 50, "{max_work}");
                assert_eq!(other.unwrap().equilibrium.joints_m, found.equilibrium.joints_m);
            }
        }
    }
    assert!(refused >= 2, "{refused}");
}
