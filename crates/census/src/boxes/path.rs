//! The path of equilibria through a shape, proved from there to its first singular point.
//!
//! Overlapping [tubes](super::tube) follow the path: each holds the two points, proved by themselves,
//! that it shares with its neighbours, so one curve runs through all of them. In each tube the tests of
//! all blocks of the derivative (module `limit`) are enclosed. Where none vanishes $J$ is regular:
//! no other equilibrium meets the path, and the parameter grows along it. Where one may vanish, but
//! with a slope that is not zero, the interval Newton step says whether and where it does.

use model::system::System;
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::arithmetic::{product, sum};
use super::family::Family;
use super::limit::{near, singular, tested, value, zero};
use super::side::Side;
use super::tube::{Centre, Tube, last};

/// Most unknowns of a path that is proved: some thirty tubes of 160 take half a second.
pub const MAX_PATH_UNKNOWNS: usize = 160;

/// Half-length of the first tube, in units in which unknowns and range are of order one.
const FIRST: f64 = 1.0 / 64.0;
/// Half-length of the shortest one.
const SHORTEST: f64 = 1e-7;
/// The next one is longer by this, and shorter where there is no proof.
const LONGER: f64 = 1.4;
const SHORTER: f64 = 0.5;
/// Part by which a tube is longer than the path between its ends.
const OVERLAP: f64 = 1e-3;
/// Tubes that are tried, whether they are proved or not: so many, and of more unknowns fewer, so that their
/// number times the square of that of the unknowns is no more than this: two or three seconds.
const MOST: usize = 4000;
const WORK: usize = 5_000_000;

/// What a singular point is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SingularKind {
    /// The parameter turns back.
    Limit,
    /// Paths that break a symmetry cross.
    Branch,
}

/// The path of equilibria from a shape on, as far as it is proved.
#[derive(Debug, Clone, PartialEq)]
pub struct PathProof {
    /// Up to this value of the parameter, which grows from its value at the start (or falls) all along,
    /// the equilibria on the path are regular: no other one meets them.
    pub to: f64,
    /// The first singular point, if the proof comes to one: what it is and an enclosure of the
    /// parameter there.
    pub first: Option<(SingularKind, Interval)>,
    /// Number of tubes.
    pub tubes: usize,
    /// Why the proof ends before the range and before a singular point.
    pub stopped: Option<NoBox>,
}

/// Prove the path of the equilibrium next to an answer under the loads of the first system, as the
/// loads go straight to those of the second: to the first point where the derivative of the
/// equations is singular, or to the second system. `values` are the parameter at both; the systems differ in
/// loads alone.
///
/// What is proved: through the equilibrium at the start goes one path on which the parameter
/// grows, and no other equilibrium meets it before the value [`to`](PathProof::to). The [first singular
/// point](PathProof::first) is a limit point, or the branch point of a mode that breaks a symmetry,
/// which is exact in double precision ([`prove_singular`](super::prove_singular)). At a branch point without such a
/// symmetry the proof stops.
///
/// # Errors
///
/// [`NoBox`], why there is no proof even of the start.
///
/// # Panics
///
/// When the systems differ in their joints.
pub fn prove_path(
    ends: [&System; 2],
    values: [f64; 2],
    joints_m: &[Point],
    axial_n: &[f64],
) -> Result<PathProof, NoBox> {
    let family = Family::new(ends, ends[1], (joints_m, axial_n), true, MAX_PATH_UNKNOWNS)?;
    let mut walk = Walk::start(&family, joints_m, axial_n)?;
    let found = walk.run();
    let [from, to] = values;
    let of = |t: Interval| value([from, to, from], t);
    let (first, stopped) = match found {
        Ok(first) => (first, None),
        Err(reason) => (None, Some(reason)),
    };
    let first = first.map(|(kind, t)| (kind, of(t)));
    // On the side of the start.
    let ended = first.map_or_else(|| of(walk.here.t()), |(_, value)| value);
    let reached = if from <= to { ended.lo().min(to) } else { ended.hi().max(to) };
    Ok(PathProof { to: reached, first, tubes: walk.tubes, stopped })
}

/// A point of the path, proved by itself, with the direction there.
struct Node {
    at: Vec<f64>,
    along: Vec<f64>,
    place: Vec<Interval>,
}

impl Node {
    fn new(family: &Family<'_>, centre: Centre) -> Result<Self, NoBox> {
        let place = centre.tube(family, Interval::ZERO)?.curve().to_vec();
        let along = centre.unit();
        Ok(Self { at: centre.at, along, place })
    }

    fn t(&self) -> Interval {
        last(&self.place)
    }
}

struct Walk<'a> {
    family: &'a Family<'a>,
    here: Node,
    sides: Vec<Side>,
    tubes: usize,
}

type First = Option<(SingularKind, Interval)>;

impl<'a> Walk<'a> {
    fn start(family: &'a Family<'a>, joints_m: &[Point], axial_n: &[f64]) -> Result<Self, NoBox> {
        let start = family.start(joints_m, axial_n, 0.0);
        let mut row = vec![0.0; family.size()];
        row[family.size() - 1] = 1.0;
        let centre = Centre::new(family, &start, row)?;
        let slope = centre.slope.clone();
        let here = Node::new(family, centre)?;
        near(&here.place, &start)?;
        family.acts(&family.spread(&here.place))?;
        let side = |block| Side::new(family, block, &slope, None).ok_or(NoBox::Singular);
        let broken = (1..family.blocks.len()).filter(|block| family.blocks[*block].size() > 0);
        let sides = broken.map(side).collect::<Result<_, _>>()?;
        Ok(Self { family, here, sides, tubes: 0 })
    }

    /// Tube after tube, to the first singular point or to the end of the range.
    fn run(&mut self) -> Result<First, NoBox> {
        let (mut length, mut failure) = (FIRST, NoBox::NotContracting);
        for _ in 0..MOST.min(WORK / self.family.size().pow(2)) {
            let left = 1.0 - self.here.t().lo();
            if left <= 0.0 {
                return Ok(None);
            }
            let pace = self.here.along.last().copied().unwrap_or(0.0);
            let rest = 0.5 * (1.0 + OVERLAP) * left / pace;
            let long = if rest > 0.0 { length.min(rest) } else { length };
            match self.tube(long) {
                Ok((next, sides, first)) => {
                    self.tubes += 1;
                    if let Some((kind, t)) = first {
                        // Beyond the range is not asked for.
                        return Ok((t.lo() <= 1.0).then_some((kind, t)));
                    }
                    (self.here, self.sides) = (next, sides);
                    length = (LONGER * long).max(length);
                }
                Err(error) => {
                    failure = error;
                    length = SHORTER * long;
                    if length < SHORTEST {
                        break;
                    }
                }
            }
        }
        Err(failure)
    }

    /// The next tube, of this half-length: the point at its end, and the first singular point in it.
    fn tube(&self, length: f64) -> Result<(Node, Vec<Side>, First), NoBox> {
        let family = self.family;
        let guess = |at: &[f64], along: &[f64]| -> Vec<f64> {
            at.iter().zip(along).map(|(x, v)| x + length * v).collect()
        };
        let Node { at, along, .. } = &self.here;
        let centre = Centre::new(family, &guess(at, along), along.clone())?;
        let end = Centre::new(family, &centre.ahead(length), centre.unit())?;
        let next = Node::new(family, end)?;
        let places = [&self.here, &next].map(|node| centre.seen(&node.place));
        let over = places[0].hull(places[1]);
        let over = over + Interval::around(0.0, OVERLAP * over.width());
        let tube = centre.tube(family, over)?;
        for node in [&self.here, &next] {
            centre.holds(&tube, &node.place)?;
        }
        if places[0].hi() >= places[1].lo() {
            return Err(NoBox::NotContracting);
        }
        family.acts(&family.spread(tube.curve()))?;
        let side = |side: &Side| Side::new(family, side.block, &centre.slope, Some(side));
        let sides = self.sides.iter().map(side).collect::<Option<Vec<_>>>();
        let sides = sides.ok_or(NoBox::Singular)?;
        let first = first(family, &centre, &tube, &sides)?;
        Ok((next, sides, first))
    }
}

/// The first singular point in a tube.
fn first(
    family: &Family<'_>,
    centre: &Centre,
    tube: &Tube,
    sides: &[Side],
) -> Result<First, NoBox> {
    let rate = centre.rate(family, tube)?.vector;
    let mut found: Vec<(Interval, SingularKind, Interval)> = vec![];
    for side in std::iter::once(None).chain(sides.iter().map(Some)) {
        let (all, slope) = tested(family, centre, tube, side, &rate)?;
        // The parameter grows towards the first limit point.
        let grows = |wrong: bool| {
            if side.is_none() && wrong { Err(NoBox::NotContracting) } else { Ok(()) }
        };
        if !all.contains(0.0) {
            grows(all.hi() < 0.0)?;
            continue;
        }
        let thin = centre.tube(family, Interval::ZERO)?;
        centre.shares(&thin, tube)?;
        let (start, _) = tested(family, centre, &thin, side, &rate)?;
        if tube.over.disjoint(-start / slope) {
            grows(start.lo() <= 0.0)?;
            continue;
        }
        let step = zero(start, slope, tube.over).ok_or(NoBox::NotContracting)?;
        grows(slope.hi() >= 0.0)?;
        let block = side.map(|side| side.block);
        let kind = if block.is_none() { SingularKind::Limit } else { SingularKind::Branch };
        // Next to the point it is enclosed more sharply, if that is the same point.
        let sharp = singular(family, &centre.ahead(step.mid()), centre.row.clone(), block);
        let sharp = sharp.and_then(|point| Ok((centre.holds(tube, &point.point)?, point.t)));
        let (s, t) = sharp.unwrap_or_else(|_| {
            let turns = sum(start, product(step.hull(Interval::ZERO), slope));
            let pace = if block.is_none() { turns } else { last(&rate) };
            (step, sum(last(thin.curve()), product(step, pace)))
        });
        found.push((s, kind, t));
    }
    found.sort_by(|a, b| a.0.hi().total_cmp(&b.0.hi()));
    let Some((s, kind, t)) = found.first().copied() else { return Ok(None) };
    let together = found.iter().skip(1).filter(|other| other.0.lo() <= s.hi());
    let mut t = t;
    for (_, other, other_t) in together {
        if *other != kind {
            return Err(NoBox::NotContracting);
        }
        t = t.hull(*other_t);
    }
    Ok(Some((kind, t)))
}

#[cfg(test)]
mod tests;
