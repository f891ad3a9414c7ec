//! Two bars over anchors that are next to each other, by the moments of their one load.
//!
//! The forces in the bars are parallel to them and differ by the load w of the joint between them.
//! With the joint at (x, z) from the start, and the end anchor at $(D_h, D_z)$, that is
//! $F_1 = \tau_1 (x, z)$, $F_2 = \tau_2 (D_h - x, D_z - z)$, $F_2 - F_1 = w e_z$: the moments of the
//! load about the anchors,
//!
//! $$ \tau_1 = w\\,\frac{D_h - x}{K}, \qquad \tau_2 = w\\,\frac{x}{K}, \qquad K = x D_z - z D_h , $$
//!
//! K being twice the area between bars and anchors, which follows from the lengths (Heron). A
//! closure that is summed up from the bars holds a rounding of their length, and the distance of
//! the anchors is hardly more; the area to twice the digits holds all of it.

use super::unloaded;
use crate::condensed::chain::Condensed;
use crate::condensed::pull::{Pull, Signs};
use crate::condensed::sums::DoubleDouble;

/// In closed form.
pub(super) fn solve(chain: &Condensed) -> Option<Pull> {
    let (&[first, second], &[before, after]) =
        (chain.bars.lengths.as_slice(), chain.bars.loads.as_slice())
    else {
        return None;
    };
    let [x, y, rise] = chain.span.steps;
    let across = x.square().add(y.square()).root();
    let square = chain.span.distance_squared;
    let (sum, difference) = (DoubleDouble::sum(first, second), DoubleDouble::sum(first, -second));
    let longer = sum.square().add(square.negate());
    let nearer = square.add(difference.square().negate());
    let area = longer.times(nearer).root().half();
    // Along the way from anchor to anchor and across it, as parts of its length.
    let along = square.add(sum.times(difference)).half().over(square);
    let aside = area.over(square);
    let x = along.times(across).add(aside.times(rise));
    let z = along.times(rise).add(aside.times(across).negate());
    let [beyond, above] = [across.add(x.negate()), rise.add(z.negate())];
    let per_area = DoubleDouble::sum(after, -before).over(area);
    let forces = [[per_area.times(beyond), x, z], [per_area.times(x), beyond, above]]
        .map(|[density, h, v]| (density, [density.times(h), density.times(v)]));
    let [(start, _), (end, _)] = forces;
    let signs = match [start, end].map(DoubleDouble::value) {
        // The load hangs from one bar alone, or there is none.
        [a, b] if a.abs() <= 0.0 || b.abs() <= 0.0 => return Some(unloaded::solve(chain)),
        [a, b] if a > 0.0 && b > 0.0 => Signs::Tension,
        [a, _] if a < 0.0 => Signs::Compressed(0),
        _ => Signs::Compressed(1),
    };
    let bottom = usize::from(after.abs() <= 0.0);
    let force = forces[bottom].1.map(DoubleDouble::value);
    let [sum, area] = [per_area.times(across), area].map(DoubleDouble::value);
    Some(Pull::of_triangle(chain, signs, force, [start, end].map(DoubleDouble::value), sum, area))
}
