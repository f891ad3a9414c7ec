//! First derivative of the energy along the closed chains.

use model::Vector;

use crate::run::closure::{Shape, answer};
use crate::run::scaled_chain::ScaledChain;
use crate::run::straight_fold::{line, off_the_line, opening_multiplier};
use crate::vector::{dot, scaled, tangent};

/// Eigenvalues above minus this, in units of the largest force, are zero: the rounding of the axial
/// forces and of the sums behind the count.
const ZERO_CURVATURE: f64 = 1e-10;

/// The projected gradient and what comes with it.
///
/// On the closed chains, with the metric `sum l_i |du_i|²`, the gradient of the energy has the
/// parts `t_i = (I - u_i u_iᵀ)(h_i up + mu)`: the force across bar *i* in units of the total
/// weight. The multiplier `mu` of the closure is the one that makes the gradient smallest (least
/// squares); at an equilibrium it is the Lagrange multiplier, and `-mu` the derivative of the least
/// energy by the position of the end anchor.
#[derive(Debug, Clone)]
pub(crate) struct Slope {
    /// Multiplier `mu` of the closure.
    pub(crate) multiplier: Vector,
    /// `N_i = -(h_i up + mu) . u_i`: the force along each bar, tension positive, and at the same
    /// time the second derivative of the Lagrangian by a turn of the bar.
    pub(crate) axial: Vec<f64>,
    /// Largest `|t_i|`.
    pub(crate) across: f64,
    /// Root of `sum l_i |t_i|²`.
    pub(crate) mean: f64,
    /// Smallest `N_i`.
    pub(crate) lowest: f64,
    /// Smallest `|N_i|`.
    pub(crate) softest: f64,
    /// Largest `|N_i|`.
    pub(crate) highest: f64,
    /// Largest `|h_i up + mu|`, at least one: the size of the forces that `t_i` is a difference of.
    pub(crate) pull: f64,
    /// Curvatures below minus this are negative, those above it positive; in between they are zero.
    pub(crate) zero: f64,
    /// The direction of the bars if all are on one straight line: the closure then leaves this part
    /// of the multiplier free, and the closure along it restricts nothing.
    pub(crate) line: Option<Vector>,
    /// Whether on that line the multiplier leaves no bar pushed.
    pub(crate) opened: bool,
}

impl Slope {
    pub(crate) fn new(links: &ScaledChain, shape: &Shape) -> Self {
        let moments = &shape.moments;
        let multiplier = scaled(-1.0, answer(&moments.spread, 0.0, moments.weight));
        let line = line(shape);
        let opening = line.and_then(|e| opening_multiplier(links, shape, multiplier, e));
        let slope = Self::with_multiplier(links, &shape.u, opening.unwrap_or(multiplier));
        Self { line, opened: opening.is_some(), ..slope }
    }

    /// At a refined minimum: weights counted from the bar with the least load, so that small ones
    /// near it say how small a curvature still says something.
    pub(crate) fn refined(links: &ScaledChain, u: &[Vector], multiplier: Vector) -> Self {
        let slope = Self::with_multiplier(links, u, multiplier);
        let sizes = links.carried.iter().map(|h| h.abs()).filter(|h| *h > 0.0);
        let near = sizes.fold(slope.pull, f64::min);
        Self { zero: ZERO_CURVATURE * near, ..slope }
    }

    fn with_multiplier(links: &ScaledChain, u: &[Vector], multiplier: Vector) -> Self {
        let mut axial = Vec::with_capacity(u.len());
        let (mut across, mut sum, mut pull) = (0.0_f64, 0.0, 1.0_f64);
        let (mut lowest, mut highest) = (f64::INFINITY, 0.0_f64);
        let mut softest = f64::INFINITY;
        for (i, &u) in u.iter().enumerate() {
            let a = links.load(i, multiplier);
            let t = tangent(u, a);
            let square = dot(t, t);
            let n = -dot(a, u);
            sum += links.length[i] * square;
            across = across.max(square);
            pull = pull.max(dot(a, a));
            lowest = lowest.min(n);
            highest = highest.max(n.abs());
            softest = softest.min(n.abs());
            axial.push(n);
        }
        Self {
            multiplier,
            axial,
            // `max` passes over NaN; the sum does not.
            across: if sum.is_finite() { across.sqrt() } else { f64::NAN },
            mean: f64::sqrt(sum),
            lowest,
            softest,
            highest,
            pull: pull.sqrt(),
            zero: ZERO_CURVATURE * pull.sqrt(),
            line: None,
            opened: false,
        }
    }

    /// What the gradient tolerance is compared with: the largest force across a bar over the
    /// largest force (or the weight, if that is more).
    pub(crate) fn residual(&self) -> f64 {
        self.across / self.pull
    }

    /// How far off the common line of the bars the end anchor lies, in total lengths, where all
    /// bars are on a line and one is compressed: what tells the positions of such a chain apart is
    /// lost. With all bars in tension there is nothing to tell: no configuration has less energy.
    pub(crate) fn lost(&self, links: &ScaledChain) -> Option<f64> {
        off_the_line(links, self.line.filter(|_| !self.opened)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::settings::Motion;

    /// Of weights counted from a bar the smallest that is not zero says what a curvature is held
    /// against; of all others the largest force.
    #[test]
    fn zero_is_a_part_of_the_smallest_load_at_a_refined_minimum() {
        let links = ScaledChain {
            length: vec![0.25; 4],
            carried: vec![0.0, -3e-5, 0.25, -0.5],
            span: [[0.0; 3]; 2],
            up: [0.0, 0.0, 1.0],
            vertical: true,
            motion: Motion::Plane,
        };
        let u = [[0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]];
        let slope = Slope::refined(&links, &u, [0.0, 0.0, 2.5]);
        // The largest load is that of the third bar, 2.5 + 0.25.
        assert!((slope.pull - 2.75).abs() < 1e-15);
        assert!((slope.zero / 3e-15 - 1.0).abs() < 1e-12);
        // Of the first and the third bar all load is along, of the second all is across, and the
        // last is at 0.6 across and 0.8 along.
        let exact = [2.5, 0.0, -2.75, -1.6];
        assert!(slope.axial.iter().zip(exact).all(|(n, exact)| (n - exact).abs() < 1e-15));
        let across = 2.5 - 3e-5;
        assert!((slope.across - across).abs() < 1e-15);
        assert!((slope.mean - (0.25 * (across * across + 1.2 * 1.2)).sqrt()).abs() < 1e-15);
        assert!((slope.lowest + 2.75).abs() < 1e-15 && (slope.highest - 2.75).abs() < 1e-15);
        assert!(slope.softest.abs() < 1e-15);
        assert!((slope.residual() - across / 2.75).abs() < 1e-15);
    }

    /// On a line that the multiplier does not open, anchors off it say that the shape is lost.
    #[test]
    fn a_shape_on_a_line_is_lost_unless_all_bars_pull() {
        let links = ScaledChain {
            length: vec![0.5, 0.5],
            carried: vec![0.25, -0.25],
            span: [[0.3, 0.0, 0.4], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion: Motion::Plane,
        };
        let u = [[1.0, 0.0, 0.0]; 2];
        let line = Some([1.0, 0.0, 0.0]);
        let slope = |line, opened| Slope { line, opened, ..Slope::refined(&links, &u, [0.0; 3]) };
        assert!((slope(line, false).lost(&links).unwrap() - 0.4).abs() < 1e-15);
        assert!(slope(line, true).lost(&links).is_none());
        assert!(slope(None, false).lost(&links).is_none());
        assert!(slope(Some([0.6, 0.0, 0.8]), false).lost(&links).is_none());
    }
}
