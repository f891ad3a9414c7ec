//! The order in which the joints are eliminated: approximate minimum degree.
//!
//! It leaves no fill in a chain or a tree. In square nets it leaves less than nested dissection at
//! the places of the joints does (measured on nets of 32 to 200 joints a side, leaves of 100 joints
//! ordered by minimum degree among themselves: 2.2 against 3.4 million entries at 100, 11.8 against
//! 16.6 at 200).

use matrices::sparse::minimum_degree;

use super::framework::Framework;
use super::stiffness::couples;

/// The joints in the order of the elimination; nothing without memory for it.
pub(super) fn by_degree(framework: &Framework) -> Option<Vec<usize>> {
    let mut neighbours = vec![Vec::new(); framework.nodes.len()];
    for (a, b) in couples(framework) {
        if framework.nodes[a].freedom() > 0 && framework.nodes[b].freedom() > 0 {
            neighbours[a.max(b)].push(a.min(b));
        }
    }
    let (mut columns, mut rows) = (vec![0], Vec::new());
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
        rows.extend_from_slice(list);
        columns.push(rows.len());
    }
    minimum_degree(&columns, &rows)
}
