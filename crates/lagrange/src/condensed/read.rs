//! One pass over the bars of the model.

use model::Chain;

use super::chain::Units;
use super::sums::{BLOCK, Twofold};

/// The bars as they are read.
pub(super) struct Read {
    /// `l_i`.
    pub lengths: Vec<f64>,
    /// Weight of the joint before each bar; nothing before the first, which the ground carries.
    pub loads: Vec<f64>,
    /// Part of the weight of bar i that its second joint carries.
    pub beyond: Vec<f64>,
    /// Part of the weight of bar 1 that joint 0 carries.
    pub at_start: f64,
    /// Length of the bars before each block.
    pub before: Vec<f64>,
    pub total_length: f64,
    pub total_mass: f64,
}

impl Read {
    pub fn new(chain: &Chain, units: Units) -> Self {
        let bars = chain.bars();
        let n = bars.len();
        let (per_length, per_mass) = (1.0 / units.length, 1.0 / units.mass);
        let (mut lengths, mut loads, mut beyond) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut before = Vec::with_capacity(n.div_ceil(BLOCK));
        let (mut total_length, mut total_mass) = (Twofold::default(), Twofold::default());
        let mut carried = 0.0;
        let arrays = lengths.chunks_mut(BLOCK).zip(loads.chunks_mut(BLOCK));
        let arrays = arrays.zip(beyond.chunks_mut(BLOCK));
        for (block, ((lengths, loads), beyond)) in bars.chunks(BLOCK).zip(arrays) {
            let (mut length_here, mut mass_here) = (0.0, 0.0);
            let out = lengths.iter_mut().zip(loads).zip(beyond);
            for (bar, ((length, load), beyond)) in block.iter().zip(out) {
                let mass = bar.mass_kg() * per_mass;
                *length = bar.length_m() * per_length;
                *beyond = mass * (bar.centre_m() / bar.length_m());
                *load = carried + (mass - *beyond);
                carried = *beyond;
                length_here += *length;
                mass_here += mass;
            }
            before.push(total_length.value());
            total_length = total_length.plus(length_here);
            total_mass = total_mass.plus(mass_here);
        }
        let at_start = std::mem::take(&mut loads[0]);
        Self {
            lengths,
            loads,
            beyond,
            at_start,
            before,
            total_length: total_length.value(),
            total_mass: total_mass.value(),
        }
    }
}
