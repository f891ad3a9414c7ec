//! Second-order behaviour from the signs and the derivative of the closure.
//!
//! Turning bar i a little costs $l_i s_i|F_i|$ in every direction across it, so on the motions in
//! the plane and on those out of it the second derivative of the Lagrangian is diagonal, under two
//! linear conditions and one. Haynsworth's formula for such a bordered matrix gives the indices:
//!
//! $$ \mathrm{index} = \\#\\{s_i = -1\\} + \\#\\{\text{positive eigenvalues of } S\\} - m, $$
//!
//! in the plane with $m = 2$ and S the derivative of the closure by the pull, which Newton's method
//! has at hand; out of it with $m = 1$ and $S = \sum s_i l_i/|F_i| = D_h/H$, the horizontal closure
//! divided by the horizontal pull. It is the inertia of the whole stress matrix for the price of
//! three pivots.
//!
//! E. V. Haynsworth, Linear Algebra Appl. 1 (1968) 73-81, doi:10.1016/0024-3795(68)90050-5

use model::{InPlane, InSpace, Stability};

use super::chain::Condensed;
use super::pull::{Pull, Signs};
use crate::thresholds::GIVEN;

/// Stability, dimension of the null space of the closure's derivative in space, and its condition.
#[derive(Debug, Clone, Copy)]
pub(super) struct SecondOrder {
    pub stability: Stability,
    pub nullity: usize,
    pub condition: f64,
}

pub(super) fn second_order(chain: &Condensed, pull: &Pull) -> SecondOrder {
    let compressed = match &pull.signs {
        Signs::Tension => 0,
        Signs::Compressed(_) => 1,
        Signs::Unloaded(bars) => return unloaded(chain, bars.len()),
    };
    let [first, second] = pull.pivots;
    let freedoms = chain.bars() - 2;
    // With every bar in tension the diagonal is positive, however singular the closure; and what
    // cannot move has nothing that could vanish.
    let degenerate = compressed > 0
        && freedoms > 0
        && (second.abs() <= GIVEN * pull.remainder_of || first.abs() <= f64::MIN_POSITIVE);
    let positive = [first, second].iter().filter(|pivot| **pivot > 0.0).count();
    let positive = if degenerate { usize::from(first > 0.0) } else { positive };
    let horizontal = chain.across_in(pull.level) / pull.force[0];
    let vertical = chain.on_one_vertical;
    // With H = 0 all bars hang straight down in tension, and the sum is positive.
    let towards = pull.force[0].abs() <= 0.0 || (!vertical && horizontal > 0.0);

    let index_in_plane = (compressed + positive).saturating_sub(2);
    let index_out_of_plane = (compressed + usize::from(towards)).saturating_sub(1);
    let index_in_space = index_in_plane + index_out_of_plane;
    let stability = Stability::of([index_in_plane, index_in_space], freedoms, degenerate);
    let out_of_plane = if vertical { 0.0 } else { horizontal };
    let values = [first, if degenerate { 0.0 } else { second }, out_of_plane].map(f64::abs);
    let regular = || values.into_iter().filter(|value| *value > 0.0 && value.is_finite());
    let (least, largest) =
        regular().fold((f64::INFINITY, 0.0_f64), |(a, b), x| (a.min(x), b.max(x)));
    SecondOrder {
        stability,
        nullity: 3 - regular().count(),
        condition: if largest > 0.0 { (largest / least).min(f64::MAX) } else { 1.0 },
    }
}

/// Bars without force, all others in tension: the least energy, and not only here. What moves at no
/// cost moves the unloaded bars alone, as far as they keep their ends where they are: two
/// conditions in the plane (one where they are straight) and one out of it.
fn unloaded(chain: &Condensed, bars: usize) -> SecondOrder {
    let gap = chain.span.across.hypot(chain.bottom.gap);
    let room = chain.bottom.room(gap);
    // The directions of the bars, like the root of the room, are within 1e-6 of one line then.
    let straight = room <= GIVEN * chain.bars.total_length;
    // Two bars between fixed ends cannot move in the plane, however straight.
    let in_plane = bars.saturating_sub(if straight && chain.bars() > 2 { 1 } else { 2 });
    let across = bars - 1;
    SecondOrder {
        stability: Stability {
            in_plane: if in_plane > 0 { InPlane::Degenerate } else { InPlane::Minimum },
            index_in_plane: 0,
            in_space: InSpace::Stable,
            index_in_space: 0,
        },
        // The force at the bottom is fixed, nothing is solved; these are the free motions.
        nullity: in_plane + across,
        condition: 1.0,
    }
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar, Chain, Problem};

    use super::*;
    use crate::condensed::settings::Settings;
    use crate::condensed::vectors::Vectors;

    const LENGTHS: [f64; 2] = [1.4, 1.0];
    const MASSES: [f64; 3] = [0.7, 0.4, 1.1];
    /// Between the lower ends of the strands when they hang straight down: 3, 4, 5.
    const ACROSS: f64 = 0.3;

    /// Two strands of one bar each, and between them one that is longer than their gap by `excess`.
    fn chain(excess: f64) -> (Condensed, f64) {
        let middle = 0.5 * (1.0 + excess);
        let bars = [LENGTHS[0], middle, LENGTHS[1]].into_iter().zip(MASSES);
        let bars = bars.map(|(length, mass)| Bar::homogeneous(length, mass).unwrap()).collect();
        let anchors = Anchors { start_m: [0.0; 3], end_m: [ACROSS, 0.0, 0.0] };
        let chain = Chain::new("propped", 1.0, anchors, bars).unwrap();
        (Condensed::new(&Problem::new(chain).unwrap()), middle)
    }

    /// Potential energy of the four-bar linkage whose first bar is `angle` from the descending
    /// vertical: the other joint of two circles. It lies to the right.
    fn energy(angle: f64, middle: f64) -> f64 {
        let first = [LENGTHS[0] * angle.sin(), -LENGTHS[0] * angle.cos()];
        let d = [ACROSS - first[0], -first[1]];
        let distance = d[0].hypot(d[1]);
        let along =
            (distance * distance + middle * middle - LENGTHS[1] * LENGTHS[1]) / (2.0 * distance);
        let aside = (middle * middle - along * along).sqrt();
        let second = first[1] + (d[1] * along - d[0] * aside) / distance;
        0.5 * (MASSES[0] * first[1] + MASSES[1] * (first[1] + second) + MASSES[2] * second)
    }

    /// Where the propping bar carries next to nothing, the pivot is small beside its terms, and the
    /// linkage of one freedom is at a minimum all the same: its energy says so by differences.
    #[test]
    fn a_small_pivot_is_no_degenerate_one() {
        for (excess, low, high) in
            [(1e-3, 1e-5, 1e-2), (1e-5, 1e-7, 1e-4), (1e-7, 1e-9, 1e-6), (1e-9, 1e-11, 1e-8)]
        {
            let (chain, middle) = chain(excess);
            let pull = chain.pull(&Settings::default()).unwrap();
            let ratio = pull.pivots[1].abs() / pull.remainder_of;
            assert!((low..high).contains(&ratio), "{excess:e}: {ratio:e}");
            assert_eq!(pull.compressed(), [1]);

            let found = second_order(&chain, &pull);
            let mut places = Vectors::default();
            chain.vectors(&pull, &mut places);
            let [x, _, z] = places.joints_m[1];
            let angle = x.atan2(-z);
            let [left, here, right] = [-1e-3, 0.0, 1e-3].map(|step| energy(angle + step, middle));
            assert!((right - left).abs() < 1e-8, "the slope of the energy vanishes");
            assert!(right + left - 2.0 * here > 1e-7, "the energy is curved upwards");
            assert_eq!(found.stability.in_plane, InPlane::Minimum, "{excess:e}: {ratio:e}");
            assert_eq!(found.stability.index_in_plane, 0);
            assert_eq!(found.nullity, 0);
        }
    }

    /// Nor is a large one, and one that vanishes is.
    #[test]
    fn a_pivot_of_zero_is_degenerate() {
        let (chain, _) = chain(1e-3);
        let mut pull = chain.pull(&Settings::default()).unwrap();
        pull.pivots[1] = 0.0;
        assert_eq!(second_order(&chain, &pull).stability.in_plane, InPlane::Degenerate);
    }
}
