//! Systems that are no equilibrium problem.

use std::collections::HashSet;

use super::graph::Graph;
use super::{Kind, Support, System};
use crate::Vector;
use crate::number::Brief;
use crate::problem::ANCHOR_ROUNDING;
use crate::readable::{Computed, Readable};

/// Why a system, or a chain, has no equilibrium to be found.
///
/// Members are counted from 1, joints are named.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Refusal {
    /// Occurs when no member meets a joint.
    #[error("no member meets joint {name:?}")]
    Unconnected {
        /// Name of the joint.
        name: String,
        /// Number of the joint, from 0.
        joint: usize,
    },
    /// Occurs when a connected part of the system has no support: it falls.
    #[error(
        "nothing holds joint {name:?} and {} connected with it: this part falls",
        if *joints == 2 { "the joint".to_owned() } else { format!("the {} joints", joints - 1) }
    )]
    Falls {
        /// Name of a joint of the part.
        name: String,
        /// Number of that joint, from 0.
        joint: usize,
        /// Joints of the part.
        joints: usize,
    },
    /// Occurs when no joint can move.
    #[error("every joint is an anchor: nothing can move")]
    NothingMoves,
    /// Occurs when there is neither mass nor force nor an elastic member: every position is an
    /// equilibrium.
    #[error(
        "no mass and no force act on the system: without load every position is an equilibrium"
    )]
    NoLoad,
    /// Occurs when all loads act on supports, through members or at their ends, and none along a way that a joint
    /// can move.
    #[error(
        "all loads of this system rest on its supports: the energy is the same in every position, and \
         every position is an equilibrium"
    )]
    LoadOnAnchors,
    /// Occurs when the loads at every joint that can move cancel, as weight and buoyancy do, but for the rounding of their sum.
    #[error(
        "the loads of every joint that can move cancel but for rounding: every position is an equilibrium"
    )]
    LoadsCancel,
    /// Occurs when two anchors are further apart than the members between them reach.
    #[error(
        "the anchors {from:?} and {to:?} are {} m apart and the members between them reach only {} m: \
         {} m are missing", Computed::of(*distance_m), Computed::of(*reach_m), Computed::difference(*distance_m, *reach_m)
    )]
    OutOfReach {
        /// Name of an anchor.
        from: String,
        /// Name of the other anchor.
        to: String,
        /// Number of the other anchor, from 0.
        joint: usize,
        /// Their distance.
        distance_m: f64,
        /// The shortest way from the one to the other over members.
        reach_m: f64,
    },
    /// Occurs when two anchors are just as far apart as the members between them reach: they lie
    /// straight and taut, and the force along them is indeterminate.
    #[error(
        "the anchors {from:?} and {to:?} are {} m apart and the members between them reach just as far \
         ({} m): they lie straight and taut, and the force along them is indeterminate",
        Computed::of(*distance_m), Computed::of(*reach_m)
    )]
    Taut {
        /// Name of an anchor.
        from: String,
        /// Name of the other anchor.
        to: String,
        /// Number of the other anchor, from 0.
        joint: usize,
        /// Their distance.
        distance_m: f64,
        /// The shortest way from the one to the other over members.
        reach_m: f64,
    },
    /// Occurs when the anchors are so far from the origin that the rounding of their coordinates decides whether what lies
    /// between them can hang, or cannot close, or is straight.
    #[error(
        "the coordinates of the anchors reach {} m, where doubles place the anchors only to \
         {} m, and the bars are only {} m away from being straight",
        Readable(*coordinate_m), Brief(*rounding_m), Brief(*margin_m)
    )]
    Unresolved {
        /// The largest coordinate.
        coordinate_m: f64,
        /// What its rounding can change the distance of two anchors by.
        rounding_m: f64,
        /// What is left when the members are stretched out or folded on one line; negative if they do
        /// not reach.
        margin_m: f64,
    },
    /// Occurs when a rope is no longer than the straight way past the anchors that it runs over.
    #[error(
        "the rope (member {member}) is {} m long, and the way past the anchors that it meets {} m: {}",
        Readable(*length_m), Computed::of(*way_m), short_or_taut(*length_m, *way_m)
    )]
    ShortRope {
        /// Number of the member, from 1.
        member: usize,
        /// Its length.
        length_m: f64,
        /// Sum of the distances between the anchors that it meets, one after another.
        way_m: f64,
    },
    /// Occurs when a member is longer than the rest of a loop through it.
    #[error(
        "member {member} from {from:?} to {to:?} is {} m long, and the rest of a loop through it ({}) \
         only {} m: the loop cannot close, {} m are missing",
        Readable(*length_m), way.join(", "), Computed::of(*rest_m), Computed::difference(*length_m, *rest_m)
    )]
    TooLong {
        /// Number of the member, from 1.
        member: usize,
        /// Name of its first joint.
        from: String,
        /// Name of its second joint.
        to: String,
        /// Its length.
        length_m: f64,
        /// Length of the rest of the loop.
        rest_m: f64,
        /// Names of the joints of the rest of the loop, shortened in the middle where they are
        /// many.
        way: Vec<String>,
    },
    /// Occurs when a member is just as long as the rest of a loop through it: the loop closes only
    /// folded on one line, and the force along it is indeterminate.
    #[error(
        "member {member} from {from:?} to {to:?} is {} m long, exactly as long as the rest of a loop \
         through it ({}): the loop closes only folded on one line, and the force along it is indeterminate",
        Readable(*length_m), way.join(", ")
    )]
    Folded {
        /// Number of the member, from 1.
        member: usize,
        /// Name of its first joint.
        from: String,
        /// Name of its second joint.
        to: String,
        /// Its length.
        length_m: f64,
        /// Names of the joints of the rest of the loop, shortened in the middle where they are
        /// many.
        way: Vec<String>,
    },
}

/// What rounding leaves of loads that cancel, over their sizes.
const CANCELS: f64 = 8.0 * f64::EPSILON;

/// Anchors times members up to which all pairs of anchors are held against the members between
/// them: a tenth of a second. What is not found here the solvers find.
const PAIRS: usize = 2_000_000;

impl System {
    /// Accept the system as an equilibrium problem, or say why it has no answer.
    ///
    /// Joints in one straight line between others are refused only where no other member holds them.
    ///
    /// Lengths are held against every loop of members that is shortest for one of its members, and
    /// against the shortest ways between anchors (where anchors times members are at most two
    /// million): conditions that are necessary, and for chains sufficient.
    ///
    /// # Errors
    /// [`Refusal`] with the numbers it rests on.
    ///
    /// ```
    /// use model::Bar;
    /// use model::system::{Joint, Member, System, Refusal};
    /// let joints = vec![
    ///     Joint::anchor("A", [0.0, 0.0, 0.0]),
    ///     Joint::free("P"),
    ///     Joint::anchor("B", [3.0, 0.0, 0.0]),
    /// ];
    /// let bar = Bar::homogeneous(1.0, 1.0)?;
    /// let members = vec![Member::bar(0, 1, bar), Member::bar(1, 2, bar)];
    /// let system = System::new("too short", 9.81, joints, members)?;
    /// assert!(matches!(
    ///     system.refusal(),
    ///     Err(Refusal::OutOfReach { distance_m: 3.0, reach_m: 2.0, .. })
    /// ));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn refusal(&self) -> Result<(), Refusal> {
        let graph = Graph::new(self);
        self.connected(&graph)?;
        if self.joints().iter().all(|joint| joint.support.is_fixed()) {
            return Err(Refusal::NothingMoves);
        }
        // Elastic members have an energy of their own, without any load.
        let elastic = self.members().iter().any(|member| member.stiffness_n.is_some());
        if self.is_unloaded() && !elastic {
            return Err(Refusal::NoLoad);
        }
        if !elastic {
            self.loads_decide()?;
        }
        self.anchors_in_reach(&graph)?;
        self.ropes_reach()?;
        self.loops_close(&graph)
    }

    /// Whether nothing loads the system: neither weight nor forces.
    pub fn is_unloaded(&self) -> bool {
        let still = |force_n: [f64; 3]| force_n.iter().all(|x| x.abs() <= 0.0);
        // No mass is negative.
        self.joints().iter().all(|joint| joint.mass_kg <= 0.0)
            && self.members().iter().all(|member| member.body.mass_kg() <= 0.0)
            && self.joints().iter().all(|joint| still(joint.force_n))
            && self.members().iter().all(|m| m.loads.iter().all(|load| still(load.force_n)))
    }

    /// Refuse where no joint feels a load along a way that it can move, its own or by the lever rule one of a member, or
    /// where nothing but rounding is left of what it feels.
    fn loads_decide(&self) -> Result<(), Refusal> {
        // Of each joint the sum of what its support does not bear, and the sizes of what is summed up.
        let mut felt = vec![([0.0_f64; 3], 0.0_f64); self.joints().len()];
        let mut add = |joint: usize, part: f64, load_n: Vector| {
            if self.joints()[joint].support.bears(load_n) {
                return;
            }
            let (sum, size) = &mut felt[joint];
            for (sum, x) in sum.iter_mut().zip(load_n) {
                *sum += part * x;
                *size += (part * x).abs();
            }
        };
        let weight = |mass_kg: f64| [0.0, 0.0, -mass_kg * self.gravity_m_s2()];
        for (k, joint) in self.joints().iter().enumerate() {
            add(k, 1.0, weight(joint.mass_kg));
            add(k, 1.0, joint.force_n);
        }
        for member in self.members() {
            let body = &member.body;
            let mut on_member = |at_m: f64, load_n: Vector| {
                let part = at_m / body.length_m();
                add(member.from, 1.0 - part, load_n);
                add(member.to, part, load_n);
            };
            on_member(body.centre_m(), weight(body.mass_kg()));
            member.loads.iter().for_each(|load| on_member(load.at_m, load.force_n));
        }
        if felt.iter().all(|(_, size)| *size <= 0.0) {
            return Err(Refusal::LoadOnAnchors);
        }
        let cancels = |(sum, size): &(Vector, f64)| sum.iter().all(|x| x.abs() <= CANCELS * size);
        if felt.iter().all(cancels) { Err(Refusal::LoadsCancel) } else { Ok(()) }
    }

    fn connected(&self, graph: &Graph<'_>) -> Result<(), Refusal> {
        let joints = self.joints();
        if let Some(joint) = (0..joints.len()).find(|joint| graph.at(*joint).len() == 0) {
            return Err(Refusal::Unconnected { name: joints[joint].name.to_string(), joint });
        }
        // On a floor a part may stand where it is drawn.
        let stands = self.floor_m().is_some() && self.drawing().is_some();
        for part in graph.components() {
            if !stands && part.iter().all(|joint| joints[*joint].support.at_m().is_none()) {
                let (joint, joints_of_part) = (part[0], part.len());
                return Err(Refusal::Falls {
                    name: joints[joint].name.to_string(),
                    joint,
                    joints: joints_of_part,
                });
            }
        }
        Ok(())
    }

    fn anchors_in_reach(&self, graph: &Graph<'_>) -> Result<(), Refusal> {
        let joints = self.joints();
        let anchors: Vec<usize> =
            (0..joints.len()).filter(|joint| joints[*joint].support.is_fixed()).collect();
        if anchors.len().saturating_mul(self.members().len()) > PAIRS {
            return Ok(());
        }
        // From the last one there is none left to go to.
        let (_, all_but_last) = anchors.split_last().unwrap_or((&0, &[]));
        for (k, &start) in all_but_last.iter().enumerate() {
            let ways = graph.distances(start, f64::INFINITY, None);
            for &joint in &anchors[k + 1..] {
                let Some(reach_m) = ways.get(joint) else { continue };
                let distance_m = self.distance_m(start, joint);
                let ends = || (joints[start].name.to_string(), joints[joint].name.to_string());
                let near = distance_m.max(reach_m) * crate::STRAIGHT_TOLERANCE;
                let places = [start, joint].map(|k| joints[k].support.at_m().unwrap_or_default());
                let coordinate_m = places.as_flattened().iter().fold(0.0, |a, x| x.abs().max(a));
                let rounding_m = ANCHOR_ROUNDING * coordinate_m;
                let margin_m = reach_m - distance_m;
                if margin_m.abs() <= near.max(rounding_m) {
                    let way = ways.way(joint);
                    let parts =
                        way.iter().map(|k| (*k, ways.get(*k).unwrap_or_default() / reach_m));
                    let slack = self.slack_beside(graph, [start, joint], parts);
                    if self.holds_inner(graph, &way, slack) {
                        continue;
                    }
                    if margin_m.abs() > near {
                        return Err(Refusal::Unresolved { coordinate_m, rounding_m, margin_m });
                    }
                    let (from, to) = ends();
                    return Err(Refusal::Taut { from, to, joint, distance_m, reach_m });
                }
                if reach_m < distance_m {
                    let (from, to) = ends();
                    return Err(Refusal::OutOfReach { from, to, joint, distance_m, reach_m });
                }
            }
        }
        Ok(())
    }

    fn ropes_reach(&self) -> Result<(), Refusal> {
        let ropes = self.members().iter().enumerate().filter(|(_, member)| member.rope.is_some());
        for (k, rope) in ropes {
            let held = || rope.path().filter(|joint| self.joints()[*joint].support.is_fixed());
            let way_m = held().zip(held().skip(1)).map(|(a, b)| self.distance_m(a, b)).sum::<f64>();
            let length_m = rope.greatest_length_m();
            if way_m >= length_m * (1.0 - crate::STRAIGHT_TOLERANCE) {
                return Err(Refusal::ShortRope { member: k + 1, length_m, way_m });
            }
        }
        Ok(())
    }

    /// Cables to anchors that are slack from joints which lie on the straight line between two others, at these parts of it.
    fn slack_beside(
        &self,
        graph: &Graph<'_>,
        ends: [usize; 2],
        parts: impl Iterator<Item = (usize, f64)>,
    ) -> Vec<usize> {
        /// Slack by this part of the length: far above any rounding.
        const CLEAR: f64 = 1e-6;
        let at_m = |joint: usize| self.joints()[joint].support.at_m();
        let [Some(start_m), Some(end_m)] = ends.map(at_m) else { return vec![] };
        let mut slack = vec![];
        for (joint, part) in parts {
            let place_m = std::array::from_fn(|k| start_m[k] + part * (end_m[k] - start_m[k]));
            for (member, other, _) in graph.at(joint) {
                let cable = &self.members()[member];
                let fixed = self.joints()[other].support.is_fixed();
                let Some(anchor_m) = at_m(other).filter(|_| fixed && cable.rope.is_none()) else {
                    continue;
                };
                let distance_m = crate::Anchors { start_m: place_m, end_m: anchor_m }.span_m();
                let length_m = cable.body.length_m();
                if cable.kind == Kind::Cable && distance_m < length_m * (1.0 - CLEAR) {
                    slack.push(member);
                }
            }
        }
        slack
    }

    /// Whether other members hold every joint that is inside a way over members in one line: joints
    /// of trusses lie straight between others and are held by their diagonals, and a member between two anchors has none.
    /// Nothing else holds those of a taut rope, and a load there has no finite force; nor do members of which it is `also` known that they do not.
    fn holds_inner(
        &self,
        graph: &Graph<'_>,
        way: &[usize],
        also: impl IntoIterator<Item = usize>,
    ) -> bool {
        let inner = &way[1..way.len() - 1];
        let mut along: HashSet<usize> = also.into_iter().collect();
        for pair in way.windows(2) {
            along.extend(graph.at(pair[0]).filter(|end| end.1 == pair[1]).map(|end| end.0));
        }
        let on_way: HashSet<usize> = way.iter().copied().collect();
        let held = |joint: usize| {
            let support = &self.joints()[joint].support;
            matches!(support, Support::Fixed { .. } | Support::Line { .. })
                || on_way.contains(&joint)
        };
        inner.iter().all(|joint| graph.meets(*joint, &along, &held))
    }

    fn loops_close(&self, graph: &Graph<'_>) -> Result<(), Refusal> {
        for (k, member) in self.members().iter().enumerate() {
            if !member.keeps_apart() {
                continue;
            }
            let length_m = member.body.length_m();
            let near = length_m * crate::STRAIGHT_TOLERANCE;
            let ways = graph.distances(member.from, length_m + near, Some((k, member.to)));
            let Some(rest_m) = ways.get(member.to) else { continue };
            let folded = (length_m - rest_m).abs() <= near;
            if folded && self.holds_inner(graph, &ways.way(member.to), Some(k)) {
                continue;
            }
            let (number, name) = (k + 1, |joint: usize| self.joints()[joint].name.to_string());
            let (from, to) = (name(member.from), name(member.to));
            let way = shortened(ways.way(member.to).into_iter().map(name).collect());
            return Err(if folded {
                Refusal::Folded { member: number, from, to, length_m, way }
            } else {
                Refusal::TooLong { member: number, from, to, length_m, rest_m, way }
            });
        }
        Ok(())
    }
}

/// What becomes of a rope that is no longer than its way.
fn short_or_taut(length_m: f64, way_m: f64) -> String {
    if way_m > length_m * (1.0 + crate::STRAIGHT_TOLERANCE) {
        return format!("{} m are missing", Computed::difference(way_m, length_m));
    }
    "it lies straight and taut, and its tension is indeterminate".to_owned()
}

/// At most six names, with the number of those left out in the middle.
pub(crate) fn shortened(mut names: Vec<String>) -> Vec<String> {
    if names.len() > 6 {
        let left_out = names.len() - 5;
        names.splice(3..3 + left_out, [format!("{left_out} more")]);
    }
    names
}
