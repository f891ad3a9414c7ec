//! Proofs where joints have run together on a rope.
//!
//! Let a span of a rope with the tension $T$ have no length, and let the balance of one of its joints leave it the
//! pull $p$. The system in which both joints are one has a box with exactly one equilibrium. Where $|p| < T$ in all
//! of it, that is the only one of the whole system near by: with the joints apart the span would pull with $T$
//! itself, $T u = p$ with $|u| = 1$, and next to the box $p$ is too small for that.

use model::system::{Support, System};
use model::{NoBox, Vector as Point};

use super::arithmetic::norm;
use super::prove::prove;
use super::proven::SystemBox;

/// A span of a taut rope without a length: its rope, its number in that, its joints.
type Jammed = (usize, usize, [usize; 2]);

/// The spans of taut ropes whose joints are in one place in an answer.
pub(super) fn jammed(system: &System, joints_m: &[Point], axial_n: &[f64]) -> Vec<Jammed> {
    let members = system.members().iter().zip(axial_n).enumerate();
    let taut = members.filter(|(_, (member, axial))| member.rope.is_some() && **axial > 0.0);
    let spans = taut.flat_map(|(k, (member, _))| {
        member.spans().enumerate().map(move |(number, joints)| (k, number, joints))
    });
    let apart =
        |[a, b]: [usize; 2], axis: usize| (joints_m[a][axis] - joints_m[b][axis]).abs() > 0.0;
    spans.filter(|(.., joints)| !(0..3).any(|axis| apart(*joints, axis))).collect()
}

/// Prove an answer with such spans.
/// As [`prove`], and [`NoBox::Rope`] where a span may bear all of the tension of its rope, or no joint tells what it
/// bears.
pub(super) fn prove_joined(
    system: &System,
    jams: &[Jammed],
    joints_m: &[Point],
    axial_n: &[f64],
) -> Result<SystemBox, NoBox> {
    let pairs: Vec<[usize; 2]> = jams.iter().map(|(.., joints)| *joints).collect();
    let Some(joined) = system.joined(&pairs) else {
        return Err(NoBox::Rope { member: jams[0].0 + 1 });
    };
    let found = prove(&joined.system, &joined.places_m(joints_m), axial_n)?;
    let of_one = |number: &usize| found.joints_m[*number];
    let whole = SystemBox {
        joints_m: joined.numbers.iter().map(of_one).collect(),
        loose_joints: (0..joints_m.len())
            .filter(|joint| found.loose_joints.contains(&joined.numbers[*joint]))
            .collect(),
        ..found
    };
    // All spans with a length pull.
    let is_jam = |member, span| jams.iter().any(|(k, n, _)| [*k, *n] == [member, span]);
    let left_n = whole.left_n(system, is_jam);
    for (member, _, joints) in jams {
        let fixed = |joint: &usize| system.joints()[*joint].support.is_fixed();
        let tells = |joint: &&usize| tells(system, jams, &whole, **joint);
        if joints.iter().all(fixed) {
            continue;
        }
        let pull = joints.iter().find(tells).map(|joint| norm(left_n[*joint]));
        if !pull.is_some_and(|pull| pull.hi() < whole.axial_n[*member].lo()) {
            return Err(NoBox::Rope { member: member + 1 });
        }
    }
    Ok(whole)
}

/// Whether the balance of a joint tells what its one span without length bears: nothing else holds it.
fn tells(system: &System, jams: &[Jammed], found: &SystemBox, joint: usize) -> bool {
    let ends = jams.iter().filter(|(.., joints)| joints.contains(&joint));
    let above = |floor_m: f64| found.joints_m[joint][2].lo() > floor_m;
    system.joints()[joint].support == Support::Free
        && ends.count() == 1
        && system.floor_m().is_none_or(above)
}
