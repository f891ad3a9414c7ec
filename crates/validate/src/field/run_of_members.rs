//! A continuous heavy elastic cable as a run of elastic members.
//!
//! A run of $n$ equal members has the weight of each at its joints by the lever rule; its end
//! forces tend to those of the cable with $1/n^2$.

use model::Bar;
use model::system::{Joint, Member, System, SystemEquilibrium, SystemError};

use super::elastic_catenary::ElasticCatenary;

/// The cable as `members` equal elastic cables, its lower end at the origin. Gravity is 10 m/s^2,
/// and masses such that the weight is the cable's.
///
/// # Errors
/// [`SystemError`] when a number is out of range.
pub fn run_of_members(cable: &ElasticCatenary, members: usize) -> Result<System, SystemError> {
    const GRAVITY: f64 = 10.0;
    let length_m = cable.length_m / members as f64;
    let mass_kg = cable.weight_n_m * length_m / GRAVITY;
    let out_of_range = SystemError::Overflow("length of a member");
    let body = Bar::homogeneous(length_m, mass_kg).map_err(|_| out_of_range)?;
    let joints = (0..=members).map(|k| match k {
        0 => Joint::anchor("lower", [0.0; 3]),
        _ if k == members => Joint::anchor("upper", [cable.x_m, 0.0, cable.z_m]),
        _ => Joint::free(k.to_string()),
    });
    let run = (0..members)
        .map(|k| Member::cable(k, k + 1, body).with_stiffness(cable.stiffness_n))
        .collect();
    System::new("run of members", GRAVITY, joints.collect(), run)
}

/// End forces of an answer for such a run: horizontal, upper and lower vertical force of the
/// supports on it, N.
pub fn end_forces(answer: &SystemEquilibrium) -> Option<[f64; 3]> {
    let (lower, upper) = (answer.reactions_n.first()?, answer.reactions_n.last()?);
    Some([upper[0], upper[2], lower[2]])
}

/// The same run with its lower end on a level floor without friction.
///
/// # Errors
/// [`SystemError`] when a number is out of range.
pub fn run_on_floor(cable: &ElasticCatenary, members: usize) -> Result<System, SystemError> {
    run_of_members(cable, members)?.with_floor(0.0)
}

#[cfg(test)]
mod tests;
