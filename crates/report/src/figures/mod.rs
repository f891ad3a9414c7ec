//! The pictures of the report: each a few vector graphics side by side, with one caption.
//!
//! Colours are left to the style of the page (classes `tension`, `compression`, `force`, ...),
//! which has one set for light and one for dark screens, both taken from Okabe and Ito's palette
//! for the colour-blind; whatever a colour says, a dash, a shape or a word says too.

mod basins;
mod census;
mod convergence;
mod equilibria;
mod mechanism;
mod valley;

pub use basins::basins;
pub use census::census;
pub use convergence::convergence;
pub use equilibria::equilibria;
pub use mechanism::mechanism;
pub use valley::valley;

/// One or more pictures under one caption.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Figure {
    /// Name of its anchor in the page.
    pub id: &'static str,
    /// The pictures: SVG elements.
    pub panels: Vec<String>,
    /// What there is to see.
    pub caption: String,
}

/// Direction of a bar at an angle from straight down, deg, in px: y downwards.
fn direction(angle_deg: f64) -> [f64; 2] {
    let (sin, cos) = angle_deg.to_radians().sin_cos();
    [sin, cos]
}

/// `at + scale * by`.
fn moved(at: [f64; 2], scale: f64, by: [f64; 2]) -> [f64; 2] {
    [at[0] + scale * by[0], at[1] + scale * by[1]]
}

/// Joints O, A, B, D of three bars of length 1 at these angles, from O; y downwards.
fn joints(angles_deg: [f64; 3]) -> [[f64; 2]; 4] {
    let mut joints = [[0.0; 2]; 4];
    for (bar, angle) in angles_deg.into_iter().enumerate() {
        joints[bar + 1] = moved(joints[bar], 1.0, direction(angle));
    }
    joints
}
