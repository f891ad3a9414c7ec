//! The page on which a system is shown: its scripts, the numbers of the system, the escaping of its name.

use figures::{BLUE, Escaped, SKY_BLUE, VERMILION, regions};
use model::Vector;
use model::system::System;
use serde::Serialize;

/// The part of the script that draws and turns the scene, and that of what moves over a number.
const SCENE: &str = include_str!("scene.js");
const TRACK: &str = include_str!("track.js");

/// A page with its scripts, colours, `@TITLE@`, `@WORDS@` and `@DATA@` filled in. It needs nothing but itself.
pub(crate) fn filled(page: &str, title: &str, words: &str, data: &str) -> String {
    // A name must not fill in the rest of the page.
    let title = Escaped(title).to_string().replace('@', "&#64;");
    let regions: Vec<_> = regions(6).iter().map(|colour| format!("\"{colour}\"")).collect();
    let page = page
        .replace("@SCENE@", SCENE.trim_end())
        .replace("@TRACK@", TRACK.trim_end())
        .replace("@BLUE@", &BLUE.to_string())
        .replace("@SKY@", &SKY_BLUE.to_string())
        .replace("@VERMILION@", &VERMILION.to_string())
        .replace("@REGIONS@", &format!("[{}]", regions.join(", ")));
    page.replace("@TITLE@", &title).replace("@WORDS@", words).replace("@DATA@", data)
}

/// The bars of a system, the joints that are held (on a line or plane too) and their names.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Topology {
    /// The joints of each, those that a rope runs over too.
    bars: Vec<Vec<usize>>,
    held: Vec<u8>,
    names: Vec<String>,
}

impl Topology {
    pub fn of(system: &System) -> Self {
        let (joints, members) = (system.joints(), system.members());
        Self {
            bars: members.iter().map(|member| member.path().collect()).collect(),
            held: joints.iter().map(|joint| u8::from(joint.support.at_m().is_some())).collect(),
            names: joints.iter().map(|joint| plain(&joint.name.text())).collect(),
        }
    }
}

/// What a page shows of a system, behind its bars and joints.
#[derive(Serialize)]
pub(crate) struct Data<'a, T> {
    #[serde(flatten)]
    net: Topology,
    /// Where places are counted from, m.
    reference: Vector,
    #[serde(flatten)]
    shown: &'a T,
}

impl<'a, T: Serialize> Data<'a, T> {
    pub fn new(system: &System, shown: &'a T) -> Self {
        Self { net: Topology::of(system), reference: system.reference_m(), shown }
    }
}

/// JSON in which nothing looks like the end of a script.
pub(crate) fn json(data: &impl Serialize) -> String {
    serde_json::to_string(data).unwrap_or_default().replace('<', "\\u003c")
}

/// A text that does not turn what stands around it.
pub(crate) fn plain(text: &str) -> String {
    text.replace(model::steers, " ")
}

/// A text of several lines, none of which turns what stands around it.
pub(crate) fn plain_lines(text: &str) -> String {
    text.lines().map(plain).collect::<Vec<_>>().join("\n")
}

/// Joints, from the reference point of the system: x, y, z of one after the other, m, for the eye.
pub(crate) fn flat(system: &System, joints_m: impl Iterator<Item = Vector>) -> Vec<f64> {
    let reference = system.reference_m();
    joints_m.flat_map(|x| [0, 1, 2].map(|k| six(x[k] - reference[k]))).collect()
}

/// For the eye: six digits, written as short as they are.
pub(crate) fn six(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(0.0)
}

/// Four digits.
pub(crate) fn eye(x: f64) -> f64 {
    format!("{x:.3e}").parse().unwrap_or(x)
}
