//! From the pull to every joint and every force: one pass over the bars.

use std::ops::Range;

use super::bar_data::BarData;
use super::chain::Condensed;
use super::parallel::{in_parallel, joined};
use super::pull::{Pull, Signs};
use super::regime::fill;
use super::sums::{DoubleDouble, running};

/// Bars that are followed in one go.
const SEGMENT: usize = 64;

/// Some consecutive bars of an equilibrium, in units of the chain.
pub(super) struct Segment<'a> {
    /// Place of the first bar among those that go to one output.
    pub first: usize,
    /// Horizontal position of the second joint of each bar, from joint 0, in the plane.
    pub along: &'a [f64],
    /// Height of it above joint 0.
    pub height: &'a [f64],
    /// Axial force of each bar with its weight lumped to the joints, tension positive.
    pub axial: &'a [f64],
    /// Vertical force at the second joint of each bar: of the next bar, or the ground, on it.
    pub vertical: &'a [f64],
}

/// What adds up along the chain.
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    /// Last joint, horizontally and vertically from joint 0.
    pub last: [f64; 2],
    /// Energy from the height of joint 0.
    pub energy: f64,
}

/// Follow the chain from joint 0 to joint n and hand every segment of it to `write`, with the
/// output of its bars. With several threads there are several outputs, made by `split`, for ranges
/// of the bars in order.
pub(super) fn reconstruct<S: Send>(
    chain: &Condensed,
    pull: &Pull,
    mut output: S,
    split: impl FnOnce(S, &[Range<usize>]) -> Vec<S>,
    write: impl Fn(&mut S, &Segment<'_>) + Sync,
) -> Ends {
    let filled = match &pull.signs {
        Signs::Unloaded(bars) => {
            fill(&chain.bars.lengths[bars.clone()], [chain.span.across, chain.bottom.gap])
        }
        Signs::Tension | Signs::Compressed(_) => Vec::new(),
    };
    let (workers, bars) = (chain.workers(), chain.bars());
    let path = Path { chain, pull, filled };
    let groups = workers.chunks_of(bars);
    let end = if groups.len() <= 1 {
        let chunks = groups.into_iter().flatten();
        chunks.fold(Progress::default(), |from, chunk| {
            path.follow(chunk, 0, &from, |segment| write(&mut output, segment))
        })
    } else {
        let ranges: Vec<Range<usize>> = groups.iter().filter_map(|chunks| joined(chunks)).collect();
        // Where each begins follows from the steps of those before it, not yet from their joints.
        let steps = in_parallel(groups[..groups.len() - 1].to_vec(), |chunks| {
            let steps =
                chunks.into_iter().map(|chunk| path.follow(chunk, 0, &Progress::default(), |_| {}));
            steps.collect::<Vec<Progress>>()
        });
        let mut from = vec![Progress::default()];
        for step in &steps {
            from.push(step.iter().fold(from[from.len() - 1], |from, step| from.then(step)));
        }
        let jobs = groups.into_iter().zip(from).zip(split(output, &ranges));
        let ends = in_parallel(jobs, |((chunks, from), mut output)| {
            let start = chunks.first().map_or(0, |chunk| chunk.start);
            chunks.into_iter().fold(from, |from, chunk| {
                path.follow(chunk, start, &from, |segment| write(&mut output, segment))
            })
        });
        ends.last().copied().unwrap_or_default()
    };
    let last = [end.along.value(), end.height.value()];
    // V = (W - W_before) D_z - sum b_i l_i u_iz, with the weight W_before between joint 0 and the
    // bottom.
    let before = chain.bars.at_start - chain.bars.loads[0];
    let energy = (chain.bars.total_mass - before) * last[1] - end.moment.value();
    Ends { last, energy }
}

/// What has added up along the way.
#[derive(Debug, Clone, Copy, Default)]
struct Progress {
    along: DoubleDouble,
    height: DoubleDouble,
    /// $\sum b_i l_i u_{iz}$
    moment: DoubleDouble,
}

impl Progress {
    /// Where another way leads after this one.
    fn then(&self, other: &Self) -> Self {
        Self {
            along: self.along.add(other.along),
            height: self.height.add(other.height),
            moment: self.moment.add(other.moment),
        }
    }
}

/// A chain and the force that shapes it.
struct Path<'a> {
    chain: &'a Condensed,
    pull: &'a Pull,
    /// The vectors of the bars that carry no force.
    filled: Vec<[f64; 2]>,
}

impl Path<'_> {
    /// Follow a chunk of the bars, and write them: `place` is that of its first bar in the output.
    /// Returns where it ends.
    fn follow(
        &self,
        chunk: Range<usize>,
        place: usize,
        from: &Progress,
        mut write: impl FnMut(&Segment<'_>),
    ) -> Progress {
        let mut here = Progress::default();
        let BarData { lengths, loads, beyond, .. } = &self.chain.bars;
        let [h, v] = self.pull.force;
        let mut space = [[0.0; SEGMENT]; 4];
        let arrays =
            lengths[chunk.clone()].chunks(SEGMENT).zip(loads[chunk.clone()].chunks(SEGMENT));
        let arrays = arrays.zip(beyond[chunk.clone()].chunks(SEGMENT));
        for (segment, ((lengths, loads), beyond)) in arrays.enumerate() {
            let first = chunk.start + segment * SEGMENT;
            let [along, height, axial, vertical] = &mut space;
            let count = lengths.len();
            let (along, height) = (&mut along[..count], &mut height[..count]);
            let (axial, vertical) = (&mut axial[..count], &mut vertical[..count]);
            for k in 0..count {
                let up = loads[k] + v;
                let size = (h * h + up * up).sqrt();
                let scale = lengths[k] / size;
                along[k] = scale * h;
                height[k] = scale * up;
                axial[k] = size;
                vertical[k] = up + beyond[k];
            }
            self.correct(first, along, height, axial);
            here.moment = here.moment.plus(product(loads, height));
            let (dx, dz) = (running(along), running(height));
            let (from_x, from_z) =
                (from.along.add(here.along).value(), from.height.add(here.height).value());
            for (x, z) in along.iter_mut().zip(height.iter_mut()) {
                *x += from_x;
                *z += from_z;
            }
            here.along = here.along.plus(dx);
            here.height = here.height.plus(dz);
            write(&Segment { first: first - place, along, height, axial, vertical });
        }
        from.then(&here)
    }

    /// Mend the bars, from this one on, that do not point along their force.
    fn correct(&self, first: usize, x: &mut [f64], z: &mut [f64], axial: &mut [f64]) {
        match &self.pull.signs {
            Signs::Tension => {}
            Signs::Compressed(bar) => {
                if let Some(k) = bar.checked_sub(first).filter(|k| *k < axial.len()) {
                    (x[k], z[k], axial[k]) = (-x[k], -z[k], -axial[k]);
                }
            }
            Signs::Unloaded(bars) => {
                for (k, at) in (first..first + x.len()).enumerate() {
                    let filled = at.checked_sub(bars.start).and_then(|b| self.filled.get(b));
                    if let Some(bar) = filled {
                        (x[k], z[k], axial[k]) = (bar[0], bar[1], 0.0);
                    }
                }
            }
        }
    }
}

/// Sum of the products of corresponding numbers.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let (fours, rest) = a.as_chunks::<4>();
    let (others, last) = b.as_chunks::<4>();
    let mut lanes = [0.0; 4];
    for (a, b) in fours.iter().zip(others) {
        for k in 0..4 {
            lanes[k] += a[k] * b[k];
        }
    }
    let tail: f64 = rest.iter().zip(last).map(|(a, b)| a * b).sum();
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + tail
}
