//! Cables, struts and ropes of a part that are taut, or slack.
//!
//! A slack member bears nothing, and is as if it were not there: for each set of slack members the part falls
//! into others, whose equilibria are listed as those of a part of bars. Of these one belongs to the system where
//! taut cables pull, taut struts push, and slack ones are shorter or longer than they reach. With a set of slack
//! members with which some joints and their load fall, all larger ones let them fall.

use model::NoCensus;
use model::system::{Kind, System};
use numerics::Interval;

use super::choice::{Choice, Measured};
use super::loaded_chain::LoadedChain;
use super::parts::{Core, Part, parts};
use crate::boxes::arithmetic::{NOWHERE, Vector, plus};
use crate::boxes::proven::reach;
use crate::net::Result;

/// Most sets of slack members.
const MOST: usize = 64;

/// A part with some of its members slack.
pub(super) struct Branch {
    pub(super) slack: Vec<usize>,
    pub(super) parts: Vec<Part>,
}

/// A part with each set of its members slack that holds its loads, none of them slack first.
pub(super) fn branches(
    Measured { system, frame }: Measured<'_>,
    taut: Part,
) -> Result<Vec<Branch>> {
    let (one_sided, joints) = (taut.one_sided(system), taut.joints.clone());
    let loads = frame.loads(system);
    let mut found = vec![Branch { slack: vec![], parts: vec![taut] }];
    let mut next = 0;
    while next < found.len() {
        let before = found[next].slack.clone();
        next += 1;
        for member in &one_sided {
            if before.last().is_some_and(|last| member <= last) {
                continue;
            }
            let slack: Vec<usize> = before.iter().copied().chain([*member]).collect();
            let mut parts = parts(system, &slack);
            parts.retain(|part| joints.contains(&part.joints[0]));
            let parts: Vec<Part> = parts.into_iter().map(|part| searched(system, part)).collect();
            if !parts.iter().any(|part| falls(part, &loads)) {
                found.push(Branch { slack, parts });
            }
            if found.len() > MOST {
                return Err(NoCensus::SlackSets { limit: MOST });
            }
        }
    }
    Ok(found)
}

/// The same, with a chain that is elastic or under level loads as a net: the census of chains does not take it.
fn searched(system: &System, part: Part) -> Part {
    let Core::Chain { joints, members } = &part.core else { return part };
    match LoadedChain::new(system, joints, members, &part.hanging) {
        Err(NoCensus::Elastic { .. } | NoCensus::LoadsNotDown { .. }) => {
            let joints = joints[1..joints.len() - 1].to_vec();
            let core = Core::Net { joints, members: members.clone() };
            Part { core, ..part }
        }
        _ => part,
    }
}

/// Whether nothing holds what bears a load.
fn falls(part: &Part, loads: &[Vector]) -> bool {
    let load = part.joints.iter().fold(NOWHERE, |all, joint| plus(all, loads[*joint]));
    !part.grounded && load.iter().any(|force| !force.contains(0.0))
}

/// Whether the taut members of a position pull or push as their kinds do.
/// [`NoCensus::Limp`], of a member that may bear nothing.
pub(super) fn signs_hold(system: &System, choice: &Choice) -> Result<bool> {
    let signed = choice.axial.iter().filter_map(|(member, axial)| {
        let borne = match system.members()[*member].kind {
            Kind::Bar => return None,
            Kind::Cable => *axial,
            Kind::Strut => -*axial,
        };
        Some((*member, borne))
    });
    hold(signed)
}

fn hold(signed: impl Iterator<Item = (usize, Interval)>) -> Result<bool> {
    let mut open = None;
    for (member, spare) in signed {
        if spare.hi() < 0.0 {
            return Ok(false);
        }
        if spare.lo() <= 0.0 {
            open = open.or(Some(NoCensus::Limp { member: member + 1 }));
        }
    }
    open.map_or(Ok(true), Err)
}

impl Branch {
    /// Whether the slack cables of a position are longer than they reach, and the slack struts shorter.
    /// [`NoCensus::Limp`], of a member that may be taut.
    pub(super) fn has(&self, of: Measured<'_>, choice: &Choice) -> Result<bool> {
        let places = of.places(choice);
        hold(self.slack.iter().map(|number| {
            let member = &of.system.members()[*number];
            let spare = of.length(*number) - reach(member, &places);
            (*number, if member.kind == Kind::Strut { -spare } else { spare })
        }))
    }
}
