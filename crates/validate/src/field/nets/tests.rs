//! A net of one free node, by hand.

use formats::system::{Edge, ForceDensityNet, Node};

use super::*;

/// 2 N/m along (3, 4, 0) and 3 N/m towards it along (0, 1, -2), with (1, -2, 6) N: (6, 8, 0) less
/// (0, 3, -6) and the load are (7, 3, 12) N. What the held nodes bear does not count.
#[test]
fn what_the_densities_leave_is_that_of_the_free_nodes() {
    let node = |at_m: [f64; 3], held: bool, force_n: [f64; 3]| Node {
        name: format!("{at_m:?}"),
        at_m,
        held,
        force_n,
    };
    let nodes = vec![
        node([1.0, 1.0, 1.0], false, [1.0, -2.0, 6.0]),
        node([4.0, 5.0, 1.0], true, [50.0, 0.0, 0.0]),
        node([1.0, 2.0, -1.0], true, [0.0; 3]),
    ];
    let edges =
        vec![Edge { from: 0, to: 1, density_n_m: 2.0 }, Edge { from: 2, to: 0, density_n_m: -3.0 }];
    let net = ForceDensityNet { name: "one".to_owned(), nodes, edges };
    let left = largest_left_n(&net);
    assert!((left - (49.0 + 9.0 + 144.0_f64).sqrt()).abs() < 1e-14, "{left}");
}
