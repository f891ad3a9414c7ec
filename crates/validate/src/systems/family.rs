//! Forces that the shape of a system leaves open: its self-stresses, from the places of its joints
//! alone.
//!
//! A self-stress is a set of axial forces of inextensible members that balances at every joint
//! along its free motions; a floor that a joint touches bears what is straight up. Where there are some, the forces of an equilibrium are one point of an
//! affine space; two answers are one if their difference is a self-stress.
//!
//! S. Pellegrino and C. R. Calladine, Int. J. Solids Struct. 22 (1986) 409-428,
//! doi:10.1016/0020-7683(86)90014-4

use faer::Mat;
use model::Vector;
use model::system::{Support, System, SystemEquilibrium};

use super::floor::sliding;
use crate::vector::{cross, dot, minus, norm, plus, times};

/// Free coordinates up to which the rank of the balances is counted: dense singular values.
const COUNTED: usize = 240;

/// A member this near its length, as a part of it, may carry force; so may the floor under a joint
/// that is this near to it, as a part of the longest member.
const TAUT: f64 = 1e-9;

/// Singular values of the balances below this part of the largest are zero: by the forces that go
/// with them the balances of joints change by less than what two answers may differ by.
const RANK: f64 = 1e-9;

/// The self-stresses of a shape.
pub(super) struct Family {
    /// Orthonormal, one axial force for each member.
    basis: Vec<Vec<f64>>,
    /// The most that one of them may leave at a joint.
    pub(super) rounding: f64,
    /// Unit vector along each member.
    along: Vec<Vector>,
    /// The motions of each joint; along the floor, of those that touch it.
    free: Vec<Vec<Vector>>,
}

impl Family {
    /// Count them; nothing where the system is too large, or the answer incomplete.
    pub(super) fn of(system: &System, answer: &SystemEquilibrium) -> Option<Self> {
        let members = system.members();
        if answer.joints_m.len() != system.joints().len() {
            return None;
        }
        let lengths_m = system.members().iter().map(|member| member.body.length_m());
        let near_m = TAUT * lengths_m.fold(0.0, f64::max);
        let floor_m = system.floor_m().unwrap_or(f64::NEG_INFINITY);
        let free = system.joints().iter().zip(&answer.joints_m).map(|(joint, at_m)| {
            let touches = at_m[2] - floor_m <= near_m;
            if touches { sliding(&joint.support) } else { motions(&joint.support) }
        });
        let free: Vec<Vec<Vector>> = free.collect();
        let coordinates: usize = free.iter().map(Vec::len).sum();
        if coordinates > COUNTED {
            return None;
        }
        let (mut along, mut taut) = (Vec::new(), Vec::new());
        for (k, member) in members.iter().enumerate() {
            let d = minus(answer.joints_m[member.to], answer.joints_m[member.from]);
            let (distance_m, length_m) = (norm(d), member.body.length_m());
            along.push(times(1.0 / distance_m, d));
            if member.stiffness_n.is_none() && (distance_m - length_m).abs() <= TAUT * length_m {
                taut.push(k);
            }
        }
        let family = Self { basis: vec![], rounding: 0.0, along, free };
        let balances: Vec<Vec<f64>> =
            taut.iter().map(|k| family.left_by(system, &unit(*k, members.len()))).collect();
        let balances = Mat::from_fn(taut.len(), coordinates, |row, column| balances[row][column]);
        let (stresses, rounding) = null_rows(&balances)?;
        let basis = stresses.into_iter().map(|stress| {
            let mut whole = vec![0.0; members.len()];
            for (&k, force) in taut.iter().zip(stress) {
                whole[k] = force;
            }
            whole
        });
        Some(Self { basis: basis.collect(), rounding, ..family })
    }

    /// Number of independent self-stresses.
    pub(super) fn dimension(&self) -> usize {
        self.basis.len()
    }

    /// What axial forces without any load leave along the free motions of the joints.
    pub(super) fn left_by(&self, system: &System, axial: &[f64]) -> Vec<f64> {
        let mut left = vec![[0.0; 3]; self.free.len()];
        for ((member, force), along) in system.members().iter().zip(axial).zip(&self.along) {
            // A member without length, or one that is slack, carries nothing.
            if force.abs() > 0.0 {
                left[member.from] = plus(left[member.from], times(*force, *along));
                left[member.to] = plus(left[member.to], times(-force, *along));
            }
        }
        let joints = self.free.iter().zip(left);
        joints.flat_map(|(free, left)| free.iter().map(move |axis| dot(*axis, left))).collect()
    }

    /// The part of axial forces that is a self-stress.
    pub(super) fn part_of(&self, axial: &[f64]) -> Vec<f64> {
        let mut part = vec![0.0; axial.len()];
        for stress in &self.basis {
            let share: f64 = stress.iter().zip(axial).map(|(s, a)| s * a).sum();
            for (part, s) in part.iter_mut().zip(stress) {
                *part += share * s;
            }
        }
        part
    }

    /// The pull of a member with this axial force on the joint where it begins.
    pub(super) fn pull(&self, member: usize, axial: f64) -> Vector {
        times(axial, self.along[member])
    }
}

/// A unit force in one member.
fn unit(member: usize, members: usize) -> Vec<f64> {
    (0..members).map(|k| if k == member { 1.0 } else { 0.0 }).collect()
}

/// Orthonormal directions in which a joint may move.
pub(super) fn motions(support: &Support) -> Vec<Vector> {
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    match *support {
        Support::Free => axes.to_vec(),
        Support::Fixed { .. } => vec![],
        Support::Line { direction, .. } => vec![times(1.0 / norm(direction), direction)],
        Support::Plane { normal, .. } => {
            let normal = times(1.0 / norm(normal), normal);
            let level = |axis: &Vector| dot(*axis, normal).abs();
            let helper = axes.into_iter().min_by(|a, b| level(a).total_cmp(&level(b)));
            let helper = helper.unwrap_or(axes[0]);
            let first = minus(helper, times(dot(helper, normal), normal));
            let first = times(1.0 / norm(first), first);
            vec![first, cross(normal, first)]
        }
    }
}

/// An orthonormal basis of the vectors whose combination of rows vanishes, and what counts as
/// vanishing.
fn null_rows(matrix: &Mat<f64>) -> Option<(Vec<Vec<f64>>, f64)> {
    let (rows, columns) = (matrix.nrows(), matrix.ncols());
    if rows == 0 {
        return Some((vec![], 0.0));
    }
    if columns == 0 {
        return Some(((0..rows).map(|k| unit(k, rows)).collect(), 0.0));
    }
    let svd = matrix.svd().ok()?;
    let values: Vec<f64> = (0..rows.min(columns)).map(|k| svd.S()[k]).collect();
    let most = values.iter().copied().fold(f64::MIN_POSITIVE, f64::max);
    let zero = RANK * most;
    let rank = values.iter().filter(|value| **value > zero).count();
    let stress = |k: usize| (0..rows).map(|row| svd.U()[(row, k)]).collect();
    Some(((rank..rows).map(stress).collect(), zero))
}

#[cfg(test)]
mod tests;
