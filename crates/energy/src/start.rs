//! A first shape from no guess.

use model::Vector;

use crate::closure::Shape;
use crate::links::Links;
use crate::vector::{along, dot, norm, scaled, unit};

/// Bisections for the opening of the arc: all digits of a double.
const BISECTIONS: u32 = 60;

impl Links {
    /// Directions along a circular arc of the chain's length through both anchors, hanging below their chord
    /// (beside it when the chord is vertical), one for the middle of each bar.
    ///
    /// The arc turns from `-gamma` to `+gamma` about the chord, `sin(gamma) / gamma` being the span over the length.
    /// A polygon on it closes nearly; the closure does the rest.
    pub(crate) fn arc(&self) -> Vec<Vector> {
        let total = self.total();
        let half = half_opening(norm(self.span[0]) / total);
        // The level direction in the plane of the anchors: `up` turned down into +first axis.
        let level = [self.up[2], 0.0, -self.up[0]];
        let chord = unit(self.span[0]).unwrap_or(level);
        // The chord turned by a right angle, to whichever side is up.
        let mut side = [-chord[2], 0.0, chord[0]];
        if side[0] * self.up[0] + side[2] * self.up[2] < 0.0 {
            side = scaled(-1.0, side);
        }
        let mut middle = 0.0;
        let mut start = 0.0;
        self.length
            .iter()
            .map(|l| {
                middle = start + 0.5 * l;
                start += l;
                let (s, c) = (half * (2.0 * middle / total - 1.0)).sin_cos();
                [c * chord[0] + s * side[0], 0.0, c * chord[2] + s * side[2]]
            })
            .collect()
    }
}

impl Links {
    /// Bring the directions of a nearly folded chain near to a closed shape; those of other chains are
    /// left as they are.
    ///
    /// A nearly folded chain closes only with its longest bar nearly along the span and the others
    /// nearly drawn out along the way back. The corrections of the closure would have to turn it as a
    /// whole, which they do only in steps as small as what it has to spare. So the chain is turned
    /// first, and the other bars are closed on the way back, where they are a nearly taut chain.
    pub(crate) fn unfolded(&self, u: Vec<Vector>) -> Vec<Vector> {
        let span = norm(self.span[0]);
        let Some((k, longest)) =
            self.length.iter().copied().enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
        else {
            return u;
        };
        let total = self.total();
        let spare = total + span - 2.0 * longest;
        let (Some(to), Some(&from)) = (unit(self.span[0]), u.get(k)) else { return u };
        let Some(half) = unit(along(from, 1.0, to)) else { return u };
        // One other bar alone cannot be closed on anything.
        if self.bars() < 3 || spare > NEARLY_FOLDED * total || spare > span {
            return u;
        }
        // Two reflections are a turn: the first takes `from` to `-from`, the second that to `to`.
        let reflected = |v: Vector, w: Vector| along(v, -2.0 * dot(v, w), w);
        let mut turned: Vec<Vector> =
            u.into_iter().map(|v| reflected(reflected(v, from), half)).collect();

        let [span, rest] = self.span;
        let mut others = Self { span: [along(span, -longest, to), rest], ..self.clone() };
        others.length.remove(k);
        others.hang.remove(k);
        let mut rest = turned.clone();
        rest.remove(k);
        let moments = others.measure(&rest);
        // If they do not close, the turned chain is as good a start as any.
        if let Ok(closed) = others.close(Shape { u: rest, moments }, CORRECTIONS) {
            rest = closed.u;
            rest.insert(k, to);
            turned = rest;
        }
        turned
    }
}

/// Corrections of the closure of the other bars.
const CORRECTIONS: usize = 100;

/// A chain that can spare less than this before its longest bar is as long as the rest and the span
/// together is nearly folded.
const NEARLY_FOLDED: f64 = 0.05;

/// The root of `sin(x) / x = span` in (0, pi], for a span from 0 to 1.
fn half_opening(span: f64) -> f64 {
    let (mut low, mut high) = (0.0_f64, std::f64::consts::PI);
    for _ in 0..BISECTIONS {
        let x = 0.5 * (low + high);
        if x.sin() > span * x {
            low = x;
        } else {
            high = x;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_nearly_folded_chain_comes_closed_with_its_longest_bar_along_the_span() {
        let links = Links {
            length: vec![0.2, 0.6, 0.2],
            hang: vec![0.3, 0.0, -0.3],
            span: [[0.21, 0.0, 0.0], [0.0; 3]],
            up: [0.0, 0.0, 1.0],
            vertical: false,
            motion: crate::Motion::Space,
        };
        let u = vec![[0.0, 0.6, 0.8], [0.0, 0.8, -0.6], [1.0, 0.0, 0.0]];
        let turned = links.unfolded(u.clone());
        assert!((turned[1][0] - 1.0).abs() < 1e-15);
        let gap = links.measure(&turned).gap;
        assert!(norm(gap) < 1e-14);
        // A chain with more to spare stays.
        let slack = Links { span: [[0.4, 0.0, 0.0], [0.0; 3]], ..links };
        assert_eq!(slack.unfolded(u.clone()), u);
    }

    #[test]
    fn the_opening_solves_its_equation() {
        for span in [0.0, 1e-3, 0.5, 0.9, 0.999_999] {
            let x = half_opening(span);
            assert!((x.sin() - span * x).abs() < 1e-15);
        }
    }
}
