//! Joints whose places equilibrium leaves open.
//!
//! A joint on which nothing acts along what it may move, and whose members bear nothing, is in equilibrium wherever the
//! lengths of these members let it be; one that the floor pushes is so along the floor. What room the lengths leave
//! follows from their derivative: with independent rows, fewer than there are coordinates, the places are a manifold
//! (implicit function theorem), and the joints that its tangents move are free.

use matrices::dense::Kernels;
use model::Vector;
use model::system::{Kind, Member, System, SystemEquilibrium};

use super::certificate::largest_force_n;
use super::floor::{push_n, sliding};
use super::spans::{connected, gradient, length_m};
use nalgebra::DMatrix;
use numerics::vector::{dot, norm};

/// Slack by this part of the length: far above the rounding of places, far below what anybody calls
/// slack.
const CLEAR: f64 = 1e-6;
/// Members that bear nothing are slack where they are shorter by this part: above the rounding of places.
const SHORTER: f64 = 1e-12;
/// A force below this part of the least load, or of the largest force, is none: far above the error of forces.
const NOTHING: f64 = 1e-8;
/// Rows of lengths with a singular value above this part of the largest are independent: far above the rounding of places.
const INDEPENDENT: f64 = 1e-6;
/// Joints of which the room is looked at together: dense singular values.
const TOGETHER: usize = 80;

/// The directions in which a joint may move.
type Ways<'a> = &'a dyn Fn(usize) -> Vec<Vector>;

/// Which joints an equilibrium leaves free, by every one of the answers: on which nothing acts but
/// the floor perhaps.
pub(crate) fn free_joints(system: &System, answers: &[SystemEquilibrium]) -> Vec<bool> {
    let joints = system.joints().len();
    let complete = |answer: &SystemEquilibrium| {
        [answer.joints_m.len(), answer.reactions_n.len()] == [joints; 2]
            && answer.axial_n.len() == system.members().len()
    };
    if !answers.iter().all(complete) {
        return vec![false; joints];
    }
    let pushed = |joint: usize| answers.iter().all(|answer| push_n(system, answer, joint) > 0.0);
    let ways = |joint: usize| {
        let support = &system.joints()[joint].support;
        if pushed(joint) { sliding(support) } else { support.motions() }
    };
    let idle = idle(system, answers, &ways);
    let members_of = if idle.contains(&true) { members_of(system) } else { vec![] };
    let mut free = vec![false; joints];
    for part in parts(system, &members_of, &idle) {
        // Of the long rest of a mooring line all is taken to slide: there is more room than bars.
        if part.len() > TOGETHER {
            for joint in &part {
                free[*joint] = pushed(*joint);
            }
            continue;
        }
        for (joint, open) in part.iter().zip(with_room(system, answers, &members_of, &part, &ways))
        {
            free[*joint] = open;
        }
    }
    for joint in in_row(system, answers) {
        free[joint] = true;
    }
    free
}

/// The free joints of a row between two anchors: however long it is, the lengths tell.
fn in_row(system: &System, answers: &[SystemEquilibrium]) -> Vec<usize> {
    // Bars bear nothing between joints without any load alone.
    let still = |load: &Vector| load.iter().all(|x| x.abs() <= 0.0);
    if !system.joint_loads_n().iter().any(still) {
        return vec![];
    }
    let Some(row) = system.as_row() else { return vec![] };
    let mut free = answers.iter().map(|answer| {
        let places: Vec<Vector> = row.joints().map(|k| answer.joints_m[k]).collect();
        crate::free::free_joints(row.problem().chain(), &places).map(|(_, free)| free)
    });
    match free.next().flatten() {
        Some(first) if free.all(|other| other.as_ref() == Some(&first)) => {
            row.joints().take(first.end() + 1).skip(*first.start()).collect()
        }
        _ => vec![],
    }
}

/// Which joints nothing acts on along these ways, nor any member, in every answer.
fn idle(system: &System, answers: &[SystemEquilibrium], ways: Ways<'_>) -> Vec<bool> {
    let mut idle = vec![true; system.joints().len()];
    let bears = |idle: &mut [bool], least_n: f64| {
        for answer in answers {
            let nothing_n = NOTHING * largest_force_n(answer).min(least_n);
            for (member, axial_n) in system.members().iter().zip(&answer.axial_n) {
                if axial_n.abs() > nothing_n {
                    member.path().for_each(|joint| idle[joint] = false);
                }
            }
        }
    };
    bears(&mut idle, f64::INFINITY);
    if !idle.contains(&true) {
        return idle;
    }
    let loads = system.joint_loads_n();
    // The least load holds the joints above it where they hang.
    let sizes = loads.iter().map(|load| norm(*load)).filter(|size_n| *size_n > 0.0);
    bears(&mut idle, sizes.fold(f64::INFINITY, f64::min));
    let is_still = |joint: usize| {
        let (load, ways) = (loads[joint], ways(joint));
        let acts = ways.iter().any(|way| dot(load, *way).abs() > f64::EPSILON * norm(load));
        !ways.is_empty() && !acts
    };
    for (joint, idle) in idle.iter_mut().enumerate() {
        *idle = *idle && is_still(joint);
    }
    idle
}

fn members_of(system: &System) -> Vec<Vec<usize>> {
    let mut members_of = vec![Vec::new(); system.joints().len()];
    for (k, member) in system.members().iter().enumerate() {
        for joint in member.path() {
            if members_of[joint].last() != Some(&k) {
                members_of[joint].push(k);
            }
        }
    }
    members_of
}

/// Whether a member is slack by more than any rounding.
pub(super) fn is_slack(member: &Member, answer: &SystemEquilibrium) -> bool {
    is_slack_by(CLEAR, member, answer)
}

fn is_slack_by(clear: f64, member: &Member, answer: &SystemEquilibrium) -> bool {
    let distance_m = length_m(member, &answer.joints_m);
    let length_m = member.body.length_m();
    match member.kind {
        Kind::Bar => false,
        Kind::Cable => distance_m < length_m * (1.0 - clear),
        Kind::Strut => distance_m > length_m * (1.0 + clear),
    }
}

/// Marked joints that members connect.
fn parts(system: &System, members_of: &[Vec<usize>], marked: &[bool]) -> Vec<Vec<usize>> {
    let mut seen = vec![false; marked.len()];
    let mut parts = Vec::new();
    for start in (0..marked.len()).filter(|joint| marked[*joint]) {
        if seen[start] {
            continue;
        }
        let beside = |joint: usize| {
            let ends = members_of[joint].iter().flat_map(|k| system.members()[*k].path());
            ends.filter(|end| marked[*end])
        };
        parts.push(connected(start, &mut seen, beside));
    }
    parts
}

/// Which of some joints can move, all others held, while no taut member changes its length: in every answer in which
/// the lengths are independent. Where they are not, as in a line folded onto itself, another answer has to tell.
fn with_room(
    system: &System,
    answers: &[SystemEquilibrium],
    members_of: &[Vec<usize>],
    part: &[usize],
    ways: Ways<'_>,
) -> Vec<bool> {
    let room = answers.iter().filter_map(|answer| room(system, answer, members_of, part, ways));
    let all = room.reduce(|a, b| a.into_iter().zip(b).map(|(a, b)| a && b).collect());
    all.unwrap_or_else(|| vec![false; part.len()])
}

fn room(
    system: &System,
    answer: &SystemEquilibrium,
    members_of: &[Vec<usize>],
    part: &[usize],
    ways: Ways<'_>,
) -> Option<Vec<bool>> {
    let mut taut: Vec<usize> = part.iter().flat_map(|joint| members_of[*joint].clone()).collect();
    taut.retain(|k| !is_slack_by(SHORTER, &system.members()[*k], answer));
    taut.sort_unstable();
    taut.dedup();
    if taut.is_empty() {
        return Some(vec![true; part.len()]);
    }
    // The coordinates of each joint along what its support leaves free.
    let axes: Vec<(usize, Vector)> = part
        .iter()
        .enumerate()
        .flat_map(|(at, joint)| ways(*joint).into_iter().map(move |axis| (at, axis)))
        .collect();
    let (rank, coordinates) = (taut.len(), axes.len());
    if rank >= coordinates {
        return Some(vec![false; part.len()]);
    }
    let mut rows = DMatrix::<f64>::zeros(rank, coordinates);
    for (row, k) in taut.iter().enumerate() {
        for (joint, pull) in gradient(system.members()[*k].spans(), &answer.joints_m) {
            for (column, (at, axis)) in axes.iter().enumerate() {
                if part[*at] == joint {
                    rows[(row, column)] = dot(pull, *axis);
                }
            }
        }
    }
    let kernels = Kernels::new(&rows, INDEPENDENT).filter(|kernels| kernels.rank == rank)?;
    let right = kernels.right();
    let moves = |at: usize| {
        let own = axes.iter().enumerate().filter(|(_, (joint, _))| *joint == at);
        own.map(|(k, _)| right.row(k).norm_squared()).sum::<f64>().sqrt() > INDEPENDENT
    };
    Some((0..part.len()).map(moves).collect())
}

#[cfg(test)]
mod tests;
