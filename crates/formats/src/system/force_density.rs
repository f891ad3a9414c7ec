//! Nets of force densities.

use model::system::{Joint, Member, System};
use model::{Bar, STANDARD_GRAVITY_M_S2, Vector};

use crate::error::{At, Result};

/// A net: nodes, and edges that each pull with their force density times their length.
#[derive(Debug, Clone, PartialEq)]
pub struct ForceDensityNet {
    /// Its name.
    pub name: String,
    /// The nodes.
    pub nodes: Vec<Node>,
    /// The edges.
    pub edges: Vec<Edge>,
}

/// A node.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Where it is, m: of a free node the place that is to be judged.
    pub at_m: Vector,
    /// Whether it is held.
    pub held: bool,
    /// The load on it, N.
    pub force_n: Vector,
}

/// An edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Edge {
    /// The node where it begins, from 0.
    pub from: usize,
    /// The node where it ends.
    pub to: usize,
    /// Its force density, tension positive, N/m.
    pub density_n_m: f64,
}

/// Unstretched length of a member that pulls, in units of its distance at the places judged; of one
/// that pushes the inverse. Any ratio carries the same force there; this one makes the stiffness of
/// a member its force.
const RATIO: f64 = 0.5;

impl ForceDensityNet {
    /// The places of the nodes as the file has them, m.
    pub fn places_m(&self) -> Vec<Vector> {
        self.nodes.iter().map(|node| node.at_m).collect()
    }

    /// What there is to say of the loads on nodes that are held: one sentence, if there are any.
    pub fn held_loads(&self) -> Option<String> {
        super::held_loads(self.nodes.iter().filter(|node| node.held).map(|node| node.force_n))
    }

    /// The system of elastic members that carry `q d` at these places: a member that pulls has half
    /// of its distance `d` as its unstretched length, one that pushes twice, and one without force
    /// density is a slack cable.
    ///
    /// The places are an equilibrium of the net if and only if they are one of this system: there
    /// the members carry the same forces. The stress matrix is the same too, and so is a
    /// certificate made of it.
    ///
    /// # Errors
    /// [`FormatError`](crate::FormatError) when the places are not as many as the nodes, two joints of a member meet,
    /// or it is no system.
    ///
    /// ```
    /// use formats::system::{Edge, ForceDensityNet, Node};
    /// let node = |name: &str, at_m, held, z| {
    ///     Node { name: name.into(), at_m, held, force_n: [0.0, 0.0, z] }
    /// };
    /// let nodes = vec![
    ///     node("A", [-3.0, 0.0, 0.0], true, 0.0),
    ///     node("B", [3.0, 0.0, 0.0], true, 0.0),
    ///     node("P", [0.0, 0.0, -4.0], false, -16.0),
    /// ];
    /// let edge = |from| Edge { from, to: 2, density_n_m: 2.0 };
    /// let net = ForceDensityNet { name: "lamp".into(), nodes, edges: vec![edge(0), edge(1)] };
    /// let system = net.system_at(&net.places_m(), "lamp.csv")?;
    /// let member = &system.members()[0];
    /// // 2 N/m over 5 m: 10 N, at twice the unstretched length of 2.5 m.
    /// assert_eq!((member.body.length_m(), member.stiffness_n), (2.5, Some(10.0)));
    /// # Ok::<(), formats::FormatError>(())
    /// ```
    pub fn system_at(&self, places_m: &[Vector], file: &str) -> Result<System> {
        let at = At::file(file);
        if places_m.len() != self.nodes.len() {
            let (places, nodes) = (places_m.len(), self.nodes.len());
            return Err(at.no_system(format!("{places} places for {nodes} nodes")));
        }
        let joints = self.nodes.iter().map(|node| {
            if node.held {
                Joint::anchor(&node.name, node.at_m)
            } else {
                Joint::free(&node.name).with_force(node.force_n)
            }
        });
        let mut members = Vec::with_capacity(self.edges.len());
        for edge in &self.edges {
            let place =
                |k: usize| if self.nodes[k].held { self.nodes[k].at_m } else { places_m[k] };
            let (a, b) = (place(edge.from), place(edge.to));
            let distance_m = (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
            let body = |length_m: f64| {
                Bar::homogeneous(length_m, 0.0).map_err(|error| {
                    let [from, to] = [edge.from, edge.to].map(|k| &self.nodes[k].name);
                    at.no_system(format!("the edge between {from:?} and {to:?}: {error}"))
                })
            };
            let q = edge.density_n_m;
            members.push(if q > 0.0 {
                let stiffness_n = q * distance_m * RATIO / (1.0 - RATIO);
                Member::bar(edge.from, edge.to, body(RATIO * distance_m)?)
                    .with_stiffness(stiffness_n)
            } else if q < 0.0 {
                // N = k (d - d/RATIO) with k = EA RATIO/d.
                let stiffness_n = -q * distance_m / (1.0 - RATIO);
                Member::bar(edge.from, edge.to, body(distance_m / RATIO)?)
                    .with_stiffness(stiffness_n)
            } else {
                Member::cable(edge.from, edge.to, body(distance_m / RATIO)?)
            });
        }
        System::new(&self.name, STANDARD_GRAVITY_M_S2, joints.collect(), members)
            .map_err(|error| at.no_system(error))
    }
}
