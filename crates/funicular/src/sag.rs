//! How deep rows of members hang below the lines that they span.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, VecDeque};

use model::Vector;
use model::system::{Member, System};

/// What is less than this part of a length is its rounding.
const LEVEL: f64 = 1e-12;

/// A row turns by less than 60 degrees in plan where it passes a joint of three and more members.
const STRAIGHT: f64 = 0.5;

/// How deep a joint hangs below the line between two others.
///
/// With $P$ the joint and $A$, $B$ the ends, the depth is $z_A + t (z_B - z_A) - z_P$, $t$ the part
/// of the way from $A$ to $B$ in plan at which $P$ is, between 0 and 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sag {
    /// The depth, m.
    pub depth_m: f64,
    /// The joint, from 0.
    pub joint: usize,
    /// The ends of the line; twice the same joint where it is a height alone, of the lowest support.
    pub ends: [usize; 2],
}

/// The joints that members connect.
struct Rows<'a> {
    system: &'a System,
    joints_m: &'a [Vector],
    /// Where the list of each joint begins in `ends`.
    begins: Vec<usize>,
    /// The joint at the other end of each member that meets in a joint.
    ends: Vec<usize>,
}

impl Sag {
    /// The largest of all rows of members. A row begins at a joint of held height, goes straight on in plan
    /// through joints where three and more members meet, and ends at a support or where none goes on. Where
    /// no row spans anything, the depth of the lowest joint below the lowest joint of held height, if it is
    /// below.
    pub(crate) fn largest(system: &System, joints_m: &[Vector]) -> Option<Self> {
        let rows = Rows::new(system, joints_m);
        let held: Vec<usize> = (0..joints_m.len())
            .filter(|joint| system.joints()[*joint].support.holds_height())
            .collect();
        let all =
            held.iter().flat_map(|&first| rows.at(first).iter().map(move |next| (first, *next)));
        let sags = all.filter_map(|(first, next)| rows.deepest(&rows.row(first, next)));
        sags.reduce(deeper).or_else(|| rows.below_lowest(&held))
    }

    /// The largest of the way of fewest members from one joint to another, by number from 0; `None`
    /// where no way connects them, one is above the other, or no joint is between them in plan.
    pub fn between(system: &System, joints_m: &[Vector], ends: [usize; 2]) -> Option<Self> {
        let rows = Rows::new(system, joints_m);
        rows.deepest(&rows.way(ends)?)
    }
}

/// The larger of two; of those that are equal to rounding the first.
fn deeper(a: Sag, b: Sag) -> Sag {
    if b.depth_m > a.depth_m + LEVEL * a.depth_m.abs() { b } else { a }
}

fn level(d: Vector) -> f64 {
    d[0].hypot(d[1])
}

impl<'a> Rows<'a> {
    fn new(system: &'a System, joints_m: &'a [Vector]) -> Self {
        let spans = || system.members().iter().flat_map(Member::spans);
        let ways = || spans().flat_map(|[a, b]| [(a, b), (b, a)]);
        let mut begins = vec![0; joints_m.len() + 1];
        for (here, _) in ways() {
            begins[here + 1] += 1;
        }
        for joint in 0..joints_m.len() {
            begins[joint + 1] += begins[joint];
        }
        let (mut next, mut ends) = (begins.clone(), vec![0; begins[joints_m.len()]]);
        for (here, there) in ways() {
            ends[next[here]] = there;
            next[here] += 1;
        }
        Self { system, joints_m, begins, ends }
    }

    /// The joints that members connect with a joint.
    fn at(&self, joint: usize) -> &[usize] {
        &self.ends[self.begins[joint]..self.begins[joint + 1]]
    }

    fn way_m(&self, a: usize, b: usize) -> Vector {
        std::array::from_fn(|k| self.joints_m[b][k] - self.joints_m[a][k])
    }

    /// The joints of a row from a support over the first joint; empty where it ends loose.
    fn row(&self, first: usize, next: usize) -> Vec<usize> {
        let mut row = vec![first, next];
        while let [.., before, here] = row[..] {
            let loose = !self.system.joints()[here].support.holds_height();
            match self.onward(before, here) {
                Some(onward) if loose && onward != first => row.push(onward),
                None if loose && self.at(here).len() == 1 => return Vec::new(),
                _ => break,
            }
            if row.len() > self.joints_m.len() {
                return Vec::new();
            }
        }
        row
    }

    /// The joint to go on to: the other one of two; of more, the straightest in plan, of these in space.
    fn onward(&self, before: usize, here: usize) -> Option<usize> {
        let mut others = self.at(here).iter().copied().filter(|other| *other != before);
        if self.at(here).len() <= 2 {
            return others.next();
        }
        let came = self.way_m(before, here);
        let straight = |other: usize| {
            let goes = self.way_m(here, other);
            let plan = (came[0] * goes[0] + came[1] * goes[1]) / (level(came) * level(goes));
            let size = level(goes).hypot(goes[2]) * level(came).hypot(came[2]);
            // To the rounding of a cosine: members in one upright plane are equally straight.
            let plan = (1e9 * plan).round() / 1e9;
            (plan, (plan * level(came) * level(goes) + came[2] * goes[2]) / size, other)
        };
        let upright = |other: &usize| {
            let goes = self.way_m(here, *other);
            level(goes) <= 1e-6 * goes[2].abs()
        };
        let by = |a: &(f64, f64, usize), b: &(f64, f64, usize)| {
            a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
        };
        let best = others.filter(|other| !upright(other)).map(straight).max_by(by);
        best.filter(|(plan, ..)| *plan > STRAIGHT).map(|(.., other)| other)
    }

    /// The inner joint of a way that is furthest below the line between its ends.
    fn deepest(&self, way: &[usize]) -> Option<Sag> {
        let [first, inner @ .., last] = way else { return None };
        let (ends, d) = ([*first, *last], self.way_m(*first, *last));
        // One above the other: no line to be below of.
        if level(d) <= LEVEL * d[2].abs() || first == last {
            return None;
        }
        let depths = inner.iter().filter_map(|&joint| {
            let p = self.way_m(*first, joint);
            let t = (p[0] * d[0] + p[1] * d[1]) / (level(d) * level(d));
            // What is beyond an end is below no point of the line.
            let beside = t.clamp(0.0, 1.0) - t;
            let sag = Sag { depth_m: t * d[2] - p[2], joint, ends };
            (beside.abs() <= LEVEL).then_some(sag)
        });
        depths.reduce(deeper)
    }

    /// The way of fewest members between two joints.
    fn way(&self, [first, last]: [usize; 2]) -> Option<Vec<usize>> {
        let mut before = HashMap::from([(first, first)]);
        let mut open = VecDeque::from([first]);
        while let Some(here) = open.pop_front() {
            for &next in self.at(here) {
                if let Entry::Vacant(new) = before.entry(next) {
                    new.insert(here);
                    open.push_back(next);
                }
            }
        }
        let mut way = vec![last];
        while let Some(&here) = way.last().filter(|here| **here != first) {
            way.push(*before.get(&here)?);
        }
        way.reverse();
        Some(way)
    }

    fn below_lowest(&self, held: &[usize]) -> Option<Sag> {
        let height = |joint: &usize| self.joints_m[*joint][2];
        let lowest = |a: &usize, b: &usize| height(a).total_cmp(&height(b));
        let support = held.iter().copied().min_by(lowest)?;
        let joint = (0..self.joints_m.len()).min_by(lowest)?;
        let depth_m = height(&support) - height(&joint);
        (depth_m > 0.0).then_some(Sag { depth_m, joint, ends: [support; 2] })
    }
}
