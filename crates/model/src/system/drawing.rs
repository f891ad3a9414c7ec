//! The structure as drawn: places next to which the equilibrium is wanted.

use std::collections::HashMap;

use super::{Joint, LENGTH_ROUNDING, Member, Support, System, SystemError};
use crate::{Anchors, Vector};

impl System {
    /// The place of every joint as it is drawn, m; `None` where nothing is drawn.
    ///
    /// ```
    /// use model::system::{Joint, Member, System};
    /// use model::Bar;
    /// let bar = Bar::homogeneous(1.0, 0.0)?;
    /// let prop = |top: Joint| {
    ///     let joints = vec![Joint::anchor("foot", [0.0; 3]), top.with_mass(1.0)];
    ///     System::new("a prop", 9.81, joints, vec![Member::bar(0, 1, bar)])
    /// };
    /// let upright = prop(Joint::free("top").near([0.0, 0.0, 1.0]))?;
    /// assert_eq!(upright.drawing(), Some(vec![[0.0; 3], [0.0, 0.0, 1.0]]));
    /// assert_eq!(prop(Joint::free("top"))?.drawing(), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn drawing(&self) -> Option<Vec<Vector>> {
        let drawn = self.joints.iter().any(|joint| joint.near_m.is_some());
        let places = || self.joints.iter().map(Joint::drawn_m).collect();
        if drawn { places() } else { None }
    }

    /// The same system with another drawing: a place for every joint, m. Those of joints that are
    /// held do not count, and one that slides is put where its support lets it be, as near as it
    /// can.
    ///
    /// # Errors
    /// [`SystemError`] when two joints are drawn at one place, or a coordinate is not finite.
    ///
    /// # Panics
    /// When there are more or fewer places than joints.
    pub fn drawn_at(mut self, places_m: &[Vector]) -> Result<Self, SystemError> {
        assert_eq!(places_m.len(), self.joints.len(), "a place for every joint");
        for (joint, place_m) in self.joints.iter_mut().zip(places_m) {
            let drawn = !joint.support.is_fixed();
            joint.near_m = drawn.then(|| joint.support.nearest_m(*place_m));
        }
        super::error::check(self.gravity_m_s2, &self.joints, &self.members)?;
        Ok(self)
    }

    /// The same joints, with their own loads, on other supports, and with these members: without floor and drawing, of which
    /// supports may know nothing.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn on_supports(
        &self,
        support: impl Fn(usize, &Joint) -> Support,
        members: Vec<Member>,
    ) -> Result<Self, SystemError> {
        let joints = self.joints.iter().enumerate();
        let joints = joints.map(|(k, joint)| joint.clone().held_by(support(k, joint)).near(None));
        Self::new(self.name.clone(), self.gravity_m_s2, joints.collect(), members)
    }

    /// The same [on supports](Self::on_supports) that keep the joints that lie on the floor in its level, at these places, m,
    /// where they may rise.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn laid(
        &self,
        joints_m: &[Vector],
        lies: impl Fn(usize, &Joint) -> bool,
        members: Vec<Member>,
    ) -> Result<Self, SystemError> {
        let level = |k: usize, joint: &Joint| {
            let floor_m = self.floor_m.filter(|_| lies(k, joint))?;
            joint.support.on_level([joints_m[k][0], joints_m[k][1], floor_m])
        };
        self.on_supports(|k, joint| level(k, joint).unwrap_or(joint.support), members)
    }

    /// The axis (0 for *x*) across the plane of two axes that supports keep every joint to; `None` where some joint may leave
    /// such a plane, or none can move.
    ///
    /// ```
    /// use model::system::{Joint, Member, Support, System};
    /// use model::Bar;
    /// let wall = Support::Plane { at_m: [0.0, 2.0, 0.0], normal: [0.0, 1.0, 0.0] };
    /// let joints = vec![Joint::anchor("A", [0.0, 2.0, 1.0]), Joint::free("P").with_mass(1.0).held_by(wall)];
    /// let system = System::new("", 10.0, joints, vec![Member::bar(0, 1, Bar::homogeneous(1.0, 0.0)?)])?;
    /// assert_eq!(system.across(), Some(1));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn across(&self) -> Option<usize> {
        let plane = |joint: &Joint| match joint.support {
            Support::Plane { at_m, normal } => Some((at_m, normal)),
            _ => None,
        };
        let (origin_m, normal) = self.joints.iter().find_map(plane)?;
        let axis = (0..3).find(|axis| normal[*axis].abs() >= 1.0)?;
        let in_plane = |at_m: Vector| (at_m[axis] - origin_m[axis]).abs() <= 0.0;
        let kept = self.joints.iter().all(|joint| match joint.support {
            Support::Free => false,
            Support::Fixed { at_m } => in_plane(at_m),
            Support::Line { at_m, direction } => direction[axis].abs() <= 0.0 && in_plane(at_m),
            Support::Plane { at_m, normal } => normal[axis].abs() >= 1.0 && in_plane(at_m),
        });
        kept.then_some(axis)
    }

    /// The same system without a drawing: the question is the lowest equilibrium.
    #[must_use]
    pub fn undrawn(mut self) -> Self {
        for joint in self.joints.iter_mut().filter(|joint| joint.near_m.is_some()) {
            joint.near_m = None;
        }
        self
    }
}

/// Refuse a drawing that leaves joints out, puts two at one place, or leaves a support.
pub(super) fn check(joints: &[Joint]) -> Result<(), SystemError> {
    if joints.iter().all(|joint| joint.near_m.is_none()) {
        return Ok(());
    }
    let mut seen: HashMap<[u64; 3], usize> = HashMap::with_capacity(joints.len());
    for (number, joint) in joints.iter().enumerate() {
        let name = || joint.name.to_string();
        let Some(place_m) = joint.drawn_m() else {
            return Err(SystemError::NotDrawn { name: name(), joint: number });
        };
        let distance_m = joint.near_m.map_or(0.0, |start_m| {
            Anchors { start_m, end_m: joint.support.nearest_m(start_m) }.span_m()
        });
        if distance_m > LENGTH_ROUNDING * reach_m(joint) {
            return Err(SystemError::DrawnOffSupport { name: name(), joint: number, distance_m });
        }
        // Minus zero is zero.
        let bits = place_m.map(|x| (x + 0.0).to_bits());
        if let Some(other) = seen.insert(bits, number)
            && !(joint.support.is_fixed() && joints[other].support.is_fixed())
        {
            let other = joints[other].name.to_string();
            return Err(SystemError::DrawnTogether { name: name(), joint: number, other });
        }
    }
    Ok(())
}

/// The largest coordinate of what a joint's support and drawing name: rounding is measured by it.
fn reach_m(joint: &Joint) -> f64 {
    let places = [joint.support.at_m(), joint.near_m];
    places.into_iter().flatten().flatten().fold(0.0, |a: f64, x| a.max(x.abs()))
}
