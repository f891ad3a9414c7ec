//! All equilibria over a parameter: where branches meet and end as the anchors are drawn apart.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::parse(
        "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
         bars = [{ length_m = 1, mass_kg = 1, count = 2 }, { length_m = 0.5, mass_kg = 2 }]",
        "three.toml",
    )?;
    let found = Trace::new().vary("anchors.end_m.x=0.8..2.6:10")?.run(&problem)?;
    for path in found.paths() {
        println!("{} branches", path.branches.len());
        for event in &path.events {
            println!("{} at x = {:.9} m", event.kind.name(), event.values[0]);
        }
    }
    println!("every census between agrees: {}", found.checks_agree());
    Ok(())
}
