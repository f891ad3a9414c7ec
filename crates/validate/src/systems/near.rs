//! The question of a drawing: the equilibrium next to a shape, and whether what was found is it.

use model::system::{Kind, Member, Support, System, SystemEquilibrium};
use model::{SolverName, Vector, sum};
use serde::Serialize;

use super::ask::SystemFailure;
use super::certificate::total_load_n;
use super::spans::length_m;
use crate::question::{Question, Solvers};
use numerics::vector::{dot, minus, norm, plus, times, worse};

/// A joint that moved further than this part of the shortest member at it is not where it was
/// drawn: half a member is about what turns a triangle of bars over.
pub(super) const FAR: f64 = 0.5;

/// But where no member has turned by as much as this, its ends against each other over its length, the shape is that
/// of the drawing wherever it has sunk: a bridge of short panels by more than one of these.
const TURNED: f64 = 0.25;

/// Places on the straight way from the drawing to the answer at which the energy is looked at.
const STATIONS: u32 = 32;

/// Steps that bring lengths to what they ought to be, and what is left of them then, over the lengths.
const FITS: usize = 8;
const FITTED: f64 = 1e-11;

/// A barrier below this part of the change of the energy along the way is rounding.
const BARRIER: f64 = 1e-6;

/// So is one below this part of the energies themselves, which are sums of many numbers.
const SUMMED: f64 = 1e-9;

/// Systems of up to this many members are also asked for their lowest equilibrium: a second.
const MEMBERS: usize = 2_000;

/// An energy is lower by more than this part of load times size: what solvers agree to.
pub(super) const LOWER: f64 = 1e-9;

/// How the equilibrium that was found lies to the shape that was given.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Near {
    /// Largest move of a joint from its place in the drawing, in units of the shortest member at it.
    pub moved: f64,
    /// The same, m.
    pub moved_m: f64,
    /// That joint.
    pub joint: String,
    /// How far the energy rises on the way from the drawing to the equilibrium on which members change their lengths evenly, J: a
    /// structure that has snapped through has passed a barrier. Nothing where there is none, or
    /// where rigid members have no energy.
    pub barrier_j: Option<f64>,
    /// Whether it is the neighbour of the drawing: no joint has moved by half a member, or no member has turned by a
    /// quarter of its length, and no barrier lies between; or it is the only one, of cables alone.
    pub is_neighbour: bool,
    /// The energy of a lower equilibrium, J, where one was looked for and found.
    pub lower_j: Option<f64>,
}

impl Near {
    /// Hold an answer against the drawing.
    #[must_use]
    pub fn of(system: &System, drawing_m: &[Vector], answer: &SystemEquilibrium) -> Self {
        let mut shortest = vec![f64::INFINITY; drawing_m.len()];
        for member in system.members() {
            for joint in member.path() {
                shortest[joint] = shortest[joint].min(member.body.length_m());
            }
        }
        let moves = drawing_m.iter().zip(&answer.joints_m).zip(system.joints()).enumerate();
        let (mut moved, mut moved_m, mut at) = (0.0, 0.0, 0);
        for (k, ((drawn, found), joint)) in moves {
            let move_m = norm(minus(*found, *drawn));
            let part = move_m / shortest[k];
            if !joint.support.is_fixed() && worse(part, moved) > moved {
                (moved, moved_m, at) = (part, move_m, k);
            }
        }
        let barrier_j = barrier_j(system, drawing_m, &answer.joints_m);
        Self {
            moved,
            moved_m,
            joint: system.joints()[at].name.to_string(),
            barrier_j,
            is_neighbour: (moved <= FAR || turned(system, drawing_m, &answer.joints_m) <= TURNED)
                && barrier_j.is_none(),
            lower_j: None,
        }
    }
}

/// The most by which the ends of a span move against each other between two shapes, over the length in the first one.
fn turned(system: &System, from_m: &[Vector], to_m: &[Vector]) -> f64 {
    let spans = system.members().iter().flat_map(Member::spans);
    let turned = spans.map(|[a, b]| {
        let [before, after] = [from_m, to_m].map(|places| minus(places[b], places[a]));
        norm(minus(after, before)) / norm(before)
    });
    turned.fold(0.0, worse)
}

/// How the answers lie to the drawing: that of the first. What `energy` found far from the drawing is no answer to
/// this question, unless `lagrange` has left the drawing, too, and for the same place, or what it found there does
/// not stay where it is.
pub(super) fn next_to(
    system: &System,
    drawing_m: &[Vector],
    answers: &mut Vec<Result<SystemEquilibrium, SystemFailure>>,
) -> Option<Near> {
    let near = |answer: &SystemEquilibrium| Near::of(system, drawing_m, answer);
    let nearest = answers.iter().flatten().next()?;
    let (places_m, stays) = (nearest.joints_m.clone(), nearest.stability.index_in_space == 0);
    let first = near(nearest);
    for answer in answers {
        let Ok(found) = answer else { continue };
        let there = near(found);
        let elsewhere = || first.is_neighbour || Near::of(system, &places_m, found).moved > FAR;
        let keeps = !stays && there.moved <= FAR;
        if found.solver == SolverName::ENERGY && !there.is_neighbour && !keeps && elsewhere() {
            let Near { joint, moved_m, .. } = there;
            *answer = Err(energy::Error::NoMinimumNear { joint, moved_m }.into());
        }
    }
    Some(first)
}

/// The energy of a lower equilibrium than this, J, if the solvers that are asked find one.
pub(super) fn lower_j(
    system: &System,
    question: &Question,
    answer: &SystemEquilibrium,
) -> Option<f64> {
    if system.members().len() > MEMBERS || answer.evidence.ladder.optimal.is_reached() {
        return None;
    }
    let hanging = system.clone().undrawn();
    let energy = || {
        energy::network::minimise(&hanging, &question.energy()).ok().map(|found| found.equilibrium)
    };
    let lagrange = || {
        lagrange::network::solve(&hanging, &question.lagrange()).ok().map(|found| found.equilibrium)
    };
    let lowest = if question.solvers == Solvers::Lagrange { lagrange() } else { energy() }?;
    let unit_j = total_load_n(system) * system.total_length_m();
    (answer.energy_j - lowest.energy_j > LOWER * unit_j).then_some(lowest.energy_j)
}

/// Whether an answer lies lower than the drawing: a structure may have come down to it.
pub(super) fn is_below(system: &System, drawing_m: &[Vector], answer: &SystemEquilibrium) -> bool {
    answer.energy_j < potential_j(system, system.members(), drawing_m)
}

/// How far the energy rises on the way between two shapes, J, if it rises and falls again: on the straight one, and, where it
/// does there, on one beside it on which no member gets longer or shorter than on its way from one length to the other. A stiff bar
/// that turns is shorter on the straight way, and has as much energy there as the whole structure; one that snaps through has
/// to be.
fn barrier_j(system: &System, from_m: &[Vector], to_m: &[Vector]) -> Option<f64> {
    if system.members().iter().any(|member| member.stiffness_n.is_none()) {
        return None;
    }
    let straight = |part: f64| -> Vec<Vector> {
        let places = from_m.iter().zip(to_m);
        places.map(|(a, b)| plus(*a, times(part, minus(*b, *a)))).collect()
    };
    let beside = |part: f64| fitted(system, [from_m, to_m], part, straight(part));
    rise_j(system, &straight).and_then(|_| rise_j(system, &beside))
}

/// How far the energy rises on a way of places over a part from 0 to 1, J, if it rises and falls again.
fn rise_j(system: &System, way: &dyn Fn(f64) -> Vec<Vector>) -> Option<f64> {
    let at = |station: u32| {
        let places_m = way(f64::from(station) / f64::from(STATIONS));
        potential_j(system, system.members(), &places_m)
    };
    let (start, end) = (at(0), at(STATIONS));
    let top = (1..STATIONS).map(at).fold(f64::NEG_INFINITY, f64::max);
    let rise = top - start.max(end);
    let rounding = SUMMED * (start.abs() + top.abs() + end.abs());
    (rise > rounding.max(BARRIER * (start - end).abs())).then_some(rise)
}

/// Places moved as little as may be, so that every member is as long as on its way between its lengths in two shapes: Newton's
/// steps, each by conjugate gradients for the least squares.
fn fitted(
    system: &System,
    shapes_m: [&[Vector]; 2],
    part: f64,
    mut places_m: Vec<Vector>,
) -> Vec<Vector> {
    let members = system.members();
    let wanted: Vec<f64> = members
        .iter()
        .map(|member| {
            let [from_m, to_m] = shapes_m.map(|places| length_m(member, places));
            from_m + part * (to_m - from_m)
        })
        .collect();
    for _ in 0..FITS {
        let off: Vec<f64> = members
            .iter()
            .zip(&wanted)
            .map(|(member, wanted_m)| wanted_m - length_m(member, &places_m))
            .collect();
        let worst = members.iter().zip(&off).map(|(m, off)| off.abs() / m.body.length_m());
        if worst.fold(0.0, worse) <= FITTED {
            break;
        }
        let rows = Rows::new(system, &places_m);
        let moves = rows.least_squares(&off);
        for (at, by) in places_m.iter_mut().zip(moves) {
            *at = plus(*at, by);
        }
    }
    places_m
}

/// The derivatives of the lengths of members by the places of joints: of each member its spans with their directions.
struct Rows<'a> {
    system: &'a System,
    spans: Vec<Vec<(usize, usize, Vector)>>,
}

impl<'a> Rows<'a> {
    fn new(system: &'a System, places_m: &[Vector]) -> Self {
        let row = |member: &Member| {
            let span = |[a, b]: [usize; 2]| {
                let d = minus(places_m[b], places_m[a]);
                (a, b, times(norm(d).max(f64::MIN_POSITIVE).recip(), d))
            };
            member.spans().map(span).collect()
        };
        Self { system, spans: system.members().iter().map(row).collect() }
    }

    /// By how much moves make each member longer.
    fn longer(&self, moves: &[Vector]) -> Vec<f64> {
        let row = |spans: &Vec<(usize, usize, Vector)>| {
            sum(spans.iter().map(|(a, b, u)| dot(*u, minus(moves[*b], moves[*a]))))
        };
        self.spans.iter().map(row).collect()
    }

    /// The transposed product: what members pull at the joints, as far as these may move.
    fn pulls(&self, forces: &[f64]) -> Vec<Vector> {
        let mut pulls = vec![[0.0; 3]; self.system.joints().len()];
        for (spans, force) in self.spans.iter().zip(forces) {
            for (a, b, u) in spans {
                pulls[*a] = plus(pulls[*a], times(-force, *u));
                pulls[*b] = plus(pulls[*b], times(*force, *u));
            }
        }
        for (pull, joint) in pulls.iter_mut().zip(self.system.joints()) {
            *pull = match joint.support {
                Support::Free => *pull,
                Support::Fixed { .. } => [0.0; 3],
                Support::Line { direction, .. } => along(*pull, direction),
                Support::Plane { normal, .. } => minus(*pull, along(*pull, normal)),
            };
        }
        pulls
    }

    /// The least moves that make members longer by this much, as nearly as they can.
    fn least_squares(&self, longer: &[f64]) -> Vec<Vector> {
        let square = |all: &[Vector]| sum(all.iter().map(|v| dot(*v, *v)));
        let mut moves = vec![[0.0; 3]; self.system.joints().len()];
        let mut left = longer.to_vec();
        let mut gradient = self.pulls(&left);
        let (mut way, mut size) = (gradient.clone(), square(&gradient));
        let enough = FITTED * FITTED * size;
        for _ in 0..3 * moves.len() {
            let by = self.longer(&way);
            let length = size / sum(by.iter().map(|x| x * x));
            if !length.is_finite() {
                break;
            }
            for (at, step) in moves.iter_mut().zip(&way) {
                *at = plus(*at, times(length, *step));
            }
            for (off, by) in left.iter_mut().zip(&by) {
                *off -= length * by;
            }
            gradient = self.pulls(&left);
            let next = square(&gradient);
            if next <= enough {
                break;
            }
            let kept = next / size;
            way = gradient.iter().zip(&way).map(|(g, w)| plus(*g, times(kept, *w))).collect();
            size = next;
        }
        moves
    }
}

/// The part of a vector along a direction.
fn along(v: Vector, direction: Vector) -> Vector {
    times(dot(v, direction) / dot(direction, direction), direction)
}

/// Energy of the loads and of the elastic ones of these members at these places, J.
pub(super) fn potential_j(system: &System, members: &[Member], places_m: &[Vector]) -> f64 {
    let gravity = system.gravity_m_s2();
    let weight = |mass_kg: f64| [0.0, 0.0, -mass_kg * gravity];
    let joints = system.joints().iter().zip(places_m);
    let joints = joints.map(|(joint, at)| -dot(plus(joint.force_n, weight(joint.mass_kg)), *at));
    let members = members.iter().map(|member| {
        let [a, b] = [places_m[member.from], places_m[member.to]];
        let body = &member.body;
        let at = |at_m: f64| plus(a, times(at_m / body.length_m(), minus(b, a)));
        let own = -dot(weight(body.mass_kg()), at(body.centre_m()));
        let loads = member.loads.iter().map(|load| -dot(load.force_n, at(load.at_m)));
        own + sum(loads) + strain_j(member, length_m(member, places_m))
    });
    sum(joints) + sum(members)
}

/// Energy of an elastic member at this length, J.
fn strain_j(member: &Member, length_m: f64) -> f64 {
    let longer = length_m - member.body.length_m();
    let resists = match member.kind {
        Kind::Bar => true,
        Kind::Cable => longer > 0.0,
        Kind::Strut => longer < 0.0,
    };
    let stiffness_n = member.stiffness_n.filter(|_| resists).unwrap_or(0.0);
    0.5 * stiffness_n * longer * longer / member.body.length_m()
}
