//! The two prestressed nets of jax_fdm: do their force densities balance?

use formats::system::parse_net;

use super::entry::{BothSolvers, Compared, Entry};
use crate::foreign::{ForcesJudged, ForeignAnswer, judge_foreign};
use numerics::vector::{minus, norm, plus, times, worse};

const SOURCE: &str = "R. Pastrana, jax_fdm, tests/test_reference_solver.py and tests/data/reference, \
    github.com/arpastrana/jax_fdm, commit 71d449076d73";
/// What its test allows a joint to be out of balance: 1e-7 N.
const ALLOWED_MICRO_N: &str = "0.1";
/// Micronewtons of a newton.
const MICRO: f64 = 1e6;
/// Tolerance of the judgement: the files have ten digits.
const TOLERANCE: f64 = 1e-9;

/// Both nets.
pub fn jax_fdm() -> Vec<Entry> {
    let olympia = (
        include_str!("../../data/external/force-density/olympia-nodes.csv").to_owned(),
        include_str!("../../data/external/force-density/olympia-edges.csv"),
    );
    // The third coordinate is headed `6` in this one.
    let stuttgart = (
        include_str!("../../data/external/force-density/stuttgart21-nodes.csv")
            .replacen("id,x,y,6,", "id,x,y,z,", 1),
        include_str!("../../data/external/force-density/stuttgart21-edges.csv"),
    );
    [("Olympia", olympia), ("Stuttgart 21", stuttgart)]
        .map(|(name, (nodes, edges))| net(name, &nodes, edges))
        .into()
}

fn net(name: &str, nodes: &str, edges: &str) -> Entry {
    let judged = parse_net((nodes, "nodes"), (edges, "edges"), name).and_then(|net| {
        let system = net.system_at(&net.places_m(), name)?;
        Ok((net, system))
    });
    let judged = judged.ok().and_then(|(net, system)| {
        let answer = ForeignAnswer::in_order(&system, "jax_fdm", net.places_m(), None).ok()?;
        let judged = judge_foreign(&system, &answer, TOLERANCE, &|_| {}).ok()?;
        // Out of balance with the densities as they stand, not with the best ones.
        Some((largest_left_n(&net), system, judged))
    });
    let Some((left_n, system, judged)) = judged else {
        return Entry::not_judged(name, SOURCE, "the net could not be read");
    };
    let largest_n = match &judged.forces {
        ForcesJudged::Found(best) => best.largest_n,
        ForcesJudged::Given => f64::NAN,
    };
    let what = "largest unbalanced force of a joint / 10⁻⁶ N";
    let number = Compared {
        at_most: true,
        digits: 3,
        ..Compared::new(what, ALLOWED_MICRO_N, MICRO * left_n, Some(0.0))
    };
    let solvers = judged.nearest().map(|nearest| BothSolvers::Judged {
        finding: judged.finding.word(),
        joints_m: nearest.joints_m,
        rung: judged.ladder.highest(),
    });
    let (joints, members) = (system.joints().len(), system.members().len());
    Entry {
        title: format!(
            "{name}: {joints} joints, {members} members, forces up to {largest_n:.1} N, no load"
        ),
        source: SOURCE,
        numbers: vec![number],
        by_hand: None,
        solvers,
        not_judged: None,
    }
}

/// The largest force that the densities leave over at a free node, N.
fn largest_left_n(net: &formats::system::ForceDensityNet) -> f64 {
    let mut left: Vec<[f64; 3]> = net.nodes.iter().map(|node| node.force_n).collect();
    for edge in &net.edges {
        let (a, b) = (net.nodes[edge.from].at_m, net.nodes[edge.to].at_m);
        let pull = times(edge.density_n_m, minus(b, a));
        left[edge.from] = plus(left[edge.from], pull);
        left[edge.to] = minus(left[edge.to], pull);
    }
    let free = net.nodes.iter().zip(left).filter(|(node, _)| !node.held);
    free.map(|(_, force)| norm(force)).fold(0.0, worse)
}

#[cfg(test)]
mod tests;
