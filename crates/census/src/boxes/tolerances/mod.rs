//! An equilibrium for all values of numbers that are known within limits.
//!
//! With the unknowns $x$ of [`prove`](super::prove) and the uncertain numbers $c$ in a box $C$ around those given,
//! $c_0$, Krawczyk's test on $F(x, c) = 0$ over all of $C$,
//!
//! $$ z = Y F(\tilde x, c_0) + \sum_j Y F_{c_j}(\tilde x, C)\\,(C_j - c_{0j}), \qquad |z| + E D < D, \qquad
//!    E \ge |I - Y F_x(\tilde x + D, C)|, $$
//!
//! proves exactly one equilibrium $x(c)$ in $\tilde x + D$ for each $c \in C$, and that $F_x$ is regular in all of
//! it: the number of directions in which the energy falls is the same for all $c$. The derivatives
//! $x_{c_j} = -F_x^{-1} F_{c_j}$ are enclosed over $C$. Where that of a force $t$ by $c_j$ has one sign, the
//! extremes of $t$ are at the ends of $C_j$: where all have, the least and the largest value are
//! those of two equilibria, each enclosed on its own, and the range is the hull. Where some have, the extreme is on
//! the face of $C$ with these $c_j$ at their ends: derivatives are enclosed again there, where more may have one
//! sign, and so on, where ranges may be too wide. For what is left the mean value theorem bounds what they add. What is reached in these equilibria is
//! stated with it.
//!
//! Above a floor a joint that lies on it slides in its level; that the floor pushes it, and that the others stay above, is
//! proved of the ranges.
//!
//! Where the test fails $C$ is halved; the equilibria of two halves are proved to be the same where they meet.
//!
//! R. Krawczyk, Computing 4 (1969) 187-201, doi:10.1007/BF02234767; A. Neumaier, Interval Methods for
//! Systems of Equations (1990), doi:10.1017/CBO9780511526473, chapter 5 (systems with parameters).

mod leaf;
mod numbers;
mod outputs;
mod region;

use std::sync::atomic::{AtomicUsize, Ordering};

use model::system::{Kind, Support, System, Uncertain, UncertainNumber};
use model::{NoBox, Vector};
use numerics::Interval;

use super::activity::Activity;
use super::arithmetic::sum;
use super::diagnosis::diagnosed;
use super::floor::{laid, stays_level};
use super::newton::refine;
use super::prove::Posed;
use super::proven::{reach, spring_n};
use leaf::{Bound, Leaf};
use outputs::{Output, outputs};

/// Boxes of numbers that are tried at most.
const MOST_BOXES: usize = 64;
/// The same as work, unknowns squared times unknowns and numbers: some seconds. Halves of one of a hundred
/// numbers hardly help.
const MOST_WORK: usize = 100_000_000;
/// Where the proof fails it is tried for tolerances halved so many times.
const HALVINGS: i32 = 6;

/// The range of one number of an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// No value is below the first or above the second.
    pub guaranteed: [f64; 2],
    /// Values within the tolerances that reach at least so far down and up.
    pub reached: [f64; 2],
    /// Whether it is the hull of all values, but for rounding: both ends are proved to be those of some values at the
    /// ends of their tolerances.
    pub is_hull: bool,
    /// The uncertain number on which it depends most, and what that changes over its tolerance.
    pub most_by: Option<(usize, f64)>,
}

/// A joint below the line between two others, above or below the point of it that has the same place in plan; below
/// one joint, where both ends are that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Depth {
    /// The joint, from 0.
    pub joint: usize,
    /// The ends of the line.
    pub ends: [usize; 2],
}

/// What is proved for all values of the uncertain numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct ToleranceRanges {
    /// The uncertain numbers.
    pub numbers: Vec<Uncertain>,
    /// Places of all joints, m.
    pub joints_m: Vec<[Range; 3]>,
    /// Axial force of each member with its loads lumped to its joints, tension positive, N.
    pub axial_n: Vec<Range>,
    /// Force of the ground on each joint that a support holds, N; none next to an elastic member
    /// between two anchors.
    pub reactions_n: Vec<Option<[Range; 3]>>,
    /// The depths that were asked for, m.
    pub depths_m: Vec<Range>,
    /// How many boxes of the numbers were needed.
    pub boxes: usize,
    /// How many parts turn freely about a vertical: each turn of them is an equilibrium as well, and the ranges are those
    /// of one.
    pub free_turns: usize,
}

/// Why nothing is proved for all values. Numbers count from 0.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum NoRanges {
    /// Occurs when no number has a tolerance.
    #[error("no number of the system has a tolerance")]
    NothingUncertain,
    /// Occurs when joints may come to lie on the floor, or rise from it.
    #[error("within the tolerances joints may come to lie on the floor or rise from it: {}", listed(.joints))]
    Floor { joints: Vec<usize> },
    /// Occurs when rigid members are more than the shape needs.
    #[error(
        "lengths of rigid members overdetermine the shape {dimension}-fold: with tolerances no shape fits them all, and only a stiffness says how they would share the misfit"
    )]
    Overdetermined { dimension: usize },
    /// Occurs when a part that turns freely about a vertical would be turned.
    #[error("a part turns freely about a vertical, and tolerances of places or forces turn it")]
    Turns,
    /// Occurs when a joint is held by slack members alone: no place is its own.
    #[error("joint {} is held by slack members alone, and may be anywhere that they reach", .joint + 1)]
    Loose { joint: usize },
    /// Occurs when cables or struts may change between slack and taut.
    #[error("within the tolerances members may change between slack and taut: {}", listed(.members))]
    MayChange { members: Vec<usize> },
    /// Occurs when there is no proof that one equilibrium is near for all values.
    #[error(
        "one equilibrium near for all of them is not proved in {} of the uncertain numbers ({reason}){}",
        in_boxes(*boxes),
        .part.map_or_else(String::new, |part| format!("; for {part} times the tolerances it is proved"))
    )]
    NoBox { reason: NoBox, boxes: usize, part: Option<f64> },
}

fn in_boxes(count: usize) -> String {
    if count == 1 { "one box".to_owned() } else { format!("{count} boxes") }
}

fn listed(members: &[usize]) -> String {
    members.iter().map(|k| (k + 1).to_string()).collect::<Vec<_>>().join(", ")
}

/// Bound places, forces, reactions and some depths of the equilibrium next to an answer, for all values of the
/// numbers of the system within their tolerances.
///
/// # Errors
///
/// [`NoRanges`], why there is no such proof.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// // 2 N, known to 1 %, on two bars of 5 m between anchors 6 m apart: each bar bears 5/8 of it.
/// let lamp = Joint::free("P").with_force([0.0, 0.0, -2.0]).with_tolerances(None, None, Some(0.02))?;
/// let joints = vec![Joint::anchor("A", [-3.0, 0.0, 0.0]), Joint::anchor("B", [3.0, 0.0, 0.0]), lamp];
/// let bar = Bar::homogeneous(5.0, 0.0)?;
/// let system = System::new("lamp", 10.0, joints, vec![Member::bar(0, 2, bar), Member::bar(2, 1, bar)])?;
/// let answer = [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 0.0, -4.0]];
/// let ranges = census::boxes::prove_ranges(&system, &answer, &[1.25, 1.25], &[])?;
/// // The force leans by 0.02 along x too: (0.02/2) 5/3 N more in one bar and less in the other.
/// let [least, most] = ranges.axial_n[0].guaranteed;
/// assert!(1.22 < least && least < 1.98 * 0.625 - 0.02 * 5.0 / 6.0 + 1e-12);
/// assert!(2.02 * 0.625 + 0.02 * 5.0 / 6.0 - 1e-12 < most && most < 1.281);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn prove_ranges(
    system: &System,
    joints_m: &[Vector],
    axial_n: &[f64],
    depths: &[Depth],
) -> Result<ToleranceRanges, NoRanges> {
    let Some(floor_m) = system.floor_m() else {
        return without_floor(system, joints_m, axial_n, depths);
    };
    let (laid, lies) = laid(system, floor_m, joints_m).map_err(NoRanges::in_one_box)?;
    let found = without_floor(&laid, joints_m, axial_n, depths)?;
    let stays = |joint: &usize| match found.reactions_n[*joint] {
        Some([_, _, push]) if lies[*joint] => push.guaranteed[0] > 0.0,
        _ => {
            let level = stays_level(&system.joints()[*joint].support);
            level || found.joints_m[*joint][2].guaranteed[0] >= floor_m
        }
    };
    let joints: Vec<usize> = (0..lies.len()).filter(|joint| !stays(joint)).collect();
    if joints.is_empty() { Ok(found) } else { Err(NoRanges::Floor { joints }) }
}

/// Whether a support may bear a force along an axis: not where all of that moves what it holds.
fn bears(support: &Support, axis: usize) -> bool {
    let unit: Vector = std::array::from_fn(|k| if k == axis { 1.0 } else { 0.0 });
    let moves = support.free_part(unit);
    (0..3).any(|k| (unit[k] - moves[k]).abs() > 0.0)
}

/// The same for the joints and members alone.
fn without_floor(
    system: &System,
    joints_m: &[Vector],
    axial_n: &[f64],
    depths: &[Depth],
) -> Result<ToleranceRanges, NoRanges> {
    let numbers = system.uncertain();
    if numbers.is_empty() {
        return Err(NoRanges::NothingUncertain);
    }
    let posed = Posed::new(system, joints_m, axial_n).map_err(NoRanges::in_one_box)?;
    refuse(&posed, &numbers)?;
    let outputs = outputs(system, &posed.equations, &posed.activities, depths);
    let start = posed.equations.start(joints_m, axial_n);
    let start = refine(&posed.equations, &start)
        .map_err(|reason| NoRanges::in_one_box(diagnosed(&posed.equations, &start, reason)))?
        .at;
    let cover = Cover {
        system,
        posed: &posed,
        numbers: &numbers,
        outputs: &outputs,
        tried: AtomicUsize::new(0),
    };
    let whole = vec![Interval::new(-1.0, 1.0); numbers.len()];
    let leaves = cover.leaves(&whole, &start).map_err(|reason| cover.open(reason, &start))?;
    cover.gather(&leaves)
}

impl NoRanges {
    /// Before any box was halved.
    fn in_one_box(reason: NoBox) -> Self {
        match reason {
            NoBox::SelfStresses { dimension } => Self::Overdetermined { dimension },
            reason => Self::NoBox { reason, boxes: 1, part: None },
        }
    }
}

/// Refuse what breaks the symmetry of parts that turn, or moves what nothing holds.
fn refuse(posed: &Posed, numbers: &[Uncertain]) -> Result<(), NoRanges> {
    if let Some(joint) = posed.loose.iter().position(|loose| *loose) {
        return Err(NoRanges::Loose { joint });
    }
    let turning = !posed.equations.holds.is_empty();
    for uncertain in numbers {
        match uncertain.number {
            UncertainNumber::At(..) | UncertainNumber::Force(_, 0 | 1) if turning => {
                return Err(NoRanges::Turns);
            }
            _ => {}
        }
    }
    Ok(())
}

/// What stays the same for all boxes.
struct Cover<'a> {
    system: &'a System,
    posed: &'a Posed,
    numbers: &'a [Uncertain],
    outputs: &'a [Output],
    tried: AtomicUsize,
}

impl Cover<'_> {
    /// Boxes with a proof for each, which together are this one.
    fn leaves(&self, parts: &[Interval], start: &[f64]) -> Result<Vec<Leaf>, NoBox> {
        self.tried.fetch_add(1, Ordering::Relaxed);
        let failure = match Leaf::new(self, parts.to_vec(), start) {
            Ok(leaf) => return Ok(vec![leaf]),
            Err(failure) => failure,
        };
        let (reason, Some((widest, starts))) = (failure.reason, failure.halves) else {
            return Err(failure.reason);
        };
        if self.tried.load(Ordering::Relaxed) >= self.most_boxes() {
            return Err(reason);
        }
        let middle = parts[widest].mid();
        let half = |part: Interval, start: &[f64]| {
            let mut parts = parts.to_vec();
            parts[widest] = part;
            self.leaves(&parts, start)
        };
        let mut below = half(Interval::new(parts[widest].lo(), middle), &starts[0])?;
        let above = half(Interval::new(middle, parts[widest].hi()), &starts[1])?;
        let mut face: Vec<f64> = parts.iter().map(|part| part.mid()).collect();
        face[widest] = middle;
        self.meet(&below, &above, &face)?;
        below.extend(above);
        Ok(below)
    }

    fn most_boxes(&self) -> usize {
        let size = self.posed.equations.size;
        (MOST_WORK / (size * size * (size + self.numbers.len())).max(1)).min(MOST_BOXES)
    }

    /// Prove that at a point on both sides the equilibrium is the same.
    fn meet(&self, below: &[Leaf], above: &[Leaf], face: &[f64]) -> Result<(), NoBox> {
        let at = |leaves: &[Leaf]| leaves.iter().position(|leaf| leaf.contains(face));
        let [Some(first), Some(second)] = [at(below), at(above)] else {
            return Err(NoBox::NotContracting);
        };
        let zero = below[first].at(self, face)?;
        if above[second].encloses(face, &zero) { Ok(()) } else { Err(NoBox::NotContracting) }
    }

    /// Why there is no proof, and for which part of the tolerances there is one.
    fn open(&self, reason: NoBox, start: &[f64]) -> NoRanges {
        let reason = diagnosed(&self.posed.equations, start, reason);
        if matches!(reason, NoBox::SelfStresses { .. }) {
            return NoRanges::in_one_box(reason);
        }
        let is_proved = |part: &f64| {
            let parts = vec![Interval::new(-part, *part); self.numbers.len()];
            Leaf::new(self, parts, start).is_ok()
        };
        let part = (1..=HALVINGS).map(|k| 0.5_f64.powi(k)).find(is_proved);
        NoRanges::NoBox { reason, boxes: self.tried.load(Ordering::Relaxed), part }
    }

    /// The ranges over all boxes, if the same members act in all of them.
    fn gather(&self, leaves: &[Leaf]) -> Result<ToleranceRanges, NoRanges> {
        let fails = |reason| NoRanges::NoBox {
            reason,
            boxes: self.tried.load(Ordering::Relaxed),
            part: None,
        };
        let mut ranges: Vec<Option<[Bound; 2]>> = vec![None; self.outputs.len()];
        for leaf in leaves {
            for (all, bounds) in ranges.iter_mut().zip(leaf.bounds(self).map_err(fails)?) {
                *all = Some(all.map_or(bounds, |all| [0, 1].map(|k| all[k].or(bounds[k]))));
            }
        }
        let ranges = ranges.into_iter().enumerate();
        let ranges: Vec<Range> =
            ranges.filter_map(|(k, bounds)| Some(range(bounds?, leaves[0].most_by(k)))).collect();
        let found = self.in_si(&ranges, leaves.len());
        let mut members = self.may_change(&ranges);
        members.extend(self.idle_may_change(&found.axial_n));
        members.sort_unstable();
        if members.is_empty() { Ok(found) } else { Err(NoRanges::MayChange { members }) }
    }

    /// Elastic cables and struts between two anchors whose force may vanish, and may not.
    fn idle_may_change<'b>(&'b self, axial_n: &'b [Range]) -> impl Iterator<Item = usize> + 'b {
        let idle = |k: &usize| self.posed.activities[*k] == Activity::Idle;
        let changes = move |k: &usize| {
            let range = &axial_n[*k];
            self.system.members()[*k].kind != Kind::Bar
                && range.contains(0.0)
                && range.guaranteed.iter().any(|end| end.abs() > 0.0)
        };
        (0..axial_n.len()).filter(idle).filter(changes)
    }

    /// Cables and struts that are not proved to stay taut or slack.
    fn may_change(&self, ranges: &[Range]) -> Vec<usize> {
        let acting = &self.posed.equations.acting;
        let pairs = self.outputs.iter().zip(ranges);
        pairs
            .filter_map(|(output, range)| {
                let [least, most] = range.guaranteed;
                let (member, stays) = match *output {
                    Output::Axial(k) => match self.system.members()[acting[k].member].kind {
                        Kind::Bar => return None,
                        Kind::Cable => (acting[k].member, least > 0.0),
                        Kind::Strut => (acting[k].member, most < 0.0),
                    },
                    Output::Spare(member) => (member, least > 0.0),
                    _ => return None,
                };
                (!stays).then_some(member)
            })
            .collect()
    }

    fn in_si(&self, ranges: &[Range], boxes: usize) -> ToleranceRanges {
        let frame = &self.posed.equations.frame;
        let parts = vec![Interval::new(-1.0, 1.0); self.numbers.len()];
        let over = numbers::within(&self.posed.equations, self.system, self.numbers, &parts);
        // What has no unknown depends on the numbers alone.
        let places = over.joints.iter().map(|joint| frame.place_m(joint.origin));
        let places: Vec<_> = places.collect();
        let mut joints_m: Vec<[Range; 3]> =
            places.iter().map(|place| place.map(Range::of)).collect();
        let mut axial_n: Vec<Range> = self.idle(&places).into_iter().map(Range::of).collect();
        let (mut reactions_n, mut depths_m) = (vec![None; joints_m.len()], vec![]);
        for (output, range) in self.outputs.iter().zip(ranges) {
            match *output {
                Output::Place(joint, axis) => {
                    joints_m[joint][axis] = range.scaled(frame.length_m, frame.origin_m[axis]);
                }
                Output::Axial(k) => {
                    axial_n[self.posed.equations.acting[k].member] =
                        range.scaled(frame.force_n, 0.0);
                }
                Output::Reaction(joint, axis) => {
                    let all = reactions_n[joint].get_or_insert([Range::of(Interval::ZERO); 3]);
                    if bears(&self.system.joints()[joint].support, axis) {
                        all[axis] = range.scaled(frame.force_n, 0.0);
                    }
                }
                Output::Depth(_) => depths_m.push(range.scaled(frame.length_m, 0.0)),
                Output::Spare(_) => {}
            }
        }
        for (k, member) in self.system.members().iter().enumerate() {
            if self.posed.activities[k] == Activity::Idle && member.stiffness_n.is_some() {
                member.path().for_each(|joint| reactions_n[joint] = None);
            }
        }
        let numbers = self.numbers.to_vec();
        let free_turns = self.posed.equations.holds.len();
        ToleranceRanges { numbers, joints_m, axial_n, reactions_n, depths_m, boxes, free_turns }
    }

    /// Forces of elastic members between two anchors by their law alone, N, and 0 of all others. Each number is
    /// in it once, so that this is the hull.
    fn idle(&self, places: &[[Interval; 3]]) -> Vec<Interval> {
        let members = self.system.members().iter().enumerate();
        let force = |(k, member): (usize, &model::system::Member)| {
            let stiffness_n = member.stiffness_n?;
            let length_m = self.number(UncertainNumber::Length(k), member.body.length_m());
            let stiffness_n = self.number(UncertainNumber::Stiffness(k), stiffness_n);
            let distance_m = reach(member, places);
            let idle = self.posed.activities[k] == Activity::Idle;
            idle.then(|| spring_n(member.kind, stiffness_n, distance_m, length_m))
        };
        members.map(|entry| force(entry).unwrap_or(Interval::ZERO)).collect()
    }

    /// All values of a number, which may have a tolerance.
    fn number(&self, number: UncertainNumber, given: f64) -> Interval {
        let uncertain = self.numbers.iter().find(|uncertain| uncertain.number == number);
        Interval::point(given) + Interval::around(0.0, uncertain.map_or(0.0, |u| u.within))
    }
}

fn range([least, most]: [Bound; 2], most_by: Option<(usize, f64)>) -> Range {
    Range {
        guaranteed: [-least.most, most.most],
        reached: [-least.reached, most.reached],
        is_hull: least.is_hull && most.is_hull,
        most_by,
    }
}

impl Range {
    /// Of what depends on no unknown: all of it is reached, but for rounding.
    fn of(hull: Interval) -> Self {
        let ends = [hull.lo(), hull.hi()];
        Self { guaranteed: ends, reached: ends, is_hull: true, most_by: None }
    }

    /// In other units, a power of two, and from another origin.
    fn scaled(self, unit: f64, origin: f64) -> Self {
        let scaled = |x: f64| sum(Interval::point(x).scale(unit), Interval::point(origin));
        let [guaranteed, reached] = [self.guaranteed, self.reached].map(|ends| ends.map(scaled));
        Self {
            guaranteed: [guaranteed[0].lo(), guaranteed[1].hi()],
            reached: [reached[0].hi(), reached[1].lo()],
            most_by: self.most_by.map(|(number, by)| (number, by * unit)),
            ..self
        }
    }

    /// How much wider it may be than the hull: what is guaranteed less what is reached.
    pub fn excess(&self) -> f64 {
        let [[least, most], [from, to]] = [self.guaranteed, self.reached];
        (from - least).max(0.0) + (most - to).max(0.0)
    }

    /// Whether a value is in it.
    pub fn contains(&self, value: f64) -> bool {
        (self.guaranteed[0]..=self.guaranteed[1]).contains(&value)
    }
}

#[cfg(test)]
mod tests;
