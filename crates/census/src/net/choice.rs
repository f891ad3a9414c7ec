//! Positions of a part, one after the other.

use model::system::System;
use numerics::Interval;

use super::parts::Part;
use crate::boxes::arithmetic::{NOWHERE, Vector, product};
use crate::boxes::frame::Frame;

/// A system with the units in which its census counts.
#[derive(Clone, Copy)]
pub(super) struct Measured<'a> {
    pub(super) system: &'a System,
    pub(super) frame: &'a Frame,
}

impl Measured<'_> {
    pub(super) fn length(self, member: usize) -> Interval {
        self.frame.length(Interval::point(self.system.members()[member].body.length_m()))
    }

    /// Places of all joints in a position.
    pub(super) fn places(self, choice: &Choice) -> Vec<Vector> {
        let held = |at_m| self.frame.place(at_m);
        let joints = self.system.joints().iter();
        let mut places: Vec<_> =
            joints.map(|joint| joint.support.at_m().map_or(NOWHERE, held)).collect();
        for (joint, place) in &choice.places {
            if !self.system.joints()[*joint].support.is_fixed() {
                places[*joint] = *place;
            }
        }
        places
    }
}

/// One position of some joints and the forces of some members, in the units of the frame.
#[derive(Debug, Clone, Default)]
pub(super) struct Choice {
    pub(super) places: Vec<(usize, Vector)>,
    pub(super) axial: Vec<(usize, Interval)>,
    /// Independent directions in which the energy falls, in the plane and out of it.
    pub(super) index: [usize; 2],
    /// Whether the part turns freely about the vertical through its anchors.
    pub(super) circle: bool,
}

impl Choice {
    /// The anchors on which the trees of a part hang.
    pub(super) fn anchor(Measured { system, frame }: Measured<'_>, part: &Part) -> Self {
        let place =
            |joint: usize| Some((joint, frame.place(system.joints()[joint].support.at_m()?)));
        let places = part.hanging.iter().filter_map(|hanging| place(hanging.parent)).collect();
        Self { places, ..Self::default() }
    }

    pub(super) fn place(&self, joint: usize) -> Option<Vector> {
        self.places.iter().find(|(k, _)| *k == joint).map(|(_, place)| *place)
    }

    /// What it is in the vertical plane in which its joints slide, with this level axis: of what would turn freely about
    /// the vertical through its anchors, of which the position through y is shown, both sides.
    pub(super) fn in_plane(self, system: &System, level: usize) -> Vec<Self> {
        let anchor = |(joint, _): &&(usize, Vector)| system.joints()[*joint].support.is_fixed();
        let Some((_, axis)) = self.places.iter().find(anchor).filter(|_| self.circle) else {
            return vec![self];
        };
        let side = |sign: Interval| {
            let at = |(joint, place): &(usize, Vector)| {
                let mut at = [axis[0], axis[1], place[2]];
                at[level] = at[level] + product(sign, place[1] - axis[1]);
                (*joint, at)
            };
            let places = self.places.iter().map(at).collect();
            Self { places, circle: false, ..self.clone() }
        };
        vec![side(Interval::ONE), side(-Interval::ONE)]
    }

    /// This and another one together.
    pub(super) fn and(&self, other: &Self) -> Self {
        let mut both = self.clone();
        both.places.extend_from_slice(&other.places);
        both.axial.extend_from_slice(&other.axial);
        for (sum, part) in both.index.iter_mut().zip(other.index) {
            *sum += part;
        }
        both.circle |= other.circle;
        both
    }
}
