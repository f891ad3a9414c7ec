//! One box of the uncertain numbers with the proof for all of them.

use std::collections::HashMap;

use model::NoBox;
use numerics::{Interval, down, in_parallel, up};

use super::super::arithmetic::{product, sum};
use super::super::equations::Equations;
use super::super::inverse::{Defect, Inverse};
use super::super::newton::{Refined, refine_within};
use super::Cover;
use super::numbers::{Effect, within};
use super::outputs::{Output, Over};
use super::region::{Change, Region, Step};

/// How much wider each room is than the one that the last would need: little, since in a wider one
/// derivatives vary more.
const WIDER: f64 = 1.2;
/// Where the smaller end of a derivative is less than this part of the larger one, its sign is guessed: then
/// the equilibrium at that end and what the other may add are a better bound than the middle.
const LEANS: f64 = 1.0 / 3.0;
/// The range of a force of which more than this part may be too much is bounded again on faces, and of all outputs where
/// these are no more than boxes that may be tried.
const LOOSE: f64 = 0.05;
/// Of an output's negative, and of the output.
const SIGNS: [f64; 2] = [-1.0, 1.0];
/// A guess of the equilibrium in the middle of a half may be so far from it.
const REACH: f64 = 0.3;
/// What numbers that do nothing at all may add by rounding, as a part of what the others do.
const ROUNDING: f64 = 1e-9;
/// The same in units of the system's length and force.
const NOTHING: f64 = 1e-12;
/// Steps with a fixed inverse to an equilibrium at a corner.
const STEPS: usize = 40;
/// A step that has not fallen to this part of the last one is at the level of rounding.
const FALLS: f64 = 0.9;

/// Least room, relative: beyond the rounding of a point of the plane.
const LEAST: f64 = 1e-12;
/// Rounds to find the room around the plane of equilibria.
const ROUNDS: usize = 8;

/// What is proved over one box.
#[derive(Clone)]
pub(super) struct Leaf {
    parts: Vec<Interval>,
    middle: Vec<f64>,
    inverse: Inverse,
    /// The plane of equilibria to first order.
    at: Vec<Interval>,
    steps: Vec<Step>,
    /// How far from the plane each equilibrium may be, where it is the only one.
    room: Vec<f64>,
    /// Over all of that.
    defect: Defect,
    /// Derivatives of each output by each number, per tolerance.
    slopes: Vec<Vec<Interval>>,
}

/// An upper bound of an output, or of its negative; what it reaches; whether that is the same.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bound {
    pub(super) most: f64,
    pub(super) reached: f64,
    pub(super) is_hull: bool,
}

impl Bound {
    /// The better of two over one box.
    fn and(self, other: Self) -> Self {
        let least = if other.most < self.most { other } else { self };
        Self { reached: self.reached.max(other.reached), ..least }
    }

    /// Over two boxes.
    pub(super) fn or(self, other: Self) -> Self {
        let largest = if other.most > self.most { other } else { self };
        Self { reached: self.reached.max(other.reached), ..largest }
    }
}

/// Where the numbers are for a bound, -1, 0 or 1 for the ends and the middle, and what they may add.
struct Corner {
    at: Vec<i8>,
    more: f64,
    /// The numbers that may add something.
    open: Vec<usize>,
    /// What all numbers do together, about.
    all: f64,
}

impl Corner {
    /// For an output with these derivatives, or, with the sign -1, for its negative.
    fn new(slopes: &[Interval], parts: &[Interval], sign: f64) -> Self {
        let mut found =
            Self { at: Vec::with_capacity(slopes.len()), more: 0.0, open: vec![], all: 0.0 };
        for (slope, part) in slopes.iter().zip(parts) {
            let [lo, hi] =
                if sign < 0.0 { [-slope.hi(), -slope.lo()] } else { [slope.lo(), slope.hi()] };
            let radius = up(part.hi() - part.lo()) / 2.0;
            let (at, more) = if lo >= 0.0 {
                (1, 0.0)
            } else if hi <= 0.0 {
                (-1, 0.0)
            } else if -lo < LEANS * hi {
                (1, -2.0 * lo)
            } else if hi < LEANS * -lo {
                (-1, 2.0 * hi)
            } else {
                (0, hi.max(-lo))
            };
            found.at.push(at);
            found.all += slope.mag() * radius;
            if more > 0.0 {
                found.open.push(found.at.len() - 1);
                found.more = up(found.more + up(more * radius));
            }
        }
        found
    }
}

/// Why there is no proof over a box, and how to go on with its halves.
pub(super) struct Failure {
    pub(super) reason: NoBox,
    /// The number by which to halve it, and the equilibria in the middles of both halves, about.
    pub(super) halves: Option<(usize, [Vec<f64>; 2])>,
}

impl From<NoBox> for Failure {
    fn from(reason: NoBox) -> Self {
        Self { reason, halves: None }
    }
}

impl Corner {
    /// The bound of an output, or of its negative, that has this value here.
    fn bound(&self, value: Interval, sign: f64) -> Bound {
        let value = if sign < 0.0 { -value } else { value };
        // Nothing is added but rounding.
        let is_hull = self.more <= ROUNDING * self.all + NOTHING;
        Bound { most: up(value.hi() + self.more), reached: value.lo(), is_hull }
    }
}

impl Leaf {
    pub(super) fn new(
        cover: &Cover<'_>,
        parts: Vec<Interval>,
        start: &[f64],
    ) -> Result<Self, Failure> {
        let middle: Vec<f64> = parts.iter().map(|part| part.mid()).collect();
        let fixed = cover.at(&middle);
        let Refined { at, inverse } = refine_within(REACH, &fixed, start)?;
        let at: Vec<Interval> = at.into_iter().map(Interval::point).collect();
        let all = within(&cover.posed.equations, cover.system, cover.numbers, &parts);
        let steps = cover.steps(&fixed, &at, &inverse);
        let mut leaf = Self {
            defect: inverse.defect(&[]),
            room: at.iter().map(|x| LEAST * (1.0 + x.mag())).collect(),
            slopes: vec![],
            parts,
            middle,
            inverse,
            at,
            steps,
        };
        let changes = leaf.settle(cover, &fixed, &all).ok_or_else(|| leaf.halves())?;
        let numbers: Vec<usize> = (0..leaf.parts.len()).collect();
        let region = leaf.region(&fixed);
        let over = Over { system: cover.system, equations: &all, region: &region };
        let slopes = leaf.derive(cover, &over, &numbers, &changes, cover.outputs);
        leaf.slopes = slopes.ok_or(NoBox::NotContracting)?;
        Ok(leaf)
    }

    /// The numbers less those of the middle.
    fn offs(&self) -> Vec<Interval> {
        let pairs = self.parts.iter().zip(&self.middle);
        pairs.map(|(part, middle)| *part - Interval::point(*middle)).collect()
    }

    fn region(&self, fixed: &Equations) -> Region {
        Region::around(fixed, &self.at, (&self.steps, &self.offs()), &self.room)
    }

    /// Find room around the plane that is mapped into itself.
    fn settle(
        &mut self,
        cover: &Cover<'_>,
        fixed: &Equations,
        all: &Equations,
    ) -> Option<Vec<Change>> {
        let off = self.inverse.apply(&fixed.value(&self.at).ok()?);
        for _ in 0..ROUNDS {
            let region = self.region(fixed);
            self.defect = region.defect(all, &self.inverse);
            let numbers: Vec<usize> = (0..self.parts.len()).collect();
            let changes = cover.changes(all, &region, &self.steps, &numbers);
            let total = [Change::total(&changes, &self.offs())];
            let [moved] = &Change::through(&total, all, &self.inverse)[..] else { return None };
            let off: Vec<Interval> = off.iter().zip(moved).map(|(a, b)| *a + *b).collect();
            let [within, _] = self.defect.bound(&off, &self.room)?;
            if within.iter().zip(&self.room).all(|(within, room)| within <= room) {
                return Some(changes);
            }
            self.room = within.iter().zip(&self.room).map(|(w, r)| (WIDER * w).max(*r)).collect();
        }
        None
    }

    /// Enclose the derivatives of outputs by these numbers, whose changes are given: what the step of a number leaves is
    /// solved for.
    fn derive(
        &self,
        cover: &Cover<'_>,
        over: &Over<'_>,
        numbers: &[usize],
        changes: &[Change],
        outputs: &[Output],
    ) -> Option<Vec<Vec<Interval>>> {
        let left = Change::through(changes, over.equations, &self.inverse);
        let slopes = in_parallel(numbers.len(), 1, |k| {
            let (number, rest) = (&numbers[k], self.defect.enclose(&left[k])?);
            let steps = self.steps[*number].unknowns.iter().zip(rest);
            let exact = steps.map(|(step, rest)| *step - rest).collect();
            let effect =
                Effect::new(over.equations, cover.system, &cover.numbers[*number], over.region);
            let exact = Step::new(over.equations, &effect, exact);
            let slope = |output: &Output| over.slope(*output, &effect, &exact);
            let slopes: Vec<Interval> = outputs.iter().map(slope).collect();
            slopes.iter().all(|slope| slope.mag().is_finite()).then_some(slopes)
        });
        let slopes: Vec<Vec<Interval>> = slopes.into_iter().collect::<Option<_>>()?;
        let all = 0..outputs.len();
        Some(all.map(|k| slopes.iter().map(|slopes| slopes[k]).collect()).collect())
    }

    /// Halve it by the number that moves an unknown most over its range.
    fn halves(&self) -> Failure {
        let moves = self.steps.iter().zip(&self.parts).map(|(step, part)| {
            step.unknowns.iter().fold(0.0, |most: f64, by| most.max(by.mag())) * part.width()
        });
        let widest = moves.enumerate().reduce(|a, b| if b.1 > a.1 { b } else { a });
        let halves = widest.map(|(widest, _)| {
            let quarter = 0.25 * self.parts[widest].width();
            let middles = [-quarter, quarter].map(|off| {
                let pairs = self.at.iter().zip(&self.steps[widest].unknowns);
                pairs.map(|(x, by)| x.mid() + off * by.mid()).collect()
            });
            (widest, middles)
        });
        Failure { reason: NoBox::NotContracting, halves }
    }

    fn on_plane(&self, numbers: &[f64]) -> Vec<Interval> {
        let mut at = self.at.clone();
        for ((step, middle), x) in self.steps.iter().zip(&self.middle).zip(numbers) {
            let off = Interval::point(*x) - Interval::point(*middle);
            at.iter_mut()
                .zip(&step.unknowns)
                .for_each(|(at, by)| *at = sum(*at, product(*by, off)));
        }
        at
    }

    pub(super) fn contains(&self, numbers: &[f64]) -> bool {
        self.parts.iter().zip(numbers).all(|(part, x)| part.contains(*x))
    }

    /// Whether a point is where the equilibrium at these numbers is the only one.
    pub(super) fn encloses(&self, numbers: &[f64], zero: &[Interval]) -> bool {
        let pairs = self.on_plane(numbers).into_iter().zip(&self.room).zip(zero);
        pairs.into_iter().all(|((plane, room), zero)| (*zero - plane).mag() <= *room)
    }

    /// The equilibrium at these numbers, enclosed.
    ///
    /// The derivative over the room is that of the mean value between a point of it and the equilibrium.
    pub(super) fn at(&self, cover: &Cover<'_>, numbers: &[f64]) -> Result<Vec<Interval>, NoBox> {
        let (equations, plane) = (cover.at(numbers), self.on_plane(numbers));
        let mut at: Vec<f64> = plane.iter().map(|x| x.mid()).collect();
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            for ((x, plane), room) in at.iter_mut().zip(&plane).zip(&self.room) {
                *x = x.max(up(plane.hi() - room)).min(down(plane.lo() + room));
            }
            let point: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
            if !self.encloses(numbers, &point) {
                return Err(NoBox::NotConverged);
            }
            let off = self.inverse.apply(&equations.value(&point)?);
            let size = off.iter().fold(0.0, |most: f64, part| most.max(part.mid().abs()));
            if size > FALLS * last || size <= 0.0 {
                let rest = self.defect.enclose(&off).ok_or(NoBox::NotContracting)?;
                return Ok(point.iter().zip(rest).map(|(x, rest)| *x - rest).collect());
            }
            last = size;
            at.iter_mut().zip(&off).for_each(|(x, step)| *x -= step.mid());
        }
        Err(NoBox::NotConverged)
    }

    /// All that is asked of it.
    pub(super) fn outputs(
        &self,
        cover: &Cover<'_>,
        numbers: &[f64],
    ) -> Result<Vec<Interval>, NoBox> {
        let (zero, equations) = (self.at(cover, numbers)?, cover.at(numbers));
        let region = Region::new(&equations, zero);
        let over = Over { system: cover.system, equations: &equations, region: &region };
        Ok(cover.outputs.iter().map(|output| over.value(*output)).collect())
    }

    /// Bounds of the negative of each output and of the output.
    pub(super) fn bounds(&self, cover: &Cover<'_>) -> Result<Vec<[Bound; 2]>, NoBox> {
        let corners: Vec<[Corner; 2]> = self
            .slopes
            .iter()
            .map(|slopes| SIGNS.map(|sign| Corner::new(slopes, &self.parts, sign)))
            .collect();
        let mut wanted: HashMap<&[i8], Vec<usize>> = HashMap::new();
        for (output, corners) in corners.iter().enumerate() {
            for corner in corners {
                wanted.entry(&corner.at).or_default().push(output);
            }
        }
        let wanted: Vec<_> = wanted.into_iter().collect();
        let values = in_parallel(wanted.len(), 1, |k| {
            let (corner, outputs) = &wanted[k];
            let all = self.outputs(cover, &self.ends(corner))?;
            let values = outputs.iter().map(|k| (*k, all[*k]));
            Ok((*corner, values.collect::<HashMap<_, _>>()))
        });
        let values = values.into_iter().collect::<Result<HashMap<_, _>, NoBox>>()?;
        let all_outputs = cover.outputs.len() <= cover.most_boxes();
        Ok(in_parallel(corners.len(), 1, |k| {
            let corners = &corners[k];
            let [least, most] =
                [0, 1].map(|end| corners[end].bound(values[&corners[end].at[..]][&k], SIGNS[end]));
            let width = least.most + most.most;
            let asked = all_outputs || matches!(cover.outputs[k], Output::Axial(_));
            if !asked || width - least.reached - most.reached <= LOOSE * width {
                return [least, most];
            }
            [(least, 0), (most, 1)].map(|(bound, end)| {
                let enough = 0.5 * LOOSE * width;
                let inner = self.on_face(cover, k, SIGNS[end], &corners[end], enough);
                inner.map_or(bound, |inner| bound.and(inner))
            })
        }))
    }

    fn ends(&self, corner: &[i8]) -> Vec<f64> {
        corner.iter().zip(&self.parts).map(end).collect()
    }

    /// A bound of an output over the face of the box on which it is largest: the numbers with which it changes
    /// in one direction are at their ends, and of the others the derivatives are enclosed over the face alone.
    fn on_face(
        &self,
        cover: &Cover<'_>,
        output: usize,
        sign: f64,
        corner: &Corner,
        enough: f64,
    ) -> Option<Bound> {
        let varies = self.parts.iter().filter(|part| part.width() > 0.0).count();
        if corner.open.is_empty() || corner.open.len() == varies {
            return None;
        }
        let mut parts: Vec<Interval> =
            self.ends(&corner.at).into_iter().map(Interval::point).collect();
        corner.open.iter().for_each(|k| parts[*k] = self.parts[*k]);
        let mut face = Self { parts, ..self.clone() };
        let equations = within(&cover.posed.equations, cover.system, cover.numbers, &face.parts);
        let region = face.region(&cover.at(&self.middle));
        face.defect = region.defect(&equations, &face.inverse);
        let over = Over { system: cover.system, equations: &equations, region: &region };
        let changes = cover.changes(&equations, &region, &self.steps, &corner.open);
        let asked = &cover.outputs[output..=output];
        let found = face.derive(cover, &over, &corner.open, &changes, asked)?;
        let mut slopes = vec![Interval::ZERO; face.parts.len()];
        corner.open.iter().zip(&found[0]).for_each(|(k, slope)| slopes[*k] = *slope);
        let corner = Corner::new(&slopes, &face.parts, sign);
        let value = face.outputs(cover, &face.ends(&corner.at)).ok()?[output];
        let bound = corner.bound(value, sign);
        if bound.most - bound.reached <= enough {
            return Some(bound);
        }
        let inner = face.on_face(cover, output, sign, &corner, enough);
        Some(inner.map_or(bound, |inner| bound.and(inner)))
    }

    #[cfg(test)]
    pub(super) fn slope(&self, output: usize, number: usize) -> Interval {
        self.slopes[output][number]
    }

    /// The number on which an output depends most.
    pub(super) fn most_by(&self, output: usize) -> Option<(usize, f64)> {
        let slopes = self.slopes[output].iter().map(|slope| slope.mid()).enumerate();
        let largest = slopes.reduce(|a, b| if b.1.abs() > a.1.abs() { b } else { a });
        largest.filter(|(_, by)| by.abs() > NOTHING)
    }
}

/// An end of a range, or its middle.
fn end((end, part): (&i8, &Interval)) -> f64 {
    match end {
        1 => part.hi(),
        -1 => part.lo(),
        _ => part.mid(),
    }
}

impl Cover<'_> {
    fn at(&self, numbers: &[f64]) -> Equations {
        let parts: Vec<Interval> = numbers.iter().copied().map(Interval::point).collect();
        within(&self.posed.equations, self.system, self.numbers, &parts)
    }

    /// How an equilibrium moves with each number, per tolerance, in double precision.
    fn steps(&self, fixed: &Equations, at: &[Interval], inverse: &Inverse) -> Vec<Step> {
        let region = Region::new(fixed, at.to_vec());
        let entries = fixed.slope(at);
        let step = |uncertain| {
            let effect = Effect::new(fixed, self.system, uncertain, &region);
            let still = Step::new(fixed, &effect, vec![Interval::ZERO; at.len()]);
            let change = region.change(fixed, &effect, &still);
            let right: Vec<f64> = change.rows.iter().map(|by| -by.mid()).collect();
            let step = inverse.solve(&entries, &right).into_iter().map(Interval::point);
            Step::new(fixed, &effect, step.collect())
        };
        in_parallel(self.numbers.len(), 1, |k| step(&self.numbers[k]))
    }

    /// What each number and its step do to the left-hand sides over a region.
    fn changes(
        &self,
        all: &Equations,
        region: &Region,
        steps: &[Step],
        numbers: &[usize],
    ) -> Vec<Change> {
        in_parallel(numbers.len(), 1, |k| {
            let effect = Effect::new(all, self.system, &self.numbers[numbers[k]], region);
            region.change(all, &effect, &steps[numbers[k]])
        })
    }
}
