//! `judge`: the self-stresses of an answer whose loads vanish beside them.

use super::table;

/// 20 N on four bars of 5 m, 6.25 N in each, and a self-stress beside which they vanish.
#[test]
fn loads_hidden() {
    let [mut output] = table::outputs("loads_hidden");
    let basis = "nearest.equilibria[].evidence.self_stresses.basis[][]";
    // Bars that are opposite to each other pull alike.
    for basis in output.numbers(basis).chunks(4) {
        assert!(
            (basis[0] - basis[3]).abs() < 1e-15 && (basis[1] - basis[2]).abs() < 1e-15,
            "{basis:?}"
        );
        assert!(basis.iter().any(|x| x.abs() > 0.1), "{basis:?}");
    }
}
