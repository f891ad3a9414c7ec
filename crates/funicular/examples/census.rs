//! Every equilibrium of a chain, stable or not, and the proof that there is no other.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::case("three-equal-bars-oblique")?;
    let found = Census::new().max_bars(10).run(&problem)?;
    println!("{} equilibria, complete: {}", found.equilibria.len(), found.complete());
    for e in found.equilibria.iter().map(|found| &found.equilibrium) {
        let index = e.stability.index_in_space;
        println!("{:.6} J, {index} directions in which the energy falls", e.energy_j);
    }
    Ok(())
}
