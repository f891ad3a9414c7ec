//! Loads of joints that are weights alone, to twice the usual precision.

use crate::net::Result;
use model::system::{Member, PointLoad, System};
use model::{NoCensus, Vector};
use numerics::{DoubleDouble, lever};

/// What hangs at each joint in kg, the sum of all loads of joints and members shared by the lever rule, but for the weight of the
/// members that bear their own; nothing where nothing hangs, exactly.
pub(super) fn weights_kg(
    system: &System,
    joints: &[usize],
    own: &[usize],
) -> Result<Vec<Option<DoubleDouble>>> {
    let mut weights = Weights { system, kg: vec![None; system.joints().len()] };
    for joint in joints {
        let own = &system.joints()[*joint];
        if own.mass_kg > 0.0 {
            weights.add(*joint, DoubleDouble::point(own.mass_kg));
        }
        weights.add_force(*joint, own.force_n, DoubleDouble::point(1.0))?;
    }
    let (mut wanted, mut bears) =
        (vec![false; system.joints().len()], vec![false; system.members().len()]);
    for joint in joints {
        wanted[*joint] = true;
    }
    for member in own {
        bears[*member] = true;
    }
    for (member, bears) in system.members().iter().zip(bears) {
        let length_m = member.body.length_m();
        for (joint, is_start) in [(member.from, true), (member.to, false)] {
            if !wanted[joint] {
                continue;
            }
            if let Some(weight_kg) = shared_kg(member, is_start).filter(|_| !bears) {
                weights.add(joint, weight_kg);
            }
            for PointLoad { at_m, force_n, .. } in &member.loads {
                if let Some(share) = share(length_m, *at_m, is_start) {
                    weights.add_force(joint, *force_n, share)?;
                }
            }
        }
    }
    // A force up, as of a float, makes a joint lighter.
    let is_down = |kg: &Option<DoubleDouble>| kg.is_none_or(|kg| kg.interval().lo() > 0.0);
    match weights.kg.iter().position(|kg| !is_down(kg)) {
        Some(joint) => Err(NoCensus::LoadsNotDown { joint: joint + 1 }),
        None => Ok(weights.kg),
    }
}

/// What an end of a member takes of its weight, kg.
pub(super) fn shared_kg(member: &Member, is_start: bool) -> Option<DoubleDouble> {
    let body = member.body;
    let share = share(body.length_m(), body.centre_m(), is_start)?;
    (body.mass_kg() > 0.0).then(|| DoubleDouble::point(body.mass_kg()) * share)
}

/// The part of a load at a point of a member that one end takes; nothing if the point is the other
/// end.
fn share(length_m: f64, at_m: f64, is_start: bool) -> Option<DoubleDouble> {
    let [length, at] = [length_m, at_m].map(DoubleDouble::point);
    if is_start {
        (at_m < length_m).then(|| lever(length, at)[0])
    } else {
        (at_m > 0.0).then(|| lever(length, at)[1])
    }
}

struct Weights<'a> {
    system: &'a System,
    kg: Vec<Option<DoubleDouble>>,
}

impl Weights<'_> {
    fn add(&mut self, joint: usize, weight_kg: DoubleDouble) {
        self.kg[joint] = Some(self.kg[joint].map_or(weight_kg, |before| before + weight_kg));
    }

    fn add_force(&mut self, joint: usize, [x, y, z]: Vector, share: DoubleDouble) -> Result<()> {
        if x.abs() > 0.0 || y.abs() > 0.0 {
            return Err(NoCensus::LoadsNotDown { joint: joint + 1 });
        }
        if z.abs() > 0.0 {
            let g = DoubleDouble::point(self.system.gravity_m_s2());
            self.add(joint, DoubleDouble::point(-z) / g * share);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;
