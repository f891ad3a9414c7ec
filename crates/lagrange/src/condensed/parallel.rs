//! Several threads at once, for chains long enough to be worth it.

use std::num::NonZeroUsize;
use std::ops::Range;

/// Bars of one chunk. Whatever adds up is added up chunk by chunk from zero, and the chunks in
/// order, so that the bits of an answer do not depend on how many processors there are. Whole
/// blocks; and about the fewest bars for which one more processor pays: below, starting it takes as
/// long as what it saves.
pub(super) const CHUNK: usize = 64 * 1024;

/// How many processors work on a chain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Workers(NonZeroUsize);

impl Workers {
    /// So many, but no more than a chain of so many bars keeps busy.
    pub fn new(processors: NonZeroUsize, bars: usize) -> Self {
        let busy = NonZeroUsize::new(bars / CHUNK).unwrap_or(NonZeroUsize::MIN);
        Self(processors.min(busy))
    }

    /// How many there are.
    pub fn size(self) -> usize {
        self.0.get()
    }

    /// Chunks of the bars in order, for each worker some consecutive ones.
    pub fn chunks_of(self, bars: usize) -> Vec<Vec<Range<usize>>> {
        let chunks: Vec<Range<usize>> =
            (0..bars).step_by(CHUNK).map(|first| first..bars.min(first + CHUNK)).collect();
        let each = chunks.len().div_ceil(self.size()).max(1);
        chunks.chunks(each).map(<[_]>::to_vec).collect()
    }

    /// Work on all chunks, and collect what comes out in their order.
    pub fn over<R: Send>(
        self,
        bars: usize,
        work: impl Fn(Range<usize>) -> R + Sync,
    ) -> impl Iterator<Item = R> {
        let done = in_parallel(self.chunks_of(bars), |chunks| {
            chunks.into_iter().map(&work).collect::<Vec<R>>()
        });
        done.into_iter().flatten()
    }
}

pub(super) fn joined(chunks: &[Range<usize>]) -> Option<Range<usize>> {
    Some(chunks.first()?.start..chunks.last()?.end)
}

/// Do all jobs at the same time, the last on this processor, and collect what they return.
pub(super) fn in_parallel<J: Send, R: Send>(
    jobs: impl IntoIterator<Item = J>,
    work: impl Fn(J) -> R + Sync,
) -> Vec<R> {
    let mut jobs: Vec<J> = jobs.into_iter().collect();
    let last = jobs.pop();
    let work = &work;
    std::thread::scope(|scope| {
        let others: Vec<_> = jobs.into_iter().map(|job| scope.spawn(move || work(job))).collect();
        let here = last.map(work);
        let others = others.into_iter().map(|other| {
            // A panic over there is a panic here.
            other.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        });
        others.chain(here).collect::<Vec<R>>()
    })
}

/// Arrays in pieces, one for each of consecutive ranges of the bars.
pub(super) fn split<'a, T, const N: usize>(
    mut arrays: [&'a mut [T]; N],
    chunks: &[Range<usize>],
) -> Vec<[&'a mut [T]; N]> {
    let piece = |chunk: &Range<usize>| {
        arrays.each_mut().map(|array| {
            let (piece, rest) = std::mem::take(array).split_at_mut(chunk.len());
            *array = rest;
            piece
        })
    };
    chunks.iter().map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::condensed::sums::BLOCK;

    #[test]
    fn chunks_cover_all_bars_in_order() {
        for bars in [0, 1, 255, 256, 257, 100_000, 1_000_001] {
            for processors in 1..5 {
                let workers = Workers(NonZeroUsize::new(processors).unwrap());
                let groups = workers.chunks_of(bars);
                assert!(groups.len() <= processors && groups.iter().all(|g| !g.is_empty()));
                let mut next = 0;
                for chunk in groups.concat() {
                    assert!(chunk.start == next && chunk.start % BLOCK == 0 && !chunk.is_empty());
                    next = chunk.end;
                }
                assert_eq!(next, bars);
                let firsts: Vec<usize> = workers.over(bars, |chunk| chunk.start).collect();
                assert!(firsts.is_sorted());
            }
        }
        assert_eq!(Workers::new(NonZeroUsize::new(8).unwrap(), 1000).size(), 1);
    }

    #[test]
    fn jobs_return_in_order() {
        assert_eq!(in_parallel([1, 2, 3], |job| job * job), [1, 4, 9]);
        assert!(in_parallel(Vec::<u8>::new(), |job| job).is_empty());
    }
}
