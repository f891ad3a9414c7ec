//! The Morse index of an equilibrium of a net, proved.
//!
//! The second derivative of the Lagrangian, bordered by that of the lengths,
//!
//! $$ K = \begin{pmatrix} \Omega & R^T \\\\ R & 0 \end{pmatrix}, $$
//!
//! has as many negative eigenvalues as there are lengths and directions in which the energy falls
//! together, where K is regular; a coordinate that holds a free turn is as a length, and an elastic member borders
//! by minus its compliance. With Q next to its eigenvectors $Q^T K Q$ is all but diagonal:
//! Gershgorin's circles tell the signs of its eigenvalues, which are those of K by Sylvester's law
//! (Q is regular because $Q^T K Q$ is).
//!
//! R. A. Horn, C. R. Johnson, "Matrix Analysis", 2nd ed. (2013), theorems 4.5.8 and 6.1.1; N. I. M.
//! Gould, "On practical conditions for the existence and uniqueness of solutions to the general
//! equality quadratic programming problem", Math. Programming 32 (1985) 90-99,
//! doi:10.1007/BF01585660

use matrices::dense::eigen;
use numerics::Interval;

use super::dense::{add, times_matrix, zeros};
use crate::boxes::equations::Equations;

/// Directions in which the energy falls; nothing if that is not proved.
pub(in crate::net) fn index(equations: &Equations, tight: &[Interval]) -> Option<usize> {
    let size = equations.size;
    let lengths: Vec<usize> = equations.acting.iter().map(|acting| acting.force).collect();
    let mut matrix = zeros(size, size);
    for (row, column, value) in equations.slope(tight) {
        // Balance is minus the gradient of the Lagrangian.
        add(&mut matrix, (row, column), if lengths.contains(&row) { value } else { -value });
    }
    let middle = matrix.map(Interval::mid);
    let (_, vectors) = eigen(&(0.5 * (&middle + middle.transpose())))?;
    let transposed = vectors.transpose();
    // Q^T K, and then Q^T (Q^T K)^T, which is Q^T K Q as K is symmetric.
    let half = times_matrix(&transposed, &matrix);
    let diagonal = times_matrix(&transposed, &half.transpose());
    let mut negative = 0_usize;
    for row in 0..size {
        let others = (0..size).filter(|column| *column != row);
        let radius: Interval =
            others.map(|column| Interval::point(diagonal[(row, column)].mag())).sum();
        let circle = diagonal[(row, row)] + Interval::new(-radius.hi(), radius.hi());
        match circle.sign()? {
            1 => {}
            -1 => negative += 1,
            _ => return None,
        }
    }
    negative.checked_sub(lengths.len() + equations.holds.len())
}
