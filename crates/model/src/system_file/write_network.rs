//! Writing systems of bars: the text that reads back to the same system, bit for bit.

use std::fmt::Write as _;

use super::write::{differ, vector, write_given};
use crate::system::{Joint, Kind, LoadOn, Member, NamedLoad, Strength, Support, System};

/// The system file of a system of bars, every joint with its name and every member on its own.
///
/// ```
/// use model::system_file::{Described, parse, write_network};
/// let system = model::system::System::from(model::cases::paper().chain());
/// assert_eq!(parse(&write_network(&system), "paper.toml")?, Described::System(system));
/// # Ok::<(), model::system_file::SystemFileError>(())
/// ```
pub fn write_network(system: &System) -> String {
    let permanent = (!system.named_loads().is_empty()).then(|| system.without_named_loads());
    let mut text = write_permanent(permanent.as_ref().unwrap_or(system));
    for load in system.named_loads() {
        write_load(&mut text, system, load);
    }
    for case in system.load_cases() {
        let factor = |(load, by): &(String, f64)| format!("{} = {by:?}", key(load));
        let factors: Vec<_> = case.factors.iter().map(factor).collect();
        let (name, factors) = (text_of(&case.name), factors.join(", "));
        let _ = write!(text, "\n[[cases]]\nname = {name}\nfactors = {{ {factors} }}\n");
    }
    text
}

fn text_of(text: &str) -> toml::Value {
    text.into()
}

/// A name as a key, in which TOML takes no text of several lines.
fn key(name: &str) -> String {
    let mut key = String::from('"');
    for c in name.chars() {
        match c {
            '"' | '\\' => key.extend(['\\', c]),
            // Writing to a String cannot fail.
            c if c.is_control() => drop(write!(key, "\\u{:04X}", u32::from(c))),
            c => key.push(c),
        }
    }
    key + "\""
}

fn write_load(text: &mut String, system: &System, load: &NamedLoad) {
    let _ = write!(text, "\n[[loads]]\nname = {}\n", text_of(&load.name));
    let _ = match &load.on {
        LoadOn::Joints { joints, mass_kg, force_n } => {
            let names =
                joints.iter().map(|k| text_of(&system.joints()[*k].name.text()).to_string());
            let (names, force_n) = (names.collect::<Vec<_>>().join(", "), vector(*force_n));
            writeln!(text, "joint = [{names}]\nmass_kg = {mass_kg:?}\nforce_n = {force_n}")
        }
        LoadOn::Members { members, force_n_per_m } => {
            let numbers = members.iter().map(|k| (k + 1).to_string());
            let (numbers, force) = (numbers.collect::<Vec<_>>().join(", "), vector(*force_n_per_m));
            writeln!(text, "bar = [{numbers}]\nforce_n_per_m = {force}")
        }
    };
}

/// The same without loads by name.
fn write_permanent(system: &System) -> String {
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
        let _ = writeln!(text, "{} = {}", key(&joint.name.text()), entry(joint));
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
    if let Some(within) = joint.tolerances.as_deref() {
        let given = [
            ("mass_tolerance_kg", within.mass_kg()),
            ("at_tolerance_m", within.at_m()),
            ("force_tolerance_n", within.force_n()),
        ];
        let given = given.into_iter().filter(|(_, within)| *within > 0.0);
        keys.extend(given.map(|(key, within)| format!("{key} = {within:?}")));
    }
    format!("{{ {} }}", keys.join(", "))
}

fn write_member(text: &mut String, system: &System, member: &Member) {
    let name = |joint: usize| text_of(&system.joints()[joint].name.text());
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
    if member.kind != Kind::Bar {
        let _ = writeln!(text, "kind = \"{}\"", member.kind.name());
    }
    let within = member.tolerances.as_deref().copied().unwrap_or_default();
    let positive = |within: f64| Some(within).filter(|within| *within > 0.0);
    let strength = member.strength.as_deref();
    let safety = strength.map(Strength::safety).filter(|safety| differ(&[*safety], &[1.0]));
    let numbers = [
        ("stiffness_n", member.stiffness_n),
        ("prestress_n", member.prestress_n()),
        ("length_tolerance_m", member.length_tolerance_m()),
        ("stiffness_tolerance", positive(within.stiffness())),
        ("mass_tolerance_kg", positive(within.mass_kg())),
        ("strength_n", strength.and_then(Strength::tension_n)),
        ("compression_n", strength.and_then(Strength::compression_n)),
        ("safety", safety),
    ];
    for (key, number) in numbers.into_iter().filter_map(|(key, number)| Some((key, number?))) {
        let _ = writeln!(text, "{key} = {number:?}");
    }
    let loads = member.given_loads();
    if !loads.is_empty() {
        let forces = loads.iter().map(|load| {
            let force_n = vector(load.force_n);
            if load.is_spread {
                format!("{{ force_n = {force_n}, spread = true }}")
            } else {
                format!("{{ force_n = {force_n}, at_m = {:?} }}", load.at_m)
            }
        });
        let _ = writeln!(text, "forces = [{}]", forces.collect::<Vec<_>>().join(", "));
    }
}
