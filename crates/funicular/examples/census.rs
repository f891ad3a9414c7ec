//! Every equilibrium of a chain, stable or not, and the proof that there is no other.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::case("three-equal-bars-oblique")?;
    let found = Census::new().max_bars(10).run(&problem)?;
    println!("{} equilibria, complete: {}", found.census.count, found.census.complete);
    for one in &found.equilibria {
        let e = &one.equilibrium;
        println!(
            "{}: {:.6} J, {} directions in which the energy falls, bars {:?}",
            one.label, e.energy_j, e.stability.index_in_space, one.signs
        );
    }
    Ok(())
}
