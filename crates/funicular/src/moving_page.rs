//! What the pages have in common on which a system moves: the scene, the numbers of the system, the
//! escaping of its name.

use std::fmt::Write as _;

use figures::{BLUE, Escaped, SKY_BLUE, VERMILION, regions};
use model::Vector;
use model::system::System;
use serde_json::Value;

/// The part of the script that draws and turns the scene.
const SCENE: &str = include_str!("scene.js");

/// A page with `@SCENE@`, `@TITLE@` and `@DATA@` filled in. It needs nothing but itself.
pub(crate) fn filled(page: &str, system: &System, data: &str) -> String {
    // A name must not fill in the rest of the page.
    let title = Escaped(system.name()).to_string().replace('@', "&#64;");
    let regions: Vec<_> = regions(6).iter().map(|colour| format!("\"{colour}\"")).collect();
    let page = page
        .replace("@SCENE@", SCENE.trim_end())
        .replace("@BLUE@", &BLUE.to_string())
        .replace("@SKY@", &SKY_BLUE.to_string())
        .replace("@VERMILION@", &VERMILION.to_string())
        .replace("@REGIONS@", &format!("[{}]", regions.join(", ")));
    page.replace("@TITLE@", &title).replace("@DATA@", data)
}

/// The entries of which bars there are, which joints are held (on a line or plane too) and what they
/// are called, with a comma behind them.
pub(crate) fn structure(out: &mut String, system: &System) {
    out.push_str("\"bars\":[");
    for (k, member) in system.members().iter().enumerate() {
        let _ = write!(out, "{}[{},{}]", comma(k), member.from, member.to);
    }
    out.push_str("],\"held\":[");
    for (k, joint) in system.joints().iter().enumerate() {
        let _ = write!(out, "{}{}", comma(k), u8::from(joint.support.at_m().is_some()));
    }
    out.push_str("],\"names\":[");
    for (k, joint) in system.joints().iter().enumerate() {
        // Nothing turns the text around it, and in a script nothing may look like its end.
        let name = joint.name.replace(model::steers, " ");
        let name = Value::from(name).to_string().replace('<', "\\u003c");
        let _ = write!(out, "{}{name}", comma(k));
    }
    out.push_str("],");
}

/// Joints, from the reference point of the system: x, y, z of one after the other, m.
pub(crate) fn places(out: &mut String, system: &System, joints_m: impl Iterator<Item = Vector>) {
    let reference = system.reference_m();
    list(out, joints_m.flat_map(|x| [0, 1, 2].map(|k| x[k] - reference[k])));
}

/// Numbers for the eye: six digits.
pub(crate) fn list(out: &mut String, numbers: impl Iterator<Item = f64>) {
    out.push('[');
    for (k, x) in numbers.enumerate() {
        // Six digits, written as short as they are.
        let rounded: f64 = format!("{x:.5e}").parse().unwrap_or(0.0);
        let _ = write!(out, "{}{rounded}", comma(k));
    }
    out.push(']');
}

/// Four digits.
pub(crate) fn eye(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}

/// What stands before item `k` of a list.
pub(crate) fn comma(k: usize) -> &'static str {
    if k > 0 { "," } else { "" }
}
