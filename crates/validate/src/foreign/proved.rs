//! How large the error of an answer is, with proof.

use census::boxes::prove;
use model::Vector;
use model::system::{System, SystemEquilibrium};
use numerics::Interval;
use serde::Serialize;

/// Enclosures of the errors of an answer: of its difference from the one equilibrium of which
/// interval arithmetic proves that it lies next to a solver's.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ProvedError {
    /// Largest distance of a joint from where the equilibrium has it, m: at least, at most.
    pub joints_m: [f64; 2],
    /// Largest difference of an axial force, N: at least, at most.
    pub forces_n: [f64; 2],
}

/// The errors of an answer against the equilibrium next to that of a solver. Nothing where no box
/// is proved, or where it stands for many equilibria: parts that turn freely, joints that lie
/// loose.
pub(super) fn proved_error(
    system: &System,
    answer: &SystemEquilibrium,
    found: &SystemEquilibrium,
) -> Option<ProvedError> {
    let proof = prove(system, &found.joints_m, &found.axial_n).ok()?;
    let fits = answer.joints_m.len() == proof.joints_m.len()
        && answer.axial_n.len() == proof.axial_n.len();
    let finite = answer.joints_m.iter().flatten().chain(&answer.axial_n).all(|x| x.is_finite());
    if !(fits && finite && proof.turns == 0 && proof.loose_joints.is_empty()) {
        return None;
    }
    let apart = |at: &Vector, place: &[Interval; 3]| {
        let squares = (0..3).map(|c| (Interval::point(at[c]) - place[c]).square());
        squares.fold(Interval::ZERO, |sum, square| sum + square).sqrt()
    };
    let joints = answer.joints_m.iter().zip(&proof.joints_m).map(|(at, place)| apart(at, place));
    let forces = answer.axial_n.iter().zip(&proof.axial_n);
    let forces = forces.map(|(force, enclosure)| (Interval::point(*force) - *enclosure).abs());
    Some(ProvedError { joints_m: largest(joints), forces_n: largest(forces) })
}

/// Bounds of the largest of some numbers, none negative.
fn largest(numbers: impl Iterator<Item = Interval>) -> [f64; 2] {
    numbers.fold([0.0; 2], |[least, most], x| [least.max(x.lo()), most.max(x.hi())])
}
