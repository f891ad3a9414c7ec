//! From the pull to every joint and every force: one pass over the bars.

use std::ops::Range;

use super::chain::Condensed;
use super::fold::fold;
use super::pull::{Pull, Signs};
use super::read::Read;
use super::sums::{Twofold, running};
use super::team::{run, together};

/// Bars that are followed in one go.
const STRETCH: usize = 64;

/// Some consecutive bars of an equilibrium, in units of the chain.
pub(super) struct Stretch<'a> {
    /// Place of the first bar among those that go to one sink.
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

/// Follow the chain from joint 0 to joint n and show every stretch of it, with the sink of its bars. With
/// several processors there are several sinks, made by `split`, for shares of the bars in order.
pub(super) fn trace<S: Send>(
    chain: &Condensed,
    pull: &Pull,
    mut sink: S,
    split: impl FnOnce(S, &[Range<usize>]) -> Vec<S>,
    show: impl Fn(&mut S, &Stretch<'_>) + Sync,
) -> Ends {
    let special = Special::new(chain, pull);
    let (team, bars) = (chain.team(), chain.bars());
    let path = Path { chain, force: pull.force, special: &special };
    let groups = team.shares(bars);
    let end = if groups.len() <= 1 {
        let shares = groups.into_iter().flatten();
        shares.fold(Walk::default(), |from, share| {
            path.follow(share, 0, &from, |stretch| show(&mut sink, stretch))
        })
    } else {
        let runs: Vec<Range<usize>> = groups.iter().filter_map(|shares| run(shares)).collect();
        // Where each begins follows from the steps of those before it, not yet from their joints.
        let steps = together(groups[..groups.len() - 1].to_vec(), |shares| {
            let steps =
                shares.into_iter().map(|share| path.follow(share, 0, &Walk::default(), |_| {}));
            steps.collect::<Vec<Walk>>()
        });
        let mut from = vec![Walk::default()];
        for step in &steps {
            from.push(step.iter().fold(from[from.len() - 1], |from, step| from.then(step)));
        }
        let jobs = groups.into_iter().zip(from).zip(split(sink, &runs));
        let ends = together(jobs, |((shares, from), mut sink)| {
            let start = shares.first().map_or(0, |share| share.start);
            shares.into_iter().fold(from, |from, share| {
                path.follow(share, start, &from, |stretch| show(&mut sink, stretch))
            })
        });
        ends.last().copied().unwrap_or_default()
    };
    let last = [end.along.value(), end.height.value()];
    // V = (W - W_before) D_z - sum b_i l_i u_iz, with the weight W_before between joint 0 and the bottom.
    let before = chain.read.at_start - chain.read.loads[0];
    let energy = (chain.read.total_mass - before) * last[1] - end.moment.value();
    Ends { last, energy }
}

/// What adds up along the way.
#[derive(Debug, Clone, Copy, Default)]
struct Walk {
    along: Twofold,
    height: Twofold,
    /// $\sum b_i l_i u_{iz}$
    moment: Twofold,
}

impl Walk {
    /// Where one gets by another walk after this one.
    fn then(&self, other: &Self) -> Self {
        Self {
            along: self.along.add(other.along),
            height: self.height.add(other.height),
            moment: self.moment.add(other.moment),
        }
    }
}

/// The chain and the force that shapes it.
struct Path<'a> {
    chain: &'a Condensed,
    force: [f64; 2],
    special: &'a Special,
}

impl Path<'_> {
    /// Follow a share of the bars, and show them: `place` is that of its first bar in the sink.
    /// Returns where it ends.
    fn follow(
        &self,
        share: Range<usize>,
        place: usize,
        from: &Walk,
        mut show: impl FnMut(&Stretch<'_>),
    ) -> Walk {
        let mut walk = Walk::default();
        let Read { lengths, loads, beyond, .. } = &self.chain.read;
        let [h, v] = self.force;
        let mut space = [[0.0; STRETCH]; 4];
        let arrays =
            lengths[share.clone()].chunks(STRETCH).zip(loads[share.clone()].chunks(STRETCH));
        let arrays = arrays.zip(beyond[share.clone()].chunks(STRETCH));
        for (stretch, ((lengths, loads), beyond)) in arrays.enumerate() {
            let first = share.start + stretch * STRETCH;
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
            self.special.correct(first, along, height, axial);
            walk.moment = walk.moment.plus(product(loads, height));
            let (dx, dz) = (running(along, 0.0), running(height, 0.0));
            let (from_x, from_z) =
                (from.along.add(walk.along).value(), from.height.add(walk.height).value());
            for (x, z) in along.iter_mut().zip(height.iter_mut()) {
                *x += from_x;
                *z += from_z;
            }
            walk.along = walk.along.plus(dx);
            walk.height = walk.height.plus(dz);
            show(&Stretch { first: first - place, along, height, axial, vertical });
        }
        from.then(&walk)
    }
}

/// Bars that do not just point along their force.
enum Special {
    /// None.
    None,
    /// This one points against it.
    One(usize),
    /// These have none: from the first on, they have these vectors.
    Loose(usize, Vec<[f64; 2]>),
}

impl Special {
    fn new(chain: &Condensed, pull: &Pull) -> Self {
        match &pull.signs {
            Signs::Tension => Self::None,
            Signs::One(bar) => Self::One(*bar),
            Signs::Loose(range) => {
                let gap = [chain.span.across, chain.bottom.gap];
                Self::Loose(range.start, fold(&chain.read.lengths[range.clone()], gap))
            }
        }
    }

    fn correct(&self, first: usize, x: &mut [f64], z: &mut [f64], axial: &mut [f64]) {
        let count = axial.len();
        let mut turn = |k: usize| {
            (x[k], z[k], axial[k]) = (-x[k], -z[k], -axial[k]);
        };
        match self {
            Self::None => {}
            Self::One(bar) => {
                if let Some(k) = bar.checked_sub(first).filter(|k| *k < count) {
                    turn(k);
                }
            }
            Self::Loose(start, bars) => {
                for (k, at) in (first..first + x.len()).enumerate() {
                    if let Some(bar) = at.checked_sub(*start).and_then(|b| bars.get(b)) {
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
