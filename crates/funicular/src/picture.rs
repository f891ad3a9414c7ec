//! Drawings of answers: joints, supports, loads, reactions and axial forces, to scale.

use figures::{Joint, Member, Structure, StructureError, Support as Held};
use model::system::{Support, System, SystemEquilibrium};
use model::{Equilibrium, Vector};

/// An equilibrium of a system as an SVG file.
///
/// ```
/// use funicular::prelude::*;
/// let chain = Problem::case("two-bars")?;
/// let chain = chain.as_chain().unwrap();
/// let system = System::from(chain.chain());
/// let answer = Solve::new().run_system(&system)?;
/// let svg = funicular::picture::of_system(&system, &answer.equilibria()[0]).unwrap();
/// assert!(svg.starts_with("<svg") || svg.starts_with("<?xml"));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
///
/// [`StructureError`] when a place is not finite.
pub fn of_system(system: &System, answer: &SystemEquilibrium) -> Result<String, StructureError> {
    draw(system, &answer.joints_m, &answer.axial_n, &answer.reactions_n)
}

/// An equilibrium of a chain as an SVG file.
///
/// # Errors
///
/// [`StructureError`] when a place is not finite.
pub fn of_chain(chain: &model::Chain, answer: &Equilibrium) -> Result<String, StructureError> {
    let system = System::from(chain);
    let mut reactions_n = vec![[0.0; 3]; answer.joints_m.len()];
    if let Some(first) = reactions_n.first_mut() {
        *first = answer.reactions_n.start;
    }
    if let Some(last) = reactions_n.last_mut() {
        *last = answer.reactions_n.end;
    }
    draw(&system, &answer.joints_m, &answer.axial_n, &reactions_n)
}

fn draw(
    system: &System,
    joints_m: &[Vector],
    axial_n: &[f64],
    reactions_n: &[Vector],
) -> Result<String, StructureError> {
    let gravity = system.gravity_m_s2();
    let placed = system.joints().iter().zip(joints_m).zip(reactions_n);
    let joints: Vec<Joint<'_>> = placed
        .map(|((joint, at_m), reaction_n)| {
            let [x, y, z] = joint.force_n;
            Joint {
                name: &joint.name,
                at_m: *at_m,
                support: match joint.support {
                    Support::Free => None,
                    Support::Fixed { .. } => Some(Held::Fixed),
                    Support::Line { direction, .. } => Some(Held::Line(direction)),
                    Support::Plane { normal, .. } => Some(Held::Plane(normal)),
                },
                load_n: [x, y, z - joint.mass_kg * gravity],
                reaction_n: *reaction_n,
            }
        })
        .collect();
    let members: Vec<Member> = system
        .members()
        .iter()
        .zip(axial_n)
        .map(|(member, axial)| Member { joints: [member.from, member.to], axial_n: Some(*axial) })
        .collect();
    let note =
        "arrows: loads at joints, and forces of the ground; the weights of members are not drawn";
    Structure { title: system.name(), note, joints: &joints, members: &members }.svg()
}
