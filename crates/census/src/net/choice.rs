//! Positions of a part, one after the other.

use model::system::System;
use numerics::Interval;

use super::parts::Part;
use crate::boxes::arithmetic::{Vector, product};
use crate::boxes::frame::Frame;

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
    pub(super) fn anchor(system: &System, frame: &Frame, part: &Part) -> Self {
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
