//! A chain of N bars of 1 m and 1 kg on a quarter of a circle, held at its upper end or at both and
//! released: microseconds of the processor a step, then the places of its joints at the end (m,
//! comma separated).
//!
//! `cargo run --profile dist -p motion --example released open|closed N STEP_S STEPS
//! second|fourth|eighth`
//!
//! `benches/peers/motion` sets it beside other programs.

use std::time::Instant;

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{Order, Settings, Simulation};
use samples::process::thread_s;

type Failed = Box<dyn std::error::Error>;

fn chain(n: usize, closed: bool) -> Result<(System, Vec<[f64; 3]>), Failed> {
    let mut at = vec![[0.0; 3]];
    for k in 0..n {
        let (sin, cos) = ((k as f64 + 0.5) * std::f64::consts::FRAC_PI_2 / n as f64).sin_cos();
        let [x, y, z] = at[k];
        at.push([x + sin, y, z - cos]);
    }
    let mut joints = vec![Joint::anchor("0", at[0])];
    joints.extend((1..n).map(|k| Joint::free(k.to_string())));
    joints.push(if closed { Joint::anchor("end", at[n]) } else { Joint::free("end") });
    let bar = Bar::homogeneous(1.0, 1.0)?;
    let members = (0..n).map(|k| Member::bar(k, k + 1, bar)).collect();
    Ok((System::new("released", 9.81, joints, members)?, at))
}

/// Time to measure, s.
const MEASURED_S: f64 = 0.2;

/// Seconds that this process has been on a processor; by the clock where the system does not say.
fn clock_s(begin: Instant) -> f64 {
    thread_s().unwrap_or_else(|| begin.elapsed().as_secs_f64())
}

fn main() -> Result<(), Failed> {
    let told: Vec<String> = std::env::args().skip(1).collect();
    let [kind, n, step_s, steps, order] = told.as_slice() else {
        return Err("released open|closed N STEP_S STEPS second|fourth|eighth".into());
    };
    let closed = match kind.as_str() {
        "open" => false,
        "closed" => true,
        other => return Err(format!("open or closed, not {other}").into()),
    };
    let order = match order.as_str() {
        "second" => Order::Second,
        "fourth" => Order::Fourth,
        "eighth" => Order::Eighth,
        other => return Err(format!("no order is called {other}").into()),
    };
    let (n, step_s, steps): (usize, f64, u32) = (n.parse()?, step_s.parse()?, steps.parse()?);
    let (system, at) = chain(n, closed)?;
    let settings = Settings { order, ..Settings::default() };
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
        if clock_s(begin) - begin_s > MEASURED_S {
            break motion;
        }
    };
    println!("{:.4}", (clock_s(begin) - begin_s) * 1e6 / f64::from(steps) / runs);
    for [x, y, z] in motion.joints_m() {
        println!("{x:.17e},{y:.17e},{z:.17e}");
    }
    Ok(())
}
