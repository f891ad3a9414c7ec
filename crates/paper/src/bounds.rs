//! The energy of all configurations of the paper's example, bounded without any guess.
//!
//! Convex programmes, solved by clarabel and rounded to proofs, against the equilibria that the
//! solvers found: the semidefinite bounds are tight on both sides, the bound by cables is not.

use bounds::{BoundError, BoundSettings, Sense, cable_bound, semidefinite};
use serde::Serialize;

use crate::example::Example;

/// Bounds on V of every configuration of the example, mgl with the paper's zero.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// No configuration has less energy: semidefinite programme, rounded to a proof.
    pub lower_mgl: f64,
    /// V(E1) by `lagrange` less that bound.
    pub gap_to_e1_mgl: f64,
    /// No configuration has more energy.
    pub upper_mgl: f64,
    /// That bound less V(E2) by `lagrange`.
    pub gap_to_e2_mgl: f64,
    /// The lower bound with bars as cables: second-order cones. Not tight, since bar 3 is in
    /// compression.
    pub cables_mgl: f64,
}

/// Largest gap, mgl, at which a bound shows that an equilibrium is the global minimum or maximum:
/// roundings of a few 1e-15 on either side.
const TIGHT_MGL: f64 = 1e-12;

/// How far below zero a gap may come out: the energies compared are rounded, the bounds are proofs.
const ROUNDING_MGL: f64 = 1e-14;

impl Bounds {
    /// Solve the programmes.
    ///
    /// # Errors
    ///
    /// [`BoundError`] when one of them is not solved.
    pub fn compute(example: &Example) -> Result<Self, BoundError> {
        let problem = model::cases::paper();
        let settings = BoundSettings::default();
        let mgl = |energy_j: f64| example.v_mgl(energy_j);
        let lower_mgl = mgl(semidefinite(&problem, Sense::Lower, &settings)?.rigorous_j);
        let upper_mgl = mgl(semidefinite(&problem, Sense::Upper, &settings)?.rigorous_j);
        let cables_mgl = mgl(cable_bound(&problem, &settings)?.rigorous_j);
        let [e1, e2] = [&example.lagrange.e1, &example.lagrange.e2]
            .map(|found| example.by_lagrange(found).v_mgl);
        Ok(Self {
            lower_mgl,
            gap_to_e1_mgl: e1 - lower_mgl,
            upper_mgl,
            gap_to_e2_mgl: upper_mgl - e2,
            cables_mgl,
        })
    }

    /// Whether E1 is proved to be the global minimum and E2 the global maximum.
    #[must_use]
    pub fn are_tight(&self) -> bool {
        let tight = |gap: f64| (-ROUNDING_MGL..TIGHT_MGL).contains(&gap);
        tight(self.gap_to_e1_mgl) && tight(self.gap_to_e2_mgl)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn e1_is_the_global_minimum_and_e2_the_global_maximum() {
        let bounds = Bounds::compute(&Example::solve().unwrap()).unwrap();
        assert!(bounds.are_tight(), "{bounds:?}");
        // Closed form: with slack cables the chain hangs straight down, V = 6 - 2.5 - 1.5 = 2.
        assert!((bounds.cables_mgl - 2.0).abs() < 1e-12, "{bounds:?}");
        for gap in [f64::NAN, -1e-6, 1e-6] {
            assert!(!Bounds { gap_to_e1_mgl: gap, ..bounds }.are_tight());
            assert!(!Bounds { gap_to_e2_mgl: gap, ..bounds }.are_tight());
        }
    }
}
