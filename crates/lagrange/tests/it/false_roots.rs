//! The paper's equations have roots that are no equilibria: where cos θ = cos φ = 0 they lose a
//! moment balance. Shown by building one, from the equations alone.

use lagrange::{Error, Seed, Settings, relative_residual, solve_from};
use model::cases;
use nalgebra::{DVector, Matrix3, Vector3};
use rand::RngExt;
use std::f64::consts::FRAC_PI_2;

use crate::common::{spatial_seed, stream};
use crate::survey::survey;

/// Directions of the three bars of the example for a pull on the first anchor (units of mg), when
/// the first bar, in the plane OYZ, does not feel the force across that plane.
fn directions(pull: &Vector3<f64>, signs: [f64; 3]) -> [Vector3<f64>; 3] {
    std::array::from_fn(|bar| {
        let carried = [0.5, 1.5, 2.5][bar];
        let mut force = pull + Vector3::new(0.0, 0.0, carried);
        if bar == 0 {
            force.x = 0.0;
        }
        force.normalize() * signs[bar]
    })
}

fn closure(pull: &Vector3<f64>, signs: [f64; 3]) -> Vector3<f64> {
    directions(pull, signs).iter().sum::<Vector3<f64>>() - Vector3::new(0.0, 0.0, -2.0)
}

/// Newton's method with differences on three equations, from random starts.
fn locked_pull() -> (Vector3<f64>, [f64; 3]) {
    let mut random = stream(61, 0);
    for _ in 0..10_000 {
        let signs = [0; 3].map(|_| if random.random_bool(0.5) { 1.0 } else { -1.0 });
        let mut pull = Vector3::from_fn(|_, _| random.random_range(-3.0..3.0));
        for _ in 0..50 {
            let step = 1e-7;
            let columns: Vec<Vector3<f64>> = (0..3)
                .map(|axis| {
                    let mut ahead = pull;
                    ahead[axis] += step;
                    (closure(&ahead, signs) - closure(&pull, signs)) / step
                })
                .collect();
            let Some(inverse) = Matrix3::from_columns(&columns).try_inverse() else { break };
            let change = inverse * closure(&pull, signs);
            pull -= change * (0.5 / change.norm()).min(1.0);
        }
        if closure(&pull, signs).norm() < 1e-13 && pull.x.abs() > 0.1 {
            return (pull, signs);
        }
    }
    panic!("no false root found");
}

#[test]
fn thirty_equations_hold_and_a_bar_is_not_in_balance() {
    let problem = cases::paper();
    let (pull, signs) = locked_pull();
    let u = directions(&pull, signs);
    // The first bar at the lock: theta = phi = pi/2, where u = (0, cos psi, sin psi).
    let locked = [u[0].z.atan2(u[0].y), FRAC_PI_2, FRAC_PI_2];
    let seed = Seed::directions(&u.map(Into::into));
    let angles = [locked, seed.angles()[1], seed.angles()[2]];
    let mg = 9.806_65;
    let mut q = DVector::zeros(18);
    let mut lambda = DVector::zeros(12);
    let mut joint = Vector3::zeros();
    lambda.fixed_rows_mut::<3>(0).copy_from(&(-pull * mg));
    for bar in 0..3 {
        q.fixed_rows_mut::<3>(6 * bar).copy_from(&(joint + u[bar] * 0.5));
        q.rows_mut(6 * bar + 3, 3).copy_from_slice(&angles[bar]);
        joint += u[bar];
        let force = pull + Vector3::new(0.0, 0.0, bar as f64 + 1.0);
        lambda.fixed_rows_mut::<3>(3 * (bar + 1)).copy_from(&(force * mg));
    }
    assert!(relative_residual(problem.chain(), &q, &lambda) < 1e-12, "all thirty equations hold");
    let moment = u[0].cross(&(pull + Vector3::new(0.0, 0.0, 0.5)));
    assert!(moment.norm() > 0.1, "and a moment of {moment} mgl acts on the first bar");

    // Started there, the solver says so when it must keep the paper's angles, and leaves otherwise.
    let seed = Seed::spatial(angles.to_vec());
    let kept = Settings { lock_margin: 0.0, ..Default::default() };
    let refused = solve_from(&problem, &seed, &kept);
    assert!(matches!(refused, Err(Error::FalseRoot { bar: 1, .. })), "{refused:?}");
    let found = solve_from(&problem, &seed, &Settings::default()).unwrap();
    assert_eq!(found.nullity, 4);
    assert!(found.effort.reparametrisations > 0);
}

/// They are no curiosity: about one random seed in twenty ends at one.
#[test]
fn random_seeds_meet_false_roots() {
    let kept = Settings { lock_margin: 0.0, relaxations: 0, ..Default::default() };
    let seeds = (0..2000).map(|index| spatial_seed(&mut stream(62, index), 3));
    let found = survey(&cases::paper(), seeds, &kept).false_roots;
    assert!((60..140).contains(&found), "{found} of 2000");
}
