//! The condensed equations in the plane: two closure equations for the force in the bottom bar.
//!
//! $$ r(q) = \sum_i s_i\\,l_i\\,\frac{q + b_i e_z}{|q + b_i e_z|} - D = 0. $$
//!
//! Signs are +1 except for one effective bar: the bottom group, whose longest bar is compressed, is
//! a bar of length `strut` with the sign -1. The derivative of r is symmetric,
//! $\sum (s_i l_i/|F_i|)(1 - u_i u_i^T)$; without a compressed bar r is the gradient of the convex
//! $\Phi$ (module `bottom`).

use super::kernel::{Bars, aligned, upright, versine_of};
use super::parallel::Workers;
use crate::larger::larger;
use crate::thresholds::{CLOSURE_ROUNDING, SLACK_ROUNDINGS};

/// Axes in which the closure is written.
#[derive(Debug, Clone, Copy)]
pub(super) enum Frame {
    /// Horizontal and vertical.
    Upright {
        /// Horizontal distance of the anchors.
        across: f64,
        /// Height of the end anchor above the start.
        rise: f64,
    },
    /// Along and across an axis to which most bars are nearly parallel: the closure along it is a
    /// balance of small terms, $\sum s_i l_i (1 - |\cos\alpha_i|) = $ slack.
    Aligned {
        /// Components of the upward vertical.
        up: [f64; 2],
        /// What straight bars reach along the axis too far.
        slack: f64,
        /// Way that the bars have to go across the axis.
        aside: f64,
        /// Whether the forces of each part point along the axis (+1) or against it (-1).
        sides: [f64; 2],
        /// The same for the compressed bar.
        strut_side: f64,
    },
}

/// Bars in tension, at most one effective bar in compression, and where they must lead.
#[derive(Debug, Clone, Copy)]
pub(super) struct System<'a> {
    /// Bars in tension.
    pub parts: [Bars<'a>; 2],
    /// Length of the compressed bar, whose load is 0; without one, 0.
    pub strut: f64,
    pub frame: Frame,
    /// Total length: the scale of the closure.
    pub total_length: f64,
    /// The threads that add up.
    pub workers: Workers,
}

/// The closure for some force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Closure {
    /// `r`
    pub residual: [f64; 2],
    /// Its symmetric derivative: 11, 12, 22.
    pub jacobian: [f64; 3],
    /// Rounding errors to be expected in the residual.
    pub floor: [f64; 2],
}

impl System<'_> {
    /// Whether an iteration that gets no further may stop here: the chain closes to `enough`, in
    /// units of its total length, and a slack is met to many of its digits.
    pub fn settled(&self, closure: &Closure, enough: f64) -> bool {
        let [r, s] = closure.residual;
        let met = match self.frame {
            Frame::Upright { .. } => true,
            Frame::Aligned { .. } => closure.size() <= SLACK_ROUNDINGS,
        };
        met && r.hypot(s) <= enough * self.total_length
    }

    /// One pass over the bars.
    pub fn closure(&self, q: [f64; 2]) -> Closure {
        match self.frame {
            Frame::Upright { across, rise } => {
                let sums = upright(&self.parts, q[0], q[1], self.workers);
                let (strut, stiff) = self.strut_terms(q);
                let residual =
                    [q[0] * sums.inverse + strut[0] - across, sums.rise + strut[1] - rise];
                let jacobian = [
                    sums.cube_zz + stiff[0],
                    stiff[1] - q[0] * sums.cube_z,
                    q[0] * q[0] * sums.cube + stiff[2],
                ];
                // Where the pull is small, so are the horizontal terms.
                let width = (q[0] * sums.inverse).abs() + strut[0].abs() + across;
                let floor = [CLOSURE_ROUNDING * width, CLOSURE_ROUNDING * self.total_length];
                Closure { residual, jacobian, floor }
            }
            Frame::Aligned { up, slack, aside, sides, strut_side } => {
                let [a, b] = [0, 1].map(|k| aligned(self.parts[k], q, up, sides[k]));
                let (strut, stiff) = self.strut_terms(q);
                let versine = if self.strut > 0.0 {
                    // The bar points against its force.
                    let (cosine, sine) = (-strut[0] / self.strut, -strut[1] / self.strut);
                    strut_side * self.strut * versine_of(strut_side * cosine, sine)
                } else {
                    0.0
                };
                let bent = a.versine + b.versine + versine.abs();
                let along = slack - sides[0] * a.versine - sides[1] * b.versine + versine;
                Closure {
                    residual: [along, a.sine + b.sine + strut[1] - aside],
                    jacobian: [
                        a.pp + b.pp + stiff[0],
                        a.pq + b.pq + stiff[1],
                        a.qq + b.qq + stiff[2],
                    ],
                    floor: [
                        CLOSURE_ROUNDING * (slack.abs() + bent),
                        // By Cauchy's inequality a bound of the sines.
                        CLOSURE_ROUNDING * ((2.0 * bent * self.total_length).sqrt() + aside.abs()),
                    ],
                }
            }
        }
    }

    /// Vector of the compressed bar, and its part of the derivative.
    fn strut_terms(&self, q: [f64; 2]) -> ([f64; 2], [f64; 3]) {
        if self.strut <= 0.0 {
            return ([0.0; 2], [0.0; 3]);
        }
        let size = q[0].hypot(q[1]);
        let (x, z) = (q[0] / size, q[1] / size);
        let stiff = -self.strut / size;
        ([-self.strut * x, -self.strut * z], [stiff * z * z, -stiff * x * z, stiff * x * x])
    }
}

impl Closure {
    /// The residual in units of its rounding error.
    pub fn size(&self) -> f64 {
        let [a, b] = [0, 1].map(|k| (self.residual[k] / self.floor[k]).abs());
        larger(a, b)
    }

    /// Condition of the derivative of a chain in tension, by its trace and determinant, within a
    /// factor 2.
    pub fn condition(&self) -> f64 {
        let [a, b, c] = self.jacobian;
        (a + c) * (a + c) / (a * c - b * b)
    }

    /// How far the force may be from the true one: what the derivative makes of the residual, or of
    /// its rounding errors where they are larger.
    pub fn force_error(&self) -> f64 {
        let [a, b, c] = self.jacobian.map(f64::abs);
        let [r, s] = [0, 1].map(|k| self.residual[k].abs().max(self.floor[k]));
        // The determinant over the larger diagonal entry, by elimination as in a step.
        let (pivot, rest) = if a >= c {
            (a, self.jacobian[2] - self.jacobian[1] / self.jacobian[0] * self.jacobian[1])
        } else {
            (c, self.jacobian[0] - self.jacobian[1] / self.jacobian[2] * self.jacobian[1])
        };
        let over = 1.0 / (pivot * rest.abs());
        ((c * r + b * s) * over).hypot((b * r + a * s) * over)
    }

    /// Newton's step; `None` when the derivative is singular to working precision.
    pub fn step(&self) -> Option<[f64; 2]> {
        let [a, b, c] = self.jacobian;
        // Elimination with the larger diagonal entry as pivot keeps the digits of a stretched
        // matrix, which the determinant would lose.
        // A residual that is but rounding would move a force that hardly acts far astray.
        let [r, s] = [0, 1]
            .map(|k| if self.residual[k].abs() <= self.floor[k] { 0.0 } else { self.residual[k] });
        let step = if a.abs() >= c.abs() {
            let y = (b / a * r - s) / (c - b / a * b);
            [-(r + b * y) / a, y]
        } else {
            let x = (b / c * s - r) / (a - b / c * b);
            [x, -(s + b * x) / c]
        };
        step.iter().all(|x| x.is_finite()).then_some(step)
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use super::*;

    /// Steps of the central differences, in units of the force: their error is about the square.
    const STEP: f64 = 1e-5;
    /// Worst measured: 3e-10 of the largest entry.
    const DIFFERENCES: f64 = 1e-8;

    /// The inverse of (2, -1; -1, 5) is (5, 1; 1, 2)/9: of residuals of 0.3 and 0.2 the force is off by (1.7, 0.7)/9.
    #[test]
    fn forces_are_off_by_the_inverse_of_the_residual() {
        for (jacobian, residual, floor) in [
            ([2.0, -1.0, 5.0], [-0.3, 0.1], [0.05, 0.2]),
            ([5.0, -1.0, 2.0], [0.0, 0.3], [0.2, 0.1]),
        ] {
            let found = Closure { residual, jacobian, floor }.force_error();
            assert!((9.0 * found - 1.7_f64.hypot(0.7)).abs() < 1e-14, "{found}");
        }
    }

    /// Between half of the ratio of the eigenvalues 9 and 1 and twice that.
    #[test]
    fn condition_is_that_of_the_eigenvalues() {
        for (sin, cos) in [(0.0, 1.0), (0.6, 0.8), (-0.8, 0.6)] {
            let (a, c) = (9.0 * cos * cos + sin * sin, 9.0 * sin * sin + cos * cos);
            let jacobian = [a, 8.0 * sin * cos, c];
            let closure = Closure { residual: [0.0; 2], floor: [1.0; 2], jacobian };
            // Trace 10, determinant 9.
            assert!((closure.condition() - 100.0 / 9.0).abs() < 1e-12);
        }
    }

    /// The derivative of the closure agrees with central differences, in both frames, with a bar
    /// in compression and without.
    #[test]
    fn derivative_of_the_closure_is_that_of_differences() {
        let lengths = [0.7, 1.2, 0.5, 0.9, 1.1];
        let loads = [-1.9, -0.8, 0.0, 0.7, 1.6];
        let bars =
            |from: usize, to: usize| Bars { lengths: &lengths[from..to], loads: &loads[from..to] };
        let upright = Frame::Upright { across: 2.0, rise: -0.3 };
        let (sin, cos) = 0.4_f64.sin_cos();
        let (up, sides) = ([sin, cos], [-1.0, 1.0]);
        let aligned = Frame::Aligned { up, slack: 0.3, aside: 0.1, sides, strut_side: 1.0 };
        for frame in [upright, aligned] {
            for strut in [0.0, 0.6] {
                let system = System {
                    parts: [bars(0, 2), bars(2, 5)],
                    strut,
                    frame,
                    total_length: 4.4,
                    workers: Workers::new(NonZeroUsize::MIN, 5),
                };
                for k in 0..50 {
                    let k = f64::from(k);
                    let force = [3.0 + k.sin(), (1.7 * k).cos() * 2.0];
                    let [a, b, c] = system.closure(force).jacobian;
                    let by = |column: usize| {
                        let at = |sign: f64| {
                            let mut there = force;
                            there[column] += sign * STEP;
                            system.closure(there).residual
                        };
                        let (ahead, behind) = (at(1.0), at(-1.0));
                        [0, 1].map(|row| (ahead[row] - behind[row]) / (2.0 * STEP))
                    };
                    let size = a.abs().max(b.abs()).max(c.abs());
                    for (got, expected) in [a, b, b, c].iter().zip([by(0), by(1)].concat()) {
                        assert!((got - expected).abs() < DIFFERENCES * size, "{got} {expected}");
                    }
                }
            }
        }
    }
}
