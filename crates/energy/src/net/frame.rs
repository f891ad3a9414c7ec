//! A system in the units and coordinates of the solver.

use std::collections::BTreeSet;

use model::Vector;
use model::system::{Joint, Kind, Member, Support, System};

use crate::error::Error;
use crate::net::law::Excess;
use crate::net::work::Meter;
use crate::thresholds::ZERO;
use crate::vector::{along, cross, dot, norm, scaled, unit};

/// A joint with the directions in which it can move.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spot {
    /// Number of its first coordinate.
    pub(super) first: usize,
    /// Number of its coordinates, 0 to 3.
    pub(super) freedom: usize,
    /// Orthonormal directions of its coordinates.
    pub(super) axes: [Vector; 3],
}

/// A member without its weight, which acts at the joints; or what keeps a joint above the floor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rod {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) length: f64,
    pub(super) kind: Kind,
    /// Elongation by a unit force; zero where inextensible.
    pub(super) flexibility: f64,
    /// No member: its second joint is not to get below its first one, a point of the floor. It acts
    /// as a cable whose excess length is the depth, and whose pull is the push of the floor.
    pub(super) ground: bool,
    /// How far the length may be off where lengths overdetermine the shape.
    pub(super) within: f64,
    /// Whether its excess is `|d| - l` although it is inextensible.
    pub(super) linear: bool,
    /// Number of the rope that it is a strand of, from 1; 0 of a straight member. A strand carries the
    /// numbers of its rope: its length, its law, its force, its excess.
    pub(super) rope: u32,
}

/// The strands of each rope in their order.
pub(super) fn strands(rods: &[Rod]) -> Vec<Vec<usize>> {
    let mut ropes: Vec<Vec<usize>> = Vec::new();
    for (e, rod) in rods.iter().enumerate().filter(|(_, rod)| rod.rope > 0) {
        let number = rod.rope as usize;
        ropes.resize(ropes.len().max(number), Vec::new());
        ropes[number - 1].push(e);
    }
    ropes
}

/// The system without units: lengths in the longest member's, forces in the sum of all loads.
///
/// A force at a point of a straight member is linear in the places of the ends. Hence all weights
/// and constant forces of a member act as if divided between its joints in the ratio of the lever
/// arms.
#[derive(Debug, Clone)]
pub(super) struct Frame {
    /// The origin in the world, m.
    pub(super) origin_m: Vector,
    pub(super) length_m: f64,
    pub(super) force_n: f64,
    /// Number of joints; a point of the floor may stand behind them.
    pub(super) joints: usize,
    /// Number of members; behind them stand the further strands of ropes, then what keeps joints above
    /// the floor.
    pub(super) members: usize,
    /// The strands of each rope; the first is the rod of its member.
    pub(super) ropes: Vec<Vec<usize>>,
    pub(super) spots: Vec<Spot>,
    /// Where supports are; the origin for free joints.
    pub(super) supports: Vec<Vector>,
    pub(super) rods: Vec<Rod>,
    /// Load of each joint, what its members bring included.
    pub(super) loads: Vec<Vector>,
    pub(super) freedom: usize,
    /// What minimisations over it cost.
    pub(super) meter: Meter,
}

/// The loads of a member divided between its joints, N.
pub(super) fn end_loads_n(member: &Member, gravity_m_s2: f64) -> [Vector; 2] {
    let body = &member.body;
    let mut end_loads = [[0.0; 3]; 2];
    let mut put = |at_m: f64, force_n: Vector| {
        let part = at_m / body.length_m();
        end_loads[0] = along(end_loads[0], 1.0 - part, force_n);
        end_loads[1] = along(end_loads[1], part, force_n);
    };
    put(body.centre_m(), [0.0, 0.0, -body.mass_kg() * gravity_m_s2]);
    for load in &member.loads {
        put(load.at_m, load.force_n);
    }
    end_loads
}

/// Load of each joint, what its members bring included, N.
pub(super) fn loads_n(system: &System) -> Vec<Vector> {
    let gravity = system.gravity_m_s2();
    let weight = |joint: &Joint| along(joint.force_n, joint.mass_kg * gravity, [0.0, 0.0, -1.0]);
    let mut loads: Vec<Vector> = system.joints().iter().map(weight).collect();
    for member in system.members() {
        let [start, end] = end_loads_n(member, gravity);
        loads[member.from] = along(loads[member.from], 1.0, start);
        loads[member.to] = along(loads[member.to], 1.0, end);
    }
    loads
}

/// Two directions that make an orthonormal frame with a third.
fn across(direction: Vector) -> [Vector; 2] {
    let steepest = (0..3).min_by(|&i, &j| direction[i].abs().total_cmp(&direction[j].abs()));
    let mut helper = [0.0; 3];
    helper[steepest.unwrap_or(0)] = 1.0;
    let first = unit(cross(direction, helper)).unwrap_or(helper);
    [first, cross(direction, first)]
}

/// The directions that a support leaves free, and their number.
pub(super) fn free_axes(support: &Support) -> (usize, [Vector; 3]) {
    // Directions of systems have the length one, to rounding.
    let straight = |direction| unit(direction).unwrap_or(direction);
    match *support {
        Support::Free => (3, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        Support::Fixed { .. } => (0, [[0.0; 3]; 3]),
        Support::Line { direction, .. } => (1, [straight(direction), [0.0; 3], [0.0; 3]]),
        Support::Plane { normal, .. } => {
            let [first, second] = across(straight(normal));
            (2, [first, second, [0.0; 3]])
        }
    }
}

impl Rod {
    /// A straight member that does not stretch, and has just its length.
    pub(super) fn straight(from: usize, to: usize, length: f64, kind: Kind) -> Self {
        let [flexibility, within] = [0.0; 2];
        Self { from, to, length, kind, flexibility, ground: false, within, linear: false, rope: 0 }
    }
}

#[cfg(test)]
impl Frame {
    /// Without loads, in units of 1 m and 1 N: so many joints are held, first of all, the others free.
    pub(super) fn of_rods(held: usize, supports: Vec<Vector>, rods: Vec<Rod>) -> Self {
        let joints = supports.len();
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let free = |k: usize| Spot { first: 3 * (k - held), freedom: 3, axes };
        let mut spots = vec![Spot { first: 0, freedom: 0, axes: [[0.0; 3]; 3] }; held];
        spots.extend((held..joints).map(free));
        Self {
            origin_m: [0.0; 3],
            length_m: 1.0,
            force_n: 1.0,
            joints,
            members: rods.len(),
            ropes: Vec::new(),
            spots,
            supports,
            rods,
            loads: vec![[0.0; 3]; joints],
            freedom: 3 * (joints - held),
            meter: Meter::default(),
        }
    }
}

impl Frame {
    /// Whether a member, or a strand of a rope, has no end that can move.
    pub(super) fn is_held(&self, rod: &Rod) -> bool {
        self.spots[rod.from].freedom + self.spots[rod.to].freedom == 0
    }

    /// The system without units.
    pub(super) fn new(system: &System) -> Result<Self, Error> {
        let origin_m = system.reference_m();
        let lengths = system.members().iter().map(|member| member.body.length_m());
        let length_m = lengths.fold(0.0, f64::max);
        let loads_n = loads_n(system);
        let mut total: f64 = loads_n.iter().map(|load| norm(*load)).sum();
        if total <= 0.0 {
            let stiff_n = system.members().iter().filter_map(|member| member.stiffness_n);
            total = stiff_n.reduce(f64::max).ok_or(Error::NoLoad)?;
        }
        let mut freedom = 0;
        let mut spots = Vec::with_capacity(loads_n.len());
        for joint in system.joints() {
            let (count, axes) = free_axes(&joint.support);
            spots.push(Spot { first: freedom, freedom: count, axes });
            freedom += count;
        }
        let supports = system.joints().iter().map(|joint| {
            let at_m = joint.support.at_m().unwrap_or(origin_m);
            scaled(1.0 / length_m, along(at_m, -1.0, origin_m))
        });
        let rods = system.members().iter().map(|member| {
            let length = member.body.length_m() / length_m;
            let flexibility = member.stiffness_n.map_or(0.0, |ea| length * total / ea);
            let within = member.within_m() / length_m;
            let rod = Rod::straight(member.from, member.to, length, member.kind);
            Rod { flexibility, within, ..rod }
        });
        let mut rods = with_strands(system, rods.collect());
        beside_strands(&mut rods);
        let mut frame = Self {
            origin_m,
            length_m,
            force_n: total,
            joints: spots.len(),
            members: system.members().len(),
            ropes: strands(&rods),
            spots,
            supports: supports.collect(),
            rods,
            loads: loads_n.iter().map(|load| scaled(1.0 / total, *load)).collect(),
            freedom,
            meter: Meter::default(),
        };
        if let Some(floor_m) = system.floor_m() {
            frame.put_floor((floor_m - origin_m[2]) / length_m);
        }
        Ok(frame)
    }

    /// Keep every joint that can rise or fall above a height.
    fn put_floor(&mut self, height: f64) {
        let point = self.joints;
        self.spots.push(Spot { first: self.freedom, freedom: 0, axes: [[0.0; 3]; 3] });
        self.supports.push([0.0, 0.0, height]);
        self.loads.push([0.0; 3]);
        for to in 0..self.joints {
            let spot = &self.spots[to];
            if spot.axes[..spot.freedom].iter().all(|axis| axis[2].abs() <= ZERO) {
                continue;
            }
            // The unit of length: depths are held against the longest member.
            self.rods.push(Rod { ground: true, ..Rod::straight(point, to, 1.0, Kind::Cable) });
        }
    }

    /// Whether a floor is below any joint that can rise.
    pub(super) fn has_floor(&self) -> bool {
        self.rods.iter().any(|rod| rod.ground)
    }

    /// From one end of a member to the other.
    pub(super) fn span(&self, x: &[Vector], rod: usize) -> Vector {
        along(x[self.rods[rod].to], -1.0, x[self.rods[rod].from])
    }

    /// The displacement of a joint by a change of the coordinates.
    pub(super) fn displacement(&self, step: &[f64], joint: usize) -> Vector {
        let spot = &self.spots[joint];
        (0..spot.freedom).fold([0.0; 3], |sum, k| along(sum, step[spot.first + k], spot.axes[k]))
    }

    /// The relative displacement of the ends of a member.
    pub(super) fn relative(&self, step: &[f64], rod: usize) -> Vector {
        let Rod { from, to, .. } = self.rods[rod];
        along(self.displacement(step, to), -1.0, self.displacement(step, from))
    }

    /// Relative displacement of the ends of a member in a step.
    pub(super) fn turned(&self, step: &[f64], rod: usize) -> f64 {
        self.whole(rod, |strand| norm(self.relative(step, strand)))
    }

    /// The value of a member, or the sum over the strands of its rope.
    pub(super) fn whole(&self, rod: usize, value: impl Fn(usize) -> f64) -> f64 {
        match self.rods[rod].rope {
            0 => value(rod),
            rope => self.ropes[rope as usize - 1].iter().map(|strand| value(*strand)).sum(),
        }
    }

    /// The excess of a member, or of its whole rope with the gradient of this strand.
    pub(super) fn excess(&self, x: &[Vector], rod: usize) -> Excess {
        let here = &self.rods[rod];
        let mut excess = here.excess(self.span(x, rod));
        if here.rope > 0 {
            excess.value = self.whole(rod, |e| norm(self.span(x, e))) - here.length;
        }
        excess
    }

    /// Change of an excess to first order by a change of the coordinates.
    pub(super) fn change(&self, excess: &[Excess], rod: usize, step: &[f64]) -> f64 {
        self.whole(rod, |strand| excess[strand].change(self.relative(step, strand)))
    }

    /// Whether a rod is a strand whose rope has another one before it: what is summed over members
    /// leaves it out.
    pub(super) fn again(&self, rod: usize) -> bool {
        rod >= self.members && self.rods[rod].rope > 0
    }

    /// The member of a rod; of what is none the last one.
    pub(super) fn member_of(&self, rod: usize) -> usize {
        match self.rods[rod].rope {
            0 => rod.min(self.members - 1),
            rope => self.ropes[rope as usize - 1][0],
        }
    }

    /// Give every strand what the first one of its rope has.
    pub(super) fn spread(&self, values: &mut [f64]) {
        for rope in &self.ropes {
            let first = values[rope[0]];
            for strand in rope {
                values[*strand] = first;
            }
        }
    }

    /// Places after a part of a change of the coordinates.
    pub(super) fn moved(&self, x: &[Vector], part: f64, step: &[f64]) -> Vec<Vector> {
        let go = |(joint, &x): (usize, &Vector)| along(x, part, self.displacement(step, joint));
        x.iter().enumerate().map(go).collect()
    }

    /// Derivative by the coordinates of `sum pull(e) . (x_to - x_from) - sum load . x`.
    pub(super) fn gradient(&self, pull: impl Fn(usize) -> Vector) -> Vec<f64> {
        let loads = self.reduced(&self.loads);
        self.resisted(pull).iter().zip(loads).map(|(pull, load)| pull - load).collect()
    }

    /// The same without the loads.
    pub(super) fn resisted(&self, pull: impl Fn(usize) -> Vector) -> Vec<f64> {
        let mut forces = vec![[0.0; 3]; self.spots.len()];
        for (e, rod) in self.rods.iter().enumerate() {
            let pull = pull(e);
            forces[rod.from] = along(forces[rod.from], -1.0, pull);
            forces[rod.to] = along(forces[rod.to], 1.0, pull);
        }
        self.reduced(&forces)
    }

    /// Components of vectors at the joints along the coordinates.
    pub(super) fn reduced(&self, vectors: &[Vector]) -> Vec<f64> {
        let mut reduced = vec![0.0; self.freedom];
        for (spot, &vector) in self.spots.iter().zip(vectors) {
            for k in 0..spot.freedom {
                reduced[spot.first + k] = dot(spot.axes[k], vector);
            }
        }
        reduced
    }

    /// Energy of the loads.
    pub(super) fn height(&self, x: &[Vector]) -> f64 {
        -model::sum(self.loads.iter().zip(x).map(|(load, x)| dot(*load, *x)))
    }
}

/// The members, with a rod for each strand of a rope: further ones behind them all.
fn with_strands(system: &System, mut rods: Vec<Rod>) -> Vec<Rod> {
    let ropes = system.members().iter().enumerate().filter(|(_, member)| member.rope.is_some());
    for (rope, (e, member)) in (1..).zip(ropes) {
        let model = Rod { rope, ..rods[e] };
        for (k, [from, to]) in member.spans().enumerate() {
            let strand = Rod { from, to, ..model };
            if k == 0 {
                rods[e] = strand;
            } else {
                rods.push(strand);
            }
        }
    }
    rods
}

/// What keeps the two joints of a strand apart has a corner where they meet, as the strand has: without it the strand
/// would hold them there.
fn beside_strands(rods: &mut [Rod]) {
    let ends = |rod: &Rod| [rod.from.min(rod.to), rod.from.max(rod.to)];
    let strands: BTreeSet<[usize; 2]> = rods.iter().filter(|rod| rod.rope > 0).map(ends).collect();
    for rod in rods.iter_mut().filter(|rod| rod.kind != Kind::Cable) {
        rod.linear = strands.contains(&ends(rod));
    }
}

#[cfg(test)]
mod tests {
    use model::Bar;
    use model::system::Joint;

    use super::*;

    /// A bar and a strut beside the two strands of a rope, which have corners of their own; a bar elsewhere.
    #[test]
    fn what_keeps_the_ends_of_a_strand_apart_has_their_corner() {
        let joints = vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B", [3.0, 0.0, 0.5]),
            Joint::free("R").with_mass(2.0),
            Joint::free("Q").with_mass(1.0),
        ];
        let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let members = vec![
            Member::cable(0, 1, body(4.0)).over(vec![2]),
            Member::bar(2, 0, body(2.0)),
            Member::bar(1, 2, body(1.5)).of_kind(Kind::Strut),
            Member::bar(2, 3, body(0.5)),
        ];
        let frame = Frame::new(&System::new("strands", 9.81, joints, members).unwrap()).unwrap();
        let found: Vec<_> = frame.rods.iter().map(|rod| (rod.from, rod.to, rod.linear)).collect();
        let wanted = [(0, 2, false), (2, 0, true), (1, 2, true), (2, 3, false), (2, 1, false)];
        assert_eq!(found, wanted);
    }
}
