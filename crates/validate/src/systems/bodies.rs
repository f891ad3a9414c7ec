//! Bodies of a system: what keeps its shape under all free turns.
//!
//! Whatever hangs on one joint alone, under vertical loads and without a support that notices,
//! turns freely about the vertical through that joint wherever the joint may be: the energy of
//! every configuration is that of the turned one. So does what hangs on anchors of one vertical.
//! Such joints are found as the articulations of the graph of members, anchors of one vertical
//! taken as one node; the parts that hang on them form a tree, each turning relative to the one
//! before.
//!
//! What hangs on several joints of one vertical turns about it too where it does not pull them
//! aside ([`Bodies::add_hinged`]).
//!
//! R. Tarjan, SIAM J. Comput. 1 (1972) 146-160, doi:10.1137/0201010 (articulations).

use model::system::{Joint, Member, Support, System};

use super::spans::connected;
use super::verticals::firsts;

/// Level distance of supports on one vertical over the length of all members.
const ONE_VERTICAL: f64 = model::VERTICAL_TOLERANCE;

/// What supports leave of moves in the level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Slides {
    Not,
    /// Along level guides of one direction.
    Along([f64; 2]),
    /// Anywhere, on the floor or on level planes alone.
    Anywhere,
}

impl Slides {
    /// What a support leaves; without one the floor is level.
    fn on(support: &Support) -> Self {
        match support {
            Support::Line { direction: [x, y, z], .. } if z.abs() <= ONE_VERTICAL * x.hypot(*y) => {
                Self::Along([x / x.hypot(*y), y / x.hypot(*y)])
            }
            Support::Fixed { .. } | Support::Line { .. } => Self::Not,
            Support::Plane { normal: [x, y, _], .. } if x.hypot(*y) > ONE_VERTICAL => {
                Self::Along([-y / x.hypot(*y), x / x.hypot(*y)])
            }
            Support::Free | Support::Plane { .. } => Self::Anywhere,
        }
    }

    /// What two leave together.
    fn both(one: Self, other: Self) -> Self {
        match (one, other) {
            (Self::Anywhere, slides) | (slides, Self::Anywhere) => slides,
            (Self::Along([x, y]), Self::Along([u, v])) if (x * v - y * u).abs() <= ONE_VERTICAL => {
                one
            }
            _ => Self::Not,
        }
    }
}

/// Joints that keep their distances under all free turns.
#[derive(Debug, Clone)]
pub(super) struct Body {
    /// The joint about whose vertical it turns; nothing for what does not turn.
    pub pivot: Option<usize>,
    /// How it moves in the level as it is.
    pub slides: Slides,
    /// Number of turning bodies from the ground to this one.
    pub depth: usize,
}

/// The bodies of a system.
#[derive(Debug, Clone)]
pub(super) struct Bodies {
    /// Number of its body, by joint.
    pub of_joint: Vec<usize>,
    /// The bodies.
    pub all: Vec<Body>,
    /// Joints that feel a turn: by a load that is not vertical, or a support.
    fixed: Vec<bool>,
    /// Neighbours of each joint.
    neighbours: Vec<Vec<usize>>,
}

/// One visit of all nodes that members connect, depth first.
struct Walk {
    /// Nodes in the order of their first visits.
    order: Vec<usize>,
    /// Position of each node in it.
    rank: Vec<usize>,
    /// The node from which each was reached; itself where a walk began.
    parent: Vec<usize>,
    /// The joint of that node to which the member runs.
    door: Vec<usize>,
}

const NONE: usize = usize::MAX;

impl Bodies {
    /// Those of the members that hold: one that is slack holds nothing.
    pub(super) fn new(system: &System, holds: impl Fn(&Member) -> bool) -> Self {
        let joints = system.joints().len();
        let mut neighbours = vec![Vec::new(); joints];
        for member in system.members().iter().filter(|member| holds(member)) {
            for [a, b] in member.spans() {
                neighbours[a].push(b);
                neighbours[b].push(a);
            }
        }
        let fixed = feeling_turns(system);
        let node = nodes(system);
        let mut new = Self { of_joint: vec![0; joints], all: vec![], fixed, neighbours };
        let walk = new.walk(&node);
        new.divide(&node, &walk, system.joints());
        new
    }

    /// Visit everything, from joints that no turn moves on.
    fn walk(&self, node: &[usize]) -> Walk {
        let joints = node.len();
        let mut members_of = vec![Vec::new(); joints];
        for (joint, node) in node.iter().enumerate() {
            members_of[*node].push(joint);
        }
        // The ends of the members of a node: the joint there, and the node here beyond.
        let ends: Vec<Vec<(usize, usize)>> = members_of
            .iter()
            .map(|joints| {
                let ends = joints.iter().flat_map(|j| self.neighbours[*j].iter().map(|o| (*j, *o)));
                ends.map(|(joint, other)| (joint, node[other])).collect()
            })
            .collect();
        let mut walk = Walk {
            order: vec![],
            rank: vec![NONE; joints],
            parent: vec![NONE; joints],
            door: vec![NONE; joints],
        };
        let held = (0..joints).filter(|joint| self.fixed[*joint]);
        for start in held.chain(0..joints).map(|joint| node[joint]) {
            if walk.rank[start] == NONE {
                walk.parent[start] = start;
                walk.from(start, &ends);
            }
        }
        walk
    }

    /// A body for the ground, one for whatever hangs on one node alone, and one for whatever stands on the floor, on level
    /// planes or guides of one direction alone.
    fn divide(&mut self, node: &[usize], walk: &Walk, all: &[Joint]) {
        let joints = node.len();
        let mut slides = vec![Slides::Anywhere; joints];
        let mut low = walk.rank.clone();
        let mut held = vec![false; joints];
        for joint in 0..joints {
            held[node[joint]] |= self.fixed[joint];
            slides[node[joint]] =
                Slides::both(slides[node[joint]], Slides::on(&all[joint].support));
            for other in &self.neighbours[joint] {
                low[node[joint]] = low[node[joint]].min(walk.rank[node[*other]]);
            }
        }
        for v in walk.order.iter().rev() {
            let parent = walk.parent[*v];
            low[parent] = low[parent].min(low[*v]);
            // Where a walk begins, nothing turns by itself.
            held[parent] |= held[*v];
            slides[parent] = Slides::both(slides[parent], slides[*v]);
        }
        self.all.push(Body { pivot: None, slides: Slides::Not, depth: 0 });
        let mut body = vec![0; joints];
        for v in &walk.order {
            let parent = walk.parent[*v];
            let hangs = parent != *v && low[*v] >= walk.rank[parent] && !held[*v];
            body[*v] = body[parent];
            if hangs {
                let depth = self.all[body[parent]].depth + 1;
                body[*v] = self.all.len();
                self.all.push(Body { pivot: Some(walk.door[*v]), slides: Slides::Not, depth });
                continue;
            }
            let slides = slides[*v];
            let moves = slides != Slides::Not && (slides != Slides::Anywhere || !held[*v]);
            if parent == *v && moves {
                body[*v] = self.all.len();
                self.all.push(Body { pivot: None, slides, depth: 0 });
            }
        }
        self.of_joint = node.iter().map(|node| body[*node]).collect();
    }

    /// What hangs on several joints of one vertical, which are not all anchors, becomes a body of
    /// its own where it pulls none of them aside. `level_n(joint, part)` is the level force with
    /// which the joints that `part` marks pull a joint.
    pub(super) fn add_hinged(
        &mut self,
        verticals: &[Vec<usize>],
        level_n: impl Fn(usize, &[bool]) -> f64,
        tolerance_n: f64,
    ) {
        let joints = self.of_joint.len();
        let marked = |joints_of: &[usize]| {
            let mut marks = vec![false; joints];
            for joint in joints_of {
                marks[*joint] = true;
            }
            marks
        };
        let mut found = Vec::new();
        for vertical in verticals {
            for part in self.parts_beside(vertical, &marked(vertical)) {
                let marks = marked(&part);
                let touches = |joint: &usize| self.neighbours[*joint].iter().any(|o| marks[*o]);
                let at: Vec<usize> = vertical.iter().copied().filter(touches).collect();
                let depth = |joint: &usize| self.all[self.of_joint[*joint]].depth;
                let Some(pivot) = at.iter().copied().max_by_key(depth) else { continue };
                let together = at.iter().all(|joint| self.moves_with(pivot, *joint));
                let still = at.iter().all(|joint| level_n(*joint, &marks) <= tolerance_n);
                if at.len() > 1 && together && still {
                    found.push((pivot, part));
                }
            }
        }
        if found.is_empty() {
            return;
        }
        // The larger may hold the smaller.
        found.sort_by_key(|(_, part)| std::cmp::Reverse(part.len()));
        for (pivot, part) in found {
            let (from, new) = (self.of_joint[pivot], self.all.len());
            for joint in part {
                if self.of_joint[joint] == from {
                    self.of_joint[joint] = new;
                }
            }
            self.all.push(Body { pivot: Some(pivot), slides: Slides::Not, depth: 0 });
        }
        self.count_depths();
    }

    /// The connected joints beside a vertical that touch it and feel no turn.
    fn parts_beside(&self, vertical: &[usize], on: &[bool]) -> Vec<Vec<usize>> {
        let mut seen = on.to_vec();
        let mut parts = Vec::new();
        for start in vertical.iter().flat_map(|joint| &self.neighbours[*joint]) {
            if seen[*start] {
                continue;
            }
            let part = connected(*start, &mut seen, |joint| self.neighbours[joint].iter().copied());
            if part.iter().all(|joint| !self.fixed[*joint]) {
                parts.push(part);
            }
        }
        parts
    }

    /// Whether a joint is of another's body, or one of the pivots that this hangs on.
    fn moves_with(&self, joint: usize, other: usize) -> bool {
        let mut body = self.of_joint[joint];
        if self.of_joint[other] == body {
            return true;
        }
        while let Some(pivot) = self.all[body].pivot {
            if pivot == other {
                return true;
            }
            body = self.of_joint[pivot];
        }
        false
    }

    /// Depths of bodies whose pivots are in any order.
    fn count_depths(&mut self) {
        let mut depths: Vec<Option<usize>> = vec![None; self.all.len()];
        for body in 0..depths.len() {
            let (mut at, mut way) = (body, vec![]);
            let ground = loop {
                match (depths[at], self.all[at].pivot) {
                    (Some(depth), _) => break depth + 1,
                    (None, None) => {
                        depths[at] = Some(0);
                        break 1;
                    }
                    (None, Some(pivot)) => {
                        way.push(at);
                        at = self.of_joint[pivot];
                    }
                }
            };
            for (more, body) in way.into_iter().rev().enumerate() {
                depths[body] = Some(ground + more);
            }
        }
        for (body, depth) in self.all.iter_mut().zip(depths) {
            body.depth = depth.unwrap_or_default();
        }
    }
}

impl Walk {
    fn from(&mut self, start: usize, ends: &[Vec<(usize, usize)>]) {
        let mut next = vec![(start, 0)];
        self.visit(start);
        while let Some((node, tried)) = next.last_mut() {
            let Some((joint, other)) = ends[*node].get(*tried) else {
                next.pop();
                continue;
            };
            *tried += 1;
            if self.rank[*other] == NONE {
                (self.parent[*other], self.door[*other]) = (*node, *joint);
                self.visit(*other);
                next.push((*other, 0));
            }
        }
    }

    fn visit(&mut self, node: usize) {
        self.rank[node] = self.order.len();
        self.order.push(node);
    }
}

/// Number of a node for each joint: its own, but anchors, and guides along a vertical, that stand
/// on one vertical are one.
fn nodes(system: &System) -> Vec<usize> {
    let near_m = ONE_VERTICAL * system.total_length_m();
    let [x0, y0, _] = system.reference_m();
    let (mut upright, mut places_m) = (Vec::new(), Vec::new());
    for (k, joint) in system.joints().iter().enumerate() {
        let at_m = match joint.support {
            Support::Fixed { at_m } => at_m,
            Support::Line { at_m, direction: [x, y, _] } if x.hypot(y) <= ONE_VERTICAL => at_m,
            _ => continue,
        };
        upright.push(k);
        places_m.push([at_m[0] - x0, at_m[1] - y0]);
    }
    let mut node: Vec<usize> = (0..system.joints().len()).collect();
    for (k, first) in firsts(places_m.into_iter(), near_m).into_iter().enumerate() {
        node[upright[k]] = upright[first];
    }
    node
}

/// Joints that a turn about a vertical outside them would do work at, or whose supports forbid it.
fn feeling_turns(system: &System) -> Vec<bool> {
    let joints = system.joints().iter().zip(system.joints_with_level_loads());
    let feels = |(joint, level): (&Joint, bool)| match joint.support {
        Support::Free => level,
        Support::Plane { normal: [x, y, _], .. } => level || x.hypot(y) > ONE_VERTICAL,
        Support::Fixed { .. } | Support::Line { .. } => true,
    };
    joints.map(feels).collect()
}

#[cfg(test)]
mod tests;
