//! The Morse inequalities: a check of a census that needs no census.
//!
//! On a closed manifold the critical points of a Morse function, counted by index, obey
//!
//! $$ \sum_k c_k t^k - \sum_k b_k t^k = (1 + t) \sum_k q_k t^k, \qquad q_k \ge 0. $$
//!
//! At t = −1 this is Σ (−1)^index = χ. A critical manifold on which the function is constant and
//! across which its second derivative is regular counts with its own Betti numbers, raised by its
//! index.
//!
//! M. Morse, Trans. Amer. Math. Soc. 27 (1925) 345-396, doi:10.1090/S0002-9947-1925-1501318-X;
//! R. Bott, Ann. of Math. 60 (1954) 248-261, doi:10.2307/1969631

use crate::run::count::topology::Topology;

/// How the Morse inequalities fail.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum MorseError {
    /// Occurs when an index is larger than the dimension.
    #[error("an equilibrium of index {index} on a manifold of dimension {dimension}")]
    Index { index: usize, dimension: usize },
    /// Occurs when Σ (−1)^index is not the Euler characteristic.
    #[error("the sum of (-1)^index is {found}, the Euler characteristic is {expected}")]
    Euler { found: i64, expected: i64 },
    /// Occurs when there are too few equilibria up to an index: a strong inequality fails.
    #[error("too few equilibria of index up to {index}: the Morse inequality fails by {missing}")]
    TooFew { index: usize, missing: i64 },
}

/// Check critical points, counted by index, against Betti numbers: all strong inequalities, which
/// imply the weak ones, and the Euler characteristic.
pub(crate) fn check(count: &[i64], topology: &Topology) -> Result<(), MorseError> {
    let dimension = topology.betti.len() - 1;
    if let Some(index) = (dimension + 1..count.len()).find(|k| count[*k] != 0) {
        return Err(MorseError::Index { index, dimension });
    }
    let found = alternating_sum(count);
    if found != topology.euler {
        return Err(MorseError::Euler { found, expected: topology.euler });
    }
    let mut quotient = 0;
    for (index, betti) in topology.betti.iter().enumerate() {
        let betti = i64::try_from(*betti).unwrap_or(i64::MAX);
        quotient = count.get(index).copied().unwrap_or(0) - betti - quotient;
        if quotient < 0 {
            return Err(MorseError::TooFew { index, missing: -quotient });
        }
    }
    Ok(())
}

/// Σ (−1)^index over critical points, counted by index.
pub(crate) fn alternating_sum(count: &[i64]) -> i64 {
    count.iter().zip([1, -1].into_iter().cycle()).map(|(c, sign)| sign * c).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn torus() -> Topology {
        Topology { betti: vec![1, 2, 1], euler: 0 }
    }

    #[test]
    fn a_function_on_the_torus() {
        assert_eq!(check(&[1, 2, 1], &torus()), Ok(()));
        assert_eq!(check(&[2, 4, 2], &torus()), Ok(()));
        assert_eq!(check(&[2, 2, 1], &torus()), Err(MorseError::Euler { found: 1, expected: 0 }));
        assert_eq!(check(&[1, 1, 0], &torus()), Err(MorseError::TooFew { index: 1, missing: 1 }));
        // Two minima more ask for two passes more.
        assert_eq!(check(&[3, 3, 0], &torus()), Err(MorseError::TooFew { index: 1, missing: 1 }));
        assert_eq!(check(&[0, 2, 2], &torus()), Err(MorseError::TooFew { index: 0, missing: 1 }));
        assert_eq!(
            check(&[1, 2, 1, 1], &torus()),
            Err(MorseError::Index { index: 3, dimension: 2 })
        );
    }
}
