//! Positions in which all bars lie in the line between the anchors.
//!
//! Where the lengths fit into the span, $\sum_i \epsilon_i l_i = |D|$ with signs ε, the bars can lie
//! straight. There the closure has no regular derivative, and its zeros at infinity, where pulls
//! of any size along D are parallel to all bars, must be told from equilibria near by.
//!
//! # Anchors not on one vertical
//!
//! Let f = ±D be the direction of the pull, $g$ the normal of f of the same size, and for the pull
//! (q, w) of a chart $a_i = g \cdot F_i = \alpha + \nu c_i w$, $b_i = f \cdot F_i > 0$, $r_i^2 =
//! a_i^2 + b_i^2$, with α = g · q and ν = g · e_z. With $\sum_i s_i l_i = \pm|D|$, exactly, the closure
//! is
//!
//! $$ \sum_i s_i l_i \frac{a_i}{r_i} = 0, \qquad
//!    \sum_i s_i l_i \Bigl(1 - \frac{b_i}{r_i}\Bigr) =
//!    \sum_i s_i l_i \frac{a_i^2}{r_i (r_i + b_i)} = 0. $$
//!
//! The point α = w = 0 is blown up: with α = w ψ, w > 0, the first is $\psi \sum s_i l_i/r_i = -\nu
//! \sum s_i l_i c_i/r_i$, which bounds ψ, and the second
//!
//! $$ \sum_i s_i l_i \frac{(\psi + \nu c_i)^2}{r_i (r_i + b_i)} = 0. $$
//!
//! If the second sum is proved not to vanish over a rectangle about the point, then no equilibrium
//! has its pull there: the straight position is isolated from all equilibria. (For w = 0 the first
//! equation asks for α = 0.) In the limit its sign is that of $\sum s_i l_i (c_i - \bar c)^2$ with
//! the mean $\bar c$ of the weights.
//!
//! Where this signed variance vanishes, exactly, as of bars of 1, 3 and 3 m with equal weights over 1 m, the two
//! sums have a common zero at w = 0. If their derivative by (ψ, w), or by (ψ, w²) between level anchors, is proved
//! to be regular over a rectangle of such, the pair takes no value twice there, and this zero, the straight
//! position itself, is the only one.
//!
//! The straight position itself is then no equilibrium: no force along the line holds a weight
//! across it. It is a singular point of the configurations: with small angles $\theta_i$ they are the
//! cone $\sum \epsilon_i l_i \theta_i = 0$, $\sum \epsilon_i l_i \theta_i^2 = 0$, and the energy changes by
//! $\nu \sum c_i \epsilon_i l_i \theta_i$, which takes both signs on it (the cone is indefinite, since at
//! least two bars point the one way and one the other, and the chain is not taut). So it is no
//! extremum of the energy either.
//!
//! # Anchors on one vertical
//!
//! All forces are then upright with the pull, H = 0, and the straight position is an equilibrium
//! whatever the size of the pull: its forces are a family. That no other equilibrium is near is the
//! business of [`upright`](crate::run::slack::upright). If both anchors are one point, the line may have
//! any direction, and pulls without bound in any direction are zeros of the closure; but only the
//! upright ones are equilibria.

use std::borrow::Cow;
use std::collections::HashMap;

use numerics::Interval;
use serde::Serialize;

use crate::branch_and_bound::hull;
use crate::run::closure::bar::size;
use crate::run::closure::{Pattern, signed};
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;
use crate::run::slack::moments::Exact;
use crate::run::slack::upright::{upright_alone, upright_or_infinite};

/// A position in which all bars lie in the line between the anchors.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StraightPosition {
    /// +1 for each bar that points from the first anchor to the last, −1 for each that points back.
    pub along: Vec<i8>,
    /// Whether it is an equilibrium, with any force along it: it hangs in the vertical through both
    /// anchors. Else no force holds it.
    pub upright: bool,
}

/// The largest rectangle about a pull without bound, in the coordinates of its chart, and the part
/// of one that is tried next.
const LARGEST: f64 = 1.0 / 8.0;
const NEXT: f64 = 0.25;
/// Rectangles tried; the smallest is 2⁻²¹ wide.
const RECTANGLES: usize = 10;

/// All of them, and the pulls that are settled with them.
#[derive(Debug, Default)]
pub(crate) struct Straight {
    /// By pattern of the bars that point back.
    pub(crate) positions: Vec<StraightPosition>,
    settled: Vec<Settled>,
    /// The lengths as integers.
    lengths: Vec<i128>,
    /// The ways to fit, sorted.
    fits: Vec<Pattern>,
    /// Between anchors in one point, by pattern that fits: the order of the first moment that does
    /// not vanish.
    first: HashMap<Pattern, u32>,
}

/// Rectangles about a pull without bound, one for each pattern, that hold no equilibrium with these
/// signs.
#[derive(Debug)]
struct Settled {
    cells: HashMap<Pattern, Cell>,
    /// Around all of them, on the same chart.
    hull: Cell,
}

impl Settled {
    fn new(cells: HashMap<Pattern, Cell>) -> Option<Self> {
        let unite = |all: Cell, cell: &Cell| Cell { face: all.face, at: hull(all.at, cell.at) };
        let first = *cells.values().next()?;
        let hull = cells.values().fold(first, unite);
        Some(Self { cells, hull })
    }
}

impl Straight {
    /// All straight positions of a chain.
    pub(crate) fn of(system: &System, exact: &Exact) -> Self {
        let Some(sides) = &exact.sides else { return Self::default() };
        let fits = sides.fits();
        let bars = system.bars();
        let all = (1_u32 << bars) - 1;
        let (mut settled, moments) = (vec![], exact.moments.as_ref());
        if !system.vertical {
            // Along the line, and against it with all signs turned.
            for (way, turned) in [(1, 0), (-1, all)] {
                let patterns = fits.iter().map(|pattern| Pattern(pattern.0 ^ turned));
                let cells = patterns.filter_map(|p| {
                    let none = moments.and_then(|m| m.is_without_variance(p)) == Some(true);
                    Some((p, isolated(system, p, way, none)?))
                });
                settled.extend(Settled::new(cells.collect()));
            }
        }
        let positions = fits.iter().map(|pattern| StraightPosition {
            along: pattern.signs(bars).collect(),
            upright: system.vertical,
        });
        let mut first = HashMap::new();
        if is_one_point(system)
            && let Some(moments) = moments
        {
            first = fits.iter().filter_map(|p| Some((*p, moments.first(*p)?))).collect();
        }
        let (positions, lengths) = (positions.collect(), sides.lengths.clone());
        Self { positions, settled, lengths, fits, first }
    }

    /// The patterns that may have equilibria in a cell besides the straight ones.
    pub(crate) fn left<'a>(
        &self,
        system: &System,
        cell: &Cell,
        patterns: Cow<'a, [Pattern]>,
    ) -> Cow<'a, [Pattern]> {
        let mut left = patterns;
        for Settled { cells, hull } in &self.settled {
            let Some(near) = cell.on(hull.face, system).filter(|near| hull.encloses(near)) else {
                continue;
            };
            left.to_mut().retain(|p| !cells.get(p).is_some_and(|cell| cell.encloses(&near)));
        }
        if self.are_near(system, cell) {
            left.to_mut().retain(|pattern| {
                !upright_alone(system, cell, *pattern, &self.fits, &self.lengths)
            });
            left.to_mut().retain(|pattern| {
                let first = self.first.get(pattern).copied();
                !upright_or_infinite(system, cell, *pattern, first)
            });
        }
        left
    }

    /// Whether a cell is next to pulls that are no isolated zeros of the closure: the upright ones,
    /// and between anchors in one point the infinite ones. There the closure vanishes to all its
    /// digits, and what is left of it when that is divided out decides.
    pub(crate) fn are_near(&self, system: &System, cell: &Cell) -> bool {
        /// 2⁻⁶
        const NEAR: f64 = 1.0 / 64.0;
        if !system.vertical || self.positions.is_empty() {
            return false;
        }
        let [h, _, w] = cell.homogeneous();
        h.mag() <= NEAR || h.contains(0.0) || is_one_point(system) && w.mag() <= NEAR
    }
}

fn is_one_point(system: &System) -> bool {
    system.vertical && system.span[1] == Interval::ZERO
}

/// A rectangle about the pull along the span, or against it, without an equilibrium of a pattern,
/// whose signed variance of the weights may be known to vanish.
fn isolated(system: &System, pattern: Pattern, way: i8, no_variance: bool) -> Option<Cell> {
    let f = system.span.map(|part| signed(way, part));
    // The chart on which the pull is largest.
    let along = usize::from(f[1].mid().abs() > f[0].mid().abs());
    let face = match (along, f[along].sign()?) {
        (0, 1) => Face::Right,
        (0, _) => Face::Left,
        (_, 1) => Face::Above,
        (_, _) => Face::Below,
    };
    let centre = (f[1 - along] / f[along].abs()).mid();
    let mut size = LARGEST;
    for _ in 0..RECTANGLES {
        let at = [Interval::around(centre, size), Interval::new(-size, size)];
        let cell = Cell { face, at };
        if is_isolated(system, &cell, f, pattern, no_variance) == Some(true) {
            return Some(cell);
        }
        size *= NEXT;
    }
    None
}

/// Whether the blown-up closure has no zero over a rectangle but the straight position.
fn is_isolated(
    system: &System,
    cell: &Cell,
    f: [Interval; 2],
    pattern: Pattern,
    no_variance: bool,
) -> Option<bool> {
    let along = |[x, z]: [Interval; 2]| f[0] * x + f[1] * z;
    let whole = size(f);
    let nu = f[0];
    let mut terms = vec![];
    let (mut turn, mut lean) = (Interval::ZERO, Interval::ZERO);
    let bars = system.length.iter().zip(&system.weight);
    for ((length, weight), sign) in bars.zip(pattern.signs(system.bars())) {
        let force = cell.force(*weight);
        let b = along(force);
        let r = whole * size(force);
        if b.lo() <= 0.0 {
            return None;
        }
        let part = signed(sign, *length / r);
        turn = turn + part;
        lean = lean + part * *weight;
        terms.push((signed(sign, *length / (r * (r + b))), nu * *weight));
    }
    if turn.contains(0.0) {
        return None;
    }
    let psi = -(nu * lean / turn);
    if no_variance {
        // The weights in the unit in which the pull is as long as f.
        let [h, v, w] = cell.homogeneous();
        let most = w / along([h, v]) * whole.square();
        let over = [psi, Interval::ZERO.hull(Interval::point(most.hi()))];
        let [[a, b], [c, d]] = derivative(system, pattern, f, over)?;
        return Some(!(a * d - b * c).contains(0.0));
    }
    let second: Interval = terms.into_iter().map(|(part, c)| part * (psi + c).square()).sum();
    Some(!second.contains(0.0))
}

/// The derivative of the blown-up closure by (ψ, w), or by (ψ, w²) between level anchors: with
/// $a = w (\psi + f_x c)$, $b = |f|^2 + w f_z c$ and $r^2 = a^2 + b^2$ for each bar, of the sums of
/// $s l (\psi + f_x c)/r$ and of $s l (\psi + f_x c)^2/(r (r + b))$. The pull is $f + w \psi g/|f|^2$.
fn derivative(
    system: &System,
    pattern: Pattern,
    f: [Interval; 2],
    [psi, w]: [Interval; 2],
) -> Option<[[Interval; 2]; 2]> {
    let level = f[1] == Interval::ZERO;
    let two = Interval::point(2.0);
    let mut sums = [[Interval::ZERO; 2]; 2];
    let bars = pattern.signs(system.bars()).zip(&system.length).zip(&system.weight);
    for ((sign, length), weight) in bars {
        let (lean, down) = (psi + f[0] * *weight, f[1] * *weight);
        let b = f[0].square() + f[1].square() + if level { Interval::ZERO } else { w * down };
        if b.lo() <= 0.0 {
            return None;
        }
        let r = (w.square() * lean.square() + b.square()).sqrt();
        let of_a = if level { lean.square() } else { two * w * lean.square() };
        let of_b = if level { Interval::ZERO } else { down };
        // By the coordinates, of r and of r (r + b).
        let of_r = [w.square() * lean / r, (of_a + two * b * of_b) / (two * r)];
        let whole = r * (r + b);
        let of_whole = [0, 1].map(|k| {
            let twice = of_r[k] * (two * r + b);
            if k == 0 { twice } else { twice + r * of_b }
        });
        let length = signed(sign, *length);
        let own = [Interval::ONE / r, two * lean / whole];
        for k in 0..2 {
            let first = -(lean * of_r[k] / r.square());
            let second = -(lean.square() * of_whole[k] / whole.square());
            let [of_first, of_second] = if k == 0 { own } else { [Interval::ZERO; 2] };
            sums[0][k] = sums[0][k] + length * (of_first + first);
            sums[1][k] = sums[1][k] + length * (of_second + second);
        }
    }
    Some(sums)
}

#[cfg(test)]
mod tests {
    use model::Bar;

    use super::*;
    use crate::run::plane::loads::JointLoads;

    /// Equal bars, to this anchor.
    fn system(bars: usize, end_m: [f64; 3]) -> System {
        let chain = samples::homogeneous(10.0, &vec![(1.0, 1.0); bars], end_m).into_chain();
        System::new(&chain, JointLoads::NONE)
    }

    #[test]
    fn one_point_is_neither_level_nor_upright() {
        assert!(is_one_point(&system(3, [0.0; 3])));
        assert!(!is_one_point(&system(3, [0.0, 0.0, 1.0])));
        assert!(!is_one_point(&system(3, [1.0, 0.0, 0.0])));
    }

    /// Weights −1, 0, 1 and lengths 1: with the signs + + − the mean of the weights is −2 and the
    /// signed variance 0 − 2²; with + − + the mean is 0 and the variance 2. Where as many bars point
    /// back as forth there is no mean.
    #[test]
    fn straight_positions_are_isolated_where_the_weights_vary() {
        let level = system(3, [1.0, 0.0, 0.0]);
        for pattern in [0b001, 0b010, 0b100] {
            for (way, turned) in [(1, 0), (-1, 0b111)] {
                let cell = isolated(&level, Pattern(pattern ^ turned), way, false);
                let face = if way > 0 { Face::Right } else { Face::Left };
                let Cell { face: found, at } = cell.unwrap();
                assert_eq!(found, face, "{pattern:03b}");
                assert!(at[0].contains(0.0) && at[1].contains(0.0) && at[0].width() > 1e-3);
            }
        }
        let even = system(4, [1.0, 0.0, 0.0]);
        assert!(isolated(&even, Pattern(0b0110), 1, false).is_none());
    }

    /// Three bars over 1 m, each with its weight at its end.
    fn with_weights_at_ends(lengths: [f64; 3]) -> System {
        let bars = lengths.map(|length| Bar::new(length, 1.0, length, [0.0; 3]).unwrap());
        System::new(samples::of_bars(10.0, bars, [1.0, 0.0, 0.0]).chain(), JointLoads::NONE)
    }

    /// Weights −1, 0, 1 and lengths 1, 3, 3 with the signs + − +: the moments are 1, 2 and 4, the
    /// signed variance 4 − 2² is nothing, and nothing is said.
    #[test]
    fn straight_positions_without_variance_are_not_isolated() {
        let system = with_weights_at_ends([1.0, 3.0, 3.0]);
        for (way, pattern) in [(1, 0b010), (-1, 0b101)] {
            assert!(isolated(&system, Pattern(pattern), way, false).is_none());
        }
    }

    /// The same weights with lengths 1, 4, 4: the moments are 1, 3 and 5, and the signed variance
    /// 5 − 3² is −4. About a mean of 1 it would be 4 − 4, nothing.
    #[test]
    fn the_variance_is_about_the_mean_of_the_weights() {
        let system = with_weights_at_ends([1.0, 4.0, 4.0]);
        for (way, pattern) in [(1, 0b010), (-1, 0b101)] {
            assert!(isolated(&system, Pattern(pattern), way, false).is_some());
        }
    }

    /// Weights −1, 0, 3 and lengths 1, 2, 1 over 2 m with the signs − + +: the moments are 2, 4 and 8, and the signed
    /// variance 2 · 8 − 4² is nothing; with a weight of 5/2 it is 2 · 21/4 − (7/2)².
    #[test]
    fn the_mean_is_of_lengths_that_differ() {
        let system = |mass_kg: f64| {
            let bar = |length: f64, mass_kg| Bar::new(length, mass_kg, length, [0.0; 3]).unwrap();
            let bars = [bar(1.0, 1.0), bar(2.0, mass_kg), bar(1.0, 1.0)];
            System::new(samples::of_bars(10.0, bars, [2.0, 0.0, 0.0]).chain(), JointLoads::NONE)
        };
        for (way, pattern) in [(1, 0b100), (-1, 0b011)] {
            assert!(isolated(&system(3.0), Pattern(pattern), way, false).is_none());
            assert!(isolated(&system(2.5), Pattern(pattern), way, false).is_some());
        }
    }

    /// Against differences of the formulas.
    #[test]
    fn the_blown_up_closure_has_its_derivative() {
        let problem = model::cases::get("five-in-space").unwrap().problem();
        let system = System::new(problem.chain(), JointLoads::NONE);
        let pattern = Pattern(0b01001);
        for f in [[0.75, 0.5], [-0.75, 0.5], [0.75, -0.25], [0.75, 0.0], [-0.5, 0.0]] {
            let level = f64::abs(f[1]) <= 0.0;
            let by_formula = |psi: f64, w: f64| {
                let mut sums = [0.0; 2];
                let bars = pattern.signs(system.bars()).zip(&system.length).zip(&system.weight);
                for ((sign, length), weight) in bars {
                    let (length, c) = (f64::from(sign) * length.mid(), weight.mid());
                    let lean = psi + f[0] * c;
                    let b = f[0] * f[0] + f[1] * f[1] + w * f[1] * c;
                    let r = (w * lean).hypot(b);
                    sums[0] += length * lean / r;
                    sums[1] += length * lean * lean / (r * (r + b));
                }
                sums
            };
            let (psi, w, step) = (0.375, 0.25, 1e-5);
            let at = [psi, w].map(Interval::point);
            let found = derivative(&system, pattern, f.map(Interval::point), at).unwrap();
            let by_psi = [by_formula(psi + step, w), by_formula(psi - step, w)];
            let by_w = [by_formula(psi, w + step), by_formula(psi, w - step)];
            // Between level anchors the second coordinate is w².
            let unit = if level { 2.0 * w } else { 1.0 };
            for k in 0..2 {
                let close = |found: Interval, wanted: f64| {
                    assert!((found.mid() - wanted).abs() < 1e-7, "{f:?} {k}: {found:?} {wanted}");
                };
                close(found[k][0], (by_psi[0][k] - by_psi[1][k]) / (2.0 * step));
                close(found[k][1], (by_w[0][k] - by_w[1][k]) / (2.0 * step * unit));
            }
        }
    }

    /// With its weight at the end of each, the straight position of bars of 1, 3 and 3 m over 1 m, whose signed
    /// variance vanishes, is the only zero.
    #[test]
    fn straight_positions_without_variance_are_isolated_where_that_is_known() {
        let system = with_weights_at_ends([1.0, 3.0, 3.0]);
        for (way, pattern) in [(1, 0b010), (-1, 0b101)] {
            assert!(isolated(&system, Pattern(pattern), way, true).is_some(), "{way}");
        }
    }
}
