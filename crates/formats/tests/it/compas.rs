//! COMPAS JSON.

use formats::system::{Edge, Source, parse_compas};

use crate::refused;

const NETWORK: &str = r#"{"dtype": "jax_fdm.datastructures/FDNetwork", "data": {
    "attributes": {"name": "lamp"},
    "default_node_attributes": {"x": 0.0, "y": 0.0, "z": 0.0, "pz": 0.0, "is_support": false},
    "default_edge_attributes": {"q": 2.0, "length": 0.0},
    "node": {"10": {"x": 0, "z": -4, "pz": -16, "neighbors": [0, 1]}, "0": {"x": -3, "is_support": true},
             "1": {"x": 3, "is_support": true}},
    "edge": {"0": {"10": {}}, "1": {"10": {"q": 2.5}}, "10": {}}}}"#;

#[test]
fn a_network_has_nodes_loads_supports_and_force_densities() {
    let net = parse_compas(NETWORK, "x").unwrap();
    assert_eq!(net.name, "lamp");
    let names: Vec<_> = net.nodes.iter().map(|node| node.name.as_str()).collect();
    assert_eq!(names, ["0", "1", "10"]);
    assert_eq!((net.nodes[0].held, net.nodes[2].held), (true, false));
    assert_eq!((net.nodes[2].at_m, net.nodes[2].force_n), ([0.0, 0.0, -4.0], [0.0, 0.0, -16.0]));
    let edge = |from, density_n_m| Edge { from, to: 2, density_n_m };
    assert_eq!(net.edges, [edge(0, 2.0), edge(1, 2.5)]);
}

#[test]
fn loads_on_supports_are_told_with_their_sum() {
    assert_eq!(parse_compas(NETWORK, "x").unwrap().held_loads(), None);
    let text = NETWORK
        .replace(r#""x": -3,"#, r#""x": -3, "px": 1.5, "pz": -8,"#)
        .replace(r#""x": 3,"#, r#""x": 3, "px": -1.5, "pz": 8,"#);
    let says = "loads on held nodes (2), in sum (0, 0, 0) N, go to the ground and are not in the reactions";
    assert_eq!(parse_compas(&text, "x").unwrap().held_loads().as_deref(), Some(says));
    let read = Source::Compas.parse(&text, "x").unwrap();
    assert!(read.notes.iter().any(|note| note == says), "{:?}", read.notes);
}

#[test]
fn edges_that_push_are_said_to_be_soft() {
    let notes = |text: &str| Source::Compas.parse(text, "x").unwrap().notes.concat();
    assert!(!notes(NETWORK).contains("some edges push"));
    assert!(notes(&NETWORK.replace(r#""q": 2.5"#, r#""q": -2.5"#)).contains("some edges push"));
}

/// As the corners of a grid, which the net does not reach: no equilibrium problem would have them.
#[test]
fn supports_that_no_member_meets_are_left_out_and_named() {
    let text =
        NETWORK.replace(r#""1": {"x": 3,"#, r#""7": {"x": 9, "is_support": true}, "1": {"x": 3,"#);
    let read = Source::Compas.parse(&text, "x").unwrap();
    let names: Vec<_> = read.system.joints().iter().map(|joint| joint.name.to_string()).collect();
    assert_eq!(names, ["0", "1", "10"]);
    assert_eq!(read.notes.last().unwrap(), "supports that no member meets are left out: 7");
    assert!(read.above_floor("x").is_ok());
}

#[test]
fn a_mesh_has_the_edges_of_its_faces_once() {
    let mesh = r#"{"dtype": "compas.datastructures/Mesh", "data": {
        "vertex": {"0": {"x": 0, "y": 0, "z": 0, "is_anchor": true}, "1": {"x": 1, "y": 0, "z": 0},
                   "2": {"x": 1, "y": 1, "z": 0}, "3": {"x": 0, "y": 1, "z": 0}},
        "face": {"0": [0, 1, 2], "1": [0, 2, 3]}, "default_edge_attributes": {"q": 1},
        "edgedata": {"0-2": {"q": 3}}}}"#;
    let net = parse_compas(mesh, "x").unwrap();
    assert_eq!(net.edges.len(), 5);
    assert!(net.edges.contains(&Edge { from: 2, to: 0, density_n_m: 3.0 }));
}

#[test]
fn what_is_not_understood_is_named() {
    refused("compas", NETWORK, |text| parse_compas(text, "x"));
    assert!(parse_compas("", "x").unwrap_err().to_string().contains("this is not JSON"));
}
