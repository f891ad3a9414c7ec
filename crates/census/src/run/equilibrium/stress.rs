//! The stress matrix: a certificate that no configuration has less energy.
//!
//! With the force densities `τ_i = s_i |F_i| / l_i` of the bars (weights lumped to the joints) the
//! energy of any configuration, in any dimension, is at least the one of this equilibrium if the
//! weighted path Laplacian of the free joints
//!
//! $$ \Omega_{kk} = \tau_k + \tau_{k+1}, \qquad \Omega_{k,k+1} = -\tau_{k+1}, \qquad k = 1..n-1 $$
//!
//! is positive semidefinite: the Lagrangian is then convex. For anchors on one vertical the
//! horizontal positions of the joints are in its kernel, since the same positions times any factor
//! balance the same way; it is exactly singular, and positive semidefinite if its leading minor of
//! order n − 2 is positive definite, by interlacing.
//!
//! R. Connelly, "Rigidity and energy", Invent. Math. 66 (1982) 11-33, doi:10.1007/BF01404753

use numerics::Interval;

use crate::run::closure::signed;

/// Whether the stress matrix is proved to be positive semidefinite, by the pivots of its
/// factorisation L D L^T in interval arithmetic.
pub(crate) fn proves_optimal(
    signs: &[i8],
    lengths: &[Interval],
    sizes: &[Interval],
    vertical: bool,
) -> bool {
    let density: Vec<Interval> = signs
        .iter()
        .zip(lengths)
        .zip(sizes)
        .map(|((sign, length), size)| signed(*sign, *size / *length))
        .collect();
    let joints = density.len() - 1;
    let needed = if vertical { joints - 1 } else { joints };
    let mut pivot = Interval::LINE;
    for k in 0..needed {
        // d_k = τ_k + τ_{k+1} − τ_k² / d_{k−1}; the start anchor is held.
        let diagonal = density[k] + density[k + 1];
        pivot = if k == 0 { diagonal } else { diagonal - density[k].square() / pivot };
        if pivot.lo() <= 0.0 || pivot.lo().is_nan() {
            return false;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn proves(signs: &[i8], sizes: &[f64], vertical: bool) -> bool {
        let sizes: Vec<Interval> = sizes.iter().map(|x| Interval::point(*x)).collect();
        proves_optimal(signs, &vec![Interval::ONE; signs.len()], &sizes, vertical)
    }

    /// All bars in tension: always. One compressed: if and only if Σ 1/τ ≤ 0. Two: never.
    #[test]
    fn the_rule_of_one_compressed_bar() {
        assert!(proves(&[1, 1, 1], &[1.0, 2.0, 3.0], false));
        // 1/1 + 1/2 − 1/0.5 = −0.5.
        assert!(proves(&[1, 1, -1], &[1.0, 2.0, 0.5], false));
        assert!(proves(&[1, -1, 1], &[1.0, 0.5, 2.0], false));
        // 1/1 + 1/2 − 1/0.75 = 1/6.
        assert!(!proves(&[1, 1, -1], &[1.0, 2.0, 0.75], false));
        assert!(!proves(&[1, -1, -1], &[9.0, 0.1, 0.1], false));
        assert!(!proves(&[-1, 1, -1], &[0.1, 9.0, 0.1], false));
    }
}
