//! Minima at a corner of the energy, where a span of a rope has no length.
//!
//! The energy of a rope with the tension `T` has the corner `T |d|` there. Moved apart by `v` the two joints
//! gain `T |v|` and lose the work `g . v` of all that else acts on one of them: the corner is a minimum across
//! if `|g| <= T`. Along, with both joints as one, it is an energy like any other, and that is minimised.

use std::collections::BTreeMap;

use model::system::{Joined, Support, System};
use model::{Jam, Vector};

use crate::network::error::Error;
use crate::network::frame::loads_n;
use crate::network::solution::Solution;
use crate::vector::{along, norm, scaled, unit};

/// Rounding of a force at a joint over the largest that acts there.
const ROUNDING: f64 = 1e-9;

/// The minimum of a system; where a span ends in a corner, of the one with its two joints as one, and so on.
pub(super) fn at_corners(
    system: &System,
    minimum: Result<Solution, Error>,
    minimise: impl Fn(&Joined) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let Err(Error::Jammed { member, span }) = &minimum else { return minimum };
    let (mut corner, mut joined, mut pairs) = ([*member, *span], None::<Joined>, vec![]);
    loop {
        let here = joined.as_ref().map_or(system, |joined| &joined.system);
        let [member, span] = corner.map(|number| number - 1);
        let Some([a, b]) = here.members()[member].spans().nth(span) else { return minimum };
        let whole = |joint: usize| joined.as_ref().map_or(joint, |joined| joined.kept[joint]);
        pairs.push([whole(a), whole(b)]);
        let Some(next) = system.joined(&pairs) else { return minimum };
        match minimise(&next) {
            Ok(solution) => return whole_again(system, &next, solution).map_or(minimum, Ok),
            Err(Error::Jammed { member, span }) => corner = [member, span],
            Err(_) => return minimum,
        }
        joined = Some(next);
    }
}

/// The minimum with its joints apart, if the energy rises across every corner.
fn whole_again(system: &System, joined: &Joined, mut solution: Solution) -> Option<Solution> {
    let answer = &mut solution.equilibrium;
    let joints = 0..system.joints().len();
    let number = |joint: usize| joined.numbers[joint];
    let held = |joint: usize| joined.kept[number(joint)] == joint;
    let reactions = joints
        .clone()
        .map(|joint| if held(joint) { answer.reactions_n[number(joint)] } else { [0.0; 3] });
    answer.reactions_n = reactions.collect();
    answer.joints_m = joints.map(|joint| answer.joints_m[number(joint)]).collect();
    let jams = corners(system, joined, &answer.joints_m, &answer.axial_n)?;
    for jam in &jams {
        let last = system.members()[jam.member].spans().count() - 1;
        if jam.span == 0 {
            answer.start_forces_n[jam.member] = scaled(-1.0, jam.pull_n);
        }
        if jam.span == last {
            answer.end_forces_n[jam.member] = jam.pull_n;
        }
    }
    answer.evidence.jams = jams;
    Some(solution)
}

/// A joint in a corner: what acts on it besides the spans without length, and the largest part of that.
#[derive(Clone, Copy)]
struct Acting {
    force: Vector,
    largest: f64,
}

/// The spans without length with their pulls; nothing where the energy falls across one.
fn corners(
    system: &System,
    joined: &Joined,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> Option<Vec<Jam>> {
    let mut acting = acting(system, joined, joints_m, axial_n);
    let mut found: Vec<(Jam, [usize; 2])> = joined
        .spans(system)
        .map(|(member, span, ends)| (Jam { member, span, pull_n: [0.0; 3] }, ends))
        .collect();
    // Tension between each two joints in one place.
    let mut ties = BTreeMap::<[usize; 2], f64>::new();
    for (jam, [a, b]) in &found {
        *ties.entry([*a.min(b), *a.max(b)]).or_default() += axial_n[jam.member];
    }
    let free = |joint: usize| system.joints()[joint].support == Support::Free;
    while let Some(any) = ties.keys().next().copied() {
        let only = |joint: usize| ties.keys().filter(|tie| tie.contains(&joint)).count() == 1;
        let tip = ties.keys().flatten().copied().find(|joint| free(*joint) && only(*joint));
        // A closed ring of them holds without one of its spans.
        let tie = tip.and_then(|tip| ties.keys().find(|tie| tie.contains(&tip)).copied());
        let tension = ties.remove(&tie.unwrap_or(any))?;
        let (Some(tip), Some([a, b])) = (tip, tie) else { continue };
        let Acting { force, largest } = acting[tip];
        if norm(force) > tension + ROUNDING * largest {
            return None;
        }
        for (jam, [first, second]) in &mut found {
            let part = if tension > 0.0 { axial_n[jam.member] / tension } else { 0.0 };
            if [*first, *second] == [a, b] || [*first, *second] == [b, a] {
                jam.pull_n = scaled(if *first == tip { -part } else { part }, force);
            }
        }
        let root = if tip == a { b } else { a };
        let Acting { force: there, largest: most } = acting[root];
        acting[root] = Acting { force: along(there, 1.0, force), largest: most.max(largest) };
    }
    Some(found.into_iter().map(|(jam, _)| jam).collect())
}

/// What loads and members of some length do at each joint.
fn acting(system: &System, joined: &Joined, joints_m: &[Vector], axial_n: &[f64]) -> Vec<Acting> {
    let mut all: Vec<Acting> =
        loads_n(system).into_iter().map(|force| Acting { force, largest: norm(force) }).collect();
    for (member, force) in system.members().iter().zip(axial_n) {
        for [a, b] in member.spans().filter(|[a, b]| joined.numbers[*a] != joined.numbers[*b]) {
            let Some(direction) = unit(along(joints_m[b], -1.0, joints_m[a])) else { continue };
            for (joint, sign) in [(a, 1.0), (b, -1.0)] {
                let Acting { force: there, largest } = &mut all[joint];
                *there = along(*there, sign * force, direction);
                *largest = largest.max(force.abs());
            }
        }
    }
    all
}
