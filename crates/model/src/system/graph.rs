//! Which joints are connected, and how far apart members let them be.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, BinaryHeap, HashMap, HashSet};

use super::System;

/// Joints with the members that meet in each.
pub(super) struct Graph<'a> {
    system: &'a System,
    /// Where the list of each joint begins in `meeting`.
    begins: Vec<usize>,
    /// Numbers of members, and behind them those of `reaches`.
    meeting: Vec<usize>,
    /// Ropes with the other joints that they meet: no two are further apart than a rope is long.
    reaches: Vec<(usize, usize)>,
    /// The anchors with their places; between two of them the distance is that of the places.
    anchors: Vec<usize>,
    places: HashMap<usize, [f64; 3]>,
}

/// Ways from one joint over members, none longer than asked for.
pub(super) struct Ways {
    start: usize,
    /// Length of the shortest way, and the joint before, by joint. A table that doubles would hold
    /// itself twice.
    found: BTreeMap<usize, (f64, usize)>,
}

/// A joint to go on from, the nearest first.
struct Next {
    way_m: f64,
    joint: usize,
    before: usize,
}

impl<'a> Graph<'a> {
    pub(super) fn new(system: &'a System) -> Self {
        let joints = system.joints().len();
        let mut begins = vec![0; joints + 1];
        let members = system.members();
        let straight = || members.iter().enumerate().filter(|(_, m)| m.rope.is_none());
        let pairs: Vec<[usize; 3]> = pairs_of_ropes(system);
        let ends = || {
            let ropes = pairs.iter().enumerate().map(|(k, [_, a, _])| (members.len() + k, *a));
            straight().flat_map(|(k, m)| [(k, m.from), (k, m.to)]).chain(ropes)
        };
        for (_, here) in ends() {
            begins[here + 1] += 1;
        }
        for joint in 0..joints {
            begins[joint + 1] += begins[joint];
        }
        let mut next = begins.clone();
        let mut meeting = vec![0; begins[joints]];
        for (k, here) in ends() {
            meeting[next[here]] = k;
            next[here] += 1;
        }
        let reaches = pairs.iter().map(|[rope, _, other]| (*rope, *other)).collect();
        let fixed = system.joints().iter().enumerate().filter(|(_, j)| j.support.is_fixed());
        let places: HashMap<_, _> =
            fixed.filter_map(|(k, joint)| Some((k, joint.support.at_m()?))).collect();
        let mut anchors: Vec<usize> = places.keys().copied().collect();
        anchors.sort_unstable();
        Self { system, begins, meeting, reaches, anchors, places }
    }

    /// The members at a joint, with the joint at their other end and their greatest length.
    pub(super) fn at(
        &self,
        joint: usize,
    ) -> impl ExactSizeIterator<Item = (usize, usize, f64)> + use<'_, 'a> {
        let meeting = &self.meeting[self.begins[joint]..self.begins[joint + 1]];
        let members = self.system.members();
        meeting.iter().map(move |&k| {
            if let Some((rope, other)) = k.checked_sub(members.len()).map(|k| self.reaches[k]) {
                return (rope, other, members[rope].greatest_length_m());
            }
            let member = &members[k];
            let other = if member.from == joint { member.to } else { member.from };
            (k, other, member.greatest_length_m())
        })
    }

    /// The connected parts, each with its joints in ascending order.
    pub(super) fn components(&self) -> Vec<Vec<usize>> {
        let joints = self.begins.len() - 1;
        let mut seen = vec![false; joints];
        let mut parts = Vec::new();
        for first in 0..joints {
            if seen[first] {
                continue;
            }
            seen[first] = true;
            let mut part = vec![first];
            let mut next = 0;
            while let Some(&joint) = part.get(next) {
                next += 1;
                for (_, other, _) in self.at(joint) {
                    if !seen[other] {
                        seen[other] = true;
                        part.push(other);
                    }
                }
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }

    /// Whether a way over members, without these, leads from a joint to another that is `held`.
    pub(super) fn meets(
        &self,
        start: usize,
        without: &HashSet<usize>,
        held: &impl Fn(usize) -> bool,
    ) -> bool {
        let (mut seen, mut open) = (HashSet::from([start]), vec![start]);
        while let Some(joint) = open.pop() {
            for (member, other, _) in self.at(joint) {
                if !without.contains(&member) && seen.insert(other) {
                    if held(other) {
                        return true;
                    }
                    open.push(other);
                }
            }
        }
        false
    }

    /// Shortest ways from a joint (Dijkstra), none longer than `limit_m`. With a member to leave
    /// out, the ways to its other end are those of the loops through it, and straight lines between
    /// anchors belong to them; without one, ways run over members alone.
    pub(super) fn distances(
        &self,
        start: usize,
        limit_m: f64,
        without: Option<(usize, usize)>,
    ) -> Ways {
        let mut ways = Ways { start, found: BTreeMap::new() };
        let mut open = BinaryHeap::from([Next { way_m: 0.0, joint: start, before: start }]);
        while let Some(Next { way_m, joint, before }) = open.pop() {
            if ways.found.contains_key(&joint) {
                continue;
            }
            ways.found.insert(joint, (way_m, before));
            if without.is_some_and(|(_, end)| end == joint) {
                break;
            }
            let mut push = |other: usize, step_m: f64| {
                let way_m = way_m + step_m;
                if way_m <= limit_m && way_m.is_finite() && !ways.found.contains_key(&other) {
                    open.push(Next { way_m, joint: other, before: joint });
                }
            };
            for (member, other, length_m) in self.at(joint) {
                if without.is_none_or(|(left_out, _)| left_out != member) {
                    push(other, length_m);
                }
            }
            if let (Some(_), Some(here)) = (without, self.places.get(&joint)) {
                for other in &self.anchors {
                    let there = self.places[other];
                    let [x, y, z] = std::array::from_fn(|k| there[k] - here[k]);
                    push(*other, f64::hypot(x, y).hypot(z));
                }
            }
        }
        ways
    }
}

/// Each rope with each two of the joints that it meets, both ways.
fn pairs_of_ropes(system: &System) -> Vec<[usize; 3]> {
    let mut pairs = Vec::new();
    for (k, rope) in system.members().iter().enumerate().filter(|(_, m)| m.rope.is_some()) {
        let met: BTreeSet<usize> = rope.path().collect();
        let others = |a: usize| met.iter().filter(move |b| **b != a).map(move |b| [k, a, *b]);
        pairs.extend(met.iter().flat_map(|a| others(*a)));
    }
    pairs
}

impl Ways {
    /// Length of the shortest way to a joint, if one was found.
    pub(super) fn get(&self, joint: usize) -> Option<f64> {
        self.found.get(&joint).map(|(way_m, _)| *way_m)
    }

    /// The joints on the shortest way to a joint that was found, from the start on.
    pub(super) fn way(&self, mut joint: usize) -> Vec<usize> {
        let mut way = vec![joint];
        while joint != self.start {
            joint = self.found[&joint].1;
            way.push(joint);
        }
        way.reverse();
        way
    }
}

impl Ord for Next {
    /// The nearest joint is the greatest; equal ways go by number, so that the answer is one.
    fn cmp(&self, other: &Self) -> Ordering {
        other.way_m.total_cmp(&self.way_m).then_with(|| other.joint.cmp(&self.joint))
    }
}

impl PartialOrd for Next {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Next {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Next {}
