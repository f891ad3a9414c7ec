//! Seeds that the iteration does not bring to an end: by the signs of their bars.
//!
//! In an equilibrium every bar is parallel to its force, $u_i = s_i F_i/|F_i|$ with $s_i = +1$ in
//! tension and $-1$ in compression, so that for given signs two equations in two unknowns are left,
//!
//! $$ r(p) = \sum_i s_i l_i F_i/|F_i| - D = 0, \qquad F_i = p + c_i e_z. $$
//!
//! The signs are those of the closed shape nearest to the seed $u_i^0$, which maximises
//! $\sum l_i u_i \cdot u_i^0$: its bars are parallel to $u_i^0 + \mu$, and the multiplier μ is the
//! minimum of the convex function $\sum l_i |u_i^0 + \mu| - \mu \cdot D$. Where the equations have
//! no root with these signs that Newton's method finds, the bars that are compressed least go over
//! to tension, some at a time. With all bars in tension r is the derivative of a convex function,
//! and a chain whose lowest bar can hang has a root. Every pass over the bars is O(n), and there
//! are some hundreds.

use super::lanes::Lanes;
use super::numbers::Bar;
use crate::full::multipliers::REGULARISATION;
use crate::thresholds::{EARNED, SEEN, SHORTEST};

/// Passes for the closed shape: a seed needs no more digits than they give.
const CLOSING_PASSES: usize = 25;
/// Passes for one pattern of signs.
const PATTERN_PASSES: usize = 40;
/// Of the compressed bars one, and this part of them, go over to tension at a time.
const PART: usize = 8;
/// Damping at first, in units of the residual; its growth after a step that led away and decrease
/// after a good one.
const DAMPING: f64 = 1e-2;
const GROWTH: f64 = 8.0;

/// One bar of a seed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Signed {
    /// Direction: of the seed, then of the closed shape.
    u: [f64; 2],
    /// Axial force in the closed shape.
    axial: f64,
    /// The sign in the pattern.
    sign: f64,
}

/// An equilibrium: the pull on the first anchor; the directions stand with the bars.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Root {
    pub pull: [f64; 2],
    /// Passes over the bars.
    pub passes: usize,
}

/// A chain and the bars of one seed, in memory that goes from seed to seed.
#[derive(Debug)]
pub(crate) struct Signs<'a> {
    bars: &'a [Bar],
    span: [f64; 2],
    /// The closure counts as met at this, in total lengths.
    tolerance: f64,
    shape: Vec<Signed>,
    compressed: Vec<usize>,
    passes: usize,
}

/// Residual of two equations and their symmetric derivative: 11, 12, 22.
struct Equations {
    residual: [f64; 2],
    jacobian: [f64; 3],
}

impl<'a> Signs<'a> {
    pub fn new(bars: &'a [Bar], span: [f64; 2], tolerance: f64) -> Self {
        let shape = Vec::with_capacity(bars.len());
        Self { bars, span, tolerance, shape, compressed: Vec::new(), passes: 0 }
    }

    /// Solve a seed with at most `limit` passes and put the directions of the bars into
    /// `directions`.
    pub fn solve(
        &mut self,
        angles: &[f64],
        limit: usize,
        directions: &mut [[f64; 2]],
    ) -> Option<Root> {
        self.passes = 0;
        self.shape.clear();
        self.shape.extend(angles.iter().map(|angle| {
            let (sin, cos) = Lanes::all(*angle).sin_cos();
            Signed { u: [sin.0[0], -cos.0[0]], axial: 0.0, sign: 1.0 }
        }));
        self.close();
        let start = self.estimate();
        for (at, bar) in self.shape.iter_mut().zip(self.bars) {
            at.axial = at.u[0] * start[0] + at.u[1] * (start[1] + bar.carried);
            at.sign = if at.axial < 0.0 { -1.0 } else { 1.0 };
        }
        let shape = &self.shape;
        self.compressed.clear();
        self.compressed.extend((0..shape.len()).filter(|k| shape[*k].sign < 0.0));
        // The most compressed first, so that the least is at the end.
        self.compressed.sort_by(|a, b| shape[*a].axial.total_cmp(&shape[*b].axial));
        while self.passes < limit {
            if let Some(pull) = self.root(start) {
                self.write(pull, directions);
                return Some(Root { pull, passes: self.passes });
            }
            let kept = self.compressed.len().checked_sub(1 + self.compressed.len() / PART)?;
            for k in self.compressed.drain(kept..) {
                self.shape[k].sign = 1.0;
            }
        }
        None
    }

    /// Turn the bars into the closed shape nearest to them.
    fn close(&mut self) {
        let mut multiplier = [0.0; 2];
        for _ in 0..CLOSING_PASSES {
            let here = self.gap(multiplier);
            if size(here.residual) <= SEEN {
                break;
            }
            let [a, b, d] = here.jacobian;
            let step = solve(
                [a + REGULARISATION, b, d + REGULARISATION],
                [-here.residual[0], -here.residual[1]],
            );
            let slope = here.residual[0] * step[0] + here.residual[1] * step[1];
            let value = self.stretch(multiplier);
            let mut part = 1.0;
            loop {
                let trial = [multiplier[0] + part * step[0], multiplier[1] + part * step[1]];
                if self.stretch(trial) <= value + EARNED * part * slope || part < SHORTEST {
                    multiplier = trial;
                    break;
                }
                part *= 0.5;
            }
        }
        for at in &mut self.shape {
            let u = [at.u[0] + multiplier[0], at.u[1] + multiplier[1]];
            let length = size(u).max(f64::MIN_POSITIVE);
            at.u = u.map(|x| x / length);
        }
    }

    /// $\sum l_i |u_i^0 + \mu| - \mu \cdot D$.
    fn stretch(&mut self, multiplier: [f64; 2]) -> f64 {
        self.passes += 1;
        let work = multiplier[0] * self.span[0] + multiplier[1] * self.span[1];
        let bars = self.shape.iter().zip(self.bars);
        let lengths = bars
            .map(|(at, bar)| bar.length * size([at.u[0] + multiplier[0], at.u[1] + multiplier[1]]));
        lengths.sum::<f64>() - work
    }

    /// Its derivatives.
    fn gap(&mut self, multiplier: [f64; 2]) -> Equations {
        self.passes += 1;
        let bars = self.shape.iter().zip(self.bars);
        let vectors =
            bars.map(|(at, bar)| (bar.length, [at.u[0] + multiplier[0], at.u[1] + multiplier[1]]));
        Equations::of(vectors, self.span)
    }

    /// The closure for a pull and the pattern of signs.
    fn closure(&mut self, pull: [f64; 2]) -> Equations {
        self.passes += 1;
        let bars = self.shape.iter().zip(self.bars);
        let forces = bars.map(|(at, bar)| (at.sign * bar.length, [pull[0], pull[1] + bar.carried]));
        Equations::of(forces, self.span)
    }

    /// The pull for which the moments on the closed shape are least, with a faint preference for
    /// equal reactions of the anchors.
    fn estimate(&mut self) -> [f64; 2] {
        self.passes += 1;
        let (mut matrix, mut right) =
            ([REGULARISATION, 0.0, REGULARISATION], [0.0, -0.5 * REGULARISATION]);
        for (at, bar) in self.shape.iter().zip(self.bars) {
            let t = [-at.u[1], at.u[0]];
            let along = [bar.length * t[0], bar.length * t[1]];
            matrix[0] += along[0] * t[0];
            matrix[1] += along[0] * t[1];
            matrix[2] += along[1] * t[1];
            right[0] -= along[0] * t[1] * bar.carried;
            right[1] -= along[1] * t[1] * bar.carried;
        }
        solve(matrix, right)
    }

    /// A root of the closure with the signs as they are, by Levenberg's and Marquardt's method.
    fn root(&mut self, start: [f64; 2]) -> Option<[f64; 2]> {
        let (mut pull, mut damping) = (start, DAMPING);
        let mut here = self.closure(pull);
        for _ in 0..PATTERN_PASSES {
            let norm = size(here.residual);
            let [a, b, d] = here.jacobian;
            let [r, s] = here.residual;
            let shift = damping * norm * (a * a + 2.0 * b * b + d * d);
            let normal = [a * a + b * b + shift, a * b + b * d, b * b + d * d + shift];
            let step = solve(normal, [-(a * r + b * s), -(b * r + d * s)]);
            let trial = [pull[0] + step[0], pull[1] + step[1]];
            let there = self.closure(trial);
            let met = norm <= self.tolerance;
            // Once the closure is met, steps are for the last digits only.
            if size(there.residual) < if met { 0.5 * norm } else { norm } {
                (pull, here) = (trial, there);
                damping /= GROWTH;
            } else if met {
                return Some(pull);
            } else {
                damping *= GROWTH;
            }
        }
        (size(here.residual) <= self.tolerance).then_some(pull)
    }

    fn write(&self, pull: [f64; 2], directions: &mut [[f64; 2]]) {
        for ((u, at), bar) in directions.iter_mut().zip(&self.shape).zip(self.bars) {
            let force = [pull[0], pull[1] + bar.carried];
            let scale = at.sign / size(force).max(f64::MIN_POSITIVE);
            *u = force.map(|x| x * scale);
        }
    }
}

impl Equations {
    /// $\sum w_i v_i/|v_i| - D$ and its derivative by a vector that is added to all $v_i$.
    fn of(vectors: impl Iterator<Item = (f64, [f64; 2])>, span: [f64; 2]) -> Self {
        let (mut residual, mut jacobian) = ([-span[0], -span[1]], [0.0; 3]);
        for (weight, vector) in vectors {
            let length = size(vector).max(f64::MIN_POSITIVE);
            let u = [vector[0] / length, vector[1] / length];
            let stiff = weight / length;
            residual[0] += weight * u[0];
            residual[1] += weight * u[1];
            jacobian[0] += stiff * u[1] * u[1];
            jacobian[1] -= stiff * u[0] * u[1];
            jacobian[2] += stiff * u[0] * u[0];
        }
        Self { residual, jacobian }
    }
}

/// Length of a vector; numbers of order one, so that no library function is needed.
fn size([x, y]: [f64; 2]) -> f64 {
    (x * x + y * y).sqrt()
}

/// Solution of the symmetric system with the matrix `[[a, b], [b, d]]`.
fn solve([a, b, d]: [f64; 3], [x, y]: [f64; 2]) -> [f64; 2] {
    let inverse = 1.0 / (a * d - b * b);
    [(d * x - b * y) * inverse, (a * y - b * x) * inverse]
}

#[cfg(test)]
mod tests;
