//! The paper's equation of motion, piece by piece against dual numbers, and as a whole against the
//! natural coordinates.

use model::system::System;
use model::{Anchors, Bar, Chain};
use motion::paper::{
    Constraints, Coordinates, accelerations, angles, angular_inertia, matrix, rates,
    rates_derivative, rotation, velocity_terms,
};
use motion::{Settings, Simulation};
use nalgebra::{Matrix3, Vector3};
use num_dual::{Dual2_64, Dual64, DualNum, HyperDual64, first_derivative};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::common::G;

type Rotation<D> = [[D; 3]; 3];

/// `[ψ][θ][φ]`, written out anew for any numbers.
fn turned<D: DualNum<f64> + Copy>(angles: [D; 3]) -> Rotation<D> {
    let (zero, one) = (D::from(0.0), D::from(1.0));
    let [(sp, cp), (st, ct), (sf, cf)] = angles.map(|a| a.sin_cos());
    let psi = [[one, zero, zero], [zero, cp, -sp], [zero, sp, cp]];
    let theta = [[ct, zero, st], [zero, one, zero], [-st, zero, ct]];
    let phi = [[cf, -sf, zero], [sf, cf, zero], [zero, zero, one]];
    product(product(psi, theta), phi)
}

fn product<D: DualNum<f64> + Copy>(a: Rotation<D>, b: Rotation<D>) -> Rotation<D> {
    std::array::from_fn(|i| {
        std::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j])
    })
}

fn random(rng: &mut ChaCha8Rng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-size..size))
}

/// Angular velocity in the axes of the bar from the rotation's derivative alone: `Aᵀ Ȧ = [ω]`.
fn omega(at: &Vector3<f64>, by: &Vector3<f64>) -> Vector3<f64> {
    let dual = turned([0, 1, 2].map(|k| Dual64::new(at[k], by[k])));
    let a = Matrix3::from_fn(|i, j| dual[i][j].re);
    let dot = Matrix3::from_fn(|i, j| dual[i][j].eps);
    let skew = a.transpose() * dot;
    assert!((skew + skew.transpose()).norm() < 1e-14 * dot.norm().max(1.0));
    Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)])
}

#[test]
fn rotation_and_angular_velocity_are_those_of_dual_numbers() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for _ in 0..100 {
        let (at, by) = (random(&mut rng, 3.0), random(&mut rng, 2.0));
        let told = turned([at.x, at.y, at.z]);
        assert!((rotation(&at) - Matrix3::from_fn(|i, j| told[i][j])).norm() < 1e-15);
        assert!((rates(&at) * by - omega(&at, &by)).norm() < 1e-14);
        let h = |t: Dual64| {
            let (st, ct) = (t * by.y + at.y).sin_cos();
            let (sf, cf) = (t * by.z + at.z).sin_cos();
            [ct * cf, sf, -ct * sf, cf, st]
        };
        let dot = rates_derivative(&at, &by);
        let entries = [dot.m11, dot.m12, dot.m21, dot.m22, dot.m31];
        for (k, entry) in entries.into_iter().enumerate() {
            let (_, slope) = first_derivative(|t| h(t)[k], 0.0);
            assert!((slope - entry).abs() < 1e-14, "{k}");
        }
    }
}

/// Kinetic energy of rotation, from the rotation alone, for any numbers: `½ Σ J_k ω_k²` with
/// `[ω] = Aᵀ Ȧ`, `Ȧ = Σ ∂A/∂β_k β̇_k` by the products' rule.
fn energy<D: DualNum<f64> + Copy>(j: [f64; 3], at: [D; 3], by: [D; 3]) -> D {
    let zero = D::from(0.0);
    let [(sp, cp), (st, ct), (sf, cf)] = at.map(|a| a.sin_cos());
    let (one, a) = (D::from(1.0), turned(at));
    let psi = [[one, zero, zero], [zero, cp, -sp], [zero, sp, cp]];
    let theta = [[ct, zero, st], [zero, one, zero], [-st, zero, ct]];
    let phi = [[cf, -sf, zero], [sf, cf, zero], [zero, zero, one]];
    let psi_by = [[zero; 3], [zero, -sp, -cp], [zero, cp, -sp]];
    let theta_by = [[-st, zero, ct], [zero; 3], [-ct, zero, -st]];
    let phi_by = [[-sf, -cf, zero], [cf, -sf, zero], [zero; 3]];
    let parts = [
        product(product(psi_by, theta), phi),
        product(product(psi, theta_by), phi),
        product(product(psi, theta), phi_by),
    ];
    let dot: Rotation<D> = std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            parts[0][i][k] * by[0] + parts[1][i][k] * by[1] + parts[2][i][k] * by[2]
        })
    });
    let skew = |i: usize, k: usize| a[0][i] * dot[0][k] + a[1][i] * dot[1][k] + a[2][i] * dot[2][k];
    let omega = [skew(2, 1), skew(0, 2), skew(1, 0)];
    (omega[0] * omega[0] * j[0] + omega[1] * omega[1] * j[1] + omega[2] * omega[2] * j[2]) * 0.5
}

/// Derivative of the energy by two of its six arguments.
fn second(j: [f64; 3], at: &Vector3<f64>, by: &Vector3<f64>, first: usize, other: usize) -> f64 {
    let x = |k: usize| {
        let value = if k < 3 { at[k] } else { by[k - 3] };
        let unit = |wanted: usize| if k == wanted { 1.0 } else { 0.0 };
        HyperDual64::new(value, unit(first), unit(other), 0.0)
    };
    energy(j, [x(0), x(1), x(2)], [x(3), x(4), x(5)]).eps1eps2
}

#[test]
fn inertia_and_velocity_terms_follow_from_the_kinetic_energy_by_lagranges_equations() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    for _ in 0..100 {
        let (at, by) = (random(&mut rng, 3.0), random(&mut rng, 2.0));
        let j = [0, 1, 2].map(|_| rng.random_range(0.1..2.0));
        // d/dt ∂T/∂β̇ − ∂T/∂β = ∂²T/∂β̇∂β̇ β̈ + ∂²T/∂β̇∂β β̇ − ∂T/∂β.
        let inertia = Matrix3::from_fn(|i, k| second(j, &at, &by, 3 + i, 3 + k));
        assert!((angular_inertia(j, &at) - inertia).norm() < 1e-13);
        let gradient = Vector3::from_fn(|i, _| {
            let dual = |k: usize| Dual64::new(at[k], if k == i { 1.0 } else { 0.0 });
            energy(j, [dual(0), dual(1), dual(2)], [0, 1, 2].map(|k| Dual64::from(by[k]))).eps
        });
        let mixed = Matrix3::from_fn(|i, k| second(j, &at, &by, 3 + i, k));
        let told = gradient - mixed * by;
        let found = velocity_terms(j, &at, &by);
        assert!((found - told).norm() < 1e-12 * told.norm().max(1.0), "{found} {told}");
    }
}

/// A chain of n bars with three moments each, at random angles that its anchors fit.
fn chain(rng: &mut ChaCha8Rng, n: usize) -> (Chain, Vec<Coordinates>) {
    let mut q = Vec::new();
    let mut bars = Vec::new();
    let mut joint = random(rng, 1.0);
    let start = joint;
    for _ in 0..n {
        let l = rng.random_range(0.5..2.0);
        let r = l * rng.random_range(0.2..0.8);
        let across = rng.random_range(0.05..0.5);
        let along = rng.random_range(0.01..0.1);
        bars.push(Bar::new(l, rng.random_range(0.5..3.0), r, [along, across, across]).unwrap());
        let mut at = random(rng, 3.0);
        // Away from gimbal lock.
        at.y = rng.random_range(-1.0..1.0);
        let axis = rotation(&at).column(0).into_owned();
        let centre = joint + axis * r;
        q.push([centre.x, centre.y, centre.z, at.x, at.y, at.z]);
        joint += axis * l;
    }
    let anchors = Anchors { start_m: start.into(), end_m: joint.into() };
    (Chain::new("random", G, anchors, bars).unwrap(), q)
}

/// The constraints of a chain for any numbers.
fn constraints<D: DualNum<f64> + Copy>(chain: &Chain, q: &[[D; 6]]) -> Vec<D> {
    let n = chain.bars().len();
    let end = |i: usize, far: bool| -> [D; 3] {
        let bar = &chain.bars()[i];
        let along = if far { bar.length_m() - bar.centre_m() } else { -bar.centre_m() };
        let a = turned([q[i][3], q[i][4], q[i][5]]);
        [0, 1, 2].map(|k| q[i][k] + a[k][0] * along)
    };
    let mut values = Vec::new();
    for joint in 0..=n {
        for k in 0..3 {
            values.push(match joint {
                0 => end(0, false)[k] - chain.anchors().start_m[k],
                _ if joint == n => end(n - 1, true)[k] - chain.anchors().end_m[k],
                _ => end(joint - 1, true)[k] - end(joint, false)[k],
            });
        }
    }
    values
}

#[test]
fn the_constraints_and_their_derivatives_are_those_of_dual_numbers() {
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    for n in [2, 3, 5] {
        let (chain, mut q) = chain(&mut rng, n);
        let closed = Constraints::new(&chain).values(&q);
        assert!(closed.amax() < 1e-14);
        // The derivatives hold off the constraints too.
        q[0][1] += 0.1;
        let values = Constraints::new(&chain).values(&q);
        let told = constraints::<f64>(&chain, &q);
        assert!(values.iter().zip(&told).all(|(a, b)| (a - b).abs() < 1e-14));
        let b = Constraints::new(&chain).matrix(&q);
        let v: Vec<Coordinates> =
            (0..n).map(|_| [0; 6].map(|_| rng.random_range(-1.0..1.0))).collect();
        for column in 0..6 * n {
            let dual: Vec<[Dual64; 6]> = (0..n)
                .map(|i| {
                    std::array::from_fn(|k| {
                        let unit = if 6 * i + k == column { 1.0 } else { 0.0 };
                        Dual64::new(q[i][k], unit)
                    })
                })
                .collect();
            for (row, value) in constraints(&chain, &dual).into_iter().enumerate() {
                assert!((value.eps - b[(row, column)]).abs() < 1e-14, "{row} {column}");
            }
        }
        // Along q + t v: the second derivative is Ḃ v.
        let along: Vec<[Dual2_64; 6]> =
            (0..n).map(|i| std::array::from_fn(|k| Dual2_64::new(q[i][k], v[i][k], 0.0))).collect();
        let gamma = Constraints::new(&chain).gamma(&q, &v);
        for (row, value) in constraints(&chain, &along).into_iter().enumerate() {
            assert!((value.v2 + gamma[row]).abs() < 1e-13, "{row}");
        }
    }
}

/// Velocities of the angles of bars whose joints move with these velocities, without spin.
fn velocities(chain: &Chain, q: &[Coordinates], joints: &[[f64; 3]]) -> Vec<Coordinates> {
    let bars = chain.bars().iter().zip(q).enumerate();
    bars.map(|(i, (bar, q))| {
        let [a, b] = [joints[i], joints[i + 1]].map(Vector3::from);
        let at = angles(q);
        let axis = rotation(&at).column(0).into_owned();
        let omega = axis.cross(&((b - a) / bar.length_m()));
        let by = rates(&at).lu().solve(&(rotation(&at).transpose() * omega)).unwrap();
        let centre = a + (b - a) * (bar.centre_m() / bar.length_m());
        [centre.x, centre.y, centre.z, by.x, by.y, by.z]
    })
    .collect()
}

/// Acceleration of the far end of a bar.
fn far_end(
    chain: &Chain,
    i: usize,
    q: &Coordinates,
    v: &Coordinates,
    a: &Coordinates,
) -> Vector3<f64> {
    let bar = &chain.bars()[i];
    let (at, by) = (angles(q), angles(v));
    let omega = rates(&at) * by;
    let turned = rates(&at) * angles(a) + rates_derivative(&at, &by) * by;
    let x = Vector3::x() * (bar.length_m() - bar.centre_m());
    let relative = rotation(&at) * (turned.cross(&x) + omega.cross(&omega.cross(&x)));
    Vector3::new(a[0], a[1], a[2]) + relative
}

#[test]
fn accelerations_and_forces_are_those_of_the_natural_coordinates() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut worst = 0.0_f64;
    for n in [2, 3, 4, 6] {
        for _ in 0..10 {
            let (chain, q) = chain(&mut rng, n);
            let system = System::from(&chain);
            let mut joints = vec![chain.anchors().start_m];
            for (bar, q) in chain.bars().iter().zip(&q) {
                let axis = rotation(&angles(q)).column(0) * bar.length_m();
                let last = joints[joints.len() - 1];
                joints.push([0, 1, 2].map(|k| last[k] + axis[k]));
            }
            let mut natural = Simulation::new(&system, &joints, Settings::default()).unwrap();
            let wild: Vec<[f64; 3]> = joints.iter().map(|_| random(&mut rng, 2.0).into()).collect();
            natural.set_velocities(&wild).unwrap();
            let now = natural.snapshot();
            let v = velocities(&chain, &q, &now.velocities_m_s);
            let found = accelerations(&chain, &q, &v).unwrap();
            let unit = now.end_forces_n.iter().flatten().fold(1.0, |a: f64, x| a.max(x.abs()));
            for i in 0..n {
                let end = far_end(&chain, i, &q[i], &v[i], &found.q[i]);
                for k in 0..3 {
                    let told = now.accelerations_m_s2[i + 1][k];
                    let force = found.lambda_n[i + 1][k] - now.end_forces_n[i][k];
                    worst = worst.max((end[k] - told).abs() / unit).max(force.abs() / unit);
                }
            }
            for k in 0..3 {
                let force = found.lambda_n[0][k] - now.start_forces_n[0][k];
                worst = worst.max(force.abs() / unit);
            }
        }
    }
    println!("largest difference {worst:e} of the largest force");
    assert!(worst < 1e-9, "{worst:e}");
}

#[test]
fn the_papers_coordinates_are_singular_where_the_paper_has_its_equilibrium() {
    // Section VIII with bars that are not slender, so that nothing else is singular.
    let bar = Bar::new(1.0, 1.0, 0.5, [0.01, 1.0 / 12.0, 1.0 / 12.0]).unwrap();
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, -2.0] };
    let chain = Chain::new("three thick bars", G, anchors, vec![bar; 3]).unwrap();
    let degrees = [19.694_867_976_133_02_f64, 38.599_136_184_451_89, -73.920_588_792_231_34];
    // θ = π/2 − ε: the bar points along A x = (cos θ cos φ, ...); at ε = 0 it lies in OYZ.
    let at = |epsilon: f64| -> Vec<Coordinates> {
        let theta = std::f64::consts::FRAC_PI_2 - epsilon;
        let mut joint = Vector3::zeros();
        let mut q = Vec::new();
        for angle in degrees {
            // ψ = 0: x = (0, sin φ, −cos φ) at ε = 0, the angle from the descending vertical.
            let angles = Vector3::new(0.0, theta, angle.to_radians());
            let axis = rotation(&angles).column(0).into_owned();
            let centre = joint + axis * 0.5;
            q.push([centre.x, centre.y, centre.z, angles.x, angles.y, angles.z]);
            joint += axis;
        }
        q
    };
    let smallest = |epsilon: f64| {
        let values = matrix(&chain, &at(epsilon)).svd(false, false).singular_values;
        values.min() / values.max()
    };
    // On the lock the matrix of (33) has no inverse; off it the smallest singular value falls like
    // ε².
    let (on, near, nearer) = (smallest(0.0), smallest(1e-2), smallest(1e-3));
    println!("smallest singular value, relative: {on:e} at the lock, {near:e}, {nearer:e} off it");
    assert!(on < 1e-16 && near > 1e-7, "{on:e} {near:e}");
    assert!((near / nearer / 100.0 - 1.0).abs() < 0.05, "{near:e} {nearer:e}");
    // Columns 4 and 6 of B agree there: ψ and φ turn about the same axis.
    let b = Constraints::new(&chain).matrix(&at(0.0));
    for bar in 0..3 {
        let difference = b.column(6 * bar + 3) - b.column(6 * bar + 5);
        assert!(difference.norm() < 1e-15, "{difference}");
    }
    // The same slow turn of a bar asks for faster and faster angles; its ends move as before.
    let turn = Vector3::new(0.0, 0.0, 1.0);
    let speed = |epsilon: f64| {
        let at = angles(&at(epsilon)[0]);
        rates(&at).lu().solve(&(rotation(&at).transpose() * turn)).unwrap().norm()
    };
    assert!((speed(1e-3) / speed(1e-2) - 10.0).abs() < 0.01, "{} {}", speed(1e-3), speed(1e-2));
    // In natural coordinates nothing happens there: the chain starts from the lock at rest.
    let joints = |q: &[Coordinates]| {
        let axes = q.iter().map(|q| rotation(&angles(q)).column(0).into_owned());
        let mut at = vec![[0.0; 3]];
        for axis in axes {
            let last = at[at.len() - 1];
            at.push([0, 1, 2].map(|k| last[k] + axis[k]));
        }
        at
    };
    let mut natural =
        Simulation::new(&System::from(&chain), &joints(&at(0.0)), Settings::default()).unwrap();
    let still = natural.snapshot().accelerations_m_s2;
    assert!(still.iter().flatten().all(|a| a.abs() < 1e-11), "{still:?}");
}
