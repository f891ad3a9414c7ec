//! Load paths: the star dome of 24 bars, and shallow domes on a triangular grid under a load at the top, until
//! they snap through.
//!
//! `cargo bench -p funicular --bench load_paths`
//!
//! The best of several runs; everything that `funicular trace` does is in them: the path, what
//! `energy` and the judge say of every point, the proof of limits where there is one.

use std::time::Instant;

use funicular::{LoadEventKind, Problem, Trace};

/// Domes of 20 m of radius over a sphere of 50 m by the number of rings of free joints, with the load, in
/// parts of 1 kN, beyond their limit.
const DOMES: [(i32, f64, u32); 3] = [(3, 0.3, 5), (11, 0.006, 3), (35, 0.000_15, 1)];

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
    let limit = path.events.iter().find(|event| event.kind == LoadEventKind::Limit);
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
    let star = Problem::case("star-dome")?;
    say("star dome, 24 bars", &star, "loads=0..4", 100)?;
    say("the same in short steps", &star, "loads=0..4:180", 100)?;
    for (rings, load, runs) in DOMES {
        let problem = Problem::parse(&samples::dome(rings, false), "dome.toml")?;
        let joints = 1 + 3 * rings * (rings + 1);
        say(&format!("dome, {joints} free joints"), &problem, &format!("loads=0..{load}"), runs)?;
    }
    Ok(())
}
