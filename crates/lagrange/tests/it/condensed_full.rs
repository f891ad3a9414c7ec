//! The condensed equations give the hanging equilibria that the full system of the paper gives. For
//! 2 to 30 bars: a single bar is refused as a problem, it cannot move and the force along it is
//! indeterminate.

use lagrange::{Settings, condensed, solve};
use model::{Equilibrium, Problem, Vector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use samples::{General, Line};

/// Agreement of joints, in total lengths, and of forces, in units of the largest. The full system
/// is solved to 1e-13. Measured: 2e-14.
const AGREED: f64 = 1e-12;
/// Bars of the largest chain.
const LARGEST: usize = 30;

fn random_problem(rng: &mut ChaCha8Rng, n: usize, vertical: bool) -> Problem {
    let line = if vertical { Line::Vertical } else { Line::Any };
    General { start_m: -1.0..1.0, span: 0.2..0.9, line, ..General::default() }.problem(rng, n)
}

/// Largest difference of joints and of forces, relative.
fn difference(problem: &Problem, a: &Equilibrium, b: &Equilibrium) -> f64 {
    let apart = |a: &[Vector], b: &[Vector]| {
        let parts = a.iter().flatten().zip(b.iter().flatten());
        parts.map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
    };
    let largest = a.multipliers_n.iter().flatten().fold(0.0_f64, |most, x| most.max(x.abs()));
    let axial = a.axial_n.iter().zip(&b.axial_n).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
    (apart(&a.joints_m, &b.joints_m) / problem.chain().total_length_m())
        .max(apart(&a.multipliers_n, &b.multipliers_n) / largest)
        .max(axial / largest)
}

/// Turn an equilibrium about the vertical through joint 0, so that joint 1 gets the azimuth of
/// another.
fn turned(from: &Equilibrium, like: &Equilibrium) -> Equilibrium {
    let azimuth = |e: &Equilibrium| {
        let h: Vector = std::array::from_fn(|k| e.joints_m[1][k] - e.joints_m[0][k]);
        h[1].atan2(h[0])
    };
    let (sin, cos) = (azimuth(like) - azimuth(from)).sin_cos();
    let turn = |v: Vector| [cos * v[0] - sin * v[1], sin * v[0] + cos * v[1], v[2]];
    let origin = from.joints_m[0];
    let mut to = from.clone();
    for joint in &mut to.joints_m {
        let arm = turn(std::array::from_fn(|k| joint[k] - origin[k]));
        *joint = std::array::from_fn(|k| origin[k] + arm[k]);
    }
    for force in &mut to.multipliers_n {
        *force = turn(*force);
    }
    to
}

#[test]
fn both_find_the_same_hanging_equilibria() {
    let mut rng = ChaCha8Rng::seed_from_u64(30);
    for n in 2..=LARGEST {
        for vertical in [false, true] {
            let problem = random_problem(&mut rng, n, vertical);
            let full = solve(&problem, &Settings::default()).unwrap().equilibrium;
            let short = condensed::solve(&problem, &condensed::Settings::default()).unwrap();
            let short =
                if vertical { turned(&short.equilibrium, &full) } else { short.equilibrium };
            let off = difference(&problem, &full, &short);
            assert!(off <= AGREED, "n = {n}, vertical {vertical}: {off:e}");
            assert_eq!(full.stability, short.stability, "n = {n}, vertical {vertical}");
        }
    }
}
