//! The sharp bend of a deep chain, bar by bar.

use std::ops::Range;

use model::{VERTICAL_TOLERANCE, Vector};

use crate::run::coarse::Grouped;
use crate::run::scaled_chain::ScaledChain;
use crate::run::vertical_plane::Turn;
use crate::vector::{VectorSum, along, dot, norm, scaled};

/// Neighbouring groups of bars that turn by more than this cosine are too long to follow the chain
/// there.
const SHARP: f64 = 0.5;

/// Groups on either side of the bend that are solved again: the bend of a hanging chain is a few
/// bars wide where a group is too long for it, and what is left of it four groups up is a nearly
/// straight strand.
const SIDE: usize = 4;

impl Grouped {
    /// The bars around the sharpest bend of the chain of groups, if it is sharp and they are less
    /// than half of all.
    pub(crate) fn bend(&self, u: &[Vector]) -> Option<Range<usize>> {
        let cosines = u.windows(2).map(|pair| dot(pair[0], pair[1]));
        let (k, sharpest) = cosines.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
        if sharpest > SHARP {
            return None;
        }
        let sizes = &self.sizes;
        let (first, last) = ((k + 1).saturating_sub(SIDE), (k + 1 + SIDE).min(sizes.len()));
        let bars = |groups: Range<usize>| sizes[groups].iter().sum::<usize>();
        let (before, bend) = (bars(0..first), bars(first..last));
        let all = before + bend + bars(last..sizes.len());
        (2 * bend <= all).then_some(before..before + bend)
    }
}

impl ScaledChain {
    /// Some of the bars as a chain of its own between the places where the directions `u` have its
    /// ends, in its own units and turned into the plane of the frame; with the turn. `None` if
    /// nothing hangs between them.
    ///
    /// With its ends held, what the part has to lose is what the whole has to lose by it: a
    /// multiple of `l_i` taken off all of its `l_i h_i` is worth a constant.
    pub(crate) fn part(&self, bars: Range<usize>, u: &[Vector]) -> Option<(Self, Turn)> {
        let (length, carried) = (&self.length[bars.clone()], &self.carried[bars.clone()]);
        let (highest, lowest) = (*carried.first()?, *carried.last()?);
        let between = highest - lowest;
        let total: f64 = length.iter().sum();
        let mut span = VectorSum::default();
        length.iter().zip(&u[bars]).for_each(|(l, u)| span.add(scaled(*l, *u)));
        let span = scaled(1.0 / total, span.value());
        let turn = Turn::heading(self, span);
        let [x, _, z] = turn.of(&[span])[0];
        let span = [x, 0.0, z];
        let level = along(span, -dot(span, self.up), self.up);
        let part = Self {
            length: length.iter().map(|l| l / total).collect(),
            carried: carried.iter().map(|h| (h - 0.5 * (highest + lowest)) / between).collect(),
            span: [span, [0.0; 3]],
            up: self.up,
            vertical: norm(level) <= VERTICAL_TOLERANCE,
            motion: self.motion,
        };
        (between > 0.0).then_some((part, turn))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::settings::Motion;

    /// A chain of a hundred equal bars that hangs from two near anchors.
    fn deep() -> ScaledChain {
        let n = 100;
        ScaledChain {
            length: vec![0.01; n],
            carried: (0..n).map(|i| 0.495 - 0.01 * i as f64).collect(),
            span: [[0.013, 0.0, 0.0], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion: Motion::Space,
        }
    }

    #[test]
    fn only_a_sharp_bend_is_one() {
        let links = ScaledChain { length: vec![0.001; 1000], carried: vec![0.0; 1000], ..deep() };
        let grouped = links.grouped().unwrap();
        let groups = grouped.links.bars();
        let hairpin = |k: usize| if k < groups / 2 { [0.0, 0.0, -1.0] } else { [0.0, 0.0, 1.0] };
        let u: Vec<Vector> = (0..groups).map(hairpin).collect();
        let range = grouped.bend(&u).unwrap();
        assert_eq!(range, 8 * (groups / 2 - 4)..8 * (groups / 2 + 4));
        let arc = grouped.links.arc();
        assert_eq!(grouped.bend(&arc), None);
    }

    /// Turning bars of the part changes its energy and that of the whole alike, but for the unit.
    #[test]
    fn a_part_has_the_energy_of_the_whole_but_for_a_constant() {
        let links = deep();
        let heading = 0.6_f64;
        let tilted = |k: usize| {
            let (s, c) = (0.3 * k as f64).sin_cos();
            [s * heading.cos(), s * heading.sin(), c]
        };
        let mut u: Vec<Vector> = (0..links.bars()).map(tilted).collect();
        let bars = 40..60;
        let (part, turn) = links.part(bars.clone(), &u).unwrap();
        let inside = |u: &[Vector]| part.measure(&turn.of(&u[bars.clone()]));
        let (before, whole) = (inside(&u), links.measure(&u));
        assert!(norm(before.gap) < 1e-14, "{:?}", before.gap);
        // Two bars that change places leave the ends where they are.
        u.swap(43, 55);
        let (after, moved) = (inside(&u), links.measure(&u));
        assert!(norm(after.gap) < 1e-14, "{:?}", after.gap);
        let unit = 0.2 * (links.carried[40] - links.carried[59]);
        let (fall, of_whole) = (before.value - after.value, whole.value - moved.value);
        assert!(fall.abs() > 1e-3 && (unit * fall - of_whole).abs() < 1e-15, "{fall} {of_whole}");
    }

    #[test]
    fn bars_without_weight_are_no_chain_to_minimise() {
        let links = ScaledChain { carried: vec![0.25; 100], ..deep() };
        assert!(links.part(10..20, &links.arc()).is_none());
        let (part, _) = deep().part(10..20, &deep().arc()).unwrap();
        assert!((part.length.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        // Its weights count from the middle, from one half to minus one half.
        assert!((part.carried[0] - 0.5).abs() < 1e-13 && (part.carried[9] + 0.5).abs() < 1e-13);
    }
}
