//! Inextensible cables and struts, and the floor: what they are about an equilibrium. In motion
//! they are [`contacts`](crate::contacts).
//!
//! A cable that pulls stays taut in small motions, for its force changes by little: it is a bar.
//! One that is shorter than its length stays slack: it has its inertia alone. Struts are alike, and
//! a joint that the floor pushes slides in its level.

use model::system::{Joint, Kind, System};

use crate::contacts::{hold, let_go};
use crate::error::{MotionError, Result};
use crate::mechanism::Mechanism;
use crate::modes::LeftOver;
use model::Vector;
use numerics::vector::{minus, norm, worse};

/// How far the ends of a taut member may be from its length, relative: what lengths may be off in
/// an equilibrium.
pub(crate) const LENGTHS: f64 = 1e-8;

/// Least force of a taut member, in units of the largest force: what may be left over in an
/// equilibrium, and is no force.
pub(crate) const BALANCE: f64 = 1e-7;

/// `cable` or `strut`, of a member that is one and does not stretch.
pub(crate) fn inextensible(system: &System, number: usize) -> Option<&'static str> {
    let member = &system.members()[number];
    (member.stiffness_n.is_none() && member.kind != Kind::Bar).then(|| member.kind.name())
}

/// Refuse inextensible cables and struts.
pub(crate) fn refuse_inextensible(system: &System) -> Result<()> {
    let first = (0..system.members().len()).find_map(|k| Some((k + 1, inextensible(system, k)?)));
    first.map_or(Ok(()), |(member, kind)| Err(MotionError::Unilateral { member, kind }))
}

/// The system with bars in place of those inextensible cables and struts that are not slack at a
/// position, world frame, m, and without a floor: joints that lie on it slide in its level. Ropes
/// that are not slack stay.
/// [`MotionError::Input`] where there are not as many places as joints, or one is below the floor.
pub(crate) fn with_what_holds(system: &System, joints_m: &[Vector]) -> Result<System> {
    let refused = |reason| MotionError::Input { what: "places of the joints", reason };
    if joints_m.len() != system.joints().len() {
        let (given, joints) = (joints_m.len(), system.joints().len());
        return Err(refused(format!("{given} given for {joints} joints")));
    }
    let mut members = system.members().to_vec();
    for (number, member) in members.iter_mut().enumerate() {
        let distance_m = distance(system, number, joints_m);
        if inextensible(system, number).is_none() {
            continue;
        }
        let stretch = distance_m / member.body.length_m() - 1.0;
        let spare = if member.kind == Kind::Cable { -stretch } else { stretch };
        if spare <= LENGTHS || spare.is_nan() {
            hold(member);
        } else {
            let_go(member);
        }
    }
    let below = |(joint, [.., z]): (&Joint, &Vector)| {
        let below_m = system.floor_m()? - z;
        (!joint.support.is_fixed() && below_m > near_m(system))
            .then(|| (joint.name.clone(), below_m))
    };
    if let Some((name, below_m)) = system.joints().iter().zip(joints_m).find_map(below) {
        return Err(refused(format!("joint {name:?} is {below_m} m below the floor")));
    }
    let lies = |k: usize, joint: &Joint| lies(system, joint, joints_m[k][2]);
    let held = system.laid(joints_m, lies, members);
    held.map_err(|error| refused(error.to_string()))
}

const UP: Vector = [0.0, 0.0, 1.0];

/// How far a joint may be from the floor and count as lying on it, m.
fn near_m(system: &System) -> f64 {
    LENGTHS * system.total_length_m() / system.members().len() as f64
}

/// Whether a joint that may rise from the floor is on it.
fn lies(system: &System, joint: &Joint, height_m: f64) -> bool {
    let on = |floor_m| height_m <= floor_m + near_m(system);
    joint.support.on_level(UP).is_some() && system.floor_m().is_some_and(on)
}

/// Refuse joints on the floor that it does not push. Where the floor is one of too many supports
/// its push is what the given forces leave over.
/// [`MotionError::NotPushed`].
pub(crate) fn check_pushes(
    system: &System,
    mechanism: &Mechanism,
    joints_m: &[Vector],
    left: &LeftOver,
) -> Result<()> {
    for (k, joint) in system.joints().iter().enumerate() {
        let left_n = left.forces[mechanism.slot_of[k]];
        let push_n = joint.support.upright_part(left_n).map_or(0.0, |part_n| -part_n);
        let is_pushed = push_n > BALANCE * left.unit_n;
        if lies(system, joint, joints_m[k][2]) && !is_pushed {
            return Err(MotionError::NotPushed { joint: joint.name.to_string(), push_n });
        }
    }
    Ok(())
}

fn distance(system: &System, number: usize, joints_m: &[Vector]) -> f64 {
    let member = &system.members()[number];
    member.spans().map(|[a, b]| norm(minus(joints_m[b], joints_m[a]))).sum()
}

/// Refuse cables taken as bars that do not pull, and struts that do not push.
///
/// `system` is the one as given, `densities` are those of the rigid bars of the mechanism, N/m.
/// [`MotionError::NeitherTautNorSlack`].
pub(crate) fn check_forces(
    system: &System,
    mechanism: &Mechanism,
    joints_m: &[Vector],
    densities: &[f64],
) -> Result<()> {
    let axial = || mechanism.bars.iter().zip(densities).map(|(bar, rho)| rho * bar.length_m);
    let loads = mechanism.load.iter().map(|f| norm(*f));
    let unit_n = axial().map(f64::abs).chain(loads).fold(0.0, worse);
    for (link, axial_n) in mechanism.bars.iter().zip(axial()) {
        let Some(kind) = inextensible(system, link.member) else { continue };
        let borne_n = if kind == "cable" { axial_n } else { -axial_n };
        if borne_n > BALANCE * unit_n {
            continue;
        }
        return Err(MotionError::NeitherTautNorSlack {
            member: link.member + 1,
            kind,
            distance_m: distance(system, link.member, joints_m),
            length_m: link.length_m,
            axial_n,
        });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::Bar;
    use model::system::Member;

    /// A member that is off its length by less than equilibria are is taut, one that has more to spare
    /// is not: cables too short, struts too long.
    #[test]
    fn what_spares_more_than_rounding_is_slack() {
        for (kind, sign) in [(Kind::Cable, -1.0), (Kind::Strut, 1.0)] {
            for (part, holds) in [(0.5, true), (-3.0, true), (2.0, false)] {
                let member = Member::bar(0, 1, Bar::homogeneous(2.0, 1.0).unwrap()).of_kind(kind);
                let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P")];
                let system = System::new("", 9.81, joints, vec![member]).unwrap();
                let at = [[0.0; 3], [0.0, 0.0, -2.0 * (1.0 + sign * part * LENGTHS)]];
                let found = with_what_holds(&system, &at).unwrap().members()[0].kind;
                assert_eq!(found == Kind::Bar, holds, "{kind:?} {part}");
            }
        }
    }
}
