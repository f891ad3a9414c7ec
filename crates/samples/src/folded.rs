//! Random chains at the edge of what doubles resolve, the same for every run.

use std::f64::consts::FRAC_PI_2;

use model::{Anchors, Bar, Chain, Problem};
use rand::RngExt;

use crate::shape::{Shape, decades, lengths, masses};
use crate::stream::stream;

/// Chain number `seed` of those all but folded on one line, or with anchors all but in one place:
/// two to six bars, and a thousandth to a hundred-billionth of the length more span than the least,
/// any slope.
///
/// ```
/// let problem = samples::folded_chain(0);
/// assert!((2..=6).contains(&problem.chain().bars().len()));
/// ```
pub fn folded_chain(seed: u64) -> Problem {
    let mut rng = stream(4, seed);
    loop {
        let n = rng.random_range(2..=6);
        let bars = [Shape::Generic, Shape::OneCompressed, Shape::Massless][rng.random_range(0..3)];
        let (sizes, masses) = (lengths(bars, n, &mut rng), masses(bars, n, &mut rng));
        let bars: Vec<Bar> = sizes
            .iter()
            .zip(masses)
            .map(|(length, mass)| Bar::homogeneous(*length, mass).expect("a valid bar"))
            .collect();
        let total = model::sum(sizes.iter().copied());
        let longest = sizes.iter().copied().fold(0.0, f64::max);
        let span = (2.0 * longest - total).max(0.0) + total * decades(&mut rng, -11.0, -3.0);
        let slope: f64 = match rng.random_range(0..3) {
            0 => 0.0,
            1 => FRAC_PI_2 * f64::from(2 * rng.random_range(0..2_i8) - 1),
            _ => rng.random_range(-1.57..1.57),
        };
        let end_m = [span * slope.cos(), 0.0, span * slope.sin()];
        let anchors = Anchors { start_m: [0.0; 3], end_m };
        let chain = Chain::new("folded", 9.81, anchors, bars).expect("a valid chain");
        if let Ok(problem) = Problem::new(chain) {
            return problem;
        }
    }
}
