//! Minima at a corner of the energy, where a span of a rope has no length.
//!
//! The energy of a rope with the tension `T` has the corner `T |d|` there. Moved apart by `v` the two joints
//! gain `T |v|` and lose the work of all that else acts on them: the corner is a minimum across if spans that
//! pull with no more than their tensions balance that. Along, with both joints as one, it is an energy like any
//! other, and that is minimised.

use matrices::dense::least_squares;
use model::system::{Joined, System};
use model::{Jam, Vector};
use nalgebra::{DMatrix, DVector};

use crate::error::Error;
use crate::net::frame::{Frame, end_loads_n, free_axes, loads_n};
use crate::net::shape::Shape;
use crate::net::solution::Solution;
use crate::thresholds::ZERO;
use crate::vector::{along, dot, norm, scaled, unit};

/// The minimum of a system; where a span ends in a corner, of the one with its two joints as one, and so on.
pub(super) fn at_corners(
    system: &System,
    minimum: Result<Solution, Error>,
    minimise: impl Fn(&Joined) -> Result<Solution, Error>,
) -> Result<Solution, Error> {
    let Err(Error::Jammed { member, span }) = &minimum else { return minimum };
    let (mut corner, mut joined, mut pairs) = ([*member, *span], None::<Joined>, vec![]);
    loop {
        let here = joined.as_ref().map_or(system, |joined| &joined.system);
        let [member, span] = corner.map(|number| number - 1);
        let Some([a, b]) = here.members()[member].spans().nth(span) else { return minimum };
        let whole = |joint: usize| joined.as_ref().map_or(joint, |joined| joined.kept[joint]);
        pairs.push([whole(a), whole(b)]);
        let Some(next) = system.joined(&pairs) else { return minimum };
        match minimise(&next) {
            Ok(solution) => return whole_again(system, &next, solution).map_or(minimum, Ok),
            Err(Error::Jammed { member, span }) => corner = [member, span],
            Err(_) => return minimum,
        }
        joined = Some(next);
    }
}

/// The minimum with its joints apart, if the energy rises across every corner.
fn whole_again(system: &System, joined: &Joined, mut solution: Solution) -> Option<Solution> {
    let answer = &mut solution.equilibrium;
    let numbers = || joined.numbers.iter();
    answer.joints_m = numbers().map(|number| answer.joints_m[*number]).collect();
    answer.reactions_n = numbers().map(|number| answer.reactions_n[*number]).collect();
    let frame = Frame::new(system).ok()?;
    let scaled_down =
        |at_m: &Vector| scaled(1.0 / frame.length_m, along(*at_m, -1.0, frame.origin_m));
    let force = frame.rods.iter().enumerate().map(|(e, rod)| {
        if rod.ground { 0.0 } else { answer.axial_n[frame.member_of(e)] / frame.force_n }
    });
    let mut x = frame.supports.clone();
    x.iter_mut().zip(&answer.joints_m).for_each(|(x, at_m)| *x = scaled_down(at_m));
    let shape = Shape { x, force: force.collect() };
    answer.energy_j = frame.energy(&shape) * frame.force_n * frame.length_m;
    let Corners { jams, reactions } = corners(system, joined, &answer.joints_m, &answer.axial_n)?;
    for (joint, reaction) in reactions {
        answer.reactions_n[joint] = reaction;
    }
    for (k, member) in system.members().iter().enumerate() {
        let first = joined.numbers[member.from];
        if member.path().all(|joint| joined.numbers[joint] == first) {
            // Slack, and its loads at the joint.
            let ends = end_loads_n(member, system.gravity_m_s2());
            [answer.start_forces_n[k], answer.end_forces_n[k]] = ends.map(|end| scaled(-1.0, end));
        }
    }
    for jam in &jams {
        if jam.span == 0 {
            answer.start_forces_n[jam.member] = scaled(-1.0, jam.pull_n);
        }
        if jam.span == system.members()[jam.member].via().len() {
            answer.end_forces_n[jam.member] = jam.pull_n;
        }
    }
    answer.evidence.jams = jams;
    Some(solution)
}

/// What spans without length bear, and the forces of the ground on their joints.
struct Corners {
    jams: Vec<Jam>,
    reactions: Vec<(usize, Vector)>,
}

/// A joint in a corner.
struct Tip {
    joint: usize,
    /// What acts on it besides the spans without length.
    force: Vector,
    /// Directions in which it can move, orthonormal.
    free: Vec<Vector>,
    /// What of a push straight up it follows, if the floor is under it.
    rising: Option<Vector>,
}

/// The balance in the corners; nothing where the energy falls across one. A joint that the floor would have to pull
/// is not held by it.
fn corners(
    system: &System,
    joined: &Joined,
    joints_m: &[Vector],
    axial_n: &[f64],
) -> Option<Corners> {
    let acting = acting(system, joined, joints_m, axial_n);
    let largest = axial_n.iter().map(|n| n.abs()).chain(acting.iter().map(|f| norm(*f)));
    let most = ZERO * largest.fold(0.0, f64::max);
    let floor_m = system.floor_m().unwrap_or(f64::NEG_INFINITY);
    let far_m = joints_m.iter().flatten().fold(1.0, |far: f64, x| far.max(x.abs()));
    let several = |joint: &usize| {
        joined.numbers.iter().filter(|other| **other == joined.numbers[*joint]).count() > 1
    };
    let mut tips = vec![];
    for joint in (0..acting.len()).filter(several) {
        let (count, axes) = free_axes(&system.joints()[joint].support);
        let lies = joints_m[joint][2] - floor_m <= ZERO * far_m;
        let free = axes[..count].to_vec();
        let rising = free.iter().fold([0.0; 3], |sum, axis| along(sum, axis[2], *axis));
        let rising = unit(rising).filter(|_| lies && norm(rising) > ZERO);
        tips.push(Tip { joint, force: acting[joint], free, rising });
    }
    loop {
        let jams = shared(system, joined, &tips, axial_n, most)?;
        let left = tips.iter().map(|tip| {
            let pulls = jams.iter().map(|(jam, [a, b])| {
                let sign =
                    f64::from(u8::from(*a == tip.joint)) - f64::from(u8::from(*b == tip.joint));
                scaled(sign, jam.pull_n)
            });
            pulls.fold(tip.force, |sum, pull| along(sum, 1.0, pull))
        });
        let left: Vec<Vector> = left.collect();
        let pulled = tips
            .iter_mut()
            .zip(&left)
            .find(|(tip, left)| tip.rising.is_some_and(|up| dot(up, **left) > most));
        let Some((tip, _)) = pulled else {
            let ground = |(tip, left): (&Tip, &Vector)| {
                let free = tip.level();
                let moving = free.iter().fold([0.0; 3], |sum, e| along(sum, dot(*e, *left), *e));
                (tip.joint, along(moving, -1.0, *left))
            };
            let reactions = tips.iter().zip(&left).map(ground).collect();
            let jams = jams.into_iter().map(|(jam, _)| jam).collect();
            return Some(Corners { jams, reactions });
        };
        tip.rising = None;
    }
}

impl Tip {
    /// The directions in which it moves on the floor, or where that is not under it.
    fn level(&self) -> Vec<Vector> {
        let Some(up) = self.rising else { return self.free.clone() };
        let mut level: Vec<Vector> = vec![];
        for axis in &self.free {
            let others = level.iter().chain([&up]);
            let rest = others.fold(*axis, |rest, other| along(rest, -dot(rest, *other), *other));
            level.extend(unit(rest).filter(|_| norm(rest) > ZERO.sqrt()));
        }
        level
    }
}

/// Pulls of the spans without length, each with its joints: the least `sum |pull|^2 / T` that balances every joint
/// along its motions. Nothing where that needs more than a tension.
fn shared(
    system: &System,
    joined: &Joined,
    tips: &[Tip],
    axial_n: &[f64],
    most: f64,
) -> Option<Vec<(Jam, [usize; 2])>> {
    let moves = |joint: usize| !system.joints()[joint].support.is_fixed();
    let spans = joined
        .spans(system)
        .filter(|(member, _, [a, b])| axial_n[*member] > 0.0 && (moves(*a) || moves(*b)));
    let spans: Vec<(usize, usize, [usize; 2])> = spans.collect();
    let root = |span: usize| axial_n[spans[span].0].sqrt();
    let level: Vec<(&Tip, Vector)> =
        tips.iter().flat_map(|tip| tip.level().into_iter().map(move |axis| (tip, axis))).collect();
    let (rows, columns) = (level.len(), 3 * spans.len());
    let balance = DMatrix::from_fn(rows, columns, |row, column| {
        let (tip, axis) = level[row];
        let [a, b] = spans[column / 3].2;
        let sign = f64::from(u8::from(a == tip.joint)) - f64::from(u8::from(b == tip.joint));
        sign * root(column / 3) * axis[column % 3]
    });
    let wanted = level.iter().map(|(tip, axis)| -dot(tip.force, *axis));
    let wanted = DVector::from_iterator(rows, wanted);
    let parts = least_squares(&balance, &wanted, ZERO)?;
    if (&balance * &parts - &wanted).iter().any(|off| off.abs() > most) {
        return None;
    }
    let jam = |(k, (member, span, joints)): (usize, &(usize, usize, [usize; 2]))| {
        let pull_n = std::array::from_fn(|axis| root(k) * parts[3 * k + axis]);
        let holds = norm(pull_n) <= axial_n[*member];
        holds.then_some((Jam { member: *member, span: *span, pull_n }, *joints))
    };
    spans.iter().enumerate().map(jam).collect()
}

/// What loads and members of some length do at each joint.
fn acting(system: &System, joined: &Joined, joints_m: &[Vector], axial_n: &[f64]) -> Vec<Vector> {
    let mut all = loads_n(system);
    for (member, force) in system.members().iter().zip(axial_n) {
        for [a, b] in member.spans().filter(|[a, b]| joined.numbers[*a] != joined.numbers[*b]) {
            let Some(direction) = unit(along(joints_m[b], -1.0, joints_m[a])) else { continue };
            all[a] = along(all[a], *force, direction);
            all[b] = along(all[b], -force, direction);
        }
    }
    all
}
