//! Nets of thousands of members: few factorisations, whatever goes slack.

use energy::net::{Settings, Solution, minimise};
use model::Bar;
use model::system::{Joint, Member, System};

use crate::net_support::{G, check_but};

/// Balance and lengths of systems of this size, over their largest force.
const ROUNDING: f64 = 1e-10;

/// A square net of cables between joints at given places; those with a `true` are anchors.
fn cables(
    n: usize,
    place: impl Fn(usize, usize) -> Option<([f64; 2], bool)>,
    length: impl Fn(f64) -> f64,
) -> (System, Solution) {
    let (mut joints, mut members) = (Vec::new(), Vec::new());
    let mut number = vec![vec![None; n + 1]; n + 1];
    let mut places = Vec::new();
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        let Some(([x, y], held)) = place(i, j) else { continue };
        number[i][j] = Some(joints.len());
        let name = format!("{i} {j}");
        places.push([x, y]);
        joints.push(if held { Joint::anchor(name, [x, y, 0.0]) } else { Joint::free(name) });
    }
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        let Some(from) = number[i][j] else { continue };
        for to in [number[i + 1][j], number[i][j + 1]].into_iter().flatten() {
            let apart = (places[to][0] - places[from][0]).hypot(places[to][1] - places[from][1]);
            let length_m = length(apart);
            members.push(Member::cable(
                from,
                to,
                Bar::homogeneous(length_m, length_m).expect("a bar"),
            ));
        }
    }
    let system = System::new("net", G, joints, members).expect("a system");
    let solution = minimise(&system, &Settings::default()).expect("a minimum");
    let axial = &solution.equilibrium.axial_n;
    let slack: Vec<usize> = (0..axial.len()).filter(|&e| axial[e] <= 0.0).collect();
    assert!(axial.iter().all(|force| *force >= 0.0));
    for &e in &slack {
        let [a, b] = [system.members()[e].from, system.members()[e].to]
            .map(|joint| solution.equilibrium.joints_m[joint]);
        let length = (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt();
        assert!(length <= system.members()[e].body.length_m() * (1.0 + ROUNDING), "{e}");
    }
    check_but(&system, &solution, &slack, ROUNDING);
    (system, solution)
}

#[test]
fn nets_of_cables_on_their_corners_take_one_factorisation_an_iteration() {
    for n in [44, 52] {
        let step = 1.0 / (n as f64 - 1.0);
        let end = |k| k == 0 || k == n - 1;
        let place = |i, j| {
            let at = |k| 0.75 * step * k as f64;
            Some(([at(i), at(j)], end(i) && end(j)))
        };
        let (_, solution) = cables(n, place, |_| step);
        let work = solution.work;
        assert!(work.iterations == 1 && work.factorisations <= 20, "{n}: {work:?}");
    }
}

#[test]
fn nets_in_a_ring_have_slack_cables_near_it() {
    for n in [16, 32] {
        let step = 1.0 / (n as f64 - 1.0);
        let at = |k: usize| k as f64 * step - 0.5;
        let inside = |i: usize, j: usize| at(i).hypot(at(j)) < 0.5;
        let place = |i: usize, j: usize| {
            if !inside(i, j) {
                return None;
            }
            let (x, y) = (at(i), at(j));
            let around = [(i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)];
            let held = !around.iter().all(|&(i, j)| inside(i, j));
            let onto = if held { 0.5 / x.hypot(y) } else { 1.0 };
            Some(([onto * x, onto * y], held))
        };
        let (system, solution) = cables(n, place, |apart| (1.1 * step).max(1.02 * apart));
        let slack = solution.equilibrium.axial_n.iter().filter(|force| **force <= 0.0).count();
        let part = slack as f64 / system.members().len() as f64;
        assert!((0.09..0.22).contains(&part), "{n}: {part}");
        assert!(solution.work.factorisations <= 20, "{n}: {:?}", solution.work);
    }
}

/// Strands of 1 m and 1 kg a bar from anchors on a circle to a knot of n kg: they take no more steps where they are
/// long, and every bar bears along its strand what the knot draws it aside with, the same in all of them, and upright
/// a third of the knot and what hangs below its middle, however few digits places have left.
#[test]
fn long_strands_are_as_short_ones() {
    for bars in [30, 4000] {
        let system = samples::bridle(bars);
        let solution = minimise(&system, &Settings::default()).expect("a minimum");
        check_but(&system, &solution, &[], ROUNDING);
        assert!(solution.work.factorisations <= 8, "{bars}: {:?}", solution.work);
        let forces_n = &solution.equilibrium.start_forces_n;
        let knot = bars as f64 / 3.0;
        for (k, strand) in forces_n.chunks(bars).enumerate() {
            let (sin, cos) = (k as f64 * std::f64::consts::TAU / 3.0).sin_cos();
            let aside_n = cos * strand[0][0] + sin * strand[0][1];
            let off_n = 2e-13 * forces_n[0][2];
            for (below, [x, y, z]) in (1..=bars).rev().zip(strand) {
                let upright_n = system.gravity_m_s2() * (knot + below as f64);
                let off = [x - cos * aside_n, y - sin * aside_n, z - upright_n];
                assert!(off.iter().all(|off| off.abs() < off_n), "{k} {below}: {off:?}");
            }
        }
    }
}
