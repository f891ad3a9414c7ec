//! Moments of signed lengths over the weights, exactly.
//!
//! With the weights $c_i$ carried before the bars and a pattern of signs,
//!
//! $$ M_k = \sum_i s_i l_i c_i^k . $$
//!
//! Where pulls have no bound, the closure is a series in these numbers, and where a bar carries
//! nothing one in sums over inverse powers of the weights; which of them vanish is a question
//! without rounding. The weights follow from masses and centres by the lever rule: quotients of
//! integers, of which a common denominator makes integers.

use model::{Bar, Chain};

use crate::closure::Pattern;
use crate::plane::loads::JointLoads;
use crate::slack::exact::{ExactSides, integers};

/// Lengths and weights as integers, each in a unit of its own; the weights counted from that before
/// bar 1.
#[derive(Debug, Clone)]
pub(crate) struct ExactMoments {
    lengths: Vec<i128>,
    weights: Vec<i128>,
    /// The square of the distance of the anchors across the vertical, and their distance along it.
    level_square: i128,
    rise: i128,
}

/// What is known of a chain in integers.
#[derive(Debug, Clone)]
pub(crate) struct Exact {
    /// Nothing where the lengths have too many digits.
    pub(crate) sides: Option<ExactSides>,
    /// Nothing where the weights have too many digits, or loads hang at the joints.
    pub(crate) moments: Option<ExactMoments>,
}

impl Exact {
    pub(crate) fn new(chain: &Chain, loads: &JointLoads) -> Self {
        let sides = ExactSides::new(chain);
        let moments = sides.as_ref().and_then(|sides| ExactMoments::new(chain, loads, sides));
        Self { sides, moments }
    }
}

/// A fraction with a positive denominator.
#[derive(Debug, Clone, Copy)]
struct Fraction {
    over: i128,
    under: i128,
}

impl Fraction {
    const ZERO: Self = Self { over: 0, under: 1 };

    /// The sum; nothing where it has too many digits.
    fn plus(self, other: Self) -> Option<Self> {
        let common = divisor(self.under, other.under);
        let [a, b] = [other.under / common, self.under / common];
        let over = self.over.checked_mul(a)?.checked_add(other.over.checked_mul(b)?)?;
        let under = self.under.checked_mul(a)?;
        let common = divisor(over.checked_abs()?, under);
        Some(Self { over: over / common, under: under / common })
    }
}

/// The part of its weight that a bar leaves at its second joint, r/l, as a reduced fraction.
fn share(bar: &Bar) -> Option<[i128; 2]> {
    let [centre, length] = integers(&[bar.centre_m(), bar.length_m()])?.try_into().ok()?;
    let common = divisor(centre, length);
    Some([centre / common, length / common])
}

/// Greatest common divisor of two numbers that are not negative, not both zero.
fn divisor(a: i128, b: i128) -> i128 {
    if b == 0 { a } else { divisor(b, a % b) }
}

impl ExactMoments {
    /// Nothing where loads hang at the joints, or the integers have too many digits.
    pub(crate) fn new(chain: &Chain, loads: &JointLoads, sides: &ExactSides) -> Option<Self> {
        let bars = chain.bars();
        if (0..=bars.len()).any(|joint| !loads.none_at(joint)) {
            return None;
        }
        let masses: Vec<f64> = bars.iter().map(Bar::mass_kg).collect();
        let masses = integers(&masses)?;
        let shares: Option<Vec<[i128; 2]>> = bars.iter().map(share).collect();
        let shares = shares?;
        let common = shares
            .iter()
            .try_fold(1_i128, |all, [_, below]| (all / divisor(all, *below)).checked_mul(*below))?;
        // What each bar leaves at its first and at its second joint.
        let left: Option<Vec<[i128; 2]>> = masses
            .iter()
            .zip(&shares)
            .map(|(mass, [above, below])| {
                let unit = mass.checked_mul(common / below)?;
                Some([unit.checked_mul(below - above)?, unit.checked_mul(*above)?])
            })
            .collect();
        let left = left?;
        let mut weights = vec![0_i128];
        for pair in left.windows(2) {
            let last = weights.last()?;
            weights.push(last.checked_add(pair[0][1])?.checked_add(pair[1][0])?);
        }
        let common = weights.iter().fold(0, |all, weight| divisor(all, *weight));
        if common > 1 {
            for weight in &mut weights {
                *weight /= common;
            }
        }
        let [level_square, rise] = sides.level_square_and_rise();
        Some(Self { lengths: sides.lengths().to_vec(), weights, level_square, rise })
    }

    /// The moment of an order; nothing where it has too many digits.
    fn moment(&self, pattern: Pattern, order: u32) -> Option<i128> {
        let bars = self.lengths.len();
        let terms = pattern.signs(bars).zip(&self.lengths).zip(&self.weights);
        terms.into_iter().try_fold(0_i128, |sum, ((sign, length), weight)| {
            let term = weight.checked_pow(order)?.checked_mul(*length)?;
            sum.checked_add(i128::from(sign).checked_mul(term)?)
        })
    }

    /// The order of the first moment that does not vanish. (Less than the number of bars of
    /// different weights, by the determinant of Vandermonde, or none: bars of one weight whose
    /// signed lengths cancel.)
    pub(crate) fn first(&self, pattern: Pattern) -> Option<u32> {
        let most = u32::try_from(self.lengths.len()).ok()?;
        for order in 0..most {
            if self.moment(pattern, order)? != 0 {
                return Some(order);
            }
        }
        None
    }

    /// Whether the signed variance of the weights, $M_0 M_2 - M_1^2$, vanishes.
    pub(crate) fn is_without_variance(&self, pattern: Pattern) -> Option<bool> {
        let [m0, m1, m2] = [0, 1, 2].map(|order| self.moment(pattern, order));
        Some(m0?.checked_mul(m2?)? == m1?.checked_mul(m1?)?)
    }

    /// The multiplicity of the equilibrium in which a bar carries nothing and the others, upright,
    /// have these signs, if there is one and it is degenerate: see
    /// [`degenerate::unloaded`](crate::degenerate::unloaded).
    pub(crate) fn multiplicity(&self, bar: usize, signs: &[i8]) -> Option<usize> {
        // Counted from the first anchor upwards.
        let mut gap = self.rise;
        let mut sums = [Fraction::ZERO; 3];
        for (i, sign) in signs.iter().enumerate().filter(|(i, _)| *i != bar) {
            let force = self.weights[i].checked_sub(self.weights[bar])?;
            let way = force.signum();
            let length = i128::from(*sign) * self.lengths[i];
            gap -= length * way;
            for (m, sum) in (1..).zip(&mut sums) {
                let under = force.checked_abs()?.checked_pow(m)?;
                if under == 0 {
                    return None;
                }
                let over = if m == 2 { length * way } else { length };
                *sum = sum.plus(Fraction { over, under })?;
            }
        }
        let length = self.lengths[bar];
        let bridged = gap.checked_mul(gap)?.checked_add(self.level_square)?;
        if bridged != length.checked_mul(length)? || self.level_square == 0 {
            return None;
        }
        match (sums.map(|sum| sum.over != 0), gap != 0) {
            ([false, true, _], true) => Some(2),
            ([false, _, true], _) => Some(3),
            ([false, true, false], false) => Some(4),
            ([true, _, _] | [_, false, false], _) => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use model::Anchors;

    use super::*;

    /// Bars of 1, 2, 1 and 2 m without mass but for 1 kg at each joint: weights 0, 1, 2, 3.
    fn moments() -> ExactMoments {
        let anchors = Anchors { start_m: [0.0; 3], end_m: [2.0, 0.0, 0.0] };
        // Each hangs its 1 kg at its second joint.
        let bars =
            [1.0, 2.0, 1.0, 2.0].map(|length| Bar::new(length, 1.0, length, [0.0; 3]).unwrap());
        let chain = Chain::new("moments", 10.0, anchors, bars.to_vec()).unwrap();
        let sides = ExactSides::new(&chain).unwrap();
        ExactMoments::new(&chain, JointLoads::NONE, &sides).unwrap()
    }

    /// By hand, signs from the first bar on: the moments, the first that is not zero, and whether
    /// the signed variance is.
    #[test]
    fn moments_of_signed_lengths() {
        let moments = moments();
        let cases = [
            // 1 + 2 + 1 + 2, 2 + 2 + 6, 2 + 4 + 18.
            (0b0000, [6, 10, 24], Some(0), false),
            // 1 − 2 − 1 + 2, −2 − 2 + 6, −2 − 4 + 18.
            (0b0110, [0, 2, 12], Some(1), false),
            // 1 − 2 + 1 + 2, −2 + 2 + 6, −2 + 4 + 18.
            (0b0100, [2, 6, 20], Some(0), false),
        ];
        for (pattern, expected, first, flat) in cases {
            let pattern = Pattern(pattern);
            let found = [0, 1, 2].map(|order| moments.moment(pattern, order));
            assert_eq!(found, expected.map(Some), "{pattern:?}");
            assert_eq!(moments.first(pattern), first);
            assert_eq!(moments.is_without_variance(pattern), Some(flat));
        }
        // 1 − 3 + 3, −3 + 6, −3 + 12: 1 · 9 = 3².
        let flat = ExactMoments { lengths: vec![1, 3, 3], weights: vec![0, 1, 2], ..moments };
        assert_eq!(flat.is_without_variance(Pattern(0b010)), Some(true));
        assert_eq!(flat.is_without_variance(Pattern(0b000)), Some(false));
        // 1 − 2 + 1, −2 + 2, −2 + 4: all but the second vanish.
        let even = ExactMoments { lengths: vec![1, 2, 1], ..flat };
        assert_eq!(even.first(Pattern(0b010)), Some(2));
        assert_eq!(even.is_without_variance(Pattern(0b010)), Some(true));
    }

    /// 1/6 + 1/3, 3/4 − 1/4, 1/2 + 1/3.
    #[test]
    fn fractions_are_reduced() {
        let sum = |[a, b]: [i128; 2], [c, d]: [i128; 2]| {
            let [one, other] = [Fraction { over: a, under: b }, Fraction { over: c, under: d }];
            one.plus(other).map(|sum| [sum.over, sum.under])
        };
        assert_eq!(sum([1, 6], [1, 3]), Some([1, 2]));
        assert_eq!(sum([3, 4], [-1, 4]), Some([1, 2]));
        assert_eq!(sum([1, 2], [1, 3]), Some([5, 6]));
        assert_eq!(sum([i128::MAX, 1], [1, 1]), None);
    }

    /// Bar 2 of three carries nothing: 1 m hangs and 1 m stands with the forces 1 and 1 to either side, whose turning
    /// parts 1/1 - 1/1 cancel; it bridges sqrt(5) m exactly or not at all.
    #[test]
    fn a_bar_without_force_has_to_bridge_its_gap() {
        let moments = |length: i128, level_square: i128, rise: i128| ExactMoments {
            lengths: vec![1, length, 1],
            weights: vec![-1, 0, 1],
            level_square,
            rise,
        };
        // Bar 1 is drawn down by its force -1 and bar 3 up by 1: with the signs + - the gap is rise + 2.
        let found = |length, level_square, rise| {
            moments(length, level_square, rise).multiplicity(1, &[1, 0, -1])
        };
        let bridged = found(5, 16, 1);
        assert!(bridged.is_some());
        for (length, level_square, rise) in [(4, 16, 1), (6, 16, 1), (5, 15, 1), (5, 16, 2)] {
            assert_eq!(found(length, level_square, rise), None);
        }
        // On one vertical it may turn about it.
        assert_eq!(found(3, 0, 1), None);
    }
}
