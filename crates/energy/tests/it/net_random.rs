//! Random networks: whatever the solver says, it says with the forces in balance.

use energy::net::{Settings, minimise};
use model::system::{Joint, Member, System};
use model::{Bar, Vector};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::net_support::{G, check_but};

/// Random places of `joints` joints in a box.
fn places(rng: &mut ChaCha8Rng, joints: usize) -> Vec<Vector> {
    (0..joints).map(|_| std::array::from_fn(|_| rng.random_range(-1.0..1.0))).collect()
}

/// The system that fits these places: lengths are distances.
fn fitted(rng: &mut ChaCha8Rng, at: &[Vector], anchors: usize, pairs: &[(usize, usize)]) -> System {
    let joints = at.iter().enumerate().map(|(k, &at_m)| {
        if k < anchors {
            Joint::anchor(format!("{k}"), at_m)
        } else {
            Joint::free(format!("{k}")).with_mass(rng.random_range(0.0..2.0))
        }
    });
    let joints = joints.collect();
    let members = pairs.iter().map(|&(a, b)| {
        let length = (0..3).map(|k| (at[a][k] - at[b][k]).powi(2)).sum::<f64>().sqrt();
        Member::bar(a, b, Bar::homogeneous(length, rng.random_range(0.1..1.0)).expect("a bar"))
    });
    System::new("random", G, joints, members.collect()).expect("a system")
}

/// A tree on one anchor.
pub fn tree(rng: &mut ChaCha8Rng) -> System {
    let n = rng.random_range(3..40);
    let at = places(rng, n);
    let pairs: Vec<_> = (1..n).map(|k| (rng.random_range(0..k), k)).collect();
    fitted(rng, &at, 1, &pairs)
}

/// Strands of several bars from anchors to one joint.
pub fn bridle(rng: &mut ChaCha8Rng) -> System {
    let (strands, bars) = (rng.random_range(2..7), rng.random_range(1..6));
    let at = places(rng, strands + 1 + strands * (bars - 1));
    let mut pairs = Vec::new();
    for strand in 0..strands {
        let mut last = strand;
        for k in 0..bars - 1 {
            let next = strands + 1 + strand * (bars - 1) + k;
            pairs.push((last, next));
            last = next;
        }
        pairs.push((last, strands));
    }
    fitted(rng, &at, strands, &pairs)
}

/// A ring with some of its joints held by strands from anchors.
pub fn ring(rng: &mut ChaCha8Rng) -> System {
    let (anchors, n) = (rng.random_range(1..6), rng.random_range(6..20));
    let at = places(rng, anchors + n);
    let mut pairs: Vec<_> = (0..n).map(|k| (anchors + k, anchors + (k + 1) % n)).collect();
    pairs.extend((0..anchors).map(|a| (a, anchors + a * n / anchors)));
    fitted(rng, &at, anchors, &pairs)
}

/// A crumpled net.
pub fn net(rng: &mut ChaCha8Rng, crumple: f64) -> System {
    let n = rng.random_range(3..8);
    let mut at = Vec::new();
    let mut number = vec![vec![0; n]; n];
    let corner = |i: usize, j: usize| (i == 0 || i == n - 1) && (j == 0 || j == n - 1);
    let cells: Vec<_> = (0..n * n).map(|k| (k / n, k % n)).collect();
    for &(i, j) in cells
        .iter()
        .filter(|&&(i, j)| corner(i, j))
        .chain(cells.iter().filter(|&&(i, j)| !corner(i, j)))
    {
        number[i][j] = at.len();
        let jitter: Vector = std::array::from_fn(|_| rng.random_range(-crumple..crumple));
        at.push([i as f64 + jitter[0], j as f64 + jitter[1], jitter[2]]);
    }
    let mut pairs = Vec::new();
    for &(i, j) in &cells {
        if i + 1 < n {
            pairs.push((number[i][j], number[i + 1][j]));
        }
        if j + 1 < n {
            pairs.push((number[i][j], number[i][j + 1]));
        }
    }
    fitted(rng, &at, 4, &pairs)
}

/// The systems fit a configuration, so each has a minimum, and it must be found. Balance and
/// lengths to 1e-11: these systems have up to 80 bars, some of them nearly in one line, whose
/// forces are hundreds of times the loads.
fn all_found(make: impl Fn(&mut ChaCha8Rng) -> System, count: u64) {
    for stream in 0..count {
        let mut rng = ChaCha8Rng::seed_from_u64(stream);
        let system = make(&mut rng);
        match minimise(&system, &Settings::default()) {
            Ok(solution) => check_but(&system, &solution, &[], 1e-11),
            Err(error) => panic!("{stream}: {error}"),
        }
    }
}

#[test]
fn random_trees_hang() {
    all_found(tree, 40);
}

#[test]
fn random_bridles_hang() {
    all_found(bridle, 120);
}

#[test]
fn random_rings_hang() {
    all_found(ring, 60);
}

#[test]
fn random_nets_hang() {
    all_found(|rng| net(rng, 0.3), 20);
    all_found(|rng| net(rng, 1.0), 40);
}

#[test]
fn cables_of_random_nets_pull_or_are_slack_and_hang_lower_than_bars() {
    let mut slack = 0;
    for stream in 0..30 {
        let mut rng = ChaCha8Rng::seed_from_u64(stream);
        let bars = net(&mut rng, 1.0);
        let members = bars.members().iter().map(|bar| Member::cable(bar.from, bar.to, bar.body));
        let cables =
            System::new("cables", G, bars.joints().to_vec(), members.collect()).expect("a system");
        let solution = minimise(&cables, &Settings::default()).expect("a minimum");
        let found = &solution.equilibrium;
        let loose: Vec<usize> =
            (0..found.axial_n.len()).filter(|&e| found.axial_n[e] <= 0.0).collect();
        check_but(&cables, &solution, &loose, 1e-11);
        slack += loose.len();
        for &e in &loose {
            let (member, joints) = (&cables.members()[e], &found.joints_m);
            let span = (0..3).map(|k| (joints[member.from][k] - joints[member.to][k]).powi(2));
            assert_eq!(found.axial_n[e].to_bits(), 0.0_f64.to_bits());
            assert!(span.sum::<f64>().sqrt() <= member.body.length_m() * (1.0 + 1e-11));
        }
        // Whatever bars can do cables can.
        let stiff = minimise(&bars, &Settings::default()).expect("a minimum").equilibrium.energy_j;
        assert!(found.energy_j <= stiff + 1e-11 * stiff.abs(), "{stream}");
    }
    assert!(slack > 100, "{slack}");
}
