//! The hanging shape over a parameter: how the pull on the anchors grows as they are drawn apart.

use funicular::StudyShape;
use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::parse(
        "gravity_m_s2 = 10\n\
         anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\n\
         bars = [{ length_m = 1, mass_kg = 2, count = 2 }]",
        "two.toml",
    )?;
    let found = Study::new().vary("anchors.end_m.x=1.2,1.6,1.96,2.2")?.run(&problem)?;
    println!("distance_m,sag_m,pull_n");
    for point in found.points() {
        match &point.shape {
            Ok(StudyShape { extremes, reactions_n, .. }) => {
                let sag_m = extremes.sag_m.unwrap_or(0.0);
                let pull_n = reactions_n.last().map_or(0.0, |[x, _, _]| *x);
                println!("{},{sag_m:.6},{pull_n:.6}", point.values[0]);
            }
            Err(none) => println!("{},,: {}", point.values[0], none.reason),
        }
    }
    println!("both solvers agree everywhere: {}", found.shapes().all(|shape| shape.agrees));
    Ok(())
}
