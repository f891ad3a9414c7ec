//! DXF of AutoCAD R12 in ASCII: a layer for each kind of member, for the joints and for their names.
//!
//! # References
//!
//! AutoCAD R12 Customization Manual, "Drawing Interchange and File Formats".

use std::fmt::Write as _;

use model::Vector;
use model::system::Support;
use numerics::vector::{minus, norm};

use super::{Shape, kind};

/// Colours of AutoCAD: tension, compression, neither.
const COLOURS: [u8; 3] = [5, 1, 8];
/// Height of the names as a part of the structure's extent.
const TEXT: f64 = 0.02;

pub(super) fn write(shape: &Shape<'_>) -> String {
    let mut text = "0\nSECTION\n2\nENTITIES\n".to_owned();
    for line in shape.lines() {
        let colour = COLOURS[line.look()];
        let _ = write!(text, "0\nLINE\n8\n{}s\n62\n{colour}\n", kind(line.member));
        for (end, joint) in line.ends.into_iter().enumerate() {
            place(&mut text, end, shape.joints_m[joint]);
        }
    }
    let height = TEXT * extent(shape.joints_m);
    for (joint, at_m) in shape.system.joints().iter().zip(shape.joints_m) {
        let layer = layer(&joint.support);
        let _ = write!(text, "0\nPOINT\n8\n{layer}\n");
        place(&mut text, 0, *at_m);
        let name = escaped(&joint.name.text());
        let _ = write!(text, "0\nTEXT\n8\nnames\n");
        place(&mut text, 0, *at_m);
        let _ = write!(text, "40\n{height:?}\n1\n{name}\n");
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

/// A text as the value of a group of DXF: without control characters, since each value has one line, and with other
/// letters than those of ASCII as units of UTF-16, since R12 knows no UTF-8.
///
/// ```
/// assert_eq!(formats::export::dxf_text("Spitze \u{e4}\n"), "Spitze \\U+00E4");
/// ```
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut units = [0; 2];
    for c in text.chars().filter(|c| !c.is_control()) {
        // A backslash of the text itself begins no number.
        if c.is_ascii() && c != '\\' {
            out.push(c);
            continue;
        }
        for unit in c.encode_utf16(&mut units) {
            let _ = write!(out, "\\U+{unit:04X}");
        }
    }
    out
}

/// The layer of a joint: a support that slides along axes has these in its name.
fn layer(support: &Support) -> String {
    /// The axis of a direction, if it is one.
    fn axis(direction: &Vector) -> Option<usize> {
        (0..3).find(|k| (0..3).all(|j| (direction[j].abs() > 0.0) == (j == *k)))
    }
    let free = match support {
        Support::Free => return "joints".to_owned(),
        Support::Fixed { .. } => return "supports".to_owned(),
        Support::Line { direction, .. } => axis(direction).map(|k| ["x", "y", "z"][k]),
        Support::Plane { normal, .. } => axis(normal).map(|k| ["yz", "xz", "xy"][k]),
    };
    free.map_or_else(|| "supports_sliding".to_owned(), |free| format!("supports_free_{free}"))
}

/// The groups of a point: 10, 20, 30 of the first, 11, 21, 31 of the second.
fn place(text: &mut String, number: usize, at_m: Vector) {
    for (k, x) in at_m.into_iter().enumerate() {
        let _ = write!(text, "{}\n{x:?}\n", 10 * (k + 1) + number);
    }
}

/// The diagonal of the box around the joints, m.
pub(super) fn extent(joints_m: &[Vector]) -> f64 {
    let of = |pick: fn(f64, f64) -> f64, start: f64| -> Vector {
        std::array::from_fn(|k| joints_m.iter().map(|at| at[k]).fold(start, pick))
    };
    let extent = norm(minus(of(f64::max, f64::NEG_INFINITY), of(f64::min, f64::INFINITY)));
    if extent > 0.0 { extent } else { 1.0 }
}
