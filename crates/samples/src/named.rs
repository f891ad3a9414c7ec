//! Chains written down as numbers.

use model::{Anchors, Bar, Chain, Problem, Vector};

/// A chain from the origin to `end_m`, in gravity 9.81 m/s²; bars as (length m, mass kg, distance
/// of the centre of weight from the first joint m).
///
/// # Panics
///
/// When a number is out of range, or the chain has no answer.
///
/// ```
/// let problem = samples::chain(&[(2.0, 1.0, 0.5), (1.0, 3.0, 0.5)], [1.5, 0.0, 0.0]);
/// assert_eq!(problem.chain().bars()[0].centre_m(), 0.5);
/// ```
#[must_use]
pub fn chain(bars: &[(f64, f64, f64)], end_m: Vector) -> Problem {
    let bars = bars.iter().map(|(l, m, r)| Bar::new(*l, *m, *r, [0.0; 3]).expect("a valid bar"));
    problem(9.81, end_m, bars.collect())
}

/// A chain of `n` equal homogeneous bars from the origin to `end_m`, `length_m` long and `mass_kg`
/// heavy in all, in standard gravity.
///
/// # Panics
///
/// When a number is out of range, or the chain has no answer.
///
/// ```
/// let problem = samples::equal_bars(10, 1.5, 1.0, [1.0, 0.0, -0.2]);
/// assert!((problem.chain().total_length_m() - 1.5).abs() < 1e-15);
/// ```
#[must_use]
pub fn equal_bars(n: usize, length_m: f64, mass_kg: f64, end_m: Vector) -> Problem {
    let bar = Bar::homogeneous(length_m / n as f64, mass_kg / n as f64).expect("a valid bar");
    problem(model::STANDARD_GRAVITY_M_S2, end_m, vec![bar; n])
}

fn problem(gravity_m_s2: f64, end_m: Vector, bars: Vec<Bar>) -> Problem {
    let anchors = Anchors { start_m: [0.0; 3], end_m };
    let chain = Chain::new("of a test", gravity_m_s2, anchors, bars).expect("a valid chain");
    Problem::new(chain).expect("a chain with an answer")
}
