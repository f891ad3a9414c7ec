//! Forces that the shape of a system leaves open: its self-stresses, from the places of its joints
//! alone.
//!
//! A self-stress is a set of axial forces of inextensible members that balances at every joint
//! along its free motions; a floor that a joint touches bears what is straight up. Where there are some, the forces of an equilibrium are one point of an
//! affine space; two answers are one if their difference is a self-stress.
//!
//! S. Pellegrino and C. R. Calladine, Int. J. Solids Struct. 22 (1986) 409-428,
//! doi:10.1016/0020-7683(86)90014-4

use std::collections::BTreeMap;

use matrices::dense::Kernels;
use model::system::{Joint, Kind, LENGTH_ROUNDING, Member, System, SystemEquilibrium};
use model::{Rigidity, Vector};

use super::floor::{push_n, sliding};
use super::spans::{has_corner, length_m, unit as unit_vector};
use super::statics::rounding_m;
use nalgebra::DMatrix;
use numerics::vector::{dot, plus, times, worse};

/// Free coordinates up to which the rank of the balances is counted: dense singular values.
const COUNTED: usize = 240;

/// Singular values of the balances below this part of the largest are zero: by the forces that go
/// with them the balances of joints change by less than what two answers may differ by.
const RANK: f64 = 1e-9;

/// What a solver leaves of lengths, up to this many roundings of a coordinate, makes the height of a joint as unsure.
const LEFT_OF_LENGTHS: f64 = 1e3;

/// A member whose part of every self-stress of unit size is below this takes part in none: far above
/// the rounding of singular vectors.
const TAKES_PART: f64 = 1e-9;

/// A self-stress that an answer names is another one than those known if this part of it is not a
/// sum of them.
const ANOTHER: f64 = 1e-6;

/// The self-stresses of a shape.
pub(super) struct Family {
    /// Orthonormal, one axial force for each member.
    basis: Vec<Vec<f64>>,
    /// Whether the basis was counted, or holds what the answer names alone.
    counted: bool,
    /// The most that one of them may leave at a joint.
    pub(super) rounding: f64,
    /// Unit vector along each member.
    along: Vec<Vector>,
    /// The joints and directions of the spans of each rope.
    ropes: BTreeMap<usize, Vec<([usize; 2], Vector)>>,
    /// Of each inextensible member that has its length within what its length may be off: distance
    /// less length, m.
    misfit_m: Vec<Option<f64>>,
    /// The motions of each joint; along the floor, of those that touch it.
    free: Vec<Vec<Vector>>,
    /// The rank, and the singular values next to it.
    counts: Rigidity,
}

impl Family {
    /// Count them. Of a system that is too large the self-stresses are those that the answer names,
    /// as far as they are in balance. Without value where the answer is incomplete, or the
    /// system is large and the answer names none, and where a rope has a span without length, which pulls in
    /// any direction.
    pub(super) fn of(system: &System, answer: &SystemEquilibrium) -> Option<Self> {
        let named = answer.evidence.self_stresses.as_ref().map(|named| &named.basis[..]);
        let motions_of = |joint: &Joint| joint.support.motions().len();
        let is_large = || system.joints().iter().map(motions_of).sum::<usize>() > 2 * COUNTED;
        if named.is_none() && is_large() {
            return None;
        }
        Self::with(system, answer, named.unwrap_or_default())
    }

    /// The same where nothing is counted and the axial forces of two answers with one shape differ: with their
    /// difference as the self-stress that is named. Without value where it is none.
    pub(super) fn between(
        system: &System,
        [first, second]: [&SystemEquilibrium; 2],
    ) -> Option<Self> {
        let apart = first.axial_n.iter().zip(&second.axial_n).map(|(a, b)| a - b);
        let stress = normalised(&apart.collect::<Vec<_>>())?;
        Self::with(system, first, &[stress]).filter(|family| !family.basis.is_empty())
    }

    fn with(system: &System, answer: &SystemEquilibrium, named: &[Vec<f64>]) -> Option<Self> {
        let members = system.members();
        if answer.joints_m.len() != system.joints().len() || has_corner(system, answer) {
            return None;
        }
        let free = motions_above_floor(system, answer);
        let coordinates: usize = free.iter().map(Vec::len).sum();
        let (mut along, mut misfit_m, mut ropes) = (Vec::new(), Vec::new(), BTreeMap::new());
        for (k, member) in members.iter().enumerate() {
            let mut spans = member.spans().map(|span| unit_vector(span, &answer.joints_m));
            let first = spans.next().unwrap_or_default();
            if member.rope.is_some() {
                let joints = member.spans().zip(std::iter::once(first).chain(spans));
                ropes.insert(k, joints.collect());
            }
            along.push(first);
            let distance_m = length_m(member, &answer.joints_m);
            let bears = answer.axial_n.get(k).is_some_and(|axial_n| axial_n.abs() > 0.0);
            misfit_m.push(misfit(member, distance_m, bears));
        }
        let taut: Vec<usize> = (0..members.len()).filter(|k| misfit_m[*k].is_some()).collect();
        let counts = Rigidity {
            rank: coordinates.min(taut.len()),
            mechanisms: 0,
            self_stresses: taut.len().saturating_sub(coordinates),
            gap: [1.0, 0.0],
        };
        let (basis, counted, rounding) = (vec![], false, RANK);
        let mut family = Self { basis, counted, rounding, along, ropes, misfit_m, free, counts };
        if coordinates <= COUNTED {
            family.count(system, &taut, coordinates)?;
        }
        for stress in named {
            family.add(system, stress);
        }
        Some(family)
    }

    /// Rank and self-stresses by singular values.
    fn count(&mut self, system: &System, taut: &[usize], coordinates: usize) -> Option<()> {
        let members = self.along.len();
        let balances: Vec<Vec<f64>> =
            taut.iter().map(|k| self.left_by(system, &unit(*k, members))).collect();
        let balances =
            DMatrix::from_fn(taut.len(), coordinates, |row, column| balances[row][column]);
        let Null { rows, zero, rank, gap } = null_rows(&balances)?;
        self.basis = rows
            .into_iter()
            .map(|stress| {
                let mut whole = vec![0.0; members];
                for (&k, force) in taut.iter().zip(stress) {
                    whole[k] = force;
                }
                whole
            })
            .collect();
        let self_stresses = self.basis.len();
        self.counts = Rigidity { rank, mechanisms: coordinates - rank, self_stresses, gap };
        (self.counted, self.rounding) = (true, zero);
        Some(())
    }

    /// Add a self-stress that is named, if it is one, and another one than those known.
    fn add(&mut self, system: &System, stress: &[f64]) {
        if stress.len() != self.along.len() || !stress.iter().all(|force| force.is_finite()) {
            return;
        }
        let taut = stress.iter().zip(&self.misfit_m).all(|(n, e)| n.abs() <= 0.0 || e.is_some());
        let left = self.left_by(system, stress).into_iter().map(f64::abs).fold(0.0, worse);
        let part = self.part_of(stress);
        let rest: Vec<f64> = stress.iter().zip(part).map(|(force, part)| force - part).collect();
        if taut
            && left <= 2.0 * self.rounding
            && size(&rest) > ANOTHER
            && let Some(rest) = normalised(&rest)
        {
            self.basis.push(rest);
            self.counts.rank = self.counts.rank.saturating_sub(usize::from(self.counted));
            self.counts.mechanisms += usize::from(self.counted);
            self.counts.self_stresses = self.basis.len();
        }
    }

    /// Number of independent self-stresses; without value where they are not counted, and none is
    /// named.
    pub(super) fn dimension(&self) -> Option<usize> {
        (self.counted || !self.basis.is_empty()).then_some(self.basis.len())
    }

    /// The rank of the lengths and what follows from it; without value where it is not counted.
    pub(super) fn counts(&self) -> Option<Rigidity> {
        self.counted.then_some(self.counts)
    }

    /// The orthonormal basis.
    pub(super) fn basis(&self) -> &[Vec<f64>] {
        &self.basis
    }

    /// Whether a member has a force in some self-stress.
    pub(super) fn takes_part(&self, member: usize) -> bool {
        self.basis.iter().any(|stress| stress[member].abs() > TAKES_PART)
    }

    /// Whether balance and signs leave forces open: not of a single self-stress that would have a
    /// cable or strut without force push or pull, whichever way it is added.
    pub(super) fn is_open(&self, system: &System, axial: &[f64], least_n: f64) -> bool {
        let [stress] = &self.basis[..] else { return !self.basis.is_empty() };
        let limits = system.members().iter().zip(axial).zip(stress).filter_map(|((m, n), s)| {
            let sign = match m.kind {
                Kind::Bar => return None,
                Kind::Cable => 1.0,
                Kind::Strut => -1.0,
            };
            (n.abs() <= least_n && s.abs() > TAKES_PART).then_some(sign * s)
        });
        let limits: Vec<f64> = limits.collect();
        limits.iter().all(|s| *s > 0.0) || limits.iter().all(|s| *s < 0.0)
    }

    /// What axial forces without any load leave along the free motions of the joints.
    pub(super) fn left_by(&self, system: &System, axial: &[f64]) -> Vec<f64> {
        let mut left = vec![[0.0; 3]; self.free.len()];
        for (k, (member, force)) in system.members().iter().zip(axial).enumerate() {
            // A member without length, or one that is slack, carries nothing.
            if force.abs() > 0.0 {
                for (joint, pull) in self.pulls(member, k) {
                    left[joint] = plus(left[joint], times(*force, pull));
                }
            }
        }
        let joints = self.free.iter().zip(left);
        joints.flat_map(|(free, left)| free.iter().map(move |axis| dot(*axis, left))).collect()
    }

    /// The part of axial forces that is a self-stress.
    pub(super) fn part_of(&self, axial: &[f64]) -> Vec<f64> {
        onto(&self.basis, axial)
    }

    /// The pulls of a member at its two ends under this axial force, each from the end inwards, N.
    pub(super) fn pull(&self, member: usize, axial: f64) -> [Vector; 2] {
        let last = self.ropes.get(&member).and_then(|spans| spans.last()).map(|(_, along)| *along);
        let first = self.along[member];
        [times(axial, first), times(-axial, last.unwrap_or(first))]
    }

    /// The joints that a member pulls under a unit force, and how.
    pub(super) fn pulls<'a>(
        &'a self,
        member: &Member,
        k: usize,
    ) -> impl Iterator<Item = (usize, Vector)> + 'a {
        let own = ([member.from, member.to], self.along[k]);
        let rope = self.ropes.get(&k);
        let straight = rope.is_none().then_some(own);
        let spans = rope.into_iter().flatten().copied().chain(straight);
        spans.flat_map(|([a, b], along)| [(a, along), (b, times(-1.0, along))])
    }

    /// How far axial forces are from the share of equally stiff members: least $\sum N^2 l$ among
    /// all that balance the same loads, $S^T L N = 0$ for every self-stress $S$. The largest change
    /// of a force, N. What is at the limit of its kind, a cable without force, stays there, and so
    /// does the floor under a joint that it does not push.
    pub(super) fn off_equally_stiff_n(
        &self,
        system: &System,
        answer: &SystemEquilibrium,
        least_n: f64,
    ) -> f64 {
        let axial = &answer.axial_n;
        let roots = roots(system);
        let Some(stresses) = self.within_signs(system, answer, least_n) else { return f64::NAN };
        let weighed = |force: &[f64]| force.iter().zip(&roots).map(|(n, root)| n * root).collect();
        let stiff: Vec<Vec<f64>> = stresses.iter().map(|stress| weighed(stress)).collect();
        let change = onto(&orthonormal(stiff), &weighed(axial));
        change.iter().zip(&roots).map(|(n, root)| (n / root).abs()).fold(0.0, worse)
    }

    /// The self-stresses that change nothing that is at the limit of its kind.
    fn within_signs(
        &self,
        system: &System,
        answer: &SystemEquilibrium,
        least_n: f64,
    ) -> Option<Vec<Vec<f64>>> {
        let at_limit = |(k, member): (usize, &Member)| {
            (member.kind != Kind::Bar && answer.axial_n[k].abs() <= least_n).then_some(k)
        };
        let members: Vec<usize> =
            system.members().iter().enumerate().filter_map(at_limit).collect();
        let joints: Vec<usize> = (0..self.free.len())
            .filter(|k| {
                let support = &system.joints()[*k].support;
                self.free[*k].len() < support.motions().len()
                    && push_n(system, answer, *k).abs() <= least_n
            })
            .collect();
        let rises = |stress: &[f64], joint: usize| -> f64 {
            let members = system.members().iter().zip(stress).enumerate();
            members
                .filter(|(_, (_, n))| n.abs() > 0.0)
                .flat_map(|(k, (member, n))| self.pulls(member, k).map(move |pull| (pull, n)))
                .map(|((at, pull), n)| if at == joint { n * pull[2] } else { 0.0 })
                .sum()
        };
        let limits =
            DMatrix::from_fn(self.basis.len(), members.len() + joints.len(), |row, column| {
                let stress = &self.basis[row];
                members.get(column).map_or_else(
                    || rises(stress, joints[column - members.len()]),
                    |member| stress[*member],
                )
            });
        let parts = null_rows(&limits)?.rows;
        let sum = |parts: Vec<f64>| {
            let mut whole = vec![0.0; self.along.len()];
            for (part, stress) in parts.iter().zip(&self.basis) {
                whole.iter_mut().zip(stress).for_each(|(whole, n)| *whole += part * n);
            }
            whole
        };
        Some(parts.into_iter().map(sum).collect())
    }

    /// Of each inextensible member that has its length, the part of distance less length that no
    /// other shape would remove: with $e$ the misfits, $S$ the self-stresses and $L$ the lengths,
    /// $L S (S^T L S)^{-1} S^T e$. The rest is zero at the shape that meets all lengths best, $R^T
    /// L^{-1} e = 0$ with the rigidity matrix $R$.
    pub(super) fn unremovable_m(&self, system: &System) -> Vec<f64> {
        let roots = roots(system);
        let misfits: Vec<f64> = self.misfit_m.iter().map(|e| e.unwrap_or(0.0)).collect();
        if !self.counted && self.basis.is_empty() {
            // More lengths than coordinates overdetermine the shape; which of them is not known.
            let over = self.counts.self_stresses > 0;
            return if over { misfits } else { vec![0.0; misfits.len()] };
        }
        let stiff = self.basis.iter().map(|s| s.iter().zip(&roots).map(|(n, r)| n * r).collect());
        let weighed: Vec<f64> = misfits.iter().zip(&roots).map(|(e, root)| e / root).collect();
        let part = onto(&orthonormal(stiff.collect()), &weighed);
        part.iter().zip(&roots).map(|(e, root)| e * root).collect()
    }
}

/// Roots of the lengths.
fn roots(system: &System) -> Vec<f64> {
    system.members().iter().map(|member| member.body.length_m().sqrt()).collect()
}

/// Whether more inextensible members have their lengths than joints have motions, by two at least: some of the forces are open
/// then, as in a shape whose self-stresses are counted.
pub(super) fn has_more_lengths(system: &System, answer: &SystemEquilibrium) -> bool {
    let of_all: usize = system.joints().iter().map(|joint| joint.support.motions().len()).sum();
    // A floor takes one of each joint at most; long chains have far more, and need no lists.
    let least =
        of_all - if system.floor_m().is_some() { system.joints().len().min(of_all) } else { 0 };
    let rigid = system.members().iter().filter(|member| member.stiffness_n.is_none());
    if rigid.count() < least + 2 {
        return false;
    }
    let motions = motions_above_floor(system, answer).iter().map(Vec::len).sum::<usize>();
    let members = system.members().iter().zip(&answer.axial_n);
    let kept = members.filter(|(member, axial_n)| {
        misfit(member, length_m(member, &answer.joints_m), axial_n.abs() > 0.0).is_some()
    });
    kept.count() >= motions + 2
}

/// Distance less length of an inextensible member that has its length: a cable or strut without
/// force to rounding alone, for else it is slack.
fn misfit(member: &Member, distance_m: f64, bears: bool) -> Option<f64> {
    let length_m = member.body.length_m();
    let misfit_m = distance_m - length_m;
    let rigid = member.kind == Kind::Bar || bears;
    let within_m = if rigid { member.within_m() } else { LENGTH_ROUNDING * length_m };
    (member.stiffness_n.is_none() && misfit_m.abs() <= within_m).then_some(misfit_m)
}

/// The projection of a vector onto the space of an orthonormal basis.
fn onto(basis: &[Vec<f64>], vector: &[f64]) -> Vec<f64> {
    let mut part = vec![0.0; vector.len()];
    for axis in basis {
        let share: f64 = axis.iter().zip(vector).map(|(a, v)| a * v).sum();
        part.iter_mut().zip(axis).for_each(|(part, a)| *part += share * a);
    }
    part
}

/// An orthonormal basis of the same space, by Gram and Schmidt, twice.
fn orthonormal(vectors: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = vec![];
    for mut vector in vectors {
        for _ in 0..2 {
            let part = onto(&basis, &vector);
            vector.iter_mut().zip(part).for_each(|(v, part)| *v -= part);
            let Some(unit) = normalised(&vector) else { break };
            vector = unit;
        }
        basis.push(vector);
    }
    basis
}

fn size(vector: &[f64]) -> f64 {
    vector.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A vector of unit length; without value of one that vanishes.
pub(super) fn normalised(vector: &[f64]) -> Option<Vec<f64>> {
    let size = size(vector);
    (size > 0.0).then(|| vector.iter().map(|x| x / size).collect())
}

/// A unit force in one member.
fn unit(member: usize, members: usize) -> Vec<f64> {
    (0..members).map(|k| if k == member { 1.0 } else { 0.0 }).collect()
}

/// Of each joint the directions in which it may move; along the floor, of those that touch it.
pub(super) fn motions_above_floor(system: &System, answer: &SystemEquilibrium) -> Vec<Vec<Vector>> {
    let joints = system.joints().iter().zip(&answer.joints_m);
    let Some(floor_m) = system.floor_m() else {
        return joints.map(|(joint, _)| joint.support.motions()).collect();
    };
    let rounding_m = rounding_m(system, answer);
    let rigid = system.members().iter().filter(|m| m.kind == Kind::Bar && m.stiffness_n.is_none());
    let off = rigid.map(|bar| (length_m(bar, &answer.joints_m) - bar.body.length_m()).abs());
    let near_m = rounding_m + off.fold(0.0, f64::max).min(LEFT_OF_LENGTHS * rounding_m);
    let motions_of = |(joint, at_m): (&Joint, &Vector)| {
        let touches = at_m[2] - floor_m <= near_m;
        if touches { sliding(&joint.support) } else { joint.support.motions() }
    };
    joints.map(motions_of).collect()
}

/// The vectors whose combination of the rows of a matrix vanishes.
struct Null {
    /// An orthonormal basis of them.
    rows: Vec<Vec<f64>>,
    /// What counts as vanishing.
    zero: f64,
    /// Singular values that count.
    rank: usize,
    /// The smallest of them and the largest other one, over the largest.
    gap: [f64; 2],
}

fn null_rows(matrix: &DMatrix<f64>) -> Option<Null> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    if rows == 0 || columns == 0 {
        let rows = (0..rows).map(|k| unit(k, rows)).collect();
        return Some(Null { rows, zero: 0.0, rank: 0, gap: [1.0, 0.0] });
    }
    let kernels = Kernels::at_scale(matrix, RANK, 1.0)?;
    let Kernels { rank, gap, largest, .. } = kernels;
    let left = kernels.left();
    let rows = left.column_iter().map(|stress| stress.iter().copied().collect()).collect();
    Some(Null { rows, zero: RANK * largest, rank, gap })
}

#[cfg(test)]
mod tests;
