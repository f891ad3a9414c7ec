//! The answer of one solver.

use crate::Vector;
use crate::evidence::Evidence;
use crate::solver_name::SolverName;
use crate::stability::Stability;

/// One equilibrium as one solver found it: observables only, so that solvers with nothing in common
/// can be compared.
///
/// The field names are those of the JSON (`funicular solve --json`).
#[derive(Debug, Clone, PartialEq)]
pub struct Equilibrium {
    /// Who found it.
    pub solver: SolverName,
    /// Potential energy `V = Σ m_i g Z_Ci`, measured from the height of joint 0, J.
    pub energy_j: f64,
    /// Positions of the joints 0..=n, world frame, m.
    pub joints_m: Vec<Vector>,
    /// The 3(n+1) multipliers in the paper's meaning and order, world frame, N: entry 0 is the
    /// force of the ground on bar 1 at joint 0 (λ₁..₃), entry k = 1..n−1 the force of bar k+1 on
    /// bar k at joint k, entry n the force of the ground on bar n at joint n.
    pub multipliers_n: Vec<Vector>,
    /// Forces of the ground on the chain, world frame, N.
    pub reactions_n: Reactions,
    /// Axial force of each bar with its weight lumped to its joints by the lever rule, N, tension
    /// positive. The axial force varies along a heavy bar; this is its value at the centre of
    /// weight of a homogeneous bar, and the only one for which the whole force is along the bar.
    pub axial_n: Vec<f64>,
    /// Second-order behaviour.
    pub stability: Stability,
    /// How far the equilibrium is proved.
    pub evidence: Evidence,
}

/// Forces of the ground on the chain at its two anchors, world frame, N.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reactions {
    /// At joint 0.
    pub start: Vector,
    /// At joint n.
    pub end: Vector,
}
