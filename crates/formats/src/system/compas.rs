//! COMPAS JSON: networks, graphs and meshes with force densities.
//!
//! Nodes (or vertices) have `x`, `y`, `z`, a load `px`, `py`, `pz` in N, and are held where
//! `is_support`, `is_anchor` or `is_fixed` is true; edges have a force density `q` in N/m. Results
//! that such files carry (`rx`, `ry`, `rz`, `length`, `force`) are not read: they are what is
//! judged. Any other attribute is named and refused.
//!
//! # References
//!
//! COMPAS, <https://compas.dev>, data of `compas.datastructures.Graph` and `Mesh`.

use std::collections::{HashMap, HashSet};

use serde_json::{Map, Value};

use crate::error::{At, Result};
use crate::json::{self, Reader};
use crate::system::force_density::{Edge, ForceDensityNet, Node};

const PLACE: [&str; 3] = ["x", "y", "z"];
const LOAD: [&str; 3] = ["px", "py", "pz"];
const HELD: [&str; 3] = ["is_support", "is_anchor", "is_fixed"];
/// Results and bookkeeping, which the statics do not depend on.
const NODE_RESULTS: &[&str] = &["rx", "ry", "rz", "_rx", "_ry", "_rz", "neighbors"];
const EDGE_RESULTS: &[&str] = &["length", "force", "_l", "_f"];

/// Read a network, graph or mesh.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with the part that is wrong, missing or not understood.
pub fn parse_compas(text: &str, file: &str) -> Result<ForceDensityNet> {
    let root = json::parse(text, file)?;
    let reader = Reader { at: At::file(file) };
    let kind = root.get("dtype").or_else(|| root.get("datatype")).and_then(Value::as_str);
    let kind = kind.ok_or_else(|| reader.at.missing("text `dtype`"))?;
    let data = reader.object("data", root.get("data"))?;
    let mesh = kind.ends_with("Mesh");
    if !mesh && !kind.ends_with("Network") && !kind.ends_with("Graph") {
        return Err(reader.at.unknown(format!("the data of type {kind:?}")));
    }
    let (nodes_key, node_defaults) = if mesh {
        ("vertex", "default_vertex_attributes")
    } else {
        ("node", "default_node_attributes")
    };
    let defaults = data.get(node_defaults).and_then(Value::as_object);
    let mut numbers = HashMap::new();
    let mut nodes = Vec::new();
    for (key, value) in ordered(reader.object(nodes_key, data.get(nodes_key))?) {
        let attributes = reader.object(&format!("{nodes_key} {key}"), Some(value))?;
        numbers.insert(key.clone(), nodes.len());
        nodes.push(reader.node(key, attributes, defaults)?);
    }
    let defaults = data.get("default_edge_attributes").and_then(Value::as_object);
    let edges = if mesh {
        reader.mesh_edges(data, &numbers, defaults)?
    } else {
        reader.graph_edges(data, &numbers, defaults)?
    };
    if edges.is_empty() {
        return Err(reader.at.missing("edge"));
    }
    let name = data.get("attributes").and_then(|a| a.get("name")).and_then(Value::as_str);
    Ok(ForceDensityNet { name: name.unwrap_or("unnamed").to_owned(), nodes, edges })
}

/// Keys that are numbers in their order, the others after them.
fn ordered(object: &Map<String, Value>) -> Vec<(&String, &Value)> {
    let mut entries: Vec<_> = object.iter().collect();
    entries.sort_by_key(|(key, _)| (key.parse::<u64>().unwrap_or(u64::MAX), (*key).clone()));
    entries
}

/// Attributes of a node or edge, and what stands for those that it has not.
#[derive(Clone, Copy)]
struct Attributes<'a> {
    own: Option<&'a Map<String, Value>>,
    defaults: Option<&'a Map<String, Value>>,
}

impl<'a> Attributes<'a> {
    fn get(&self, key: &str) -> Option<&'a Value> {
        let own = self.own.and_then(|own| own.get(key));
        own.or_else(|| self.defaults.and_then(|defaults| defaults.get(key)))
    }
}

impl Reader<'_> {
    fn object<'v>(&self, what: &str, value: Option<&'v Value>) -> Result<&'v Map<String, Value>> {
        let value = value.ok_or_else(|| self.at.missing(format!("object `{what}`")))?;
        value.as_object().ok_or_else(|| self.wrong(what, "an object", value))
    }

    fn node(
        &self,
        key: &str,
        own: &Map<String, Value>,
        defaults: Option<&Map<String, Value>>,
    ) -> Result<Node> {
        let known = [&PLACE[..], &LOAD, &HELD, NODE_RESULTS];
        self.only(own, &known, &format!("node {key}"))?;
        let attributes = Attributes { own: Some(own), defaults };
        let vector = |keys: [&str; 3], needed: bool| -> Result<[f64; 3]> {
            let mut vector = [0.0; 3];
            for (x, name) in vector.iter_mut().zip(keys) {
                match attributes.get(name) {
                    Some(value) => *x = self.number(&format!("{name} of node {key}"), value)?,
                    None if needed => return Err(self.at.missing(format!("{name} of node {key}"))),
                    None => {}
                }
            }
            Ok(vector)
        };
        let mut held = false;
        for name in HELD {
            if let Some(value) = attributes.get(name) {
                let what = format!("{name} of node {key}");
                held |= value.as_bool().ok_or_else(|| self.wrong(&what, "true or false", value))?;
            }
        }
        let (at_m, force_n) = (vector(PLACE, true)?, vector(LOAD, false)?);
        Ok(Node { name: key.to_owned(), at_m, held, force_n })
    }

    /// Refuse attributes that are not known.
    fn only(&self, own: &Map<String, Value>, known: &[&[&str]], place: &str) -> Result<()> {
        let known = || known.iter().flat_map(|list| list.iter().copied());
        match own.keys().find(|key| !known().any(|name| name == key.as_str())) {
            None => Ok(()),
            Some(key) => {
                let error = self.at.unknown(format!("the attribute {key:?} of {place}"));
                Err(error
                    .with_help(format!("known are: {}", known().collect::<Vec<_>>().join(", "))))
            }
        }
    }

    fn end(&self, key: &str, numbers: &HashMap<String, usize>) -> Result<usize> {
        numbers.get(key).copied().ok_or_else(|| self.at.missing(format!("node {key:?}")))
    }

    fn edge(
        &self,
        [from, to]: [&str; 2],
        numbers: &HashMap<String, usize>,
        attributes: Attributes<'_>,
    ) -> Result<Edge> {
        let place = format!("the edge {from} - {to}");
        if let Some(own) = attributes.own {
            self.only(own, &[&["q"], &LOAD, EDGE_RESULTS], &place)?;
        }
        for key in LOAD {
            if let Some(load) = attributes.get(key)
                && self.number(key, load)?.abs() > 0.0
            {
                return Err(self.at.out_of_scope(format!("the load {key} on {place}")));
            }
        }
        let q = attributes.get("q").ok_or_else(|| self.at.missing(format!("q of {place}")))?;
        Ok(Edge {
            from: self.end(from, numbers)?,
            to: self.end(to, numbers)?,
            density_n_m: self.number(&format!("q of {place}"), q)?,
        })
    }

    /// `edge: { u: { v: attributes } }`.
    fn graph_edges(
        &self,
        data: &Map<String, Value>,
        numbers: &HashMap<String, usize>,
        defaults: Option<&Map<String, Value>>,
    ) -> Result<Vec<Edge>> {
        let mut edges = Vec::new();
        for (from, row) in ordered(self.object("edge", data.get("edge"))?) {
            for (to, own) in ordered(self.object(&format!("edge {from}"), Some(row))?) {
                let own = Some(self.object(&format!("edge {from} - {to}"), Some(own))?);
                edges.push(self.edge([from, to], numbers, Attributes { own, defaults })?);
            }
        }
        Ok(edges)
    }

    /// Edges of faces, each once, with the attributes of `edgedata`.
    fn mesh_edges(
        &self,
        data: &Map<String, Value>,
        numbers: &HashMap<String, usize>,
        defaults: Option<&Map<String, Value>>,
    ) -> Result<Vec<Edge>> {
        let mut own = HashMap::new();
        if let Some(edgedata) = data.get("edgedata") {
            for (key, value) in self.object("edgedata", Some(edgedata))? {
                let ends: Vec<_> = key
                    .split(|c: char| !c.is_ascii_alphanumeric())
                    .filter(|part| !part.is_empty())
                    .collect();
                let [from, to] = ends[..] else {
                    return Err(self.at.unknown(format!("the key {key:?} of edgedata")));
                };
                let ends = [self.end(from, numbers)?, self.end(to, numbers)?];
                own.insert(sorted(ends), self.object(&format!("edgedata {key}"), Some(value))?);
            }
        }
        let mut edges: Vec<Edge> = Vec::new();
        let mut seen = HashSet::new();
        for (key, face) in ordered(self.object("face", data.get("face"))?) {
            let wanted = "a list of vertices";
            let list = face.as_array().filter(|list| list.len() > 2);
            let list = list.ok_or_else(|| self.wrong(&format!("face {key}"), wanted, face))?;
            let names: Vec<_> =
                list.iter().map(|v| v.to_string().trim_matches('"').to_owned()).collect();
            for (k, name) in names.iter().enumerate() {
                let ends = [name.as_str(), names[(k + 1) % names.len()].as_str()];
                let pair = sorted([self.end(ends[0], numbers)?, self.end(ends[1], numbers)?]);
                if seen.insert(pair) {
                    let own = own.get(&pair).copied();
                    edges.push(self.edge(ends, numbers, Attributes { own, defaults })?);
                }
            }
        }
        Ok(edges)
    }
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}
