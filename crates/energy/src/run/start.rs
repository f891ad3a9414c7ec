//! A first shape from no guess.

use model::Vector;

use crate::run::scaled_chain::ScaledChain;
use crate::thresholds::BISECTIONS;
use crate::vector::{norm, scaled, unit};

impl ScaledChain {
    /// Directions along a circular arc of the chain's length through both anchors, hanging below
    /// their chord (beside it when the chord is vertical), one for the middle of each bar.
    ///
    /// The arc turns from `-gamma` to `+gamma` about the chord, `sin(gamma) / gamma` being the span
    /// over the length. A polygon on it closes nearly; the closure does the rest.
    pub(crate) fn arc(&self) -> Vec<Vector> {
        let total = self.total();
        let half = half_opening(norm(self.span[0]) / total);
        let chord = unit(self.span[0]).unwrap_or(self.level());
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
    use crate::run::settings::Motion;
    use crate::vector::{along, dot};

    #[test]
    fn the_opening_solves_its_equation() {
        for span in [0.0, 1e-3, 0.5, 0.9, 0.999_999] {
            let x = half_opening(span);
            assert!((x.sin() - span * x).abs() < 1e-15);
        }
    }

    /// The arc turns by twice its opening, from below the chord to above it: the bars sink at first
    /// and rise at last, whichever way the chord points.
    #[test]
    fn the_arc_hangs_below_its_chord() {
        for up in [[0.0, 0.0, 1.0], [0.6, 0.0, -0.8], [-0.8, 0.0, 0.6], [0.6, 0.0, 0.8]] {
            for turn in 0..16 {
                let (s, c) = (0.2 + 0.39 * f64::from(turn)).sin_cos();
                let links = ScaledChain {
                    length: vec![0.25; 5],
                    carried: vec![0.0; 5],
                    span: [[0.9 * c, 0.0, 0.9 * s], [0.0; 3]],
                    up,
                    vertical: false,
                    motion: Motion::Plane,
                };
                let u = links.arc();
                let half = half_opening(0.72);
                let chord = [c, 0.0, s];
                for (k, u) in (0..).zip(&u) {
                    let angle = half * (0.4 * f64::from(k) - 0.8);
                    assert!((dot(*u, chord) - angle.cos()).abs() < 1e-14);
                }
                // Up from the chord.
                let side = along(up, -dot(up, chord), chord);
                assert!(dot(u[0], side) < 0.0 && dot(u[4], side) > 0.0, "{up:?} {turn}");
                assert!(dot(u[1], side) < 0.0 && dot(u[3], side) > 0.0, "{up:?} {turn}");
            }
        }
    }
}
