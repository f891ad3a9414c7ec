//! Which members act in an answer.

use model::NoBox;
use model::system::{Kind, Member, System};

use super::frame::Frame;

/// What a member does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Activity {
    /// It has a force: an unknown.
    Acts,
    /// A cable shorter than its length, or a strut longer: no force.
    Slack,
    /// Both ends are held: what it bears moves nothing.
    Idle,
}

/// Below this part of the largest force, and nearer than this part to its length, a cable or strut
/// is neither taut nor slack as far as an answer in double precision can tell.
const DEGENERATE: f64 = 1e-9;

/// What each member does in an answer.
pub(super) fn activities(
    system: &System,
    frame: &Frame,
    joints_m: &[model::Vector],
    axial_n: &[f64],
) -> Result<Vec<Activity>, NoBox> {
    let of_member = |(k, member): (usize, &Member)| {
        let held = |joint: usize| system.joints()[joint].support.is_fixed();
        if member.path().all(held) {
            return Ok(Activity::Idle);
        }
        if member.kind == Kind::Bar {
            return Ok(Activity::Acts);
        }
        let span_m = |[a, b]: [usize; 2]| {
            let [x, y, z] = std::array::from_fn(|i| joints_m[b][i] - joints_m[a][i]);
            x.hypot(y).hypot(z)
        };
        let length_m = member.body.length_m();
        let stretch = member.spans().map(span_m).sum::<f64>() / length_m - 1.0;
        // How far the member is on the side on which it is slack, and how much it bears.
        let (spare, borne) = match member.kind {
            Kind::Bar | Kind::Cable => (-stretch, axial_n[k]),
            Kind::Strut => (stretch, -axial_n[k]),
        };
        let borne = borne / frame.force_n;
        if borne < -DEGENERATE {
            return Err(NoBox::WrongSign { member: k + 1 });
        }
        if spare.max(borne) < DEGENERATE {
            return Err(NoBox::Degenerate { member: k + 1 });
        }
        if borne <= spare {
            return Ok(Activity::Slack);
        }
        let no_span = |ends: [usize; 2]| span_m(ends) < DEGENERATE * length_m;
        if member.rope.is_some() && member.spans().any(no_span) {
            return Err(NoBox::Rope { member: k + 1 });
        }
        Ok(Activity::Acts)
    };
    system.members().iter().enumerate().map(of_member).collect()
}

#[cfg(test)]
mod tests;
