//! A net taken apart into knots, whose places are unknown, joints that swing between two others,
//! and bars between knots.

use model::NoCensus;
use model::system::Kind;
use numerics::Interval;

use super::pieces::Core;
use crate::boxes::arithmetic::{NOWHERE, Vector, difference, norm, plus, product, sum};
use crate::boxes::equations::Acting;

/// Most ropes at whose ends something hangs: each doubles what is searched for jams.
const MOST_HANGING: usize = 6;

/// Where a span or a swing ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum End {
    /// A knot, by its number in the layout.
    Knot(usize),
    /// A place that is known.
    Held(Vector),
}

/// A joint that two bars hold between places that are given.
#[derive(Debug, Clone)]
pub(super) struct Swing {
    pub(super) joint: usize,
    pub(super) members: [usize; 2],
    pub(super) ends: [End; 2],
    pub(super) lengths: [Interval; 2],
    pub(super) load: Vector,
}

/// A member between knots, or from knots to held places: of one span, or of a rope several.
#[derive(Debug, Clone)]
pub(super) struct Link {
    pub(super) acting: Acting,
    pub(super) ends: Vec<[End; 2]>,
    /// What its kind lets it bear, in units of force or of force density.
    pub(super) range: Interval,
    /// What hangs at the end of a rope, and at nothing else, tells its tension.
    pub(super) hanging: Option<Hanging>,
}

/// A joint that hangs plumb along its load at the end of a rope, as far down as the other spans leave it.
#[derive(Debug, Clone)]
pub(super) struct Hanging {
    pub(super) joint: usize,
    /// The joint next to it on the rope.
    pub(super) from: usize,
    pub(super) load: Vector,
    /// The size of the load.
    pub(super) tension: Interval,
}

/// The net in the units of the frame.
#[derive(Debug, Clone)]
pub(super) struct Layout {
    /// 2 in a plane, 3 in space.
    pub(super) dim: usize,
    /// The axes of the world frame in which the joints move; of a plane the first two.
    pub(super) axes: [usize; 3],
    /// An anchor on the vertical about which all turns freely: the one knot is in the plane, on one side of it.
    pub(super) axis: Option<usize>,
    /// The joints whose places are unknown.
    pub(super) knots: Vec<usize>,
    pub(super) loads: Vec<Vector>,
    pub(super) swings: Vec<Swing>,
    pub(super) links: Vec<Link>,
}

impl Layout {
    /// As many joints as possible swing. `axes` are those of the motion, in a plane two.
    pub(super) fn new(core: &Core, dim: usize, axes: [usize; 3]) -> Result<Self, NoCensus> {
        let swinging = swinging(core);
        let hanging: Vec<Option<Hanging>> =
            core.members.iter().map(|member| Hanging::at_end(core, *member)).collect();
        let hangs = |joint: &usize| hanging.iter().flatten().any(|at| at.joint == *joint);
        let knots = core.joints.iter().copied();
        let knots = knots.filter(|joint| !swinging.contains(joint) && !hangs(joint)).collect();
        let (axis, loads, swings, links) = (None, vec![], vec![], vec![]);
        let mut layout = Self { dim, axes, axis, knots, loads, swings, links };
        let borne = |knot: &usize| {
            let of_rope = hanging.iter().flatten().filter(|at| at.from == *knot);
            of_rope.fold(core.loads[*knot], |all, at| plus(all, at.load))
        };
        layout.loads = layout.knots.iter().map(|knot| layout.turned(borne(knot))).collect();
        for joint in swinging.iter().copied() {
            layout.swings.extend(layout.swing(core, joint)?);
        }
        for (member, hanging) in core.members.iter().copied().zip(hanging) {
            if core.system.members()[member].path().all(|joint| !swinging.contains(&joint)) {
                layout.links.push(layout.link(core, member, hanging));
            }
        }
        let jams = layout.links.iter().filter(|link| link.hanging.is_some()).count();
        if jams > MOST_HANGING {
            return Err(NoCensus::SlackSets { limit: 1 << MOST_HANGING });
        }
        let jammed = layout.jammed();
        let unbounded = std::iter::once(&layout).chain(&jammed).find_map(Self::unbounded);
        match unbounded {
            Some(member) => Err(NoCensus::Elastic { member: member + 1 }),
            None => Ok(layout),
        }
    }

    fn swing(&self, core: &Core, joint: usize) -> Result<Option<Swing>, NoCensus> {
        let [(first, a), (second, b)] = core.meeting(joint)[..] else { return Ok(None) };
        let load = self.turned(core.loads[joint]);
        // Two bars that nothing turns can fold or lie straight under any force.
        if load.iter().all(|part| part.contains(0.0)) {
            return Err(NoCensus::Limp { member: first + 1 });
        }
        let ends = [self.end(core, a), self.end(core, b)];
        let lengths = [core.length(first), core.length(second)];
        Ok(Some(Swing { joint, members: [first, second], ends, lengths, load }))
    }

    /// The same where what hangs at the ends of some of the ropes has run up to the next joint: the tension is then
    /// at least its load, and the other spans have all of the length. One layout for each set of such ropes.
    pub(super) fn jammed(&self) -> Vec<Self> {
        let hanging = |k: &usize| self.links[*k].hanging.is_some();
        let mut all = vec![self.clone()];
        for k in (0..self.links.len()).filter(hanging) {
            let jammed = |layout: &Self| {
                let mut layout = layout.clone();
                layout.links[k] = layout.links[k].jammed();
                layout
            };
            all.extend(all.iter().map(jammed).collect::<Vec<_>>());
        }
        all.split_off(1)
    }

    fn link(&self, core: &Core, member: usize, hanging: Option<Hanging>) -> Link {
        let own = &core.system.members()[member];
        let spans: Vec<[usize; 2]> = own.spans().collect();
        let hangs = |joint: &usize| hanging.as_ref().is_some_and(|at| at.joint == *joint);
        let left = spans.iter().filter(|span| !span.iter().any(hangs));
        let ends = left.map(|span| span.map(|joint| self.end(core, joint))).collect();
        let (length, compliance) = (core.length(member), core.frame.compliance(own));
        let acting =
            Acting { member, spans: 0..spans.len(), length, compliance, force: self.links.len() };
        let range = match own.kind {
            Kind::Bar => Interval::LINE,
            Kind::Cable => Interval::new(0.0, f64::INFINITY),
            Kind::Strut => Interval::new(f64::NEG_INFINITY, 0.0),
        };
        Link { acting, ends, range, hanging }
    }

    /// An elastic member with a knot whose place nothing inextensible bounds.
    fn unbounded(&self) -> Option<usize> {
        let mut bounded = vec![false; self.knots.len()];
        let is = |bounded: &[bool], end: &End| match end {
            End::Knot(knot) => bounded[*knot],
            End::Held(_) => true,
        };
        let rigid = self.links.iter().filter(|link| link.sizes().hi().is_finite());
        let rigid = rigid.map(|link| link.ends.as_flattened());
        let groups: Vec<&[End]> =
            rigid.chain(self.swings.iter().map(|swing| &swing.ends[..])).collect();
        for _ in 0..self.knots.len() {
            for group in &groups {
                if group.iter().any(|end| is(&bounded, end)) {
                    for end in *group {
                        if let End::Knot(knot) = end {
                            bounded[*knot] = true;
                        }
                    }
                }
            }
        }
        let open = |link: &&Link| !link.ends.as_flattened().iter().all(|end| is(&bounded, end));
        self.links.iter().find(open).map(|link| link.acting.member)
    }

    fn end(&self, core: &Core, joint: usize) -> End {
        if let Some(number) = self.knots.iter().position(|knot| *knot == joint) {
            return End::Knot(number);
        }
        let at_m = core.system.joints()[joint].support.at_m();
        End::Held(at_m.map_or(NOWHERE, |at_m| self.turned(core.frame.place(at_m))))
    }

    /// A vector of the world frame in the axes of the motion; in a plane without its normal part.
    pub(super) fn turned(&self, world: Vector) -> Vector {
        std::array::from_fn(|k| if k < self.dim { world[self.axes[k]] } else { Interval::ZERO })
    }

    pub(super) fn coordinates(&self) -> usize {
        self.dim * self.knots.len()
    }

    /// Independent motions of the knots.
    pub(super) fn motions(&self) -> usize {
        self.coordinates().saturating_sub(self.constraints())
    }

    /// Links whose tension follows from the balance alone.
    pub(super) fn constraints(&self) -> usize {
        self.links.iter().filter(|link| link.is_constraint()).count()
    }

    /// The distances that swings bridge: both ends, and the range of the distance.
    pub(super) fn reaches(&self) -> impl Iterator<Item = ([End; 2], Interval)> {
        self.swings.iter().map(|swing| {
            let [a, b] = swing.lengths;
            let least = if a == b { Interval::ZERO } else { (a - b).abs() };
            (swing.ends, Interval::new(least.lo(), (a + b).hi()))
        })
    }
}

impl Link {
    /// Whether it keeps a length, with a tension that follows from the balance.
    pub(super) fn is_constraint(&self) -> bool {
        self.hanging.is_none() && self.acting.is_rigid()
    }

    /// What its spans are together.
    pub(super) fn sizes(&self) -> Interval {
        let length = self.acting.length;
        if let Some(hanging) = &self.hanging {
            // What it has where its tension is known, less what hangs.
            let whole = sum(length, product(self.acting.compliance, hanging.tension));
            return Interval::new(0.0, whole.hi());
        }
        if self.acting.is_rigid() {
            return length;
        }
        let [least, most] = [self.range.lo() < 0.0, self.range.hi() > 0.0];
        let least = if least { 0.0 } else { length.lo() };
        Interval::new(least, if most { f64::INFINITY } else { length.hi() })
    }

    /// Without what hangs, which holds on with its load at least.
    fn jammed(&self) -> Self {
        let acting = Acting { spans: 0..self.ends.len(), ..self.acting.clone() };
        let least = self.hanging.as_ref().map_or(0.0, |hanging| hanging.tension.lo());
        // Of a single span the unknown is the force density.
        let least = (Interval::point(least) / acting.axial(Interval::ONE)).lo();
        let range = Interval::new(least, f64::INFINITY);
        Self { acting, range, hanging: None, ends: self.ends.clone() }
    }

    /// The tension of one that is no constraint, by its law; nothing if its kind cannot have it.
    pub(super) fn known(&self, spans: &[Vector]) -> Option<Interval> {
        if let Some(hanging) = &self.hanging {
            return Some(hanging.tension);
        }
        let size = spans.iter().map(|span| norm(*span)).fold(Interval::ZERO, sum);
        (difference(size, self.acting.length) / self.acting.compliance).intersect(self.range)
    }
}

impl Hanging {
    /// The joint that hangs at an end of a rope.
    fn at_end(core: &Core, member: usize) -> Option<Self> {
        let rope = &core.system.members()[member];
        rope.rope.as_ref()?;
        let (first, last) = (rope.spans().next()?, rope.spans().last()?);
        let ends = [first, [last[1], last[0]]];
        let hangs = |[joint, from]: &[usize; 2]| {
            let passes = rope.path().filter(|other| other == joint).count();
            let others = core.meeting(*joint);
            let alone = passes == 1 && others.iter().all(|(other, _)| *other == member);
            alone && !core.held(*joint) && from != joint
        };
        let [joint, from] = ends.into_iter().find(hangs)?;
        let load = core.loads[joint];
        let tension = norm(load);
        (tension.lo() > 0.0).then_some(Self { joint, from, load, tension })
    }
}

/// As many joints with two members as there are of which no two are neighbours: from the ends of
/// each run of such joints on, those next to anchors last, so that knots are held by anchors.
fn swinging(core: &Core) -> Vec<usize> {
    let between_rods = |joint: &usize| {
        let meeting = core.meeting(*joint);
        meeting.len() == 2 && meeting.iter().all(|(member, _)| core.is_rod(*member))
    };
    let mut left: Vec<usize> = core.joints.iter().copied().filter(between_rods).collect();
    let mut chosen = vec![];
    while !left.is_empty() {
        let neighbours = |joint: usize| core.meeting(joint).into_iter().map(|(_, other)| other);
        let rank = |joint: &usize| {
            let runs_on = neighbours(*joint).filter(|other| left.contains(other)).count();
            let at_anchor = neighbours(*joint).any(|other| core.held(other));
            (runs_on, at_anchor, *joint)
        };
        let Some(next) = left.iter().copied().min_by_key(|joint| rank(joint)) else { break };
        let gone: Vec<usize> = neighbours(next).chain([next]).collect();
        left.retain(|joint| !gone.contains(joint));
        chosen.push(next);
    }
    chosen.sort_unstable();
    chosen
}
