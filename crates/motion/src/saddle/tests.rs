//! Both eliminations against each other and against the product with the matrix.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;

fn random(rng: &mut ChaCha8Rng) -> Vector {
    std::array::from_fn(|_| rng.random_range(-1.0..1.0))
}

fn edge(a: usize, b: usize, between: f64, row: Option<usize>) -> Edge {
    Edge { a, b, between, row: row.map(|row| [row; 2]) }
}

fn own(slot: usize, row: usize, sign: f64) -> OwnRow {
    OwnRow { slot, row: [row; 2], sign }
}

/// A tree with bars to anchors, a support and a spring.
fn tree() -> Layout {
    Layout {
        mass: vec![1.0, 2.0, 1.5, 1.1, 3.0],
        edges: vec![
            edge(0, 2, 0.2, Some(0)),
            edge(3, 1, -0.3, Some(1)),
            edge(2, 4, 0.4, None),
            edge(4, 3, 0.5, Some(2)),
        ],
        own: vec![own(0, 3, 1.0), own(1, 4, -1.0), own(3, 5, 1.0), own(2, 6, 1.0)],
    }
}

/// `M x + Rᵀ ρ` and `R x`.
fn apply(
    layout: &Layout,
    vectors: &[Vector],
    x: &[Vector],
    rho: &[f64],
) -> (Vec<Vector>, Vec<f64>) {
    use numerics::vector::{add_times, dot};
    let mut f: Vec<Vector> = x.iter().zip(&layout.mass).map(|(x, m)| x.map(|x| m * x)).collect();
    let mut phi = vec![0.0; rho.len()];
    let mut row = |f: &mut Vec<Vector>, slot: usize, [row, k]: [usize; 2], sign: f64| {
        f[slot] = add_times(f[slot], sign * rho[row], vectors[k]);
        phi[row] += sign * dot(vectors[k], x[slot]);
    };
    for edge in &layout.edges {
        f[edge.a] = add_times(f[edge.a], edge.between, x[edge.b]);
        f[edge.b] = add_times(f[edge.b], edge.between, x[edge.a]);
        if let Some(k) = edge.row {
            row(&mut f, edge.a, k, -1.0);
            row(&mut f, edge.b, k, 1.0);
        }
    }
    for own in &layout.own {
        row(&mut f, own.slot, own.row, own.sign);
    }
    (f, phi)
}

fn solves(saddle: &mut Saddle, layout: &Layout, rng: &mut ChaCha8Rng) {
    let vectors: Vec<Vector> = (0..9).map(|_| random(rng)).collect();
    saddle.factor(&vectors).unwrap();
    let x: Vec<Vector> = layout.mass.iter().map(|_| random(rng)).collect();
    let rho: Vec<f64> = (0..layout.rows()).map(|_| rng.random_range(-1.0..1.0)).collect();
    let (mut f, mut phi) = apply(layout, &vectors, &x, &rho);
    saddle.solve(&mut f, &mut phi);
    for (found, wanted) in f.iter().zip(&x) {
        for k in 0..3 {
            assert!((found[k] - wanted[k]).abs() < 1e-10, "{f:?} {x:?}");
        }
    }
    for (found, wanted) in phi.iter().zip(&rho) {
        assert!((found - wanted).abs() < 1e-10, "{phi:?} {rho:?}");
    }
}

#[test]
fn trees_are_solved_by_both_eliminations() {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mut layout = tree();
    // Another one, whose root has two bars, either way round.
    layout.mass.extend([2.2, 0.8, 1.7]);
    layout.edges.extend([edge(5, 7, 0.3, Some(7)), edge(7, 6, -0.25, Some(8))]);
    for _ in 0..50 {
        solves(&mut Saddle::Forest(Forest::new(&layout)), &layout, &mut rng);
        solves(&mut Saddle::Sparse(Sparse::new(&layout).unwrap()), &layout, &mut rng);
    }
}

#[test]
fn loops_are_solved() {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut layout = tree();
    layout.edges.push(edge(0, 4, 0.1, Some(7)));
    layout.edges.push(edge(0, 3, 0.1, None));
    let mut sparse = Saddle::Sparse(Sparse::new(&layout).unwrap());
    for _ in 0..50 {
        solves(&mut sparse, &layout, &mut rng);
    }
}

/// A rope from an anchor over two joints that move, with an anchor between them.
#[test]
fn rows_with_several_vectors_are_solved() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut layout = tree();
    for (slot, vector, sign) in [(0, 7, 1.0), (0, 8, -1.0), (3, 3, 1.0)] {
        layout.own.push(OwnRow { slot, row: [7, vector], sign });
    }
    layout.edges.push(Edge { a: 3, b: 1, between: 0.0, row: Some([7, 2]) });
    let mut sparse = Saddle::Sparse(Sparse::new(&layout).unwrap());
    for _ in 0..50 {
        solves(&mut sparse, &layout, &mut rng);
    }
}

#[test]
fn a_row_that_stands_twice_is_told() {
    let mut layout = tree();
    layout.own.push(own(1, 7, 1.0));
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let mut vectors: Vec<Vector> = (0..8).map(|_| random(&mut rng)).collect();
    vectors[7] = vectors[4];
    assert_eq!(Forest::new(&layout).factor(&vectors).unwrap_err().slot, 1);
    assert_eq!(Sparse::new(&layout).unwrap().factor(&vectors).unwrap_err().slot, 1);
}

/// A bar between joints in one place, a support without a normal.
#[test]
fn a_row_without_a_direction_is_told() {
    let layout = tree();
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    for row in 0..layout.rows() {
        let mut vectors: Vec<Vector> = (0..layout.rows()).map(|_| random(&mut rng)).collect();
        vectors[row] = [0.0; 3];
        assert!(Forest::new(&layout).factor(&vectors).is_err(), "{row}");
        assert!(Sparse::new(&layout).unwrap().factor(&vectors).is_err(), "{row}");
    }
}

/// A chain between anchors whose bars lie on one line but for small angles.
#[test]
fn rows_that_nearly_depend_on_each_other_keep_their_digits() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let n = 12;
    let layout = Layout {
        mass: vec![1.0; n],
        edges: (0..n - 1).map(|a| edge(a, a + 1, 0.2, Some(a))).collect(),
        own: vec![own(0, n - 1, 1.0), own(n - 1, n, -1.0)],
    };
    for bend in [1e-5, 1e-6, 1e-7] {
        let vectors: Vec<Vector> = (0..=n)
            .map(|_| [1.0, bend * rng.random_range(-1.0..1.0), bend * rng.random_range(-1.0..1.0)])
            .collect();
        let mut forest = Forest::new(&layout);
        forest.factor(&vectors).unwrap();
        let x: Vec<Vector> = layout.mass.iter().map(|_| random(&mut rng)).collect();
        let rho: Vec<f64> = vectors.iter().map(|_| rng.random_range(-1.0..1.0)).collect();
        let (f, phi) = apply(&layout, &vectors, &x, &rho);
        let (mut found, mut forces) = (f.clone(), phi.clone());
        forest.solve(&mut found, &mut forces);
        let (f_found, phi_found) = apply(&layout, &vectors, &found, &forces);
        // The rows are met to rounding; forces lose the digits of the square of the bend, which are
        // those of the multipliers.
        for (found, wanted) in phi_found.iter().zip(&phi) {
            assert!((found - wanted).abs() < 1e-14, "{bend:e} {found} {wanted}");
        }
        let allowed = 1e-16 / (bend * bend);
        for (found, wanted) in f_found.iter().zip(&f) {
            for k in 0..3 {
                assert!((found[k] - wanted[k]).abs() < allowed, "{bend:e}");
            }
        }
    }
}
