//! The start for long runs: the same system with few members in a run.
//!
//! A run becomes [`PARTS`] members of about as many of its own each, as long as these together. The
//! loads between act at their ends by the lever rule, measured along the run. The hanging shape of
//! that has the pulls of the runs to a percent, at the cost of a system of the branchings alone.

use nalgebra::Vector3;

use super::framework::{Framework, Link, Node};
use super::hanging::Hanging;
use super::runs::{Element, Runs};
use super::stiffness::Stiffness;
use model::system::Kind;

/// Members of a run in the coarse system. With eight the pulls of the bridle of the speed
/// measurements are right to 1 %, and Newton's method takes four steps from there.
const PARTS: usize = 8;
/// The gap at which its shape is taken.
const END: f64 = 1e-5;

/// Places of the joints that stay, and pulls of the elements.
pub(super) struct Start {
    pub places: Vec<Vector3<f64>>,
    pub pulls: Vec<Vector3<f64>>,
    pub factorisations: usize,
}

/// Number of members of the coarse system.
pub(super) fn members(runs: &Runs) -> usize {
    runs.elements.iter().map(|element| element.steps.len().min(PARTS)).sum()
}

/// The start; nothing when the coarse system does not settle.
pub(super) fn start(framework: &Framework, runs: &Runs) -> Option<Start> {
    let mut coarse = framework.of_parts(runs.nodes.clone(), Vec::new());
    // The pull of an element is the force of its first coarse member and what the lever rule gave
    // to its first joint.
    let firsts: Vec<(usize, Vector3<f64>)> =
        runs.elements.iter().map(|element| refine(&mut coarse, framework, runs, element)).collect();
    let mut stiffness = Stiffness::new(&coarse, false).ok()?;
    let mut hanging = Hanging::new(&coarse).ok()?;
    if !hanging.advance(&coarse, &mut stiffness, END) {
        return None;
    }
    let forces = hanging.forces();
    let pulls = firsts.iter().map(|(link, shift)| forces[*link] + shift).collect();
    let places = hanging.places[..runs.kept.len()].to_vec();
    Some(Start { places, pulls, factorisations: hanging.steps })
}

/// Add the coarse members of an element: the number of the first, and the pull less its force.
fn refine(
    coarse: &mut Framework,
    framework: &Framework,
    runs: &Runs,
    element: &Element,
) -> (usize, Vector3<f64>) {
    let steps = &runs.steps[element.steps.clone()];
    let parts = steps.len().min(PARTS);
    let (first, mut shift) = (coarse.links.len(), Vector3::zeros());
    // In `nodes` all loads of the run act at its end.
    coarse.nodes[element.to].load += steps[steps.len() - 1].offset;
    let mut from = element.from;
    for part in 0..parts {
        let (begin, end) = (part * steps.len() / parts, (part + 1) * steps.len() / parts);
        let group = &steps[begin..end];
        let length: f64 = group.iter().map(|step| step.length).sum();
        let (mut near, mut far, mut at) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        for pair in steps[begin..end].windows(2) {
            at += pair[0].length;
            let load = pair[0].offset - pair[1].offset;
            near += load * (1.0 - at / length);
            far += load * (at / length);
        }
        let to = if part + 1 == parts {
            element.to
        } else {
            // The load of the joint between two parts is whole.
            let load = steps[end - 1].offset - steps[end].offset;
            coarse
                .nodes
                .push(Node { load, ..framework.nodes[group[group.len() - 1].joint].clone() });
            coarse.nodes.len() - 1
        };
        coarse.nodes[from].load += near;
        coarse.nodes[to].load += far;
        if part == 0 {
            shift = near;
        }
        let cable = group.iter().any(|step| framework.links[step.member].kind == Kind::Cable);
        coarse.links.push(Link {
            from,
            to,
            length,
            within: 0.0,
            compliance: group.iter().map(|step| step.compliance).sum(),
            kind: if cable { Kind::Cable } else { Kind::Bar },
            rope: None,
        });
        from = to;
    }
    (first, shift)
}
