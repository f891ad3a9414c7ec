//! How many zeros two functions of two variables have in a box, counted with multiplicity.
//!
//! Where the derivative of (g, h) has rank one, g can be chosen so that its zeros in the box are
//! one arc, a graph over one of the coordinates. The zeros of the pair are those of h along the
//! arc, and the derivative along it is, but for a positive factor,
//!
//! $$ L f = g_x f_y - g_y f_x . $$
//!
//! If $L^k h$ does not vanish in the box, then h has at most k zeros on the arc, counted with
//! multiplicity, by Rolle's theorem. (L f = w · df/ds with a factor w of one sign: if h had k + 1 zeros,
//! L h had k, and so on.) A multiplicity along the arc is that of the zero of the pair: the dimension
//! of the local ring of (g, h), since g can be taken as a coordinate. The signs of h at the ends of the
//! arc are the degree, and the parity of the number.
//!
//! A fold has k = 2, a fold of folds or a merger of three by symmetry k = 3.
//!
//! # References
//!
//! M. Golubitsky, D. G. Schaeffer, "Singularities and Groups in Bifurcation Theory" I (1985),
//! chapters I and II, doi:10.1007/978-1-4612-5034-0; V. I. Arnold, S. M. Gusein-Zade, A. N.
//! Varchenko, "Singularities of Differentiable Maps" I (1985), chapters 4 and 5,
//! doi:10.1007/978-1-4612-5154-5

use numerics::Interval;

use crate::degenerate::maps::Pair;
use crate::degenerate::series::{ORDER, Series};

/// What is proved of the zeros in a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Counted {
    /// The box.
    pub(crate) at: [Interval; 2],
    /// At most so many, counted with multiplicity.
    pub(crate) at_most: usize,
    /// The degree of the map on the border of the box: zeros where the determinant of the
    /// derivative is positive less those where it is negative. The number of zeros has the same
    /// parity.
    pub(crate) degree: i8,
}

/// The smallest room around the box that is tried, and the largest.
const SMALLEST: f64 = f64::from_bits((1023 - 44) << 52);
const LARGEST: f64 = 1.0 / 8.0;

type Map<'a> = &'a dyn Fn([Interval; 2]) -> Pair;

/// The counts in larger and larger boxes around a given one, where they succeed.
fn counts(map: Map<'_>, around: [Interval; 2]) -> impl Iterator<Item = Counted> {
    let rooms = std::iter::successors(Some(SMALLEST), |room| Some(2.0 * room));
    let count = move |room| Arc::through(map, around, room).and_then(|arc| arc.count());
    rooms.take_while(|room| *room <= LARGEST).filter_map(count)
}

/// Count the zeros in a box around a given one.
pub(crate) fn count(map: Map, around: [Interval; 2]) -> Option<Counted> {
    counts(map, around).next()
}

/// The largest box around a given one in which there are at most so many zeros.
pub(crate) fn widest(map: Map, around: [Interval; 2], at_most: usize) -> Option<Counted> {
    counts(map, around).filter(|counted| counted.at_most == at_most).last()
}

/// The zeros of g in a box: n as a function of t.
struct Arc<'a> {
    map: Map<'a>,
    at: [Interval; 2],
    /// Which coordinates t and n are.
    t: usize,
    n: usize,
    /// Of the two functions, the parts that make g and h; their determinant is positive.
    g: [f64; 2],
    h: [f64; 2],
    /// Over the box.
    pair: [Series; 2],
    /// The sign of g_n.
    rising: i8,
}

/// A part of one function and a part of the other.
fn combined(parts: [f64; 2], pair: &[Series; 2]) -> Series {
    pair[0].scaled(Interval::point(parts[0])) + pair[1].scaled(Interval::point(parts[1]))
}

impl<'a> Arc<'a> {
    /// The arc in a box with that much room around another, if it crosses the box from end to end.
    fn through(map: Map<'a>, around: [Interval; 2], room: f64) -> Option<Self> {
        let middle = around.map(|part| Interval::point(part.mid()));
        let [a, b] = map(middle)?.map(|series| series.gradient().map(Interval::mid));
        // The direction in which the derivative is largest: an eigenvector of J Jᵀ.
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let angle = 0.5 * (2.0 * dot(a, b)).atan2(dot(a, a) - dot(b, b));
        let (sin, cos) = angle.sin_cos();
        let (g, h) = ([cos, sin], [-sin, cos]);
        let slope: [f64; 2] = std::array::from_fn(|k| cos * a[k] + sin * b[k]);
        let n = usize::from(slope[1].abs() > slope[0].abs());
        let t = 1 - n;
        let lean = (slope[t] / slope[n]).abs();
        if !lean.is_finite() {
            return None;
        }
        let mut at = around;
        let radius = around[t].rad() + room;
        at[t] = Interval::around(around[t].mid(), radius);
        at[n] = Interval::around(around[n].mid(), around[n].rad() + (lean + 0.5) * radius);
        let pair = map(at)?;
        let pair = [combined(g, &pair), combined(h, &pair)];
        let rising = pair[0].gradient()[n].sign().filter(|sign| *sign != 0)?;
        let arc = Self { map, at, t, n, g, h, pair, rising };
        let side = |end: f64| {
            let mut edge = at;
            edge[n] = Interval::point(end);
            arc.value(arc.g, edge, 0)?.sign()
        };
        (side(at[n].lo())? == -rising && side(at[n].hi())? == rising).then_some(arc)
    }

    /// One of the functions over a part of the box, in mean value form.
    fn value(&self, parts: [f64; 2], at: [Interval; 2], which: usize) -> Option<Interval> {
        let middle = at.map(|part| Interval::point(part.mid()));
        let slope = self.pair[which].gradient();
        let moved: Interval = (0..2).map(|k| slope[k] * (at[k] - middle[k])).sum();
        Some(combined(parts, &(self.map)(middle)?).value() + moved)
    }

    /// The sign of h where the arc ends.
    fn sign_at(&self, t: f64) -> Option<i8> {
        /// Contractions: each gains digits, and a few use them up.
        const ROUNDS: usize = 8;
        let mut at = self.at;
        at[self.t] = Interval::point(t);
        let slope = self.pair[0].gradient()[self.n];
        for _ in 0..ROUNDS {
            let middle = Interval::point(at[self.n].mid());
            let mut point = at;
            point[self.n] = middle;
            let step = self.value(self.g, point, 0)? / slope;
            at[self.n] = at[self.n].intersect(middle - step)?;
        }
        self.value(self.h, at, 1)?.sign().filter(|sign| *sign != 0)
    }

    fn count(&self) -> Option<Counted> {
        let [g, mut f] = self.pair;
        let mut at_most = 0;
        while f.value().contains(0.0) {
            at_most += 1;
            if at_most > ORDER {
                return None;
            }
            f = g.derivative(0) * f.derivative(1) - g.derivative(1) * f.derivative(0);
        }
        let ends = [self.at[self.t].lo(), self.at[self.t].hi()].map(|t| self.sign_at(t));
        let (before, after) = (ends[0]?, ends[1]?);
        // Along the arc dh/dt = −det ∂(g, h)/∂(t, n) / g_n.
        let turned = if self.t == 0 { 1 } else { -1 };
        let degree = -self.rising * turned * ((after - before) / 2);
        if at_most % 2 != usize::from(degree != 0) {
            // The number is of the parity of the degree.
            at_most = at_most.checked_sub(1)?;
        }
        Some(Counted { at: self.at, at_most, degree })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// x and y about the origin, turned so that no axis is special.
    fn turned(at: [Interval; 2]) -> [Series; 2] {
        let [x, y] = [Series::variable(at[0], 0), Series::variable(at[1], 1)];
        let part = |a: f64, b: f64| x.scaled(Interval::point(a)) + y.scaled(Interval::point(b));
        [part(0.8, 0.6), part(-0.6, 0.8)]
    }

    fn constant(x: f64) -> Series {
        Series::constant(Interval::point(x))
    }

    /// Polynomials along the parabola n = t²: their zeros are known.
    #[test]
    fn polynomials_have_the_zeros_that_they_have() {
        type Polynomial = fn(Series) -> Series;
        let cases: [(Polynomial, usize, i8); 7] = [
            (|t| t, 1, 1),
            (|t| t * t - constant(1e-12), 2, 0),
            (|t| t * t + constant(1e-12), 2, 0),
            (|t| t * t, 2, 0),
            (|t| -(t * t * t), 3, -1),
            (|t| t * t * t * t - constant(1e-20) * t, 4, 0),
            (|t| t * t * t * t * t, ORDER, 1),
        ];
        for (number, (polynomial, at_most, degree)) in cases.into_iter().enumerate() {
            let map = |at: [Interval; 2]| {
                let [t, n] = turned(at);
                // (p(t), n − t²) has the determinant p'(t).
                Some([polynomial(t) + (n - t * t).scaled(Interval::point(2.0)), n - t * t])
            };
            let counted = count(&map, [Interval::around(0.0, 1e-9); 2]).unwrap();
            assert_eq!((counted.at_most, counted.degree), (at_most, degree), "{number}");
        }
    }

    /// The arc 2 y = x leans by 1/2: a box is wide enough for it, and half as wide again.
    #[test]
    fn the_box_follows_the_lean_of_the_arc() {
        let map = |at: [Interval; 2]| {
            let [x, y] = [Series::variable(at[0], 0), Series::variable(at[1], 1)];
            Some([x * x, y.scaled(Interval::point(2.0)) - x])
        };
        let radius = 1e-9;
        let counted = count(&map, [Interval::around(0.0, radius); 2]).unwrap();
        assert_eq!((counted.at_most, counted.degree), (2, 0));
        let [along, across] = counted.at.map(Interval::rad);
        let room = along - radius;
        assert!(room > 0.0);
        assert!((across / (radius + (0.5 + 0.5) * along) - 1.0).abs() < 1e-9, "{across} {along}");
    }

    #[test]
    fn nothing_is_said_of_a_zero_without_derivative() {
        let map = |at: [Interval; 2]| {
            let [x, y] = turned(at);
            Some([x * x - y * y, x * y])
        };
        assert_eq!(count(&map, [Interval::around(0.0, 1e-9); 2]), None);
    }

    /// `x + 2 y` and `y` have the derivatives (1, 2) and (0, 1): their largest part is that at 22.5°,
    /// and leans by the tangent of it, √2 - 1.
    #[test]
    fn the_arc_is_that_of_the_largest_derivative() {
        let map = |at: [Interval; 2]| {
            let [x, y] = [Series::variable(at[0], 0), Series::variable(at[1], 1)];
            Some([x + y.scaled(Interval::point(2.0)), y])
        };
        let (radius, room) = (1e-9, 3e-9);
        let arc = Arc::through(&map, [Interval::around(0.0, radius); 2], room).unwrap();
        assert_eq!((arc.t, arc.n, arc.rising), (0, 1, 1));
        let lean = 2.0_f64.sqrt() - 1.0;
        let [along, across] = arc.at.map(Interval::rad);
        assert!((along / (radius + room) - 1.0).abs() < 1e-9, "{along}");
        let wanted = radius + (lean + 0.5) * (radius + room);
        assert!((across / wanted - 1.0).abs() < 1e-9, "{across} {wanted}");
    }

    /// Where the arc passes above or below the box, or leaves it, it does not go through.
    #[test]
    fn an_arc_goes_through_from_end_to_end() {
        let through = |aside: f64, rising: f64| {
            let map = |at: [Interval; 2]| {
                let [x, y] = [Series::variable(at[0], 0), Series::variable(at[1], 1)];
                Some([
                    (y - constant(aside)).scaled(Interval::point(rising)),
                    x.scaled(Interval::point(0.5)),
                ])
            };
            Arc::through(&map, [Interval::around(0.0, 1e-9); 2], 1e-9).map(|arc| arc.rising)
        };
        for rising in [2.0, -2.0] {
            assert!(through(0.0, rising).is_some());
            for aside in [1e-8, -1e-8] {
                assert!(through(aside, rising).is_none(), "{aside}");
            }
        }
    }
}
