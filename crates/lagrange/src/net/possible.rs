//! What can be said before, or instead of, an answer.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use matrices::dense::eigen_of_three;
use model::system::{Kind, RunTogether, System};
use nalgebra::{Matrix3, Vector3};

use super::directions::Directions;
use super::framework::Framework;
use super::state::State;
use crate::error::Error;
use crate::thresholds::{GIVEN, ZERO};

/// Refuse members between anchors that do not fit, and systems that no support holds.
pub(super) fn check(system: &System, framework: &Framework) -> Result<(), Error> {
    check_held(framework)?;
    let component = components(framework, |_| true);
    let held = supports(framework, &component);
    let count = held.len();
    let mut loads = vec![Vector3::<f64>::zeros(); count];
    let mut sizes = vec![0.0_f64; count];
    for (node, &part) in framework.nodes.iter().zip(&component) {
        loads[part] += node.load;
        sizes[part] += node.load.norm();
    }
    for part in 0..count {
        let free = loads[part] - onto_range(&held[part], &loads[part]);
        // The sum of the squared cosines to the supports' normals.
        let unsupported = held[part].trace() < ZERO * ZERO;
        if unsupported || free.norm() > GIVEN * sizes[part] {
            let joints = component.iter().filter(|other| **other == part).count();
            let first = component.iter().position(|other| *other == part).unwrap_or(0);
            let joint = system.joints()[first].name.to_string();
            let load_n = free.norm() * framework.units.force_n;
            return Err(Error::Falls { joint, joints: joints - 1, load_n });
        }
    }
    Ok(())
}

/// Refuse a system of which no load moves anything.
pub(super) fn check_loaded(framework: &Framework) -> Result<(), Error> {
    let elastic = framework.links.iter().any(|link| link.compliance > 0.0);
    let held = framework.freedoms() == 0;
    if is_loaded(framework) || elastic || held { Ok(()) } else { Err(Error::Unloaded) }
}

/// Whether a load acts along a free direction of its joint.
pub(super) fn is_loaded(framework: &Framework) -> bool {
    framework.nodes.iter().any(|node| node.free.components(&node.load).norm() > 0.0)
}

/// Refuse inextensible members between anchors that do not fit there.
fn check_held(framework: &Framework) -> Result<(), Error> {
    for (member, link) in framework.links[..framework.members()].iter().enumerate() {
        if framework.moves(link) || link.compliance > 0.0 {
            continue;
        }
        let distance = framework.held_length(member);
        let excess = distance - link.length;
        let misfit = match link.kind {
            Kind::Bar => excess.abs(),
            Kind::Cable => excess,
            Kind::Strut => -excess,
        };
        if misfit > link.within {
            let unit = framework.units.length_m;
            let (length_m, distance_m) = (link.length * unit, distance * unit);
            return Err(Error::HeldMisfit { member: member + 1, length_m, distance_m });
        }
    }
    Ok(())
}

/// The part of a vector in the range of a positive semidefinite matrix.
fn onto_range(matrix: &Matrix3<f64>, vector: &Vector3<f64>) -> Vector3<f64> {
    let (values, axes) = eigen_of_three(matrix).unwrap_or_default();
    let mut parts = axes.tr_mul(vector);
    (0..3).filter(|&k| values[k] <= ZERO).for_each(|k| parts[k] = 0.0);
    axes * parts
}

/// Sum of the projections onto what the supports of each component hold.
fn supports(framework: &Framework, component: &[usize]) -> Vec<Matrix3<f64>> {
    let count = component.iter().max().map_or(0, |last| last + 1);
    let mut held = vec![Matrix3::zeros(); count];
    for (node, &part) in framework.nodes.iter().zip(component) {
        match &node.free {
            Directions::All => {}
            Directions::Held => held[part] += Matrix3::identity(),
            Directions::Few(few) => held[part] += Matrix3::identity() - few.0 * few.0.transpose(),
        }
    }
    held
}

/// Independent translations, of all components that members of a kind join, that the supports
/// allow.
pub(super) fn translations(framework: &Framework, joins: impl Fn(usize) -> bool) -> usize {
    let supports = supports(framework, &components(framework, joins));
    let free = |held: &Matrix3<f64>| {
        // Most components have an anchor, which alone holds everything.
        let anchored = held.diagonal().min() >= 1.0;
        let values =
            if anchored { held.diagonal() } else { eigen_of_three(held).unwrap_or_default().0 };
        values.iter().filter(|value| **value <= ZERO).count()
    };
    supports.iter().map(free).sum()
}

/// Number of the component of each joint, by the members for which `joins` holds.
fn components(framework: &Framework, joins: impl Fn(usize) -> bool) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..framework.nodes.len()).collect();
    for (member, link) in framework.links.iter().enumerate() {
        if !joins(member) {
            continue;
        }
        let (a, b) = (root(&mut parent, link.from), root(&mut parent, link.to));
        parent[a.max(b)] = a.min(b);
    }
    // In place: no parent has a larger number than its joint, and has its component's already.
    let mut next = 0;
    for joint in 0..parent.len() {
        let above = parent[joint];
        parent[joint] = if above == joint { next } else { parent[above] };
        next += usize::from(above == joint);
    }
    parent
}

fn root(parent: &mut [usize], mut joint: usize) -> usize {
    while parent[joint] != joint {
        parent[joint] = parent[parent[joint]];
        joint = parent[joint];
    }
    joint
}

/// A span shorter than this part of its rope, where nothing converges, has run to its end.
const JAMMED: f64 = 1e-2;

/// Whether two joints of a rope have run together: the span between them has no direction, and the energy
/// a corner that no equation of the others describes.
pub(super) fn jammed(system: &System, framework: &Framework, state: &State) -> Option<Error> {
    let directions = state.directions(framework);
    let spans = framework.ropes.iter().flat_map(|rope| rope.spans.iter().copied());
    let part = |span: usize| directions[span].1 / framework.links[span].length;
    let short =
        spans.filter(|span| framework.ends_move(&framework.links[*span]) && part(*span) <= JAMMED);
    let span = short.min_by(|a, b| part(*a).total_cmp(&part(*b)))?;
    let link = &framework.links[span];
    let [from, to] = [link.from, link.to].map(|joint| system.joints()[joint].name.to_string());
    Some(RunTogether { member: framework.member_of(span) + 1, from, to }.into())
}

/// Two anchors that are further apart than inextensible bars and cables between them reach, if
/// there are such.
pub(super) fn too_short(system: &System, framework: &Framework) -> Option<Error> {
    let mut neighbours = vec![Vec::new(); framework.nodes.len()];
    for link in &framework.links {
        if link.kind != Kind::Strut {
            let reach = if link.compliance > 0.0 { f64::INFINITY } else { link.length };
            neighbours[link.from].push((link.to, reach));
            neighbours[link.to].push((link.from, reach));
        }
    }
    let anchors: Vec<usize> =
        (0..framework.nodes.len()).filter(|&joint| framework.nodes[joint].freedom() == 0).collect();
    anchors.iter().find_map(|&from| {
        let reach = shortest(&neighbours, from);
        let place = |joint: usize| framework.nodes[joint].base;
        let worst = anchors
            .iter()
            .map(|&to| ((place(to) - place(from)).norm() - reach[to], to))
            .max_by(|a, b| a.0.total_cmp(&b.0))?;
        let unit = framework.units.length_m;
        (worst.0 > 0.0).then(|| Error::TooShort {
            from: system.joints()[from].name.to_string(),
            to: system.joints()[worst.1].name.to_string(),
            distance_m: (place(worst.1) - place(from)).norm() * unit,
            reach_m: reach[worst.1] * unit,
        })
    })
}

/// Length of the shortest path to each joint (Dijkstra).
fn shortest(neighbours: &[Vec<(usize, f64)>], from: usize) -> Vec<f64> {
    let mut reach = vec![f64::INFINITY; neighbours.len()];
    reach[from] = 0.0;
    // Of numbers that are not negative the bits are in order.
    let mut queue = BinaryHeap::from([Reverse((0, from))]);
    while let Some(Reverse((bits, joint))) = queue.pop() {
        let length = f64::from_bits(bits);
        if length > reach[joint] {
            continue;
        }
        for &(next, step) in &neighbours[joint] {
            if length + step < reach[next] {
                reach[next] = length + step;
                queue.push(Reverse((reach[next].to_bits(), next)));
            }
        }
    }
    reach
}
