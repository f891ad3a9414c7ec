//! URDF: bars as links that hang from their anchors like trees, on ball joints.
//!
//! A link begins at the joint nearer to its anchor, and its axes are those of the world in this equilibrium, in which all its joints
//! are at zero. It has the mass and moments of its bar, and the mass of the joint at its other end. Ball joints (`spherical`) are
//! what MuJoCo and Bullet read beyond the standard; gravity stands in an element of MuJoCo's, as URDF has none.
//!
//! # References
//!
//! URDF, <https://wiki.ros.org/urdf/XML>; MuJoCo, Modeling, "URDF extensions", <https://mujoco.readthedocs.io/en/stable/modeling.html>.

use std::collections::VecDeque;
use std::fmt::Write as _;

use model::Vector;
use model::system::{Kind, Member};
use numerics::vector::{minus, norm, times};

use super::{ExportError, Shape, attribute, row};

/// Radius of gyration that every link has at least, as a part of its length: readers refuse what has no moment of inertia. The
/// frequencies are off by no more than its square.
const SLENDER: f64 = 1e-5;
/// Moments of a bar across are one where they differ by no more than their rounding.
const ROUNDING: f64 = 1e-12;

pub(super) fn write(shape: &Shape<'_>) -> Result<String, ExportError> {
    let (system, joints_m) = (shape.system, shape.joints_m);
    let refuse = |what| Err(ExportError::NoCounterpart { format: "URDF", what });
    if let Some(floor_m) = system.floor_m() {
        return refuse(format!("floor (z = {floor_m} m)"));
    }
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n<mujoco>\n<compiler balanceinertia=\"false\"/>\n\
         <option gravity=\"0 0 {:?}\"/>\n</mujoco>\n<link name=\"world\"/>\n",
        attribute(system.name()),
        -system.gravity_m_s2()
    );
    // Of each joint that is reached: the link that it is on, and where that begins.
    let mut reached: Vec<Option<(String, Vector)>> = vec![None; joints_m.len()];
    let mut next = VecDeque::new();
    for (k, joint) in system.joints().iter().enumerate() {
        if joint.support.is_fixed() {
            reached[k] = Some(("world".to_owned(), [0.0; 3]));
            next.push_back(k);
        } else if joint.support.at_m().is_some() {
            return refuse(format!("joint that slides and turns (joint {:?})", joint.name));
        } else if norm(joint.force_n) > 0.0 {
            return refuse(format!("force at rest (joint {:?})", joint.name));
        }
    }
    let mut left: Vec<(usize, &Member)> = system.members().iter().enumerate().collect();
    while let Some(from) = next.pop_front() {
        let Some((parent, begin_m)) = reached[from].clone() else { continue };
        let (here, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|(_, member)| [member.from, member.to].contains(&from));
        left = others;
        for (k, member) in here {
            let number = k + 1;
            if member.kind != Kind::Bar || member.rope.is_some() {
                return refuse(format!("link that goes slack (member {number})"));
            }
            if member.stiffness_n.is_some() {
                return refuse(format!("link that stretches (member {number})"));
            }
            if !member.loads.is_empty() {
                return refuse(format!("force at rest (member {number})"));
            }
            let to = if member.from == from { member.to } else { member.from };
            if reached[to].is_some() {
                return refuse(format!("loop (member {number})"));
            }
            let [_, across, other] = member.body.inertia_kg_m2();
            if (across - other).abs() > ROUNDING * across {
                return refuse(format!("bar whose moments across differ (member {number})"));
            }
            let Some(inertia) = inertial(shape, member, from, to) else {
                return refuse(format!("link without mass (member {number})"));
            };
            let at = row(&minus(joints_m[from], begin_m));
            let _ = write!(
                text,
                "<link name=\"m{number}\">\n{inertia}</link>\n<joint name=\"j{number}\" type=\"spherical\">\n\
                 <parent link=\"{parent}\"/>\n<child link=\"m{number}\"/>\n<origin xyz=\"{at}\"/>\n</joint>\n"
            );
            reached[to] = Some((format!("m{number}"), joints_m[from]));
            next.push_back(to);
        }
    }
    text.push_str("</robot>\n");
    Ok(text)
}

/// Mass, centre and moments of a bar with the mass at its far joint, about the joint where it begins; none if it has no mass.
fn inertial(shape: &Shape<'_>, member: &Member, from: usize, to: usize) -> Option<String> {
    let body = &member.body;
    let along = minus(shape.joints_m[to], shape.joints_m[from]);
    let length_m = norm(along);
    let unit = times(1.0 / length_m, along);
    let centre_m = body.centre_m();
    let centre_m = if member.from == from { centre_m } else { body.length_m() - centre_m };
    let point_kg = shape.system.joints()[to].mass_kg;
    let mass_kg = body.mass_kg() + point_kg;
    if mass_kg <= 0.0 {
        return None;
    }
    let middle_m = (body.mass_kg() * centre_m + point_kg * length_m) / mass_kg;
    let [axial, across, _] = body.inertia_kg_m2();
    let least = mass_kg * (SLENDER * length_m).powi(2);
    // All masses are on one line.
    let across = across
        + body.mass_kg() * (centre_m - middle_m).powi(2)
        + point_kg * (length_m - middle_m).powi(2)
        + least;
    let axial = axial + least;
    let moment = |i: usize, k: usize| {
        let line = unit[i] * unit[k];
        axial * line + across * (f64::from(u8::from(i == k)) - line)
    };
    let mut text = format!(
        "<inertial>\n<origin xyz=\"{}\"/>\n<mass value=\"{mass_kg:?}\"/>\n<inertia",
        row(&times(middle_m, unit))
    );
    for (name, i, k) in
        [("ixx", 0, 0), ("ixy", 0, 1), ("ixz", 0, 2), ("iyy", 1, 1), ("iyz", 1, 2), ("izz", 2, 2)]
    {
        let _ = write!(text, " {name}=\"{:?}\"", moment(i, k));
    }
    text.push_str("/>\n</inertial>\n");
    Some(text)
}
