//! Several processors at once, for chains long enough to be worth it.

use std::num::NonZeroUsize;
use std::ops::Range;

/// Bars of one share. Whatever adds up is added up share by share from zero, and the shares in order,
/// so that the bits of an answer do not depend on how many processors there are. Whole blocks; and about
/// the fewest bars for which one more processor pays: below, starting it takes as long as what it saves.
pub(super) const SHARE: usize = 64 * 1024;

/// How many processors work together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Team(NonZeroUsize);

impl Team {
    /// So many, but no more than a chain of so many bars keeps busy.
    pub fn new(processors: NonZeroUsize, bars: usize) -> Self {
        let busy = NonZeroUsize::new(bars / SHARE).unwrap_or(NonZeroUsize::MIN);
        Self(processors.min(busy))
    }

    /// How many work.
    pub fn size(self) -> usize {
        self.0.get()
    }

    /// Shares of the bars in order, for each of the team some consecutive ones.
    pub fn shares(self, bars: usize) -> Vec<Vec<Range<usize>>> {
        let shares: Vec<Range<usize>> =
            (0..bars).step_by(SHARE).map(|first| first..bars.min(first + SHARE)).collect();
        let each = shares.len().div_ceil(self.size()).max(1);
        shares.chunks(each).map(<[_]>::to_vec).collect()
    }

    /// Work on all shares, and collect what comes out in their order.
    pub fn over<R: Send>(
        self,
        bars: usize,
        work: impl Fn(Range<usize>) -> R + Sync,
    ) -> impl Iterator<Item = R> {
        let done =
            together(self.shares(bars), |shares| shares.into_iter().map(&work).collect::<Vec<R>>());
        done.into_iter().flatten()
    }
}

/// Consecutive shares as one.
pub(super) fn run(shares: &[Range<usize>]) -> Option<Range<usize>> {
    Some(shares.first()?.start..shares.last()?.end)
}

/// Do all jobs at the same time, the last on this processor, and collect what they return.
pub(super) fn together<J: Send, R: Send>(
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

/// Arrays in pieces, one for each share of the bars.
pub(super) fn split<'a, T, const N: usize>(
    mut arrays: [&'a mut [T]; N],
    shares: &[Range<usize>],
) -> Vec<[&'a mut [T]; N]> {
    let piece = |share: &Range<usize>| {
        arrays.each_mut().map(|array| {
            let (piece, rest) = std::mem::take(array).split_at_mut(share.len());
            *array = rest;
            piece
        })
    };
    shares.iter().map(piece).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::condensed::sums::BLOCK;

    #[test]
    fn shares_cover_all_bars_in_order() {
        for bars in [0, 1, 255, 256, 257, 100_000, 1_000_001] {
            for processors in 1..5 {
                let team = Team(NonZeroUsize::new(processors).unwrap());
                let groups = team.shares(bars);
                assert!(groups.len() <= processors && groups.iter().all(|g| !g.is_empty()));
                let mut next = 0;
                for share in groups.concat() {
                    assert!(share.start == next && share.start % BLOCK == 0 && !share.is_empty());
                    next = share.end;
                }
                assert_eq!(next, bars);
                let firsts: Vec<usize> = team.over(bars, |share| share.start).collect();
                assert!(firsts.is_sorted());
            }
        }
        assert_eq!(Team::new(NonZeroUsize::new(8).unwrap(), 1000).size(), 1);
    }

    #[test]
    fn jobs_return_in_order() {
        assert_eq!(together([1, 2, 3], |job| job * job), [1, 4, 9]);
        assert!(together(Vec::<u8>::new(), |job| job).is_empty());
    }
}
