//! A system taken apart: parts that move without each other, and in each the trees that hang and
//! what they hang on. A rope hangs in no tree: what is at its end moves with all its spans.

use std::collections::VecDeque;

use model::system::{Kind, System};

/// Joints that move and members that hold them, connected not over anchors.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Part {
    /// Its joints that move.
    pub(super) joints: Vec<usize>,
    /// Whether a member holds it to what is fixed.
    pub(super) grounded: bool,
    /// Members of trees, outermost last: the joint at which each hangs is known before it.
    pub(super) hanging: Vec<Hanging>,
    /// What is left without the trees.
    pub(super) core: Core,
}

/// A member that alone holds one side of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Hanging {
    pub(super) member: usize,
    /// The joint at which it hangs.
    pub(super) parent: usize,
    /// The joint that hangs on it, and with it all that hangs further out.
    pub(super) child: usize,
}

/// What closes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Core {
    /// Nothing: the part is a tree on one anchor.
    Anchor,
    /// A chain between two anchors: its joints from end to end, and its members.
    Chain { joints: Vec<usize>, members: Vec<usize> },
    /// Several closures.
    Net {
        /// Its joints that move.
        joints: Vec<usize>,
        /// Members that are in no tree.
        members: Vec<usize>,
    },
}

impl Part {
    /// What of it may be slack: members of one sense that are in no tree.
    pub(super) fn one_sided(&self, system: &System) -> Vec<usize> {
        let (Core::Chain { members, .. } | Core::Net { members, .. }) = &self.core else {
            return vec![];
        };
        let two_sided = |member: &usize| system.members()[*member].kind == Kind::Bar;
        members.iter().copied().filter(|member| !two_sided(member)).collect()
    }
}

/// The parts of a system without its slack members, in the order of their first joints.
pub(super) fn parts(system: &System, slack: &[usize]) -> Vec<Part> {
    let mut meeting: Vec<Vec<usize>> = vec![vec![]; system.joints().len()];
    for (k, member) in system.members().iter().enumerate().filter(|(k, _)| !slack.contains(k)) {
        for joint in member.path() {
            if meeting[joint].last() != Some(&k) {
                meeting[joint].push(k);
            }
        }
    }
    let taker = Taker { system, meeting };
    let mut seen = vec![false; system.joints().len()];
    let mut found = vec![];
    for joint in 0..system.joints().len() {
        if !taker.held(joint) && !seen[joint] {
            found.push(taker.part(joint, &mut seen));
        }
    }
    found
}

struct Taker<'a> {
    system: &'a System,
    /// Members by joint.
    meeting: Vec<Vec<usize>>,
}

impl Taker<'_> {
    fn held(&self, joint: usize) -> bool {
        self.system.joints()[joint].support.is_fixed()
    }

    fn other(&self, member: usize, joint: usize) -> usize {
        let member = &self.system.members()[member];
        if member.from == joint { member.to } else { member.from }
    }

    /// The moving joints connected with one.
    fn connected(&self, start: usize, seen: &mut [bool]) -> Vec<usize> {
        seen[start] = true;
        let mut joints = vec![start];
        let mut next = 0;
        while let Some(here) = joints.get(next).copied() {
            next += 1;
            let members = self.meeting[here].iter();
            for there in members.flat_map(|member| self.system.members()[*member].path()) {
                if !self.held(there) && !seen[there] {
                    seen[there] = true;
                    joints.push(there);
                }
            }
        }
        joints
    }

    fn part(&self, start: usize, seen: &mut [bool]) -> Part {
        let joints = self.connected(start, seen);
        let mut degree: Vec<usize> = self.meeting.iter().map(Vec::len).collect();
        let mut gone = vec![false; self.system.members().len()];
        let mut ends: VecDeque<usize> =
            joints.iter().copied().filter(|j| degree[*j] == 1).collect();
        let mut hanging = vec![];
        while let Some(child) = ends.pop_front() {
            let left = self.meeting[child].iter().copied().find(|member| !gone[*member]);
            let Some(member) = left.filter(|member| !self.is_rope(*member)) else { continue };
            let parent = self.other(member, child);
            gone[member] = true;
            degree[parent] -= 1;
            degree[child] -= 1;
            if degree[parent] == 1 && !self.held(parent) {
                ends.push_back(parent);
            }
            hanging.push(Hanging { member, parent, child });
        }
        hanging.reverse();
        let mut met = joints.iter().flat_map(|joint| &self.meeting[*joint]);
        let held =
            |member: &usize| self.system.members()[*member].path().any(|joint| self.held(joint));
        let grounded = met.any(held);
        let core = self.core(&joints, &degree, &gone);
        Part { joints, grounded, hanging, core }
    }

    fn is_rope(&self, member: usize) -> bool {
        self.system.members()[member].rope.is_some()
    }

    fn core(&self, joints: &[usize], degree: &[usize], gone: &[bool]) -> Core {
        let moving: Vec<usize> = joints.iter().copied().filter(|j| degree[*j] > 0).collect();
        let mut left: Vec<usize> = moving
            .iter()
            .flat_map(|j| self.meeting[*j].iter().copied())
            .filter(|m| !gone[*m])
            .collect();
        left.sort_unstable();
        left.dedup();
        if moving.is_empty() {
            return Core::Anchor;
        }
        let net = Core::Net { joints: moving.clone(), members: left.clone() };
        let ropes = left.iter().any(|member| self.is_rope(*member));
        if ropes || moving.iter().any(|joint| degree[*joint] != 2) {
            return net;
        }
        // A walk from the first anchor; without one the part is a ring that falls.
        let anchored = |member: &usize| {
            let ends = &self.system.members()[*member];
            [ends.from, ends.to]
                .into_iter()
                .find(|joint| self.held(*joint))
                .map(|joint| (joint, *member))
        };
        let Some((mut here, first)) = left.iter().filter_map(anchored).min() else { return net };
        let (mut walk, mut members) = (vec![here], vec![]);
        let mut next = Some(first);
        while let Some(member) = next {
            here = self.other(member, here);
            members.push(member);
            walk.push(here);
            next = (!self.held(here))
                .then(|| self.meeting[here].iter().copied().find(|m| !gone[*m] && *m != member))
                .flatten();
        }
        if members.len() == left.len() { Core::Chain { joints: walk, members } } else { net }
    }
}
