//! Joints whose places equilibrium leaves open.
//!
//! A joint that nothing loads, and whose members bear no force, is in equilibrium wherever the
//! lengths of these members let it be. That no force is borne is proved joint by joint: a slack
//! member bears none, and at a joint without load neither do members in independent directions.
//! What room the lengths leave follows from their derivative: with independent rows, fewer than
//! there are coordinates, the places are a manifold (implicit function theorem), and the joints
//! that its tangents move are free. So are joints that lie on the floor with members that bear nothing, where the lengths leave
//! them room to slide.

use matrices::dense::Kernels;
use model::Vector;
use model::system::{Kind, Member, Support, System, SystemEquilibrium};

use super::certificate::{along_supports, joint_loads, largest_force_n, total_load_n};
use super::family::motions;
use super::floor::{push_n, sliding};
use super::spans::{gradient, length_m};
use nalgebra::DMatrix;
use numerics::vector::{cross, dot, norm};

/// Slack by this part of the length: far above the rounding of places, far below what anybody calls
/// slack.
const CLEAR: f64 = 1e-6;
/// Directions, or rows of lengths, with a volume or a singular value above this part of the largest
/// are independent: far above the rounding of places.
const INDEPENDENT: f64 = 1e-6;
/// Joints of which the room is looked at together: dense singular values.
const TOGETHER: usize = 80;

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
    let unloaded = unloaded(system, answers);
    let mut free = lie_loose(system, answers);
    if unloaded.contains(&true) {
        let members_of = members_of(system);
        let bears = bearing(system, answers, &members_of, &unloaded);
        let idle: Vec<bool> = (0..joints)
            .map(|joint| unloaded[joint] && members_of[joint].iter().all(|k| !bears[*k]))
            .collect();
        for part in parts(system, &members_of, &idle) {
            let room = with_room(system, answers, &members_of, &part, &IN_SPACE);
            for (joint, open) in part.iter().zip(room) {
                free[*joint] |= open;
            }
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
    if !joint_loads(system).iter().any(still) {
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

/// Which joints nothing but the floor acts on in every answer, and can slide on it.
fn lie_loose(system: &System, answers: &[SystemEquilibrium]) -> Vec<bool> {
    /// A force below this part of the largest is none, or of all that acts where that is less: far
    /// above the error of forces.
    const NONE: f64 = 1e-8;
    let joints = system.joints();
    let slides = |joint: usize| !sliding(&joints[joint].support).is_empty();
    let mut loose: Vec<bool> = (0..joints.len())
        .map(|joint| {
            slides(joint) && answers.iter().all(|answer| push_n(system, answer, joint) > 0.0)
        })
        .collect();
    if !loose.contains(&true) {
        return loose;
    }
    let acts_n = total_load_n(system);
    let acts_n = if acts_n > 0.0 { acts_n } else { f64::INFINITY };
    for answer in answers {
        let least_n = NONE * largest_force_n(answer).min(acts_n);
        for (member, axial_n) in system.members().iter().zip(&answer.axial_n) {
            if axial_n.abs() > least_n {
                for joint in member.path() {
                    loose[joint] = false;
                }
            } else if !is_slack_by(ON_FLOOR.clear, member, answer) {
                // At a member that is upright, and just as long as it is high, a joint would have to rise.
                for (joint, pull) in gradient(member.spans(), &answer.joints_m) {
                    let axes = sliding(&joints[joint].support);
                    loose[joint] &= axes.iter().any(|axis| dot(pull, *axis).abs() > INDEPENDENT);
                }
            }
        }
    }
    let members_of = members_of(system);
    for part in parts(system, &members_of, &loose) {
        // Of the long rest of a mooring line all is taken to slide: there is more room than bars.
        if part.len() > TOGETHER {
            continue;
        }
        let room = with_room(system, answers, &members_of, &part, &ON_FLOOR);
        for (joint, open) in part.iter().zip(room) {
            loose[*joint] = open;
        }
    }
    loose
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

/// Joints that can move, on which and on whose members nothing acts.
fn unloaded(system: &System, answers: &[SystemEquilibrium]) -> Vec<bool> {
    let still = |force: Vector| force.iter().all(|x| x.abs() <= 0.0);
    let mut unloaded: Vec<bool> = system
        .joints()
        .iter()
        .map(|j| !j.support.is_fixed() && j.mass_kg <= 0.0 && still(j.force_n))
        .collect();
    for (k, unloaded) in unloaded.iter_mut().enumerate() {
        *unloaded &= answers.iter().all(|answer| push_n(system, answer, k) <= 0.0);
    }
    for member in system.members() {
        let light = member.body.mass_kg() <= 0.0 && member.loads.iter().all(|l| still(l.force_n));
        if !light {
            unloaded[member.from] = false;
            unloaded[member.to] = false;
        }
    }
    unloaded
}

/// Which members may bear a force.
fn bearing(
    system: &System,
    answers: &[SystemEquilibrium],
    members_of: &[Vec<usize>],
    unloaded: &[bool],
) -> Vec<bool> {
    let members = system.members();
    let mut bears: Vec<bool> =
        members.iter().map(|member| !answers.iter().all(|a| is_slack(member, a))).collect();
    let mut open: Vec<usize> = (0..unloaded.len()).filter(|joint| unloaded[*joint]).collect();
    while let Some(joint) = open.pop() {
        let here: Vec<usize> = members_of[joint].iter().copied().filter(|k| bears[*k]).collect();
        let apart = |answer: &SystemEquilibrium| {
            let along = here.iter().flat_map(|k| pulls(system, *k, answer));
            let along = along.filter(|(end, _)| *end == joint).map(|(_, along)| along);
            independent(&along.collect::<Vec<_>>())
        };
        if !here.is_empty() && answers.iter().all(apart) {
            for k in here {
                bears[k] = false;
                let others = members[k].path();
                open.extend(others.filter(|other| *other != joint && unloaded[*other]));
            }
        }
    }
    bears
}

/// The derivatives of the length of a member by the places of its joints, along what their supports leave free.
fn pulls(system: &System, k: usize, answer: &SystemEquilibrium) -> Vec<(usize, Vector)> {
    let all = gradient(system.members()[k].spans(), &answer.joints_m).into_iter();
    all.map(|(joint, pull)| (joint, along_supports(system, joint, pull))).collect()
}

/// Whether vectors are independent; NaN never is.
fn independent(along: &[Vector]) -> bool {
    match *along {
        [one] => norm(one) > INDEPENDENT,
        [a, b] => norm(cross(a, b)) > INDEPENDENT,
        [a, b, c] => dot(cross(a, b), c).abs() > INDEPENDENT,
        _ => false,
    }
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
        seen[start] = true;
        let (mut part, mut next) = (vec![start], 0);
        while let Some(&joint) = part.get(next) {
            next += 1;
            for &k in &members_of[joint] {
                for end in system.members()[k].path() {
                    if marked[end] && !std::mem::replace(&mut seen[end], true) {
                        part.push(end);
                    }
                }
            }
        }
        parts.push(part);
    }
    parts
}

/// How joints may move.
struct Way {
    /// The directions that a support leaves.
    motions: fn(&Support) -> Vec<Vector>,
    /// Members slack by more than this part of their length hold nothing.
    clear: f64,
}

const IN_SPACE: Way = Way { motions, clear: CLEAR };
/// Of members that bear nothing, so that any length to spare, above the rounding of places, lets a joint slide.
const ON_FLOOR: Way = Way { motions: sliding, clear: 1e-12 };

/// Which of some joints can move, all others held, while no taut member changes its length: in every answer in which
/// the lengths are independent. Where they are not, as in a line folded onto itself, another answer has to tell.
fn with_room(
    system: &System,
    answers: &[SystemEquilibrium],
    members_of: &[Vec<usize>],
    part: &[usize],
    way: &Way,
) -> Vec<bool> {
    let room = answers.iter().filter_map(|answer| room(system, answer, members_of, part, way));
    let all = room.reduce(|a, b| a.into_iter().zip(b).map(|(a, b)| a && b).collect());
    all.unwrap_or_else(|| vec![false; part.len()])
}

fn room(
    system: &System,
    answer: &SystemEquilibrium,
    members_of: &[Vec<usize>],
    part: &[usize],
    way: &Way,
) -> Option<Vec<bool>> {
    let mut taut: Vec<usize> = part.iter().flat_map(|joint| members_of[*joint].clone()).collect();
    taut.retain(|k| !is_slack_by(way.clear, &system.members()[*k], answer));
    taut.sort_unstable();
    taut.dedup();
    if taut.is_empty() {
        return Some(vec![true; part.len()]);
    }
    // The coordinates of each joint along what its support leaves free.
    let axes: Vec<(usize, Vector)> = part
        .iter()
        .enumerate()
        .flat_map(|(at, joint)| {
            (way.motions)(&system.joints()[*joint].support).into_iter().map(move |axis| (at, axis))
        })
        .collect();
    let (rank, coordinates) = (taut.len(), axes.len());
    if part.len() > TOGETHER || rank >= coordinates {
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
