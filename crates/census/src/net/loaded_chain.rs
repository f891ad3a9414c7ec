//! A chain between two anchors with weights at its joints: the census of a chain of bars.
//!
//! What hangs at a joint adds to the weight $c_i$ that all further bars carry, and to nothing else;
//! the search is the one for chains. Bars bear their own weight; where one is given against the
//! direction of the chain and its centre would be rounded, its weight is handed over at the joints
//! like that of all else, to twice the usual precision.

use model::system::{Member, System};
use model::{Anchors, Bar, Chain, NoCensus};
use numerics::DoubleDouble;

use super::choice::Choice;
use super::parts::Hanging;
use super::weights::{shared_kg, weights_kg};
use crate::boxes::frame::Frame;
use crate::net::Result;
use crate::run::Census;
use crate::run::check::CheckError;
use crate::run::equilibrium::ProvenEquilibrium;
use crate::run::plane::loads::JointLoads;
use crate::run::plane::system::groups;
use crate::run::search::Progress;
use crate::settings::Settings;

/// A chain between anchors with what hangs at its joints.
pub(super) struct LoadedChain {
    pub(super) chain: Chain,
    pub(super) loads: JointLoads,
    /// Whether all bars bear their own weight.
    pub(super) whole: bool,
}

impl LoadedChain {
    /// From the joints and members of a chain in a system, and the trees that hang on it.
    pub(super) fn new(
        system: &System,
        joints: &[usize],
        members: &[usize],
        hanging: &[Hanging],
    ) -> Result<Self> {
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
        let walk = members.iter().zip(joints);
        let own: Vec<Option<Bar>> =
            walk.map(|(member, joint)| along(&system.members()[*member], *joint)).collect();
        let bearing: Vec<usize> =
            members.iter().zip(&own).filter_map(|(k, bar)| bar.map(|_| *k)).collect();
        let mut kg = weights_kg(system, &moving, &bearing)?;
        // Outermost first.
        for Hanging { parent, child, .. } in hanging.iter().rev() {
            if let Some(weight) = kg[*child] {
                kg[*parent] = Some(kg[*parent].map_or(weight, |own| own + weight));
            }
        }
        let light = |number: usize| {
            Bar::homogeneous(system.members()[number].body.length_m(), 0.0)
                .map_err(|_| NoCensus::Settings)
        };
        let bars =
            members.iter().zip(&own).map(|(member, own)| own.map_or_else(|| light(*member), Ok));
        let bars = bars.collect::<Result<Vec<_>, _>>()?;
        let anchor = |joint: usize| system.joints()[joint].support.at_m().ok_or(NoCensus::Settings);
        let anchors =
            Anchors { start_m: anchor(joints[0])?, end_m: anchor(joints[joints.len() - 1])? };
        let mut kg: Vec<Option<DoubleDouble>> = joints.iter().map(|joint| kg[*joint]).collect();
        // Energies count from the height of the first anchor; what a bar without its own weight leaves at the
        // last one has some.
        let end = members.len();
        let without = members.last().zip(own.last()).filter(|(_, own)| own.is_none());
        kg[end] = without.and_then(|(last, _)| {
            let member = &system.members()[*last];
            shared_kg(member, member.from == joints[end])
        });
        let loads = JointLoads::new(kg);
        if groups(&bars, &loads).len() < 2 {
            return Err(NoCensus::Limp { member: members[0] + 1 });
        }
        let chain = Chain::new(system.name(), system.gravity_m_s2(), anchors, bars)
            .map_err(|_| NoCensus::Settings)?;
        Ok(Self { chain, loads, whole: own.iter().all(Option::is_some) })
    }

    pub(super) fn census(&self, settings: &Settings, watch: &dyn Fn(Progress)) -> Result<Census> {
        Census::of_chain(&self.chain, &self.loads, settings, watch).map_err(|error| error.reason())
    }

    /// Its census judged again.
    pub(super) fn check(&self, census: &Census) -> Result<(), CheckError> {
        census.check_chain(&self.chain, &self.loads)
    }
}

/// The bar that a member is from one of its joints on; nothing where its centre would be rounded.
fn along(member: &Member, first: usize) -> Option<Bar> {
    let body = member.body;
    let (length_m, centre_m) = (body.length_m(), body.centre_m());
    if member.from == first || body.mass_kg() <= 0.0 {
        return Some(body);
    }
    let from_end_m = length_m - centre_m;
    // The rounding of the difference, itself without rounding.
    let is_exact = ((length_m - from_end_m) - centre_m).abs() <= 0.0;
    let turned = || Bar::new(length_m, body.mass_kg(), from_end_m, body.inertia_kg_m2()).ok();
    is_exact.then(turned).flatten()
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
    let places = proven.joints_m.iter().map(|at_m| frame.places(*at_m));
    let axial = proven.axial_n.iter().map(|axial| frame.force(*axial));
    Choice {
        places: joints.iter().copied().zip(places).collect(),
        axial: members.iter().copied().zip(axial).collect(),
        index: [proven.index_in_plane, proven.index_out_of_plane],
        circle: proven.circle,
    }
}
