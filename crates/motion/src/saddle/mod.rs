//! The linear system of every step: inertia bordered by the constraints.
//!
//! $$ \begin{bmatrix} M & R^T \\\\ R & 0 \end{bmatrix}
//!    \begin{bmatrix} x \\\\ \rho \end{bmatrix} = \begin{bmatrix} f \\\\ \varphi \end{bmatrix} $$
//!
//! `M` has one number for each joint and each member, the same for all three axes; `R` has for each
//! rigid bar the row `(−d, +d)` with `d` the vector from its first to its second joint, for a rope
//! the sum of such rows over its spans, and for each support of a slider its normal. Since the inverse of `M` is full, nothing is eliminated
//! onto the rows alone.

mod forest;
mod orthogonal;
mod sparse;

use model::Vector;

use crate::error::{MotionError, Result};
use crate::mechanism::{Link, Mechanism};
use forest::Forest;
use sparse::Sparse;

/// What the elimination needs to know.
#[derive(Debug, Clone)]
pub(crate) struct Layout {
    /// Diagonal of `M` by slot that moves.
    pub mass: Vec<f64>,
    /// Spans between two slots that move.
    pub edges: Vec<Edge>,
    /// Parts of rows that only one slot that moves has.
    pub own: Vec<OwnRow>,
}

/// A span between two slots that move.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Edge {
    pub a: usize,
    pub b: usize,
    /// `M` between the two.
    pub between: f64,
    /// Its row and its vector, if it is rigid: two equal numbers but for ropes.
    pub row: Option<[usize; 2]>,
}

/// A part of a row that only one slot has: `sign` times a vector.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OwnRow {
    pub slot: usize,
    /// The row and the vector.
    pub row: [usize; 2],
    pub sign: f64,
}

/// No factorisation: the slot where it fails, and the pivot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Singular {
    pub slot: usize,
    pub pivot: f64,
}

impl Layout {
    /// The layout of a mechanism with inertia on and between its joints.
    pub(crate) fn new(mechanism: &Mechanism) -> Self {
        let moving = mechanism.moving;
        let mut found =
            Self { mass: mechanism.mass[..moving].to_vec(), edges: Vec::new(), own: Vec::new() };
        let rigid = mechanism.bars.iter().enumerate();
        let mut rows = rigid.flat_map(|(row, bar)| bar.spans.clone().map(move |span| [row, span]));
        for &Link { a, b, inertia, .. } in &mechanism.spans {
            let row = rows.next();
            match (a < moving, b < moving, row) {
                (true, true, _) => {
                    found.edges.push(Edge { a, b, between: inertia.between, row });
                }
                (true, false, Some(row)) => found.own.push(OwnRow { slot: a, row, sign: -1.0 }),
                (false, true, Some(row)) => found.own.push(OwnRow { slot: b, row, sign: 1.0 }),
                _ => {}
            }
        }
        for (k, slide) in mechanism.slides.iter().enumerate() {
            let row = [mechanism.bars.len() + k, mechanism.rigid_spans() + k];
            found.own.push(OwnRow { slot: slide.slot, row, sign: 1.0 });
        }
        found
    }

    fn rows(&self) -> usize {
        let of_edges = self.edges.iter().filter_map(|edge| edge.row);
        let rows = of_edges.chain(self.own.iter().map(|own| own.row));
        rows.map(|[row, _]| row + 1).max().unwrap_or(0)
    }
}

/// The factorised system.
#[derive(Debug, Clone)]
pub(crate) enum Saddle {
    Forest(Forest),
    Sparse(Sparse),
}

impl Saddle {
    /// Prepare the elimination of a mechanism.
    /// [`MotionError::Massless`] where `M` itself is singular, [`MotionError::Memory`].
    pub(crate) fn new(mechanism: &Mechanism) -> Result<Self> {
        // Without rows the same elimination tells whether every joint has inertia of its own.
        Self::inertia(mechanism)?;
        Self::of(&Layout::new(mechanism), mechanism.is_forest)
    }

    /// The matrix `M` alone, factorised.
    /// [`MotionError::Massless`] where it is singular, [`MotionError::Memory`].
    pub(crate) fn inertia(mechanism: &Mechanism) -> Result<Self> {
        let Layout { mass, mut edges, .. } = Layout::new(mechanism);
        for edge in &mut edges {
            edge.row = None;
        }
        let bare = Layout { mass, edges, own: Vec::new() };
        let mut found = Self::of(&bare, mechanism.is_forest)?;
        found.factor(&[]).map_err(|failed| {
            // A pivot that is no number is one of nothing, as one below zero is.
            let inertia_kg = failed.pivot.max(0.0);
            MotionError::Massless { joint: mechanism.name(failed.slot), inertia_kg }
        })?;
        Ok(found)
    }

    fn of(layout: &Layout, is_forest: bool) -> Result<Self> {
        if is_forest {
            return Ok(Self::Forest(Forest::new(layout)));
        }
        let lost = MotionError::Memory { joints: layout.mass.len() };
        Sparse::new(layout).map(Self::Sparse).ok_or(lost)
    }

    /// Factors for the given vectors of the rows.
    pub(crate) fn factor(&mut self, vectors: &[Vector]) -> Result<(), Singular> {
        match self {
            Self::Forest(forest) => forest.factor(vectors),
            Self::Sparse(sparse) => sparse.factor(vectors),
        }
    }

    /// Solve in place. `x` has a vector for each slot that moves, `rows` a number for each row.
    pub(crate) fn solve(&mut self, x: &mut [Vector], rows: &mut [f64]) {
        match self {
            Self::Forest(forest) => forest.solve(x, rows),
            Self::Sparse(sparse) => sparse.solve(x, rows),
        }
    }
}

#[cfg(test)]
mod tests;
