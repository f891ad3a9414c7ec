//! Orders in which the joints are eliminated.
//!
//! Approximate minimum degree leaves no fill in a chain or a tree. In large nets nested dissection
//! leaves less: a net is cut in two along the shorter way across, the joints on the cut come last,
//! and so on in the halves. The places of the joints say where to cut: any rough shape does.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;
use nalgebra::Vector3;

use super::framework::Framework;

/// Parts of so many joints are ordered by minimum degree.
const LEAF: usize = 100;

/// The joints that can move and their neighbours, both ways.
struct Graph {
    starts: Vec<usize>,
    neighbours: Vec<usize>,
}

impl Graph {
    fn new(framework: &Framework) -> Self {
        let joints = framework.nodes.len();
        let free = |joint: usize| framework.nodes[joint].freedom > 0;
        let both = || framework.links.iter().filter(|link| free(link.from) && free(link.to));
        let mut starts = vec![0; joints + 1];
        for link in both() {
            starts[link.from + 1] += 1;
            starts[link.to + 1] += 1;
        }
        for joint in 0..joints {
            starts[joint + 1] += starts[joint];
        }
        let mut next = starts.clone();
        let mut neighbours = vec![0; starts[joints]];
        for link in both() {
            for (joint, other) in [(link.from, link.to), (link.to, link.from)] {
                neighbours[next[joint]] = other;
                next[joint] += 1;
            }
        }
        Self { starts, neighbours }
    }

    fn of(&self, joint: usize) -> &[usize] {
        &self.neighbours[self.starts[joint]..self.starts[joint + 1]]
    }
}

/// Rank of each joint in the elimination, by approximate minimum degree; nothing without memory for
/// it.
pub(super) fn by_degree(framework: &Framework) -> Option<Vec<usize>> {
    let joints: Vec<usize> = (0..framework.nodes.len()).collect();
    let order = minimum_degree(&Graph::new(framework), &joints, &joints)?;
    Some(ranks(&order))
}

/// The same by nested dissection at the places of the joints.
pub(super) fn by_dissection(framework: &Framework, places: &[Vector3<f64>]) -> Option<Vec<usize>> {
    let mut dissection = Dissection {
        graph: Graph::new(framework),
        places,
        sides: vec![0; places.len()],
        calls: 0,
        order: Vec::with_capacity(places.len()),
        numbers: vec![0; places.len()],
    };
    let mut joints: Vec<usize> = (0..places.len()).collect();
    dissection.order(&mut joints)?;
    Some(ranks(&dissection.order))
}

fn ranks(order: &[usize]) -> Vec<usize> {
    let mut ranks = vec![0; order.len()];
    for (rank, &joint) in order.iter().enumerate() {
        ranks[joint] = rank;
    }
    ranks
}

/// The order of some joints by minimum degree among themselves; `numbers` gives each of them its
/// place in `joints`, and any other joint one that is not its own.
fn minimum_degree(graph: &Graph, joints: &[usize], numbers: &[usize]) -> Option<Vec<usize>> {
    let (mut columns, mut rows) = (vec![0], Vec::new());
    for (number, &joint) in joints.iter().enumerate() {
        let inside = graph.of(joint).iter().map(|&other| (numbers[other], other));
        let inside = inside.filter(|&(k, other)| joints.get(k) == Some(&other));
        let begin = rows.len();
        rows.extend(inside.map(|(k, _)| k).filter(|&k| k < number));
        rows[begin..].sort_unstable();
        let mut last = usize::MAX;
        let mut end = begin;
        for k in begin..rows.len() {
            if rows[k] != last {
                last = rows[k];
                rows[end] = last;
                end += 1;
            }
        }
        rows.truncate(end);
        columns.push(rows.len());
    }
    let size = joints.len();
    let pattern = SymbolicSparseColMatRef::new_checked(size, size, &columns, None, &rows);
    let (mut order, mut rank) = (vec![0; size], vec![0; size]);
    let scratch = amd::order_maybe_unsorted_scratch::<usize>(size, rows.len());
    let mut memory = MemBuffer::try_new(scratch).ok()?;
    let stack = MemStack::new(&mut memory);
    let control = amd::Control::default();
    amd::order_maybe_unsorted(&mut order, &mut rank, pattern, control, stack).ok()?;
    Some(order.iter().map(|&k| joints[k]).collect())
}

struct Dissection<'a> {
    graph: Graph,
    places: &'a [Vector3<f64>],
    /// In which half of which cut a joint was seen last.
    sides: Vec<usize>,
    /// Cuts so far, twice.
    calls: usize,
    order: Vec<usize>,
    numbers: Vec<usize>,
}

impl Dissection<'_> {
    /// Append the order of some joints.
    fn order(&mut self, joints: &mut [usize]) -> Option<()> {
        if joints.len() <= LEAF {
            for (number, &joint) in joints.iter().enumerate() {
                self.numbers[joint] = number;
            }
            self.order.extend(minimum_degree(&self.graph, joints, &self.numbers)?);
            return Some(());
        }
        let axis = self.longest(joints);
        let middle = joints.len() / 2;
        let places = self.places;
        joints.select_nth_unstable_by(middle, |&a, &b| {
            places[a][axis].total_cmp(&places[b][axis]).then(a.cmp(&b))
        });
        let (lower, upper) = joints.split_at_mut(middle);
        self.calls += 2;
        let (low, high) = (self.calls, self.calls + 1);
        for (half, side) in [(&*lower, low), (&*upper, high)] {
            for &joint in half {
                self.sides[joint] = side;
            }
        }
        // The joints of one half with neighbours in the other come last.
        let (inner_low, inner_high) = (self.inner(lower, high), self.inner(upper, low));
        let cut_low = lower.len() - inner_low <= upper.len() - inner_high;
        let (low_end, high_end) =
            if cut_low { (inner_low, upper.len()) } else { (lower.len(), inner_high) };
        let cut: Vec<usize> =
            if cut_low { lower[inner_low..].to_vec() } else { upper[inner_high..].to_vec() };
        self.order(&mut lower[..low_end])?;
        self.order(&mut upper[..high_end])?;
        self.order.extend(cut);
        Some(())
    }

    /// Axis along which some joints extend furthest.
    fn longest(&self, joints: &[usize]) -> usize {
        let first = self.places[joints[0]];
        let (least, most) = joints.iter().fold((first, first), |(least, most), &joint| {
            (least.inf(&self.places[joint]), most.sup(&self.places[joint]))
        });
        (most - least).imax()
    }

    /// Bring the joints without neighbours on a side to the front; their number.
    fn inner(&self, joints: &mut [usize], side: usize) -> usize {
        let mut count = 0;
        for k in 0..joints.len() {
            if self.graph.of(joints[k]).iter().all(|&other| self.sides[other] != side) {
                joints.swap(k, count);
                count += 1;
            }
        }
        count
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::Bar;
    use model::system::{Joint, Member, System};

    fn net(n: usize) -> (Framework, Vec<Vector3<f64>>) {
        let bar = Bar::homogeneous(1.0, 1.0).unwrap();
        let (mut joints, mut members, mut places) = (Vec::new(), Vec::new(), Vec::new());
        for k in 0..n * n {
            let (i, j) = (k / n, k % n);
            places.push(Vector3::new(i as f64, j as f64, 0.0));
            joints.push(match k {
                0 => Joint::anchor("0", [0.0; 3]),
                _ => Joint::free(format!("{k}")),
            });
            if i > 0 {
                members.push(Member::bar(k - n, k, bar));
            }
            if j > 0 {
                members.push(Member::bar(k - 1, k, bar));
            }
        }
        (Framework::new(&System::new("net", 1.0, joints, members).unwrap()), places)
    }

    #[test]
    fn each_joint_has_one_rank() {
        let (framework, places) = net(20);
        for ranks in [by_degree(&framework), by_dissection(&framework, &places)] {
            let mut ranks = ranks.unwrap();
            ranks.sort_unstable();
            assert!(ranks.iter().enumerate().all(|(k, rank)| k == *rank));
        }
    }
}
