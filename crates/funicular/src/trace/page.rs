//! Load paths as one HTML file: the shape at every point, and the load over what is shown.

use std::fmt::Write as _;

use serde_json::Value;

use super::load::{LoadPath, LoadPaths};
use crate::moving_page::{self, comma, list, places, structure};
use crate::text::load::happens;

const PAGE: &str = include_str!("../load_path.html");

/// The HTML of the page.
pub(super) fn page(found: &LoadPaths) -> String {
    moving_page::filled(PAGE, &found.system, &data(found))
}

/// A text as JSON, in which nothing looks like the end of a script.
fn quoted(text: &str) -> String {
    Value::from(text.replace(model::steers, " ")).to_string().replace('<', "\\u003c")
}

fn data(found: &LoadPaths) -> String {
    let named = |name: &str, unit: &str| match unit {
        "1" => quoted(name),
        _ => quoted(&format!("{name} / {unit}")),
    };
    let last = found.parameters.len().saturating_sub(1);
    let load = named(&found.parameters[last], found.units[last]);
    let of = found.of.first().map_or_else(|| quoted("point"), |(name, unit)| named(name, unit));
    let mut out = format!("{{\"load\":{load},\"of\":{of},");
    structure(&mut out, &found.system);
    out.push_str("\"paths\":[");
    for (k, path) in found.paths.iter().enumerate() {
        out.push_str(comma(k));
        one(&mut out, found, path, last);
    }
    out.push_str("]}");
    out
}

fn one(out: &mut String, found: &LoadPaths, path: &LoadPath, last: usize) {
    let from = path
        .branches_from
        .map_or_else(String::new, |from| format!(", from path {}", from.path + 1));
    let _ = write!(out, "{{\"from\":{},\"load\":", quoted(&from));
    list(out, path.points.iter().map(|point| point.values[last]));
    out.push_str(",\"of\":[");
    for (k, point) in path.points.iter().enumerate() {
        let shown = match point.of.first() {
            Some(shown) => *shown,
            None => Some(k as f64),
        };
        let _ = write!(out, "{}{}", comma(k), shown.map_or(Value::Null, Value::from));
    }
    out.push_str("],\"stable\":[");
    for (k, point) in path.points.iter().enumerate() {
        let _ = write!(out, "{}{}", comma(k), u8::from(point.index == 0));
    }
    out.push_str("],\"events\":{");
    for (k, event) in path.events.iter().enumerate() {
        let _ = write!(out, "{}\"{}\":{}", comma(k), event.point, quoted(&happens(event)));
    }
    out.push_str("},\"x\":[");
    for (k, point) in path.points.iter().enumerate() {
        out.push_str(comma(k));
        places(out, &found.system, point.joints_m.iter().copied());
    }
    out.push_str("],\"axial\":[");
    for (k, point) in path.points.iter().enumerate() {
        out.push_str(comma(k));
        list(out, point.axial_n.iter().copied());
    }
    out.push_str("]}");
}
