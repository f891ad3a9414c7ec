//! Systems above a floor: a proof for the joints that lie on it, and of which way it pushes.
//!
//! A joint that lies on the floor and may rise upright is one that slides in its level. The box of that system is
//! one of the system above the floor as well, if in all of it the floor pushes what lies and the
//! other joints are above.

use model::system::{Joint, Support, System};
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::prove::prove_without_floor;
use super::proven::SystemBox;

/// A joint that is this near to the floor, in units of the mean length of the members, is taken to
/// lie on it: far above the error of answers, far below what else is likely. The proof does not
/// rest on it.
const NEAR: f64 = 1e-7;

/// Prove that exactly one equilibrium above the floor lies in a box next to an answer.
///
/// Another equilibrium in the box would have the same joints above the floor, and those that lie
/// could not rise: the push is positive in all of the box.
pub(super) fn prove_above(
    system: &System,
    floor_m: f64,
    joints_m: &[Point],
    axial_n: &[f64],
) -> Result<SystemBox, NoBox> {
    let (laid, lies) = laid(system, floor_m, joints_m)?;
    let found = prove_without_floor(&laid, joints_m, axial_n)?;
    let pushes = pushes_n(system, &found);
    for (k, joint) in system.joints().iter().enumerate() {
        let height = found.joints_m[k][2];
        let right = if lies[k] {
            pushes[k].lo() > 0.0
        } else {
            stays_level(&joint.support) || height.lo() >= floor_m
        };
        if !right {
            return Err(NoBox::Floor { joint: k + 1 });
        }
    }
    Ok(found)
}

/// The system whose joints slide on the floor where they lie on it, and which do.
pub(super) fn laid(
    system: &System,
    floor_m: f64,
    joints_m: &[Point],
) -> Result<(System, Vec<bool>), NoBox> {
    let near_m = NEAR * system.total_length_m() / system.members().len() as f64;
    let joints = || system.joints().iter().zip(joints_m);
    let near = |at_m: &Point| at_m[2] <= floor_m + near_m;
    let rises = |joint: &Joint| match joint.support {
        Support::Free | Support::Plane { .. } => joint.support.on_level([0.0; 3]).is_some(),
        _ => false,
    };
    let lies: Vec<bool> = joints().map(|(joint, at_m)| rises(joint) && near(at_m)).collect();
    let laid = system.laid(joints_m, |k, _| lies[k], system.members().to_vec());
    Ok((laid.map_err(|_| NoBox::NotFinite)?, lies))
}

/// Whether no motion that a support leaves changes the height, without any rounding.
pub(super) fn stays_level(support: &Support) -> bool {
    support.free_part([0.0, 0.0, 1.0])[2] <= 0.0
}

/// What the members and loads of each joint leave for the floor to bear, up positive, N.
fn pushes_n(system: &System, found: &SystemBox) -> Vec<Interval> {
    // A plane that leans bears what is normal to the ways it leaves: of `n` normal to it the upright push bears
    // `f_z - n_z (n_x f_x + n_y f_y)/(n_x² + n_y²)`.
    let supports = system.joints().iter().map(|joint| &joint.support);
    supports
        .zip(found.left_n(system, |_, _| false))
        .map(|(support, [x, y, z])| match support {
            Support::Plane { normal, .. } if normal[2].abs() > 0.0 => {
                let [along_x, along_y, up] = normal.map(Interval::point);
                let level = along_x.square() + along_y.square();
                up * (along_x * x + along_y * y) / level - z
            }
            _ => -z,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::Member;

    use super::*;

    /// Members of 2 m, 5 m and 8 m, 5 m on the average: joints lie on the floor up to 0.5 µm above it.
    #[test]
    fn joints_lie_by_the_mean_length_of_members() {
        let mut joints = vec![Joint::anchor("A", [0.0, 0.0, 3.0])];
        joints.extend((1..4).map(|k| Joint::free(k.to_string()).with_mass(1.0)));
        let member =
            |(k, length_m)| Member::bar(k, k + 1, Bar::homogeneous(length_m, 0.0).unwrap());
        let members = [2.0, 5.0, 8.0].into_iter().enumerate().map(member).collect();
        let system = System::new("floor", 10.0, joints, members).unwrap();
        let system = system.with_floor(1.0).unwrap();
        let at =
            [[0.0, 0.0, 3.0], [1.0, 0.0, 0.9e-7 * 5.0], [6.0, 0.0, 1.1e-7 * 5.0], [9.0, 0.0, -1.0]];
        let at = at.map(|[x, y, z]| [x, y, z + 1.0]);
        let (laid, lies) = laid(&system, 1.0, &at).unwrap();
        assert_eq!(lies, [false, true, false, true]);
        let supports = laid.joints()[1..].iter().map(|joint| joint.support);
        for ((support, lies), at_m) in supports.zip(&lies[1..]).zip(&at[1..]) {
            let plane = Support::Plane { at_m: [at_m[0], at_m[1], 1.0], normal: [0.0, 0.0, 1.0] };
            assert_eq!(support, if *lies { plane } else { Support::Free });
        }
    }
}
