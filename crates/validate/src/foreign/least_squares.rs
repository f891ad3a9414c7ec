//! Least squares of a sparse equilibrium matrix under bounds of the unknowns.
//!
//! Minimise $\\tfrac12 |A x + f|^2$ for $l \\le x \\le u$, where a column of $A$ is $\\pm u_e$ at
//! the two ends of a member, and at each joint of a rope the sum of that over its spans there. Bertsekas's projected Newton method: unknowns at a bound that the
//! gradient pushes outwards go there or stay, the others take a Newton step, and the path is bent at the
//! bounds. With the slope $s = A_F^T r$ the step is
//! $$ p = -(A_F^T A_F + \\varepsilon I)^{-1} s
//!      = -\\frac1\\varepsilon \\big(s - A_F^T (A_F A_F^T + \\varepsilon I)^{-1} A_F s\\big) , $$
//! so that the matrix to factorise is that of the joints, sparse whatever the number of members in a
//! joint. The ridge $\\varepsilon$ makes it definite where forces are indeterminate; repeated steps
//! remove what it leaves. The shorter $-A_F^T (A_F A_F^T + \\varepsilon I)^{-1} r$ is the same, but its
//! rounding is that of $r$ over $\\varepsilon$ where no forces balance $r$, this one's that of $s$.
//!
//! # References
//!
//! D. P. Bertsekas, SIAM J. Control Optim. 20 (1982) 221-246, doi:10.1137/0320018.

use matrices::sparse::{Entries, Ldlt, Pivots, minimum_degree};
use model::{Vector, sum};

use numerics::vector::{dot, norm, plus, times};

/// The ridge, in units of the diagonal (a member adds 1 to each end): its square root is far above
/// the rounding, and itself far below what changes a residual.
const RIDGE: f64 = 1e-9;
/// Steps before the method gives up. Nets of 10,000 cables, a fifth of them slack, take some ten.
const STEPS: usize = 200;
/// Halvings of a step.
const HALVINGS: usize = 40;
/// The band of unknowns that count as at a bound, at most, in units of the loads.
const BAND: f64 = 1e-3;
/// Full steps at the end, at most: each leaves of the slope what the ridge is of an eigenvalue.
const POLISHES: usize = 5;
/// Part of the descent promised by the gradient that a step must bring (Armijo).
const DESCENT: f64 = 1e-4;
/// A step that lowers the objective by less than this part of it, or of the squared loads'
/// rounding, is the last.
const PROGRESS: f64 = 1e-13;

/// A column: each joint of a member once, with its pull there when its force is 1.
#[derive(Debug, Clone)]
pub(super) struct Column {
    pub(super) pulls: Vec<(usize, Vector)>,
    pub(super) lower: f64,
    pub(super) upper: f64,
}

/// The problem: columns, and for each joint its load and what of a force counts there.
pub(super) struct Problem<'a> {
    pub(super) columns: &'a [Column],
    pub(super) loads: &'a [Vector],
    /// The part of a force along the motions that the support of a joint leaves free.
    pub(super) free: &'a dyn Fn(usize, Vector) -> Vector,
}

/// What was found.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub(super) x: Vec<f64>,
    /// What is left over at each joint.
    pub(super) left: Vec<Vector>,
    pub(super) steps: usize,
}

impl Problem<'_> {
    /// Solve, from zero brought within the bounds.
    pub(super) fn solve(&self) -> Found {
        let mut x: Vec<f64> =
            self.columns.iter().map(|c| 0.0_f64.clamp(c.lower, c.upper)).collect();
        let mut left = self.left(&x);
        let loads = size(self.loads);
        let mut steps = 0;
        while steps < STEPS {
            let before = size(&left);
            let Some((next, next_left)) = self.step(&x, &left) else { break };
            let after = size(&next_left);
            (x, left) = (next, next_left);
            steps += 1;
            if before - after <= PROGRESS * before || after <= f64::EPSILON * f64::EPSILON * loads {
                break;
            }
        }
        self.polish(&mut x, &mut left);
        Found { x, left, steps }
    }

    /// Full steps while they bring the unknowns nearer to where the slope holds them: what is left
    /// changes by rounding alone when the slope is still the root of that.
    fn polish(&self, x: &mut Vec<f64>, left: &mut Vec<Vector>) {
        for _ in 0..POLISHES {
            let Some(direction) = self.direction(x, left) else { return };
            let next = self.moved(x, &direction, 1.0);
            let next_left = self.left(&next);
            if self.pull(&next, &next_left) >= self.pull(x, left) {
                return;
            }
            (*x, *left) = (next, next_left);
        }
    }

    /// What no unknowns within their bounds and up to `at_most` can go below: for every such `z`
    /// $$ |A z + f| \\ge r \\cdot (A z + f)/|r| = |r| - s \\cdot (x - z)/|r| , \\quad s = A^T r , $$
    /// and the right side is least with every `z` at one of its ends. This needs no optimal `x`,
    /// but is near `|r|` only then.
    pub(super) fn least(&self, found: &Found, at_most: f64) -> f64 {
        let residual = size(&found.left).sqrt();
        if residual <= 0.0 {
            return 0.0;
        }
        let gains = self.columns.iter().zip(&found.x).map(|(column, x)| {
            let ends = [column.lower.max(-at_most), column.upper.min(at_most)];
            let slope = along(column, &found.left);
            ends.into_iter().map(|end| slope * (x - end)).fold(0.0, f64::max)
        });
        (residual - sum(gains) / residual).max(0.0)
    }

    /// What is left over at each joint.
    fn left(&self, x: &[f64]) -> Vec<Vector> {
        self.pulls(self.loads.to_vec(), x)
    }

    /// `A x` and what is there before.
    fn pulls(&self, mut left: Vec<Vector>, x: &[f64]) -> Vec<Vector> {
        for (column, x) in self.columns.iter().zip(x) {
            for (joint, pull) in &column.pulls {
                left[*joint] = plus(left[*joint], times(*x, *pull));
            }
        }
        self.freed(left)
    }

    /// Of a vector for each joint the parts that count.
    fn freed(&self, vectors: Vec<Vector>) -> Vec<Vector> {
        vectors.into_iter().enumerate().map(|(joint, vector)| (self.free)(joint, vector)).collect()
    }

    /// A step that lowers the objective; `None` if there is none.
    fn step(&self, x: &[f64], left: &[Vector]) -> Option<(Vec<f64>, Vec<Vector>)> {
        let direction = self.direction(x, left)?;
        let before = size(left);
        let mut step = 1.0;
        for _ in 0..HALVINGS {
            let next = self.moved(x, &direction, step);
            let change = self.columns.iter().zip(next.iter().zip(x));
            let promised = -sum(change.map(|(c, (next, x))| along(c, left) * (next - x)));
            let next_left = self.left(&next);
            let gained = 0.5 * (before - size(&next_left));
            if gained > 0.0 && gained >= DESCENT * promised {
                return Some((next, next_left));
            }
            step *= 0.5;
        }
        None
    }

    /// A step along a direction, bent at the bounds.
    fn moved(&self, x: &[f64], direction: &[f64], step: f64) -> Vec<f64> {
        let ends = self.columns.iter().zip(x).zip(direction);
        ends.map(|((c, x), d)| (x + step * d).clamp(c.lower, c.upper)).collect()
    }

    /// How far the slope would move an unknown, at most: zero at the best ones alone.
    fn pull(&self, x: &[f64], left: &[Vector]) -> f64 {
        let downhill: Vec<f64> = self.columns.iter().map(|c| -along(c, left)).collect();
        let changes = self.moved(x, &downhill, 1.0).into_iter().zip(x);
        changes.map(|(next, x)| (next - x).abs()).fold(0.0, f64::max)
    }

    /// Newton's direction for the unknowns that move, and downhill for those at a bound.
    fn direction(&self, x: &[f64], left: &[Vector]) -> Option<Vec<f64>> {
        // Bertsekas's band: what is this near to a bound and pushed to it counts as at the bound,
        // or ever shorter steps would be taken towards it.
        let band = self.pull(x, left).min(BAND * size(self.loads).sqrt());
        let slope: Vec<f64> = self.columns.iter().map(|c| along(c, left)).collect();
        let pushes = |k: usize| {
            let Column { lower, upper, .. } = &self.columns[k];
            (x[k] <= lower + band && slope[k] > 0.0) || (x[k] >= upper - band && slope[k] < 0.0)
        };
        let moving: Vec<bool> = (0..x.len()).map(|k| !pushes(k)).collect();
        let held = |k: usize| if moving[k] { slope[k] } else { 0.0 };
        let held: Vec<f64> = (0..x.len()).map(held).collect();
        let moves = self.newton(&moving, &self.pulls(vec![[0.0; 3]; left.len()], &held))?;
        let newton = |k: usize| (along(&self.columns[k], &moves) - slope[k]) / RIDGE;
        Some((0..x.len()).map(|k| if moving[k] { newton(k) } else { -slope[k] }).collect())
    }

    /// `(A_F A_Fᵀ + ε I)⁻¹ v`, a vector for each joint.
    ///
    /// Across what a support leaves free the matrix has the ridge alone, which magnifies rounding a
    /// billion times: without the projection of what is found that would become part of the step.
    fn newton(&self, moving: &[bool], vectors: &[Vector]) -> Option<Vec<Vector>> {
        let size = 3 * vectors.len();
        let mut entries = Vec::with_capacity(15 * moving.len() + size);
        entries.extend((0..size).map(|k| (k, k, RIDGE)));
        for (column, _) in self.columns.iter().zip(moving).filter(|(_, moving)| **moving) {
            let free =
                column.pulls.iter().map(|(joint, pull)| (*joint, (self.free)(*joint, *pull)));
            let free: Vec<(usize, Vector)> = free.collect();
            let pairs =
                free.iter().flat_map(|first| free.iter().map(move |second| (first, second)));
            for ((j, u), (k, v)) in pairs.filter(|(first, second)| first.0 >= second.0) {
                let pairs = (0..3).flat_map(|a| (0..3).map(move |b| (3 * j + a, 3 * k + b)));
                entries.extend(
                    pairs
                        .filter(|(row, column)| row >= column)
                        .map(|(row, column)| (row, column, u[row % 3] * v[column % 3])),
                );
            }
        }
        let matrix = Entries::new(size, &entries);
        let order = minimum_degree(&matrix.starts, &matrix.rows)?;
        let mut factor = Ldlt::new(&matrix.starts, &matrix.rows, &order)?;
        if !factor.factorise(&matrix.values, Pivots::Positive) {
            return None;
        }
        let mut solved: Vec<f64> = vectors.iter().flatten().copied().collect();
        factor.solve(&mut solved);
        let moves =
            (0..vectors.len()).map(|j| [solved[3 * j], solved[3 * j + 1], solved[3 * j + 2]]);
        Some(self.freed(moves.collect()))
    }
}

/// A column times a vector for each joint.
fn along(column: &Column, vectors: &[Vector]) -> f64 {
    sum(column.pulls.iter().map(|(joint, pull)| dot(*pull, vectors[*joint])))
}

/// Sum of the squares.
fn size(left: &[Vector]) -> f64 {
    sum(left.iter().map(|left| norm(*left).powi(2)))
}
