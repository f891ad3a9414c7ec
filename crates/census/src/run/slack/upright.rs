//! Pulls next to those of upright positions, and next to infinite ones between anchors in one
//! point.
//!
//! Anchors on one vertical hold a chain whose lengths fit upright, $\sum_i \epsilon_i l_i = D_z$,
//! with any pull along the vertical: lines H = 0 of zeros of the closure. Between anchors in one
//! point, D = 0, lengths that cancel, $\sum_i s_i l_i = 0$, make every infinite pull a zero. Neither
//! is isolated, so both are divided out; what is left has no zero near by. With
//!
//! $$ \sigma = \sum_i \frac{s_i l_i}{|F_i|}, \qquad
//!    \pi = \sum_i \frac{s_i l_i c_i}{|F_i|}, \qquad
//!    \chi = \sum_i \frac{s_i b_i l_i}{|F_i| (|F_i| + |V + c_i w|)}, $$
//!
//! where $b_i$ is the sign of $V + c_i w$:
//!
//! - The level part of the closure is H σ. So σ = 0 at every equilibrium that is not upright.
//! - Where $\sum_i s_i b_i l_i = D_z$ exactly, the upright part is −H² χ. So χ = 0 there, too.
//!   At H = 0, χ is half the derivative of −σ by V: both vanish only at a double zero of σ.
//! - For D = 0 the upright part is V σ + w π. So π = 0 there, too.
//! - Where one bar k has no force, $F_k = \varrho e$, the level part is $e_x (\varrho
//!   \sum_{i \ne k} s_i l_i / |F_i| + l_k)$; of bars in a row that lose their force together, parallel
//!   where they have one, $l_k$ is the sum of their signed lengths.
//!   If that is zero, known from integers, the sum over the others alone is left.
//!
//! # Infinite pulls between anchors in one point
//!
//! If the moments $M_j = \sum_i s_i l_i c_i^j$ vanish for j < k, exactly, and $M_k$ does not, then σ
//! has the factor w^k and π the factor w^(k−1). With the generating function of the Legendre
//! polynomials, $(1 - 2 x t + t^2)^{-1/2} = \sum_j P_j(x) t^j$, and Taylor's theorem in t = −c w,
//!
//! $$ \frac{\sigma}{w^k} = (-1)^k \sum_i s_i l_i c_i^k \frac{P_k(x_i)}{\varrho_i^{k+1}}, \qquad
//!    \frac{\pi}{w^{k-1}} = (-1)^{k-1} \sum_i s_i l_i c_i^k \frac{P_{k-1}(y_i)}{\eta_i^k}, $$
//!
//! where $\varrho_i$ and $x_i$ are the size and the upright cosine of a force between q = (H, V) and
//! $F_i = q + c_i w e_z$, and so are $\eta_i$ and $y_i$. In the limit w = 0 these are $\pm M_k P_k$
//! and $\mp M_k P_{k-1}$ at the direction of q: successive Legendre polynomials have no common zero,
//! so that no equilibrium is near an infinite pull but upright ones.
//!
//! # References
//!
//! NIST Digital Library of Mathematical Functions, <https://dlmf.nist.gov/18.12>, (18.12.11), and
//! <https://dlmf.nist.gov/18.9>, (18.9.1)

use numerics::Interval;

use crate::run::closure::bar::{size, unit};
use crate::run::closure::{Pattern, signed};
use crate::run::plane::cell::Cell;
use crate::run::plane::system::System;

/// Whether every equilibrium of a pattern in a cell about H = 0 is upright, besides those in which a
/// group carries nothing. `fits` are the ways in which the bars fit upright, sorted: the patterns of
/// those that point back; `lengths` are integers.
pub(super) fn upright_alone(
    system: &System,
    cell: &Cell,
    pattern: Pattern,
    fits: &[Pattern],
    lengths: &[i128],
) -> bool {
    let bars = system.bars();
    let weights = system.weights(cell.face);
    let mut free = None;
    let (mut level, mut deflated) = (Interval::ZERO, Interval::ZERO);
    // The bars that point back, if it is known of all.
    let mut back = Some(0);
    let way = if system.span[1].hi() < 0.0 { -1 } else { 1 };
    for group in &system.groups {
        let force = cell.force(weights[group.start]);
        if force[0].contains(0.0) && force[1].contains(0.0) {
            // Bars that lose their force at other pulls.
            if free.is_some() {
                return false;
            }
            let way = |i| pattern.sign(bars, i);
            let reach: Interval = group.clone().map(|i| signed(way(i), system.length[i])).sum();
            let exactly: i128 = group.clone().map(|i| i128::from(way(i)) * lengths[i]).sum();
            free = Some((if exactly == 0 { Interval::ZERO } else { reach }, force));
            continue;
        }
        let size = size(force);
        let up = force[1].sign().filter(|up| *up != 0);
        for i in group.clone() {
            let sign = pattern.sign(bars, i);
            let term = signed(sign, system.length[i] / size);
            level = level + term;
            deflated = deflated + signed(up.unwrap_or(1), term / (size + force[1].abs()));
            let bit = |up: i8| if sign * up * way < 0 { Pattern::bit(bars, i) } else { 0 };
            back = back.zip(up).map(|(all, up)| all | bit(up));
        }
    }
    match free {
        None => {
            let fits = |back| fits.binary_search(&Pattern(back)).is_ok();
            !level.contains(0.0) || back.is_some_and(fits) && !deflated.contains(0.0)
        }
        // The force of the one group, of either sign, times the sum of the others.
        Some((reach, _)) if reach == Interval::ZERO => !level.contains(0.0),
        Some((reach, force)) => {
            let most = Interval::point(size(force).hi()) * Interval::point(level.mag());
            most.hi() < reach.mig()
        }
    }
}

/// Between anchors in one point: whether every zero of a pattern in a cell has H = 0 or an infinite
/// pull. `first` is the order of the first moment of the pattern that does not vanish, if it is
/// known.
pub(super) fn upright_or_infinite(
    system: &System,
    cell: &Cell,
    pattern: Pattern,
    first: Option<u32>,
) -> bool {
    let order = first.unwrap_or(1).max(1);
    if system.span[1] != Interval::ZERO {
        return false;
    }
    [[order, order - 1], [first.unwrap_or(0); 2]].into_iter().any(|orders| {
        remainder(system, cell, pattern, orders).is_some_and(|sum| !sum.contains(0.0))
    })
}

/// $\sum_i s_i l_i c_i^m P_j(x_i)/\varrho_i^{j+1}$ over the forces between the pull and those of the
/// bars; `None` if one of them may vanish. Taylor's remainder of order 0 is the value itself.
fn remainder(
    system: &System,
    cell: &Cell,
    pattern: Pattern,
    [power, order]: [u32; 2],
) -> Option<Interval> {
    let mut sum = Interval::ZERO;
    let bars = system.length.iter().zip(system.weights(cell.face));
    for ((length, weight), sign) in bars.zip(pattern.signs(system.bars())) {
        let between = if order == 0 { *weight } else { Interval::ZERO.hull(*weight) };
        let force = cell.force(between);
        let size = size(force);
        if size.lo() <= 0.0 {
            return None;
        }
        let mut term = signed(sign, *length / size) * legendre(order, unit(force)[1]);
        for _ in 0..power {
            term = term * *weight;
        }
        for _ in 0..order {
            term = term / size;
        }
        sum = sum + term;
    }
    Some(sum)
}

/// The Legendre polynomial over cosines.
fn legendre(order: u32, x: Interval) -> Interval {
    let (mut before, mut here) = (Interval::ONE, x);
    if order == 0 {
        return before;
    }
    for k in 1..order {
        let number = |k: u32| Interval::point(f64::from(k));
        let next = (number(2 * k + 1) * x * here - number(k) * before) / number(k + 1);
        // None exceeds 1 between −1 and 1.
        before = here;
        here = next.intersect(Interval::new(-1.0, 1.0)).unwrap_or(next);
    }
    here
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar, Chain};

    use super::*;
    use crate::run::plane::face::Face;
    use crate::run::plane::loads::JointLoads;

    #[test]
    fn legendre_polynomials_have_their_closed_forms() {
        for x in [-1.0, -0.7, -0.25, 0.0, 0.3, 0.8, 1.0_f64] {
            let forms = [
                1.0,
                x,
                0.5 * (3.0 * x * x - 1.0),
                0.5 * (5.0 * x.powi(3) - 3.0 * x),
                0.125 * (35.0 * x.powi(4) - 30.0 * x * x + 3.0),
                0.125 * (63.0 * x.powi(5) - 70.0 * x.powi(3) + 15.0 * x),
            ];
            for (order, form) in (0..).zip(forms) {
                let found = legendre(order, Interval::point(x));
                assert!((found.mid() - form).abs() < 1e-14, "{order} {x}: {found:?} {form}");
                assert!(found.width() < 1e-14 && found.mag() <= 1.0);
            }
        }
    }

    /// Bars of 1, 2 and 1 m, in a unit of 4 m, with the weights of the chain: sums of
    /// `s l c^m P_j(x)/ϱ^{j+1}`, at the weights themselves and within what lies between them and
    /// nothing.
    #[test]
    fn remainders_are_sums_over_the_bars() {
        let bars =
            [1.0, 2.0, 1.0].map(|length| Bar::homogeneous(length, 2.0 - 0.5 * length).unwrap());
        let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0; 3] };
        let chain = Chain::new("closed", 10.0, anchors, bars.to_vec()).unwrap();
        let system = System::new(&chain, JointLoads::NONE);
        let [h, v] = [1.5, 2.0];
        let cell = Cell::point(Face::Near, [h, v]);
        let signs = [1.0, 1.0, -1.0];
        let pattern = Pattern(Pattern::bit(3, 2));
        let by_hand = |power: i32, order: i32, part: f64| -> f64 {
            let bars = system.length.iter().zip(&system.weight).zip(signs);
            bars.map(|((length, weight), sign)| {
                let c = weight.mid();
                let size = h.hypot(v + part * c);
                let x = (v + part * c) / size;
                let legendre = [1.0, x, 0.5 * (3.0 * x * x - 1.0)];
                let legendre = legendre[usize::try_from(order).unwrap()];
                sign * length.mid() * c.powi(power) * legendre / size.powi(order + 1)
            })
            .sum()
        };
        for power in 0..3 {
            let found = remainder(&system, &cell, pattern, [power, 0]).unwrap();
            let wanted = by_hand(i32::try_from(power).unwrap(), 0, 1.0);
            assert!(
                (found.mid() - wanted).abs() < 1e-14 && found.width() < 1e-13,
                "{found:?} {wanted}"
            );
        }
        for (power, order) in [(2, 1), (3, 2)] {
            let found = remainder(&system, &cell, pattern, [power, order]).unwrap();
            let [power, order] = [power, order].map(|k| i32::try_from(k).unwrap());
            for part in [0.0, 0.5, 1.0] {
                assert!(found.contains(by_hand(power, order, part)), "{found:?} {part}");
            }
        }
        // A force that may vanish is divided by nothing.
        let lost = Cell::point(Face::Near, [0.0, -system.weight[0].mid()]);
        assert_eq!(remainder(&system, &lost, pattern, [0, 0]), None);
    }
}
