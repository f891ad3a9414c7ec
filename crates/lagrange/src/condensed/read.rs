//! One pass over the bars of the model.

use model::Chain;

use super::chain::Units;
use super::sums::{BLOCK, Twofold};

/// The bars as they are read.
#[derive(Debug, Clone, Default)]
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
    /// Read a chain, into the same memory as the last one.
    pub fn read(&mut self, chain: &Chain, units: Units) {
        let bars = chain.bars();
        let n = bars.len();
        let (per_length, per_mass) = (1.0 / units.length, 1.0 / units.mass);
        for array in [&mut self.lengths, &mut self.loads, &mut self.beyond] {
            fit(array, n);
        }
        self.before.clear();
        self.before.reserve(n.div_ceil(BLOCK));
        let (mut total_length, mut total_mass) = (Twofold::default(), Twofold::default());
        let mut carried = 0.0;
        let arrays = self.lengths.chunks_mut(BLOCK).zip(self.loads.chunks_mut(BLOCK));
        let arrays = arrays.zip(self.beyond.chunks_mut(BLOCK));
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
            self.before.push(total_length.value());
            total_length = total_length.plus(length_here);
            total_mass = total_mass.plus(mass_here);
        }
        self.at_start = std::mem::take(&mut self.loads[0]);
        self.total_length = total_length.value();
        self.total_mass = total_mass.value();
    }
}

/// Give an array another length. What it holds is written over, so fresh memory is asked for zeroed,
/// which costs nothing before it is touched.
pub(super) fn fit<T: Clone + Default>(array: &mut Vec<T>, n: usize) {
    if array.capacity() < n {
        *array = vec![T::default(); n];
    } else {
        array.resize(n, T::default());
    }
}
