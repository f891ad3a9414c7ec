//! Morse indices, proved.
//!
//! With the pull as multiplier, the second derivative of the energy by the direction of bar i is
//! `h_i = s_i l_i |F_i|`, the same in the plane and out of it: positive in tension, negative in
//! compression. Motions in the plane keep two closure equations, those out of it one. By the
//! inertia of the bordered matrix, with the Schur complements
//!
//! $$ S = \sum_i \frac{s_i l_i}{|F_i|} (I - f_i f_i^T), \qquad
//!    \sigma = \sum_i \frac{s_i l_i}{|F_i|}, $$
//!
//! index in the plane = compressed bars + positive eigenvalues of S − 2,
//! index out of it = compressed bars + (1 if σ > 0) − 1.
//!
//! S is the derivative of the closure by the pull. The horizontal closure reads `H σ = D_x`, so the
//! sign of σ is that of H, and for anchors on one vertical σ = 0 exactly: the turn of the whole
//! chain about that vertical, which costs nothing, and the only such motion.
//!
//! Y. Chabrillac, J.-P. Crouzeix, "Definiteness and semidefiniteness of quadratic forms revisited",
//! Linear Algebra Appl. 63 (1984) 283-292, doi:10.1016/0024-3795(84)90150-2

use numerics::Interval;

use crate::run::closure::bar::{size, unit};
use crate::run::closure::signed;

/// The number of positive eigenvalues of a symmetric matrix, all matrices of the enclosure having
/// the same and none of them being singular; `None` if that cannot be proved.
fn positive_eigenvalues([a, b, d]: [Interval; 3]) -> Option<usize> {
    let determinant = a * d - b.square();
    match determinant.sign()? {
        -1 => Some(1),
        1 => Some(if (a + d).sign()? > 0 { 2 } else { 0 }),
        _ => None,
    }
}

/// Indices of an equilibrium, of the signs and the forces `F_i` (any common positive unit) of its
/// bars.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Indices {
    pub(crate) in_plane: usize,
    pub(crate) out_of_plane: usize,
    /// Ratio of the singular values of S, as a plain number.
    pub(crate) condition: f64,
}

/// The indices, if they can be proved.
pub(crate) fn indices(
    signs: &[i8],
    lengths: &[Interval],
    forces: &[[Interval; 2]],
    vertical: bool,
) -> Option<Indices> {
    let compressed = signs.iter().filter(|sign| **sign < 0).count();
    let mut schur = [Interval::ZERO; 3];
    for ((sign, length), force) in signs.iter().zip(lengths).zip(forces) {
        let [x, z] = unit(*force);
        let weight = signed(*sign, *length / size(*force));
        let terms = [z.square(), -(x * z), x.square()];
        for (sum, term) in schur.iter_mut().zip(terms) {
            *sum = *sum + weight * term;
        }
    }
    // All forces have the same horizontal part, H.
    let horizontal = forces.first()?[0].sign()?;
    let positive = positive_eigenvalues(schur)?;
    let steeper = usize::from(!vertical && horizontal > 0);
    let [a, b, d] = schur.map(Interval::mid);
    Some(Indices {
        in_plane: (compressed + positive).checked_sub(2)?,
        out_of_plane: (compressed + steeper).checked_sub(1)?,
        condition: condition([[a, b], [b, d]]),
    })
}

/// Ratio of the singular values of a matrix.
pub(crate) fn condition([[a, b], [c, d]]: [[f64; 2]; 2]) -> f64 {
    let larger = 0.5 * ((a + d).hypot(b - c) + (a - d).hypot(b + c));
    larger * larger / (a * d - b * c).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvalues_are_counted_only_when_certain() {
        let matrix = |a: f64, b: f64, d: f64| [a, b, d].map(Interval::point);
        assert_eq!(positive_eigenvalues(matrix(2.0, 1.0, 2.0)), Some(2));
        assert_eq!(positive_eigenvalues(matrix(-2.0, 1.0, -2.0)), Some(0));
        assert_eq!(positive_eigenvalues(matrix(1.0, 2.0, 1.0)), Some(1));
        assert_eq!(positive_eigenvalues(matrix(1.0, 1.0, 1.0)), None);
        let unsure = [Interval::new(-1.0, 1.0), Interval::ZERO, Interval::ONE];
        assert_eq!(positive_eigenvalues(unsure), None);
    }

    /// Two bars in a V between level anchors: the only positions, so the index in the plane is 0;
    /// the lower one is stable in space, the upper one turns over.
    #[test]
    fn a_triangle_cannot_move_in_its_plane() {
        let lengths = [Interval::ONE; 2];
        let forces = |h: f64, v: f64| [[h, -v], [h, v]].map(|force| force.map(Interval::point));
        let hanging = indices(&[1, 1], &lengths, &forces(1.0, 1.0), false);
        let pair = |indices: Option<Indices>| indices.map(|i| (i.in_plane, i.out_of_plane));
        assert_eq!(pair(hanging), Some((0, 0)));
        let standing = indices(&[-1, -1], &lengths, &forces(-1.0, 1.0), false);
        assert_eq!(pair(standing), Some((0, 1)));
        // S = √2/2 [[1, 0], [0, 1]] for both.
        assert!(hanging.is_some_and(|i| (i.condition - 1.0).abs() < 1e-15));
    }
}
