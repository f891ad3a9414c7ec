//! A table of somebody else, judged: what is broken, and how large the error is.

use funicular::judge::fit;
use funicular::prelude::*;

/// A lamp on two cables of 5 m, as a table has it: a centimetre too low.
const THEIRS: &str = "joint,x_m,y_m,z_m\nA,-3,0,0\nB,3,0,0\nlamp,0,0,-4.01\n";

fn main() -> Result<(), Error> {
    let joints = vec![
        Joint::anchor("A", [-3.0, 0.0, 0.0]),
        Joint::anchor("B", [3.0, 0.0, 0.0]),
        Joint::free("lamp").with_mass(2.0),
    ];
    let body = Bar::homogeneous(5.0, 0.0)?;
    let members = vec![Member::cable(0, 2, body), Member::cable(2, 1, body)];
    let system = System::new("a lamp", 10.0, joints, members)?;
    for answer in formats::answer::parse(THEIRS, "their table")? {
        let judged = Judge::new().run(&system, &fit(&system, answer)?)?;
        println!("{}", judged.judgement().finding);
        for violation in &judged.judgement().violations {
            println!("{}: {}", violation.place_in(&system), violation.what());
        }
        println!("{}", judged.judgement().error_sentences(&system).join("\n"));
    }
    Ok(())
}
