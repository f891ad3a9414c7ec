//! The rung `verified` for systems: interval arithmetic proves that exactly one equilibrium lies in
//! a box, and the answers are held against it.

use census::boxes::{SystemBox, prove};
use model::system::{System, SystemEquilibrium};
use model::{NoBox, Reason, Status, Verified, VerifiedSystem};

use super::certificate::largest_force_n;
use super::scale::Scale;
use crate::tolerances::Tolerances;
use numerics::vector::worse;

/// Prove each answer and say so on its ladder. Answers in one box share the proof.
pub fn verify(system: &System, answers: &mut [SystemEquilibrium]) {
    let mut proved: Option<SystemBox> = None;
    for answer in answers {
        // A box whose turns are held fast is that of one answer.
        let shared = proved.take().filter(|proof| proof.turns == 0).and_then(|proof| {
            let status = held_against(system, &proof, answer);
            status.is_reached().then_some((proof, status))
        });
        let found = shared.map_or_else(
            || {
                prove(system, &answer.joints_m, &answer.axial_n).map(|proof| {
                    let status = held_against(system, &proof, answer);
                    (proof, status)
                })
            },
            Ok,
        );
        answer.evidence.ladder.verified = match found {
            Ok((proof, status)) => {
                proved = Some(proof);
                status
            }
            Err(because) => Status::Open(Reason::NoBox(because)),
        };
    }
}

/// Whether an answer is the equilibrium of a box, to the accuracy that answers are asked to agree
/// to.
fn held_against(
    system: &System,
    proof: &SystemBox,
    answer: &SystemEquilibrium,
) -> Status<Verified> {
    let length_m = system.total_length_m();
    let scale = Scale::new(system, answer);
    let size_m = worse(scale.size_m, f64::MIN_POSITIVE);
    let force_n = worse(scale.of_forces_n(largest_force_n(answer)), f64::MIN_POSITIVE);
    let distance_m = proof.beyond_m(&answer.joints_m);
    let distance_n = proof.beyond_n(&answer.axial_n);
    let tolerances = Tolerances::project();
    let near =
        distance_m <= tolerances.joints * length_m && distance_n <= tolerances.forces * force_n;
    // NaN is near to nothing.
    if !near {
        return Status::Open(Reason::NoBox(NoBox::Elsewhere { distance_m, distance_n }));
    }
    let SystemBox { width_m, width_n, turns, .. } = *proof;
    Status::Reached(Verified {
        box_width: (width_m / size_m).max(width_n / force_n),
        distance: distance_m / length_m,
        circle: false,
        system: Some(VerifiedSystem {
            width_m,
            width_n,
            distance_n,
            turns,
            slack: proof.slack.len(),
            loose_joints: proof.loose_joints.len(),
        }),
    })
}

#[cfg(test)]
mod tests;
