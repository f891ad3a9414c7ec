//! Where Newton's method begins: the catenary of the same length with the same moments of the load.
//!
//! A rope of weight W spread evenly over its length L has a closed form. The chain's load is spread
//! otherwise; the rope takes the mean of the loads and, in place of W, $\sqrt{12}$ of their
//! standard deviation. That is exact for the rope itself, and for every chain in the limit of the
//! taut one: there the pull is $\sqrt{\mathrm{var}\\,b/(2\\,\mathrm{slack})}$ whatever the
//! distribution.

use super::chain::Condensed;
use super::span::Span;

/// A chain as the catenary sees it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Catenary {
    /// Horizontal distance of the ends, positive.
    pub across: f64,
    /// Height of the end above the start.
    pub rise: f64,
    /// Length L.
    pub length: f64,
    /// $L^2 - |D|^2$, positive, without cancellation.
    pub slack_squared: f64,
    /// Length-weighted mean of the loads.
    pub mean: f64,
    /// Length-weighted standard deviation of the loads.
    pub deviation: f64,
}

impl Catenary {
    /// The catenary of a chain that is longer than its span by `slack`.
    pub fn of(chain: &Condensed, slack: f64) -> Self {
        let Span { across, rise, distance, .. } = chain.span;
        let length = chain.bars.total_length;
        let (mean, deviation) = chain.moments.total(length);
        // The root of a difference of squares: what is less comes from cancellation.
        let deviation = deviation.max(f64::EPSILON.sqrt() * chain.largest_load());
        Self { across, rise, length, slack_squared: slack * (length + distance), mean, deviation }
    }

    /// Force at load 0, horizontal and vertical.
    ///
    /// With $\sinh x/x = \rho = \sqrt{L^2 - D_z^2}/D_h$ the horizontal pull is $W D_h/(2 x L)$, and
    /// the force at the mean load points along the tangent whose slope is
    /// $\sinh(\mathrm{artanh}(D_z/L)) \cosh x$.
    pub fn force(&self) -> [f64; 2] {
        let excess_squared = self.slack_squared / (self.across * self.across);
        let ratio = (1.0 + excess_squared).sqrt();
        let x = half_parameter(ratio, excess_squared / (1.0 + ratio));
        let weight = 12.0_f64.sqrt() * self.deviation;
        let horizontal = weight * self.across / (2.0 * x * self.length);
        // L^2 - rise^2 = slack_squared + across^2.
        let depth = (self.slack_squared + self.across * self.across).sqrt();
        let slope = self.rise / depth * (1.0 + (ratio * x).powi(2)).sqrt();
        [horizontal, horizontal * slope - self.mean]
    }
}

/// Solve $\sinh x/x = 1 + e$ to a few percent, which is all that a start needs.
fn half_parameter(ratio: f64, excess: f64) -> f64 {
    /// Up to here the rational function is good to 2 %, from here on the logarithm.
    const DEEP: f64 = 3.0;
    if ratio < DEEP {
        // x^2 = 6e - 9/5 e^2 + 144/175 e^3 - ... as a quotient with the same first three terms.
        let (upper, lower) = (1.0 + 11.0 / 70.0 * excess, 1.0 + 16.0 / 35.0 * excess);
        (6.0 * excess * upper / lower).sqrt()
    } else {
        // x - ln x = ln 2 rho, since sinh x is half of exp x; one Newton step from ln + ln ln.
        let log = (2.0 * ratio).ln();
        let x = log + log.ln();
        x - (x - x.ln() - log) / (1.0 - 1.0 / x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_parameter_is_good_to_a_few_percent() {
        for exponent in -80..200 {
            let x = (f64::from(exponent) / 20.0).exp2();
            let ratio = x.sinh() / x;
            // e from its series where the difference would have lost it.
            let y = x * x / 6.0;
            let excess = if x < 0.01 { y * (1.0 + 0.3 * y) } else { ratio - 1.0 };
            if ratio.is_finite() {
                let got = half_parameter(ratio, excess);
                assert!((got / x - 1.0).abs() < 0.03, "{x}: {got}");
            }
        }
    }

    #[test]
    fn uniform_rope_has_its_closed_form() {
        // c = 1, from x = -1 to x = 2: loads are the arc length.
        let length = 2.0_f64.sinh() + 1.0_f64.sinh();
        let rise = 2.0_f64.cosh() - 1.0_f64.cosh();
        let rope = Catenary {
            across: 3.0,
            rise,
            length,
            slack_squared: length * length - 9.0 - rise * rise,
            mean: length / 2.0,
            deviation: length / 12.0_f64.sqrt(),
        };
        let [h, v] = rope.force();
        assert!((h - 1.0).abs() < 0.03 && (v + 1.0_f64.sinh()).abs() < 0.05, "{h} {v}");
    }
}
