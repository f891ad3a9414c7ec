//! Every analytic derivative is held against dual numbers and central differences over random
//! states.

use lagrange::{
    constraint_functions, constraint_matrix, direction, direction_gradient, direction_hessian,
    jacobian, load_vector, residual, rotation, spin,
};
use model::Chain;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use num_dual::Dual64;
use rand::RngExt;

use crate::common::{any_chain, stream, vector};

/// Dual numbers differ from the formulas by rounding alone: a few hundred operations on numbers of
/// order ten. Worst measured: 3e-14.
const ROUNDING: f64 = 2e-13;
/// Step of the central differences: their error is about its square plus rounding divided by it.
const STEP: f64 = 1e-5;
/// Worst measured: 3e-9 on entries of order ten.
const DIFFERENCES: f64 = 2e-8;
const STATES: usize = 20;

/// Derivative of `f` at `x` by dual numbers, column by column.
fn dual(f: impl Fn(&DVector<Dual64>) -> DVector<Dual64>, x: &DVector<f64>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..x.len())
        .map(|column| {
            let mut at = x.map(Dual64::from_re);
            at[column].eps = 1.0;
            f(&at).map(|value| value.eps)
        })
        .collect();
    DMatrix::from_columns(&columns)
}

/// Derivative of `f` at `x` by central differences.
fn differences(f: impl Fn(&DVector<f64>) -> DVector<f64>, x: &DVector<f64>) -> DMatrix<f64> {
    let columns: Vec<DVector<f64>> = (0..x.len())
        .map(|column| {
            let at = |step: f64| {
                let mut x = x.clone();
                x[column] += step;
                f(&x)
            };
            (at(STEP) - at(-STEP)) / (2.0 * STEP)
        })
        .collect();
    DMatrix::from_columns(&columns)
}

fn assert_near(a: &DMatrix<f64>, b: &DMatrix<f64>, tolerance: f64) {
    assert_eq!(a.shape(), b.shape());
    let worst = a.iter().zip(b.iter()).map(|(a, b)| (a - b).abs());
    let worst = worst.fold(0.0, |worst, next| if next <= worst { worst } else { next });
    assert!(worst <= tolerance, "largest difference {worst:e}");
}

/// Random chains of 1 to 5 bars with random coordinates and multipliers.
fn states() -> impl Iterator<Item = (Chain, DVector<f64>, DVector<f64>)> {
    (1..=5).flat_map(|bars| (0..STATES).map(move |index| (bars, index))).map(|(bars, index)| {
        let mut random = stream(21, 100 * bars + index);
        let chain = any_chain(&mut random, bars);
        (chain, vector(&mut random, 6 * bars), vector(&mut random, 3 * (bars + 1)))
    })
}

#[test]
fn constraint_matrix_is_the_derivative_of_the_constraint_functions() {
    for (chain, q, _) in states() {
        let analytic = constraint_matrix(&chain, &q);
        assert_near(&analytic, &dual(|q| constraint_functions(&chain, q), &q), ROUNDING);
        let numeric = differences(|q| constraint_functions(&chain, q), &q);
        assert_near(&analytic, &numeric, DIFFERENCES);
    }
}

#[test]
fn jacobian_is_the_derivative_of_the_residual() {
    for (chain, q, lambda) in states() {
        let size = q.len();
        let analytic = jacobian(&chain, &q, &lambda);
        let x =
            DVector::from_iterator(q.len() + lambda.len(), q.iter().chain(lambda.iter()).copied());
        let split = |x: &DVector<Dual64>| {
            let rest = x.len() - size;
            residual(&chain, &x.rows(0, size).into_owned(), &x.rows(size, rest).into_owned())
        };
        assert_near(&analytic, &dual(split, &x), ROUNDING);
        let split = |x: &DVector<f64>| {
            let rest = x.len() - size;
            residual(&chain, &x.rows(0, size).into_owned(), &x.rows(size, rest).into_owned())
        };
        assert_near(&analytic, &differences(split, &x), DIFFERENCES);
    }
}

/// Equation (40) to the letter: the residual is −Bᵀλ − T above and f below.
#[test]
fn residual_is_equation_40_and_the_constraint_functions() {
    for (chain, q, lambda) in states() {
        let above = -constraint_matrix(&chain, &q).transpose() * &lambda - load_vector(&chain);
        let below = constraint_functions(&chain, &q);
        let residual = residual(&chain, &q, &lambda);
        let expected = above.iter().chain(below.iter());
        assert_eq!(residual.len(), above.len() + below.len());
        for (got, expected) in residual.iter().zip(expected) {
            assert!((got - expected).abs() < ROUNDING);
        }
    }
}

#[test]
fn direction_has_the_derivatives_it_claims() {
    let mut random = stream(22, 0);
    for _ in 0..STATES {
        let a = vector(&mut random, 3);
        let force = Vector3::from_fn(|_, _| random.random_range(-3.0..3.0));
        let gradient = direction_gradient(a[0], a[1], a[2]);
        let by_dual =
            dual(|a| DVector::from_column_slice(direction(a[0], a[1], a[2]).as_slice()), &a);
        let dynamic = |m: &Matrix3<f64>| DMatrix::from_column_slice(3, 3, m.as_slice());
        assert_near(&dynamic(&gradient), &by_dual, ROUNDING);

        let hessian = direction_hessian(a[0], a[1], a[2], &force);
        let by_dual = dual(
            |a| {
                let row = direction_gradient(a[0], a[1], a[2]).tr_mul(&force.map(Dual64::from_re));
                DVector::from_column_slice(row.as_slice())
            },
            &a,
        );
        assert_near(&dynamic(&hessian), &by_dual, ROUNDING);

        // The spin is the kernel, and its length the product of the singular values.
        let v = spin(a[1], a[2]);
        assert!((gradient * v).norm() < ROUNDING);
        let values = gradient.singular_values();
        assert!((values[0] * values[1] - v.norm()).abs() < ROUNDING);
    }
}

#[test]
fn rotation_is_the_product_of_equations_2_3_4() {
    let mut random = stream(23, 0);
    for _ in 0..STATES {
        let a = vector(&mut random, 3);
        let ((s1, c1), (s2, c2), (s3, c3)) = (a[0].sin_cos(), a[1].sin_cos(), a[2].sin_cos());
        let psi = Matrix3::new(1.0, 0.0, 0.0, 0.0, c1, -s1, 0.0, s1, c1);
        let theta = Matrix3::new(c2, 0.0, s2, 0.0, 1.0, 0.0, -s2, 0.0, c2);
        let phi = Matrix3::new(c3, -s3, 0.0, s3, c3, 0.0, 0.0, 0.0, 1.0);
        let product = psi * theta * phi;
        assert!((rotation(a[0], a[1], a[2]) - product).norm() < ROUNDING);
        assert!((direction(a[0], a[1], a[2]) - product.column(0)).norm() < ROUNDING);
    }
}

/// The entries (xi)-(xxii) of the paper's example, as printed, at psi = 0, theta = pi/2; all others
/// are zero.
#[test]
fn constraint_matrix_has_the_entries_of_the_example() {
    let chain = model::cases::paper();
    let phi = [0.4, 0.7, -1.3_f64];
    let mut q = DVector::zeros(18);
    for (bar, phi) in phi.iter().enumerate() {
        q[6 * bar + 4] = std::f64::consts::FRAC_PI_2;
        q[6 * bar + 5] = *phi;
    }
    let b = constraint_matrix(chain.chain(), &q);
    let half = 0.5;
    let (c, s) = (phi.map(|p| half * p.cos()), phi.map(|p| half * p.sin()));
    let mut printed = DMatrix::<f64>::zeros(12, 18);
    for bar in 0..3 {
        let (c, s) = (c[bar], s[bar]);
        let first = if bar == 0 { 1.0 } else { -1.0 };
        for (joint, one, half) in [(bar, first, -first), (bar + 1, 1.0, 1.0)] {
            for (row, column, value) in [
                (0, 0, one),
                (0, 4, -half * c),
                (1, 1, one),
                (1, 3, half * c),
                (1, 5, half * c),
                (2, 2, one),
                (2, 3, half * s),
                (2, 5, half * s),
            ] {
                printed[(3 * joint + row, 6 * bar + column)] = value;
            }
        }
    }
    assert_near(&b, &printed, ROUNDING);
}
