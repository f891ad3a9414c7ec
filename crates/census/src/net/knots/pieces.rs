use model::Vector as Point;
use model::system::System;
use numerics::Interval;

use crate::boxes::arithmetic::Vector;
use crate::boxes::frame::Frame;

/// Joints and members of a part without its trees, and the loads of all joints.
#[derive(Debug, Clone, Copy)]
pub(in crate::net) struct Core<'a> {
    pub(in crate::net) system: &'a System,
    pub(in crate::net) frame: &'a Frame,
    pub(in crate::net) joints: &'a [usize],
    pub(in crate::net) members: &'a [usize],
    pub(in crate::net) loads: &'a [Vector],
}

impl Core<'_> {
    /// Members of the core at a joint, each with the joint at its other end; of a rope with all others.
    pub(in crate::net) fn meeting(&self, joint: usize) -> Vec<(usize, usize)> {
        let path = |member: usize| self.system.members()[member].path();
        let at = self.members.iter().filter(|member| path(**member).any(|other| other == joint));
        let others = at.flat_map(|member| path(*member).map(|other| (*member, other)));
        others.filter(|(_, other)| *other != joint).collect()
    }

    /// Whether a member is straight and inextensible.
    pub(in crate::net) fn is_rod(&self, member: usize) -> bool {
        let member = &self.system.members()[member];
        member.rope.is_none() && member.stiffness_n.is_none()
    }

    /// Members less joints that move.
    pub(in crate::net) fn closures(&self) -> usize {
        self.members.len().saturating_sub(self.joints.len())
    }

    /// Places of all joints that are held, m; others are next to those.
    pub(in crate::net) fn places_m(&self) -> Vec<Point> {
        let joints = self.system.joints().iter();
        joints.map(|joint| joint.support.at_m().unwrap_or(self.frame.origin_m)).collect()
    }

    pub(in crate::net) fn held(&self, joint: usize) -> bool {
        self.system.joints()[joint].support.is_fixed()
    }

    pub(in crate::net) fn length(&self, member: usize) -> Interval {
        let body = &self.system.members()[member].body;
        self.frame.length(Interval::point(body.length_m()))
    }

    fn anchors(&self) -> Vec<usize> {
        let paths = self.members.iter().flat_map(|member| self.system.members()[*member].path());
        paths.filter(|joint| self.held(*joint)).collect()
    }

    /// The axes of the vertical plane of all anchors and loads, and its normal last, if it is a
    /// plane of constant x or y.
    pub(in crate::net) fn plane(&self) -> Option<[usize; 3]> {
        let anchors = self.anchors();
        let at_m = |joint: usize| self.system.joints()[joint].support.at_m();
        let first = at_m(*anchors.first()?)?;
        let holds = |normal: usize| {
            let level = |joint: &usize| {
                at_m(*joint).is_some_and(|at| (at[normal] - first[normal]).abs() <= 0.0)
            };
            let loads = |joint: &usize| self.loads[*joint][normal] == Interval::ZERO;
            anchors.iter().all(level) && self.joints.iter().all(loads)
        };
        [[0, 2, 1], [1, 2, 0]].into_iter().find(|axes| holds(axes[2]))
    }

    pub(in crate::net) fn anchor_m(&self) -> Option<Point> {
        self.system.joints()[*self.anchors().first()?].support.at_m()
    }

    /// Whether all loads are vertical.
    fn is_upright(&self) -> bool {
        let level = |load: &Vector| load[0] == Interval::ZERO && load[1] == Interval::ZERO;
        self.joints.iter().all(|joint| level(&self.loads[*joint]))
    }

    /// An anchor of a net whose anchors are on one vertical: it turns freely about that.
    pub(in crate::net) fn axis(&self) -> Option<usize> {
        let anchors = self.anchors();
        let at_m = |joint: usize| self.system.joints()[joint].support.at_m();
        let on_one_vertical = |joint: &usize| match (at_m(*joint), at_m(anchors[0])) {
            (Some([x, y, _]), Some([p, q, _])) => (x - p).abs() <= 0.0 && (y - q).abs() <= 0.0,
            _ => false,
        };
        let turns = self.is_upright() && anchors.iter().all(on_one_vertical);
        anchors.first().copied().filter(|_| turns)
    }

    /// A joint at which alone a part of the net hangs, and turns freely about the vertical.
    pub(in crate::net) fn turning(&self) -> Option<usize> {
        let hangs = |joint: &usize| self.is_upright() && self.hangs_at(*joint);
        self.joints.iter().copied().find(hangs)
    }

    /// Whether a part of the net is held by this joint alone.
    fn hangs_at(&self, joint: usize) -> bool {
        // Whatever is connected with an anchor, not over the joint.
        let mut reached: Vec<usize> = vec![];
        let mut next: Vec<usize> = self
            .joints
            .iter()
            .copied()
            .filter(|other| self.meeting(*other).iter().any(|(_, end)| self.held(*end)))
            .collect();
        while let Some(here) = next.pop() {
            if here == joint || reached.contains(&here) {
                continue;
            }
            reached.push(here);
            let on = self.meeting(here).into_iter().map(|(_, other)| other);
            next.extend(on.filter(|other| !self.held(*other)));
        }
        reached.len() + 1 < self.joints.len()
    }
}
