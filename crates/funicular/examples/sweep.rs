//! Which start leads where: ten thousand starts through both solvers.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::case("three-equal-bars")?;
    let found = Sweep::new(10_000).spread(Spread::Sobol).run(&problem)?;
    println!("solver,equilibrium,energy_j,starts,median_iterations");
    for (solver, rows) in &found.summary.tally().solvers {
        for (outcome, row) in &rows.0 {
            let equilibrium = usize::try_from(*outcome).ok().and_then(|k| found.equilibria.get(k));
            let energy_j = equilibrium.map_or(f64::NAN, |equilibrium| equilibrium.energy_j);
            println!("{solver},{outcome},{energy_j},{},{}", row.count, row.median_iterations());
        }
    }
    Ok(())
}
