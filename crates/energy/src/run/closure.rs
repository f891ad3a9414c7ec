//! The closure `sum l_i u_i = D`: how far directions are from it, and the way back.

use std::f64::consts::TAU;

use model::{STRAIGHT_TOLERANCE, Sum, Vector};

use crate::run::scaled_chain::ScaledChain;
use crate::run::settings::Motion;
use crate::run::symmetric::{Column, Symmetric};
use crate::thresholds::{FAIR_PART, GOLDEN, PROGRESS, ROUNDING, ZERO};
use crate::vector::{VectorSum, along, cross, dot, norm, scaled, tangent};

/// Directions of the bars with what one pass over them gives.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    /// Unit directions `u_i`.
    pub(crate) u: Vec<Vector>,
    pub(crate) moments: Moments,
}

/// Sums over the bars.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Moments {
    /// `sum l_i u_i - D`.
    pub(crate) gap: Vector,
    /// Size of the terms that each component of the gap is the difference of: it holds no more
    /// digits.
    pub(crate) terms: Vector,
    /// `sum l_i (I - u_i u_iᵀ)`: how far the last joint moves for a pull on it.
    pub(crate) spread: Symmetric,
    /// `sum l_i h_i (I - u_i u_iᵀ) up`: the tangent part of the weight.
    pub(crate) weight: Vector,
    /// The energy `sum l_i h_i up . u_i`.
    pub(crate) value: f64,
}

/// First damping after a correction that failed, over the gap: it holds the turn of a bar below the
/// square root of the gap, the size at which the curvature of the spheres undoes the correction.
const FIRST_DAMPING: f64 = 0.1;

/// Factor of the damping after a failure, and its inverse after a success.
const DAMPING_FACTOR: f64 = 10.0;

/// Angle by which bars on one straight line are turned off it, alternately, rad.
const NUDGE: f64 = 0.05;

/// How often a straight chain is nudged.
const NUDGES: usize = 3;

impl ScaledChain {
    /// Sums over the bars for unit directions.
    pub(crate) fn measure(&self, u: &[Vector]) -> Moments {
        let mut pass = Pass::new();
        for (i, u) in u.iter().enumerate() {
            pass.add(self, i, *u);
        }
        pass.moments(self)
    }

    /// Move every bar by the tangent vector `step(i, u_i)`, back on its sphere, and measure.
    pub(crate) fn moved(
        &self,
        from: &[Vector],
        mut step: impl FnMut(usize, Vector) -> Vector,
    ) -> Shape {
        let mut pass = Pass::new();
        let u = from
            .iter()
            .enumerate()
            .map(|(i, &u)| {
                let v = along(u, 1.0, step(i, u));
                // 1 <= |v|² = 1 + |step|²: no division by zero.
                let v = scaled(1.0 / norm(v), v);
                pass.add(self, i, v);
                v
            })
            .collect();
        Shape { u, moments: pass.moments(self) }
    }

    /// Close the chain: Gauss-Newton with damping on half the squared gap, over the directions,
    /// each correction the least one in the metric `sum l_i |du_i|²`.
    ///
    /// The only directions at which the squared gap is stationary and not zero are those on one
    /// straight line along the gap. None of them is a local minimum for a chain that can close:
    /// a second derivative without negative directions would need (all but one of) the bars to
    /// point against the gap, and then the anchors were out of reach. So from almost every seed the
    /// descent ends closed; a straight seed is nudged off its line first.
    ///
    /// `Err` carries the gap that is left and the corrections made.
    pub(crate) fn close(
        &self,
        mut shape: Shape,
        corrections: usize,
    ) -> Result<Shape, (f64, usize)> {
        let mut damping = 0.0;
        let mut nudges = 0;
        let mut gap = norm(shape.moments.gap);
        for _ in 0..corrections {
            if shape.moments.closed() {
                return Ok(shape);
            }
            let Moments { gap: r, spread, .. } = shape.moments;
            let pull = scaled(-1.0, answer(&spread, damping, r));
            let predicted = predicted_fall(&spread, damping, r, pull);
            // Bars parallel to the gap.
            if predicted <= ZERO * gap * gap && gap > SMALL_GAP {
                if nudges == NUDGES {
                    break;
                }
                nudges += 1;
                damping = 0.0;
                shape = self.nudged(&shape.u);
                gap = norm(shape.moments.gap);
                continue;
            }
            let trial = self.moved(&shape.u, |_, u| tangent(u, pull));
            let left = norm(trial.moments.gap);
            if !left.is_finite() {
                return Err((gap, corrections));
            }
            let finer =
                gap <= SMALL_GAP && trial.moments.parts() <= PROGRESS * shape.moments.parts();
            if finer || gap * gap - left * left >= FAIR_PART * predicted {
                (shape, gap) = (trial, left);
                damping =
                    if damping > gap * FIRST_DAMPING { damping / DAMPING_FACTOR } else { 0.0 };
            } else if gap <= SMALL_GAP {
                // Rounding: no correction makes it better.
                return Ok(if left < gap { trial } else { shape });
            } else {
                damping = (damping * DAMPING_FACTOR).max(FIRST_DAMPING * gap);
            }
        }
        if gap <= SMALL_GAP { Ok(shape) } else { Err((gap, corrections)) }
    }

    /// Turn the bars off their common line, every other one to the other side, each one around the
    /// line (in space) by a golden angle more than the one before.
    fn nudged(&self, u: &[Vector]) -> Shape {
        self.moved(u, |i, u| {
            // In the plane of the second axis; its normal if that is where the bar points.
            let mut side = cross([0.0, 1.0, 0.0], u);
            if norm(side) < 0.5 {
                side = [1.0, 0.0, 0.0];
            }
            let size = if i % 2 == 0 { NUDGE } else { -NUDGE };
            let turned = match self.motion {
                Motion::Plane => scaled(size, side),
                Motion::Space => {
                    let (s, c) = (TAU * (1.0 - GOLDEN) * i as f64).sin_cos();
                    along(scaled(size * c, side), size * s, cross(u, side))
                }
            };
            tangent(u, turned)
        })
    }
}

impl Moments {
    /// The components of the gap as parts of their terms, the largest of them.
    fn parts(&self) -> f64 {
        let parts = self.gap.iter().zip(&self.terms).map(|(gap, terms)| gap.abs() / terms);
        // Nothing of nothing is closed.
        parts.filter(|part| !part.is_nan()).fold(0.0, f64::max)
    }

    /// Whether the gap is nothing but rounding.
    fn closed(&self) -> bool {
        self.parts() <= ROUNDING
    }
}

/// The pull that answers `rhs` in `spread`, plus damping; pseudo-inverse where the chain is
/// straight.
///
/// Eigenvalues of `spread` below [`STRAIGHT_TOLERANCE`] times the largest are zero: no pull moves the last
/// joint that way. Sums of squares of angles in a frame along the line of the bars keep their digits;
/// what is cut is what the rounding of the lengths can bend a straight chain by. Angles `a_i` take
/// `sum l_i a_i²/2` off its length, so this must be at most twice the slack of the tautest chain
/// that is a problem.
pub(crate) fn answer(spread: &Symmetric, damping: f64, rhs: Vector) -> Vector {
    let mut matrix = *spread;
    for k in 0..3 {
        matrix.entry[k][k] += damping;
    }
    let rhs: Column = [rhs[0], rhs[1], rhs[2], 0.0];
    let x = matrix.solve(rhs).unwrap_or_else(|| matrix.eigen().solve(rhs, STRAIGHT_TOLERANCE));
    [x[0], x[1], x[2]]
}

/// Fall of the squared gap if the gap were linear in the correction.
fn predicted_fall(spread: &Symmetric, damping: f64, gap: Vector, pull: Vector) -> f64 {
    if damping > 0.0 {
        // The equation of the pull leaves `-damping pull` of the gap.
        return dot(gap, gap) - damping * damping * dot(pull, pull);
    }
    let row = |k: usize| (0..3).map(|j| spread.entry[k][j] * pull[j]).sum::<f64>();
    let left: Vector = std::array::from_fn(|k| gap[k] + row(k));
    dot(gap, gap) - dot(left, left)
}

/// A gap of rounding: a sum of many directions, each rounded, may not get below [`ROUNDING`].
const SMALL_GAP: f64 = 1e-14;

/// The sums while they run.
struct Pass {
    closure: VectorSum,
    terms: Vector,
    weight: VectorSum,
    value: Sum,
    spread: [f64; 6],
}

impl Pass {
    fn new() -> Self {
        Self {
            closure: VectorSum::default(),
            terms: [0.0; 3],
            weight: VectorSum::default(),
            value: Sum::default(),
            spread: [0.0; 6],
        }
    }

    #[inline]
    fn add(&mut self, links: &ScaledChain, i: usize, u: Vector) {
        let (l, h) = (links.length[i], links.carried[i]);
        let (axis, rest) = parted(u);
        self.closure.add_to(axis, l.copysign(u[axis]));
        let rest = scaled(l, rest);
        self.closure.add(rest);
        for (terms, rest) in self.terms.iter_mut().zip(rest) {
            *terms += rest.abs();
        }
        self.weight.add(scaled(l * h, tangent(u, links.up)));
        self.value.add(l * h * dot(links.up, u));
        add_projector(&mut self.spread, l, u);
    }

    fn moments(&self, links: &ScaledChain) -> Moments {
        let mut closure = self.closure;
        for span in links.span {
            closure.add(scaled(-1.0, span));
        }
        Moments {
            gap: closure.value(),
            terms: self.terms,
            spread: unpacked(&self.spread),
            weight: self.weight.value(),
            value: self.value.value(),
        }
    }
}

/// The axis nearest to a unit vector, either way, and what the vector is less a unit step along it.
/// That keeps its digits however small it is: along the axis
/// $-(1 - \cos\alpha) = -\sin^2\alpha/(1 + \cos\alpha)$. So the closure of a chain that is drawn
/// out along an axis is a balance of small terms, its slack against what the bars lose by their
/// angles.
#[inline]
fn parted(u: Vector) -> (usize, Vector) {
    let [x, y, z] = u.map(f64::abs);
    let axis = if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    };
    let mut rest = u;
    rest[axis] = 0.0;
    rest[axis] = (dot(rest, rest) / (1.0 + u[axis].abs())).copysign(-u[axis]);
    (axis, rest)
}

/// Add `w (I - u uᵀ)` to a packed sum `[xx, yy, zz, xy, xz, yz]`. The diagonal is written as sums
/// of squares: `1 - x²` would lose what a nearly straight chain needs.
#[inline]
pub(crate) fn add_projector(packed: &mut [f64; 6], w: f64, [x, y, z]: Vector) {
    let (xx, yy, zz) = (x * x, y * y, z * z);
    packed[0] += w * (yy + zz);
    packed[1] += w * (xx + zz);
    packed[2] += w * (xx + yy);
    packed[3] -= w * x * y;
    packed[4] -= w * x * z;
    packed[5] -= w * y * z;
}

/// The matrix of a packed sum.
pub(crate) fn unpacked(packed: &[f64; 6]) -> Symmetric {
    let [xx, yy, zz, xy, xz, yz] = *packed;
    let mut matrix = Symmetric::zero(3);
    matrix.entry[0] = [xx, xy, xz, 0.0];
    matrix.entry[1] = [xy, yy, yz, 0.0];
    matrix.entry[2] = [xz, yz, zz, 0.0];
    matrix
}

#[cfg(test)]
mod tests {
    use super::*;

    fn links(motion: Motion) -> ScaledChain {
        ScaledChain {
            length: vec![0.25; 5],
            carried: vec![0.4, 0.2, 0.0, -0.2, -0.4],
            span: [[1.0, 0.0, 0.0], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion,
        }
    }

    /// No turn of bars along the gap changes it to first order; of bars across, all is predicted.
    #[test]
    fn the_fall_that_a_pull_promises() {
        let spread = |u: Vector| links(Motion::Space).measure(&[u; 5]).spread;
        let along = spread([1.0, 0.0, 0.0]);
        let gap = [0.25, 0.0, 0.0];
        assert!(predicted_fall(&along, 0.0, gap, [0.0; 3]).abs() <= 0.0);
        let across = spread([0.0, 0.0, 1.0]);
        let pull = scaled(-1.0, answer(&across, 0.0, gap));
        assert!((pull[0] + 0.2).abs() < 1e-15);
        assert!((predicted_fall(&across, 0.0, gap, pull) - 0.0625).abs() < 1e-15);
        // A damping as large as the spread leaves half of the gap.
        let pull = scaled(-1.0, answer(&across, 1.25, gap));
        assert!((predicted_fall(&across, 1.25, gap, pull) - 0.75 * 0.0625).abs() < 1e-15);
        let half = [-0.1, 0.0, 0.0];
        assert!((predicted_fall(&across, 0.0, gap, half) - 0.75 * 0.0625).abs() < 1e-15);
    }

    /// Bars on a line, the third axis among them, all turn off it by the same angle, to both sides;
    /// in space each in a plane of its own.
    #[test]
    fn nudged_bars_leave_their_line() {
        for u in [[1.0, 0.0, 0.0], [0.6, 0.0, -0.8], [0.0, 1.0, 0.0]] {
            for motion in [Motion::Plane, Motion::Space] {
                let shape = links(motion).nudged(&[u; 5]);
                let parts: Vec<Vector> =
                    shape.u.iter().map(|v| along(*v, -dot(*v, u), u)).collect();
                for (v, part) in shape.u.iter().zip(&parts) {
                    assert!((norm(*part) / dot(*v, u) - NUDGE).abs() < 1e-15);
                }
                let turned = (TAU * GOLDEN).cos();
                for (k, pair) in parts.windows(2).enumerate() {
                    let cosine = dot(pair[0], pair[1]) / (norm(pair[0]) * norm(pair[1]));
                    let expected = if motion == Motion::Plane { -1.0 } else { -turned };
                    assert!((cosine - expected).abs() < 1e-12, "{u:?} {k}");
                }
            }
        }
    }

    /// From bars on one line the chain closes, to rounding and with the length of its bars.
    #[test]
    fn straight_seeds_close() {
        for motion in [Motion::Plane, Motion::Space] {
            for u in [[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.6, 0.0, 0.8]] {
                let links = links(motion);
                let moments = links.measure(&[u; 5]);
                let closed = links.close(Shape { u: vec![u; 5], moments }, 60).unwrap();
                let sum = closed.u.iter().fold([0.0; 3], |sum, u| along(sum, 0.25, *u));
                assert!(norm(along(sum, -1.0, [1.0, 0.0, 0.0])) < 1e-14);
                assert!(closed.u.iter().all(|u| (norm(*u) - 1.0).abs() < 1e-15));
            }
        }
        let links = ScaledChain { span: [[1.3, 0.0, 0.0], [0.0; 3]], ..links(Motion::Space) };
        let u = vec![[0.0, 0.0, 1.0]; 5];
        let moments = links.measure(&u);
        // Out of reach by 0.05.
        let (left, _) = links.close(Shape { u, moments }, 200).unwrap_err();
        assert!((left - 0.05).abs() < 1e-6);
    }
}
