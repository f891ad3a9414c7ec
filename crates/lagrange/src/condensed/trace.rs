//! From the pull to every joint and every force: one pass over the bars.

use std::ops::Range;

use super::chain::Condensed;
use super::fold::fold;
use super::pull::{Pull, Signs};
use super::read::Read;
use super::sums::{Twofold, running};
use super::team::together;

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
    let end = if team.size() == 1 {
        path.follow(0..bars, Walk::default(), |stretch| show(&mut sink, stretch))
    } else {
        let shares = team.shares(bars);
        // Where each share begins follows from the lengths of those before it, not yet from their joints.
        let steps = together(shares[..shares.len() - 1].to_vec(), |share| {
            path.follow(share, Walk::default(), |_| {})
        });
        let mut from = vec![Walk::default()];
        for step in &steps {
            from.push(from[from.len() - 1].then(step));
        }
        let jobs = shares.iter().cloned().zip(from).zip(split(sink, &shares));
        let ends = together(jobs, |((share, from), mut sink)| {
            path.follow(share, from, |stretch| show(&mut sink, stretch))
        });
        // The moments count from zero in each share.
        let moment = ends.iter().fold(Twofold::default(), |sum, end| sum.add(end.moment));
        ends.last().map_or_else(Walk::default, |last| Walk { moment, ..*last })
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
        let (along, height) = (self.along.add(other.along), self.height.add(other.height));
        Self { along, height, moment: Twofold::default() }
    }
}

/// The chain and the force that shapes it.
struct Path<'a> {
    chain: &'a Condensed,
    force: [f64; 2],
    special: &'a Special<'a>,
}

impl Path<'_> {
    fn follow(
        &self,
        bars: Range<usize>,
        mut walk: Walk,
        mut show: impl FnMut(&Stretch<'_>),
    ) -> Walk {
        let Read { lengths, loads, beyond, .. } = &self.chain.read;
        let [h, v] = self.force;
        let mut space = [[0.0; STRETCH]; 4];
        let arrays = lengths[bars.clone()].chunks(STRETCH).zip(loads[bars.clone()].chunks(STRETCH));
        let arrays = arrays.zip(beyond[bars.clone()].chunks(STRETCH));
        for (stretch, ((lengths, loads), beyond)) in arrays.enumerate() {
            let first = stretch * STRETCH;
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
            self.special.correct(bars.start + first, along, height, axial);
            walk.moment = walk.moment.plus(product(loads, height));
            let (dx, dz) = (running(along, 0.0), running(height, 0.0));
            let (from_x, from_z) = (walk.along.value(), walk.height.value());
            for (x, z) in along.iter_mut().zip(height.iter_mut()) {
                *x += from_x;
                *z += from_z;
            }
            walk.along = walk.along.plus(dx);
            walk.height = walk.height.plus(dz);
            show(&Stretch { first, along, height, axial, vertical });
        }
        walk
    }
}

/// Bars that do not just point along their force.
enum Special<'a> {
    /// None.
    None,
    /// This one points against it.
    One(usize),
    /// Those marked do.
    Listed(&'a [bool]),
    /// These have none: from the first on, they have these vectors.
    Loose(usize, Vec<[f64; 2]>),
}

impl<'a> Special<'a> {
    fn new(chain: &Condensed, pull: &'a Pull) -> Self {
        match &pull.signs {
            Signs::Tension => Self::None,
            Signs::One(bar) => Self::One(*bar),
            Signs::Listed(signs) => Self::Listed(signs),
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
            Self::Listed(signs) => {
                for k in 0..count {
                    if signs[first + k] {
                        turn(k);
                    }
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
