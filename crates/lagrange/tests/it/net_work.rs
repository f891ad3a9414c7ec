//! The work of the solver of systems, frozen as that of chains in `work`.

use lagrange::net::{Error, Forces, Seed, Settings, Solution, solve, solve_from};
use model::system::{Kind, Member, System};
use model::{Bar, Vector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use samples::assert_frozen;

use crate::net_random::random;
use crate::net_runs::bridle;

/// Systems, answers, factorisations, mechanisms, self-stresses, slack members, limp ones, forces of
/// least norm, indices in space, free motions; refusals, and what they count.
type Row = [usize; 12];

fn add(row: &mut Row, outcome: Result<Solution, Error>) {
    row[0] += 1;
    let found = match outcome {
        Ok(found) => found,
        Err(error) => {
            row[10] += 1;
            row[11] += match error {
                Error::NotConverged { iterations, member, .. } => iterations + member - 1,
                Error::Falls { joints, .. } => joints,
                Error::HeldMisfit { member, .. } => member - 1,
                Error::Unstable { index } => index,
                Error::Floor { rounds } => rounds,
                _ => 0,
            };
            return;
        }
    };
    row[1] += 1;
    row[2] += found.factorisations;
    row[3] += found.mechanisms.unwrap_or(0);
    row[4] += found.self_stresses.as_ref().map_or(0, Vec::len);
    row[5] += found.slack.len();
    row[6] += found.limp.len();
    row[7] += usize::from(found.forces == Forces::LeastNorm);
    row[8] += found.equilibrium.stability.index_in_space;
    row[9] += found.equilibrium.stability.neutral;
}

/// Above a floor a little below the lowest anchor.
pub(crate) fn above_a_floor(system: System) -> System {
    let heights = system.joints().iter().filter_map(|joint| Some(joint.support.at_m()?[2]));
    let floor_m = heights.fold(f64::INFINITY, f64::min) - 0.3;
    system.with_floor(floor_m).expect("below the anchors")
}

const ALL: [Kind; 3] = [Kind::Bar, Kind::Cable, Kind::Strut];

#[test]
fn work_of_random_systems() {
    let mut found = Vec::new();
    for (kinds, elastic) in
        [(&ALL[..1], false), (&ALL[1..2], false), (&ALL[..], false), (&ALL[..], true)]
    {
        let (mut plain, mut floor, mut sparse) = (Row::default(), Row::default(), Row::default());
        for seed in 1000..1060 {
            let system = random(seed, kinds, elastic);
            add(&mut plain, solve(&system, &Settings::default()));
            let pivots = Settings { dense_freedoms: 0, ..Settings::default() };
            add(&mut sparse, solve(&system, &pivots));
            add(&mut floor, solve(&above_a_floor(system), &Settings::default()));
        }
        found.extend([plain, sparse, floor]);
    }
    let expected = [
        [60, 56, 2338, 601, 0, 0, 3, 0, 0, 17, 4, 16],
        [60, 56, 2305, 0, 0, 0, 3, 0, 0, 17, 4, 16],
        [60, 53, 8141, 231, 0, 0, 309, 0, 0, 151, 7, 16],
        [60, 56, 539, 734, 0, 133, 0, 0, 0, 10, 4, 16],
        [60, 56, 506, 0, 0, 133, 0, 0, 0, 10, 4, 16],
        [60, 56, 986, 666, 0, 455, 6, 0, 0, 576, 4, 16],
        [60, 54, 1105, 687, 0, 105, 0, 0, 0, 15, 6, 16],
        [60, 54, 1054, 0, 0, 105, 0, 0, 0, 15, 6, 16],
        [60, 54, 1909, 549, 0, 347, 78, 0, 0, 466, 6, 157],
        [60, 53, 1005, 1100, 0, 96, 0, 0, 0, 15, 7, 16],
        [60, 53, 950, 0, 0, 96, 0, 0, 0, 15, 7, 16],
        [60, 56, 1698, 778, 0, 363, 0, 0, 0, 481, 4, 16],
    ];
    assert_frozen(&found[..], &expected);
}

#[test]
fn work_from_random_places() {
    let mut found = Vec::new();
    for (kinds, elastic) in [(&ALL[..1], false), (&ALL[..], true), (&ALL[..], false)] {
        let mut row = Row::default();
        for stream in 2000..2050 {
            let system = random(stream, kinds, elastic);
            let mut rng = ChaCha8Rng::seed_from_u64(stream);
            let places = system.joints().iter();
            let places: Vec<Vector> =
                places.map(|_| std::array::from_fn(|_| rng.random_range(-2.0..2.0))).collect();
            add(&mut row, solve_from(&system, &Seed::at(places), &Settings::default()));
        }
        found.push(row);
    }
    let expected = [
        [50, 26, 820, 242, 0, 0, 0, 0, 122, 7, 24, 547],
        [50, 39, 2504, 793, 0, 78, 0, 0, 0, 8, 11, 126],
        [50, 39, 4362, 464, 0, 71, 2, 0, 0, 8, 11, 159],
    ];
    assert_frozen(&found[..], &expected);
}

/// Runs are elements where systems are large.
#[test]
fn work_of_elements() {
    let mut found = [Row::default(); 2];
    for seed in 100..120 {
        let system = bridle(seed);
        let elements = Settings { dense_freedoms: 0, ..Settings::default() };
        add(&mut found[0], solve(&system, &elements));
        add(&mut found[1], solve(&above_a_floor(system), &elements));
    }
    let expected =
        [[20, 20, 176, 0, 0, 0, 0, 0, 0, 0, 0, 0], [20, 20, 580, 0, 0, 2, 175, 0, 0, 175, 0, 0]];
    assert_frozen(&found[..], &expected);
}

/// All exhibits: from no guess or from the drawing, and from places a twentieth of a metre off.
#[test]
fn work_on_exhibits() {
    let settings = Settings::default();
    let mut found = Vec::new();
    for exhibit in model::cases::exhibits() {
        let system = exhibit.system();
        let first = match system.drawing() {
            Some(drawing_m) => solve_from(&system, &Seed::at(drawing_m), &settings),
            None => solve(&system, &settings),
        };
        let mut row = Row::default();
        let seed: Option<Vec<Vector>> = first.as_ref().ok().map(|solution| {
            let off = |k: usize, x: f64| x + 0.05 * (1.0 + k as f64).sin();
            let joints = solution.equilibrium.joints_m.iter().enumerate();
            joints.map(|(j, at)| std::array::from_fn(|k| off(3 * j + k, at[k]))).collect()
        });
        add(&mut row, first);
        if let Some(seed) = seed {
            add(&mut row, solve_from(&system, &Seed::at(seed), &settings));
        }
        found.push((exhibit.name, row));
    }
    let expected = [
        ("lamp", [2, 2, 21, 2, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("bridle", [2, 2, 23, 84, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("mobile", [2, 2, 114, 30, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("footbridge", [2, 2, 25, 46, 0, 0, 10, 0, 0, 0, 0, 0]),
        ("net", [2, 2, 27, 174, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("ring", [2, 2, 24, 42, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("tripod", [2, 2, 18, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("pendulum-chain", [2, 2, 23, 20, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("four-bar-linkage", [2, 2, 21, 8, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("x-cross", [2, 2, 54, 4, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("prism", [2, 2, 62, 10, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("expandable-octahedron", [2, 2, 87, 40, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("simplex-tower", [2, 2, 83, 20, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("warren-truss", [2, 2, 15, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("pratt-truss", [2, 2, 19, 0, 8, 0, 0, 2, 0, 0, 0, 0]),
        ("lattice-tower", [2, 2, 13, 72, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("star-dome", [2, 2, 22, 42, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("geiger-dome", [2, 2, 120, 108, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("ring-on-a-rope", [2, 2, 20, 4, 0, 0, 0, 0, 0, 0, 0, 0]),
        ("tackle", [2, 2, 12, 6, 0, 0, 0, 0, 0, 0, 0, 0]),
    ];
    assert_frozen(&found[..], &expected);
}

/// Three cables and a lamp: a solve that may do less work than it needs says so, after no more than
/// what one round of its loops does, and one that may do more gives the same answer as ever.
#[test]
fn a_solve_ends_with_its_work() {
    let joints = samples::joints(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.5], [1.0, 1.5, -0.3]], &[3.0]);
    let cable = |from| Member::cable(from, 3, Bar::homogeneous(2.0, 1.0).unwrap());
    let system = System::new("a lamp", 9.81, joints, (0..3).map(cable).collect()).unwrap();
    let found = solve(&system, &Settings::default()).unwrap();
    let mut refused = 0;
    for max_work in [1, 7, 20, 50, 100, 200, 500, 5000] {
        match solve(&system, &Settings { max_work, ..Settings::default() }) {
            Err(Error::Work { spent, max_work: most }) => {
                refused += 1;
                assert!(most == max_work && spent >= most && spent < most + 9, "{spent} of {most}");
            }
            other => {
                assert!(max_work >= 50, "{max_work}");
                assert_eq!(other.unwrap().equilibrium.joints_m, found.equilibrium.joints_m);
            }
        }
    }
    assert!(refused >= 2, "{refused}");
    let settings = Settings { max_work: 0, ..Settings::default() };
    assert!(solve(&system, &settings).unwrap_err().to_string().contains("max_work = 0"));
}
