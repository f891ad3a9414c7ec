//! A chain between two anchors with weights at its joints: the census of a chain of bars.
//!
//! What hangs at a joint adds to the weight $c_i$ that all further bars carry, and to nothing else;
//! the search is the one for chains. All weights, those of the bars too, are handed over at the
//! joints, to twice the usual precision: a bar that is told against the direction of the chain
//! would have its centre rounded.

use model::system::System;
use model::{Anchors, Bar, Chain, NoCensus};
use numerics::{DoubleDouble, Interval};

use super::choice::Choice;
use super::parts::Hanging;
use super::weights::weights_kg;
use crate::census::Census;
use crate::equilibrium::ProvenEquilibrium;
use crate::network::frame::Frame;
use crate::plane::loads::JointLoads;
use crate::settings::Settings;

/// A chain between anchors with what hangs at its joints.
pub(super) struct LoadedChain {
    pub(super) chain: Chain,
    pub(super) loads: JointLoads,
}

impl LoadedChain {
    /// From the joints and members of a chain in a system, and the trees that hang on it.
    pub(super) fn new(
        system: &System,
        joints: &[usize],
        members: &[usize],
        hanging: &[Hanging],
    ) -> Result<Self, NoCensus> {
        for number in members {
            let member = &system.members()[*number];
            if member.stiffness_n.is_some() {
                return Err(NoCensus::Elastic { member: number + 1 });
            }
        }
        let moving: Vec<usize> = joints[1..joints.len() - 1]
            .iter()
            .copied()
            .chain(hanging.iter().map(|hanging| hanging.child))
            .collect();
        let mut kg = weights_kg(system, &moving)?;
        // Outermost first.
        for Hanging { parent, child, .. } in hanging.iter().rev() {
            if let Some(weight) = kg[*child] {
                kg[*parent] = Some(kg[*parent].map_or(weight, |own| own + weight));
            }
        }
        if joints[1..joints.len() - 1].iter().all(|joint| kg[*joint].is_none()) {
            return Err(NoCensus::Limp { member: members[0] + 1 });
        }
        let light = |number: &usize| {
            Bar::homogeneous(system.members()[*number].body.length_m(), 0.0)
                .map_err(|_| NoCensus::Settings)
        };
        let bars = members.iter().map(light).collect::<Result<Vec<_>, _>>()?;
        let anchor = |joint: usize| system.joints()[joint].support.at_m().ok_or(NoCensus::Settings);
        let anchors =
            Anchors { start_m: anchor(joints[0])?, end_m: anchor(joints[joints.len() - 1])? };
        let chain = Chain::new(system.name(), system.gravity_m_s2(), anchors, bars)
            .map_err(|_| NoCensus::Settings)?;
        let kg: Vec<Option<DoubleDouble>> = joints.iter().map(|joint| kg[*joint]).collect();
        Ok(Self { chain, loads: JointLoads::new(kg) })
    }

    /// Its census.
    pub(super) fn census(&self, settings: &Settings) -> Result<Census, NoCensus> {
        let watch = &|_| {};
        Census::of_chain(&self.chain, &self.loads, settings, watch).map_err(|error| error.reason())
    }

    /// Its census judged again.
    pub(super) fn check(&self, census: &Census) -> Result<(), String> {
        census.check_chain(&self.chain, &self.loads).map_err(|error| error.to_string())
    }
}

/// The isolated positions of a census in the units of a frame.
pub(super) fn choices(
    census: &Census,
    frame: &Frame,
    [joints, members]: [&[usize]; 2],
) -> Vec<Choice> {
    let proven = census.equilibria.iter();
    proven.map(|proven| choice(proven, frame, joints, members)).collect()
}

fn choice(
    proven: &ProvenEquilibrium,
    frame: &Frame,
    joints: &[usize],
    members: &[usize],
) -> Choice {
    let place = |at_m: &[Interval; 3]| {
        std::array::from_fn(|k| frame.length(at_m[k] - Interval::point(frame.origin_m[k])))
    };
    let axial = proven.axial_n.iter().map(|axial| frame.force(*axial));
    Choice {
        places: joints.iter().copied().zip(proven.joints_m.iter().map(place)).collect(),
        axial: members.iter().copied().zip(axial).collect(),
        index: [proven.index_in_plane, proven.index_out_of_plane],
        circle: proven.circle,
    }
}
