//! Ropes that jam: joints that have run together are solved as one.
//!
//! Where a span of a rope has no length its direction is any vector $s$ with $|s| \\le 1$: a subgradient of
//! $|d|$. The two joints are one in the balances then, and what each of them alone is out of balance by the
//! span bears as $T s$. It is an equilibrium if that is no more than the tension.

use model::system::{Joined, Support, System};
use model::{Jam, Vector};
use nalgebra::Vector3;

use super::error::Error;
use super::framework::Framework;
use super::solution::Solution;
use super::state::State;

/// What a span bears may exceed its tension by this part of the forces at its joint: rounding.
const ROUNDING: f64 = 1e-9;

/// What was found; where a rope jams, with the joints that run together as one, as long as more do.
pub(super) fn joined(
    system: &System,
    found: Result<Solution, Error>,
    solve: impl Fn(&Joined) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let Err(Error::Jammed { from, to, .. }) = &found else { return found };
    let mut names = [from.clone(), to.clone()];
    let mut pairs = Vec::new();
    loop {
        let [Some(a), Some(b)] = names.each_ref().map(|name| system.joint(name)) else {
            return found;
        };
        pairs.push([a, b]);
        let Some(joined) = system.joined(&pairs) else { return found };
        match solve(&joined) {
            Ok(solution) => return apart(system, &joined, solution).map_or(found, Ok),
            Err(Error::Jammed { from, to, .. }) => names = [from, to],
            Err(_) => return found,
        }
    }
}

/// The answer with all joints of the whole system; nothing where a span would bear more than its tension.
fn apart(system: &System, joined: &Joined, mut solution: Solution) -> Option<Solution> {
    let answer = &mut solution.equilibrium;
    answer.joints_m = joined.numbers.iter().map(|number| answer.joints_m[*number]).collect();
    let reaction = |(joint, number): (usize, &usize)| {
        if joined.kept[*number] == joint { answer.reactions_n[*number] } else { [0.0; 3] }
    };
    answer.reactions_n = joined.numbers.iter().enumerate().map(reaction).collect();
    answer.evidence.jams = jams(system, joined, &answer.joints_m, &answer.axial_n)?;
    for Jam { member, span, pull_n } in &answer.evidence.jams {
        if *span == 0 {
            answer.start_forces_n[*member] = pull_n.map(|n| -n);
        }
        if *span == system.members()[*member].via().len() {
            answer.end_forces_n[*member] = *pull_n;
        }
    }
    Some(solution)
}

/// The spans without length and what they bear, from one joint to the next: each that is not held and has one
/// neighbour left hands on to it what it is out of balance by.
fn jams(
    system: &System,
    joined: &Joined,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> Option<Vec<Jam>> {
    let mut left = unbalance(system, joints_m, axial_n);
    let spans: Vec<_> = joined.spans(system).collect();
    let mut pulls = vec![Vector3::zeros(); spans.len()];
    let mut open: Vec<[usize; 2]> =
        spans.iter().map(|(.., [a, b])| [*a.min(b), *a.max(b)]).collect();
    open.sort_unstable();
    open.dedup();
    while let Some(last) = open.last().copied() {
        let is_last = |joint: usize| {
            system.joints()[joint].support == Support::Free
                && open.iter().filter(|pair| pair.contains(&joint)).count() == 1
        };
        let ends = open.iter().flat_map(|[a, b]| [[*a, *b], [*b, *a]]);
        let Some([end, next]) = ends.into_iter().find(|[end, _]| is_last(*end)) else {
            // In a ring of such spans one more than needed bears nothing.
            open.retain(|pair| *pair != last);
            continue;
        };
        let between = |k: &usize| [[end, next], [next, end]].contains(&spans[*k].2);
        let between: Vec<usize> = (0..spans.len()).filter(between).collect();
        let most: f64 = between.iter().map(|k| axial_n[spans[*k].0]).sum();
        let (force, size) = left[end];
        if force.norm() > most + ROUNDING * size {
            return None;
        }
        for k in between.into_iter().filter(|_| most > 0.0) {
            let (member, _, [first, _]) = spans[k];
            let sign = if first == end { -1.0 } else { 1.0 };
            pulls[k] = force * (sign * axial_n[member] / most);
        }
        left[next] = (left[next].0 + force, left[next].1.max(size));
        open.retain(|pair| !(pair.contains(&end) && pair.contains(&next)));
    }
    let jam = |((member, span, _), pull): (&(usize, usize, _), &Vector3<f64>)| Jam {
        member: *member,
        span: *span,
        pull_n: (*pull).into(),
    };
    Some(spans.iter().zip(&pulls).map(jam).collect())
}

/// What loads and spans that have a length leave at each joint, N, and the largest of these forces.
fn unbalance(system: &System, joints_m: &[Vector], axial_n: &[f64]) -> Vec<(Vector3<f64>, f64)> {
    let framework = Framework::new(system);
    let units = framework.units;
    let place = |at_m: &Vector| (Vector3::from(*at_m) - units.origin_m) / units.length_m;
    let axial = framework.by_link(axial_n.to_vec());
    let taut = vec![true; axial.len()];
    let state = State::new(joints_m.iter().map(place).collect(), axial, taut);
    let pulls =
        state.directions(&framework).into_iter().zip(&state.axial).map(|((u, _), n)| u * *n);
    let mut all: Vec<_> = framework.nodes.iter().map(|node| node.load * units.force_n).collect();
    let mut most: Vec<f64> = all.iter().map(Vector3::norm).collect();
    for (link, pull) in framework.links.iter().zip(pulls) {
        for (joint, pull) in [(link.from, pull), (link.to, -pull)] {
            all[joint] += pull;
            most[joint] = most[joint].max(pull.norm());
        }
    }
    all.into_iter().zip(most).collect()
}
