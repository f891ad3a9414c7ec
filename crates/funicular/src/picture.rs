//! Drawings of answers: joints, supports, loads, reactions and axial forces, to scale.

pub use figures::{Format, FormatError, Seen};
use figures::{StructureError, SystemShape};
use model::system::{System, SystemEquilibrium};
use model::{AxialForce, Vector};

/// An equilibrium of a system as an SVG file, looked at from where it is asked for.
///
/// ```
/// use funicular::{picture, prelude::*};
/// let answer = Solve::new().run(&Problem::case("two-bars")?)?;
/// let (system, found) = (answer.system(), &answer.equilibria()[0]);
/// let svg = picture::of_system(system, found, picture::Seen::Best).unwrap();
/// assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
///
/// [`StructureError`] when a place is not finite.
pub fn of_system(
    system: &System,
    answer: &SystemEquilibrium,
    seen: Seen,
) -> Result<String, StructureError> {
    let SystemEquilibrium { joints_m, reactions_n, .. } = answer;
    let axial_n = largest_n(&answer.axial_forces(system));
    let used = answer.utilisations(system).unwrap_or_default();
    of_answer(system, joints_m, &axial_n, reactions_n, &used, seen)
}

/// What a picture shows of a member: its axial force where it is largest.
fn largest_n(axial: &[AxialForce]) -> Vec<f64> {
    axial.iter().map(AxialForce::largest_n).collect()
}

/// Positions, axial forces and forces of the ground from anywhere as an SVG file; each list as long
/// as the system has joints or members, that of the parts of strengths `used` perhaps empty.
///
/// # Errors
///
/// [`StructureError`] when a place is not finite.
pub fn of_answer(
    system: &System,
    joints_m: &[Vector],
    axial_n: &[f64],
    reactions_n: &[Vector],
    used: &[Option<f64>],
    seen: Seen,
) -> Result<String, StructureError> {
    SystemShape { system, joints_m, axial_n, reactions_n, used, seen }.svg()
}
