//! The certificate of global minimality where ropes run over rings and pulleys.
//!
//! The length $\sum |d_s|$ of a rope is a convex function of the places of its joints, and so is that of
//! every member that pulls. With any tensions $T_e \ge 0$ and any unit vectors $u_s$ of the spans
//!
//! $$ V(x) \ge \sum_e \Big(\varphi_e(s_e) + T_e \big(\textstyle\sum_s u_s \cdot d_s - s_e\big)\Big)
//!    - \sum_j f_j \cdot x_j $$
//!
//! (where a span has no length any vectors of no more than unit length) in every configuration: an inextensible member is not longer than $s_e = l_e$, of an elastic one
//! $T_e$ is the slope of $\varphi_e$ at $s_e = l_e (1 + T_e/EA_e)$, and $|d| \ge u \cdot d$. The right side
//! is linear in the places. With its gradient $r$ at the answer $\tilde x$, where in no configuration with
//! less energy a joint is further from its place than $D_j$,
//!
//! $$ V(x) \ge Q(\tilde x) - \sum_j D_j |r_j| . $$
//!
//! $D_j$ is twice the length of members to an anchor and, where some stretch, by how much: together they
//! stretch by no more than the root $S$ of $k S^2/2m - F S = V(\tilde x) + F a$, with the least spring rate
//! $k$ of the $m$ that stretch, all loads $F$ and the reach $a$ without stretching.

use std::collections::VecDeque;

use model::system::{Joint, Kind, Member, System, SystemEquilibrium};
use model::{NoCertificate, sum};

use super::certificate::{Below, size_m};
use super::spans::pull_n;
use numerics::vector::{dot, minus, norm, times};

/// More than rounding adds to a reach.
const REACHES: f64 = 1.001;

/// A bound that no configuration has less energy than, J.
pub(super) fn bound_j(system: &System, answer: &SystemEquilibrium) -> Result<f64, NoCertificate> {
    let members = || system.members().iter().zip(&answer.axial_n);
    let pulls = |member: &Member, axial_n: f64| match member.kind {
        Kind::Bar => axial_n >= 0.0,
        Kind::Cable => true,
        Kind::Strut => false,
    };
    match members().filter(|(member, axial_n)| !pulls(member, **axial_n)).count() {
        0 => {}
        members => return Err(NoCertificate::NotConvex { members }),
    }
    let reaches_m = reaches_m(system);
    let longest_m = reaches_m.iter().copied().fold(0.0, f64::max);
    let stretch_m = stretch_m(system, answer, longest_m);
    let far_m = |reach_m: f64| REACHES * 2.0 * (reach_m + stretch_m);
    let farthest_m = far_m(longest_m);
    if !farthest_m.is_finite() {
        return Err(NoCertificate::NotConvex { members: 0 });
    }
    let mut below = Below::new(system, answer);
    for (k, (member, axial_n)) in members().enumerate() {
        let tension_n = axial_n.max(0.0);
        if tension_n <= 0.0 {
            continue;
        }
        let (mut along_m, mut size_m) = (0.0, farthest_m);
        for (n, [a, b]) in member.spans().enumerate() {
            let pull = pull_n(k, n, [a, b], answer);
            // Of a span without length no more than its tension.
            let pull = times(tension_n / norm(pull).max(tension_n), pull);
            below.pull([a, b], pull, tension_n);
            let [from, to] = [a, b].map(|joint| below.places_m[joint]);
            size_m = size_m + norm(from) + norm(to);
            along_m += dot(pull, minus(to, from)) / tension_n;
        }
        // Unstretched, and by its force.
        let stretch_m =
            member.stiffness_n.map_or(0.0, |ea| member.body.length_m() * tension_n / ea);
        let stretched_m = member.body.length_m() + stretch_m;
        let value_j = tension_n * (along_m - stretched_m) + 0.5 * tension_n * stretch_m;
        below.terms_j.push((value_j, tension_n * (size_m + stretched_m)));
    }
    let (value_j, left_n) = below.bounds(system.members().iter().map(|m| m.via().len() + 1).sum());
    let left_j = left_n.iter().zip(reaches_m).map(|(left_n, reach_m)| left_n * far_m(reach_m));
    Ok(value_j - sum(left_j))
}

/// How far each joint may be from an anchor along unstretched members, m; infinite where nothing leads to one.
fn reaches_m(system: &System) -> Vec<f64> {
    let mut neighbours = vec![Vec::new(); system.joints().len()];
    for member in system.members() {
        for [a, b] in member.spans() {
            neighbours[a].push((b, member.body.length_m()));
            neighbours[b].push((a, member.body.length_m()));
        }
    }
    let held = |joint: &Joint| if joint.support.is_fixed() { 0.0 } else { f64::INFINITY };
    let mut reaches_m: Vec<f64> = system.joints().iter().map(held).collect();
    let mut open: VecDeque<usize> =
        (0..reaches_m.len()).filter(|joint| reaches_m[*joint] <= 0.0).collect();
    while let Some(joint) = open.pop_front() {
        for &(other, length_m) in &neighbours[joint] {
            if reaches_m[other].is_infinite() {
                reaches_m[other] = reaches_m[joint] + length_m;
                open.push_back(other);
            }
        }
    }
    reaches_m
}

/// By how much all members together may stretch in a configuration with no more energy, m.
fn stretch_m(system: &System, answer: &SystemEquilibrium, reach_m: f64) -> f64 {
    let rate = |member: &Member| Some(member.stiffness_n? / member.body.length_m());
    let rates: Vec<f64> = system.members().iter().filter_map(rate).collect();
    if rates.is_empty() {
        return 0.0;
    }
    let load_n = system.total_load_n();
    let soft = rates.iter().copied().fold(f64::INFINITY, f64::min) / rates.len() as f64;
    let energy_j = (answer.energy_j + load_n * (size_m(system, answer) + reach_m)).max(0.0);
    (load_n + (load_n * load_n + 2.0 * soft * energy_j).sqrt()) / soft
}
