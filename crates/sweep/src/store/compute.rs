//! What a stored sweep asks of whatever computes it.

use std::ops::Range;

use crate::reached::Reached;
use crate::record::Chunk;

/// What computes seeds. The same seeds must give the same bits, whatever the thread and the cut.
pub trait Compute: Sync {
    /// Seeds to be computed at a time: some milliseconds of work, so that an interruption is heard
    /// soon.
    fn chunk_seeds(&self) -> u64 {
        1 << 13
    }

    /// What becomes of these seeds.
    fn chunk(&self, seeds: Range<u64>) -> Chunk;

    /// The same where the list of equilibria is not complete, with numbers for what is reached
    /// beside it.
    fn chunk_reaching(&self, seeds: Range<u64>, _: &mut Reached) -> Chunk {
        self.chunk(seeds)
    }

    /// Where they start: a column for each name in [`Manifest::angles`](crate::Manifest::angles).
    fn angles(&self, seeds: Range<u64>) -> Vec<Vec<f64>>;
}

/// Without starting values.
impl<F: Fn(Range<u64>) -> Chunk + Sync> Compute for F {
    fn chunk(&self, seeds: Range<u64>) -> Chunk {
        self(seeds)
    }

    fn angles(&self, _: Range<u64>) -> Vec<Vec<f64>> {
        Vec::new()
    }
}
