//! The closure in the axial force and the direction of one bar that may carry no force.
//!
//! Where the force of bar k vanishes, its direction is not that of its force, and the closure as a
//! function of the pull has no derivative there. It has one in other coordinates: the axial force ρ
//! of bar k, with its sign, and the direction e of bar k. For
//!
//! $$ F_k = \varrho\\, e, \qquad F_i = \varrho\\, e + (c_i - c_k) e_z, \qquad
//!    G(\varrho, e) = \sum_{i \ne k} s_i l_i \frac{F_i}{|F_i|} + l_k e - D = 0 $$
//!
//! tension (ρ > 0) and compression (ρ < 0) of bar k are one smooth system, as long as no other
//! force vanishes. At ρ = 0 all other bars are upright; the derivative of G is regular if bar k is
//! not, and if $\sum_{i \ne k} s_i l_i / |F_i|$ is not zero. So Krawczyk's test in (ρ, e) proves
//! that exactly one equilibrium is near, whether or not its bar k carries nothing at all: lengths
//! that are integers often make it carry nothing.
//!
//! Bars in a row whose common joints carry no weight share one force. Pointing along e or against
//! it, they are one bar of the length $\sum_k \sigma_k l_k$ with their ways σ.
//!
//! The direction is written without trigonometry, $e = (a + t\\,n)/|a + t\\,n|$ about an axis a with
//! its normal n.

use std::ops::Range;

use numerics::Interval;

use crate::run::closure::bar::{size, unit};
use crate::run::closure::signed;
use crate::run::enclosure::krawczyk::{image, inside, narrowed};
use crate::run::equilibrium::Observed;
use crate::run::equilibrium::inertia::Indices;
use crate::run::plane::cell::Cell;
use crate::run::plane::face::Face;
use crate::run::plane::system::System;

/// The range of directions is widened by this part of its width, and by this, so that the image can
/// lie inside.
const WIDER: f64 = 0.25;
/// See [`WIDER`].
const WIDER_BY: f64 = 1e-12;

/// The closure in the coordinates (ρ, t), for the bars of one group and one pattern of the others.
pub(crate) struct AxialClosure<'a> {
    pub(crate) system: &'a System,
    /// The bars without force: one, or a run of bars whose common joints carry no weight.
    pub(crate) group: Range<usize>,
    /// Whether each of them points along e, +1, or against it, −1.
    pub(crate) along: Vec<i8>,
    /// The chart of pulls whose origin is that without force in the bar.
    pub(crate) face: Face,
    /// 0 for the bars of the group.
    pub(crate) signs: Vec<i8>,
    /// a
    pub(crate) axis: [Interval; 2],
}

impl AxialClosure<'_> {
    /// The way of a bar of the group along e.
    fn way(&self, bar: usize) -> i8 {
        self.along[bar - self.group.start]
    }

    fn direction(&self, t: Interval) -> [Interval; 2] {
        let [x, z] = self.axis;
        unit([x - t * z, z + t * x])
    }

    /// What the bars do over a box of (ρ, t); `None` where the force of another bar may vanish.
    pub(crate) fn bars(&self, [rho, t]: [Interval; 2]) -> Option<Observed> {
        let e = self.direction(t);
        let force = e.map(|part| rho * part);
        let pull = Cell { face: self.face, at: force }.pull(self.system);
        let mut bars = Observed { pull, forces: vec![], directions: vec![], sizes: vec![] };
        let weights = self.system.weights(self.face);
        for (i, (sign, weight)) in self.signs.iter().zip(weights).enumerate() {
            if *sign == 0 {
                let way = self.way(i);
                bars.forces.push(force);
                bars.directions.push(e.map(|part| signed(way, part)));
                bars.sizes.push(signed(way, rho));
                continue;
            }
            let force = [force[0], force[1] + *weight];
            if force[0].contains(0.0) && force[1].contains(0.0) {
                return None;
            }
            bars.forces.push(force);
            bars.directions.push(unit(force).map(|part| signed(*sign, part)));
            bars.sizes.push(size(force));
        }
        Some(bars)
    }

    /// G.
    fn gap(&self, bars: &Observed) -> [Interval; 2] {
        let terms = bars.directions.iter().zip(&self.system.length);
        let sum = |k: usize| terms.clone().map(|(u, length)| *length * u[k]).sum::<Interval>();
        std::array::from_fn(|k| sum(k) - self.system.span[k])
    }

    /// The derivative of G by ρ and t, first index the component.
    pub(crate) fn slope(&self, bars: &Observed, [rho, t]: [Interval; 2]) -> [[Interval; 2]; 2] {
        let first = self.group.start;
        let e = bars.directions[first].map(|part| signed(self.way(first), part));
        let n = normal(e);
        let mut slope = [[Interval::ZERO; 2]; 2];
        for (i, sign) in self.signs.iter().enumerate() {
            if *sign == 0 {
                for (row, part) in slope.iter_mut().zip(n) {
                    row[1] = row[1] + signed(self.way(i), self.system.length[i]) * part;
                }
                continue;
            }
            // (I - f f^T)/|F| = g g^T/|F| with the normal g of f, whichever way f points.
            let g = normal(bars.directions[i]);
            let scale = signed(*sign, self.system.length[i] / bars.sizes[i]);
            let (by_rho, by_turn) = (dot(g, e) * scale, dot(g, n) * scale * rho);
            for (row, part) in slope.iter_mut().zip(g) {
                *row = [row[0] + by_rho * part, row[1] + by_turn * part];
            }
        }
        // e turns by dt/(1 + t²).
        let turn = Interval::ONE / (Interval::ONE + t.square());
        slope.map(|[by_rho, by_turn]| [by_rho, by_turn * turn])
    }

    /// Krawczyk's image of a box about a point of it.
    fn krawczyk(&self, at: &Cell, x: [f64; 2]) -> Option<Cell> {
        let slope = self.slope(&self.bars(at.at)?, at.at);
        let gap = self.gap(&self.bars(x.map(Interval::point))?);
        image(at, x, slope, gap)
    }

    /// All directions t that bar k, or its group, can have if its force is at most so large: with all forces of
    /// the disc at once the other bars leave the gap l_k e.
    pub(crate) fn directions(&self, radius: f64) -> Option<Interval> {
        let disc = Interval::new(-radius, radius);
        let mut left = self.system.span;
        for (i, sign) in self.signs.iter().enumerate().filter(|(_, sign)| **sign != 0) {
            let force = [disc, disc + self.system.weights(self.face)[i]];
            if force[0].contains(0.0) && force[1].contains(0.0) {
                return None;
            }
            let direction = unit(force);
            for k in 0..2 {
                left[k] = left[k] - signed(*sign, self.system.length[i] * direction[k]);
            }
        }
        let along = dot(self.axis, left);
        (along.lo() > 0.0).then(|| dot(normal(self.axis), left) / along)
    }

    /// A box of (ρ, t) that holds every zero whose |F_k| is at most `radius`, and exactly one:
    /// shrunk.
    pub(crate) fn only_one(&self, radius: f64) -> Option<Cell> {
        let disc = Interval::new(-radius, radius);
        let turned = self.directions(radius)?;
        let margin = WIDER * turned.width() + WIDER_BY;
        let whole = Cell {
            face: self.face,
            at: [disc, Interval::new(turned.lo() - margin, turned.hi() + margin)],
        };
        let image = |cell: &Cell| self.krawczyk(cell, cell.middle());
        let first = image(&whole)?;
        inside(&first, &whole).then(|| narrowed(&first, image))
    }

    /// The indices. The rotation rates of the other bars are the unknowns: that of bar k follows
    /// from the closure across it, and enters the second derivative with the factor
    /// $h_k = l_k \varrho$ alone,
    ///
    /// $$ \sum_{i \ne k} h_i \dot\theta_i^2 + h_k (w \cdot \dot\theta)^2, \qquad
    ///    b \cdot \dot\theta = 0, $$
    ///
    /// $h_i = s_i l_i |F_i|$, $b_i = l_i\\,e \cdot n_i$, $w_i = l_i\\,n_k \cdot n_i / l_k$. It has
    /// one negative direction less than bars are compressed where $b^T H^{-1} b < 0$. Out of the
    /// plane the closure is one equation, which bar k can meet without force: as many as are
    /// compressed. Of a group that carries nothing, ρ = 0 exactly, these are the directions across
    /// those in which its bars turn among themselves, where the second derivative vanishes.
    pub(crate) fn indices(&self, bars: &Observed, condition: f64) -> Option<Indices> {
        let k = self.group.start;
        let e = bars.directions[k];
        let n_k = normal(e);
        let (mut bb, mut bw, mut ww, mut out) = ([Interval::ZERO; 4]).into();
        for (i, sign) in self.signs.iter().enumerate().filter(|(_, sign)| **sign != 0) {
            let length = self.system.length[i];
            let h = signed(*sign, length * bars.sizes[i]);
            let n = normal(bars.directions[i]);
            let b = length * dot(e, n);
            let across = length / self.system.length[k];
            let w = across * dot(n_k, n);
            bb = bb + b.square() / h;
            bw = bw + b * w / h;
            ww = ww + w.square() / h;
            out = out + across.square() / h;
        }
        let h_k = self.system.length[k] * bars.sizes[k];
        let regular = [ww, out].map(|part| Interval::ONE + h_k * part);
        if regular.iter().any(|part| part.sign() != Some(1)) {
            return None;
        }
        let schur = bb - h_k * bw.square() / regular[0];
        let compressed = self.signs.iter().filter(|sign| **sign < 0).count();
        let less = match schur.sign()? {
            -1 => 1,
            1 => 0,
            _ => return None,
        };
        Some(Indices {
            in_plane: compressed.checked_sub(less)?,
            out_of_plane: compressed,
            condition,
        })
    }
}

fn normal([x, z]: [Interval; 2]) -> [Interval; 2] {
    [-z, x]
}

fn dot(a: [Interval; 2], b: [Interval; 2]) -> Interval {
    a[0] * b[0] + a[1] * b[1]
}

#[cfg(test)]
mod tests {
    use crate::run::plane::loads::JointLoads;
    use proptest::prelude::*;

    use super::*;
    use crate::run::closure::{Closure, Pattern};
    use crate::run::equilibrium::inertia;

    /// Four different bars, and the coordinates of bar 2 or 3 about some axis.
    fn axial_closure(
        system: &System,
        bar: usize,
        pattern: u32,
        axis: [f64; 2],
    ) -> AxialClosure<'_> {
        let signs = Pattern(pattern).signs(4).enumerate();
        AxialClosure {
            system,
            group: bar..bar + 1,
            along: vec![1],
            face: Face::Around(u8::try_from(bar).unwrap()),
            signs: signs.map(|(i, sign)| if i == bar { 0 } else { sign }).collect(),
            axis: axis.map(Interval::point),
        }
    }

    fn system() -> System {
        let bars = [(0.9, 1.0, 0.5), (1.1, 2.0, 0.75), (0.4, 1.0, 0.25), (0.7, 1.5, 0.3)];
        System::new(samples::chain(&bars, [1.0, 0.0, -0.5]).chain(), JointLoads::NONE)
    }

    fn axis() -> impl Strategy<Value = [f64; 2]> {
        (-3.1..3.1f64, 0.5..1.5f64)
            .prop_map(|(angle, size)| [size * angle.cos(), size * angle.sin()])
    }

    /// Forces of bar 2 or 3 that leave every other one alone.
    fn force() -> impl Strategy<Value = f64> {
        (1e-3..0.1f64, prop::bool::ANY).prop_map(|(size, pushed)| if pushed { -size } else { size })
    }

    /// Bar 1 hangs 0.9 m and bar 3 reaches 0.4 m up to the anchor 0.5 m below the first: bar 2 of 1
    /// m is level between them, without force.
    #[test]
    fn a_bar_that_just_bridges_its_gap_is_proved_to_rounding() {
        /// 2⁻²¹
        const RADIUS: f64 = f64::from_bits((1023 - 21) << 52);
        let bars = [(0.9, 1.0, 0.5), (1.0, 2.0, 0.75), (0.4, 1.0, 0.25)];
        let system = System::new(samples::chain(&bars, [1.0, 0.0, -0.5]).chain(), JointLoads::NONE);
        let axis = [Interval::ONE, Interval::ZERO];
        let closure = AxialClosure {
            system: &system,
            group: 1..2,
            along: vec![1],
            face: Face::Around(1),
            signs: vec![1, 0, 1],
            axis,
        };
        let only = closure.only_one(RADIUS).unwrap();
        for part in only.at {
            assert!(part.contains(0.0) && part.width() < 1e-14, "{part:?}");
        }
        // The other bars, upright, turn by as much as their force does, and rise by its square.
        let turned = closure.directions(RADIUS).unwrap();
        let square = RADIUS * RADIUS;
        assert!(turned.contains(0.0) && (square..4.0 * square).contains(&turned.width()));
    }

    proptest! {
        /// With bar k in tension or in compression G is the closure as a function of the pull.
        #[test]
        fn it_is_the_closure_in_other_coordinates(
            bar in 1..3_usize, pattern in 0..16_u32, axis in axis(), rho in force(), t in -2.0..2.0f64,
        ) {
            let system = system();
            let closure = axial_closure(&system, bar, pattern, axis);
            let bars = closure.bars([rho, t].map(Interval::point)).unwrap();
            let gap = closure.gap(&bars);
            let mut signs = closure.signs.clone();
            signs[bar] = if rho < 0.0 { -1 } else { 1 };
            // The direction by trigonometry.
            let angle = axis[1].atan2(axis[0]) + t.atan();
            let pull = [rho * angle.cos(), rho * angle.sin()];
            let known = Closure::gap_over(&system, &signs, &Cell::point(closure.face, pull));
            for k in 0..2 {
                prop_assert!((gap[k].mid() - known[k].mid()).abs() < 1e-12, "{gap:?} {known:?}");
                prop_assert!(gap[k].width() < 1e-13);
            }
        }

        /// With a bar under force the indices are those of the other formula, wherever both are
        /// sure.
        #[test]
        fn the_indices_are_those_of_loaded_bars(
            bar in 1..3_usize, pattern in 0..16_u32, axis in axis(), rho in force(), t in -2.0..2.0f64,
        ) {
            let system = system();
            let closure = axial_closure(&system, bar, pattern, axis);
            let bars = closure.bars([rho, t].map(Interval::point)).unwrap();
            let mut signs = closure.signs.clone();
            signs[bar] = if rho < 0.0 { -1 } else { 1 };
            let loaded = inertia::indices(&signs, &system.length, &bars.forces, false);
            if let (Some(found), Some(loaded)) = (closure.indices(&bars, 1.0), loaded) {
                prop_assert_eq!(found.in_plane, loaded.in_plane);
                // One closure out of the plane: an index less than bars are compressed where Σ l²/h
                // < 0.
                let inverse = signs.iter().zip(&system.length).zip(&bars.forces).map(|((s, l), f)| {
                    f64::from(*s) * l.mid() / f[0].mid().hypot(f[1].mid())
                });
                let compressed = signs.iter().filter(|sign| **sign < 0).count();
                let less = usize::from(inverse.sum::<f64>() < 0.0);
                prop_assert_eq!(found.out_of_plane, compressed - less);
            }
        }

        /// Its derivative is that of differences, at ρ = 0 too.
        #[test]
        fn the_slope_is_its_difference_quotient(
            bar in 1..3_usize, pattern in 0..16_u32, axis in axis(), rho in force(), t in -2.0..2.0f64,
            none in prop::bool::ANY,
        ) {
            let system = system();
            let closure = axial_closure(&system, bar, pattern, axis);
            let x = [if none { 0.0 } else { rho }, t];
            let at = x.map(Interval::point);
            let slope = closure.slope(&closure.bars(at).unwrap(), at);
            for j in 0..2 {
                let gap = |h: f64| {
                    let mut x = x;
                    x[j] += h;
                    closure.gap(&closure.bars(x.map(Interval::point)).unwrap()).map(Interval::mid)
                };
                let quotient = |h: f64, k: usize| (gap(h)[k] - gap(-h)[k]) / (2.0 * h);
                for (k, row) in slope.iter().enumerate() {
                    let expected = (4.0 * quotient(1e-4, k) - quotient(2e-4, k)) / 3.0;
                    prop_assert!((row[j].mid() - expected).abs() < 1e-8, "{row:?} {expected}");
                }
            }
        }
    }
}
