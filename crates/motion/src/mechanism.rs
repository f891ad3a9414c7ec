use std::ops::Range;

use model::Vector;
use model::system::{Kind, System};

use crate::corners::{Cornered, Expanded, expand};
use crate::error::{MotionError, Result};
use crate::inertia::EndInertia;
use crate::order::order;
use crate::unequal::smaller;
use crate::unilateral::refuse_inextensible;
use numerics::vector::{add_times, minus};

/// A system of bars as the mechanics of the places of its joints (natural coordinates).
///
/// Joints are stored in *slots*: those that move come first, in the order of elimination, then the
/// anchors. Places are relative to [`System::reference_m`], so that a system far from the origin
/// keeps its digits.
#[derive(Debug, Clone)]
pub struct Mechanism {
    /// With the corners of bars that have some.
    pub(crate) system: System,
    /// The system as given, where it has fewer joints.
    given: Option<System>,
    /// The point that places are relative to, world frame, m.
    pub(crate) reference_m: Vector,
    pub(crate) cornered: Vec<Cornered>,
    /// Slot of each joint, and joint of each slot.
    pub(crate) slot_of: Vec<usize>,
    pub(crate) joint_at: Vec<usize>,
    /// Number of slots that move.
    pub(crate) moving: usize,
    /// Whether the joints that move form trees.
    pub(crate) is_forest: bool,
    /// Spans of all members, those of rigid ones first.
    pub(crate) spans: Vec<Link>,
    /// Rigid members; member *k* of them has the row *k* of the constraints.
    pub(crate) bars: Vec<Rigid>,
    /// Members with a stiffness.
    pub(crate) springs: Vec<Spring>,
    /// Supports of sliders; support *k* has the row `bars.len() + k`.
    pub(crate) slides: Vec<Slide>,
    /// Diagonal of the mass matrix by slot, kg, the same for each axis.
    pub(crate) mass: Vec<f64>,
    /// Constant force by slot, N: weights and forces lumped by the lever rule.
    pub(crate) load: Vec<Vector>,
}

/// A span of a member between two slots; but for ropes it is the member.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Link {
    /// Slots of its ends.
    pub a: usize,
    pub b: usize,
    /// Length of the member over the number of its spans.
    pub length_m: f64,
    /// Number of the member.
    pub member: usize,
    pub inertia: EndInertia,
}

/// A member whose length, the sum of its spans, does not change.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Rigid {
    /// Where its spans stand among all.
    pub spans: Range<usize>,
    pub length_m: f64,
    /// Its number among the members.
    pub member: usize,
}

/// A member with a stiffness.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Spring {
    /// Where its spans stand among all.
    pub spans: Range<usize>,
    pub length_m: f64,
    /// Its number among the members.
    pub member: usize,
    pub kind: Kind,
    /// `EA`, N; zero of an inextensible member that is slack.
    pub stiffness_n: f64,
}

/// A direction in which a support does not let its joint move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slide {
    pub slot: usize,
    pub normal: Vector,
    /// A point of the support, relative to the reference, m.
    pub at: Vector,
}

impl Mechanism {
    /// The mechanics of a system in small motions.
    ///
    /// # Errors
    ///
    /// [`MotionError`] when the system has members or joints whose motion is indeterminate:
    /// inextensible cables and struts, moments that no body has, joints without inertia.
    pub fn new(system: &System) -> Result<Self> {
        refuse_inextensible(system)?;
        Self::for_small_motions(system)
    }

    /// The same, where inextensible cables and struts are slack.
    pub(crate) fn for_small_motions(system: &System) -> Result<Self> {
        let inertia = smaller(system)?;
        let expanded = Expanded { system: system.clone(), inertia, cornered: Vec::new() };
        Self::build(expanded, None, system.reference_m())
    }

    /// For places alone, where nothing depends on how bars spin.
    pub(crate) fn for_places(system: &System) -> Result<Self> {
        let inertia = system.members().iter().map(|m| EndInertia::new(&m.body)).collect();
        let expanded = Expanded { system: system.clone(), inertia, cornered: Vec::new() };
        Self::build(expanded, None, system.reference_m())
    }

    /// For motions: with corners at bars whose moments across differ. Inextensible cables and
    /// struts are slack.
    pub(crate) fn for_motion(system: &System, reference_m: Vector) -> Result<Self> {
        let expanded = expand(system)?;
        let given = (!expanded.cornered.is_empty()).then(|| system.clone());
        Self::build(expanded, given, reference_m)
    }

    fn build(expanded: Expanded, given: Option<System>, reference_m: Vector) -> Result<Self> {
        let Expanded { system, inertia, cornered } = expanded;
        if given.as_ref().unwrap_or(&system).floor_m().is_some() {
            return Err(MotionError::Floor);
        }
        let joints = system.joints();
        let moves: Vec<bool> = joints.iter().map(|joint| !joint.support.is_fixed()).collect();
        let between = coupled(&system, &moves);
        let ordered = order(&moves, &between);
        let moving = ordered.joints.len();
        let mut joint_at = ordered.joints;
        joint_at.extend((0..joints.len()).filter(|&joint| !moves[joint]));
        let mut slot_of = vec![0; joints.len()];
        for (slot, &joint) in joint_at.iter().enumerate() {
            slot_of[joint] = slot;
        }
        let mut found = Self {
            given,
            reference_m,
            cornered,
            slot_of,
            joint_at,
            moving,
            is_forest: ordered.is_forest && !system.has_ropes(),
            spans: Vec::new(),
            bars: Vec::new(),
            springs: Vec::new(),
            slides: Vec::new(),
            mass: vec![0.0; joints.len()],
            load: vec![[0.0; 3]; joints.len()],
            system,
        };
        found.add_joints();
        found.add_members(&inertia);
        Ok(found)
    }

    /// The system.
    pub fn system(&self) -> &System {
        self.given.as_ref().unwrap_or(&self.system)
    }

    /// Number of constraints: rigid members, and directions that supports of sliders take.
    pub fn constraints(&self) -> usize {
        self.bars.len() + self.slides.len()
    }

    /// Number of coordinates: three for each joint that is no anchor.
    pub fn coordinates(&self) -> usize {
        3 * self.moving
    }

    fn add_joints(&mut self) {
        let gravity = self.system.gravity_m_s2();
        let reference = self.reference_m;
        for (joint, data) in self.system.joints().iter().enumerate() {
            let slot = self.slot_of[joint];
            self.mass[slot] += data.mass_kg;
            let weight = [0.0, 0.0, -data.mass_kg * gravity];
            self.load[slot] = std::array::from_fn(|k| data.force_n[k] + weight[k]);
            let Some(at_m) = data.support.at_m().filter(|_| !data.support.is_fixed()) else {
                continue;
            };
            let normals = data.support.normals();
            let at = minus(at_m, reference);
            self.slides.extend(normals.into_iter().map(|normal| Slide { slot, normal, at }));
        }
    }

    fn add_members(&mut self, inertia: &[EndInertia]) {
        let members = self.system.members();
        let (mut rigid, mut elastic) = (Vec::new(), Vec::new());
        for (number, member) in members.iter().enumerate() {
            let [a, b] = [member.from, member.to].map(|joint| self.slot_of[joint]);
            self.mass[a] += inertia[number].from;
            self.mass[b] += inertia[number].to;
            let [at_a, at_b] = member.end_loads_n(self.system.gravity_m_s2());
            self.load[a] = add_times(self.load[a], 1.0, at_a);
            self.load[b] = add_times(self.load[b], 1.0, at_b);
            // Inextensible cables and struts that come here are slack, ropes are taut. What is between anchors keeps
            // nothing from moving.
            let is_rigid = member.kind == Kind::Bar || member.rope.is_some();
            let moves = member.path().any(|joint| self.slot_of[joint] < self.moving);
            if is_rigid && moves && member.stiffness_n.is_none() {
                rigid.push((a.min(b), number));
            } else {
                elastic.push(number);
            }
        }
        // Bars in the order of their first slots are read one behind the other.
        rigid.sort_by_key(|(slot, _)| *slot);
        let mut spans = Vec::with_capacity(members.len());
        let mut spanned = |member: usize| {
            let first = spans.len();
            let all = members[member].spans();
            let length_m = members[member].body.length_m();
            let part_m = length_m / all.clone().count() as f64;
            spans.extend(all.map(|ends| {
                let [a, b] = ends.map(|joint| self.slot_of[joint]);
                Link { a, b, length_m: part_m, member, inertia: inertia[member] }
            }));
            (first..spans.len(), length_m)
        };
        for (_, member) in rigid {
            let (spans, length_m) = spanned(member);
            self.bars.push(Rigid { spans, length_m, member });
        }
        for member in elastic {
            let (spans, length_m) = spanned(member);
            let (kind, stiffness_n) = (members[member].kind, members[member].stiffness_n);
            let stiffness_n = stiffness_n.unwrap_or(0.0);
            self.springs.push(Spring { spans, length_m, member, kind, stiffness_n });
        }
        self.spans = spans;
    }

    pub(crate) fn name(&self, slot: usize) -> String {
        self.system.joints()[self.joint_at[slot]].name.to_string()
    }

    pub(crate) fn of(&self, spans: &Range<usize>) -> &[Link] {
        &self.spans[spans.clone()]
    }

    /// Number of spans of rigid members: so many of all have a vector in the rows.
    pub(crate) fn rigid_spans(&self) -> usize {
        self.bars.last().map_or(0, |bar| bar.spans.end)
    }

    /// Number of vectors that the rows are made of: one for each span and for each direction of a
    /// slider.
    pub(crate) fn vectors(&self) -> usize {
        self.rigid_spans() + self.slides.len()
    }

    /// Number of joints and members of the system as given, without corners.
    pub(crate) fn given(&self) -> [usize; 2] {
        let given = self.system();
        [given.joints().len(), given.members().len()]
    }

    /// Number of the member that a member belongs to: itself, or that with the corner it holds.
    pub(crate) fn owner(&self, number: usize) -> usize {
        let before = self.cornered.partition_point(|cornered| cornered.first <= number);
        before.checked_sub(1).map_or(number, |last| self.cornered[last].member)
    }

    /// Places by slot, relative to the reference, of places by joint in the world frame.
    /// [`MotionError::Input`] when their number is not that of the joints, or one is not finite.
    pub(crate) fn places(&self, joints_m: &[Vector]) -> Result<Vec<Vector>> {
        let reference = self.reference_m;
        self.check_vectors(joints_m, "places of the joints")?;
        let mut joints_m = joints_m.to_vec();
        for cornered in &self.cornered {
            cornered.place(&self.system.members()[cornered.member].body, &mut joints_m);
        }
        let by_slot = self.joint_at.iter().map(|&joint| joints_m[joint]);
        let mut places: Vec<Vector> = by_slot.map(|x| minus(x, reference)).collect();
        let anchors = places.iter_mut().zip(&self.joint_at).skip(self.moving);
        for (place, &joint) in anchors {
            if let Some(at_m) = self.system.joints()[joint].support.at_m() {
                *place = minus(at_m, reference);
            }
        }
        Ok(places)
    }

    /// Vectors by slot of vectors by joint; none at corners.
    pub(crate) fn by_slot(&self, by_joint: &[Vector], what: &'static str) -> Result<Vec<Vector>> {
        self.check_vectors(by_joint, what)?;
        let of = |&joint: &usize| by_joint.get(joint).copied().unwrap_or_default();
        Ok(self.joint_at.iter().map(of).collect())
    }

    /// Refuse vectors that are not as many as the joints as given, or not finite.
    fn check_vectors(&self, by_joint: &[Vector], what: &'static str) -> Result<()> {
        let [joints, _] = self.given();
        if by_joint.len() != joints {
            let reason = format!("{} given for {joints} joints", by_joint.len());
            return Err(MotionError::Input { what, reason });
        }
        if let Some(joint) = by_joint.iter().position(|x| x.iter().any(|x| !x.is_finite())) {
            let name = &self.system.joints()[joint].name;
            let reason = format!("not finite at joint {name:?}");
            return Err(MotionError::Input { what, reason });
        }
        Ok(())
    }

    /// Vectors by joint of vectors by slot, without corners.
    pub(crate) fn by_joint(&self, by_slot: &[Vector]) -> Vec<Vector> {
        self.slot_of[..self.given()[0]].iter().map(|&slot| by_slot[slot]).collect()
    }
}

/// Pairs of joints that move and that a member or the row of a rope has parts at.
fn coupled(system: &System, moves: &[bool]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for member in system.members() {
        let path = member.path().filter(|&joint| moves[joint]);
        for (k, a) in path.clone().enumerate() {
            found.extend(path.clone().skip(k + 1).filter(|&b| b != a).map(|b| (a, b)));
        }
    }
    found
}
