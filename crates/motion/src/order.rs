use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

/// Joints that move, in the order of elimination, and whether they form trees.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Order {
    /// Numbers of joints: every joint of a tree stands before the one it hangs on.
    pub joints: Vec<usize>,
    /// Whether the joints that move form trees: every loop runs through an anchor.
    pub is_forest: bool,
}

/// Order the joints of `moves` over the `edges` between them.
///
/// Trees are ordered from their leaves to the root, which causes no fill at all; other graphs by
/// least degree.
pub(crate) fn order(moves: &[bool], edges: &[(usize, usize)]) -> Order {
    let mut neighbours = vec![Vec::new(); moves.len()];
    for &(a, b) in edges {
        neighbours[a].push(b);
        neighbours[b].push(a);
    }
    let mut joints = Vec::with_capacity(moves.len());
    let mut seen: Vec<bool> = moves.iter().map(|moves| !moves).collect();
    let mut parts = 0;
    // The root is the last joint: a chain is then eliminated in the order in which it is stored.
    for root in (0..moves.len()).rev() {
        if seen[root] {
            continue;
        }
        parts += 1;
        seen[root] = true;
        let mut open = vec![root];
        while let Some(joint) = open.pop() {
            joints.push(joint);
            for &other in &neighbours[joint] {
                if !seen[other] {
                    seen[other] = true;
                    open.push(other);
                }
            }
        }
    }
    joints.reverse();
    let is_forest = edges.len() + parts == joints.len();
    if !is_forest {
        joints = least_degree(&joints, &neighbours);
    }
    Order { joints, is_forest }
}

/// Always the joint with the fewest neighbours next; its neighbours become neighbours of each
/// other.
fn least_degree(joints: &[usize], neighbours: &[Vec<usize>]) -> Vec<usize> {
    let mut around: Vec<BTreeSet<usize>> =
        neighbours.iter().map(|list| list.iter().copied().collect()).collect();
    let mut heap: BinaryHeap<_> =
        joints.iter().map(|&joint| Reverse((around[joint].len(), joint))).collect();
    let mut done = vec![false; neighbours.len()];
    let mut ordered = Vec::with_capacity(joints.len());
    while let Some(Reverse((degree, joint))) = heap.pop() {
        if done[joint] || degree != around[joint].len() {
            continue;
        }
        done[joint] = true;
        ordered.push(joint);
        let clique: Vec<usize> = std::mem::take(&mut around[joint]).into_iter().collect();
        for &other in &clique {
            around[other].remove(&joint);
            around[other].extend(clique.iter().copied().filter(|&third| third != other));
            heap.push(Reverse((around[other].len(), other)));
        }
    }
    ordered
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chain_keeps_its_order_and_a_loop_is_seen() {
        let chain = order(&[false, true, true, true, false], &[(1, 2), (2, 3)]);
        assert_eq!(chain, Order { joints: vec![1, 2, 3], is_forest: true });
        let ring = order(&[true; 4], &[(0, 1), (1, 2), (2, 3), (3, 0)]);
        assert!(!ring.is_forest);
        assert_eq!(ring.joints.len(), 4);
    }

    #[test]
    fn every_joint_of_a_tree_stands_before_the_one_it_hangs_on() {
        // A star with arms of two.
        let edges = [(0, 1), (1, 2), (0, 3), (3, 4), (0, 5), (5, 6)];
        let star = order(&[true; 7], &edges);
        assert!(star.is_forest);
        let place = |joint| star.joints.iter().position(|&j| j == joint).unwrap();
        // The last joint is the root.
        for (child, parent) in [(4, 3), (3, 0), (2, 1), (1, 0), (0, 5), (5, 6)] {
            assert!(place(child) < place(parent), "{child} {parent}");
        }
    }
}
