//! A net taken apart into knots, whose places are unknown, joints that swing between two others,
//! and bars between knots.

use model::NoCensus;
use model::system::Kind;
use numerics::Interval;

use super::core::Core;
use crate::network::arithmetic::{NOWHERE, Vector};

/// Where a bar or a swing ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum End {
    /// A knot, by its number in the layout.
    Knot(usize),
    /// A place that is known.
    Held(Vector),
}

/// A joint that two bars hold between places that are given.
#[derive(Debug, Clone)]
pub(super) struct Swing {
    pub(super) joint: usize,
    pub(super) members: [usize; 2],
    pub(super) ends: [End; 2],
    pub(super) lengths: [Interval; 2],
    pub(super) load: Vector,
}

/// A bar between knots, or from a knot to a held place.
#[derive(Debug, Clone)]
pub(super) struct Link {
    pub(super) member: usize,
    pub(super) ends: [End; 2],
    pub(super) length: Interval,
}

/// The net in the units of the frame.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// 2 in a plane, 3 in space.
    pub(super) dim: usize,
    /// The axes of the world frame in which the joints move; of a plane the first two.
    pub(super) axes: [usize; 3],
    /// The joints whose places are unknown.
    pub(super) knots: Vec<usize>,
    /// Their loads.
    pub(super) loads: Vec<Vector>,
    pub(super) swings: Vec<Swing>,
    pub(super) bars: Vec<Link>,
}

impl Layout {
    /// As many joints as possible swing. `axes` are those of the motion, in a plane two.
    pub(super) fn new(core: &Core, dim: usize, axes: [usize; 3]) -> Result<Self, NoCensus> {
        for number in core.members {
            let member = &core.system.members()[*number];
            if member.kind != Kind::Bar || member.stiffness_n.is_some() {
                return Err(NoCensus::NotABar { member: number + 1 });
            }
        }
        let swinging = swinging(core);
        let knots: Vec<usize> =
            core.joints.iter().copied().filter(|joint| !swinging.contains(joint)).collect();
        let mut layout = Self { dim, axes, knots, loads: vec![], swings: vec![], bars: vec![] };
        layout.loads = layout.knots.iter().map(|knot| layout.turned(core.loads[*knot])).collect();
        for joint in swinging.iter().copied() {
            let [(first, a), (second, b)] = core.meeting(joint)[..] else { continue };
            let load = layout.turned(core.loads[joint]);
            // Two bars that nothing turns can fold or lie straight under any force.
            if load.iter().all(|part| part.contains(0.0)) {
                return Err(NoCensus::Limp { member: first + 1 });
            }
            layout.swings.push(Swing {
                joint,
                members: [first, second],
                ends: [layout.end(core, a), layout.end(core, b)],
                lengths: [core.length(first), core.length(second)],
                load,
            });
        }
        for member in core.members.iter().copied() {
            let ends = core.ends(member);
            if ends.iter().all(|joint| !swinging.contains(joint)) {
                let ends = ends.map(|joint| layout.end(core, joint));
                layout.bars.push(Link { member, ends, length: core.length(member) });
            }
        }
        Ok(layout)
    }

    fn end(&self, core: &Core, joint: usize) -> End {
        if let Some(number) = self.knots.iter().position(|knot| *knot == joint) {
            return End::Knot(number);
        }
        let at_m = core.system.joints()[joint].support.at_m();
        End::Held(at_m.map_or(NOWHERE, |at_m| self.turned(core.frame.place(at_m))))
    }

    /// A vector of the world frame in the axes of the motion; in a plane without its normal part.
    pub(super) fn turned(&self, world: Vector) -> Vector {
        std::array::from_fn(|k| if k < self.dim { world[self.axes[k]] } else { Interval::ZERO })
    }

    /// Number of unknown coordinates.
    pub(super) fn coordinates(&self) -> usize {
        self.dim * self.knots.len()
    }

    /// Independent motions of the knots.
    pub(super) fn motions(&self) -> usize {
        self.coordinates().saturating_sub(self.bars.len())
    }

    /// All distances that are bounded: both ends, the least and the largest.
    pub(super) fn reaches(&self) -> impl Iterator<Item = ([End; 2], [Interval; 2])> {
        let bars = self.bars.iter().map(|bar| (bar.ends, [bar.length; 2]));
        let swings = self.swings.iter().map(|swing| {
            let [a, b] = swing.lengths;
            let least = if a == b { Interval::ZERO } else { (a - b).abs() };
            (swing.ends, [least, a + b])
        });
        bars.chain(swings)
    }
}

/// As many joints with two members as there are of which no two are neighbours: from the ends of
/// each run of such joints on, those next to anchors last, so that knots are held by anchors.
fn swinging(core: &Core) -> Vec<usize> {
    let mut left: Vec<usize> =
        core.joints.iter().copied().filter(|joint| core.meeting(*joint).len() == 2).collect();
    let mut chosen = vec![];
    while !left.is_empty() {
        let neighbours = |joint: usize| core.meeting(joint).into_iter().map(|(_, other)| other);
        let rank = |joint: &usize| {
            let runs_on = neighbours(*joint).filter(|other| left.contains(other)).count();
            let at_anchor = neighbours(*joint).any(|other| core.held(other));
            (runs_on, at_anchor, *joint)
        };
        let Some(next) = left.iter().copied().min_by_key(|joint| rank(joint)) else { break };
        let gone: Vec<usize> = neighbours(next).chain([next]).collect();
        left.retain(|joint| !gone.contains(joint));
        chosen.push(next);
    }
    chosen.sort_unstable();
    chosen
}
