//! The certificate of global minimality where ropes run over rings and pulleys.
//!
//! The length $\sum |d_s|$ of a rope is a convex function of the places of its joints, and so is that of
//! every member that pulls. With any tensions $T_e \ge 0$ and any unit vectors $u_s$ of the spans
//!
//! $$ V(x) \ge \sum_e \Big(\varphi_e(s_e) + T_e \big(\textstyle\sum_s u_s \cdot d_s - s_e\big)\Big)
//!    - \sum_j f_j \cdot x_j $$
//!
//! in every configuration: an inextensible member is not longer than $s_e = l_e$, of an elastic one
//! $T_e$ is the slope of $\varphi_e$ at $s_e = l_e (1 + T_e/EA_e)$, and $|d| \ge u \cdot d$. The right side
//! is linear in the places. With its gradient $r$ at the answer $\tilde x$, the places of which no
//! configuration with less energy is further away than $D$,
//!
//! $$ V(x) \ge Q(\tilde x) - D \sum_j |r_j| . $$
//!
//! $D$ follows from the lengths of all members and, where some stretch, from their energy: together they
//! stretch by no more than the root $S$ of $k S^2/2m - F S = V(\tilde x) + F a$, with the least spring rate
//! $k$ of the $m$ that stretch, all loads $F$ and the reach $a$ without stretching.

use model::system::{Kind, Member, System, SystemEquilibrium};
use model::{NoCertificate, Vector, sum};

use super::certificate::{TERM_ULPS, along_supports, joint_loads, pushed, size_m, total_load_n};
use super::spans::direction;
use numerics::vector::{dot, minus, norm, plus, times};

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
    let held = |joints: &[usize]| joints.iter().any(|k| system.joints()[*k].support.is_fixed());
    let far_m = far_m(system, answer);
    if !system.parts().iter().all(|part| held(&part.joints)) || !far_m.is_finite() {
        return Err(NoCertificate::NotConvex { members: 0 });
    }
    let origin = system.reference_m();
    let place = |k: usize| minus(answer.joints_m[k], origin);
    let mut loads = joint_loads(system);
    let mut terms = pushed(system, answer, &mut loads);
    let mut gradient: Vec<Vector> = loads.iter().map(|load| times(-1.0, *load)).collect();
    let mut sizes_n: Vec<f64> = loads.iter().map(|load| norm(*load)).collect();
    for (member, axial_n) in members() {
        let tension_n = axial_n.max(0.0);
        if tension_n <= 0.0 {
            continue;
        }
        let (mut along_m, mut size_m) = (0.0, far_m);
        for [a, b] in member.spans() {
            let pull = times(tension_n, direction([a, b], &answer.joints_m));
            gradient[b] = plus(gradient[b], pull);
            gradient[a] = minus(gradient[a], pull);
            for joint in [a, b] {
                sizes_n[joint] += tension_n;
                size_m += norm(place(joint));
            }
            along_m += dot(pull, minus(place(b), place(a))) / tension_n;
        }
        // Unstretched, and by its force.
        let stretch_m =
            member.stiffness_n.map_or(0.0, |ea| member.body.length_m() * tension_n / ea);
        let stretched_m = member.body.length_m() + stretch_m;
        let value_j = tension_n * (along_m - stretched_m) + 0.5 * tension_n * stretch_m;
        terms.push((value_j, tension_n * (size_m + stretched_m)));
    }
    let works = loads.iter().enumerate().map(|(k, load)| {
        let at = place(k);
        (-dot(*load, at), norm(*load) * norm(at))
    });
    terms.extend(works);
    let ulps = TERM_ULPS * f64::EPSILON;
    let rounding_j = ulps * sum(terms.iter().map(|(_, size)| *size));
    let many =
        f64::EPSILON * system.members().iter().map(|m| m.via().len() + 1).sum::<usize>() as f64;
    let left_n = gradient.iter().zip(sizes_n).enumerate().map(|(k, (force, size))| {
        let moving = along_supports(system, k, *force);
        if system.joints()[k].support.is_fixed() {
            0.0
        } else {
            norm(moving) + (ulps + many) * size
        }
    });
    Ok(sum(terms.iter().map(|(term, _)| *term)) - rounding_j - far_m * sum(left_n))
}

/// How far any configuration with no more energy may be from the answer, m.
fn far_m(system: &System, answer: &SystemEquilibrium) -> f64 {
    let (at_m, length_m) = (size_m(system, answer), system.total_length_m());
    let rate = |member: &Member| Some(member.stiffness_n? / member.body.length_m());
    let rates: Vec<f64> = system.members().iter().filter_map(rate).collect();
    let stretch_m = if rates.is_empty() {
        0.0
    } else {
        let load_n = total_load_n(system);
        let soft = rates.iter().copied().fold(f64::INFINITY, f64::min) / rates.len() as f64;
        let energy_j = (answer.energy_j + load_n * (at_m + length_m)).max(0.0);
        (load_n + (load_n * load_n + 2.0 * soft * energy_j).sqrt()) / soft
    };
    REACHES * (2.0 * at_m + length_m + stretch_m)
}
