//! What the pages have in common on which a system moves: the scene, the numbers of the system, the
//! escaping of its name.

use std::fmt::Write as _;

use figures::{BLUE, Escaped, SKY_BLUE, VERMILION, regions};
use model::Vector;
use model::system::System;
use serde_json::Value;

/// The part of the script that draws and turns the scene.
const SCENE: &str = include_str!("scene.js");

/// A page with `@SCENE@`, `@TITLE@`, `@WORDS@` and `@DATA@` filled in. It needs nothing but itself.
pub(crate) fn filled(page: &str, title: &str, words: &str, data: &str) -> String {
    // A name must not fill in the rest of the page.
    let title = Escaped(title).to_string().replace('@', "&#64;");
    let regions: Vec<_> = regions(6).iter().map(|colour| format!("\"{colour}\"")).collect();
    let page = page
        .replace("@SCENE@", SCENE.trim_end())
        .replace("@BLUE@", &BLUE.to_string())
        .replace("@SKY@", &SKY_BLUE.to_string())
        .replace("@VERMILION@", &VERMILION.to_string())
        .replace("@REGIONS@", &format!("[{}]", regions.join(", ")));
    page.replace("@TITLE@", &title).replace("@WORDS@", words).replace("@DATA@", data)
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
        let name = Value::from(plain(&joint.name)).to_string();
        let _ = write!(out, "{}{}", comma(k), in_script(&name));
    }
    out.push_str("],");
}

/// Joints, from the reference point of the system: x, y, z of one after the other, m.
pub(crate) fn places(out: &mut String, system: &System, joints_m: impl Iterator<Item = Vector>) {
    list(out, flat(system, joints_m).into_iter());
}

/// The same as numbers for the eye.
pub(crate) fn flat(system: &System, joints_m: impl Iterator<Item = Vector>) -> Vec<f64> {
    let reference = system.reference_m();
    joints_m.flat_map(|x| [0, 1, 2].map(|k| six(x[k] - reference[k]))).collect()
}

/// A text that does not turn what stands around it.
pub(crate) fn plain(text: &str) -> String {
    text.replace(model::steers, " ")
}

/// JSON in which nothing looks like the end of a script.
pub(crate) fn in_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

/// For the eye: six digits, written as short as they are.
pub(crate) fn six(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(0.0)
}

/// Numbers for the eye.
pub(crate) fn list(out: &mut String, numbers: impl Iterator<Item = f64>) {
    out.push('[');
    for (k, x) in numbers.enumerate() {
        let _ = write!(out, "{}{}", comma(k), six(x));
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
