//! Microseconds a bar and step, for chains that hang from one anchor and between two.
//!
//! `cargo run --profile dist -p motion --example step_speed [largest]`
//!
//! `cargo run --profile dist -p motion --example step_speed open|closed N STEP_S STEPS
//! second|fourth|eighth` follows one chain of bars of 1 m, held at its upper end or at both: microseconds of the processor
//! a step, then the places of its joints at the end (m, comma separated). `benches/peers/motion` sets it beside other
//! programs.
//!
//! Time is that on the processor, where the system tells it (Linux): other programs take none of
//! it.

use std::time::Instant;

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{CONSTRAINT_TOLERANCE, Order, Settings, Simulation};
use samples::process::thread_s;

/// Time to measure for each chain of many, and for one chain, s.
const MEASURED_S: f64 = 0.5;
const MEASURED_ONE_S: f64 = 0.2;

type Failed = Box<dyn std::error::Error>;

/// A chain of n bars of this length on a quarter of a circle, with the places of its joints; closed if both ends are held.
fn chain(n: usize, length: f64, closed: bool) -> Result<(System, Vec<[f64; 3]>), Failed> {
    let angle = std::f64::consts::FRAC_PI_2 / n as f64;
    let mut at = vec![[0.0; 3]];
    for k in 0..n {
        let [x, y, z] = at[k];
        let turn = (k as f64 + 0.5) * angle;
        at.push([x + length * turn.sin(), y, z - length * turn.cos()]);
    }
    let mut joints = vec![Joint::anchor("0", at[0])];
    joints.extend((1..n).map(|k| Joint::free(k.to_string())));
    let last = n.to_string();
    joints.push(if closed { Joint::anchor(last, at[n]) } else { Joint::free(last) });
    let bar = Bar::homogeneous(length, length)?;
    let members = (0..n).map(|k| Member::bar(k, k + 1, bar)).collect();
    Ok((System::new("chain", 9.81, joints, members)?, at))
}

/// Seconds that this thread has been on a processor; by the clock where the system does not say.
fn clock_s(begin: Instant) -> f64 {
    thread_s().unwrap_or_else(|| begin.elapsed().as_secs_f64())
}

fn main() -> Result<(), Failed> {
    let told: Vec<String> = std::env::args().skip(1).collect();
    match told.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        [] => all(100_000),
        [largest] => all(largest.parse()?),
        [kind, n, step_s, steps, order] => {
            let closed = match kind {
                "open" => false,
                "closed" => true,
                other => return Err(format!("open or closed, not {other}").into()),
            };
            let order = match order {
                "second" => Order::Second,
                "fourth" => Order::Fourth,
                "eighth" => Order::Eighth,
                other => return Err(format!("no order is called {other}").into()),
            };
            let settings = Settings { order, ..Settings::default() };
            one((n.parse()?, closed), step_s.parse()?, steps.parse()?, settings)
        }
        _ => Err("step_speed [largest], or open|closed N STEP_S STEPS second|fourth|eighth".into()),
    }
}

/// One chain of bars of 1 m.
fn one(
    (n, closed): (usize, bool),
    step_s: f64,
    steps: u32,
    settings: Settings,
) -> Result<(), Failed> {
    let (system, at) = chain(n, 1.0, closed)?;
    let begin = Instant::now();
    let begin_s = clock_s(begin);
    let mut runs = 0.0;
    // The clock of the processor goes in leaps: a short motion is followed many times.
    let motion = loop {
        let mut motion = Simulation::new(&system, &at, settings)?;
        for _ in 0..steps {
            motion.step(step_s)?;
        }
        runs += 1.0;
        if clock_s(begin) - begin_s > MEASURED_ONE_S {
            break motion;
        }
    };
    println!("{:.4}", (clock_s(begin) - begin_s) * 1e6 / f64::from(steps) / runs);
    for [x, y, z] in motion.joints_m() {
        println!("{x:.17e},{y:.17e},{z:.17e}");
    }
    Ok(())
}

/// Chains of up to so many bars, 1 m long together.
fn all(largest: usize) -> Result<(), Failed> {
    println!("bars,closed,us_a_bar_and_step,corrections,worst_length,worst_rate");
    for closed in [false, true] {
        let mut points = Vec::new();
        for n in [3, 10, 30, 100, 300, 1000, 10_000, 100_000] {
            if n > largest {
                continue;
            }
            let (system, at) = chain(n, 1.0 / n as f64, closed)?;
            let mut motion = Simulation::new(&system, &at, Settings::default())?;
            // A joint moves by a few hundredths of a bar in a step.
            let step_s = (1e-3_f64).min(0.01 / n as f64);
            motion.step(step_s)?;
            let (mut steps, mut worst) = (0_u64, [0.0_f64; 2]);
            let mut corrections = 0;
            let begin = Instant::now();
            let begin_s = clock_s(begin);
            while clock_s(begin) - begin_s < MEASURED_S {
                // The clock is asked once in many steps of a short chain.
                for _ in 0..(1000 / n).max(1) {
                    motion.step(step_s)?;
                    steps += 1;
                    corrections += motion.corrections();
                    let off = motion.constraints_off();
                    worst = [worst[0].max(off[0]), worst[1].max(off[1])];
                }
            }
            let each = (clock_s(begin) - begin_s) / steps as f64 / n as f64 * 1e6;
            if worst.iter().any(|off| *off > CONSTRAINT_TOLERANCE) {
                return Err(format!("{n} bars: constraints off by {worst:?}").into());
            }
            let mean = corrections as f64 / steps as f64;
            println!("{n},{closed},{each:.3},{mean:.1},{:.1e},{:.1e}", worst[0], worst[1]);
            points.push(((n as f64).ln(), (each * n as f64).ln()));
        }
        let (first, last) = (points[0], points[points.len() - 1]);
        eprintln!("slope {:.3}", (last.1 - first.1) / (last.0 - first.0));
    }
    Ok(())
}
