//! Which way a chain is solved: decided from its data alone, before any iteration.
//!
//! The table stands in [the crate](crate#regimes). Two questions lead to a regime: what holds the
//! lowest bar (the lemma of the module `bottom`), and whether the chain is so nearly straight,
//! folded or doubled that its closure must be written along an axis to keep its digits.

mod indeterminate;
mod side_by_side;
mod strut;
mod taut;
mod tension;
mod triangle;
mod unloaded;

pub(super) use unloaded::fill;

use super::chain::Condensed;
use super::newton::Budget;
use super::pull::Pull;
use crate::thresholds::{CLOSURE_ROUNDING, NEARLY_STRAIGHT};

/// The way a chain is solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Regime {
    /// Every bar in tension.
    Tension,
    /// Every bar in tension, the chain nearly straight between its anchors.
    Taut,
    /// Every bar in tension, in two nearly vertical strands side by side.
    SideBySide,
    /// The lowest bar in compression, all others in tension.
    Strut,
    /// The same, the chain nearly straight between its anchors.
    TautStrut,
    /// The same, the other bars folded back along it on the line of the anchors.
    FoldedStrut,
    /// The lowest bar in compression, the anchors on one vertical.
    VerticalStrut,
    /// Two bars over anchors that are next to each other.
    Triangle,
    /// The lowest bars carry no force and fill the gap between two vertical strands.
    Unloaded,
    /// Anchors on one vertical and two vertical strands that just meet: how they share the weight
    /// of the joint between them is indeterminate.
    Indeterminate,
}

impl Regime {
    /// The regime of a chain.
    pub fn of(chain: &Condensed) -> Self {
        if chain.bars() == 2 && chain.span.distance < NEARLY_STRAIGHT * chain.bars.total_length {
            return Self::Triangle;
        }
        let (bottom, across) = (&chain.bottom, chain.span.across);
        let gap = across.hypot(bottom.gap);
        let rounding = CLOSURE_ROUNDING * chain.bars.total_length;
        // |G|² less the square of the length. Anchors that are a little apart pull strands of equal
        // depth together, though the gap is no longer than the bar in any of its digits.
        let terms = [across * across, bottom.over * (bottom.gap.abs() + bottom.length)];
        let excess = terms[0] + terms[1];
        if across <= rounding && bottom.over.abs() <= rounding {
            Self::Indeterminate
        } else if excess > CLOSURE_ROUNDING * (terms[0] + terms[1].abs()) {
            Self::in_tension(chain)
        } else if gap < bottom.shortest_reach - rounding {
            Self::in_compression(chain)
        } else {
            Self::Unloaded
        }
    }

    fn in_tension(chain: &Condensed) -> Self {
        if nearly_straight(chain, chain.bars.total_length) {
            Self::Taut
        } else if side_by_side(chain) {
            Self::SideBySide
        } else {
            Self::Tension
        }
    }

    fn in_compression(chain: &Condensed) -> Self {
        let (bottom, total) = (&chain.bottom, chain.bars.total_length);
        if nearly_straight(chain, total - bottom.length + bottom.shortest_reach) {
            Self::TautStrut
        } else if nearly_folded(chain) {
            Self::FoldedStrut
        } else if chain.on_one_vertical {
            Self::VerticalStrut
        } else {
            Self::Strut
        }
    }

    /// Solve a chain of this regime; where the way of the regime does not lead to the end, by the
    /// fallback of the table, if it has one. `None` when that fails, too: the passes over the bars ran
    /// out, or rounding errors prevent a closure within the settings.
    pub fn solve(self, chain: &Condensed, budget: &mut Budget) -> Option<Pull> {
        match self {
            Self::Tension => tension::solve(chain, budget),
            Self::Taut => taut::solve(chain, budget),
            Self::SideBySide => side_by_side::solve(chain, budget),
            Self::Strut => strut::solve(chain, budget),
            Self::TautStrut => strut::taut(chain, budget),
            Self::FoldedStrut => strut::folded(chain, budget),
            Self::VerticalStrut => strut::vertical(chain, budget),
            Self::Triangle => triangle::solve(chain),
            Self::Unloaded => Some(unloaded::solve(chain)),
            Self::Indeterminate => indeterminate::solve(chain, budget),
        }
    }
}

/// Whether a chain that reaches so far when straight has hardly more than its span asks for.
fn nearly_straight(chain: &Condensed, reach: f64) -> bool {
    reach - chain.span.distance < NEARLY_STRAIGHT * chain.bars.total_length
}

/// Whether the compressed bar is longer than all others together, and hardly shorter than these and the span.
fn nearly_folded(chain: &Condensed) -> bool {
    let (bottom, total) = (&chain.bottom, chain.bars.total_length);
    let others = || chain.length_in_tension(true).plus(-bottom.shortest_reach).value();
    total - bottom.length - bottom.shortest_reach + chain.span.distance < NEARLY_STRAIGHT * total
        && others() < 0.0
}

/// Whether the strands hang nearly vertically, and equally deep.
fn side_by_side(chain: &Condensed) -> bool {
    let (across, bottom) = (chain.span.across, &chain.bottom);
    across < NEARLY_STRAIGHT * chain.bars.total_length
        && bottom.over.abs() < NEARLY_STRAIGHT * bottom.length
}

#[cfg(test)]
mod tests {
    use model::{Anchors, Bar, Chain, Problem, Vector};

    use super::*;

    /// A chain of bars of the given lengths and masses, from the origin to `end_m`.
    fn regime(lengths: &[f64], masses: &[f64], end_m: Vector) -> Regime {
        let bars = lengths.iter().zip(masses);
        let bars = bars.map(|(length, mass)| Bar::homogeneous(*length, *mass).unwrap()).collect();
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        let chain = Chain::new("table", 9.81, anchors, bars).unwrap();
        Regime::of(&Condensed::new(&Problem::new(chain).unwrap()))
    }

    #[test]
    fn every_regime_has_its_chain() {
        let light = [1.0, 1.0, 0.0, 0.0, 1.0, 1.0];
        for (expected, lengths, masses, end_m) in [
            (Regime::Tension, &[1.0; 3][..], &[1.0; 3][..], [1.5, 0.0, 0.0]),
            (Regime::Taut, &[0.25; 4], &[1.0; 4], [0.9995, 0.0, 0.0]),
            (Regime::SideBySide, &[1.0; 4], &[1.0; 4], [1e-4, 0.0, 0.0]),
            (Regime::Strut, &[1.0; 3], &[1.0; 3], [0.5, 0.0, 0.0]),
            (Regime::TautStrut, &[1.0; 3], &[1.0; 3], [0.0, 0.0, -2.999]),
            (Regime::FoldedStrut, &[0.5, 2.0, 0.5], &[1.0; 3], [1.0005, 0.0, 0.0]),
            (Regime::VerticalStrut, &[1.0; 3], &[1.0; 3], [0.0, 0.0, -2.0]),
            (Regime::Triangle, &[1.0; 2], &[1.0; 2], [0.0, 0.0, 1e-3]),
            (Regime::Unloaded, &[1.0; 6], &light, [1.0, 0.0, 0.0]),
            (Regime::Indeterminate, &[1.0; 4], &[1.0; 4], [0.0; 3]),
        ] {
            assert_eq!(regime(lengths, masses, end_m), expected, "{lengths:?} {end_m:?}");
        }
    }

    /// On both sides of each threshold.
    #[test]
    fn regimes_change_at_their_thresholds() {
        let four = |end_m| regime(&[0.25; 4], &[1.0; 4], end_m);
        assert_eq!(four([1.0 - 0.9 * NEARLY_STRAIGHT, 0.0, 0.0]), Regime::Taut);
        assert_eq!(four([1.0 - 1.1 * NEARLY_STRAIGHT, 0.0, 0.0]), Regime::Tension);
        // Strands of equal depth: apart by more than rounding they are pulled together, ...
        assert_eq!(four([0.5 * CLOSURE_ROUNDING, 0.0, 0.0]), Regime::Indeterminate);
        assert_eq!(four([2.0 * CLOSURE_ROUNDING, 0.0, 0.0]), Regime::SideBySide);
        // ... and are no strands side by side where they are as far apart as a bar may be tilted.
        assert_eq!(four([0.9 * NEARLY_STRAIGHT, 0.0, 0.0]), Regime::SideBySide);
        assert_eq!(four([1.1 * NEARLY_STRAIGHT, 0.0, 0.0]), Regime::Tension);
        // The strands are one bar deeper on one side: at the length of that bar it changes sides.
        let three = |across: f64| regime(&[1.0; 3], &[1.0; 3], [across, 0.0, 0.0]);
        assert_eq!(three(1.0 - 1e-12), Regime::Strut);
        assert_eq!(three(1.0 + 1e-12), Regime::Tension);
        // Two bars over anchors that are so near.
        let two = |across: f64| regime(&[0.5; 2], &[1.0; 2], [across, 0.0, 0.0]);
        assert_eq!(two(0.9 * NEARLY_STRAIGHT), Regime::Triangle);
        assert_eq!(two(1.1 * NEARLY_STRAIGHT), Regime::Tension);
        // The fold: slack against span.
        let fold =
            |long: f64, across: f64| regime(&[0.5, long, 0.5], &[1.0; 3], [across, 0.0, 0.0]);
        assert_eq!(fold(1.2, 0.2001), Regime::FoldedStrut);
        assert_eq!(fold(1.0, 0.0009), Regime::Strut);
        assert_eq!(fold(0.95, 0.1), Regime::Strut);
    }

    /// Bars of 3 and 1 without load reach from 2 to 4, folded and stretched: in between, and where
    /// they just do, they carry nothing.
    #[test]
    fn bars_without_load_fill_what_they_reach() {
        let gap = |across: f64| {
            let (lengths, light) = ([2.0, 2.0, 3.0, 1.0, 2.0, 2.0], [1.0, 1.0, 0.0, 0.0, 1.0, 1.0]);
            regime(&lengths, &light, [across, 0.0, 0.0])
        };
        assert_eq!(gap(2.0 - 1e-9), Regime::Strut);
        assert_eq!(gap(2.0), Regime::Unloaded);
        assert_eq!(gap(2.0 + 1e-9), Regime::Unloaded);
        assert_eq!(gap(4.0 - 1e-9), Regime::Unloaded);
        assert_eq!(gap(4.0 + 1e-9), Regime::Tension);
    }
}
