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

fn refuse(what: String) -> ExportError {
    ExportError::NoCounterpart { format: "URDF", what }
}

pub(super) fn write(shape: &Shape<'_>) -> Result<String, ExportError> {
    let (system, joints_m) = (shape.system, shape.joints_m);
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<robot name=\"{}\">\n<mujoco>\n<compiler balanceinertia=\"false\"/>\n\
         <option gravity=\"0 0 {:?}\"/>\n</mujoco>\n<link name=\"world\"/>\n",
        attribute(system.name()),
        -system.gravity_m_s2()
    );
    let (mut reached, mut next) = anchors(shape)?;
    let mut at_joint = vec![vec![]; joints_m.len()];
    for (k, member) in system.members().iter().enumerate() {
        at_joint[member.from].push(k);
        at_joint[member.to].push(k);
    }
    let mut written = vec![false; system.members().len()];
    while let Some(from) = next.pop_front() {
        let Some((parent, begin_m)) = reached[from].clone() else { continue };
        for k in std::mem::take(&mut at_joint[from]) {
            if std::mem::replace(&mut written[k], true) {
                continue;
            }
            let (number, member) = (k + 1, &system.members()[k]);
            let to = if member.from == from { member.to } else { member.from };
            let why = if reached[to].is_some() { Some("loop") } else { unlike_a_link(member) };
            let inertia = why.map_or_else(|| inertial(shape, member, from, to), Err);
            let inertia = inertia.map_err(|why| refuse(format!("{why} (member {number})")))?;
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

/// Of each joint that is reached: the link that it is on, and where that begins, m.
type Reached = Vec<Option<(String, Vector)>>;

/// The anchors, from which everything hangs.
fn anchors(shape: &Shape<'_>) -> Result<(Reached, VecDeque<usize>), ExportError> {
    if let Some(floor_m) = shape.system.floor_m() {
        return Err(refuse(format!("floor (z = {floor_m} m)")));
    }
    let mut reached = vec![None; shape.joints_m.len()];
    for (joint, reached) in shape.system.joints().iter().zip(&mut reached) {
        if joint.support.is_fixed() {
            *reached = Some(("world".to_owned(), [0.0; 3]));
        } else if joint.support.at_m().is_some() {
            return Err(refuse(format!("joint that slides and turns (joint {:?})", joint.name)));
        } else if norm(joint.force_n) > 0.0 {
            return Err(refuse(format!("force at rest (joint {:?})", joint.name)));
        }
    }
    let held = (0..reached.len()).filter(|k| reached[*k].is_some()).collect();
    Ok((reached, held))
}

/// What a member has that no link has.
fn unlike_a_link(member: &Member) -> Option<&'static str> {
    let [_, across, other] = member.body.inertia_kg_m2();
    if member.kind != Kind::Bar || member.rope.is_some() {
        Some("link that goes slack")
    } else if member.stiffness_n.is_some() {
        Some("link that stretches")
    } else if !member.loads.is_empty() {
        Some("force at rest")
    } else if (across - other).abs() > ROUNDING * across {
        Some("bar whose moments across differ")
    } else {
        None
    }
}

/// Mass, centre and moments about it of a bar with the mass at its far joint, in axes that begin at the near one.
fn inertial(
    shape: &Shape<'_>,
    member: &Member,
    from: usize,
    to: usize,
) -> Result<String, &'static str> {
    let body = &member.body;
    let along = minus(shape.joints_m[to], shape.joints_m[from]);
    let length_m = norm(along);
    let unit = times(1.0 / length_m, along);
    let centre_m = body.centre_m();
    let centre_m = if member.from == from { centre_m } else { body.length_m() - centre_m };
    let point_kg = shape.system.joints()[to].mass_kg;
    let mass_kg = body.mass_kg() + point_kg;
    if mass_kg <= 0.0 {
        return Err("link without mass");
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
    Ok(text)
}
