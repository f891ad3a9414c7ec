//! Our time for nets of cables beside that of clarabel's cone programme, in one run:
//! `cargo run --profile dist -p validate --features cones --example third_road [members ...]`.
//!
//! Times are those of the processor on Linux (in steps of 10 ms), which other work does not change,
//! elsewhere those of the clock. One run on a server (AMD EPYC):
//!
//! | members | `lagrange` | `energy` | clarabel | ratios |
//! |---|---|---|---|---|
//! | 1,984 | 0.03 s | 0.04 s | 0.15 s | 5.0 and 3.7 |
//! | 19,800 | 0.52 s | 0.43 s | 5.97 s | 11.5 and 13.9 |

use std::time::Instant;

use model::system::System;
use samples::process::processor_s;
use validate::systems::hang_as_cables;

/// A square net of about so many cables.
fn net(members: usize) -> System {
    // Rows and columns of n joints have 2 n (n - 1) cables; those along the edge are left out.
    let side = (3..=members.max(3)).find(|n| 2 * n * (n - 1) >= members).unwrap_or(3);
    samples::cable_net(side)
}

/// Time that the processors have given to this process; of the clock where the system does not say.
fn seconds(clock: &Instant) -> f64 {
    processor_s().unwrap_or_else(|| clock.elapsed().as_secs_f64())
}

/// What something returns, and its time.
fn timed<T, E>(clock: &Instant, work: impl FnOnce() -> Result<T, E>) -> Result<(T, f64), E> {
    let before = seconds(clock);
    let result = work()?;
    Ok((result, seconds(clock) - before))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked: Vec<usize> =
        std::env::args().skip(1).map(|n| n.parse()).collect::<Result<_, _>>()?;
    let sizes = if asked.is_empty() { vec![2_000, 20_000] } else { asked };
    let clock = Instant::now();
    println!("members  lagrange/s  energy/s  clarabel/s  ratios        energies apart");
    for members in sizes {
        let system = net(members);
        let (forces, lagrange_s) =
            timed(&clock, || lagrange::net::solve(&system, &lagrange::net::Settings::default()))?;
        let (places, energy_s) =
            timed(&clock, || energy::net::minimise(&system, &energy::net::Settings::default()))?;
        let (cones, clarabel_s) = timed(&clock, || hang_as_cables(&system))?;
        let ours = forces.equilibrium.energy_j;
        let apart = [places.equilibrium.energy_j, cones.energy_j]
            .map(|other| ((other - ours) / ours).abs())
            .into_iter()
            .fold(0.0, f64::max);
        println!(
            "{:7}  {lagrange_s:10.2}  {energy_s:8.2}  {clarabel_s:10.2}  {:5.1} {:5.1}  {apart:.1e}",
            system.members().len(),
            clarabel_s / lagrange_s,
            clarabel_s / energy_s,
        );
    }
    Ok(())
}
