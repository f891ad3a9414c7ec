//! What is proved of rank and stability, by a road that neither solver takes: Cholesky's factorisation
//! of a sparse matrix in floating point, and a bound of its rounding (module `definite`).
//!
//! With the derivatives $g$ of the lengths of the inextensible members that have their length as rows $R$ (of
//! a rope the sum over its spans), the
//! matrix $R R^T$ is positive definite exactly where the rows are independent: no self-stress, and the
//! forces follow from the shape. With the Hessian $H$ of the energy and any $c > 0$
//!
//! $$ H + c R^T R > 0 \quad\Rightarrow\quad v^T H v > 0 \text{ for all } v \ne 0 \text{ with } R v =
//! 0 , $$
//!
//! and the energy rises along every motion that keeps the lengths. Both statements are about the
//! places and forces as they are stored. The converse of the second holds for large $c$ alone (P.
//! Finsler, Comment. Math. Helv. 9 (1937) 188-192, doi:10.1007/BF01258188); where this $c$ proves
//! nothing, nothing is claimed.

use model::system::{Kind, Member, System, SystemEquilibrium};
use model::{Proved, Vector};

use super::definite::{Symmetric, gamma};
use super::family::motions_above_floor;
use super::spans::{self, has_corner};
use numerics::vector::{dot, minus, norm};

/// A member that is this near its length, as a part of it, has it.
const TAUT: f64 = model::system::LENGTH_ROUNDING;
/// The factor $c$ over the largest entry of the Hessian: far above the curvature of the energy, and
/// far below what would drown it in rounding.
const PENALTY: f64 = 1e4;
/// Members, and coordinates, up to which proofs are tried: their factorisations cost no more than the
/// solvers' own.
const MOST: usize = 3000;
/// Roundings of a unit vector, of its component along a motion, and of the products of an entry.
const ENTRY_ROUNDINGS: usize = 64;

/// One member in action.
struct Acting {
    /// The derivative of its length by the place of each of its joints.
    gradient: Vec<(usize, Vector)>,
    /// Second derivative of its energy by its length, N/m; infinite for one that keeps its length.
    stiffness: f64,
    /// The joints of each of its spans, its direction, and its force over its length, N/m.
    spans: Vec<([usize; 2], Vector, f64)>,
}

impl Acting {
    /// How many ends of its spans are at a joint.
    fn ends_at(&self, joint: usize) -> usize {
        self.spans.iter().flat_map(|(ends, ..)| ends).filter(|end| **end == joint).count()
    }
}

/// What is proved of an answer.
pub(super) fn proved(system: &System, answer: &SystemEquilibrium) -> Option<Proved> {
    let joints = system.joints().len();
    let members = system.members().len();
    // Asked first: what follows holds far more for each member than its answer.
    if members > MOST || [answer.joints_m.len(), answer.axial_n.len()] != [joints, members] {
        return None;
    }
    let acting: Vec<Acting> = (0..members).filter_map(|k| acting(system, answer, k)).collect();
    // A span without length is a corner of the energy.
    let corner = |(_, unit, _): &([usize; 2], Vector, f64)| norm(*unit) <= 0.0;
    if has_corner(system, answer) || acting.iter().flat_map(|member| &member.spans).any(corner) {
        return None;
    }
    let free: Vec<Vec<Vector>> =
        system.joints().iter().map(|joint| joint.support.motions()).collect();
    if free.iter().map(Vec::len).sum::<usize>() > MOST {
        return None;
    }
    // What the floor bears is a force as those of members are.
    let on_floor = motions_above_floor(system, answer);
    Proved::of(is_independent(&acting, &on_floor), is_stable(&acting, &free))
}

/// A member that bears a force, or would along its own direction.
fn acting(system: &System, answer: &SystemEquilibrium, k: usize) -> Option<Acting> {
    let (member, joints_m): (&Member, _) = (&system.members()[k], &answer.joints_m);
    let (length_m, axial_n) = (member.body.length_m(), answer.axial_n[k]);
    let distance_m = spans::length_m(member, joints_m);
    let stretched = distance_m - length_m;
    let idle = axial_n.abs() <= 0.0;
    let acts = match (member.stiffness_n, member.kind) {
        (_, Kind::Bar) => true,
        (Some(_), Kind::Cable) => stretched > 0.0,
        (Some(_), Kind::Strut) => stretched < 0.0,
        // At its length without force it may act or not: it is a row of its own, and adds nothing
        // to the curvature.
        (None, _) => !idle || stretched.abs() <= TAUT * length_m,
    };
    let span = |[a, b]: [usize; 2]| {
        let long_m = norm(minus(joints_m[b], joints_m[a]));
        let density = if idle || long_m <= 0.0 { 0.0 } else { axial_n / long_m };
        ([a, b], spans::unit([a, b], joints_m), density)
    };
    (acts && distance_m > 0.0).then(|| Acting {
        gradient: spans::gradient(member.spans(), joints_m),
        stiffness: member.stiffness_n.map_or(f64::INFINITY, |n| n / length_m),
        spans: member.spans().map(span).collect(),
    })
}

/// Whether the lengths are proved to be independent.
fn is_independent(acting: &[Acting], free: &[Vec<Vector>]) -> bool {
    let rigid: Vec<&Acting> = acting.iter().filter(|m| m.stiffness.is_infinite()).collect();
    let mut at_joint: Vec<Vec<(usize, Vec<f64>)>> = vec![vec![]; free.len()];
    for (row, member) in rigid.iter().enumerate() {
        for (joint, along) in &member.gradient {
            at_joint[*joint].push((row, seen(&free[*joint], *along)));
        }
    }
    let (mut diagonal, mut below) = (vec![0.0; rigid.len()], vec![]);
    let mut sums = vec![0.0_f64; rigid.len()];
    for (joint, rows) in at_joint.iter().enumerate() {
        for (k, (row, own)) in rows.iter().enumerate() {
            for (column, theirs) in &rows[..=k] {
                let value: f64 = own.iter().zip(theirs).map(|(a, b)| a * b).sum();
                let size = (rigid[*row].ends_at(joint) * rigid[*column].ends_at(joint)) as f64;
                if row == column {
                    diagonal[*row] += value;
                } else {
                    below.push((*row.max(column), *row.min(column), value));
                    sums[*column] += size;
                }
                sums[*row] += size;
            }
        }
    }
    let largest = sums.into_iter().fold(0.0, f64::max);
    let uncertainty = gamma(roundings(acting)) * largest;
    Symmetric { size: rigid.len(), below, diagonal, uncertainty }.least_eigenvalue(0.0).is_some()
}

/// Whether the energy is proved to rise along every motion that keeps the lengths.
fn is_stable(acting: &[Acting], free: &[Vec<Vector>]) -> bool {
    let firsts: Vec<usize> = free
        .iter()
        .scan(0, |next, axes| {
            let first = *next;
            *next += axes.len();
            Some(first)
        })
        .collect();
    let size = free.iter().map(Vec::len).sum();
    let curvatures = acting.iter().flat_map(|m| m.spans.iter().map(|(.., density)| density.abs()));
    let springs = acting.iter().map(|m| m.stiffness).filter(|stiffness| stiffness.is_finite());
    let penalty = PENALTY * curvatures.chain(springs).fold(0.0, f64::max);
    let (mut diagonal, mut below) = (vec![0.0; size], vec![]);
    let mut add = |[a, b]: [usize; 2], block: &dyn Fn(&Vector, &Vector) -> f64| {
        for (i, x) in free[a].iter().enumerate() {
            for (k, y) in free[b].iter().enumerate() {
                let (row, column) = (firsts[a] + i, firsts[b] + k);
                if row == column {
                    diagonal[row] += block(x, y);
                } else if row > column {
                    below.push((row, column, block(x, y)));
                }
            }
        }
    };
    let mut sums = vec![0.0_f64; free.len()];
    for member in acting {
        let axial = if member.stiffness.is_finite() { member.stiffness } else { penalty };
        for (a, along) in &member.gradient {
            sums[*a] += axial.abs() * (member.ends_at(*a) * 2 * member.spans.len()) as f64;
            for (b, other) in &member.gradient {
                add([*a, *b], &|x, y| axial * dot(*x, *along) * dot(*y, *other));
            }
        }
        for (ends, along, density) in &member.spans {
            for a in ends {
                sums[*a] += 4.0 * density.abs();
                for b in ends {
                    let sign = if a == b { 1.0 } else { -1.0 };
                    let across =
                        |x: &Vector, y: &Vector| dot(*x, *y) - dot(*x, *along) * dot(*y, *along);
                    add([*a, *b], &|x, y| sign * density * across(x, y));
                }
            }
        }
    }
    // A row holds three axes of each joint.
    let largest = sums.into_iter().fold(0.0, f64::max);
    let uncertainty = gamma(roundings(acting)) * 3.0 * largest;
    Symmetric { size, below, diagonal, uncertainty }.least_eigenvalue(0.0).is_some()
}

/// Components along the motions of a joint.
fn seen(axes: &[Vector], along: Vector) -> Vec<f64> {
    axes.iter().map(|axis| dot(*axis, along)).collect()
}

/// Roundings of an entry: each further span of a rope adds one to the derivatives of its length.
fn roundings(acting: &[Acting]) -> usize {
    ENTRY_ROUNDINGS + 2 * acting.iter().map(|member| member.spans.len() - 1).max().unwrap_or(0)
}

#[cfg(test)]
mod tests;
