//! Nets of thousands of members: few factorisations, whatever goes slack.

use energy::net::{Settings, Solution, minimise};
use model::Bar;
use model::system::{Joint, Member, System};

use crate::net_support::{G, bar, check_but};

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

#[test]
fn long_strands_take_no_more_steps_than_short_ones() {
    for bars in [30, 3000] {
        let mut joints = vec![Joint::free("knot")];
        let mut members = Vec::new();
        let bar = Bar::homogeneous(1.3 / f64::from(bars), 1.3 / f64::from(bars)).expect("a bar");
        for strand in 0..3 {
            let angle = std::f64::consts::TAU * f64::from(strand) / 3.0;
            let at_m = [angle.cos(), angle.sin(), 0.1 * f64::from(strand)];
            joints.push(Joint::anchor(format!("anchor {strand}"), at_m));
            for k in 1..=bars {
                let from = joints.len() - 1;
                let to = if k == bars { 0 } else { joints.len() };
                members.push(Member::bar(from, to, bar));
                if k < bars {
                    joints.push(Joint::free(format!("{strand} {k}")));
                }
            }
        }
        let system = System::new("bridle", G, joints, members).expect("a system");
        let solution = minimise(&system, &Settings::default()).expect("a minimum");
        check_but(&system, &solution, &[], ROUNDING);
        assert!(solution.work.factorisations <= 8, "{bars}: {:?}", solution.work);
    }
}

/// A ring of 50 kg on three strands of 4,000 bars of 1 m and 0.3 kg from anchors on a circle: places have twelve
/// digits, and yet every bar bears along the strand what the ring draws it aside with, the same in all of them, and
/// upright a third of the ring and what hangs below its middle.
#[test]
fn long_strands_bear_what_hangs_below_them() {
    const BARS: usize = 4000;
    let (ring, mut joints, mut members) = (3, vec![], vec![]);
    for k in 0..3 {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 3.0).sin_cos();
        joints.push(Joint::anchor(format!("A{k}"), [3000.0 * cos, 3000.0 * sin, 0.0]));
    }
    joints.push(Joint::free("ring").with_mass(50.0));
    for k in 0..3 {
        for step in 0..BARS {
            let from = if step == 0 { k } else { joints.len() - 1 };
            let to = if step + 1 == BARS { ring } else { joints.len() };
            if to != ring {
                joints.push(Joint::free(format!("{k}-{step}")));
            }
            members.push(bar(from, to, 1.0, 0.3));
        }
    }
    let system = System::new("strands", G, joints, members).expect("a system");
    let solution = minimise(&system, &Settings::default()).expect("a minimum");
    let forces_n = &solution.equilibrium.start_forces_n;
    for (k, strand) in forces_n.chunks(BARS).enumerate() {
        let (sin, cos) = (k as f64 * std::f64::consts::TAU / 3.0).sin_cos();
        let aside_n = cos * strand[0][0] + sin * strand[0][1];
        for (below, [x, y, z]) in (1..=BARS).rev().zip(strand) {
            let upright_n = G * (50.0 / 3.0 + 0.3 * below as f64);
            let off = [x - cos * aside_n, y - sin * aside_n, z - upright_n];
            assert!(off.iter().all(|off| off.abs() < 2e-9), "{k} {below}: {off:?}");
        }
    }
}
