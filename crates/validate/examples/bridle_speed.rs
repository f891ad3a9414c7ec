//! A bridle of three long strands beside chains, in one run:
//! `cargo run --profile dist -p validate --example bridle_speed [bars of a strand [rounds]]`.
//!
//! Three strands of n bars (100,000 if nothing is said) meet in a joint with the mass of a strand.
//! Beside it stand chains of n and of 3 n bars, by the solvers of chains of both crates. Each round
//! solves everything once; a time is the median of all rounds (9 if nothing is said), and on Linux
//! that of the processor, which other work changes little. The ratios are those to the condensed
//! solver of `lagrange`, the fastest of all, and for `energy` also to its own solver of chains. One
//! run on a server (AMD EPYC):
//!
//! | system | solver | time | to the chain of 100,000 | to the chain of 300,000 |
//! |---|---|---|---|---|
//! | chain of 100,000 bars | `lagrange::condensed` | 0.0016 s | 1 | |
//! | chain of 300,000 bars | `lagrange::condensed` | 0.0050 s | 3.1 | 1 |
//! | chain of 100,000 bars | `energy` | 0.032 s | 20 | |
//! | chain of 300,000 bars | `energy` | 0.100 s | 62 | 20 |
//! | bridle of 3 x 100,000 | `lagrange` | 0.066 s | 41 | 13 |
//! | bridle of 3 x 100,000 | `energy` | 1.40 s | 883; to its own 44 | 279; to its own 14 |

use std::hint::black_box;
use std::time::Instant;

use model::Problem;
use samples::process::thread_s;

type Failure = Box<dyn std::error::Error>;

/// The condensed solver is run so often for one time: the system counts in milliseconds.
const CHAINS: u32 = 20;

/// A chain of `n` bars of 1 m and 1 kg between level anchors, 0.8 of its length apart as those of the bridle.
fn chain(n: usize) -> Problem {
    let end_m = [0.8 * n as f64, 0.0, 0.0];
    samples::homogeneous(model::STANDARD_GRAVITY_M_S2, &vec![(1.0, 1.0); n], end_m)
}

/// Time that the processor has given to this thread, s; of the clock where the system does not say.
fn processor_s(clock: Instant) -> f64 {
    thread_s().unwrap_or_else(|| clock.elapsed().as_secs_f64())
}

/// Time of a solve, s, as the mean of so many.
fn timed<T, E: std::error::Error + 'static>(
    times: u32,
    mut solve: impl FnMut() -> Result<T, E>,
) -> Result<f64, Failure> {
    let clock = Instant::now();
    let before = processor_s(clock);
    for _ in 0..times {
        drop(black_box(solve()?));
    }
    Ok((processor_s(clock) - before) / f64::from(times))
}

fn median(mut times: Vec<f64>) -> f64 {
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() -> Result<(), Failure> {
    let asked: Vec<usize> =
        std::env::args().skip(1).map(|n| n.parse()).collect::<Result<_, _>>()?;
    let strand = asked.first().copied().unwrap_or(100_000);
    let rounds = asked.get(1).copied().unwrap_or(9).max(1);
    let (short, long, net) = (chain(strand), chain(3 * strand), samples::bridle(strand));
    let mut times: [Vec<f64>; 6] = Default::default();
    for _ in 0..rounds {
        let condensed = |problem: &Problem| {
            timed(CHAINS, || {
                lagrange::condensed::solve(problem, &lagrange::condensed::Settings::default())
            })
        };
        let turned = |problem: &Problem| {
            timed(1, || energy::minimise(problem, &energy::Settings::default()))
        };
        let forces = timed(1, || lagrange::net::solve(&net, &lagrange::net::Settings::default()));
        let places = timed(1, || energy::net::minimise(&net, &energy::net::Settings::default()));
        let round = [
            condensed(&short)?,
            condensed(&long)?,
            turned(&short)?,
            turned(&long)?,
            forces?,
            places?,
        ];
        for (times, time) in times.iter_mut().zip(round) {
            times.push(time);
        }
    }
    let [short_s, long_s, turned_s, turned_long_s, forces_s, places_s] = times.map(median);
    let bars = 3 * strand;
    println!("chain of {strand} bars, lagrange::condensed  {short_s:9.4} s");
    println!("chain of {bars} bars, lagrange::condensed  {long_s:9.4} s");
    println!("chain of {strand} bars, energy               {turned_s:9.4} s");
    println!("chain of {bars} bars, energy               {turned_long_s:9.4} s");
    println!("bridle of 3 x {strand}, lagrange            {forces_s:9.4} s");
    println!("bridle of 3 x {strand}, energy              {places_s:9.4} s");
    println!("times the condensed chain of {strand} and {bars} bars:");
    println!("lagrange {:6.1} {:6.1}", forces_s / short_s, forces_s / long_s);
    println!("energy   {:6.1} {:6.1}", places_s / short_s, places_s / long_s);
    println!("times the chain of energy of {strand} and {bars} bars:");
    println!("energy   {:6.1} {:6.1}", places_s / turned_s, places_s / turned_long_s);
    Ok(())
}
