//! Second derivative of the energy along the closed chains.

use std::sync::Arc;

use model::{STRAIGHT_TOLERANCE, Vector};

use crate::run::closure::{Shape, add_projector, unpacked};
use crate::run::scaled_chain::ScaledChain;
use crate::run::settings::Motion;
use crate::run::slope::Slope;
use crate::run::symmetric::{Column, MOST, Symmetric};
use crate::thresholds::{BISECTIONS, GRADIENT_PART};
use crate::vector::{along, cross, dot, norm, scaled, tangent};

/// The Hessian of the Lagrangian on the motions that keep the chain closed.
///
/// Each bar adds its axial force `N_i` times the identity of its tangent plane (metric
/// `sum l_i |du_i|²`): the Hessian is diagonal, and the closure adds three rows. Eliminating the
/// bars from
///
/// ```text
/// [ l (N + s)   Jᵀ ] [ du ]   [ -l t ]
/// [    J        0  ] [ nu ] = [   0  ]      J = [ l_1 P_1 ... l_n P_n ],  P_i = I - u_i u_iᵀ
/// ```
///
/// leaves the matrix `S = sum l_i / (N_i + s) P_i` of size three. One pass over the bars builds it
/// for any shift `s`, and by Sylvester's law the number of eigenvalues below `-s` is the number
/// of negative `N_i + s` (twice, in space) plus the number of positive eigenvalues of `S` less
/// three.
///
/// About anchors on one vertical the whole chain turns freely. This motion is no direction of the
/// minimisation; it is taken out by a fourth row, `sum l_i du_i . (up × u_i) = 0`.
#[derive(Debug, Clone)]
pub(crate) struct Curvature {
    pub(crate) links: Arc<ScaledChain>,
    pub(crate) shape: Arc<Shape>,
    pub(crate) slope: Arc<Slope>,
}

/// What the elimination of the bars leaves.
#[derive(Debug, Clone, Copy)]
struct Schur {
    matrix: Symmetric,
    /// `sum l_i / (N_i + s) t_i`, and the same along the turn.
    rhs: Column,
    /// Negative ones among the diagonal entries `N_i + s`, with multiplicity.
    negative: usize,
}

/// A Newton step, as three (or four) numbers: the directions follow bar by bar.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Step {
    pull: Vector,
    turn: f64,
    pub(crate) shift: f64,
}

impl Curvature {
    /// Rows of the closure in the motions considered.
    fn rows(&self) -> usize {
        match self.links.motion {
            Motion::Plane => 2,
            Motion::Space if self.turns() => 4,
            Motion::Space => 3,
        }
    }

    /// Whether the free turn has to be taken out; a chain on the axis of the turn does not change.
    fn turns(&self) -> bool {
        self.links.turns() && self.slope.line.is_none()
    }

    /// Tangent directions per bar.
    fn freedom(&self) -> usize {
        match self.links.motion {
            Motion::Plane => 1,
            Motion::Space => 2,
        }
    }

    /// Pick the rows of the motion from sums in three coordinates and along the turn.
    fn pick(&self, packed: &[f64; 6], turn: &[f64; 4]) -> Symmetric {
        let mut matrix = match self.rows() {
            2 => {
                let mut matrix = Symmetric::zero(2);
                matrix.entry[0] = [packed[0], packed[4], 0.0, 0.0];
                matrix.entry[1] = [packed[4], packed[2], 0.0, 0.0];
                matrix
            }
            3 => unpacked(packed),
            _ => {
                let mut matrix = unpacked(packed);
                matrix.size = MOST;
                matrix.entry[3] = *turn;
                for (k, &t) in turn.iter().enumerate() {
                    matrix.entry[k][3] = t;
                }
                matrix
            }
        };
        if let Some(line) = self.slope.line {
            matrix.without(self.pick_column(line, 0.0));
        }
        matrix
    }

    /// Pick the rows of a column in the same way.
    fn pick_column(&self, v: Vector, turn: f64) -> Column {
        match self.rows() {
            2 => [v[0], v[2], 0.0, 0.0],
            3 => [v[0], v[1], v[2], 0.0],
            _ => [v[0], v[1], v[2], turn],
        }
    }

    /// The inverse of [`Curvature::pick_column`].
    fn spread_column(&self, x: Column) -> (Vector, f64) {
        match self.rows() {
            2 => ([x[0], 0.0, x[1]], 0.0),
            3 => ([x[0], x[1], x[2]], 0.0),
            _ => ([x[0], x[1], x[2]], x[3]),
        }
    }

    /// The matrix `sum w_i [P_i, xi_i; xi_iᵀ, |xi_i|²]` for weights by bar.
    fn gram(&self, weight: impl Fn(usize) -> f64) -> Symmetric {
        let mut packed = [0.0; 6];
        let mut turn = [0.0; MOST];
        let turns = self.turns();
        for (i, &u) in self.shape.u.iter().enumerate() {
            let w = weight(i);
            add_projector(&mut packed, w, u);
            if turns {
                let xi = cross(self.links.up, u);
                for k in 0..3 {
                    turn[k] += w * xi[k];
                }
                turn[3] += w * dot(xi, xi);
            }
        }
        self.pick(&packed, &turn)
    }

    fn schur(&self, shift: f64) -> Schur {
        let links = &*self.links;
        let (axial, multiplier) = (&self.slope.axial, self.slope.multiplier);
        let mut packed = [0.0; 6];
        let mut turn = [0.0; MOST];
        let mut rhs = [0.0; 3];
        let mut turn_rhs = 0.0;
        let mut negative = 0;
        let turns = self.turns();
        for (i, &u) in self.shape.u.iter().enumerate() {
            let stiffness = axial[i] + shift;
            let w = links.length[i] / stiffness;
            let t = tangent(u, links.load(i, multiplier));
            // Zero as well: the sums are infinite then, and what is made of them is refused.
            negative += usize::from(stiffness <= 0.0);
            add_projector(&mut packed, w, u);
            rhs = along(rhs, w, t);
            if turns {
                let xi = cross(links.up, u);
                for k in 0..3 {
                    turn[k] += w * xi[k];
                }
                turn[3] += w * dot(xi, xi);
                turn_rhs += w * dot(xi, t);
            }
        }
        Schur {
            matrix: self.pick(&packed, &turn),
            rhs: self.pick_column(rhs, turn_rhs),
            negative: negative * self.freedom(),
        }
    }

    /// Independent rows among those of the closure; fewer than all only for a straight chain.
    pub(crate) fn rank(&self) -> usize {
        self.gram(|i| self.links.length[i]).eigen().signs(STRAIGHT_TOLERANCE).0
    }

    /// Independent motions that keep the chain closed, the free turn left out.
    pub(crate) fn dimension(&self) -> usize {
        (self.links.bars() * self.freedom()).saturating_sub(self.rank())
    }

    /// Number of eigenvalues below `-shift`.
    pub(crate) fn index(&self, shift: f64) -> usize {
        if shift > -self.slope.lowest {
            return 0;
        }
        let schur = self.schur(shift);
        let (positive, _) = schur.matrix.eigen().signs(STRAIGHT_TOLERANCE);
        (schur.negative + positive).saturating_sub(self.rank())
    }

    /// Number of eigenvalues of which rounding does not tell whether they are below `-shift`: bars
    /// without force that nearly lie on one line leave such.
    pub(crate) fn undecided(&self, shift: f64) -> usize {
        if shift > -self.slope.lowest {
            return 0;
        }
        let (positive, below) = self.schur(shift).matrix.eigen().signs(STRAIGHT_TOLERANCE);
        self.rank().saturating_sub(positive + below)
    }

    /// Ratio of the largest to the smallest size of an eigenvalue, those below `zero` left out.
    ///
    /// The largest is taken from the bars; the smallest is enclosed by counting, within ten per
    /// cent. Without a closure it were the smallest `|N_i|`; three rows move it past few others.
    pub(crate) fn condition(&self, zero: f64) -> f64 {
        let largest = self.slope.highest;
        if self.dimension() == 0 || largest <= zero {
            return 1.0;
        }
        let inside = |size: f64| self.index(-size) - self.index(size);
        let none = inside(zero);
        let enclosure = self.enclosure_of_smallest(zero);
        let (low, high) = enclosed(enclosure, CONDITION_PART, |size| inside(size) == none);
        largest / between(low, high)
    }

    /// Bounds for the smallest eigenvalue. Where every bar is in tension it lies between the
    /// smallest and the few next `N_i`, by interlacing: each row of the closure moves it past one.
    fn enclosure_of_smallest(&self, zero: f64) -> (f64, f64) {
        let largest = self.slope.highest;
        if self.slope.lowest <= zero {
            return (zero, largest);
        }
        let passed = self.rows() / self.freedom();
        let mut least = vec![largest; passed + 1];
        for &n in &self.slope.axial {
            if n < least[passed] {
                least[passed] = n;
                least.sort_by(f64::total_cmp);
            }
        }
        (self.slope.lowest, least[passed].min(largest))
    }

    /// A shift for which the shifted Hessian is positive definite whatever the closure allows.
    pub(crate) fn safe_shift(&self) -> f64 {
        (-self.slope.lowest).max(0.0) + GRADIENT_PART * self.slope.mean
    }

    /// The Newton step of the shifted Hessian, `None` if that is not positive definite.
    pub(crate) fn step(&self, shift: f64) -> Option<Step> {
        let Schur { matrix, rhs, negative } = self.schur(shift);
        let minus = rhs.map(|x| -x);
        let solution = if negative == 0 {
            // S is positive semidefinite, and singular only for a straight chain: no motion changes
            // its closure along its line, and that row is left out.
            let regular = if self.slope.line.is_some() { None } else { matrix.solve(minus) };
            regular.unwrap_or_else(|| matrix.eigen().solve(minus, STRAIGHT_TOLERANCE))
        } else {
            let eigen = matrix.eigen();
            let (positive, below) = eigen.signs(STRAIGHT_TOLERANCE);
            let rank = self.rank();
            if negative + positive != rank || positive + below != rank {
                return None;
            }
            eigen.solve(minus, STRAIGHT_TOLERANCE)
        };
        let (pull, turn) = self.spread_column(solution);
        (solution.iter().all(|x| x.is_finite())).then_some(Step { pull, turn, shift })
    }

    /// The turn of bar `i` in a step.
    #[inline]
    pub(crate) fn turn_of(&self, step: &Step, i: usize, u: Vector) -> Vector {
        let a = along(self.links.load(i, self.slope.multiplier), 1.0, step.pull);
        let mut t = tangent(u, a);
        if self.turns() {
            t = along(t, step.turn, cross(self.links.up, u));
        }
        scaled(-1.0 / (self.slope.axial[i] + step.shift), t)
    }

    /// The answer `(H + shift)⁻¹ f` within the closed motions, for tangent vectors `f`.
    fn respond(&self, shift: f64, f: &[Vector]) -> Vec<Vector> {
        let links = &*self.links;
        let weight = |i: usize| links.length[i] / (self.slope.axial[i] + shift);
        let matrix = self.gram(weight);
        let (mut rhs, mut turn_rhs) = ([0.0; 3], 0.0);
        for (i, &f) in f.iter().enumerate() {
            rhs = along(rhs, weight(i), f);
            turn_rhs += weight(i) * dot(f, cross(links.up, self.shape.u[i]));
        }
        let x = matrix.eigen().solve(self.pick_column(rhs, turn_rhs), STRAIGHT_TOLERANCE);
        let (pull, turn) = self.spread_column(x);
        f.iter()
            .zip(&self.shape.u)
            .enumerate()
            .map(|(i, (&f, &u))| {
                let mut t = along(f, -1.0, tangent(u, pull));
                if self.turns() {
                    t = along(t, -turn, cross(links.up, u));
                }
                scaled(1.0 / (self.slope.axial[i] + shift), t)
            })
            .collect()
    }

    /// A motion in which the energy falls fastest (to second order), largest turn of a bar 1; with
    /// its curvature. `None` if the curvature is nowhere below `-threshold`.
    ///
    /// The lowest eigenvalue is enclosed by counting signs, its vector found by inverse iteration.
    pub(crate) fn falling(&self, threshold: f64) -> Option<(Vec<Vector>, f64)> {
        if self.index(threshold) == 0 {
            return None;
        }
        // All N_i + high are positive.
        let high = (1.0 + ENCLOSURE) * -self.slope.lowest;
        let (_, high) = enclosed((threshold, high), ENCLOSURE, |shift| self.index(shift) > 0);
        let mut mode: Vec<Vector> = (0..self.links.bars()).map(|i| self.start_of_mode(i)).collect();
        for _ in 0..INVERSE_ITERATIONS {
            mode = self.respond((1.0 + ENCLOSURE) * high, &mode);
            let largest = mode.iter().fold(0.0_f64, |m, v| m.max(norm(*v)));
            if !(largest.is_finite() && largest > 0.0) {
                return None;
            }
            for v in &mut mode {
                *v = scaled(1.0 / largest, *v);
            }
        }
        let (mut curvature, mut size) = (0.0, 0.0);
        for (i, v) in mode.iter().enumerate() {
            let square = self.links.length[i] * dot(*v, *v);
            curvature += self.slope.axial[i] * square;
            size += square;
        }
        (curvature < 0.0).then_some((mode, curvature / size))
    }

    /// A tangent vector for each bar without any symmetry that the lowest mode could be blind to.
    fn start_of_mode(&self, i: usize) -> Vector {
        // Fractional parts of multiples of square roots are equidistributed and never repeat.
        let k = (i + 1) as f64;
        let part = |root: f64| (k * root).fract() - 0.5;
        let mut v = [part(2.0_f64.sqrt()), part(3.0_f64.sqrt()), part(5.0_f64.sqrt())];
        if self.links.motion == Motion::Plane {
            v[1] = 0.0;
        }
        tangent(self.shape.u[i], v)
    }
}

/// The geometric mean, of numbers whose product may be less or more than any double too.
fn between(low: f64, high: f64) -> f64 {
    low.sqrt() * high.sqrt()
}

/// Bounds drawn together until they differ by this part: sizes for which `below` holds are less
/// than what is enclosed.
fn enclosed(bounds: (f64, f64), part: f64, below: impl Fn(f64) -> bool) -> (f64, f64) {
    let (mut low, mut high) = bounds;
    // Eighteen bring any two positive doubles that near.
    for _ in 0..BISECTIONS {
        if high <= (1.0 + part) * low {
            break;
        }
        let middle = between(low, high);
        if below(middle) { low = middle } else { high = middle }
    }
    (low, high)
}

/// How closely the smallest eigenvalue is enclosed for the condition, relative.
const CONDITION_PART: f64 = 0.2;

/// How closely the lowest eigenvalue is enclosed, relative.
const ENCLOSURE: f64 = 0.02;

/// Each one multiplies the part along the lowest mode by the ratio of the shifted eigenvalues,
/// about `1 / ENCLOSURE`.
const INVERSE_ITERATIONS: usize = 4;

#[cfg(test)]
impl Curvature {
    /// The Riemannian Hessian times a closed motion.
    pub(crate) fn apply(&self, motion: &[Vector]) -> Vec<Vector> {
        let links = &*self.links;
        let mut sum = [0.0; 3];
        for (i, &v) in motion.iter().enumerate() {
            sum = along(sum, links.length[i] * self.slope.axial[i], v);
        }
        let pull = crate::run::closure::answer(&self.shape.moments.spread, 0.0, sum);
        let rows = motion.iter().zip(&self.shape.u).zip(&self.slope.axial);
        rows.map(|((&v, &u), axial)| along(scaled(*axial, v), -1.0, tangent(u, pull))).collect()
    }
}

#[cfg(test)]
mod tests;
