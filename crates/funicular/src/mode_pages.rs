//! Modes to look at: drawn side by side, and moving on a page.

use figures::{ModeShape, ModeShapes, Seen, StructureError};
use model::system::System;

use crate::modes::{Mode, ModesAnswer, WithModes};
use crate::moving_page::eye;
use crate::shown::{Shape, Shown};

/// Most modes in one drawing: those on a large sheet.
const MOST_DRAWN: usize = 24;

/// The lowest modes of an equilibrium as an SVG file, up to 24 of them: at rest, and displaced to
/// both sides, seen from where it is asked for. Displacements are to first order, and exaggerated.
///
/// ```
/// use funicular::prelude::*;
/// let problem = Problem::case("two-bars")?;
/// let found = Modes::new().run(&problem)?;
/// let system = funicular::system_of(&problem);
/// let svg = funicular::drawn_modes(&system, &found.equilibria[0], funicular::picture::Seen::Best).unwrap();
/// assert!(svg.starts_with("<svg") && svg.contains("Hz"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
///
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

/// All equilibria with their modes as one HTML file in which they move. Displacements are to first
/// order, and exaggerated.
///
/// ```
/// use funicular::prelude::*;
/// let problem = Problem::case("two-bars")?;
/// let found = Modes::new().run(&problem)?;
/// let page = funicular::animated_modes(&funicular::system_of(&problem), &found);
/// assert!(page.starts_with("<!DOCTYPE html>") && page.contains("\"bars\":[[0,1],[1,2]]"));
/// # Ok::<(), Error>(())
/// ```
#[must_use]
pub fn animated_modes(system: &System, answer: &ModesAnswer) -> String {
    let shapes = answer.equilibria.iter().map(|found| {
        let places = found.joints.iter().map(|joint| joint.at_m);
        Shape::bare(system, "Equilibria", &found.label, places).with_modes(&found.modes)
    });
    Shown { heading: "modes", play: true, shapes: shapes.collect(), ..Shown::default() }
        .html(system, "")
}
