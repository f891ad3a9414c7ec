//! Joints that slide from one answer to another through equilibria.
//!
//! Let every span that bears something pull the same in both answers, with one force along one direction, or
//! without length. With $d(t) = (1 - t) d_1 + t d_2$ it does so everywhere between them: the direction stays, and
//! the length is linear. So is a height above the floor, a place on a support, the length of a bar that keeps its
//! direction, and the work of the loads; a slack cable is convex, and no longer than at its longer end. Then all
//! between are equilibria with the same forces: what differs is a freedom, and no error. The unloaded ring on a
//! taut rope is one, and two equal weights over a pulley.

use model::Vector;
use model::system::{Kind, Member, System, SystemEquilibrium};

use super::spans::{pull_n, unit};
use numerics::vector::{dot, minus, norm, plus, times};

/// Unit vectors that differ by less than this are one direction.
const DIRECTION: f64 = 1e-9;

/// A member that bears less than this part of all that acts bears nothing.
const NOTHING: f64 = 1e-12;

/// The joints that are further than this from their place in the other answer, m, where these differ by a freedom
/// alone; none where they differ in anything else. Of answers that are in balance with the same forces.
pub(super) fn sliding(
    system: &System,
    answers: [&SystemEquilibrium; 2],
    acts_n: f64,
    near_m: f64,
) -> Vec<usize> {
    let mut members = system.members().iter().enumerate();
    if !members.all(|(k, member)| keeps_law(member, k, answers, NOTHING * acts_n)) {
        return vec![];
    }
    let [first, second] = answers.map(|answer| &answer.joints_m);
    let far = |joint: &usize| norm(minus(first[*joint], second[*joint])) > near_m;
    (0..system.joints().len()).filter(far).collect()
}

/// Whether a member keeps its law everywhere between two answers that it keeps it in.
fn keeps_law(member: &Member, k: usize, answers: [&SystemEquilibrium; 2], nothing_n: f64) -> bool {
    let bears = |answer: &SystemEquilibrium| answer.axial_n[k].abs() > nothing_n;
    let [first, second] = answers;
    if bears(first) != bears(second) {
        return false;
    }
    member.spans().enumerate().all(|(n, span)| {
        let direction = |answer: &SystemEquilibrium| {
            let jams = answer.evidence.jams.iter().any(|jam| [jam.member, jam.span] == [k, n]);
            let along = || times(1.0 / answer.axial_n[k], pull_n(k, n, span, answer));
            if jams { along() } else { unit(span, &answer.joints_m) }
        };
        let turned = || norm(minus(direction(first), direction(second)));
        match member.kind {
            Kind::Cable | Kind::Strut if bears(first) => turned() <= DIRECTION,
            Kind::Bar => turned() <= DIRECTION,
            Kind::Cable => true,
            Kind::Strut => {
                least(
                    answers.map(|answer| minus(answer.joints_m[span[1]], answer.joints_m[span[0]])),
                ) >= member.body.length_m()
            }
        }
    })
}

/// The least length of what goes linearly from one vector to another.
fn least([from, to]: [Vector; 2]) -> f64 {
    let way = minus(to, from);
    let part = (-dot(from, way) / dot(way, way)).clamp(0.0, 1.0);
    if part.is_nan() { norm(from) } else { norm(plus(from, times(part, way))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: the foot of the perpendicular, an end, and no way.
    #[test]
    fn the_least_length_is_that_of_the_nearest_point() {
        let near = |from, to, wanted: f64| assert!((least([from, to]) - wanted).abs() < 1e-15);
        near([4.0, 0.0, 0.0], [0.0, 3.0, 0.0], 2.4);
        near([3.0, 4.0, 0.0], [3.0, 8.0, 0.0], 5.0);
        near([1.0, 2.0, 2.0], [1.0, 2.0, 2.0], 3.0);
    }
}
