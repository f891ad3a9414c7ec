//! The bottom bar in compression, all others in tension.
//!
//! Bar k, of length l, is too long for the gap $G$ between the straight strands and pushes them
//! apart. Let $u = (\cos\varphi, \sin\varphi)$ be its direction and $\varrho$ its compression:
//! $q = -\varrho u$. At every other bar $F_i = b_i e_z - \varrho u$, and the horizontal closure is
//!
//! $$ -\varrho\cos\varphi \sum_{i \ne k} \frac{l_i}{|F_i|} + l\cos\varphi - D_h = 0. $$
//!
//! The sum over all bars of $1/\tau_i = s_i l_i/|F_i|$ is then $-D_h/(\varrho\cos\varphi)$. For
//! $\cos\varphi > 0$ it is not positive, so the stress matrix is positive semidefinite and the
//! equilibrium is a global minimum of the energy; for $D_h > 0$ it is even definite, and the
//! minimum unique. So there is exactly one root with $\cos\varphi > 0$, and to find it is to have
//! proved it the lowest. (A negative $\cos\varphi$ is the higher equilibrium on the other side,
//! with the pull towards the other anchor.)
//!
//! Newton's method in $(\ln\varrho, \varphi)$, with one equation divided by $\cos\varphi$, which
//! removes the false root of vertical anchors, q vertical. If it fails: for given $\varphi$ the
//! closure along u falls as $\varrho$ grows (the tension of the others is convex), so one search
//! gives $\varrho(\varphi)$, and the closure across u, negative near $-\pi/2$ and positive near
//! $\pi/2$, changes its sign only at the root: another search gives $\varphi$.
//!
//! For a nearly straight chain all this happens in the axes of its line, and the angle counts from
//! it.

use super::axis::Axis;
use super::bracket::Bracket;
use super::newton::{Budget, MARGIN, Root, within_a_few_passes};
use super::system::{Closure, Frame, System};
use crate::thresholds::SHORTEST;

/// Largest change of the logarithm of the compression in one step.
const LARGEST_LOG_STEP: f64 = 2.0;

/// The equations of a chain with a bar in compression, and where to start.
#[derive(Debug, Clone, Copy)]
pub(super) struct Strut<'a> {
    /// Bars, and the axes in which forces are written.
    pub system: System<'a>,
    /// The bar at angle 0 points along the first axis (+1) or against it (-1).
    pub side: f64,
    /// Horizontal unit vector, from the start towards the end anchor.
    pub level: [f64; 2],
    /// Angles at which the bar points straight down and straight up.
    pub between: Bracket,
    /// Angle of the line from the start to the end anchor.
    pub line: f64,
    /// Angle to start from.
    pub angle: f64,
    /// A load typical of the bars next to the bottom.
    pub load: f64,
    /// The largest load.
    pub largest_load: f64,
}

/// Compression and direction of the bottom bar.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// $\varrho$
    size: f64,
    /// Angle of the bar.
    angle: f64,
}

/// The closure at a point and its derivatives by $\ln\varrho$ and the angle.
struct Equations {
    closure: Closure,
    force: [f64; 2],
    /// u
    along: [f64; 2],
    /// t, u turned by a right angle.
    across: [f64; 2],
    by_log: [f64; 2],
    by_angle: [f64; 2],
    /// $\cos\varphi$ and its derivative.
    cosine: f64,
    cosine_by_angle: f64,
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

impl Strut<'_> {
    /// The same problem, given in upright axes, in other ones.
    #[must_use]
    pub fn along(&self, axis: &Axis) -> Self {
        let [h, z] = axis.bar();
        // Straight down and straight up, and whether the bar would hang below the axis if it hung
        // loose.
        let (low, high) = (-h.atan2(-z), h.atan2(z));
        let below = self.angle < z.atan2(h);
        let below = if axis.tilt < high.min(-low) { below } else { -low > high };
        Self {
            system: System { frame: axis.frame, ..self.system },
            side: axis.side,
            level: axis.enter(self.level),
            between: Bracket { low, high },
            line: self.line - z.atan2(h),
            angle: if below { -axis.tilt } else { axis.tilt },
            ..*self
        }
    }

    /// Find the equilibrium. `None` when the passes ran out, or rounding errors prevent a closure
    /// within the budget.
    pub fn solve(&self, budget: &mut Budget) -> Option<Root> {
        let direct = within_a_few_passes(budget, |few| {
            let log = self.compression(self.angle, self.load.ln(), few)?;
            self.newton(Point { size: log.exp(), angle: self.angle }, few)
        });
        direct.or_else(|| {
            let start = self.nested(budget)?;
            within_a_few_passes(budget, |few| self.newton(start, few))
        })
    }

    fn equations(&self, at: Point) -> Equations {
        let (sin, cos) = at.angle.sin_cos();
        let size = at.size;
        let bar = [self.side * cos, self.side * sin];
        let force = bar.map(|u| -size * u);
        let across = [-bar[1], bar[0]];
        let (cosine, cosine_by_angle) = (dot(bar, self.level), dot(across, self.level));
        let closure = self.system.closure(force);
        let [a, b, c] = closure.jacobian;
        // dq = -size (u dlog + t dangle); the derivative holds the turn of the bar itself, too.
        let derivative = |v: [f64; 2]| [-size * dot([a, b], v), -size * dot([b, c], v)];
        let (by_log, by_angle) = (derivative(bar), derivative(across));
        Equations { closure, force, along: bar, across, by_log, by_angle, cosine, cosine_by_angle }
    }

    /// Newton's method with the step shortened until the equations, in units of their rounding
    /// errors, are nearer to zero.
    fn newton(&self, start: Point, budget: &mut Budget) -> Option<Root> {
        let (mut at, mut here) = (start, self.equations(start));
        budget.spend();
        // The equation that vanishes for a vertical bar between vertical anchors.
        let turning = match self.system.frame {
            Frame::Upright { .. } => 0,
            Frame::Aligned { .. } => 1,
        };
        let first = here.cosine;
        let norm = |e: &Equations, floor: [f64; 2]| {
            let mut units = [e.closure.residual[0] / floor[0], e.closure.residual[1] / floor[1]];
            units[turning] *= first / e.cosine;
            units[0].hypot(units[1])
        };
        loop {
            let root = Root { force: here.force, closure: here.closure, contraction: 0.0 };
            let size = here.closure.size();
            if size <= 1.0 {
                return Some(root);
            }
            let enough = budget.closure;
            let settled = || self.system.settled(&here.closure, enough).then_some(root);
            let [r, s] = here.closure.residual;
            let (by_log, mut by_angle) = (here.by_log, here.by_angle);
            // Derivatives of r/cos times cos.
            by_angle[turning] -=
                here.closure.residual[turning] * here.cosine_by_angle / here.cosine;
            let determinant = by_log[0] * by_angle[1] - by_angle[0] * by_log[1];
            let log = (by_angle[0] * s - by_angle[1] * r) / determinant;
            let angle = (by_log[1] * r - by_log[0] * s) / determinant;
            if !(log.is_finite() && angle.is_finite()) {
                return settled();
            }
            let Bracket { low, high } = self.between;
            let room = (1.0 - MARGIN) * if angle > 0.0 { high - at.angle } else { at.angle - low };
            let mut part = 1.0_f64.min(LARGEST_LOG_STEP / log.abs()).min(room / angle.abs());
            let floor = here.closure.floor;
            let before = norm(&here, floor);
            loop {
                if part < SHORTEST || !budget.spend() {
                    return settled();
                }
                let trial =
                    Point { size: at.size * (part * log).exp(), angle: at.angle + part * angle };
                let there = self.equations(trial);
                if norm(&there, floor) < before {
                    (at, here) = (trial, there);
                    break;
                }
                part *= 0.5;
            }
        }
    }

    /// $\ln\varrho$ that closes the chain along the bar for a given direction; `None` when none
    /// does.
    fn compression(&self, angle: f64, start: f64, budget: &mut Budget) -> Option<f64> {
        // Where the loads would be rounding beside the compression the other bars do not reach: the direction is too far
        // from the line of the anchors.
        let limit = (self.largest_load / f64::EPSILON).ln();
        Bracket::LINE.root(start, 1.0, 1.0, |log| {
            if !budget.spend() {
                return None;
            }
            let e = self.equations(Point { size: log.min(limit).exp(), angle });
            let floor = dot(e.closure.floor, e.along.map(f64::abs));
            // Falling: handed over with the other sign.
            let (value, slope) = (dot(e.closure.residual, e.along), dot(e.by_log, e.along));
            (value <= 0.0 || log < limit).then_some((-value / floor, -slope / floor))
        })
    }

    fn nested(&self, budget: &mut Budget) -> Option<Point> {
        let mut log = self.load.ln();
        let angle = self.between.root(self.angle, 1.0, 1.0, |angle| {
            let Some(found) = self.compression(angle, log, budget) else {
                // Out of reach: the root lies towards the line of the anchors.
                let out = if angle > self.line { f64::MAX } else { -f64::MAX };
                return (budget.spent < budget.limit).then_some((out, 0.0));
            };
            log = found;
            let e = self.equations(Point { size: log.exp(), angle });
            let floor = dot(e.closure.floor, e.across.map(f64::abs));
            let residual = e.closure.residual;
            // Across the bar, and how it changes while the closure along the bar is kept.
            let value = dot(residual, e.across);
            let along_by_angle = dot(e.by_angle, e.along) + value;
            let across_by_angle = dot(e.by_angle, e.across) - dot(residual, e.along);
            let kept = dot(e.by_log, e.across) * along_by_angle / dot(e.by_log, e.along);
            let slope = across_by_angle - kept - value * e.cosine_by_angle / e.cosine;
            Some((value / floor, slope / floor))
        })?;
        Some(Point { size: log.exp(), angle })
    }
}
