//! A third solver of one's own, held against ours: two equal bars, level anchors, by trigonometry.

use funicular::prelude::*;
use funicular::{Evidence, InSpace, SystemStability};

/// Both bars hang at the same angle; the joint between them carries no vertical force.
fn by_trigonometry(span_m: f64, bar: &Bar, gravity_m_s2: f64) -> SystemEquilibrium {
    let (half, weight) = (0.5 * span_m, bar.mass_kg() * gravity_m_s2);
    let drop = (bar.length_m().powi(2) - half * half).sqrt();
    // The moments about the joint vanish: weight * half / 2 = pull * drop.
    let pull = 0.5 * weight * half / drop;
    let axial = (pull * half + 0.5 * weight * drop) / bar.length_m();
    let [start, end] = [[-pull, 0.0, weight], [pull, 0.0, weight]];
    let (index_in_space, index_in_plane, neutral) = (0, Some(0), 0);
    let in_space = InSpace::Stable;
    let stability = SystemStability { in_space, index_in_space, index_in_plane, neutral };
    SystemEquilibrium {
        solver: SolverName::new("trigonometry"),
        energy_j: -weight * drop,
        joints_m: vec![[0.0; 3], [half, 0.0, -drop], [span_m, 0.0, 0.0]],
        start_forces_n: vec![start, [-pull, 0.0, 0.0]],
        end_forces_n: vec![[pull, 0.0, 0.0], end],
        reactions_n: vec![start, [0.0; 3], end],
        axial_n: vec![axial, axial],
        stability,
        evidence: Evidence::new("closed form", 0.0, f64::EPSILON, 0),
    }
}

fn main() -> Result<(), Error> {
    let bar = Bar::homogeneous(1.0, 2.0)?;
    let anchors = Anchors { start_m: [0.0; 3], end_m: [1.2, 0.0, 0.0] };
    let problem = Problem::try_from(Chain::new("two bars", 9.80665, anchors, vec![bar; 2])?)?;
    let mut answers = Solve::new().run(&problem)?.equilibria().to_vec();
    answers.push(by_trigonometry(1.2, &bar, 9.80665));
    let agreement = compare(&problem, &mut answers)?;
    println!("{}: to {:.0e} m", agreement.verdict, agreement.joints_m);
    Ok(())
}
