//! The certificate of the greatest energy: upside down it is the least.

use model::{Anchors, Chain, Equilibrium, NoCertificate, Problem, Reactions, Vector};

use super::{Certificate, certify};

/// Certify that no configuration has more energy than the equilibrium found; in the certificate
/// `bound_j` is then an upper bound, and the `compressed_bar` the only one that is not.
///
/// A mirror that turns the chain upside down changes the sign of every energy. All forces change
/// their sense, and the weights stay what they are.
///
/// # Errors
/// [`NoCertificate`], as [`certify`] of the chain upside down.
///
/// ```
/// use lagrange::{Seed, Settings, Solver};
/// use validate::certificate::certify_highest;
/// // The paper's chain stands on its first bar: E2.
/// let problem = model::cases::paper();
/// let mut solver = Solver::new(&problem, &Settings::default())?;
/// let seed = Seed::planar(&[1.3, -0.7, -0.3]);
/// let found = solver.solve(&seed)?.solution()?.equilibrium;
/// let bound = certify_highest(&problem, &found)?.bound_j / 9.80665 + 6.0;
/// assert!((3.664_531_348_000_69..3.664_531_348_001).contains(&bound));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify_highest(
    problem: &Problem,
    found: &Equilibrium,
) -> Result<Certificate, NoCertificate> {
    let chain = problem.chain();
    let Anchors { start_m, end_m } = chain.anchors();
    let anchors = Anchors { start_m: mirrored(*start_m), end_m: mirrored(*end_m) };
    let turned = Chain::new(chain.name(), chain.gravity_m_s2(), anchors, chain.bars().to_vec());
    let turned = Problem::new(turned.map_err(|_| NoCertificate::Unusable)?);
    let turned = turned.map_err(|_| NoCertificate::Unusable)?;
    let force = |force_n: Vector| mirrored(force_n).map(|x| -x);
    let Reactions { start, end } = found.reactions_n;
    let lowest = Equilibrium {
        energy_j: -found.energy_j,
        joints_m: found.joints_m.iter().map(|at| mirrored(*at)).collect(),
        reactions_n: Reactions { start: force(start), end: force(end) },
        axial_n: found.axial_n.iter().map(|axial_n| -axial_n).collect(),
        ..found.clone()
    };
    let certificate = certify(&turned, &lowest)?;
    Ok(Certificate { bound_j: -certificate.bound_j, ..certificate })
}

fn mirrored([x, y, z]: Vector) -> Vector {
    [x, y, -z]
}
