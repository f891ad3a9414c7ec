//! Bounds of least eigenvalues against closed forms, dense eigenvalues and factors by hand.

use std::f64::consts::PI;

use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::*;

/// Joints of a grid with `-1` between neighbours and `diagonal` at each.
fn grid(wide: usize, high: usize, diagonal: f64) -> Symmetric {
    let mut below = Vec::new();
    for k in 0..wide * high {
        if k % wide > 0 {
            below.push((k, k - 1, -1.0));
        }
        if k >= wide {
            below.push((k, k - wide, -1.0));
        }
    }
    let size = wide * high;
    Symmetric { size, below, diagonal: vec![diagonal; size], uncertainty: 0.0 }
}

/// What the entries beside the diagonal take off it: `2 cos` of the first mode each way.
fn taken(wide: usize, high: usize) -> f64 {
    [wide, high].iter().map(|n| 2.0 * (PI / (n + 1) as f64).cos()).sum()
}

/// A chain and a net, on both sides of zero: the closed form of the
/// least eigenvalue is right to the rounding of the diagonal.
#[test]
fn nearly_singular_matrices_are_told_from_nearly_definite_ones() {
    for (wide, high) in [(100_000, 1), (150, 150)] {
        // A row of joints has no neighbours across.
        let taken =
            if high == 1 { 2.0 * (PI / (wide + 1) as f64).cos() } else { taken(wide, high) };
        for over in [1e-3, 1e-6, 1e-9, 3e-11] {
            let matrix = grid(wide, high, taken + over);
            let bound = matrix.least_eigenvalue(over / 4.0).unwrap();
            assert!(bound > 0.0 && bound <= over + 1e-14, "{wide} x {high}, {over}: {bound}");
            let beyond = grid(wide, high, taken - over);
            assert_eq!(beyond.least_eigenvalue(0.0), None, "{wide} x {high}, {over}");
            assert_eq!(beyond.least_eigenvalue(over), None, "{wide} x {high}, {over}");
        }
    }
}

/// The bound by the trace, 1e-16 times the size times the sum of the diagonal, is 2e-6 here.
#[test]
fn rounding_is_known_by_the_rows_of_the_factor() {
    let matrix = grid(100_000, 1, 2.0 + 1e-9);
    let mut factor = Factor::new(&matrix).unwrap();
    let shift = 1e-9;
    let bound = factor.bound(&matrix, shift).unwrap();
    assert!(shift - bound < 1e-13, "{:e}", shift - bound);
}

#[test]
fn what_is_wanted_is_given_where_there_is_as_much() {
    let (wide, high) = (40, 40);
    let matrix = grid(wide, high, taken(wide, high) + 1e-3);
    assert!(matrix.least_eigenvalue(4e-4).unwrap() >= 4e-4);
    for more in [9e-4, 1.0, f64::INFINITY] {
        let bound = matrix.least_eigenvalue(more).unwrap();
        assert!(bound > 4e-4 && bound < 1e-3, "{bound}");
    }
    assert!(matrix.least_eigenvalue(f64::NAN).unwrap() > 0.0);
}

/// Everything times a power of four: its factor by a power of two, and no digit changes.
#[test]
fn bounds_are_in_units_of_the_matrix() {
    for (size, below) in [(1, vec![]), (3, vec![(1, 0, 0.3), (2, 0, -0.2), (2, 1, 0.7)])] {
        // What is wanted is little, what there is, and too much.
        for wanted in [0.0, 0.1, 10.0] {
            let bound = |scale: f64| {
                let below = below.iter().map(|&(i, j, value)| (i, j, scale * value)).collect();
                let diagonal = [1.0, 1.5, 2.25][..size].iter().map(|d| scale * d).collect();
                let matrix = Symmetric { size, below, diagonal, uncertainty: 1e-9 * scale };
                matrix.least_eigenvalue(scale * wanted).unwrap() / scale
            };
            for exponent in [-40, 40] {
                assert_eq!(
                    bound(4_f64.powi(exponent)).to_bits(),
                    bound(1.0).to_bits(),
                    "{size}, {wanted}"
                );
            }
        }
    }
}

/// Dense eigenvalues are right to some 1e-13 of the largest entry.
#[test]
fn the_bound_is_below_the_eigenvalues_of_random_matrices() {
    let mut random = ChaCha8Rng::seed_from_u64(2006);
    let (mut proved, mut refused) = (0, 0);
    for _ in 0..300 {
        let size = random.random_range(1..30);
        let mut dense = DMatrix::<f64>::zeros(size, size);
        let (mut below, mut diagonal) = (Vec::new(), Vec::new());
        for row in 0..size {
            for column in 0..row {
                if random.random_bool(0.3) {
                    let value = random.random_range(-1.0..1.0);
                    below.push((row, column, value));
                    (dense[(row, column)], dense[(column, row)]) = (value, value);
                }
            }
            diagonal.push(random.random_range(0.0..4.0));
            dense[(row, row)] = diagonal[row];
        }
        let least = dense.symmetric_eigenvalues().min();
        let matrix = Symmetric { size, below, diagonal, uncertainty: 0.0 };
        let bound = matrix.least_eigenvalue(least / 4.0);
        if least > 1e-9 {
            assert!(bound.is_some_and(|bound| bound >= least / 4.0 && bound <= least + 1e-13));
            proved += 1;
        } else if least < -1e-9 {
            assert_eq!(bound, None, "{least}");
            refused += 1;
        }
    }
    assert!(proved > 50 && refused > 50, "{proved}, {refused}");
}

/// All entries one and a thousandth more on the diagonal, of 64 joints: the first column of the
/// factor is of ones, so that the sums over its rows are some 64, four times the guess, and the
/// shift is taken again from them.
#[test]
fn rounding_that_is_more_than_guessed_is_outrun() {
    let size = 64;
    let pairs = (0..size).flat_map(|row| (0..row).map(move |column| (row, column, 1.0)));
    let diagonal = vec![1.001; size];
    let matrix = Symmetric { size, below: pairs.collect(), diagonal, uncertainty: 0.0 };
    let bound = matrix.least_eigenvalue(0.0).unwrap();
    assert!(bound > 0.0 && bound < 1e-10, "{bound}");
}

/// Where the true matrix may be nearer to singular by 1, so is the bound.
#[test]
fn what_is_uncertain_is_taken_off() {
    let matrix = Symmetric { size: 1, below: vec![], diagonal: vec![8.0], uncertainty: 1.0 };
    let bound = Factor::new(&matrix).unwrap().bound(&matrix, 7.5).unwrap();
    assert!(bound < 6.5 && bound > 6.5 - 1e-13, "{bound}");
}

/// The least mode of `[2 1; 1 2]` has two signs, and the eigenvalue 1. More than there is was
/// wanted: half of it is proved.
#[test]
fn the_least_mode_is_found_whatever_its_signs() {
    let below = vec![(1, 0, 1.0)];
    let matrix = Symmetric { size: 2, below, diagonal: vec![2.0; 2], uncertainty: 0.0 };
    let bound = matrix.least_eigenvalue(10.0).unwrap();
    assert!(bound > 0.499 && bound < 1.0, "{bound}");
}

/// Twice what is wanted is tried first, and what is proved by it is told.
#[test]
fn the_bound_is_that_of_the_shift_that_was_tried() {
    let matrix = Symmetric { size: 1, below: vec![], diagonal: vec![1.0], uncertainty: 0.0 };
    let bound = matrix.least_eigenvalue(0.375).unwrap();
    assert!(bound < 0.75 && bound > 0.75 - 1e-13, "{bound}");
}

/// By hand, in any order of elimination: `[4]` has the factor `[2]`, its one row the sum 4 and
/// 2 (1 + 8) + 2 roundings. `[4 2; 2 4]` has the rows (2, 0) and (1, √3): the sums over the
/// columns are 3 and √3, over the rows 6 both, with 2 (2 + 8) + 2 roundings in the longer.
#[test]
fn the_error_of_a_factor_is_the_rows_of_its_product() {
    let error = |size: usize, below: Vec<(usize, usize, f64)>| {
        let matrix = Symmetric { size, below, diagonal: vec![4.0; size], uncertainty: 0.0 };
        let mut factor = Factor::new(&matrix).unwrap();
        factor.bound(&matrix, 0.0).unwrap();
        factor.error().unwrap() / (1.001 * 0.5 * f64::EPSILON)
    };
    assert!((error(1, vec![]) / (4.0 * 20.0) - 1.0).abs() < 1e-12);
    assert!((error(2, vec![(1, 0, 2.0)]) / (6.0 * 22.0) - 1.0).abs() < 1e-12);
}

/// `2^50` operations are an eighth, and an eighth over seven eighths a seventh.
#[test]
fn many_roundings_are_more_than_their_sum() {
    assert!((gamma((1 << 50) - 2) * 7.0 - 1.0).abs() < 1e-15);
    assert!((gamma(8) / (5.0 * f64::EPSILON) - 1.0).abs() < 1e-14);
}

/// The squares in a row of the factor add up to the diagonal, which is the same in all rows. The
/// products of its rows with the sums over its columns are the sums over the rows of the matrix,
/// in whatever order.
#[test]
fn every_entry_of_a_factor_stands_in_its_row_and_column() {
    let sorted = |mut values: Vec<f64>| {
        values.sort_by(f64::total_cmp);
        values
    };
    for (wide, high) in [(30, 1), (5, 4), (150, 150)] {
        let matrix = grid(wide, high, 4.5);
        let mut wanted = matrix.diagonal.clone();
        for (row, column, value) in &matrix.below {
            wanted[*row] += value;
            wanted[*column] += value;
        }
        let mut factor = Factor::new(&matrix).unwrap();
        factor.bound(&matrix, 0.0).unwrap();
        let (mut squares, mut columns) = (vec![0.0; matrix.size], vec![0.0; matrix.size]);
        factor.entries(|row, column, entry| {
            squares[row] += entry * entry;
            columns[column] += entry;
        });
        let mut rows = vec![0.0; matrix.size];
        factor.entries(|row, column, entry| rows[row] += entry * columns[column]);
        assert!(squares.iter().all(|sum| (sum - 4.5).abs() < 1e-13), "{wide} x {high}");
        let apart = sorted(rows).into_iter().zip(sorted(wanted)).map(|(a, b)| (a - b).abs());
        assert!(apart.fold(0.0, f64::max) < 1e-12, "{wide} x {high}");
    }
}

/// Where all are neighbours the last row is full, in any order.
#[test]
fn the_longest_row_is_that_of_the_factor() {
    let longest = |matrix: &Symmetric| Factor::new(matrix).unwrap().longest_row();
    assert_eq!(longest(&grid(1, 1, 3.0)), 1);
    assert_eq!(longest(&grid(2, 1, 3.0)), 2);
    let below = vec![(1, 0, 1.0), (2, 0, 1.0), (2, 1, 1.0)];
    let all = Symmetric { size: 3, below, diagonal: vec![4.0; 3], uncertainty: 0.0 };
    assert_eq!(longest(&all), 3);
}

#[test]
fn numbers_that_are_none_prove_nothing() {
    for bad in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e200] {
        let mut matrix = grid(3, 3, 8.0);
        matrix.diagonal[4] = bad;
        assert_eq!(matrix.least_eigenvalue(1.0), None, "{bad}");
    }
    let mut matrix = grid(3, 3, 8.0);
    matrix.below[2].2 = f64::NAN;
    assert_eq!(matrix.least_eigenvalue(1.0), None);
    matrix = grid(3, 3, 8.0);
    matrix.uncertainty = 9.0;
    assert_eq!(matrix.least_eigenvalue(1.0), None);
}
