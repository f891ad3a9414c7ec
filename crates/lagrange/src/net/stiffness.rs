//! Sparse symmetric matrices over the free directions of the joints, and their factorisation.
//!
//! Every matrix here is $\sum_e C_e^T K_e C_e$ with one symmetric 3 x 3 block $K_e$ a member, where
//! $C_e$ takes moves of the joints to the change of the member's span. Its pattern is that of the
//! members; the joints are numbered by approximate minimum degree, which a tree or a chain passes
//! without any fill.

use std::collections::BTreeMap;

use matrices::sparse::{Ldlt, Pivots};
use nalgebra::{Matrix3, Vector3};

use super::directions::Directions;
use super::framework::Framework;
use super::law::by_direction;
use super::order::by_degree;
use super::work::Work;
use crate::error::Error;

/// A pivot below this fraction of the largest diagonal entry is no pivot: the direction is left out
/// of the solve. Some fifty rounding errors.
const NO_PIVOT: f64 = 1e-14;

/// The same for a matrix that is positive definite by its making, whose stiffness along the members
/// is up to 10^11 times that across: half a rounding error.
const NO_STIFF_PIVOT: f64 = 1e-16;

/// Where the blocks of one member stand.
#[derive(Debug, Clone, Copy)]
struct Place {
    /// Joint that is eliminated first, and the other.
    low: usize,
    high: usize,
    /// Rows between the diagonal block of `low` and the first row of `high` in its columns.
    gap: usize,
}

/// Where the unknowns of a joint stand.
#[derive(Debug, Clone, Copy, Default)]
struct Unknowns {
    first: usize,
    count: usize,
}

/// The matrix, its pattern analysed once.
pub(super) struct Stiffness {
    unknowns: Vec<Unknowns>,
    places: Vec<Place>,
    /// Those of each two joints of each rope.
    ties: Vec<Vec<Place>>,
    columns: Vec<usize>,
    values: Vec<f64>,
    factor: Ldlt,
    work: Work,
}

impl Stiffness {
    /// The pattern of a framework with the free directions of its joints; with `scalar` one unknown
    /// a free joint, for matrices whose blocks are multiples of the identity.
    ///
    /// # Errors
    ///
    /// [`Error::Memory`] when the factor cannot be held.
    pub fn new(framework: &Framework, scalar: bool) -> Result<Self, Error> {
        let counts: Vec<usize> = framework
            .nodes
            .iter()
            .map(|node| if scalar { usize::from(node.freedom() > 0) } else { node.freedom() })
            .collect();
        let size = counts.iter().sum();
        let lost = || Error::Memory { unknowns: size };
        let order = by_degree(framework).ok_or_else(lost)?;
        let unknowns = unknowns(&counts, &order);
        let (mut places, columns, rows) = pattern(framework, &unknowns, &order);
        let mut between = places.split_off(framework.links.len()).into_iter();
        let ties = framework.ropes.iter().map(|rope| {
            let joints = rope.joints.len();
            between.by_ref().take(joints * (joints - 1) / 2).collect()
        });
        let ties = ties.collect();
        // The joints are in their order already.
        let order: Vec<usize> = (0..size).collect();
        let factor = Ldlt::new(&columns, &rows, &order).ok_or_else(lost)?;
        let (values, work) = (vec![0.0; rows.len()], framework.work.clone());
        Ok(Self { unknowns, places, ties, columns, values, factor, work })
    }

    /// Number of unknowns.
    pub fn size(&self) -> usize {
        self.columns.len() - 1
    }

    /// Set to $\sum_e C_e^T K_e C_e$ with the blocks of `blocks`, in the order of the members.
    pub fn assemble(&mut self, framework: &Framework, blocks: impl Iterator<Item = Matrix3<f64>>) {
        self.values.fill(0.0);
        for (place, block) in self.places.iter().zip(blocks) {
            let (low, high) = (&framework.nodes[place.low], &framework.nodes[place.high]);
            let (unknowns_low, unknowns_high) =
                (self.unknowns[place.low], self.unknowns[place.high]);
            let (same_low, same_high, mixed) = match (&low.free, &high.free) {
                (Directions::All, Directions::All) => (block, block, block),
                (low, high) => {
                    let (low, high) = (low.axes(), high.axes());
                    let (by_low, by_high) = (block * low, block * high);
                    (low.tr_mul(&by_low), high.tr_mul(&by_high), high.tr_mul(&by_low))
                }
            };
            for column in 0..unknowns_low.count {
                let start = self.columns[unknowns_low.first + column];
                let height = unknowns_low.count - column;
                for row in 0..height {
                    self.values[start + row] += same_low[(column + row, column)];
                }
                for row in 0..unknowns_high.count {
                    self.values[start + height + place.gap + row] -= mixed[(row, column)];
                }
            }
            for column in 0..unknowns_high.count {
                let start = self.columns[unknowns_high.first + column];
                for row in 0..unknowns_high.count - column {
                    self.values[start + row] += same_high[(column + row, column)];
                }
            }
        }
    }

    /// The same with the direction of each link, and its stiffnesses across and along: that of a rope
    /// along is one, $k g g^T$ with the gradient $g$ of its length.
    pub fn assemble_members(
        &mut self,
        framework: &Framework,
        row: impl Fn(usize) -> (Vector3<f64>, f64, f64),
    ) {
        let blocks = framework.links.iter().enumerate().map(|(k, link)| {
            let (u, across, along) = row(k);
            by_direction(&u, across, if link.rope.is_some() { 0.0 } else { along })
        });
        self.assemble(framework, blocks);
        for number in 0..framework.ropes.len() {
            let rope = &framework.ropes[number];
            let along = row(rope.spans[0]).2;
            let gradient = rope.gradient(&framework.links, |span| row(span).0);
            let parts = rope.joints.iter().zip(gradient).map(|(joint, g)| {
                let part = framework.nodes[*joint].free.components(&g);
                (*joint, part)
            });
            self.tie(number, along, &parts.collect());
        }
    }

    /// Add $k g g^T$ with the components of $g$ at the joints of a rope.
    fn tie(&mut self, rope: usize, k: f64, parts: &BTreeMap<usize, Vector3<f64>>) {
        for (joint, part) in parts {
            self.press(*joint, k, part);
        }
        for place in &self.ties[rope] {
            let (low, high) = (self.unknowns[place.low], self.unknowns[place.high]);
            for column in 0..low.count {
                let start = self.columns[low.first + column] + low.count - column + place.gap;
                for row in 0..high.count {
                    self.values[start + row] +=
                        k * parts[&place.high][row] * parts[&place.low][column];
                }
            }
        }
    }

    /// Add a stiffness in all directions of one joint.
    pub fn hold(&mut self, joint: usize, by: f64) {
        let own = self.unknowns[joint];
        for column in own.first..own.first + own.count {
            self.values[self.columns[column]] += by;
        }
    }

    /// Add $k g g^T$ with the components of $g$ at one joint.
    pub fn press(&mut self, joint: usize, k: f64, part: &Vector3<f64>) {
        let own = self.unknowns[joint];
        for column in 0..own.count {
            let start = self.columns[own.first + column];
            for row in column..own.count {
                self.values[start + row - column] += k * part[row] * part[column];
            }
        }
    }

    /// The same for a scalar matrix: one number a member.
    pub fn assemble_scalar(&mut self, weights: impl Iterator<Item = f64>) {
        self.values.fill(0.0);
        for (place, weight) in self.places.iter().zip(weights) {
            let (low, high) = (self.unknowns[place.low], self.unknowns[place.high]);
            if low.count == 1 {
                let start = self.columns[low.first];
                self.values[start] += weight;
                if high.count == 1 {
                    self.values[start + 1 + place.gap] -= weight;
                }
            }
            if high.count == 1 {
                self.values[self.columns[high.first]] += weight;
            }
        }
    }

    /// Largest diagonal entry.
    pub fn largest(&self) -> f64 {
        let diagonal = self.columns[..self.size()].iter().map(|&start| self.values[start]);
        diagonal.fold(0.0, |largest, entry| largest.max(entry.abs()))
    }

    /// Add a multiple of the identity.
    pub fn shift(&mut self, by: f64) {
        for column in 0..self.size() {
            self.values[self.columns[column]] += by;
        }
    }

    /// Factorise a matrix that ought to be positive definite; directions without stiffness, or with
    /// a negative one, are left out of later solves.
    pub fn factorise_definite(&mut self) {
        self.raised(NO_PIVOT);
    }

    /// The same where soft directions beside very stiff ones count.
    pub fn factorise_stiff(&mut self) {
        self.raised(NO_STIFF_PIVOT);
    }

    fn raised(&mut self, part: f64) {
        let (least, instead) = self.least(part, part.recip());
        self.factorise(Pivots::Raised { least, instead });
    }

    /// Factorise a matrix as it is, positive and negative pivots alike; directions without
    /// stiffness are left out of later solves. Whether all came out finite.
    pub fn factorise_indefinite(&mut self) -> bool {
        let (least, instead) = self.least(NO_PIVOT, NO_PIVOT.recip());
        self.factorise(Pivots::Replaced { least, instead })
    }

    /// The same with a tiny stiffness where there is none: a bordered matrix is solved through a
    /// singular one.
    pub fn factorise_bordered(&mut self) -> bool {
        let (least, instead) = self.least(NO_PIVOT, NO_PIVOT);
        self.factorise(Pivots::Replaced { least, instead })
    }

    /// The least pivot and what is in the place of smaller ones, given in units of the largest
    /// entry: a large one leaves its direction out of solutions.
    fn least(&self, least: f64, instead: f64) -> (f64, f64) {
        let largest = self.largest();
        if largest > 0.0 { (least * largest, instead * largest) } else { (1.0, 1.0) }
    }

    fn factorise(&mut self, pivots: Pivots) -> bool {
        self.work.spend(self.factor.entries()) && self.factor.factorise(&self.values, pivots)
    }

    /// Number of negative pivots of the factor.
    pub fn negative_pivots(&self) -> usize {
        self.factor.pivots().iter().filter(|pivot| **pivot < 0.0).count()
    }

    /// Solve with the factor, in place; several right-hand sides one after another. Without work there
    /// is no step.
    pub fn solve(&self, right: &mut [f64]) {
        if self.work.is_refused() {
            right.fill(0.0);
        } else {
            self.factor.solve(right);
        }
    }

    /// The moves of the joints by forces on them, with the factor.
    pub fn moves(&self, framework: &Framework, forces: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let mut moves = self.gather(framework, forces);
        self.solve(&mut moves);
        self.scatter(framework, &moves)
    }

    /// The components of forces at the joints along their free directions.
    pub fn gather(&self, framework: &Framework, forces: &[Vector3<f64>]) -> Vec<f64> {
        let mut gathered = vec![0.0; self.size()];
        for ((node, own), force) in framework.nodes.iter().zip(&self.unknowns).zip(forces) {
            let along = node.free.components(force);
            gathered[own.first..own.first + own.count]
                .copy_from_slice(&along.as_slice()[..own.count]);
        }
        gathered
    }

    /// The moves of the joints from their components along the free directions.
    pub fn scatter(&self, framework: &Framework, moves: &[f64]) -> Vec<Vector3<f64>> {
        let joints = framework.nodes.iter().zip(&self.unknowns);
        joints
            .map(|(node, own)| node.free.vector(&moves[own.first..own.first + own.count]))
            .collect()
    }

    /// Where the unknown of a joint stands in a scalar matrix; nothing for a joint that is held.
    pub fn first_unknown(&self, joint: usize) -> Option<usize> {
        (self.unknowns[joint].count > 0).then_some(self.unknowns[joint].first)
    }
}

/// Unknowns of the joints one after another in the order of elimination.
fn unknowns(counts: &[usize], order: &[usize]) -> Vec<Unknowns> {
    let mut unknowns = vec![Unknowns::default(); counts.len()];
    let mut first = 0;
    for &joint in order {
        unknowns[joint] = Unknowns { first, count: counts[joint] };
        first += counts[joint];
    }
    unknowns
}

/// Places of the members' blocks, and the lower triangle column by column.
fn pattern(
    framework: &Framework,
    unknowns: &[Unknowns],
    order: &[usize],
) -> (Vec<Place>, Vec<usize>, Vec<usize>) {
    let mut rank = vec![0; order.len()];
    for (place, &joint) in order.iter().enumerate() {
        rank[joint] = place;
    }
    let mut later = vec![Vec::new(); unknowns.len()];
    let ends = couples(framework).map(|(a, b)| if rank[a] < rank[b] { (a, b) } else { (b, a) });
    let ends: Vec<_> = ends.collect();
    for &(low, high) in &ends {
        if unknowns[low].count > 0 && unknowns[high].count > 0 {
            later[low].push(rank[high]);
        }
    }
    let (mut columns, mut rows) = (vec![0], Vec::new());
    for &joint in order {
        later[joint].sort_unstable();
        later[joint].dedup();
        let own = unknowns[joint];
        for column in 0..own.count {
            rows.extend(own.first + column..own.first + own.count);
            for &other in &later[joint] {
                let there = unknowns[order[other]];
                rows.extend(there.first..there.first + there.count);
            }
            columns.push(rows.len());
        }
    }
    let places = ends.iter().map(|&(low, high)| {
        let before = later[low].iter().take_while(|other| **other < rank[high]);
        let gap = before.map(|&other| unknowns[order[other]].count).sum();
        Place { low, high, gap }
    });
    (places.collect(), columns, rows)
}

/// The joints that each link couples, then each two of each rope.
pub(super) fn couples(framework: &Framework) -> impl Iterator<Item = (usize, usize)> + '_ {
    let ropes = framework.ropes.iter().flat_map(|rope| {
        let later = |(k, a): (usize, &usize)| {
            let a = *a;
            rope.joints[k + 1..].iter().map(move |b| (a, *b))
        };
        rope.joints.iter().enumerate().flat_map(later)
    });
    framework.links.iter().map(|link| (link.from, link.to)).chain(ropes)
}

#[cfg(test)]
mod tests;
