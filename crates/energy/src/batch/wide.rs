//! A number of each of eight seeds.
#![expect(
    clippy::inline_always,
    reason = "a pass over the bars is fast only as one loop of vector instructions"
)]

/// How many seeds go side by side.
pub(crate) const WIDTH: usize = 8;

/// One number per seed.
pub(crate) type Wide = [f64; WIDTH];

/// The same number for every seed.
#[inline(always)]
pub(crate) const fn same(x: f64) -> Wide {
    [x; WIDTH]
}

/// Seed by seed, from its place.
#[inline(always)]
pub(crate) fn wide(entry: impl Fn(usize) -> f64) -> Wide {
    std::array::from_fn(entry)
}

/// Add to each entry.
#[inline(always)]
pub(crate) fn accumulate(sum: &mut Wide, entry: impl Fn(usize) -> f64) {
    for (k, sum) in sum.iter_mut().enumerate() {
        *sum += entry(k);
    }
}
