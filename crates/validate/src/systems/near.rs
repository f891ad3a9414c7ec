//! The question of a drawing: the equilibrium next to a shape, and whether what was found is it.

use std::borrow::Cow;

use matrices::sparse::{Entries, Ldlt, Pivots, minimum_degree};
use model::system::{Kind, Member, Support, System, SystemEquilibrium};
use model::{SolverName, Vector, sum};
use serde::Serialize;

use super::ask::SystemFailure;
use super::placed::placed;
use super::spans::length_m;
use super::statics::judge;
use super::turn::turned_onto;
use crate::question::{Question, Solvers};
use crate::tolerances::Tolerances;
use numerics::vector::{dot, minus, norm, plus, times, worse};

/// A joint that moved further than this part of the shortest member at it is not where it was
/// drawn: half a member is about what turns a triangle of bars over.
pub(super) const FAR: f64 = 0.5;

/// But where no member has turned by as much as this, its ends against each other over its length, the shape is that
/// of the drawing wherever it has sunk: a bridge of short panels by more than one of these.
const TURNED: f64 = 0.25;

/// Places on the straight way from the drawing to the answer at which the energy is looked at.
const STATIONS: u32 = 32;

/// Steps that bring lengths to what they ought to be, what is left of them then, over the lengths, and what makes their matrix
/// definite where it is not, in units of a member.
const FITS: usize = 8;
const FITTED: f64 = 1e-11;
const RIDGE: f64 = 1e-13;

/// Where lengths are still off by more, over themselves, no places fit them.
const CLOSED: f64 = 1e-6;

/// A member that turns by more of its length may have turned over on the way to where the energy is least of all: rough drawings
/// of what hangs are off by up to 0.7, chains and triangles that end on another side by 1.3 and more.
const SWUNG: f64 = 0.75;

/// A member turns at once where it does so by this part of its whole turn between two stations.
const AT_ONCE: f64 = 0.25;

/// Of two stable equilibria that the energy falls to from a drawing, the nearer one is its neighbour if the other is so many times
/// as far.
const TWICE: f64 = 2.0;

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
    /// Largest move of a joint from its place in the drawing, in units of the shortest member at it; what turns freely is
    /// turned towards the drawing first.
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
    /// quarter of its length, and no barrier lies between; or it is the only one, of cables alone; or the lowest of all, and the
    /// energy falls all the way there. Never where the other solver comes to rest at another stable one that is about as near.
    pub is_neighbour: bool,
    /// The energy of a lower equilibrium, J, where one was looked for and found.
    pub lower_j: Option<f64>,
}

impl Near {
    /// Hold an answer against the drawing; what turns freely is turned towards it first.
    pub fn of(system: &System, drawing_m: &[Vector], answer: &SystemEquilibrium) -> Self {
        let answer = if answer.stability.neutral > 0 {
            let drawn = SystemEquilibrium { joints_m: drawing_m.to_vec(), ..answer.clone() };
            turned_onto(system, &drawn, answer, &vec![false; drawing_m.len()]).0
        } else {
            Cow::Borrowed(answer)
        };
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
        // The energy of cables is convex, with all that is held and a floor: an equilibrium is the only one.
        let is_only = system.members().iter().all(|member| member.kind == Kind::Cable);
        let is_close = moved <= FAR || turned(system, drawing_m, &answer.joints_m) <= TURNED;
        let is_below = || {
            answer.evidence.ladder.optimal.is_reached()
                && falls(system, drawing_m, &answer.joints_m)
        };
        Self {
            moved,
            moved_m,
            joint: system.joints()[at].name.to_string(),
            barrier_j,
            is_neighbour: is_only || barrier_j.is_none() && (is_close || is_below()),
            lower_j: None,
        }
    }
}

/// An answer of which equilibrium leaves places open, at those of the drawing, where the same forces are in balance there; or
/// else with what turns freely turned towards it.
pub(super) fn as_drawn(system: &System, drawing_m: &[Vector], answer: &mut SystemEquilibrium) {
    let moves = drawing_m.iter().zip(&answer.joints_m).map(|(a, b)| norm(minus(*a, *b)));
    let Tolerances { joints, statics, .. } = Tolerances::project();
    if moves.fold(0.0, worse) <= joints * system.total_length_m() {
        return;
    }
    let drawn = SystemEquilibrium { joints_m: drawing_m.to_vec(), ..answer.clone() };
    let off_j = (drawn_j(system, drawing_m) - answer.energy_j).abs();
    if off_j <= LOWER * system.total_load_n() * system.total_length_m() {
        let there = placed(system, &answer.solver, drawing_m, &answer.axial_n);
        // What the floor bears stays what it is.
        let ground = system.joints().iter().zip(there.reactions_n).zip(&answer.reactions_n);
        let reactions_n = ground.map(|((joint, there), here)| match joint.support {
            Support::Free => *here,
            _ => there,
        });
        let there = SystemEquilibrium {
            joints_m: there.joints_m,
            start_forces_n: there.start_forces_n,
            end_forces_n: there.end_forces_n,
            reactions_n: reactions_n.collect(),
            ..answer.clone()
        };
        if judge(system, &there).passes(statics) {
            *answer = there;
            return;
        }
    }
    // What lies on a floor has more motions than turns.
    if answer.stability.neutral > 0 && system.floor_m().is_none() {
        let nothing = vec![false; drawing_m.len()];
        let turned = turned_onto(system, &drawn, answer, &nothing).0.into_owned();
        *answer = turned;
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
/// not stay where it is. And whether the drawing lies between the two: both are stable, the energy falls to both, and neither is
/// much nearer, as of soft bars that are drawn too long.
pub(super) fn next_to(
    system: &System,
    drawing_m: &[Vector],
    answers: &mut Vec<Result<SystemEquilibrium, SystemFailure>>,
) -> Option<(Near, bool)> {
    let near = |answer: &SystemEquilibrium| Near::of(system, drawing_m, answer);
    let nearest = answers.iter().flatten().next()?;
    let (places_m, stays) = (nearest.joints_m.clone(), nearest.stability.index_in_space == 0);
    let nearest_j = nearest.energy_j;
    let first = near(nearest);
    let mut between = false;
    for answer in answers {
        let Ok(found) = answer else { continue };
        let there = near(found);
        let differs = || Near::of(system, &places_m, found).moved > FAR;
        let elsewhere = || first.is_neighbour || differs();
        let keeps = !stays && there.moved <= FAR;
        let both_stay = stays && found.stability.index_in_space == 0;
        let falls = there.barrier_j.is_none() && first.barrier_j.is_none();
        let as_near = worse(there.moved, first.moved) <= TWICE * there.moved.min(first.moved);
        // What slides freely is as high in both.
        let unit_j = system.total_load_n() * system.total_length_m();
        let apart = (found.energy_j - nearest_j).abs() > LOWER * unit_j;
        between |= both_stay && falls && as_near && apart && differs();
        if found.solver == SolverName::ENERGY && !there.is_neighbour && !keeps && elsewhere() {
            let Near { joint, moved_m, .. } = there;
            *answer = Err(energy::Error::NoMinimumNear { joint, moved_m }.into());
        }
    }
    Some((first, between))
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
    let energy =
        || energy::net::minimise(&hanging, &question.energy()).ok().map(|found| found.equilibrium);
    let lagrange =
        || lagrange::net::solve(&hanging, &question.lagrange()).ok().map(|found| found.equilibrium);
    let lowest = if question.solvers == Solvers::Lagrange { lagrange() } else { energy() }?;
    let unit_j = system.total_load_n() * system.total_length_m();
    (answer.energy_j - lowest.energy_j > LOWER * unit_j).then_some(lowest.energy_j)
}

/// Whether an answer lies lower than the drawing: a structure may have come down to it.
pub(super) fn is_below(system: &System, drawing_m: &[Vector], answer: &SystemEquilibrium) -> bool {
    answer.energy_j < drawn_j(system, drawing_m)
}

/// The energy of a drawing, J, from where that of answers counts.
fn drawn_j(system: &System, drawing_m: &[Vector]) -> f64 {
    let origin_m = system.reference_m();
    let places_m: Vec<Vector> = drawing_m.iter().map(|at| minus(*at, origin_m)).collect();
    potential_j(system, system.members(), &places_m)
}

/// How far the energy rises on the way between two shapes, J, if it rises and falls again: on the straight one, and, where it
/// does there, on one beside it on which no member gets longer or shorter than on its way from one length to the other. A stiff bar
/// that turns is shorter on the straight way, and has as much energy there as the whole structure; one that snaps through has
/// to be.
fn barrier_j(system: &System, from_m: &[Vector], to_m: &[Vector]) -> Option<f64> {
    if system.members().iter().any(|member| member.stiffness_n.is_none()) {
        return None;
    }
    let straight = |part: f64| straight(from_m, to_m, part);
    let rise_j = |way: &mut dyn FnMut(f64) -> Vec<Vector>| rise_j(system, way);
    let barrier_j = rise_j(&mut |part| straight(part))?;
    match Fit::new(system, [from_m, to_m]) {
        // Where no places fit, the way beside the straight one leads anywhere.
        Some(mut fit) => {
            rise_j(&mut |part| fit.at(part, straight(part)).0).map(|j| j.min(barrier_j))
        }
        None => Some(barrier_j),
    }
}

/// Places on the straight way between two shapes, at a part from 0 to 1.
fn straight(from_m: &[Vector], to_m: &[Vector], part: f64) -> Vec<Vector> {
    let places = from_m.iter().zip(to_m);
    places.map(|(a, b)| plus(*a, times(part, minus(*b, *a)))).collect()
}

/// Whether the energy falls from each station to the next on the way from a drawing, closed first, on which rigid members keep
/// their lengths and elastic ones change theirs evenly; and no member turns far, nor at once, as a gable does that snaps through.
fn falls(system: &System, from_m: &[Vector], to_m: &[Vector]) -> bool {
    let Some(mut fit) = Fit::new(system, [from_m, to_m]) else { return false };
    let (mut before_m, _) = fit.at(0.0, from_m.to_vec());
    let mut before_j = f64::INFINITY;
    let whole = turned(system, &before_m, to_m);
    let rounding = SUMMED * system.total_load_n() * system.total_length_m();
    whole <= SWUNG
        && (0..=STATIONS).all(|station| {
            let part = f64::from(station) / f64::from(STATIONS);
            let (places_m, misfit) = fit.at(part, straight(from_m, to_m, part));
            let energy_j = potential_j(system, system.members(), &places_m);
            let follows = turned(system, &before_m, &places_m) <= AT_ONCE * whole;
            let falls = misfit <= CLOSED && follows && energy_j <= before_j + rounding;
            (before_m, before_j) = (places_m, energy_j);
            falls
        })
}

/// How far the energy rises on a way of places over a part from 0 to 1, J, if it rises and falls again.
fn rise_j(system: &System, way: &mut dyn FnMut(f64) -> Vec<Vector>) -> Option<f64> {
    let mut at = |station: u32| {
        let places_m = way(f64::from(station) / f64::from(STATIONS));
        potential_j(system, system.members(), &places_m)
    };
    let (start, end) = (at(0), at(STATIONS));
    let top = (1..STATIONS).map(at).fold(f64::NEG_INFINITY, f64::max);
    let rise = top - start.max(end);
    let rounding = SUMMED * (start.abs() + top.abs() + end.abs());
    (rise > rounding.max(BARRIER * (start - end).abs())).then_some(rise)
}

/// Places between two shapes at which every member is as long as on its way between its lengths there, by Newton's steps for the
/// least squares: $(J^T J + \\varepsilon) x = J^T r$ with the derivatives $J$ of the lengths and what they lack, $r$.
struct Fit<'a> {
    system: &'a System,
    lengths_m: [Vec<f64>; 2],
    factor: Ldlt,
}

/// The spans of a member, each with its joints and the direction from one to the other.
type Spans = Vec<(usize, usize, Vector)>;

impl<'a> Fit<'a> {
    /// `None` for systems that are too large.
    fn new(system: &'a System, shapes_m: [&[Vector]; 2]) -> Option<Self> {
        if system.members().len() > MEMBERS {
            return None;
        }
        let kept = |(member, length_m): (&Member, f64)| match (member.stiffness_n, member.kind) {
            (Some(_), _) => length_m,
            (None, Kind::Bar) => member.body.length_m(),
            (None, Kind::Cable) => length_m.min(member.body.length_m()),
            (None, Kind::Strut) => length_m.max(member.body.length_m()),
        };
        let lengths_m = shapes_m.map(|places_m| {
            system.members().iter().zip(lengths_m(system, places_m)).map(kept).collect()
        });
        let Entries { starts, rows, .. } = square(system, &spans(system, shapes_m[0]));
        let order = minimum_degree(&starts, &rows)?;
        Some(Self { system, lengths_m, factor: Ldlt::new(&starts, &rows, &order)? })
    }

    /// The places, and by how much of itself a length is still off.
    fn at(&mut self, part: f64, mut places_m: Vec<Vector>) -> (Vec<Vector>, f64) {
        let members = self.system.members();
        let [from_m, to_m] = &self.lengths_m;
        let mut misfit = f64::INFINITY;
        for _ in 0..FITS {
            let now_m = lengths_m(self.system, &places_m);
            let off_m: Vec<f64> = (0..members.len())
                .map(|k| from_m[k] + part * (to_m[k] - from_m[k]) - now_m[k])
                .collect();
            let worst = members.iter().zip(&off_m).map(|(m, off)| off.abs() / m.body.length_m());
            misfit = worst.fold(0.0, worse);
            if misfit <= FITTED {
                break;
            }
            let spans = spans(self.system, &places_m);
            let matrix = square(self.system, &spans);
            if !self.factor.factorise(&matrix.values, Pivots::Positive) {
                break;
            }
            let mut right = vec![0.0; 3 * places_m.len()];
            for (spans, off_m) in spans.iter().zip(&off_m) {
                for (row, value) in row(self.system, spans) {
                    right[row] += value * off_m;
                }
            }
            self.factor.solve(&mut right);
            for (at, by) in places_m.iter_mut().zip(right.chunks(3)) {
                *at = plus(*at, [by[0], by[1], by[2]]);
            }
        }
        (places_m, misfit)
    }
}

fn lengths_m(system: &System, places_m: &[Vector]) -> Vec<f64> {
    system.members().iter().map(|member| length_m(member, places_m)).collect()
}

fn spans(system: &System, places_m: &[Vector]) -> Vec<Spans> {
    let span = |[a, b]: [usize; 2]| {
        let d = minus(places_m[b], places_m[a]);
        (a, b, times(norm(d).max(f64::MIN_POSITIVE).recip(), d))
    };
    system.members().iter().map(|member| member.spans().map(span).collect()).collect()
}

/// A row of the derivatives: three entries for each end of each span, as far as its joint may move.
fn row<'a>(system: &'a System, spans: &'a Spans) -> impl Iterator<Item = (usize, f64)> + 'a {
    let ends = spans.iter().flat_map(|(a, b, u)| [(*a, times(-1.0, *u)), (*b, *u)]);
    ends.flat_map(|(joint, pull)| {
        let free = system.joints()[joint].support.free_part(pull);
        (0..3).map(move |axis| (3 * joint + axis, free[axis]))
    })
}

/// The matrix of the least squares, its lower triangle.
fn square(system: &System, spans: &[Spans]) -> Entries {
    let size = 3 * system.joints().len();
    let mut entries: Vec<(usize, usize, f64)> = (0..size).map(|k| (k, k, RIDGE)).collect();
    for spans in spans {
        let row: Vec<(usize, f64)> = row(system, spans).collect();
        for (i, a) in &row {
            let below = row.iter().filter(|(k, _)| k <= i);
            entries.extend(below.map(|(k, b)| (*i, *k, a * b)));
        }
    }
    Entries::new(size, &entries)
}

/// Energy of the loads and of the elastic ones of these members at these places, J.
pub(crate) fn potential_j(system: &System, members: &[Member], places_m: &[Vector]) -> f64 {
    let loads = system.joint_loads_n().into_iter().zip(places_m).map(|(load, at)| -dot(load, *at));
    let strains = members.iter().map(|member| strain_j(member, length_m(member, places_m)));
    sum(loads.chain(strains))
}

/// Energy of an elastic member at this length, J.
fn strain_j(member: &Member, length_m: f64) -> f64 {
    let longer = member.kind.borne(length_m - member.body.length_m());
    0.5 * member.stiffness_n.unwrap_or(0.0) * longer * longer / member.body.length_m()
}
