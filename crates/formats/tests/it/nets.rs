//! Nets of force densities as CSV.

use formats::FormatError;
use formats::system::{ForceDensityNet, parse_net};

const NODES: &str =
    "id,x,y,z,is_free,u,v,w\n1,-3,0,0,0,0,0,0\n2,3,0,0,0,0,0,0\n3,0,0,-3,7,0,0,-1\n";
const EDGES: &str = "a,b,q0,qopt,f\n1,3,1,2,10\n3,2,1,2,10\n";

fn parse(nodes: &str, edges: &str) -> Result<ForceDensityNet, FormatError> {
    parse_net((nodes, "nodes"), (edges, "edges"), "net")
}

#[test]
fn displacements_are_added_and_forces_checked() {
    let net = parse(NODES, EDGES).unwrap();
    assert_eq!(net.places_m(), [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]]);
    assert_eq!([0, 1, 2].map(|k| net.nodes[k].held), [true, true, false]);
    let system = net.system_at(&net.places_m(), "net").unwrap();
    assert!(system.members().iter().all(|m| (m.body.length_m() - 2.5).abs() < 1e-15));
    // Our own names, and a density of the start alone.
    let own = parse(
        "joint,x_m,y_m,z_m,free\n1,-3,0,0,0\n2,3,0,0,0\n3,0,0,-4,1\n",
        "from,to,q_n_m\n1,3,2\n3,2,2\n",
    );
    assert_eq!(own.unwrap().edges, net.edges);
    assert_eq!(parse(NODES, "u,v,q\n1,3,2\n3,2,2\n").unwrap().edges, net.edges);
}

/// Of 6 N at 5 m of distance: a member that pushes is twice as long unstretched, and so stiff that
/// it pushes with q d.
#[test]
fn members_that_push_and_those_without_force() {
    let net = parse(NODES, "from,to,q_n_m\n1,3,-2\n3,2,0\n").unwrap();
    let system = net.system_at(&net.places_m(), "net").unwrap();
    let [push, slack] = [&system.members()[0], &system.members()[1]];
    let force = push.stiffness_n.unwrap() * (5.0 / push.body.length_m() - 1.0);
    assert!((force + 10.0).abs() < 1e-12, "{force}");
    assert!(slack.stiffness_n.is_none() && slack.body.length_m() > 5.0);
}

#[test]
fn bad_nets_are_told() {
    for (nodes, edges, says) in [
        ("", EDGES, "nodes: the file is empty"),
        (NODES, "", "edges: the file is empty"),
        ("id,x,y,6,is_free\n1,0,0,0,0\n", EDGES, "nodes:1: the column \"6\" is not understood"),
        ("id,x,y,z\n1,0,0,0\n", EDGES, "nodes:1: there is no column `free`"),
        (NODES, "a,b,qopt\n1,9,1\n", "edges:2: there is no node \"9\""),
        (NODES, "a,b\n1,2\n", "edges:1: there is no column `q_n_m`"),
        (NODES, "a,b,qopt\n", "edges: there is no edge"),
        (NODES, "a,b,qopt\n1,3,inf\n", "edges:2: q_n_m must be a finite number, found \"inf\""),
        (
            NODES,
            "a,b,q0,qopt,f\n1,3,1,2,11\n",
            "edges:2: the force 11 N is not the force density times the length, 10 N",
        ),
        ("id,x,y,z,is_free\n1,0,0,0,0\n1,0,0,0,0\n", EDGES, "nodes:3: node \"1\" is there twice"),
    ] {
        assert_eq!(parse(nodes, edges).unwrap_err().to_string(), says);
    }
    let twice = parse(NODES, "a,b,qopt\n1,3,1\n3,1,1\n").unwrap();
    let error = twice.system_at(&twice.places_m(), "net").unwrap_err();
    assert!(error.to_string().contains("two members connect joint"), "{error}");
    let meeting = parse("id,x,y,z,is_free\n1,0,0,0,0\n2,0,0,0,1\n", "a,b,qopt\n1,2,1\n").unwrap();
    assert!(meeting.system_at(&meeting.places_m(), "net").is_err());
}
