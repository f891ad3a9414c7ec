//! Elimination where every loop runs through an anchor: chains, trees, spiders. O(n), no fill.
//!
//! Joints are eliminated from the leaves to the root. A joint *p* is eliminated together with the
//! rows that are complete with it: those of the bars to its children *c*, of bars to anchors, of
//! its support. With `A` its 3 × 3 inertia, `W` the columns of its rows and `S` what the children
//! left on them,
//!
//! $$ \begin{bmatrix} A & W \\\\ W^T & -S \end{bmatrix}, \quad T = S + W^T A^{-1} W, \quad
//!    H = A^{-1} W T^{-1}, \quad P = A^{-1} - H T H^T , $$
//!
//! and its parent gets, with `b` the inertia between them and `d` the vector of the bar towards the
//! parent,
//!
//! $$ A_q \leftarrow A_q - b^2 P, \qquad w = d + b P d, \qquad s = d^T P d . $$
//!
//! A row is eliminated after both of its joints, so `T` is positive definite wherever the
//! constraints are independent; no pivoting is needed.

use model::Vector;

use super::orthogonal::eliminate;
use super::{Layout, Singular};
use numerics::vector::{add_times, dot, times};

/// Symmetric 3 × 3 matrix: xx, xy, xz, yy, yz, zz.
pub(super) type Symmetric = [f64; 6];

/// Least pivot of `T`, relative to its diagonal before elimination: below it is rounding.
const LEAST_PIVOT: f64 = 1e-14;

/// Least relative pivot of `T` up to which products serve at a joint with a parent: they have lost
/// four digits of what that gets, the square of the pivot.
const CLOSE_PIVOT: f64 = 1e-2;

/// The same at a root, which hands nothing on: half of the digits, and less than the pivot of a
/// closed chain of 10^5 bars, which falls with their number.
const CLOSE_ROOT: f64 = 1e-7;

/// Where the bar of a joint towards its parent leads.
#[derive(Debug, Clone, Copy)]
struct Up {
    parent: usize,
    /// Inertia between the two, kg.
    between: f64,
    /// Place among the rows in order of elimination, and the row itself; none for a spring.
    place: Option<usize>,
    row: usize,
    /// `+1` if the row is `+d` at the parent.
    sign: f64,
}

/// A row that is complete with a joint that has no child on it.
#[derive(Debug, Clone, Copy)]
struct Own {
    place: usize,
    row: usize,
    sign: f64,
}

#[derive(Debug, Clone)]
pub(crate) struct Forest {
    up: Vec<Option<Up>>,
    /// Rows of joint p: `rows[first[p]..first[p + 1]]`.
    first: Vec<usize>,
    rows: Vec<usize>,
    /// Where the m × m matrix of joint p begins.
    square: Vec<usize>,
    own: Vec<Own>,
    mass: Vec<f64>,
    // The factors.
    p: Vec<Symmetric>,
    h: Vec<Vector>,
    t_inverse: Vec<f64>,
    to_parent: Vec<Vector>,
    // What children left.
    a: Vec<Symmetric>,
    w: Vec<Vector>,
    s: Vec<f64>,
    /// Whether rows nearly depend on each other.
    is_close: bool,
}

impl Forest {
    pub(super) fn new(layout: &Layout) -> Self {
        let n = layout.mass.len();
        let rows = layout.rows();
        let mut complete_at: Vec<Vec<usize>> = vec![Vec::new(); n];
        let mut up: Vec<Option<Up>> = vec![None; n];
        for edge in &layout.edges {
            let (child, parent) = (edge.a.min(edge.b), edge.a.max(edge.b));
            if let Some([row, _]) = edge.row {
                complete_at[parent].push(row);
            }
            let sign = if parent == edge.b { 1.0 } else { -1.0 };
            // Without ropes a row has the number of its vector.
            let row = edge.row.map_or(usize::MAX, |[row, _]| row);
            let place = edge.row.map(|_| 0);
            up[child] = Some(Up { parent, between: edge.between, place, row, sign });
        }
        for own in &layout.own {
            complete_at[own.slot].push(own.row[0]);
        }
        let mut begin = vec![0];
        let mut square = vec![0];
        let mut place_of = vec![0; rows];
        let mut in_order = Vec::with_capacity(rows);
        for list in &complete_at {
            for &row in list {
                place_of[row] = in_order.len();
                in_order.push(row);
            }
            begin.push(in_order.len());
            square.push(square[square.len() - 1] + list.len() * list.len());
        }
        for up in up.iter_mut().flatten() {
            up.place = up.place.map(|_| place_of[up.row]);
        }
        let own = layout.own.iter();
        let own = own.map(|o| (o.row[0], o.sign));
        let own = own.map(|(row, sign)| Own { place: place_of[row], row, sign }).collect();
        let squares = square[n];
        Self {
            up,
            first: begin,
            rows: in_order,
            square,
            own,
            mass: layout.mass.clone(),
            p: vec![[0.0; 6]; n],
            h: vec![[0.0; 3]; rows],
            t_inverse: vec![0.0; squares],
            to_parent: vec![[0.0; 3]; n],
            a: vec![[0.0; 6]; n],
            w: vec![[0.0; 3]; rows],
            s: vec![0.0; rows],
            is_close: false,
        }
    }

    /// Factors for the given vectors of the rows (`+d` at the second joint of a bar, the normal of
    /// a support).
    pub(super) fn factor(&mut self, vectors: &[Vector]) -> Result<(), Singular> {
        self.is_close = false;
        let factored = self.by_products(vectors);
        if factored.is_err() || self.is_close {
            return self.by_reflections(vectors);
        }
        Ok(())
    }

    /// What all joints begin with.
    fn begin(&mut self, vectors: &[Vector]) {
        for (a, &m) in self.a.iter_mut().zip(&self.mass) {
            *a = [m, 0.0, 0.0, m, 0.0, m];
        }
        for own in &self.own {
            self.w[own.place] = times(own.sign, vectors[own.row]);
            self.s[own.place] = 0.0;
        }
    }

    /// Factors where rows nearly depend on each other: positions at which bars are about to lie on
    /// one taut line.
    fn by_reflections(&mut self, vectors: &[Vector]) -> Result<(), Singular> {
        self.begin(vectors);
        for slot in 0..self.p.len() {
            let (first, end) = (self.first[slot], self.first[slot + 1]);
            // The roots of what children left.
            let (w, roots) = (&self.w[first..end], &self.s[first..end]);
            let found =
                eliminate(self.a[slot], w, roots).map_err(|pivot| Singular { slot, pivot })?;
            self.p[slot] = found.p();
            self.h[first..end].copy_from_slice(&found.h);
            let square = self.square[slot]..self.square[slot + 1];
            self.t_inverse[square].copy_from_slice(&found.t_inverse);
            self.hand_up(slot, vectors);
            if let Some(Up { place: Some(place), .. }) = self.up[slot] {
                self.s[place] = found.root(self.to_parent[slot]);
            }
        }
        Ok(())
    }

    fn by_products(&mut self, vectors: &[Vector]) -> Result<(), Singular> {
        self.begin(vectors);
        for slot in 0..self.p.len() {
            let inverse = inverse(self.a[slot]).map_err(|pivot| Singular { slot, pivot })?;
            let (first, end) = (self.first[slot], self.first[slot + 1]);
            self.p[slot] = match end - first {
                0 => inverse,
                1 => self.one_row(slot, inverse)?,
                _ => self.rows_of(slot, inverse)?,
            };
            self.hand_up(slot, vectors);
        }
        Ok(())
    }

    /// What the parent gets from an eliminated joint.
    #[inline]
    fn hand_up(&mut self, slot: usize, vectors: &[Vector]) {
        let Some(up) = self.up[slot] else { return };
        let p = self.p[slot];
        let b = up.between;
        for (a, p) in self.a[up.parent].iter_mut().zip(p) {
            *a -= b * b * p;
        }
        if let Some(place) = up.place {
            let d = times(up.sign, vectors[up.row]);
            let pd = product(p, d);
            self.to_parent[slot] = d;
            self.w[place] = add_times(d, b, pd);
            self.s[place] = dot(d, pd);
        }
    }

    fn one_row(&mut self, slot: usize, inverse: Symmetric) -> Result<Symmetric, Singular> {
        let place = self.first[slot];
        let w = self.w[place];
        let g = product(inverse, w);
        let t = self.s[place] + dot(w, g);
        if t.is_nan() || t <= 0.0 {
            return Err(Singular { slot, pivot: t });
        }
        let h = times(1.0 / t, g);
        self.t_inverse[self.square[slot]] = 1.0 / t;
        self.h[place] = h;
        Ok(without(inverse, h, g))
    }

    fn rows_of(&mut self, slot: usize, inverse: Symmetric) -> Result<Symmetric, Singular> {
        let (first, end) = (self.first[slot], self.first[slot + 1]);
        let m = end - first;
        let g: Vec<Vector> = self.w[first..end].iter().map(|&w| product(inverse, w)).collect();
        let t = &mut self.t_inverse[self.square[slot]..self.square[slot + 1]];
        for i in 0..m {
            for j in 0..m {
                t[i * m + j] = dot(self.w[first + i], g[j]);
            }
            t[i * m + i] += self.s[first + i];
        }
        let pivot = invert(t, m).map_err(|pivot| Singular { slot, pivot })?;
        let close = if self.up[slot].is_some() { CLOSE_PIVOT } else { CLOSE_ROOT };
        self.is_close |= pivot < close;
        let mut p = inverse;
        for i in 0..m {
            let mut h = [0.0; 3];
            for j in 0..m {
                h = add_times(h, t[i * m + j], g[j]);
            }
            self.h[first + i] = h;
            p = without(p, h, g[i]);
        }
        Ok(p)
    }

    /// Solve in place: forces become displacements, right-hand sides of rows their multipliers.
    pub(super) fn solve(&self, x: &mut [Vector], rows: &mut [f64]) {
        let mut small = Vec::new();
        for slot in 0..self.p.len() {
            let (first, end) = (self.first[slot], self.first[slot + 1]);
            let f = x[slot];
            let mut z = product(self.p[slot], f);
            if end == first + 1 {
                let (h, row) = (self.h[first], self.rows[first]);
                let right = rows[row];
                z = add_times(z, right, h);
                rows[row] = dot(h, f) - self.t_inverse[self.square[slot]] * right;
            } else if end > first {
                let m = end - first;
                small.clear();
                small.extend(self.rows[first..end].iter().map(|&row| rows[row]));
                let t = &self.t_inverse[self.square[slot]..self.square[slot + 1]];
                for i in 0..m {
                    let h = self.h[first + i];
                    z = add_times(z, small[i], h);
                    let line = &t[i * m..(i + 1) * m];
                    let sum: f64 = line.iter().zip(&small).map(|(t, right)| t * right).sum();
                    rows[self.rows[first + i]] = dot(h, f) - sum;
                }
            }
            x[slot] = z;
            if let Some(up) = self.up[slot] {
                x[up.parent] = add_times(x[up.parent], -up.between, z);
                if up.place.is_some() {
                    rows[up.row] += dot(self.to_parent[slot], z);
                }
            }
        }
        for slot in (0..self.p.len()).rev() {
            let Some(up) = self.up[slot] else { continue };
            let mut u = times(-up.between, x[up.parent]);
            if up.place.is_some() {
                u = add_times(u, rows[up.row], self.to_parent[slot]);
            }
            x[slot] = add_times(x[slot], 1.0, product(self.p[slot], u));
            for place in self.first[slot]..self.first[slot + 1] {
                rows[self.rows[place]] += dot(self.h[place], u);
            }
        }
    }
}

#[inline]
fn product(m: Symmetric, v: Vector) -> Vector {
    [
        m[0] * v[0] + m[1] * v[1] + m[2] * v[2],
        m[1] * v[0] + m[3] * v[1] + m[4] * v[2],
        m[2] * v[0] + m[4] * v[1] + m[5] * v[2],
    ]
}

/// `m − h gᵀ`, which is symmetric.
#[inline]
fn without(m: Symmetric, h: Vector, g: Vector) -> Symmetric {
    [
        m[0] - h[0] * g[0],
        m[1] - h[0] * g[1],
        m[2] - h[0] * g[2],
        m[3] - h[1] * g[1],
        m[4] - h[1] * g[2],
        m[5] - h[2] * g[2],
    ]
}

/// Inverse of a positive definite matrix by its cofactors; the pivot that fails otherwise.
#[inline]
fn inverse(m: Symmetric) -> Result<Symmetric, f64> {
    let [xx, xy, xz, yy, yz, zz] = m;
    let c = [yy * zz - yz * yz, xz * yz - xy * zz, xy * yz - xz * yy];
    let determinant = xx * c[0] + xy * c[1] + xz * c[2];
    if determinant.is_nan() || determinant <= 0.0 || xx <= 0.0 {
        return Err(determinant);
    }
    let r = 1.0 / determinant;
    Ok([
        c[0] * r,
        c[1] * r,
        c[2] * r,
        (xx * zz - xz * xz) * r,
        (xy * xz - xx * yz) * r,
        (xx * yy - xy * xy) * r,
    ])
}

/// Invert a symmetric positive definite m × m matrix in place (Gauss-Jordan without pivoting); the
/// least relative pivot, or that which fails.
fn invert(t: &mut [f64], m: usize) -> Result<f64, f64> {
    let diagonal: Vec<f64> = (0..m).map(|k| t[k * m + k]).collect();
    let mut least = 1.0_f64;
    for k in 0..m {
        let pivot = t[k * m + k];
        least = least.min(pivot / diagonal[k]);
        if pivot.is_nan() || pivot <= LEAST_PIVOT * diagonal[k] {
            return Err(if diagonal[k] > 0.0 { pivot / diagonal[k] } else { 0.0 });
        }
        let r = 1.0 / pivot;
        t[k * m + k] = 1.0;
        for j in 0..m {
            t[k * m + j] *= r;
        }
        for i in (0..m).filter(|&i| i != k) {
            let factor = t[i * m + k];
            t[i * m + k] = 0.0;
            for j in 0..m {
                t[i * m + j] -= factor * t[k * m + j];
            }
        }
    }
    Ok(least)
}

#[cfg(test)]
mod tests {
    use super::invert;

    /// What a refusal says of a joint without inertia and of one whose rows depend on each other; the
    /// inverse of a matrix by hand.
    #[test]
    fn pivots_that_vanish_are_zero() {
        assert_eq!(invert(&mut [0.0; 4], 2), Err(0.0));
        assert_eq!(invert(&mut [4.0, 2.0, 2.0, 1.0], 2), Err(0.0));
        let mut matrix = [4.0, 2.0, 2.0, 1.25];
        assert_eq!(invert(&mut matrix, 2), Ok(0.2));
        for (found, wanted) in matrix.into_iter().zip([1.25, -2.0, -2.0, 4.0_f64]) {
            assert_eq!(found.to_bits(), wanted.to_bits(), "{matrix:?}");
        }
    }
}
