//! Which patterns of bars fit into a straight line between the anchors, exactly.
//!
//! Doubles are integers times powers of two. Where the lengths and the span of a chain have a
//! common power of two of which all of them are integers of not too many digits (integers, halves,
//! and most numbers with a decimal point too), the sums are exact in integers of 128 bits.

use std::ops::Range;

use model::Chain;

use crate::run::closure::Pattern;

/// Bits of the integers: three squares of differences of two add up to less than 2¹²⁷.
const LARGEST: u32 = 61;

/// The lengths and the distance of the anchors, exactly.
#[derive(Debug, Clone)]
pub(crate) struct ExactSides {
    /// In a unit in which they and the places of the anchors are integers.
    pub(super) lengths: Vec<i128>,
    /// The distance, if that is an integer too.
    span: Option<i128>,
    /// The square of the level part of the distance, and the upright part.
    level_square: i128,
    rise: i128,
}

/// A double as an odd integer times a power of two; nothing for zero.
fn odd(x: f64) -> Option<(i128, i32)> {
    /// Bits behind the exponent.
    const DIGITS: i32 = 52;
    /// What the exponent of a normal double is more than its power.
    const BIAS: i32 = 1023;
    if x.abs() <= 0.0 {
        return None;
    }
    let bits = x.to_bits();
    let exponent = i32::try_from(bits >> DIGITS & 0x7ff).unwrap_or(0);
    let fraction = i128::from(bits & ((1 << DIGITS) - 1));
    let (integer, power) = if exponent == 0 {
        (fraction, 1 - BIAS - DIGITS)
    } else {
        (fraction | 1 << DIGITS, exponent - BIAS - DIGITS)
    };
    let zeros = integer.trailing_zeros();
    let integer = integer >> zeros;
    Some((if x < 0.0 { -integer } else { integer }, power + i32::try_from(zeros).unwrap_or(0)))
}

/// All numbers in units of the largest power of two of which they are integers; nothing if some
/// have too many digits then.
pub(super) fn integers(numbers: &[f64]) -> Option<Vec<i128>> {
    let parts: Vec<Option<(i128, i32)>> = numbers.iter().map(|x| odd(*x)).collect();
    let unit = parts.iter().flatten().map(|(_, power)| *power).min()?;
    parts
        .into_iter()
        .map(|part| {
            let Some((integer, power)) = part else { return Some(0) };
            let digits = i128::BITS - integer.unsigned_abs().leading_zeros();
            let shift = u32::try_from(power - unit).ok()?;
            (digits + shift <= LARGEST).then(|| integer << shift)
        })
        .collect()
}

impl ExactSides {
    /// Nothing where the numbers of a chain have too many digits.
    pub(crate) fn new(chain: &Chain) -> Option<Self> {
        let anchors = chain.anchors();
        let bars = chain.bars().iter().map(model::Bar::length_m);
        let numbers: Vec<f64> = bars.chain(anchors.start_m).chain(anchors.end_m).collect();
        let mut lengths = integers(&numbers)?;
        let places = lengths.split_off(chain.bars().len());
        let square = (0..3).map(|k| (places[k + 3] - places[k]).pow(2)).sum::<i128>();
        let root = square.isqrt();
        let span = (root * root == square).then_some(root);
        let rise = places[5] - places[2];
        Some(Self { lengths, span, level_square: square - rise * rise, rise })
    }

    /// The square of the gap that bars leave which stand upright and point up (+1) or down (−1) towards the
    /// last anchor; 0 for those that are to bridge it. Nothing where it has too many digits.
    pub(crate) fn gap_square(&self, up: &[i8]) -> Option<i128> {
        let rise = self.rise - sum(up, &self.lengths);
        rise.checked_mul(rise)?.checked_add(self.level_square)
    }

    /// Whether a group of bars in one line, each along it (+1) or against it (−1), reaches exactly over the
    /// gap that the other bars leave, as [`gap_square`](Self::gap_square) has it. The gap is not zero.
    pub(crate) fn just_bridges(&self, up: &[i8], group: Range<usize>, along: &[i8]) -> bool {
        let reach = sum(along, &self.lengths[group]);
        let gap = self.gap_square(up);
        reach > 0 && gap.is_some() && gap == reach.checked_mul(reach)
    }

    /// All ways in which the bars fit into the line between the anchors: patterns whose sum of
    /// lengths, −1 for each bar that is in the pattern, is the distance.
    pub(crate) fn fits(&self) -> Vec<Pattern> {
        let Some(span) = self.span else { return vec![] };
        let bars = self.lengths.len();
        let mut sum: i128 = self.lengths.iter().sum();
        let mut found = vec![];
        let mut gray = 0_u32;
        // One bar is turned at a time.
        for number in 1..=1_u32 << bars {
            if sum == span {
                found.push(Pattern(gray));
            }
            let turned = number.trailing_zeros();
            if turned >= u32::try_from(bars).unwrap_or(0) {
                break;
            }
            gray ^= 1 << turned;
            let bar = bars - 1 - turned as usize;
            let sign = if gray >> turned & 1 == 1 { -2 } else { 2 };
            sum += sign * self.lengths[bar];
        }
        found.sort_unstable();
        found
    }
}

fn sum(ways: &[i8], lengths: &[i128]) -> i128 {
    ways.iter().zip(lengths).map(|(way, length)| i128::from(*way) * length).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::{Anchors, Bar};

    fn sides(lengths: &[f64], end_m: [f64; 3]) -> Option<ExactSides> {
        let bars = lengths.iter().map(|l| Bar::homogeneous(*l, 1.0).unwrap()).collect();
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        ExactSides::new(&Chain::new("exact", 9.81, anchors, bars).unwrap())
    }

    fn fits(lengths: &[f64], end_m: [f64; 3]) -> Option<Vec<u32>> {
        sides(lengths, end_m).map(|sides| sides.fits().into_iter().map(|p| p.0).collect())
    }

    /// Bar 1 of 1 m hangs; 5 and 1 m, or 7 less 1, reach 6 m over, or 3, 4, 5 at a slant.
    #[test]
    fn gaps_are_bridged_exactly() {
        let sides = |lengths: &[f64], end_m: [f64; 3]| sides(lengths, end_m).unwrap();
        let level = sides(&[1.0, 5.0, 1.0], [6.0, 0.0, -1.0]);
        assert!(level.just_bridges(&[-1, 0, 0], 1..3, &[1, 1]));
        assert!(!level.just_bridges(&[1, 0, 0], 1..3, &[1, 1]));
        assert!(!level.just_bridges(&[-1, 0, 0], 1..3, &[1, -1]));
        assert!(!level.just_bridges(&[-1, 0, 0], 1..3, &[-1, -1]));
        let folded = sides(&[1.0, 7.0, 1.0], [6.0, 0.0, -1.0]);
        assert!(folded.just_bridges(&[-1, 0, 0], 1..3, &[1, -1]));
        let slanted = sides(&[1.0, 4.0, 1.0], [3.0, 0.0, -5.0]);
        assert!(slanted.just_bridges(&[-1, 0, 0], 1..3, &[1, 1]));
        let longer = sides(&[1.0, 4.0, 1.0 + f64::EPSILON], [3.0, 0.0, -5.0]);
        assert!(!longer.just_bridges(&[-1, 0, 0], 1..3, &[1, 1]));
        // Downwards too; a gap of zero is none.
        let upright = sides(&[1.0, 4.0, 1.0], [0.0, 0.0, -6.0]);
        assert!(upright.just_bridges(&[-1, 0, 0], 1..3, &[1, 1]));
        let none = sides(&[1.0, 4.0, 4.0], [0.0, 0.0, -1.0]);
        assert!(!none.just_bridges(&[-1, 0, 0], 1..3, &[1, -1]));
        // 6 m across and 1 m - 1 m, or -1 m - 1 m, along; and nothing.
        let squares = |ways: &[i8]| level.gap_square(ways).zip(none.gap_square(ways));
        assert_eq!(squares(&[-1, 0, 0]), Some((36, 0)));
        assert_eq!(squares(&[1, 0, 0]), Some((40, 4)));
    }

    #[test]
    fn fits_are_found_exactly() {
        // One of four against the others; bar 1 is the first bit from the left.
        assert_eq!(fits(&[1.0; 4], [2.0, 0.0, 0.0]), Some(vec![1, 2, 4, 8]));
        assert_eq!(fits(&[0.5; 6], [0.0, 0.0, -2.0]).map(|all| all.len()), Some(6));
        // 3, 4, 5: of 6 and 1 the second against the first.
        assert_eq!(fits(&[6.0, 1.0], [3.0, 0.0, 4.0]), Some(vec![1]));
        assert_eq!(fits(&[6.0, 1.0], [3.0, 0.0, 4.5]), Some(vec![]));
        // In doubles 0.1 + 0.2 is not 0.3, and 0.5 + 0.25 is 0.75.
        assert_eq!(fits(&[0.1, 0.2, 0.5, 0.5], [0.3, 0.0, 0.0]), Some(vec![]));
        assert_eq!(fits(&[0.5, 0.25, 1.0, 1.0], [0.75, 0.0, 0.0]), Some(vec![1, 2]));
        // Too many digits between the largest and the smallest.
        assert_eq!(fits(&[1.0, 1e-17], [1.0, 0.0, 0.0]), None);
    }

    /// 6 is 3 times 2, 3/4 three quarters; the smallest double is 2^-1074.
    #[test]
    fn doubles_are_odd_integers_times_powers_of_two() {
        for (x, wanted) in [
            (6.0, Some((3, 1))),
            (-0.75, Some((-3, -2))),
            (1.0 + f64::EPSILON, Some(((1 << 52) + 1, -52))),
            (f64::MIN_POSITIVE, Some((1, -1022))),
            (f64::from_bits(3), Some((3, -1074))),
            (f64::MAX, Some(((1 << 53) - 1, 971))),
            (0.0, None),
        ] {
            assert_eq!(odd(x), wanted, "{x:e}");
        }
        assert_eq!(integers(&[0.5, -3.0, 0.0]), Some(vec![1, -6, 0]));
        // 61 binary digits, and one more; a long number far above a short one.
        let power = |power: i32| 2.0_f64.powi(power);
        assert_eq!(integers(&[power(60), 1.0]), Some(vec![1 << 60, 1]));
        assert_eq!(integers(&[power(61), 1.0]), None);
        assert_eq!(integers(&[3.0 * power(59), 1.0]), Some(vec![3 << 59, 1]));
        assert_eq!(integers(&[3.0 * power(60), 1.0]), None);
        assert_eq!(integers(&[7.0 * power(90), power(90)]), Some(vec![7, 1]));
    }
}
