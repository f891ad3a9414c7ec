//! The answer of one solver for a system.

use crate::Vector;
use crate::evidence::Evidence;
use crate::solver_name::SolverName;
use crate::stability::InSpace;

/// One equilibrium of a [`System`](super::System) as one solver found it: observables only.
#[derive(Debug, Clone, PartialEq)]
pub struct SystemEquilibrium {
    /// Who found it.
    pub solver: SolverName,
    /// Potential energy relative to [`System::reference_m`](super::System::reference_m), J.
    pub energy_j: f64,
    /// Place of each joint, world frame, m.
    pub joints_m: Vec<Vector>,
    /// For each member the force on it at the joint where it begins, world frame, N.
    pub start_forces_n: Vec<Vector>,
    /// For each member the force on it at the joint where it ends, world frame, N.
    pub end_forces_n: Vec<Vector>,
    /// Axial force of each member with its loads lumped to its joints by the lever rule, N, tension
    /// positive.
    pub axial_n: Vec<f64>,
    /// Force of the ground on each joint, world frame, N; zero at free joints.
    pub reactions_n: Vec<Vector>,
    /// Second-order behaviour.
    pub stability: SystemStability,
    /// How far the equilibrium is proved.
    pub evidence: Evidence,
}

/// Second-order behaviour of an equilibrium of a system among all motions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
pub struct SystemStability {
    /// Whether the energy falls in some direction.
    pub in_space: InSpace,
    /// Number of independent directions in which the energy falls (Morse index).
    pub index_in_space: usize,
    /// The same among the motions in the vertical plane that holds all joints, forces and supports;
    /// nothing where there is no such plane.
    pub index_in_plane: Option<usize>,
    /// Independent directions in which the energy neither falls nor rises to second order, as the solver counts them. Of joints
    /// on which nothing acts, and of forces that are shared by convention, each has its own count: it is not compared.
    pub neutral: usize,
}
