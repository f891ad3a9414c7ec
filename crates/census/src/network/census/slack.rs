//! Positions of a chain in which a cable or strut bears nothing.
//!
//! The force in member g vanishes at the one pull $p = -c_g e_z$. All other forces are then
//! upright: the members before g hang plumb from the first anchor, or stand, those behind it from
//! the last, and what is between their ends must be shorter than a cable, or longer than a strut.

use model::NoCensus;
use model::system::{Kind, System};
use numerics::Interval;

use super::choice::Choice;
use super::core::LoadedChain;
use crate::network::arithmetic::{Vector, minus, norm};
use crate::network::frame::Frame;
use crate::plane::face::Face;
use crate::plane::system::System as Plane;

/// A chain while the positions of one slack member are gone through.
struct Slackened<'a> {
    system: &'a System,
    frame: &'a Frame,
    joints: &'a [usize],
    members: &'a [usize],
    /// Place of the slack member in the chain.
    slack: usize,
    /// Sizes of the axial forces of all members.
    sizes: Vec<Interval>,
}

/// All positions in which a cable or strut of a chain is slack.
pub(super) fn slackened(
    system: &System,
    frame: &Frame,
    loaded: &LoadedChain,
    [joints, members]: [&[usize]; 2],
) -> Result<Vec<Choice>, NoCensus> {
    let kind = |k: usize| system.members()[members[k]].kind;
    let mut found = vec![];
    if (0..members.len()).all(|k| kind(k) == Kind::Bar) {
        return Ok(found);
    }
    let plane = Plane::new(&loaded.chain, &loaded.loads);
    for (number, group) in plane.groups.iter().enumerate() {
        let Some(slack) = group.clone().find(|k| kind(*k) != Kind::Bar) else { continue };
        // Several members without force between joints without load need not be straight.
        if group.len() > 1 {
            return Err(NoCensus::Limp { member: members[slack] + 1 });
        }
        let face = Face::Around(u8::try_from(number).map_err(|_| NoCensus::Settings)?);
        let newton = plane.force_unit_n();
        let weights = plane.weights(face).iter();
        let sizes = weights.map(|c| frame.force(c.abs() * newton)).collect();
        let chain = Slackened { system, frame, joints, members, slack, sizes };
        chain.positions(&mut found)?;
    }
    Ok(found)
}

impl Slackened<'_> {
    /// Go through all signs of the other members that their kinds allow.
    fn positions(&self, found: &mut Vec<Choice>) -> Result<(), NoCensus> {
        let free: Vec<usize> = (0..self.members.len())
            .filter(|k| *k != self.slack && self.kind(*k) == Kind::Bar)
            .collect();
        for pattern in 0..1_u64 << free.len() {
            let signs: Vec<bool> = (0..self.members.len())
                .map(|k| match self.kind(k) {
                    Kind::Bar => free
                        .iter()
                        .position(|bar| *bar == k)
                        .is_some_and(|bit| pattern >> bit & 1 == 0),
                    Kind::Cable => true,
                    Kind::Strut => false,
                })
                .collect();
            found.extend(self.position(&signs)?);
        }
        Ok(())
    }

    fn kind(&self, k: usize) -> Kind {
        self.system.members()[self.members[k]].kind
    }

    fn length(&self, k: usize) -> Interval {
        let body = &self.system.members()[self.members[k]].body;
        self.frame.length(Interval::point(body.length_m()))
    }

    /// The position with these members in tension, if the slack one is.
    fn position(&self, tension: &[bool]) -> Result<Option<Choice>, NoCensus> {
        let last = self.members.len();
        let mut places: Vec<Option<Vector>> = vec![None; last + 1];
        for (end, joint) in [(0, self.joints[0]), (last, self.joints[last])] {
            let at_m = self.system.joints()[joint].support.at_m();
            places[end] = at_m.map(|at_m| self.frame.place(at_m));
        }
        let below = |place: Option<Vector>, k: usize| {
            place.map(|[x, y, z]| {
                [x, y, if tension[k] { z - self.length(k) } else { z + self.length(k) }]
            })
        };
        for k in 0..self.slack {
            places[k + 1] = below(places[k], k);
        }
        for k in (self.slack + 1..last).rev() {
            places[k] = below(places[k + 1], k);
        }
        let limp = NoCensus::Limp { member: self.members[self.slack] + 1 };
        let (Some(a), Some(b)) = (places[self.slack], places[self.slack + 1]) else {
            return Err(limp);
        };
        let (gap, length) = (norm(minus(b, a)), self.length(self.slack));
        let shorter = match () {
            () if gap.hi() < length.lo() => true,
            () if gap.lo() > length.hi() => false,
            () => return Err(limp),
        };
        if shorter != (self.kind(self.slack) == Kind::Cable) {
            return Ok(None);
        }
        let axial = |k: usize| match k {
            _ if k == self.slack => Interval::ZERO,
            _ if tension[k] => self.sizes[k],
            _ => -self.sizes[k],
        };
        let compressed = (0..last).filter(|k| *k != self.slack && !tension[*k]).count();
        Ok(Some(Choice {
            places: self.joints.iter().copied().zip(places.into_iter().flatten()).collect(),
            axial: (0..last).map(|k| (self.members[k], axial(k))).collect(),
            index: [compressed; 2],
            circle: false,
        }))
    }
}
