//! The spans of members: one of a member that is straight, several of a rope over rings and pulleys.

use model::Vector;
use model::system::{Member, System, SystemEquilibrium};

use numerics::vector::{minus, norm, plus, times};

/// How long a member is with its joints there: the sum of its spans, m.
pub(crate) fn length_m(member: &Member, joints_m: &[Vector]) -> f64 {
    member.spans().map(|[a, b]| norm(minus(joints_m[b], joints_m[a]))).sum()
}

/// The unit vector of a span; zero where its joints meet.
pub(crate) fn unit([a, b]: [usize; 2], joints_m: &[Vector]) -> Vector {
    let along = minus(joints_m[b], joints_m[a]);
    let long_m = norm(along);
    // Of NaN it is NaN.
    if long_m <= 0.0 { [0.0; 3] } else { times(1.0 / long_m, along) }
}

/// A joint and all that its neighbours lead to, as far as nothing is seen yet.
pub(super) fn connected<I: IntoIterator<Item = usize>>(
    start: usize,
    seen: &mut [bool],
    neighbours: impl Fn(usize) -> I,
) -> Vec<usize> {
    seen[start] = true;
    let (mut part, mut next) = (vec![start], 0);
    while let Some(&joint) = part.get(next) {
        next += 1;
        part.extend(
            neighbours(joint).into_iter().filter(|k| !std::mem::replace(&mut seen[*k], true)),
        );
    }
    part
}

/// The derivatives of the length of these spans by the places of their joints, each joint once. A span
/// whose joints meet adds nothing.
pub(crate) fn gradient(
    spans: impl Iterator<Item = [usize; 2]>,
    joints_m: &[Vector],
) -> Vec<(usize, Vector)> {
    let mut all: Vec<(usize, Vector)> = Vec::with_capacity(2);
    for span in spans {
        let unit = unit(span, joints_m);
        for (joint, part) in [(span[0], times(-1.0, unit)), (span[1], unit)] {
            match all.iter_mut().find(|(other, _)| *other == joint) {
                Some((_, sum)) => *sum = plus(*sum, part),
                None => all.push((joint, part)),
            }
        }
    }
    all
}

/// The pull of span `n` of member `k` on its first joint, N: of a span without length what the answer says, or
/// nothing.
pub(super) fn pull_n(k: usize, n: usize, span: [usize; 2], answer: &SystemEquilibrium) -> Vector {
    let mut jams = answer.evidence.jams.iter();
    let jam = jams.find(|jam| [jam.member, jam.span] == [k, n]);
    jam.map_or_else(|| times(answer.axial_n[k], unit(span, &answer.joints_m)), |jam| jam.pull_n)
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
        let inner = |sign: f64| times(sign, pull_n(k, n, span, answer));
        let start = if n == 0 { answer.start_forces_n[k] } else { inner(-1.0) };
        let end = if n == last { answer.end_forces_n[k] } else { inner(1.0) };
        (span, [start, end])
    })
}

/// A span of a rope that is shorter than this part of it has no direction in double precision.
const NO_SPAN: f64 = model::system::LENGTH_ROUNDING;

/// Whether a rope that bears something has a span without length, named as a jam or not.
pub(crate) fn has_corner(system: &System, answer: &SystemEquilibrium) -> bool {
    let bears = |k: usize| answer.axial_n.get(k).is_some_and(|axial_n| axial_n.abs() > 0.0);
    let mut ropes = system.members().iter().enumerate().filter(|(_, member)| member.rope.is_some());
    ropes.any(|(k, member)| {
        let near_m = NO_SPAN * member.body.length_m();
        let short = |[a, b]: [usize; 2]| {
            let ends = [a, b].map(|joint| answer.joints_m.get(joint));
            matches!(ends, [Some(a), Some(b)] if norm(minus(*b, *a)) <= near_m)
        };
        bears(k) && member.spans().any(short)
    })
}
