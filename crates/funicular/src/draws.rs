//! Random values of numbers that are known within limits.

use std::f64::consts::PI;

use census::boxes::{NoRanges, Range, ToleranceRanges};
use model::system::{System, SystemEquilibrium};
use rayon::prelude::*;
use serde::Serialize;
use validate::UseCensus;

use crate::solve::Solve;

/// Solvers agree to this part of lengths and forces: less is no draw outside of what is proved.
const ROUNDING: f64 = 1e-9;

/// How random values of a number are distributed within its tolerance.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "program", derive(clap::ValueEnum))]
pub enum Distribution {
    /// Anywhere within it: the deviation is the tolerance over $\sqrt 3$.
    #[default]
    Uniform,
    /// Normal with a deviation of a third of the tolerance, and cut off at the tolerance.
    Normal,
    /// At one end of it or the other: the deviation is the tolerance.
    Ends,
}

/// What becomes of random values of the uncertain numbers, each anywhere within its tolerance.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Draws {
    /// How many were drawn.
    pub count: usize,
    /// The seed.
    pub seed: u64,
    /// How the values are distributed.
    pub distribution: Distribution,
    /// Of how many there is an answer.
    pub solved: usize,
    /// Of how many an answer is outside of the ranges that are proved for all.
    pub outside: usize,
    /// Coordinates of all joints, m.
    #[serde(skip)]
    pub joints_m: Vec<[Drawn; 3]>,
    /// Axial forces of all members, N.
    #[serde(skip)]
    pub axial_n: Vec<Drawn>,
}

/// One number of many draws.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct Drawn {
    /// The mean.
    pub mean: f64,
    /// The standard deviation.
    pub deviation: f64,
}

impl Draws {
    pub(crate) fn new(
        solve: &Solve,
        (system, found): (&System, &SystemEquilibrium),
        ranges: &Result<ToleranceRanges, NoRanges>,
        (count, seed, distribution): (usize, u64, Distribution),
    ) -> Self {
        let solve = solve.census(UseCensus::Never);
        let of_draw = |draw: usize| {
            let numbers = system.uncertain().into_iter().enumerate();
            let values = numbers
                .map(|(k, number)| number.given + number.within * distribution.of(seed, draw, k))
                .collect::<Vec<_>>();
            let drawn = system.with_uncertain(&values).ok()?;
            // Not at the mirror image, which has the same energy.
            let drawn = drawn.clone().drawn_at(&found.joints_m).unwrap_or(drawn);
            let answer = solve.run_here(&drawn.into()).ok()?;
            answer.into_parts().1.into_iter().next()
        };
        let all: Vec<Option<SystemEquilibrium>> = (0..count).into_par_iter().map(of_draw).collect();
        let all: Vec<SystemEquilibrium> = all.into_iter().flatten().collect();
        let outside = |found: &SystemEquilibrium| {
            ranges.as_ref().is_ok_and(|ranges| is_outside(system, ranges, found))
        };
        let place =
            |joint: usize, axis: usize| Drawn::of(all.iter().map(|e| e.joints_m[joint][axis]));
        Self {
            count,
            seed,
            distribution,
            solved: all.len(),
            outside: all.iter().filter(|found| outside(found)).count(),
            joints_m: (0..system.joints().len())
                .map(|joint| [0, 1, 2].map(|axis| place(joint, axis)))
                .collect(),
            axial_n: (0..system.members().len())
                .map(|member| Drawn::of(all.iter().map(|e| e.axial_n[member])))
                .collect(),
        }
    }
}

/// Whether a solver's answer is outside of what is proved by more than its rounding.
fn is_outside(system: &System, ranges: &ToleranceRanges, found: &SystemEquilibrium) -> bool {
    let most_n = found.axial_n.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
    let beyond = |(range, x): (&Range, &f64), size: f64| {
        let [least, most] = range.guaranteed;
        let beyond = (least - x).max(x - most);
        beyond.is_nan() || beyond > ROUNDING * size
    };
    let places = ranges.joints_m.iter().flatten();
    let mut places = places.zip(found.joints_m.iter().flatten());
    places.any(|pair| beyond(pair, system.total_length_m()))
        || ranges.axial_n.iter().zip(&found.axial_n).any(|pair| beyond(pair, most_n))
}

impl Distribution {
    /// A value from -1 to 1 for each number of each draw.
    fn of(self, seed: u64, draw: usize, number: usize) -> f64 {
        let uniform = |attempt: u64| uniform(seed, draw, number, attempt);
        match self {
            Self::Uniform => uniform(0),
            Self::Ends => 1.0_f64.copysign(uniform(0)),
            Self::Normal => {
                // G. E. P. Box, M. E. Muller, Ann. Math. Stat. 29 (1958) 610-611, doi:10.1214/aoms/1177706645.
                let of = |attempt: u64| {
                    let part = 0.5 * uniform(2 * attempt) + 0.5;
                    let angle = PI * uniform(2 * attempt + 1);
                    (-2.0 * part.ln()).sqrt() * angle.cos() / 3.0
                };
                // One of 370 lies beyond three deviations: the second is hardly ever asked for.
                (0..64).map(of).find(|x| x.abs() <= 1.0).unwrap_or(0.0)
            }
        }
    }
}

/// A number from -1 to 1 for each attempt of each number of each draw: SplitMix64.
///
/// G. L. Steele, D. Lea, C. H. Flood, OOPSLA (2014) 453-472, doi:10.1145/2660193.2660195.
fn uniform(seed: u64, draw: usize, number: usize, attempt: u64) -> f64 {
    let mixed = |x: u64| {
        let x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        x ^ (x >> 31)
    };
    let bits = mixed(mixed(mixed(seed) ^ draw as u64) ^ number as u64 ^ (attempt << 40));
    (bits >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
}

impl Drawn {
    fn of(values: impl ExactSizeIterator<Item = f64> + Clone) -> Self {
        let count = values.len() as f64;
        let mean = model::sum(values.clone()) / count;
        let squares = model::sum(values.map(|x| (x - mean).powi(2)));
        // Of one draw nothing is known of how others deviate; of none, nothing at all.
        let deviation = if count > 1.0 { (squares / (count - 1.0)).sqrt() } else { 0.0 };
        Self { mean, deviation }
    }
}
