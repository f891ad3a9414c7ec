//! What stands out in an equilibrium.

use model::{AxialForce, Vector};
use serde::Serialize;

/// What is this much smaller than the largest force is the rounding of a zero: solvers agree to
/// less.
const ROUNDING: f64 = 1e-12;

/// What stands out in an equilibrium: how deep it hangs, and where the forces are largest.
///
/// ```
/// use funicular::{AxialForce, Extremes};
/// // A lamp on two threads of 5 m between anchors 6 m apart: the triangle 3, 4, 5.
/// let joints_m = [[-3.0, 0.0, 0.0], [0.0, 0.0, -4.0], [3.0, 0.0, 0.0]];
/// let pull = AxialForce { from_n: 12.5, to_n: 12.5, least_n: 12.5, most_n: 12.5 };
/// let extremes = Extremes::of(&joints_m, [0, 2], &[pull; 2]).expect("joints");
/// assert_eq!((extremes.lowest_joint, extremes.sag_m), (1, Some(4.0)));
/// assert_eq!(extremes.tension_n, Some((0, 12.5)));
/// assert_eq!(extremes.compression_n, None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Extremes {
    /// The lowest joint, from 0; of several the first.
    pub lowest_joint: usize,
    /// Where it is, m.
    pub lowest_m: Vector,
    /// How far below the lowest support it is, m; nothing where there is no support.
    pub sag_m: Option<f64>,
    /// The bar, from 0, with the largest tension anywhere along it, and that, N; without value where
    /// no bar pulls.
    pub tension_n: Option<(usize, f64)>,
    /// The bar, from 0, with the largest compression anywhere along it, and its size, N; without
    /// value where no bar pushes.
    pub compression_n: Option<(usize, f64)>,
}

impl Extremes {
    /// Of places in m, the joints that are held, and the axial forces along the bars; without value where
    /// there is no joint.
    #[must_use]
    pub fn of(
        joints_m: &[Vector],
        supports: impl IntoIterator<Item = usize>,
        axial: &[AxialForce],
    ) -> Option<Self> {
        let height = |joint: &usize| joints_m[*joint][2];
        let by_height = |a: &usize, b: &usize| height(a).total_cmp(&height(b));
        let lowest_joint = (0..joints_m.len()).min_by(by_height)?;
        let support = supports.into_iter().min_by(by_height);
        let size = axial.iter().fold(0.0, |most: f64, along| most.max(along.largest_n().abs()));
        let largest = |of: fn(&AxialForce) -> f64| {
            let forces = axial.iter().map(of).enumerate();
            let first = forces.fold(None, |most: Option<(usize, f64)>, (bar, force)| match most {
                Some((_, largest)) if force <= largest => most,
                _ => Some((bar, force)),
            });
            first.filter(|(_, force)| *force > ROUNDING * size)
        };
        Some(Self {
            lowest_joint,
            lowest_m: joints_m[lowest_joint],
            sag_m: support.map(|joint| height(&joint) - height(&lowest_joint)),
            tension_n: largest(|along| along.most_n),
            compression_n: largest(|along| -along.least_n),
        })
    }
}
