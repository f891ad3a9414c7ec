//! The answer of one solver.

use serde::{Deserialize, Serialize};

use crate::{Evidence, Vector};

/// One equilibrium as one solver found it: observables only, so that solvers with nothing in common
/// can be compared.
///
/// The field names are those of the JSON (`funicular solve --json`).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Equilibrium {
    /// Who found it.
    pub solver: SolverName,
    /// Potential energy `V = Σ m_i g Z_Ci`, measured from the height of joint 0, J.
    pub energy_j: f64,
    /// Positions of the joints 0..=n, world frame, m.
    pub joints_m: Vec<Vector>,
    /// The 3(n+1) multipliers in the paper's meaning and order, world frame, N: entry 0 is the force
    /// of the ground on bar 1 at joint 0 (λ₁..₃), entry k = 1..n−1 the force of bar k+1 on bar k at
    /// joint k, entry n the force of the ground on bar n at joint n.
    pub multipliers_n: Vec<Vector>,
    /// Forces of the ground on the chain, world frame, N.
    pub reactions_n: Reactions,
    /// Axial force of each bar with its weight lumped to its joints by the lever rule, N, tension
    /// positive. The axial force varies along a heavy bar; this is its value at the centre of weight
    /// of a homogeneous bar, and the only one for which the whole force is along the bar.
    pub axial_n: Vec<f64>,
    /// Second-order behaviour.
    pub stability: Stability,
    /// How far the equilibrium is proved.
    pub evidence: Evidence,
}

/// The solver behind an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum SolverName {
    /// Crate `lagrange`: forces first.
    Lagrange,
    /// Crate `energy`: energy first.
    Energy,
    /// Crate `census`: every equilibrium, by interval branch and bound.
    Census,
}

impl std::fmt::Display for SolverName {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Lagrange => "lagrange",
            Self::Energy => "energy",
            Self::Census => "census",
        })
    }
}

/// Forces of the ground on the chain at its two anchors, world frame, N.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Reactions {
    /// At joint 0.
    pub start: Vector,
    /// At joint n.
    pub end: Vector,
}

/// Second-order behaviour of an equilibrium.
///
/// The index is the number of independent directions in which the energy falls (Morse index of the
/// energy on the configurations that keep every bar whole and both ends in place).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Stability {
    /// Character among the motions in the vertical plane of the equilibrium.
    pub in_plane: InPlane,
    /// Morse index among those motions.
    pub index_in_plane: usize,
    /// Stability among all motions. The neutral turn of the whole chain about vertical anchors does
    /// not count against it.
    pub in_space: InSpace,
    /// Morse index among all motions.
    pub index_in_space: usize,
}

/// Character of an equilibrium among the motions in its own vertical plane.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InPlane {
    /// No direction of falling energy.
    Minimum,
    /// The energy falls in some directions and rises in others.
    Saddle,
    /// The energy falls in every direction.
    Maximum,
    /// The second derivative has a zero eigenvalue: the second order does not decide.
    Degenerate,
}

/// Stability of an equilibrium among all motions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum InSpace {
    /// No direction of falling energy.
    Stable,
    /// At least one direction of falling energy.
    Unstable,
}
