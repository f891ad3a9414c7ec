//! Runs of members between branchings, and trees that dangle.
//!
//! A joint where two members meet and that nothing holds lies inside a run: its balance gives the
//! force of the one member from that of the other, $F_{k+1} = F_k - f_k$, so the forces of a whole
//! run follow from the pull $p$ of its first member. A member whose far end meets no other bears
//! the load there, and so does, member by member, a tree that dangles. What is left is a framework
//! of the joints where runs meet, with one element for each run.

use std::ops::Range;

use nalgebra::Vector3;

use super::densities::pulls;
use super::framework::{Framework, Node};
use crate::thresholds::ZERO;

/// No joint, no member; in the place of the number of members at a joint, that of a tree that was taken away.
const NONE: usize = usize::MAX;

/// A run of members from one joint that stays to another.
#[derive(Debug, Clone)]
pub(super) struct Element {
    /// Where it begins, a number in [`Runs::kept`].
    pub from: usize,
    /// Where it ends.
    pub to: usize,
    /// Its members, as a range of [`Runs::steps`].
    pub steps: Range<usize>,
}

/// A member of a run.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    /// Its number.
    pub member: usize,
    /// The joint at its end that comes later in the run.
    pub joint: usize,
    pub length: f64,
    pub compliance: f64,
    /// Its force is the pull of the run plus this.
    pub offset: Vector3<f64>,
}

/// A member of a dangling tree.
#[derive(Debug, Clone, Copy)]
pub(super) struct Twig {
    /// Its number.
    pub member: usize,
    /// Its joint on the side of the supports.
    pub root: usize,
    /// The other one.
    pub tip: usize,
    /// Load that it bears: it pulls its root with this force.
    pub force: Vector3<f64>,
}

/// A framework by its runs and dangling trees.
#[derive(Debug)]
pub(super) struct Runs {
    /// Joints that stay, by their numbers in the framework.
    pub kept: Vec<usize>,
    /// The same as nodes; the loads inside a run act at its end, those of a tree at its root.
    pub nodes: Vec<Node>,
    pub elements: Vec<Element>,
    pub steps: Vec<Step>,
    /// Members of trees, each before those nearer to the supports.
    pub twigs: Vec<Twig>,
}

impl Runs {
    /// Of the members that can pull and move; nothing when a free joint has none of them.
    pub fn new(framework: &Framework) -> Option<Self> {
        let mut graph = Graph::new(framework);
        let twigs = graph.trim(framework);
        let mut runs = Self {
            kept: Vec::new(),
            nodes: Vec::new(),
            elements: Vec::new(),
            steps: Vec::with_capacity(framework.links.len() - twigs.len()),
            twigs,
        };
        let mut numbers = vec![NONE; framework.nodes.len()];
        for twig in &runs.twigs {
            graph.degrees[twig.tip] = NONE;
        }
        for (joint, node) in framework.nodes.iter().enumerate() {
            let degree = graph.degrees[joint];
            if degree == NONE || (node.freedom() == 3 && degree == 2) {
                continue;
            }
            if node.freedom() == 3 && degree == 0 {
                return None;
            }
            runs.keep(framework, &graph, &mut numbers, joint);
        }
        for member in 0..framework.links.len() {
            let link = &framework.links[member];
            for joint in [link.from, link.to] {
                if graph.alive[member] && numbers[joint] != NONE {
                    runs.walk(framework, &mut graph, &mut numbers, joint, member);
                }
            }
        }
        // What is left are closed runs that nothing holds.
        let all = graph.alive.iter().all(|alive| !alive);
        all.then_some(runs)
    }

    fn keep(&mut self, framework: &Framework, graph: &Graph, numbers: &mut [usize], joint: usize) {
        numbers[joint] = self.kept.len();
        self.kept.push(joint);
        let load = graph.load(framework, joint);
        self.nodes.push(Node { load, ..framework.nodes[joint].clone() });
    }

    /// Take the run that begins at a joint with a member.
    fn walk(
        &mut self,
        framework: &Framework,
        graph: &mut Graph,
        numbers: &mut [usize],
        start: usize,
        first: usize,
    ) {
        let begin = self.steps.len();
        let (mut joint, mut member, mut offset) = (start, first, Vector3::zeros());
        loop {
            let link = &framework.links[member];
            joint ^= link.from ^ link.to;
            graph.alive[member] = false;
            self.steps.push(Step {
                member,
                joint,
                length: link.length,
                compliance: link.compliance,
                offset,
            });
            if numbers[joint] != NONE {
                break;
            }
            offset -= graph.load(framework, joint);
            member ^= graph.members[joint];
        }
        let ends = begin..self.steps.len();
        if joint == start && ends.len() > 1 {
            // A loop: an element needs two different ends.
            let middle = begin + ends.len() / 2;
            self.keep(framework, graph, numbers, self.steps[middle - 1].joint);
            let number = numbers[self.steps[middle - 1].joint];
            let before = self.steps[middle].offset;
            for step in &mut self.steps[middle..] {
                step.offset -= before;
            }
            self.close(numbers[start], number, begin..middle);
            self.close(number, numbers[joint], middle..ends.end);
        } else {
            self.close(numbers[start], numbers[joint], ends);
        }
    }

    /// Add an element; the loads inside act at its end.
    fn close(&mut self, from: usize, to: usize, steps: Range<usize>) {
        self.nodes[to].load -= self.steps[steps.end - 1].offset;
        self.elements.push(Element { from, to, steps });
    }
}

/// Joints and members while runs and trees are taken out of them.
struct Graph {
    /// Members at a joint, those that are left.
    degrees: Vec<usize>,
    /// Exclusive or of their numbers: with one left its number, with two left the other one.
    members: Vec<usize>,
    /// Loads with those of the trees taken away; empty where there is no tree.
    loads: Vec<Vector3<f64>>,
    alive: Vec<bool>,
}

impl Graph {
    fn new(framework: &Framework) -> Self {
        let joints = framework.nodes.len();
        let mut graph = Self {
            degrees: vec![0; joints],
            members: vec![0; joints],
            loads: Vec::new(),
            alive: framework.links.iter().map(|link| pulls(framework, link)).collect(),
        };
        for (member, link) in framework.links.iter().enumerate() {
            if graph.alive[member] {
                for joint in [link.from, link.to] {
                    graph.degrees[joint] += 1;
                    graph.members[joint] ^= member;
                }
            }
        }
        graph
    }

    fn load(&self, framework: &Framework, joint: usize) -> Vector3<f64> {
        if self.loads.is_empty() { framework.nodes[joint].load } else { self.loads[joint] }
    }

    /// Take the dangling trees away, tips first; their loads act at their roots then.
    fn trim(&mut self, framework: &Framework) -> Vec<Twig> {
        let tip = |(node, degree): (&Node, &usize)| *degree == 1 && node.freedom() == 3;
        if !framework.nodes.iter().zip(&self.degrees).any(tip) {
            return Vec::new();
        }
        self.loads = framework.nodes.iter().map(|node| node.load).collect();
        let mut sizes: Vec<f64> = self.loads.iter().map(Vector3::norm).collect();
        let mut twigs = Vec::new();
        for joint in 0..framework.nodes.len() {
            let mut tip = joint;
            while self.degrees[tip] == 1
                && framework.nodes[tip].freedom() == 3
                && self.loads[tip].norm() > ZERO * sizes[tip]
            {
                let (member, force) = (self.members[tip], self.loads[tip]);
                let root = framework.links[member].from ^ framework.links[member].to ^ tip;
                self.alive[member] = false;
                self.degrees[tip] = 0;
                self.degrees[root] -= 1;
                self.members[root] ^= member;
                self.loads[root] += force;
                sizes[root] += sizes[tip];
                twigs.push(Twig { member, root, tip, force });
                tip = root;
            }
        }
        twigs
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use model::Bar;
    use model::system::{Joint, Member, System};

    /// Two anchors, runs of three and two members to a branching, a loop of four and a tree of
    /// three members below it.
    fn framework() -> Framework {
        let mut joints = vec![Joint::anchor("A", [0.0; 3]), Joint::anchor("B", [4.0, 0.0, 0.0])];
        joints.extend((2..12).map(|k| Joint::free(format!("{k}"))));
        let pairs = [
            (0, 2),
            (3, 2),
            (3, 4),
            (4, 5),
            (1, 5), // the runs, joint 4 is the branching
            (4, 6),
            (7, 6),
            (7, 8),
            (8, 4), // the loop
            (4, 9),
            (9, 10),
            (11, 9), // the tree
        ];
        let bar = Bar::homogeneous(1.0, 1.0).unwrap();
        let members = pairs.iter().map(|&(a, b)| Member::bar(a, b, bar)).collect();
        Framework::new(&System::new("runs", 1.0, joints, members).unwrap())
    }

    #[test]
    fn runs_loops_and_trees_are_told_apart() {
        let runs = Runs::new(&framework()).unwrap();
        assert_eq!(runs.kept, [0, 1, 4, 7]);
        let members: Vec<Vec<usize>> = runs
            .elements
            .iter()
            .map(|element| runs.steps[element.steps.clone()].iter().map(|s| s.member).collect())
            .collect();
        assert_eq!(members, [vec![0, 1, 2], vec![3, 4], vec![5, 6], vec![7, 8]]);
        let twigs: Vec<_> = runs.twigs.iter().map(|t| (t.member, t.root, t.tip)).collect();
        assert_eq!(twigs, [(10, 9, 10), (11, 9, 11), (9, 4, 9)]);
        let total = |nodes: &[Node]| nodes.iter().map(|node| node.load.z).sum::<f64>();
        assert!((total(&runs.nodes) - total(&framework().nodes)).abs() < 1e-12);
    }
}
