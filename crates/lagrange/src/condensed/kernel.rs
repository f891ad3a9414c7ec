//! The one pass over the bars: sums that make the closure and its derivative.
//!
//! All loops run over fixed-size lanes, which the compiler turns into vector instructions; blocks
//! of lanes are summed plainly and blocks among each other with compensation.

use std::ops::Range;

use super::parallel::{CHUNK, Workers};
use super::sums::DoubleDouble;

/// Numbers treated alike in one step of the loop.
const LANES: usize = 4;
/// Bars between two compensated additions.
const SPAN: usize = 1024;

/// Some bars as the kernel reads them.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bars<'a> {
    /// `l_i`
    pub lengths: &'a [f64],
    /// `b_i`
    pub loads: &'a [f64],
}

impl Bars<'_> {
    /// None.
    pub const NONE: Self = Self { lengths: &[], loads: &[] };

    /// Some consecutive ones of them.
    pub fn chunk(self, range: Range<usize>) -> Self {
        Self { lengths: &self.lengths[range.clone()], loads: &self.loads[range] }
    }
}

/// Sums over bars in tension with the force $F_i = (h, v + b_i)$, horizontal and vertical.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Upright {
    /// $\sum l_i/|F_i|$
    pub inverse: f64,
    /// $\sum l_i F_{iz}/|F_i|$
    pub rise: f64,
    /// $\sum l_i/|F_i|^3$
    pub cube: f64,
    /// $\sum l_i F_{iz}/|F_i|^3$
    pub cube_z: f64,
    /// $\sum l_i F_{iz}^2/|F_i|^3$
    pub cube_zz: f64,
}

/// Add up what [`Upright`] holds.
pub(super) fn upright(parts: &[Bars<'_>], h: f64, v: f64, workers: Workers) -> Upright {
    let mut sum = UprightSum::default();
    for part in parts {
        if part.lengths.len() <= CHUNK {
            // Nothing to divide, and no memory to ask for: short chains take less time than that.
            sum.merge(&UprightSum::of(*part, h, v));
            continue;
        }
        let chunk = |range| UprightSum::of(part.chunk(range), h, v);
        for chunk in workers.over(part.lengths.len(), chunk) {
            sum.merge(&chunk);
        }
    }
    Upright { inverse: sum.inverse.value(), rise: sum.rise.value(), ..sum.rest }
}

/// [`Upright`] while it is added up.
#[derive(Debug, Clone, Copy, Default)]
struct UprightSum {
    inverse: DoubleDouble,
    rise: DoubleDouble,
    rest: Upright,
}

impl UprightSum {
    fn of(bars: Bars<'_>, h: f64, v: f64) -> Self {
        let mut sum = Self::default();
        for (lengths, loads) in bars.lengths.chunks(SPAN).zip(bars.loads.chunks(SPAN)) {
            let block = upright_block(lengths, loads, h * h, v);
            sum.inverse = sum.inverse.plus(block.inverse);
            sum.rise = sum.rise.plus(block.rise);
            sum.add_rest(&block);
        }
        sum
    }

    fn merge(&mut self, other: &Self) {
        self.inverse = self.inverse.add(other.inverse);
        self.rise = self.rise.add(other.rise);
        self.add_rest(&other.rest);
    }

    fn add_rest(&mut self, other: &Upright) {
        self.rest.cube += other.cube;
        self.rest.cube_z += other.cube_z;
        self.rest.cube_zz += other.cube_zz;
    }
}

#[inline]
fn upright_block(lengths: &[f64], loads: &[f64], hh: f64, v: f64) -> Upright {
    let (mut inverse, mut rise) = ([0.0; LANES], [0.0; LANES]);
    let (mut cube, mut cube_z, mut cube_zz) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    lanes(lengths, loads, |lengths, loads| {
        for k in 0..LANES {
            let z = loads[k] + v;
            let square = hh + z * z;
            let over = 1.0 / square.sqrt();
            let first = lengths[k] * over;
            let third = first * (over * over);
            let third_z = third * z;
            inverse[k] += first;
            rise[k] += first * z;
            cube[k] += third;
            cube_z[k] += third_z;
            cube_zz[k] += third_z * z;
        }
    });
    Upright {
        inverse: add_lanes(inverse),
        rise: add_lanes(rise),
        cube: add_lanes(cube),
        cube_z: add_lanes(cube_z),
        cube_zz: add_lanes(cube_zz),
    }
}

/// Sums over bars in tension with the force $F_i = (p + b_i e_p, q + b_i e_q)$ along and across an
/// axis near to which most of them lie, at angles $\alpha_i$ to it.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Aligned {
    /// $\sum l_i (1 - |\cos\alpha_i|)$ for bars on their side, without cancellation.
    pub versine: f64,
    /// $\sum l_i \sin\alpha_i$
    pub sine: f64,
    /// $\sum l_i F_q^2/|F|^3$
    pub pp: f64,
    /// $-\sum l_i F_p F_q/|F|^3$
    pub pq: f64,
    /// $\sum l_i F_p^2/|F|^3$
    pub qq: f64,
}

/// Add up what [`Aligned`] holds; `weight` is $(e_p, e_q)$. With `side` -1 angles count from the
/// opposite of the axis, near to which these bars lie.
pub(super) fn aligned(part: Bars<'_>, force: [f64; 2], weight: [f64; 2], side: f64) -> Aligned {
    let (mut versine, mut sine) = (DoubleDouble::default(), DoubleDouble::default());
    let mut sums = Aligned::default();
    for (lengths, loads) in part.lengths.chunks(SPAN).zip(part.loads.chunks(SPAN)) {
        let block = aligned_block(lengths, loads, force, weight, side);
        versine = versine.plus(block.versine);
        sine = sine.plus(block.sine);
        sums.pp += block.pp;
        sums.pq += block.pq;
        sums.qq += block.qq;
    }
    Aligned { versine: versine.value(), sine: sine.value(), ..sums }
}

#[inline]
fn aligned_block(
    lengths: &[f64],
    loads: &[f64],
    force: [f64; 2],
    weight: [f64; 2],
    side: f64,
) -> Aligned {
    let (mut versine, mut sine) = ([0.0; LANES], [0.0; LANES]);
    let (mut pp, mut pq, mut qq) = ([0.0; LANES], [0.0; LANES], [0.0; LANES]);
    lanes(lengths, loads, |lengths, loads| {
        for k in 0..LANES {
            let along = force[0] + loads[k] * weight[0];
            let across = force[1] + loads[k] * weight[1];
            let over = 1.0 / (along * along + across * across).sqrt();
            let (p, q) = (along * over, across * over);
            let stiff = lengths[k] * over;
            versine[k] += lengths[k] * versine_of(side * p, q);
            sine[k] += lengths[k] * q;
            pp[k] += stiff * (q * q);
            pq[k] -= stiff * (p * q);
            qq[k] += stiff * (p * p);
        }
    });
    Aligned {
        versine: add_lanes(versine),
        sine: add_lanes(sine),
        pp: add_lanes(pp),
        pq: add_lanes(pq),
        qq: add_lanes(qq),
    }
}

/// Show all bars to `step`, [`LANES`] at a time. The last ones are filled up with bars of no
/// length, which add nothing; their load is that of a bar whose force does not vanish.
#[inline]
fn lanes(lengths: &[f64], loads: &[f64], mut step: impl FnMut(&[f64; LANES], &[f64; LANES])) {
    let (lengths, last_lengths) = lengths.as_chunks::<LANES>();
    let (loads, last_loads) = loads.as_chunks::<LANES>();
    for (l, b) in lengths.iter().zip(loads) {
        step(l, b);
    }
    if !last_lengths.is_empty() {
        let mut l = [0.0; LANES];
        let mut b = [last_loads[0]; LANES];
        l[..last_lengths.len()].copy_from_slice(last_lengths);
        b[..last_loads.len()].copy_from_slice(last_loads);
        step(&l, &b);
    }
}

fn add_lanes(lanes: [f64; LANES]) -> f64 {
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3])
}

/// $1 - \cos\alpha$ of a unit vector $(\cos\alpha, \sin\alpha)$, with all its digits where it is
/// small.
#[inline]
pub(super) fn versine_of(cosine: f64, sine: f64) -> f64 {
    let nearer = sine * sine / (1.0 + cosine.abs());
    if cosine > 0.0 { nearer } else { 2.0 - nearer }
}
