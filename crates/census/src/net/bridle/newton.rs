//! The interval Newton method on the closures of all strands and the balance of the knot.
//!
//! Unknowns: the place of the knot and two coordinates of the pull of each strand; of a bar alone
//! its force density. Equations: two of closure for each strand, $\Phi_i(p_i) - (r_i, z_i) = 0$
//! with the horizontal distance $r_i$ and the rise $z_i$ from its anchor to the knot, or the length
//! of the bar; and three of balance, $\sum_i d_i/w_i - L = 0$.

use numerics::Interval;

use super::pulls::density;
use super::strand::{Bridle, Span, Strand};
use crate::boxes::arithmetic::squared;
use crate::net::knots::dense::{add, zeros};
use crate::net::knots::newton::{Linear, Newton, around, step, zero};
use crate::run::closure::bar::BarTerm;
use crate::run::closure::{Pattern, signed};
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;

/// The charts of the pulls of all strands, and their patterns.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Charts {
    pub(super) faces: Vec<Face>,
    pub(super) patterns: Vec<Pattern>,
}

/// Next to the only equilibrium of a box.
#[derive(Debug, Clone)]
pub(super) struct Found {
    pub(super) charts: Charts,
    pub(super) alone_in: Vec<Interval>,
    pub(super) at: Vec<f64>,
}

/// What is known of a box.
pub(super) enum Verdict {
    Empty,
    /// All equilibria of the box lie in this part of it.
    Within(Vec<Interval>),
    /// No other equilibrium than the one next to a point lies in a box, which has this one in it.
    One(Found),
}

/// What is known of a box; nothing can be said where a force may vanish or be infinite, or the
/// knot stand over an anchor.
pub(super) fn examine(bridle: &Bridle, charts: &Charts, at: &[Interval]) -> Verdict {
    match narrowed(bridle, charts, at) {
        None => Verdict::Within(at.to_vec()),
        Some(Newton { left: None, .. }) => Verdict::Empty,
        Some(Newton { left: Some(left), single }) => {
            let found = if single { one(bridle, charts, &left) } else { None };
            found.map_or(Verdict::Within(left), Verdict::One)
        }
    }
}

fn narrowed(bridle: &Bridle, charts: &Charts, at: &[Interval]) -> Option<Newton> {
    let (_, slope) = equations(bridle, charts, at)?;
    let middle: Vec<Interval> = at.iter().map(|part| Interval::point(part.mid())).collect();
    let (value, _) = equations(bridle, charts, &middle)?;
    step(at, &slope, &value)
}

/// The proof that one equilibrium at most is in a box around this one and the zero next to it.
fn one(bridle: &Bridle, charts: &Charts, at: &[Interval]) -> Option<Found> {
    let middle = at.iter().map(|part| part.mid()).collect();
    let zero = zero(middle, |unknowns| equations(bridle, charts, unknowns))?;
    let alone_in = around(at, &zero)?;
    let newton = narrowed(bridle, charts, &alone_in)?;
    newton.single.then_some(Found { charts: charts.clone(), alone_in, at: zero })
}

/// The cell of the pulls of a strand in a box of all unknowns.
pub(super) fn cell(bridle: &Bridle, charts: &Charts, at: &[Interval], strand: usize) -> Cell {
    let first = bridle.first(strand);
    let second = if bridle.strands[strand].is_rod() { Interval::ZERO } else { at[first + 1] };
    Cell { face: charts.faces[strand], at: [at[first], second] }
}

fn equations(bridle: &Bridle, charts: &Charts, at: &[Interval]) -> Option<Linear> {
    let size = at.len();
    let knot = [at[0], at[1], at[2]];
    let mut all = (vec![Interval::ZERO; size], zeros(size, size));
    for k in 0..3 {
        all.0[size - 3 + k] = -bridle.load[k];
    }
    for (i, strand) in bridle.strands.iter().enumerate() {
        let cell = cell(bridle, charts, at, i);
        let span = Span::new(strand, &knot);
        let own = bridle.first(i);
        if strand.is_rod() {
            rod(&mut all, strand, &span, &cell, own)?;
        } else {
            several(&mut all, strand, &span, &cell, own, charts.patterns[i])?;
        }
    }
    Some(all)
}

/// The length of a bar alone and its force, with the density τ: $(|a|^2 - l^2)/2$ and $\tau a$.
fn rod(
    (value, slope): &mut Linear,
    strand: &Strand,
    span: &Span,
    cell: &Cell,
    own: usize,
) -> Option<()> {
    let (row, balance) = (own - 3, value.len() - 3);
    let [t, w] = density(cell);
    if w.lo() <= 0.0 {
        return None;
    }
    let tau = if w == Interval::ONE { t } else { t / w };
    let by = if w == Interval::ONE { Interval::ONE } else { -(tau / w) };
    value[row] = (squared(span.arm) - strand.length[0].square()).scale(0.5);
    for (k, arm) in span.arm.into_iter().enumerate() {
        slope[(row, k)] = arm;
        value[balance + k] = value[balance + k] + tau * arm;
        add(slope, (balance + k, k), tau);
        slope[(balance + k, own)] = by * arm;
    }
    Some(())
}

/// The closure of a strand of several bars, and the force of its last one.
fn several(
    (value, slope): &mut Linear,
    strand: &Strand,
    span: &Span,
    cell: &Cell,
    own: usize,
    pattern: Pattern,
) -> Option<()> {
    let (row, balance) = (own - 3, value.len() - 3);
    let toward = span.toward?;
    let [distance, rise] = span.way;
    let mut gap = [-distance, -rise];
    let bars = strand.length.len();
    for (k, (length, weight)) in strand.length.iter().zip(&strand.weight).enumerate() {
        let term = BarTerm::over(cell, *length, *weight)?;
        let sign = pattern.sign(bars, k);
        for (part, gap) in gap.iter_mut().enumerate() {
            *gap = *gap + signed(sign, term.value[part]);
            for (coordinate, by) in term.slope[part].into_iter().enumerate() {
                add(slope, (row + part, own + coordinate), signed(sign, by));
            }
        }
    }
    value[row] = gap[0];
    value[row + 1] = gap[1];
    slope[(row, 0)] = -toward[0];
    slope[(row, 1)] = -toward[1];
    slope[(row + 1, 2)] = -Interval::ONE;
    let ([along, up], by) = force(cell, strand.weight[bars - 1])?;
    for (k, part) in span.world([along, up]).into_iter().enumerate() {
        value[balance + k] = value[balance + k] + part;
    }
    for (coordinate, by) in by.into_iter().enumerate() {
        let part = span.world(by);
        for (k, part) in part.into_iter().enumerate() {
            slope[(balance + k, own + coordinate)] = part;
        }
    }
    // The horizontal direction turns with the knot.
    let turning = along / distance;
    let [x, y] = toward;
    add(slope, (balance, 0), turning * y.square());
    add(slope, (balance, 1), -(turning * x * y));
    add(slope, (balance + 1, 0), -(turning * x * y));
    add(slope, (balance + 1, 1), turning * x.square());
    Some(())
}

/// The force of a bar, (H, V + c), and its derivatives, first by the one and then by the other
/// coordinate of the cell; nothing where it may be infinite.
fn force(cell: &Cell, weight: Interval) -> Option<([Interval; 2], [[Interval; 2]; 2])> {
    let [h, v, w] = cell.homogeneous();
    let (zero, one) = (Interval::ZERO, Interval::ONE);
    if matches!(cell.face, Face::Near | Face::Around(_)) {
        return Some(([h, v + weight], [[one, zero], [zero, one]]));
    }
    if w.lo() <= 0.0 {
        return None;
    }
    let (along, up, inverse) = (h / w, v / w, one / w);
    let by_w = [-(along * inverse), -(up * inverse)];
    let by_other = match cell.face {
        Face::Left | Face::Right => [zero, inverse],
        _ => [inverse, zero],
    };
    Some(([along, up + weight], [by_other, by_w]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::boxes::arithmetic::points;

    fn strand(anchor: [f64; 3], lengths: &[f64], weights: &[f64]) -> Strand {
        let all = |numbers: &[f64]| numbers.iter().copied().map(Interval::point).collect();
        let (length, weight) = (all(lengths), all(weights));
        Strand { members: vec![], joints: vec![], anchor: points(anchor), length, weight }
    }

    /// Strands of two bars, of one and of three.
    fn bridle() -> Bridle {
        let strands = vec![
            strand([1.0, 0.25, 0.5], &[0.75, 0.5], &[-0.5, 0.5]),
            strand([-1.0, 0.5, 0.25], &[1.25], &[0.0]),
            strand([0.25, -1.0, 0.0], &[0.5, 0.75, 0.5], &[-0.75, 0.25, 0.75]),
        ];
        Bridle { knot: 0, load: points([0.25, -0.5, -1.0]), strands }
    }

    const FACES: [Face; 5] = [Face::Near, Face::Left, Face::Right, Face::Below, Face::Above];

    fn charts(face: usize) -> Charts {
        let rod = [Face::Near, Face::Left, Face::Right][face % 3];
        let faces = vec![FACES[face], rod, FACES[(face + 2) % 5]];
        Charts { faces, patterns: vec![Pattern(0b01), Pattern(0), Pattern(0b010)] }
    }

    /// The knot; coordinates of a pull, a density, and a pull.
    const AT: [f64; 8] = [0.25, 0.125, -0.75, 0.625, 0.375, 0.5, -0.25, 0.875];

    /// The pull (H, V) of coordinates of a chart, in plain numbers.
    fn pull(face: Face, [x, y]: [f64; 2]) -> [f64; 2] {
        match face {
            Face::Left => [-1.0 / y, x / y],
            Face::Right => [1.0 / y, x / y],
            Face::Below => [x / y, -1.0 / y],
            Face::Above => [x / y, 1.0 / y],
            Face::Near | Face::Around(_) => [x, y],
        }
    }

    /// The equations in plain numbers, from their definition.
    fn plain(bridle: &Bridle, charts: &Charts) -> Vec<f64> {
        let mut closures = vec![];
        let mut balance: Vec<f64> = bridle.load.iter().map(|part| -part.mid()).collect();
        let mut first = 3;
        for (i, strand) in bridle.strands.iter().enumerate() {
            let arm: [f64; 3] = std::array::from_fn(|k| AT[k] - strand.anchor[k].mid());
            let length: Vec<f64> = strand.length.iter().map(|length| length.mid()).collect();
            let mut force = [0.0; 3];
            if length.len() == 1 {
                let tau = match charts.faces[i] {
                    Face::Left => -1.0 / AT[first],
                    Face::Right => 1.0 / AT[first],
                    _ => AT[first],
                };
                let square: f64 = arm.iter().map(|x| x * x).sum();
                closures.push(0.5 * (square - length[0] * length[0]));
                force = arm.map(|x| tau * x);
                first += 1;
            } else {
                let [h, v] = pull(charts.faces[i], [AT[first], AT[first + 1]]);
                let distance = arm[0].hypot(arm[1]);
                let mut gap = [-distance, -arm[2]];
                let signs = charts.patterns[i].signs(length.len());
                for ((length, weight), sign) in length.iter().zip(&strand.weight).zip(signs) {
                    let up = v + weight.mid();
                    let size = f64::from(sign) * length / h.hypot(up);
                    gap = [gap[0] + size * h, gap[1] + size * up];
                    force = [h * arm[0] / distance, h * arm[1] / distance, up];
                }
                closures.extend(gap);
                first += 2;
            }
            for (sum, part) in balance.iter_mut().zip(force) {
                *sum += part;
            }
        }
        closures.extend(balance);
        closures
    }

    fn over(charts: &Charts, at: &[f64]) -> Linear {
        let at: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
        equations(&bridle(), charts, &at).unwrap()
    }

    #[test]
    fn equations_and_their_slope_are_those_of_plain_numbers() {
        for charts in (0..5).map(charts) {
            let (value, slope) = over(&charts, &AT);
            for (found, expected) in value.iter().zip(plain(&bridle(), &charts)) {
                let near = (found.mid() - expected).abs() < 1e-13 && found.width() < 1e-12;
                assert!(near, "{charts:?}: {found:?} {expected}");
            }
            for column in 0..AT.len() {
                let moved = |step: f64| {
                    let mut at = AT;
                    at[column] += step;
                    over(&charts, &at).0
                };
                let quotient = |step: f64, row: usize| {
                    (moved(step)[row].mid() - moved(-step)[row].mid()) / (2.0 * step)
                };
                for row in 0..AT.len() {
                    let expected = (4.0 * quotient(1e-4, row) - quotient(2e-4, row)) / 3.0;
                    let found = slope[(row, column)].mid();
                    assert!((found - expected).abs() < 1e-9, "{charts:?}: {found} {expected}");
                }
            }
        }
    }

    /// A strand of two bars that a load of (3/4, 0, -5/16) draws aside, and 11/16 between them: the
    /// forces are (12, -16)/16 and (12, -5)/16, the slopes those of 3, 4, 5 and 5, 12, 13.
    #[test]
    fn a_strand_drawn_aside_is_proved_in_a_neighbourhood() {
        let strands = vec![strand([0.0; 3], &[1.25, 0.8125], &[-0.34375, 0.34375])];
        let bridle = Bridle { knot: 0, load: points([0.75, 0.0, -0.3125]), strands };
        let charts = Charts { faces: vec![Face::Near], patterns: vec![Pattern(0)] };
        let zero = [1.5, 0.0, -1.3125, 0.75, -0.65625];
        let around = |by: f64| -> Vec<Interval> {
            zero.iter().map(|x| Interval::new(x - by, x + 0.5 * by)).collect()
        };
        let Verdict::One(found) = examine(&bridle, &charts, &around(1e-7)) else {
            panic!("not proved");
        };
        for ((alone, at), x) in found.alone_in.iter().zip(&found.at).zip(zero) {
            // Room in units of length, and next to none besides.
            assert!((at - x).abs() < 1e-14 && alone.contains(x));
            assert!((1.9e-9..2.5e-9).contains(&alone.width()), "{alone:?}");
        }
        // Away from it there is none.
        let mut aside = around(1e-7);
        aside[0] = aside[0] + Interval::point(1e-3);
        assert!(matches!(examine(&bridle, &charts, &aside), Verdict::Empty));
    }
}
