//! Chains and checks that several tests use.

use energy::{Seed, Solution};
use model::{Bar, Problem, Vector};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

pub fn rng(stream: u64) -> ChaCha8Rng {
    samples::stream(20_261_121, stream)
}

/// Bars as (length, mass, part of the length at which the centre lies).
pub fn problem(bars: &[(f64, f64, f64)], end_m: Vector, gravity: f64) -> Problem {
    let bars = bars.iter().map(|&(l, m, r)| Bar::new(l, m, r * l, [0.0; 3]).expect("a valid bar"));
    samples::of_bars(gravity, bars, end_m)
}

/// A direction evenly distributed over the sphere.
pub fn direction(rng: &mut ChaCha8Rng) -> Vector {
    let z: f64 = rng.random_range(-1.0..1.0);
    let (s, c) = rng.random_range(0.0..std::f64::consts::TAU).sin_cos();
    let r = (1.0 - z * z).sqrt();
    [r * c, r * s, z]
}

pub fn random_seed(problem: &Problem, rng: &mut ChaCha8Rng) -> Seed {
    let directions: Vec<Vector> = problem.chain().bars().iter().map(|_| direction(rng)).collect();
    Seed::directions(problem, &directions).expect("one direction per bar")
}

pub fn difference(a: Vector, b: Vector) -> f64 {
    (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max)
}

/// The unit of energy: total weight times total length.
pub fn energy_unit(problem: &Problem) -> f64 {
    let chain = problem.chain();
    chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m()
}

/// Newton's laws for every bar, from the directions and the joint forces alone: the largest
/// unbalanced force, and the largest unbalanced moment over the length of its bar, both over the
/// largest force. Also the largest error of a length and of the end anchor, over the total length.
pub fn unbalanced(problem: &Problem, solution: &Solution) -> (f64, f64) {
    let chain = problem.chain();
    let found = &solution.equilibrium;
    let mut forces = 0.0_f64;
    let mut largest = chain.total_mass_kg() * chain.gravity_m_s2();
    let mut lengths = difference(*found.joints_m.last().expect("joints"), chain.anchors().end_m);
    for (i, bar) in chain.bars().iter().enumerate() {
        let (p, q) = (found.joints_m[i], found.joints_m[i + 1]);
        let axis: Vector = std::array::from_fn(|k| q[k] - p[k]);
        let length = axis[0].hypot(axis[1]).hypot(axis[2]);
        lengths = lengths.max((length - bar.length_m()).abs());
        // Entry 0 acts on bar 1; entry i acts on the bar before joint i, so minus it on the next.
        let sign = if i == 0 { 1.0 } else { -1.0 };
        let at_p = found.multipliers_n[i].map(|x| sign * x);
        let at_q = found.multipliers_n[i + 1];
        let weight = bar.mass_kg() * chain.gravity_m_s2();
        let sum: Vector =
            std::array::from_fn(|k| at_p[k] + at_q[k] - if k == 2 { weight } else { 0.0 });
        // Moments about the first joint, per length of the bar.
        let part = bar.centre_m() / bar.length_m();
        let arm: Vector =
            std::array::from_fn(|k| at_q[k] - if k == 2 { part * weight } else { 0.0 });
        // Not from the joints: the ends of a tiny bar far along the chain are rounded.
        let u = solution.directions[i];
        let moment = [
            u[1] * arm[2] - u[2] * arm[1],
            u[2] * arm[0] - u[0] * arm[2],
            u[0] * arm[1] - u[1] * arm[0],
        ];
        for k in 0..3 {
            forces = forces.max(sum[k].abs()).max(moment[k].abs());
            largest = largest.max(at_p[k].abs()).max(at_q[k].abs());
        }
    }
    (forces / largest, lengths / chain.total_length_m())
}
