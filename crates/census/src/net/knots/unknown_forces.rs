//! Forces that are not known: those of inextensible links between knots, and the tensions of swings that
//! may lie straight, as unknowns of the linear balance of the knots.
//!
//! Over a box of places the balance is $C\\,t + g = 0$ with a matrix C of intervals. With Y near the
//! left inverse of its middle, $t = -Y g + (I - Y C)\\,t$: so $|t|_\infty \le |Y g|_\infty/(1 -
//! \|I - Y C\|_\infty)$, and the map narrows that. What a projection that takes out the middle of C
//! leaves of the balance must vanish too.

use std::ops::Range;
use std::slice::from_ref;

use nalgebra::DMatrix;
use numerics::Interval;

use super::cell::{Cell, Pattern};
use super::dense::{Dense, add_to_column, complement, left_inverse, times, times_matrix, zeros};
use super::layout::{End, Link, Swing};
use super::swing::Swung;
use crate::boxes::arithmetic::{Vector, norm, sum};

/// A tension that varies over a box by more than this part of its size is an unknown: solving for
/// it is sharper than its range.
const WIDE: f64 = 0.5;

/// Unless it varies by less than this part of the load: near zero its own size says nothing.
const LITTLE: f64 = 1.0 / 1024.0;

/// Times that a bound is narrowed by the map.
const NARROW: usize = 3;

/// The unknown forces of a box.
pub(super) struct Columns {
    /// Swings whose tension is an unknown, behind those of the bars.
    pub(super) unbounded: Vec<bool>,
    matrix: Dense,
    solver: Option<Solver>,
}

struct Solver {
    inverse: DMatrix<f64>,
    /// `I − Y C`.
    rest: Dense,
    /// Its norm, less than 1.
    norm: f64,
    complement: DMatrix<f64>,
    /// The complement of C: next to nothing.
    left: Dense,
}

/// What the unknown forces can be.
pub(super) enum Forces {
    /// None balance.
    Impossible,
    /// They are not bounded over this box.
    Unknown,
    /// Forces, or force densities, of all links.
    Within(Vec<Interval>),
}

impl Columns {
    pub(super) fn new<const N: usize>(cell: &Cell<N>) -> Self {
        let wide = |(swing, swung): (&Swing, &Swung<N>)| {
            let width = swung.tension.width();
            let pull = (norm(swung.span) * Interval::point(width)).hi();
            let narrow = width <= WIDE * swung.tension.mag();
            !width.is_finite() || !(narrow || pull <= LITTLE * norm(swing.load).lo())
        };
        let swings = cell.layout.swings.iter().zip(&cell.swung);
        let unbounded: Vec<bool> = swings.map(|both| !both.1.folded && wide(both)).collect();
        let links = cell.layout.links.iter().zip(&cell.along);
        let links = links.filter(|(link, _)| link.is_constraint());
        let links = links.map(|(link, along)| (&link.ends[..], &along[..]));
        let swings = cell.layout.swings.iter().zip(&cell.swung).zip(&unbounded);
        let swings = swings.filter(|(_, unbounded)| **unbounded);
        let swings =
            swings.map(|((swing, swung), _)| (from_ref(&swing.ends), from_ref(&swung.span)));
        let columns: Vec<(&[[End; 2]], &[Vector])> = links.chain(swings).collect();
        let mut matrix = zeros(cell.layout.coordinates(), columns.len());
        for (column, (ends, spans)) in columns.into_iter().enumerate() {
            for ([a, b], span) in ends.iter().zip(spans) {
                for (end, pull) in [(a, *span), (b, span.map(|part| -part))] {
                    if let Some(row) = cell.rows(*end) {
                        add_to_column(&mut matrix, (row, column), &pull[..cell.layout.dim]);
                    }
                }
            }
        }
        let solver = Solver::new(&matrix);
        Self { unbounded, matrix, solver }
    }

    /// Whether no column touches these rows but that of one swing.
    pub(super) fn free_but_of(&self, swing: usize, rows: Range<usize>) -> bool {
        let bars = self.matrix.ncols() - self.unbounded.iter().filter(|wide| **wide).count();
        let own = self.unbounded[swing]
            .then(|| bars + self.unbounded[..swing].iter().filter(|wide| **wide).count());
        let free = |row: usize| {
            let free = |column| Some(column) == own || self.matrix[(row, column)] == Interval::ZERO;
            (0..self.matrix.ncols()).all(free)
        };
        rows.into_iter().all(free)
    }

    /// Whether no column touches a row.
    fn free_row(&self, row: usize) -> bool {
        self.matrix.row(row).iter().all(|entry| *entry == Interval::ZERO)
    }

    /// The forces that balance these loads.
    pub(super) fn forces<const N: usize>(
        &self,
        cell: &Cell<N>,
        pattern: Pattern,
        loads: &[Interval],
    ) -> Forces {
        if loads.iter().enumerate().any(|(row, g)| !g.contains(0.0) && self.free_row(row)) {
            return Forces::Impossible;
        }
        if self.matrix.ncols() == 0 {
            return Forces::Within(cell.known.iter().copied().flatten().collect());
        }
        let Some(solver) = &self.solver else { return Forces::Unknown };
        let Some(found) = solver.forces(loads) else { return Forces::Unknown };
        if found.iter().any(|force| !force.mag().is_finite()) {
            return Forces::Unknown;
        }
        let missing = times(&solver.complement, loads);
        for (row, missing) in missing.into_iter().enumerate() {
            let left = solver.left.row(row);
            let terms = left.iter().zip(&found).map(|(c, t)| *c * *t);
            if !terms.fold(missing, sum).contains(0.0) {
                return Forces::Impossible;
            }
        }
        let swings = (0..self.unbounded.len()).filter(|s| self.unbounded[*s]);
        for (swing, force) in swings.zip(&found[cell.layout.constraints()..]) {
            if force.disjoint(cell.tension(pattern, swing)) {
                return Forces::Impossible;
            }
        }
        let mut found = found.into_iter();
        let of_link = |(link, known): (&Link, &Option<Interval>)| match known {
            Some(known) => Some(*known),
            None => found.next()?.intersect(link.range),
        };
        let forces = cell.layout.links.iter().zip(&cell.known).map(of_link);
        forces.collect::<Option<_>>().map_or(Forces::Impossible, Forces::Within)
    }
}

impl Solver {
    fn new(matrix: &Dense) -> Option<Self> {
        if matrix.is_empty() || matrix.ncols() > matrix.nrows() {
            return None;
        }
        let middle = matrix.map(Interval::mid);
        let inverse = left_inverse(&middle)?;
        let mut rest = times_matrix(&inverse, matrix);
        let mut norm = 0.0_f64;
        for row in 0..rest.nrows() {
            let mut size = Interval::ZERO;
            for column in 0..rest.ncols() {
                let unit = if row == column { Interval::ONE } else { Interval::ZERO };
                let entry = sum(unit, -rest[(row, column)]);
                rest[(row, column)] = entry;
                size = size + Interval::point(entry.mag());
            }
            norm = norm.max(size.hi());
        }
        if norm.is_nan() || norm >= 1.0 {
            return None;
        }
        let complement = complement(&middle, &inverse);
        let left = times_matrix(&complement, matrix);
        Some(Self { inverse, rest, norm, complement, left })
    }

    fn forces(&self, loads: &[Interval]) -> Option<Vec<Interval>> {
        let first: Vec<Interval> = times(&self.inverse, loads).into_iter().map(|t| -t).collect();
        let largest = first.iter().map(|t| t.mag()).fold(0.0, f64::max);
        let room = Interval::ONE - Interval::point(self.norm);
        let bound = (Interval::point(largest) / room).hi();
        if !bound.is_finite() {
            return None;
        }
        let mut found = vec![Interval::new(-bound, bound); first.len()];
        for _ in 0..NARROW {
            let next: Vec<Interval> = (0..first.len())
                .map(|row| {
                    let rest = self.rest.row(row);
                    let terms = rest.iter().zip(&found).map(|(c, t)| *c * *t);
                    terms.fold(first[row], sum)
                })
                .collect();
            for (all, next) in found.iter_mut().zip(next) {
                *all = all.intersect(next)?;
            }
        }
        Some(found)
    }
}
