//! Free turns: the bodies of one answer are turned onto those of another before the two are
//! compared.

use std::borrow::Cow;
use std::collections::BTreeMap;

use model::Vector;
use model::system::{Member, Support, System, SystemEquilibrium};

use super::bodies::{Bodies, Body, Slides};
use super::free::is_slack;
use super::spans::span_forces;
use super::statics::judge;
use super::verticals::firsts;
use crate::tolerances::Tolerances;
use numerics::vector::{minus, norm, plus, worse};

/// Verticals through several joints are looked at where their number times that of the joints is
/// at most this: each costs a visit of the joints.
const MOST_VISITS: usize = 4_000_000;

/// A turn about the vertical through one place, and a level move of that to another place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    from_m: [f64; 2],
    to_m: [f64; 2],
    cos: f64,
    sin: f64,
}

impl Turn {
    const NONE: Self = Self { from_m: [0.0; 2], to_m: [0.0; 2], cos: 1.0, sin: 0.0 };

    pub(crate) fn vector(&self, [x, y, z]: Vector) -> Vector {
        [self.cos * x - self.sin * y, self.sin * x + self.cos * y, z]
    }

    pub(crate) fn place(&self, [x, y, z]: Vector) -> Vector {
        let [x, y, z] = self.vector([x - self.from_m[0], y - self.from_m[1], z]);
        [x + self.to_m[0], y + self.to_m[1], z]
    }
}

/// The second answer with its freely moving bodies moved onto those of the first, and how many there are that a turn moves,
/// and that move in the level. Joints of `left_out` count for nothing in that.
///
/// What comes out is an answer as good as the one that went in: where the judge of statics finds a
/// larger violation in it than its budget, nothing is turned.
pub(crate) fn turned_onto<'a>(
    system: &System,
    first: &SystemEquilibrium,
    second: &'a SystemEquilibrium,
    left_out: &[bool],
) -> (Cow<'a, SystemEquilibrium>, [usize; 2]) {
    let as_it_is = (Cow::Borrowed(second), [0; 2]);
    let joints = system.joints().len();
    let complete = [&first.joints_m, &second.joints_m].map(Vec::len) == [joints; 2]
        && second.axial_n.len() == system.members().len()
        && [&second.start_forces_n, &second.end_forces_n].map(Vec::len)
            == [system.members().len(); 2]
        && second.reactions_n.len() == joints;
    if !complete || is_held_row(system, second) {
        return as_it_is;
    }
    let budget = Tolerances::project().statics;
    // What is slack in both holds nothing; the judge sees where a turn would make it taut.
    let holds = |member: &Member| ![first, second].iter().all(|answer| is_slack(member, answer));
    let mut bodies = Bodies::new(system, holds);
    let before = bodies.all.len();
    add_hinged(system, first, second, &mut bodies);
    if bodies.all.len() == 1 {
        return as_it_is;
    }
    let untouched = judge(system, second).largest();
    let sound = |bodies: &Bodies| {
        let turned = turned(system, second, bodies, &turns(bodies, first, second, left_out));
        let largest = judge(system, &turned).largest();
        let is_sound = largest <= budget || largest <= untouched;
        is_sound.then(|| (Cow::Owned(turned), moving(bodies, system, second)))
    };
    let hinges = before != bodies.all.len() && before != 1;
    // What hangs on single joints, without what hinges on several.
    let without = || sound(&Bodies::new(system, holds));
    sound(&bodies).or_else(|| if hinges { without() } else { None }).unwrap_or(as_it_is)
}

/// How many bodies a turn moves, none of which lies on its vertical, and how many move in the level.
fn moving(bodies: &Bodies, system: &System, answer: &SystemEquilibrium) -> [usize; 2] {
    let near_m = near_m(system, answer);
    let mut beside = vec![false; bodies.all.len()];
    for (body, at) in bodies.of_joint.iter().zip(&answer.joints_m) {
        if let Some(pivot) = bodies.all[*body].pivot {
            let [x, y, _] = minus(*at, answer.joints_m[pivot]);
            beside[*body] |= x.hypot(y) > near_m;
        }
    }
    let count = |is: &dyn Fn(usize) -> bool| (0..beside.len()).filter(|k| is(*k)).count();
    [count(&|body| beside[body]), count(&|body| bodies.all[body].slides != Slides::Not)]
}

/// Places that are nearer to each other than this are one, m.
fn near_m(system: &System, answer: &SystemEquilibrium) -> f64 {
    let origin_m = system.reference_m();
    let reach = answer.joints_m.iter().map(|place| norm(minus(*place, origin_m)));
    Tolerances::project().joints * reach.fold(0.0, worse)
}

/// Whether nothing of a row can turn: its anchors are not on one vertical, and its level pull, which
/// is the same all along it, is felt.
fn is_held_row(system: &System, answer: &SystemEquilibrium) -> bool {
    let Some(row) = system.as_row() else { return false };
    let sizes_n = answer.end_forces_n.iter().map(|force| norm(*force));
    let largest_n = sizes_n.fold(0.0, worse);
    let Some(first) = row.joints().next() else { return false };
    let [x, y, _] = answer.reactions_n[first];
    !row.problem().chain().anchors_on_one_vertical()
        && x.hypot(y) > Tolerances::project().forces * largest_n
}

/// Bodies that hinge on joints of one vertical in both answers.
fn add_hinged(
    system: &System,
    first: &SystemEquilibrium,
    second: &SystemEquilibrium,
    bodies: &mut Bodies,
) {
    let tolerances = Tolerances::project();
    let (origin_m, near_m) = (system.reference_m(), near_m(system, second));
    let level = |answer: &SystemEquilibrium| -> Vec<usize> {
        let places = answer.joints_m.iter().map(|x| [x[0] - origin_m[0], x[1] - origin_m[1]]);
        firsts(places, near_m)
    };
    let both = level(first).into_iter().zip(level(second)).enumerate();
    let mut verticals: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
    for (joint, key) in both {
        verticals.entry(key).or_default().push(joint);
    }
    let free = |joint: &usize| !system.joints()[*joint].support.is_fixed();
    let several = |joints: &Vec<usize>| joints.len() > 1 && joints.iter().any(free);
    let verticals: Vec<Vec<usize>> = verticals.into_values().filter(several).collect();
    if verticals.len().saturating_mul(system.joints().len()) > MOST_VISITS {
        return;
    }
    let forces = second.start_forces_n.iter().chain(&second.end_forces_n);
    let largest_n = forces.map(|force| norm(*force)).fold(0.0, worse);
    let mut ends = vec![Vec::new(); system.joints().len()];
    for (k, member) in system.members().iter().enumerate() {
        for ([a, b], [start, end]) in span_forces(member, k, second) {
            ends[a].push((b, start));
            ends[b].push((a, end));
        }
    }
    let level_n = |joint: usize, part: &[bool]| {
        if system.joints()[joint].support.is_fixed() {
            return 0.0;
        }
        let pulls = ends[joint].iter().filter(|(other, _)| part[*other]).map(|(_, force)| *force);
        let [x, y, _] = pulls.fold([0.0; 3], plus);
        x.hypot(y)
    };
    bodies.add_hinged(&verticals, level_n, tolerances.forces * largest_n);
}

/// For every body the turn that brings the second places closest to the first, when what it hangs
/// on has been turned already.
fn turns(
    bodies: &Bodies,
    first: &SystemEquilibrium,
    second: &SystemEquilibrium,
    left_out: &[bool],
) -> Vec<Turn> {
    let mut joints = vec![Vec::new(); bodies.all.len()];
    for (joint, body) in bodies.of_joint.iter().enumerate() {
        if !left_out[joint] {
            joints[*body].push(joint);
        }
    }
    let mut order: Vec<usize> = (0..bodies.all.len()).collect();
    order.sort_by_key(|body| bodies.all[*body].depth);
    let mut turns = vec![Turn::NONE; bodies.all.len()];
    for body in order {
        let (at_m, to_m) = match bodies.all[body] {
            Body { pivot: Some(pivot), .. } => {
                let at_m = second.joints_m[pivot];
                (at_m, turns[bodies.of_joint[pivot]].place(at_m))
            }
            Body { slides: Slides::Anywhere, .. } => {
                (middle_m(&joints[body], second), middle_m(&joints[body], first))
            }
            Body { slides: Slides::Along([u, v]), .. } => {
                let from_m = middle_m(&joints[body], second);
                let [x, y, _] = minus(middle_m(&joints[body], first), from_m);
                let (along_m, [from_x, from_y, _]) = (x * u + y * v, from_m);
                let to_m = [from_x + along_m * u, from_y + along_m * v];
                turns[body] = Turn { from_m: [from_x, from_y], to_m, ..Turn::NONE };
                continue;
            }
            Body { .. } => continue,
        };
        let (mut along, mut across) = (0.0, 0.0);
        for joint in &joints[body] {
            let [ax, ay, _] = minus(first.joints_m[*joint], to_m);
            let [bx, by, _] = minus(second.joints_m[*joint], at_m);
            along += ax * bx + ay * by;
            across += bx * ay - by * ax;
        }
        let (sin, cos) = f64::atan2(across, along).sin_cos();
        turns[body] = Turn { from_m: [at_m[0], at_m[1]], to_m: [to_m[0], to_m[1]], cos, sin };
    }
    turns
}

/// The mean of the places of some joints, m.
fn middle_m(joints: &[usize], answer: &SystemEquilibrium) -> Vector {
    let all = joints.iter().map(|joint| answer.joints_m[*joint]).fold([0.0; 3], plus);
    all.map(|x| x / joints.len().max(1) as f64)
}

/// An answer with its bodies turned.
fn turned(
    system: &System,
    answer: &SystemEquilibrium,
    bodies: &Bodies,
    turns: &[Turn],
) -> SystemEquilibrium {
    let mut turned = answer.clone();
    for (joint, place) in turned.joints_m.iter_mut().enumerate() {
        *place = turns[bodies.of_joint[joint]].place(*place);
    }
    let depth = |joint: usize| bodies.all[bodies.of_joint[joint]].depth;
    for (k, member) in system.members().iter().enumerate() {
        let last = member.via().len();
        for (n, (joints, forces)) in span_forces(member, k, answer).enumerate() {
            // A span turns with its joint that is further from the ground.
            let [from, to] = joints;
            let turn = &turns[bodies.of_joint[if depth(from) > depth(to) { from } else { to }]];
            let after = forces.map(|force| turn.vector(force));
            for ((joint, before), after) in joints.into_iter().zip(forces).zip(after) {
                // The ground takes what has changed.
                if !matches!(system.joints()[joint].support, Support::Free) {
                    let reaction = plus(turned.reactions_n[joint], minus(after, before));
                    turned.reactions_n[joint] = reaction;
                }
            }
            let jams = turned.evidence.jams.iter_mut();
            for jam in jams.filter(|jam| [jam.member, jam.span] == [k, n]) {
                jam.pull_n = turn.vector(jam.pull_n);
            }
            if n == 0 {
                turned.start_forces_n[k] = after[0];
            }
            if n == last {
                turned.end_forces_n[k] = after[1];
            }
        }
    }
    turned
}

#[cfg(test)]
mod tests;
