//! A table of somebody else, judged: what is broken, and how large the error is.

use funicular::judge::{fit, parse};
use funicular::prelude::*;

/// A lamp on two cables of 5 m, as a table has it: a centimetre too low.
const THEIRS: &str = "joint,x_m,y_m,z_m\nA,-3,0,0\nB,3,0,0\nlamp,0,0,-4.01\n";

fn main() -> Result<(), Error> {
    let cord = Bar::homogeneous(5.0, 0.0)?;
    let system = System::builder("a lamp")
        .gravity_m_s2(10.0)
        .joint(Joint::anchor("A", [-3.0, 0.0, 0.0]))
        .joint(Joint::anchor("B", [3.0, 0.0, 0.0]))
        .joint(Joint::free("lamp").with_mass(2.0))
        .cable("A", "lamp", cord)
        .cable("lamp", "B", cord)
        .build()?;
    let problem = Problem::from(system.clone());
    for answer in parse(THEIRS, "their table")? {
        let judged = Judge::new().run(&problem, &fit(&system, answer)?)?;
        println!("{}", judged.judgement().finding);
        for violation in &judged.judgement().violations {
            println!("{}: {}", violation.place_in(&system), violation.what());
        }
        println!("{}", judged.judgement().error_sentences(&system).join("\n"));
    }
    Ok(())
}
