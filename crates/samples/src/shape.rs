//! Random chains of all hard shapes, the same for every run.

use std::f64::consts::{FRAC_PI_2, TAU};

use model::{Anchors, Bar, Chain, Problem, Vector};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::stream::stream;

/// A shape that asks something of a solver.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Shape {
    /// Any slope, any slack.
    Generic,
    /// Both anchors in one place: span 0.
    Together,
    /// Span 0.999999 of the length.
    NearlyTaut,
    /// Anchors on one vertical.
    Vertical,
    /// One bar longer than the others, anchors close: it cannot but be compressed.
    OneCompressed,
    /// Massless bars between heavy ones.
    Massless,
    /// Masses and lengths over six orders of magnitude.
    SixOrders,
    /// Total length about 1e-9 m.
    Tiny,
    /// Total length about 1e9 m.
    Huge,
    /// Gravity between 1e-9 and 1e9 m/s².
    AnyGravity,
    /// One of the bars, the anchors and the units of each of the others, drawn apart.
    Mixed,
}

impl Shape {
    /// All of them.
    pub const ALL: [Self; 11] = [
        Self::Generic,
        Self::Together,
        Self::NearlyTaut,
        Self::Vertical,
        Self::OneCompressed,
        Self::Massless,
        Self::SixOrders,
        Self::Tiny,
        Self::Huge,
        Self::AnyGravity,
        Self::Mixed,
    ];
}

/// How the bars, the anchors and the units are drawn.
struct Recipe {
    bars: Shape,
    anchors: Shape,
    units: Shape,
}

impl Recipe {
    fn new(shape: Shape, rng: &mut ChaCha8Rng) -> Self {
        let of = |these: &[Shape]| {
            if these.contains(&shape) { shape } else { Shape::Generic }
        };
        let bars = [Shape::OneCompressed, Shape::Massless, Shape::SixOrders];
        let anchors = [Shape::Together, Shape::NearlyTaut, Shape::Vertical, Shape::OneCompressed];
        let units = [Shape::Tiny, Shape::Huge, Shape::AnyGravity];
        if shape == Shape::Mixed {
            Self {
                bars: bars[rng.random_range(0..bars.len())],
                anchors: anchors[rng.random_range(0..anchors.len())],
                units: units[rng.random_range(0..units.len())],
            }
        } else {
            Self { bars: of(&bars), anchors: of(&anchors), units: of(&units) }
        }
    }
}

/// A number whose logarithm is uniform between the decades `low` and `high`.
pub(crate) fn decades(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    10.0_f64.powf(rng.random_range(low..high))
}

/// Chain number `seed`: its shape, and the chain, of 2 to 200 bars.
///
/// ```
/// let (shape, problem) = samples::random_chain(3);
/// assert_eq!(shape, samples::Shape::Vertical);
/// assert!(problem.chain().anchors_on_one_vertical());
/// ```
pub fn random_chain(seed: u64) -> (Shape, Problem) {
    let mut rng = stream(3, seed);
    let shapes = Shape::ALL.len() as u64;
    let shape = Shape::ALL[usize::try_from(seed % shapes).expect("fewer shapes than numbers")];
    // Chains that cannot close, and weightless ones, are drawn again.
    loop {
        // Small chains are where one bar matters most: a third of them have fewer than ten.
        let few = rng.random_range(0..3) == 0;
        let n = if few { rng.random_range(2..10) } else { rng.random_range(2..=200) };
        let recipe = Recipe::new(shape, &mut rng);
        if let Some(problem) = draw(&recipe, n, &mut rng) {
            return (shape, problem);
        }
    }
}

fn draw(recipe: &Recipe, n: usize, rng: &mut ChaCha8Rng) -> Option<Problem> {
    let metre = match recipe.units {
        Shape::Tiny => 1e-9,
        Shape::Huge => 1e9,
        _ => 1.0,
    };
    let gravity = match recipe.units {
        Shape::AnyGravity => decades(rng, -9.0, 9.0),
        _ => 9.81,
    };
    let mut sizes = lengths(recipe.bars, n, rng);
    let total = model::sum(sizes.iter().copied());
    for size in &mut sizes {
        *size *= metre / total;
    }
    let masses = masses(recipe.bars, n, rng);
    let bars: Vec<Bar> = sizes
        .iter()
        .zip(masses)
        .map(|(length, mass)| {
            // At an end, in the middle, anywhere.
            let part = [0.0, 0.5, 1.0, rng.random_range(0.0..1.0)][rng.random_range(0..4)];
            Bar::new(*length, mass, length * part, [0.0; 3]).expect("a valid bar")
        })
        .collect();
    let end_m = far_anchor(recipe.anchors, &bars, rng);
    // Now and then the first anchor is not the origin.
    let start_m: Vector = if rng.random_range(0..2) == 0 {
        [0.0; 3]
    } else {
        std::array::from_fn(|_| metre * rng.random_range(-1.0..1.0))
    };
    let end_m = std::array::from_fn(|k| start_m[k] + end_m[k]);
    let chain = Chain::new("random", gravity, Anchors { start_m, end_m }, bars);
    Problem::new(chain.expect("a valid chain")).ok()
}

/// Lengths of `n` bars, in any unit.
pub(crate) fn lengths(shape: Shape, n: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let equal = rng.random_range(0..2) == 0;
    let mut sizes: Vec<f64> = (0..n)
        .map(|_| match shape {
            Shape::SixOrders => decades(rng, -3.0, 3.0),
            _ if equal => 1.0,
            _ => rng.random_range(0.2..2.0),
        })
        .collect();
    if shape == Shape::OneCompressed {
        let others = model::sum(sizes.iter().copied());
        sizes[rng.random_range(0..n)] += others * rng.random_range(0.5..2.0);
    }
    sizes
}

pub(crate) fn masses(shape: Shape, n: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let equal = rng.random_range(0..2) == 0;
    (0..n)
        .map(|_| match shape {
            Shape::SixOrders => decades(rng, -3.0, 3.0),
            Shape::Massless if rng.random_range(0..2) == 0 => 0.0,
            _ if equal => 1.0,
            _ => rng.random_range(0.1..10.0),
        })
        .collect()
}

/// Where the last joint is, from the first.
fn far_anchor(shape: Shape, bars: &[Bar], rng: &mut ChaCha8Rng) -> Vector {
    let total = model::sum(bars.iter().map(Bar::length_m));
    let longest = bars.iter().map(Bar::length_m).fold(0.0, f64::max);
    let least = (2.0 * longest - total).max(0.0);
    let distance = match shape {
        Shape::Together => 0.0,
        Shape::NearlyTaut => 0.999_999 * total,
        // Close: the longest bar has to lie across the others.
        Shape::OneCompressed => least + (total - least) * rng.random_range(0.01..0.3),
        _ => least + (total - least) * rng.random_range(0.05..0.95),
    };
    let azimuth = rng.random_range(0.0..TAU);
    let slope: f64 = match shape {
        Shape::Vertical => FRAC_PI_2 * f64::from(2 * rng.random_range(0..2_i8) - 1),
        _ if rng.random_range(0..4) == 0 => 0.0,
        _ => rng.random_range(-1.5..1.5),
    };
    let across = if shape == Shape::Vertical { 0.0 } else { distance * slope.cos() };
    [across * azimuth.cos(), across * azimuth.sin(), distance * slope.sin()]
}
