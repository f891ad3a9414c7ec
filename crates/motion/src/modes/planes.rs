//! Displacements in and across the vertical plane of an equilibrium: they do not act on each other.

use model::Vector;

use crate::mechanism::Mechanism;
use crate::state::State;
use crate::unequal::Excess;
use numerics::vector::{cross, dot, minus, norm, times};

/// Which way the joints of a mode move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Direction {
    /// In the vertical plane that holds the equilibrium.
    InPlane,
    /// Across that plane.
    Across,
    /// The equilibrium lies in no vertical plane.
    Space,
}

/// How far from a plane joints may be and still lie in it, relative to the total length: rounding.
pub(super) const FLAT: f64 = 1e-11;

/// Directions of displacement that the others do not act on: the same for every joint.
#[derive(Debug, Clone)]
pub(super) struct Sector {
    pub direction: Direction,
    pub axes: Vec<Vector>,
}

/// All displacements.
pub(super) fn space() -> Sector {
    let axes = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Sector { direction: Direction::Space, axes }
}

/// The sectors of an equilibrium: its plane and across, or space.
pub(super) fn sectors(mechanism: &Mechanism, state: &State, excesses: &[Excess]) -> Vec<Sector> {
    let space = vec![space()];
    let near_m = FLAT * mechanism.system.total_length_m();
    let first = state.at[0];
    let level = |at: &Vector| [at[0] - first[0], at[1] - first[1], 0.0];
    let far = |a: &Vector, b: &Vector| norm(level(a)).total_cmp(&norm(level(b)));
    let widest = state.at.iter().max_by(|a, b| far(a, b)).map_or([0.0; 3], level);
    // On one vertical line every vertical plane is a plane of the equilibrium.
    let width_m = norm(widest);
    let along = if width_m > near_m { times(1.0 / width_m, widest) } else { [1.0, 0.0, 0.0] };
    let normal = cross(along, [0.0, 0.0, -1.0]);
    if state.at.iter().any(|at| dot(minus(*at, first), normal).abs() > near_m) {
        return space;
    }
    // A support that is oblique to the plane ties both together, as a principal axis does.
    let oblique = |n: Vector| {
        let across = dot(n, normal).abs();
        across > FLAT && norm(minus(n, times(dot(n, normal), normal))) > FLAT
    };
    let is_tied = excesses.iter().any(|excess| oblique(excess.axis));
    if is_tied || mechanism.slides.iter().any(|slide| oblique(slide.normal)) {
        return space;
    }
    let in_plane = vec![along, [0.0, 0.0, 1.0]];
    vec![
        Sector { direction: Direction::InPlane, axes: in_plane },
        Sector { direction: Direction::Across, axes: vec![normal] },
    ]
}
