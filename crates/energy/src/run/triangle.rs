//! Two bars over anchors that are near each other: a triangle.
//!
//! The lengths leave such a chain one motion, the turn about the line through its anchors, and its
//! shape in any plane is known. With the span `d`, the lengths `l_1`, `l_2`, the unit vector `e`
//! along the span and `n` normal to it the joint lies at `a e + h n`,
//!
//! $$ a = \frac{d^2 + l_1^2 - l_2^2}{2 d}, \qquad
//!    h = \frac{\sqrt{(d^2 - (l_1 - l_2)^2)((l_1 + l_2)^2 - d^2)}}{2 d}, $$
//!
//! and its energy is `(h_1 - h_2) up . (a e + h n)`. It is least with `n` as far down as the span
//! allows. That the gradient vanishes, `h_i up + mu = -N_i u_i`, are two equations in the plane
//! for the forces along the bars:
//!
//! $$ N_1 = -(h_1 - h_2)\\, l_1\\, \frac{h\\, up_e + b\\, up_n}{h\\, d}, \qquad
//!    N_2 =  (h_1 - h_2)\\, l_2\\, \frac{h\\, up_e - a\\, up_n}{h\\, d}, \qquad b = d - a . $$
//!
//! Two bars folded back to 1e-8 of their length differ in direction by that angle, and its square
//! is rounding: what a minimiser sees of the closure has lost it. To twice the digits of a double
//! these formulas keep all of it, whatever the anchors and lengths a problem can have.

use std::sync::Arc;

use model::Vector;

use crate::run::closure::Shape;
use crate::run::minimise::Minimum;
use crate::run::regime::Reach;
use crate::run::scaled_chain::ScaledChain;
use crate::run::settings::Motion;
use crate::run::slope::Slope;
use crate::twofold::Twofold;
use crate::vector::{along, cross, dot, scaled, unit};

/// A vector to twice the digits.
type Wide = [Twofold; 3];

/// Two bars over near anchors, in balance.
#[derive(Debug)]
pub(crate) struct Triangle {
    /// Directions of the bars.
    u: [Vector; 2],
    /// Multiplier of the closure.
    multiplier: Vector,
    /// Second derivative of the energy by the turn about the line through the anchors, in the
    /// metric `sum l_i |du_i|²`; zero about anchors on one vertical.
    pub(crate) curvature: f64,
}

impl Triangle {
    /// The equilibrium of two bars over near anchors to which directions lean: the upper or the
    /// lower one, or, about anchors on one vertical, that in their plane. `None` of other chains.
    pub(crate) fn near(links: &ScaledChain, u: &[Vector]) -> Option<Self> {
        if Reach::of_links(links) != Reach::Triangle {
            return None;
        }
        let (&[l1, l2], &[first, second]) = (links.length.as_slice(), u) else { return None };
        let lean = along(scaled(l1, first), -l2, second);
        let up = wide(links.up);
        let span: Wide = std::array::from_fn(|k| Twofold::sum(links.span[0][k], links.span[1][k]));
        let square = product(span, span);
        let d = square.sqrt();
        let e = span.map(|x| x / d);
        let n = if links.vertical {
            let aside = level(links, lean);
            let off = product(wide(aside), e);
            direction(std::array::from_fn(|k| Twofold::from(aside[k]) - off * e[k]))
        } else {
            let down = direction(crossed(crossed(up, span), span));
            if dot(down.map(Twofold::value), lean) < 0.0 { down.map(|x| -x) } else { down }
        };
        let two = Twofold::from(2.0);
        let (sum, difference) = (Twofold::sum(l1, l2), Twofold::sum(l1, -l2));
        let [a, b] = [sum * difference, -(sum * difference)].map(|x| (square + x) / (two * d));
        let sides = (d - difference) * (d + difference) * (sum - d) * (sum + d);
        let h = sides.sqrt() / (two * d);
        // Anchors so far apart as the lengths differ: the bars lie on one line.
        if h.value() <= 0.0 {
            return None;
        }
        let [l1, l2] = [l1, l2].map(Twofold::from);
        let at = |along: Twofold, aside: Twofold, length: Twofold| -> Wide {
            std::array::from_fn(|k| (along * e[k] + aside * n[k]) / length)
        };
        let (first, second) = (at(a, h, l1), at(b, -h, l2));
        let load = Twofold::sum(links.carried[0], -links.carried[1]);
        let (up_e, up_n) = (product(up, e), product(up, n));
        let axial = -(load * l1 * (h * up_e + b * up_n)) / (h * d);
        let carried = Twofold::from(links.carried[0]);
        let multiplier = std::array::from_fn(|k| -(axial * first[k] + carried * up[k]).value());
        let spread = h * (Twofold::from(1.0) / l1 + Twofold::from(1.0) / l2);
        let curvature = if links.vertical { 0.0 } else { -(load * up_n / spread).value() };
        let u = [first, second].map(|u| u.map(Twofold::value));
        Some(Self { u, multiplier, curvature })
    }

    /// The equilibrium below a seed: in space the lower one.
    fn below(links: &ScaledChain, u: &[Vector]) -> Option<Self> {
        let found = Self::near(links, u)?;
        if links.motion == Motion::Plane || found.curvature >= 0.0 {
            return Some(found);
        }
        let other: Vec<Vector> = u.iter().map(|u| scaled(-1.0, *u)).collect();
        Self::near(links, &other)
    }

    /// The projected gradient at directions, with the multiplier of the equilibrium.
    pub(crate) fn slope(&self, links: &ScaledChain, u: &[Vector]) -> Slope {
        Slope::refined(links, u, self.multiplier)
    }
}

impl Minimum {
    /// The minimum of two bars over near anchors; `None` of other chains.
    pub(crate) fn of_triangle(links: &Arc<ScaledChain>, start: &[Vector]) -> Option<Self> {
        let found = Triangle::below(links, start)?;
        let u = found.u.to_vec();
        let slope = found.slope(links, &u);
        let moments = links.measure(&u);
        Some(Self {
            links: Arc::clone(links),
            shape: Arc::new(Shape { u, moments }),
            slope: Arc::new(slope),
            iterations: 0,
            evaluations: 0,
            unsettled: None,
        })
    }
}

/// Unit vector of the level part; the level axis of the frame of what has none.
fn level(links: &ScaledChain, v: Vector) -> Vector {
    unit(cross(cross(links.up, v), links.up)).unwrap_or(links.level())
}

fn wide(v: Vector) -> Wide {
    v.map(Twofold::from)
}

fn product(a: Wide, b: Wide) -> Twofold {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn crossed(a: Wide, b: Wide) -> Wide {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn direction(v: Wide) -> Wide {
    let size = product(v, v).sqrt();
    v.map(|x| x / size)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_cross_to_the_right() {
        let near = |found: Wide, wanted: Vector| {
            let found = found.map(Twofold::value);
            assert!((0..3).all(|k| (found[k] - wanted[k]).abs() < 1e-15), "{found:?}");
        };
        near(crossed(wide([2.0, 3.0, -5.0]), wide([7.0, 11.0, 13.0])), [94.0, -61.0, 1.0]);
        near(direction(wide([2.0, -3.0, 6.0])), [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0]);
        let part = product(wide([2.0, 3.0, -5.0]), wide([7.0, 11.0, 13.0])).value();
        assert!((part + 18.0).abs() < 1e-15, "{part}");
    }
}
