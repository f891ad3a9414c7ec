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
//! whatever the size of the pull: its forces are a family. The horizontal part of the closure is
//! $H \sum_i s_i l_i/|F_i|$. Where that sum is proved not to vanish no other equilibrium is near.
//! Where the force of one bar k vanishes, the same is proved by its size: with $F_k = \varrho e$ the
//! horizontal part is $e_x (\varrho \sum_{i \ne k} s_i l_i/|F_i| + l_k)$.
//!
//! If both anchors are one point, D = 0, the line may have any direction, and pulls without bound
//! in any direction are zeros of the closure. The product $q \times \Phi$ with the pull is then $H w
//! \sum_i s_i l_i c_i/|F_i|$: where that sum does not vanish, the pull is upright or infinite.

use std::borrow::Cow;
use std::collections::HashMap;

use intervals::Interval;
use model::Chain;
use serde::{Deserialize, Serialize};

use crate::closure::{Pattern, signed};
use crate::plane::cell::Cell;
use crate::plane::face::Face;
use crate::plane::system::System;
use crate::slack::exact::ExactSides;

/// A position in which all bars lie in the line between the anchors.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
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
    /// Whether all ways to fit are known: what may fit upright, does so or is none.
    exact: bool,
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
        let unite = |all: Cell, cell: &Cell| Cell {
            face: all.face,
            at: std::array::from_fn(|k| all.at[k].hull(cell.at[k])),
        };
        let first = *cells.values().next()?;
        let hull = cells.values().fold(first, unite);
        Some(Self { cells, hull })
    }
}

impl Straight {
    /// All straight positions of a chain.
    pub(crate) fn of(system: &System, chain: &Chain) -> Self {
        let Some(sides) = ExactSides::new(chain) else { return Self::default() };
        let fits = sides.fits();
        let bars = system.bars();
        let all = (1_u32 << bars) - 1;
        let mut settled = vec![];
        if !system.vertical {
            // Along the line, and against it with all signs turned.
            for (way, turned) in [(1, 0), (-1, all)] {
                let patterns = fits.iter().map(|pattern| Pattern(pattern.0 ^ turned));
                let cells = patterns.filter_map(|p| Some((p, isolated(system, p, way)?)));
                settled.extend(Settled::new(cells.collect()));
            }
        }
        let positions = fits.iter().map(|pattern| StraightPosition {
            along: pattern.signs(bars).collect(),
            upright: system.vertical,
        });
        Self { positions: positions.collect(), settled, exact: true }
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
        if !self.exact || !system.vertical || self.positions.is_empty() {
            return left;
        }
        if cell.homogeneous()[0].contains(0.0) {
            left.to_mut().retain(|pattern| !upright_alone(system, cell, *pattern));
        }
        if system.span[1] == Interval::ZERO {
            left.to_mut().retain(|pattern| !upright_or_infinite(system, cell, *pattern));
        }
        left
    }
}

/// A rectangle about the pull along the span, or against it, without an equilibrium of a pattern.
fn isolated(system: &System, pattern: Pattern, way: i8) -> Option<Cell> {
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
        if is_isolated(system, &cell, f, pattern) == Some(true) {
            return Some(cell);
        }
        size *= NEXT;
    }
    None
}

/// Whether the blown-up closure has no zero over a rectangle.
fn is_isolated(system: &System, cell: &Cell, f: [Interval; 2], pattern: Pattern) -> Option<bool> {
    let size = |[x, z]: [Interval; 2]| (x.square() + z.square()).sqrt();
    let whole = size(f);
    let nu = f[0];
    let mut terms = vec![];
    let (mut turn, mut lean) = (Interval::ZERO, Interval::ZERO);
    let bars = system.length.iter().zip(&system.weight);
    for ((length, weight), sign) in bars.zip(pattern.signs(system.bars())) {
        let force = cell.force(*weight);
        let b = f[0] * force[0] + f[1] * force[1];
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
    let second: Interval = terms.into_iter().map(|(part, c)| part * (psi + c).square()).sum();
    Some(!second.contains(0.0))
}

/// Whether every equilibrium of a pattern in a cell about H = 0 has H = 0.
fn upright_alone(system: &System, cell: &Cell, pattern: Pattern) -> bool {
    let bars = system.bars();
    let weights = system.weights(cell.face);
    let mut free = None;
    let mut sum = Interval::ZERO;
    for group in &system.groups {
        let force = cell.force(weights[group.start]);
        if force[0].contains(0.0) && force[1].contains(0.0) {
            // Several bars, or bars that lose their force at other pulls.
            if free.is_some() || group.len() > 1 {
                return false;
            }
            free = Some((group.start, force));
            continue;
        }
        let size = (force[0].square() + force[1].square()).sqrt();
        for i in group.clone() {
            let sign = if pattern.compressed(bars, i) { -1 } else { 1 };
            sum = sum + signed(sign, system.length[i] / size);
        }
    }
    match free {
        None => !sum.contains(0.0),
        // The force of the one bar, of either sign, times the sum of the others.
        Some((bar, force)) => {
            let size = (force[0].square() + force[1].square()).sqrt().hi();
            let most = Interval::point(size) * Interval::point(sum.mag());
            most.hi() < system.length[bar].lo()
        }
    }
}

/// Between anchors in one point: whether every zero of a pattern in a cell has H = 0 or an infinite
/// pull.
fn upright_or_infinite(system: &System, cell: &Cell, pattern: Pattern) -> bool {
    let mut sum = Interval::ZERO;
    let bars = system.length.iter().zip(system.weights(cell.face));
    for ((length, weight), sign) in bars.zip(pattern.signs(system.bars())) {
        let force = cell.force(*weight);
        let size = (force[0].square() + force[1].square()).sqrt();
        if size.lo() <= 0.0 {
            return false;
        }
        sum = sum + signed(sign, *length * *weight / size);
    }
    !sum.contains(0.0)
}
