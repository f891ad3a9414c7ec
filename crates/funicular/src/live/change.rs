//! Changes of a system file that keep its comments and its order.

use model::Vector;
use serde::Deserialize;
use toml_edit::{
    Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value, value,
};

/// A change of a system file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Change {
    /// A joint is put somewhere or gets a mass; one that is not there yet is added. Of a chain the
    /// joints are numbers from 0: the first and the last are its anchors, others get a load.
    Joint {
        /// Its name.
        name: String,
        /// Where it is held, m; as it is if not given.
        #[serde(default)]
        at_m: Option<Vector>,
        /// Its mass, kg; as it is if not given.
        #[serde(default)]
        mass_kg: Option<f64>,
    },
    /// A member is added, without mass.
    Member {
        /// Name of the joint where it begins.
        from: String,
        /// Name of the joint where it ends.
        to: String,
        /// The joints that it runs over.
        #[serde(default)]
        via: Vec<String>,
        /// `bar`, `cable` or `strut`.
        kind: String,
        /// Its length, m; of a drawn system that of the drawing if not given.
        #[serde(default)]
        length_m: Option<f64>,
    },
}

impl Change {
    /// The file with the change.
    ///
    /// # Errors
    /// A sentence where the file is no TOML, or has no place for the change.
    pub(super) fn of(&self, text: &str) -> Result<String, String> {
        let mut file: DocumentMut =
            text.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
        match self {
            Self::Joint { name, at_m, mass_kg } => {
                if file.contains_key("anchors") {
                    chain(&mut file, name, *at_m, *mass_kg)?;
                } else {
                    joint(&mut file, name, *at_m, *mass_kg)?;
                }
            }
            Self::Member { from, to, via, kind, length_m } => {
                let mut keys: Vec<(&str, Value)> =
                    vec![("from", from.as_str().into()), ("to", to.as_str().into())];
                if !via.is_empty() {
                    keys.push(("via", Array::from_iter(via).into()));
                }
                keys.push(("kind", kind.as_str().into()));
                keys.extend(length_m.map(|length_m| ("length_m", length_m.into())));
                keys.push(("mass_kg", 0.0.into()));
                append(&mut file, "bars", keys)?;
            }
        }
        Ok(file.to_string())
    }
}

/// A joint by its name.
fn joint(
    file: &mut DocumentMut,
    name: &str,
    at_m: Option<Vector>,
    mass_kg: Option<f64>,
) -> Result<(), String> {
    let elsewhere = || format!("joint {name:?} does not stand in this text");
    let joints = file.get_mut("joints").and_then(Item::as_table_like_mut).ok_or_else(elsewhere)?;
    if !joints.contains_key(name) {
        joints.insert(name, value(InlineTable::new()));
    }
    let joint = joints.get_mut(name).and_then(Item::as_table_like_mut).ok_or_else(elsewhere)?;
    put(joint, "at_m", at_m.map(place));
    put(joint, "mass_kg", mass_kg.map(Value::from));
    Ok(())
}

/// A joint of a chain by its number.
fn chain(
    file: &mut DocumentMut,
    name: &str,
    at_m: Option<Vector>,
    mass_kg: Option<f64>,
) -> Result<(), String> {
    let number: i64 = name.parse().map_err(|_| format!("a chain has no joint {name:?}"))?;
    if let Some(at_m) = at_m {
        let anchors = file.get_mut("anchors").and_then(Item::as_table_like_mut);
        let anchors = anchors.ok_or("anchors is not a table")?;
        put(anchors, if number == 0 { "start_m" } else { "end_m" }, Some(place(at_m)));
    }
    match mass_kg {
        Some(mass_kg) => {
            append(file, "loads", vec![("joint", number.into()), ("mass_kg", mass_kg.into())])
        }
        None => Ok(()),
    }
}

fn place(at_m: Vector) -> Value {
    Array::from_iter(at_m).into()
}

/// Give a key another value, with what stands around the old one.
fn put(table: &mut dyn TableLike, key: &str, new: Option<Value>) {
    let Some(mut new) = new else { return };
    match table.get_mut(key).and_then(Item::as_value_mut) {
        Some(old) => {
            *new.decor_mut() = old.decor().clone();
            *old = new;
        }
        None => {
            table.insert(key, value(new));
        }
    }
}

/// Add a table to a list of them, however the list is written.
fn append(file: &mut DocumentMut, key: &str, keys: Vec<(&str, Value)>) -> Result<(), String> {
    let list = file.entry(key).or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new()));
    match list {
        Item::ArrayOfTables(list) => {
            list.push(keys.into_iter().map(|(key, new)| (key, value(new))).collect::<Table>());
        }
        Item::Value(Value::Array(list)) => list.push(keys.into_iter().collect::<InlineTable>()),
        _ => return Err(format!("{key} is not a list")),
    }
    Ok(())
}
