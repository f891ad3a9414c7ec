//! Answers as JSON: what our own commands print.

use model::Vector;
use serde_json::{Map, Value};

use crate::answer::{Answer, Forces, Joints};
use crate::error::{At, Result};
use crate::json::{self, Reader};

/// Parse JSON: every equilibrium of `solve --json` or `census --json`, or one object with the same
/// keys.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the reason.
pub fn parse_json(text: &str, file: &str) -> Result<Vec<Answer>> {
    let root = json::parse(text, file)?;
    let reader = Reader { at: At::file(file) };
    let Some(object) = root.as_object() else {
        return Err(reader.wrong("the text", "a JSON object", &root));
    };
    match object.get("equilibria") {
        None => Ok(vec![reader.answer(object, file)?]),
        Some(Value::Array(list)) if list.is_empty() => Err(reader.at.missing("equilibrium")),
        Some(Value::Array(list)) => list
            .iter()
            .enumerate()
            .map(|(k, value)| match value.as_object() {
                Some(object) => reader.answer(object, &format!("equilibrium {}", k + 1)),
                None => Err(reader.wrong(&format!("equilibria[{k}]"), "an object", value)),
            })
            .collect(),
        Some(other) => Err(reader.wrong("equilibria", "a list", other)),
    }
}

impl Reader<'_> {
    fn vector(&self, what: &str, value: &Value) -> Result<Vector> {
        let list = value.as_array().filter(|list| list.len() == 3);
        let list = list.ok_or_else(|| self.wrong(what, "a vector [x, y, z]", value))?;
        Ok([
            self.number(what, &list[0])?,
            self.number(what, &list[1])?,
            self.number(what, &list[2])?,
        ])
    }

    fn list<'v>(&self, what: &str, value: &'v Value) -> Result<&'v [Value]> {
        value.as_array().map(Vec::as_slice).ok_or_else(|| self.wrong(what, "a list", value))
    }

    fn answer(&self, object: &Map<String, Value>, name: &str) -> Result<Answer> {
        let source = object.get("solver").and_then(Value::as_str).unwrap_or(name).to_owned();
        let joints = match (object.get("joints"), object.get("joints_m")) {
            (Some(joints), _) => Joints::Named(self.named_joints(joints)?),
            (None, Some(places)) => {
                let list = self.list("joints_m", places)?.iter();
                Joints::InOrder(list.map(|v| self.vector("joints_m", v)).collect::<Result<_, _>>()?)
            }
            (None, None) => {
                let error = self.at.missing("list `joints` or `joints_m`");
                return Err(error.with_help("an answer printed with --summary has no joints"));
            }
        };
        let forces = match (object.get("bars"), object.get("axial_n")) {
            (Some(bars), _) => self.bar_forces(bars)?,
            (None, Some(axial)) => {
                let list = self.list("axial_n", axial)?.iter();
                Forces::InOrder(list.map(|v| self.number("axial_n", v)).collect::<Result<_, _>>()?)
            }
            (None, None) => Forces::None,
        };
        let reactions_n = match object.get("reactions_n") {
            None => None,
            Some(value) => Some(self.reactions(value, &joints)?),
        };
        Ok(Answer { source, joints, forces, reactions_n })
    }

    fn text(&self, what: &str, object: &Value, key: &str) -> Result<String> {
        let text = object.get(key).and_then(Value::as_str).map(str::to_owned);
        text.ok_or_else(|| self.at.missing(format!("text `{key}` in {what}")))
    }

    fn named_joints(&self, value: &Value) -> Result<Vec<(String, Vector)>> {
        let joints = self.list("joints", value)?.iter().enumerate();
        joints
            .map(|(k, joint)| {
                let what = format!("joints[{k}]");
                let at =
                    joint.get("at_m").ok_or_else(|| self.at.missing(format!("at_m in {what}")))?;
                Ok((self.text(&what, joint, "name")?, self.vector(&format!("{what}.at_m"), at)?))
            })
            .collect()
    }

    fn bar_forces(&self, value: &Value) -> Result<Forces> {
        let mut forces = Vec::new();
        for (k, bar) in self.list("bars", value)?.iter().enumerate() {
            let what = format!("bars[{k}]");
            let axial =
                bar.get("axial_n").ok_or_else(|| self.at.missing(format!("axial_n in {what}")))?;
            let axial = self.number(&format!("{what}.axial_n"), axial)?;
            forces.push((self.text(&what, bar, "from")?, self.text(&what, bar, "to")?, axial));
        }
        Ok(if forces.is_empty() { Forces::None } else { Forces::Named(forces) })
    }

    /// By name, or of a chain at its start and end.
    fn reactions(&self, value: &Value, joints: &Joints) -> Result<Vec<(String, Vector)>> {
        let Some(object) = value.as_object() else {
            return Err(self.wrong("reactions_n", "an object", value));
        };
        let last = match joints {
            Joints::InOrder(places) => Some(places.len().saturating_sub(1)),
            Joints::Named(_) => None,
        };
        let name = |key: &str| match (key, last) {
            ("start", Some(_)) => "0".to_owned(),
            ("end", Some(last)) => last.to_string(),
            _ => key.to_owned(),
        };
        let named = object.iter();
        named
            .map(|(key, v)| Ok((name(key), self.vector(&format!("reactions_n.{key}"), v)?)))
            .collect()
    }
}
