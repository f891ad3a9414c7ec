//! Load paths: the star dome of 24 bars, and shallow domes on a triangular grid under a load at the top, until
//! they snap through.
//!
//! `cargo bench -p funicular --bench load_paths`
//!
//! The best of several runs; everything that `funicular trace` does is in them: the path, what
//! `energy` and the judge say of every point, the proof of limits where there is one.

use std::fmt::Write as _;
use std::time::Instant;

use funicular::{LoadEventKind, Problem, Trace};

/// Domes of 20 m of radius over a sphere of 50 m by the number of rings of free joints, with the load, in
/// parts of 1 kN, beyond their limit.
const DOMES: [(i32, f64, u32); 3] = [(3, 0.3, 5), (11, 0.006, 3), (35, 0.000_15, 1)];

fn dome(rings: i32) -> String {
    let edge = rings + 1;
    let place = |q: i32, r: i32| {
        let step = 20.0 / f64::from(edge);
        let [x, y] =
            [(f64::from(q) + 0.5 * f64::from(r)) * step, f64::from(r) * 0.75_f64.sqrt() * step];
        [x, y, (2500.0 - x * x - y * y).sqrt() - 2100_f64.sqrt()]
    };
    let ring = |q: i32, r: i32| q.abs().max(r.abs()).max((q + r).abs());
    let mut file = String::from("name = \"dome\"\n[joints]\n");
    let mut bars = String::new();
    for q in -edge..=edge {
        for r in (-edge..=edge).filter(|r| ring(q, *r) <= edge) {
            let [x, y, z] = place(q, r);
            let (key, more) = match ring(q, r) {
                0 => ("near_m", ", force_n = [0, 0, -1000]"),
                far if far == edge => ("at_m", ""),
                _ => ("near_m", ""),
            };
            let _ = writeln!(file, "\"{q} {r}\" = {{ {key} = [{x}, {y}, {z}]{more} }}");
            for (a, b) in [(q + 1, r), (q, r + 1), (q + 1, r - 1)] {
                if ring(a, b) <= edge && ring(a, b).min(ring(q, r)) < edge {
                    let ends = format!("from = \"{q} {r}\"\nto = \"{a} {b}\"");
                    let _ = writeln!(bars, "[[bars]]\n{ends}\nmass_kg = 0\nstiffness_n = 1e6");
                }
            }
        }
    }
    file + &bars
}

/// Seconds, points, and the first limit.
fn timed(
    problem: &Problem,
    vary: &str,
    runs: u32,
) -> Result<(f64, usize, Option<f64>), funicular::Error> {
    let trace = Trace::new().vary(vary)?;
    let mut best = f64::INFINITY;
    let mut found = trace.run(problem)?;
    for _ in 0..runs {
        let clock = Instant::now();
        found = trace.run(problem)?;
        best = best.min(clock.elapsed().as_secs_f64());
    }
    let path = &found.load_paths().map_or(&[][..], |found| found.paths())[0];
    let limit = path.events.iter().find(|event| event.kind == LoadEventKind::LimitPoint);
    Ok((best, path.points.len(), limit.map(|event| event.values[0])))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("                                      s  points  ms a point  first limit");
    let say = |what: &str, problem: &Problem, vary: &str, runs| {
        let (seconds, points, limit) = timed(problem, vary, runs)?;
        let each = 1e3 * seconds / points as f64;
        let limit = limit.map_or("none".to_owned(), |limit| format!("{limit:.9}"));
        println!("{what:32} {seconds:7.4} {points:7} {each:11.3}  {limit}");
        Ok::<(), funicular::Error>(())
    };
    say("star dome, 24 bars", &Problem::case("star-dome")?, "loads=0..4", 20)?;
    for (rings, load, runs) in DOMES {
        let problem = Problem::parse(&dome(rings), "dome.toml")?;
        let joints = 1 + 3 * rings * (rings + 1);
        say(&format!("dome, {joints} free joints"), &problem, &format!("loads=0..{load}"), runs)?;
    }
    Ok(())
}
