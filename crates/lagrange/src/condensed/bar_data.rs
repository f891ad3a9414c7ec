//! The bars of a chain as arrays, read in one pass.

use std::ops::Range;

use model::{Bar, Chain};

use super::parallel::{Workers, in_parallel, joined, split};
use super::sums::{BLOCK, DoubleDouble};
use super::units::Units;

#[derive(Debug, Clone, Default)]
pub(super) struct BarData {
    /// `l_i`.
    pub lengths: Vec<f64>,
    /// Weight of the joint before each bar; nothing before the first, which the ground carries.
    pub loads: Vec<f64>,
    /// Part of the weight of bar i that its second joint carries.
    pub beyond: Vec<f64>,
    /// Part of the weight of bar 1 that joint 0 carries.
    pub at_start: f64,
    /// What is known of each block of bars.
    pub blocks: Vec<Block>,
    pub total_length: f64,
    pub total_mass: f64,
}

/// Totals of a block of bars.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Block {
    /// Length of the bars before it; while they are read, of its own.
    pub length: f64,
    mass: f64,
}

impl BarData {
    /// Read a chain, into the same memory as the last one.
    pub fn read(&mut self, chain: &Chain, units: Units, workers: Workers) {
        let bars = chain.bars();
        for array in [&mut self.lengths, &mut self.loads, &mut self.beyond] {
            resize(array, bars.len());
        }
        let (lengths, loads, beyond) =
            (&mut self.lengths[..], &mut self.loads[..], &mut self.beyond[..]);
        let all = Part { bars, lengths, loads, beyond };
        if workers.size() == 1 {
            self.blocks.clear();
            self.blocks.reserve(bars.len().div_ceil(BLOCK));
            all.read(units, &mut self.blocks);
        } else {
            // For each processor one run of bars: nothing is added up over more than a block here.
            let runs: Vec<Range<usize>> =
                workers.chunks_of(bars.len()).iter().filter_map(|chunks| joined(chunks)).collect();
            let blocks = in_parallel(all.split(&runs), |part| {
                let mut blocks = Vec::with_capacity(part.bars.len().div_ceil(BLOCK));
                part.read(units, &mut blocks);
                blocks
            });
            self.blocks = blocks.concat();
            // What the last bar of one run puts on the first joint of the next.
            for run in runs.into_iter().skip(1) {
                self.loads[run.start] += self.beyond[run.start - 1];
            }
        }
        self.at_start = std::mem::take(&mut self.loads[0]);
        self.add_up();
    }

    /// Replace the length of each block by that of all before it; and the totals.
    fn add_up(&mut self) {
        let (mut length, mut mass) = (DoubleDouble::default(), DoubleDouble::default());
        for block in &mut self.blocks {
            let here = block.length;
            block.length = length.value();
            length = length.plus(here);
            mass = mass.plus(block.mass);
        }
        self.total_length = length.value();
        self.total_mass = mass.value();
    }
}

/// Some bars, and where they are written to.
struct Part<'a> {
    bars: &'a [Bar],
    lengths: &'a mut [f64],
    loads: &'a mut [f64],
    beyond: &'a mut [f64],
}

impl Part<'_> {
    fn split(self, ranges: &[Range<usize>]) -> Vec<Self> {
        let Self { bars, lengths, loads, beyond } = self;
        let arrays = split([lengths, loads, beyond], ranges);
        let parts = ranges.iter().zip(arrays);
        parts
            .map(|(range, [lengths, loads, beyond])| Part {
                bars: &bars[range.clone()],
                lengths,
                loads,
                beyond,
            })
            .collect()
    }

    fn read(self, units: Units, blocks: &mut Vec<Block>) {
        let (per_length, per_mass) = (1.0 / units.length, 1.0 / units.mass);
        let mut carried = 0.0;
        let arrays = self.lengths.chunks_mut(BLOCK).zip(self.loads.chunks_mut(BLOCK));
        let arrays = arrays.zip(self.beyond.chunks_mut(BLOCK));
        for (bars, ((lengths, loads), beyond)) in self.bars.chunks(BLOCK).zip(arrays) {
            let mut block = Block::default();
            let out = lengths.iter_mut().zip(loads).zip(beyond);
            for (bar, ((length, load), beyond)) in bars.iter().zip(out) {
                let mass = bar.mass_kg() * per_mass;
                *length = bar.length_m() * per_length;
                *beyond = mass * (bar.centre_m() / bar.length_m());
                *load = carried + (mass - *beyond);
                carried = *beyond;
                block.length += *length;
                block.mass += mass;
            }
            blocks.push(block);
        }
    }
}

/// Give an array another length. What it holds is written over, so fresh memory is asked for
/// zeroed, which costs nothing before it is touched.
pub(super) fn resize<T: Clone + Default>(array: &mut Vec<T>, n: usize) {
    if array.capacity() < n {
        *array = vec![T::default(); n];
    } else {
        array.resize(n, T::default());
    }
}
