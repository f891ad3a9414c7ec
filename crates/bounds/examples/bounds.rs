//! The bounds of chains of many sizes, with their gaps and their times.
//!
//! `cargo run --profile dist -p bounds --features sdp --example bounds`

use std::time::Instant;

use bounds::{BoundSettings, Sense, cable_bound, semidefinite};
use model::{Anchors, Bar, Chain, Problem};

/// Largest chain for which the semidefinite programme is shown; it is solved in fractions of a
/// second there, and its solver loses its digits beyond.
const LARGEST_SEMIDEFINITE: u32 = 1_000;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let paper = model::cases::paper();
    let mgl = paper.chain().gravity_m_s2();
    for sense in [Sense::Lower, Sense::Upper] {
        let bound = semidefinite(&paper, sense, &BoundSettings::default())?;
        println!(
            "paper, {sense:?}: V = {:.14} mgl in the paper's terms",
            bound.rigorous_j / mgl + 6.0
        );
    }
    println!(
        "\nchains of n bars, long short long short ..., 1.5 times the span; gaps over weight times length"
    );
    println!(
        "{:>7}  {:>10}  {:>10}  {:>9}  {:>10}  {:>10}",
        "n", "sdp gap", "sdp ms", "its", "cable gap", "cable ms"
    );
    for n in [3_u32, 10, 30, 100, 300, 1_000, 10_000, 100_000] {
        let problem = alternating(n)?;
        let chain = problem.chain();
        let unit = chain.total_mass_kg() * chain.gravity_m_s2() * chain.total_length_m();

        let semidefinite_columns = if n <= LARGEST_SEMIDEFINITE {
            let clock = Instant::now();
            let bound = semidefinite(&problem, Sense::Lower, &BoundSettings::default())?;
            let time = clock.elapsed().as_secs_f64() * 1e3;
            let gap =
                bound.optimiser.as_ref().map_or(f64::NAN, |found| bound.gap_j(found.energy_j));
            let iterations = bound.evidence.iterations;
            format!("{:>10.1e}  {time:>10.2}  {iterations:>9}", gap / unit)
        } else {
            format!("{:>10}  {:>10}  {:>9}", "", "", "")
        };
        let clock = Instant::now();
        let bound = cable_bound(&problem, &BoundSettings::default())?;
        let time = clock.elapsed().as_secs_f64() * 1e3;
        let gap = bound.gap_j(bound.cables.energy_j);
        println!("{n:>7}  {semidefinite_columns}  {:>10.1e}  {time:>10.2}", gap / unit);
    }
    Ok(())
}

fn alternating(n: u32) -> Result<Problem, Box<dyn std::error::Error>> {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, -0.2] };
    let unit = 1.5 * anchors.span_m() / f64::from(n);
    let bars = (0..n)
        .map(|i| {
            let factor = if i % 2 == 0 { 1.25 } else { 0.75 };
            Bar::homogeneous(factor * unit, factor)
        })
        .collect::<Result<_, _>>()?;
    Ok(Problem::new(Chain::new("alternating", 9.81, anchors, bars)?)?)
}
