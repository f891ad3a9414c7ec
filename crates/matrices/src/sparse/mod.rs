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

use entries::{compressed, places};

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
pub fn minimum_degree(starts: &[usize], rows: &[usize]) -> Option<Vec<usize>> {
    let size = starts.len() - 1;
    let (starts, rows) = clean(starts, rows);
    let (order, _, _) = amd::order(size, &starts, &rows, &amd::Control::default()).ok()?;
    Some(order)
}

/// The pattern with its diagonal, each place once, in the order of the rows; of one that has places twice or out of order the
/// transpose. What the ordering does by itself with such patterns fails its assertions, where these are compiled.
fn clean(starts: &[usize], rows: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let size = starts.len() - 1;
    let column = |k: usize| &rows[starts[k]..starts[k + 1]];
    let is_clean = (0..size).all(|k| column(k).is_sorted_by(|a, b| a < b));
    let pairs = places(starts, rows)
        .map(|(row, column, _)| if is_clean { (row, column) } else { (column, row) })
        .chain((0..size).map(|k| (k, k)));
    let (given, all) = compressed(size, pairs);
    let (mut begins, mut once) = (vec![0], Vec::with_capacity(all.len()));
    for own in given.windows(2) {
        let mut column = all[own[0]..own[1]].to_vec();
        column.sort_unstable();
        column.dedup();
        once.extend(column);
        begins.push(once.len());
    }
    (begins, once)
}
