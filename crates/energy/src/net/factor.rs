//! Sparse factorisations of matrices that couple the ends of members.

use std::collections::{BTreeMap, BTreeSet};

use matrices::sparse::{Ldlt, Pivots, minimum_degree};
use model::Vector;

use crate::error::Error;
use crate::net::frame::{Rod, Spot, strands};
use crate::net::work::Meter;
use crate::vector::{along, dot};

/// What a member puts on the difference of its ends: `isotropic I + along d dᵀ`.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Block {
    pub(super) isotropic: f64,
    pub(super) along: f64,
    pub(super) direction: Vector,
    /// The part of `along` that comes of a longer member: the strands of a rope have it together.
    pub(super) stretch: f64,
}

/// The strands of a rope, the joints that they meet, and where each two of these stand.
struct Tie {
    strands: Vec<usize>,
    joints: Vec<usize>,
    pairs: Vec<Option<(usize, usize, usize)>>,
}

impl Tie {
    /// The joints of a rope, ascending.
    fn joints(rods: &[Rod], strands: &[usize]) -> Vec<usize> {
        let ends = strands.iter().flat_map(|e| [rods[*e].from, rods[*e].to]);
        ends.collect::<BTreeSet<usize>>().into_iter().collect()
    }

    /// The gradient of the rope's length at a joint.
    fn gradient(&self, rods: &[Rod], block: &dyn Fn(usize) -> Block, joint: usize) -> Vector {
        self.strands.iter().fold([0.0; 3], |sum, &e| {
            let sign = f64::from(u8::from(rods[e].to == joint))
                - f64::from(u8::from(rods[e].from == joint));
            along(sum, sign, block(e).direction)
        })
    }
}

/// Each two of some joints.
fn couples(joints: &[usize]) -> impl Iterator<Item = (usize, usize)> + '_ {
    let with = |(k, first): (usize, &usize)| {
        let first = *first;
        joints[k + 1..].iter().map(move |second| (first, *second))
    };
    joints.iter().enumerate().flat_map(with)
}

impl Block {
    /// The bilinear form.
    pub(super) fn between(&self, a: Vector, b: Vector) -> f64 {
        self.isotropic * dot(a, b) + self.along * dot(self.direction, a) * dot(self.direction, b)
    }
}

/// A symmetric matrix with a block for each joint and each pair of joints that a member connects,
/// and its factorisation.
///
/// The order of elimination is one of joints (approximate minimum degree): trees and chains are
/// eliminated without fill-in, plane nets of *n* joints in about `n^1.5` operations.
pub(super) struct Factor {
    /// Where each column of the lower triangle starts.
    starts: Vec<usize>,
    /// For each member the joint that comes first in the matrix, the other one, and how many rows
    /// of the first one's columns stand between the diagonal block and theirs; nothing for a
    /// support that is fixed.
    pairs: Vec<Option<(usize, usize, usize)>>,
    ties: Vec<Tie>,
    values: Vec<f64>,
    ldlt: Ldlt,
    meter: Meter,
    /// Factorisations made.
    pub(super) count: u64,
}

/// For each joint that moves the joints after it that a member connects with it, itself first.
fn neighbours(spots: &[Spot], rods: &[Rod]) -> Vec<Vec<usize>> {
    let mut columns: Vec<Vec<usize>> =
        (0..spots.len()).map(|j| if spots[j].freedom > 0 { vec![j] } else { vec![] }).collect();
    let ropes: Vec<_> = strands(rods).iter().map(|strands| Tie::joints(rods, strands)).collect();
    let ties = ropes.iter().flat_map(|joints| couples(joints));
    for (a, b) in rods.iter().map(|rod| (rod.from, rod.to)).chain(ties) {
        if spots[a].freedom > 0 && spots[b].freedom > 0 {
            columns[a.min(b)].push(a.max(b));
        }
    }
    for column in &mut columns {
        column.sort_unstable();
        column.dedup();
    }
    columns
}

/// Order of elimination of the coordinates: approximate minimum degree of the joints.
fn order(spots: &[Spot], columns: &[Vec<usize>]) -> Result<Vec<usize>, Error> {
    let moving: Vec<usize> = (0..spots.len()).filter(|&j| spots[j].freedom > 0).collect();
    let mut number = vec![0; spots.len()];
    for (k, &j) in moving.iter().enumerate() {
        number[j] = k;
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for &j in &moving {
        rows.extend(columns[j].iter().map(|&i| number[i]));
        starts.push(rows.len());
    }
    let order =
        minimum_degree(&starts, &rows).ok_or(Error::Memory { coordinates: moving.len() })?;
    let coordinates = |k: usize| {
        let spot = spots[moving[k]];
        spot.first..spot.first + spot.freedom
    };
    Ok(order.into_iter().flat_map(coordinates).collect())
}

/// The lower triangle's pattern, column by column.
fn lower_pattern(spots: &[Spot], columns: &[Vec<usize>]) -> (Vec<usize>, Vec<usize>) {
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for (j, spot) in spots.iter().enumerate() {
        for k in 0..spot.freedom {
            rows.extend(spot.first + k..spot.first + spot.freedom);
            for &i in columns[j].iter().skip(1) {
                rows.extend(spots[i].first..spots[i].first + spots[i].freedom);
            }
            starts.push(rows.len());
        }
    }
    (starts, rows)
}

impl Factor {
    /// Choose the order of elimination and find the pattern of the factor.
    pub(super) fn new(spots: &[Spot], rods: &[Rod], meter: &Meter) -> Result<Self, Error> {
        let columns = neighbours(spots, rods);
        let order = order(spots, &columns)?;
        let (starts, rows) = lower_pattern(spots, &columns);
        let ldlt =
            Ldlt::new(&starts, &rows, &order).ok_or(Error::Memory { coordinates: order.len() })?;
        let place = |(a, b): (usize, usize)| {
            let (first, second) = (a.min(b), a.max(b));
            let column = &columns[first];
            let place =
                column.binary_search(&second).ok().filter(|_| !columns[second].is_empty())?;
            Some((first, second, column[1..place].iter().map(|&i| spots[i].freedom).sum()))
        };
        let pairs = rods.iter().map(|rod| place((rod.from, rod.to)));
        let tie = |strands: Vec<usize>| {
            let joints = Tie::joints(rods, &strands);
            Tie { pairs: couples(&joints).map(place).collect(), strands, joints }
        };
        let ties = strands(rods).into_iter().map(tie).collect();
        let values = vec![0.0; rows.len()];
        let meter = meter.clone();
        Ok(Self { starts, pairs: pairs.collect(), ties, values, ldlt, meter, count: 0 })
    }

    pub(super) fn size(&self) -> usize {
        self.ldlt.size()
    }

    /// Put the matrix together: the block of each member on the difference of its ends, and
    /// `shift(joint)` on the diagonal.
    pub(super) fn fill(
        &mut self,
        spots: &[Spot],
        rods: &[Rod],
        block: &dyn Fn(usize) -> Block,
        shift: &dyn Fn(usize) -> f64,
    ) {
        let starts = &self.starts;
        self.values.fill(0.0);
        for (j, spot) in spots.iter().enumerate() {
            for k in 0..spot.freedom {
                self.values[starts[spot.first + k]] = shift(j);
            }
        }
        for (e, rod) in rods.iter().enumerate() {
            let mut block = block(e);
            if rod.rope > 0 {
                block.along -= block.stretch;
            }
            for j in [rod.from, rod.to] {
                let spot = &spots[j];
                for k in 0..spot.freedom {
                    let start = starts[spot.first + k];
                    for t in k..spot.freedom {
                        self.values[start + t - k] += block.between(spot.axes[t], spot.axes[k]);
                    }
                }
            }
            let Some((first, second, skipped)) = self.pairs[e] else { continue };
            let (column, row) = (&spots[first], &spots[second]);
            for k in 0..column.freedom {
                let start = starts[column.first + k] + column.freedom - k + skipped;
                for t in 0..row.freedom {
                    self.values[start + t] -= block.between(row.axes[t], column.axes[k]);
                }
            }
        }
        for tie in &self.ties {
            let stretch = block(tie.strands[0]).stretch;
            let parts: BTreeMap<usize, [f64; 3]> = tie
                .joints
                .iter()
                .map(|j| {
                    let gradient = tie.gradient(rods, block, *j);
                    (*j, spots[*j].axes.map(|axis| dot(axis, gradient)))
                })
                .collect();
            for (j, part) in &parts {
                let spot = &spots[*j];
                for k in 0..spot.freedom {
                    for t in k..spot.freedom {
                        self.values[starts[spot.first + k] + t - k] += stretch * part[t] * part[k];
                    }
                }
            }
            for (first, second, skipped) in tie.pairs.iter().flatten() {
                let (column, row) = (&spots[*first], &spots[*second]);
                for k in 0..column.freedom {
                    let start = starts[column.first + k] + column.freedom - k + skipped;
                    for t in 0..row.freedom {
                        self.values[start + t] += stretch * parts[second][t] * parts[first][k];
                    }
                }
            }
        }
    }

    /// Whether there is work left for a factorisation; without it the last one stays.
    fn may(&mut self) -> bool {
        let may = self.meter.take(self.ldlt.entries());
        self.count += u64::from(may);
        may
    }

    /// Factorise the matrix; whether it is positive definite, as far as the work allows to tell.
    pub(super) fn definite(&mut self) -> bool {
        self.may() && self.ldlt.factorise(&self.values, Pivots::Positive)
    }

    /// Factorise the matrix and count the negative pivots: by Sylvester's law of inertia that is
    /// the number of negative eigenvalues. Nothing where a pivot vanishes, or no work is left.
    pub(super) fn negative_pivots(&mut self) -> Option<usize> {
        let done = self.may() && self.ldlt.factorise(&self.values, Pivots::Signed);
        done.then(|| self.ldlt.pivots().iter().filter(|pivot| **pivot < 0.0).count())
    }

    /// Solve with the factorisation made last, one right side after the other.
    pub(super) fn solve(&self, right: &mut [f64]) {
        self.ldlt.solve(right);
    }

    /// The step that takes a gradient away: the solution for minus it.
    pub(super) fn step_against(&self, mut gradient: Vec<f64>) -> Vec<f64> {
        for value in &mut gradient {
            *value = -*value;
        }
        self.solve(&mut gradient);
        gradient
    }
}
