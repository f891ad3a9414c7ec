//! One box and one pattern: excluded, narrowed, or proved to hold one equilibrium at most.

use numerics::Interval;

use super::cell::{self, Cell, Pattern};
use super::layout::{Layout, Swing};
use super::newton::{Newton, around, step, zero};
use super::swing::Swung;
use super::unknown_forces::{Columns, Forces};
use crate::boxes::arithmetic::{Vector, cross, dot, minus, norm, plus, times};

/// What is known of a box for a pattern.
pub(super) enum Verdict<const N: usize> {
    Empty,
    /// All equilibria of the box lie in this part of it.
    Within([Interval; N]),
    /// No other equilibrium than the one next to a point lies in a box, which has this one in it.
    One(Found<N>),
}

/// Next to the only equilibrium of a box with its pattern.
#[derive(Debug, Clone)]
pub(super) struct Found<const N: usize> {
    pub(super) pattern: Pattern,
    pub(super) alone_in: [Interval; N],
    pub(super) at: [f64; N],
    /// Forces, or force densities, of the links.
    pub(super) densities: Vec<f64>,
}

/// A box with what all patterns share.
pub(super) struct Examined<'a, const N: usize> {
    cell: Cell<'a, N>,
    columns: Columns,
    rough: Vec<Option<[Vector; 2]>>,
    middle: Option<Cell<'a, N>>,
}

impl<'a, const N: usize> Examined<'a, N> {
    /// Nothing where bars cannot meet.
    pub(super) fn new(layout: &'a Layout, at: [Interval; N]) -> Option<Self> {
        let cell = Cell::over(layout, at)?;
        let columns = Columns::new(&cell);
        let rough = cell.rough_parts(&columns.unbounded);
        let middle = if cell.smooth() {
            Cell::over(layout, at.map(|part| Interval::point(part.mid())))
        } else {
            None
        };
        Some(Self { cell, columns, rough, middle: middle.filter(Cell::smooth) })
    }

    pub(super) fn pattern(&self, pattern: Pattern) -> Verdict<N> {
        if self.swing_is_impossible(pattern) {
            return Verdict::Empty;
        }
        if self.cell.swung.iter().any(|swung| swung.folded) {
            return Verdict::Within(self.cell.at);
        }
        let loads = self.cell.rough(&self.rough, pattern, None);
        let densities = match self.columns.forces(&self.cell, pattern, &loads) {
            Forces::Impossible => return Verdict::Empty,
            Forces::Unknown => return Verdict::Within(self.cell.at),
            Forces::Within(densities) => densities,
        };
        let Some(middle) = &self.middle else { return Verdict::Within(self.cell.at) };
        match newton(&self.cell, middle, pattern, &densities) {
            None => Verdict::Within(self.cell.at),
            Some(Newton { left: None, .. }) => Verdict::Empty,
            Some(Newton { left: Some(left), single }) => {
                let found = if single { self.one(pattern, &densities) } else { None };
                found.map_or(Verdict::Within(self.cell.places(&left)), Verdict::One)
            }
        }
    }

    /// Whether the force of some swing alone is proved impossible at one of its ends.
    fn swing_is_impossible(&self, pattern: Pattern) -> bool {
        let cell = &self.cell;
        let swings = || cell.layout.swings.iter().zip(&cell.swung).enumerate();
        swings().any(|(number, (swing, swung))| {
            if !swung.near && swung.round.is_none() {
                return false;
            }
            let loads = cell.rough(&self.rough, pattern, Some(number));
            (0..2).any(|end| {
                let Some(row) = cell.rows(swing.ends[end]) else { return false };
                let folds = |other: &(usize, (&Swing, &Swung<N>))| {
                    let (k, (other, swung)) = *other;
                    k != number && swung.folded && other.ends.contains(&swing.ends[end])
                };
                let known = swings().all(|other| !folds(&other))
                    && self.columns.free_but_of(number, row..row + cell.layout.dim);
                let pull = cell.at_rows(&loads, row);
                let sign = f64::from(cell::sign(pattern, number));
                known
                    && (swung.near && folded_is_impossible(swing, swung, end, pull)
                        || round_is_impossible(swing, swung, end, pull, sign))
            })
        })
    }

    /// The proof that one equilibrium at most is in a box around this one and the zero next to it.
    fn one(&self, pattern: Pattern, densities: &[Interval]) -> Option<Found<N>> {
        let layout = self.cell.layout;
        let coordinates = layout.coordinates();
        let places = &self.cell.at[..coordinates];
        let start = places.iter().chain(densities).map(|part| part.mid()).collect();
        let found = zero(start, |unknowns| {
            let cell = Cell::over(layout, self.cell.places(unknowns)).filter(Cell::smooth)?;
            let densities = &unknowns[coordinates..];
            Some((cell.residual(pattern, densities), cell.derivative(pattern, densities)))
        })?;
        let alone_in = self.cell.places(&around(places, &found)?);
        let wider = Examined::new(layout, alone_in)?;
        if wider.cell.swung.iter().any(|swung| swung.folded) {
            return None;
        }
        let loads = wider.cell.rough(&wider.rough, pattern, None);
        let Forces::Within(bounds) = wider.columns.forces(&wider.cell, pattern, &loads) else {
            return None;
        };
        let newton = newton(&wider.cell, wider.middle.as_ref()?, pattern, &bounds)?;
        let at = std::array::from_fn(|k| if k < coordinates { found[k] } else { 0.0 });
        let densities = found[coordinates..].to_vec();
        newton.single.then_some(Found { pattern, alone_in, at, densities })
    }
}

/// Two bars all but folded onto each other, $a \approx b$: with the pull $G = w_2 r$ at b, $|r| =
/// l_2$, balance $f = (w_1 + w_2) r + w_1 c$ gives $|G \times f| = |w_1| |G \times c|$, and
/// $|w_1| l_1 \le |f| + |G|$. So G is all but parallel to f where c is small; if the other forces
/// at b are not, no equilibrium is there.
fn folded_is_impossible<const N: usize>(
    swing: &Swing,
    swung: &Swung<N>,
    end: usize,
    pull: Vector,
) -> bool {
    let (size, load) = (norm(pull), norm(swing.load));
    let density = (size + load) / swing.lengths[1 - end];
    let most = size * density * norm(swung.span);
    norm(cross(pull, swing.load)).lo() > most.hi()
}

/// Where the joint may go round freely n is any direction, but of the size 1: the other forces at
/// an end, with what the swing pulls there besides, are as large as $\varrho h n$, and across c.
fn round_is_impossible<const N: usize>(
    swing: &Swing,
    swung: &Swung<N>,
    end: usize,
    pull: Vector,
    sign: f64,
) -> bool {
    let Some(size) = swung.round.filter(|_| swung.tension.mag().is_finite()) else { return false };
    let tension = if sign < 0.0 { -swung.tension } else { swung.tension };
    let along = times(tension, swung.span);
    let rest = if end == 1 {
        minus(plus(pull, swung.base), along)
    } else {
        plus(plus(pull, minus(swing.load, swung.base)), along)
    };
    norm(rest).disjoint(size) || !dot(rest, swung.span).contains(0.0)
}

/// A step over a box: nothing where the derivative has no inverse.
fn newton<const N: usize>(
    cell: &Cell<N>,
    middle: &Cell<N>,
    pattern: Pattern,
    densities: &[Interval],
) -> Option<Newton> {
    let middles: Vec<Interval> = densities.iter().map(|w| Interval::point(w.mid())).collect();
    let slope = cell.derivative(pattern, densities);
    let places = &cell.at[..cell.layout.coordinates()];
    let whole: Vec<Interval> = places.iter().chain(densities).copied().collect();
    step(&whole, &slope, &middle.residual(pattern, &middles))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::arithmetic::points;
    use crate::boxes::equations::Acting;
    use crate::net::knots::layout::{End, Link};

    fn swing(lengths: [f64; 2], load: [f64; 3]) -> Swing {
        Swing {
            joint: 0,
            members: [0, 1],
            ends: [End::Held(points([0.0; 3])); 2],
            lengths: lengths.map(Interval::point),
            load: points(load),
        }
    }

    /// A knot that bears 1, on strands from these places.
    fn hung(strands: &[([f64; 3], [f64; 2])]) -> Layout {
        let swing = |(at, lengths): &([f64; 3], [f64; 2])| Swing {
            ends: [End::Held(points(*at)), End::Knot(0)],
            ..swing(*lengths, [0.0, 0.0, -1.0])
        };
        Layout {
            dim: 3,
            axes: [0, 1, 2],
            axis: None,
            knots: vec![0],
            loads: vec![points([0.0, 0.0, -1.0])],
            swings: strands.iter().map(swing).collect(),
            links: vec![],
        }
    }

    /// Two equal bars folded onto each other hold a knot at their anchor, and the one strand that is
    /// left draws it aside, or pushes it: they cannot pull level. Where others are folded there,
    /// too, nobody knows what these pull.
    #[test]
    fn folded_bars_do_not_hold_what_draws_aside() {
        let at = [Interval::around(0.0, 1e-6); 3];
        let [folded, aside] = [([0.0; 3], [1.0; 2]), ([2.0, 0.0, 0.0], [1.5, 1.0])];
        let is_empty = |layout: &Layout, pattern: u32| {
            let examined = Examined::new(layout, at).unwrap();
            matches!(examined.pattern(pattern), Verdict::Empty)
        };
        for strands in [[folded, aside], [aside, folded]] {
            assert!((0..4).all(|pattern| is_empty(&hung(&strands), pattern)));
        }
        assert!(!(0..8).any(|pattern| is_empty(&hung(&[folded, folded, aside]), pattern)));
        // Nor what a bar does.
        let ends = [End::Held(points([0.0, 2.0, 0.0])), End::Knot(0)];
        let (length, compliance) = (Interval::point(2.0), Interval::ZERO);
        let acting = Acting { member: 0, spans: 0..1, length, compliance, force: 0 };
        let range = Interval::LINE;
        let links = vec![Link { acting, ends: vec![ends], range, hanging: None }];
        let barred = Layout { links, ..hung(&[folded, aside]) };
        assert!(!(0..4).any(|pattern| is_empty(&barred, pattern)));
    }

    fn swung(span: [f64; 3]) -> Swung<3> {
        Swung {
            base: points([1.0, 0.0, 0.0]),
            sideways: points([0.0; 3]),
            span: points(span),
            tension: Interval::point(2.0),
            smooth: None,
            folded: false,
            near: true,
            round: Some(Interval::ONE),
        }
    }

    /// A load of 1 and a pull of 4 across it, bars of 2 and 3: |G × f| = 4 is more than
    /// 4 (4 + 1)/3 |c| for |c| < 3/5, and than 4 (4 + 1)/2 |c| for |c| < 2/5.
    #[test]
    fn folded_bars_pull_along_the_load() {
        let swing = swing([2.0, 3.0], [0.0, 0.0, -1.0]);
        let impossible = |span: f64, end: usize, pull: [f64; 3]| {
            folded_is_impossible(&swing, &swung([span, 0.0, 0.0]), end, points(pull))
        };
        let across = [4.0, 0.0, 0.0];
        for (end, most) in [(0, 0.6), (1, 0.4)] {
            assert!(impossible(0.99 * most, end, across) && !impossible(1.01 * most, end, across));
            assert!(!impossible(0.1, end, [0.0, 0.0, 4.0]));
        }
    }

    /// With c = e_z, τ = 2 and base e_x what is left at b is pull + e_x ∓ 2 e_z, at a
    /// pull − e_x ± 2 e_z + load: of the size 1, and level.
    #[test]
    fn what_goes_round_pulls_across_its_line() {
        let swing = swing([2.0, 3.0], [0.0, 0.0, -3.0]);
        let swung = swung([0.0, 0.0, 1.0]);
        let impossible = |end: usize, sign: f64, pull: [f64; 3]| {
            round_is_impossible(&swing, &swung, end, points(pull), sign)
        };
        assert!(!impossible(1, 1.0, [0.0, 0.0, 2.0]) && !impossible(1, -1.0, [0.0, 0.0, -2.0]));
        assert!(impossible(1, -1.0, [0.0, 0.0, 2.0]));
        // Too large, and not across.
        assert!(impossible(1, 1.0, [1.0, 0.0, 2.0]) && impossible(1, 1.0, [-1.0, 0.0, 3.0]));
        assert!(!impossible(0, 1.0, [2.0, 0.0, 1.0]) && !impossible(0, -1.0, [0.0, 0.0, 5.0]));
        assert!(impossible(0, 1.0, [0.0; 3]));
        let known = Swung { round: None, ..swung.clone() };
        assert!(!round_is_impossible(&swing, &known, 0, points([0.0; 3]), 1.0));
        let open = Swung { tension: Interval::LINE, ..swung.clone() };
        assert!(!round_is_impossible(&swing, &open, 0, points([0.0; 3]), 1.0));
    }

    /// Of two knots each has three rows.
    #[test]
    fn forces_are_those_of_their_knot() {
        let mut layout = hung(&[([0.0; 3], [1.0; 2])]);
        layout.swings[0].ends[0] = End::Knot(1);
        let at = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0].map(Interval::point);
        layout.loads.push(layout.loads[0]);
        let cell = Cell::over(&layout, at).unwrap();
        let forces: Vec<Interval> = (0_u8..6).map(|k| Interval::point(k.into())).collect();
        assert_eq!(cell.at_rows(&forces, 0), points([0.0, 1.0, 2.0]));
        assert_eq!(cell.at_rows(&forces, 3), points([3.0, 4.0, 5.0]));
    }
}
