use crate::error::SweepError;

/// Bits of a coordinate, and of the index.
const BITS: usize = 64;

/// Points in the unit cube that fill it evenly, in the order of the Gray code.
///
/// # References
///
/// S. Joe, F. Y. Kuo, "Constructing Sobol sequences with better two-dimensional projections", SIAM
/// J. Sci. Comput. 30, 2008, doi:10.1137/070709359; their table new-joe-kuo-6.
#[derive(Debug, Clone)]
pub(crate) struct Sobol {
    /// Direction numbers of each dimension.
    directions: Vec<[u64; BITS]>,
}

impl Sobol {
    pub(crate) fn new(dimensions: usize) -> Result<Self, SweepError> {
        if dimensions > Self::MOST {
            return Err(SweepError::SobolDimensions { bars: dimensions, most: Self::MOST });
        }
        let first = std::array::from_fn(|bit| 1 << (BITS - 1 - bit));
        let others = JOE_KUO.iter().map(|(polynomial, start)| recurrence(*polynomial, start));
        Ok(Self { directions: std::iter::once(first).chain(others).take(dimensions).collect() })
    }

    /// Dimensions in the table.
    pub(crate) const MOST: usize = JOE_KUO.len() + 1;

    /// Coordinate `dimension` of point `k`, as a binary fraction of 64 bits.
    #[inline]
    pub(crate) fn at(&self, k: u64, dimension: usize) -> u64 {
        let mut gray = k ^ (k >> 1);
        let mut bits = 0;
        while gray != 0 {
            bits ^= self.directions[dimension][gray.trailing_zeros() as usize];
            gray &= gray - 1;
        }
        bits
    }
}

/// Direction numbers $v_j = m_j/2^j$ from the first ones and a primitive polynomial of the same
/// degree s, whose inner coefficients are the bits of `a`: $v_j = a_1 v_{j-1} \oplus \dots \oplus
/// a_{s-1} v_{j-s+1} \oplus v_{j-s} \oplus (v_{j-s}/2^s)$.
fn recurrence(a: u32, start: &[u32]) -> [u64; BITS] {
    let degree = start.len();
    let mut v = [0_u64; BITS];
    for j in 0..BITS {
        v[j] = if j < degree {
            u64::from(start[j]) << (BITS - 1 - j)
        } else {
            let mut bits = v[j - degree] ^ (v[j - degree] >> degree);
            for k in 1..degree {
                if a >> (degree - 1 - k) & 1 == 1 {
                    bits ^= v[j - k];
                }
            }
            bits
        };
    }
    v
}

/// Inner coefficients of the polynomial, and the first $m_j$, of dimensions 2 to 32.
const JOE_KUO: [(u32, &[u32]); 31] = [
    (0, &[1]),
    (1, &[1, 3]),
    (1, &[1, 3, 1]),
    (2, &[1, 1, 1]),
    (1, &[1, 1, 3, 3]),
    (4, &[1, 3, 5, 13]),
    (2, &[1, 1, 5, 5, 17]),
    (4, &[1, 1, 5, 5, 5]),
    (7, &[1, 1, 7, 11, 19]),
    (11, &[1, 1, 5, 1, 1]),
    (13, &[1, 1, 1, 3, 11]),
    (14, &[1, 3, 5, 5, 31]),
    (1, &[1, 3, 3, 9, 7, 49]),
    (13, &[1, 1, 1, 15, 21, 21]),
    (16, &[1, 3, 1, 13, 27, 49]),
    (19, &[1, 1, 1, 15, 7, 5]),
    (22, &[1, 3, 1, 15, 13, 25]),
    (25, &[1, 1, 5, 5, 19, 61]),
    (1, &[1, 3, 7, 11, 23, 15, 103]),
    (4, &[1, 3, 7, 13, 13, 15, 69]),
    (7, &[1, 1, 3, 13, 7, 35, 63]),
    (8, &[1, 3, 5, 9, 1, 25, 53]),
    (14, &[1, 3, 1, 13, 9, 35, 107]),
    (19, &[1, 3, 1, 5, 27, 61, 31]),
    (21, &[1, 1, 5, 11, 19, 41, 61]),
    (28, &[1, 3, 5, 3, 3, 13, 69]),
    (31, &[1, 1, 7, 13, 1, 19, 1]),
    (32, &[1, 3, 7, 5, 13, 19, 59]),
    (37, &[1, 1, 3, 9, 25, 29, 41]),
    (41, &[1, 3, 5, 13, 23, 1, 55]),
    (42, &[1, 3, 7, 3, 13, 59, 17]),
];

#[cfg(test)]
mod tests {
    use super::Sobol;

    /// Every dimension, as SciPy 1.17.1 gives it in units of 2^-30 (`qmc.Sobol(32,
    /// scramble=False)`, `fast_forward(k)`). In the Gray code of the first number all of 17 bits
    /// are set, so that every direction number of the table counts.
    #[test]
    fn all_dimensions_are_those_of_another_program() {
        const POINTS: [(u64, [u32; 32]); 2] = [
            (
                0x15555,
                [
                    1_073_733_632, 536_895_488, 371_187_712, 413_081_600, 945_856_512, 843_341_824,
                    313_876_480, 763_420_672, 174_874_624, 1_062_952_960, 672_735_232, 419_143_680,
                    489_086_976, 307_109_888, 1_048_109_056, 398_336_000, 166_535_168, 692_346_880,
                    760_946_688, 887_988_224, 1_042_784_256, 47_030_272, 469_491_712, 471_949_312,
                    896_753_664, 148_987_904, 76_144_640, 639_967_232, 401_481_728, 403_841_024,
                    34_758_656, 663_101_440,
                ],
            ),
            (
                0xcafe,
                [
                    545_079_296, 386_449_408, 379_469_824, 163_463_168, 96_190_464, 12_828_672,
                    1_009_041_408, 1_001_078_784, 702_562_304, 1_020_936_192, 360_366_080,
                    80_920_576, 692_109_312, 21_839_872, 718_979_072, 811_024_384, 262_651_904,
                    505_921_536, 1_012_482_048, 821_280_768, 3_784_704, 214_646_784, 720_486_400,
                    385_859_584, 247_185_408, 20_529_152, 327_794_688, 195_379_200, 260_358_144,
                    445_923_328, 782_024_704, 863_289_344,
                ],
            ),
        ];
        let sobol = Sobol::new(32).unwrap();
        for (k, expected) in POINTS {
            for (dimension, x) in expected.into_iter().enumerate() {
                assert_eq!(sobol.at(k, dimension) >> 34, u64::from(x), "{k} {dimension}");
            }
        }
    }

    #[test]
    fn every_block_of_points_is_a_permutation() {
        let sobol = Sobol::new(32).unwrap();
        for dimension in 0..32 {
            let mut seen = [false; 1024];
            for k in 1024..2048 {
                seen[usize::try_from(sobol.at(k, dimension) >> 54).unwrap()] = true;
            }
            assert!(seen.iter().all(|seen| *seen));
        }
    }

    #[test]
    fn more_dimensions_than_the_table_are_refused() {
        assert!(Sobol::new(33).is_err());
    }
}
