//! Small motions of bars whose two moments across differ.
//!
//! A bar along `u` that turns with `ω` has `u̇ = ω × u`: with the second and third principal axis
//! across it `e₂ · ω = −e₃ · u̇` and `e₃ · ω = e₂ · u̇`, so that
//!
//! $$ T = \tfrac12 J_y (e_3 \cdot \dot u)^2 + \tfrac12 J_z (e_2 \cdot \dot u)^2
//!      + \tfrac12 J_x (u \cdot \omega)^2 . $$
//!
//! About a position at rest the spin `u · ω` is apart, though it is not in large motions: nothing
//! resists it, and it is a mode with `ω² = 0`. The smaller of the two moments counts in every
//! direction ([`EndInertia`]), and what the other is more in one.
//!
//! At rest a bar may have turned about itself by any angle, and the frequencies depend on it. It is
//! taken as a motion begins: its second axis level ([`second_axis`]).

use model::system::{Kind, System};

use crate::corners::{is_symmetric, second_axis, unequal};
use crate::error::Result;
use crate::inertia::EndInertia;
use crate::mechanism::{Link, Mechanism};
use crate::state::State;
use model::Vector;
use numerics::vector::{cross, times};

/// How far a moment may be above the sum of the other two, relative, and count as equal to it.
const ROUNDING: f64 = 1e-12;

/// What the greater of two moments across a bar adds to the inertia of the difference of its ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Excess {
    /// Slots of the ends.
    pub a: usize,
    pub b: usize,
    /// Number of the member.
    pub member: usize,
    /// The difference of the moments over the square of the length, kg.
    pub inertia_kg: f64,
    /// Direction across the bar in which it counts.
    pub axis: Vector,
}

/// The inertia of all members for small motions: with the smaller moment across.
/// [`MotionError::UnequalMoments`] where the moments across a member that may stretch or go slack
/// differ, or where no body has such moments.
pub(crate) fn smaller(system: &System) -> Result<Vec<EndInertia>> {
    let members = system.members().iter().enumerate();
    let inertia = members.map(|(number, member)| {
        let body = &member.body;
        let [jx, jy, jz] = body.inertia_kg_m2();
        if is_symmetric(body) {
            return Ok(EndInertia::new(body));
        }
        if member.stiffness_n.is_some() || member.kind != Kind::Bar {
            return Err(unequal(
                number,
                body,
                "it may stretch or go slack, and they differ across it",
            ));
        }
        let most = jx.max(jy).max(jz);
        if 2.0 * most > (1.0 + ROUNDING) * (jx + jy + jz) {
            return Err(unequal(number, body, "no body has one that is more than the other two"));
        }
        Ok(EndInertia::with_moment(body, jy.min(jz)))
    });
    inertia.collect()
}

/// What the greater moments add, at a position.
pub(crate) fn excesses(mechanism: &Mechanism, state: &State) -> Vec<Excess> {
    let excess = |link: &Link| {
        let body = &mechanism.system.members()[link.member].body;
        let [_, jy, jz] = body.inertia_kg_m2();
        if is_symmetric(body) {
            return None;
        }
        let d = state.between(link.a, link.b);
        let second = second_axis(d);
        let third = times(1.0 / link.length_m, cross(d, second));
        Some(Excess {
            a: link.a,
            b: link.b,
            member: link.member,
            inertia_kg: (jz - jy).abs() / link.length_m / link.length_m,
            axis: if jz > jy { second } else { third },
        })
    };
    mechanism.spans[..mechanism.rigid_spans()].iter().filter_map(excess).collect()
}
