//! Nets of force densities as two CSV files: nodes and edges.

use std::collections::HashMap;

use numerics::vector::{minus, norm};

use crate::error::{At, Result};
use crate::sheet::{Row, Sheet};
use crate::system::force_density::{Edge, ForceDensityNet, Node};

const NODES: &[&str] = names! {
    joint x_m y_m z_m free u_m v_m w_m force_x_n force_y_n force_z_n
};
/// Names that stand for them in files of jax_fdm.
const NODE_ALIASES: &[(&str, &str)] = names! {
    id: joint Knoten: joint node: joint x: x_m y: y_m z: z_m is_free: free u: u_m v: v_m w: w_m
    px: force_x_n py: force_y_n pz: force_z_n
};
const EDGES: &[&str] = &["from", "to", "q_n_m", "q_start_n_m", "force_n"];
const EDGE_ALIASES: &[(&str, &str)] = names! {
    a: from b: to u: from v: to qopt: q_n_m q0: q_start_n_m q: q_start_n_m f: force_n
    forceopt: force_n
};
/// How far the force of an edge may be from its density times its length, as a part of it: the
/// digits of such files.
const DIGITS: f64 = 1e-6;

/// Read a net of two files.
///
/// Nodes: `joint,x_m,y_m,z_m,free` (0 is held), and if there are displacements `u_m,v_m,w_m` and
/// loads `force_x_n,force_y_n,force_z_n`. Edges: `from,to,q_n_m`, and if there are `q_start_n_m`
/// (the density of the start, which is not judged; alone it is the density) and `force_n`, which
/// must be the density times the length. The names of the files of jax_fdm stand for these.
///
/// # Errors
/// [`FormatError`](crate::FormatError) with file, line and reason.
pub fn parse_net(nodes: (&str, &str), edges: (&str, &str), name: &str) -> Result<ForceDensityNet> {
    let (text, file) = nodes;
    let sheet = Sheet::parse(file, text, NODES, NODE_ALIASES)?;
    for column in &NODES[..5] {
        sheet.need(column)?;
    }
    let mut numbers = HashMap::new();
    let mut found = Vec::new();
    for row in sheet.rows() {
        let node = node(&row)?;
        if numbers.insert(node.name.clone(), found.len()).is_some() {
            return Err(row.at().repeated(format!("node {:?}", node.name)));
        }
        found.push(node);
    }
    let (text, file) = edges;
    // `q` is the density where there is no other.
    let optimised =
        text.lines().next().is_some_and(|head| head.split(',').any(|c| c.trim() == "qopt"));
    let aliases: Vec<_> = EDGE_ALIASES
        .iter()
        .map(|alias| if alias.0 == "q" && !optimised { ("q", "q_n_m") } else { *alias })
        .collect();
    let sheet = Sheet::parse(file, text, EDGES, &aliases)?;
    for column in &EDGES[..3] {
        sheet.need(column)?;
    }
    let edges = sheet.rows().map(|row| edge(&row, &numbers, &found, sheet.has("force_n")));
    let edges = edges.collect::<Result<Vec<_>, _>>()?;
    if edges.is_empty() {
        return Err(At::file(file).missing("edge"));
    }
    Ok(ForceDensityNet { name: name.to_owned(), nodes: found, edges })
}

fn node(row: &Row<'_>) -> Result<Node> {
    let name = row.text("joint").to_owned();
    if name.is_empty() {
        return Err(row.at().missing("name of the joint"));
    }
    let mut at_m = [row.number("x_m")?, row.number("y_m")?, row.number("z_m")?];
    for (place, moved) in at_m.iter_mut().zip(["u_m", "v_m", "w_m"]) {
        *place += row.number_or_zero(moved)?;
    }
    let force_n = [
        row.number_or_zero("force_x_n")?,
        row.number_or_zero("force_y_n")?,
        row.number_or_zero("force_z_n")?,
    ];
    // Files number their free nodes here; what counts is whether it is zero.
    let held = row.number("free")?.abs() <= 0.0;
    Ok(Node { name, at_m, held, force_n })
}

fn edge(
    row: &Row<'_>,
    numbers: &HashMap<String, usize>,
    nodes: &[Node],
    with_force: bool,
) -> Result<Edge> {
    let end = |column: &str| {
        let name = row.text(column);
        let number = numbers.get(name).copied();
        number.ok_or_else(|| row.at().missing(format!("node {name:?}")))
    };
    let (from, to, density_n_m) = (end("from")?, end("to")?, row.number("q_n_m")?);
    if with_force {
        let [a, b] = [nodes[from].at_m, nodes[to].at_m];
        let length_m = norm(minus(b, a));
        let (given, follows) = (row.number("force_n")?, density_n_m * length_m);
        if (given - follows).abs() > DIGITS * given.abs().max(follows.abs()) {
            return Err(row.at().no_system(format!(
                "the force {given} N is not the force density times the length, {follows} N"
            )));
        }
    }
    Ok(Edge { from, to, density_n_m })
}
