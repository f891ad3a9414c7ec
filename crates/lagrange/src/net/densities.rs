//! A shape to start from: force densities.
//!
//! With $F = w\\,d$ the balance of the joints is a linear system for their places, scalar where no
//! joint slides, and $w \leftarrow w\\,|d|/l$ brings the lengths nearer to $l$ (the iteration of
//! Weiszfeld).

use nalgebra::{Matrix3, Vector3};

use super::framework::{Framework, Link};
use super::stiffness::Stiffness;
use crate::error::Error;
use model::system::Kind;

/// Iterations. Each costs a scalar factorisation, an eighth of a step of what follows; nets that
/// hang from few points take fewer of those after 20 than after 5 (22 in the place of 28 for 19,800
/// bars from four corners).
const DENSITY_STEPS: usize = 20;
/// The least density of a member at the start, in units of the mean one, and the least span that it is divided by,
/// in units of its rope's length.
const LEAST: f64 = 1e-3;

/// Whether a member takes part: one that cannot pull does not.
pub(super) fn pulls(framework: &Framework, link: &Link) -> bool {
    link.kind != Kind::Strut && framework.moves(link)
}

/// Places in balance and force densities, first `1 / l` times the mean load, improved some times.
pub(super) fn by_densities(framework: &Framework) -> Result<(Vec<Vector3<f64>>, Vec<f64>), Error> {
    let sliding = framework.nodes.iter().any(|node| matches!(node.freedom(), 1 | 2));
    let mut stiffness = Stiffness::new(framework, !sliding)?;
    let mut densities: Vec<f64> = framework
        .links
        .iter()
        .map(|link| if pulls(framework, link) { link.length.recip() } else { 0.0 })
        .collect();
    let mut places = Vec::new();
    for step in 0..=DENSITY_STEPS {
        places = by_density(framework, &mut stiffness, &densities, sliding);
        if step < DENSITY_STEPS {
            densities = nearer(framework, &places, &densities);
        }
    }
    // A member whose joints are at one place has lost its density.
    let least = LEAST * densities.iter().sum::<f64>() / densities.len().max(1) as f64;
    Ok((places, densities.into_iter().map(|density| density.max(least)).collect()))
}

/// Densities that bring the lengths nearer. The spans of a rope have one force: its mean over them.
fn nearer(framework: &Framework, places: &[Vector3<f64>], densities: &[f64]) -> Vec<f64> {
    let span = |k: usize| framework.links[k].span(places).norm();
    let nearer = |(k, link): (usize, &Link)| {
        if link.rope.is_none() {
            let stretched = link.length + link.compliance * densities[k] * span(k);
            return densities[k] * (span(k) / stretched);
        }
        let (length, least) = (framework.whole(k, span), LEAST * link.length);
        let force = framework.whole(k, |k| densities[k] * span(k) * span(k)) / length.max(least);
        let density = force / span(k).max(least);
        density * (length / (link.length + link.compliance * force))
    };
    framework.links.iter().enumerate().map(nearer).collect()
}

/// Places of the joints in balance for given force densities.
fn by_density(
    framework: &Framework,
    stiffness: &mut Stiffness,
    densities: &[f64],
    sliding: bool,
) -> Vec<Vector3<f64>> {
    let bases: Vec<_> = framework.nodes.iter().map(|node| node.base).collect();
    let pulls = framework.links.iter().zip(densities);
    let unbalance = framework.unbalance(pulls.map(|(link, density)| link.span(&bases) * *density));
    if sliding {
        stiffness.assemble(framework, densities.iter().map(|w| Matrix3::identity() * *w));
        stiffness.factorise_definite();
        let moves = stiffness.moves(framework, &unbalance);
        return bases.iter().zip(moves).map(|(base, step)| base + step).collect();
    }
    stiffness.assemble_scalar(densities.iter().copied());
    stiffness.factorise_definite();
    let size = stiffness.size();
    let mut moves = vec![0.0; 3 * size];
    let column_of = |joint: usize| stiffness.first_unknown(joint);
    for (joint, force) in unbalance.iter().enumerate() {
        if let Some(column) = column_of(joint) {
            for axis in 0..3 {
                moves[axis * size + column] = force[axis];
            }
        }
    }
    stiffness.solve(&mut moves);
    let place = |(joint, base): (usize, &Vector3<f64>)| {
        stiffness.first_unknown(joint).map_or(*base, |column| {
            base + Vector3::new(moves[column], moves[size + column], moves[2 * size + column])
        })
    };
    bases.iter().enumerate().map(place).collect()
}
