//! Axial forces fitted to a shape, to begin with.
//!
//! Rigid members: the forces that leave the joints least out of balance, of these the least. With
//! elastic ones: the least complementary energy $\\sum c\\,(N - N_0)^2/2$ of forces in balance, where
//! $N_0$ is what a member bears at the length that it has in the shape; so a prestress stays what it
//! is, and what does not fit is relaxed. Both are one solve with $\\sum k\\, u u^T$, $k = 1/c$, and as many more as
//! it takes until cables pull and struts push.

use super::framework::{Framework, Link};
use super::signs::SIGN_CHANGES;
use super::state::State;
use super::stiffness::Stiffness;

/// Stiffness that stands for a rigid member, in units of the stiffest elastic one.
pub(super) const RIGID: f64 = 1e3;
/// Ridge of the least squares, in units of the stiffness.
const RIDGE: f64 = 1e-9;

/// Forces fitted to the places of a state, of its taut members.
pub(super) fn fitted_forces(
    framework: &Framework,
    stiffness: &mut Stiffness,
    state: &State,
) -> Vec<f64> {
    let directions = state.directions(framework);
    let elastic = |link: &Link| (link.compliance > 0.0).then(|| link.compliance.recip());
    let stiffest = framework.links.iter().filter_map(elastic).fold(0.0, f64::max);
    let rigid = if stiffest > 0.0 { RIGID * stiffest } else { 1.0 };
    let member = |(k, link): (usize, &Link)| {
        if !state.taut[k] {
            return (0.0, 0.0);
        }
        let Some(along) = elastic(link) else { return (rigid, 0.0) };
        let length = framework.whole(k, |span| directions[span].1);
        let stretch = length - link.length;
        let own = stretch * along;
        (along, own)
    };
    let members: Vec<(f64, f64)> = framework.links.iter().enumerate().map(member).collect();
    let mut bearing = state.taut.clone();
    let mut forces = vec![0.0; members.len()];
    for _ in 0..SIGN_CHANGES {
        let along = |k: usize| if bearing[k] { members[k].0 } else { 0.0 };
        stiffness.assemble_members(framework, |k| (directions[k].0, 0.0, along(k)));
        stiffness.shift(RIDGE * stiffest.max(rigid));
        stiffness.factorise_definite();
        let own = |k: usize| if bearing[k] { members[k].1 } else { 0.0 };
        let loads =
            framework.unbalance(directions.iter().enumerate().map(|(k, (u, _))| u * own(k)));
        let mut moves = stiffness.gather(framework, &loads);
        stiffness.solve(&mut moves);
        let moves = stiffness.scatter(framework, &moves);
        let stretch = |span: usize| directions[span].0.dot(&framework.links[span].span(&moves));
        for (e, (force, (k, own))) in forces.iter_mut().zip(&members).enumerate() {
            *force = own + k * framework.whole(e, stretch);
        }
        let links = framework.links.iter().zip(&forces).zip(&state.taut);
        let next =
            links.map(|((link, force), taut)| *taut && (*force == 0.0 || link.bears(*force)));
        let next: Vec<bool> = next.collect();
        if next == bearing {
            break;
        }
        bearing = next;
    }
    forces
}
