//! From the weights of the joints to the loads between the bottom bar and every other.

use super::parallel::Workers;
use super::sums::{BLOCK, DoubleDouble, running};

/// Chains of fewer bars are solved without a coarse chain first: of fewer than sixteen blocks it
/// says little more than the catenary does.
const COARSE_FROM: usize = 16 * BLOCK;

/// Moments that are summed side by side.
const LANES: usize = 8;

/// Lengths and loads of some bars.
#[derive(Debug, Clone, Default)]
pub(super) struct Arrays {
    pub lengths: Vec<f64>,
    pub loads: Vec<f64>,
}

/// Replace the weights of the joints (entry i: the joint before bar i) by the loads $b_i$ counted
/// from bar `bottom`, and take their moments while they are in the cache.
///
/// Blocks count outwards from the bottom, each from zero, and are then shifted by an offset of
/// twice the digits: no rounding grows with n, and next to the bottom there is no offset at all.
pub(super) fn count_from(
    bottom: usize,
    lengths: &[f64],
    loads: &mut [f64],
    moments: &mut Moments,
    workers: Workers,
) {
    let (before, after) = loads.split_at_mut(bottom + 1);
    let (lengths_before, lengths_after) = lengths.split_at(bottom + 1);
    let mut other = Moments { wanted: moments.wanted, ..Moments::default() };
    if workers.size() == 1 {
        count_down(lengths_before, before, moments);
        count_up(lengths_after, after, &mut other);
    } else {
        std::thread::scope(|scope| {
            scope.spawn(|| count_up(lengths_after, after, &mut other));
            count_down(lengths_before, before, moments);
        });
    }
    moments.merge(&other);
}

/// Bars after the bottom: the load grows by the joint before each.
fn count_up(lengths: &[f64], loads: &mut [f64], moments: &mut Moments) {
    let mut offset = DoubleDouble::default();
    for (lengths, loads) in lengths.chunks(BLOCK).zip(loads.chunks_mut(BLOCK)) {
        let here = running(loads);
        for load in loads.iter_mut() {
            *load += offset.value();
        }
        offset = offset.plus(here);
        moments.take(lengths, loads);
    }
}

/// The bottom, last, and the bars before it: the load falls by the joint after each, whose weight
/// stands with the next bar.
fn count_down(lengths: &[f64], loads: &mut [f64], moments: &mut Moments) {
    let mut offset = DoubleDouble::default();
    let mut after = 0.0;
    let mut space = [0.0; BLOCK];
    for (lengths, loads) in lengths.rchunks(BLOCK).zip(loads.rchunks_mut(BLOCK)) {
        let space = &mut space[..loads.len()];
        space[0] = after;
        after = loads[0];
        for (to, load) in space[1..].iter_mut().zip(loads.iter().rev()) {
            *to = *load;
        }
        let here = running(space);
        for (load, sum) in loads.iter_mut().zip(space.iter().rev()) {
            *load = -(sum + offset.value());
        }
        offset = offset.plus(here);
        moments.take(lengths, loads);
    }
}

/// Moments of the loads, weighted with the lengths.
#[derive(Debug, Clone, Default)]
pub(super) struct Moments {
    first: f64,
    second: f64,
    wanted: bool,
    pub coarse: Arrays,
}

impl Moments {
    /// Begin again for a chain of so many bars, in the same memory.
    pub fn clear(&mut self, bars: usize) {
        self.wanted = bars >= COARSE_FROM;
        // Two for each block, and the bottom may split one block in two.
        let points = if self.wanted { 2 * (bars / BLOCK + 2) } else { 0 };
        for array in [&mut self.coarse.lengths, &mut self.coarse.loads] {
            array.clear();
            array.reserve(points);
        }
        (self.first, self.second) = (0.0, 0.0);
    }

    /// Take in what another took.
    fn merge(&mut self, other: &Self) {
        self.first += other.first;
        self.second += other.second;
        self.coarse.lengths.extend(&other.coarse.lengths);
        self.coarse.loads.extend(&other.coarse.loads);
    }

    /// Take a block in. The coarse chain gets two bars for it, of half its length each and one
    /// standard deviation to both sides of its mean: a quadrature of third order.
    fn take(&mut self, lengths: &[f64], loads: &[f64]) {
        let Some(&origin) = loads.first() else { return };
        // Several sums side by side: each addition waits for the one before it.
        let mut sums = [[0.0; LANES]; 3];
        let mut add = |lane: usize, l: f64, b: f64| {
            let from = b - origin;
            for (sum, term) in sums.iter_mut().zip([l, l * from, l * from * from]) {
                sum[lane] += term;
            }
        };
        let (lengths, last_lengths) = lengths.as_chunks::<LANES>();
        let (loads, last_loads) = loads.as_chunks::<LANES>();
        for (l, b) in lengths.iter().zip(loads) {
            for lane in 0..LANES {
                add(lane, l[lane], b[lane]);
            }
        }
        for (lane, (l, b)) in last_lengths.iter().zip(last_loads).enumerate() {
            add(lane, *l, *b);
        }
        let [length, first, second] = sums.map(|sums| sums.iter().sum::<f64>());
        let mean = first / length;
        let variance = (second / length - mean * mean).max(0.0);
        let centre = origin + mean;
        self.first += length * centre;
        self.second += length * (variance + centre * centre);
        if self.wanted {
            let deviation = variance.sqrt();
            self.coarse.lengths.extend([0.5 * length; 2]);
            self.coarse.loads.extend([centre - deviation, centre + deviation]);
        }
    }

    /// Mean and standard deviation of all loads.
    pub fn total(&self, length: f64) -> (f64, f64) {
        let mean = self.first / length;
        (mean, (self.second / length - mean * mean).max(0.0).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loads_count_from_the_bottom_both_ways() {
        for (n, bottom) in [(1, 0), (7, 0), (7, 6), (7, 3), (1000, 0), (1000, 999), (1000, 301)] {
            let lengths = vec![1.0; n];
            // Integers: every sum is exact.
            let weights: Vec<f64> =
                (0..n).map(|i| f64::from(u32::try_from(i % 5).unwrap())).collect();
            let mut loads = weights.clone();
            let mut moments = Moments::default();
            moments.clear(n);
            let workers = Workers::new(std::num::NonZeroUsize::MIN, n);
            count_from(bottom, &lengths, &mut loads, &mut moments, workers);
            for i in 0..n {
                let expected: f64 = if i >= bottom {
                    weights[bottom + 1..=i].iter().sum()
                } else {
                    -weights[i + 1..=bottom].iter().sum::<f64>()
                };
                assert!((loads[i] - expected).abs() < 0.5, "{n} {bottom} {i}");
            }
            let mean = loads.iter().sum::<f64>() / n as f64;
            let variance = loads.iter().map(|b| (b - mean).powi(2)).sum::<f64>() / n as f64;
            let (got_mean, got_deviation) = moments.total(n as f64);
            assert!((got_mean - mean).abs() <= 1e-9 * (1.0 + mean.abs()));
            assert!((got_deviation - variance.sqrt()).abs() <= 1e-6 * (1.0 + variance.sqrt()));
        }
    }
}
