//! Trees: every member hangs in the direction of the force that it carries, or stands against it.
//!
//! The member e alone holds all that hangs further out, with the sum $F_e$ of the loads there. So
//! its direction from parent to child is $s_e F_e/|F_e|$ with $s_e = +1$ in tension and −1 in
//! compression, whatever the others do: $2^k$ positions for k members, no other ones, as long as no
//! $F_e$ vanishes. The energy is $-\sum_e F_e \cdot d_e$: it rises in both directions across a
//! member in tension and falls in both across one in compression. An elastic member is as long as
//! its force makes it, $l_e (1 + s_e |F_e|/EA)$.

use model::NoCensus;
use model::system::Kind;
use numerics::Interval;

use super::choice::{Choice, Measured};
use super::parts::Hanging;
use super::{MAX_POSITIONS, Result};
use crate::boxes::arithmetic::{Vector, norm, plus, product, sum, times};

/// A member of a tree with the force that it carries.
struct Carrying {
    at: Hanging,
    direction: Vector,
    /// The signs that its kind allows, with the axial force and the length of each.
    ways: Vec<Way>,
}

struct Way {
    axial: Interval,
    /// Along the direction of the force; negative in compression.
    reach: Interval,
}

/// Loads of all joints with all that hangs on them in trees.
pub(super) fn borne(of: Measured<'_>, hanging: &[Hanging]) -> Vec<Vector> {
    let mut loads = of.frame.loads(of.system);
    // Outermost first.
    for at in hanging.iter().rev() {
        loads[at.parent] = plus(loads[at.parent], loads[at.child]);
    }
    loads
}

/// Whatever positions the trees of a part can be in, once for each position of what they hang on.
pub(super) fn hung(
    of: Measured<'_>,
    hanging: &[Hanging],
    mut choices: Vec<Choice>,
) -> Result<Vec<Choice>> {
    let borne = borne(of, hanging);
    for at in hanging {
        let member = carrying(of, *at, borne[at.child])?;
        if choices.len().saturating_mul(member.ways.len()) > MAX_POSITIONS {
            return Err(NoCensus::TooManyPositions { limit: MAX_POSITIONS });
        }
        choices = choices
            .iter()
            .flat_map(|choice| member.ways.iter().filter_map(|way| extended(choice, &member, way)))
            .collect();
    }
    Ok(choices)
}

fn carrying(of: Measured<'_>, at: Hanging, force: Vector) -> Result<Carrying> {
    let size = norm(force);
    // Less than what rounding leaves of the loads is no direction.
    if size.lo() <= 0.0 {
        return Err(NoCensus::Limp { member: at.member + 1 });
    }
    let member = &of.system.members()[at.member];
    let direction = force.map(|part| {
        let upright = force.iter().filter(|other| **other != Interval::ZERO).count() == 1;
        match part {
            Interval::ZERO => part,
            _ if upright => part.unit_sign(),
            _ => part / size,
        }
    });
    let signs: &[Interval] = match member.kind {
        Kind::Bar => &[Interval::ONE, Interval::ONE.negated()],
        Kind::Cable => &[Interval::ONE],
        Kind::Strut => &[Interval::ONE.negated()],
    };
    let mut ways = vec![];
    for sign in signs {
        let axial = product(*sign, size);
        // Density times distance: l + (l/EA) N.
        let distance = sum(of.length(at.member), product(of.frame.compliance(member), axial));
        match distance.sign() {
            Some(1) => ways.push(Way { axial, reach: product(*sign, distance) }),
            // Pushed together to less than nothing: no position.
            Some(-1) => {}
            _ => return Err(NoCensus::Limp { member: at.member + 1 }),
        }
    }
    Ok(Carrying { at, direction, ways })
}

/// A position with one more member; nothing where its parent has no place.
fn extended(choice: &Choice, member: &Carrying, way: &Way) -> Option<Choice> {
    let parent = choice.place(member.at.parent)?;
    let compressed = usize::from(way.axial.hi() < 0.0);
    let place = plus(parent, times(way.reach, member.direction));
    Some(choice.and(&Choice {
        places: vec![(member.at.child, place)],
        axial: vec![(member.at.member, way.axial)],
        index: [compressed; 2],
        circle: false,
    }))
}
