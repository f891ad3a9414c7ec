//! What a joint between two bars makes of the places of its ends, over a box of them.
//!
//! The joint P hangs on bars of the lengths $l_1$ to a and $l_2$ to b; $c = b - a$, $q = |c|^2$. It
//! lies on a circle about the line through a and b (in a plane, at two points),
//!
//! $$ P = a + \alpha c + \sigma h\\,n, \qquad \alpha = \frac12 + \frac{l_1^2 - l_2^2}{2q}, \qquad
//!    h^2 = \frac{((l_1 + l_2)^2 - q)(q - (l_1 - l_2)^2)}{4q}. $$
//!
//! With its load f, $\varrho = f\cdot c/q$ and $f_\perp = f - \varrho c$, balance across the line
//! asks in space for $n = f_\perp/|f_\perp|$, and then the bars pull at b with
//!
//! $$ G_b = (1 - \alpha)\varrho\\,c + \alpha f_\perp - \sigma\Bigl(\tau c
//!    + \varrho\\,h\\,n\Bigr), \qquad \tau = \frac{|f_\perp|\\,\alpha(1 - \alpha)}{h}, $$
//!
//! and at a with $G_a = f - G_b$; in a plane n is the normal of c and $|f_\perp|$ is
//! $f\cdot n$, of either sign. The force densities are $w_1 = \sigma |f_\perp|(1 - \alpha)/h +
//! \varrho$ and $w_2 = \sigma |f_\perp|\alpha/h - \varrho$. Where the bars lie straight (h = 0) the
//! tension τ has no bound; where a and b stand on one line along f the joint goes round freely, and
//! n is any; where equal bars are folded (c = 0) nothing is said of $G_b$ here.

use std::array::from_fn;

use numerics::Interval;
use numerics::vector::{cross, minus, plus, times};

use super::jet::{Jet, Jets, across, along, squared, values};
use super::layout::{End, Swing};
use crate::boxes::arithmetic::{self, Vector, product, quotient, sum};

/// A swinging joint over a box of the places of its ends.
#[derive(Debug, Clone)]
pub(super) struct Swung<const N: usize> {
    /// `(1 − α) ρ c + α f⊥`.
    pub(super) base: Vector,
    /// `ρ h n`: taken off times σ.
    pub(super) sideways: Vector,
    /// c.
    pub(super) span: Vector,
    /// τ, perhaps without bound.
    pub(super) tension: Interval,
    /// Base, and `τ c + ρ h n`, where both are differentiable over the whole box.
    pub(super) smooth: Option<[Jets<N>; 2]>,
    /// Whether both ends may be one point.
    pub(super) folded: bool,
    /// Whether they are so near that the bars are all but folded.
    pub(super) near: bool,
    /// The size of `ρ h n` where n may be any direction.
    pub(super) round: Option<Interval>,
}

/// What a point tells besides: the place of the joint and its force densities.
#[derive(Debug, Clone, Copy)]
pub(super) struct Hung {
    pub(super) place: [f64; 3],
    pub(super) densities: [f64; 2],
}

/// The place of an end over a box of coordinates.
pub(super) fn place<const N: usize>(end: End, dim: usize, at: &[Interval; N]) -> Jets<N> {
    match end {
        End::Held(place) => place.map(Jet::constant),
        End::Knot(knot) => from_fn(|k| {
            if k < dim { Jet::coordinate(at[dim * knot + k], dim * knot + k) } else { Jet::ZERO }
        }),
    }
}

/// Ends nearer than half of the length of both bars, squared.
const NEAR: f64 = 0.25;

const UNIT: Interval = Interval::ONE.hull(Interval::ONE.negated());

impl<const N: usize> Swung<N> {
    /// Over a box; nothing where the bars reach nowhere in it.
    pub(super) fn over(swing: &Swing, dim: usize, at: &[Interval; N]) -> Option<Self> {
        let [a, b] = swing.ends.map(|end| place(end, dim, at));
        let span = minus(b, a);
        let reach = Reach::new(swing, squared(span))?;
        let (q, folded) = (reach.clipped, reach.clipped.lo() <= 0.0);
        let near = q.hi() < NEAR * reach.sum.lo() * reach.sum.lo();
        if folded {
            let nothing = [Interval::LINE; 3];
            return Some(Self {
                base: nothing,
                sideways: nothing,
                span: values(span),
                tension: Interval::LINE,
                smooth: None,
                folded,
                near,
                round: None,
            });
        }
        let rough = reach.at(Jet::constant(q));
        let rough = Parts::new(swing, dim, span.map(|part| Jet::constant(part.value)), &rough);
        let smooth = reach.smooth().and_then(|bars| Parts::new(swing, dim, span, &bars).smooth());
        Some(Self {
            base: values(rough.base),
            sideways: rough.sideways(),
            span: values(span),
            tension: rough.tension(),
            round: rough.round(),
            smooth,
            folded,
            near,
        })
    }

    /// Place and force densities at the middle of a box that is next to a point.
    pub(super) fn at_point(
        swing: &Swing,
        dim: usize,
        at: &[Interval; N],
        sign: f64,
    ) -> Option<Hung> {
        let [a, b] = swing.ends.map(|end| place(end, dim, at));
        let span = minus(b, a);
        let bars = Reach::new(swing, squared(span))?.smooth()?;
        let parts = Parts::new(swing, dim, span, &bars);
        let height = parts.bars.square_height.value.sqrt().mid();
        let alpha = parts.bars.alpha.value.mid();
        let normal = parts.normal();
        let place = from_fn(|k| {
            a[k].value.mid() + alpha * span[k].value.mid() + sign * height * normal[k].mid()
        });
        let pull = sign * parts.aside().mid() / height;
        let rho = parts.rho.value.mid();
        Some(Hung { place, densities: [pull * (1.0 - alpha) + rho, pull * alpha - rho] })
    }
}

/// The lengths of the bars against the square q of the distance of their ends.
struct Reach<const N: usize> {
    square: Jet<N>,
    /// What of it the bars reach.
    clipped: Interval,
    sum: Interval,
    /// Exactly 0 for equal bars.
    difference: Interval,
}

/// α and h² with q.
#[derive(Clone, Copy)]
struct Bars<const N: usize> {
    inverse: Jet<N>,
    alpha: Jet<N>,
    square_height: Jet<N>,
}

impl<const N: usize> Reach<N> {
    fn new(swing: &Swing, square: Jet<N>) -> Option<Self> {
        let [l, m] = swing.lengths;
        let (sum, difference) = (l + m, arithmetic::difference(l, m));
        let reached = Interval::new(squared_or_zero(difference).lo(), sum.square().hi());
        let clipped = square.value.intersect(reached)?;
        Some(Self { square, clipped, sum, difference })
    }

    fn at(&self, q: Jet<N>) -> Bars<N> {
        let inverse = q.inverse();
        let both = product(self.sum, self.difference);
        let half = Jet::constant(Interval::ONE.scale(0.5));
        let alpha = half + inverse.times(both.scale(0.5));
        let near = Jet::constant(Interval::ONE) - inverse.times(squared_or_zero(self.difference));
        let far = Jet::constant(self.sum.square()) - q;
        let square_height = (far * near).times(Interval::ONE.scale(0.25));
        Bars { inverse, alpha, square_height }
    }

    /// Where the bars are neither straight nor folded in the whole box.
    fn smooth(&self) -> Option<Bars<N>> {
        if self.square.value.lo() <= 0.0 {
            return None;
        }
        let bars = self.at(self.square);
        (bars.square_height.value.lo() > 0.0).then_some(bars)
    }
}

fn squared_or_zero(x: Interval) -> Interval {
    if x == Interval::ZERO { x } else { x.square() }
}

/// All that the force is made of.
struct Parts<const N: usize> {
    dim: usize,
    span: Jets<N>,
    bars: Bars<N>,
    rho: Jet<N>,
    /// In space `c × f`, of the size `|c| |f⊥|`; in a plane the normal of c turned by 90 degrees.
    turned: Jets<N>,
    /// In space `q f⊥`.
    off: Jets<N>,
    /// In a plane `f · turned`.
    sheer: Jet<N>,
    base: Jets<N>,
}

impl<const N: usize> Parts<N> {
    fn new(swing: &Swing, dim: usize, span: Jets<N>, bars: &Bars<N>) -> Self {
        let rho = along(swing.load, span) * bars.inverse;
        let (turned, off, sheer) = if dim == 2 {
            let turned = [-span[1], span[0], Jet::ZERO];
            let sheer = along(swing.load, turned);
            (turned, times(sheer, turned), sheer)
        } else {
            let turned = across(span, swing.load);
            (turned, cross(turned, span), Jet::ZERO)
        };
        let one = Jet::constant(Interval::ONE);
        let base =
            plus(times((one - bars.alpha) * rho, span), times(bars.alpha * bars.inverse, off));
        Self { dim, span, bars: *bars, rho, turned, off, sheer, base }
    }

    /// |f⊥|, in a plane f · n.
    fn aside(&self) -> Interval {
        let inverse = self.bars.inverse.value.sqrt();
        if self.dim == 2 {
            product(self.sheer.value, inverse)
        } else {
            product(arithmetic::norm(values(self.turned)), inverse)
        }
    }

    /// n; in space any direction where the load may have no part across.
    fn normal(&self) -> Vector {
        let inverse = self.bars.inverse.value.sqrt();
        if self.dim == 2 {
            return values(self.turned).map(|part| product(part, inverse));
        }
        let size = arithmetic::norm(values(self.turned));
        if size.lo() <= 0.0 {
            return [UNIT; 3];
        }
        values(self.off).map(|part| {
            let part = product(product(part, inverse), Interval::ONE / size);
            part.intersect(UNIT).unwrap_or(UNIT)
        })
    }

    /// The size of `ρ h n`, if nothing is known of n.
    fn round(&self) -> Option<Interval> {
        let height = self.bars.square_height.value.sqrt();
        let size = product(self.rho.value.abs(), height);
        (self.dim == 3 && arithmetic::norm(values(self.turned)).lo() <= 0.0).then_some(size)
    }

    fn sideways(&self) -> Vector {
        let height = self.bars.square_height.value.sqrt();
        self.normal().map(|part| product(product(self.rho.value, height), part))
    }

    /// τ.
    fn tension(&self) -> Interval {
        let alpha = self.bars.alpha.value;
        // α (1 − α) is largest at α = 1/2.
        let off_centre = arithmetic::difference(alpha, Interval::ONE.scale(0.5));
        let quarter = Interval::ONE.scale(0.25);
        let leverage = arithmetic::difference(quarter, squared_or_zero(off_centre));
        quotient(product(self.aside(), leverage), self.bars.square_height.value.sqrt())
    }

    /// Base, and what is taken off it times σ, where that is differentiable.
    fn smooth(&self) -> Option<[Jets<N>; 2]> {
        let height = self.bars.square_height.sqrt();
        let one = Jet::constant(Interval::ONE);
        let leverage = self.bars.alpha * (one - self.bars.alpha) * height.inverse();
        // Both parts have 1/|c| in them, from |f⊥| or from n.
        let root = self.bars.inverse.sqrt();
        let taken = if self.dim == 2 {
            plus(
                times(self.sheer * leverage * root, self.span),
                times(self.rho * height * root, self.turned),
            )
        } else {
            let square = squared(self.turned);
            if square.value.lo() <= 0.0 {
                return None;
            }
            let size = square.sqrt();
            plus(
                times(size * leverage * root, self.span),
                times(self.rho * height * root * size.inverse(), self.off),
            )
        };
        let finite = |jets: &Jets<N>| {
            let parts = jets.iter().flat_map(|jet| jet.slope.iter().chain([&jet.value]));
            parts.into_iter().all(|part| part.mag().is_finite())
        };
        let both = [self.base, taken];
        both.iter().all(finite).then_some(both)
    }
}

/// `a + b` of the parts of two vectors.
pub(super) fn added(to: &mut [Interval], part: Vector) {
    for (sum_so_far, part) in to.iter_mut().zip(part) {
        *sum_so_far = sum(*sum_so_far, part);
    }
}
