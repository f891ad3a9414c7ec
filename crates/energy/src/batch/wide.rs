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

/// Seed by seed, from its place. Written out: `std::array::from_fn` goes through a function that
/// is not inlined across the parts of a build, and a loop stays in memory where little is optimised; either is several times slower.
#[inline(always)]
pub(crate) fn wide<T>(entry: impl Fn(usize) -> T) -> [T; WIDTH] {
    let [a, b, c, d] = [entry(0), entry(1), entry(2), entry(3)];
    [a, b, c, d, entry(4), entry(5), entry(6), entry(7)]
}

#[inline(always)]
pub(crate) fn accumulate(sum: &mut Wide, entry: impl Fn(usize) -> f64) {
    for (k, sum) in sum.iter_mut().enumerate() {
        *sum += entry(k);
    }
}
