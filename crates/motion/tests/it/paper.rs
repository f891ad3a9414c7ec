//! The paper's equation of motion (33), sections V and VI, solved with dual numbers and held against
//! the natural coordinates; `paper::equations` has its formulas and their corrections.

use model::system::System;
use model::{Anchors, Bar, Chain};
use motion::{Settings, Simulation};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_dual::{Dual, Dual2_64, Dual64, DualNum, HyperDual64};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::common::G;

/// Place of the centre of a bar and its angles, `(X_C, Y_C, Z_C, ψ, θ, φ)`, or their derivatives by
/// time.
type Coordinates = [f64; 6];

type Rotation<D> = [[D; 3]; 3];

/// `[A] = [ψ] [θ] [φ]` (1)-(5): its columns are the axes of the bar.
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

fn angles(q: &Coordinates) -> [f64; 3] {
    [q[3], q[4], q[5]]
}

/// The axis along a bar.
fn axis(q: &Coordinates) -> Vector3<f64> {
    let a = turned(angles(q));
    Vector3::new(a[0][0], a[1][0], a[2][0])
}

/// Angular velocity in the axes of the bar, from the rotation alone: `[ω] = Aᵀ Ȧ`.
fn omega<D: DualNum<f64> + Copy>(at: [D; 3], by: [D; 3]) -> [D; 3] {
    let dual = turned([0, 1, 2].map(|k| Dual::<D, f64>::new(at[k], by[k])));
    let entry = |i: usize, k: usize| {
        let [x, y, z] = [0, 1, 2].map(|row| dual[row][i].re * dual[row][k].eps);
        x + y + z
    };
    [entry(2, 1), entry(0, 2), entry(1, 0)]
}

/// `[Q]` (23): `ω` from the velocities of the angles.
fn rates(q: &Coordinates) -> Matrix3<f64> {
    let unit = |k: usize| Vector3::from(omega(angles(q), Vector3::ith(k, 1.0).into()));
    Matrix3::from_columns(&[unit(0), unit(1), unit(2)])
}

/// Kinetic energy of rotation, `½ Σ J_k ω_k²`.
fn energy<D: DualNum<f64> + Copy>(j: [f64; 3], at: [D; 3], by: [D; 3]) -> D {
    let [x, y, z] = omega(at, by);
    (x * x * j[0] + y * y * j[1] + z * z * j[2]) * 0.5
}

/// Derivative of the energy by two of its six arguments.
fn second(j: [f64; 3], at: [f64; 3], by: [f64; 3], first: usize, other: usize) -> f64 {
    let x = |k: usize| {
        let value = if k < 3 { at[k] } else { by[k - 3] };
        let unit = |wanted: usize| if k == wanted { 1.0 } else { 0.0 };
        HyperDual64::new(value, unit(first), unit(other), 0.0)
    };
    energy(j, [x(0), x(1), x(2)], [x(3), x(4), x(5)]).eps1eps2
}

/// `[Q]ᵀ[J][Q]` (31), from the kinetic energy.
fn angular_inertia(j: [f64; 3], at: [f64; 3]) -> Matrix3<f64> {
    Matrix3::from_fn(|i, k| second(j, at, [0.0; 3], 3 + i, 3 + k))
}

/// `{F̃_β}` (39), by Lagrange's equations: `∂T/∂β − ∂²T/∂β̇∂β β̇`.
fn velocity_terms(j: [f64; 3], at: [f64; 3], by: [f64; 3]) -> Vector3<f64> {
    let gradient = Vector3::from_fn(|i, _| {
        let dual = |k: usize| Dual64::new(at[k], if k == i { 1.0 } else { 0.0 });
        energy(j, [dual(0), dual(1), dual(2)], by.map(Dual64::from)).eps
    });
    gradient - Matrix3::from_fn(|i, k| second(j, at, by, 3 + i, k)) * Vector3::from(by)
}

/// The two ends of a bar.
fn ends<D: DualNum<f64> + Copy>(bar: &Bar, q: &[D; 6]) -> [[D; 3]; 2] {
    let a = turned([q[3], q[4], q[5]]);
    [-bar.centre_m(), bar.length_m() - bar.centre_m()]
        .map(|along| [0, 1, 2].map(|k| q[k] + a[k][0] * along))
}

/// The constraints (7)-(20) of n bars: joint 0 at its anchor, both bars of a joint in one place,
/// joint n at its anchor.
fn constraints<D: DualNum<f64> + Copy>(chain: &Chain, q: &[[D; 6]]) -> Vec<D> {
    let ends: Vec<_> = chain.bars().iter().zip(q).map(|(bar, q)| ends(bar, q)).collect();
    let [start, end] = [chain.anchors().start_m, chain.anchors().end_m].map(|x| x.map(D::from));
    let far = ends.iter().map(|ends| ends[1]);
    let near = ends.iter().skip(1).map(|ends| ends[0]).chain([end]);
    let first = [0, 1, 2].map(|k| ends[0][0][k] - start[k]);
    let joined = far.zip(near).map(|(far, near)| [0, 1, 2].map(|k| far[k] - near[k]));
    [first].into_iter().chain(joined).flatten().collect()
}

/// `[B]` (22): derivatives of the constraints by the coordinates.
fn constraint_matrix(chain: &Chain, q: &[Coordinates]) -> DMatrix<f64> {
    let column = |column: usize| {
        let dual = |(i, q): (usize, &Coordinates)| {
            let unit = |k| if 6 * i + k == column { 1.0 } else { 0.0 };
            std::array::from_fn(|k| Dual64::new(q[k], unit(k)))
        };
        let dual: Vec<[Dual64; 6]> = q.iter().enumerate().map(dual).collect();
        DVector::from_iterator(3 * q.len() + 3, constraints(chain, &dual).iter().map(|f| f.eps))
    };
    DMatrix::from_columns(&(0..6 * q.len()).map(column).collect::<Vec<_>>())
}

/// The matrix of (33).
fn matrix(chain: &Chain, q: &[Coordinates]) -> DMatrix<f64> {
    let b = constraint_matrix(chain, q);
    let (rows, size) = b.shape();
    let mut matrix = DMatrix::zeros(size + rows, size + rows);
    for (i, (bar, q)) in chain.bars().iter().zip(q).enumerate() {
        for k in 0..3 {
            matrix[(6 * i + k, 6 * i + k)] = bar.mass_kg();
        }
        let angular = angular_inertia(bar.inertia_kg_m2(), angles(q));
        matrix.view_mut((6 * i + 3, 6 * i + 3), (3, 3)).copy_from(&angular);
    }
    matrix.view_mut((0, size), (size, rows)).copy_from(&(-b.transpose()));
    matrix.view_mut((size, 0), (rows, size)).copy_from(&b);
    matrix
}

/// `q + t v + t² a/2`.
fn moving(q: &Coordinates, v: &Coordinates, a: &[f64]) -> [Dual2_64; 6] {
    std::array::from_fn(|k| Dual2_64::new(q[k], v[k], a[k]))
}

/// `{q̈}`, six for each bar, then `{λ}`, three for each joint.
fn accelerations(chain: &Chain, q: &[Coordinates], v: &[Coordinates]) -> DVector<f64> {
    let matrix = matrix(chain, q);
    let mut right = DVector::zeros(matrix.nrows());
    for (i, (bar, (q, v))) in chain.bars().iter().zip(q.iter().zip(v)).enumerate() {
        right[6 * i + 2] = -bar.mass_kg() * chain.gravity_m_s2();
        let terms = velocity_terms(bar.inertia_kg_m2(), angles(q), angles(v));
        right.rows_mut(6 * i + 3, 3).copy_from(&terms);
    }
    // `−[Ḃ]{q̇}`.
    let even: Vec<_> = q.iter().zip(v).map(|(q, v)| moving(q, v, &[0.0; 6])).collect();
    for (k, value) in constraints(chain, &even).iter().enumerate() {
        right[6 * q.len() + k] = -value.v2;
    }
    matrix.lu().solve(&right).unwrap()
}

fn random(rng: &mut ChaCha8Rng, size: f64) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.random_range(-size..size))
}

/// The coordinates of bars one after the other from a place, and their joints.
fn placed(
    bars: &[Bar],
    start: Vector3<f64>,
    angles: &[[f64; 3]],
) -> (Vec<Coordinates>, Vec<[f64; 3]>) {
    let (mut joints, mut q) = (vec![start.into()], Vec::new());
    let mut joint = start;
    for (bar, [psi, theta, phi]) in bars.iter().zip(angles) {
        let along = axis(&[0.0, 0.0, 0.0, *psi, *theta, *phi]);
        let centre = joint + along * bar.centre_m();
        q.push([centre.x, centre.y, centre.z, *psi, *theta, *phi]);
        joint += along * bar.length_m();
        joints.push(joint.into());
    }
    (q, joints)
}

/// Velocities of the coordinates of bars whose joints move with these velocities, without spin.
fn velocities(chain: &Chain, q: &[Coordinates], joints: &[[f64; 3]]) -> Vec<Coordinates> {
    let bars = chain.bars().iter().zip(q).enumerate();
    bars.map(|(i, (bar, q))| {
        let [a, b] = [joints[i], joints[i + 1]].map(Vector3::from);
        let omega = axis(q).cross(&((b - a) / bar.length_m()));
        let by = rates_of(q, &omega);
        let centre = a + (b - a) * (bar.centre_m() / bar.length_m());
        [centre.x, centre.y, centre.z, by.x, by.y, by.z]
    })
    .collect()
}

/// Velocities of the angles of a bar that turns with `ω`, in the axes of the world.
fn rates_of(q: &Coordinates, omega: &Vector3<f64>) -> Vector3<f64> {
    let a = turned(angles(q));
    let own = Matrix3::from_fn(|i, k| a[k][i]) * omega;
    rates(q).lu().solve(&own).unwrap()
}

#[test]
fn accelerations_and_forces_are_those_of_the_natural_coordinates() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mut worst = 0.0_f64;
    for n in [2, 3, 4, 6] {
        for _ in 0..10 {
            let bar = |rng: &mut ChaCha8Rng| {
                let l = rng.random_range(0.5..2.0);
                let (along, across) = (rng.random_range(0.01..0.1), rng.random_range(0.05..0.5));
                let (mass, r) = (rng.random_range(0.5..3.0), l * rng.random_range(0.2..0.8));
                Bar::new(l, mass, r, [along, across, across]).unwrap()
            };
            let bars: Vec<Bar> = (0..n).map(|_| bar(&mut rng)).collect();
            // Away from gimbal lock.
            let turns = [0; 6].map(|_| random(&mut rng, 3.0)).map(|a| [a.x, a.y / 3.0, a.z]);
            let (q, joints) = placed(&bars, random(&mut rng, 1.0), &turns);
            let anchors = Anchors { start_m: joints[0], end_m: joints[n] };
            let chain = Chain::new("random", G, anchors, bars).unwrap();
            let closed = constraints(&chain, &q);
            assert!(closed.iter().all(|f: &f64| f.abs() < 1e-14), "{closed:?}");
            let mut natural =
                Simulation::new(&System::from(&chain), &joints, Settings::default()).unwrap();
            let wild: Vec<[f64; 3]> = joints.iter().map(|_| random(&mut rng, 2.0).into()).collect();
            natural.set_velocities(&wild).unwrap();
            let now = natural.snapshot();
            let v = velocities(&chain, &q, &now.velocities_m_s);
            let found = accelerations(&chain, &q, &v);
            let unit = now.end_forces_n.iter().flatten().fold(1.0, |a: f64, x| a.max(x.abs()));
            let lambda = |joint: usize, k: usize| found[6 * n + 3 * joint + k];
            for (i, bar) in chain.bars().iter().enumerate() {
                let bar_moving = moving(&q[i], &v[i], found.rows(6 * i, 6).as_slice());
                let [_, end] = ends(bar, &bar_moving);
                for (k, end) in end.iter().enumerate() {
                    let told = now.accelerations_m_s2[i + 1][k];
                    let force = lambda(i + 1, k) - now.end_forces_n[i][k];
                    worst = worst.max((end.v2 - told).abs() / unit).max(force.abs() / unit);
                }
            }
            for k in 0..3 {
                // (7) has the first bar with the sign of a far end.
                let force = lambda(0, k) - now.start_forces_n[0][k];
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
    // θ = π/2 − ε: the bar points along A x = (cos θ cos φ, ...); at ε = 0 it lies in OYZ, with
    // ψ = 0 at x = (0, sin φ, −cos φ), φ the angle from the descending vertical.
    let at = |epsilon: f64| {
        let theta = std::f64::consts::FRAC_PI_2 - epsilon;
        let angles = degrees.map(|angle| [0.0, theta, angle.to_radians()]);
        placed(chain.bars(), Vector3::zeros(), &angles)
    };
    let smallest = |epsilon: f64| {
        let values = matrix(&chain, &at(epsilon).0).svd(false, false).singular_values;
        values.min() / values.max()
    };
    // On the lock the matrix of (33) has no inverse; off it the smallest singular value falls like
    // ε².
    let (on, near, nearer) = (smallest(0.0), smallest(1e-2), smallest(1e-3));
    println!("smallest singular value, relative: {on:e} at the lock, {near:e}, {nearer:e} off it");
    assert!(on < 1e-16 && near > 1e-7, "{on:e} {near:e}");
    assert!((near / nearer / 100.0 - 1.0).abs() < 0.05, "{near:e} {nearer:e}");
    // Columns 4 and 6 of B agree there: ψ and φ turn about the same axis.
    let b = constraint_matrix(&chain, &at(0.0).0);
    for bar in 0..3 {
        let difference = b.column(6 * bar + 3) - b.column(6 * bar + 5);
        assert!(difference.norm() < 1e-15, "{difference}");
    }
    // The same slow turn of a bar asks for faster and faster angles; its ends move as before.
    let speed = |epsilon: f64| rates_of(&at(epsilon).0[0], &Vector3::z()).norm();
    assert!((speed(1e-3) / speed(1e-2) - 10.0).abs() < 0.01, "{} {}", speed(1e-3), speed(1e-2));
    // In natural coordinates nothing happens there: the chain starts from the lock at rest.
    let mut natural =
        Simulation::new(&System::from(&chain), &at(0.0).1, Settings::default()).unwrap();
    let still = natural.snapshot().accelerations_m_s2;
    assert!(still.iter().flatten().all(|a| a.abs() < 1e-11), "{still:?}");
}
