//! Abstract and section VII: eqs. (40), (41), and what the text counts and cites.

use std::f64::consts::FRAC_PI_2;

use matrices::dense::{Lu, apply};
use nalgebra::{DVector, Vector3};

use super::inertia::velocity_matrix;
use super::sample::{LargestEntry, dynamic, largest};
use super::{E1State, EquationAudit, Fault, ROUNDING, SOLVED, says};

/// Multipliers of three bars.
const MULTIPLIERS: usize = 12;

/// Coordinates of three bars.
const COORDINATES: usize = 18;

/// The coordinates of section VIII: $\psi_i = 0$, $\theta_i = \pi/2$, $\varphi_i$ from the
/// descending vertical, the bars hung on one another from O, l = 1.
pub(super) fn planar(phi: [f64; 3]) -> DVector<f64> {
    let mut joint = Vector3::zeros();
    let mut q = DVector::zeros(COORDINATES);
    for (bar, angle) in phi.into_iter().enumerate() {
        let along = Vector3::new(0.0, angle.sin(), -angle.cos());
        q.fixed_rows_mut::<3>(6 * bar).copy_from(&(joint + along / 2.0));
        q.fixed_rows_mut::<3>(6 * bar + 3).copy_from(&Vector3::new(0.0, FRAC_PI_2, angle));
        joint += along;
    }
    q
}

/// $-[B]^T\\{\lambda\\}$ at planar coordinates, in the unit of `lambda`.
pub(super) fn reactions(q: &DVector<f64>, lambda: &DVector<f64>) -> DVector<f64> {
    let paper = model::cases::paper();
    -apply(&lagrange::constraint_matrix(paper.chain(), q).transpose(), lambda)
}

/// $[T]$ of (41) in mg, with or without the weight of bar 2.
pub(super) fn load(with_second: bool) -> DVector<f64> {
    let mut load = DVector::zeros(COORDINATES);
    for bar in 0..3 {
        if bar != 1 || with_second {
            load[6 * bar + 2] = -1.0;
        }
    }
    load
}

/// Largest entry of (40) at the equilibrium, mg.
fn unbalanced(e1: &E1State, with_second: bool) -> f64 {
    let lambda = DVector::from_fn(MULTIPLIERS, |k, _| e1.lambda(k + 1));
    (reactions(&planar(e1.angles()), &lambda) - load(with_second)).largest_entry()
}

/// Equations and unknowns of `lagrange`'s system for the paper's example.
fn system_size() -> usize {
    let paper = model::cases::paper();
    let (q, lambda) = (DVector::zeros(COORDINATES), DVector::<f64>::zeros(MULTIPLIERS));
    lagrange::residual(paper.chain(), &q, &lambda).len()
}

/// The abstract counts equations.
pub(super) fn counted() -> Vec<EquationAudit> {
    let size = system_size() as f64;
    vec![
        says(
            "abstract",
            "abstract",
            "a system of 18 non-linear equations gives equilibria and reactions",
        )
        .counted("equations less unknowns of the whole system", 18.0 - size)
        .corrected(
            "30 equations, as section VII says: 18 of (40) and 12 constraint functions",
            30.0 - size,
            ROUNDING,
        ),
    ]
}

/// Matrices [Q] that are singular at these angles, or not known to be regular.
fn singular(angles: [[f64; 3]; 3]) -> f64 {
    let determinant = |q: &[f64; 3]| {
        Lu::new(&dynamic(&velocity_matrix(*q))).map_or(0.0, |factors| factors.determinant())
    };
    let regular = angles.iter().filter(|q| determinant(q).abs() > ROUNDING);
    (angles.len() - regular.count()) as f64
}

pub(super) fn rows(e1: &E1State) -> Vec<EquationAudit> {
    let size = system_size() as f64;
    let angles = COORDINATES / 2;
    let unknowns = (MULTIPLIERS + angles) as f64 - 21.0;
    let all = (COORDINATES + MULTIPLIERS) as f64 - size;
    vec![
        says("(40)", "VII", "the multipliers balance the load")
            .measured("largest entry at E1, mg", unbalanced(e1, true), SOLVED),
        says("(41)", "VII", "the load; its dots pass over bar 2, as those of (21) do")
            .measured(
            "largest entry of (40) at E1 with the weight of bar 2 where the dots are, mg",
            unbalanced(e1, true),
            SOLVED,
        ),
        says(
            "(41)",
            "VII",
            "with zeros for the dots the weight of bar 2 would be missing, which (xxiii) has: lambda_6 - lambda_9 = -mg",
        )
        .measured(
            "largest entry of (40) at E1 with zeros for the dots, mg",
            unbalanced(e1, false),
            SOLVED,
        )
        .remark(),
        says("after (41)", "VII", "21 unknowns of (40); with the constraints 30 equations for 30 unknowns")
            .counted("differences of the counts", largest([unknowns, all])),
    ]
}

/// The two citations of section VII that lead nowhere, given the last number there is.
pub(super) fn citations(last_number: u32) -> [EquationAudit; 2] {
    let beyond = |cited: u32| f64::from(cited.saturating_sub(last_number));
    let measure = "how far the number lies beyond the last numbered equation";
    [
        says("before (40)", "VII", "cites the moving equation as (45), which does not exist")
            .counted(measure, beyond(45))
            .corrected("(33)", beyond(33), ROUNDING)
            .fault(Fault::Form),
        says("after (41)", "VII", "cites the system of equations as (52), which does not exist")
            .counted(measure, beyond(52))
            .corrected("(40)", beyond(40), ROUNDING)
            .fault(Fault::Form),
    ]
}

/// The coordinates that section VIII chooses: right, and at gimbal lock.
pub(super) fn coordinates(e1: &E1State) -> [EquationAudit; 2] {
    let out_of_plane = e1.angles().map(|phi| lagrange::direction(0.0, FRAC_PI_2, phi).x);
    let in_oyz = e1.angles().map(|phi| [0.0, FRAC_PI_2, phi]);
    // In the plane OXZ, theta alone tells the direction: u = (cos(theta), 0, -sin(theta)).
    let in_oxz = e1.angles().map(|angle| [0.0, FRAC_PI_2 - angle, 0.0]);
    [
        says("before (xi)", "VIII", "psi_i = 0, theta_i = pi/2: the bars lie in the plane OYZ")
            .measured("largest X of a bar's direction at E1", largest(out_of_plane), ROUNDING),
        says(
            "before (xi)",
            "VIII",
            "these coordinates are at gimbal lock: psi_i and phi_i turn about one axis",
        )
        .counted(
            "singular matrices [Q_i] at E1, and with them a singular matrix of (33)",
            singular(in_oyz),
        )
        .replaced(
            "none in the plane OXZ, with psi_i = phi_i = 0 and theta_i the angle from the level",
            singular(in_oxz),
        )
        .remark(),
    ]
}
