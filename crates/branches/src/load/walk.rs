use std::mem::take;

use nalgebra::DVector;

use super::bordered::Row;
use super::crossings::{Crossing, ahead, joins};
use super::events::Singular;
use super::here::{Here, Metric, Space, correct};
use super::kinks::kink;
use super::singular::without_symmetry;
use super::{End, Equations, Event, Kind, LoadPath, NoPath, Parent, Point, Settings};

/// The first step, as a part of the range.
const FIRST: f64 = 1.0 / 64.0;
/// A corrector that moves a point by less leaves what it leaves of the equations.
const ROUNDING: f64 = 1e-9;
/// Cosine of the largest turn of the tangent in one step, about 14 degrees, and of one after which
/// the next step is longer.
const STRAIGHT_ENOUGH: f64 = 0.97;
const STRAIGHT: f64 = 0.995;
/// A chord that differs from the mean of the tangents at its ends by more than this spans no arc.
const SKEW: f64 = 0.003;
/// A corrector that moves a point further than this part of the step has found another path.
const CORRECTION: f64 = 0.2;
/// Growth of the next step after one that went well.
const GROWTH: f64 = 1.6;
/// A step that has jumped to another path is taken again so much shorter.
const SHORTER: f64 = 0.25;
/// The shortest step, as a part of the first.
const SHORTEST: f64 = 1e-10;
/// A start at which the range, to first order, or a unit of force moves places by so many units of
/// length is singular.
const SINGULAR: f64 = 1e6;
/// Places whose change over the range is less than this at the start count as if it were this.
const STILL: f64 = 1e-3;
/// Tangents with less of the parameter than this, a thousandth of the way apart or more, are along equilibria at one value of
/// it: no bend is so flat, but what branches off begins flat, and may stay so for a tenth.
const FLAT: f64 = 1e-6;
const LONG: [f64; 2] = [1e-3, 0.1];
/// Forces that turn round between two points and are so many times as large in between go through infinity.
const BURST: f64 = 4.0;
/// The step before that is no longer than this part of the first.
const NEAR: f64 = 0.1;
/// Part of a step at which the side of a path after a kink is seen.
const BESIDE: f64 = 1e-6;

/// What the way between two points is.
enum Passed<E> {
    /// One path, which goes on.
    On,
    /// Two paths: the step has jumped from one to the other.
    Gap,
    /// One that ends.
    End(End<E>),
}

pub(super) struct Walk<'a, Q: Equations> {
    pub(super) space: Space<'a, Q>,
    settings: Settings,
    points: Vec<Point<Q::Record>>,
    events: Vec<Event<Q::Side>>,
    /// Conditions that have changed sides since the start of the first path, as often as they did.
    switched: Vec<Q::Side>,
    /// Branch points of all paths so far.
    pub(super) crossings: Vec<Crossing<Q::Side>>,
    /// How many branch points there are between this path and the first one.
    pub(super) depth: usize,
    paths: usize,
}

/// The start with its tangent, and the measure in which places and parameter change alike there.
pub(super) fn begin<'a, Q: Equations>(
    equations: &'a mut Q,
    start: &DVector<f64>,
) -> Result<(Space<'a, Q>, Here), NoPath<Q::Error>> {
    let places = equations.places();
    let row = Row::parameter(start.len());
    let found = correct(equations, (start, 0.0), &row).map_err(NoPath::Numbers)?;
    let found = found.map_err(|residual| NoPath::Start { residual })?;
    let mut space = Space { equations, metric: Metric { places, square: 0.0 } };
    let here = space.here(found, [&row, &row]).map_err(NoPath::Numbers)?;
    let mut here = here.ok_or(NoPath::Singular)?;
    let change = here.tangent.y.rows(0, places).norm();
    // Forces alone: a unit of length would be an enormous load.
    let mut push = without_symmetry(start.len());
    push.rows_mut(places, start.len() - places).fill(0.0);
    let gives = space.equations.solve(&push).rows(0, places).amax();
    if change.max(gives) > SINGULAR {
        return Err(NoPath::Singular);
    }
    space.metric.square = change.max(STILL).powi(-2);
    here.tangent = space.metric.unit(here.tangent.y, here.tangent.t);
    Ok((space, here))
}

impl<'a, Q: Equations> Walk<'a, Q> {
    pub(super) fn new(space: Space<'a, Q>, settings: Settings) -> Self {
        let (points, events, switched, crossings) = (vec![], vec![], vec![], vec![]);
        Self { space, settings, points, events, switched, crossings, depth: 0, paths: 0 }
    }

    /// The path from a point on; of a branch point where it begins in one.
    pub(super) fn path(
        &mut self,
        here: &Here,
        parent: Option<Parent>,
        watch: &dyn Fn(usize),
    ) -> LoadPath<Q> {
        let end = self.keep(here, None).and_then(|()| self.run(here.clone(), watch));
        let end = end.unwrap_or_else(End::Numbers);
        // Kinks alone, one after another where it began, lead nowhere.
        let stays = self.points.len() > 1
            && self.points.iter().all(|point| point.t.to_bits() == here.t.to_bits());
        let end = if stays { End::Lost } else { end };
        self.paths += 1;
        let (points, events) = (take(&mut self.points), take(&mut self.events));
        LoadPath { points, events, end, parent }
    }

    /// As at the start of the first path, but for these changes of sides.
    pub(super) fn set(&mut self, switched: &[Q::Side]) -> Result<(), Q::Error> {
        for side in take(&mut self.switched).iter().chain(switched) {
            self.space.equations.switch(*side)?;
        }
        self.switched = switched.to_vec();
        Ok(())
    }

    fn switch(&mut self, side: Q::Side) -> Result<bool, Q::Error> {
        self.switched.push(side);
        self.space.equations.switch(side)
    }

    fn run(&mut self, mut here: Here, watch: &dyn Fn(usize)) -> Result<End<Q::Error>, Q::Error> {
        // Since where the parameter has not changed.
        let (mut length, mut flat) = (FIRST, None::<Here>);
        while self.points.len() < self.settings.max_points {
            watch(self.points.len());
            let slope = here.tangent.t.abs();
            let long = length.min(self.settings.longest / slope.max(f64::MIN_POSITIVE));
            if let Some(end) = self.arrives(&here, long)? {
                return Ok(end);
            }
            let Some((next, lands)) = self.step(&here, long)? else {
                length = 0.5 * long;
                if length < SHORTEST * FIRST {
                    return Ok(End::Lost);
                }
                continue;
            };
            flat = is_flat([flat.as_ref().unwrap_or(&here), &next])
                .then(|| flat.unwrap_or_else(|| here.clone()));
            if let Some(first) = flat.as_ref()
                && self.space.metric.apart(first, &next) >= LONG[usize::from(self.depth > 0)]
            {
                self.leave_open(first.t);
                return Ok(End::Open);
            }
            let turn = self.turn(&here, &next);
            let kink = kink(&mut self.space, &here, &next)?;
            let passed = match &kink {
                Some((at, _)) if self.bursts([&here, at, &next]) => Passed::End(End::Unbounded),
                Some((_, sides)) if sides.is_empty() => Passed::Gap,
                Some((at, _)) => self.smooth(&here, at)?,
                None => self.smooth(&here, &next)?,
            };
            match passed {
                Passed::On => {}
                // Nearer to where forces have no bound.
                Passed::End(End::Unbounded) if long > NEAR * FIRST => {
                    length = SHORTER * long;
                    continue;
                }
                Passed::End(end) => return Ok(end),
                Passed::Gap if long > SHORTEST * FIRST => {
                    length = SHORTER * long;
                    continue;
                }
                Passed::Gap => return Ok(End::Lost),
            }
            if let Some((at, sides)) = kink {
                let Some(after) = self.through(&at, sides)? else {
                    return Ok(End::Lost);
                };
                (here, length) = (after, FIRST.min(long));
                continue;
            }
            if self.space.is_exact(&next)? {
                self.keep(&next, None)?;
            }
            if lands {
                return Ok(End::Range);
            }
            here = next;
            length = if turn >= STRAIGHT { GROWTH * long } else { long };
        }
        Ok(End::MaxPoints)
    }

    /// The end of a path whose next step goes to a branch point that is known, at which several modes meet: next to it
    /// all of them are too soft to step on.
    fn arrives(&mut self, here: &Here, long: f64) -> Result<Option<End<Q::Error>>, Q::Error> {
        let (point, metric) = ((self.paths, self.points.len()), self.space.metric);
        let Some(known) = ahead(metric, &mut self.crossings, (here, long), point) else {
            return Ok(None);
        };
        let (of, at) = (known.of, Here { index: here.index, ..known.at.clone() });
        let (mode, load_on_mode) = self.space.mode(&at, here);
        let mode = mode.iter().copied().collect();
        let event = Event { mode, load_on_mode, ..self.event(Kind::Branch, at.t, [here.index; 2]) };
        self.keep(&at, Some(event))?;
        Ok(Some(End::Joins(of)))
    }

    /// Whether forces go through infinity on the way between two points.
    fn bursts(&self, way: [&Here; 3]) -> bool {
        let places = self.space.metric.places;
        let [a, at, b] = way.map(|here| here.y.rows(places, here.y.len() - places));
        a.dot(&b) < 0.0 && at.norm() > BURST * a.norm().max(b.norm())
    }

    /// Of the points at this value of the parameter only the first, and what changes sides there.
    fn leave_open(&mut self, t: f64) {
        let there = |at: f64| (at - t).abs() <= ROUNDING;
        let Some(first) = self.points.iter().position(|point| there(point.t)) else { return };
        self.points.truncate(first + 1);
        self.events
            .retain(|event| event.point <= first && (event.kind == Kind::Kink || !there(event.t)));
        let point = &mut self.points[first];
        point.event = point.event.filter(|number| *number < self.events.len());
        let (path, events) = (self.paths, self.events.len());
        self.crossings.retain(|crossing| crossing.of.path != path || crossing.of.event < events);
    }

    /// Cosine of the angle between two tangents.
    fn turn(&self, a: &Here, b: &Here) -> f64 {
        self.space.metric.along(&a.tangent).dot(&b.tangent.y, b.tangent.t)
    }

    /// The next point, and whether it is at an end of the range; nothing where the step is too long.
    fn step(&mut self, here: &Here, long: f64) -> Result<Option<(Here, bool)>, Q::Error> {
        let guess = (&here.y + &here.tangent.y * long, here.t + here.tangent.t * long);
        let inside = guess.1.clamp(self.settings.range[0], self.settings.range[1]);
        if inside.to_bits() != guess.1.to_bits() {
            let part = (inside - here.t) / (guess.1 - here.t);
            let guess = &here.y + &here.tangent.y * (long * part);
            let row = Row::parameter(guess.len());
            let end = self.corrected(here, (&guess, inside), Some(&row), long * part)?;
            return Ok(end.map(|end| (end, true)));
        }
        let next = self.corrected(here, (&guess.0, guess.1), None, long)?;
        let inside = self.settings.range[0]..=self.settings.range[1];
        Ok(next.filter(|next| inside.contains(&next.t)).map(|next| (next, false)))
    }

    /// A guess corrected across the tangent, or across this row, with what is there; nothing where it is moved too far.
    fn corrected(
        &mut self,
        here: &Here,
        guess: (&DVector<f64>, f64),
        across: Option<&Row>,
        long: f64,
    ) -> Result<Option<Here>, Q::Error> {
        let along = self.space.metric.along(&here.tangent);
        let row = across.unwrap_or(&along);
        let Ok(found) = correct(self.space.equations, guess, row)? else { return Ok(None) };
        let moved = self.space.metric.norm(&(&found.0 - guess.0), found.1 - guess.1);
        if moved > (CORRECTION * long).max(ROUNDING) {
            return Ok(None);
        }
        let next = self.space.here(found, [row, &along])?;
        Ok(next.filter(|next| self.turn(here, next) >= STRAIGHT_ENOUGH && self.one_arc(here, next)))
    }

    /// Whether the chord of two points points as the mean of their tangents, as that of an arc does: between
    /// different paths, or over a bend and back, it does not.
    fn one_arc(&self, a: &Here, b: &Here) -> bool {
        let metric = self.space.metric;
        let chord = metric.towards(a, b);
        let mean = metric.unit(&a.tangent.y + &b.tangent.y, a.tangent.t + b.tangent.t);
        let off = metric.norm(&(chord.y - mean.y), chord.t - mean.t);
        off <= SKEW || off * metric.apart(a, b) <= ROUNDING
    }

    /// Limit points and branch points between two points; the end of the path where it comes to a
    /// branch point that is known.
    fn smooth(&mut self, a: &Here, b: &Here) -> Result<Passed<Q::Error>, Q::Error> {
        let Some(all) = self.space.smooth(a, b) else { return Ok(Passed::Gap) };
        for found in all {
            let Singular { mut at, kind, index, turns, mode, load_on_mode } = found;
            if self.bursts([a, &at, b]) {
                return Ok(Passed::End(End::Unbounded));
            }
            let mut end = None;
            if kind == Kind::Branch {
                let here = (self.paths, self.points.len() + 1);
                let known = joins(self.space.metric, &mut self.crossings, [a, &at, b], here);
                // That point is known better than it is seen from here, where several directions are singular at once.
                if let Some(Crossing { at: known, of, .. }) = known {
                    (at.y, at.t) = (known.y.clone(), known.t);
                    end = Some(End::Joins(*of));
                }
            }
            let mode = mode.iter().copied().collect();
            let event = Event { turns, mode, load_on_mode, ..self.event(kind, at.t, index) };
            // There the tangent is that of two paths at once.
            let tangent = self.space.metric.towards(a, b);
            let at = Here { index: index[0], tangent, ..at };
            self.keep(&at, Some(event))?;
            if let Some(end) = end {
                return Ok(Passed::End(end));
            }
            if kind == Kind::Branch {
                self.crossings.push(Crossing {
                    at,
                    of: Parent { path: self.paths, event: self.events.len() - 1 },
                    point: self.points.len(),
                    modes: index[0].abs_diff(index[1]).max(1),
                    depth: self.depth,
                    switched: self.switched.clone(),
                    known: vec![],
                });
            }
        }
        Ok(Passed::On)
    }

    /// Beyond a kink: with the conditions on their other sides, the direction in which they are.
    fn through(&mut self, at: &Here, mut sides: Vec<Q::Side>) -> Result<Option<Here>, Q::Error> {
        let mut active = vec![];
        for side in &sides {
            active.push(self.switch(*side)?);
        }
        let mut after = self.beyond(at, &sides)?;
        if after.is_none() && sides.len() > 1 {
            // Not all of them together: the first alone, and the others follow if they have to.
            for side in sides.drain(1..) {
                self.switch(side)?;
            }
            after = self.beyond(at, &sides)?;
        }
        let Some(after) = after else { return Ok(None) };
        let turns = at.tangent.t * after.tangent.t < 0.0;
        let sides = sides.into_iter().zip(active).collect();
        let event = self.event(Kind::Kink, at.t, [at.index, after.index]);
        let event = Event { turns, sides, ..event };
        self.keep(at, Some(event))?;
        Ok(Some(after))
    }

    fn beyond(&mut self, at: &Here, sides: &[Q::Side]) -> Result<Option<Here>, Q::Error> {
        let row = self.space.metric.along(&at.tangent);
        let here = self.space.here((at.y.clone(), at.t), [&row, &row])?;
        let Some(mut here) = here else { return Ok(None) };
        let ahead = &here.y + &here.tangent.y * BESIDE;
        let there = self.space.equations.sides(&ahead, here.t + here.tangent.t * BESIDE)?;
        let now = self.space.equations.sides(&here.y, here.t)?;
        let rises = there.iter().zip(&now).filter(|((side, _), _)| sides.contains(side));
        let rises: Vec<bool> = rises.map(|((_, there), (_, now))| there >= now).collect();
        if rises.contains(&true) && rises.contains(&false) {
            return Ok(None);
        }
        if rises.contains(&false) {
            here = here.turned();
        }
        Ok(Some(here))
    }

    /// What happens at the next point.
    fn event(&self, kind: Kind, t: f64, index: [usize; 2]) -> Event<Q::Side> {
        let (turns, sides, mode, load_on_mode) = (false, vec![], vec![], 1.0);
        let point = self.points.len();
        Event { kind, t, point, index, turns, sides, mode, load_on_mode }
    }

    fn keep(&mut self, here: &Here, event: Option<Event<Q::Side>>) -> Result<(), Q::Error> {
        let record = self.space.equations.record(&here.y, here.t, here.index)?;
        let number = event.map(|event| {
            self.events.push(event);
            self.events.len() - 1
        });
        self.points.push(Point { t: here.t, index: here.index, event: number, record });
        Ok(())
    }
}

/// Whether two points are at one value of the parameter, and their tangents along it.
fn is_flat([a, b]: [&Here; 2]) -> bool {
    (b.t - a.t).abs() <= ROUNDING && [a, b].iter().all(|here| here.tangent.t.abs() <= FLAT)
}
