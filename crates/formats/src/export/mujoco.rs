//! MuJoCo's XML: masses at the joints, members as tendons.
//!
//! A joint that moves is a body with a slide along each direction that its support leaves free; its mass is its own and what the
//! members lay on it by the lever rule, which is exact at rest; so that light joints bear stiff
//! springs and large forces in steps of time they are made heavier, with gravity taken off what is added. A bar is a tendon of constant length, a cable one with a greatest
//! length, a strut one with a least; elastic members are springs with a dead band where they are slack; a rope is one tendon over
//! the sites of its joints. The bodies stand in the equilibrium, so that it is at rest in MuJoCo as far as its constraints are stiff.
//!
//! # References
//!
//! MuJoCo, XML Reference, <https://mujoco.readthedocs.io/en/stable/XMLreference.html>.

use std::fmt::Write as _;

use model::system::Kind;

use super::dxf::extent;
use super::{Shape, attribute, joint_loads, row};

/// Time step, s: what is left of a constraint's violation falls with its square.
const STEP_S: f64 = 1e-4;
/// Least time, in time steps, that a joint takes for a radian of its fastest swing on the springs that meet there.
const STEPS: f64 = 20.0;
/// Greatest acceleration by which the force of a member may move a joint alone, m/s^2: what constraints are off grows with it.
const GENTLE_M_S2: f64 = 1.0;
/// Least mass and moment of inertia that are written, kg and kg m^2: MuJoCo takes no smaller ones.
const LEAST: f64 = 1e-9;
/// A length that no structure reaches, as a multiple of its extent.
const FAR: f64 = 1e3;

pub(super) fn write(shape: &Shape<'_>) -> String {
    let (forces, masses) = joint_loads(shape.system);
    let least_kg = least_masses(shape);
    let size_m = extent(shape.joints_m);
    let mut text = format!(
        "<!-- Statics: masses at the joints by the lever rule, light ones heavier without weight (gravcomp): no dynamics. -->\n<mujoco model=\"{}\">\n\
         <option gravity=\"0 0 {:?}\" timestep=\"{STEP_S:?}\" iterations=\"200\" tolerance=\"1e-14\">\n\
         <flag refsafe=\"enable\"/>\n</option>\n<worldbody>\n",
        attribute(shape.system.name()),
        -shape.system.gravity_m_s2()
    );
    let radius_m = 0.005 * size_m;
    if let Some(floor_m) = shape.system.floor_m() {
        let at = row(&[0.0, 0.0, floor_m - radius_m]);
        let _ = writeln!(
            text,
            "<geom type=\"plane\" pos=\"{at}\" size=\"0 0 1\" contype=\"1\" conaffinity=\"2\" condim=\"1\" {}/>",
            stiff("")
        );
    }
    let mut motors = String::new();
    for (k, (joint, at_m)) in shape.system.joints().iter().zip(shape.joints_m).enumerate() {
        let (at, axes) = (row(at_m), joint.support.motions());
        if axes.is_empty() {
            let _ = writeln!(text, "<site name=\"j{k}\" pos=\"{at}\" size=\"{radius_m:?}\"/>");
            continue;
        }
        let mass_kg = masses[k].max(least_kg[k]);
        let off = 1.0 - masses[k] / mass_kg;
        // MuJoCo's own name for what does not move.
        let name = joint.name.text();
        let name = if name == "world" { "world of the system" } else { &name };
        let _ =
            writeln!(text, "<body name=\"{}\" pos=\"{at}\" gravcomp=\"{off:?}\">", attribute(name));
        for (n, axis) in axes.iter().enumerate() {
            let _ =
                writeln!(text, "<joint name=\"j{k}.{n}\" type=\"slide\" axis=\"{}\"/>", row(axis));
            let along: f64 = axis.iter().zip(forces[k]).map(|(a, f)| a * f).sum();
            if along.abs() > 0.0 {
                let _ = writeln!(
                    motors,
                    "<general joint=\"j{k}.{n}\" gainprm=\"0\" biastype=\"affine\" biasprm=\"{along:?} 0 0\"/>"
                );
            }
        }
        let turn = (mass_kg * radius_m * radius_m).max(LEAST);
        let _ = writeln!(
            text,
            "<inertial pos=\"0 0 0\" mass=\"{mass_kg:?}\" diaginertia=\"{}\"/>\n<geom type=\"sphere\" size=\"{radius_m:?}\" \
             contype=\"2\" conaffinity=\"0\" condim=\"1\" {}/>\n<site name=\"j{k}\" size=\"{radius_m:?}\"/>\n</body>",
            row(&[turn; 3]),
            stiff("")
        );
    }
    text.push_str("</worldbody>\n<tendon>\n");
    let mut equal = String::new();
    for (k, member) in shape.system.members().iter().enumerate() {
        let (length_m, far_m) = (member.body.length_m(), FAR * size_m);
        let [least_m, most_m] = match member.kind {
            Kind::Bar => [length_m; 2],
            Kind::Cable => [0.0, length_m],
            Kind::Strut => [length_m, far_m],
        };
        let _ = write!(text, "<spatial name=\"m{}\" ", k + 1);
        match (member.stiffness_n, member.kind) {
            (Some(stiffness_n), _) => {
                let k_n_m = stiffness_n / length_m;
                let _ = write!(
                    text,
                    "stiffness=\"{k_n_m:?}\" springlength=\"{}\"",
                    row(&[least_m, most_m])
                );
            }
            (None, Kind::Bar) => {
                let _ = writeln!(equal, "<tendon tendon1=\"m{}\" {}/>", k + 1, stiff(""));
            }
            (None, _) => {
                let _ = write!(
                    text,
                    "limited=\"true\" range=\"{}\" {}",
                    row(&[least_m, most_m]),
                    stiff("limit")
                );
            }
        }
        text.push_str(">\n");
        for joint in member.path() {
            let _ = write!(text, "<site site=\"j{joint}\"/>");
        }
        text.push_str("\n</spatial>\n");
    }
    text.push_str("</tendon>\n");
    for (name, part) in [("equality", equal), ("actuator", motors)] {
        if !part.is_empty() {
            let _ = write!(text, "<{name}>\n{part}</{name}>\n");
        }
    }
    text.push_str("</mujoco>\n");
    text
}

/// What a joint has to weigh so that springs and constraints hold it still in steps of time, kg. Gravity does not act on what is added
/// to its own mass.
fn least_masses(shape: &Shape<'_>) -> Vec<f64> {
    let mut least = vec![LEAST; shape.joints_m.len()];
    for line in shape.lines() {
        let stiffness_n_m = line.member.stiffness_n.unwrap_or(0.0) / line.member.body.length_m();
        let still_kg = stiffness_n_m * (STEPS * STEP_S).powi(2) + line.axial_n.abs() / GENTLE_M_S2;
        for joint in line.ends {
            least[joint] += still_kg;
        }
    }
    least
}

/// The stiffest constraint that the time step bears.
fn stiff(of: &str) -> String {
    format!("solref{of}=\"{:?} 1\" solimp{of}=\"0.9999 0.9999 1 0.5 2\"", 2.0 * STEP_S)
}
