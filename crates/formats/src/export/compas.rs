//! A COMPAS graph with force densities: what [`parse_compas`](crate::system::parse_compas) reads.

use std::collections::BTreeMap;

use model::system::Support;
use numerics::vector::{minus, norm};
use serde_json::{Map, Value, json};

use super::{ExportError, Shape, joint_loads};

/// A member that carries `N` at the distance `d` of its ends is an edge with the density `q = N/d`; weights and loads of members
/// are at the joints by the lever rule, which is what `axial_n` belongs to.
pub(super) fn write(shape: &Shape<'_>) -> Result<String, ExportError> {
    let refuse = |what| Err(ExportError::NoCounterpart { format: "a COMPAS graph", what });
    let (forces, masses) = joint_loads(shape.system);
    let mut nodes = Map::new();
    for (k, (joint, at_m)) in shape.system.joints().iter().zip(shape.joints_m).enumerate() {
        let [x, y, z] = at_m;
        let [px, py, mut pz] = forces[k];
        pz -= masses[k] * shape.system.gravity_m_s2();
        let pushed = shape.reactions_n.get(k).is_some_and(|push| norm(*push) > 0.0);
        let held = match joint.support {
            Support::Free if pushed => {
                return refuse(format!("floor that pushes (joint {:?})", joint.name));
            }
            Support::Free => false,
            Support::Fixed { .. } => true,
            Support::Line { .. } | Support::Plane { .. } => {
                return refuse(format!("support that slides (joint {:?})", joint.name));
            }
        };
        let node =
            json!({ "x": x, "y": y, "z": z, "px": px, "py": py, "pz": pz, "is_support": held });
        nodes.insert(k.to_string(), node);
    }
    let mut edges: BTreeMap<usize, Map<String, Value>> = BTreeMap::new();
    let mut taken = std::collections::HashSet::new();
    for line in shape.lines() {
        let [a, b] = line.ends;
        if !taken.insert([a.min(b), a.max(b)]) {
            let [a, b] = line.ends.map(|k| shape.system.joints()[k].name.text());
            return refuse(format!("two edges between the same nodes ({a:?} and {b:?})"));
        }
        let distance_m = norm(minus(shape.joints_m[b], shape.joints_m[a]));
        if distance_m <= 0.0 {
            return refuse(format!("edge without length (member {})", line.number + 1));
        }
        let edge = json!({ "q": line.axial_n / distance_m });
        edges.entry(a).or_default().insert(b.to_string(), edge);
    }
    let edges: Map<String, Value> =
        edges.into_iter().map(|(from, row)| (from.to_string(), row.into())).collect();
    let graph = json!({
        "dtype": "compas.datastructures/Graph",
        "data": {
            "attributes": { "name": shape.system.name() },
            "default_node_attributes": {},
            "default_edge_attributes": {},
            "node": nodes,
            "edge": edges,
        },
    });
    Ok(format!("{graph:#}\n"))
}
