//! Random numbers by their index: number k of a stream is computed from k alone.

/// The stream of SplitMix64 for one seed number: number k is a mix of `key + (k + 1) γ`, so that
/// any number can be had without those before it.
///
/// # References
///
/// G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number generators", OOPSLA
/// 2014, doi:10.1145/2660193.2660195.
///
/// ```
/// // The first number of the published generator (java.util.SplittableRandom) seeded with 0.
/// assert_eq!(sweep::Stream::raw(0).at(0), 0xe220_a839_7b1d_cdaf);
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Stream {
    key: u64,
}

/// γ: 2⁶⁴ over the golden ratio, made odd.
const GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

impl Stream {
    /// The stream of a seed number. The number is mixed first: neighbouring numbers have streams
    /// that do not overlap by a shift of one.
    pub fn new(number: u64) -> Self {
        Self { key: Self::raw(number ^ GAMMA).at(0) }
    }

    /// The stream of the published generator with this state.
    pub fn raw(key: u64) -> Self {
        Self { key }
    }

    /// Number `k`, 64 random bits.
    #[inline]
    pub fn at(self, k: u64) -> u64 {
        let mut z = self.key.wrapping_add(GAMMA.wrapping_mul(k.wrapping_add(1)));
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

/// The upper 53 bits as a number in [0, 1).
#[inline]
pub(crate) fn unit(bits: u64) -> f64 {
    const SCALE: f64 = 1.0 / (1_u64 << 53) as f64;
    (bits >> 11) as f64 * SCALE
}

#[cfg(test)]
mod tests {
    use super::{Stream, unit};

    #[test]
    fn numbers_are_uniform_to_the_eye_of_a_chi_square() {
        // 100 cells, 10^5 numbers: the statistic has mean 99 and standard deviation 14.
        let mut cells = [0_u32; 100];
        let stream = Stream::new(7);
        for k in 0..100_000 {
            let cell = (0..100).rfind(|c| unit(stream.at(k)) * 100.0 >= f64::from(*c)).unwrap();
            cells[usize::try_from(cell).unwrap()] += 1;
        }
        let statistic: f64 = cells.iter().map(|n| (f64::from(*n) - 1e3).powi(2) / 1e3).sum();
        assert!((99.0 - 4.0 * 14.0..99.0 + 4.0 * 14.0).contains(&statistic), "{statistic}");
    }

    #[test]
    fn the_unit_interval_is_half_open() {
        assert!(unit(0) <= 0.0 && unit(u64::MAX) < 1.0);
    }
}
