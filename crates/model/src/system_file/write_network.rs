//! Writing systems of bars: the text that reads back to the same system, bit for bit.

use std::fmt::Write as _;

use super::write::{differ, vector, write_given};
use crate::system::{Joint, Kind, Member, Support, System};

/// The system file of a system of bars, every joint with its name and every member on its own.
///
/// ```
/// use model::system_file::{Described, parse, write_network};
/// let system = model::system::System::from(model::cases::paper().chain());
/// assert_eq!(parse(&write_network(&system), "paper.toml")?, Described::System(system));
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
#[must_use]
pub fn write_network(system: &System) -> String {
    let mut text = format!(
        "name = {}\ngravity_m_s2 = {:?}\n",
        toml::Value::from(system.name()),
        system.gravity_m_s2(),
    );
    // Writing to a String cannot fail.
    if let Some(floor_m) = system.floor_m() {
        let _ = writeln!(text, "floor_m = {floor_m:?}");
    }
    text.push_str("\n[joints]\n");
    for joint in system.joints() {
        let _ = writeln!(text, "{} = {}", toml::Value::from(joint.name.as_str()), entry(joint));
    }
    for member in system.members() {
        write_member(&mut text, system, member);
    }
    text
}

fn entry(joint: &Joint) -> String {
    let mut keys = Vec::new();
    if let Some(at_m) = joint.support.at_m() {
        keys.push(format!("at_m = {}", vector(at_m)));
    }
    match joint.support {
        Support::Line { direction, .. } => keys.push(format!("along = {}", vector(direction))),
        Support::Plane { normal, .. } => keys.push(format!("normal = {}", vector(normal))),
        Support::Free | Support::Fixed { .. } => {}
    }
    if let Some(near_m) = joint.near_m {
        keys.push(format!("near_m = {}", vector(near_m)));
    }
    if differ(&[joint.mass_kg], &[0.0]) {
        keys.push(format!("mass_kg = {:?}", joint.mass_kg));
    }
    if differ(&joint.force_n, &[0.0; 3]) {
        keys.push(format!("force_n = {}", vector(joint.force_n)));
    }
    format!("{{ {} }}", keys.join(", "))
}

fn write_member(text: &mut String, system: &System, member: &Member) {
    let name = |joint: usize| toml::Value::from(system.joints()[joint].name.as_str());
    let body = member.given_body();
    let (length_m, mass_kg) = (body.length_m(), body.mass_kg());
    let _ = write!(
        text,
        "\n[[bars]]\nfrom = {}\nto = {}\nlength_m = {length_m:?}\nmass_kg = {mass_kg:?}\n",
        name(member.from),
        name(member.to),
    );
    if member.rope.is_some() {
        let via: Vec<String> = member.via().iter().map(|joint| name(*joint).to_string()).collect();
        let _ = writeln!(text, "via = [{}]", via.join(", "));
    }
    write_given(text, body);
    match member.kind {
        Kind::Bar => {}
        Kind::Cable => text.push_str("kind = \"cable\"\n"),
        Kind::Strut => text.push_str("kind = \"strut\"\n"),
    }
    if let Some(stiffness_n) = member.stiffness_n {
        let _ = writeln!(text, "stiffness_n = {stiffness_n:?}");
    }
    if let Some(prestress_n) = member.prestress_n() {
        let _ = writeln!(text, "prestress_n = {prestress_n:?}");
    }
    if let Some(tolerance_m) = member.length_tolerance_m {
        let _ = writeln!(text, "length_tolerance_m = {tolerance_m:?}");
    }
    if let Some(strength) = member.strength.as_deref() {
        let given =
            [("strength_n", strength.tension_n()), ("compression_n", strength.compression_n())];
        let safety = Some(strength.safety()).filter(|safety| differ(&[*safety], &[1.0]));
        for (key, number) in given.into_iter().chain([("safety", safety)]) {
            if let Some(number) = number {
                let _ = writeln!(text, "{key} = {number:?}");
            }
        }
    }
    let loads = member.given_loads();
    if !loads.is_empty() {
        let forces = loads.iter();
        let forces = forces.map(|load| {
            format!("{{ force_n = {}, at_m = {:?} }}", vector(load.force_n), load.at_m)
        });
        let _ = writeln!(text, "forces = [{}]", forces.collect::<Vec<_>>().join(", "));
    }
}
