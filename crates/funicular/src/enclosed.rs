//! Enclosures of frequencies: an equilibrium proved to lie in a box, and the `ω²` about it.

use model::Vector;
use model::evidence::NoBox;
use model::system::System;
use motion::{Enclosures, EquilibriumBox, MOST_ENCLOSED_JOINTS, NotEnclosed};
use serde::Serialize;
use validate::Tolerances;

/// Whether the `ω²` of an equilibrium are enclosed by interval arithmetic.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "status", rename_all = "snake_case")]
#[non_exhaustive]
pub enum Enclosed {
    /// Exactly one equilibrium is proved to lie in a box, and each `ω²` about it in its interval.
    Reached {
        /// Largest width of the box, m.
        width_m: f64,
        /// How many `ω²` have which sign; none where an enclosure holds zero and no turn about a
        /// vertical proves it to be zero.
        inertia: Option<Inertia>,
    },
    /// Not proved.
    Open {
        /// Why, in words.
        because: String,
    },
}

/// Signs of `ω²`, proved; spins of bars, which are zero, left aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Inertia {
    /// Number of `ω² < 0`: the index of the equilibrium.
    pub negative: usize,
    /// Number of `ω² = 0`: independent turns about verticals.
    pub zero: usize,
    /// Number of `ω² > 0`.
    pub positive: usize,
}

impl Enclosed {
    /// The index, where it is proved.
    pub fn index(&self) -> Option<usize> {
        match self {
            Self::Reached { inertia, .. } => inertia.map(|inertia| inertia.negative),
            Self::Open { .. } => None,
        }
    }
}

/// Prove an equilibrium next to an answer, and enclose all its `ω²`, ascending, spins left out.
pub(crate) fn enclose(
    system: &System,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> (Enclosed, Vec<[f64; 2]>) {
    match proved(system, joints_m, axial_n) {
        Ok((width_m, found)) => {
            let inertia = found.inertia.map(|[negative, zero, positive]| Inertia {
                negative,
                zero,
                positive,
            });
            let ends = found.omega2_s2.iter().map(|omega2| [omega2.lo(), omega2.hi()]).collect();
            (Enclosed::Reached { width_m, inertia }, ends)
        }
        Err(because) => (Enclosed::Open { because }, Vec::new()),
    }
}

/// The width of the box, m, and what is enclosed; or why not, in words.
fn proved(
    system: &System,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> Result<(f64, Enclosures), String> {
    // The proof of the box is asked for only where it is of use.
    let moving = system.joints().iter().filter(|joint| !joint.support.is_fixed()).count();
    if moving > MOST_ENCLOSED_JOINTS {
        let refused = NotEnclosed::TooLarge { joints: moving, most: MOST_ENCLOSED_JOINTS };
        return Err(refused.to_string());
    }
    let proof = census::boxes::prove(system, joints_m, axial_n)
        .map_err(|no_box| format!("the equilibrium is not proved: {no_box}"))?;
    // A box next to a fold may hold the neighbour. NaN is near to nothing.
    let distance_m = proof.beyond_m(joints_m);
    let near = distance_m <= Tolerances::project().joints * system.total_length_m();
    if !near {
        let distance_n = proof.beyond_n(axial_n);
        return Err(NoBox::Elsewhere { distance_m, distance_n }.to_string());
    }
    if let Some(joint) = proof.loose_joints.first() {
        let name = &system.joints()[*joint].name;
        return Err(format!("joint {name:?} hangs on slack members alone"));
    }
    let at =
        EquilibriumBox { joints_m: &proof.joints_m, axial_n: &proof.axial_n, turns: proof.turns };
    let found = motion::enclose_modes(system, &at).map_err(|error| error.to_string())?;
    Ok((proof.width_m, found))
}
