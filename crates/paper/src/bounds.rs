//! The energy of all configurations of the paper's example: E1 has the least, E2 the greatest.
//!
//! Their stress matrices prove it, positive semidefinite at E1 (although bar 3 is in compression),
//! negative at E2, and singular at both: the chain turns about the vertical of its anchors.

use model::system::System;
use serde::Serialize;
use validate::certificate::{certify, certify_highest};
use validate::systems::hang_as_cables;

use crate::example::{Example, ExampleError};

/// Bounds on V of every configuration of the example, mgl with the paper's zero.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Bounds {
    /// No configuration has less energy: the certificate of E1 by `lagrange`.
    pub lower_mgl: f64,
    /// V(E1) by `energy` less that bound.
    pub gap_to_e1_mgl: f64,
    /// No configuration has more energy: the certificate of E2 by `lagrange`.
    pub upper_mgl: f64,
    /// That bound less V(E2) by `lagrange`.
    pub gap_to_e2_mgl: f64,
    /// Least energy with bars as cables: second-order cones. Lower, since bar 3 is in compression.
    pub cables_mgl: f64,
}

/// Largest gap, mgl, at which a bound shows that an equilibrium is the global minimum or maximum:
/// roundings of a few 1e-15 on either side.
const TIGHT_MGL: f64 = 1e-12;

/// How far below zero a gap may come out: the energies compared are rounded, the bounds are proofs.
const ROUNDING_MGL: f64 = 1e-14;

impl Bounds {
    /// Certify both ends, and hang the example as cables.
    ///
    /// # Errors
    ///
    /// [`ExampleError`] when E1 or E2 gets no certificate, or the cones are not solved.
    pub fn compute(example: &Example) -> Result<Self, ExampleError> {
        let problem = model::cases::paper();
        let [e1, e2] = [&example.lagrange.e1, &example.lagrange.e2];
        let lower_mgl = example.v_mgl(certify(&problem, &e1.equilibrium)?.bound_j);
        let upper_mgl = example.v_mgl(certify_highest(&problem, &e2.equilibrium)?.bound_j);
        let cables = hang_as_cables(&System::from(problem.chain()))?;
        Ok(Self {
            lower_mgl,
            gap_to_e1_mgl: example.by_energy_e1().v_mgl - lower_mgl,
            upper_mgl,
            gap_to_e2_mgl: upper_mgl - example.by_lagrange(e2).v_mgl,
            cables_mgl: example.v_mgl(cables.energy_j),
        })
    }

    /// Whether E1 is proved to be the global minimum and E2 the global maximum.
    pub fn are_tight(&self) -> bool {
        let tight = |gap: f64| (-ROUNDING_MGL..TIGHT_MGL).contains(&gap);
        tight(self.gap_to_e1_mgl) && tight(self.gap_to_e2_mgl)
    }
}
