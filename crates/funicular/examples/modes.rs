//! How fast a chain swings about its stable equilibrium, and how fast it leaves the others.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::case("three-equal-bars")?;
    let found = Modes::new().run(&problem)?;
    for equilibrium in &found.equilibria {
        println!("equilibrium {} at {:.6} J", equilibrium.label, equilibrium.energy_j);
        for mode in &equilibrium.modes {
            println!("  omega^2 = {:12.6} 1/s^2: {}", mode.omega2_s2, mode.what);
        }
    }
    println!("signs and indices agree: {}", found.indices_agree());
    Ok(())
}
