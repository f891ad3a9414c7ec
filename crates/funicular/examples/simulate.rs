//! A chain released from a random position comes to rest where the solvers say.

use funicular::prelude::*;

fn main() -> Result<(), Error> {
    let problem = Problem::case("three-equal-bars-oblique")?;
    let moved = Simulate::new()
        .start(Start::Seed(7))
        .damping_1_s(2.0)
        .time_s(30.0)
        .step_s(5e-3)
        .run(&problem)?;
    println!("time_s,kinetic_j,potential_j");
    for at in moved.stored.iter().step_by(100) {
        println!("{:.3},{:.6e},{:.9}", at.time_s, at.kinetic_j, at.potential_j);
    }
    let solved = Solve::new().run(&problem)?;
    let (Some(rest), [hanging, ..]) = (moved.stored.last(), solved.equilibria()) else {
        return Ok(());
    };
    let pairs = rest.joints_m.iter().flatten().zip(hanging.joints_m.iter().flatten());
    let off_m = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    eprintln!("at rest {off_m:.1e} m from the equilibrium of the solvers");

    let mut animation = funicular::Animation::new(&moved.system);
    moved.stored.iter().for_each(|at| animation.add(at));
    eprintln!("an animation of {} bytes", animation.page().len());
    Ok(())
}
