//! The hanging equilibrium of a chain, and its joints and forces as CSV.
//!
//! `cargo run --example solve > joints.csv`

use funicular::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A lamp on a cord of four links, drawn aside: `Problem::read("lamp.toml")` takes it from a
    // file.
    let anchors = Anchors { start_m: [0.0, 0.0, 0.0], end_m: [1.0, 0.0, -0.4] };
    let link = Bar::homogeneous(0.4, 0.1)?;
    let lamp = Bar::new(0.2, 3.0, 0.1, Bar::slender_inertia(0.2, 3.0))?;
    let chain = Chain::new("lamp", 9.80665, anchors, vec![link, link, lamp, link, link])?;
    let answer = Solve::new().run(&Problem::try_from(chain)?)?;

    answer.write_csv(std::io::stdout().lock())?;
    for found in answer.equilibria() {
        let [x, _, z] = found.reactions_n[0];
        eprintln!(
            "{}: {} pulls on the start with {x:.3} N, {z:.3} N",
            found.solver,
            found.evidence.rung().map_or_else(String::new, |rung| rung.to_string())
        );
    }
    eprintln!("agreed: {}", answer.agrees());
    Ok(())
}
