//! Runs of members as one element each, against the equations of all members and chains.

use lagrange::net::{Settings, solve};
use model::Bar;
use model::system::{Joint, Kind, Member, System};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::net::{close, faults, hang, near};

/// A bridle in space: strands of bars, cables and springs with forces on their joints from two to
/// five anchors to one of two joints, which a strand connects, and a tree below the first.
pub fn bridle(seed: u64) -> System {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (mut joints, mut members) = (Vec::new(), Vec::new());
    joints.extend(["left", "right"].map(|name| Joint::free(name).with_mass(3.0)));
    let mut strands = vec![(0, 1, 3.0)];
    for k in 0..rng.random_range(2..=5_usize) {
        let (x, y) = (rng.random_range(-4.0..4.0), if k % 2 == 0 { -4.0 } else { 4.0 });
        joints.push(Joint::anchor(format!("A{k}"), [x, y, rng.random_range(-0.5..0.5)]));
        strands.push((joints.len() - 1, k % 2, rng.random_range(5.0..7.0)));
    }
    for (from, to, length) in strands {
        let count = rng.random_range(1..40_usize);
        let mut here = from;
        for k in 1..=count {
            let there = if k == count { to } else { joints.len() };
            if k < count {
                let mut aside = || rng.random_range(-0.05..0.05);
                joints.push(Joint::free(format!("{from} {k}")).with_force([aside(), aside(), 0.0]));
            }
            let body = Bar::homogeneous(length / count as f64, rng.random_range(0.01..0.1));
            let (one, other) = if rng.random_bool(0.5) { (here, there) } else { (there, here) };
            let member = Member::bar(one, other, body.unwrap());
            members.push(match rng.random_range(0..3) {
                0 => member,
                1 => member.of_kind(Kind::Cable),
                _ => member.with_stiffness(rng.random_range(100.0..10_000.0)),
            });
            here = there;
        }
    }
    for k in 0..rng.random_range(0..20_usize) {
        let root = if k == 0 { 0 } else { joints.len() - rng.random_range(1..=k) };
        members.push(Member::bar(root, joints.len(), Bar::homogeneous(0.3, 0.05).unwrap()));
        joints.push(Joint::free(format!("tree {k}")));
    }
    System::new("bridle", 9.80665, joints, members).unwrap()
}

/// With no system small enough to go without, runs are elements; with all of them, none is.
#[test]
fn elements_and_members_agree() {
    let members = Settings { dense_freedoms: 3000, ..Settings::default() };
    let elements = Settings { dense_freedoms: 0, ..Settings::default() };
    let mut fewer = 0;
    for seed in 0..40 {
        let system = bridle(seed);
        let (one, other) = (solve(&system, &members), solve(&system, &elements));
        let (one, other) = (one.unwrap(), other.unwrap());
        let faults = faults(&system, &other);
        assert!(faults.is_empty(), "{seed}: {}", faults.join(", "));
        for (a, b) in one.equilibrium.joints_m.iter().zip(&other.equilibrium.joints_m) {
            for axis in 0..3 {
                assert!((a[axis] - b[axis]).abs() < 1e-9, "{seed}: {a:?} and {b:?}");
            }
        }
        let (one, other) = (one.equilibrium.stability, other.equilibrium.stability);
        assert_eq!((one.index_in_space, one.neutral), (other.index_in_space, other.neutral));
        fewer += usize::from(one == other);
    }
    assert_eq!(fewer, 40);
}

/// A chain as a network, of thirty unequal bars and of 3,000 that are one element, has the digits of the solver for
/// chains.
#[test]
fn chains_as_networks_against_condensed() {
    let unequal = (0..30).map(|k| {
        let (length, mass) = (1.0 + 0.3 * f64::from(k % 4), 0.5 + f64::from(k % 3));
        Bar::new(length, mass, 0.4 * length, [0.0; 3]).unwrap()
    });
    let equal = vec![Bar::homogeneous(1.0 / 3000.0, 1.0 / 3000.0).unwrap(); 3000];
    for (bars, end) in [(unequal.collect(), [20.0, 3.0, 1.0]), (equal, [0.6, 0.1, 0.2])] {
        let problem = samples::of_bars(9.80665, bars.clone(), end);
        let expected =
            lagrange::condensed::solve(&problem, &lagrange::condensed::Settings::default());
        let expected = expected.unwrap().equilibrium;
        let mut joints = vec![Joint::anchor("0", [0.0; 3])];
        joints.extend((1..bars.len()).map(|k| Joint::free(format!("{k}"))));
        joints.push(Joint::anchor("end", end));
        let members = bars.iter().enumerate().map(|(k, bar)| Member::bar(k, k + 1, *bar));
        let system = System::new("chain", 9.80665, joints, members.collect()).unwrap();
        let answer = hang(&system).equilibrium;
        for (got, expected) in answer.joints_m.iter().zip(&expected.joints_m) {
            near(*got, *expected);
        }
        for (got, expected) in answer.axial_n.iter().zip(&expected.axial_n) {
            close(*got, *expected);
        }
        close(answer.energy_j, expected.energy_j);
    }
}

/// Three strands of 30,000 bars to one joint: rounding of so long sums does not reach the members,
/// and the factor is that of the branching.
#[test]
fn long_strands_keep_their_digits() {
    const BARS: usize = 30_000;
    let system = samples::bridle(BARS);
    let answer = solve(&system, &Settings::default()).unwrap();
    // Of the loads: forces are a thousand times these.
    assert!(answer.residual <= 1e-13, "{:e}", answer.residual);
    assert!(answer.factorisations <= 10, "{}", answer.factorisations);
    // A third of everything hangs at each anchor.
    let third = system.total_mass_kg() * 9.80665 / 3.0;
    for (joint, reaction) in system.joints().iter().zip(&answer.equilibrium.reactions_n) {
        if joint.support.is_fixed() {
            assert!((reaction[2] - third).abs() < 1e-12 * third);
        }
    }
}

/// A tree of 10,000 bars below one anchor: every member bears the weight below it.
#[test]
fn a_tree_needs_no_factorisation() {
    const BARS: usize = 10_000;
    let bar = Bar::homogeneous(0.5, 2.0).unwrap();
    let mut joints = vec![Joint::anchor("0", [0.0; 3])];
    joints.extend((1..=BARS).map(|k| Joint::free(format!("{k}"))));
    let members = (1..=BARS).map(|k| Member::bar((k - 1) / 2, k, bar)).collect();
    let system = System::new("tree", 1.0, joints, members).unwrap();
    let answer = solve(&system, &Settings::default()).unwrap();
    let mut below = vec![1.0; BARS + 1];
    for k in (1..=BARS).rev() {
        let axial = answer.equilibrium.axial_n[k - 1];
        // Half the weight of the own bar hangs at its upper end.
        let load: f64 = 2.0 * below[k] - 1.0;
        assert!((axial - load).abs() <= 1e-12 * load, "{k}: {axial}, not {load}");
        let weight = below[k];
        below[(k - 1) / 2] += weight;
    }
    assert!(answer.factorisations <= 3, "{}", answer.factorisations);
    assert_eq!(answer.equilibrium.stability.index_in_space, 0);
}
