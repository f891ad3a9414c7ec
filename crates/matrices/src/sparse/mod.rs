//! Sparse symmetric matrices: an order of elimination, and the factorisation $L D L^T$.
//!
//! Neighbouring columns of $L$ that have the same rows below them, or all but the same, are one dense block (a
//! *supernode*). A block takes the updates of those before it, one product of dense matrices for each of them
//! (left-looking), and is eliminated in place, without pivoting: for matrices that are positive definite, or have
//! pivots in the order that the caller chooses.
//!
//! # References
//!
//! T. A. Davis, "Direct Methods for Sparse Linear Systems", SIAM (2006), chapters 4 and 7 (elimination
//! tree, counts of columns, orders); Y. Chen, T. A. Davis, W. W. Hager, S. Rajamanickam, ACM Trans.
//! Math. Softw. 35 (2008) 22, doi:10.1145/1391989.1391995 (blocks of columns, with zeros); P. R. Amestoy, T. A. Davis,
//! I. S. Duff, SIAM J. Matrix Anal. Appl. 17 (1996) 886-905, doi:10.1137/S0895479894278952 (approximate minimum
//! degree).

mod blocks;
mod entries;
mod ldlt;
mod solve;

pub use entries::Entries;
pub use ldlt::{Ldlt, Pivots};

/// An order in which rows and columns are eliminated so that little is filled in: approximate minimum degree.
///
/// Of the pattern the entries of either triangle, or of both, are given by columns. `None` where the pattern is none
/// or there is no memory.
#[must_use]
pub fn minimum_degree(starts: &[usize], rows: &[usize]) -> Option<Vec<usize>> {
    let size = starts.len() - 1;
    let (order, _, _) = amd::order(size, starts, rows, &amd::Control::default()).ok()?;
    Some(order)
}
