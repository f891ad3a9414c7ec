//! A system as a framework: forces at joints, members without weight, and units that suit it.
//!
//! A weight or a constant force $p$ at the fraction $s$ of a straight member does the work
//! $p \cdot ((1 - s)\\,x_a + s\\,x_b)$, linear in the places of its two ends: it acts as $(1 - s)\\,p$
//! at the one and $s\\,p$ at the other. That is the lever rule, and it holds for a member that
//! stretches uniformly as well. What remains of the member is a law between its length and its
//! axial force.

use std::collections::BTreeSet;
use std::num::NonZeroU32;

use model::system::{Joint, Kind, Member, Support, System};
use nalgebra::{Matrix3, Vector3};

use super::directions::Directions;
use super::possible::is_loaded;
use super::state::State;
use super::work::Work;

/// A strain of prestressed members: the unit of force of a system without loads need only be near
/// its forces.
const STRAIN: f64 = 1e-2;

/// A joint: where it may be, and the force that acts on it.
#[derive(Debug, Clone)]
pub(super) struct Node {
    /// A place that its support allows.
    pub base: Vector3<f64>,
    /// Its free directions.
    pub free: Directions,
    /// Loads of the joint, and of its members at it.
    pub load: Vector3<f64>,
}

impl Node {
    /// Number of its free directions.
    pub fn freedom(&self) -> usize {
        self.free.count()
    }
}

/// A member without weight.
#[derive(Debug, Clone)]
pub(super) struct Link {
    /// Joint where it begins.
    pub from: usize,
    /// Joint where it ends.
    pub to: usize,
    /// Unstretched length.
    pub length: f64,
    /// How far the length may be off.
    pub within: f64,
    /// Elongation by a unit of axial force, `l / EA`; zero when inextensible.
    pub compliance: f64,
    /// Which sign of axial force it can have.
    pub kind: Kind,
    /// Number from 1 of the rope that it is a span of. Each span has the numbers of the whole rope.
    pub rope: Option<NonZeroU32>,
}

/// A rope over rings and pulleys: its length is the sum of its spans, its force that of each of
/// them. With the spans' directions $u$ its length has the gradient $g = \sum C^T u$ by the places.
#[derive(Debug, Clone)]
pub(super) struct Rope {
    /// Its spans in their order: the first is the link of the member, the others stand behind all
    /// members.
    pub spans: Vec<usize>,
    /// The joints that it meets, each once.
    pub joints: Vec<usize>,
}

impl Rope {
    /// The gradient of its length at each of its joints.
    pub fn gradient(&self, links: &[Link], u: impl Fn(usize) -> Vector3<f64>) -> Vec<Vector3<f64>> {
        let at = |joint: &usize| {
            self.spans.iter().fold(Vector3::zeros(), |sum, span| {
                let sign = f64::from(u8::from(links[*span].to == *joint))
                    - f64::from(u8::from(links[*span].from == *joint));
                sum + u(*span) * sign
            })
        };
        self.joints.iter().map(at).collect()
    }
}

impl Link {
    /// From where it begins to where it ends.
    pub fn span(&self, places: &[Vector3<f64>]) -> Vector3<f64> {
        places[self.to] - places[self.from]
    }

    /// Whether it can bear an axial force of this sign.
    pub fn bears(&self, axial: f64) -> bool {
        match self.kind {
            Kind::Bar => true,
            Kind::Cable => axial > 0.0,
            Kind::Strut => axial < 0.0,
        }
    }
}

/// The units in which the solver computes.
#[derive(Debug, Clone, Copy)]
pub(super) struct Units {
    /// Mean length of the members, m.
    pub length_m: f64,
    /// Mean load of the joints, N; where there is none, the force of elastic members at some
    /// strain.
    pub force_n: f64,
    /// Origin of places, m.
    pub origin_m: Vector3<f64>,
}

impl Units {
    /// A place, m, in these units.
    pub fn place(&self, at_m: impl Into<Vector3<f64>>) -> Vector3<f64> {
        (at_m.into() - self.origin_m) / self.length_m
    }
}

/// A system as the solver sees it, in [`Units`].
#[derive(Debug, Clone)]
pub(super) struct Framework {
    pub units: Units,
    pub nodes: Vec<Node>,
    /// The members, and behind them the further spans of ropes.
    pub links: Vec<Link>,
    pub ropes: Vec<Rope>,
    /// Joints that lie on the floor.
    pub lying: Vec<Lying>,
    pub work: Work,
}

/// A joint that lies on the floor, which its free directions know nothing of.
#[derive(Debug, Clone)]
pub(super) struct Lying {
    pub joint: usize,
    /// What of a push straight up its support leaves to it.
    pub rise: Vector3<f64>,
}

impl Lying {
    /// Push of the floor with a force of the ground: what of it the support cannot bear.
    pub fn push(&self, reaction: &Vector3<f64>) -> f64 {
        reaction.dot(&self.rise) / self.rise.norm_squared()
    }
}

impl Framework {
    pub fn new(system: &System) -> Self {
        Self::in_units(system, None)
    }

    /// Of other joints and members, in the same units and with the same work to spend; without ropes and floor.
    pub fn of_parts(&self, nodes: Vec<Node>, links: Vec<Link>) -> Self {
        let (ropes, lying) = (Vec::new(), Vec::new());
        Self { units: self.units, nodes, links, ropes, lying, work: self.work.clone() }
    }

    /// In the units of another system, as of one nearby, or in its own.
    pub fn in_units(system: &System, of: Option<Units>) -> Self {
        let mut nodes: Vec<_> = system.joints().iter().map(|joint| node(system, joint)).collect();
        for member in system.members() {
            let [start, end] = end_loads_n(system, member);
            nodes[member.from].load += start;
            nodes[member.to].load += end;
        }
        let units = of.unwrap_or_else(|| units(system, &nodes));
        // In place: memory that is touched for the first time costs more than what is done with it.
        for node in &mut nodes {
            if !matches!(node.free, Directions::All) {
                node.base = units.place(node.base);
            }
            node.load /= units.force_n;
        }
        let links = system.members().iter().map(|member| link(member, units)).collect();
        let (ropes, lying) = (Vec::new(), Vec::new());
        let mut new = Self { units, nodes, links, ropes, lying, work: Work::default() };
        for (k, member) in system.members().iter().enumerate().filter(|(_, m)| m.rope.is_some()) {
            new.span_rope(k, member);
        }
        new
    }

    /// Give a rope a link for each of its spans.
    fn span_rope(&mut self, member: usize, rope: &Member) {
        let number = u32::try_from(self.ropes.len() + 1).ok().and_then(NonZeroU32::new);
        let mut spans = vec![member];
        for [from, to] in rope.spans() {
            let link = Link { from, to, rope: number, ..self.links[member].clone() };
            if self.links[member].rope.is_none() {
                self.links[member] = link;
            } else {
                spans.push(self.links.len());
                self.links.push(link);
            }
        }
        let joints: BTreeSet<usize> = rope.path().collect();
        self.ropes.push(Rope { spans, joints: joints.into_iter().collect() });
    }

    /// Number of members.
    pub fn members(&self) -> usize {
        self.ropes.first().map_or(self.links.len(), |rope| rope.spans[1])
    }

    /// What was given for each member, for each link.
    pub fn by_link<T: Copy>(&self, mut of_members: Vec<T>) -> Vec<T> {
        for rope in &self.ropes {
            let of_rope = of_members[rope.spans[0]];
            of_members.extend(rope.spans[1..].iter().map(|_| of_rope));
        }
        of_members
    }

    /// The rope of a link.
    pub fn rope(&self, link: &Link) -> Option<&Rope> {
        link.rope.map(|number| &self.ropes[number.get() as usize - 1])
    }

    /// The member that a link belongs to.
    pub fn member_of(&self, link: usize) -> usize {
        self.rope(&self.links[link]).map_or(link, |rope| rope.spans[0])
    }

    /// The value of a link, or the sum over the spans of its rope.
    pub fn whole(&self, link: usize, value: impl Fn(usize) -> f64) -> f64 {
        match self.rope(&self.links[link]) {
            None => value(link),
            Some(rope) => rope.spans.iter().map(|span| value(*span)).sum(),
        }
    }

    /// With this much work for all solves over it.
    pub fn within(self, max_work: u64) -> Self {
        Self { work: Work::new(max_work), ..self }
    }

    /// Number of free directions of all joints.
    pub fn freedoms(&self) -> usize {
        self.nodes.iter().map(Node::freedom).sum()
    }

    /// Whether a member has a joint that can move.
    pub fn moves(&self, link: &Link) -> bool {
        let ends = [link.from, link.to];
        let joints = self.rope(link).map_or(&ends[..], |rope| &rope.joints);
        joints.iter().any(|joint| self.nodes[*joint].freedom() > 0)
    }

    /// Whether a link has an end that can move.
    pub fn ends_move(&self, link: &Link) -> bool {
        self.nodes[link.from].freedom() + self.nodes[link.to].freedom() > 0
    }

    /// Distance of the ends of a member that cannot move, along its spans.
    pub fn held_length(&self, link: usize) -> f64 {
        let base = |joint: usize| self.nodes[joint].base;
        self.whole(link, |span| {
            let Link { from, to, .. } = self.links[span];
            (base(to) - base(from)).norm()
        })
    }

    /// Axial force of an elastic member between two anchors; nothing for any other.
    pub fn held_force(&self, number: usize) -> Option<f64> {
        let link = &self.links[number];
        if self.moves(link) || link.compliance <= 0.0 {
            return None;
        }
        let force = (self.held_length(number) - link.length) / link.compliance;
        Some(if link.bears(force) { force } else { 0.0 })
    }

    /// What forces at a joint are measured against at least: the mean load, which is the unit; in
    /// a system without loads the largest force that an elastic member bears.
    pub fn least_scale(&self, state: &State) -> f64 {
        if is_loaded(self) {
            return 1.0;
        }
        let elastic = self.links.iter().zip(&state.axial).filter(|(link, _)| link.compliance > 0.0);
        let borne = elastic.map(|(_, axial)| axial.abs()).fold(0.0, f64::max);
        borne.max(f64::MIN_POSITIVE)
    }

    /// Sum of the pulls of all members and of the load at each joint; `pulls` are the forces with
    /// which the members pull their first joint towards their last.
    pub fn unbalance(&self, pulls: impl Iterator<Item = Vector3<f64>>) -> Vec<Vector3<f64>> {
        let mut sums: Vec<_> = self.nodes.iter().map(|node| node.load).collect();
        for (link, pull) in self.links.iter().zip(pulls) {
            sums[link.from] += pull;
            sums[link.to] -= pull;
        }
        sums
    }

    /// The same with these axial forces along the members.
    pub fn left(&self, directions: &[(Vector3<f64>, f64)], axial: &[f64]) -> Vec<Vector3<f64>> {
        self.unbalance(directions.iter().zip(axial).map(|((u, _), axial)| u * *axial))
    }

    /// What a self-stress adds to the push of the floor on each joint that lies on it.
    pub fn pushes_of_stress(&self, directions: &[(Vector3<f64>, f64)], stress: &[f64]) -> Vec<f64> {
        let none = self.pushes(directions, &vec![0.0; stress.len()]);
        let with = self.pushes(directions, stress).into_iter().zip(none);
        with.map(|(push, none)| push - none).collect()
    }

    /// Push of the floor on each joint that lies on it, with these axial forces along the members.
    pub fn pushes(&self, directions: &[(Vector3<f64>, f64)], axial: &[f64]) -> Vec<f64> {
        let left = self.left(directions, axial);
        let push = |lying: &Lying| {
            let (free, left) = (&self.nodes[lying.joint].free, &left[lying.joint]);
            lying.push(&(free.part(left) - left))
        };
        self.lying.iter().map(push).collect()
    }
}

/// Weight of the point mass and constant force of a joint, N.
fn own_load_n(system: &System, joint: &Joint) -> Vector3<f64> {
    Vector3::from(joint.force_n) - Vector3::z() * (joint.mass_kg * system.gravity_m_s2())
}

/// Weight and loads of a member divided between its joints by the lever rule, N.
pub(super) fn end_loads_n(system: &System, member: &Member) -> [Vector3<f64>; 2] {
    let length = member.body.length_m();
    let weight = Vector3::z() * (-member.body.mass_kg() * system.gravity_m_s2());
    let mut end_loads = [Vector3::zeros(); 2];
    let own = std::iter::once((member.body.centre_m(), weight));
    let others = member.loads.iter().map(|load| (load.at_m, Vector3::from(load.force_n)));
    for (at, force) in own.chain(others) {
        let fraction = at / length;
        end_loads[0] += force * (1.0 - fraction);
        end_loads[1] += force * fraction;
    }
    end_loads
}

/// The units of a system; the loads of the nodes are in N.
fn units(system: &System, nodes: &[Node]) -> Units {
    let mean = |total: f64, count: usize| (total > 0.0).then(|| total / count as f64);
    let load_n = mean(model::sum(nodes.iter().map(|node| node.load.norm())), nodes.len());
    Units {
        length_m: mean(system.total_length_m(), system.members().len()).unwrap_or(1.0),
        force_n: load_n.or_else(|| prestress_n(system)).unwrap_or(1.0),
        origin_m: system.reference_m().into(),
    }
}

/// The force of the mean stiffness at [`STRAIN`], N; nothing where no member is elastic.
fn prestress_n(system: &System) -> Option<f64> {
    let stiffnesses: Vec<f64> = system.members().iter().filter_map(|m| m.stiffness_n).collect();
    let mean = model::sum(stiffnesses.iter().copied()) / stiffnesses.len() as f64;
    (mean > 0.0).then_some(STRAIN * mean)
}

/// A joint with its place in m and its own load in N.
fn node(system: &System, joint: &Joint) -> Node {
    let (base, free) = match joint.support {
        Support::Free => (Vector3::zeros(), Directions::All),
        Support::Fixed { at_m } => (at_m.into(), Directions::Held),
        Support::Line { at_m, direction } => {
            let along = Vector3::from(direction).normalize();
            let axes = Matrix3::from_columns(&[along, Vector3::zeros(), Vector3::zeros()]);
            (at_m.into(), Directions::new(axes, 1))
        }
        Support::Plane { at_m, normal } => {
            let [first, second] = across(&Vector3::from(normal).normalize());
            let axes = Matrix3::from_columns(&[first, second, Vector3::zeros()]);
            (at_m.into(), Directions::new(axes, 2))
        }
    };
    Node { base, free, load: own_load_n(system, joint) }
}

/// Two unit vectors normal to a unit vector and to each other.
pub(super) fn across(normal: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = normal.cross(&Vector3::ith(normal.iamin(), 1.0)).normalize();
    [first, normal.cross(&first)]
}

fn link(member: &Member, units: Units) -> Link {
    let length = member.body.length_m() / units.length_m;
    Link {
        from: member.from,
        to: member.to,
        length,
        within: member.within_m() / units.length_m,
        compliance: member.stiffness_n.map_or(0.0, |stiffness| length * units.force_n / stiffness),
        kind: member.kind,
        rope: None,
    }
}
