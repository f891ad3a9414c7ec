//! Equilibria in which a group of bars in one line carries nothing and just bridges its gap.
//!
//! The bars of a group, whose common joints carry no weight, may bridge the gap that the others leave
//! in any way, without force: a family. If the gap is just as long as all of them in one line, or as
//! the longest less the others, one position is left. With the lengths and anchors as integers this
//! is a question without rounding.
//!
//! The position is an equilibrium that no other is near: with the small turns $\varphi_k$ of the group's
//! bars, $\sum_k \sigma_k l_k \varphi_k = 0$ across the gap, the group is shorter than in one line by
//!
//! $$ \delta = \tfrac12 \sum_k \sigma_k l_k \varphi_k^2 , $$
//!
//! which is positive definite if all point along the gap. If the longest alone does, it is negative
//! definite: $l_1^2 \varphi_1^2 = (\sum_{k>1} l_k \varphi_k)^2 \le (l_1 - |g|) \sum_{k>1} l_k \varphi_k^2$ for the
//! gap g. The other bars, upright with the signed forces $\mu_i$, must lean by $x = \delta |g|/g_x$ in sum, and
//! with $C = \sum_i l_i/\mu_i$ the energy is
//!
//! $$ V = V_0 + \frac{|g|^2 \delta^2}{2\\,g_x^2\\,C} + \dots, $$
//!
//! of the fourth order in the g − 1 turns that are free, and definite. (C ≠ 0 where the derivative by
//! the force of the group is regular, as Krawczyk's test proves.) The energy rises with all of
//! them if C > 0, so its degree is that of the other bars, and falls if C < 0, each turn changing the
//! sign. With two bars in the group the derivative of the energy has a zero of order three: a pitchfork,
//! at which two slack positions and the one in line meet. With more a sphere of slack positions shrinks
//! to the point.

use numerics::Interval;

use crate::degenerate::unloaded::DegenerateEquilibrium;
use crate::slack::axial::AxialClosure;
use crate::slack::exact::ExactSides;
use crate::slack::unloaded::{upright, widest_disc};

/// The radius of a disc of pulls in which no other has the group in this line, pulled or pushed, than that
/// without force, if the group exactly bridges its gap so.
pub(crate) fn alone(sides: &ExactSides, closure: &AxialClosure) -> Option<f64> {
    let AxialClosure { system, group, along, face, signs, .. } = closure;
    let up = upright(system, *face, signs)?;
    if !sides.just_bridges(&up, group.clone(), along) {
        return None;
    }
    let (only, radius) = widest_disc(closure)?;
    // The zero without force is in the disc, so it is the only one.
    only.at[0].contains(0.0).then_some(radius)
}

/// The equilibrium in which the group carries nothing, alone in such a disc, where it has no other way to
/// bridge the gap.
pub(crate) fn prove(closure: &AxialClosure, radius: f64) -> Option<DegenerateEquilibrium> {
    let AxialClosure { group, signs, .. } = closure;
    let exactly = closure.directions(0.0)?;
    let bars = closure.bars([Interval::ZERO, exactly])?;
    let indices = closure.indices(&bars, f64::INFINITY)?;
    let turns = group.len() - 1;
    let compressed = signs.iter().filter(|sign| **sign < 0).count();
    let falls = if indices.in_plane < compressed { turns } else { 0 };
    let degree = if (indices.in_plane + falls) % 2 == 0 { 1 } else { -1 };
    let multiplicity = (turns == 1).then_some(3);
    Some(DegenerateEquilibrium::new(closure, bars, radius, indices, (multiplicity, degree)))
}
