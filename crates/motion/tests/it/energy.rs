//! Energy over many steps, and constraints at every one of them.

use motion::{CONSTRAINT_TOLERANCE, Order};

use crate::common::{at_rest, closed, paper};

/// Slope and scatter of the energy's means over windows of time, relative to the band.
fn trend(means: &[f64]) -> f64 {
    let n = means.len() as f64;
    let middle = 0.5 * (n - 1.0);
    let mean = means.iter().sum::<f64>() / n;
    let (mut above, mut below) = (0.0, 0.0);
    for (k, value) in means.iter().enumerate() {
        let t = k as f64 - middle;
        above += t * (value - mean);
        below += t * t;
    }
    above / below * n
}

#[test]
fn the_energy_of_the_papers_chain_stays_in_its_band_without_trend() {
    // Measured: a band of 4.0e-5 J, a trend of -4.1e-9 J over all 10^6 steps.
    let steps = 1_000_000;
    let mut chain = at_rest(&paper(), &closed(0.8, 1.0), Order::Second);
    let begin_j = chain.energy_j();
    let mut band_j = 0.0_f64;
    let mut worst = [0.0_f64; 2];
    let windows = 20;
    let mut means = vec![0.0; windows];
    for k in 0..steps {
        chain.step(1e-3).unwrap();
        let off_j = chain.energy_j() - begin_j;
        band_j = band_j.max(off_j.abs());
        means[k * windows / steps] += off_j / (steps / windows) as f64;
        let off = chain.constraints_off();
        worst = [worst[0].max(off[0]), worst[1].max(off[1])];
    }
    let trend_j = trend(&means);
    println!("band {band_j:e} J, trend over all {trend_j:e} J, constraints {worst:?}");
    assert!(worst[0] <= CONSTRAINT_TOLERANCE && worst[1] <= CONSTRAINT_TOLERANCE, "{worst:?}");
    // The energy of three bars of 1 kg and 1 m is some 20 J; the band is of the order h².
    assert!(band_j < 2e-4, "{band_j:e}");
    assert!(trend_j.abs() < 0.01 * band_j, "{trend_j:e} {band_j:e}");
}
