//! Drawings of answers: joints, supports, loads, reactions and axial forces, to scale.

pub use figures::{Format, FormatError, Seen};
use figures::{ModeShape, ModeShapes, StructureError, SystemShape};
use model::system::{System, SystemEquilibrium};
use model::{AxialForce, Vector};

use crate::modes::{Mode, WithModes};
use crate::moving_page::eye;

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

/// Most modes in one drawing: those on a large sheet.
const MOST_DRAWN: usize = 24;

/// The lowest modes of an equilibrium as an SVG file, up to 24 of them: at rest, and displaced to
/// both sides, seen from where it is asked for. Displacements are to first order, and exaggerated.
///
/// ```
/// use funicular::prelude::*;
/// let problem = Problem::case("two-bars")?;
/// let found = Modes::new().run(&problem)?;
/// let system = problem.system();
/// let svg = funicular::drawn_modes(&system, &found.equilibria[0], funicular::picture::Seen::Best).unwrap();
/// assert!(svg.starts_with("<svg") && svg.contains("Hz"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// [`StructureError`] when a place is not finite.
pub fn drawn_modes(
    system: &System,
    found: &WithModes,
    seen: Seen,
) -> Result<String, StructureError> {
    let joints_m: Vec<_> = found.joints.iter().map(|joint| joint.at_m).collect();
    let drawn = found.modes.len().min(MOST_DRAWN);
    let modes = found.modes.iter().take(drawn).enumerate().map(|(k, mode)| ModeShape {
        heading: heading(k, mode),
        what: &mode.what,
        shape: &mode.shape,
    });
    let modes: Vec<_> = modes.collect();
    let which = if drawn < found.modes_in_all {
        format!("the lowest {drawn} of {} modes", found.modes_in_all)
    } else {
        "all modes".to_owned()
    };
    let note = format!("equilibrium {}: {which}; displacements are exaggerated", found.label);
    ModeShapes { system, note: &note, joints_m: &joints_m, modes: &modes, seen }.svg()
}

/// Number and frequency of a mode.
pub(crate) fn heading(k: usize, mode: &Mode) -> String {
    let number = k + 1;
    match (mode.frequency_hz, mode.rate_1_s) {
        (Some(hz), _) => format!("{number}: {} Hz", eye(hz)),
        (_, Some(rate)) => format!("{number}: leaves at {} per s", eye(rate)),
        _ => format!("{number}: 0 Hz"),
    }
}
