//! Linear algebra: the factorisation $L D L^T$ of [`sparse`] symmetric matrices, and rank, kernels, least
//! squares and eigenvalues of small [`dense`] ones.
//!
//! Arithmetic alone: nothing here knows what a bar is, and both solvers may use it.
//!
//! ```
//! use matrices::sparse::{Entries, Ldlt, Pivots};
//! // Three springs in a row between two walls, by their lower triangle.
//! let stiffness = Entries::new(2, &[(0, 0, 3.0), (1, 0, -2.0), (1, 1, 3.0)]);
//! let mut factor = Ldlt::new(&stiffness.starts, &stiffness.rows, &[0, 1]).ok_or("memory")?;
//! assert!(factor.factorise(&stiffness.values, Pivots::Positive));
//! assert_eq!(factor.pivots(), [3.0, 3.0 - 4.0 / 3.0]);
//! let mut moves = [1.0, 1.0];
//! factor.solve(&mut moves);
//! assert!(moves.iter().all(|x| (x - 1.0).abs() < 1e-15));
//! # Ok::<(), &str>(())
//! ```

pub mod dense;
pub mod sparse;
