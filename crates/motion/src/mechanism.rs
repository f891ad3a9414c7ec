//! A system of bars as the mechanics of the places of its joints.

use model::Vector;
use model::system::{Kind, Member, Support, System};

use crate::corners::{Cornered, Expanded, expand};
use crate::error::MotionError;
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
    /// Rigid bars; bar *k* has the row *k* of the constraints.
    pub(crate) bars: Vec<Link>,
    /// Members with a stiffness.
    pub(crate) springs: Vec<Spring>,
    /// Supports of sliders; support *k* has the row `bars.len() + k`.
    pub(crate) slides: Vec<Slide>,
    /// Diagonal of the mass matrix by slot, kg, the same for each axis.
    pub(crate) mass: Vec<f64>,
    /// Constant force by slot, N: weights and forces lumped by the lever rule.
    pub(crate) load: Vec<Vector>,
}

/// A member between two slots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Link {
    /// Slots of its ends.
    pub a: usize,
    pub b: usize,
    pub length_m: f64,
    /// Its number among the members.
    pub member: usize,
    pub inertia: EndInertia,
}

/// A member with a stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spring {
    pub link: Link,
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

/// What does not take ropes.
pub(crate) const MOTION: &str = "motion";

impl Mechanism {
    /// The mechanics of a system in small motions.
    ///
    /// # Errors
    ///
    /// [`MotionError`] when the system has members or joints whose motion is indeterminate:
    /// inextensible cables and struts, moments that no body has, joints without inertia.
    pub fn new(system: &System) -> Result<Self, MotionError> {
        refuse_inextensible(system)?;
        Self::for_small_motions(system)
    }

    /// The same, where inextensible cables and struts are slack.
    pub(crate) fn for_small_motions(system: &System) -> Result<Self, MotionError> {
        let inertia = smaller(system)?;
        let expanded = Expanded { system: system.clone(), inertia, cornered: Vec::new() };
        Self::build(expanded, None, system.reference_m())
    }

    /// For places alone, where nothing depends on how bars spin.
    pub(crate) fn for_places(system: &System) -> Result<Self, MotionError> {
        let inertia = system.members().iter().map(|m| EndInertia::new(&m.body)).collect();
        let expanded = Expanded { system: system.clone(), inertia, cornered: Vec::new() };
        Self::build(expanded, None, system.reference_m())
    }

    /// For motions: with corners at bars whose moments across differ. Inextensible cables and
    /// struts are slack.
    pub(crate) fn for_motion(system: &System, reference_m: Vector) -> Result<Self, MotionError> {
        let expanded = expand(system)?;
        let given = (!expanded.cornered.is_empty()).then(|| system.clone());
        Self::build(expanded, given, reference_m)
    }

    fn build(
        expanded: Expanded,
        given: Option<System>,
        reference_m: Vector,
    ) -> Result<Self, MotionError> {
        let Expanded { system, inertia, cornered } = expanded;
        system.without_ropes(MOTION)?;
        if given.as_ref().unwrap_or(&system).floor_m().is_some() {
            return Err(MotionError::Floor);
        }
        let joints = system.joints();
        let moves: Vec<bool> = joints.iter().map(|joint| !joint.support.is_fixed()).collect();
        let edges: Vec<_> = system.members().iter().map(|m| (m.from, m.to)).collect();
        let between: Vec<_> =
            edges.iter().copied().filter(|&(a, b)| moves[a] && moves[b]).collect();
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
            is_forest: ordered.is_forest,
            bars: Vec::new(),
            springs: Vec::new(),
            slides: Vec::new(),
            mass: vec![0.0; joints.len()],
            load: vec![[0.0; 3]; joints.len()],
            system,
        };
        found.add_joints();
        found.add_members(&inertia);
        if let Some(link) = found.bars.iter().find(|link| link.a.min(link.b) >= moving) {
            return Err(MotionError::Redundant { joint: found.name(link.a), pivot: 0.0 });
        }
        Ok(found)
    }

    /// The system.
    #[must_use]
    pub fn system(&self) -> &System {
        self.given.as_ref().unwrap_or(&self.system)
    }

    /// Number of constraints: rigid bars, and directions that supports of sliders take.
    #[must_use]
    pub fn constraints(&self) -> usize {
        self.bars.len() + self.slides.len()
    }

    /// Number of coordinates: three for each joint that is no anchor.
    #[must_use]
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
            let (at_m, normals) = match data.support {
                Support::Free | Support::Fixed { .. } => continue,
                Support::Plane { at_m, normal } => (at_m, vec![normal]),
                Support::Line { at_m, direction } => (at_m, across(direction).to_vec()),
            };
            let at = minus(at_m, reference);
            self.slides.extend(normals.into_iter().map(|normal| Slide { slot, normal, at }));
        }
    }

    fn add_members(&mut self, inertia: &[EndInertia]) {
        for (number, member) in self.system.members().iter().enumerate() {
            let link = Link {
                a: self.slot_of[member.from],
                b: self.slot_of[member.to],
                length_m: member.body.length_m(),
                member: number,
                inertia: inertia[number],
            };
            self.mass[link.a] += link.inertia.from;
            self.mass[link.b] += link.inertia.to;
            let [at_a, at_b] = end_loads(member, self.system.gravity_m_s2());
            self.load[link.a] = add_times(self.load[link.a], 1.0, at_a);
            self.load[link.b] = add_times(self.load[link.b], 1.0, at_b);
            match (member.stiffness_n, member.kind) {
                (None, Kind::Bar) => self.bars.push(link),
                (stiffness_n, kind) => {
                    // Inextensible cables and struts that come here are slack.
                    let stiffness_n = stiffness_n.unwrap_or(0.0);
                    self.springs.push(Spring { link, kind, stiffness_n });
                }
            }
        }
        // Bars in the order of their first slots are read one behind the other.
        self.bars.sort_by_key(|link| link.a.min(link.b));
    }

    /// Name of the joint in a slot.
    pub(crate) fn name(&self, slot: usize) -> String {
        self.system.joints()[self.joint_at[slot]].name.clone()
    }

    /// All members, rigid ones first.
    pub(crate) fn links(&self) -> impl Iterator<Item = &Link> {
        self.bars.iter().chain(self.springs.iter().map(|spring| &spring.link))
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
    ///
    /// # Errors
    ///
    /// [`MotionError::Input`] when their number is not that of the joints, or one is not finite.
    pub(crate) fn places(&self, joints_m: &[Vector]) -> Result<Vec<Vector>, MotionError> {
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
    pub(crate) fn by_slot(
        &self,
        by_joint: &[Vector],
        what: &'static str,
    ) -> Result<Vec<Vector>, MotionError> {
        self.check_vectors(by_joint, what)?;
        let of = |&joint: &usize| by_joint.get(joint).copied().unwrap_or_default();
        Ok(self.joint_at.iter().map(of).collect())
    }

    /// Refuse vectors that are not as many as the joints as given, or not finite.
    fn check_vectors(&self, by_joint: &[Vector], what: &'static str) -> Result<(), MotionError> {
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

/// Weight and forces of a member at its ends, N, by the lever rule.
pub(crate) fn end_loads(member: &Member, gravity_m_s2: f64) -> [Vector; 2] {
    let bar = &member.body;
    let weight = [0.0, 0.0, -bar.mass_kg() * gravity_m_s2];
    let own = member.loads.iter().map(|load| (load.at_m, load.force_n));
    let mut ends = [[0.0; 3]; 2];
    for (at_m, force_n) in own.chain([(bar.centre_m(), weight)]) {
        let far = at_m / bar.length_m();
        ends[0] = add_times(ends[0], (bar.length_m() - at_m) / bar.length_m(), force_n);
        ends[1] = add_times(ends[1], far, force_n);
    }
    ends
}

/// Two unit vectors across a unit vector and each other.
fn across(direction: Vector) -> [Vector; 2] {
    let unit = |v: Vector| {
        let length = numerics::vector::norm(v);
        v.map(|x| x / length)
    };
    // The axis that the direction has least of.
    let least = (0..3).min_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs()));
    let mut axis = [0.0; 3];
    axis[least.unwrap_or(0)] = 1.0;
    let first = unit(numerics::vector::cross(direction, axis));
    [first, unit(numerics::vector::cross(direction, first))]
}
