//! The spans of members: one of a member that is straight, several of a rope over rings and pulleys.

use model::Vector;
use model::system::{Member, SystemEquilibrium};

use numerics::vector::{minus, norm, times};

/// How long a member is with its joints there: the sum of its spans, m.
pub(super) fn length_m(member: &Member, joints_m: &[Vector]) -> f64 {
    member.spans().map(|[a, b]| norm(minus(joints_m[b], joints_m[a]))).sum()
}

/// The unit vector of a span.
pub(super) fn direction([a, b]: [usize; 2], joints_m: &[Vector]) -> Vector {
    let along = minus(joints_m[b], joints_m[a]);
    times(1.0 / norm(along), along)
}

/// The joints of each span of member `k`, and the forces on the span there, N. What is stored are those at
/// the two ends of the member; inside a rope they are its tension.
pub(super) fn span_forces<'a>(
    member: &'a Member,
    k: usize,
    answer: &'a SystemEquilibrium,
) -> impl Iterator<Item = ([usize; 2], [Vector; 2])> + 'a {
    let last = member.via().len();
    member.spans().enumerate().map(move |(n, span)| {
        let inner = |sign: f64| match answer.axial_n[k] {
            // A span without length has no direction, and needs none where the rope is slack.
            axial_n if axial_n.abs() <= 0.0 => [0.0; 3],
            axial_n => times(sign * axial_n, direction(span, &answer.joints_m)),
        };
        let start = if n == 0 { answer.start_forces_n[k] } else { inner(-1.0) };
        let end = if n == last { answer.end_forces_n[k] } else { inner(1.0) };
        (span, [start, end])
    })
}
