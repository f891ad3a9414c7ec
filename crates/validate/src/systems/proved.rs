//! What is proved of rank and stability, by a road that neither solver takes: Cholesky's factorisation
//! of a sparse matrix in floating point, and a bound of its rounding (module `definite`).
//!
//! With the unit vectors $u$ of the inextensible members that have their length as rows $R$, the
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
use super::family::motions;
use numerics::vector::{dot, minus, norm, times};

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
    ends: [usize; 2],
    along: Vector,
    /// Second derivative of its energy along itself, N/m; infinite for one that keeps its length.
    stiffness: f64,
    /// Force over distance, N/m.
    density: f64,
}

/// What is proved of an answer.
pub(super) fn proved(system: &System, answer: &SystemEquilibrium) -> Option<Proved> {
    let joints = system.joints().len();
    let members = system.members().len();
    // The rows of ropes over rings and pulleys are not among those below.
    if [answer.joints_m.len(), answer.axial_n.len()] != [joints, members] || system.has_ropes() {
        return None;
    }
    let acting: Vec<Acting> = (0..members).filter_map(|k| acting(system, answer, k)).collect();
    let free: Vec<Vec<Vector>> =
        system.joints().iter().map(|joint| motions(&joint.support)).collect();
    if members.max(free.iter().map(Vec::len).sum()) > MOST {
        return None;
    }
    Proved::of(is_independent(&acting, &free), is_stable(&acting, &free))
}

/// A member that bears a force, or would along its own direction.
fn acting(system: &System, answer: &SystemEquilibrium, k: usize) -> Option<Acting> {
    let member: &Member = &system.members()[k];
    let d = minus(answer.joints_m[member.to], answer.joints_m[member.from]);
    let (distance_m, length_m, axial_n) = (norm(d), member.body.length_m(), answer.axial_n[k]);
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
    (acts && distance_m > 0.0).then(|| Acting {
        ends: [member.from, member.to],
        along: times(1.0 / distance_m, d),
        stiffness: member.stiffness_n.map_or(f64::INFINITY, |n| n / length_m),
        density: if idle { 0.0 } else { axial_n / distance_m },
    })
}

/// Whether the lengths are proved to be independent.
fn is_independent(acting: &[Acting], free: &[Vec<Vector>]) -> bool {
    let rigid: Vec<&Acting> = acting.iter().filter(|m| m.stiffness.is_infinite()).collect();
    let mut at_joint: Vec<Vec<(usize, f64)>> = vec![vec![]; free.len()];
    for (row, member) in rigid.iter().enumerate() {
        at_joint[member.ends[0]].push((row, -1.0));
        at_joint[member.ends[1]].push((row, 1.0));
    }
    let seen = |axes: &[Vector], along: Vector| -> Vec<f64> {
        axes.iter().map(|axis| dot(*axis, along)).collect()
    };
    let (mut diagonal, mut below) = (vec![0.0; rigid.len()], vec![]);
    let mut sums = vec![0.0_f64; rigid.len()];
    for (axes, rows) in free.iter().zip(&at_joint) {
        for (k, (row, sign)) in rows.iter().enumerate() {
            let own = seen(axes, rigid[*row].along);
            for (column, other) in &rows[..=k] {
                let theirs = seen(axes, rigid[*column].along);
                let product: f64 = own.iter().zip(&theirs).map(|(a, b)| a * b).sum();
                let value = sign * other * product;
                if row == column {
                    diagonal[*row] += value;
                } else {
                    below.push((*row.max(column), *row.min(column), value));
                    sums[*column] += 1.0;
                }
                sums[*row] += 1.0;
            }
        }
    }
    let largest = sums.into_iter().fold(0.0, f64::max);
    let uncertainty = gamma(ENTRY_ROUNDINGS) * largest;
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
    let curvatures = acting.iter().map(|m| m.density.abs());
    let springs = acting.iter().map(|m| m.stiffness).filter(|stiffness| stiffness.is_finite());
    let penalty = PENALTY * curvatures.chain(springs).fold(0.0, f64::max);
    let (mut diagonal, mut below) = (vec![0.0; size], vec![]);
    let mut sums = vec![0.0_f64; free.len()];
    for Acting { ends, along, stiffness, density } in acting {
        let axial = if stiffness.is_finite() { *stiffness } else { penalty + density };
        for joint in ends {
            sums[*joint] += axial.abs() + 2.0 * density.abs();
        }
        for a in ends {
            for b in ends {
                let sign = if a == b { 1.0 } else { -1.0 };
                for (i, x) in free[*a].iter().enumerate() {
                    for (k, y) in free[*b].iter().enumerate() {
                        let (row, column) = (firsts[*a] + i, firsts[*b] + k);
                        let across = density * (dot(*x, *y) - dot(*x, *along) * dot(*y, *along));
                        let value = sign * (across + axial * dot(*x, *along) * dot(*y, *along));
                        if row == column {
                            diagonal[row] += value;
                        } else if row > column {
                            below.push((row, column, value));
                        }
                    }
                }
            }
        }
    }
    // A row holds the three axes of its joint and as many of each neighbour.
    let largest = sums.into_iter().fold(0.0, f64::max);
    let uncertainty = gamma(ENTRY_ROUNDINGS) * 6.0 * largest;
    Symmetric { size, below, diagonal, uncertainty }.least_eigenvalue(0.0).is_some()
}

#[cfg(test)]
mod tests;
