//! From the pull to every joint and every force: one pass over the bars.

use super::chain::Condensed;
use super::fold::fold;
use super::pull::{Pull, Signs};
use super::sums::{BLOCK, Twofold, running};

/// Some consecutive bars of an equilibrium, in units of the chain.
pub(super) struct Stretch<'a> {
    /// Index of the first bar.
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

/// Follow the chain from joint 0 to joint n and show every stretch of it.
pub(super) fn trace(chain: &Condensed, pull: &Pull, mut show: impl FnMut(Stretch<'_>)) -> Ends {
    let (mut x, mut z) = (Twofold::default(), Twofold::default());
    // V = (W - W_before) D_z - sum b_i l_i u_iz, with the weight W_before between joint 0 and the bottom.
    let mut moment = Twofold::default();
    let special = Special::new(chain, pull);
    let mut space = Space::new();
    let arrays = chain.read.lengths.chunks(BLOCK).zip(chain.read.loads.chunks(BLOCK));
    let arrays = arrays.zip(chain.read.beyond.chunks(BLOCK)).enumerate();
    for (block, ((lengths, loads), beyond)) in arrays {
        let first = block * BLOCK;
        let Space { along, height, axial, vertical } = &mut space;
        let count = lengths.len();
        let (along, height) = (&mut along[..count], &mut height[..count]);
        let (axial, vertical) = (&mut axial[..count], &mut vertical[..count]);
        let [h, v] = pull.force;
        for k in 0..count {
            let up = loads[k] + v;
            let size = (h * h + up * up).sqrt();
            let scale = lengths[k] / size;
            along[k] = scale * h;
            height[k] = scale * up;
            axial[k] = size;
            vertical[k] = up + beyond[k];
        }
        special.correct(first, along, height, axial);
        moment = moment.plus(product(loads, height));
        let (dx, dz) = (running(along, 0.0), running(height, 0.0));
        let (from_x, from_z) = (x.value(), z.value());
        for (x, z) in along.iter_mut().zip(height.iter_mut()) {
            *x += from_x;
            *z += from_z;
        }
        (x, z) = (x.plus(dx), z.plus(dz));
        show(Stretch { first, along, height, axial, vertical });
    }
    let last = [x.value(), z.value()];
    let before = chain.read.at_start - chain.read.loads[0];
    let energy = (chain.read.total_mass - before) * last[1] - moment.value();
    Ends { last, energy }
}

/// Room for one block of bars.
struct Space {
    along: [f64; BLOCK],
    height: [f64; BLOCK],
    axial: [f64; BLOCK],
    vertical: [f64; BLOCK],
}

impl Space {
    fn new() -> Self {
        Self {
            along: [0.0; BLOCK],
            height: [0.0; BLOCK],
            axial: [0.0; BLOCK],
            vertical: [0.0; BLOCK],
        }
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
