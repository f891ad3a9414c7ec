//! Twins of the derivatives: differences along closed chains, and a dense matrix for the counts.

use std::sync::Arc;

use model::Vector;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::run::closure::Shape;
use crate::run::curvature::Curvature;
use crate::run::scaled_chain::ScaledChain;
use crate::run::settings::Motion;
use crate::run::slope::Slope;
use crate::vector::{along, cross, dot, norm, scaled, tangent, unit};

fn random(rng: &mut ChaCha8Rng) -> Vector {
    std::array::from_fn(|_| rng.random_range(-1.0..1.0))
}

/// A random closed chain that is no equilibrium.
fn place(n: usize, motion: Motion, vertical: bool, rng: &mut ChaCha8Rng) -> Curvature {
    let mut length: Vec<f64> = (0..n).map(|_| rng.random_range(0.5..1.5)).collect();
    let total: f64 = length.iter().sum();
    for l in &mut length {
        *l /= total;
    }
    let carried = (0..n).map(|_| rng.random_range(-0.5..0.5)).collect();
    let span = if vertical { [0.0, 0.0, -0.5] } else { [0.4, 0.0, 0.2] };
    let up = [0.0, 0.0, 1.0];
    let links = ScaledChain { length, carried, span: [span, [0.0; 3]], up, vertical, motion };
    let u: Vec<Vector> = (0..n)
        .map(|_| {
            let mut v = random(rng);
            if motion == Motion::Plane {
                v[1] = 0.0;
            }
            unit(v).unwrap()
        })
        .collect();
    let moments = links.measure(&u);
    let shape = links.close(Shape { u, moments }, 300).unwrap();
    let slope = Slope::new(&links, &shape);
    Curvature { links: Arc::new(links), shape: Arc::new(shape), slope: Arc::new(slope) }
}

/// A random motion that keeps the chain closed to first order.
fn motion(at: &Curvature, rng: &mut ChaCha8Rng) -> Vec<Vector> {
    let u = &at.shape.u;
    let raw: Vec<Vector> = u
        .iter()
        .map(|&u| {
            let mut v = random(rng);
            if at.links.motion == Motion::Plane {
                v[1] = 0.0;
            }
            tangent(u, v)
        })
        .collect();
    let gap = raw.iter().zip(&at.links.length).fold([0.0; 3], |g, (v, l)| along(g, *l, *v));
    let pull = crate::run::closure::answer(&at.shape.moments.spread, 0.0, gap);
    raw.iter().zip(u).map(|(&v, &u)| along(v, -1.0, tangent(u, pull))).collect()
}

fn product(at: &Curvature, a: &[Vector], b: &[Vector]) -> f64 {
    at.links.length.iter().zip(a).zip(b).map(|((l, a), b)| l * dot(*a, *b)).sum()
}

/// The energy after the motion, the chain closed again.
fn value(at: &Curvature, v: &[Vector], h: f64) -> f64 {
    let moved = at.links.moved(&at.shape.u, |i, _| scaled(h, v[i]));
    at.links.close(moved, 30).unwrap().moments.value
}

#[test]
fn gradient_and_hessian_are_the_derivatives_along_closed_chains() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for case in 0..60 {
        let kind = if case % 3 == 0 { Motion::Plane } else { Motion::Space };
        let at = place(3 + case % 6, kind, case % 2 == 0, &mut rng);
        let spread = at.shape.moments.spread.eigen().value;
        if spread[..3].iter().any(|x| *x < 0.05) {
            // Nearly straight: the differences need smaller steps than their roundings allow.
            continue;
        }
        let v = motion(&at, &mut rng);
        let gradient: Vec<Vector> = at
            .shape
            .u
            .iter()
            .enumerate()
            .map(|(i, &u)| tangent(u, at.links.load(i, at.slope.multiplier)))
            .collect();
        let slope = product(&at, &gradient, &v);
        let (first, second) = differences(|h| value(&at, &v, h));
        assert!((slope - first).abs() < 1e-9, "{case}: {slope} {first}");

        let turned = at.apply(&v);
        let curvature = product(&at, &turned, &v);
        assert!((curvature - second).abs() < 1e-6, "{case}: {curvature} {second}");
        // A motion of closed chains, and symmetric.
        let gap = turned.iter().zip(&at.links.length).fold([0.0; 3], |g, (v, l)| along(g, *l, *v));
        assert!(norm(gap) < 1e-14);
        let w = motion(&at, &mut rng);
        let other = product(&at, &at.apply(&w), &v);
        assert!((product(&at, &turned, &w) - other).abs() < 1e-14);
    }
}

/// First and second derivative at 0 by central differences of fourth order.
fn differences(f: impl Fn(f64) -> f64) -> (f64, f64) {
    let (h, middle) = (1e-3, f(0.0));
    let [a, b, c, d] = [f(-2.0 * h), f(-h), f(h), f(2.0 * h)];
    let first = (a - 8.0 * b + 8.0 * c - d) / (12.0 * h);
    let second = (-a + 16.0 * b - 30.0 * middle + 16.0 * c - d) / (12.0 * h * h);
    (first, second)
}

#[test]
fn counting_signs_gives_the_eigenvalues_of_the_dense_matrix() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for case in 0..80 {
        let kind = if case % 3 == 0 { Motion::Plane } else { Motion::Space };
        let at = place(2 + case % 5, kind, case % 2 == 0, &mut rng);
        let eigenvalues = dense(&at);
        assert_eq!(eigenvalues.len(), at.dimension(), "{case}");
        for shift in [-0.5, -0.2, -0.05, 0.0, 0.03, 0.1, 0.4] {
            let below = eigenvalues.iter().filter(|x| **x < -shift).count();
            let near = eigenvalues.iter().any(|x| (x + shift).abs() < 1e-9);
            assert!(near || at.index(shift) == below, "{case} {shift}: {eigenvalues:?}");
        }
    }
}

#[test]
fn a_newton_step_solves_its_system() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for case in 0..40 {
        let at = place(3 + case % 5, Motion::Space, case % 2 == 0, &mut rng);
        let shift = 1.1 * (-at.slope.lowest).max(0.1);
        let step = at.step(shift).unwrap();
        let v: Vec<Vector> =
            at.shape.u.iter().enumerate().map(|(i, &u)| at.turn_of(&step, i, u)).collect();
        // (H + s) v + g is normal to every motion that the system allows.
        let hv = at.apply(&v);
        for _ in 0..5 {
            let mut w = motion(&at, &mut rng);
            if at.links.turns() {
                // No part along the free turn.
                let turn: Vec<Vector> = at.shape.u.iter().map(|&u| cross(at.links.up, u)).collect();
                let part = product(&at, &w, &turn) / product(&at, &turn, &turn);
                w = w.iter().zip(&turn).map(|(&w, &t)| along(w, -part, t)).collect();
            }
            let load: f64 = (0..w.len())
                .map(|i| at.links.length[i] * dot(at.links.load(i, at.slope.multiplier), w[i]))
                .sum();
            let left = product(&at, &hv, &w) + shift * product(&at, &v, &w) + load;
            assert!(left.abs() < 1e-13, "{case}: {left:e}");
        }
    }
}

/// The lowest mode has nearly the lowest eigenvalue, by four steps of inverse iteration; it keeps
/// the chain closed, and its curvature is its Rayleigh quotient. The condition is enclosed within
/// ten per cent either way.
#[test]
fn falling_modes_and_conditions_are_those_of_the_dense_matrix() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut falling = 0;
    for case in 0..90 {
        let kind = if case % 3 == 0 { Motion::Plane } else { Motion::Space };
        let at = place(4 + case % 5, kind, case % 2 == 0, &mut rng);
        let values = dense(&at);
        let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
        let least = values.iter().map(|value| value.abs()).fold(f64::INFINITY, f64::min);
        let ratio = at.condition(1e-10) * least / at.slope.highest;
        assert!(least < 1e-7 || (0.9..1.11).contains(&ratio), "{case}: {ratio}");
        assert_eq!(at.undecided(at.slope.zero), 0, "{case}");
        let Some((mode, curvature)) = at.falling(1e-10) else {
            assert!(lowest > -2e-10, "{case}: {lowest}");
            continue;
        };
        falling += 1;
        assert!((0.97..1.0 + 1e-9).contains(&(curvature / lowest)), "{case}: {curvature} {lowest}");
        let (size, bend) = (product(&at, &mode, &mode), product(&at, &at.apply(&mode), &mode));
        assert!((bend / size / curvature - 1.0).abs() < 1e-9, "{case}");
        let most = mode.iter().fold(0.0_f64, |most, v| most.max(norm(*v)));
        assert!((most - 1.0).abs() < 1e-14);
        let moved =
            (0..mode.len()).fold([0.0; 3], |sum, i| along(sum, at.links.length[i], mode[i]));
        assert!(norm(moved) < 1e-12, "{case}: {moved:?}");
        assert!(mode.iter().zip(&at.shape.u).all(|(v, u)| dot(*v, *u).abs() < 1e-12));
    }
    assert!(falling > 60, "{falling}");
}

/// Eigenvalues of the Hessian on an orthonormal basis of the closed motions, the free turn left
/// out.
fn dense(at: &Curvature) -> Vec<f64> {
    let n = at.links.bars();
    let mut rng = ChaCha8Rng::seed_from_u64(9);
    let mut taken: Vec<Vec<Vector>> = Vec::new();
    if at.links.turns() {
        let turn: Vec<Vector> = at.shape.u.iter().map(|&u| cross(at.links.up, u)).collect();
        let size = product(at, &turn, &turn).sqrt();
        taken.push(turn.iter().map(|&v| scaled(1.0 / size, v)).collect());
    }
    let first = taken.len();
    for _ in 0..2 * n {
        let mut v = motion(at, &mut rng);
        // Twice is enough.
        for _ in 0..2 {
            for t in &taken {
                let part = product(at, &v, t);
                v = v.iter().zip(t).map(|(&v, &t)| along(v, -part, t)).collect();
            }
        }
        let size = product(at, &v, &v).sqrt();
        if size > 1e-9 {
            taken.push(v.iter().map(|&v| scaled(1.0 / size, v)).collect());
        }
    }
    let basis = &taken[first..];
    if basis.is_empty() {
        return vec![];
    }
    let bent: Vec<Vec<Vector>> = basis.iter().map(|v| at.apply(v)).collect();
    let matrix =
        DMatrix::from_fn(basis.len(), basis.len(), |i, j| product(at, &bent[i], &basis[j]));
    matrix.symmetric_eigenvalues().as_slice().to_vec()
}
