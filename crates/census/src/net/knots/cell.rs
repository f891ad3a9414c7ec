//! The balance of the knots and the laws of the links between them, over a box of their places.
//!
//! With the force densities w of the bars between knots, the tensions N of ropes and elastic members and the
//! directions u of their spans the equations are, for a pattern σ of the swinging joints,
//!
//! $$ f_j + \sum_e w_e (x_k - x_j) + \sum_{\text{at } j} \pm N_e u + \sum_s G_s(\sigma_s; x) = 0, $$
//! $$ \tfrac12(|x_b - x_a|^2 - l_e^2) = 0, \qquad \sum |x_b - x_a| - c_e N_e - l_e = 0. $$
//!
//! A rope at whose end a load W hangs alone has $N = W$ in place of the last. Where a span may have no length u
//! is any vector of at most the length 1: what a span without length pulls with is among its forces.

use std::array::from_fn;

use numerics::Interval;

use super::dense::{Dense, add, add_to_column, zeros};
use super::jet::Jets;
use super::layout::{End, Layout};
use super::reach::span;
use super::swing::{Swung, added};
use crate::boxes::arithmetic::{self, Vector, difference, plus, squared, sum, times, unit, upon};
use crate::run::closure::signed;

/// Which way each swinging joint lies: a bit is set where σ = −1.
pub(super) type Pattern = u32;

/// A box of places of the knots with all that it makes of the forces. Of the N coordinates those beyond
/// [`Layout::coordinates`] are in no equation.
pub(super) struct Cell<'a, const N: usize> {
    pub(super) layout: &'a Layout,
    pub(super) at: [Interval; N],
    pub(super) swung: Vec<Swung<N>>,
    /// From the one end of each span of a link to the other.
    pub(super) spans: Vec<Vec<Vector>>,
    /// What each span pulls with by a unit of the unknown of its link.
    pub(super) along: Vec<Vec<Vector>>,
    /// Tensions of links that follow from the places; `None` for the others.
    pub(super) known: Vec<Option<Interval>>,
}

/// σ of a joint.
pub(super) fn sign(pattern: Pattern, swing: usize) -> i8 {
    if pattern >> swing & 1 == 0 { 1 } else { -1 }
}

impl<'a, const N: usize> Cell<'a, N> {
    /// Nothing where two bars cannot meet anywhere in the box, or an elastic member cannot bear its force.
    pub(super) fn over(layout: &'a Layout, at: [Interval; N]) -> Option<Self> {
        let swung = layout.swings.iter().map(|swing| Swung::over(swing, layout.dim, &at));
        let swung = swung.collect::<Option<Vec<_>>>()?;
        let (mut spans, mut along, mut known) = (vec![], vec![], vec![]);
        for link in &layout.links {
            let own = link.ends.iter().map(|ends| span(layout.dim, &at, *ends));
            let own: Vec<Vector> = own.collect();
            let squared = link.acting.is_squared();
            along.push(own.iter().map(|d| if squared { *d } else { unit(*d) }).collect());
            known.push(if link.is_constraint() { None } else { Some(link.known(&own)?) });
            spans.push(own);
        }
        Some(Self { layout, at, swung, spans, along, known })
    }

    /// Whether everything can be differentiated in the whole box.
    pub(super) fn smooth(&self) -> bool {
        self.swung.iter().all(|swung| swung.smooth.is_some()) && !self.jams()
    }

    /// Whether a span of a rope or of an elastic member may have no length.
    pub(super) fn jams(&self) -> bool {
        let links = self.layout.links.iter().zip(&self.spans);
        links
            .filter(|(link, _)| !link.acting.is_squared())
            .any(|(_, spans)| spans.iter().any(|span| squared(*span).lo() <= 0.0))
    }

    pub(super) fn places(&self, unknowns: &[Interval]) -> [Interval; N] {
        let coordinates = self.layout.coordinates();
        from_fn(|k| if k < coordinates { unknowns[k] } else { self.at[k] })
    }

    /// The rows of an end, if it is a knot.
    pub(super) fn rows(&self, end: End) -> Option<usize> {
        match end {
            End::Knot(knot) => Some(self.layout.dim * knot),
            End::Held(_) => None,
        }
    }

    /// Add a force to the rows of an end.
    pub(super) fn push(&self, forces: &mut [Interval], end: End, force: Vector) {
        if let Some(row) = self.rows(end) {
            added(&mut forces[row..row + self.layout.dim], force);
        }
    }

    pub(super) fn loads(&self) -> Vec<Interval> {
        let dim = self.layout.dim;
        self.layout.loads.iter().flat_map(|load| load[..dim].to_vec()).collect()
    }

    /// Left-hand sides of all equations; all swings must be smooth.
    pub(super) fn residual(&self, pattern: Pattern, densities: &[Interval]) -> Vec<Interval> {
        let mut all = self.loads();
        for (s, (swing, swung)) in self.layout.swings.iter().zip(&self.swung).enumerate() {
            let Some([base, taken]) = &swung.smooth else { continue };
            let turn = sign(pattern, s);
            let pull: Vector = from_fn(|k| difference(base[k].value, signed(turn, taken[k].value)));
            self.push(&mut all, swing.ends[1], pull);
            self.push(&mut all, swing.ends[0], arithmetic::minus(swing.load, pull));
        }
        for (link, force) in densities.iter().enumerate() {
            self.pull(&mut all, link, *force);
        }
        for ((link, spans), force) in self.layout.links.iter().zip(&self.spans).zip(densities) {
            all.push(match &link.hanging {
                Some(hanging) => difference(hanging.tension, *force),
                None => link.acting.misfit(spans, *force),
            });
        }
        all
    }

    fn pull(&self, forces: &mut [Interval], link: usize, force: Interval) {
        for (ends, along) in self.layout.links[link].ends.iter().zip(&self.along[link]) {
            let pull = times(force, *along);
            self.push(forces, ends[0], pull);
            self.push(forces, ends[1], pull.map(|part| -part));
        }
    }

    /// Their derivative by places and densities; all swings must be smooth.
    pub(super) fn derivative(&self, pattern: Pattern, densities: &[Interval]) -> Dense {
        let places = self.layout.coordinates();
        let size = places + densities.len();
        let mut slope = zeros(size, size);
        for (s, (swing, swung)) in self.layout.swings.iter().zip(&self.swung).enumerate() {
            let Some([base, taken]) = &swung.smooth else { continue };
            let turn = sign(pattern, s);
            for column in 0..places {
                let part = |jets: &Jets<N>, k: usize| jets[k].slope[column];
                let pull: Vector = from_fn(|k| sum(part(base, k), -signed(turn, part(taken, k))));
                for (end, pull) in [(1, pull), (0, pull.map(|part| -part))] {
                    if let Some(row) = self.rows(swing.ends[end]) {
                        add_to_column(&mut slope, (row, column), &pull[..self.layout.dim]);
                    }
                }
            }
        }
        for (link, force) in densities.iter().enumerate() {
            self.slope_of_link(&mut slope, link, *force);
        }
        slope
    }

    fn slope_of_link(&self, slope: &mut Dense, number: usize, force: Interval) {
        let (link, dim) = (&self.layout.links[number], self.layout.dim);
        let extra = self.layout.coordinates() + number;
        let spans = link.ends.iter().zip(&self.spans[number]).zip(&self.along[number]);
        for (([a, b], span), along) in spans {
            let direction = link.acting.direction(*span);
            for (here, there, along) in [(a, b, *along), (b, a, along.map(|part| -part))] {
                let Some(row) = self.rows(*here) else { continue };
                for (k, part) in along[..dim].iter().enumerate() {
                    add(slope, (row + k, extra), *part);
                    if link.hanging.is_none() {
                        add(slope, (extra, row + k), -*part);
                    }
                    let turned = direction.turned(force, upon(k, Interval::ONE));
                    if let Some(other) = self.rows(*there) {
                        add_to_column(slope, (row, other + k), &turned[..dim]);
                    }
                    add_to_column(slope, (row, row + k), &turned.map(|part| -part)[..dim]);
                }
            }
        }
        let by_own = if link.hanging.is_some() { Interval::ONE } else { link.acting.compliance };
        add(slope, (extra, extra), -by_own);
    }

    /// Of each swing whose ends are apart what it pulls at its second end with σ = 0, and what it
    /// takes off that times σ, but for a tension that has no bound.
    pub(super) fn rough_parts(&self, unbounded: &[bool]) -> Vec<Option<[Vector; 2]>> {
        let swings = self.swung.iter().zip(unbounded);
        swings
            .map(|(swung, unbounded)| {
                let along = times(swung.tension, swung.span);
                let off = if *unbounded { swung.sideways } else { plus(swung.sideways, along) };
                (!swung.folded).then_some([swung.base, off])
            })
            .collect()
    }

    /// The forces at the knots for one pattern, without those of links whose tension is not known; perhaps
    /// without those of one swing.
    pub(super) fn rough(
        &self,
        rough: &[Option<[Vector; 2]>],
        pattern: Pattern,
        without: Option<usize>,
    ) -> Vec<Interval> {
        let mut all = self.loads();
        for (link, known) in self.known.iter().enumerate() {
            if let Some(force) = known {
                self.pull(&mut all, link, *force);
            }
        }
        for (s, (swing, parts)) in self.layout.swings.iter().zip(rough).enumerate() {
            let Some([base, off]) = parts.filter(|_| without != Some(s)) else { continue };
            self.push(&mut all, swing.ends[1], base);
            self.push(&mut all, swing.ends[0], arithmetic::minus(swing.load, base));
            let off = off.map(|part| signed(sign(pattern, s), part));
            self.push(&mut all, swing.ends[1], off.map(|part| -part));
            self.push(&mut all, swing.ends[0], off);
        }
        all
    }

    /// The tension along a swing with its sign.
    pub(super) fn tension(&self, pattern: Pattern, swing: usize) -> Interval {
        signed(sign(pattern, swing), self.swung[swing].tension)
    }

    /// The force on the knot whose first row this is.
    pub(super) fn at_rows(&self, forces: &[Interval], row: usize) -> Vector {
        from_fn(|k| if k < self.layout.dim { forces[row + k] } else { Interval::ZERO })
    }
}

#[cfg(test)]
mod tests {
    use super::super::layout::{Hanging, Link, Swing};
    use super::*;
    use crate::boxes::arithmetic::points;
    use crate::boxes::equations::Acting;

    fn link(ends: &[[End; 2]], spans: usize, length: f64, compliance: f64) -> Link {
        let [length, compliance] = [length, compliance].map(Interval::point);
        let acting = Acting { member: 0, spans: 0..spans, length, compliance, force: 0 };
        Link { acting, ends: ends.to_vec(), range: Interval::LINE, hanging: None }
    }

    /// Two knots and a swing between one of them and a held place; a bar between the knots, a rope over both and
    /// twice over one, an elastic bar, an elastic rope, and a rope with a weight at its end. No two terms of one size.
    fn layout() -> Layout {
        let [p, q] = [End::Knot(0), End::Knot(1)];
        let [a, b] = [[0.1, -1.3, 0.4], [2.3, 0.7, 1.9]].map(|at| End::Held(points(at)));
        let swing = Swing {
            joint: 2,
            members: [0, 1],
            ends: [a, q],
            lengths: [1.7, 2.2].map(Interval::point),
            load: points([0.2, 0.1, -0.9]),
        };
        let hanging = Hanging {
            joint: 3,
            from: 0,
            load: points([0.0, 0.0, -0.8]),
            tension: Interval::point(0.8),
        };
        let links = vec![
            link(&[[p, q]], 1, 1.1, 0.0),
            link(&[[a, p], [p, b], [b, p], [p, q], [q, a]], 5, 9.0, 0.0),
            link(&[[q, b]], 1, 1.9, 0.7),
            link(&[[p, b], [b, q]], 2, 3.1, 0.3),
            Link { hanging: Some(hanging), ..link(&[[q, b]], 2, 5.0, 0.0) },
        ];
        let loads = vec![points([0.3, -0.2, -1.1]), points([-0.1, 0.5, -0.7])];
        let (axes, knots) = ([0, 1, 2], vec![0, 1]);
        Layout { dim: 3, axes, axis: None, knots, loads, swings: vec![swing], links }
    }

    #[test]
    fn the_derivative_is_the_difference_quotient_of_the_residual() {
        let layout = layout();
        let forces = [0.9, 1.7, -0.6, 2.3, 1.2];
        let at: [f64; 6] = [0.7, -0.4, 0.2, 1.2, 0.6, -0.8];
        let unknowns: Vec<f64> = at.iter().copied().chain(forces).collect();
        let cell = |unknowns: &[f64]| {
            Cell::<6>::over(&layout, from_fn(|k| Interval::point(unknowns[k]))).unwrap()
        };
        let points = |unknowns: &[f64]| -> Vec<Interval> {
            unknowns[6..].iter().copied().map(Interval::point).collect()
        };
        assert!(cell(&unknowns).smooth() && !cell(&unknowns).jams());
        for pattern in 0..2 {
            let slope = cell(&unknowns).derivative(pattern, &points(&unknowns));
            for column in 0..unknowns.len() {
                let moved = |step: f64| {
                    let mut unknowns = unknowns.clone();
                    unknowns[column] += step;
                    cell(&unknowns).residual(pattern, &points(&unknowns))
                };
                let (more, less) = (moved(1e-5), moved(-1e-5));
                for row in 0..unknowns.len() {
                    let quotient = (more[row].mid() - less[row].mid()) / 2e-5;
                    let found = slope[(row, column)].mid();
                    assert!((found - quotient).abs() < 1e-8, "{row} {column}: {found} {quotient}");
                }
            }
        }
        // Where the tension is told by the places the residual of its law vanishes.
        let here = cell(&unknowns);
        for (k, known) in here.known.iter().enumerate() {
            let Some(known) = known else { continue };
            let mut forces = points(&unknowns);
            forces[k] = *known;
            assert!(here.residual(0, &forces)[6 + k].contains(0.0), "{k}");
        }
        assert_eq!(
            here.known.iter().map(Option::is_some).collect::<Vec<_>>(),
            [false, false, true, true, true]
        );
    }

    /// Knots on each other, and the one on a pulley: what a span there pulls with is any vector up to its tension.
    #[test]
    fn a_span_without_length_pulls_anywhere() {
        let layout = layout();
        let at: [Interval; 6] = [0.7, -0.4, 0.2, 0.7, -0.4, 0.2].map(|x| Interval::around(x, 1e-3));
        let cell = Cell::over(&layout, at).unwrap();
        assert!(cell.jams() && !cell.smooth());
        let anywhere = Interval::new(-1.0, 1.0);
        assert_eq!(cell.along[1][3], [anywhere; 3]);
        assert!(cell.along[1][0].iter().all(|part| part.width() < 1e-2));
    }
}
